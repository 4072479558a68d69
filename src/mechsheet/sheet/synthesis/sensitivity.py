"""By how much each step of a solution changes when one input does, by 0.1 degrees or 0.1 percent: the chain rule in cells.

d step = sum over what it reads: (∂ step/∂ read) d read
"""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Call, Node, Number, Symbol, symbols
from mechsheet.model import Dimension, Synthesis
from mechsheet.synthesis.writing import says

PART = 0.001
"""An input that is no angle changes by this part of it."""

STEP = 0.1
"""An angle, by so many degrees."""


def changes(task: Synthesis, dimensions: Mapping[str, Dimension]) -> dict[tuple[str, str], Node]:
    """(step, input) -> the change of the step in internal units, over symbols; `d step input` names another change.

    Left out where the step does not depend on the input, and steps from which no length follows.
    """
    found: dict[tuple[str, str], Node] = {}
    wanted = _read_by(largest(task, dimensions), task, dimensions)
    for column in task.inputs:
        if column == task.rounding:
            continue
        for step in wanted:
            value = dimensions[step].value
            if isinstance(value, float):
                continue
            terms: list[Node] = []
            for read, slope in _slopes(step, says(value), task):
                if read == column:
                    terms.append(al.mul(slope, _own(dimensions[column])))
                elif (read, column) in found:
                    terms.append(al.mul(slope, Symbol(mark(read, column))))
            if terms:
                found[step, column] = al.total(terms)
    return found


def _slopes(step: str, node: Node, task: Synthesis) -> list[tuple[str, Node]]:
    """What a step reads, and its derivative by that: of a root by the equation that it fulfils."""
    if step not in task.roots:
        slopes = ((read, derivative(node, read)) for read in symbols(node))
        return [(read, slope) for read, slope in slopes if not al.is_zero(slope)]
    b, c, _ = task.roots[step]
    x = Symbol(step)
    slope = al.add(al.mul(x, al.add(al.mul(Number(3.0), x), al.mul(al.TWO, Symbol(b)))), Symbol(c))
    powers = (al.square(x), x, al.ONE)
    return [(read, al.neg(al.div(power, slope))) for read, power in zip(task.roots[step], powers, strict=True)]


def _read_by(ends: list[str], task: Synthesis, dimensions: Mapping[str, Dimension]) -> list[str]:
    """The steps that these follow from, and they themselves, in order."""
    needed = set(ends)
    for step in reversed(task.steps):
        value = dimensions[step].value
        if step in needed and not isinstance(value, float):
            needed |= set(task.roots.get(step, ())) or set(symbols(says(value)))
    return [step for step in task.steps if step in needed]


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
