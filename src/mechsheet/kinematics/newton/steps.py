"""Whether the rows are near enough to each other for Newton's method: held against the same motion in smaller steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import at_values, listed_values
from mechsheet.kinematics.equations import PASSES, Equations, System
from mechsheet.kinematics.newton.system import MOST_PASSES
from mechsheet.kinematics.numeric import Array, interpolated
from mechsheet.model import Mechanism

FINER = (2, 4, 8)
"""Parts into which the steps are divided."""

MOST_ROWS = 4_000
ALIKE = 1e-6

LEAP = math.pi / 2
"""No link turns so far in one of the smallest steps [rad]."""

TRIED = (PASSES, 8, 10, MOST_PASSES)

Sweep = Callable[[Mechanism, Equations, Mapping[str, Array]], dict[str, Array]]


@dataclass(frozen=True, slots=True)
class Trial:
    """What rows do with so many passes: which are lost that smaller steps find, which lie elsewhere."""

    lost: Array
    elsewhere: Array

    @property
    def fine(self) -> bool:
        """Whether nothing is amiss."""
        return not (self.lost.any() or self.elsewhere.any())


class Steps:
    """A mechanism's rows, and the same motion in the smallest steps that are tried."""

    def __init__(self, mechanism: Mechanism, equations: Equations, driver: Array, sweep: Sweep) -> None:
        self.besides = listed_values(mechanism, dimension_values(mechanism), driver)
        self.mechanism, self.equations, self.driver, self.sweep = mechanism, equations, driver, sweep
        self.parts = max((parts for parts in FINER if parts * len(driver) <= MOST_ROWS), default=1)
        finest = self._followed(with_passes(equations, MOST_PASSES), self.parts)
        self.truth = [column[:: self.parts] for column, _ in finest]
        self.reached = [there[:: self.parts] for _, there in finest]

    def _followed(self, equations: Equations, parts: int) -> list[tuple[Array, NDArray[np.bool_]]]:
        """The unknowns in steps divided into so many parts, each with where it has been followed to."""
        rows = np.arange(len(self.driver), dtype=float)
        places = np.arange((len(self.driver) - 1) * parts + 1) / parts

        def listed(column: Array) -> tuple[float, ...]:
            return tuple(float(value) for value in interpolated(places, rows, column))

        besides = {symbol: listed(column) for symbol, column in self.besides.items()}
        drivers = tuple(
            replace(other, values=besides[other.symbol]) if other.values else other for other in self.mechanism.drivers
        )
        path = interpolated(places, rows, self.driver)
        finer = replace(self.mechanism, driver=at_values(self.mechanism.driver, path), drivers=drivers)
        own = _finer(equations, parts)
        given: dict[str, Array] = {symbol: np.array(column) for symbol, column in besides.items()}
        values = self.sweep(finer, own, {**given, self.mechanism.driver.symbol: path})
        slides = {joint.symbol for joint in self.mechanism.joints}
        found = []
        for system in (group.system for group in own.groups if group.system):
            columns = [values[name] for name in system.unknowns]
            angles = [column for name, column in zip(system.variables, columns, strict=True) if name not in slides]
            there = _reached(columns, angles, values[system.determinant], system.row)
            found += [(column, there) for column in columns]
        return found

    def trial(self, equations: Equations, parts: int = 1) -> Trial:
        """The rows with these equations, in steps divided into so many parts."""
        lost = np.zeros(len(self.driver), dtype=bool)
        elsewhere = lost.copy()
        columns = [column[::parts] for column, _ in self._followed(equations, parts)]
        for true, reached, own in zip(self.truth, self.reached, columns, strict=True):
            gap = np.abs(own - true)
            lost |= np.isnan(own) & reached
            with np.errstate(invalid="ignore"):
                elsewhere |= (gap > ALIKE * np.maximum(1.0, np.abs(true))) & (
                    np.abs(gap - math.tau * np.round(gap / math.tau)) > ALIKE
                )
        return Trial(lost, elsewhere)


