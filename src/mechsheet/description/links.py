"""The part [links]: numbers, points in each link's frame, and whether every link hangs together with the ground."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from livesheet import portable
from livesheet.said import say
from mechsheet.description.kinds import ANGLE, LENGTH
from mechsheet.description.report import BAD, listed
from mechsheet.description.scope import REPORTED, Scope, Space, circle_message, cycles, words
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import GROUND, Cartesian, Distances, GivenPoint, Joint, Link, Polar

_ROUNDING = 1e-9
"""Distances may miss each other by this part of their size and count as meeting (a point on the line between two)."""


_GROUNDS = ("ground", "zemin", "sabit")
"""What people call the fixed link, and no other."""

LONGEST_NAME = 60
"""Characters of the name of a link."""


def declare(data: dict[str, Any], scope: Scope) -> tuple[Link, ...]:
    """Number the links and enter their names, angles and points; the links come back without points."""
    names, numbers, last = Space(scope.report), dict[int, str](), 0
    links: list[Link] = []
    for name, entry in data.items():
        path: Path = ("links", name)
        _name_is_good(name, path, scope)
        names.claim(name, "link", path)
        table = entry if isinstance(entry, dict) else {}
        number = table.get("number", last + 1)
        last = last + 1 if number is BAD else number
        if not links and last != GROUND:
            scope.report.at((*path, "number"), say("the first link is the ground; its number is 1"))
            last = GROUND
        elif last in numbers:
            where = (*path, "number") if "number" in table else path
            message = say("the number {number} is taken by the link {link}", number=last, link=quoted(numbers[last]))
            scope.report.at(where, message, say("numbers count upwards from the link before, unless `number` is given"))
        numbers.setdefault(last, name)
        links.append(Link(name, last, {}, words(table.get("label"))))
    _check_ground_is_first(links, scope)
    for link in links[1:]:
        if numbers[link.number] == link.name:
            scope.add_variable(link.angle_symbol, ANGLE, "angle of a link", ("links", link.name))
    _declare_points(data, scope)
    return tuple(links)


def _check_ground_is_first(links: list[Link], scope: Scope) -> None:
    """Report a link that is called the ground behind another one: that one would be fixed, and this one move."""
    for link in links[1:]:
        if link.name.lower() in _GROUNDS and links[0].name.lower() not in _GROUNDS:
            message = say("the first link of the file is the ground, and that is {link}", link=quoted(links[0].name))
            hint = say("write [links.{name}] before the other links", name=link.name)
            scope.report.at(("links", link.name), message, hint)


def _name_is_good(name: str, path: Path, scope: Scope) -> None:
    message = say("the name {name} must begin with a letter and go on with letters, digits, - and _", name=quoted(name))
    if len(name) > LONGEST_NAME:
        scope.report.at(path, say("{message} (at most {most})", message=message, most=LONGEST_NAME))
    elif not (name and name[0].isalpha() and all(sign.isalnum() or sign in "_-" for sign in name)):
        scope.report.at(path, message)


def _declare_points(data: dict[str, Any], scope: Scope) -> None:
    space = Space(scope.report)
    for order, (link, entry) in enumerate(data.items()):
        points = points_of(entry)
        if order == 0:
            scope.fixed.update(points or {})
        for point in points or {}:
            path: Path = ("links", link, "points", point)
            if point not in scope.points:
                scope.symbol_is_good(point, path)
                space.claim(point, "point", path)
            scope.points.setdefault(point, []).append(link)


def points_of(entry: Any) -> dict[str, Any] | None:
    """The points that a link's table lists, or None when a fault hides them."""
    points = entry.get("points", BAD) if isinstance(entry, dict) else BAD
    return points if isinstance(points, dict) else None


def read(data: dict[str, Any], links: tuple[Link, ...], scope: Scope) -> tuple[Link, ...]:
    """The links with the places of their points."""
    result = []
    for link in links:
        points = points_of(data[link.name]) or {}
        path: Path = ("links", link.name, "points")
        places = {name: place(value, (*path, name), scope) for name, value in points.items() if value is not BAD}
        _check_distances(places, points, path, scope)
        result.append(Link(link.name, link.number, places, link.label))
    return tuple(result)


