"""The angle of transmission: one angle between 0 and 90 degrees, the worst first, amber where poor, in both layouts."""

import math
import re

import pytest
from both_layouts import Book

from mechsheet.description.templates import template_text

FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]


def worst_of(a1, a2, a3, a4, rows=25):
    """By the law of cosines, over the rows that close."""
    found = []
    for row in range(rows):
        s2 = a1**2 + a2**2 - 2 * a1 * a2 * math.cos(math.tau * row / (rows - 1))
        cosine = (a3**2 + a4**2 - s2) / (2 * a3 * a4)
        if abs(cosine) <= 1:
            found.append(math.degrees(math.acos(abs(cosine))))
    return min(found)


@pytest.mark.cases(3)
@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("language", ["en", "tr"])
def test_what_is_said(layout, language):
    book = Book(FOUR_BAR, layout, language)
    poor = {"en": " (below 40°: poor)", "tr": " (40° altı: kötü)"}[language]
    for a2 in (15, 20, 35, 50):  # 50: three rows do not close, and it is worse than 35
        for mode in (1, -1):
            book.type(a2=a2, mode_1=mode)
            worst = worst_of(70, a2, 62.3, 56)
            assert book.number("transmission_1") == pytest.approx(worst, abs=1e-6)
            said = book.line[book.line.rindex(";") :]
            first, place = [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", said.replace(poor, ""))]
            assert first == pytest.approx(worst, abs=0.051), said
            s2 = 70**2 + a2**2 - 2 * 70 * a2 * math.cos(math.radians(place))
            cosine = (62.3**2 + 56**2 - s2) / (2 * 62.3 * 56)
            assert math.degrees(math.acos(abs(cosine))) == pytest.approx(worst, abs=0.1), said
            assert (poor in said) == (poor in book.words("transmission_1")) == (worst < 40), said
            assert book.line_colour == ("amber" if worst < 40 else "green")
            assert book.colour(book.row("transmission_1"), 4) != ("green" if worst < 40 else "amber")


@pytest.mark.slow
def test_of_rows_only_nothing_is_said_of_what_lies_between_them():
    """Of two stretches no row is at a right angle, though one of them ends below it and the other begins above."""
    book = Book(FOUR_BAR, "sheets").type(a1=60, a2=50, a3=45, a4=48)
    assert book.words("transmission_1") == "worst 11.8° at 0° (below 40°: poor) (rows only)"
    few = Book(re.sub(r"(?m)^step = .*", "step = 180", FOUR_BAR), "sheets")  # three rows: 0, 180, 360
    assert few.words("transmission_1") == "worst 33.9° at 0° (below 40°: poor) (rows only)"
    assert few.type(a2=15).words("transmission_1") == "worst 55.1° at 0° (rows only)"


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_the_worst_of_several_groups_decides(layout):
    """A rod against its guide counts from a right angle to it, two links from each other."""
    book = Book(template_text("six-bar-r-rrr-rrt").partition("[[charts]]")[0], layout)
    keys = [key for key in book.plan.blocks["verdicts"].rows if key.startswith("transmission")]
    assert len(keys) > 1
    worst = min(book.number(key) for key in keys)
    assert f"{worst:.1f}".removesuffix(".0") in book.line
    assert book.line_colour == ("amber" if worst < 40 else "green")


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_of_two_places_that_rounding_tells_apart_both_layouts_name_one(layout):
    """The slide of a Whitworth mechanism is as far from a right angle at 90 degrees as at 270."""
    book = Book(template_text("whitworth").partition("[[charts]]")[0], layout)
    assert "worst 72.5° at 270°" in book.line
