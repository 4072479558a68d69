"""What is found from all links together, or of a mass centre, where somebody asks for it.

    power      effort times the driver's velocity
    shaking    - sum of m a_G, and its moment about the ground's origin, - sum of G x m a_G + J alpha: what inertia exerts on
               the ground, weights and loads apart
    G3.vx ...  velocity and acceleration of a mass centre that is no point of its own

Source: Norton, Design of Machinery, chapter 11.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.formula.vectors import Vector, cross, size, times
from livesheet.said import Words
from mechsheet.dynamics.acting import ActingForces
from mechsheet.kinematics.build_equations import Found
from mechsheet.model import SHAKING, Mass, center_symbol
from mechsheet.units import LENGTH, Unit
from mechsheet.words.equations import link_words, phrase


class Wholes:
    """Of one mechanism, all of whose forces are written down."""

    def __init__(self, acting: ActingForces, found: Found) -> None:
        self.acting, self.found, self.columns = acting, found, acting.columns
        self.mechanism, self.ledger = found.poses.mechanism, found.poses.ledger
        self.own = {*(dim.symbol for dim in self.mechanism.dimensions), *(out.symbol for out in self.mechanism.outputs)}

    def write(self, effort: str) -> None:
        """Write down what is asked for; `effort` is the driver's."""
        if self.found.rates.by_time is None:
            return
        if "power" in self.columns.asked and "power" not in self.own:
            self._power(effort)
        if self.columns.asked.keys() & {*SHAKING}:
            self._shaking()
        for mass in self.acting.dynamics.masses:
            if mass.mass is not None and not isinstance(mass.center, str):
                self._center(mass)

    def _power(self, effort: str) -> None:
        """In W where torques are in N m, else in the description's own units."""
        force, metric = self.acting.dynamics.force_unit, self.acting.dynamics.metre is not None
        unit = Unit("power", "W" if metric else f"{force} {self.mechanism.length_unit}/s")
        value = al.mul(Symbol(effort), Symbol(self.mechanism.driver_rates[0]))
        if self.mechanism.driver.joint:
            value = al.mul(self.columns.metre, value)
        self.columns.written("power", value, unit, phrase("power"), "whole")

    # --- the shaking force ------------------------------------------------------------------------------------

    def _shaking(self) -> None:
        """Its parts and its moment, those that are asked for."""
        found: list[Vector] = []
        moments: list[Node] = []
        couples: list[Node] = []
        for mass in self.acting.dynamics.masses:
            link = self.acting.poses.links[mass.link]
            if mass.mass is not None:
                center = self.acting.mass_centre(mass, link)
                force = times(mass.mass, self.acting.acceleration(mass, center, link))
                found.append(force)
                moments.append(cross(center, force))
            couples.append(self.acting.inertia_couple(mass))
        for axis, name, parts in zip("xy", SHAKING, zip(*found, strict=True) if found else ((), ()), strict=False):
            if name in self.columns.asked:
                self._whole(name, 1, al.total(parts), [], phrase("shaking_force", axis=axis))
        if SHAKING[2] in self.columns.asked:
            self._whole(SHAKING[2], 2, al.total(moments), couples, phrase("shaking_moment"))

    def _whole(self, name: str, lengths: int, inertia: Node, couples: list[Node], label: Words) -> None:
        """- metre^lengths times the inertia + couples, as a column; the first terms of what is long in columns of their own.

        lengths  1 for a force, 2 for a moment
        """
        columns, mass_unit, length_unit = self.columns, self.acting.dynamics.mass_unit, self.mechanism.length_unit
        unit, metre = ((columns.force, columns.metre), (columns.torque, al.square(columns.metre)))[lengths - 1]
        part = unit
        if self.acting.dynamics.metre is not None:
            part = Unit(unit.kind, f"{mass_unit} {length_unit}{'²' if lengths > 1 else ''}/s²")
        inertia = columns.lengths.split(inertia, lambda terms: columns.grey(name, terms, part, label))
        columns.written(name, al.total([al.neg(al.mul(metre, inertia)), *couples]), unit, label, "whole")

    # --- a mass centre ----------------------------------------------------------------------------------------

    def _center(self, mass: Mass) -> None:
        """Of its velocity and acceleration what is asked for; its place and the parts of the latter stand there already."""
        motions, asked = self.found.rates.by_time, self.columns.asked
        link = self.acting.poses.links[mass.link]
        name = center_symbol(link.number)
        unit, label = LENGTH.per_time(), phrase("mass_centre", link=link_words(link))
        if motions is None or not asked.keys() & {f"{name}.{part}" for part in ("vx", "vy", "v", "a")}:
            return
        center = self.acting.mass_centre(mass, link)
        if asked.keys() & {f"{name}.vx", f"{name}.vy", f"{name}.v"}:
            velocity = motions.motion[mass.link](center).first
            x, y = (
                self.columns.grey(f"{name}.v{axis}", node, unit, phrase("velocity_part", what=label, axis=axis), True)
                for axis, node in zip("xy", velocity, strict=True)
            )
            self._size(f"{name}.v", (x, y), unit, phrase("velocity_of", what=label))
        acceleration = self.acting.acceleration(mass, center, link)
        self._size(f"{name}.a", acceleration, unit.per_time(), phrase("acceleration_of", what=label))

    def _size(self, name: str, parts: Vector, unit: Unit, label: Words) -> None:
        if name in self.columns.asked:
            x, y = parts
            node = size(parts) if not (al.is_zero(x) or al.is_zero(y)) else Call("ABS", (al.add(x, y),))
            self.columns.written(name, node, unit, label, "center")
