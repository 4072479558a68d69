"""`mechsheet recalc`: recalculate any workbook."""

from __future__ import annotations

import csv
import io
import json
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from livesheet.time_limit import limited
from mechsheet.arguments.outputs import folder_ready, names_folder
from mechsheet.diagnostics import MechsheetError

from .common import (
    FILE,
    JSON,
    Explained,
    modules_option,
    output_file,
    output_option,
    progress,
    seconds_option,
    settings_of,
)
from .gate import Gate, concluded, gate_options, of_each, workbooks
from .speaking import note, told, wrote

if TYPE_CHECKING:
    from mechsheet.checking import Baseline, Report, Rules
    from mechsheet.library.recalculation import Result


@click.command(cls=Explained, short_help="Recalculate any workbook without a spreadsheet program.")
@click.argument("files", nargs=-1, required=True, metavar="WORKBOOK...", type=FILE)
@click.option(
    "--set", "settings", multiple=True, metavar="CELL=VALUE", help="Set a named cell or Sheet!B2; may be repeated."
)
@click.option(
    "--print", "ranges", multiple=True, metavar="RANGE", help="Print Sheet!A1:C9, tab separated; may be repeated."
)
@modules_option
@output_option("Write the recalculated workbook there.")
@click.option("--strict", is_flag=True, help="Exit code 1 even if something just cannot be computed or compared.")
@click.option("--check", is_flag=True, help="Compare with the stored values instead, of files and whole folders.")
@gate_options
@seconds_option()
@JSON
def recalc(
    files: tuple[Path, ...],
    settings: tuple[str, ...],
    ranges: tuple[str, ...],
    modules: tuple[Path, ...],
    check: bool,
    output: str | None,
    seconds: float | None,
    as_json: bool,
    **options: Any,
) -> None:
    """Recalculate any workbook (.xlsx, .ods, .xls ...) without a spreadsheet program.

    \b
    mechsheet recalc book.xlsx --set rate=0.07 --print 'Plan!A1:C9'
    mechsheet recalc book.xlsx --set 'Plan!B2=3' -o new.xlsx      the rest stays
    mechsheet recalc book.xlsx --check                            compare values
    mechsheet recalc --check workbooks --junit report.xml         a whole folder

    Whatever cannot be computed as intended (an unknown function, another workbook, a circular reference ...) is named on
    standard error. Cells with an unknown function keep their stored values, and what depends on them is computed from these.

    Exit code 0: done, all agree; 1: --check found a difference, or --strict anything to remark; 2: cannot be read.
    """
    gate = Gate(**options)
    if check:
        if settings:
            raise MechsheetError(Fault(say("--check compares with the stored values, which know nothing of --set")))
        if ranges or output is not None:
            raise MechsheetError(Fault(say("--check compares: it goes without --print and -o")))
        _check(workbooks(files), gate, modules, seconds, as_json)
        return
    if gate.given():
        raise MechsheetError(Fault(say("{names}: only with --check", names=", ".join(gate.given()))))
    if len(files) > 1:
        raise MechsheetError(
            Fault(say("{count} workbooks: one at a time is recalculated, several only with --check", count=len(files)))
        )
    with limited(seconds, readable_name(files[0])):
        _recalculate(files[0], settings, ranges, modules, output, as_json, gate.strict)


def _recalculate(
    workbook: Path,
    settings: tuple[str, ...],
    ranges: tuple[str, ...],
    modules: tuple[Path, ...],
    output: str | None,
    as_json: bool,
    strict: bool,
) -> None:
    """Set, compute, print, write."""
    from mechsheet.library.recalculation import recalc as recalculate

    with progress(workbook.name) as tell:
        tell("recalculating")
        result = recalculate(workbook, settings_of(settings), modules)
    areas = [result.area(text) for text in ranges]
    if output is not None:
        file = output_file(output, workbook.name, (workbook,) if names_folder(output) else ())
        with folder_ready(output):
            result.write(file)
        wrote(file.as_posix())
    _print_notes("", result.remarks)
    if areas:
        _print_areas(result, areas, as_json)
    elif as_json:
        click.echo(json.dumps(result.as_dict()))
    elif output is None:
        for name, value in result.named().items():
            click.echo(f"{name} = {value}")
    if strict and any(fault.doubtful for fault in result.remarks):
        sys.exit(1)


def _check(files: Sequence[Path], gate: Gate, modules: Sequence[Path], seconds: float | None, as_json: bool) -> None:
    """The stored values of each file."""
    from mechsheet.checking.stored_lines import stored_lines

    rules, baseline = gate.rules(), gate.accepted()
    faults: list[Fault] = []
    reports = of_each(files, faults, lambda file, tell: _judged(file, tell, rules, baseline, modules), seconds)
    for report in reports:
        assert report.stored is not None
        head = f"{report.file}: " if len(files) > 1 else ""
        _print_notes(head, report.stored.remarks)
        if not as_json:
            click.echo(head + "\n".join(map(told, stored_lines(report.stored))))
    if as_json:
        found = [{"file": report.file, **report.stored.as_dict()} for report in reports if report.stored is not None]
        click.echo(json.dumps(found, indent=2))
    concluded(gate, reports, baseline, faults)


def _judged(
    file: Path, tell: Callable[[str], None], rules: Rules, baseline: Baseline | None, modules: Sequence[Path]
) -> Report:
    from livesheet.formats import read
    from mechsheet.checking import Report
    from mechsheet.checking.stored import judge_stored
    from mechsheet.library.routines import with_routines

    tell("recalculating")
    stored, _ = judge_stored(with_routines(read(file), modules), rules)
    if baseline is not None:
        stored = baseline.accept(file, stored)
    return Report(readable_name(file), (stored.comparison(),), stored=stored)


def _print_notes(head: str, remarks: Iterable[Fault]) -> None:
    """What cannot be computed as it is meant: a line for each function, not for each cell."""
    from mechsheet.checking.stored_lines import remark_lines

    for line in remark_lines(remarks):
        note(say("{head}{line}", head=head, line=line))


def _print_areas(result: Result, areas: Iterable[Any], as_json: bool) -> None:
    """The cells of some ranges: JSON as for the whole workbook, or tables with an empty line between them."""
    from livesheet.formula.references import cell_name
    from mechsheet.checking.stored_lines import cell_text
    from mechsheet.library.recalculation import json_value

    if as_json:
        found: dict[str, dict[str, object]] = {}
        for area in areas:
            cells = found.setdefault(area.sheet, {})
            for row, values in enumerate(result.table(area), area.row):
                cells.update({cell_name(row, col): json_value(value) for col, value in enumerate(values, area.col)})
        click.echo(json.dumps(found))
        return
    for number, area in enumerate(areas):
        if number:
            click.echo()
        text = io.StringIO()
        writer = csv.writer(text, "excel-tab", lineterminator="\n")
        writer.writerows([cell_text(value) for value in row] for row in result.table(area))
        click.echo(text.getvalue(), nl=False)
