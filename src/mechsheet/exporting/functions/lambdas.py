"""Functions as names of a workbook, each a LAMBDA whose steps are the names of a LET: for Excel 365."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from livesheet.formula.names import folded, safe_name
from livesheet.formula.nodes import Call, Local, Node, Symbol, transform
from livesheet.workbook import NamedFunction
from mechsheet.exporting.functions.all_functions import TABLE_KEY, Function
from mechsheet.exporting.functions.routines import guarded
from mechsheet.exporting.lowering import missing_where

MOST_PAIRS = 120
"""Names of one LET: it takes 126."""


def named_functions(
    functions: Sequence[Function],
    names: Mapping[str, str],
    mode_cell: Callable[[str], Node] | None = None,
    taken: Collection[str] = (),
) -> tuple[NamedFunction, ...]:
    """The names of a workbook.

    names      key of a function -> its name
    mode_cell  the cell of a configuration, which the table's function reads; the others take it as an argument, and with
               None all of them do
    taken      names that the workbook has (folded): a parameter may hide one in Excel, but not in every program
    """
    others = {*taken, *(folded(name) for name in names.values())}
    return tuple(
        NamedFunction(names[function.key], _formula(function, names, mode_cell, others)) for function in functions
    )


def modes_read(function: Function) -> tuple[str, ...]:
    """The configurations that a function reads from their cells: the table's function."""
    return tuple(function.modes) if function.key == TABLE_KEY else ()


def _formula(
    function: Function, names: Mapping[str, str], mode_cell: Callable[[str], Node] | None, others: Collection[str]
) -> Node:
    routine = function.routine
    taken = set(others)
    forms: dict[str, Node] = {symbol: mode_cell(symbol) for symbol in modes_read(function)} if mode_cell else {}

    def local(symbol: str, shown: str) -> Local:
        name = safe_name(shown, taken)
        taken.add(folded(name))
        found = Local(name)
        forms[symbol] = found
        return found

    def said(node: Node) -> Node:
        def change(part: Node) -> Node:
            if isinstance(part, Symbol):
                return forms[part.name]
            return Call(names[part.name], part.args) if isinstance(part, Call) and part.name in names else part

        return transform(node, change)

    parameters = [
        local(part.symbol, shown)
        for part, shown in zip(routine.parameters, function.parameters, strict=True)
        if part.symbol not in forms
    ]
    pairs: list[tuple[Local, Node]] = []
    for step in routine.steps:
        expression = said(missing_where(step.missing, step.expression))
        pairs.append((local(step.symbol, step.symbol), expression))
    body = guarded(routine, said(missing_where(routine.missing, routine.result)), forms)
    for start in reversed(range(0, len(pairs), MOST_PAIRS)):
        parts: list[Node] = [node for pair in pairs[start : start + MOST_PAIRS] for node in pair]
        body = Call("LET", (*parts, body))
    return Call("LAMBDA", (*parameters, body))
