"""What a solution says by symbol: its variables, what is found from all links together, and the outputs asked for.

power           effort times the driver's velocity
shaking force   - d/dt of the momentum, sum of m v_G
shaking moment  - d/dt of its moment about the origin, sum of G x m v_G + J omega
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from livesheet.formula.nodes import symbols

from ..model import ENERGY, SHAKING, center_symbol, pair_symbol
from .cams import profile
from .driving import driver_rates
from .expressions import column
from .forces import Applied, forces
from .geometry import Array
from .rates import by_time
from .solution import Solution, motion_of, over_all_rows

WHOLE = 1e-9
"""So many turns from a whole number is rounding."""


def further(solution: Solution) -> dict[str, Array]:
    """Velocities, accelerations, forces, power, shaking force, mass centres: by name (n,); NaN in rows that do not exist."""
    held = forces(solution)
    cam = solution.mechanism.cam
    shape = {} if cam is None else profile(solution, cam).columns
    return by_time(solution) | shape | held | _wholes(solution, held) | _energy(solution, held)


def _energy(solution: Solution, held: dict[str, Array]) -> dict[str, Array]:
    """What a flywheel has given since the first row: the work beyond that of the mean torque, by trapezia.

    Only over whole turns at a constant speed is it stored and given back; else there is none.
    """
    mechanism = solution.mechanism
    if mechanism.flywheel is None:
        return {}
    given = driver_rates(mechanism, solution.dimensions, solution.driver)
    speed, acceleration = (given[name] for name in mechanism.driver_rates)
    turns = abs(solution.driver[-1] - solution.driver[0]) / math.tau
    whole = round(turns) >= 1 and abs(turns - round(turns)) < WHOLE
    if not whole or np.any(acceleration != 0.0) or np.any(speed != speed[0]) or speed[0] == 0.0:
        return {ENERGY: np.full(len(solution.driver), np.nan)}
    torque, steps = held[_effort(solution)], np.diff(solution.driver)
    work = np.concatenate([[0.0], np.cumsum((torque[1:] + torque[:-1]) / 2 * steps)])
    turned = solution.driver - solution.driver[0]
    return {ENERGY: work - work[-1] / turned[-1] * turned}


def _wholes(solution: Solution, held: dict[str, Array]) -> dict[str, Array]:
    mechanism, dynamics = solution.mechanism, solution.mechanism.dynamics
    if dynamics is None:
        return {}
    rows = np.flatnonzero(solution.exists)
    applied = Applied(solution, dynamics, rows)
    scale, origin = applied.built.scale, applied.built.origin
    timed = mechanism.driver.speed is not None
    found: dict[str, Array] = {}
    shaking = np.zeros((3, len(rows)))
    for mass in dynamics.masses:
        if mass.mass is not None:
            axes = applied.place(mass.link, mass.center)
            at = np.array([applied.coordinate(axis) for axis in axes]) * scale + origin[:, None]
            moved = [applied.moved(axis) for axis in axes]
            velocity = (
                np.array([np.einsum("mc,mc->m", along, applied.first) * applied.speed for along, _ in moved]) * scale
            )
            acceleration = np.array([second for _, second in moved]) * scale
            weight = applied.values(mass.mass) * applied.metre
            shaking[:2] -= weight * acceleration
            shaking[2] -= weight * applied.metre * (at[0] * acceleration[1] - at[1] * acceleration[0])
            if not isinstance(mass.center, str):
                name = center_symbol(applied.links[mass.link].number)
                found |= {f"{name}.x": at[0], f"{name}.y": at[1]}
                for letter, (x, y) in (("v", velocity), ("a", acceleration)) if timed else ():
                    found |= {f"{name}.{letter}x": x, f"{name}.{letter}y": y, f"{name}.{letter}": np.hypot(x, y)}
        if mass.inertia is not None:
            shaking[2] -= applied.values(mass.inertia) * applied.moved(applied.turn(mass.link))[1]
    if timed:
        found |= dict(zip(SHAKING, shaking, strict=True))
        found["power"] = (
            held[_effort(solution)][rows] * applied.speed * (applied.unit if mechanism.driver.joint else 1.0)
        )
    return {name: over_all_rows(solution, rows, values) for name, values in found.items()}


def _effort(solution: Solution) -> str:
    """The name of the driver's effort."""
    driver, numbers = solution.mechanism.driver, {link.name: link.number for link in solution.mechanism.links}
    if driver.joint:
        joint = next(joint for joint in solution.mechanism.joints if joint.name == driver.joint)
        return f"{pair_symbol('F', numbers[joint.on], numbers[joint.link])}.t"
    return pair_symbol("T", numbers[driver.relative_to or solution.mechanism.ground.name], numbers[driver.link])


POLE = 1e9
"""An output of so many times its unit (or the size, of a length) is one only because rounding has missed a pole."""


def variables(solution: Solution) -> dict[str, Array]:
    """Every variable and output over the sweep by its symbol: theta1N, displacements, the driver, `P.x`, `P.y`, outputs.

    NaN in rows that do not exist, except for the driver.
    """
    found = motion_of(solution, solution.poses, solution.displacements, solution.points)
    for symbol, result in outputs(solution, found).items():
        result[~solution.exists] = np.nan
        found[symbol] = result
    return found


def outputs(solution: Solution, found: Mapping[str, Array]) -> dict[str, Array]:
    """The outputs, for any values of the variables (`found`, as `variables` names them)."""
    values: dict[str, Array] = {name: np.array(value) for name, value in solution.dimensions.items()} | dict(found)
    own = {output.symbol for output in solution.mechanism.outputs}
    if not {name for output in solution.mechanism.outputs for name in symbols(output.formula)} <= values.keys() | own:
        values = further(solution) | values
    results: dict[str, Array] = {}
    for output in solution.mechanism.outputs:
        results[output.symbol] = values[output.symbol] = column(output.formula, values, len(solution.driver))
    return results
