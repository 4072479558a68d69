"""The mechanism as a sheet's own numbers have it, beside the right one: in the row in which they are farthest apart.

Each link is laid at a point that it shares with one laid before, in the direction that the sheet has for it, a slide as far
along as the sheet has it: where a number is wrong, links that should be pinned together do not meet. In the SVG for a page
there is a ring.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from mechsheet import reference
from mechsheet.homework.agreement import Reading, gaps
from mechsheet.homework.judging import Judged
from mechsheet.homework.verdicts import Sheet, mostly
from mechsheet.model import Link, Mechanism
from mechsheet.reference.solution import Solution
from mechsheet.shapes.colors import INK, LINKS, QUIET
from mechsheet.shapes.positions import in_digits
from mechsheet.units import behind_number
from mechsheet.words.catalogue import said
from mechsheet.words.symbols import plain

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


# --- as SVG for a page -----------------------------------------------------------------------------------------------


SIDE = 340
"""Pixels of a picture."""

AROUND = 0.12
"""What is free around what is drawn, of its size."""

MEET = 0.004
"""Ends that are nearer than this part of the size meet."""

WRONG = "C0202B"


def pictures(found: Picture, language: str) -> str:
    """HTML: both pictures side by side, and the numbers that differ most there."""
    driver = found.mechanism.driver
    unit = behind_number(driver.unit.text)
    at = f"{plain(driver.symbol)} = {in_digits(float(driver.unit.to_shown(found.at)), 5)}{unit}"
    pairs = "; ".join(
        said(
            language,
            "page.compare",
            symbol=plain(symbol),
            theirs=_shown(found, symbol, a),
            right=_shown(found, symbol, b),
        )
        for symbol, (a, b) in found.numbers.items()
    )
    drawn = [
        (said(language, "page.theirs"), _svg(found, found.theirs, found.marks)),
        (said(language, "page.right"), _svg(found, found.right, {})),
    ]
    figures = "".join(f"<figure>{svg}<figcaption>{escape(words)}</figcaption></figure>\n" for words, svg in drawn)
    head = said(language, "page.at", at=at)
    return f'<h2>{escape(head)}</h2>\n<div class="both">\n{figures}</div>\n<p>{escape(pairs)}</p>\n'


def _shown(found: Picture, symbol: str, number: float) -> str:
    mechanism = found.mechanism
    angle = symbol in {link.angle_symbol for link in mechanism.links} or any(
        output.symbol == symbol and output.unit.kind == "angle" for output in mechanism.outputs
    )
    if angle:
        unit = mechanism.angle_unit
        return f"{in_digits(float(unit.to_shown(number)), 5)}{behind_number(unit.text)}"
    return f"{in_digits(number, 5)} {mechanism.length_unit}"


def _svg(found: Picture, laid: Laid, marks: Mapping[str, Point]) -> str:
    """One picture; both have the same scale."""
    places = [place for each in (found.theirs, found.right) for link in each.values() for place in link.values()]
    places += list(found.marks.values())
    low, high = ([min_or_max(part) for part in zip(*places, strict=True)] for min_or_max in (min, max))
    size = max(high[0] - low[0], high[1] - low[1]) or 1.0
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    scale = SIDE / (size * (1 + 2 * AROUND))

    def at(place: Point) -> str:
        return f"{SIDE / 2 + (place[0] - middle[0]) * scale:.1f},{SIDE / 2 - (place[1] - middle[1]) * scale:.1f}"

    lines = []
    ground, *moving = found.mechanism.links
    for point in ground.points:
        x, y = at(laid[ground.name][point]).split(",")
        lines.append(f'<path transform="translate({x},{y})" d="M0,0L-8,13H8ZM-12,13H12" fill="#fff" stroke="#{INK}"/>')
    for number, link in enumerate(moving):
        corners = [at(place) for place in laid[link.name].values()]
        closed = "Z" if len(corners) > 2 else ""
        color = LINKS[number % len(LINKS)]
        if len(corners) > 1:
            path = f'd="M{"L".join(corners)}{closed}" stroke="#{color}" stroke-width="5" stroke-linejoin="round"'
            lines.append(f'<path {path} stroke-linecap="round" fill="none"/>')
        else:
            x, y = corners[0].split(",")
            lines.append(
                f'<rect x="{float(x) - 11:.1f}" y="{float(y) - 7:.1f}" width="22" height="14" fill="#{color}"/>'
            )
    lines += _pins(laid, at, MEET * size)
    for point, place in marks.items():
        x, y = at(place).split(",")
        cross = f'<path transform="translate({x},{y})" d="M-6,-6L6,6M-6,6L6,-6" stroke="#{WRONG}" stroke-width="2"/>'
        lines.append(f"{cross}{_text(point, x, y)}")
    return (
        f'<svg width="{SIDE}" height="{SIDE}" viewBox="0 0 {SIDE} {SIDE}" role="img">\n' + "\n".join(lines) + "\n</svg>"
    )


def _pins(laid: Laid, at: Callable[[Point], str], near: float) -> list[str]:
    """Every point; one that links have in different places is a ring at each."""
    lines = []
    for point in dict.fromkeys(point for places in laid.values() for point in places):
        spots = [places[point] for places in laid.values() if point in places]
        torn = any(math.dist(spot, spots[0]) > near for spot in spots)
        for number, spot in enumerate(spots if torn else spots[:1]):
            x, y = at(spot).split(",")
            color, radius = (WRONG, 7) if torn else (INK, 4)
            fill = "none" if torn else "#fff"
            lines.append(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}" stroke="#{color}" stroke-width="2"/>')
            if not number:
                lines.append(_text(point, x, y))
        if torn:
            way = "L".join(map(at, spots))
            lines.append(f'<path d="M{way}" stroke="#{QUIET}" stroke-dasharray="4 4" fill="none"/>')
    return lines


def _text(point: str, x: str, y: str) -> str:
    place = f'x="{float(x) + 8:.1f}" y="{float(y) - 8:.1f}"'
    return f'<text {place} font-size="14" font-style="italic" fill="#{INK}">{escape(plain(point))}</text>'
