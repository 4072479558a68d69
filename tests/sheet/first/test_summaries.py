"""Summaries over a sweep of which a part, or nothing, exists: no number that could be taken for a result."""

import math
from dataclasses import replace

import pytest
from laid import Laid

import mechsheet
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.nodes import CellRef, ErrorValue, RangeRef, transform
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text

NA = ErrorValue("#N/A")

SUMMARIES = """
[summary]
least = { of = "theta14", take = "min" }
most = { of = "mu", take = "max" }
swing = { of = "theta14", take = "range" }
middle = { of = "B.x", take = "mean" }
begin = { of = "B.y", take = "first" }
finish = { of = "B.y", take = "last" }
turned = { of = "theta12", take = "range" }
pin = { of = "A.x", take = "min" }
"""

FOUR_BAR = template_text("four-bar").partition("[summary]")[0] + SUMMARIES
NAMES = [line.partition(" =")[0] for line in SUMMARIES.splitlines() if "take" in line]


def cell(laid, name, col=1):
    """A cell of a summary's line: 1 the value, 3 where, 4 the words."""
    return laid.values.get(laid.plan.main, laid.plan.blocks["summary"].rows[name], col)


@pytest.mark.slow
def test_nothing_exists():
    """a1 = 500: the crank's pin still turns, but the coupler never reaches."""
    laid = Laid(FOUR_BAR).change(a1=500)
    for name in NAMES:
        assert cell(laid, name) == NA, name
        assert cell(laid, name, 3) in (NA, None), name
        assert cell(laid, name, 4).endswith(": 0 of 25 positions"), name
    for line in laid.plan.blocks["verdicts"].rows:
        if line.startswith(("swing", "stroke", "time_ratio", "transmission", "input_")):
            assert laid.spot(f"{line}") == NA, line


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("language", "words", "only", "several"),
    [
        ("en", "{} of 25 positions", " (rows only)", " (several stretches)"),
        ("tr", "{} / 25 konum", " (yalnız satırlar)", " (birkaç parça)"),
    ],
)
def test_a_part_exists(language, words, only, several):
    """a1 = 110 leaves a part of the rows: the numbers are those of these rows, and the words say so.

    Two stretches: an angle counts its turns anew after the gap, so that it has no range.
    """
    laid = Laid(FOUR_BAR, language).change(a1=110)
    there = int(laid.spot("rows_closed"))
    assert 0 < there < 25
    assert cell(laid, "swing") == NA
    assert cell(laid, "swing", 4).endswith(": " + words.format(there) + several)
    for name in sorted({*NAMES} - {"swing"}):
        said = cell(laid, name, 4).removesuffix(only)  # of an extreme that lies where the stretch ends
        assert said.endswith(": " + words.format(there)), name
        assert isinstance(cell(laid, name), float), name
    assert cell(laid, "pin") > -34  # the crank turns on, but where nothing assembles its pin does not count


WIPER = """
format = 1
mechanism.name = "wiper"
links.ground.points = { A0 = [0, 0], B0 = [220, 0], C0 = [720, 0] }
links.crank.points = { A0 = [0, 0], A = [45, 0] }
links.coupler.points = { A = [0, 0], B = [215, 0] }
links.wiper1.points = { B0 = [0, 0], B = [70, 0], P = { r = 60, angle = -13 } }
links.second.points = { P = [0, 0], Q = [500, 0] }
links.wiper2.points = { C0 = [0, 0], Q = [60, 0] }
driver = { link = "crank", start = 0, stop = 360, step = 5 }
assembly = { B = [220, 70], Q = [720, 60] }
summary = { one = { of = "theta14", take = "range" }, other = { of = "theta16", take = "range" } }
"""


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_an_angle_has_no_range_over_a_gap(layout):
    """Two wipers that a rod joins swing alike; one was said to swing by three times as much, its turns counted anew."""
    whole, parts = (
        compiled_of(loads(WIPER.replace("45, 0", crank), overrides=Overrides(layout=layout)))
        for crank in ("45, 0", "80, 0")
    )
    for name in ("one", "other"):
        assert 60 < whole.number(whole.plan.places.summaries[name]) < 100
        assert parts.value(parts.plan.places.summaries[name]) == NA


@pytest.mark.slow
def test_the_whole_sweep_is_not_mentioned():
    laid = Laid(FOUR_BAR)
    assert cell(laid, "swing", 4) == "range of θ₁₄"
    assert cell(laid, "turned") == 360
    assert cell(laid, "finish") == pytest.approx(cell(laid, "begin"), abs=1e-9)


@pytest.mark.slow
def test_smallest_swing_is_of_a_linkage_that_assembles():
    """Who looks for the ground link with the smallest swing by typing in one after the other finds one that turns."""
    laid = Laid(FOUR_BAR)
    swings = {a1: cell(laid.change(a1=a1), "swing") for a1 in (66, 70, 74, 200, 500)}
    assert {a1 for a1, swing in swings.items() if swing == NA} == {200, 500}
    assert min((swing, a1) for a1, swing in swings.items() if swing != NA)[1] in (66, 70, 74)


@pytest.mark.slow
def test_pole_in_the_first_row():
    """The first value of an output that has none there is no number, not an empty text."""
    text = FOUR_BAR.replace("[summary]", '[summary]\nstart = { of = "pole", take = "first" }')
    text = text.replace("[outputs]", '[outputs]\npole = { formula = "1/sin(theta12)" }')
    laid = Laid(text)
    assert laid.column("pole")[0] == ErrorValue("#DIV/0!")
    assert cell(laid, "start") == NA


