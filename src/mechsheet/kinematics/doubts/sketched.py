"""What the sketch shows: the position it is read at, and doubts whether that is the position it was drawn at.

A sketch drawn at 40 degrees and read at the first row may lie nearer to the assembly that is not meant. So the sketch is
held against the whole sweep, in every assembly: where it fits another driver value much better, that value is named.
"""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from livesheet import portable
from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import DescriptionWarning
from mechsheet.kinematics.build_equations import write_equations
from mechsheet.kinematics.dimensions import dimension_values, extent
from mechsheet.kinematics.doubts.base_circle import base_circle_doubts
from mechsheet.kinematics.doubts.slips import inertia_doubts, sweep_doubts, way_back_doubts
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.mobility import listed_names
from mechsheet.kinematics.modes import way
from mechsheet.kinematics.newton.changed_dimensions import assembly_doubts
from mechsheet.kinematics.newton.steps import step_doubts
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Gear, Mechanism, Rack, Relation

FAR, NOWHERE = 0.25, 0.5
"""A sketch that misses the position by such a part of the mechanism's size (or radians) was not drawn there, or anywhere."""

OFF = 0.15
"""A pin of the driven link whose sketch misses it by this part of its travel shows another position."""

CLEAR = 0.15
"""A sketch that misses the assembly picked by less than this part of what it misses the others says well which is meant."""

SUSPICIOUS = 0.03
"""From this part on a sketch may be that of another position in the other assembly."""

BETTER = 1 / 3
"""Another position is named when the sketch misses it by less than this part of what it misses the one it is read at."""

ALIKE = 0.02
"""Positions that fit the sketch worse than the best one by less than this are named beside it."""

BESIDE = 0.06
"""Driver values nearer to one another than this part of a turn, or of the sweep, are one position of a rough sketch."""

OUT_OF_PHASE = math.radians(15.0)
"""A wheel that is sketched farther from the angle that its gear's phase makes was meant with another phase."""

MOST_NAMED = 3
MOST_ROWS = 400
MOST_ASSEMBLIES = 64
STEP = math.radians(2.0)
"""Outside its sweep a turning driver is tried in such steps."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing sketched: its columns (x and y of a point, or a symbol), the values it has there, whether it is an angle."""

    name: str
    columns: tuple[str, ...]
    wanted: tuple[float, ...]
    angle: bool = False

    def missed(self, values: Mapping[str, Array], size: float) -> Array:
        """How far each row is from it: a part of the size, or radians."""
        gaps = [values[column] - wanted for column, wanted in zip(self.columns, self.wanted, strict=True)]
        if self.angle:
            return np.abs(np.remainder(gaps[0] + math.pi, math.tau) - math.pi)
        return np.sqrt(sum((gap / size) ** 2 for gap in gaps))


def tell(mechanism: Mechanism, equations: Equations, stacklevel: int = 3) -> None:
    """Warn (DescriptionWarning) of every doubt about the mechanism's sketch; `stacklevel` as in `warnings.warn`."""
    for fault in doubts(mechanism, equations):
        warnings.warn(DescriptionWarning(fault), stacklevel=stacklevel)


def doubts(mechanism: Mechanism, equations: Equations) -> tuple[Fault, ...]:
    """What a person should hear of the sketch although it picks an assembly in every group; empty for a good one."""
    if not mechanism.sketch.doubted:  # other dimensions than those it was drawn for
        if mechanism.before is None or not any(group.system for group in equations.groups):
            return ()
        return tuple(assembly_doubts(mechanism.before, mechanism, equations))
    return (
        *_left_out(mechanism),
        *_sketched(mechanism, equations),
        *inertia_doubts(mechanism),
        *sweep_doubts(mechanism),
        *way_back_doubts(mechanism),
        *base_circle_doubts(mechanism, equations),
    )


def _left_out(mechanism: Mechanism) -> list[Fault]:
    """Links that are left out although the description does not mark them: which one, and which would do as well."""
    found = []
    for each in mechanism.redundant:
        if each.also is None:
            continue
        message = say(
            'the link "{name}" is redundant: left out of the solution, its length checked in every row',
            name=each.link.name,
        )
        hint = say("write `redundant = true` under it, then nothing more is said of it")
        if each.also:
            hint = say(
                "{links} would do as well; write `redundant = true` under the one that is meant, then nothing more is said",
                links=listed_names(each.also),
            )
        found.append(Fault(message, key=f"links.{each.link.name}", hint=hint))
    return found


