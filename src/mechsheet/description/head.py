"""The part [mechanism], and how parts that may be missing or faulty are taken."""

from __future__ import annotations

from typing import Any

from livesheet.said import say
from mechsheet.description.kinds import plain_unit
from mechsheet.description.report import BAD, Report
from mechsheet.description.scope import Scope
from mechsheet.diagnostics import quoted
from mechsheet.units import unit_of


def part(data: dict[str, Any], key: str, empty: Any) -> Any:
    """What stands at `key`; `empty` where there is nothing, or nothing usable."""
    value = data.get(key, BAD)
    return empty if value is BAD else value


def choice(table: dict[str, Any], key: str, default: str) -> str:
    """The word at `key`, or the default."""
    value = table.get(key, default)
    return default if value is BAD else str(value)


def scope_of(head: dict[str, Any], report: Report) -> Scope:
    """A scope with the units of the part [mechanism], and no names yet."""
    scope = Scope(report)
    scope.length_unit = _length_unit(head, report)
    scope.angle_unit = unit_of(choice(head, "angle_unit", "deg"), scope.length_unit)
    return scope


def _length_unit(head: dict[str, Any], report: Report) -> str:
    unit = choice(head, "length_unit", "mm")
    if plain_unit(unit) in ("deg", "rad", "1") or unit != unit.strip():
        report.at(("mechanism", "length_unit"), say("{unit} cannot be the unit of lengths", unit=quoted(unit)))
        return "mm"
    return unit
