"""What is found from all links together: the driver's effort by virtual work, and what somebody asks for.

    effort     -sum of (F . X' + T theta'): what weights, forces of inertia and loads do while the driver moves by a little
    power      effort times the driver's velocity
    shaking    - sum of m a_G, and its moment about the ground's origin, - sum of G x m a_G + J alpha: what inertia exerts on
               the ground, weights and loads apart
    G3.vx ...  velocity and acceleration of a mass centre that is no point of its own
    flywheel   how large it must be for what the torque's deviations from its mean store and give back in a turn

A prime is the derivative by the driver's variable. The efforts of further drivers are among the F and T; a cam's force does
no work on cam and follower together. Forces act at their own places, not in the sums that the reactions are found from: a
second way to the same number.
Sources: d'Alembert's principle; Soeylemez, Mechanisms, chapter 5; Norton, Design of Machinery, chapter 11.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.formula.vectors import Vector, cross, size, times
from livesheet.said import Words
from mechsheet.dynamics.acting import ActingForces
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.model import SHAKING, Mass, Mechanism, center_symbol
from mechsheet.units import LENGTH, Unit
from mechsheet.words.equations import link_words, phrase


class Wholes:
    """Of one mechanism, all of whose forces are written down."""

    def __init__(self, acting: ActingForces) -> None:
        self.acting, self.columns, self.motions = acting, acting.columns, acting.found.rates.by_time
        self.mechanism = acting.poses.mechanism
        self.own = {*(dim.symbol for dim in self.mechanism.dimensions), *(out.symbol for out in self.mechanism.outputs)}

    def write(self, effort: str) -> None:
        """Write down what is asked for; `effort` is the driver's."""
        if self.motions is None:
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
        motions, asked = self.motions, self.columns.asked
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


# --- the effort by virtual work ----------------------------------------------------------------------------

LONGEST, AROUND = 250, 12
"""Characters of the formula, as of any in a table, and of what stands around its two sums: `-(metre*()+)`. What couples do
has half of it at most, what forces do all that is left."""


def own_works(
    acting: ActingForces,
    moved: Callable[[str, Vector], Vector],
    turned: Callable[[str], Node],
) -> tuple[list[Node], list[Node]]:
    """What weights, forces of inertia, loads and springs do, and what couples do: their terms.

    moved   how the place of a link moves that is at some coordinates;  turned  how a link turns
    """
    works: list[Node] = []
    turnings: list[Node] = []
    for link in acting.poses.mechanism.links[1:]:
        own = acting.of(link.name)
        for force in own.forces[: own.own[0]]:
            works += [al.mul(part, way) for part, way in zip(force.vector, moved(link.name, force.at), strict=True)]
        turnings += [al.mul(couple, turned(link.name)) for couple in own.couples[: own.own[1]]]
    return works, turnings


def effort_by_work(acting: ActingForces, efforts: Mapping[str, str]) -> None:
    """Write the driver's effort down, beside the one from the reactions.

    efforts  the symbols of the efforts from the reactions, by that of what is driven: what further drivers do is known
    """
    motions, columns, mechanism = acting.motions, acting.columns, acting.poses.mechanism
    works, turnings = own_works(
        acting, lambda link, at: motions.motion[link](at).first, lambda link: motions.turning[link].first
    )
    effort = efforts[mechanism.driver.symbol]
    for driver in mechanism.drivers:
        if driver.symbol not in efforts:  # a cam moves it
            continue
        other = al.mul(Symbol(efforts[driver.symbol]), motions.rates.of_drive(driver.symbol).first)
        (works if driver.joint else turnings).append(other)
    slides = bool(mechanism.driver.joint)
    if slides:
        turnings = [al.div(turning, columns.metre) for turning in turnings]
    unit: Unit = columns.force if slides else columns.torque
    label = phrase("by_work")
    of_lengths = columns.force if slides else columns.of_lengths
    turning = columns.in_parts(al.total(turnings), unit, label, LONGEST // 2)
    room = LONGEST - AROUND - columns.lengths.of(turning)
    work = columns.in_parts(al.total(works), of_lengths, label, room)
    work = work if slides else al.mul(columns.metre, work)
    columns.written(
        f"{effort.removesuffix('.t')}.work", al.neg(al.add(work, turning)), unit, label, "work", longest=LONGEST
    )


# --- a flywheel --------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Flywheel:
    """mean  of the torque;  energy  E row by row (n,);  change: its largest less its smallest;  inertia: the moment of
    inertia that is needed. Energy in the torque's unit, inertia in that over (rad/s)^2."""

    mean: float
    energy: Array
    change: float
    inertia: float


def flywheel(mechanism: Mechanism, equations: Equations, values: Mapping[str, Array]) -> Flywheel | None:
    """What a flywheel must do; None where none is asked for.

        E(theta) = integral of (T12 - mean), by trapezia;    J = (max E - min E) / (fluctuation omega^2)

    E is what the flywheel has given: where it is largest the shaft turns slowest.

    values  of all symbols over a sweep, in internal units: the torque T12 (n,), NaN where a row has none, over the driver's
            angle (n,) [rad]; the coefficient of fluctuation and the driver's speed [rad/s]

    Where a row has no torque nothing but NaN comes out.
    """
    if mechanism.flywheel is None:
        return None
    torque, driver = values[equations.efforts[0]], values[mechanism.driver.symbol]
    work = np.concatenate([[0.0], np.cumsum((torque[1:] + torque[:-1]) / 2 * np.diff(driver))])
    mean = float(work[-1] / (driver[-1] - driver[0]))
    energy = work - mean * (driver - driver[0])
    change = float(np.ptp(energy))
    fluctuation, speed = (float(values[name][0]) for name in (mechanism.flywheel.symbol, mechanism.driver_rates[0]))
    return Flywheel(mean, energy, change, change / (fluctuation * speed**2))
