"""How large a workbook is, for a person who has to read it: formulas, columns, lengths; and what each may come to.

Counted on the workbook as it is laid out. `benchmarks/bench_budgets.py` prints the table of all templates,
`test_budgets.py` holds columns and lengths.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

from folders import ROOT
from livesheet.formula.nodes import Call, Node, children
from livesheet.formula.printer import print_formula
from livesheet.workbook import Fill, Sheet
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan

PAGES = sorted(path.stem.removesuffix("-page") for path in (ROOT / "generated").glob("*-page.xlsx"))
"""Templates that are generated in both layouts."""

FOUR_BAR_COLUMNS = {"sheets": 19, "page": 15}
ALL = 213_500
"""Formulas of all templates together, as they are described."""

PLAIN = [
    *(
        "adjustable-pump",
        "chebyshev",
        "cylinder-boom",
        "drag-link",
        "elliptic-trammel",
        "fivelink",
        "four-bar",
        "hoeken",
    ),
    *("inverted-slider-crank", "jansen", "klann", "oldham", "pantograph", "parallelogram", "peaucellier", "roberts"),
    *("scissor-lift", "scotch-yoke", "six-bar-r-rrr-rrt", "six-link-dwell", "slider-crank", "slotted-lever"),
    *("stephenson-i", "stephenson-iii", "toggle-press", "watt-i", "watt-ii", "watt-straight-line", "whitworth"),
]
PLAIN_TOGETHER = 130_000
"""Formulas of the templates that need nothing but positions (some have velocities by now): they had 409,100 when every
table was computed twice."""

A_PASS = 10
"""Columns of a pass of Newton's method for each unknown."""
IN_TABLE = {("sheets", "names"): 120, ("sheets", "anchors"): 180, ("page", "anchors"): 160}
"""Characters of the longest formula of the table; an anchor names its sheet: Mechanism!$B$12."""

TABLES = 250
"""Characters of the longest formula of any table that a person reads row by row, and of the two-way tables."""

ANYWHERE = 400
"""Characters of any formula, as people see it, in both formats: what would be longer has a cell of its own for a part."""

LAW_OF_A_LOAD = ("engine",)
"""Templates whose description has a load of several lines: where names are not written its formulas are as long as it is."""


@dataclass(frozen=True)
class Size:
    """Of one workbook.

    cells       formulas of all sheets
    two_way     those of two-way tables
    table       those of the table of positions
    iterations  those of the sheet of Newton's method, which the other numbers leave out
    rates       those of the sheet of velocities and accelerations
    forces      those of the sheet of forces
    tolerance   those of the sheet of tolerances
    columns     columns of that table
    longest     characters of its longest formula; outputs, which are as long as the description has them, left out
    elsewhere   characters of the longest formula of the other sheets, and on a page beside the table; no two-way tables, and
                no virtual work, which has a term for every load
    ifs         how deep IF stands in IF in the table
    """

    cells: int
    two_way: int
    table: int
    rates: int
    iterations: int
    forces: int
    tolerance: int
    columns: int
    longest: int
    elsewhere: int
    ifs: int


def compiled(name: str, layout: str = "sheets", references: str = "") -> Compiled:
    """A template in a layout, its references as it has them (on a page: anchors) or as given."""
    own = "anchors" if layout == "page" else _described(name).references
    return _compiled(name, layout, references or own)


def many_rows(rows: int, references: str = "names") -> Mechanism:
    """The four-bar over a turn in so many rows."""
    text = template_text("four-bar")
    step = f"step = {360 / (rows - 1)!r}"
    described = loads("\n".join(step if line.startswith("step") else line for line in text.splitlines()))
    return replace(described, references=references)


@cache
def _described(name: str) -> Mechanism:
    return load(ROOT / f"templates/{name}.toml")


@cache
def _compiled(name: str, layout: str, references: str) -> Compiled:
    return Compiled(replace(_described(name), layout=layout, references=references))


@cache
def size_of(found: Compiled) -> Size:
    """The sizes of a workbook. An output of the description is as long as its expression there."""
    plan, sheets = found.plan, found.layout.sheets
    iterations = [sheet for sheet in sheets if sheet.title == plan.at.titles.get("iterations")]
    sheets = tuple(sheet for sheet in sheets if sheet not in iterations)
    outputs = {plan.at.spots[output.symbol].col for output in plan.mechanism.outputs}
    two_way = [sheet for sheet in sheets if sheet.title.startswith(plan.text("sheet.table"))]
    fills = [(sheet, fill) for sheet in sheets if sheet not in two_way for fill in sheet.fills]
    table = [fill for sheet, fill in fills if _in_table(plan, sheet, fill)]
    work = {(plan.at.spots[symbol].sheet, plan.at.spots[symbol].col) for symbol in found.equations.efforts[1:]}
    others = [fill for sheet, fill in fills if not _in_table(plan, sheet, fill) and (sheet.title, fill.col) not in work]
    return Size(
        cells=sum(map(cells, sheets)),
        two_way=sum(map(cells, two_way)),
        table=sum(fill.rows * fill.cols for fill in table),
        rates=sum(cells(sheet) for sheet in sheets if sheet.title == plan.at.titles.get("rates")),
        iterations=sum(map(cells, iterations)),
        forces=sum(cells(sheet) for sheet in sheets if sheet.title == plan.at.titles.get("forces")),
        tolerance=sum(cells(sheet) for sheet in sheets if sheet.title == plan.at.titles.get("tolerance")),
        columns=len(plan.columns),
        longest=max(length(fill) for fill in table if fill.col not in outputs),
        elsewhere=max(map(length, others)),
        ifs=max(_nested_ifs(fill.formula) for fill in table if fill.col not in outputs),
    )


def longest_of_tables(found: Compiled) -> int:
    """Of positions, rates, forces, tolerances and two-way tables; outputs, as long as they are described, left out."""
    plan = found.plan
    titles = {plan.at.titles[key] for key in ("rates", "forces", "tolerance") if key in plan.at.titles} - {plan.table}
    outputs = {plan.at.spots[output.symbol].col for output in plan.mechanism.outputs}
    lengths = [
        length(fill)
        for sheet in found.layout.sheets
        for fill in sheet.fills
        if sheet.title in titles
        or sheet.title.startswith(plan.text("sheet.table"))
        or (_in_table(plan, sheet, fill) and fill.col not in outputs)
    ]
    return max(lengths)


def cells(sheet: Sheet) -> int:
    """Formula cells of a sheet."""
    return sum(fill.rows * fill.cols for fill in sheet.fills)


def length(fill: Fill) -> int:
    """Characters of a formula as Excel shows it."""
    return len(print_formula(fill.formula, "excel"))


def _in_table(plan: Plan, sheet: Sheet, fill: Fill) -> bool:
    rows = range(plan.at.first, plan.at.last + 1)
    return sheet.title == plan.table and fill.row in rows and fill.col <= max(column.col for column in plan.columns)


def _nested_ifs(node: Node) -> int:
    below = max(map(_nested_ifs, children(node)), default=0)
    return below + (isinstance(node, Call) and node.name == "IF")
