"""Links and sliding joints that may be left out: with them the count says that nothing moves, and it moves all the same.

Gruebler's criterion counts joints and knows no lengths. Side rods of a locomotive with three axles, the third crank of a
parallelogram, two guides side by side are counted as rigid although they move. So each candidate is left out, the rest is
solved, and the condition that it stood for is measured over the whole sweep. Source: texts on
mobility, "redundant constraints".
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import combinations, islice

import numpy as np

from livesheet import portable
from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.build_equations import write_equations, write_stepped
from mechsheet.kinematics.dimensions import dimension_values, extent
from mechsheet.kinematics.doubts.sketched import assemblies
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.graph import graph_of
from mechsheet.kinematics.mobility import mobility
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.points_in_link import number, number_points
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Joint, Link, Mechanism, Rack, Sketch

HOLDS = 1e-7
"""A condition that is met within this part of the size, in every position, is met by itself."""

MOST_TRIED = 200
"""So many ways of leaving something out are tried, then the count is all that is told."""

ALIKE = 1e-6
"""A link whose length is met within this part of the size, where the sketch shows it and around, is taken as redundant."""

AROUND = np.arange(-3, 4)
NEAR = math.radians(1.0), 0.01
"""Where that is asked: so many small steps of the driver, of an angle or in parts of its sweep."""

MOST_LEFT_OUT = 2
"""So many links are looked for together at most: a fourth crank, two side rods."""

MOST_SETS = 60
"""So many sets of them are tried."""

LEAST_AROUND = 5
LEAST_ROWS = 3
MOST_ROWS = 60

Part = Link | Joint


def redundancy_faults(mechanism: Mechanism, missing: int) -> list[Fault]:
    """What may be left out so that `missing` more degrees of freedom are counted; none when it does not move.

    One fault for each link or joint that alone would do; for the first set that does where one alone is not enough.
    """
    candidates = _candidates(mechanism)
    tried = (
        found
        for count in range(1, missing + 1)
        for found in combinations(candidates, count)
        if sum(gain for _, gain in found) == missing
    )
    parts: dict[str, Fault] = {}
    for found in islice(tried, MOST_TRIED):
        left_out = [part for part, _ in found]
        if (len(left_out) > 1 and parts) or not _moves(mechanism, left_out):
            continue
        for part in left_out:
            others = [other.name for other in left_out if other is not part]
            parts.setdefault(part.name, _fault(mechanism, part, others))
    return list(parts.values())


def redundant_links(mechanism: Mechanism) -> tuple[tuple[str, ...], ...]:
    """The sets of links that may be left out together, as many as freedoms lack in the count; those described last first.

    Without them the others stand as sketched and move, their lengths are met there and around, and whichever set is left
    out, every point goes the same way. None where no links do so, or where it depends on them how the rest moves.
    """
    missing = 1 + len(mechanism.drivers) - mobility(graph_of(mechanism))
    if not 1 <= missing <= MOST_LEFT_OUT:
        return ()
    found: list[tuple[tuple[str, ...], _Around]] = []
    links = [part for part, _ in _candidates(mechanism) if isinstance(part, Link)]
    for parts in islice(combinations(links, missing), MOST_SETS):
        around = _around(mechanism, parts)
        if around is not None:
            found.append((tuple(part.name for part in parts), around))
    for _, other in found[1:]:
        first = found[0][1]
        places = [name for name in other.values if name.endswith((".x", ".y")) and name in first.values]
        apart = max(float(np.nanmax(np.abs(other.values[name] - first.values[name]))) for name in places)
        if apart > ALIKE * first.size:
            return ()
    return tuple(names for names, _ in found)


@dataclass(frozen=True, slots=True)
class _Around:
    """Positions of a mechanism around the one that is sketched, and its size."""

    values: dict[str, Array]
    size: float


def _around(mechanism: Mechanism, links: tuple[Link, ...]) -> _Around | None:
    """What the others do around the position that is sketched; None where one of the links does not fit."""
    rest = _without(mechanism, [*links])
    points = {point for other in rest.links for point in other.points}
    own = {link.angle_symbol for link in links}
    sketch = replace(
        mechanism.sketch,
        points={point: place for point, place in mechanism.sketch.points.items() if point in points},
        symbols={name: value for name, value in mechanism.sketch.symbols.items() if name not in own},
    )
    dimensions = dimension_values(mechanism)
    driver = driver_values(mechanism, dimensions)
    try:
        equations = write_stepped(replace(rest, sketch=sketch))
        closed = equations.closed(sweep(rest, equations, driver))
    except MechanismError:
        return None
    if not closed.any():
        return None
    here = driver[int(np.argmax(closed))] if mechanism.sketch.at is None else number(mechanism.sketch.at, dimensions)
    step = NEAR[1] * float(np.ptp(driver)) if mechanism.driver.joint else NEAR[0]
    values = sweep(rest, equations, np.asarray(here + step * AROUND, dtype=np.float64))
    size = extent(rest, values)
    gap = np.max([_gap(mechanism, link, values) for link in links], axis=0) / size
    there = np.isfinite(gap)
    if there.sum() < LEAST_AROUND or not there[AROUND == 0].all() or np.any(gap[there] > ALIKE):
        return None
    return _Around(values, size)


def _candidates(mechanism: Mechanism) -> list[tuple[Part, int]]:
    """Links with two revolute joints and nothing else at them, and sliding joints; each with the freedoms that it takes."""
    driver = mechanism.driver
    used = {driver.link, driver.relative_to, mechanism.ground.name}
    for joint in mechanism.joints:
        used |= {joint.link, joint.on}
    used |= {name for other in mechanism.drivers for name in (other.link, other.relative_to)}
    used |= {name for relation in mechanism.relations for name in relation.turning}
    kept = {driver.joint, *(other.joint for other in mechanism.drivers)}
    kept |= {relation.joint for relation in mechanism.relations if isinstance(relation, Rack)}
    links = [(link, 1) for link in mechanism.links if link.name not in used and len(_shared(mechanism, link)) == 2]
    joints = [
        (joint, 2 if joint.kind == "prismatic" else 1)
        for joint in mechanism.joints
        if not {joint.name, joint.symbol} & kept
    ]
    return [*reversed(links), *reversed(joints)]  # what was described last was added last


def _shared(mechanism: Mechanism, link: Link) -> list[str]:
    """The points at which a link is joined to others."""
    return [point for point in link.points if sum(point in other.points for other in mechanism.links) > 1]


def _moves(mechanism: Mechanism, left_out: list[Part]) -> bool:
    """Whether the rest moves, and keeps the conditions of what was left out over the whole sweep."""
    rest = _without(mechanism, left_out)
    try:
        if mobility(graph_of(rest)) != 1 + len(rest.drivers):
            return False
        equations = write_equations(rest, None)
    except MechanismError:
        return False
    dimensions = dimension_values(mechanism)
    driver = driver_values(mechanism, dimensions)
    driver = driver[:: math.ceil(len(driver) / MOST_ROWS)]
    least = np.full(len(driver), np.inf)
    for assembly in assemblies(equations):
        values = sweep(rest, assembly, driver)
        gaps = np.max([_gap(mechanism, part, values) for part in left_out], axis=0) / extent(rest, values)
        least = np.fmin(least, gaps)  # row by row: at a change point the mechanism goes over into the other assembly
    there = np.isfinite(least)
    return bool(there.sum() >= min(LEAST_ROWS, len(driver)) and np.all(least[there] <= HOLDS))


def _without(mechanism: Mechanism, left_out: list[Part]) -> Mechanism:
    names = {part.name for part in left_out if isinstance(part, Link)}
    slides = {part.symbol for part in left_out if isinstance(part, Joint)}
    return replace(
        mechanism,
        # Numbers stay: they name the angles.
        links=tuple(link for link in mechanism.links if link.name not in names),
        joints=tuple(joint for joint in mechanism.joints if joint.symbol not in slides),
        sketch=Sketch(),
        outputs=(), summaries=(), charts=(), tables=(),
    )  # fmt: skip


def _gap(mechanism: Mechanism, part: Part, values: dict[str, Array]) -> Array:
    """How far each row misses the condition of a part that was left out, as a length."""
    dimensions = dimension_values(mechanism)
    if isinstance(part, Link):
        first, second = _shared(mechanism, part)
        places = number_points(part, dimensions)
        (x, y), (x2, y2) = places[first], places[second]
        length = portable.hypot(x2 - x, y2 - y)
        apart = portable.hypot(
            values[f"{first}.x"] - values[f"{second}.x"], values[f"{first}.y"] - values[f"{second}.y"]
        )
        return np.asarray(np.abs(apart - length))
    on = mechanism.link(part.on)
    base = number_points(on, dimensions)
    u, v = base[part.through] if isinstance(part.through, str) else (number(x, dimensions) for x in part.through)
    theta = _angle(mechanism, on, values)
    # From a point of the link whose place is known; the ground's own frame needs none.
    anchor = "" if on is mechanism.ground else next(iter(base))
    x0, y0 = (values[f"{anchor}.x"], values[f"{anchor}.y"]) if anchor else (0.0, 0.0)
    du, dv = (u - base[anchor][0], v - base[anchor][1]) if anchor else (u, v)
    x = x0 + du * portable.cos(theta) - dv * portable.sin(theta)
    y = y0 + du * portable.sin(theta) + dv * portable.cos(theta)
    line = theta + number(part.angle, dimensions)
    across = np.abs(
        (values[f"{part.point}.y"] - y) * portable.cos(line) - (values[f"{part.point}.x"] - x) * portable.sin(line)
    )
    if part.kind == "pin-slot":
        return np.asarray(across)
    body = mechanism.link(part.link)
    turned = _angle(mechanism, body, values) - line - number(part.orientation, dimensions)
    return np.asarray(across + np.abs(portable.sin(turned / 2)) * extent(mechanism, values))


def _angle(mechanism: Mechanism, link: Link, values: dict[str, Array]) -> Array:
    if link is mechanism.ground:
        return np.zeros(len(values[mechanism.driver.symbol]))
    return values[link.angle_symbol]


def _place_in_file(mechanism: Mechanism, joint: Joint) -> int:
    """The place of a sliding joint among all joints of the file, between which gears stand."""
    place = mechanism.joints.index(joint)
    for order in sorted(relation.order for relation in mechanism.relations):
        place += order <= place
    return place


def _fault(mechanism: Mechanism, part: Part, others: list[str]) -> Fault:
    key = f"links.{part.name}" if isinstance(part, Link) else f"joints.{_place_in_file(mechanism, part)}"
    together: str = ""
    for other in others:
        together = say('{before} together with "{other}"', before=together, other=other)
    message = say(
        'the sliding joint "{name}" is redundant and may be left out{together}: the rest moves in the same way without it',
        name=part.name,
        together=together,
    )
    hint = say(
        "leave it out of the description (its points can be points of another link, its forces are another matter)"
    )
    if isinstance(part, Link):
        message = say(
            'the link "{name}" is redundant and may be left out{together}: the rest moves in the same way without it',
            name=part.name,
            together=together,
        )
        hint = say("write `redundant = true` under it: it follows the others, and its length is checked in every row")
    return Fault(message, key=key, hint=hint)
