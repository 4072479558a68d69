"""Dialects that are only written: programs and the textbook."""

import pytest

from livesheet.formula.nodes import Call, Number
from livesheet.formula.parser import parse_description
from livesheet.formula.printer import print_formula
from livesheet.formula.written import WRITTEN
from mechsheet.kinematics.numeric import FUNCTIONS


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("a - -b", r"a - (-b)"),
        ("-(-b)", r"-(-b)"),
        ("-(a*b)", r"-a\,b"),
        ("-(a + b)", r"-(a + b)"),
        ("(-a)*b", r"(-a)\,b"),
        ("(-a)^2", r"(-a)^{2}"),
        ("-a^2", r"-a^{2}"),
        ("a*cos(b)", r"a\,\cos b"),
        ("cos(b)^2", r"(\cos b)^{2}"),
        ("cos(a + b)*c", r"\cos\left(a + b\right)\,c"),
        ("(a + b)/(c*d)", r"\frac{a + b}{c\,d}"),
        ("(a/b)^2", r"(\frac{a}{b})^{2}"),
        ("2^3^a", r"2^{3^{a}}"),
        ("sqrt(a^2 + b^2)", r"\sqrt{a^{2} + b^{2}}"),
        ("atan2(b, a)", r"\operatorname{arctan2}\left(a;\ b\right)"),
        ("max(a, b, 1)", r"\max\left(\max\left(a;\ b\right);\ 1\right)"),
    ],
)
def test_latex(text, latex):
    """arctan2 takes x first on paper, as in the cell."""
    assert print_formula(parse_description(text), "latex", lambda part: part.name) == latex


@pytest.mark.parametrize(
    ("text", "octave", "python"),
    [
        ("-a^2", "-a.^2", "-a**2"),
        ("2^3^a", "raised(2, raised(3, a))", "np.power(2, np.power(3, a))"),
        ("(a^2)^3", "a.^2.^3", "(a**2)**3"),
        ("a/(b*2)", "a ./ (b .* 2)", "a / (b * 2)"),
        ("atan2(b, a)", "direction(a, b)", "_direction(a, b)"),
        ("radians(a)", "a .* pi ./ 180", "np.radians(a)"),
        ("min(a, b, 0.5)", "smaller(smaller(a, b), 0.5)", "np.minimum(np.minimum(a, b), 0.5)"),
    ],
)
def test_programs(text, octave, python):
    node = parse_description(text)
    assert print_formula(node, "octave", lambda part: part.name) == octave
    assert print_formula(node, "python", lambda part: part.name) == python


@pytest.mark.parametrize(
    ("text", "basic"),
    [
        ("max(a, b, c, 1)", "MaxOf(MaxOf(a, b), MaxOf(c, 1))"),
        ("min(a, b, 0.5)", "MinOf(a, MinOf(b, 0.5))"),
        ("radians(a)", "((a) * PiValue() / 180)"),
        ("(-a)^2", "((-a) ^ (2))"),
    ],
)
def test_basic(text, basic):
    assert print_formula(parse_description(text), "basic", lambda part: part.name) == basic


OF_SEARCHES = {"MEDIAN", "MOD", "ROUNDDOWN", "ROUNDUP"}
"""In the rules by which sheets and studies search: no equation has them."""


def test_programs_can_say_what_equations_say():
    """Every function of the equations has its counterpart, and a symbol needs a name."""
    for name in ("octave", "python"):
        known = set(WRITTEN[name].calls) | {"SUMSQ", "RADIANS", "DEGREES", "CHOOSE", "IFERROR"}
        assert set(FUNCTIONS) - OF_SEARCHES <= known
    with pytest.raises(ValueError, match="GAMMA"):
        print_formula(Call("GAMMA", (Number(1.0),)), "octave")
