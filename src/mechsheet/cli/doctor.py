"""`mechsheet doctor`: what is there, what is missing, how to get it."""

from __future__ import annotations

import json
import platform
import shutil
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from livesheet.said import say
from mechsheet import __version__

from .common import JSON, Explained, progress
from .speaking import told

if TYPE_CHECKING:
    from mechsheet.checking import Report

TRIED = "four-bar"
"""The template that is built and checked."""


@click.command(cls=Explained, short_help="Say what works here, what is missing and how to get it.")
@JSON
def doctor(as_json: bool) -> None:
    """Say what of mechsheet works on this machine, what is missing, and how to get it.

    \b
    mechsheet doctor

    A workbook is built in a temporary folder and checked. Nothing is installed, nothing leaves the machine.

    Exit code 0: it works, whatever extras are missing; 1: the workbook does not agree with its reference.
    """
    with progress("doctor") as tell:
        tell(say("building and checking {template}", template=TRIED))
        report = _tried()
    parts = installed()
    about = {"mechsheet": __version__, "python": platform.python_version(), "system": platform.platform()}
    if as_json:
        found = [asdict(part) for part in parts]
        click.echo(json.dumps({**about, "works": report.agrees, "command": on_path(), "parts": found}, indent=2))
    else:
        click.echo(f"mechsheet {__version__}, Python {about['python']}, {about['system']}")
        works = say("agrees with its numpy reference" if report.agrees else "DOES NOT AGREE: see mechsheet check")
        click.echo(told(say("  a workbook of {template}, built and checked: {works}", template=TRIED, works=works)))
        if not on_path():
            starter = "py" if sys.platform == "win32" else "python3"
            pattern = "  the command is not on the PATH: {starter} -m mechsheet does the same (or install it by pipx)"
            click.echo(told(say(pattern, starter=starter)))
        width = max(len(part.name) for part in parts)
        there, missing = [p for p in parts if p.found], [p for p in parts if not p.found]
        for heading, rows in ((say("There"), there), (say("Missing"), missing)):
            if rows:
                click.echo(f"\n{told(heading)}")
            for part in rows:
                click.echo(f"  {part.name:<{width}} {told(part.use)}")
                click.echo(f"  {'':<{width}} {part.found or part.get}")
    if not report.agrees:
        sys.exit(1)


def _tried() -> Report:
    """The check of a workbook that is built here and now."""
    from mechsheet.checking import check
    from mechsheet.description.templates import template_text
    from mechsheet.library.building import build
    from mechsheet.library.changed import loads

    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        file = Path(folder) / f"{TRIED}.xlsx"
        build(loads(template_text(TRIED)), file)
        return check(file)


@dataclass(frozen=True, slots=True)
class Part:
    """Something that a person may want besides the bare program."""

    name: str
    use: str
    """What it is for."""
    found: str
    """Its version, or where it is; "" when it is missing."""
    get: str
    """How to get it."""


def installed() -> list[Part]:
    """Every extra and every program that this one can use."""
    from mechsheet.checking.programs import libreoffice_command
    from mechsheet.extras import EXTRAS, command_for, how_to_get

    extras = [
        Part(f"mechsheet[{extra}]", use, _versions(packages), command_for(extra))
        for extra, (packages, use) in EXTRAS.items()
    ]
    programs = [
        ("LibreOffice", say("opens workbooks; mechsheet check --with libreoffice"), libreoffice_command()),
        ("gnumeric", say("mechsheet check --with gnumeric"), shutil.which("ssconvert")),
    ]
    parts = [Part(name, use, found or "", how_to_get(name)) for name, use, found in programs]
    return extras + [part for part in parts if part.found or part.get]


def _versions(packages: Sequence[str]) -> str:
    """Names and versions of packages, "" when one is missing."""
    from importlib import metadata

    try:
        return ", ".join(f"{package} {metadata.version(package)}" for package in packages)
    except metadata.PackageNotFoundError:
        return ""


def on_path() -> bool:
    """Whether the command `mechsheet` is found where a shell looks for commands."""
    return shutil.which("mechsheet") is not None
