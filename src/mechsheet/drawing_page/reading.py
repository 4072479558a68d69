"""A description as far as it can be read and solved, with everything that is wrong with it.

Numbers that it gives elsewhere than among its dimensions: of loads, masses, gears, the driver's speed, are cells
of the page: each can be typed over where it stands.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import symbols
from mechsheet.compiled import Compiled
from mechsheet.description.overrides import scope_for, typed_value
from mechsheet.description.parts import Parts, parts_of
from mechsheet.description.report import located
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import CONSISTENT
from mechsheet.description.text.rewrite import with_value
from mechsheet.description.text.source import Source, dotted, parse
from mechsheet.diagnostics import DescriptionError, MechanismError, MechsheetError
from mechsheet.drawing_page.questions import Refusal
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.graph import graph_of
from mechsheet.kinematics.mobility import check_mobility, mobility
from mechsheet.library.changed import loads
from mechsheet.model import Cartesian, Dimension, Distances, Driver, Joint, Label, Link, Mechanism, Polar, Quantity
from mechsheet.units import Unit
from mechsheet.words.catalogue import text_in

KEPT = 12
"""Texts of which the reading is kept."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a text is.

    source    None where it is no TOML
    parts     what can be drawn of it; None where it is no TOML
    compiled  the mechanism and its equations; None where it cannot be solved
    faults    what is wrong, each at its line;  mobility  degrees of freedom, where there are links
    """

    text: str
    source: Source | None
    parts: Parts | None
    compiled: Compiled | None
    faults: tuple[Fault, ...]
    mobility: int | None


@lru_cache(maxsize=KEPT)
def read(text: str, file: str) -> Reading:
    """The reading of a text; `file` is what messages call it. Nothing is raised for what a description can have wrong.

    The last texts are kept: while a point is dragged, each question begins with the text as it was before.
    """
    try:
        source = parse(text, file)
    except MechsheetError as error:
        return Reading(text, None, None, None, error.faults, None)
    parts = parts_of(source)
    count, loose = _counted(parts)
    try:
        mechanism = loads(text, file)
    except MechsheetError as error:
        told = [*error.faults, *(fault for fault in located(MechanismError(loose), text, file).faults)]
        return Reading(text, source, parts, None, tuple(told), count)
    compiled = Compiled(mechanism)
    try:
        _ = compiled.equations
    except MechanismError as error:
        return Reading(text, source, parts, None, located(error, text, file).faults, count)
    parts = replace(parts, numbers={**dimension_values(mechanism), **parts.numbers})  # a synthesis has found some
    return Reading(text, source, parts, compiled, (), count)


def _counted(parts: Parts) -> tuple[int | None, list[Fault]]:
    """Degrees of freedom, and what `show` would say of them; of parts without a driver."""
    if len(parts.links) < 2:
        return None, []
    mechanism = Mechanism(
        "", Label(""), Label(""), parts.length_unit, parts.angle_unit, (), parts.links, parts.joints,
        parts.driver or Driver("", parts.angle_unit),
    )  # fmt: skip
    graph = graph_of(mechanism)
    count = mobility(graph) - parts.relations
    if parts.relations:  # which bodies they tie is known of sound descriptions only
        return count, []
    try:
        check_mobility(mechanism, graph)
    except MechanismError as error:
        unfinished = parts.driver is None and count > 1  # how many drivers are missing is no news yet: links are
        return count, [fault for fault in error.faults if not (unfinished and fault.key == "links")]
    return count, []


# --- where a fault lies ----------------------------------------------------------------------------------------------

_WORD = re.compile(r"[\w.-]+")


def fault_entry(fault: Fault, parts: Parts | None, language: str) -> dict[str, Any]:
    """A fault as the page shows it, in its language: at its line, and at the links that it names."""
    return {
        "line": fault.line,
        "key": fault.key,
        "message": text_in(fault.message, language),
        "hint": text_in(fault.hint, language),
        "links": _links_of(fault, parts) if parts is not None else [],
    }


def _links_of(fault: Fault, parts: Parts) -> list[str]:
    keys = fault.key.split(".")
    quoted = set(re.findall(r'"([^"]+)"', fault.message))
    words = set(_WORD.findall(fault.message)) if "cannot be joined" in fault.message else set()
    dimension = keys[1] if keys[0] == "dimensions" and len(keys) > 1 else ""
    return [
        link.name
        for link in parts.links
        if link.name in quoted | words or keys[:2] == ["links", link.name] or dimension in reads_of(link, parts)
    ]


def reads_of(link: Link, parts: Parts) -> set[str]:
    """The dimensions that the places of a link's points follow from."""
    quantities = (quantity for place in link.points.values() for quantity in quantities_of(place))
    return followed({name for quantity in quantities for name in symbols_in(quantity)}, parts)


