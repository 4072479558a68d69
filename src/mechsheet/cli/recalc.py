"""`mechsheet recalc`: recalculate any workbook."""

from __future__ import annotations

import csv
import io
import math
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mechsheet.diagnostics import Fault, MechsheetError
from mechsheet.outputs import folder_ready, names_folder

from .common import JSON, output_file, output_option, progress, settings_of
from .streams import print_json

if TYPE_CHECKING:
    from mechsheet.checking.stored import Stored
    from mechsheet.recalculation import Result

MOST_LINES = 50
"""Most notes and most groups of differences that are printed; --json has all of them."""


@click.command()
@click.argument("workbook", type=click.Path(path_type=Path))
@click.option(
    "--set", "settings", multiple=True, metavar="CELL=VALUE", help="Set a named cell or Sheet!B2; may be repeated."
)
@click.option(
    "--print", "ranges", multiple=True, metavar="RANGE", help="Print Sheet!A1:C9, tab separated; may be repeated."
)
@click.option("--check", is_flag=True, help="Compare with the stored values instead; exit code 1 when any differs.")
@click.option("--strict", is_flag=True, help="Exit code 1 when anything cannot be computed as it is meant.")
@output_option("Write the recalculated workbook there.")
@JSON
def recalc(
    workbook: Path,
    settings: tuple[str, ...],
    ranges: tuple[str, ...],
    check: bool,
    strict: bool,
    output: str | None,
    as_json: bool,
) -> None:
    """Recalculate any workbook (.xlsx, .xlsm, .ods) without a spreadsheet program.

    \b
    mechsheet recalc book.xlsx --set rate=0.07 --print 'Plan!A1:C9'
    mechsheet recalc book.xlsx --set 'Plan!B2=3' -o new.xlsx      all else stays as it was
    mechsheet recalc book.xlsx --check                            does it hold what its formulas say?

    What cannot be computed as it is meant (an unknown function, another workbook, a circle ...) is named on standard
    error, cell by cell.

    Exit code 0: done; 1: --check found a difference, or --strict anything to remark; 2: cannot be read.
    """
    from mechsheet.recalculation import recalc as recalculate

    if check and settings:
        raise MechsheetError(Fault("--check compares with the stored values, which know nothing of --set"))
    with progress(workbook.name) as say:
        say("recalculating")
        result = recalculate(workbook, settings_of(settings))
    areas = [result.area(text) for text in ranges]
    if output is not None:
        file = output_file(output, workbook.name, (workbook,) if names_folder(output) else ())
        with folder_ready(output):
            result.write(file)
        click.echo(f"wrote {file.as_posix()}", err=True)
    _print_notes(result.remarks)
    stored = result.compare_with_stored() if check else None
    if stored is not None:
        print_json(stored.as_dict()) if as_json else click.echo(_check_text(stored))
    if areas and not (check and as_json):
        _print_areas(result, areas, as_json)
    elif stored is None and as_json:
        print_json(result.as_dict())
    elif stored is None and output is None:
        for name, value in result.named().items():
            click.echo(f"{name} = {value}")
    if (stored is not None and not stored.agrees) or (strict and result.remarks):
        sys.exit(1)


def _print_notes(remarks: Iterable[Fault]) -> None:
    """What cannot be computed as it is meant, a line each."""
    remarks = list(remarks)
    for remark in remarks[:MOST_LINES]:
        place = f"{remark.key}: " if remark.key else ""
        click.echo(f"note: {place}{remark.message}{f' ({remark.hint})' if remark.hint else ''}", err=True)
    if len(remarks) > MOST_LINES:
        click.echo(f"note: and {len(remarks) - MOST_LINES} more", err=True)


def _print_areas(result: Result, areas: Iterable[Any], as_json: bool) -> None:
    """The cells of some ranges: JSON as for the whole workbook, or tables with an empty line between them."""
    from mechsheet.formula.references import cell_name
    from mechsheet.recalculation import plain

    if as_json:
        found: dict[str, dict[str, object]] = {}
        for area in areas:
            cells = found.setdefault(area.sheet, {})
            for row, values in enumerate(result.table(area), area.row):
                cells.update({cell_name(row, col): plain(value) for col, value in enumerate(values, area.col)})
        print_json(found)
        return
    for number, area in enumerate(areas):
        if number:
            click.echo()
        text = io.StringIO()
        writer = csv.writer(text, "excel-tab", lineterminator="\n")
        writer.writerows([_cell_text(value) for value in row] for row in result.table(area))
        click.echo(text.getvalue(), nl=False)


def _cell_text(value: object) -> str:
    """A value as a table shows it: numbers with all their digits, TRUE and FALSE."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    return str(value)


def _check_text(stored: Stored) -> str:
    """What a comparison with the stored values found."""
    lines = [f"{stored.formulas} formulas: {stored.equal} as stored, {len(stored.differences)} differ"]
    if stored.unstored:
        lines.append(f"  {stored.unstored} have no stored value")
    if stored.kept:
        lines.append(f"  {stored.kept} more were not computed: their stored values were taken")
    excused = sum(item.excused for item in stored.differences)
    follow = sum(item.follows and not item.excused for item in stored.differences)
    if excused:
        lines.append(f"  {excused} differ by functions that change by themselves (NOW, RAND ...)")
    if follow:
        lines.append(f"  {follow} read cells that differ themselves; the others, by their functions:")
    groups = stored.groups()
    for group in groups[:MOST_LINES]:
        size = f" by {group.first.size:.1e}" if math.isfinite(group.first.size) else ""
        lines.append(f"  {group.cells:>7} {group.kind}{size}  {group.functions or 'references'}")
        shown = group.first.formula if len(group.first.formula) <= 80 else group.first.formula[:77] + "..."
        lines.append(f"{'':>10}{group.first.address} ={shown}")
        ours, theirs = _cell_text(group.first.ours), _cell_text(group.first.theirs)
        lines.append(f"{'':>10}computed {ours or 'nothing'}, stored {theirs or 'nothing'}")
    if len(groups) > MOST_LINES:
        lines.append(f"  and {len(groups) - MOST_LINES} groups more")
    return "\n".join(lines)
