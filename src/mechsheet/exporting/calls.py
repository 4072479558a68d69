"""Where an expression is one of the basic functions written out, it becomes a call of that function."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from mechsheet.exporting.routines import Routine, Step
from mechsheet.formula.nodes import Call, Node, Symbol, children, transform
from mechsheet.formula.written import pairwise


def with_calls(routine: Routine, patterns: Sequence[Routine]) -> Routine:
    """The routine calling the patterns (routines without steps) where its expressions match them; the first that does."""

    def change(part: Node) -> Node:
        if isinstance(part, Call) and part.name == "SUMSQ":
            return pairwise(part)
        for pattern in patterns:
            found: dict[str, Node] = {}
            if matches(pattern.result, part, found):
                return Call(pattern.key, tuple(found[parameter.symbol] for parameter in pattern.parameters))
        return part

    return mapped(routine, lambda node: transform(node, change))


def mapped(routine: Routine, change: Callable[[Node], Node]) -> Routine:
    """The routine with every expression changed."""
    steps = tuple(Step(step.symbol, change(step.expression)) for step in routine.steps)
    return replace(routine, steps=steps, result=change(routine.result))


def matches(pattern: Node, node: Node, found: dict[str, Node]) -> bool:
    """True when `node` is `pattern` with its symbols replaced, each by the same expression everywhere; they come in `found`.

    Patterns are a few levels deep, so recursion does.
    """
    if isinstance(pattern, Symbol):
        return found.setdefault(pattern.name, node) == node
    below, other = children(pattern), children(node)
    if type(pattern) is not type(node) or len(below) != len(other):
        return False
    if not below:
        return pattern == node
    same_head = all(getattr(pattern, name, "") == getattr(node, name, "") for name in ("op", "name"))
    return same_head and all(matches(one, two, found) for one, two in zip(below, other, strict=True))