def _sketched(mechanism: Mechanism, equations: Equations) -> tuple[Fault, ...]:
    """What is to be said of the sketch: of positions, so nothing else is computed."""
    equations = equations.positions
    driver = driver_values(mechanism, dimension_values(mechanism))
    if any(group.system for group in equations.groups):  # its assembly is that of the first position alone
        doubts = step_doubts(mechanism, equations, driver, sweep)
        return (*doubts, *_phases_there(mechanism, equations, driver))
    found = [
        Fault(
            say('"{point}" is a point of the ground: sketching it decides nothing', point=point),
            key=f"assembly.{point}",
        )
        for point in mechanism.sketch.points
        if point in mechanism.ground.points
    ]
    entries = _entries(mechanism)
    if not entries:
        return tuple(found)
    shown = _read_at(mechanism, driver)
    values, row = _position(mechanism, equations, shown)
    if row is None:
        return tuple(found)
    found += [_out_of_phase(mechanism, each) for each in out_of_phase(mechanism, equations)]
    size = extent(mechanism, {name: column[row : row + 1] for name, column in values.items()})
    missed = _missed(entries, values, size)
    here = float(missed[row])
    if here > SUSPICIOUS:
        found += _elsewhere(mechanism, equations, entries, _Read(float(shown[row]), here, size, driver, values, row))
    return tuple(found)


def _phases_there(mechanism: Mechanism, equations: Equations, driver: Array) -> list[Fault]:
    """As `out_of_phase`, where a phase may decide more than one wheel: the phase that the sketched angles of all three links
    make is held against the one that is given. A gear of which the sketch leaves one open is not asked.
    """
    gears = [relation for relation in mechanism.relations if isinstance(relation, Gear)]
    sketched = {entry.name: entry.wanted for entry in _entries(mechanism)}
    if not gears or not sketched:
        return []
    values, row = _position(mechanism, equations, _read_at(mechanism, driver))
    if row is None:
        return []
    there = {name: float(column[row]) for name, column in values.items()}
    iterated = {name for group in equations.groups if group.system for name in group.links}
    found = []
    for gear in gears:
        link, on, arm = (
            _turned(mechanism, name, sketched, there, name in iterated) for name in (gear.link, gear.on, gear.arm)
        )
        if link is None or on is None or arm is None:
            continue
        off = math.remainder(link - arm - number(gear.ratio, dimension_values(mechanism)) * (on - arm), math.tau)
        if abs(off) > OUT_OF_PHASE:
            found.append(_out_of_phase(mechanism, OutOfPhase(gear, gear.link, off)))
    return found


def _turned(
    mechanism: Mechanism,
    name: str,
    sketched: Mapping[str, tuple[float, ...]],
    there: Mapping[str, float],
    iterated: bool,
) -> float | None:
    """By how much a link is sketched away from where it is found; 0 where the sketch says nothing and need not, None where
    it leaves open what Newton's method is to find.

    sketched  places and angles by name;  there: every symbol's value
    """
    link = mechanism.link(name)
    if link is mechanism.ground:
        return 0.0
    if link.angle_symbol in sketched:
        return math.remainder(sketched[link.angle_symbol][0] - there[link.angle_symbol], math.tau)
    places = {point: (there[f"{point}.x"], there[f"{point}.y"]) for point in link.points}
    known = [point for point in link.points if point in sketched or point in mechanism.ground.points]
    if len(known) < 2:
        return None if iterated else 0.0
    found, drawn = (
        portable.arctan2(end[1] - start[1], end[0] - start[0])
        for start, end in (
            (places[known[0]], places[known[1]]),
            (sketched.get(known[0], places[known[0]]), sketched.get(known[1], places[known[1]])),
        )
    )
    return math.remainder(float(drawn - found), math.tau)


@dataclass(frozen=True, slots=True)
class OutOfPhase:
    """A gear or rack, what is sketched of it, and by how much [rad or length unit] that is off where the phase puts it."""

    relation: Relation
    name: str
    off: float

    def meant(self, mechanism: Mechanism) -> float:
        """The phase, as people write it, that puts it where it is sketched."""
        phase = number(self.relation.phase, dimension_values(mechanism)) + self.off
        if isinstance(self.relation, Rack):
            return float(f"{phase:.4g}")
        return round(mechanism.angle_unit.to_shown(phase), 9) + 0.0  # no -0


