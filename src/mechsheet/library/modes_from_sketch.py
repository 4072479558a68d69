"""Saying assembly modes with a sketch: the description has no modes, only a rough position that means them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechsheet import portable
from mechsheet.description import loads
from mechsheet.description.rewrite import number_text, with_number, with_value, without_key
from mechsheet.description.source import Source
from mechsheet.diagnostics import Fault, MechanismError
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equations, Group
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.places import number
from mechsheet.kinematics.solve import dimension_values, solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

APART = 1e-5
"""Assemblies nearer than this part of their size are no help to tell them apart; a later row may be."""

DIGITS = 2
"""A sketched number is rounded to a hundredth of how far the two assemblies are apart."""

ROUNDS = 3
"""A changed sketch of one group may bring another group to the fore; then again."""


def with_modes(source: Source, wanted: Mapping[str, int]) -> Source:
    """The description with its sketch changed, where it must be, so that every group takes the mode `wanted`.

    Raises MechanismError when no sketch says so (the assemblies are the same over the whole sweep, or nothing closes).
    """
    for _ in range(ROUNDS):
        mechanism = loads(source.text, source.file)
        groups = _wrong(mechanism, wanted)
        if not groups:
            return source
        for group in groups:
            source = _sketched(source, mechanism, wanted, group)
    left = ", ".join(
        f"{group.mode} = {wanted[group.mode]}" for group in _wrong(loads(source.text, source.file), wanted)
    )
    if left:
        raise MechanismError(Fault(f"no sketch says {left}", source.file, key="assembly"))
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


def _sketched(source: Source, mechanism: Mechanism, wanted: Mapping[str, int], group: Group) -> Source:
    """With what the sketch says of one group: entries that are there, or the one that tells its assemblies apart best."""
    if group.system is not None:
        raise MechanismError(
            Fault(
                f"{group.mode} is the number of one of {len(group.assemblies)} assemblies: sketch the one that is meant",
                source.file,
                key="assembly",
                hint="; ".join(f"{number}: {words.en}" for number, words in enumerate(group.assemblies, 1)),
            )
        )
    dimensions = dimension_values(mechanism)
    at = mechanism.sketch.at
    driver = driver_values(mechanism, dimensions) if at is None else np.array([number(at, dimensions)])
    equations = solve(mechanism, wanted)  # every mode is given: the sketch as it is does not matter
    right = sweep(mechanism, equations, driver)
    left = sweep(mechanism, _flipped(equations, group.mode), driver)
    size = max([abs(value) for value in dimensions.values()], default=1.0) or 1.0
    gaps = _gaps(equations, group, right, left, size)
    rows = np.flatnonzero(np.isfinite(right[group.closes]))
    row = next((int(row) for row in rows if any(gap[row] > APART for gap in gaps.values())), None)
    if row is None and at is not None:  # there the sketch can tell nothing: it shall show the first position instead
        source = without_key(source, ("assembly", "at"))
        return _sketched(source, replace(mechanism, sketch=replace(mechanism.sketch, at=None)), wanted, group)
    if row is None:
        message = f"the two assemblies of {group.label.en} are one: no sketch tells them apart"
        raise MechanismError(Fault(message, source.file, key="assembly"))
    sketch = mechanism.sketch
    present = [name for name in gaps if name in sketch.points or name in sketch.symbols]
    for name in present or [max(gaps, key=lambda name: float(gaps[name][row]))]:
        gap = float(gaps[name][row]) or 1.0
        if f"{name}.x" in right:
            pair = [_rough(float(right[f"{name}.{axis}"][row]), gap * size) for axis in "xy"]
            source = _with_point(source, name, pair)
        else:
            source = with_number(source, ("assembly", name), _symbol_value(mechanism, equations, name, right, row, gap))
    return source


def _symbol_value(
    mechanism: Mechanism, equations: Equations, name: str, values: Mapping[str, Array], row: int, gap: float
) -> float:
    """An angle or a displacement as a description writes it, rounded."""
    value = float(values[name][row])
    if equations.of(name).unit.kind != "angle":
        return _rough(value, gap * max([abs(value), *_lengths(mechanism)]))
    if mechanism.angle_unit.in_degrees:
        return _rough(math.degrees(value), math.degrees(gap))
    return _rough(value, gap)


def _lengths(mechanism: Mechanism) -> list[float]:
    return [abs(value) for value in dimension_values(mechanism).values()]


def _with_point(source: Source, name: str, pair: list[float]) -> Source:
    if ("assembly", name, 1) not in source.spots:
        return with_value(source, ("assembly", name), f"[{number_text(pair[0])}, {number_text(pair[1])}]")
    for index, value in enumerate(pair):
        source = with_number(source, ("assembly", name, index), value)
    return source


def _flipped(equations: Equations, mode: str) -> Equations:
    groups = tuple(
        replace(group, assembly=1 - group.assembly) if group.mode == mode else group for group in equations.groups
    )
    return replace(equations, groups=groups)


def _gaps(
    equations: Equations, group: Group, right: Mapping[str, Array], left: Mapping[str, Array], size: float
) -> dict[str, Array]:
    """What a sketch may say of a group -> how far its assemblies are apart there, row by row: as a part of the size,
    angles as the chord of an arc of radius 1."""
    found: dict[str, Array] = {}
    for equation in equations.columns:
        if equation.group != group.number:
            continue
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
