"""What of this program, and of what it can use, is there on this machine, and how to get the rest."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import shutil
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from mechsheet.checking.programs import libreoffice_command


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


EXTRAS = {
    "plot": (("matplotlib",), "pictures and animations: mechsheet plot, .png and .gif"),
    "study": (("pyarrow",), "millions of designs: mechsheet study"),
    "dask": (("distributed", "pyarrow"), "studies on many machines"),
    "notebook": (("matplotlib", "pandas"), "motion.frame() in notebooks"),
    "dxf": (("ezdxf",), "drawings for CAD: mechsheet export --to dxf"),
    "ironcalc": (("ironcalc",), "one more judge: mechsheet check --with ironcalc"),
}
"""Extra -> (packages, what they are for)."""

PROGRAMS = {
    "win32": {"LibreOffice": "winget install TheDocumentFoundation.LibreOffice", "gnumeric": ""},
    "darwin": {"LibreOffice": "brew install --cask libreoffice", "gnumeric": "brew install gnumeric"},
    "linux": {"LibreOffice": "sudo apt install libreoffice-calc", "gnumeric": "sudo apt install gnumeric"},
}
"""Platform -> how to get a program there; "" where nobody offers it."""


def installed() -> list[Part]:
    """Every extra and every program that this one can use."""
    extras = [
        Part(f"mechsheet[{extra}]", use, _versions(packages), f'pip install "mechsheet[{extra}]"')
        for extra, (packages, use) in EXTRAS.items()
    ]
    get = PROGRAMS.get(sys.platform, PROGRAMS["linux"])
    programs = [
        Part("LibreOffice", "opens workbooks; mechsheet check --with libreoffice", libreoffice_command() or "", ""),
        Part("gnumeric", "mechsheet check --with gnumeric", shutil.which("ssconvert") or "", ""),
    ]
    return [
        *extras,
        *(Part(part.name, part.use, part.found, get[part.name]) for part in programs if part.found or get[part.name]),
    ]


def _versions(packages: Sequence[str]) -> str:
    """Names and versions of packages, "" when one is missing."""
    if any(importlib.util.find_spec(package) is None for package in packages):
        return ""
    return ", ".join(f"{package} {importlib.metadata.version(package)}" for package in packages)


def on_path() -> bool:
    """Whether the command `mechsheet` is found where a shell looks for commands."""
    return shutil.which("mechsheet") is not None
