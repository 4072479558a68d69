"""The names in which expressions about a synthesis are written, and the symbols that they mean."""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, with_symbols
from livesheet.formula.parser import parse_description
from mechsheet.kinematics.build_equations import counts_from_driven
from mechsheet.model import Synthesis
from mechsheet.sheet.plan import Plan

MODE = "mode"
"""The result that is an assembly."""


class Naming:
    """Results mean the mechanism's dimensions where it has them, else, or where asked for, their exact values.

    The assembly is always the one that the mechanism has: that of the loop, where the description takes no other from the
    task, be it sketched or typed.
    """

    def __init__(self, plan: Plan, task: Synthesis, exact: bool = False) -> None:
        self.symbols: Mapping[str, str] = {**task.names, **task.results, **({} if exact else task.used)}
        self.nodes: dict[str, Node] = {name: Symbol(symbol) for name, symbol in self.symbols.items()}
        if MODE in task.results and (mode := _mode(plan, task)) is not None:
            self.nodes[MODE] = mode

    def tree(self, text: str | Node) -> Node:
        """The tree of an expression in the description's notation."""
        tree = parse_description(text) if isinstance(text, str) else text
        return with_symbols(tree, self.nodes)


def _mode(plan: Plan, task: Synthesis) -> Node | None:
    """The mode of the mechanism's cell, counted as the task counts it; None where it has none."""
    groups = plan.equations.groups
    taken = [group for group in groups if group.mode in task.mode]
    of_loop = [groups[loop.group - 1] for loop in plan.found.four_bars]
    group = next(iter((*taken, *of_loop)), None)
    if group is None or not group.mode:
        return None
    mode = Symbol(group.mode)
    return mode if counts_from_driven(plan.mechanism, group.pins) else al.neg(mode)
