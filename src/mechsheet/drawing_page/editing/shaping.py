"""A point was dragged, or a number typed: the dimensions of the text, and its sketch as it is drawn now."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.description.overrides import scope_for, typed_value, with_values
from mechsheet.description.parts import Parts
from mechsheet.description.text.numbers import typed_number
from mechsheet.description.text.rewrite import number_text, with_last_key, with_number, with_value, without_key
from mechsheet.description.text.source import Source
from mechsheet.diagnostics import DescriptionError, MechsheetError, quoted
from mechsheet.drawing_page.fitting import Fit, fitted
from mechsheet.drawing_page.looking import shown_value, values_at
from mechsheet.drawing_page.positions import (
    Point,
    Pose,
    drawn_pose,
    drawn_poses,
    drawn_positions,
    line_of,
    local_points,
    turned,
)
from mechsheet.drawing_page.questions import Impossible
from mechsheet.drawing_page.reading import Reading, read
from mechsheet.kinematics.points_in_link import number
from mechsheet.library.modes_from_sketch import with_modes
from mechsheet.units import NUMBER, Unit

DIGITS = 5
"""Of the mechanism's size: a dragged length is rounded to so many."""

NOTHING = 0.5
"""A drag that no number follows, and that misses this part of its way, cannot be done."""

