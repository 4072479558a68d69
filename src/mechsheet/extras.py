"""What this program can use and does not bring along: packages, by the extra that installs them, and other programs."""

from __future__ import annotations

import sys

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MissingProgramError

EXTRAS = {
    "plot": (("matplotlib",), say("pictures and animations: mechsheet plot, .svg, .png and .gif")),
    "study": (("pyarrow", "scipy"), say("millions of designs: mechsheet study")),
    "dask": (("distributed", "pyarrow", "scipy"), say("studies on many machines")),
    "notebook": (("matplotlib", "pandas"), say("motion.frame() in notebooks")),
    "dxf": (("ezdxf",), say("drawings for CAD: mechsheet export --to dxf")),
    "statistics": (("scipy",), say("probabilities and Bessel functions in workbooks of others: mechsheet recalc")),
    "formulas": (("formulas", "openpyxl"), say("one more judge: mechsheet check --with formulas")),
    "ironcalc": (("ironcalc",), say("one more judge: mechsheet check --with ironcalc")),
    "onlyoffice": (("document-builder",), say("one more judge: mechsheet check --with onlyoffice (100 MB, AGPL)")),
}
"""Extra -> (packages, what they are for)."""

PROGRAMS = {
    "win32": {"LibreOffice": "winget install TheDocumentFoundation.LibreOffice", "gnumeric": ""},
    "darwin": {"LibreOffice": "brew install --cask libreoffice", "gnumeric": "brew install gnumeric"},
    "linux": {"LibreOffice": "sudo apt install libreoffice-calc", "gnumeric": "sudo apt install gnumeric"},
}
"""Platform -> how to get a program there; "" where nobody offers it."""


def command_for(extra: str) -> str:
    """What installs an extra on this platform; the quotes are those that every shell takes."""
    starter = "py -m " if sys.platform == "win32" else ""  # there pip is seldom on the PATH
    return f'{starter}pip install "mechsheet[{extra}]"'


def how_to_get(program: str) -> str:
    """What installs LibreOffice or gnumeric on this platform, "" where nothing does."""
    return PROGRAMS.get(sys.platform, PROGRAMS["linux"])[program]


def missing_package(package: str, extra: str, use: str = "") -> MissingProgramError:
    """The error that says that a package is not installed, what it is used for, and which extra brings it."""
    message = say("{package} is not installed", package=package)
    if use:
        message = say("{package} is not installed: {use}", package=package, use=use)
    return MissingProgramError(Fault(message, hint=command_for(extra)))


def missing_program(program: str) -> MissingProgramError:
    """The error that says that LibreOffice or gnumeric is not installed, and how to get it here."""
    return MissingProgramError(Fault(say("{package} is not installed", package=program), hint=how_to_get(program)))
