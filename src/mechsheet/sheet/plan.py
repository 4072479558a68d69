"""The plan of a workbook: every row of the first sheet and every column of the table, before any cell is written.

Everything that is read by a formula gets its address here; the writers of the sheets only fill in.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from mechsheet.formula.names import folded, safe_name
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.solve import dimension_order, dimension_values, driver_values, largest_length
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Dimension, Mechanism
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.findings import findings
from mechsheet.sheet.language import Language, words
from mechsheet.sheet.lowering import Assignment, Assignments, lowered
from mechsheet.sheet.workbook import Name

SYMBOL, VALUE, UNIT, TOLERANCE, MEANING = range(5)
"""Columns of the blocks on the first sheet."""

HEADING_ROWS = 3
"""Rows over the table: group, symbol with unit, formula as text."""

FOOTER_TITLE = 100
"""Characters of the title in the footer, which holds 255 in all."""

NUMBER, DRIVER, STATUS, EXISTS = range(4)
"""First columns of the table: row number, driver as shown, status word, 1 where the position exists."""


@dataclass(frozen=True, slots=True)
class Block:
    """A block of the first sheet: its heading's row and the rows of its entries by symbol (or key)."""

    key: str
    row: int
    rows: dict[str, int]


@dataclass(frozen=True, slots=True)
class TableColumn:
    """One column of the table.

    kind   "number", "driver", "status", "exists" for the fixed ones; "equation" (internal units), "shown" (the same in
           degrees), "blank" (value or nothing: what summaries read, since MAX must not meet #N/A), "rounded" (the same to
           twelve digits: of two equal peaks, MATCH must find the same in every program)
    inner  folded away with the intermediate columns
    """

    col: int
    symbol: str
    kind: Literal["number", "driver", "status", "exists", "equation", "shown", "blank", "rounded"]
    group: int
    inner: bool
    equation: Assignment | None = None


@dataclass
class Plan:
    """Addresses of everything; see `Addresses` for `at`.

    window  cells with the middle ("x", "y") and half the side ("half") of the drawing's window, once it is drawn
    ways    by link and point, the cells of the way from the link's base point to it, once the checks are laid out
    proven  by sheet, where fills begin (row, column) that need no copy on the sheet "Recomputed": geometry proves them
    """

    mechanism: Mechanism
    equations: Assignments
    language: Language
    at: Addresses
    rows: int
    driver: list[float]
    blocks: dict[str, Block] = field(default_factory=dict)
    columns: list[TableColumn] = field(default_factory=list)
    names: list[Name] = field(default_factory=list)
    next_row: int = 0
    window: dict[str, Spot] = field(default_factory=dict)
    ways: dict[tuple[str, str], tuple[Spot, Spot]] = field(default_factory=dict)
    proven: dict[str, set[tuple[int, int]]] = field(default_factory=dict)

    @cached_property
    def size(self) -> float:
        """The largest length, as the description has it; 1 where there is none."""
        return largest_length(self.mechanism, dimension_values(self.mechanism)) or 1.0

    @cached_property
    def nominal(self) -> dict[str, Array]:
        """Every symbol's values over the rows with the dimensions and modes as described, NaN where there is none."""
        return sweep(self.mechanism, self.equations.equations, np.array(self.driver))

    @cached_property
    def first_existing(self) -> int:
        """The number of the first row that has a position, with the dimensions as described; 0 where none has."""
        there = np.ones(self.rows, dtype=bool)
        for group in self.equations.equations.groups:
            there &= np.isfinite(self.nominal[group.closes])
        return int(np.argmax(there))

    @cached_property
    def reads(self) -> dict[str, tuple[str, ...]]:
        """What each column reads of its row."""
        return {equation.symbol: equation.reads for equation in self.equations.columns}

    @property
    def footer(self) -> str:
        """What stands below every printed page: title, sheet, page; an ampersand is a mark there."""
        title = self.mechanism.title.of(self.language).replace("&", "&&")
        return self.text("footer", title=title[:FOOTER_TITLE], made=self.text("made"))

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook in its language."""
        return words(self.language, key, **parts)

    @property
    def main(self) -> str:
        """Title of the first sheet."""
        return self.at.titles["mechanism"]

    @property
    def table(self) -> str:
        """Title of the sheet with the positions."""
        return self.at.titles["positions"]


def plan_of(mechanism: Mechanism, equations: Equations) -> Plan:
    """The plan of a mechanism's workbook."""
    language = mechanism.language
    titles = {
        key: words(language, f"sheet.{key}")
        for key in ("mechanism", "positions", "drawing", "checks", "notes", "recomputed", "description")
    }
    values = driver_values(mechanism, dimension_values(mechanism))
    rows = len(values)
    at = Addresses(mechanism.references, titles, HEADING_ROWS, HEADING_ROWS + rows - 1)
    plan = Plan(mechanism, lowered(mechanism, equations), language, at, rows, [float(value) for value in values])
    _plan_names_and_blocks(plan)
    _plan_columns(plan)
    return plan


