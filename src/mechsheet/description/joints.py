"""The part [[joints]]: sliding joints between links that exist, at points that exist. For gears see `gears`.

`redundant = true` under a link: it moves with the others anyway, and is left out of what has to be solved. Its second
revolute joint becomes a pin in a slot along the link, which asks nothing of its length: so the link follows the others, and
whether its length fits is measured in every row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.said import say
from mechsheet.description.kinds import ANGLE, LENGTH
from mechsheet.description.links import pair, points_of
from mechsheet.description.report import BAD, listed, suggestion
from mechsheet.description.scope import Scope, Space, part
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Cartesian, Distances, GivenPoint, Joint, Link, Polar, Quantity, Redundant

RELATIONS = ("gear", "belt", "rack")
"""Types that tie angles and displacements to each other; they join nothing."""


class Ends:
    """Looks up links and points by the names that joints give."""

    def __init__(self, data: dict[str, Any], links: tuple[Link, ...], scope: Scope) -> None:
        self.points = {name: points_of(entry) for name, entry in data.items()}
        self.numbers = {link.name: link.number for link in links}
        self.scope = scope

    def has_link(self, name: Any, path: Path) -> bool:
        """True when `name` is a link; reports when it is not."""
        if name is BAD or name is None:
            return False
        if name not in self.numbers:
            hint = suggestion(name, self.numbers, "links")
            self.scope.report.at(path, say("no link is called {name}", name=quoted(name)), hint)
        return name in self.numbers

    def has_point(self, link: str, point: str, path: Path) -> bool:
        """True when `link` lists `point`; reports when it does not (and a fault has not hidden its points)."""
        points = self.points[link]
        if points is None:
            return False
        if point not in points:
            self.scope.no_point_of(link, point, points, path)
        return point in points

    def pair_symbol(self, letter: str, on: str, link: str) -> str:
        """`s14`, `theta34`; with an underscore where a number has two digits, as theta1_10 has."""
        first, second = self.numbers[on], self.numbers[link]
        return f"{letter}{first}{'_' if max(first, second) > 9 else ''}{second}"


def read(data: list[Any], ends: Ends, scope: Scope) -> tuple[Joint, ...]:
    """The sliding joints that are free of faults; their displacements become variables."""
    joints: list[Joint] = []
    names = Space(scope.report)
    for place, entry in enumerate(data):
        if entry is not BAD and entry["type"] in RELATIONS:
            continue
        joint = None if entry is BAD else _joint(entry, ("joints", place), ends, scope)
        if joint is None:
            scope.complete = False
            continue
        path: Path = ("joints", place, "name") if "name" in entry else ("joints", place)
        names.claim(joint.name, "joint", path)
        joints.append(joint)
        if joint.name != joint.symbol:
            scope.slides[joint.name] = joint.symbol
    return tuple(joints)


def _joint(entry: dict[str, Any], path: Path, ends: Ends, scope: Scope) -> Joint | None:
    on, point = entry["on"], entry["point"]
    on_known = ends.has_link(on, (*path, "on"))
    link: Any = entry.get("link")
    link_known = ends.has_link(link, (*path, "link"))
    prismatic = entry["type"] == "prismatic"
    if on_known and link == on:
        scope.report.at(
            (*path, "link"), say("{on} cannot slide on itself: `link` and `on` are the same", on=quoted(on))
        )
        link_known = False
    through = _through(entry, path, ends, scope, on if on_known else None)
    angle = scope.quantity(entry.get("angle", 0), ANGLE, (*path, "angle"))
    orientation = scope.quantity(entry.get("orientation", 0), ANGLE, (*path, "orientation"))
    if point is BAD or not on_known:
        return None
    if not prismatic and "link" not in entry:
        link = _first_owner(point, on, path, ends, scope)
        link_known = link is not None
    elif link_known:
        link_known = ends.has_point(link, point, (*path, "point"))
    if not link_known or not _free_of(on, point, path, ends, scope):
        return None
    symbol = _symbol(entry, link, path, ends, scope)
    if symbol is None or through is None:
        return None
    name = entry.get("name", symbol)
    kind = entry["type"]
    return Joint(symbol if name is BAD else name, kind, link, on, point, through, angle, orientation, symbol)


def _through(entry: dict[str, Any], path: Path, ends: Ends, scope: Scope, on: str | None) -> Any:
    through, place = entry["through"], (*path, "through")
    if isinstance(through, list):
        return pair(through, place, scope)
    if through is BAD or on is None:
        return None
    return through if ends.has_point(on, through, place) else None


def _first_owner(point: str, on: str, path: Path, ends: Ends, scope: Scope) -> str | None:
    """The first link beside `on` that has `point`."""
    owners = [link for link in scope.points.get(point, ()) if link != on]
    if owners or any(points is None for points in ends.points.values()):
        return owners[0] if owners else None
    if point in scope.points:
        message = say(
            "the point {point} belongs to {on} itself: it must be a point of another link",
            point=quoted(point),
            on=quoted(on),
        )
        scope.report.at((*path, "point"), message)
    else:
        hint = suggestion(point, scope.points, "points")
        scope.report.at((*path, "point"), say("no link has a point {point}", point=quoted(point)), hint)
    return None


def _free_of(on: str, point: str, path: Path, ends: Ends, scope: Scope) -> bool:
    """True when `on` does not have the sliding point as a point of its own, which would pin it."""
    if point not in (ends.points[on] or {}):
        return True
    message = say(
        "the point {point} is a point of {on} too, which pins it there: it cannot slide",
        point=quoted(point),
        on=quoted(on),
    )
    scope.report.at((*path, "point"), message, say("take it out of the points of {on}", on=on))
    return False


def _symbol(entry: dict[str, Any], link: str, path: Path, ends: Ends, scope: Scope) -> str | None:
    """The displacement's symbol, entered among the variables."""
    symbol, place, hint = entry.get("symbol"), path, ""
    if symbol is BAD:
        return None
    if symbol is None:
        owners = [name for name in scope.points.get(entry["point"], ()) if name != entry["on"]]
        if entry["type"] == "pin-slot" and len(owners) > 1:
            message = say(
                "is missing: the point {point} belongs to {owners}", point=quoted(entry["point"]), owners=listed(owners)
            )
            scope.report.at((*path, "symbol"), message, say("no default fits; name the displacement"))
            return None
        symbol = ends.pair_symbol("s", entry["on"], link)
        hint = say("this is the default; give the joint a `symbol` of its own")
    else:
        place = (*path, "symbol")
        if not scope.symbol_is_good(symbol, place):
            return None
    scope.add_variable(symbol, LENGTH, "displacement of a joint", place, hint)
    return str(symbol)


