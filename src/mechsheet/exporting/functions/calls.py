"""Where an expression is one of the basic functions written out, it becomes a call of that function."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from livesheet.formula.nodes import Call, Node, Symbol, children, transform
from livesheet.formula.written import pairwise
from mechsheet.exporting.functions.routines import Routine, mapped
from mechsheet.exporting.lowering import Step


def with_calls(routine: Routine, patterns: Sequence[Routine]) -> Routine:
    """The routine calling the patterns (routines without steps) where its expressions match them; the first that does."""
    always = [pattern for pattern in patterns if pattern.missing is None]
    sometimes = [pattern for pattern in patterns if pattern.missing is not None]

    def change(part: Node) -> Node:
        if isinstance(part, Call) and part.name == "SUMSQ":
            return pairwise(part)
        for pattern in always:
            found: dict[str, Node] = {}
            if matches(pattern.result, part, found):
                return _call(pattern, found)
        return part

    def called(step: Step) -> Step:
        for pattern in sometimes:
            found: dict[str, Node] = {}
            if pattern.missing is None or step.missing is None or not matches(pattern.missing, step.missing, found):
                continue
            if matches(pattern.result, step.expression, found):
                return Step(step.symbol, _call(pattern, found))
        return step

    routine = mapped(routine, lambda node: transform(node, change))
    return replace(routine, steps=tuple(called(step) for step in routine.steps))


def _call(pattern: Routine, found: dict[str, Node]) -> Call:
    return Call(pattern.key, tuple(found[parameter.symbol] for parameter in pattern.parameters))


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
