"""What the page shows of a description: every point in many positions, guides, curves, and what is wrong where.

All numbers are in the description's own units, angles in the unit that its readers see.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Node
from mechsheet.compiled import SHOWN_ROLES, Compiled
from mechsheet.description.parts import Parts
from mechsheet.description.text.numbers import METRES
from mechsheet.description.text.source import dotted
from mechsheet.drawing_page.positions import Point, Pose, drawn_poses, drawn_positions, line_of, local_points
from mechsheet.drawing_page.reading import SPEED, Reading, cells_of, fault_entry, first_speed, own_units
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.search import edges
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Driver, Joint, Link, Mechanism
from mechsheet.shapes.described import Described, corners, direction_of, through_of
from mechsheet.shapes.forms import Kind, Shape
from mechsheet.shapes.listing import is_cylinder
from mechsheet.shapes.loads import first_shown
from mechsheet.shapes.positions import Positions
from mechsheet.words.catalogue import Language, words
from mechsheet.words.equations import given_words, link_words

FRAMES = 180
"""Positions of an animation, about: between the rows of a sweep that steps there are further ones."""

DIGITS = 7
"""Of the largest length: places are shown on a screen."""

ACTING = ("cylinder", "spring", "damper", "load", "torque", "weight", "mass", "velocity", "gear", "belt", "rack", "cam")
"""Kinds of shapes that are drawn as the list has them; links, guides and supports the page draws so that they can be
taken hold of."""

FAINT, STRONG = 1.0, 2.25
"""Widths of lines [points] below which one only helps, and above which one is to be seen first: a cam's profile between its
circles."""

HALVINGS = 24
"""Of the stretch between two positions, to find a limit."""

ALIKE = 1e-9
"""Driver values nearer than this part of the sweep are one position."""


def look(
    reading: Reading, at: float | None, held: Mapping[str, Point], language: Language = "en", velocities: bool = False
) -> dict[str, Any]:
    """The answer to a text.

    at    the driver value that the page shows, in the driver's unit;  held: where it shows the points now
    velocities  whether those of points are drawn
    """
    parts = reading.parts
    answer: dict[str, Any] = {
        "solved": reading.compiled is not None,
        "readable": parts is not None,
        "mobility": reading.mobility,
        "faults": [fault_entry(fault, parts, language) for fault in reading.faults],
    }
    if parts is None:
        return answer
    answer |= _described(parts, reading, language)
    answer |= (
        _moving(reading.compiled, at, language, velocities) if reading.compiled is not None else _standing(parts, held)
    )
    return answer


# --- what is there ---------------------------------------------------------------------------------------------------


def _described(parts: Parts, reading: Reading, language: Language) -> dict[str, Any]:
    mechanism = reading.compiled.mechanism if reading.compiled is not None else None
    head = reading.source.data.get("mechanism") if reading.source is not None else None
    head = head if isinstance(head, dict) else {}
    name = head.get("name")
    cylinders = _cylinders(reading)
    return {
        "name": name if isinstance(name, str) else "",
        "title": mechanism.title.of(language) if mechanism is not None else "",
        "unit": parts.length_unit,
        "links": [
            {
                "name": link.name,
                "number": link.number,
                "label": link_words(link).of(language),
                "points": list(_outline(link, parts)),
            }
            for link in parts.links
        ],
        "joints": [
            {
                "name": joint.name,
                "kind": joint.kind,
                "link": joint.link,
                "on": joint.on,
                "point": joint.point,
                "cylinder": joint.name in cylinders,
            }
            for joint in parts.joints
        ],
        "driver": None if parts.driver is None else _driver(parts.driver, parts, reading),
        "dimensions": _dimensions(parts, language),
        "cells": _cells(reading, language),
        "units": _units(parts, reading),
        "undrawn": _undrawn(reading),
    }


def _cylinders(reading: Reading) -> set[str]:
    """The sliding joints that are drawn as a barrel and its rod, once there is a motion to see how long both are."""
    if reading.compiled is None:
        return set()
    known = Described(reading.compiled.mechanism, reading.compiled.equations)
    return {joint.name for joint in known.mechanism.sliding if is_cylinder(known, joint)}


def _outline(link: Link, parts: Parts) -> tuple[str, ...]:
    """The points around a link."""
    try:
        return corners(link, parts.numbers)
    except (KeyError, ArithmeticError, ValueError):
        return tuple(link.points)


def _driver(driver: Driver, parts: Parts, reading: Reading) -> dict[str, Any]:
    """What is driven, about which point, and the numbers of its sweep as they are written.

    Its symbol is that of what the positions go through: of what a cam moves the angle of the cam.
    """
    data = reading.source.data.get("driver") if reading.source is not None else None
    table = data if isinstance(data, dict) else {}
    link, base = parts.link(driver.link), parts.link(driver.relative_to)
    shared = [point for point in link.points if point in base.points] if link and base else []
    through = reading.compiled.mechanism.driver if reading.compiled is not None else driver
    return {
        "symbol": through.symbol,
        "unit": through.unit.text,
        "link": driver.link,
        "joint": driver.joint,
        "pivot": shared[0] if shared else "",
        "sweep": {key: table[key] for key in ("start", "stop", "step") if isinstance(table.get(key), int | float)},
    }


def _dimensions(parts: Parts, language: str) -> list[dict[str, Any]]:
    found = []
    for dim in parts.dimensions:
        if dim.path or dim.symbol not in parts.numbers:
            continue
        found.append(
            {
                "symbol": dim.symbol,
                "value": dim.shown if dim.shown is not None else dim.unit.to_shown(parts.numbers[dim.symbol]),
                "unit": dim.unit.text,
                "label": dim.label.of(language) if dim.label is not None else "",
                "formula": dim.written or ("" if isinstance(dim.value, float) and math.isfinite(dim.value) else "="),
            }
        )
    return found


def _units(parts: Parts, reading: Reading) -> dict[str, str]:
    """In which unit the page asks for what is drawn."""
    force, mass = own_units(reading.source)
    length = parts.length_unit
    return {
        "spring": f"{force}/{length}",
        "damper": f"{force} s/{length}",
        "force": force,
        "torque": f"{force} {'m' if length in METRES else length}",
        "mass": mass,
        "gear": "",
        "rack": length,
    }


def _cells(reading: Reading, language: Language) -> list[dict[str, Any]]:
    """Numbers given elsewhere than among the dimensions, by their places in the text; a speed that is not there yet last."""
    found: list[dict[str, Any]] = []
    for dim in cells_of(reading):
        if reading.compiled is not None and isinstance(dim.value, float):
            label = given_words(reading.compiled.mechanism, language, dim)
            value = dim.shown if dim.shown is not None else dim.unit.to_shown(dim.value)
            found.append(
                {
                    "place": dotted(dim.path),
                    "symbol": dim.symbol,
                    "value": value,
                    "unit": dim.unit.text,
                    "label": label,
                }
            )
    unit = first_speed(reading)
    if unit is not None:
        found.append({"place": dotted(SPEED), "symbol": "speed", "value": None, "unit": unit.text, "label": ""})
    return found


_EDITED_AS_TEXT = {
    "flywheel": "flywheel", "synthesis": "synthesis",
    "exercise": "exercise", "tables": "tables",
}  # fmt: skip


def _undrawn(reading: Reading) -> list[str]:
    """What the description has that the drawing does not show or change: keys of the page's words."""
    data = reading.source.data if reading.source is not None else {}
    found = [word for key, word in _EDITED_AS_TEXT.items() if key in data]
    motion = data.get("driver")
    if isinstance(motion, dict):
        found += [word for word in ("motion", "values") if word in motion]
    return found


