"""A mechanism outside its workbook: as a picture, as an animation, as a web page, as a report on paper.

The mechanism is the list of shapes; curves are the workbook's charts, computed by the engine. Scale is true: a circle is
round.
"""

from __future__ import annotations

from pathlib import Path

from livesheet.diagnostics import Fault, near_miss, readable_name
from livesheet.said import say
from mechsheet.arguments.outputs import file_in
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism

KINDS = ("svg", "png", "gif", "html", "pdf")

GIF_FRAMES = 60


def plot(
    mechanism: Mechanism,
    path: str | Path,
    at: float | None = None,
    language: str | None = None,
    vectors: bool = False,
) -> Path:
    """Draw a mechanism into the file `path`, whose ending says how, and return it; a folder gets a .svg.

    .svg, .png   a picture of the mechanism at the driver value `at`, exactly there, also outside of the sweep
    .gif         an animation of the sweep that starts near `at`; one that does not come round is run to and fro
    .html        a page with a slider for the sweep, set to `at`, and the charts; it needs no network and no other file
    .pdf         a report of one to three pages: the mechanism at true scale in its worst position, or at `at`, its
                 dimensions, what can be said of it, curves, the largest forces

    at        in the driver's unit (degrees, radians or the length unit); without it, one in which the loads act, else the
              first that exists
    language  "en", "tr" or that of another catalogue; without it, the description's
    vectors   draw velocities, accelerations and joint forces as arrows, each kind with a scale bar

    Raises MechsheetError for another ending and for a position that an animation does not have, MechanismError when
    the mechanism cannot be solved or has no position at `at`, MissingProgramError when a picture is wanted and
    matplotlib (`pip install "mechsheet[plot]"`) is not there, OutputError when the file cannot be written.
    """
    path = file_in(path, f"{mechanism.stem}.svg")
    kind = path.suffix.lower().removeprefix(".")
    if kind not in KINDS:
        hint = near_miss(kind, KINDS) or say(
            "endings: {endings}; or a folder: {name}/",
            endings=", ".join(f".{known}" for known in KINDS),
            name=path.name,
        )
        raise MechsheetError(Fault(say("the ending of the name says how to draw"), readable_name(path), hint=hint))
    from livesheet.replacing import replace_file

    replace_file(path, drawn(mechanism, kind, at, language, vectors))
    return path


def drawn(
    mechanism: Mechanism,
    kind: str,
    at: float | None = None,
    language: str | None = None,
    vectors: bool = False,
) -> bytes:
    """The bytes of the file that `plot` writes; `kind` is one of KINDS. Raises as `plot` does."""
    from mechsheet.plotting import pictures
    from mechsheet.plotting.page import page
    from mechsheet.plotting.sampling import sample
    from mechsheet.plotting.scenes import Stage, journey

    if kind == "pdf":
        from mechsheet.plotting.report import report

        return report(mechanism, at, language)
    stage = Stage(sample(mechanism, at, language, vectors=vectors))
    shown, sweep = stage.sample.shown, stage.sample.sweep
    title = mechanism.title.of(stage.sample.mechanism.language)
    if kind in ("gif", "html") and shown >= sweep:
        fault = say("{at:g} lies outside of the sweep, which is what a .{kind} shows", at=at, kind=kind)
        raise MechsheetError(Fault(fault, key="at", hint=say("draw a .svg or .png, or widen the sweep")))
    if kind == "html":
        return page(stage)
    if kind == "gif":
        rows, _ = journey(stage, GIF_FRAMES)
        return pictures.gif([stage.drawing(row) for row in rows], title)
    return (pictures.svg if kind == "svg" else pictures.png)(stage.drawing(shown), title)
