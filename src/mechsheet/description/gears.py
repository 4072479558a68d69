"""Gears, belts and racks of [[joints]]: what they tie exists, and can be tied.

A plain number becomes an input cell of its own: ratio_4, radius_4, phase_4 of link 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node
from livesheet.said import say
from mechsheet.description.joints import RELATIONS, Ends
from mechsheet.description.kinds import ANGLE, ANY, LENGTH
from mechsheet.description.report import BAD, listed, suggestion
from mechsheet.description.scope import Scope, own_cell
from mechsheet.description.sketch import SketchedAngles
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import PRESSURE, Dimension, Gear, Joint, Link, Rack, Relation
from mechsheet.units import NUMBER

ROUGH = 1
"""Decimals of a phase [deg] that is read off a sketch."""

STANDARD = 20.0
"""Pressure angle [deg] of a gear that says none."""


def read(
    data: list[Any], ends: Ends, links: tuple[Link, ...], slides: tuple[Joint, ...], shown: SketchedAngles, scope: Scope
) -> tuple[tuple[Relation, ...], tuple[Dimension, ...]]:
    """The relations that are free of faults, and the cells that they bring; `shown`: angles that the sketch has."""
    return _Reader(ends, links, slides, shown, scope).read(data)


@dataclass
class _Reader:
    ends: Ends
    links: tuple[Link, ...]
    slides: tuple[Joint, ...]
    shown: SketchedAngles
    scope: Scope
    cells: list[Dimension] = field(default_factory=list)
    found: list[Relation] = field(default_factory=list)

    def read(self, data: list[Any]) -> tuple[tuple[Relation, ...], tuple[Dimension, ...]]:
        for order, entry in enumerate(data):
            if entry is BAD or entry["type"] not in RELATIONS:
                continue
            made = self._rack(entry, order) if entry["type"] == "rack" else self._gear(entry, order)
            if made is not None:
                self.found.append(made)
        return tuple(self.found), tuple(self.cells)

    # --- gears and belts ----------------------------------------------------------------------------------------

    def _gear(self, entry: dict[str, Any], order: int) -> Gear | None:
        path: Path = ("joints", order)
        names = {key: entry.get(key, self.links[0].name) for key in ("link", "on", "arm")}
        known = [self.ends.has_link(name, (*path, key)) for key, name in names.items()]
        given = self._ratio(entry, order, names["link"] if known[0] else None)
        if not all(known):
            return None
        link, on, arm = (str(name) for name in names.values())
        if not self._can_turn(link, on, path) or not self._carries(arm, (link, on), path, "arm" in entry):
            return None
        ratio, pressure = given
        phase = self._phase(entry, order, link, self._gear_shows(link, on, arm, ratio))
        return Gear(entry["type"], link, on, arm, ratio, phase, order, pressure, "phase" not in entry)

    def _ratio(self, entry: dict[str, Any], order: int, link: str | None) -> tuple[Node, Node]:
        """The ratio (of a rack the radius), and the pressure angle."""
        key = say("radius") if entry["type"] == "rack" else say("ratio")
        path: Path = ("joints", order, key)
        kind, unit = (LENGTH, self.scope.length) if key == "radius" else (ANY, NUMBER)
        number = self.ends.numbers[link] if link is not None else order
        node = own_cell(self.scope, self.cells, self._name(key, number), entry[key], kind, unit, path, key)
        if entry[key] is not BAD and self.scope.number(node) == 0:
            self.scope.report.at(path, say("the {key} is 0: nothing would turn with it", key=key))
        degrees = self.scope.quantity(entry.get("pressure_angle", STANDARD), ANGLE, (*path[:2], "pressure_angle"))
        if "pressure_angle" in entry:
            size = abs(self.scope.number(degrees))
            if size >= math.pi / 2:
                message = say("must be less than 90 degrees to either side")
                self.scope.report.at((*path[:2], "pressure_angle"), message, say("usual are 20 and 14.5 degrees"))
        return node, al.as_node(degrees) if "pressure_angle" in entry else PRESSURE

    def _name(self, key: str, number: int) -> str:
        """ratio_4 of link 4; ratio_4_2 where it has another one already."""
        taken = {cell.symbol for cell in self.cells}
        names = (f"{key}_{number}", *(f"{key}_{number}_{again}" for again in range(2, 100)))
        return next(name for name in names if name not in taken)

    def _can_turn(self, link: str, on: str, path: Path) -> bool:
        """Whether two wheels can turn against each other; reports why not."""
        if link == on:
            self.scope.report.at(
                (*path, "on"), say("{link} is one link: no gear can turn it against itself", link=quoted(link))
            )
            return False
        for slide in self.slides:
            if slide.kind == "prismatic" and {slide.link, slide.on} == {link, on}:
                message = say(
                    "{link} and {on} slide on each other and keep their angle: no gear can turn them",
                    link=quoted(link),
                    on=quoted(on),
                )
                self.scope.report.at((*path, "on"), message)
                return False
        return True

    def _carries(self, arm: str, wheels: tuple[str, str], path: Path, given: bool) -> bool:
        """Whether the arm has a pivot with either wheel; reports which one it lacks."""
        where: Path = (*path, "arm") if given else path
        if arm in wheels:
            self.scope.report.at(where, say("the arm {arm} is one of the wheels", arm=quoted(arm)), self._arms(wheels))
            return False
        lacking = [wheel for wheel in wheels if not self._pivot(arm, wheel)]
        if lacking:
            message = say(
                "the arm {arm} does not carry the axis of {lacking}: they share no point",
                arm=quoted(arm),
                lacking=listed(lacking, "or"),
            )
            self.scope.report.at(where, message, self._arms(wheels))
        return not lacking

    def _pivot(self, one: str, other: str) -> bool:
        mine, theirs = self.ends.points[one], self.ends.points[other]
        return mine is None or theirs is None or bool(set(mine) & set(theirs))

    def _arms(self, wheels: tuple[str, str]) -> str:
        good = [
            link.name
            for link in self.links
            if link.name not in wheels and all(self._pivot(link.name, wheel) for wheel in wheels)
        ]
        if good:
            return say("write arm = {name}", name=quoted(good[0]))
        return say("no link shares a point with both {wheels}", wheels=listed(wheels))

    # --- racks --------------------------------------------------------------------------------------------------

    def _rack(self, entry: dict[str, Any], order: int) -> Rack | None:
        path: Path = ("joints", order)
        slide = next((slide for slide in self.slides if slide.name == entry["joint"]), None)
        if slide is None and entry["joint"] is not BAD:
            hint = suggestion(entry["joint"], [slide.name for slide in self.slides], "sliding joints")
            self.scope.report.at(
                (*path, "joint"), say("no sliding joint is called {name}", name=quoted(entry["joint"])), hint
            )
        known = self.ends.has_link(entry["link"], (*path, "link"))
        radius, pressure = self._ratio(entry, order, entry["link"] if known else None)
        if slide is None or not known:
            return None
        link = str(entry["link"])
        sides = [side for side in (slide.on, slide.link) if side != link]
        if len(sides) < 2:
            message = say(
                "{link} is a side of the sliding joint itself: the pinion must be a third link", link=quoted(link)
            )
            self.scope.report.at((*path, "link"), message)
            return None
        if entry.get("arm") is BAD:
            return None
        arm = entry.get("arm") or next((side for side in sides if self._pivot(side, link)), sides[0])
        if not self._carries_pinion(arm, link, sides, path, "arm" in entry):
            return None
        angle, still = self.shown.of(link), self.shown.of(arm)
        slid = self.shown.displacement(slide)
        phase = 0.0
        if angle is not None and still is not None and slid is not None:
            phase = float(f"{slid - self.scope.number(radius) * (angle - still):.4g}")
        node = self._phase(entry, order, link, phase)
        return Rack(slide.symbol, link, arm, radius, node, order, pressure, "phase" not in entry)

    def _carries_pinion(self, arm: str, link: str, sides: list[str], path: Path, given: bool) -> bool:
        where: Path = (*path, "arm") if given else (*path, "link")
        if arm not in sides:
            if self.ends.has_link(arm, where):
                message = say("the arm {arm} is no side of the sliding joint", arm=quoted(arm))
                self.scope.report.at(where, message, say("its sides: {sides}", sides=listed(sides, "or")))
            return False
        if not self._pivot(arm, link):
            which = quoted(arm) if given else listed(sides, "or")
            message = say(
                "the pinion {link} is not pivoted on {which}: they share no point", link=quoted(link), which=which
            )
            self.scope.report.at(where, message)
            return False
        return True

    # --- phases -------------------------------------------------------------------------------------------------

    def _phase(self, entry: dict[str, Any], order: int, link: str, shown: float) -> Node:
        """The phase as given, or the one `shown` [deg or length unit] by the sketch; a cell, unless it is an expression."""
        rack = entry["type"] == "rack"
        kind, unit = (LENGTH, self.scope.length) if rack else (ANGLE, self.scope.angle_unit)
        if not rack and "phase" not in entry:
            shown = round(unit.to_shown(math.radians(shown)), ROUGH if unit.in_degrees else 3)
        name = self._name("phase", self.ends.numbers[link])
        path: Path = ("joints", order, "phase")
        return own_cell(self.scope, self.cells, name, entry.get("phase", shown), kind, unit, path, "phase")

    def _gear_shows(self, link: str, on: str, arm: str, ratio: Node) -> float:
        """The phase [deg] that makes the wheels stand as they are sketched; 0 where the sketch does not say."""
        angles = [self.shown.of(name) for name in (link, on, arm)]
        factor = self.scope.number(ratio)
        if any(angle is None for angle in angles) or not math.isfinite(factor):
            return 0.0
        wheel, other, carried = (angle for angle in angles if angle is not None)
        return math.degrees(math.remainder(wheel - carried - factor * (other - carried), math.tau))
