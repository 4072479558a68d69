"""Two books side by side, whatever their formats spell differently: formulas as trees, and twins altogether."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

from livesheet.formats import FORMATS, read
from livesheet.formula.book import Block, Book, BookSheet, CellStore
from livesheet.formula.nodes import (
    ArrayLiteral,
    Binary,
    Call,
    CellRef,
    NameRef,
    Node,
    Number,
    RangeRef,
    Scalar,
    Unary,
    children,
    shifted,
    transform,
)
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_address
from livesheet.said import say
from mechsheet.checking.cells_apart import column_scale, difference
from mechsheet.checking.comparison import Comparison, Tally
from mechsheet.checking.inputs import description_in
from mechsheet.checking.report import Report

DIGITS = 1e-12
"""Numbers in formulas that differ by less, relatively, are one number in two spellings."""


def neutral(node: Node, title: str) -> Node:
    """The formula without what only spelling decides: capital letters of names, a sheet's own name before a reference."""

    def change(part: Node) -> Node:
        match part:
            case CellRef(sheet=str(sheet)):
                return replace(part, sheet=None if sheet.casefold() == title.casefold() else sheet.casefold())
            case RangeRef(CellRef() as start, CellRef() as end) if replace(end, sheet=start.sheet) == start:
                return start  # gnumeric writes a range of one cell as the cell
            case RangeRef(start, end) if end.sheet is None and start.sheet is not None:
                return RangeRef(start, replace(end, sheet=start.sheet))
            case NameRef(name, sheet):
                return NameRef(name.casefold(), sheet and sheet.casefold())
            case Call(name, args):
                return Call(name.upper(), args)
        return part

    return transform(node, change)


def alike(one: Node | None, other: Node | None) -> bool:
    """Whether two trees are equal, their numbers but for the digits that programs write (LibreOffice 13 in a formula)."""
    pairs = [(one, other)]
    while pairs:
        left, right = pairs.pop()
        if left == right:
            continue
        if left is None or right is None or type(left) is not type(right):
            return False
        if isinstance(left, Number) and isinstance(right, Number):
            if not math.isclose(left.value, right.value, rel_tol=DIGITS):
                return False
            continue
        below = children(left), children(right)
        if not below[0] or len(below[0]) != len(below[1]) or not _same_head(left, right):
            return False
        pairs += zip(*below, strict=True)
    return True


def _same_head(left: Node, right: Node) -> bool:
    """Operator, function or shape, whatever stands below."""
    match left, right:
        case (Unary(op), Unary(other)) | (Binary(op), Binary(other)) | (Call(op), Call(other)):
            return op == other
        case (ArrayLiteral(rows), ArrayLiteral(others)):
            return [len(row) for row in rows] == [len(row) for row in others]
    return type(left) is type(right)


class Formulas:
    """The formulas of a sheet, found by column and row."""

    def __init__(self, sheet: BookSheet | None) -> None:
        self.columns = {} if sheet is None else _by_column(sheet.blocks)

    def block(self, row: int, col: int) -> Block | None:
        """The block that a cell belongs to."""
        column: Sequence[Block] = self.columns.get(col, ())
        index = bisect_right(column, row, key=lambda block: block.row) - 1
        if index < 0 or row >= column[index].row + column[index].rows:
            return None
        return column[index]

    def at(self, row: int, col: int) -> Node | None:
        """The formula of a cell, as seen from there; None where there is none."""
        block = self.block(row, col)
        return None if block is None else formula_of(block, row, col)


def formula_of(block: Block, row: int, col: int) -> Node:
    """A block's formula as one of its cells has it."""
    return shifted(block.formula, row - block.row, col - block.col)


def stretches(ours: Formulas, theirs: Formulas) -> Iterator[tuple[int, int, int]]:
    """(column, first row, row after the last) of cells in which neither side begins another formula."""
    for col in sorted(ours.columns.keys() | theirs.columns.keys()):
        sides = ours.columns.get(col, ()), theirs.columns.get(col, ())
        edges = sorted({edge for side in sides for block in side for edge in (block.row, block.row + block.rows)})
        for start, stop in pairwise(edges):
            yield col, start, stop


def _by_column(blocks: Iterable[Block]) -> dict[int, list[Block]]:
    found: dict[int, list[Block]] = {}
    for block in blocks:
        for col in range(block.col, block.col + block.cols):
            found.setdefault(col, []).append(block)
    return {col: sorted(column, key=lambda block: block.row) for col, column in found.items()}


