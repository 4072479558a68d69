"""The same equations for other programs: each kind of export is a printer for the one list of equations, or a reader of
what the engine computes from it. No kind has mathematics of its own.
"""

from __future__ import annotations

from pathlib import Path

from livesheet.diagnostics import Fault, near_miss, readable_name
from livesheet.replacing import make_folder, replace_file
from livesheet.said import say
from mechsheet.arguments.outputs import file_in
from mechsheet.arguments.values import number_given, whole_number_given
from mechsheet.diagnostics import MechsheetError
from mechsheet.exporting import geogebra, octave, python, table
from mechsheet.exporting.drawings import dxf, svg
from mechsheet.exporting.functions.basic import vba
from mechsheet.exporting.job import Job, Kind
from mechsheet.exporting.program import ascii_word
from mechsheet.exporting.solution import latex, markdown
from mechsheet.model import Mechanism

__all__ = ["KINDS", "Job", "Kind", "export", "exported", "kind_of"]

MOST_FRAMES = 10_000

_ROWS = (
    Kind("octave", ".m", "arrays, animated drawing and curves: GNU Octave, MATLAB", octave.write, identifier=True),
    Kind("python", ".py", "a numpy module that needs nothing else", python.write, identifier=True),
    Kind("geogebra", ".ggb", "a construction that moves, with sliders, for GeoGebra", geogebra.write),
    Kind("vba", ".bas", "a module of functions for Excel and LibreOffice", vba, identifier=True),
    Kind("latex", ".tex", "the solution as a textbook writes it, for one position", latex, positions=True),
    Kind("markdown", ".md", "the same in Markdown", markdown, positions=True),
    Kind("csv", ".csv", "the variables over the sweep, with units", table.write),
    Kind(
        "svg",
        ".svg",
        "drawings of positions, true coordinates",
        svg,
        positions=True,
        frames=True,
        behind="-drawing",
    ),
    Kind("dxf", ".dxf", "drawings for CAD (needs mechsheet[dxf])", dxf, positions=True, frames=True),
)

KINDS = {kind.name: kind for kind in _ROWS}
"""Name -> kind, one line each, in the order of the help."""


def kind_of(name: str) -> Kind:
    """The kind of that name. Raises MechsheetError with the near miss when there is none."""
    if name not in KINDS:
        hint = near_miss(str(name).casefold(), KINDS) or say("kinds: {kinds}", kinds=", ".join(KINDS))
        raise MechsheetError(Fault(say('no kind of export is called "{name}"', name=name), key="to", hint=hint))
    return KINDS[name]


def export(
    mechanism: Mechanism,
    to: str,
    path: str | Path | None = None,
    at: float | None = None,
    frames: int | None = None,
) -> list[Path]:
    """Write a mechanism as another program reads it, and return the files written.

    to      a kind: one of `KINDS`
    path    the file; or a folder (an existing one, or a name that ends with a slash), in which the file is called as the
            description's; the present folder by default. With `frames`, the folder for the files
    at      for kinds that show one position: the driver's value in its own unit; by default one in which
            the loads act, else the first that exists
    frames  for kinds that draw: so many positions, evenly spread over the sweep, one file each

    Raises MechsheetError for another kind or an option that the kind does not take, MechanismError when the mechanism
    cannot be solved or has no position at `at`, MissingProgramError when a package is missing, OutputError when a file
    cannot be written. A failure leaves every old file whole.
    """
    kind = _asked(to, at, frames)
    if frames:
        path = Path(path) if path is not None else Path(mechanism.stem)
    else:
        path = file_in(path, default_name(mechanism, kind))
    name = path.name if frames else path.stem
    if kind.identifier and name != ascii_word(name):
        hint = say("for example {name}{suffix}", name=ascii_word(name), suffix=kind.suffix)
        fault = say("the file's name is a name in its language too: letters, digits and _ ({kind})", kind=kind.name)
        raise MechsheetError(Fault(fault, readable_name(path), key="output", hint=hint))
    contents = kind.write(Job(mechanism, name, at, frames))
    return _write(path, name, kind, contents, bool(frames))


def default_name(mechanism: Mechanism, kind: Kind) -> str:
    """What the file of an export is called when nobody names it."""
    stem = ascii_word(mechanism.stem) if kind.identifier else mechanism.stem
    return f"{stem}{kind.behind}{kind.suffix}"


def _write(path: Path, name: str, kind: Kind, contents: list[bytes], frames: bool) -> list[Path]:
    files = [path]
    if frames:
        digits = len(str(len(contents)))
        files = [path / f"{name}-{number:0{digits}}{kind.suffix}" for number in range(1, len(contents) + 1)]
        make_folder(path)
    for file, content in zip(files, contents, strict=True):
        replace_file(file, content)
    return files


def exported(mechanism: Mechanism, to: str, at: float | None = None) -> bytes:
    """What `export` would write into one file. Raises as `export` does."""
    kind = _asked(to, at, None)
    (content,) = kind.write(Job(mechanism, ascii_word(mechanism.name) if kind.identifier else mechanism.name, at))
    return content


def _asked(to: str, at: float | None, frames: int | None) -> Kind:
    """The kind of that name, when it takes these options."""
    kind = kind_of(to)
    at = None if at is None else number_given(at, "at")
    frames = None if frames is None else whole_number_given(frames, "frames")
    faults = _faults(kind, at, frames)
    if faults:
        raise MechsheetError(faults)
    return kind


def _faults(kind: Kind, at: float | None, frames: int | None) -> list[Fault]:
    """Options that the kind does not take, and values that no position has."""
    faults = []
    for key, given, taken in (("at", at, "positions"), ("frames", frames, "frames")):
        if given is not None and not getattr(kind, taken):
            others = ", ".join(other.name for other in KINDS.values() if getattr(other, taken))
            faults.append(
                Fault(
                    say("{name} holds the whole sweep", name=kind.name),
                    key=key,
                    hint=say("kinds that take it: {others}", others=others),
                )
            )
    if at is not None and frames is not None:
        faults.append(Fault(say("one position or several: at and frames exclude each other"), key="frames"))
    if frames is not None and not 1 <= frames <= MOST_FRAMES:
        faults.append(
            Fault(
                say("{frames} frames: from 1 to {most} can be written", frames=frames, most=MOST_FRAMES),
                key="frames",
            )
        )
    return faults
