"""`check` holds what the first sheet says against a search in Python: a wrong verdict is found, with its cell."""

from dataclasses import replace
from functools import cache

import pytest
from edited import TEMPLATES, edited, laid_out, saved
from placed import places_of

import random_cams
from livesheet.diagnostics import WorkbookError
from livesheet.engine import compile_book
from livesheet.evaluation import book_of
from livesheet.formula.references import cell_address
from mechsheet.checking import check
from mechsheet.checking.against_search import EXACT, against_search
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.search import Search
from mechsheet.library.verdicts import verdicts_of

pytestmark = pytest.mark.slow


@cache
def built(name, layout="sheets"):
    compiled = Compiled(replace(load(TEMPLATES / f"{name}.toml"), layout=layout))
    return compiled, compile_book(book_of(compiled.layout))


class Damaged:
    """Values, but one of a verdict's cell that is off by so much."""

    def __init__(self, values, spot, by):
        self.values, self.place, self.by, self.column = values, (spot.sheet, spot.row, spot.col), by, values.column

    def get(self, *place):
        value = self.values.get(*place)
        return value + self.by if place == self.place else value


@cache
def evaluated(name, layout, typed):
    compiled, book = built(name, layout)
    places = places_of(compiled.plan)
    spots = {places[symbol]: value for symbol, value in typed}
    return book.evaluate({(spot.sheet, spot.row, spot.col): float(value) for spot, value in spots.items()})


def judged(name, layout="sheets", damage=None, **typed):
    """The comparison, with a verdict's value changed by `damage` (key, by how much), and inputs typed."""
    plan = built(name, layout)[0].plan
    values = evaluated(name, layout, tuple(typed.items()))
    if damage is not None:
        values = Damaged(values, places_of(plan)[damage[0]], damage[1])
    return against_search(book_of(built(name, layout)[0].layout), values, plan, name)


def test_a_redundant_link_that_does_not_fit_is_off_by_its_length_in_either_assembly():
    """In the other one the slot that stands for it is passed the other way."""
    for mode in (1, -1):
        found = judged("double-parallelogram", a4=224.375, mode_2=mode)
        assert found.agrees, found


@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("typed", [{}, {"a1": 110}, {"a1": 200}])
def test_a_four_bar_says_what_the_search_finds(layout, typed):
    """Everywhere, between limits, nowhere."""
    found = judged("four-bar", layout, **typed)
    assert found.agrees, found


@pytest.mark.parametrize(
    ("key", "by", "typed"),
    [
        ("rows_closed", 1, {}), ("limits", 1, {}), ("limit_1", 0.01, {"a1": 110}), ("input_to", 0.01, {"a1": 110}),
        ("grashof_1", 0.01, {}), ("swing_theta14", 0.02, {}), ("time_ratio_theta14", 0.05, {}),
        ("transmission_1", 0.02, {}), ("largest_gap", 1e-3, {}), ("leaps", 1, {}), ("passes", 1, {}),
    ],
)  # fmt: skip
def test_a_wrong_verdict_is_found(key, by, typed):
    found = judged("four-bar", damage=(key, by), **typed)
    assert not found.agrees
    assert f"({key})" in found.where
    assert found.worst > EXACT


def test_check_reports_a_verdict_that_was_typed_over(tmp_path):
    """The cell, what it says, and what is true."""
    workbook, plan = laid_out("four-bar")
    spot = places_of(plan)["verdict"]
    cell, said = cell_address(spot.sheet, spot.row, spot.col), "closes in all 24 positions"
    report = check(saved(edited(workbook, **{cell.replace("!", "_"): said}), tmp_path / "edited.xlsx"))
    search = next(item for item in report.comparisons if item.judge == "search")
    assert (search.agrees, search.where, search.ours) == (False, f"{cell} (verdict)", said)
    assert search.theirs == "closes in all 25 positions"


def test_a_mode_that_is_none_and_a_length_below_0_are_no_inputs():
    """They are reported, not read as +1, and as a linkage of another shape."""
    mode = built("four-bar")[0].plan.equations.groups[0].mode
    with pytest.raises(WorkbookError, match=r"mode_1 must be 1 or -1, not 0\.5"):
        judged("four-bar", **{mode: 0.5})
    with pytest.raises(WorkbookError, match="a2 is the distance of two joints and must be greater than 0, not -35"):
        judged("four-bar", a2=-35)


def test_the_search_knows_a_crank_slider():
    """Stroke of a slider-crank in line: twice the crank, from the sketch of it alone."""
    compiled, _ = built("slider-crank")
    mechanism = compiled.mechanism
    dimensions = tuple(replace(dim, value=0.0) if dim.symbol == "a1" else dim for dim in mechanism.dimensions)
    search = Search(replace(mechanism, dimensions=dimensions), compiled.equations, compiled.given)
    low, _, high, _ = search.extremes("s14")
    crank = next(dim.value for dim in mechanism.dimensions if dim.symbol == "a2")
    assert high - low == pytest.approx(2 * crank, rel=1e-9)
    assert search.whole
    assert search.closes_everywhere
    assert not search.limits()