def with_twins(reports: Sequence[Report]) -> list[Report]:
    """The reports, each of a workbook whose twin came before it with the comparison of the two.

    Twins differ by the suffix of their files only, and carry the same description; where they carry different ones, a
    remark says so.
    """
    done: list[Report] = []
    for report in reports:
        path = Path(report.file)
        twin = next((Path(other.file) for other in done if _are_twins(Path(other.file), path)), None)
        done.append(report if twin is None else _with_twin(report, path, twin))
    return done


def _are_twins(one: Path, other: Path) -> bool:
    suffixes = {one.suffix.lower(), other.suffix.lower()}
    return len(suffixes) == 2 and suffixes <= FORMATS.keys() and one.with_suffix("") == other.with_suffix("")


def _with_twin(report: Report, path: Path, twin: Path) -> Report:
    ours, theirs = read(path), read(twin)
    if description_in(ours) is None or description_in(ours) != description_in(theirs):
        remark = say("{name} does not carry the same description: not compared", name=twin.name)
        return replace(report, remarks=(*report.remarks, remark))
    return replace(report, comparisons=(*report.comparisons, compare_twins(ours, theirs, f"twin {twin.suffix}")))


def compare_twins(ours: Book, theirs: Book, judge: str) -> Comparison:
    """Sheets, names, constants, formulas as trees, and stored values of two books."""
    tally = Tally(judge)
    mine, yours = (", ".join(sheet.title for sheet in book.sheets) for book in (ours, theirs))
    tally.note(0.0 if mine == yours else math.inf, "sheets", mine, yours)
    _compare_names(tally, ours, theirs)
    for sheet in ours.sheets:
        other = theirs.sheet(sheet.title)
        if other is not None:
            _compare_formulas(tally, sheet, other)
            _compare_values(tally, sheet.title, sheet.constants, other.constants, scaled=False)
            _compare_values(tally, sheet.title, sheet.cached, other.cached, scaled=True)
    return replace(tally.result(), subject="this file")


def _compare_names(tally: Tally, ours: Book, theirs: Book) -> None:
    mine, yours = ({(d.name, d.sheet): neutral(d.formula, "") for d in book.names} for book in (ours, theirs))
    for name in sorted(mine.keys() | yours.keys(), key=str):
        _compare_nodes(tally, f"name {name[0]}", mine.get(name), yours.get(name))


def _compare_nodes(tally: Tally, where: str, ours: Node | None, theirs: Node | None) -> None:
    if ours == theirs:
        tally.note(0.0, where, "", "")
    else:
        tally.note(math.inf, where, printed(ours), printed(theirs))


def printed(node: Node | None) -> str:
    """A formula as a report shows it."""
    return "no formula" if node is None else "=" + print_formula(node)


def _compare_formulas(tally: Tally, sheet: BookSheet, other: BookSheet) -> None:
    """Column by column, from one row where either side begins another formula to the next."""
    ours, theirs = Formulas(sheet), Formulas(other)
    for col, start, stop in stretches(ours, theirs):
        found = [side.at(start, col) for side in (ours, theirs)]
        nodes = [None if node is None else neutral(node, sheet.title) for node in found]
        if nodes != [None, None]:
            _compare_nodes(tally, cell_address(sheet.title, start, col), nodes[0], nodes[1])
            tally.cells += stop - start - 1


def _compare_values(tally: Tally, title: str, ours: CellStore, theirs: CellStore, scaled: bool) -> None:
    """`scaled`: results are compared by the size of their column, what was typed each by itself."""
    for col in sorted(ours.columns.keys() | theirs.columns.keys()):
        mine, yours = ours.columns.get(col, ()), theirs.columns.get(col, ())
        if mine == yours:
            tally.cells += sum(len(run.values) for run in mine)
            tally.worst = max(tally.worst, 0.0)
            continue
        scale = column_scale([value for run in mine for value in run.values], 1.0) if scaled else 0.0
        rows = {row for runs in (mine, yours) for run in runs for row in range(run.row, run.end)}
        for row in sorted(rows):
            _compare_value(tally, cell_address(title, row, col), ours.get(row, col), theirs.get(row, col), scale)


def _compare_value(tally: Tally, where: str, ours: Scalar, theirs: Scalar, scale: float) -> None:
    apart = 0.0 if ours == theirs else difference(ours, theirs, scale)
    tally.note(apart, where, ours, theirs)
