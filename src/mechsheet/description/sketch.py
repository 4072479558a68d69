"""The part [assembly]: the rough position of points, angles and displacements that tells assemblies apart; and at which
angles it shows the links (`SketchedAngles`), which phases of gears are read off."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from livesheet import portable
from livesheet.said import say
from mechsheet.description.kinds import ANGLE, LENGTH
from mechsheet.description.links import pair
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Cartesian, Driver, FurtherDriver, Joint, Link, Polar, Quantity, Sketch


def read(data: dict[str, Any], driver: Driver | None, scope: Scope) -> Sketch:
    """The rough position: points by [x, y], angles and displacements by a number; `at` is in the driver's unit."""
    points: dict[str, tuple[Quantity, Quantity]] = {}
    values: dict[str, Quantity] = {}
    at: Quantity | None = None
    for name, value in data.items():
        path: Path = ("assembly", name)
        if name == "at":
            if driver is not None and value is not BAD:
                at = scope.quantity(value, LENGTH if driver.joint else ANGLE, path)
        elif isinstance(value, dict):
            continue  # a mode that the synthesis says
        elif isinstance(value, list):
            if name not in scope.points:
                hint = suggestion(name, scope.points, "points")
                scope.report.at(path, say("no link has a point {name}", name=quoted(name)), hint)
            points[name] = pair(value, path, scope)
        elif value is not BAD and name in scope.variables:
            values[name] = scope.quantity(value, scope.kinds[name], path)
        elif value is not BAD and name in scope.points:
            scope.report.at(path, say("the point {name} is sketched as [x, y]", name=quoted(name)))
        elif value is not BAD and scope.complete:
            message = say("no point, link angle or displacement is called {name}", name=quoted(name))
            if name in scope.units or name in scope.outputs:
                message = say("{name} is no point, link angle or displacement", name=quoted(name))
            names = [*scope.points, *scope.variables]
            scope.report.at(path, message, suggestion(name, names, "allowed"))
    return Sketch(points, values, at)


class SketchedAngles:
    """Of one description, at the driver value that its sketch shows.

    symbols  what is sketched or driven, by symbol
    """

    def __init__(
        self,
        links: Sequence[Link],
        slides: Sequence[Joint],
        driver: Driver | None,
        further: Sequence[FurtherDriver],
        sketch: Sketch,
        scope: Scope,
    ) -> None:
        self.scope = scope
        self.links = {link.name: link for link in links}
        self.symbols = {symbol: scope.number(value) for symbol, value in sketch.symbols.items()}
        self.sketched = {name: self._pair(pair) for name, pair in sketch.points.items()}
        self.angles: dict[str, float] = {links[0].name: 0.0} if links else {}
        for link in links[1:]:
            if link.angle_symbol in self.symbols:
                self.angles[link.name] = self.symbols[link.angle_symbol]
        if driver is not None:
            first = driver.values[0] if driver.values else driver.start
            self._driven(driver, sketch.at if sketch.at is not None else first)
        for other in further:
            if other.values:
                self._driven(other, other.values[0])
        self._by_slides(slides)

    def _driven(self, driver: Driver | FurtherDriver, value: Quantity) -> None:
        number = self.scope.number(value)
        self.symbols.setdefault(driver.symbol, number)
        base = self.angles.get(driver.relative_to)
        if driver.link and base is not None:
            self.angles[driver.link] = base + number

    def _by_slides(self, slides: Sequence[Joint]) -> None:
        """Links that slide on one whose angle is known."""
        for _ in slides:
            for slide in slides:
                if slide.kind != "prismatic":
                    continue
                kept = self.scope.number(slide.angle) + self.scope.number(slide.orientation)
                if slide.on in self.angles:
                    self.angles.setdefault(slide.link, self.angles[slide.on] + kept)
                elif slide.link in self.angles:
                    self.angles.setdefault(slide.on, self.angles[slide.link] - kept)

    def displacement(self, slide: Joint) -> float | None:
        """That of a sliding joint, as it is given or as its point is sketched beside a guide that is known; else None."""
        if slide.symbol in self.symbols:
            return self.symbols[slide.symbol]
        spot, angle, on = self.sketched.get(slide.point), self.of(slide.on), self.links[slide.on]
        if spot is None or angle is None:
            return None
        through = self._place(on, slide.through) if isinstance(slide.through, str) else self._pair(slide.through)
        c, s = portable.cos(angle), portable.sin(angle)
        for point in on.points:
            own, there = self._place(on, point), self._spot(point)
            if through and own and there:
                u, v = through[0] - own[0], through[1] - own[1]
                x, y = spot[0] - there[0] - u * c + v * s, spot[1] - there[1] - u * s - v * c
                direction = angle + self.scope.number(slide.angle)
                along = float(x * portable.cos(direction) + y * portable.sin(direction))
                return along if math.isfinite(along) else None
        return None

    def of(self, name: str) -> float | None:
        """The angle [rad] of a link, as it is given or as two of its points are sketched; None where neither is."""
        link = self.links[name]
        if name not in self.angles:
            found = self._by_points(link)
            if found is None:
                return None
            self.angles[name] = found
        angle = self.angles[name]
        return angle if math.isfinite(angle) else None

    def _by_points(self, link: Link) -> float | None:
        """By the two points that lie farthest apart among those whose places are known."""
        known = [(self._place(link, point), spot) for point in link.points if (spot := self._spot(point)) is not None]
        ways = [
            (
                _distance(own, other),
                portable.arctan2(b[1] - a[1], b[0] - a[0]) - portable.arctan2(other[1] - own[1], other[0] - own[0]),
            )
            for index, (own, a) in enumerate(known)
            for other, b in known[index + 1 :]
            if own and other and _distance(own, other) > 0 and _distance(a, b) > 0
        ]
        return math.remainder(max(ways)[1], math.tau) if ways else None

    def _spot(self, point: str) -> tuple[float, float] | None:
        """Where a point is sketched, or fixed, or carried by a link that turns about a fixed one."""
        if point in self.sketched:
            return self.sketched[point]
        ground = next(iter(self.links.values()))
        if point in ground.points:
            return self._place(ground, point)
        for link in self.links.values():
            pivot = next((own for own in link.points if own in ground.points), None)
            if pivot is None or point not in link.points or link.name not in self.angles:
                continue
            base, start, end = self._place(ground, pivot), self._place(link, pivot), self._place(link, point)
            if base and start and end:
                c, s = portable.cos(self.angles[link.name]), portable.sin(self.angles[link.name])
                u, v = end[0] - start[0], end[1] - start[1]
                return base[0] + u * c - v * s, base[1] + u * s + v * c
        return None

    def _place(self, link: Link, point: str) -> tuple[float, float] | None:
        """In the link's own frame; None for a point that is given by distances."""
        match link.points[point]:
            case Cartesian(x, y):
                found = self._pair((x, y))
            case Polar(r, angle):
                length, direction = self.scope.number(r), self.scope.number(angle)
                found = length * portable.cos(direction), length * portable.sin(direction)
            case _:
                return None
        return found if all(map(math.isfinite, found)) else None

    def _pair(self, pair: tuple[Quantity, Quantity]) -> tuple[float, float]:
        return self.scope.number(pair[0]), self.scope.number(pair[1])


def _distance(a: tuple[float, float], b: tuple[float, float]) -> float:
    return float(portable.hypot(b[0] - a[0], b[1] - a[1]))
