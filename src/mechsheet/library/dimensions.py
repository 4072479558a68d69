"""The dimensions of a mechanism by name, with their exact values: given, derived, found by a synthesis."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.model import Dimension, Mechanism

DIGITS = 6
"""Of the rounded values in the table."""


@dataclass(frozen=True, slots=True)
class Value:
    """A dimension in its own unit; None where it has no value: the task has no solution.

    exact  as it is found;  used  as the mechanism has it: rounded, where the synthesis rounds
    """

    name: str
    exact: float | None
    used: float | None
    unit: str
    words: str


def values_of(mechanism: Mechanism) -> list[Value]:
    """The mechanism's own dimensions, then the task of its synthesis, its steps and results."""
    numbers = dimension_values(mechanism)
    own = {dim.symbol: dim for dim in mechanism.dimensions}
    task = mechanism.synthesis
    if task is not None and not all(math.isfinite(numbers[symbol]) for symbol in task.ends):
        # without a solution nothing is a result, nor what the task gives of it
        numbers |= dict.fromkeys((*task.results.values(), *task.taken), math.nan)
    exact = {} if task is None else {name: task.results[result] for name, result in task.taken.items()}
    shown = {symbol: _value(mechanism, dim, exact.get(symbol, symbol), numbers) for symbol, dim in own.items()}
    names = [dim.symbol for dim in mechanism.dimensions if dim.path[:1] != ("synthesis",)]
    if task is None:
        return [shown[name] for name in names]
    of_task = [symbol for symbol in (*task.inputs, *task.steps) if symbol not in exact.values()]
    found = [shown[name] for name in (*names, *of_task)]
    there = {value.name for value in found}
    return found + [
        Value(name, shown[symbol].exact, shown[symbol].used, shown[symbol].unit, shown[symbol].words)
        for name, symbol in task.results.items()
        if name not in there
    ]


def _value(mechanism: Mechanism, dim: Dimension, exact: str, numbers: dict[str, float]) -> Value:
    def number(symbol: str) -> float | None:
        value = numbers[symbol]
        return dim.unit.written(value) if math.isfinite(value) else None

    words = dim.label.of(mechanism.language) if dim.label else ""
    return Value(dim.symbol, number(exact), number(dim.symbol), dim.unit.text, words)


def dimensions_json(mechanism: Mechanism) -> str:
    """{"a1": 100.0, ...}: exact values in their own units, null where there is none."""
    return json.dumps({value.name: value.exact for value in values_of(mechanism)}, ensure_ascii=False)


def dimensions_text(mechanism: Mechanism) -> str:
    """A table: name, exact value to six digits, the value that is used, unit, meaning."""
    values = values_of(mechanism)
    rounds = mechanism.synthesis is not None
    head = ("name", "value", "used" if rounds else "", "unit", "")
    task = mechanism.synthesis
    taken = set() if task is None else {*task.taken, *(task.results[name] for name in task.mode.values())}
    rows = [head] + [
        (value.name, _text(value.exact), _text(value.used) if value.name in taken else "", value.unit, value.words)
        for value in values
    ]
    widths = [max(len(row[col]) for row in rows) for col in range(len(head))]
    lines = []
    for row in rows:
        name, exact, used, unit, words = row
        cells = [name.ljust(widths[0]), exact.rjust(widths[1])]
        cells += [used.rjust(widths[2])] if rounds else []
        lines.append("  ".join((*cells, unit.ljust(widths[3]), words)).rstrip())
    return "\n".join(lines)


def _text(value: float | None) -> str:
    return "no value" if value is None else f"{value:.{DIGITS}g}"
