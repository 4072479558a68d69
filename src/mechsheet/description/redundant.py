"""`redundant = true` under a link: it moves with the others anyway, and is left out of what has to be solved.

Its second revolute joint becomes a pin in a slot along the link, which asks nothing of its length: so the link follows the
others, and whether its length fits is measured in every row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.said import say
from mechsheet.description.head import part
from mechsheet.description.joints import Ends
from mechsheet.description.kinds import LENGTH
from mechsheet.description.report import listed
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Cartesian, Distances, GivenPoint, Joint, Link, Polar, Quantity, Redundant


def read(
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
