"""Velocities, accelerations and forces beside the reference's: near a dead centre they grow like 1/sin of the angle at
which a group is driven, and lose digits like 1/sin^2."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from livesheet.formula.nodes import Call, Node, symbols, walk
from mechsheet import reference
from mechsheet.checking.excuses.columns import HAIR, JUMP, Mask
from mechsheet.checking.report import Array
from mechsheet.kinematics.dyads.solved import DEAD
from mechsheet.kinematics.equations import CAM, FORCES, INNER, RATES
from mechsheet.kinematics.numeric import value
from mechsheet.model import ENERGY
from mechsheet.sheet.plan import Plan

EDGE = 1e-6
"""By so much the sine may be rounded where it decides whether a row has velocities."""


class Steepness:
    """The rows of a workbook.

    sine  the least sine of the angle at which a group is driven, at most 1
    """

    def __init__(self, plan: Plan, known: Mapping[str, Array]) -> None:
        self.plan = plan
        self.sine = np.ones(plan.rows)
        self._dead: dict[str, int] = {}
        for equation in plan.equations.equations.columns:
            if equation.role == "coefficient" and equation.exists:
                self._dead[equation.symbol] = equation.group
                names = {name for each in equation.exists for name in (*symbols(each.margin), *symbols(each.least))}
                there = {name: known[name] for name in names}
                with np.errstate(all="ignore"):
                    for each in equation.exists:
                        ratio = np.abs(value(each.margin, there) / value(each.least, there)) * DEAD
                        self.sine = np.fmin(self.sine, ratio)
        self._reads = self._readers()
        follower = plan.mechanism.follower
        self._of_follower = set() if follower is None else {*follower.by_angle, *follower.by_time}

    def _readers(self) -> dict[str, bool]:
        """Rates, and outputs that read them -> whether they depend on a group that has dead centres."""
        found: dict[str, bool] = {}
        roles = {equation.symbol: equation.role for equation in self.plan.equations.equations.columns}
        for equation in self.plan.equations.equations.columns:
            of_rates = [name for name in equation.reads if name in found]
            if equation.role in (*RATES, *FORCES) or (equation.role == "output" and of_rates):
                dead = equation.symbol in self._dead or any(found[name] for name in of_rates)
                found[equation.symbol] = dead
        return {symbol: dead for symbol, dead in found.items() if roles[symbol] not in INNER}

    def concerns(self, symbol: str) -> bool:
        """True for velocities, accelerations and forces, and outputs of them."""
        return symbol in self._reads

    def at_all(self, symbol: str) -> bool:
        """True for one that certainly has no number where the first of all groups is at a dead centre."""
        return self._reads[symbol] and len(self._dead) == 1

    def scale(self, symbol: str, solution: reference.Solution, found: Mapping[str, Array]) -> Array:
        """What a difference is measured by: the driver's own rate, as a length where it is one; the largest joint force."""
        mechanism = self.plan.mechanism
        equation = self.plan.equations.of(symbol)
        if equation.unit.kind in ("force", "moment") and equation.role == "force":
            return self._largest(equation.unit.kind, solution, found)
        if equation.unit.kind == "power":
            effort = self.plan.equations.of(self.plan.efforts[0]).unit.kind
            largest = self._largest(effort, solution, found)
            return np.maximum(largest * np.abs(found[mechanism.driver_rates[0]]), 1e-300)
        size = solution.size or 1.0
        if symbol in self._of_follower:  # short segments have large derivatives, which are as exact as their largest
            return np.full(self.plan.rows, max(float(np.nanmax(np.abs(found[symbol]))), 1e-300))
        if equation.group == CAM:
            return _of_cam(symbol, equation.unit.kind, np.abs(np.nan_to_num(found[symbol])), size)
        if equation.role == "output" or mechanism.driver.speed is None:
            return np.ones(self.plan.rows)
        speed, acceleration = (np.abs(found[name]) for name in mechanism.driver_rates)
        if mechanism.given_by_row:  # the driver may come to rest: measured by what it does elsewhere
            speed, acceleration = (np.full(self.plan.rows, np.nanmax(each)) for each in (speed, acceleration))
        if mechanism.driver.joint:
            speed, acceleration = speed / size, acceleration / size
        jerk = speed**3 + 3 * speed * acceleration
        rate = (np.ones(self.plan.rows), speed, speed**2 + acceleration, jerk)[equation.unit.per]
        return np.maximum(rate * (size if equation.unit.kind == "length" else 1.0), 1e-300)

    def apart(
        self, symbol: str, ours: Array, solution: reference.Solution, found: Mapping[str, Array], elsewhere: Mask
    ) -> Array:
        """How far a rate is from the reference's, without what is no fault.

        elsewhere  rows in which sheet and reference stand in two assemblies, both right: nothing can be compared
        """
        theirs = np.asarray(found[symbol], float)
        with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
            apart = np.abs(ours - theirs) / (self.scale(symbol, solution, found) + np.abs(theirs)) * self.sine**2
        missing = np.isnan(ours)
        fine = missing & (np.isnan(theirs) | (self.sine < DEAD * (1 + EDGE)))
        fine |= ~solution.exists | elsewhere  # what does not depend on the group that comes apart goes on
        fine |= ~missing & (ours == theirs)
        if self._of_forces(symbol):
            fine |= _loads_leap(solution, found) & np.isfinite(ours)
        wrong = np.isnan(apart) | (~missing & (self.sine < DEAD * (1 - EDGE)) & self.at_all(symbol))
        return np.where(fine, 0.0, np.where(wrong, math.inf, apart))

    def _of_forces(self, symbol: str) -> bool:
        """True for a force, and for an output of forces."""
        equation = self.plan.equations.of(symbol)
        return equation.role in FORCES or any(
            self.plan.equations.of(name).role in FORCES for name in equation.reads if name in self._reads
        )

    def energy_apart(self, ours: Array, solution: reference.Solution, found: Mapping[str, Array]) -> Array:
        """The same of the flywheel's energy: a sum over rows, measured by the largest torque over a radian."""
        theirs, largest = found[ENERGY], self.scale(self.plan.efforts[0], solution, found)
        apart = np.abs(ours - theirs) / np.max(largest) * np.min(self.sine) ** 2
        return np.where(np.isnan(ours) & np.isnan(theirs), 0.0, np.where(np.isnan(apart), math.inf, apart))

    def _largest(self, kind: str, solution: reference.Solution, found: Mapping[str, Array]) -> Array:
        """Of each row the largest force, as a torque at the largest length where that is asked for; all torques, too."""
        dynamics = self.plan.mechanism.dynamics
        metre = (dynamics.metre if dynamics else None) or 1.0
        lever = metre * (solution.size or 1.0)
        forces, torques = np.zeros(self.plan.rows), np.zeros(self.plan.rows)
        for equation in self.plan.equations.equations.columns:
            if equation.role == "force" and equation.symbol in found:
                size = np.nan_to_num(np.abs(found[equation.symbol]))
                if equation.unit.kind == "force":
                    forces = np.maximum(forces, size)
                elif equation.unit.kind == "moment":
                    torques = np.maximum(torques, size)
        # a joint that is pressed by couples alone has forces of their size over the lever, and the other way round
        largest = np.maximum(forces * lever, torques) if kind == "moment" else np.maximum(forces, torques / lever)
        return np.maximum(largest, 1e-300)


