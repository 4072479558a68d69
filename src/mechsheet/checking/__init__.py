"""Do engine, stored values, reference and other programs agree? The only place where they meet."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from mechsheet.building import build
from mechsheet.checking.against_reference import against_plan
from mechsheet.checking.audit import audit
from mechsheet.checking.cells import Angles, angles_in, compare_cells
from mechsheet.checking.expected import expected_for, functions_in, inside
from mechsheet.checking.inputs import description_in
from mechsheet.checking.moves import MovedValues
from mechsheet.checking.mutate import Mutation, mutate
from mechsheet.checking.perturb import Perturbation, perturb
from mechsheet.checking.report import TOLERANCE, Comparison, Edit, Report, Tally, difference
from mechsheet.checking.twins import with_twins
from mechsheet.description import load
from mechsheet.description.locate import located
from mechsheet.diagnostics import MechanismError, WorkbookError, readable_name
from mechsheet.engine import evaluate
from mechsheet.formats import read
from mechsheet.formula.book import Book
from mechsheet.model import Mechanism
from mechsheet.programs import answers, cannot_judge

__all__ = [
    "TOLERANCE",
    "Comparison",
    "Edit",
    "Mutation",
    "Perturbation",
    "Report",
    "Tally",
    "check",
    "difference",
    "mutate",
    "perturb",
    "with_twins",
]


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
    if book.remarks or values.remarks:  # what is not computed as it is meant cannot be judged
        raise WorkbookError((*book.remarks, *values.remarks))
    stored = {sheet.title: sheet.cached for sheet in book.sheets}
    comparisons = [compare_cells("stored values", book, values, lambda title, row, col: stored[title].get(row, col))]
    remarks: list[str] = []
    edits: tuple[Edit, ...] = ()
    angles = Angles()
    text = description_in(book)
    if text is None:
        remarks.append("no description inside: only recalculated, not compared with the reference")
    else:
        say("looking for edits")
        expected = expected_for(text, inside(shown), functions_in(book))
        found = audit(book, expected)
        edits = found.edits
        say("solving")
        placed = MovedValues(values, found.moves) if found.moves else values
        comparison, of_inputs = against_plan(found.book, placed, expected.plan, shown)
        comparisons.append(comparison)
        remarks += [*found.remarks, *of_inputs]
        angles = angles_in(expected.plan)
    for program in programs:
        say(program)
        if reason := cannot_judge(program, (defined.name for defined in book.names)):
            remarks.append(reason)
            continue
        comparisons.append(compare_cells(program, book, values, answers(program, path).get, angles))
    return Report(shown, tuple(comparisons), tuple(remarks), edits)
