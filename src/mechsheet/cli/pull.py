"""`mechsheet pull`: what was changed in a workbook, back into its description."""

from __future__ import annotations

from pathlib import Path

import click

from mechsheet.diagnostics import Fault, MechsheetError


@click.command()
@click.argument("workbook", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File to write; standard output without it.")
@click.option("--into", type=click.Path(path_type=Path), help="Bring the changes into this description instead.")
def pull(workbook: Path, output: Path | None, into: Path | None) -> None:
    """Bring dimensions and modes that were changed in a workbook back into its description.

    Comments and order of the description stay. Without --into it is the one that the workbook carries.

    \b
    mechsheet pull edited.xlsx -o new.toml
    mechsheet pull edited.xlsx --into mine.toml -o mine.toml
    """
    from mechsheet.checking.pull import pull as pulled_from
    from mechsheet.formats.archive import replace_file

    if output is not None and output.exists() and not (into is not None and into.exists() and output.samefile(into)):
        hint = "choose another name, or name the same file with --into"
        raise MechsheetError(Fault("there is a file already: it is left as it is", output.as_posix(), hint=hint))
    result = pulled_from(workbook, into)
    for change in result.changes:
        click.echo(change, err=True)
    if not result.changes:
        click.echo("nothing was changed", err=True)
    if output is None:
        click.echo(result.text, nl=False)
        return
    replace_file(output, result.text.encode())
    click.echo(f"wrote {output.as_posix()}", err=True)
