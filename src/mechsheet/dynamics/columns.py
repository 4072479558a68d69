"""Columns of the sheet of forces: grey ones that forces are found from, black ones that people read."""

from __future__ import annotations

from collections.abc import Sequence

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.vectors import Vector, size
from livesheet.said import Words
from mechsheet.kinematics.equations import RATES, Condition, ForceKind
from mechsheet.kinematics.poses import Poses
from mechsheet.kinematics.rates.coefficients import asked
from mechsheet.kinematics.rates.rate_columns import CellLengths
from mechsheet.model import Dynamics, torque_unit
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import phrase

LONGEST = 128
"""Characters of a formula with its blanks, which cells leave out."""


class Columns:
    """Writes them into the ledger.

    of_lengths  the unit of a force times a length
    metre       the constant that turns it into a torque; 1 where units are consistent
    """

    def __init__(self, poses: Poses, dynamics: Dynamics) -> None:
        self.poses, self.ledger = poses, poses.ledger
        self.lengths = CellLengths(poses.mechanism, poses.ledger)
        self.lengths.near = frozenset(eq.symbol for eq in poses.ledger.columns if eq.role in RATES)
        self.asked = asked(poses.mechanism)
        self.force = Unit("force", dynamics.force_unit)
        self.torque = Unit("moment", torque_unit(dynamics.force_unit, dynamics.metre, poses.mechanism.length_unit))
        self.of_lengths = Unit("moment", torque_unit(dynamics.force_unit, None, poses.mechanism.length_unit))
        self.metre: Node = al.ONE
        if dynamics.metre not in (None, 1.0):
            name = self._reserve("metre")
            label = phrase("metre", unit=poses.mechanism.length_unit)
            self.metre = self.ledger.define(name, al.number(dynamics.metre or 1.0), NUMBER, label, "constant")

    def grey(self, base: str, node: Node, unit: Unit, label: Words, own_name: bool = False) -> Node:
        """A simple expression itself; any other as a constant or a column, `base` its very name or what it is made from.

        A column of its very name is black where somebody asks for it.
        """
        if own_name and base in self.asked:
            return self.written(base, node, unit, label, "center")
        if al.is_simple(node):
            return node
        part = base.replace(".", "_")
        node = self.lengths.split(node, lambda terms: self._define(self._reserve(part), terms, unit, label), LONGEST)
        return self._define(base if own_name else self._reserve(part), node, unit, label)

    def _reserve(self, base: str) -> str:
        """A free name; links have numbers, so that no group's is added."""
        return self.ledger.reserve(base, numbered=False)

    def name(self, base: str) -> str:
        """A free name for a column of this sheet."""
        name = self._reserve(base)
        self.lengths.own.add(name)
        return name

    def pair(self, base: str, vector: Vector, unit: Unit, label: str, **parts: str | Words) -> Vector:
        """A vector, its parts as `grey` has them."""
        x, y = (
            self.grey(f"{base}_{axis}", node, unit, phrase(label, axis=axis, **parts))
            for axis, node in zip("xy", vector, strict=True)
        )
        return x, y

    def _define(self, name: str, node: Node, unit: Unit, label: Words) -> Symbol:
        constant = self.ledger.is_constant(node)
        if not constant:
            self.lengths.own.add(name)
        return self.ledger.define(name, node, unit, label, "constant" if constant else "dynamic")

    def black(self, name: str, node: Node, unit: Unit, label: Words, kind: ForceKind) -> Node:
        """A column that people read; nothing for what is always 0, unless it is asked for by name."""
        if al.is_zero(node) and name not in self.asked:
            return node
        return self.written(self._free(name), node, unit, label, kind)

    def written(
        self,
        name: str,
        node: Node,
        unit: Unit,
        label: Words,
        kind: ForceKind,
        longest: int = LONGEST,
        exists: Sequence[Condition] = (),
    ) -> Symbol:
        """A column that people read, whatever it is."""
        node = self.in_parts(node, unit, label, longest)
        self.lengths.own.add(name)
        return self.ledger.define(name, node, unit, label, "force", exists, force=kind)

    def in_parts(self, node: Node, unit: Unit, label: Words, longest: int) -> Node:
        """A sum short enough for one formula; its first terms have columns of their own where it is not."""
        return self.lengths.split(node, lambda part: self._define(self._reserve("part"), part, unit, label), longest)

    def joint_force(self, name: str, vector: Vector, label: Words) -> Vector:
        """The parts of a pin's force, and its magnitude."""
        wanted = {name, f"{name}.x", f"{name}.y"} & self.asked.keys()
        if not wanted and all(map(al.is_zero, vector)):
            return vector
        name = self._free(name)
        x, y = (
            self.written(f"{name}.{axis}", node, self.force, phrase("part_of", what=label, axis=axis), "part")
            for axis, node in zip("xy", vector, strict=True)
        )
        self.written(name, size((x, y)), self.force, label, "size")
        return x, y

    def _free(self, name: str) -> str:
        """The name, or one like it where two links have two joints with each other."""
        return self._reserve(name) if name in self.ledger.values else name
