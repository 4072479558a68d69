"""What `mechsheet.load` returns: a mechanism with the library's functions as methods, for notebooks and scripts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.arguments.values import number_text, whole_number_given
from mechsheet.description.overrides import Overrides
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism

if TYPE_CHECKING:
    from mechsheet.compiled import Compiled
    from mechsheet.library.motion import Motion
    from mechsheet.library.tolerances import Band
    from mechsheet.library.verdicts import Verdict

Value: TypeAlias = "str | float | Fraction | Decimal | np.number[Any]"
Values: TypeAlias = Mapping[str, Value]


@dataclass(frozen=True)
class Drawing:
    """A drawing at one position that a notebook shows as it stands."""

    linkage: Linkage
    at: float | None = None

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        from mechsheet.plotting import drawn

        return {"image/svg+xml": drawn(self.linkage, "svg", self.at).decode(), "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<Drawing of {self.linkage.name}{'' if self.at is None else f' at {self.at:g}'}>"


class Linkage(Mechanism):
    """A mechanism (see `Mechanism`: links, joints, driver as data) with what can be done with it."""

    __slots__ = ("_kept",)
    _kept: Compiled

    @property
    def _compiled(self) -> Compiled:
        """What was compiled of it, kept: the mechanism never changes, and solving takes longer than evaluating."""
        from mechsheet.compiled import Compiled

        if not hasattr(self, "_kept"):
            object.__setattr__(self, "_kept", Compiled(self))
        return self._kept

    def solve(self) -> Motion:
        """The whole sweep: driver, variables, points and outputs by name; the equations of the workbook, in numpy.

        If the driver has a speed, velocities and accelerations as well: `omega13`, `alpha13`, `s14.v`, `C.v`; with masses
        or loads, forces.

        Raises MechanismError when the linkage cannot be solved.
        """
        from mechsheet.library.motion import Motion

        return Motion(self._compiled)

    def verdicts(self) -> dict[str, Verdict]:
        """What is to be said of the motion, by the names of the first sheet's cells: `verdicts()["transmission_1"].value`.

        The first, "verdict", is the line under the title. Raises MechanismError when the linkage cannot be solved.
        """
        from mechsheet.library.verdicts import verdicts_of

        return verdicts_of(self)

    def tolerance(self) -> dict[str, Band]:
        """What the tolerances of the dimensions come to, by output and summary: `tolerance()["swing"].worst`.

        Raises DescriptionError where no dimension has a tolerance or nothing can have a band.
        """
        from mechsheet.library.tolerances import bands_of

        return bands_of(self)

    def build(
        self,
        output: str | Path = ".",
        formats: str | Iterable[str] | None = None,
        force: bool = False,
        layout: str | None = None,
        tolerance: bool = False,
    ) -> list[Path]:
        """Write the workbooks; see `mechsheet.build`."""
        from mechsheet.library.building import build

        return build(self, output, formats, force=force, layout=layout, tolerance=tolerance)

    def drawing(self, at: float | None = None) -> Drawing:
        """The drawing at a driver value (in its unit; the first position without it), shown by a notebook."""
        return Drawing(self, at)

    def plot(
        self,
        path: str | Path,
        at: float | None = None,
        language: str | None = None,
        vectors: bool = False,
    ) -> Path:
        """Draw into a file: .svg, .png, .gif, .html or .pdf; see `mechsheet.plot`."""
        from mechsheet.plotting import plot

        return plot(self, path, at, language, vectors)

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Its drawing, for notebooks; where it cannot be solved, its name alone."""
        try:
            return {**self.drawing()._repr_mimebundle_(), "text/plain": repr(self)}
        except MechsheetError:
            return {"text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<Linkage {self.name}: {len(self.links)} links, driven by {self.driver.symbol}>"


def _linkage(mechanism: Mechanism) -> Linkage:
    return Linkage(**{field.name: getattr(mechanism, field.name) for field in fields(Mechanism)})


def load(
    path: str | Path,
    overrides: Values | None = None,
    language: str | None = None,
    *,
    rows: int | None = None,
    step: Value | None = None,
) -> Linkage:
    """The linkage that a description file describes.

    overrides  dimension -> value in its own unit, in place of the file's: {"a1": 65}; a number of any type (of numpy,
               Fraction, Decimal), or a text: "65", "a2*1.1" (names: the dimensions after the changes before it; with names,
               functions or pi angles are in radians). Or assembly mode -> 1 or -1: {"mode_1": -1}
    language   that of a catalogue ("en", "tr"), in place of the file's
    step       of the driver, in its unit; start and stop stay
    rows       how many positions: the step follows from start and stop, with `step` the stop from start

    Raises DescriptionError with every fault, each with file, line and key; MechanismError where no sketch can mean a mode.
    """
    from mechsheet.library import changed

    return _linkage(changed.load(path, _overrides(overrides, language, rows, step)))


def loads(
    text: str,
    file: str = "<text>",
    overrides: Values | None = None,
    language: str | None = None,
    *,
    rows: int | None = None,
    step: Value | None = None,
) -> Linkage:
    """The same from a text; `file` is what messages call it."""
    from mechsheet.library import changed

    return _linkage(changed.loads(text, file, _overrides(overrides, language, rows, step)))


def template(
    name: str,
    overrides: Values | None = None,
    language: str | None = None,
    *,
    rows: int | None = None,
    step: Value | None = None,
) -> Linkage:
    """A packaged linkage to start from: `mechsheet.template("four-bar")`; `mechsheet new --list` names all.

    Raises DescriptionError with the near miss when there is no such template, and as `load`.
    """
    from mechsheet.description.templates import template_text

    return loads(template_text(name), name, overrides, language, rows=rows, step=step)


def _overrides(values: Values | None, language: str | None, rows: int | None, step: Value | None) -> Overrides:
    """What is given as texts. Raises MechsheetError for what is no number, with every such value."""
    texts = _texts(values)
    count = None if rows is None else str(whole_number_given(rows, "rows"))
    by = step if step is None or isinstance(step, str) else number_text(step, "step")
    return Overrides(texts, count, by, language)


def _texts(values: Values | None) -> dict[str, str]:
    if not isinstance(values, Mapping | None):
        hint = say('{"a1": 65}: the dimension, and its value in its own unit')
        raise MechsheetError(Fault(say("expected a mapping of values"), key="overrides", hint=hint))
    texts: dict[str, str] = {}
    faults: list[Fault] = []
    for name, value in (values or {}).items():
        try:
            texts[str(name)] = value if isinstance(value, str) else number_text(value, str(name))
        except MechsheetError as error:
            faults += error.faults
    if faults:
        raise MechsheetError(faults)
    return texts