def _plan_names_and_blocks(plan: Plan) -> None:
    mechanism = plan.mechanism
    order = {symbol: index for index, symbol in enumerate(dimension_order(mechanism))}
    inputs = [dim for dim in mechanism.dimensions if not dim.derived]
    derived = sorted((dim for dim in mechanism.dimensions if dim.derived), key=lambda dim: order[dim.symbol])
    taken = {folded(dim.cell) for dim in mechanism.dimensions if dim.cell}
    taken |= {folded(summary.cell) for summary in mechanism.summaries if summary.cell}
    plan.next_row = 3
    _block(plan, "position", ["position", mechanism.driver.symbol, "status"])
    _block(plan, "dimensions", [dim.symbol for dim in inputs])
    if not mechanism.driver.values:
        _block(plan, "sweep", ["start", "step", "stop"])
    modes = [group.mode for group in plan.equations.groups if group.mode]
    if modes:
        _block(plan, "assembly", modes)
    variables = [eq.symbol for eq in plan.equations.columns if eq.role in ("variable", "output")]
    _block(plan, "variables", [symbol for symbol in variables if symbol != mechanism.driver.symbol])
    if mechanism.summaries:
        _block(plan, "summary", [summary.symbol for summary in mechanism.summaries])
    _block(plan, "stands", findings(mechanism, plan.equations).entries)
    _block(plan, "derived", [dim.symbol for dim in derived] + [eq.symbol for eq in plan.equations.constants])
    for dim in mechanism.dimensions:
        _place_dimension(plan, dim, taken)
    for equation in plan.equations.constants:
        row = plan.blocks["derived"].rows[equation.symbol]
        _spot(
            plan,
            equation.symbol,
            row,
            mechanism.shown(equation.unit).in_degrees,
            safe_name(equation.symbol, taken),
            taken,
        )
    for mode in modes:
        _spot(plan, mode, plan.blocks["assembly"].rows[mode], False, safe_name(mode, taken), taken)
    for key in ("start", "step"):
        if "sweep" in plan.blocks:
            name = safe_name(plan.text(f"name.{key}"), taken)
            degrees = mechanism.driver.unit.in_degrees
            _spot(plan, f"#{key}", plan.blocks["sweep"].rows[key], degrees, name, taken)
    for summary in mechanism.summaries:
        row = plan.blocks["summary"].rows[summary.symbol]
        name = summary.cell or safe_name(summary.symbol, taken)
        _spot(plan, f"#summary {summary.symbol}", row, False, name, taken)
    name = safe_name(plan.text("name.position"), taken)
    _spot(plan, "#position", plan.blocks["position"].rows["position"], False, name, taken)


def _place_dimension(plan: Plan, dim: Dimension, taken: set[str]) -> None:
    block = plan.blocks["derived" if dim.derived else "dimensions"]
    name = dim.cell or safe_name(dim.symbol, taken)
    _spot(plan, dim.symbol, block.rows[dim.symbol], dim.unit.in_degrees, name, taken)


def _spot(plan: Plan, symbol: str, row: int, degrees: bool, name: str, taken: set[str]) -> None:
    taken.add(folded(name))
    spot = Spot(plan.main, row, VALUE, degrees=degrees, name=name)
    plan.at.spots[symbol] = spot
    plan.at.shown[symbol] = spot
    plan.names.append(Name(name, plan.main, row, VALUE))


