"""`mechsheet pull`: what was changed in a workbook, back into its description."""

from __future__ import annotations

from pathlib import Path

import click

from livesheet.said import say

from .common import (
    FILE,
    STANDARD_OUTPUT,
    Explained,
    output_file,
    output_option,
    progress,
    refuse_existing,
    same_file,
    write_text,
)
from .speaking import told, wrote
from .streams import print_file


@click.command(cls=Explained, short_help="Bring changes made in a workbook back into its description.")
@click.argument("workbook", type=FILE)
@output_option("File to write; standard output without it.")
@click.option("--into", type=FILE, help="Bring the changes into this description instead.")
def pull(workbook: Path, output: str | None, into: Path | None) -> None:
    """Bring dimensions and modes that were changed in a workbook back into its description.

    Comments and order of the description stay. Without --into it is the one that the workbook carries.

    \b
    mechsheet pull edited.xlsx -o new.toml
    mechsheet pull edited.xlsx --into mine.toml -o mine.toml
    """
    from mechsheet.checking.edited.pull import pull as pulled_from

    file = None if output in (None, STANDARD_OUTPUT) else output_file(output, f"{workbook.stem}.toml", (workbook,))
    if file is not None and not (into is not None and same_file(file, into)):
        refuse_existing(file, say("choose another name, or name the same file with --into"))
    with progress(workbook.name) as tell:
        tell("comparing")
        result = pulled_from(workbook, into)
    for change in result.changes:
        click.echo(told(change), err=True)
    if not result.changes:
        click.echo(told(say("nothing was changed")), err=True)
    if file is None:
        print_file(result.text)
        return
    write_text(file, result.text, output)
    wrote(file.as_posix())
