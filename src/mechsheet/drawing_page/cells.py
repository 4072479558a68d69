"""Numbers that a description gives elsewhere than among its dimensions: of loads, masses, gears, the driver's speed."""

from __future__ import annotations

from mechsheet.description.overrides import scope_for, typed_value
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import CONSISTENT
from mechsheet.description.text.rewrite import with_value
from mechsheet.description.text.source import Source, dotted
from mechsheet.diagnostics import DescriptionError
from mechsheet.drawing_page.questions import Refusal
from mechsheet.drawing_page.reading import Reading
from mechsheet.model import Dimension
from mechsheet.units import Unit

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
