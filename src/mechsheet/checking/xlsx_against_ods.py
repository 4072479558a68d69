"""The same workbook in two formats: do they agree cell by cell, whatever their formats spell differently?"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from livesheet.formats import FORMATS, read
from livesheet.formula.book import Book, BookSheet, CellStore
from livesheet.formula.nodes import Node, Scalar
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_address
from livesheet.said import say
from mechsheet.checking.cells import column_scale
from mechsheet.checking.edited.formula_diff import Formulas, neutral, stretches
from mechsheet.checking.inputs import description_in
from mechsheet.checking.report import Comparison, Report, Tally, difference


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
        tally.note(math.inf, where, _printed(ours), _printed(theirs))


def _printed(node: Node | None) -> str:
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
