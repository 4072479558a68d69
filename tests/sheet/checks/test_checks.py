"""Checks: rounding only on every template, blank where there is no position, and damage of any column is seen."""

from dataclasses import replace

import pytest
from laid import Laid
from placed import places_of

from chosen import some
from folders import ROOT, TEMPLATE_NAMES
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.nodes import Binary, Call, Number, RangeRef, transform
from livesheet.workbook import Cell
from mechsheet.description.templates import template_text
from mechsheet.sheet.checks.checks import Checks

pytestmark = pytest.mark.slow

CLOSED = {"en": "largest gap of a joint: rounding only", "tr": "en büyük mafsal açıklığı: yalnız yuvarlama"}
OPEN = "a joint is open: see the hidden sheet Checks"


def columns(laid, kind):
    """What the columns of a kind hold, row by row."""
    checks = Checks(laid.plan)
    cols = [2 + index for index, check in enumerate(checks.columns) if check.kind == kind]
    rows = range(checks.first, checks.last + 1)
    return [[laid.values.get(checks.title, row, col) for row in rows] for col in cols]


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", some(TEMPLATE_NAMES, 2))
def test_rounding_only(name):
    """Gaps are rounding errors, nothing leaps, no cell has been typed over, and every row has been measured."""
    laid = Laid(template_text(name))
    lengths = [abs(dim.value) for dim in laid.mechanism.dimensions if dim.shown is not None]
    assert 0 <= laid.spot("largest_gap") < 1e-9 * max(lengths)
    assert laid.words("largest_gap") == CLOSED[laid.mechanism.language]
    assert (laid.spot("leaps"), laid.spot("typed")) == (0, 0)
    gaps = columns(laid, "gap")
    assert gaps and all(isinstance(cell, float) for gap in gaps for cell in gap)


def places(laid):
    """By kind, where the columns have their worst values."""
    checks = Checks(laid.plan)
    return [
        (check.kind, laid.values.get(checks.title, checks.at_row, 2 + at)) for at, check in enumerate(checks.columns)
    ]


@pytest.mark.parametrize("name", ["four-bar-forces", "stephenson-iii-output"])
def test_of_rounding_no_place_is_said(name):
    """Where it is largest differs from program to program."""
    laid = Laid(template_text(name))
    small = ("gap", "velocity", "acceleration", "torque", "residual")
    found = places(laid)
    assert {kind for kind, _ in found} >= {"gap", "velocity", "acceleration"}
    assert all(place == "" for kind, place in found if kind in small)
    assert all(isinstance(place, float) for kind, place in found if kind in ("effort", "force", "det"))
    laid.damage(laid.plan.table, laid.plan.at.spots["B.x"].col, lambda node: Binary("+", node, Number(1.0)))
    assert any(isinstance(place, float) for kind, place in places(laid) if kind == "gap")


def test_of_gaps_the_largest_is_shown_and_leaps_are_counted():
    """Gaps added up, or the largest of 0 and 1 for two leaps, would be other numbers on the first sheet."""
    checks = Checks(Laid(template_text("watt-ii")).plan)
    found = {kind: [check.kind for check in checks.columns].count(kind) for kind in ("gap", "leap")}
    assert found == {"gap": 3, "leap": 1}
    for kind, name in (("gap", "MAX"), ("leap", "SUM")):
        worst = checks.worst(kind)
        cells = sum(each.end.col - each.start.col + 1 if isinstance(each, RangeRef) else 1 for each in worst.args)
        assert (worst.name, cells) == (name, found[kind])


def test_rows_without_a_position_are_blank():
    laid = Laid(template_text("four-bar")).change(a1=110)
    assert 0 < sum(laid.exists) < laid.plan.rows
    cells = zip(*columns(laid, "gap"), strict=True)
    for there, row in zip(laid.exists, cells, strict=True):
        assert there == all(isinstance(cell, float) for cell in row)
        assert there or "" in row
    assert laid.words("largest_gap") == CLOSED["en"]


def test_nothing_is_said_of_gaps_where_nothing_closes():
    laid = Laid(template_text("four-bar")).change(a1=500)
    assert laid.words("largest_gap") == ""
    assert laid.verdict.startswith(
        "closes in no position: these links cannot be joined; A0ABB0: cannot be closed; enough: a₁"
    )


