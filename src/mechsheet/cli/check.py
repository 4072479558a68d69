"""`mechsheet check`: recalculate and compare."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import click

from mechsheet.diagnostics import Fault, MechsheetError

from .common import JSON, progress


@click.command()
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--with", "programs", default="", help="Other judges: formulas, ironcalc, libreoffice, gnumeric.")
@JSON
def check(files: tuple[Path, ...], programs: str, as_json: bool) -> None:
    """Recalculate and compare: engine, stored values, numpy reference, other programs.

    \b
    mechsheet check four-bar.xlsx
    mechsheet check four-bar.toml --with libreoffice,ironcalc
    mechsheet check four-bar.xlsx four-bar.ods      also: are they the same, cell by cell?

    Exit code 0: all agree; 1: something differs; 2: cannot be read.
    """
    from mechsheet.checking import check as check_file
    from mechsheet.checking import with_twins

    judges = [part.strip() for part in programs.split(",") if part.strip()]
    reports = []
    faults: list[Fault] = []
    for file in files:
        with progress(file.name) as say:
            try:
                reports.append(check_file(file, judges, say))
            except MechsheetError as error:
                faults += error.faults
    reports = with_twins(reports)
    if as_json:
        click.echo(json.dumps([report.as_dict() for report in reports], indent=2))
    else:
        for report in reports:
            _print_report(report)
    if faults:
        raise MechsheetError(faults)
    if not all(report.agrees for report in reports):
        sys.exit(1)


def _print_report(report: Any) -> None:
    click.echo(f"{report.file}: {'all agree' if report.agrees else 'SOMETHING DIFFERS'}")
    for item in report.comparisons:
        verdict = "agrees " if item.agrees else "DIFFERS"
        click.echo(f"  {item.judge:<14} {verdict} {item.cells:>8} values, worst {item.worst:9.2e}  {item.where}")
        if not item.agrees:
            click.echo(f"  {'':<14} {item.subject} {item.ours}, {item.judge} {item.theirs or 'nothing'}")
    for remark in report.remarks:
        click.echo(f"  note: {remark}")
