"""How far may two right answers differ: a column of cells beside the reference's.

All reasons are one: what the last digits of the numbers before may do to these. At a dead centre a position moves with the
square root of what they are off. An output is evaluated again for variables that are off by a hair, one after the other:
where it leaps to another value, to an infinite one or to none, each of these answers is as good as the other. Velocities,
accelerations and forces grow near a dead centre like 1/sin of the angle at which a group is driven, and lose digits like
1/sin^2 (`Steepness`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Call, Node, symbols, walk
from mechsheet import reference
from mechsheet.checking.comparison import TOLERANCE, Array
from mechsheet.kinematics.dyads.solved import DEAD
from mechsheet.kinematics.equations import CAM, FORCES, INNER, RATES
from mechsheet.kinematics.numeric import value
from mechsheet.model import ENERGY, Mechanism
from mechsheet.sheet.plan import Plan

Mask = NDArray[np.bool_]

DEAD_CENTRE = 1e-6
"""At a dead centre a position is as uncertain as the square root of rounding: two answers that both close the loops to
CLOSED agree when they are this near."""

CLOSED = 1e-11
"""A closure residual, as a part of the size, that is nothing but rounding."""

HAIR = 1e-12
"""How far off, as a part of the size, or in radians: a thousand times what rounding makes."""

JUMP = 1e-3
"""So many times the unit (or the size) within two hairs is a jump, as of a direction where there is none."""

REACH = 4.0
"""At the edge of a function's range, as of a root, the value itself is so many times as far away as those a hair and two
hairs inside are apart, at most."""


class Rows(NamedTuple):
    """What is known of the rows of a column.

    goes_on  it depends on no group that comes apart
    closed   the cells' positions close every loop, and rounding may have moved them
    beyond   behind a gap the cells may follow another assembly; None: there is no such row
    """

    goes_on: Mask
    closed: Mask
    beyond: Mask | None = None


def apart_from(
    plan: Plan,
    symbol: str,
    ours: Array,
    solution: reference.Solution,
    found: Mapping[str, Array],
    rows: Rows,
    turns: bool,
) -> Array:
    """How far the cells of a column are from the reference (its variables and outputs: `found`), without what is no fault.

    In internal units, NaN where there is no number; `turns`: whole turns make no difference to an angle.
    """
    theirs, missing = np.asarray(found[symbol], float), np.isnan(ours)
    unknown = np.isnan(theirs)
    scale, is_angle, is_output = scale_of(plan, symbol, solution)
    apart = apart_of(ours, theirs, turns and is_angle, scale or np.maximum(1.0, np.abs(theirs)))
    # in a row that does not exist, the sheet goes on with what does not depend on the group that comes apart
    fine = (missing & unknown) | (~solution.exists & (missing | (unknown & rows.goes_on)))
    apart = np.where(fine, 0.0, np.where(np.isnan(apart), math.inf, apart))
    near = apart <= DEAD_CENTRE
    at_dead_centre = rows.closed & (near if rows.beyond is None else near | rows.beyond)
    apart = np.where(at_dead_centre, np.minimum(apart, TOLERANCE), apart)
    if is_output and (apart > TOLERANCE).any():
        steep = given_by_rounding(solution, found, symbol, ours, scale or 1.0)
        apart = np.where((apart > TOLERANCE) & steep, 0.0, apart)
    return apart


def scale_of(plan: Plan, symbol: str, solution: reference.Solution) -> tuple[float | None, bool, bool]:
    """What a difference is a part of: the size of the mechanism, of an angle a radian, None: the value itself; whether it is
    an angle, and an output."""
    mechanism = plan.mechanism
    unit = plan.unit_of(symbol)
    is_angle = unit.kind == "angle" and not unit.per
    is_output = any(output.symbol == symbol for output in mechanism.outputs)
    if is_angle:
        return 1.0, is_angle, is_output
    own = is_output or symbol in mechanism.given_by_row
    return (solution.size if unit.kind == "length" or not own else None), is_angle, is_output


def closed_rows(
    mechanism: Mechanism, solution: reference.Solution, ours: Mapping[str, Array], beyond: Mask | None = None
) -> Mask:
    """Rows in which our positions close every loop to rounding: there a larger difference is a dead centre's uncertainty.

    Of rows `beyond`, in which a group may stand in another assembly and those after it come apart, what is shown counts.
    """
    found = reference.residuals(mechanism, solution.dimensions, ours)
    worst = np.nan_to_num(reference.worst(found)[0], nan=math.inf)
    if beyond is not None:
        shown = np.nan_to_num(np.abs(np.stack(np.broadcast_arrays(*found.values()))), nan=0.0).max(axis=0)
        worst = np.where(beyond, shown, worst)
    closed: Mask = worst < CLOSED * max(solution.size, 1e-300)
    return closed


def apart_of(ours: Array, theirs: Array, turns: bool, scale: float | Array) -> Array:
    """How far two columns are apart, row by row: as a part of the scale; of one that `turns`, but for whole turns [rad]."""
    with np.errstate(invalid="ignore"):
        gap = ours - theirs
        return np.abs(np.remainder(gap + math.pi, math.tau) - math.pi) if turns else np.abs(gap / scale)


def given_by_rounding(
    solution: reference.Solution, found: Mapping[str, Array], symbol: str, ours: Array, scale: float
) -> Mask:
    """Rows in which the value `ours` (NaN: an error) of an output is one of those that rounding may give.

    found  the reference's variables and outputs;  scale  what a difference of this output is compared with
    """
    near = _near(solution, found, symbol)
    far = reference.POLE * scale
    with np.errstate(all="ignore"):
        tame = np.where(np.abs(near) < far, near, np.nan)  # neither a pole nor without a value
        low, high = np.fmin.reduce(tame), np.fmax.reduce(tame)
        room = REACH * (high - low)
        within = (ours >= low - room) & (ours <= high + room)
        pole = (np.abs(near) >= far).any(axis=0)
        nothing = pole | ~np.isfinite(near).all(axis=0) | (high - low > JUMP * scale)
        return np.asarray(np.where(np.isnan(ours), nothing, within | (pole & (np.abs(ours) >= far))), bool)


def _near(solution: reference.Solution, found: Mapping[str, Array], symbol: str) -> Array:
    """(k, n) values of an output: the reference's own, and with each variable off by one and two hairs either way.

    Rows that do not exist have NaN, which is within nothing.
    """
    mechanism = solution.mechanism
    own = {output.symbol for output in mechanism.outputs}
    angles = {link.angle_symbol for link in mechanism.links}
    if not mechanism.driver.joint:
        angles.add(mechanism.driver.symbol)
    positions = {name: column for name, column in found.items() if name not in own}
    values = [found[symbol]]
    for name, column in positions.items():
        hair = HAIR * (1.0 if name in angles else solution.size)
        for off in (-2 * hair, -hair, hair, 2 * hair):
            values.append(reference.outputs(solution, positions | {name: column + off})[symbol])
    return np.where(solution.exists, np.stack(values), np.nan)


# --- velocities, accelerations, forces -------------------------------------------------------------------------------


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