# --- not solved ------------------------------------------------------------------------------------------------------


def _standing(parts: Parts, held: Mapping[str, Point]) -> dict[str, Any]:
    """One position, as drawn."""
    places = drawn_positions(parts, held)
    poses = drawn_poses(parts, places)
    lines = {joint.name: _standing_line(joint, poses, parts, places) for joint in parts.joints}
    return {
        "frames": {
            "driver": [0.0],
            "points": {point: [[x], [y]] for point, (x, y) in places.items()},
            "lines": {name: line for name, line in lines.items() if line is not None},
            "why": [0],
            "reasons": [""],
        },
        "at": 0,
        "curves": [],
    }


def _standing_line(
    joint: Joint, poses: Mapping[str, Pose], parts: Parts, places: Mapping[str, Point]
) -> list[list[float]] | None:
    """The guide of a sliding joint: a point of it, and its direction [rad]."""
    try:
        place, direction = line_of(joint, poses[joint.on], parts.numbers)
        x, y = places[str(joint.through)] if place is None else place
    except (KeyError, ArithmeticError, ValueError):
        return None
    return [[x], [y], [direction]]


# --- solved ----------------------------------------------------------------------------------------------------------


def driver_places(compiled: Compiled, at: float | None) -> tuple[Array, int]:
    """The driver's values of all positions that are shown [rad or length unit], and the number of that which is `at`.

    A sweep that steps has further positions between its rows, and `at` itself; others have their rows alone.
    """
    mechanism, rows = compiled.mechanism, compiled.driver
    wanted = shown_value(compiled, at)
    if not mechanism.driver.stepped or mechanism.listed_symbols or len(rows) < 2:
        return rows, int(np.argmin(np.abs(rows - wanted)))
    fine = max(1, round(FRAMES / (len(rows) - 1)))
    span = float(rows[-1] - rows[0])
    between = rows[:-1, None] + np.diff(rows)[:, None] * (np.arange(fine) / fine)
    driver = np.append(between.ravel(), rows[-1])
    nearest = int(np.argmin(np.abs(driver - wanted)))
    if abs(driver[nearest] - wanted) <= ALIKE * abs(span):
        return driver, nearest
    place = int(np.searchsorted(driver if span > 0 else -driver, wanted if span > 0 else -wanted))
    return np.insert(driver, place, wanted), place