def _block(plan: Plan, key: str, entries: list[str]) -> Block:
    """Reserve rows for a block: a heading, its entries, one empty row."""
    first = plan.next_row + 1
    block = Block(key, plan.next_row, {entry: first + index for index, entry in enumerate(entries)})
    plan.blocks[key] = block
    plan.next_row = first + len(entries) + 1
    return block


def _plan_columns(plan: Plan) -> None:
    mechanism, equations = plan.mechanism, plan.equations
    symbol = mechanism.driver.symbol
    columns = plan.columns
    columns += [
        TableColumn(NUMBER, "#number", "number", 0, False),
        TableColumn(DRIVER, symbol, "driver", 0, False),
        TableColumn(STATUS, "#status", "status", 0, False),
        TableColumn(EXISTS, "#exists", "exists", 0, True),
    ]
    for column in columns:
        plan.at.spots[column.symbol] = _table_spot(plan, column.col, mechanism.driver.unit.in_degrees)
    plan.at.spots["#number"] = _table_spot(plan, NUMBER, False)
    plan.at.spots["#exists"] = _table_spot(plan, EXISTS, False)
    plan.at.shown |= {column.symbol: plan.at.spots[column.symbol] for column in columns}
    if mechanism.driver.unit.in_degrees:
        _add_column(plan, symbol, "equation", 0, inner=True, equation=None)
        plan.at.shown[symbol] = _table_spot(plan, DRIVER, True)
    for equation in equations.columns:
        _plan_equation(plan, equation)
    for of in dict.fromkeys(summary.of for summary in mechanism.summaries):
        _add_column(plan, of, "blank", -1, inner=True, equation=None)
    placed = (summary.of for summary in mechanism.summaries if summary.take in ("max", "min"))
    for of in dict.fromkeys([*placed, *findings(mechanism, equations).extremes]):
        _add_column(plan, of, "rounded", -1, inner=True, equation=None)


def _plan_equation(plan: Plan, equation: Assignment) -> None:
    """One column, or two: what formulas read (folded away), and what people read (degrees; #N/A where nothing exists)."""
    if equation.role == "output":
        col = _add_column(plan, equation.symbol, "equation", -1, False, equation)
        spot = _table_spot(plan, col, equation.unit.in_degrees)
        plan.at.spots[equation.symbol] = plan.at.shown[equation.symbol] = spot
        return
    inner = equation.role == "intermediate"
    degrees = plan.mechanism.shown(equation.unit).in_degrees
    if not inner and (degrees or needs_guard(plan, equation.symbol)):
        _add_column(plan, equation.symbol, "equation", equation.group, True, equation)
        col = _add_column(plan, equation.symbol, "shown", equation.group, False, equation)
        plan.at.shown[equation.symbol] = _table_spot(plan, col, degrees)
        return
    _add_column(plan, equation.symbol, "equation", equation.group, inner, equation)


def needs_guard(plan: Plan, symbol: str) -> bool:
    """True for a quantity that stays a number where some group cannot be closed: the crank's pin, another branch's points.

    A row that does not exist must show no number at all, so such a column is shown through IF(exists, ...).
    """
    missing, reads = {group.closes for group in plan.equations.groups}, plan.reads
    stack, seen = [symbol], {symbol}
    while stack:
        for name in reads.get(stack.pop(), ()):
            if name not in seen:
                seen.add(name)
                stack.append(name)
    return not missing <= seen


def _add_column(
    plan: Plan,
    symbol: str,
    kind: Literal["equation", "shown", "blank", "rounded"],
    group: int,
    inner: bool,
    equation: Assignment | None,
) -> int:
    col = len(plan.columns)
    plan.columns.append(TableColumn(col, symbol, kind, group, inner, equation))
    if kind == "equation":
        spot = _table_spot(plan, col, False)
        plan.at.spots[symbol] = spot
        plan.at.shown[symbol] = spot
    elif kind in ("blank", "rounded"):
        plan.at.shown[f"#{kind} {symbol}"] = _table_spot(plan, col, False)
    return col


def _table_spot(plan: Plan, col: int, degrees: bool) -> Spot:
    return Spot(plan.table, plan.at.first, col, column=True, degrees=degrees)