def read_by_guide(joint: Joint) -> set[str]:
    """The dimensions that a sliding joint names."""
    through = joint.through if isinstance(joint.through, tuple) else ()
    return {name for quantity in (joint.angle, joint.orientation, *through) for name in symbols_in(quantity)}


def followed(named: set[str], parts: Parts) -> set[str]:
    """Dimensions, and those that the derived ones among them follow from."""
    found = set(named)
    derived = {dim.symbol: dim.value for dim in parts.dimensions if dim.derived}
    waiting = list(found)
    while waiting:
        new = set(symbols_in(derived.get(waiting.pop(), 0.0))) - found
        found |= new
        waiting += new
    return found


def quantities_of(place: Cartesian | Polar | Distances) -> tuple[Quantity, ...]:
    """The numbers and expressions of a place."""
    match place:
        case Cartesian(x, y):
            return (x, y)
        case Polar(r, angle):
            return (r, angle)
        case Distances(_, first, _, second, _):
            return (first, second)


def symbols_in(quantity: Quantity) -> tuple[str, ...]:
    """The dimensions that an expression names."""
    return () if isinstance(quantity, float | int) else tuple(symbols(quantity))


SPEED: Path = ("driver", "speed")


def cells_of(reading: Reading) -> list[Dimension]:
    """Those that can be typed over: plain numbers, each at a place of the text."""
    if reading.compiled is None:
        return []
    named = reading.compiled.mechanism.dimensions
    there = [dim for dim in named if dim.path and dim.path[0] != "synthesis"]  # a task is another matter
    return [dim for dim in there if isinstance(dim.value, float) and not dim.written]


def first_speed(reading: Reading) -> Unit | None:
    """The unit in which a driver that has no speed yet may be given one; None where it has one, or a motion law."""
    driver = reading.parts.driver if reading.parts is not None else None
    data = reading.source.data.get("driver") if reading.source is not None else None
    if driver is None or reading.parts is None or not isinstance(data, dict):
        return None
    if {"speed", "motion", "segments", "values"} & data.keys():
        return None
    return Unit("label", f"{reading.parts.length_unit}/s" if driver.joint else "rpm")


def own_units(source: Source | None) -> tuple[str, str]:
    """The units of forces and masses."""
    given = source.data.get("dynamics") if source is not None else None
    table = given if isinstance(given, dict) else {}
    head = source.data.get("mechanism") if source is not None else None
    length = head.get("length_unit") if isinstance(head, dict) else None
    own = CONSISTENT.get(length, ("N", "kg")) if isinstance(length, str) else ("N", "kg")
    force, mass = table.get("force_unit"), table.get("mass_unit")
    return force if isinstance(force, str) else own[0], mass if isinstance(mass, str) else own[1]


def number_in_unit(source: Source, typed: str, unit: str) -> str:
    """What was typed ("20", "2 kN", "3*4") as a number of the text in `unit`. Raises DescriptionError for what is none."""
    scope = scope_for(source, "")
    text = typed_value(typed, Unit("label", unit), "its", scope)
    if text is None:
        raise DescriptionError(scope.report.faults)
    return text


def typed_in_cell(reading: Reading, name: str, value: str) -> str:
    """The text with another number at the place `name` ("loads[1].stiffness"). Raises DescriptionError for no number."""
    source = reading.source
    if source is None:
        return reading.text
    for dim in cells_of(reading):
        if dotted(dim.path) == name:
            text = number_in_unit(source, value, dim.unit.text)
            place = dim.path if (*dim.path, "value") not in source.spots else (*dim.path, "value")
            return with_value(source, place, text).text
    unit = first_speed(reading)
    if name == dotted(SPEED) and unit is not None:
        text = number_in_unit(source, value, unit.text)
        return with_value(source, SPEED, f'"{text} {unit.text}"').text
    raise Refusal(f'nothing is given at "{name}"')
