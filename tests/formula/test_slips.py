"""What goes wrong when a formula is typed: each slip once, in one place."""

import pytest

from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from livesheet.formula.slips import damages


def slips(text, kind, names=()):
    formula = parse_formula(text)
    return [print_formula(each.of(formula)) for each in damages(formula, names) if each.kind == kind]


@pytest.mark.parametrize(
    ("text", "kind", "found"),
    [
        ("$A1", "anchor", ["$A$1", "A1"]),
        ("$B$2", "reference", ["$B$3", "$B$1", "$C$2", "$A$2"]),
        ("IF(a>b,c,d)", "function", ["IF(a>b,d,c)"]),
        ("ATAN2(a,b)", "function", ["ATAN2(b,a)"]),
        ("SIN(RADIANS(a))", "function", ["COS(RADIANS(a))", "SIN(DEGREES(a))", "SIN(a)"]),
        ("a*b", "sign", ["-a*b", "a*-b"]),
        ("-a", "sign", ["a"]),
        ("a<b", "operator", ["a>b", "a<=b"]),
        ("a+2", "constant", ["a+3", "a+2.02", "a+-2"]),
        ("a+0", "constant", ["a+1"]),
    ],
)
def test_slips_of_a_kind(text, kind, found):
    assert sorted(slips(text, kind)) == sorted(found)


def test_a_name_is_taken_for_the_next_one():
    assert slips("a+1", "reference", ["a", "b", "c"]) == ["b+1"]
    assert slips("c+1", "reference", ["a", "b", "c"]) == ["a+1"]
    assert slips("a+1", "reference", ["a"]) == []