def test_show_prints_what_the_search_finds_not_what_the_probes_found():
    """A designer who reads the time ratio from a script gets it exactly; the sheet's is right to its own limits."""
    compiled, _ = built("adjustable-pump")
    shown = verdicts_of(compiled.mechanism)
    ratio = shown["time_ratio_s15"].value
    sheet = compiled.value(places_of(compiled.plan)["time_ratio_s15"])
    assert ratio == pytest.approx(2.00873, abs=1e-5)  # the reference, Newton every 0.05 degrees
    assert ratio != sheet
    assert ratio == pytest.approx(sheet, rel=5e-3)
    assert shown["time_ratio_s15"].words


# --- summaries and the outputs that follow from them -----------------------------------------------------------------------

OF_SUMMARIES = """
[outputs]
arc = { formula = "a4*swing" }
[summary]
swing = { of = "theta14", take = "range" }
middle = { of = "theta14", take = "mean" }
"""


@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize(("symbol", "by"), [("swing", 0.05), ("middle", 0.05), ("arc", 1e-5), (None, 0)])
def test_a_wrong_summary_is_found(layout, symbol, by):
    """A number of the whole sweep, and what follows from it: that formula is held against the summaries shown."""
    text = template_text("four-bar").partition("[outputs]")[0] + OF_SUMMARIES
    compiled = Compiled(replace(loads(text), layout=layout))
    values = compile_book(book_of(compiled.layout)).evaluate({})
    if symbol is not None:
        values = Damaged(values, places_of(compiled.plan)[f"summary {symbol}"], by)
    found = against_search(book_of(compiled.layout), values, compiled.plan, "four-bar")
    assert found.agrees == (symbol is None), found
    assert symbol is None or found.where.endswith((f"({symbol})", "(arc)"))  # arc follows from what is shown of swing


# --- cams ------------------------------------------------------------------------------------------------------------------


@pytest.mark.cases(2)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("name", ["cam-flat", "cam-linkage", "cam-rocker", "cam-slide", "cam-valve"])
def test_a_cam_says_what_the_search_finds(name, layout):
    found = judged(name, layout)
    assert found.agrees, found


WRONG = [
    ("pressure_angle", 0.05), ("least_rho", 0.05), ("contact_force", 0.2), ("holding_spring", 0.02), ("velocity_leaps", 1),
    ("largest_velocity", 1), ("largest_acceleration", 500), ("largest_jerk", 1e6), ("acceleration_leaps", 1),
]  # fmt: skip
WRONG_PLACES = [("pressure_angle_at", 2), ("least_rho_at", 1), ("contact_force_at", 1), ("largest_velocity_at", 5)]


@pytest.mark.cases(6)
@pytest.mark.parametrize(
    ("key", "by", "layout"),
    [(*each, layout) for each in WRONG for layout in ("sheets", "page")] + [(*each, "sheets") for each in WRONG_PLACES],
)
def test_a_wrong_line_of_a_cam_is_found(key, by, layout):
    """A page has no cells of the places."""
    name = "cam-slide" if key.startswith("pressure_angle") else "cam-valve"
    found = judged(name, layout, damage=(key, by))
    assert not found.agrees
    assert f"({key})" in found.where


class Said:
    """Values, but the words beside a cell are others."""

    def __init__(self, values, spot, col, words):
        self.values, self.place, self.words, self.column = values, (spot.sheet, spot.row, col), words, values.column

    def get(self, *place):
        return self.words if place == self.place else self.values.get(*place)


@pytest.mark.cases(9)
@pytest.mark.parametrize(("layout", "col"), [("sheets", 4), ("page", 3)])
@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("pressure_angle", "pressure angle: more than usual, it may jam"),
        ("least_rho", "undercut: it cannot be made"),
        ("contact_force", "the follower lifts off at 69°: N = -1 N"),
        ("largest_velocity", "segment 3, modified sine: factor 1.7596"),
        ("largest_acceleration", "segment 1, modified trapezoid: factor 5.528"),
        ("velocity_leaps", "infinite acceleration: the velocity leaps at 80°"),
        ("acceleration_leaps", ""),
    ],
)  # fmt: skip
def test_wrong_words_of_a_cam_are_found(key, words, layout, col):
    compiled, _ = built("cam-valve", layout)
    values = Said(evaluated("cam-valve", layout, ()), places_of(compiled.plan)[key], col, words)
    found = against_search(book_of(compiled.layout), values, compiled.plan, "cam-valve")
    assert not found.agrees
    assert f"({key})" in found.where


@pytest.mark.cases(3)
@pytest.mark.parametrize("seed", range(60))
def test_random_cams_say_what_the_search_finds(seed):
    """All laws, leaps of the acceleration, knife edges, springs; on sheets, and on a page."""
    text = random_cams.cam(seed)
    mechanism = loads(random_cams.loaded(text) if seed % 2 else text)
    for layout in ("sheets", "page"):
        compiled = Compiled(replace(mechanism, layout=layout))
        found = against_search(book_of(compiled.layout), compiled.cells.values(), compiled.plan, "cam")
        assert found.agrees, (layout, found)