OFF = 0.02
"""A point that lies farther from where it was drawn than this part of the size is in another assembly."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """The position that the page shows.

    places  of all points;  poses: of all links
    at      the driver's value in its own unit; None where there is no driver, or no position follows from it
    """

    places: Mapping[str, Point]
    poses: Mapping[str, Pose]
    at: float | None = None


def drawn_now(reading: Reading, at: float | None, held: Mapping[str, Point]) -> Drawn:
    """The position that the page shows: of a mechanism that can be solved that at `at`, else as it was drawn."""
    parts = reading.parts
    if parts is None:
        return Drawn({}, {})
    places = drawn_positions(parts, held)
    compiled = reading.compiled
    if compiled is None:
        return Drawn(places, drawn_poses(parts, places), at)
    shown = shown_value(compiled, at)
    values = values_at(compiled, np.array([shown]))
    for point in places:
        x, y = (float(values[f"{point}.{axis}"][0]) for axis in "xy")
        places[point] = (x, y) if math.isfinite(x + y) else held.get(point, places[point])
    poses = {}
    for link in parts.links:
        pose = drawn_pose(link, parts, places)
        turn = float(values[link.angle_symbol][0]) if link is not parts.links[0] else 0.0
        if math.isfinite(turn) and link is not parts.links[0] and link.points:
            point = next(iter(link.points))
            pose = turned(turn, local_points(link, parts.numbers)[point], places[point])
        poses[link.name] = pose
    return Drawn(places, poses, float(compiled.mechanism.driver.unit.written(shown)))


def size_of(places: Mapping[str, Point]) -> float:
    """The larger side of what is drawn."""
    if not places:
        return 1.0
    spans = [
        max(place[axis] for place in places.values()) - min(place[axis] for place in places.values()) for axis in (0, 1)
    ]
    return max(spans) or 1.0


def digits_for(size: float) -> int:
    """Decimals of a length."""
    return max(0, DIGITS - 1 - math.floor(math.log10(size)))


Edited: TypeAlias = tuple[str, float | None]
"""A text, and the driver value at which the page shows it, in its own unit."""


def moved(reading: Reading, point: str, to: Point, at: float | None, held: Mapping[str, Point]) -> Edited:
    """The text with the point where it was dragged."""
    source, parts = reading.source, reading.parts
    if source is None or parts is None or not parts.links_at(point):
        return reading.text, at
    before = drawn_now(reading, at, held)
    places = {**before.places, point: to}
    size = size_of(before.places)
    fit = fitted(parts, places, point, before.poses, size)
    source = _with_fit(source, parts, fit, digits_for(size))
    if source.text == reading.text and fit.missed * size > NOTHING * math.dist(to, before.places[point]):
        raise Impossible("nothing_follows", point=point)
    after = Drawn(places, {**before.poses, **fit.poses}, before.at)
    after = replace(after, at=_driven(reading, after))
    return as_drawn(source, reading, after, (point,)).text, after.at


def _with_fit(source: Source, parts: Parts, fit: Fit, digits: int) -> Source:
    """The numbers of a fit, rounded, where they differ from those that stand there."""
    for symbol, value in fit.dimensions.items():
        dim = next(dim for dim in parts.dimensions if dim.symbol == symbol)
        own = digits if dim.unit.kind == "length" else 2 if dim.unit.in_degrees else 5
        old, new = dim.unit.to_shown(parts.numbers[symbol]), round(dim.unit.to_shown(value), own)
        if abs(new - old) > 0.5 * 10.0**-own:
            source = with_number(source, ("dimensions", symbol), new)
    for path, value in fit.plain.items():
        angle = path[-1] == "angle"
        unit = parts.angle_unit
        own = digits if not angle else 2 if unit.in_degrees else 5
        new = round(unit.to_shown(value) if angle else value, own) + 0.0
        text = source.text[source.spots[path].start : source.spots[path].end] if path in source.spots else "0"
        if abs(new - _plain(text)) > 0.5 * 10.0**-own:
            source = with_number(source, path, new)
    return source


def _plain(text: str) -> float:
    try:
        return float(text.replace("_", ""))
    except ValueError:
        return math.nan


def _driven(reading: Reading, drawn: Drawn) -> float | None:
    """The driver's value in a position, in its own unit; None where there is no driver.

    Where further drivers or gears decide about links as well, it stays what it was: lengths alone change.
    """
    parts = reading.parts
    driver = parts.driver if parts is not None else None
    if (
        parts is None
        or driver is None
        or parts.relations
        or "drivers" in (reading.source.data if reading.source else {})
    ):
        return drawn.at
    if driver.joint:
        return slid(parts, driver.joint, drawn)
    if not {driver.link, driver.relative_to} <= drawn.poses.keys():
        return drawn.at
    value = driver.unit.to_shown(drawn.poses[driver.link].turn - drawn.poses[driver.relative_to].turn)
    turn = driver.unit.to_shown(math.tau)
    if drawn.at is not None:
        value += turn * round((drawn.at - value) / turn)
    return round(value, 2 if driver.unit.in_degrees else 5) + 0.0


def slid(parts: Parts, name: str, drawn: Drawn) -> float | None:
    """The displacement of a sliding joint in a position."""
    joint = next((joint for joint in parts.joints if joint.name == name), None)
    if joint is None:
        return None
    place, direction = line_of(joint, drawn.poses[joint.on], parts.numbers)
    x, y = drawn.places[str(joint.through)] if place is None else place
    px, py = drawn.places[joint.point]
    along = (px - x) * math.cos(direction) + (py - y) * math.sin(direction)
    return round(along, digits_for(size_of(drawn.places))) + 0.0


def as_drawn(source: Source, reading: Reading, drawn: Drawn, points: tuple[str, ...]) -> Source:
    """The text with its sketch as it is drawn: the points that it names, and the driver value at which they are there.

    points  those that were moved: they are named where the sketch would mean another assembly without them
    """
    parts, places = reading.parts, drawn.places
    if parts is None:
        return source
    digits = max(0, digits_for(size_of(places)) - 1)
    fixed = parts.links[0].points if parts.links else {}
    told = _with_at(source, reading, parts, drawn.at)
    moved_on = told is not source  # the sketch shows another driver value now, and all else of it must follow
    source = told
    for point in parts.sketch.points:
        if point in places and point not in fixed and (moved_on or point in points):
            source = with_sketched(source, point, places[point], digits)
    for symbol in parts.sketch.symbols if moved_on else ():
        source = _without_old_angle(source, symbol, places, digits)
    new = read(source.text, source.file)
    if new.compiled is None:
        return source
    for point in points:
        there = drawn_now(new, drawn.at, places).places.get(point)
        if there is None or point in fixed or math.dist(there, places[point]) <= OFF * size_of(places):
            continue
        tried = with_sketched(source, point, places[point], digits)
        if read(tried.text, tried.file).compiled is not None:
            source = tried
    return source


def with_sketched(source: Source, point: str, place: Point, digits: int) -> Source:
    """The sketch with a point."""
    x, y = (round(value, digits) + 0.0 for value in place)
    if ("assembly", point, 1) in source.spots:
        for index, value in enumerate((x, y)):
            path = ("assembly", point, index)
            spot = source.spots[path]
            if _plain(source.text[spot.start : spot.end]) != value:
                source = with_number(source, path, value)
        return source
    return with_last_key(source, ("assembly",), point, f"[{number_text(x)}, {number_text(y)}]")


def _without_old_angle(source: Source, symbol: str, places: Mapping[str, Point], digits: int) -> Source:
    """A sketched angle or displacement is of the position before: the points say it now."""
    spot = source.spots.get(("assembly", symbol))
    if spot is None:
        return source
    found = read(source.text, source.file)
    source = without_key(source, ("assembly", symbol))
    fixed = found.parts.links[0].points if found.parts is not None and found.parts.links else {}
    for point, place in places.items():
        if point not in fixed and ("assembly", point) not in source.spots:
            source = with_sketched(source, point, place, digits)
    return source


def _with_at(source: Source, reading: Reading, parts: Parts, at: float | None) -> Source:
    """The driver value that the sketch shows; nothing where it is that of the first row, as the description has it."""
    if at is None:
        return source
    there = ("assembly", "at") in source.spots
    first = math.nan
    if reading.compiled is not None:
        first = reading.compiled.mechanism.driver.unit.to_shown(float(reading.compiled.driver[0]))
    elif parts.driver is not None and isinstance(parts.driver.start, float):
        first = parts.driver.unit.to_shown(parts.driver.start)
    if not there and math.isclose(at, first, abs_tol=1e-9):
        return source
    if there and parts.sketch.at is not None:
        unit = parts.driver.unit if parts.driver is not None else parts.angle_unit
        if math.isclose(unit.to_shown(number(parts.sketch.at, parts.numbers)), at, abs_tol=5e-3):
            return source
    return with_number(source, ("assembly", "at"), at)


SWEEP = {f"driver.{key}": key for key in ("start", "stop", "step")}


def _swept(source: Source, key: str, value: str, unit: Unit) -> str:
    """The text with a number of the driver's sweep, in `unit` or with its own. Raises DescriptionError for others."""
    number, option = typed_number(value), f"driver.{key}"
    text = None if number is None else number.text
    if number is not None and number.unit:
        scope = scope_for(source, option)
        text = typed_value(value, unit, "the driver's", scope)
        if text is None:
            raise DescriptionError(scope.report.faults)
    if text is None:
        raise DescriptionError(Fault(say("{value} is no number", value=quoted(value)), source.file, key=option))
    return with_value(source, ("driver", key), text).text


# --- numbers that were typed -----------------------------------------------------------------------------------------


def typed(reading: Reading, name: str, value: str) -> str:
    """The text with a dimension, or with `start`, `stop` or `step` of the driver, as it was typed; modes stay.

    Raises DescriptionError for what is no such number.
    """
    source = reading.source
    if source is None:
        return reading.text
    if name in SWEEP:
        driver = None if reading.parts is None else reading.parts.driver
        return _swept(source, SWEEP[name], value, NUMBER if driver is None else driver.unit)
    new, faults = with_values(source, [(name, value)])
    if faults:
        raise DescriptionError(faults)
    compiled = reading.compiled
    if compiled is None:
        return new.text
    try:
        return with_modes(new, compiled.modes).text
    except MechsheetError:  # it cannot be joined any more: then the text says what was typed
        return new.text
