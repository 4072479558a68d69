"""A point is dragged: the dimensions are those with which it lies where it was dragged."""

import math
import re
import tomllib

import pytest

from chosen import CAMS, but, part
from folders import TEMPLATE_FILES
from mechsheet.description.templates import template_text
from mechsheet.drawing_page.editing.shaping import drawn_now, moved, size_of
from mechsheet.drawing_page.questions import Impossible
from mechsheet.drawing_page.reading import read

SHARED = (
    "chebyshev", "parallelogram", "pantograph", "peaucellier", "roberts", "watt-straight-line", "oldham", "scissor-lift",
    "scissor-lift-between-arms", "five-bar-robot", "desk-lamp",
)  # fmt: skip
"""One dimension is the length of several links: to drag one changes the others."""
FOUND = tuple(path.stem for path in TEMPLATE_FILES if "[synthesis]" in path.read_text(encoding="utf-8"))
"""A synthesis has found their dimensions."""

# a cam's follower stands where the base circle and the segments say
TIED = ("cardan-gear", "geared-five-bar", "rack-slider")
"""Gears decide about angles: lengths alone change."""


def dragged(path, point, by):
    """(how far the point and the farthest other one are off, as parts of the size; texts before and after)."""
    text = path.read_text(encoding="utf-8")
    reading = read(text, path.name)
    before = drawn_now(reading, None, {}).places
    size = size_of(before)
    to = (before[point][0] + by[0] * size, before[point][1] + by[1] * size)
    new, at = moved(reading, point, to, None, {})
    found = read(new, path.name)
    assert found.compiled is not None, found.faults
    after = drawn_now(found, at, {}).places
    others = max((math.dist(after[other], before[other]) for other in before if other != point), default=0.0)
    return math.dist(after[point], to) / size, others / size, text, new


def points_of(path):
    return list(drawn_now(read(path.read_text(encoding="utf-8"), path.name), None, {}).places)


def names_in(path):
    """The same names as they stand in the text: cases are listed before anything is solved."""
    links = tomllib.loads(path.read_text(encoding="utf-8"))["links"].values()
    return list(dict.fromkeys(name for link in links for name in link.get("points", link)))


CASES = [(path, point) for path in but(TEMPLATE_FILES, *SHARED, *TIED, *FOUND, *CAMS) for point in names_in(path)]


@pytest.mark.slow
@pytest.mark.cases(5)
@pytest.mark.parametrize(("path", "point"), part(CASES, 9), ids=lambda part: getattr(part, "stem", part))
def test_a_dragged_point_lies_where_it_was_dragged(path, point):
    """And a solved mechanism comes of it; what is not one of its links keeps its dimensions."""
    off, _, text, new = dragged(path, point, (0.03, 0.02))
    assert (
        off < 0.05
        if path.stem in ("cylinder-boom", "excavator", "planar-3rpr", "inverted-slider-crank")
        else off < 2e-3
    )
    assert len(new.splitlines()) <= len(text.splitlines()) + 4  # a sketch: its heading, `at`, the point


@pytest.mark.parametrize("name", [name for name in (*SHARED, *TIED) if name != "oldham"])
def test_where_dimensions_are_shared_it_can_still_be_solved(name):
    path = TEMPLATE_FILES[0].with_stem(name)
    off, _, _, _ = dragged(path, points_of(path)[-1], (0.02, 0.01))
    assert off < 0.1


def test_the_coupler_point_of_the_four_bar():
    """C has its distances b3 and c3 from A and B: nothing else changes, gamma3 follows."""
    path = TEMPLATE_FILES[0].with_stem("four-bar")
    off, others, text, new = dragged(path, "C", (0.05, -0.1))
    changed = [line for line in new.splitlines() if line not in text.splitlines()]
    assert [re.match(r"\w+", line)[0] for line in changed] == ["b3", "c3"]
    assert off < 1e-3
    assert others < 1e-3


