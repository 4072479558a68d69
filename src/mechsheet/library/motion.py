"""What `Linkage.solve` returns: the columns of a sweep by name, what no column shows, and the numbers of the motion."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from livesheet.said import say, say_count
from mechsheet.extras import missing_package
from mechsheet.library.named import Named, unknown

if TYPE_CHECKING:
    from mechsheet.compiled import Compiled

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
            raise unknown(name, [*self._columns, *columns], say("names"))
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
