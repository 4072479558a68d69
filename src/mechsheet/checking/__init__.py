"""Do engine, stored values, reference and other programs agree? The only place where they meet."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from mechsheet.building import build
from mechsheet.checking.against_reference import against_reference
from mechsheet.checking.inputs import description_in, plan_inside
from mechsheet.checking.report import TOLERANCE, Comparison, Report, Tally, difference
from mechsheet.description import load
from mechsheet.description.locate import located
from mechsheet.diagnostics import MechanismError, readable_name
from mechsheet.engine import evaluate
from mechsheet.formats import read
from mechsheet.formula.book import Book, cells_of
from mechsheet.formula.references import cell_address
from mechsheet.model import Mechanism
from mechsheet.programs import answers

__all__ = ["TOLERANCE", "Comparison", "Report", "Tally", "check", "difference"]


def check(path: str | Path, programs: Sequence[str] = (), progress: Callable[[str], None] | None = None) -> Report:
    """Judge a description (.toml) or a workbook: engine against stored values, reference, and the named programs.

    Raises MechsheetError when the file cannot be read, MissingProgramError when a program is not installed.
    """
    path = Path(path)
    say = progress or (lambda _: None)
    if path.suffix.lower() == ".toml":
        return _check_description(path, programs, say)
    say("reading")

    return _check_book(read(path), path, readable_name(path), programs, say)


def _check_description(path: Path, programs: Sequence[str], say: Callable[[str], None]) -> Report:
    """Build the workbook aside and judge that file."""

    mechanism = load(path)
    try:
        return _check_built(mechanism, readable_name(path), programs, say)
    except MechanismError as error:
        raise located(error, mechanism.text, readable_name(path)) from error


def _check_built(mechanism: Mechanism, shown: str, programs: Sequence[str], say: Callable[[str], None]) -> Report:
    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        say("building")
        (built,) = build(mechanism, folder)
        return _check_book(read(built), built, shown, programs, say)


def _check_book(book: Book, path: Path, shown: str, programs: Sequence[str], say: Callable[[str], None]) -> Report:

    say("recalculating")
    values = evaluate(book)
    comparisons = [_against_stored(book, values)]
    remarks: list[str] = []
    periods: Periods = {}
    text = description_in(book)
    if text is None:
        remarks.append("no description inside: only recalculated, not compared with the reference")
    else:
        say("solving")
        comparison, remarks = against_reference(book, values, text, shown)
        comparisons.append(comparison)
        periods = _periods(text, shown)
    for program in programs:
        say(program)
        comparisons.append(_against_program(book, values, path, program, periods))
    return Report(shown, tuple(comparisons), tuple(remarks))


def _against_stored(book: Book, values: Any) -> Comparison:
    tally = Tally("stored values")
    for sheet in book.sheets:
        for block in sheet.blocks:
            for col in range(block.col, block.col + block.cols):
                ours = values.column(sheet.title, col, block.row, block.row + block.rows - 1)
                for offset, value in enumerate(ours):
                    row = block.row + offset
                    stored = sheet.cached.get(row, col)
                    apart = difference(value, stored)
                    if apart > tally.worst or apart > TOLERANCE:
                        tally.note(apart, cell_address(sheet.title, row, col), value, stored)
                    else:
                        tally.cells += 1
    return tally.result()


Periods = Mapping[tuple[str, int], float]
"""(sheet, column) -> the period of an angle's column: two values that differ by a multiple of it are the same."""


def _periods(text: str, shown: str) -> Periods:
    """Where a mechanism's workbook holds angles, and counts of turns.

    ATAN2(-1, 0) is pi or -pi by the sign of a rounding error: programs may differ by a turn there, and in the count of turns
    that makes up for it.
    """
    plan = plan_inside(text, shown)
    found = {}
    for column in plan.columns:
        if column.equation is None:
            continue
        if column.equation.unit == "angle":
            in_degrees = column.kind == "shown" or plan.at.spots[column.symbol].degrees
            found[plan.table, column.col] = 360.0 if in_degrees else math.tau
        elif column.equation.kind == "intermediate" and column.symbol.startswith("turns"):
            found[plan.table, column.col] = 1.0
    return found


def _against_program(book: Book, values: Any, path: Path, program: str, periods: Periods) -> Comparison:

    theirs = answers(program, path)
    tally = Tally(program)
    for title, row, col in cells_of(book):
        value = values.get(title, row, col)
        other = theirs.get(title, row, col)
        tally.note(difference(value, other, periods.get((title, col))), cell_address(title, row, col), value, other)
    return tally.result()
