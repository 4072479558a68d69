"""Loop closure equations as data: vectors in complex form, one way round against the other.

sum of r e^(i theta)  (left)  =  sum of r e^(i theta)  (right)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Node, symbols


@dataclass(frozen=True, slots=True)
class Vector:
    """length e^(i angle); a displacement may be negative."""

    length: Node
    angle: Angle


@dataclass(frozen=True, slots=True)
class Loop:
    """left = right, as vectors and as ways over named points (a way and its reverse differ in sign).

    left_way, right_way  the steps of each side, from point to point
    """

    left: tuple[Vector, ...]
    right: tuple[Vector, ...]
    left_way: tuple[tuple[str, str], ...]
    right_way: tuple[tuple[str, str], ...]

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """Those of both sides."""
        return self.left + self.right

    @property
    def reads(self) -> tuple[str, ...]:
        """Every symbol in it, once."""
        nodes = (node for vector in self.vectors for node in (vector.length, vector.angle.node))
        return tuple(dict.fromkeys(name for node in nodes for name in symbols(node)))

    @property
    def gap(self) -> tuple[Node, Node]:
        """Real and imaginary part of left minus right: both are 0 where the loop closes."""

        def part(function: Callable[[Angle], Node]) -> Node:
            sides = (
                al.total(al.mul(vector.length, function(vector.angle)) for vector in side)
                for side in (self.left, self.right)
            )
            return al.sub(*sides)

        return part(al.cos), part(al.sin)


NO_LOOP = Loop((), (), (), ())
"""Of a group that is solved by other equations."""