def out_of_phase(mechanism: Mechanism, equations: Equations) -> list[OutOfPhase]:
    """Gears whose wheel, and racks whose bar, is sketched elsewhere than their phase puts it, where no group decides it.

    Turns count: where the sketch says at which value of the driver it was drawn, the mechanism is followed there.
    """
    entries = _entries(mechanism)
    place = _followed(mechanism, equations) if mechanism.relations and entries else None
    if place is None:
        return []
    found = []
    for relation in mechanism.relations:
        for entry in entries:
            if isinstance(relation, Gear):
                off = _turned_off(mechanism, relation, entry, place)
                far = abs(off) > OUT_OF_PHASE
            else:
                off = _slid_off(mechanism, relation, entry, place)
                radius = abs(number(relation.radius, dimension_values(mechanism)))
                far = abs(off) > max(OUT_OF_PHASE * radius, SUSPICIOUS * _extent(mechanism, place))
            if far:
                found.append(OutOfPhase(relation, entry.name, off))
    return found


def _extent(mechanism: Mechanism, place: Mapping[str, float]) -> float:
    """The size of a position."""
    return extent(mechanism, {name: np.array([value]) for name, value in place.items()})


def _followed(mechanism: Mechanism, equations: Equations) -> Mapping[str, float] | None:
    """The position that the sketch shows, followed to from the first one; None where the links come apart on the way."""
    equations = equations.positions
    dimensions = dimension_values(mechanism)
    driver = driver_values(mechanism, dimensions)
    values, row = _position(mechanism, equations, driver)
    if row is None:
        return None
    if mechanism.sketch.at is not None:
        path = way(float(driver[row]), number(mechanism.sketch.at, dimensions), not mechanism.driver.joint)
        values, row = sweep(mechanism, equations, path), len(path) - 1
        if not equations.closed(values).all():
            return None
    return {name: float(column[row]) for name, column in values.items()}


def _turned_off(mechanism: Mechanism, gear: Gear, entry: Entry, place: Mapping[str, float]) -> float:
    """By which angle a wheel is sketched elsewhere than it is; 0 where the entry is none of it."""
    links = {link.name: link for link in mechanism.links}
    link = links[gear.link]
    pivot = next(point for point in link.points if point in links[gear.arm].points)
    if entry.columns == (link.angle_symbol,):
        off = entry.wanted[0] - place[link.angle_symbol]
    elif entry.name in link.points and entry.name != pivot:
        here, there = (
            portable.arctan2(y - place[f"{pivot}.y"], x - place[f"{pivot}.x"])
            for x, y in (tuple(place[column] for column in entry.columns), entry.wanted)
        )
        off = float(there - here)
    else:
        return 0.0
    return math.remainder(off, math.tau)


def _slid_off(mechanism: Mechanism, rack: Rack, entry: Entry, place: Mapping[str, float]) -> float:
    """How far along its guide a rack's bar is sketched from where it is; 0 where the entry is none of it."""
    joint = next(joint for joint in mechanism.joints if joint.symbol == rack.joint)
    if entry.name == joint.symbol:
        return entry.wanted[0] - place[joint.symbol]
    if entry.name != joint.point:
        return 0.0
    on = mechanism.link(joint.on)
    turned = 0.0 if on is mechanism.ground else place[on.angle_symbol]
    direction = turned + number(joint.angle, dimension_values(mechanism))
    x, y = (wanted - place[column] for wanted, column in zip(entry.wanted, entry.columns, strict=True))
    return float(x * portable.cos(direction) + y * portable.sin(direction))


def _out_of_phase(mechanism: Mechanism, found: OutOfPhase) -> Fault:
    if isinstance(found.relation, Rack):
        message = say(
            "{name} is sketched {length:.4g} {unit} away from where the phase puts it",
            name=found.name,
            length=abs(found.off),
            unit=mechanism.length_unit,
        )
    else:
        message = say(
            "{name} is sketched {angle:.3g} degrees away from where the phase puts it",
            name=found.name,
            angle=abs(math.degrees(found.off)),
        )
    hint = say("write phase = {phase:.4g}, or sketch {name} elsewhere", phase=found.meant(mechanism), name=found.name)
    return Fault(message, key=f"joints.{found.relation.order}", hint=hint)


@dataclass(frozen=True, slots=True)
class _Read:
    """The position at which the sketch was read: the driver's value there, how far the sketch misses it."""

    value: float
    missed: float
    size: float
    driver: Array
    values: Mapping[str, Array]
    row: int


def _read_at(mechanism: Mechanism, driver: Array) -> Array:
    """The driver's values at which the sketch is read: the one it is said to show, else those of the rows."""
    at = mechanism.sketch.at
    return driver if at is None else np.array([number(at, dimension_values(mechanism))])


