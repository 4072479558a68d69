"""One line on a mechanism that was built: in how many positions it closes, and what its sweep leaves out."""

from __future__ import annotations

from collections.abc import Sequence

from mechsheet.compiled import Compiled
from mechsheet.kinematics.places import number
from mechsheet.kinematics.solve import dimension_values
from mechsheet.model import Mechanism
from mechsheet.sheet.blocks import shown_unit

MOST_RUNS = 3
"""So many stretches without a position are named."""

_LANDS = 1e-6
"""By this part of a step the stop may be missed: it is rounding."""


def verdict(compiled: Compiled) -> str:
    """`closes in 19 of 25 positions, not from 120° to 195°; the step misses the stop (360°): the last row is 350°`.

    Read from the values of the computed workbook; nothing is computed again.
    """
    mechanism, plan = compiled.mechanism, compiled.plan
    drivers = compiled.column(plan.at.spots[mechanism.driver.symbol].col)
    unit = shown_unit(plan, mechanism.driver.symbol)
    shown = [_shown(value, unit) for value in drivers]
    said = [_closing(compiled.exists, shown)]
    missed = _missed_stop(mechanism, plan.rows)
    if missed is not None:
        said.append(f"the step misses the stop ({_shown(missed, unit)}): the last row is {shown[-1]}")
    said += [
        f"the sketch says nothing about group {group.number}: mode +1 was taken"
        for group in plan.equations.groups
        if group.open
    ]
    return "; ".join(said)


def _closing(exists: Sequence[bool], shown: list[str]) -> str:
    count = sum(exists)
    if not count:
        return f"closes in none of {len(exists)} positions: no such mechanism can be assembled in this sweep"
    text = f"closes in {count} of {len(exists)} positions"
    runs = _runs(exists)
    named = [f"at {shown[first]}" if first == last else f"from {shown[first]} to {shown[last]}" for first, last in runs]
    if named:
        more = f" and {len(named) - MOST_RUNS} more" if len(named) > MOST_RUNS else ""
        text += f", not {', '.join(named[:MOST_RUNS])}{more}"
    return text


def _runs(exists: Sequence[bool]) -> list[tuple[int, int]]:
    """First and last index of each stretch of rows without a position."""
    runs: list[tuple[int, int]] = []
    for index, there in enumerate(exists):
        if there:
            continue
        if runs and runs[-1][1] == index - 1:
            runs[-1] = (runs[-1][0], index)
        else:
            runs.append((index, index))
    return runs


def _missed_stop(mechanism: Mechanism, rows: int) -> float | None:
    """The stop of the sweep as people read it, where the steps do not land on it."""
    driver = mechanism.driver
    if driver.values:
        return None
    values = dimension_values(mechanism)
    start, stop, step = (number(part, values) for part in (driver.start, driver.stop, driver.step))
    if abs((stop - start) / step - (rows - 1)) < _LANDS:
        return None
    return driver.unit.to_shown(stop)


def _shown(value: object, unit: str) -> str:
    gap = "" if unit in ("", "°") else " "
    return f"{value:.6g}{gap}{unit}" if isinstance(value, float | int) else str(value)