def place(value: Any, path: Path, scope: Scope) -> GivenPoint:
    """A place in a link's frame in any of the three ways of writing it."""
    if isinstance(value, list):
        x, y = pair(value, path, scope)
        return Cartesian(x, y)
    if "distances" not in value:
        r = scope.quantity(value.get("r", BAD), LENGTH, (*path, "r"))
        return Polar(r, scope.quantity(value.get("angle", BAD), ANGLE, (*path, "angle")))
    given = value["distances"]
    names = [*given, "", ""] if isinstance(given, dict) else ["", ""]
    first, second = (
        scope.quantity(given[name] if name else BAD, LENGTH, (*path, "distances", name)) for name in names[:2]
    )
    return Distances(names[0], first, names[1], second, value.get("side", "left"))


def pair(value: list[Any], path: Path, scope: Scope) -> tuple[Any, Any]:
    """[x, y] as two lengths."""
    return scope.quantity(value[0], LENGTH, (*path, 0)), scope.quantity(value[1], LENGTH, (*path, 1))


def _check_distances(places: Mapping[str, GivenPoint], points: dict[str, Any], path: Path, scope: Scope) -> None:
    """Points given by distances: the two others exist, no circles, and a triangle with these sides exists."""
    needs: dict[str, Iterable[str]] = {}
    for name, place in places.items():
        needs[name] = ()
        if not isinstance(place, Distances) or not place.first:
            continue
        needs[name] = [other for other in (place.first, place.second) if other in points]
        for other in (place.first, place.second):
            if other not in points:
                others = [point for point in points if point != name]
                scope.no_point_of(str(path[1]), other, others, (*path, name, "distances", other))
    order, circles = cycles(needs)
    for circle in circles:
        scope.report.at((*path, circle[0], "distances"), circle_message(circle, "the points"))
    where: dict[str, tuple[float, float]] = {}
    for name in order:
        where[name] = _coordinates(places[name], where, (*path, name), scope)


def _coordinates(
    place: GivenPoint, where: Mapping[str, tuple[float, float]], path: Path, scope: Scope
) -> tuple[float, float]:
    """Where a point lies in its frame; (nan, nan) when that is not known."""
    match place:
        case Cartesian(x, y):
            return scope.number(x), scope.number(y)
        case Polar(r, angle):
            length, direction = scope.number(r), scope.number(angle)
            return length * portable.cos(direction), length * portable.sin(direction)
    a, b = where.get(place.first), where.get(place.second)
    ra, rb = scope.number(place.first_distance), scope.number(place.second_distance)
    if a is None or b is None or not all(math.isfinite(value) for value in (*a, *b, ra, rb)):
        return REPORTED, REPORTED
    between = portable.hypot(b[0] - a[0], b[1] - a[1])
    slack = _ROUNDING * max(between, abs(ra), abs(rb))
    problem = say("")
    if min(ra, rb) < 0:
        problem = say("a distance is negative: {ra:.6g} and {rb:.6g}", ra=ra, rb=rb)
    elif between <= slack:
        problem = say(
            "{points} lie at the same place, so no side can be told", points=listed((place.first, place.second))
        )
    elif ra + rb < between - slack or abs(ra - rb) > between + slack:
        problem = say(
            "no point lies {ra:.6g} from {first} and {rb:.6g} from {second}: these two are {between:.6g} apart",
            ra=ra,
            first=quoted(place.first),
            rb=rb,
            second=quoted(place.second),
            between=between,
        )
    if problem:
        scope.report.at((*path, "distances"), problem)
        return REPORTED, REPORTED
    along = (ra * ra - rb * rb + between * between) / (2 * between)
    across = math.sqrt(max(ra * ra - along * along, 0.0)) * (1 if place.side == "left" else -1)
    ux, uy = (b[0] - a[0]) / between, (b[1] - a[1]) / between
    return a[0] + along * ux - across * uy, a[1] + along * uy + across * ux


def check_connected(links: tuple[Link, ...], joints: Iterable[Joint], scope: Scope) -> None:
    """Report every link from which no chain of joints leads to the ground."""
    neighbours: dict[str, set[str]] = {link.name: set() for link in links}
    groups = [*scope.points.values(), *([joint.link, joint.on] for joint in joints)]
    for group in groups:
        for member in group:
            neighbours[member].update(group)
    reached, frontier = set[str](), [links[0].name]
    while frontier:
        name = frontier.pop()
        if name not in reached:
            reached.add(name)
            frontier.extend(neighbours[name])
    for link in links:
        if link.name not in reached:
            message = say("no chain of joints leads from the link {name} to the ground", name=quoted(link.name))
            others = sorted(neighbours[link.name] - {link.name})
            hint = (
                say("it is joined to {others} only", others=listed(others))
                if others
                else say("it shares no point with another link")
            )
            scope.report.at(("links", link.name), message, hint)
