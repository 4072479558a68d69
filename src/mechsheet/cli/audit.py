"""`mechsheet audit`: what is right in a workbook that somebody made by hand."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click

from .common import JSON, Changes, at_lines_of, described, progress
from .helping import Explained


@click.command(cls=Explained, short_help="Find quantities and faults in a workbook made by hand.")
@click.argument("workbook", metavar="BOOK", type=click.Path(path_type=Path))
@click.option(
    "--against", "description", required=True, metavar="DESCRIPTION", type=click.Path(path_type=Path),
    help="What the workbook should be.",
)  # fmt: skip
@click.option("--assembly", type=click.Choice(["any"]), help="any: another assembly than the sketch's is right, too.")
@click.option("--language", type=click.Choice(["en", "tr"]), help="Of the words, in place of the description's.")
@JSON
def audit(workbook: Path, description: Path, assembly: str | None, language: str | None, as_json: bool) -> None:
    """Find the quantities of a mechanism in a workbook laid out in any way, and the faults.

    \b
    mechsheet audit student.xlsx --against four-bar.toml
    mechsheet audit student.xlsx --against four-bar.toml --json

    The sheet's own dimensions and driver hold. Each asked quantity is right, right but for an earlier fault,
    wrong, of the other assembly, not live (it does not follow the dimensions) or missing.

    Exit code 0: all right; 1: something is not; 2: cannot be read or judged.
    """
    from mechsheet.homework.audit import audit as judge
    from mechsheet.homework.words_of import lines

    mechanism = described(description, Changes(), language)
    with at_lines_of(mechanism, description), progress(workbook.name) as say:
        say("auditing")
        found = judge(workbook, mechanism, assembly or "")
    click.echo(json.dumps(found.as_dict(), indent=2, ensure_ascii=False) if as_json else "\n".join(lines(found)))
    if not found.right:
        sys.exit(1)
