"""The mechanism as a sheet's own numbers have it, beside the right one: in the row in which they are farthest apart.

Each link is laid at a point that it shares with one laid before, in the direction that the sheet has for it, a slide as far
along as the sheet has it: where a number is wrong, links that should be pinned together do not meet.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechsheet import reference
from mechsheet.homework.agreement import Reading, gaps
from mechsheet.homework.judging import Judged
from mechsheet.homework.verdicts import Sheet, mostly
from mechsheet.model import Link, Mechanism
from mechsheet.reference.solution import Solution

Point = tuple[float, float]
Laid = Mapping[str, Mapping[str, Point]]
"""Link -> its points in the ground's frame."""

SHOWN = ("wrong", "other assembly")
"""Verdicts of what differs from the mechanism in most rows."""


@dataclass(frozen=True, slots=True)
class Picture:
    """Both of them.

    at        the driver's value in the row shown [rad or length unit]
    theirs, right  link by link where its points are;  marks  points whose coordinates the sheet gives, as it has them
    numbers   what is asked and wrong: (as the sheet has it, as it is), in internal units
    """

    mechanism: Mechanism
    at: float
    theirs: Laid
    right: Laid
    marks: Mapping[str, Point]
    numbers: Mapping[str, tuple[float, float]]


def picture_of(part: Judged) -> Picture | None:
    """The picture of a table; None where nothing wrong in it can be drawn, or it looks as it should."""
    truth, sheet = part.found.truth, Sheet(part.found, tuple(part.asked))
    columns = {}
    for symbol in part.asked:
        finding = part.first[symbol]
        if finding.series is not None and truth.kinds.get(symbol) in ("angle", "length"):
            quantity = truth.quantity(symbol)
            column = sheet.column(finding.series)
            reading = finding.reading or mostly(sheet, truth, symbol, finding.series)
            columns[symbol] = (reading or Reading(part.found.meant_unit(column, quantity))).of(column)
    wrong = [symbol for symbol in columns if part.first[symbol].verdict in SHOWN]
    if not wrong:
        return None
    apart = gaps(columns[wrong[0]], truth.quantity(wrong[0]), Reading())
    apart = np.where(np.isfinite(apart) & truth.exists, apart, -1.0)
    row = int(np.argmax(apart))
    if apart[row] <= 0:
        return None
    solution = reference.solve(truth.mechanism, truth.dimensions, start=truth.poses, values=truth.driver)
    here = {symbol: float(column[row]) for symbol, column in columns.items() if math.isfinite(column[row])}
    right = {
        link.name: {point: _point(solution, point, row) for point in link.points} for link in truth.mechanism.links
    }
    theirs = _laid(truth.mechanism, solution, row, here, right)
    marks = {point: (here[f"{point}.x"], here[f"{point}.y"]) for point in solution.points if _both(point, here)}
    if not _differ(theirs, marks, right, part.found.tolerance * truth.size):
        return None
    numbers = {symbol: (here[symbol], float(truth.columns[symbol][row])) for symbol in wrong if symbol in here}
    return Picture(truth.mechanism, float(truth.driver[row]), theirs, right, marks, numbers)


def _differ(theirs: Laid, marks: Mapping[str, Point], right: Laid, allowed: float) -> bool:
    """Whether anything lies elsewhere than it should: what is wrong may be no place of a link, as the length of a spring."""
    laid = [(place, right[link][point]) for link, places in theirs.items() for point, place in places.items()]
    told = [(place, places[point]) for point, place in marks.items() for places in right.values() if point in places]
    return any(math.dist(place, wanted) > allowed for place, wanted in laid + told)


def _point(solution: Solution, point: str, row: int) -> Point:
    x, y = solution.points[point][row]
    return float(x), float(y)


def _both(point: str, here: Mapping[str, float]) -> bool:
    return f"{point}.x" in here and f"{point}.y" in here


def _laid(mechanism: Mechanism, solution: Solution, row: int, here: Mapping[str, float], right: Laid) -> Laid:
    """Every link in the direction that the sheet has, at the first point that it shares with one that lies there already;
    what slides on the ground as far along as the sheet has it, so that wrong numbers of it part it from its neighbours."""
    laid: dict[str, Mapping[str, Point]] = {mechanism.ground.name: right[mechanism.ground.name]}
    waiting = list(mechanism.links[1:])
    while waiting:
        link, held = _next(waiting, laid)
        waiting.remove(link)
        own = right[link.name]
        slid = _slid(mechanism, solution, row, here, link, own)
        if slid is not None or not held:
            laid[link.name] = own if slid is None else slid
            continue
        turn = here.get(link.angle_symbol, math.nan) - float(solution.poses[link.name][row][2])
        turn = turn if math.isfinite(turn) else 0.0
        there = next(places[held] for places in laid.values() if held in places)
        laid[link.name] = {point: _turned(place, own[held], there, turn) for point, place in own.items()}
    return laid


def _next(waiting: Sequence[Link], laid: Laid) -> tuple[Link, str]:
    """The next link in the file's order that shares a point with one that is laid; else one that only slides."""
    for link in waiting:
        held = next((point for point in link.points if any(point in places for places in laid.values())), "")
        if held:
            return link, held
    return waiting[0], ""


def _turned(place: Point, about: Point, there: Point, turn: float) -> Point:
    dx, dy = place[0] - about[0], place[1] - about[1]
    c, s = math.cos(turn), math.sin(turn)
    return there[0] + dx * c - dy * s, there[1] + dx * s + dy * c


def _slid(
    mechanism: Mechanism, solution: Solution, row: int, here: Mapping[str, float], link: Link, own: Mapping[str, Point]
) -> Mapping[str, Point] | None:
    """A link that slides on the ground, as far as the sheet has it; None for any other."""
    for joint in mechanism.sliding:
        if joint.link == link.name and joint.on == mechanism.ground.name and joint.symbol in here:
            s = solution.displacements[joint.symbol]
            other = int(np.nanargmax(np.abs(s - s[row])))
            way = (solution.points[joint.point][other] - solution.points[joint.point][row]) / (s[other] - s[row])
            dx, dy = ((here[joint.symbol] - float(s[row])) * way).tolist()
            return {point: (x + dx, y + dy) for point, (x, y) in own.items()}
    return None