def shown_value(compiled: Compiled, at: float | None) -> float:
    """The driver value that is shown [rad or length unit]: `at`, that of the sketch, or a workbook's first one."""
    mechanism, rows = compiled.mechanism, compiled.driver
    if at is not None and math.isfinite(at):
        found = mechanism.driver.unit.to_internal(at)
    elif mechanism.sketch.at is not None:
        found = number(mechanism.sketch.at, dimension_values(mechanism))
    else:
        found = float(rows[first_shown(mechanism, compiled.closed, compiled.values)])
    low, high = float(np.min(rows)), float(np.max(rows))
    if not mechanism.driver.joint and not low <= found <= high:  # the same position, a turn further
        turned = found + math.tau * np.arange(-3, 4)
        inside = turned[(turned >= low - ALIKE) & (turned <= high + ALIKE)]
        found = float(inside[0]) if len(inside) else found
    return found


def values_at(compiled: Compiled, driver: Array) -> dict[str, Array]:
    """Every symbol's values at values of the driver."""
    if len(driver) == len(compiled.driver) and np.array_equal(driver, compiled.driver):
        return dict(compiled.values)
    return sweep(compiled.mechanism, compiled.equations, driver)


def _moving(compiled: Compiled, at: float | None, language: Language, velocities: bool) -> dict[str, Any]:
    """All positions of the sweep."""
    mechanism, equations = compiled.mechanism, compiled.equations
    driver, shown = driver_places(compiled, at)
    values = values_at(compiled, driver)
    size = largest_length(mechanism, dimension_values(mechanism)) or 1.0
    digits = max(0, DIGITS - math.floor(math.log10(size)))
    names = dict.fromkeys(point for link in mechanism.links for point in link.points)
    fixed = local_points(mechanism.ground, dimension_values(mechanism))
    points = {
        name: [[_rounded(fixed[name][0], digits)], [_rounded(fixed[name][1], digits)]]
        if name in fixed
        else [_column(values[f"{name}.{axis}"], digits) for axis in "xy"]
        for name in names
    }
    why, reasons = _why(compiled, values, len(driver), language)
    unit = mechanism.driver.unit
    return {
        "frames": {
            "driver": [round(unit.to_shown(float(each)), 9) for each in driver],
            "points": points,
            "lines": {joint.name: _line(mechanism, joint, values, digits) for joint in mechanism.joints},
            "why": why,
            "reasons": reasons,
        },
        "at": shown,
        "shapes": _shapes(_Frames(mechanism, equations, driver, values), digits, velocities),
        "limits": [round(float(unit.to_shown(each)), 6) for each in _limits(compiled, driver, np.array(why) == 0)],
        "curves": _curves(mechanism, equations.columns, values, language),
    }


@dataclass(frozen=True, slots=True)
class _Frames:
    """A mechanism in the positions of the page."""

    mechanism: Mechanism
    equations: Equations
    driver: Array
    values: Mapping[str, Array]