def swapped(node):
    """ATAN2 with its arguments the wrong way round."""
    return transform(
        node, lambda part: Call("ATAN2", part.args[::-1]) if getattr(part, "name", "") == "ATAN2" else part
    )


def doubled(node):
    return Binary("*", node, Number(1.001))


FOUR_BAR = (ROOT / "tests/data/four-bar.toml").read_text(encoding="utf-8")
"""Its coupler point is given by distances: the angle there is the equations' own."""

DAMAGE = {
    "ATAN2 swapped": ("phi", swapped),
    "angle in a triangle": ("mu_1", doubled),
    "angle of a link": ("theta13", doubled),
    "pin": ("B.x", doubled),
    "coupler point": ("C.y", doubled),
    "crank pin": ("A.x", doubled),
    "fixed point": ("B0.x", doubled),
    "constant angle": ("gamma3", doubled),
    "limit": ("k", lambda node: Call("MAX", (Number(0.0), node))),  # clipped instead of #N/A
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_damage_is_seen(kind):
    """The lengths between the points are no longer those of the description: the line and the title say so."""
    symbol, change = DAMAGE[kind]
    laid = Laid(FOUR_BAR, overrides={"a1": "100"} if kind == "limit" else None)
    spot = places_of(laid.plan)[symbol]
    assert laid.words("largest_gap") == CLOSED["en"]
    own = [fill for fill in laid.workbook.sheet(spot.sheet).fills if fill.col == spot.col]
    hit = [fill.formula for fill in own if spot.column or fill.row == spot.row]
    assert hit
    laid.damage(spot.sheet, spot.col, lambda node: change(node) if any(node is one for one in hit) else node)
    assert laid.words("largest_gap") == OPEN
    assert laid.verdict == OPEN


@pytest.mark.parametrize("symbol", ["theta13", "C.x", "number", "mu"])
def test_numbers_typed_over_formulas_are_counted(symbol):
    """One number in the last row of a column, also where it moves no point."""
    laid = Laid(FOUR_BAR)
    spot = places_of(laid.plan)[symbol]
    last = laid.plan.at.last
    sheets = []
    for sheet in laid.workbook.sheets:
        if sheet.title == spot.sheet:
            fills = [replace(fill, rows=fill.rows - 1) if (fill.col, fill.row + fill.rows - 1) == (spot.col, last) else fill
                     for fill in sheet.fills]  # fmt: skip
            typed = Cell(last, spot.col, laid.column(symbol)[-1])
            sheet = replace(sheet, fills=tuple(fills), cells=(*sheet.cells, typed))
        sheets.append(sheet)
    laid.values = evaluate(book_of(replace(laid.workbook, sheets=tuple(sheets))))
    assert laid.spot("typed") == 1
    assert laid.words("largest_gap") == laid.verdict == "a formula was typed over: see the hidden sheet Checks"


LEVER = """
format = 1
[mechanism]
name = "lever"
[dimensions]
a1 = 50
a2 = 50
b3 = 120
[links.ground]
points = { A0 = [0, 0], B0 = ["-a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.lever]
points = { B0 = [0, 0], C = ["b3", 0] }
[[joints]]
type = "pin-slot"
point = "A"
on = "lever"
through = "B0"
symbol = "s3"
[driver]
link = "crank"
start = 2
stop = 362
step = 5
[assembly]
C = [70, 0]
"""


def test_leap_where_a_slot_passes_its_pivot():
    """The crank's pin runs through the lever's pivot at 180 degrees: the lever turns round from one row to the next."""
    laid = Laid(LEVER)
    assert laid.spot("leaps") == 1
    (flags,) = columns(laid, "leap")
    (row,) = [row for row, flag in enumerate(flags) if flag == 1]
    assert 2 + 5 * (row - 1) < 180 < 2 + 5 * row
    assert laid.words("leaps") == laid.plan.text("verdict.leaps.some")
    assert Laid(LEVER.replace("a1 = 50", "a1 = 60")).spot("leaps") == 0