def _reached(columns: Sequence[Array], angles: Sequence[Array], determinant: Array, row: int) -> NDArray[np.bool_]:
    """Where the motion goes on from its row `row`; `columns`: the unknowns, of which `angles` are some.

    Newton's method may find anything behind a place that does not close, where the determinant changes its sign, or where
    a link turns by more than `LEAP` in one of the smallest steps.
    """
    ends = np.flatnonzero(np.isnan(columns).any(axis=0) | (determinant * determinant[row] <= 0))
    for angle in angles:
        leaps = np.flatnonzero(np.abs(np.diff(angle)) > LEAP)  # from one place to the next; NaN is none
        ends = np.concatenate([ends, leaps[leaps < row], leaps[leaps >= row] + 1])
    before, behind = ends[ends <= row], ends[ends >= row]
    found = np.zeros(len(determinant), dtype=bool)
    found[int(before.max(initial=-1)) + 1 : int(behind.min(initial=len(determinant)))] = True
    return found


def with_passes(equations: Equations, passes: int) -> Equations:
    """The equations with so many Newton steps a row."""
    return _with_systems(equations, lambda system: replace(system, passes=passes))


def _finer(equations: Equations, parts: int) -> Equations:
    """The equations over rows of which each step is divided into so many parts."""
    return _with_systems(equations, lambda system: replace(system, row=system.row * parts))


def _with_systems(equations: Equations, change: Callable[[System], System]) -> Equations:
    groups = (
        group if group.system is None else replace(group, system=change(group.system)) for group in equations.groups
    )
    return replace(equations, groups=tuple(groups))


def settled(mechanism: Mechanism, equations: Equations, driver: Array, sweep: Sweep) -> Equations:
    """The equations with as many passes as the rows need: the description's, else at least `PASSES`.

    Raises MechanismError where a row would be of another assembly, with the largest step that works.
    """
    steps = Steps(mechanism, equations, driver, sweep)
    asked = mechanism.solution.passes
    best: Equations | None = None
    fewest = math.inf
    for passes in TRIED if asked is None else (asked,):
        own = with_passes(equations, passes)
        trial = steps.trial(own)
        if trial.fine:
            return own
        amiss = float(trial.lost.sum() + len(driver) * trial.elsewhere.sum())
        if amiss < fewest:
            best, fewest, worst = own, amiss, trial
    if best is None:
        raise ValueError("no number of passes")
    if worst.elsewhere.any():
        row = int(np.argmax(worst.elsewhere))
        raise MechanismError(_too_far(mechanism, driver, row, working_step(steps, best), elsewhere=True))
    return best


def step_doubts(mechanism: Mechanism, equations: Equations, driver: Array, sweep: Sweep) -> list[Fault]:
    """A warning where smaller steps find positions that the rows lose."""
    if not any(group.system for group in equations.groups):
        return []
    steps = Steps(mechanism, equations, driver, sweep)
    trial = steps.trial(equations)
    if not trial.lost.any():
        return []
    row = int(np.argmax(trial.lost))
    return [_too_far(mechanism, driver, row, working_step(steps, equations), elsewhere=False)]


def working_step(steps: Steps, equations: Equations) -> int:
    """The smallest number of parts of a step with which nothing is amiss; 0 where none of those tried does it."""
    most = with_passes(equations, MOST_PASSES)
    return next((parts for parts in FINER if parts <= steps.parts and steps.trial(most, parts).fine), 0)


def _too_far(mechanism: Mechanism, driver: Array, row: int, parts: int, elsewhere: bool) -> Fault:
    unit = mechanism.driver.unit
    there, before = float(unit.to_shown(driver[row])), float(unit.to_shown(driver[max(row - 1, 0)]))
    law = mechanism.driver.law
    hint = say("take a much smaller step, or end the sweep before")
    if parts > 1:
        hint = say("a step of {step:.4g} works", step=abs(there - before) / parts)
        if law is not None:
            hint = say("write rows = {rows} in motion", rows=(law.rows - 1) * parts + 1)
    at = {"symbol": mechanism.driver.symbol, "value": there}
    message = say("the step to {symbol} = {value:.6g} is too large: Newton's method loses the links", **at)
    if elsewhere:
        message = say(
            "the step to {symbol} = {value:.6g} is too large: Newton's method lands on another assembly", **at
        )
    return Fault(
        message,
        key="driver.motion" if law is not None else "driver.values" if mechanism.driver.values else "driver.step",
        hint=hint,
    )
