"""`mechsheet recalc`: recalculate any workbook."""

from __future__ import annotations

import json
from pathlib import Path

import click

from .common import JSON, SET, settings_of


@click.command()
@click.argument("workbook", type=click.Path(path_type=Path))
@SET
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Write the recalculated workbook there.")
@JSON
def recalc(workbook: Path, settings: tuple[str, ...], output: Path | None, as_json: bool) -> None:
    """Recalculate any workbook without a spreadsheet program.

    \b
    mechsheet recalc four-bar.xlsx --set a1=65 --json
    """
    from mechsheet.recalculation import recalc as recalculate

    result = recalculate(workbook, settings_of(settings))
    if output is not None:
        result.write(output)
        click.echo(f"wrote {output.as_posix()}", err=True)
    if as_json:
        click.echo(json.dumps(result.as_dict(), ensure_ascii=False))
    elif output is None:
        for name, value in result.named().items():
            click.echo(f"{name} = {value}")
