"""The part [dimensions]: inputs, and derived ones in the order in which they can be computed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from livesheet.formula.nodes import Node, symbols
from livesheet.said import say
from mechsheet.description.asked import synthesis
from mechsheet.description.kinds import unit_kind
from mechsheet.description.report import BAD
from mechsheet.description.scope import REPORTED, Scope, circle_message, cycles, words
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import Measured, home
from mechsheet.model import Dimension
from mechsheet.units import Unit


def spelled_out(data: dict[str, Any], scope: Scope) -> dict[str, Any]:
    """The entries with numbers with their unit as tables: `a1 = "2 cm"` as { value = 20, unit = "mm" }."""
    return {symbol: _spelled_out(entry, ("dimensions", symbol), scope) for symbol, entry in data.items()}


def _spelled_out(entry: Any, path: Path, scope: Scope) -> Any:
    found = entry.get("value") if isinstance(entry, dict) else entry
    if not isinstance(found, Measured):
        return entry
    rest = {key: value for key, value in entry.items() if key != "value"} if isinstance(entry, dict) else {}
    if "unit" in rest:
        scope.report.at((*path, "unit"), say("the value says its unit already"), say("take it away"))
    at_home = home(found, scope.length_unit)
    if at_home is None:
        scope.unknown_unit(found.unit, path)
        return rest | {"value": BAD}
    return rest | {"value": at_home[0], "unit": at_home[1]}


def declare(data: dict[str, Any], scope: Scope, units: Mapping[str, Unit] | None = None) -> None:
    """Enter the names and units of all dimensions, so that expressions can be read in any order.

    units  of those that say none of their own, in place of the length unit
    """
    for symbol, entry in data.items():
        path: Path = ("dimensions", symbol)
        scope.symbol_is_good(symbol, path)
        scope.symbols.claim(symbol, "dimension", path)
        own = units[symbol] if units and symbol in units and "unit" not in entry else None
        scope.units[symbol] = own or scope.unit(entry if isinstance(entry, dict) else {}, path)
        scope.kinds[symbol] = unit_kind(scope.units[symbol])
        if not (isinstance(entry, dict) and ("formula" in entry or "synthesis" in entry)):
            scope.inputs.append(symbol)


def read(data: dict[str, Any], scope: Scope, task: synthesis.Found) -> tuple[Dimension, ...]:
    """The dimensions in the order of the file; their values, and those of the steps of a synthesis, go into
    `scope.numbers`.
    """
    for symbol, entry in data.items():
        value = entry.get("value", BAD) if isinstance(entry, dict) else entry
        if value is not BAD:
            scope.numbers[symbol] = scope.units[symbol].to_internal(value)
    synthesis.declare(task, scope)
    trees = _formulas(data, scope) | task.trees
    _compute(trees, scope)
    return tuple(_dimension(symbol, entry, trees, scope) for symbol, entry in data.items() if entry is not BAD)


def _formulas(data: dict[str, Any], scope: Scope) -> dict[str, Node]:
    """The trees of the derived dimensions that are free of faults."""
    trees: dict[str, Node] = {}
    for symbol, entry in data.items():
        text = entry.get("formula", BAD) if isinstance(entry, dict) and "value" not in entry else BAD
        path: Path = ("dimensions", symbol, "formula")
        if text is BAD or (tree := scope.parse(text, path)) is None:
            continue
        good = scope.only_dimensions(tree, text, path)
        fits = scope.fits(tree, text, scope.kinds[symbol], path)
        if fits and good and scope.is_in_radians(tree, text, scope.units[symbol], path):
            trees[symbol] = tree
    return trees


def _compute(trees: dict[str, Node], scope: Scope) -> None:
    order, circles = cycles({symbol: symbols(tree) for symbol, tree in trees.items()})
    for circle in circles:
        scope.report.at(("dimensions", circle[0], "formula"), circle_message(circle, "the dimensions"))
    for symbol in order:
        value = scope.value(trees[symbol], ("dimensions", symbol, "formula"))
        if value is not None:
            scope.numbers[symbol] = value


def _dimension(symbol: str, entry: Any, trees: Mapping[str, Node], scope: Scope) -> Dimension:
    path: Path = ("dimensions", symbol)
    unit = scope.units[symbol]
    if not isinstance(entry, dict):
        return Dimension(symbol, entry, unit, shown=entry)
    derived = "value" not in entry
    return Dimension(
        symbol=symbol,
        value=trees[symbol] if symbol in trees else scope.numbers.get(symbol, REPORTED),
        unit=unit,
        label=words(entry.get("label")),
        cell=scope.cell(entry, path),
        tolerance=entry.get("tolerance"),
        shown=None if derived or entry["value"] is BAD else entry["value"],
        written=entry.get("formula", "") if derived else "",
    )
