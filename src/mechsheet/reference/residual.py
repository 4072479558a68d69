"""How well anybody's positions satisfy a mechanism: link lengths, joints and driver, straight from the model."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np

from ..model import Driver, FurtherDriver, Joint, Link, Mechanism, Rack, Relation
from . import geometry
from .expressions import number
from .geometry import Array


def residuals(
    mechanism: Mechanism, dimensions: Mapping[str, float], variables: Mapping[str, Array]
) -> dict[str, Array]:
    """Residual (n,) of every condition by its name, as lengths: what is measured minus what should be.

    dimensions  values by symbol, internal units (those not named are the mechanism's own)
    variables   theta1N, displacements, the driver, `P.x` and `P.y`, each (n,), as `reference.variables` names them

    length AB of coupler        distance of two points of a link, minus the same in the link's frame
    side of C on coupler        signed area of a triangle of the link's points over its longest side (a mirrored link fails)
    angle of coupler at B       distance of a point from where the link's angle and first point put it
    ground point A0             distance from its fixed place
    guide: on the line, angle, displacement
    driver                      angle of the driven link against the driver's value, times the size; further drivers likewise
    gear of planet              what the angles that it ties miss it by, times the size; a rack: as a length

    Angles are compared modulo a turn. Rows with NaN have NaN. Raises KeyError when a variable is missing.
    """
    numbers = geometry.dimension_values(mechanism, dimensions)
    located = geometry.points_in_links(mechanism, numbers)
    size = geometry.size(mechanism, numbers)
    judge = _Judge(mechanism, numbers, located, {name: np.asarray(v) for name, v in variables.items()}, size)
    found: dict[str, Array] = {}
    for point, place in located[mechanism.ground.name].items():
        found[f"ground point {point}"] = _norm(judge.point(point) - place)
    for link in mechanism.links[1:]:
        found.update(judge.link(link))
    for joint in mechanism.joints:
        found.update(judge.joint(joint))
    for driver in mechanism.all_drivers:
        found.update(judge.driver(driver))
    for relation in mechanism.relations:
        found.update(judge.relation(relation))
    return found


def worst(found: Mapping[str, Array]) -> tuple[Array, tuple[str, ...]]:
    """Largest residual (n,) of each row without its sign, and its condition's name ("" where the row has no numbers)."""
    names = tuple(found)
    table = np.abs(np.stack(np.broadcast_arrays(*found.values()), axis=1))
    empty = np.isnan(table).any(axis=1)
    which = np.argmax(np.where(np.isnan(table), -1.0, table), axis=1)
    largest = np.where(empty, np.nan, table[np.arange(len(table)), which])
    return largest, tuple("" if gone else names[i] for i, gone in zip(which, empty, strict=True))


class _Judge:
    """The positions under judgement and what the model says of them."""

    def __init__(
        self,
        mechanism: Mechanism,
        numbers: Mapping[str, float],
        located: geometry.PointsByLink,
        variables: Mapping[str, Array],
        size: float,
    ) -> None:
        self.mechanism, self.numbers, self.located = mechanism, numbers, located
        self.variables, self.size = variables, size
        self.angles = {link.name: link.angle_symbol for link in mechanism.links[1:]}

    def point(self, name: str) -> Array:
        return np.stack([self.variables[f"{name}.x"], self.variables[f"{name}.y"]], axis=1)

    def angle(self, link: str) -> Array:
        symbol = self.angles.get(link)
        return np.zeros(1) if symbol is None else self.variables[symbol]

    def link(self, link: Link) -> dict[str, Array]:
        found: dict[str, Array] = {}
        place, seen = self.located[link.name], {p: self.point(p) for p in link.points}
        for p, q in itertools.combinations(place, 2):
            found[f"length {p}{q} of {link.name}"] = _norm(seen[q] - seen[p]) - float(np.hypot(*(place[q] - place[p])))
        names = list(place)
        if len(names) > 1:
            far = max(names[1:], key=lambda p: float(np.hypot(*(place[p] - place[names[0]]))))
            base, seen_base = place[far] - place[names[0]], seen[far] - seen[names[0]]
            span = float(np.hypot(*base))
            for p in names[1:]:
                if p != far and span > 0:
                    area = _cross(seen_base, seen[p] - seen[names[0]]) - _cross(base, place[p] - place[names[0]])
                    found[f"side of {p} on {link.name}"] = area / span
        theta = self.angle(link.name)
        for p in names[1:]:
            wanted = seen[names[0]] + _turned(place[p] - place[names[0]], theta)
            found[f"angle of {link.name} at {p}"] = _norm(seen[p] - wanted)
        return found

    def joint(self, joint: Joint) -> dict[str, Array]:
        direction = self.angle(joint.on) + number(joint.angle, self.numbers)
        along = np.stack([np.cos(direction), np.sin(direction)], axis=1)
        away = self.point(joint.point) - self._through(joint)
        found = {
            f"{joint.name}: on the line": _cross(along, away),
            f"{joint.name}: displacement": np.sum(along * away, axis=1) - self.variables[joint.symbol],
        }
        if joint.kind == "prismatic":
            kept = self.angle(joint.link) - direction - number(joint.orientation, self.numbers)
            found[f"{joint.name}: angle"] = self.size * _within_half_turn(kept)
        return found

    def _through(self, joint: Joint) -> Array:
        """Where the point that the line passes is."""
        local = geometry.through(joint, self.located, self.numbers)
        if joint.on == self.mechanism.ground.name:
            return local[None, :]
        place = self.located[joint.on]
        if place:
            mark = next(iter(place))
            return self.point(mark) + _turned(local - place[mark], self.angle(joint.on))
        # A link that names no point has its place from the first sliding joint on it, and the others are judged by that.
        leader = next(other for other in self.mechanism.joints if other.on == joint.on)
        direction = self.angle(joint.on) + number(leader.angle, self.numbers)
        along = np.stack([np.cos(direction), np.sin(direction)], axis=1)
        base = self.point(leader.point) - self.variables[leader.symbol][:, None] * along
        between = local - geometry.through(leader, self.located, self.numbers)
        return np.asarray(base + _turned(between, self.angle(joint.on)))

    def driver(self, driver: Driver | FurtherDriver) -> dict[str, Array]:
        name = "driver" if driver is self.mechanism.driver else f"driver {driver.symbol}"
        if driver.joint:
            joint = next(joint for joint in self.mechanism.joints if joint.name == driver.joint)
            return {name: self.variables[joint.symbol] - self.variables[driver.symbol]}
        turned = self.angle(driver.link) - self.angle(driver.relative_to) - self.variables[driver.symbol]
        return {name: self.size * _within_half_turn(turned)}

    def relation(self, relation: Relation) -> dict[str, Array]:
        phase = number(relation.phase, self.numbers)
        if isinstance(relation, Rack):
            turned = self.angle(relation.link) - self.angle(relation.arm)
            way = self.variables[relation.joint] - number(relation.radius, self.numbers) * turned - phase
            return {f"rack and {relation.link}": way}
        arm = self.angle(relation.arm)
        meant = number(relation.ratio, self.numbers) * (self.angle(relation.on) - arm) + phase
        miss = _within_half_turn(self.angle(relation.link) - arm - meant)
        return {f"{relation.kind} of {relation.link} on {relation.on}": self.size * miss}


def _norm(vectors: Array) -> Array:
    return np.asarray(np.hypot(vectors[..., 0], vectors[..., 1]))


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _turned(vector: Array, angle: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]], axis=1)


def _within_half_turn(angle: Array) -> Array:
    return angle - geometry.whole_turns(angle)
