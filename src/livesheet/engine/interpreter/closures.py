"""What the parts of a formula ask of whoever evaluates it, and what the names of LET and LAMBDA stand for then.

A name stands for a tree in the scope in which it was given, evaluated when it is first needed (`Bound`), for cells that are
known, or for nothing: an argument that was left out. A function (`Closure`) is a LAMBDA with the scope it was written in.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ...formula.functions import FUNCTIONS
from ...formula.nodes import Apply, Call, FunctionRef, Local, Missing, Node
from ..values.cells import NAME, NUM, VALUE, Bound, Cells, Frame, Scope, Span, error
from ..values.coerce import truths_of
from .environment import CELLS_A_STEP, Budget
from .reading import Reading

MOST_CALLS = 1024
"""How deep functions may call one another: #NUM! beyond."""

Reader: TypeAlias = Callable[[str, bool, str, int, int], "Node | None"]


class Evaluation(Reading, ABC):
    """All that functions and references know of the evaluator that calls them."""

    scopes: Scopes

    @abstractmethod
    def value(self, node: Node, frame: Frame, spread: bool = False) -> Cells:
        """The value of a tree over a frame. `spread`: a range is an array there; else the cell of it beside the formula."""

    @abstractmethod
    def mapped(self, function: Callable[..., Any], args: tuple[Cells, ...]) -> Cells:
        """A function of numbers over values: errors of arguments first, from the left, then the function's own."""

    @abstractmethod
    def span(self, node: Node, frame: Frame) -> Span | None:
        """The one rectangle that a reference means over the frame, None where it leaves the sheet or is no reference."""

    @abstractmethod
    def region(self, node: Node, frame: Frame, spread: bool) -> Cells:
        """The cells that an expression means which gives a reference: as an array, or the one beside the formula."""


class Closure(NamedTuple):
    """A function: its parameters, its body, and the scope in which it was written."""

    params: tuple[Local, ...]
    body: Node
    scope: Scope | None = None

    def given(self, args: Sequence[Bound]) -> Scope | None:
        """The scope of the body for some arguments; None when there are too many or too few."""
        missing = [Bound(omitted=True) for _ in self.params[len(args) :]]
        if len(args) > len(self.params) or any(not param.optional for param in self.params[len(args) :]):
            return None
        names = (param.name for param in self.params)
        return {**(self.scope or {}), **dict(zip(names, (*args, *missing), strict=True))}


