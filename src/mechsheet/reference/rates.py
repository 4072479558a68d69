"""First and second derivatives of every variable by the driver, from the constraints on link poses.

With F(q) = d e, where q are the poses, d the driver's value and e is 1 in the driven condition:

    J q' = e,    J q'' = - J' q'        J = dF/dq,   J' how it changes along q'

Source: the implicit function theorem; J' by a complex step (W. Squire, G. Trapp, "Using complex variables to estimate
derivatives of real functions", 1998), which has no rounding error of a difference.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from livesheet.formula.nodes import symbols

from ..model import Mechanism, rate_symbols
from . import further_drivers, geometry
from .driving import driver_rates
from .expressions import number
from .geometry import Array
from .segments import motion
from .solution import Solution, over_all_rows
from .system import Equation, System, residual

_STEP = 1e-30


def rates(solution: Solution) -> dict[str, tuple[Array, Array]]:
    """First and second derivative (n,), (n,) by the driver of all that `variables` gives but outputs.

    In the file's length unit and radians, by the driver's own unit of these. NaN in rows that do not exist; at a dead
    centre, where there is no derivative, numbers that are large beyond reason.
    """
    built, mechanism = solution.system, solution.mechanism
    rows = np.flatnonzero(solution.exists)
    state = solution.state[rows]
    first, second = of_poses(built, state, solution.driver[rows])
    driver_unit = built.scale if mechanism.driver.joint else 1.0

    def shown(once: Array, twice: Array, unit: float) -> tuple[Array, Array]:
        return (
            over_all_rows(solution, rows, once * unit / driver_unit),
            over_all_rows(solution, rows, twice * unit / driver_unit**2),
        )

    found: dict[str, tuple[Array, Array]] = {}
    for symbol, quantity in _quantities(built, mechanism).items():
        _, once, twice = changes(quantity, state, first, second)
        found[symbol] = shown(once, twice, 1.0 if quantity.kind == "angle" else built.scale)
    found[mechanism.driver.symbol] = (np.ones(len(solution.driver)), np.zeros(len(solution.driver)))
    for column, other in zip(built.prescribed, mechanism.drivers, strict=True):
        of_driver = shown(first[:, column], second[:, column], built.scale if other.joint else 1.0)
        found.setdefault(other.symbol, of_driver)
    return found


def by_time(solution: Solution) -> dict[str, Array]:
    """Velocities and accelerations by name: omega13, alpha13, s14.v, C.vx, C.a; and theta13.d, theta13.dd by the driver.

    In radians, the file's length unit and seconds. Nothing for a mechanism in which nobody asks for them.
    """
    mechanism = solution.mechanism
    driver = mechanism.driver
    read = {name for output in mechanism.outputs for name in symbols(output.formula)}
    follower = mechanism.follower
    if driver.speed is None and follower is None and not any(name.endswith((".d", ".dd")) for name in read):
        return {}
    slides = {joint.symbol for joint in mechanism.joints}
    derivatives = rates(solution)
    found: dict[str, Array] = {}
    for symbol, (once, twice) in derivatives.items():
        found |= {f"{symbol}.d": once, f"{symbol}.dd": twice}
    if follower is not None and follower.segments is not None:
        found[follower.by_angle[-1]] = motion(follower.segments, solution.dimensions, solution.driver)[3]
    if driver.speed is None:
        return found
    given = driver_rates(mechanism, solution.dimensions, solution.driver)
    speed, acceleration = (given[name] for name in mechanism.driver_rates)
    moved = {
        name: (once * speed, twice * speed**2 + once * acceleration) for name, (once, twice) in derivatives.items()
    }
    found |= given
    if follower is not None:
        _, twice, thrice = (found[name] for name in follower.by_angle)
        found[follower.by_time[-1]] = thrice * speed**3 + 3.0 * twice * speed * acceleration
    for symbol, pair in moved.items():
        if not symbol.endswith((".x", ".y")):
            found |= dict(zip(rate_symbols(symbol, symbol not in slides), pair, strict=True))
    for point in solution.points:
        x, y = moved[f"{point}.x"], moved[f"{point}.y"]
        for letter, first, second in (("v", x[0], y[0]), ("a", x[1], y[1])):
            found |= {f"{point}.{letter}x": first, f"{point}.{letter}y": second}
            found[f"{point}.{letter}"] = np.hypot(first, second)
    return found


def of_poses(built: System, state: Array, driver: Array) -> tuple[Array, Array]:
    """First and second derivatives (m, columns) of the state by the driver (m,), in the system's own lengths.

    A further driver whose values are listed says nothing of its motion: it counts as one that stands.
    """
    equations, unknown = built.equations, built.unknown
    driven = np.array([[float(equation.driven)] for equation in equations])
    first, second = np.zeros_like(state), np.zeros_like(state)
    given = list(built.prescribed)
    first[:, given], second[:, given] = further_drivers.derivatives(built, driver)
    whole, _ = gradients(equations, state, first)
    jacobian, besides = whole[:, :, unknown], whole[:, :, given]
    right = np.broadcast_to(driven, (*jacobian.shape[:2], 1))
    first[:, unknown] = solved(jacobian, right - besides @ first[:, given, None])
    _, turning = gradients(equations, state, first)
    second[:, unknown] = solved(jacobian, -turning @ first[:, :, None] - besides @ second[:, given, None])
    return first, second


def by_prescribed(built: System, state: Array, column: int) -> Array:
    """First derivatives (m, columns) of the state by one of its prescribed columns, while all else that is driven stands."""
    equations, unknown = built.equations, built.unknown
    first = np.zeros_like(state)
    first[:, column] = 1.0
    whole, _ = gradients(equations, state, first)
    first[:, unknown] = solved(whole[:, :, unknown], -whole[:, :, [column]])
    return first


def solved(matrix: Array, right: Array) -> Array:
    """The solutions (m, k) of m systems of equations; NaN where one is singular to the last digit."""
    try:
        return np.asarray(np.linalg.solve(matrix, right)[:, :, 0])
    except np.linalg.LinAlgError:
        found = np.full(right.shape[:2], np.nan)
        for row, (one, other) in enumerate(zip(matrix, right, strict=True)):
            with suppress(np.linalg.LinAlgError):
                found[row] = np.linalg.solve(one, other)[:, 0]
        return found


def gradients(equations: Sequence[Equation], state: Array, along: Array) -> tuple[Array, Array]:
    """Gradients (m, k, columns) of k conditions by the whole state, and how these change along a direction (m, columns).

    The change by a complex step, Im g(x + i h along) / h: no digit is lost to a difference.
    """
    moved = state + 1j * _STEP * along
    found = np.zeros((len(state), len(equations), state.shape[1]), complex)
    for i, equation in enumerate(equations):
        _, gradient = residual(equation, moved, np.zeros(len(state)))
        for slot, entry in enumerate(gradient):
            column = 3 * (equation.body if slot < 3 else equation.on) + slot % 3
            found[:, i, column if slot < 6 else equation.terms[slot - 6][0]] += entry
    return found.real, found.imag / _STEP


def changes(quantity: Equation, state: Array, first: Array, second: Array) -> tuple[Array, Array, Array]:
    """The gradient (m, columns) of a quantity, its first and its second derivative (m,), where the state has these."""
    gradient, turning = gradients([quantity], state, first)
    once = np.einsum("mkc,mc->m", gradient, first)
    twice = np.einsum("mkc,mc->m", gradient, second) + np.einsum("mkc,mc->m", turning, first)
    return gradient[:, 0], once, twice


def _quantities(built: System, mechanism: Mechanism) -> dict[str, Equation]:
    """Every variable as a condition whose residual it is, but for a constant."""
    found: dict[str, Equation] = {}
    owners = {point: link.name for link in reversed(mechanism.links) for point in link.points}
    for link in mechanism.links[1:]:
        found[link.angle_symbol] = Equation("angle", built.bodies[link.name], 0)
    for joint in mechanism.joints:
        line = built.local(joint.on, geometry.through(joint, built.points, built.dimensions))
        pin = built.local(joint.link, built.points[joint.link][joint.point])
        angle = number(joint.angle, built.dimensions)
        found[joint.symbol] = Equation(
            "displacement", built.bodies[joint.link], built.bodies[joint.on], pin, line, angle
        )
    for point, owner in owners.items():
        spot = built.local(owner, built.points[owner][point])
        found[f"{point}.x"] = Equation("meet x", built.bodies[owner], 0, spot)
        found[f"{point}.y"] = Equation("meet y", built.bodies[owner], 0, spot)
    return found
