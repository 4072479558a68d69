"""What formulas are rewritten to before they are evaluated: names of LET and LAMBDA told from others, `@` made explicit.

Every use of a name that LET or LAMBDA gives becomes a `Local`, every call of one an `Apply`.

A range written as a single value (`=A1:A9+1`) is the evaluator's matter. But functions evaluate their lists of values as
arrays, so `SUM(A1:A9*2)` would be the sum of an array: Excel does that only in array formulas, and takes one cell of A1:A9
in others. There `SINGLE` is written around it. Functions that want arrays (SUMPRODUCT, MMULT, LOOKUP ...) take them
everywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

from ...formula.functions import FUNCTIONS
from ...formula.nodes import (
    Apply,
    Arrayed,
    Binary,
    Call,
    Local,
    NameRef,
    Node,
    RangeRef,
    TableRef,
    Unary,
    children,
    rebuilt,
    walk,
)
from .calling import SINGLES

_SCOPES = ("LET", "LAMBDA")


def with_locals(node: Node) -> Node:
    """The tree with the names of LET and LAMBDA told from those of the workbook."""
    for part in walk(node):
        if type(part) is Call and part.name in _SCOPES:
            return _in_scope(node, frozenset())
    return node


def is_function(node: Node) -> bool:
    """Whether a name's formula stands for a function: a LAMBDA, or a LET that ends with one."""
    while isinstance(node, Call) and node.name == "LET" and node.args:
        node = node.args[-1]
    return isinstance(node, Call) and node.name == "LAMBDA"


def _in_scope(node: Node, names: frozenset[str]) -> Node:
    match node:
        case Call("LET", args):
            return Call("LET", _let(args, names))
        case Call("LAMBDA", args):
            *params, body = args or (node,)
            given = tuple(given_name(param) for param in params)
            inside = names | {param.name for param in given if isinstance(param, Local)}
            return Call("LAMBDA", (*given, _in_scope(body, inside))) if args else node
        case NameRef(name, None) if name.casefold() in names:
            return Local(name.casefold())
        case Call(name, args) if name.casefold() in names:
            return Apply(Local(name.casefold()), tuple(_in_scope(arg, names) for arg in args))
        case Binary():
            return _along(node, lambda part: _in_scope(part, names))
        case _:
            below = children(node)
            return rebuilt(node, tuple(_in_scope(part, names) for part in below)) if below else node


def _let(args: tuple[Node, ...], names: frozenset[str]) -> tuple[Node, ...]:
    found: list[Node] = []
    for place, arg in enumerate(args):
        if place % 2 or place == len(args) - 1:
            found.append(_in_scope(arg, names))
            last = found[place - 1] if place else None
            if place % 2 and isinstance(last, Local):
                names |= {last.name}
        else:
            found.append(given_name(arg))
    return tuple(found)


def given_name(node: Node) -> Node:
    """The name that LET or LAMBDA gives, as a Local; anything else as it is. `[x]` may be left out in a call."""
    match node:
        case NameRef(name, None):
            return Local(name.casefold())
        case TableRef(None, parts, str(first), last) if not parts and first == last:
            return Local(first.casefold(), True)
        case _:
            return node


_LISTS = frozenset("v")
"""Kinds of arguments that are lists of values: a range is taken whole, an expression of ranges is a single value."""
_LIKE_LISTS = ("AND", "OR", "XOR")
_MAKING_REFERENCES = ("OFFSET", "INDIRECT", "INDEX")
"""Functions that give references: an array among their arguments would mean many of them."""
_BRANCHING = ("IF", "CHOOSE")
"""Functions that hand on one of their arguments, a reference as it is."""
REFERENCES = frozenset((" ", ",", ":"))
"""Operators between references."""


def intersected(node: Node) -> Node:
    """The formula with `SINGLE` around the ranges of which one cell is meant inside lists of values."""
    match node:
        case Call(name, args):
            kinds = _kinds(name, len(args))
            changed = [_argument(name, kind, arg) for arg, kind in zip(args, kinds, strict=True)]
            return _replaced(node, changed)
        case Binary():
            return _along(node, intersected, REFERENCES)
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
        return node.op not in REFERENCES
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
        case Binary(op, _, _) if op in REFERENCES:
            return node
        case Binary():
            return _along(node, _singled, REFERENCES)
        case Unary():
            return _replaced(node, [_singled(node.operand)])
        case _:
            return node


def _replaced(node: Node, below: list[Node]) -> Node:
    old = children(node)
    if all(new is part for new, part in zip(below, old, strict=True)):
        return node
    return rebuilt(node, tuple(below))


def _along(node: Binary, change: Callable[[Node], Node], but: Collection[str] = ()) -> Node:
    """A change of the operands of a run of operators (all `but` some), in a loop: a sum may have thousands of terms."""
    run: list[Binary] = []
    left: Node = node
    while isinstance(left, Binary) and left.op not in but:
        run.append(left)
        left = left.left
    if not run:
        return node
    changed = change(left)
    for part in reversed(run):
        right = change(part.right)
        same = changed is part.left and right is part.right
        changed = part if same else Binary(part.op, changed, right)
    return changed
