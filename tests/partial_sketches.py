"""Random linkages of which only one to three moving points are sketched, roughly; and which assembly that means.

Which assemblies there are is asked of the reference, which knows nothing of groups and modes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from mechsheet import reference
from mechsheet.description import loads
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism, Sketch
from mechsheet.reference.geometry import points_in_links
from random_mechanisms import Body, Grower

NOISE = 0.05
"""Of the sketch, as a part of the size of the linkage: the largest distance of a point."""

CLEAR = 0.2
"""Sketched points tell the nearest assembly from another where they lie by this part of the way nearer to it than to half
way between."""

SAME = 1e-6

NEAR = 0.2
"""A linkage whose whole sketch misses every assembly of the first position by more than this was drawn elsewhere."""

Point = tuple[float, float]


class Lifted(Grower):
    """A four-bar driven by a cylinder between two of its moving links, and dyads on it."""

    def _driver(self, ground: Body) -> None:
        start, pin, meet, end = self._spot(), self._spot(), self._spot(), self._spot()
        self.start = 0.0
        crank, coupler, rocker = self._new_body(start), self._new_body(pin), self._new_body(end)
        self._point(*start, ground, crank)
        self._point(*pin, crank, coupler)
        self._point(*meet, coupler, rocker)
        self._point(*end, rocker, ground)
        moving = [crank, coupler, rocker]
        one, other = (moving[int(i)] for i in self.random.choice(3, 2, replace=False))
        foot, eye = self._near(one), self._spot()
        barrel, rod = self._new_body(foot), self._new_body(eye)
        self._point(*foot, one, barrel)
        self._point(*eye, other, rod)
        self._slide(rod, barrel, foot, eye)

    def text(self, rows: int = 3, step: float = 0.5, language: str = "en") -> str:
        joint = f'name = "cylinder"\n{self.joints[0].removeprefix("[[joints]]")}'
        length = self.sketched_symbols["s_0"]
        self.joints[0] = f"[[joints]]\n{joint}"
        head, _, tail = super().text(rows, step, language).partition("[driver]")
        tail = tail[tail.index("[assembly]") :]
        stop = length + (rows - 1) * step
        return f'{head}[driver]\njoint = "cylinder"\nstart = {length!r}\nstop = {stop!r}\nstep = {step!r}\n{tail}'


@dataclass(frozen=True)
class Case:
    """A linkage with a part of its sketch.

    places      of each assembly of the first position every point, the one that was drawn first
    sketched    names of the sketched points, of which `rough` has the places
    """

    mechanism: Mechanism
    places: list[dict[str, Point]]
    sketched: tuple[str, ...]
    rough: dict[str, Point]
    size: float

    @property
    def means(self) -> bool:
        """Whether the sketched points lie clearly nearer to the drawn assembly than to any that has them elsewhere."""
        drawn, *others = (np.array([place[name] for name in self.sketched]) for place in self.places)
        rough = np.array([self.rough[name] for name in self.sketched])
        for other in others:
            apart = np.sum((other - drawn) ** 2)
            if apart <= (SAME * self.size) ** 2:
                continue
            if np.sum((other - rough) ** 2) - np.sum((drawn - rough) ** 2) < CLEAR * apart:
                return False
        return True

    @property
    def alone(self) -> bool:
        """Whether no other assembly has the sketched points where they are drawn."""
        drawn, *others = (np.array([place[name] for name in self.sketched]) for place in self.places)
        return all(np.abs(other - drawn).max() > SAME * self.size for other in others)

    def missed(self, found: dict[str, Point], everywhere: bool = False) -> float:
        """How far a position has the sketched points, or all points, from the drawn assembly: a part of the size."""
        names = self.places[0] if everywhere else self.sketched
        return max(math.dist(found[name], self.places[0][name]) for name in names) / self.size


def linkage(seed: int, lifted: bool) -> Mechanism:
    """One with one to three dyads; `lifted`: a four-bar with a cylinder between two moving links, and up to two dyads."""
    grower = Lifted(seed, seed % 3) if lifted else Grower(seed, 1 + seed % 3)
    return loads(grower.text(3, 0.5), "partial.toml")


def case_of(mechanism: Mechanism, seed: int, noise: float = NOISE) -> Case | None:
    """One to three of its points sketched at random, in the assembly that its sketch means; None without a choice.

    That assembly is the one that has the points of the whole sketch nearest.
    """
    random = np.random.default_rng([31, seed])
    numbers = reference.dimension_values(mechanism)
    first = float(reference.driver_values(mechanism, numbers)[0])
    located = points_in_links(mechanism, numbers)
    found = [_points(poses, located) for poses in reference.assemblies(mechanism, None, first)]
    drawn = {
        name: tuple(number(part, numbers) for part in place)
        for name, place in mechanism.sketch.points.items()
        if name not in mechanism.ground.points
    }
    if len(found) < 2 or not drawn:
        return None
    found.sort(key=lambda place: sum(math.dist(place[name], spot) ** 2 for name, spot in drawn.items()))
    size = max(np.ptp([place[axis] for place in found[0].values()]) for axis in (0, 1))
    if max(math.dist(found[0][name], spot) for name, spot in drawn.items()) > NEAR * size:
        return None
    moving = [name for name in found[0] if name not in mechanism.ground.points]
    names = [str(name) for name in random.choice(moving, min(len(moving), int(random.integers(1, 4))), replace=False)]
    rough = {}
    for name in names:
        away, turn = noise * size * random.uniform(), random.uniform(0, math.tau)
        x, y = found[0][name]
        rough[name] = (x + away * math.cos(turn), y + away * math.sin(turn))
    return Case(replace(mechanism, sketch=Sketch(rough)), found, tuple(names), rough, float(size))


def _points(
    poses: dict[str, tuple[float, float, float]], located: dict[str, dict[str, np.ndarray]]
) -> dict[str, Point]:
    found = {}
    for link, points in located.items():
        x, y, angle = poses[link]
        for name, place in points.items():
            turned = complex(*place) * complex(math.cos(angle), math.sin(angle))
            found[name] = (x + turned.real, y + turned.imag)
    return found