def _entries(mechanism: Mechanism) -> list[Entry]:
    """Everything sketched that moves: points, angles, displacements, the driver itself."""
    sketch, driver, dimensions = mechanism.sketch, mechanism.driver, dimension_values(mechanism)
    angles = {link.angle_symbol for link in mechanism.links} | ({driver.symbol} if not driver.joint else set())
    found = [
        Entry(point, (f"{point}.x", f"{point}.y"), (number(x, dimensions), number(y, dimensions)))
        for point, (x, y) in sketch.points.items()
        if point not in mechanism.ground.points
    ]
    found += [
        Entry(symbol, (symbol,), (number(value, dimensions),), symbol in angles)
        for symbol, value in sketch.symbols.items()
    ]
    return found


def with_position(fault: Fault, mechanism: Mechanism) -> Fault:
    """A fault of a sketch that is read at the first position, with the driver value that it fits, if there is one."""
    dimensions = dimension_values(mechanism)
    entries, driver = _entries(mechanism), driver_values(mechanism, dimensions)
    if not entries:
        return fault
    equations = write_equations(mechanism, None)
    size = max(abs(value) for entry in entries for value in entry.wanted)
    size = max([size, *(abs(value) for value in dimensions.values())]) or 1.0
    values, missed, _ = _best(mechanism, equations, entries, driver, size)
    if not missed.min() < SUSPICIOUS:
        return fault
    written = _written(mechanism, _named(mechanism, values, missed))
    fits = say("the sketch fits {positions}", positions=_positions(mechanism, written))
    hint = say("{hint}; {fits}: if it was drawn there, write at = {at}", hint=fault.hint, fits=fits, at=written[0])
    return replace(fault, hint=hint)


def _position(mechanism: Mechanism, equations: Equations, driver: Array) -> tuple[Mapping[str, Array], int | None]:
    """The first of the rows that exists, and the values there; one row is tried before all of them."""
    for count in dict.fromkeys((1, len(driver))):
        values = sweep(mechanism, equations, driver[:count])
        exists = equations.closed(values)
        if exists.any():
            return values, int(np.flatnonzero(exists)[0])
    return {}, None


def _missed(entries: Sequence[Entry], values: Mapping[str, Array], size: float) -> Array:
    """Root of the mean square of what the entries miss, row by row; infinite where a position does not exist."""
    squares = np.mean([entry.missed(values, size) ** 2 for entry in entries], axis=0)
    return np.where(np.isfinite(squares), np.sqrt(squares), np.inf)


def _elsewhere(mechanism: Mechanism, equations: Equations, entries: Sequence[Entry], read: _Read) -> list[Fault]:
    """The warning that names the driver values that the sketch fits, or the entry that fits nowhere."""
    rows, best, modes = _best(mechanism, equations, entries, read.driver, read.size)
    least = float(best.min())
    other = int(modes[int(best.argmin())]) != 0
    unclear = other and read.missed > CLEAR * _next(mechanism, equations, entries, read)
    far = read.missed > FAR or unclear or _driver_is_off(mechanism, equations, entries, read)
    if far and least < BETTER * read.missed:
        return [_fits(mechanism, _named(mechanism, rows, best), read)]
    if read.missed > NOWHERE:
        return [_misfit(mechanism, entries, read)]
    return []


def _driver_is_off(mechanism: Mechanism, equations: Equations, entries: Sequence[Entry], read: _Read) -> bool:
    """Whether the driver itself, or a point that follows from it alone, is sketched elsewhere."""
    own = {equation.symbol for equation in equations.columns if equation.group == 0} | {mechanism.driver.symbol}
    values = sweep(mechanism, equations, _tried(mechanism, read.driver))
    for entry in entries:
        if set(entry.columns) <= own:
            travel = max(float(np.ptp(values[column])) for column in entry.columns)
            missed = float(entry.missed(read.values, 1.0)[read.row])
            if missed > OFF * travel:
                return True
    return False


def _next(mechanism: Mechanism, equations: Equations, entries: Sequence[Entry], read: _Read) -> float:
    """How far the sketch misses the nearest other assembly of the same position; infinite where there is no other."""
    here = np.array([read.value])
    others = [
        float(_missed(entries, sweep(mechanism, assembly, here), read.size)[0])
        for assembly in assemblies(equations)[1:]
    ]
    return min((missed for missed in others if abs(missed - read.missed) > SUSPICIOUS), default=math.inf)


