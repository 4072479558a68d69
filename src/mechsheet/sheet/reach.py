"""What the first group's closing depends on, when it is one length that the driver alone decides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Node
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism
from mechsheet.sheet.lowering import Assignments

SAME = 1e-9
"""Parts of a length below this are rounding."""

ANGLES = np.pi * np.array([0.0, 0.5, 1.0, 0.2, 0.8, 1.3, 1.7])
LENGTHS = np.array([-1.0, 0.0, 1.0, 0.3, 0.7, -0.6, 2.0])
"""Values of the driver at which the form is looked at: angles; lengths in parts of the largest one."""


@dataclass(frozen=True, slots=True)
class Reach:
    """The condition for the first group to close, lo <= quantity <= hi (None: no such end), over columns and constants.

    form  "turn": quantity = A + B cos + C sin of the driver; "slide": A + B t + C t^2; "line": the same with C = 0
    """

    group: Group
    form: Literal["turn", "slide", "line"]
    quantity: Node
    lo: Node
    hi: Node | None


def reach_of(mechanism: Mechanism, equations: Assignments) -> Reach | None:
    """The condition, or None where there is none of that form: nothing depends on the driver, or more than one length."""
    group = next(iter(equations.groups), None)
    if group is None or not group.sides:
        return None
    turns = mechanism.driver.unit.kind == "angle"
    values = _Values(mechanism, equations)
    length = values.length
    driver = ANGLES if turns else LENGTHS * length
    values.take(driver)
    moving = [side for side in group.sides if float(np.ptp(values.of(side))) > SAME * length]
    if len(moving) != 1:
        return None
    quantity, lo, hi = _condition(group.sides, moving[0])
    found = values.of(quantity)
    ones = np.ones_like(driver)
    basis = np.stack((ones, np.cos(driver), np.sin(driver)) if turns else (ones, driver, driver**2), axis=1)
    coefficients, *_ = np.linalg.lstsq(basis, found, rcond=None)
    size = float(np.max(np.abs(found)))
    if not np.allclose(basis @ coefficients, found, rtol=0, atol=SAME * size):
        return None
    if turns:
        return Reach(group, "turn", quantity, lo, hi)
    if abs(coefficients[2]) * length**2 >= SAME * size:
        return Reach(group, "slide", quantity, lo, hi)
    return Reach(group, "line", quantity, lo, hi) if hi is not None else None


def _condition(sides: tuple[Node, ...], moving: Node) -> tuple[Node, Node, Node | None]:
    """(q, lo, hi) of a triangle or a right triangle of which one side moves."""
    rest = [side for side in sides if side is not moving]
    if len(sides) == 3:
        return al.square(moving), al.square(al.sub(rest[0], rest[1])), al.square(al.add(rest[0], rest[1]))
    if moving is sides[0]:  # the hypotenuse
        return al.square(moving), al.square(rest[0]), None
    return moving, al.neg(rest[0]), rest[0]


class _Values:
    """The equations at some values of the driver that are no sweep."""

    def __init__(self, mechanism: Mechanism, equations: Assignments) -> None:
        self.mechanism = mechanism
        self.equations = equations.equations
        self.take(np.zeros(1))
        self.length = float(self.known[equations.tolerance][0]) * 1e12 if equations.tolerance else 1.0

    def take(self, driver: Array) -> None:
        """Compute everything at these values of the driver."""
        self.count = len(driver)
        self.known = sweep(self.mechanism, self.equations, driver)

    def of(self, node: Node) -> Array:
        """The values of an expression."""
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(value(node, self.known), float), (self.count,))
