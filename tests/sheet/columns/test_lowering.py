"""From mathematics to cells: angles of triangles, angles that go on, and what makes a row claim no position."""

import math
from itertools import pairwise

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from laid import Laid

from chosen import examples
from livesheet.engine import evaluate
from livesheet.formula.algebra import rooted
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import Call, CellRef, ErrorValue, Symbol, walk
from livesheet.formula.printer import print_formula
from mechsheet.description.templates import template_text
from mechsheet.kinematics.solve import solve
from mechsheet.sheet.columns.lowering import angle_by_sides, lowered, sine_side

NA = ErrorValue("#N/A")
FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]


def angle(opposite, beside, other):
    """What a cell gives for three sides."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col, side in enumerate((opposite, beside, other)):
        sheet.constant(0, col, float(side))
    a, b, c = (CellRef(0, col) for col in range(3))
    sheet.block(1, 0, 1, 1, angle_by_sides(a, b, c, sine_side(b, c, a)))
    return evaluate(builder.build()).get("S", 1, 0)


@settings(max_examples=examples(60), derandomize=True, deadline=None, database=None)
@given(st.floats(0.1, 100), st.floats(0.1, 100), st.floats(0.02, 0.98))
def test_the_angle_is_that_of_the_law_of_cosines(beside, other, part):
    opposite = abs(beside - other) + part * (beside + other - abs(beside - other))
    with mpmath.workdps(40):
        a, b, c = (mpmath.mpf(side) for side in (opposite, beside, other))
        expected = mpmath.acos((b * b + c * c - a * a) / (2 * b * c))
    assert angle(opposite, beside, other) == pytest.approx(float(expected), rel=1e-12)


@pytest.mark.parametrize(("beside", "other"), [(3.0, 5.0), (0.1, 0.3), (62.3, 56.0)])
def test_exact_at_dead_centres(beside, other):
    """Stretched half a turn, folded nothing; a rounding error beyond them is no gap."""
    assert angle(beside + other, beside, other) == pytest.approx(math.pi, abs=1e-15)
    assert angle(abs(beside - other), beside, other) == pytest.approx(0, abs=1e-15)
    assert angle((beside + other) * (1 + 1e-15), beside, other) == pytest.approx(math.pi, abs=1e-15)
    assert angle(abs(beside - other) * (1 - 1e-15), beside, other) == 0


@pytest.mark.parametrize("thin", [1e-3, 1e-6, 1e-9])
def test_thin_triangles_keep_their_digits(thin):
    """Two links of the same length nearly folded together: the arccosine would lose up to all of them."""
    with mpmath.workdps(40):
        a, b = mpmath.mpf(62.3 * thin), mpmath.mpf(62.3)
        expected = float(mpmath.acos((2 * b * b - a * a) / (2 * b * b)))
    assert angle(62.3 * thin, 62.3, 62.3) == pytest.approx(expected, rel=1e-14, abs=0)
    textbook = math.acos((2 * 62.3**2 - (62.3 * thin) ** 2) / (2 * 62.3**2))
    assert textbook != pytest.approx(expected, rel=1e-12, abs=0)


def test_dead_centres_are_never_an_error():
    """Lengths of one decimal, stretched and folded: at every third one the cosine is 1 + 1e-16 in one way or the other."""
    beyond = 0
    for tenths in range(101, 700, 20):
        beside, other = tenths / 10, 45.7
        for opposite, expected in ((beside + other, math.pi), (abs(beside - other), 0.0)):
            beyond += abs((beside**2 + other**2 - opposite**2) / (2 * beside * other)) > 1
            assert angle(round(opposite, 1), beside, other) == pytest.approx(expected, abs=1e-7)
    assert beyond > 5


@pytest.mark.slow
def test_a_root_is_guarded_once():
    """SQRT(MAX(0, x)), however often it is asked for."""
    once = rooted(Call("SQRT", (Symbol("x"),)))
    assert print_formula(once, "text") == print_formula(rooted(once), "text")
    laid = Laid(FOUR_BAR)
    for fill in laid.workbook.sheet(laid.plan.table).fills:
        for part in walk(fill.formula):
            if isinstance(part, Call) and part.name == "MAX":
                assert not any(isinstance(arg, Call) and arg.name == "MAX" for arg in part.args)


@pytest.mark.slow
@pytest.mark.parametrize("step", [15, 70, 170, -170])
def test_direction_goes_on_within_half_a_turn(step):
    """phi of each row is within half a turn of the row above, whole turns included, at any step."""
    laid = Laid(template_text("drag-link").partition("[[charts]]")[0]).change(_step=step)
    phi = laid.column("phi")
    assert all(laid.exists)
    assert max(abs(after - before) for before, after in pairwise(phi)) <= math.pi + 1e-12
    turned = math.degrees(phi[-1] - phi[0])
    assert abs(turned) > 300  # it counts turns, and does not come back into one


@pytest.mark.slow
def test_direction_begins_anew_after_rows_without_a_position():
    """Nobody knows how the mechanism came there: the first angle behind a gap is the one within half a turn."""
    text = FOUR_BAR.replace("stop = 360", "stop = 720").replace("a1 = { value = 70", "a1 = { value = 100")
    laid = Laid(text)
    exists, theta = laid.exists, laid.column("theta14")
    begun = [row for row in range(1, laid.plan.rows) if exists[row] and not exists[row - 1]]
    assert len(begun) >= 2
    assert theta[begun[0]] == pytest.approx(theta[begun[1]], abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("typed", "named"),
    [
        ({"a3": 0}, "a₃"),
        ({"a2": -35}, "a₂"),
        ({"a1": None}, "a₁"),
        ({"mode_1": 2}, "mode₁"),
        ({"mode_1": 0.5}, "mode₁"),
    ],
)
def test_no_row_claims_a_position_for_inputs_that_cannot_be(typed, named):
    """An emptied cell, a length of 0 between joints, an assembly that is none: no row closes, and the line says why."""
    laid = Laid(FOUR_BAR)
    symbols = {"mode_1": laid.plan.equations.groups[0].mode}
    laid.change(**{symbols.get(name, name): value for name, value in typed.items()})
    assert laid.spot(laid.plan.equations.tolerance) == NA
    assert not any(laid.exists)
    assert laid.spot("rows_closed") == 0
    for symbol in ("theta14", "theta13", "B.x", "C.y", "mu"):
        assert set(laid.column(symbol)) == {NA}, symbol
    assert laid.verdict.startswith(f"look at {named}: ")


def test_groups_that_always_close_ask_the_inputs_too():
    """Two lines that cross at one angle have no margin."""
    laid = Laid(template_text("scotch-yoke")).change(a2=None)
    assert laid.spot("rows_closed") == 0
    assert set(laid.column("s13")) == {NA}


@pytest.mark.slow
def test_a_row_without_a_position_keeps_what_does_not_depend_on_the_group():
    laid = Laid(FOUR_BAR).change(a1=110)
    exists = laid.exists
    assert 0 < sum(exists) < laid.plan.rows
    for symbol in ("A.x", "A.y", "s", "phi"):
        assert all(isinstance(cell, float) for cell in laid.column(symbol)), symbol
    for symbol in ("theta14", "theta13", "B.x", "C.x", "mu"):
        assert [isinstance(cell, float) for cell in laid.column(symbol)] == exists, symbol
        assert all(cell == NA for cell, there in zip(laid.column(symbol), exists, strict=True) if not there)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "jansen", "slider-crank", "slotted-lever", "scissor-lift"])
def test_one_column_for_each_equation(name):
    """A column a quantity, none twice under one heading, and one more for the margin of a group that can come apart."""
    laid = Laid(template_text(name))
    equations = solve(laid.mechanism)
    ours = lowered(laid.mechanism, equations)
    symbols = [column.symbol for column in laid.plan.columns if column.symbol]
    assert len(set(symbols)) == len(symbols)
    added = {each.symbol for each in ours.columns} - {each.symbol for each in equations.all}
    assert added == set(ours.margins.values())