def test_a_zero_stays_a_zero():
    """The rocker lies along its own x axis: its length follows, not the 0 beside it."""
    path = TEMPLATE_FILES[0].with_stem("four-bar")
    _, _, _, new = dragged(path, "B", (0.05, 0.05))
    assert 'B = ["a4", 0]' in new
    assert 'B = ["a3", 0]' in new


def test_a_point_of_the_ground_takes_plain_numbers_where_there_is_no_dimension():
    path = TEMPLATE_FILES[0].with_stem("four-bar")
    _, _, _, new = dragged(path, "B0", (0.0, 0.1))
    assert re.search(r'B0 = \["a1", 1\d\.\d+\]', new)


def test_a_crank_that_is_dragged_turns_and_the_sketch_says_so():
    path = TEMPLATE_FILES[0].with_stem("four-bar")
    _, others, _, new = dragged(path, "A", (0.0, 0.1))
    assert re.search(r"^at = \d", new, re.MULTILINE)
    assert others < 2e-3


def test_the_eccentricity_of_a_guide_follows_its_block():
    path = TEMPLATE_FILES[0].with_stem("slider-crank")
    off, _, text, new = dragged(path, "B", (0.0, 0.05))
    assert off < 2e-3
    value = re.compile(r"^a1 = { value = ([\d.]+)", re.MULTILINE)
    assert float(value.search(new)[1]) > float(value.search(text)[1])


def test_a_point_that_is_dragged_to_the_other_side_is_joined_there():
    """The other assembly: the sketch says it, and the drawing keeps it."""
    path = TEMPLATE_FILES[0].with_stem("four-bar")
    off, others, _, _ = dragged(path, "B", (-0.02, -0.85))
    assert off < 2e-3
    assert others < 2e-3


def test_comments_order_and_line_count_stay():
    path = TEMPLATE_FILES[0].with_stem("four-bar")
    _, _, text, new = dragged(path, "B", (0.04, 0.02))
    kept = [line for line in text.splitlines() if line.startswith("#") or line.startswith("[")]
    assert [line for line in new.splitlines() if line.startswith("#") or line.startswith("[")] == kept


@pytest.mark.slow
@pytest.mark.parametrize("name", FOUND)
def test_what_a_synthesis_has_found_stays_what_it_found(name):
    """Its lengths follow from what is asked of it: no number is written over them."""
    path = TEMPLATE_FILES[0].with_stem(name)
    for point in points_of(path):
        try:
            _, _, text, new = dragged(path, point, (0.02, 0.02))
        except Impossible:
            continue
        assert new.count("synthesis = ") == text.count("synthesis = ")


def test_where_no_number_leads_the_page_says_so():
    """The middle of an Oldham coupling is where both discs want it."""
    with pytest.raises(Impossible) as told:
        dragged(TEMPLATE_FILES[0].with_stem("oldham"), "M", (0.05, 0.05))
    assert "M" in told.value.text("en")


def test_the_other_assembly_is_sketched_where_no_sketch_was(tmp_path):
    """Without a sketch the mode is +1: a point dragged to the other side is named, and stays there."""
    text = TEMPLATE_FILES[0].with_stem("four-bar").read_text(encoding="utf-8").replace("[assembly]\nB = [50, 55]\n", "")
    path = tmp_path / "four-bar.toml"
    path.write_text(text, encoding="utf-8")
    off, _, _, new = dragged(path, "B", (-0.02, -0.85))
    assert off < 2e-3
    assert re.search(r"^B = \[", new, re.MULTILINE)


def test_a_length_with_its_unit_is_dragged_as_one_without():
    text = template_text("four-bar")
    text = re.sub(r"(?m)^a2 = .*$", 'a2 = "3.5 cm"', text)
    reading = read(text, "four-bar.toml")
    before = drawn_now(reading, None, {}).places
    assert math.dist(before["A0"], before["A"]) == pytest.approx(35)
    new, _ = moved(reading, "A", (before["A0"][0] + 40.0, before["A0"][1]), None, {})
    assert re.search(r"(?m)^a2 = 40(\.0)?$", new)