def _loads_leap(solution: reference.Solution, found: Mapping[str, Array]) -> Mask:
    """Rows in which rounding decides how large a load is: a cutting force that ends where the velocity is 0, at its dead
    centre. Either answer is right there."""
    leaps = np.zeros(len(solution.driver), dtype=bool)
    known: dict[str, Any] = {**solution.dimensions, **found}
    for tree in _steps(solution):
        with np.errstate(all="ignore"):
            own = np.asarray(value(tree, known), float)
            far = JUMP * np.nanmax(np.abs(own), initial=0.0)
            for name in symbols(tree):
                hair = HAIR * np.nanmax(np.abs(known[name]), initial=0.0)
                for off in (-hair, hair):
                    other = np.asarray(value(tree, {**known, name: known[name] + off}), float)
                    leaps |= np.abs(other - own) > far
    return leaps


def _steps(solution: reference.Solution) -> Iterator[Node]:
    """The parts of loads that are not steady: those with a sign or a choice."""
    dynamics = solution.mechanism.dynamics
    for load in dynamics.loads if dynamics else ():
        for tree in (*(load.force or ()), load.torque):
            if tree is not None and any(isinstance(part, Call) and part.name in ("IF", "SIGN") for part in walk(tree)):
                yield tree


def _of_cam(symbol: str, kind: str, theirs: Array, size: float) -> Array:
    """What a difference of a cam's column is measured by: lengths by the size, a radius of curvature as its curvature."""
    if symbol == "rho":
        return np.asarray((theirs + size) ** 2 / size)
    return np.full(len(theirs), size if kind == "length" else 1.0 / size if symbol == "kappa" else 1.0)