def _shapes(frames: _Frames, digits: int, velocities: bool) -> list[dict[str, Any]]:
    """Of the list of shapes what the page does not draw by itself: a path in a frame whose vectors have a column for each
    part, or corners that have one."""
    vectors: tuple[Kind, ...] = ("velocity",) if velocities else ()
    found = Positions(frames, vectors)
    shapes = []
    marks = dict.fromkeys(shape.name for shape in found.list.shapes if shape.kind == "mass")
    dynamics = frames.mechanism.dynamics
    bodies = [mass.link for mass in dynamics.masses if mass.mass is not None] if dynamics is not None else []
    weighed = dict(zip(marks, bodies, strict=False))  # each has one mark, in their order
    for shape in found.list.shapes:
        if isinstance(shape, Shape) and shape.kind in ACTING:
            columns = found.columns(shape)
            curve = found.curve(shape) if shape.is_curve else np.zeros((0, 2))
            path = [[_rounded(part, digits) for part in place] for place in curve[np.isfinite(curve).all(axis=1)]]
            shapes.append(
                {
                    "kind": shape.kind,
                    "name": shape.name,
                    "of": weighed.get(shape.name, "") if shape.kind == "mass" else "",
                    "filled": {"": "", "FFFFFF": "paper"}.get(shape.fill, "own"),
                    "line": "faint" if shape.width < FAINT else "strong" if shape.width > STRONG else "",
                    "path": path or shape.path,
                    "places": [[_short(part, digits) for part in vector.T] for vector in np.moveaxis(columns, 1, 0)],
                }
            )
    return shapes


def _short(column: Array, digits: int) -> list[float | None]:
    """A column for JSON; of one value that is the same in every position once."""
    found = _column(column, digits)
    return found[:1] if all(each == found[0] for each in found) else found


def _limits(compiled: Compiled, driver: Array, closes: NDArray[np.bool_]) -> Array:
    """Driver values at which it begins or stops closing, by halving between two positions; of a sweep that steps."""
    equations = compiled.equations
    if not compiled.mechanism.driver.stepped or any(group.system for group in equations.groups):
        return np.zeros(0)

    def exists(values: Array) -> NDArray[np.bool_]:
        return equations.closed(sweep(compiled.mechanism, equations, values))

    return edges(driver, closes, exists, HALVINGS)


def _rounded(number: float, digits: int) -> float:
    return round(float(number), digits) + 0.0


def _column(column: Array, digits: int) -> list[float | None]:
    """A column for JSON: rounded, None where there is no position."""
    return [each if math.isfinite(each) else None for each in np.round(column, digits).tolist()]


def _line(mechanism: Mechanism, joint: Joint, values: Mapping[str, Array], digits: int) -> list[list[float | None]]:
    """The guide of a sliding joint: a point of it in the ground's frame, and its direction [rad], in every position."""

    def column(node: Node, own: int) -> list[float | None]:
        found = np.asarray(value(node, values), float)
        return _column(found.reshape(1) if found.ndim == 0 else found, own)

    x, y = through_of(mechanism, joint)
    return [column(x, digits), column(y, digits), column(direction_of(mechanism, joint), DIGITS)]


def _why(
    compiled: Compiled, values: Mapping[str, Array], count: int, language: Language
) -> tuple[list[int], list[dict[str, Any]]]:
    """Of every position the reason (an index) why there is none, 0 where there is one; and the reasons in words."""
    found = np.zeros(count, int)
    reasons: list[dict[str, Any]] = [{"text": "", "links": []}]
    for group in compiled.equations.groups:
        open_here = (found == 0) & ~np.isfinite(values[group.closes])
        if np.any(open_here):
            key = "status.newton" if group.system is not None else "status.open"
            reasons.append(
                {
                    "text": words(language, key, links=group.label.of(language)),
                    "links": [
                        name for name in group.links if any(link.name == name for link in compiled.mechanism.links)
                    ],
                }
            )
            found[open_here] = len(reasons) - 1
    return found.tolist(), reasons


def _curves(
    mechanism: Mechanism, columns: Any, values: Mapping[str, Array], language: Language
) -> list[dict[str, Any]]:
    """Variables and outputs over the driver, and rates where there are any, with their units."""
    found = []
    count = len(values[mechanism.driver.symbol])
    for equation in columns:
        if equation.role not in SHOWN_ROLES or equation.role == "point" or equation.symbol == mechanism.driver.symbol:
            continue
        column = np.broadcast_to(values.get(equation.symbol, np.array(math.nan)), (count,))
        if not np.any(np.isfinite(column)):
            continue
        unit = mechanism.shown(equation.unit)
        shown = unit.to_shown(column)
        found.append(
            {
                "symbol": equation.symbol,
                "unit": unit.text,
                "label": equation.label.of(language),
                "role": equation.role,
                "values": [float(f"{each:.7g}") if math.isfinite(each) else None for each in shown.tolist()],
            }
        )
    return found
