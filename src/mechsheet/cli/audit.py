"""`mechsheet audit`: what is right in a workbook that somebody made by hand, or what it seems to be."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from livesheet.time_limit import limited
from mechsheet.diagnostics import MechsheetError

from .common import (
    FILE,
    JSON,
    MOST_SECONDS,
    Explained,
    at_lines_of,
    described,
    language_option,
    modules_option,
    progress,
    say_written,
    seconds_option,
)
from .speaking import spoken

if TYPE_CHECKING:
    from mechsheet.homework.recognition import Recognised
    from mechsheet.model import Mechanism


@click.command(cls=Explained, short_help="Find quantities and faults in a workbook made by hand.")
@click.argument("workbook", metavar="BOOK", type=FILE)
@click.option(
    "--against", "description", metavar="DESCRIPTION", type=FILE,
    help="What the workbook should be (or the key.json of an exercise); if not given, find out what it seems to be.",
)  # fmt: skip
@click.option("--assembly", type=click.Choice(["any"]), help="any: accept assemblies other than the sketch's.")
@click.option(
    "--describe", metavar="OUT.toml", type=FILE,
    help="Without --against: write a description to start from.",
)  # fmt: skip
@modules_option
@language_option("Of the words, in place of the description's.")
@seconds_option(MOST_SECONDS)
@JSON
def audit(
    workbook: Path,
    description: Path | None,
    assembly: str | None,
    modules: tuple[Path, ...],
    describe: Path | None,
    language: str | None,
    seconds: float,
    as_json: bool,
) -> None:
    """Find the quantities of a mechanism, and the faults, in a workbook of any layout.

    \b
    mechsheet audit student.xlsx --against four-bar.toml
    mechsheet audit student.xlsx --against four-bar.toml --json
    mechsheet audit old.xls --describe old.toml               what is it?

    The sheet's own dimensions and driver are used. Each quantity asked for is right, right but for an earlier fault,
    wrong, of the other assembly, not live (it does not follow the dimensions) or missing.

    Without --against, it says which packaged linkage the formulas follow, and claims only what the sheet's own formulas
    prove, even when its dimensions are retyped.

    Exit code 0: all right, or recognised; 1: something is not; 2: cannot be read or judged.
    """
    if description is None:
        with limited(seconds, readable_name(workbook)):
            _recognised(workbook, modules, describe, language, as_json)
        return
    if describe is not None:
        raise MechsheetError(Fault(say("with --against there is a description already"), key="--describe"))
    from mechsheet.homework.audit import audit as judge
    from mechsheet.homework.audit import audit_lines

    mechanism = _asked(description, language)
    named = readable_name(workbook)
    with at_lines_of(mechanism, description), progress(workbook.name) as tell, limited(seconds, named):
        tell("auditing")
        found = judge(workbook, mechanism, assembly or "", modules)
    click.echo(json.dumps(found.as_dict(), indent=2, ensure_ascii=False) if as_json else "\n".join(audit_lines(found)))
    if not found.right:
        sys.exit(1)


def _asked(description: Path, language: str | None) -> Mechanism:
    """What is asked for: a description, or that in the key of an exercise."""
    from mechsheet.homework.classroom.marks import key_of_file

    if description.suffix.lower() != ".json":
        return described(description, language=language)
    mechanism = key_of_file(description).mechanism
    return replace(mechanism, language=language or mechanism.language)


def _recognised(
    workbook: Path, modules: tuple[Path, ...], describe: Path | None, language: str | None, as_json: bool
) -> None:
    """What a workbook seems to be; a description of that."""
    from livesheet.formats import read
    from mechsheet.homework.formula_strips import upright
    from mechsheet.homework.recognition import as_dict, recognise, recognised_lines, tables

    with progress(workbook.name) as tell:
        found = tables(upright(read(workbook), modules=modules))
        known = recognise(found, tell)
    click.echo(
        json.dumps(as_dict(known), indent=2, ensure_ascii=False)
        if as_json
        else "\n".join(recognised_lines(found, known, workbook, language or spoken()))
    )
    if known is None:
        sys.exit(1)
    if describe is not None:
        _describe(known, describe, language or "en")


def _describe(known: Recognised, output: Path, language: str) -> None:
    """Write the description, as the template has it, with the workbook's dimensions, driver and assembly."""
    from livesheet.replacing import replace_file
    from mechsheet.description import Overrides
    from mechsheet.description.templates import template_text
    from mechsheet.homework.recognition import settings_of, with_driver
    from mechsheet.library.changed import loads

    text = with_driver(known, template_text(known.template))
    found = loads(text, known.template, Overrides(settings_of(known), language=language))
    replace_file(output, found.text.encode())
    say_written([output])
