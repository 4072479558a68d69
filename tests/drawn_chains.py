"""Linkages with links that must be solved all at once, drawn by other means than `random_mechanisms`.

A position is drawn first: points in the plane, a body through some of them. A body that is free to move (three ways) or
hangs on a pin (one way) is then held by as many *stays* as it has ways: a leg with two pins, a block that slides, a
telescope, a pin in a slot. Gears, belts and racks are stays, too. What is written down is that drawing, unrounded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

Spot = tuple[float, float]

TIES = ("gear", "belt")
SHAPES = ("platform", "plates", "sun", "wheels", "rack", "robot")
"""Class III; class IV; a planet on an arm that is not known; two wheels, or a pinion and its rack, that are not known; a
platform between two driven links."""

STAYS = ("leg", "leg", "block", "telescope", "slot", "guide")


@dataclass
class Body:
    """A link as drawn: where its frame stands, and the points that it has, in the plane."""

    name: str
    at: Spot
    angle: float
    points: dict[str, Spot] = field(default_factory=dict)

    def own(self, spot: Spot) -> Spot:
        """A place of the plane in its frame."""
        turned = complex(spot[0] - self.at[0], spot[1] - self.at[1]) * complex(
            math.cos(self.angle), -math.sin(self.angle)
        )
        return turned.real, turned.imag


class Drawn:
    """A linkage of one of the shapes, with dyads before and behind its group now and then."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng([18, seed])
        self.shape = SHAPES[seed % len(SHAPES)]
        self.bodies: list[Body] = []
        self.joints: list[str] = []
        self.sketched: dict[str, Spot] = {}
        self.slides: dict[str, float] = {}
        self.drivers = ""
        self.ground = self.body((0.0, 0.0), 0.0, "frame")
        self.home = math.radians(float(self.random.integers(0, 360)))
        pivot = self.somewhere(40)
        self.crank = self.body(pivot, self.home, "crank")
        self.pin(pivot, self.ground, self.crank)
        self.free = [self.ground, self.crank]
        if self.random.random() < 0.3:
            self.dyad()
        getattr(self, self.shape)()
        if self.random.random() < 0.3:
            self.dyad()

    # --- places and pieces ----------------------------------------------------------------------------------------

    def number(self, low: float, high: float) -> float:
        return float(self.random.uniform(low, high))

    def somewhere(self, reach: float = 100, around: Spot = (0.0, 0.0)) -> Spot:
        return around[0] + self.number(-reach, reach), around[1] + self.number(-reach, reach)

    def on(self, body: Body) -> Spot:
        """A place that a body may have a pin at: near its own pins; of the crank at a fair radius."""
        if body is self.crank:
            turn, length = self.number(0, math.tau), self.number(10, 30)
            return body.at[0] + length * math.cos(turn), body.at[1] + length * math.sin(turn)
        return self.somewhere(60, body.at if body is not self.ground else (0.0, 0.0))

    def body(self, near: Spot, angle: float | None = None, name: str = "") -> Body:
        """A new link; its frame stands beside a place."""
        at = near if angle is not None else self.somewhere(15, near)
        angle = self.number(-3, 3) if angle is None else angle
        found = Body(name or f"part{len(self.bodies)}", at, angle)
        self.bodies.append(found)
        return found

    def pin(self, spot: Spot, *bodies: Body) -> str:
        """A point that some bodies share, sketched."""
        name = f"K{len(self.sketched)}"
        self.sketched[name] = spot
        for body in bodies:
            body.points[name] = spot
        return name

    def slide(self, kind: str, mover: Body, carrier: Body, spot: Spot, through: Spot) -> str:
        """`spot` of one body on the line of another through a place."""
        point, symbol = self.pin(spot, mover), f"d{len(self.joints)}"
        direction = math.atan2(spot[1] - through[1], spot[0] - through[0])
        self.slides[symbol] = math.dist(spot, through)
        turned = f", orientation = {math.degrees(mover.angle - direction)!r}" if kind == "prismatic" else ""
        self.joints.append(
            f'{{ type = "{kind}", link = "{mover.name}", on = "{carrier.name}", point = "{point}", '
            f"through = {[*carrier.own(through)]!r}, angle = {math.degrees(direction - carrier.angle)!r}{turned}, "
            f'symbol = "{symbol}" }}'
        )
        return symbol

    def tie(self, link: Body, on: Body, arm: Body) -> None:
        """A gear or belt that fits the drawing."""
        ratio = float(self.random.choice([-2, -1.5, -1, -0.5, 0.75, 2]))
        phase = link.angle - arm.angle - ratio * (on.angle - arm.angle)
        self.joints.append(
            f'{{ type = "{self.random.choice(TIES)}", link = "{link.name}", on = "{on.name}", arm = "{arm.name}", '
            f"ratio = {ratio!r}, phase = {math.degrees(phase)!r} }}"
        )

    def stay(self, one: Body, other: Body, kind: str = "") -> None:
        """Takes one way to move of `other` against `one`."""
        here, there = self.on(one), self.on(other)
        match kind or str(self.random.choice(STAYS)):
            case "leg":
                leg = self.body(here)
                self.pin(here, one, leg)
                self.pin(there, leg, other)
            case "block":
                block = self.body(there)
                self.slide("prismatic", block, one, there, here)
                self.pin(there, block, other)
            case "telescope":
                leg = self.body(here)
                self.pin(here, one, leg)
                self.slide("prismatic", leg, other, self.somewhere(10, here), there)
            case "slot":
                self.slide("pin-slot", one, other, here, there)
            case "guide":
                self.slide("pin-slot", other, one, there, here)

    def dyad(self) -> None:
        """Two links between two that are there."""
        ends = self.random.choice(len(self.free), 2, replace=False)
        meet = self.somewhere()
        for end in ends:
            foot = self.on(self.free[int(end)])
            link = self.body(foot)
            self.pin(foot, self.free[int(end)], link)
            self.free.append(link)
        self.pin(meet, *self.free[-2:])

    def held(self) -> Body:
        """A body that is solved before the group."""
        return self.free[int(self.random.integers(len(self.free)))]

    # --- shapes ---------------------------------------------------------------------------------------------------

    def platform(self) -> None:
        middle = self.body(self.somewhere())
        second, third = self.held(), self.held()
        for one in (self.crank, self.ground if second is third is self.crank else second, third):
            self.stay(one, middle)
        self.free.append(middle)

    def robot(self) -> None:
        pivot = self.somewhere(60)
        second = self.body(pivot, math.radians(float(self.random.integers(-90, 90))), "second")
        self.pin(pivot, self.ground, second)
        slope = float(self.random.choice([-1, 0.5, 2]))
        follows = f"{slope!r}*theta12 + {second.angle - slope * self.home!r}"
        self.drivers = f'[[drivers]]\nlink = "second"\nfollows = "{follows}"\n'
        middle = self.body(self.somewhere())
        for one in (self.crank, second, self.ground):
            self.stay(one, middle)
        self.free.append(middle)

    def hung(self, on: Body, spot: Spot | None = None) -> Body:
        """A body that hangs on a pin of another."""
        spot = self.on(on) if spot is None else spot
        found = self.body(spot)
        self.pin(spot, on, found)
        return found

    def plates(self) -> None:
        one = self.hung(self.crank)
        other = self.hung(next(body for body in (self.held(), *self.free) if body is not self.crank))
        self.stay(one, other)
        self.stay(one, other, "leg")
        self.free += [one, other]

    def sun(self) -> None:
        """An arm about the crank's own pivot, and on it a planet that meshes with the crank."""
        arm = self.body(self.crank.at, self.number(-3, 3))
        pivot = next(iter(self.crank.points))
        arm.points[pivot] = self.sketched[pivot]
        planet = self.hung(arm)
        self.tie(planet, self.crank, arm)
        self.stay(self.ground, planet)
        self.free.append(planet)

    def wheels(self) -> None:
        one, other = self.hung(self.ground), self.hung(self.ground)
        self.tie(one, other, self.ground)
        rod = self.hung(one)
        self.stay(other, rod, "leg")
        self.stay(self.crank, rod)
        self.free.append(rod)

    def rack(self) -> None:
        pinion, bar = self.hung(self.ground), self.body(self.somewhere())
        spot = self.somewhere()
        symbol = self.slide("prismatic", bar, self.ground, spot, self.somewhere(60, spot))
        radius = self.number(5, 25)
        phase = self.slides[symbol] - radius * pinion.angle
        self.joints.append(
            f'{{ type = "rack", joint = "{symbol}", link = "{pinion.name}", radius = {radius!r}, phase = {phase!r} }}'
        )
        rod = self.hung(pinion)
        self.stay(bar, rod, "leg")
        self.stay(self.crank, rod)
        self.free.append(rod)

    # --- written ----------------------------------------------------------------------------------------------------

    def text(self, rows: int, step: float) -> str:
        """The description, driven on from the position drawn; its sketch is rounded."""
        links = "".join(
            f"[links.{body.name}]\npoints = {{ "
            + ", ".join(f"{name} = {[*body.own(spot)]!r}" for name, spot in body.points.items())
            + " }\n"
            for body in self.bodies
        )
        points = "".join(
            f"{name} = [{x:.2f}, {y:.2f}]\n" for name, (x, y) in self.sketched.items() if name not in self.ground.points
        )
        slides = "".join(f"{symbol} = {value:.2f}\n" for symbol, value in self.slides.items())
        start = math.degrees(self.home)
        joints = ",\n    ".join(self.joints)
        return (
            f'format = 1\njoints = [\n    {joints}\n]\n[mechanism]\nname = "drawn"\n{links}[driver]\nlink = "crank"\n'
            f"start = {start!r}\nstop = {start + step * (rows - 1)!r}\nstep = {step!r}\n{self.drivers}"
            f"[assembly]\n{points}{slides}"
        )