# --- redundant links --------------------------------------------------------------------------------------------------


def read_redundant(
    data: dict[str, Any], links: tuple[Link, ...], joints: tuple[Joint, ...], ends: Ends, scope: Scope
) -> tuple[tuple[Link, ...], tuple[Joint, ...], tuple[Redundant, ...]]:
    """(links without the second pins of redundant ones, joints with the slots in their place, what was taken apart).

    data  the whole description
    """
    bodies, driver = part(data, "links", {}), part(data, "driver", {})
    driven = {driver.get(key) for key in ("link", "relative_to")}
    found: list[Redundant] = []
    slots: list[Joint] = []
    kept: list[Link] = []
    for link in links:
        entry = bodies[link.name]
        slot = None
        if isinstance(entry, dict) and entry.get("redundant") is True:
            if link.name in driven:
                scope.report.at(
                    ("links", link.name, "redundant"),
                    say("the link {name} is driven: it is needed", name=quoted(link.name)),
                )
            slot = _slot(link, links, joints, ends, scope)
        if slot is None:
            kept.append(link)
            continue
        slots.append(slot)
        found.append(Redundant(link, slot.symbol))
        points = {name: place for name, place in link.points.items() if name != slot.point}
        kept.append(replace(link, points=points))
    return tuple(kept), (*joints, *slots), tuple(found)


def _slot(link: Link, links: Sequence[Link], joints: Sequence[Joint], ends: Ends, scope: Scope) -> Joint | None:
    """The slot that takes the place of the second pin; None where the link is none that can be left out."""
    path: Path = ("links", link.name, "redundant")
    shared = [point for point in link.points if len(scope.points[point]) > 1]
    sliding = [joint.name for joint in joints if link.name in (joint.on, joint.link)]
    if link is links[0] or len(shared) != 2 or sliding:
        message = say("the link {link} is joined at no point", link=quoted(link.name))
        if shared:
            message = say("the link {link} is joined at {points}", link=quoted(link.name), points=listed(shared))
        if sliding:
            message = say("{message} and slides at {joints}", message=message, joints=listed(sliding))
        scope.report.at(path, message, say("a link can be left out that joins two others by two revolute joints"))
        return None
    first, second = shared
    if any(isinstance(place, Distances) for place in link.points.values()):
        hint = say('give its points by coordinates: B = ["a3", 0]')
        scope.report.at(path, say("points of a redundant link cannot be given by distances"), hint)
        return None
    owner = next(name for name in scope.points[second] if name != link.name)
    symbol = ends.pair_symbol("s", link.name, owner)
    scope.add_variable(symbol, LENGTH, "length of a redundant link", path)
    angle = _direction(link.points[first], link.points[second], scope)
    return Joint(symbol, "pin-slot", owner, link.name, second, first, angle, 0.0, symbol)


def _direction(start: GivenPoint, end: GivenPoint, scope: Scope) -> Quantity:
    """Of the way from one place to the other, in the link's frame."""
    if isinstance(end, Polar) and isinstance(start, Cartesian) and start.x == start.y == 0.0:
        return end.angle
    x, y = (al.sub(there, here) for there, here in zip(_parts(end), _parts(start), strict=True))
    across, up = al.value_of(x), al.value_of(y)
    if across is not None and up is not None:
        return float(portable.arctan2(up, across))
    if isinstance(x, Symbol) and al.is_zero(y) and scope.numbers.get(x.name, 0.0) > 0:
        return 0.0  # along the x axis, by a length
    return al.atan2(x, y)


def _parts(place: GivenPoint) -> tuple[Node, Node]:
    match place:
        case Cartesian(x, y):
            return al.as_node(x), al.as_node(y)
        case Polar(r, angle):
            length, turn = al.as_node(r), al.as_node(angle)
            return al.mul(length, Call("COS", (turn,))), al.mul(length, Call("SIN", (turn,)))
    raise ValueError(f"no coordinates: {place}")
