"""One file before all its judges: engine, stored values, reference, search, other programs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from livesheet.diagnostics import Fault, MissingSheetError, WorkbookError, readable_name
from livesheet.formats import read
from livesheet.formula.book import Book
from livesheet.said import say
from mechsheet.checking.against_reference import against_plan
from mechsheet.checking.against_search import against_search
from mechsheet.checking.baseline import Baseline
from mechsheet.checking.cells import compare_cells, compare_program
from mechsheet.checking.cells_apart import Rules
from mechsheet.checking.comparison import Comparison
from mechsheet.checking.edited.edits import compared
from mechsheet.checking.edited.inserted_rows import MovedValues
from mechsheet.checking.inputs import description_in, expected_for, functions_in, inside, workbook_of
from mechsheet.checking.of_itself import description_of, first_sheet, red_line, stale
from mechsheet.checking.programs import answers, cannot_judge, names_of, refuse_unknown
from mechsheet.checking.report import Edit, Report
from mechsheet.checking.stored import judge_stored
from mechsheet.diagnostics import MissingProgramError
from mechsheet.library.routines import with_routines


def check(
    path: str | Path,
    programs: str | Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
    rules: Rules | None = None,
    baseline: Baseline | None = None,
) -> Report:
    """Check a description (.toml) or a workbook: engine against stored values, reference, and the programs named.

    programs  names, or one text with commas: "libreoffice,ironcalc"
    rules     tolerances, and cells that are left out;  baseline  differences of stored values that are accepted

    A program that is not installed or cannot read the file is in `Report.missing`. Raises MechsheetError when the file
    cannot be read, and MissingProgramError for a name that is no program's.
    """
    report = judge(path, programs, progress, rules, baseline)
    if report.stored is not None and report.stored.unmeant:
        raise WorkbookError(report.stored.unmeant.values())
    return report


def judge(
    path: str | Path,
    programs: str | Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
    rules: Rules | None = None,
    baseline: Baseline | None = None,
    descriptions: Sequence[Path] = (),
    modules: Sequence[Path] = (),
) -> Report:
    """As `check`; cells to ignore that mean nothing in this file are left to the caller, who may have other files.

    descriptions  files among which the workbook's own is looked for when none of its name is beside it
    modules       files in Basic whose functions the workbook calls
    """
    asked = names_of(programs)
    refuse_unknown(asked)
    path = Path(path)
    work = _Work(asked, progress or (lambda _: None), rules or Rules(), baseline, modules)
    if path.suffix.lower() == ".toml":
        work.say("building")
        with workbook_of(path) as built:
            return _check_book(read(built), built, readable_name(path), work)
    work.say("reading")
    return _check_book(read(path), path, readable_name(path), work, description_of(path, descriptions))


@dataclass(frozen=True, slots=True)
class _Work:
    """What was asked for."""

    programs: Sequence[str]
    say: Callable[[str], None]
    rules: Rules
    baseline: Baseline | None
    modules: Sequence[Path] = ()


def _check_book(book: Book, path: Path, shown: str, work: _Work, file: Path | None = None) -> Report:
    """Judge a workbook; `file` is the description that it should have been built from, if there is one."""
    work.say("recalculating")
    form = functions_in(book)
    book = with_routines(book, work.modules)
    stored, values = judge_stored(book, work.rules)
    if work.baseline is not None:
        stored = work.baseline.accept(Path(shown), stored)
    comparisons = [stored.comparison()]
    remarks: list[str] = []
    edits: tuple[Edit, ...] = ()
    text = description_in(book)
    red = red_line(book, values)
    changed = ""
    if text is None:
        expected = None
        remarks.append(say("no description inside: only recalculated, not compared with the reference"))
    else:
        if file is not None:
            changed = stale(text, path, file)
        work.say("looking for edits")
        expected = expected_for(text, inside(shown), form)
        with_rows = compared(book, expected)
        found, plan = with_rows.edits, with_rows.plan
        edits = found.edits
        work.say("solving")
        placed = MovedValues(values, found.moves) if found.moves else values
        remarks += found.remarks
        try:
            comparison, of_inputs = against_plan(found.book, placed, plan, shown, expected.plan, with_rows.built)
            comparisons.append(comparison)
            remarks += of_inputs
            searched = against_search(found.book, placed, plan, shown, expected.plan)
            comparisons += [] if searched is None else [searched]
        except MissingSheetError as error:  # the sheet is told as an edit
            judge = "reference" if len(comparisons) == 1 else "search"
            comparisons.append(Comparison(judge, 0, 0.0))
            remarks.append(_not_without(error.title, judge))
    missing: list[Fault] = []
    for program in work.programs:
        work.say(program)
        if reason := cannot_judge(program, book):
            remarks.append(reason)
            continue
        try:
            theirs = answers(program, path).get
        except (
            MissingProgramError,
            WorkbookError,
        ) as error:  # the other judges' answers are worth something without it
            missing += error.faults
            continue
        if expected is None:
            comparisons.append(compare_cells(program, book, values, theirs, None, work.rules, stored.unsure))
            continue
        try:
            comparisons.append(
                compare_program(
                    program, book, values, theirs, plan, shown,
                    rules=work.rules, but=stored.unsure, moves=found.moves,
                )
            )  # fmt: skip
        except MissingSheetError as error:
            comparisons.append(Comparison(program, 0, 0.0))
            remarks.append(_not_without(error.title, program))
    nameless = text is None and first_sheet(book) is not None
    return Report(shown, tuple(comparisons), tuple(remarks), edits, stored, tuple(missing), red, nameless, changed)


def _not_without(title: str, judge: str) -> str:
    """What is said where a judge needs a sheet that is not there."""
    return say('the sheet "{title}" is missing: not compared: {judge}', title=title, judge=say(judge))
