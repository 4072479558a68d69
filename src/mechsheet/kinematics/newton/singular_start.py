"""A group that is singular in the first position: at which value of the driver near by it is not, or that it is everywhere.

Where det J = 0 Newton's method has no direction. Mostly two assemblies meet there and part beside it: then the sweep can
begin a little further on. Where it is so at neighbouring values of the driver as well, the group has a free motion left that
Gruebler's count does not see: legs that are equal and parallel in every position.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import Words, say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dyads.solved import DEAD
from mechsheet.kinematics.equations import System
from mechsheet.kinematics.modes import BetweenModesError
from mechsheet.kinematics.numeric import Array, evaluate_equation, value
from mechsheet.model import Mechanism

ASIDE = 1e-3
"""So far aside it is seen how an equation bends."""

ROWS = 3
"""So many of the next rows are tried."""

BESIDE = (0.1, -0.1, 0.01, -0.01)
"""Then values beside the first one, in parts of a step."""

STEP = math.radians(1.0), 0.01
"""What counts as a step where there is one row: of an angle; of a displacement, in parts of its size."""

FREE = 2
"""Singular at so many neighbouring values as well, before one at which it is not: the links are free to move."""


class DeadStartError(BetweenModesError):
    """Two assemblies meet in the first position: Newton's method has no direction there."""

    def __init__(self, links: Words) -> None:
        self.links = links
        super().__init__(
            Fault(
                say("two assemblies of {group} meet in the first position", group=links),
                key="driver",
                hint=say("begin the sweep at another value of the driver, or walk it the other way"),
            )
        )


def singular(
    system: System, known: Mapping[str, float], state: Sequence[float], slides: Sequence[bool], size: float
) -> bool:
    """Whether det J is 0 in a position: against the product of the sizes of its rows; of one equation, which has no other
    row to be parallel to, whether the other zero of the parabola that it is near by is as good as the same.

    Below the part DEAD of that product det J counts as 0, as in rates; so near to each other (radians, or parts of the size)
    two assemblies are one.

    state  the unknowns;  slides: which of them are displacements, which count by the size of the mechanism
    """
    scales = [size if slide else 1.0 for slide in slides]
    here, determinant = _jacobian(system, known, state)
    if len(scales) == 1:
        aside, _ = _jacobian(system, known, [state[0] + ASIDE * scales[0]])
        bend = (aside - here) / ASIDE
        return bool(2 * abs(here[0, 0]) <= DEAD * abs(bend[0, 0]))
    rows = np.abs(here * scales).sum(axis=1)
    return bool(abs(determinant) * math.prod(scales) <= DEAD * math.prod(rows))


def _jacobian(system: System, known: Mapping[str, float], state: Sequence[float]) -> tuple[Array, float]:
    """J and its determinant, as the pass has it."""
    there = {name: np.array(number) for name, number in known.items()}
    there |= {name: np.array(number) for name, number in zip(system.unknowns, state, strict=True)}
    for equation in system.body:
        there[equation.symbol] = evaluate_equation(equation, there, 1)[0]
    jacobian = np.array([[float(value(part, there)) for part in row] for row in system.jacobian])
    return jacobian, float(there[system.determinant])


def with_neighbour(
    error: DeadStartError, mechanism: Mechanism, rows: Sequence[float], try_at: Callable[[float], object]
) -> MechanismError:
    """The error that names a value of the driver at which the sweep can begin, or says that the links are free to move.

    rows  the driver's values;  try_at: solves the mechanism at one value of the driver, or raises MechanismError
    """
    refused: list[float] = []
    for at in _near(mechanism, rows):
        try:
            try_at(at)
        except DeadStartError:
            refused.append(at)
            if len(refused) == FREE:
                break
            continue
        except MechanismError:
            continue
        hint = say(
            "at {place} they are apart: begin the sweep there, or walk it the other way", place=_shown(mechanism, at)
        )
        return MechanismError(replace(error.faults[0], hint=hint))
    if len(refused) < FREE:
        return error
    message = say(
        "{group} are free to move while the driver stands: the equations are singular at {first} and at {other}",
        group=error.links,
        first=_shown(mechanism, rows[0]),
        other=_shown(mechanism, refused[0]),
    )
    hint = say("legs that are equal and parallel hold nothing: give one of them another length or place")
    return MechanismError(Fault(message, key="links", hint=hint))


def _near(mechanism: Mechanism, rows: Sequence[float]) -> list[float]:
    """Values of the driver to try, the next rows first."""
    first, following = rows[0], [row for row in dict.fromkeys(rows) if row != rows[0]][:ROWS]
    turn, part = STEP
    own = turn if mechanism.driver.link else part * (abs(first) or 1.0)
    step = following[0] - first if following else own
    return [*following, *(first + share * step for share in BESIDE)]


def _shown(mechanism: Mechanism, at: float) -> str:
    driver = mechanism.driver
    return f"{driver.symbol} = {driver.unit.to_shown(at):.6g}"
