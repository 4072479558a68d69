"""What `mechsheet.load` returns: a mechanism with the library's functions as methods, for notebooks and scripts; and what
its `solve` returns, the columns of a sweep by name, what no column shows, and the numbers of the motion."""

from __future__ import annotations

import html
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault
from livesheet.said import say, say_count
from mechsheet.arguments.values import number_text, whole_number_given
from mechsheet.description.overrides import Overrides
from mechsheet.diagnostics import MechsheetError
from mechsheet.extras import missing_package
from mechsheet.model import Mechanism

if TYPE_CHECKING:
    from mechsheet.compiled import Compiled
    from mechsheet.library.verdicts import Band, Verdict

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
        from mechsheet.library.verdicts import bands_of

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


# --- its motion -------------------------------------------------------------------------------------------------------

MOST_ROWS = 60
"""Rows that a notebook shows: the first half of them, and the last."""


class _Units(dict[str, str]):
    """The units of the columns; of other names they are found with their values."""

    motion: Motion

    def __missing__(self, name: str) -> str:
        self.motion[name]  # raises where there is nothing of that name
        return self.motion._further[1][name]


class Motion(Mapping[str, NDArray[np.float64]]):
    """The columns of a sweep by name, the driver first: `motion["theta13"]`, `motion["C.x"]`.

    Each is an array of one value per row, as in the workbook: degrees for angles, the length unit for lengths, NaN in rows
    that do not exist. Angles are continuous from row to row. `units` maps each name to "°", "mm", "rad/s", ... or "".

    Every other name that an output may read (`C.vx`, `theta13.d`, `G3.ax`) is there as well, computed when it is asked for;
    a wrong name is told with the one that may be meant.
    """

    def __init__(self, compiled: Compiled) -> None:
        from mechsheet.compiled import motion_of

        columns, units = motion_of(compiled)
        self._compiled, self._columns = compiled, columns
        # at a dead centre there is a position, but there are no rates
        moves = compiled.mechanism.driver.speed is not None
        self._exists = np.asarray(compiled.closed, bool) if moves else None
        self.units = _Units(units)
        self.units.motion = self

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name in self._columns:
            return self._columns[name]
        columns, _ = self._further
        if name not in columns:
            from mechsheet.library.verdicts import unknown

            raise unknown(name, [*self._columns, *columns])
        return columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @cached_property
    def _further(self) -> tuple[dict[str, NDArray[np.float64]], dict[str, str]]:
        from mechsheet.compiled import further_of

        return further_of(self._compiled)

    @property
    def exists(self) -> NDArray[np.bool_]:
        """True in the rows where the linkage can be assembled."""
        if self._exists is not None:
            return self._exists
        return np.asarray(~np.isnan(np.array(list(self._columns.values()))).any(axis=0))

    @cached_property
    def summary(self) -> dict[str, float]:
        """The numbers of the whole motion, `motion.summary["swing"]`, as the first sheet has them; NaN for none."""
        from mechsheet.library.verdicts import Named

        plan = self._compiled.plan
        singles = self._compiled.mechanism.motion_numbers
        return Named((each.symbol, self._compiled.number(plan.places.summaries[each.symbol])) for each in singles)

    def frame(self) -> Any:
        """The columns as a pandas DataFrame, indexed by the driver. Raises MissingProgramError without pandas."""
        try:
            import pandas
        except ImportError as problem:
            raise missing_package("pandas", "notebook") from problem
        driver = next(iter(self._columns))
        return pandas.DataFrame(self._columns).set_index(driver)

    def __repr__(self) -> str:
        rows = len(next(iter(self._columns.values())))
        return f"<Motion: {say_count('{count} row', '{count} rows', rows)} of {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        """The table, for notebooks: names and units above the numbers."""
        rows = list(zip(*self._columns.values(), strict=True))
        heads = "".join(f"<th>{html.escape(name)}<br>{html.escape(self.units[name])}</th>" for name in self._columns)
        lines = [f"<tr>{heads}</tr>"]
        lines += [_line(row) for row in (rows if len(rows) <= MOST_ROWS else rows[: MOST_ROWS // 2])]
        if len(rows) > MOST_ROWS:
            lines.append(f"<tr><td colspan={len(self._columns)}>⋮ {len(rows) - MOST_ROWS} ⋮</td></tr>")
            lines += [_line(row) for row in rows[-MOST_ROWS // 2 :]]
        return f"<table>{''.join(lines)}</table>"


def _line(row: tuple[float, ...]) -> str:
    return "<tr>" + "".join(f"<td>{'' if np.isnan(value) else f'{value:.6g}'}</td>" for value in row) + "</tr>"
