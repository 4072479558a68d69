"""Yellow cells that decide no position, and the one with the position shown: where they cannot be, nothing is green."""

import pytest
from both_layouts import Book
from placed import places_of

from mechsheet.description.templates import template_text
from mechsheet.sheet.plan import VALUE

FOUR_BAR, FORCES, GEARED = (template_text(name) for name in ("four-bar", "four-bar-forces", "geared-five-bar"))
MISFIT = "look at the yellow cells: they do not fit"
LAYOUTS = pytest.mark.parametrize("layout", ["sheets", "page"])


@LAYOUTS
def test_what_follows_from_them_and_is_no_number(layout):
    """The coupler's third side is too short: the angle at A does not exist."""
    assert Book(FOUR_BAR, layout).type(b3=10).line == MISFIT


@pytest.mark.slow
@LAYOUTS
@pytest.mark.parametrize("typed", [{"J_3": None}, {"m_3": -1}, {"omega12": None}, {"M": None}])
def test_what_rates_and_forces_follow_from(typed, layout):
    book = Book(FORCES, layout).type(**typed)
    (symbol,) = typed
    assert (book.number("inputs"), book.words("inputs"), book.line) == (0, MISFIT, MISFIT)
    assert (book.colour(places_of(book.plan)[symbol].row, VALUE), book.line_colour) == ("red", "red")
    assert book.number("rows_closed") == 37


@pytest.mark.slow
def test_of_no_forces_nothing_is_said_to_agree():
    book = Book(FORCES, "sheets").type(J_3="x")
    for key in ("largest_effort", "largest_force", "effort_fits"):
        assert (str(book.number(key)), book.words(key)) == ("#N/A", ""), key


@pytest.mark.slow
@LAYOUTS
@pytest.mark.parametrize("symbol", ["z2", "z5"])
def test_a_wheel_without_teeth(symbol, layout):
    line = Book(GEARED, layout).type(**{symbol: 0}).line
    assert line.startswith(f"look at z{'₂' if symbol == 'z2' else '₅'}") or line.startswith(f"look at {symbol}")


@pytest.mark.parametrize("number", [-1, 25, 2.5, None])
def test_a_position_that_is_none_shows_no_other(number):
    """INDEX with 0 takes the row in which the formula stands: beside position -1 stood "45°, ok"."""
    book = Book(FOUR_BAR, "sheets").type(position=number)
    rows = book.plan.blocks["position"].rows
    shown = [book.values.get(book.plan.main, row, VALUE) for row in (rows["theta12"], rows["status"])]
    assert [str(value) for value in shown] == ["#N/A", "no position there"]
    assert book.line == "look at position: no value that it can have"


@pytest.mark.slow
def test_a_crank_that_turns_far_in_a_step():
    """At 1000° a row nobody knows what is between; it was said that no link turns far."""
    far = Book(FOUR_BAR, "sheets").type(step=1000)
    assert (far.number("leaps"), far.words("leaps")) == (24, "turns of over 90° in a step: smaller step")
    assert far.words("swing_theta14") == "unsure: links turn far, smaller step"
    assert far.type(step=90).number("leaps") == 0
