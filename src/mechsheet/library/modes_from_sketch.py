"""Saying assembly modes with a sketch: the description has no modes, only a rough position that means them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from livesheet import portable
from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.description import loads
from mechsheet.description.text.rewrite import number_text, with_number, with_value, without_key
from mechsheet.description.text.source import Source
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equations, Group
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

APART = 1e-5
"""Assemblies nearer than this part of their size are no help to tell them apart; a later row may be."""

ENOUGH = 0.02
"""Entries that tell assemblies apart by less than this part of what the best one does are not enough."""

DIGITS = 2
"""A sketched number is rounded to a hundredth of how far the two assemblies are apart."""

ROUNDS = 3
"""A changed sketch of one group may bring another group to the fore; then again."""


def with_modes(source: Source, wanted: Mapping[str, int]) -> Source:
    """The description with its sketch changed, where it must be, so that every group takes the mode `wanted`.

    Raises MechanismError when no sketch says so (the assemblies are the same over the whole sweep, or nothing closes).
    """
    for again in range(ROUNDS):
        mechanism = loads(source.text, source.file)
        groups = _wrong(mechanism, wanted)
        if not groups:
            return source
        for group in groups:
            source = _sketched(source, mechanism, wanted, group)
        if again:  # what stands on these groups is sketched where it was, and says so
            source = _all_sketched(source, wanted)
    left = ", ".join(
        f"{group.mode} = {wanted[group.mode]}" for group in _wrong(loads(source.text, source.file), wanted)
    )
    if left:
        raise MechanismError(Fault(say("no sketch says {left}", left=left), source.file, key="assembly"))
    return source


def _wrong(mechanism: Mechanism, wanted: Mapping[str, int]) -> list[Group]:
    """Groups that take another mode; all that have one when the sketch lies between two.

    None of those whose mode follows from the task of a synthesis: no sketch says it.
    """
    try:
        groups = solve(mechanism).groups
    except MechanismError:
        return [group for group in solve(mechanism, wanted).groups if group.mode and group.follows is None]
    sketched = [group for group in groups if group.mode and group.follows is None]
    return [group for group in sketched if group.mode_value != wanted.get(group.mode, group.mode_value)]


@dataclass(frozen=True, slots=True)
class _Swept:
    """A mechanism in the modes that are wanted, where its sketch shows it, or over its sweep.

    size  of the mechanism, for what is measured in parts of it
    """

    mechanism: Mechanism
    equations: Equations
    driver: Array
    values: Mapping[str, Array]
    size: float

    def entry(self, source: Source, name: str, row: int, gap: float) -> Source:
        """With a point, an angle or a displacement sketched where it is in a row, rounded to a hundredth of the gap between
        two assemblies."""
        if f"{name}.x" in self.values:
            pair = [_rough(float(self.values[f"{name}.{axis}"][row]), gap * self.size) for axis in "xy"]
            return _with_point(source, name, pair)
        value = float(self.values[name][row])
        if self.equations.of(name).unit.kind != "angle":
            lengths = map(abs, dimension_values(self.mechanism).values())
            value = _rough(value, gap * max([abs(value), *lengths]))
        elif self.mechanism.angle_unit.in_degrees:
            value = _rough(math.degrees(value), math.degrees(gap))
        else:
            value = _rough(value, gap)
        return with_number(source, ("assembly", name), value)


def _swept(mechanism: Mechanism, wanted: Mapping[str, int]) -> _Swept:
    dimensions, at = dimension_values(mechanism), mechanism.sketch.at
    driver = driver_values(mechanism, dimensions) if at is None else np.array([number(at, dimensions)])
    equations = solve(mechanism, wanted)  # every mode is given: the sketch as it is does not matter
    size = largest_length(mechanism, dimensions) or 1.0
    return _Swept(mechanism, equations, driver, sweep(mechanism, equations, driver), size)


def _sketched(source: Source, mechanism: Mechanism, wanted: Mapping[str, int], group: Group) -> Source:
    """With what the sketch says of one group: entries that are there, or the one that tells its assemblies apart best."""
    sketch = mechanism.sketch
    if sketch.at is not None and group.system is not None:  # its assemblies are those of the first position
        return _sketched(*_of_first_position(source, mechanism), wanted, group)
    swept = _swept(mechanism, wanted)
    others = [
        _gaps(swept, group, sweep(mechanism, other, swept.driver)) for other in _others(swept.equations, group.mode)
    ]
    gaps = {name: np.min([other[name] for other in others], axis=0) for name in (others[0] if others else ())}
    rows = np.flatnonzero(np.isfinite(swept.values[group.closes]))
    rows = rows if group.system is None else rows[rows == group.system.row]
    row = next((int(row) for row in rows if any(gap[row] > APART for gap in gaps.values())), None)
    if row is None and sketch.at is not None:  # there the sketch can tell nothing, the first position may
        return _sketched(*_of_first_position(source, mechanism), wanted, group)
    if row is None:
        message = say("the assemblies of {group} are one: no sketch tells them apart", group=group.label)
        raise MechanismError(Fault(message, source.file, key="assembly"))
    best = max(gaps, key=lambda name: float(gaps[name][row]))
    present = [name for name in gaps if name in sketch.points or name in sketch.symbols]
    if not any(gaps[name][row] > ENOUGH * gaps[best][row] for name in present):
        present.append(best)
    for name in present:
        source = swept.entry(source, name, row, float(gaps[name][row]) or 1.0)
    return source


def _of_first_position(source: Source, mechanism: Mechanism) -> tuple[Source, Mechanism]:
    """Both with a sketch that shows the first position."""
    return without_key(source, ("assembly", "at")), replace(mechanism, sketch=replace(mechanism.sketch, at=None))


def _all_sketched(source: Source, wanted: Mapping[str, int]) -> Source:
    """With everything that is sketched where it is in these modes, in the first row in which it is anywhere."""
    mechanism = loads(source.text, source.file)
    swept = _swept(mechanism, wanted)
    solved = {equation.symbol for equation in swept.equations.columns if equation.group > 0}
    for name in (*mechanism.sketch.points, *mechanism.sketch.symbols):
        symbols = [name] if name in mechanism.sketch.symbols else [f"{name}.x", f"{name}.y"]
        rows = np.flatnonzero(np.isfinite(swept.values.get(symbols[0], np.array([]))))
        if solved.issuperset(symbols) and len(rows):
            source = swept.entry(source, name, int(rows[0]), ENOUGH)
    return source


def _with_point(source: Source, name: str, pair: list[float]) -> Source:
    if ("assembly", name, 1) not in source.spots:
        return with_value(source, ("assembly", name), f"[{number_text(pair[0])}, {number_text(pair[1])}]")
    for index, value in enumerate(pair):
        source = with_number(source, ("assembly", name, index), value)
    return source


def _others(equations: Equations, mode: str) -> list[Equations]:
    """The equations in every other assembly of a group."""
    (group,) = (group for group in equations.groups if group.mode == mode)
    return [
        replace(
            equations,
            groups=tuple(replace(each, assembly=index) if each is group else each for each in equations.groups),
        )
        for index in range(len(group.assemblies))
        if index != group.assembly
    ]


def numbered_anew(mechanism: Mechanism, equations: Equations, wanted: Mapping[str, int]) -> dict[str, int]:
    """`wanted` of a workbook as modes of the mechanism, which has other dimensions.

    equations  those of the workbook: groups of more than two assemblies number those of their own dimensions, and follow
               the chosen one from there; the mechanism numbers its own. Where it cannot be followed the number stays.
    """
    found = dict(wanted)
    there = replace(
        equations,
        groups=tuple(
            replace(group, assembly=group.assembly_of(wanted[group.mode])) if group.mode in wanted else group
            for group in equations.groups
        ),
    )
    driver = driver_values(mechanism, dimension_values(mechanism))
    for group in there.groups:
        if group.system is None:
            continue
        anew = next(each for each in solve(mechanism, found).groups if each.mode == group.mode).system
        if anew is None:
            continue
        values = sweep(mechanism, there, driver)
        meant = [float(values[name][anew.row]) for name in anew.variables]
        if all(map(math.isfinite, meant)):
            found[group.mode] = 1 + int(
                np.argmin([_away(start, meant, equations, anew.variables) for start in anew.starts])
            )
    return found


def _away(start: Sequence[float], meant: Sequence[float], equations: Equations, names: Sequence[str]) -> float:
    turns = (equations.of(name).unit.kind == "angle" for name in names)
    gaps = (math.remainder(x - y, math.tau) if turn else x - y for x, y, turn in zip(start, meant, turns, strict=True))
    return math.sqrt(sum(gap * gap for gap in gaps))


def _gaps(swept: _Swept, group: Group, left: Mapping[str, Array]) -> dict[str, Array]:
    """What a sketch may say of a group -> how far its assemblies are apart there, row by row: as a part of the size,
    angles as the chord of an arc of radius 1."""
    found: dict[str, Array] = {}
    right, size, columns = swept.values, swept.size, swept.equations.columns
    own = [equation for equation in columns if equation.group == group.number]
    if not any(equation.role in ("point", "variable") for equation in own):  # its links are placed by later groups
        own = [equation for equation in columns if equation.group > group.number]
    for equation in own:
        apart = np.abs(right[equation.symbol] - left[equation.symbol])
        if equation.role == "point":
            point = equation.symbol.rpartition(".")[0]
            found[point] = portable.hypot(found.get(point, np.zeros_like(apart)), apart / size)
        elif equation.role == "variable":
            found[equation.symbol] = (
                2 * np.abs(portable.sin(apart / 2)) if equation.unit.kind == "angle" else apart / size
            )
    return found


def _rough(value: float, gap: float) -> float:
    return round(value, max(0, DIGITS - math.floor(float(portable.log10(gap))))) + 0.0
