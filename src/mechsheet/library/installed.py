"""What of this program, and of what it can use, is there on this machine, and how to get the rest."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata

from livesheet.said import say
from mechsheet.checking.programs import libreoffice_command
from mechsheet.extras import EXTRAS, command_for, how_to_get


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
    try:
        return ", ".join(f"{package} {metadata.version(package)}" for package in packages)
    except metadata.PackageNotFoundError:
        return ""


def on_path() -> bool:
    """Whether the command `mechsheet` is found where a shell looks for commands."""
    return shutil.which("mechsheet") is not None
