"""A column of cells beside the reference's: how far the two are apart, and the reasons for which that is no fault.

All of them are one: what the last digits of the numbers before may do to these. At a dead centre a position moves with the
square root of what they are off. An output is evaluated again for variables that are off by a hair, one after the other:
where it leaps to another value, to an infinite one or to none, each of these answers is as good as the other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet import reference
from mechsheet.checking.report import TOLERANCE, Array
from mechsheet.model import Mechanism
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
