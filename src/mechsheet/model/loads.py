"""What forces come from: masses, loads and springs, and the units that they are given in."""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.formula.nodes import Node

from .symbols import GivenPoint


@dataclass(frozen=True, slots=True)
class Mass:
    """What a link weighs.

    mass     [kg] or the description's unit;  None for a link that has a moment of inertia alone
    center   one of the link's points by name, or a place in its frame
    inertia  about the mass centre [kg m²]; None where it counts as 0
    assumed  whether the description does not say the inertia of a link that turns: its cell has 0
    """

    link: str
    mass: Node | None
    center: str | GivenPoint
    inertia: Node | None
    assumed: bool = False


@dataclass(frozen=True, slots=True)
class Load:
    """A force at a point of a link, or a torque on it: expressions over dimensions, positions and rates.

    order    its number in the file, from 0
    force    components [N] in the ground's frame, or in the link's own where `in_link`; None for a torque [N m]
    point    one of the link's points by name, or a place in its frame; "" for a torque
    """

    name: str
    order: int
    link: str
    point: str | GivenPoint = ""
    force: tuple[Node, Node] | None = None
    torque: Node | None = None
    in_link: bool = False


@dataclass(frozen=True, slots=True)
class Spring:
    """A spring and damper between two points: it pulls with stiffness (L - free length) + damping L'.

    ends     (link, point) of both; the ground may be one
    """

    name: str
    order: int
    ends: tuple[tuple[str, str], tuple[str, str]]
    stiffness: Node
    free_length: Node
    damping: Node

    @property
    def hold(self) -> str:
        """What the free length is called with which it just holds the follower of a cam."""
        return f"{self.name}.hold"


def torque_unit(force_unit: str, metre: float | None, length_unit: str) -> str:
    """The unit of a torque: N m, or that of a force times the description's own lengths."""
    return f"{force_unit} {length_unit if metre is None else 'm'}"


@dataclass(frozen=True, slots=True)
class Dynamics:
    """What forces come from.

    gravity  its acceleration in the ground's frame
    metre    metres in a length unit, where masses are in kg, forces in N and torques in N m; None where all units are
             the description's own and consistent
    """

    masses: tuple[Mass, ...]
    loads: tuple[Load, ...]
    gravity: tuple[Node, Node]
    metre: float | None
    springs: tuple[Spring, ...] = ()
    force_unit: str = "N"
    mass_unit: str = "kg"


def energy_unit(dynamics: Dynamics, length_unit: str) -> str:
    """J, or a force times a length in the description's own units."""
    return "J" if dynamics.metre is not None else f"{dynamics.force_unit} {length_unit}"


def inertia_unit(dynamics: Dynamics, length_unit: str) -> str:
    """kg m², or in the description's own units; without a mass nobody has said what masses are called."""
    if dynamics.metre is not None:
        return "kg m²"
    return inertia_label(dynamics.mass_unit or f"{dynamics.force_unit} s²/{length_unit}", length_unit)


def inertia_label(mass_unit: str, length_unit: str) -> str:
    """A mass times a length squared: lb ft², but lbf in s² for lbf s²/in times in²."""
    force, of_force, rest = mass_unit.partition(f" s²/{length_unit}")
    return f"{force} {length_unit} s²" if of_force and not rest else f"{mass_unit} {length_unit}²"
