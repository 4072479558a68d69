"""What the tests of all kinds share: the mechanisms, and arrays compared with the reference."""

import math

import numpy as np

from chosen import first, some
from folders import TEMPLATE_FILES
from mechsheet import reference
from mechsheet.description import load, loads
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.sweep import rough_poses
from random_mechanisms import Grower

SEEDS = range(700, 710)

DEAD_CENTRE, CLOSED = 1e-6, 1e-11
"""At a dead centre a position is as uncertain as the square root of rounding, if it closes the loops to rounding."""


def mechanisms(turn):
    """Templates, all of them in a full run, and random linkages of all dyads, by a name that is an identifier."""
    found = {path.stem.replace("-", "_"): load(path) for path in some(TEMPLATE_FILES, turn)}
    return found | {f"random_{seed}": loads(Grower(seed, 1 + seed % 6).text(13)) for seed in first(SEEDS, 4)}


def worst_against_reference(mechanism, found, dimensions=None, modes=None):
    """The largest difference, as a part of the size (angles in radians); infinite where only one has a number.

    found  {symbol: array} in internal units, the driver among them
    """
    driver = np.asarray(found[mechanism.driver.symbol], float)
    equations = solve(mechanism)
    modes = {group.mode: group.mode_value for group in equations.groups if group.mode} | (modes or {})
    start = rough_poses(mechanism, solve(mechanism, modes))
    solution = reference.solve(mechanism, dimensions, start=start, values=driver)
    theirs = reference.further(solution) | reference.variables(solution)
    if equations.efforts:  # the same by virtual work
        theirs[equations.efforts[1]] = theirs[equations.efforts[0]]
    residual, _ = reference.worst(
        reference.residuals(mechanism, solution.dimensions, complete(mechanism, found, theirs))
    )
    closed = np.nan_to_num(residual, nan=math.inf) < CLOSED * solution.size
    worst = 0.0
    for symbol, values in found.items():
        gap = np.asarray(values, float) - theirs[symbol]
        unit = "angle" if symbol == mechanism.driver.symbol else equations.of(symbol).unit.kind
        if symbol != mechanism.driver.symbol and equations.of(symbol).unit.per:
            unit = "rate"
        if symbol != mechanism.driver.symbol and (equations.of(symbol).role == "force" or unit == "rate"):
            gap = gap / max(1.0, float(np.nanmax(np.abs(theirs[symbol]))))
        elif symbol == mechanism.driver.symbol:
            gap = gap / (1.0 if mechanism.driver.unit.kind == "angle" else solution.size)
        elif unit == "angle":
            gap = np.remainder(gap + math.pi, math.tau) - math.pi
        elif unit == "length":
            gap = gap / solution.size
        else:
            gap = gap / np.maximum(1.0, np.abs(theirs[symbol]))
        gap = np.where(np.isnan(values) & np.isnan(theirs[symbol]), 0.0, np.abs(gap))
        gap = np.where(np.isnan(gap), math.inf, gap)
        gap = np.where(closed & (gap < DEAD_CENTRE), 0.0, gap) if (gap > 1e-9).any() else gap
        worst = max(worst, float(gap.max()))
    return worst


def complete(mechanism, found, theirs):
    """The arrays, with the fixed points that programs do not hand back."""
    fixed = {f"{point}.{axis}" for point in mechanism.ground.points for axis in "xy"}
    return {symbol: theirs[symbol] for symbol in fixed} | found


def leaping_angles(mechanism, found):
    """Angles that leap by a whole turn from one row to the next: where the arctangent has its cut, the turns were not
    counted. (By half a turn a slotted link may well leap, where the pin passes its centre.)"""
    steps = {link.angle_symbol: np.abs(np.diff(found[link.angle_symbol])) for link in mechanism.links[1:]}
    return [symbol for symbol, step in steps.items() if (step > 1.5 * math.pi).any()]