class Scopes:
    """Names, functions and calls of one evaluation.

    functions  what the workbook's names for functions mean
    reference  the reference that a text says (text, in A1 form, sheet, row, column), None when it says none
    budget     what calls of functions cost
    """

    def __init__(self, functions: Mapping[FunctionRef, Node], reference: Reader, budget: Budget) -> None:
        self.functions = functions
        self.reference = reference
        self.budget = budget

    def let(self, args: Sequence[Node], frame: Frame) -> tuple[Node, Frame]:
        """The last argument of LET and the frame with its names."""
        scope = dict(frame.names or {})
        for name, value in zip(args[:-1:2], args[1:-1:2], strict=False):
            if isinstance(name, Local):
                scope = {**scope, name.name: Bound(value, scope)}
        return args[-1], frame.within(scope)

    def local(self, ev: Evaluation, name: str, frame: Frame, spread: bool) -> Cells:
        """The value of a name."""
        bound = (frame.names or {}).get(name)
        if bound is None:
            return error(NAME)
        if bound.omitted:
            return ev.texts.constant(None)
        found = bound_value(ev, bound, frame, spread)
        if self.budget.depth:
            self.budget.spend(1 + np.size(found.numbers) // CELLS_A_STEP)
        return found

    def is_omitted(self, node: Node, frame: Frame) -> bool:
        """Whether a name stands for an argument that was left out."""
        bound = (frame.names or {}).get(node.name) if isinstance(node, Local) else None
        return bound is not None and bound.omitted

    # functions

    def call(self, ev: Evaluation, node: Apply, frame: Frame, spread: bool) -> Cells:
        """The value of a call."""
        found = self.applied(ev, node, frame)
        return found if isinstance(found, Cells) else self.body_value(ev, *found, spread)

    def body_value(self, ev: Evaluation, body: Node, frame: Frame, spread: bool) -> Cells:
        """The value of a function's body, #NUM! when functions call each other too deep."""
        budget = self.budget
        if budget.depth >= MOST_CALLS:
            return error(NUM)
        budget.depth += 1
        try:
            budget.spend(1)
            return ev.value(body, frame, spread)
        finally:
            budget.depth -= 1

    def applied(self, ev: Evaluation, node: Apply, frame: Frame) -> tuple[Node, Frame] | Cells:
        """The body of the function that is called, in the frame with its arguments; or why it cannot be called."""
        self.budget.spend(1)
        closure = self.function(ev, node.function, frame, len(node.args))
        if closure is None:
            return error(VALUE)
        scope = closure.given([_argument(arg, frame.names) for arg in node.args])
        return error(VALUE) if scope is None else (closure.body, frame.within(scope))

    def function(self, ev: Evaluation, node: Node, frame: Frame, count: int) -> Closure | None:
        """The function that a tree stands for, None when it stands for none; `count`: how many arguments it will get."""
        match node:
            case Call("LAMBDA", args) if args:
                params = tuple(param for param in args[:-1] if isinstance(param, Local))
                return Closure(params, args[-1], frame.names) if len(params) == len(args) - 1 else None
            case Call("LET", args):
                return self.function(ev, *self.let(args, frame), count)
            case Call("IF", (condition, *branches)):
                mask, errors = truths_of(ev.value(condition, frame), ev.texts)
                taken = 0 if np.all(mask) else 1
                known = errors is None and np.size(mask) == 1 and taken < len(branches)
                return self.function(ev, branches[taken], frame, count) if known else None
            case FunctionRef(name, ""):
                return _builtin(name, count)
            case FunctionRef():
                body = self.functions.get(node)
                return None if body is None else self.function(ev, body, frame.within(None), count)
            case Local(name):
                bound = (frame.names or {}).get(name)
                if bound is None or bound.cells is not None or bound.omitted:
                    return None
                return self.function(ev, bound.node, frame.within(bound.scope), count)
            case Apply():
                found = self.applied(ev, node, frame)
                return None if isinstance(found, Cells) else self.function(ev, *found, count)
            case _:
                return None

    def called(self, ev: Evaluation, closure: Closure, args: Sequence[Bound], frame: Frame, spread: bool) -> Cells:
        """The value of a function for arguments at hand."""
        scope = closure.given(args)
        return error(VALUE) if scope is None else self.body_value(ev, closure.body, frame.within(scope), spread)


def bound_value(ev: Evaluation, bound: Bound, frame: Frame, spread: bool) -> Cells:
    """The value of what a name stands for."""
    if bound.cells is not None:
        return bound.cells
    place = frame.row, frame.col, frame.rows, frame.cols, spread
    found = bound.known.get(place)
    if found is None:
        found = bound.known[place] = ev.value(bound.node, frame.within(bound.scope), spread)
    return found


def _argument(node: Node, scope: Scope | None) -> Bound:
    """What an argument stands for. A name stands for what it stood for: a function that hands itself on to itself would else
    be looked up through all its calls."""
    if isinstance(node, Missing):
        return Bound(omitted=True)
    known = (scope or {}).get(node.name) if isinstance(node, Local) else None
    return known if known is not None and not known.omitted else Bound(node, scope)


def _builtin(name: str, count: int) -> Closure | None:
    """A function of the program as a function of so many arguments."""
    row = FUNCTIONS.get(name)
    if row is None or not row.least <= count <= row.most:
        return None
    params = tuple(Local(f"argument {place}") for place in range(count))
    return Closure(params, Call(name, params))
