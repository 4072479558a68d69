"""The type of a four-bar loop: the same words in both layouts and in a study, also beside a change point."""

import math
import re

import numpy as np
import pytest
from both_layouts import Book
from placed import places_of

from mechsheet.description.templates import template_text
from mechsheet.studies.questions import turns_fully

FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]
PRESS = re.sub(
    r"(?ms)^\[dynamics\].*?(?=^\[assembly\])|^\[summary\].*|^speed = .*?$", "", template_text("toggle-press")
)
SYMBOLS = ("a1", "a2", "a3", "a4")


def near_change_points(count):
    """Lengths that miss a change point by 1e-13 to 1e-5 of the longest, of every size, in any order."""
    random = np.random.default_rng(31)
    for _ in range(count):
        sides = random.uniform(0.2, 1.0, 3) * 10.0 ** random.uniform(-3, 6)
        short, long = min(sides), max(sides)
        other = short + long - sum(sides) + short + long  # shortest + longest - the one between
        off = random.choice([-1, 1]) * 10.0 ** random.uniform(-13, -5) * long
        yield random.permutation([*sides, other + off]).tolist()


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "tr"])
def test_both_layouts_say_the_same_type(language):
    sheets, page = (Book(FOUR_BAR, layout, language) for layout in ("sheets", "page"))
    cases = [[60, 20, 49.9999999999, 30], [70, 35, 70, 35], [60, 20, 49.99, 30], *near_change_points(40)]
    for lengths in cases:
        typed = dict(zip(SYMBOLS, lengths, strict=True))
        said = [book.type(**typed).words("grashof_1").removeprefix("A0ABB0: ") for book in (sheets, page)]
        assert said[0] == said[1], lengths
        fully = bool(turns_fully([np.array([length]) for length in lengths])[0])
        stuck = [sheets.plan.text(f"verdict.grashof.{word}") for word in ("none", "change", "open")]
        assert fully == (said[0].partition(sheets.plan.text("verdict.grashof.enough"))[0] not in stuck), lengths


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_no_length_is_advised_that_no_link_can_have(layout):
    """A first link of a sixtieth of its length, or of less than nothing, would turn fully."""
    book = Book(FOUR_BAR, layout)
    book.type(a1=70, a2=65, a3=63, a4=66)
    assert "not Grashof; enough: a₂ ≤ " in book.line
    for longest in (128, 180):
        book.type(a1=longest, a2=65, a3=63, a4=66)
        assert "not Grashof" in book.line
        assert "enough" not in book.line


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize(
    ("language", "alone"),
    [("en", "loop A0AKB0 alone: crank-rocker, "), ("tr", "yalnız A0AKB0 devresi: krank-sarkaç, ")],
)
def test_of_a_linkage_of_more_links_it_is_the_type_of_the_loop_alone(layout, language, alone):
    """The links behind the loop may come apart while its crank turns fully: then the type is no summary."""
    book = Book(PRESS, layout, language)
    assert f"; {alone}" in book.line
    book.type(a5=60)
    assert "47" in book.line and "73" in book.line
    assert "A0AKB0" not in book.line and book.line_colour == "amber"


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("language", "words"), [("en", "tolerances reach a change point"), ("tr", "toleranslar sınır duruma")]
)
def test_tolerances_that_reach_a_change_point(language, words):
    """Those of the four lengths add up to 0.3; at 160 the linkage is at its change point."""
    book = Book(template_text("hoeken").partition("[[charts]]")[0], "sheets", language)
    for a1 in (80, 159.5, 159.75, 159.9, 160, 160.2, 160.5):
        book.type(a1=a1)
        reached = 0 < abs(a1 - 160) < 0.3
        assert (words in book.words("grashof_1")) == reached, a1
        assert (book.colour(book.row("grashof_1"), 4) == "amber") == (reached or a1 == 160), a1
        assert (words in book.line) == reached
        assert book.line_colour == "amber" or not reached


@pytest.mark.slow
def test_how_far_tolerances_reach_follows_from_where_points_are():
    """The ground's length is the hypotenuse of two dimensions with a tolerance."""
    book = Book(template_text("toggle-press").partition("[[charts]]")[0], "sheets")
    spot = places_of(book.plan)["reach_1"]
    expected = 0.1 * (300 + 180) / math.hypot(300, 180) + 0.05 + 0.1 + 0.05
    assert book.values.get(spot.sheet, spot.row, spot.col - 1) == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_a_change_point_does_not_depend_on_lengths_outside_its_loop():
    """A long arm of the coupler is none of the four lengths."""
    book = Book(FOUR_BAR, "sheets")
    lengths = {"a1": 60.0, "a2": 20.0, "a3": 50.0 - 4e-7, "a4": 30.0}
    assert book.type(**lengths).words("grashof_1") == book.type(**lengths, b3=1e5, c3=1e5).words("grashof_1")
