"""The part [[driver.segments]]: a follower's motion over the angle of a cam.

The cam is the driver, a link of its own that turns about a point of the ground; the joint or link that [driver] names is
what the cam moves, and is driven besides.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.said import say
from mechsheet.description.driving import driver as drivers
from mechsheet.description.driving.segment_laws import way_of
from mechsheet.description.joints import Ends
from mechsheet.description.kinds import ANGLE
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope, own_cell
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Dimension, Driver, FurtherDriver, Joint, Link, Segment, Segments
from mechsheet.units import Unit

LINKS, ANGLE_OF_CAM = ("cam", "cam-disc"), "phi"
"""What the cam is called, where another link is called so already, and its angle where nobody says."""

FULL = 1e-9
"""Angles [rad], and ways as parts of the longest, that miss each other by so little count as the same."""

_TURN = al.mul(al.TWO, al.PI)


def given(data: dict[str, Any]) -> bool:
    """Whether what is read has such a motion."""
    driver = data.get("driver")
    return isinstance(driver, dict) and "segments" in driver


def with_cam(data: dict[str, Any], scope: Scope) -> dict[str, Any]:
    """The data with the cam as a link of its own, where there is a motion over its angle."""
    links, cam = data.get("links"), data.get("cam", {})
    if not given(data) or not isinstance(links, dict) or not isinstance(cam, dict):
        return data
    ground = next(iter(links.values()), None)
    points = ground.get("points") if isinstance(ground, dict) else None
    if not isinstance(points, dict):
        return data
    center = cam.get("center", next(iter(points), ""))
    if center is BAD:
        return data
    if center not in points:
        message = say("{name} is no point of the ground: a cam turns about one", name=quoted(center))
        path: Path = ("cam", "center") if "center" in cam else ("driver", "segments")
        scope.report.at(path, message, suggestion(center, points, "points"))
        return data
    name = next((name for name in LINKS if name not in links), LINKS[-1])
    return {**data, "links": {**links, name: {"points": {center: [0.0, 0.0]}}}}


def check_alone(data: dict[str, Any], scope: Scope) -> None:
    """Report what goes with segments where there are none."""
    if "cam" in data:
        scope.report.at(("cam",), say("needs a motion over its angle"), say("write [[driver.segments]]"))
    driver = data.get("driver")
    if isinstance(driver, dict) and "closed" in driver:
        scope.report.at(("driver", "closed"), say("goes with `segments`"))


@dataclass(frozen=True, slots=True)
class Moved:
    """What is read: the cam as the driver, what it moves, and the cells of all this."""

    driver: Driver
    follower: FurtherDriver
    dimensions: tuple[Dimension, ...]


def read(
    data: Any,
    cam: dict[str, Any],
    start: Node | None,
    links: tuple[Link, ...],
    joints: tuple[Joint, ...],
    ends: Ends,
    scope: Scope,
) -> Moved | None:
    """The motion, when no fault hides it.

    cam    the part [cam];  start: where the follower is on the base circle, where that says it
    """
    if data is BAD:
        scope.complete = False
        return None
    found = drivers.driven(data, ("driver",), links, joints, ends, scope)
    angle = cam.get("symbol", ANGLE_OF_CAM)
    good = angle is not BAD and scope.symbol_is_good(angle, ("cam", "symbol"))
    if good:
        scope.add_variable(angle, ANGLE, "angle of the cam", ("cam", "symbol") if "symbol" in cam else ("driver",))
    if found is None or not good:
        scope.complete = False
        return None
    symbol, link, relative_to, joint = found
    kind, unit = drivers.kind_and_unit({"joint": ""} if joint else {"link": ""}, scope)
    cells: list[Dimension] = []
    if "start" in data:
        start = own_cell(scope, cells, f"{symbol}_0", data["start"], kind, unit, ("driver", "start"), "start")
    elif start is not None:
        start = _derived(f"{symbol}_0", start, unit, ("cam", "start"), cells, scope)
    else:
        if not scope.report.sound("cam"):
            return None
        hint = say("a base circle says it where the ground carries a slide, or a rocker with a roller")
        scope.report.at(("driver",), say("start is missing: where the follower is on the base circle"), hint)
        return None
    closed = data.get("closed", True) is not False
    parts = _Parts(data["segments"], closed, str(angle), kind, unit, cells, scope).read()
    step = scope.quantity(data.get("step", BAD), ANGLE, ("driver", "step"))
    if parts is None:
        return None
    whole = al.add(parts[-1].begins, parts[-1].over)
    stop = math.tau if closed else whole
    shown = {"start": 0, "stop": scope.angle_unit.written(scope.number(stop)), "step": data.get("step", BAD)}
    drivers.check_sweep(0.0, scope.number(stop), scope.number(step), shown, scope)
    turning, standing = links[-1].name, links[0].name
    if cam.get("turns", 1) == -1:  # what grows is the angle of the ground, seen from the cam
        turning, standing = standing, turning
    driver = Driver(str(angle), scope.angle_unit, turning, standing, "", 0.0, stop, step)
    follower = FurtherDriver(symbol, unit, -1, link, relative_to, joint, segments=Segments(start, parts, closed))
    return Moved(driver, follower, tuple(cells))


class _Parts:
    """The segments, one after another."""

    def __init__(
        self, data: Any, closed: bool, angle: str, kind: str, unit: Unit, cells: list[Dimension], scope: Scope
    ) -> None:
        self.data, self.closed, self.angle, self.kind, self.unit = data, closed, angle, kind, unit
        self.cells, self.scope = cells, scope

    def read(self) -> tuple[Segment, ...] | None:
        """They, with the cells of their angles and ways; None where a fault hides one."""
        if self.data is BAD or any(each is BAD for each in self.data):
            return None
        told = len(self.scope.report.faults)
        moving = [place for place, each in enumerate(self.data) if each.get("law") != "dwell"]
        parts: list[Segment] = []
        begins: Node = al.ZERO
        lift: Node = al.ZERO
        for place, each in enumerate(self.data):
            last = place == len(self.data) - 1
            over = self._over(each, place, begins, last)
            by = self._by(each, place, lift, bool(moving) and place == moving[-1])
            if BAD in (each.get("law"), over, by):
                return None
            parts.append(Segment(each["law"], begins, over, lift, by, way_of(each["law"])))
            if last:
                break
            begins = self._held(
                f"{self.angle}_{place + 2}", al.add(begins, over), self.scope.angle_unit, place, "begins"
            )
            lift = self._held(f"lift_{place + 2}", al.add(lift, by), self.unit, place, "lift")
        if len(self.scope.report.faults) > told:
            return None
        if not moving:
            self.scope.report.at(("driver", "segments"), say("the follower never moves: every segment is a dwell"))
            return None
        return tuple(parts)

    def _held(self, name: str, node: Node, unit: Unit, place: int, key: str) -> Node:
        """A sum as a cell of its own, where it is one."""
        if al.is_simple(node):
            return node
        return _derived(name, node, unit, ("driver", "segments", place + 1, key), self.cells, self.scope)

    def _over(self, each: dict[str, Any], place: int, begins: Node, last: bool) -> Any:
        """Over which angle a segment goes: the last one of a closed motion over what is left of the turn."""
        path: Path = ("driver", "segments", place, "over")
        scope, name = self.scope, f"over_{place + 1}"
        begun = scope.number(begins)
        if last and self.closed:
            left = math.tau - begun
            if left <= FULL:
                message = say(
                    "nothing is left of the turn: the segments before end at {end:.6g}°", end=math.degrees(begun)
                )
                scope.report.at(path[:-1], message, say("they must end before 360°"))
            if "over" in each and each["over"] is not BAD:
                own = scope.number(scope.quantity(each["over"], ANGLE, path))
                if abs(own - left) > FULL:
                    message = say("the segments end at {end:.6g}°, not at 360°", end=math.degrees(begun + own))
                    scope.report.at(path, message, say("leave `over` out of the last one: what is left of the turn"))
            return _derived(name, al.sub(_TURN, begins), scope.angle_unit, path, self.cells, scope)
        if "over" not in each:
            scope.report.at(path[:-1], say("over is missing: over which angle of the cam the segment goes"))
            return BAD
        if each["over"] is BAD:
            return BAD
        over = own_cell(scope, self.cells, name, each["over"], ANGLE, scope.angle_unit, path, "segment")
        size = scope.number(over)
        if size <= 0:
            scope.report.at(path, say("a segment goes over an angle greater than 0"))
            return BAD
        if begun + size > math.tau + FULL:
            end = math.degrees(begun + size)
            scope.report.at(path, say("the segments leave the turn: they end at {end:.6g}°", end=end))
            return BAD
        return over

    def _by(self, each: dict[str, Any], place: int, lift: Node, last: bool) -> Any:
        """How far a segment goes: in a closed motion the last one that moves goes back."""
        path: Path = ("driver", "segments", place)
        scope, keys = self.scope, [key for key in ("by", "to") if key in each]
        if each.get("law") == "dwell":
            if keys:
                scope.report.at((*path, keys[0]), say("a dwell goes nowhere"), say("leave {key} out", key=keys[0]))
            return al.ZERO
        if len(keys) != 1:
            message = say("by and to exclude each other") if keys else say("by or to is missing: how far it goes")
            scope.report.at(path, message)
            return BAD
        key = keys[0]
        if each[key] is BAD:
            return BAD
        if last and self.closed:
            own = scope.number(scope.quantity(each[key], self.kind, (*path, key)))
            end = own if key == "to" else scope.number(lift) + own
            if not abs(end) <= FULL * max(1.0, abs(own)):
                message = say("the follower does not come back: it ends {end:.6g} from where it began",
                              end=self.unit.to_shown(end))  # fmt: skip
                scope.report.at((*path, key), message, say("write to = 0, or closed = false in [driver]"))
            return _derived(f"by_{place + 1}", al.neg(lift), self.unit, (*path, "by"), self.cells, scope)
        if key == "to" and each[key] == 0:
            return _derived(f"by_{place + 1}", al.neg(lift), self.unit, (*path, "by"), self.cells, scope)
        node = own_cell(
            scope, self.cells, f"{key}_{place + 1}", each[key], self.kind, self.unit, (*path, key), "segment"
        )
        if key == "by":
            return node
        return _derived(f"by_{place + 1}", al.sub(node, lift), self.unit, (*path, "by"), self.cells, scope)


def _derived(symbol: str, node: Node, unit: Unit, place: Path, cells: list[Dimension], scope: Scope) -> Node:
    """A cell of what follows from other dimensions."""
    scope.symbols.claim(symbol, "segment", place, say("rename it: the cam's motion has a cell of that name"))
    scope.numbers[symbol] = scope.number(node)
    cells.append(Dimension(symbol, node, unit, path=place))
    return Symbol(symbol)
