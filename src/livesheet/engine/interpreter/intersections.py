"""Ranges of which an ordinary formula (no array formula) takes the cell beside itself, made explicit as `@`.

A range written as a single value (`=A1:A9+1`) is the evaluator's matter. But functions evaluate their lists of values as
arrays, so `SUM(A1:A9*2)` would be the sum of an array: Excel does that only in array formulas, and takes one cell of A1:A9
in others. Functions that want arrays (SUMPRODUCT, MMULT, LOOKUP ...) take them everywhere.
"""

from __future__ import annotations

from ...formula.functions import FUNCTIONS
from ...formula.nodes import Arrayed, Binary, Call, Node, RangeRef, TableRef, Unary, children, rebuilt

SINGLES = frozenset("npytbdae")
"""Kinds of arguments that are single values."""
_LISTS = frozenset("v")
"""Kinds of arguments that are lists of values: a range is taken whole, an expression of ranges is a single value."""
_LIKE_LISTS = ("AND", "OR", "XOR")
_MAKING_REFERENCES = ("OFFSET", "INDIRECT", "INDEX")
"""Functions that give references: an array among their arguments would mean many of them."""
_BRANCHING = ("IF", "CHOOSE")
"""Functions that hand on one of their arguments, a reference as it is."""
_REFERENCES = (" ", ",", ":")


def intersected(node: Node) -> Node:
    """The formula with `SINGLE` around the ranges of which one cell is meant inside lists of values."""
    match node:
        case Call(name, args):
            kinds = _kinds(name, len(args))
            changed = [_argument(name, kind, arg) for arg, kind in zip(args, kinds, strict=True)]
            return _replaced(node, changed)
        case Binary():
            return _along(node, intersected)
        case _ if children(node) and not isinstance(node, RangeRef | Arrayed):
            return _replaced(node, [intersected(part) for part in children(node)])
        case _:
            return node


def _argument(name: str, kind: str, arg: Node) -> Node:
    """An argument of a function, by its kind."""
    if kind in _LISTS and isinstance(arg, Call) and arg.name in _BRANCHING and arg.args:
        condition, *branches = arg.args
        return _replaced(arg, [_singled(condition), *(_argument("", kind, branch) for branch in branches)])
    if (kind in _LISTS and _computes(arg)) or (kind in SINGLES and name in _MAKING_REFERENCES):
        return _singled(arg)
    return arg if kind in "rmqfgl" and not _makes_reference(arg) else intersected(arg)


def _makes_reference(node: Node) -> bool:
    return isinstance(node, Call) and node.name in _MAKING_REFERENCES


def _kinds(name: str, count: int) -> str:
    row = FUNCTIONS.get(name)
    kinds = row.kinds_of(count) if row is not None else ""
    if name in _LIKE_LISTS:
        kinds = "v" * count
    return kinds.ljust(count, "r")


def _computes(node: Node) -> bool:
    """Whether an argument is an expression, not a reference."""
    if isinstance(node, Binary):
        return node.op not in _REFERENCES
    if isinstance(node, Call):
        return set(_kinds(node.name, len(node.args))) <= SINGLES and node.name not in (*_BRANCHING, "SINGLE")
    return isinstance(node, Unary)


def _singled(node: Node) -> Node:
    """The expression with `SINGLE` around ranges where single values stand."""
    match node:
        case RangeRef() | TableRef():
            return Call("SINGLE", (node,))
        case Call(name, args):
            kinds = _kinds(name, len(args))
            return _replaced(
                node,
                [
                    _singled(arg) if kind in SINGLES else _argument(name, kind, arg)
                    for arg, kind in zip(args, kinds, strict=True)
                ],
            )
        case Binary(op, _, _) if op in _REFERENCES:
            return node
        case Binary():
            return _along(node, _singled)
        case Unary():
            return _replaced(node, [_singled(node.operand)])
        case _:
            return node


def _replaced(node: Node, below: list[Node]) -> Node:
    old = children(node)
    if all(new is part for new, part in zip(below, old, strict=True)):
        return node
    return rebuilt(node, tuple(below))


def _along(node: Binary, change: object) -> Node:
    """A change of the operands of a run of operators, in a loop: a sum may have thousands of terms."""
    assert callable(change)
    run: list[Binary] = []
    left: Node = node
    while isinstance(left, Binary) and left.op not in _REFERENCES:
        run.append(left)
        left = left.left
    if not run:
        return node
    changed: Node = change(left)
    for part in reversed(run):
        right: Node = change(part.right)
        same = changed is part.left and right is part.right
        changed = part if same else Binary(part.op, changed, right)
    return changed
