"""Forces at the teeth of gears and racks, from the multipliers of their conditions; and what they do along the poses.

The multiplier of a gear is the torque on its `link`, that of a rack the force on the joint's link along the line. A force at
the pitch point, where the two bodies move alike, does the same work; with it the pins hold what they hold in truth. Belts,
and wheels about one axis, keep their torques.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..model import Gear, Mechanism, Rack, pair_symbol
from .expressions import number
from .geometry import Array

if TYPE_CHECKING:
    from .forces import Applied


@dataclass(frozen=True, slots=True)
class Contact:
    """A force (2, m) on a body at a place (2, m) in the system's own lengths; the opposite one on `other`."""

    body: str
    other: str
    force: Array
    at: Array


def tooth_forces(
    mechanism: Mechanism, applied: Applied, multipliers: dict[str, Array]
) -> tuple[dict[str, Array], list[Contact]]:
    """G25 and its tangential part G25.t, or the torque G25.m, by name; and the forces at the teeth.

    multipliers  of the relations, by the name of their conditions
    """
    named: dict[str, Array] = {}
    contacts: list[Contact] = []
    for order, relation in enumerate(mechanism.relations):
        effort = multipliers[f"relation {order}"]
        if isinstance(relation, Rack):
            one, other, tangent, contact = _rack(mechanism, applied, relation, effort)
        else:
            one, other = relation.on, relation.link
            found = _gear(applied, relation, effort)
            if found is None:
                named[f"{_name(mechanism, one, other)}.m"] = effort
                continue
            tangent, contact = found
        name = _name(mechanism, one, other)
        named |= {f"{name}.t": tangent, name: np.hypot(*contact.force)}
        contacts.append(contact)
    return named, contacts


def along_poses(applied: Applied, contacts: list[Contact]) -> Array:
    """What the forces at the teeth do along the poses (m, columns), as torques."""
    total: Array = np.zeros_like(applied.state)
    for contact in contacts:
        for link, sign in ((contact.body, 1.0), (contact.other, -1.0)):
            first = applied.built.column(link)
            force = sign * applied.unit * contact.force
            arm = contact.at - applied.state[:, first : first + 2].T
            total[:, first : first + 2] += force.T
            total[:, first + 2] += arm[0] * force[1] - arm[1] * force[0]
    return total


def _name(mechanism: Mechanism, one: str, other: str) -> str:
    numbers = {link.name: link.number for link in mechanism.links}
    return pair_symbol("G", numbers[one], numbers[other])


def _axis(applied: Applied, wheel: str, arm: str) -> Array:
    """Where a wheel turns on its arm (2, m)."""
    point = next(point for point in applied.links[wheel].points if point in applied.links[arm].points)
    return np.array([applied.coordinate(axis) for axis in applied.place(arm, point)])


def _gear(applied: Applied, gear: Gear, torque: Array) -> tuple[Array, Contact] | None:
    values = applied.solution.dimensions
    ratio, pressure = number(gear.ratio, values), number(gear.pressure, values)
    start, end = (_axis(applied, wheel, gear.arm) for wheel in (gear.on, gear.link))
    length = np.hypot(*(end - start))
    if gear.kind == "belt" or abs(ratio - 1) < 1e-9 or not np.all(length > 0):
        return None
    e = (end - start) / length
    n = np.array([-e[1], e[0]])
    at = start + ratio / (ratio - 1) * length * e
    tangent = torque / applied.unit * (ratio - 1) / length
    force = tangent * n - np.sign(ratio) * np.abs(tangent) * np.tan(pressure) * e
    return tangent, Contact(gear.link, gear.on, force, at)


def _rack(mechanism: Mechanism, applied: Applied, rack: Rack, effort: Array) -> tuple[str, str, Array, Contact]:
    joint = next(joint for joint in mechanism.joints if joint.symbol == rack.joint)
    bar = joint.link if rack.arm == joint.on else joint.on
    sign = 1.0 if bar == joint.link else -1.0
    values = applied.solution.dimensions
    radius = number(rack.radius, values) / applied.built.scale
    direction = applied.state[:, applied.built.column(joint.on) + 2] + number(joint.angle, values)
    d = np.array([np.cos(direction), np.sin(direction)])
    n = np.array([-d[1], d[0]])
    tangent = sign * effort / applied.unit
    push = np.abs(tangent) * np.tan(number(rack.pressure, values))
    force = tangent * d - sign * np.sign(radius) * push * n
    return (
        rack.link,
        bar,
        tangent,
        Contact(bar, rack.link, force, _axis(applied, rack.link, rack.arm) - sign * radius * n),
    )