@pytest.mark.slow
@pytest.mark.parametrize("start", [0, 120, 170])
def test_position_shown_starts_at_a_row_that_exists(start):
    """Whoever opens the workbook sees the mechanism, not an empty drawing, also where the first rows do not exist."""
    text = FOUR_BAR.replace("value = 70,", "value = 110,").replace("start = 0", f"start = {start}")
    laid = Laid(text)
    shown = laid.spot("position")
    assert shown == laid.exists.index(True)
    assert isinstance(laid.values.get(laid.plan.main, laid.plan.blocks["variables"].rows["theta14"], 1), float)


@pytest.mark.slow
def test_an_extreme_says_where_it_is_and_other_summaries_do_not():
    """The crank's pin is farthest to the left at 180 degrees; a range and a mean have no place."""
    laid = Laid(FOUR_BAR)
    assert cell(laid, "pin") == pytest.approx(-35)
    assert cell(laid, "pin", 3) == pytest.approx(180, abs=1e-6)
    assert cell(laid, "most", 3) == pytest.approx(180, abs=1e-3)  # the diagonal is longest
    assert [cell(laid, name, 3) for name in ("swing", "middle", "turned")] == [None] * 3


@pytest.mark.slow
def test_an_output_of_summaries_reads_an_angle_as_radians():
    """Half of what the rocker swings, and the sine of that: both from a summary that is shown in degrees."""
    outputs = (
        '[outputs]\nhalf = { formula = "swing/2", unit = "deg" }\nrise = { formula = "sin(swing/2)", unit = "1" }\n'
    )
    laid = Laid(FOUR_BAR.replace("[outputs]\n", outputs))
    swing = cell(laid, "swing")
    assert cell(laid, "half") == pytest.approx(swing / 2)
    assert cell(laid, "rise") == pytest.approx(math.sin(math.radians(swing / 2)))


@pytest.mark.slow
def test_of_a_task_without_a_solution_no_summary_says_an_error():
    """No margin says where rows end there; nothing closes, so there is no row to count from."""
    laid = Laid(template_text("quick-return-lever")).change(time_ratio=0.99)
    assert laid.spot("rows_closed") == 0
    assert cell(laid, "stroke", 4) == f"stroke: 0 of {laid.plan.rows} positions"


DEAD_CENTRE = """
format = 1
[mechanism]
name = "dead-centre"
[dimensions]
a1 = 100
a2 = 60
a3 = 40
a4 = 50
[links]
ground.points = { A0 = [0, 0], B0 = ["a1", 0] }
crank.points = { A0 = [0, 0], A = ["a2", 0] }
coupler.points = { A = [0, 0], B = ["a3", 0] }
rocker.points = { B0 = [0, 0], B = ["a4", 0] }
[driver]
link = "crank"
start = 0
stop = "acos((60^2 + 100^2 - 90^2)/(2*60*100))"
step = "acos((60^2 + 100^2 - 90^2)/(2*60*100))/8"
speed = "30 rpm"
[assembly]
B = [80, 40]
[summary]
fastest = { of = "omega14", take = "max" }
least = { of = "theta14", take = "min" }
"""


@pytest.mark.slow
def test_a_dead_centre_in_the_last_row_is_why_a_velocity_has_no_largest_value():
    """The sweep ends exactly where coupler and rocker are in line: no velocity there, so none is known to be the largest."""
    laid = Laid(DEAD_CENTRE)
    assert cell(laid, "fastest") == NA
    assert cell(laid, "fastest", 4).endswith(" (some row has no value)")
    assert isinstance(cell(laid, "least"), float)


@pytest.mark.slow
def test_check_agrees_with_it(tmp_path):
    mechanism = mechsheet.loads(DEAD_CENTRE, "mine")
    (book,) = mechanism.build(tmp_path / "mine.xlsx")
    assert mechsheet.check(book).agrees


@pytest.mark.slow
@pytest.mark.parametrize(("layout", "words"), [("page", 3), ("sheets", 4)])
def test_a_mean_says_why_it_is_not_there(layout, words):
    """A row that is inserted above the first of a table moves the ranges that begin there, not those of the rows before."""
    compiled = compiled_of(loads(FOUR_BAR, overrides=Overrides(layout=layout)))
    plan, workbook = compiled.plan, compiled.layout
    first = plan.at.first

    def moved(part):
        match part:
            case RangeRef(CellRef(row=row, sheet=sheet) as start, end) if row == first and sheet in (None, plan.table):
                return RangeRef(replace(start, row=row + 1), end)
        return part

    def says(sheets):
        values = evaluate(book_of(replace(workbook, sheets=sheets)))
        row = plan.blocks["summary"].rows["middle"]
        return [values.get(plan.main, row, col) for col in (1, words)]

    def torn_sheet(sheet):
        if sheet.title not in (plan.main, plan.at.titles["extremes"]):
            return sheet
        return replace(
            sheet, fills=tuple(replace(fill, formula=transform(fill.formula, moved)) for fill in sheet.fills)
        )

    torn = "; no mean: rows were inserted beside the first or the last"
    why = says(tuple(torn_sheet(sheet) for sheet in workbook.sheets))
    assert why[0] == NA
    assert why[1].endswith(torn)
    number, said = says(workbook.sheets)
    assert isinstance(number, float)
    assert torn not in said