def _best(
    mechanism: Mechanism, equations: Equations, entries: Sequence[Entry], driver: Array, size: float
) -> tuple[Array, Array, NDArray[np.int_]]:
    """Driver values, how far the sketch misses the nearest assembly there, and which one that is (0: the one picked)."""
    rows = _tried(mechanism, driver)
    best, modes = np.full(len(rows), np.inf), np.zeros(len(rows), dtype=int)
    for place, assembly in enumerate(assemblies(equations)):
        missed = _missed(entries, sweep(mechanism, assembly, rows), size)
        better = missed < best
        best, modes = np.where(better, missed, best), np.where(better, place, modes)
    return rows, best, modes


def _tried(mechanism: Mechanism, driver: Array) -> Array:
    """Driver values to try: those of the sweep, thinned; for a driver that turns all around the circle, the way it goes."""
    rows = driver[:: math.ceil(len(driver) / MOST_ROWS)]
    if mechanism.driver.joint:
        return rows
    sense = -1.0 if driver[-1] < driver[0] else 1.0
    return np.concatenate([rows, driver[0] + sense * np.arange(0.0, math.tau, STEP)])


def assemblies(equations: Equations) -> list[Equations]:
    """The equations in every assembly, the one picked first; of very many groups only each flipped alone."""
    places = [place for place, group in enumerate(equations.groups) if group.mode and group.system is None]
    if 2 ** len(places) <= MOST_ASSEMBLIES:
        flips = [set(part) for count in range(len(places) + 1) for part in itertools.combinations(places, count)]
    else:
        flips = [set[int](), *({place} for place in places)]
    return [
        replace(
            equations,
            groups=tuple(
                replace(group, assembly=1 - group.assembly) if place in flip else group
                for place, group in enumerate(equations.groups)
            ),
        )
        for flip in flips
    ]


def _named(mechanism: Mechanism, rows: Array, missed: Array) -> list[float]:
    """The driver values that fit best, those that lie beside a better one left out."""
    turn = 0.0 if mechanism.driver.joint else math.tau
    beside = BESIDE * (turn or float(np.ptp(rows)))
    found: list[float] = []
    for row in np.argsort(missed, kind="stable"):
        value = float(rows[row])
        if missed[row] > missed.min() + ALIKE or len(found) == MOST_NAMED:
            break
        apart = [math.remainder(value - other, turn) if turn else value - other for other in found]
        if all(abs(gap) > beside for gap in apart):
            found.append(value)
    return found


def shown_value(mechanism: Mechanism, value: float) -> str:
    """A value of the driver as a person writes it, with its symbol: `theta12 = 40`."""
    driver = mechanism.driver
    written = driver.unit.to_shown(value)
    return f"{driver.symbol} = {written:.4g}"


def _written(mechanism: Mechanism, values: Sequence[float]) -> list[str]:
    return [shown_value(mechanism, value).partition(" = ")[2] for value in values]


def _positions(mechanism: Mechanism, written: Sequence[str]) -> str:
    """Values of the driver between which there is a choice."""
    found: str = f"{mechanism.driver.symbol} = {written[0]}"
    for further in written[1:]:
        found = say("{first} or {last}", first=found, last=further)
    return found


def _fits(mechanism: Mechanism, values: Sequence[float], read: _Read) -> Fault:
    written = _written(mechanism, values)
    fits = _positions(mechanism, written)
    where = shown_value(mechanism, read.value)
    if mechanism.sketch.at is None:
        message = say("the sketch is read at the first position, {where}, but it fits {fits}", where=where, fits=fits)
        return Fault(
            message,
            key="assembly",
            hint=say("write at = {at} in [assembly], or sketch the first position", at=written[0]),
        )
    message = say("the sketch is said to show {where}, but it fits {fits}", where=where, fits=fits)
    return Fault(
        message,
        key="assembly.at",
        hint=say("write at = {at}, or sketch the position at {where}", at=written[0], where=where),
    )


def _misfit(mechanism: Mechanism, entries: Sequence[Entry], read: _Read) -> Fault:
    worst = max(entries, key=lambda entry: float(entry.missed(read.values, read.size)[read.row]))
    lies = ", ".join(
        f"{column} = {mechanism.angle_unit.to_shown(value) if worst.angle else value:.4g}"
        for column in worst.columns
        for value in [float(read.values[column][read.row])]
    )
    where = shown_value(mechanism, read.value)
    message = say(
        "the sketch of {name} is far from every position; at {where} it is at {lies}",
        name=worst.name,
        where=where,
        lies=lies,
    )
    return Fault(message, key=f"assembly.{worst.name}", hint=say("check the dimensions and the sketch"))
