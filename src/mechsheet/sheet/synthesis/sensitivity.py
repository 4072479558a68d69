"""By how much each step of a solution changes when one input does, by 0.1 degrees or 0.1 percent: the chain rule in cells.

d step = sum over what it reads: (∂ step/∂ read) d read
"""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.formula import algebra as al
from mechsheet.formula.derivatives import derivative
from mechsheet.formula.nodes import Call, Node, Number, Symbol, symbols
from mechsheet.model import Dimension, Synthesis
from mechsheet.synthesis.writing import says

PART = 0.001
"""An input that is no angle changes by this part of it."""

STEP = 0.1
"""An angle, by so many degrees."""


def changes(task: Synthesis, dimensions: Mapping[str, Dimension]) -> dict[tuple[str, str], Node]:
    """(step, input) -> the change of the step in internal units, over symbols; `d step input` names another change.

    Left out where the step does not depend on the input.
    """
    found: dict[tuple[str, str], Node] = {}
    for column in task.inputs:
        if column == task.rounding:
            continue
        for step in task.steps:
            value = dimensions[step].value
            if isinstance(value, float):
                continue
            node = says(value)
            terms: list[Node] = []
            for read in symbols(node):
                if read == column:
                    change = _own(dimensions[column])
                elif (read, column) in found:
                    change = Symbol(mark(read, column))
                else:
                    continue
                slope = derivative(node, read)
                if not al.is_zero(slope):
                    terms.append(al.mul(slope, change))
            if terms:
                found[step, column] = al.total(terms)
    return found


def mark(step: str, column: str) -> str:
    """The symbol of the change of a step with an input: no description can use a name with a blank in it."""
    return f"d {step} {column}"


def _own(dim: Dimension) -> Node:
    """By how much an input changes itself."""
    if dim.unit.kind == "angle":
        return Call("RADIANS", (Number(STEP),))
    return al.mul(Number(PART), Call("ABS", (Symbol(dim.symbol),)))


def largest(task: Synthesis, dimensions: Mapping[str, Dimension]) -> list[str]:
    """Symbols of the lengths among the ends of a solution that are steps."""
    return [symbol for symbol in task.ends if symbol in task.steps and dimensions[symbol].unit.kind == "length"]
