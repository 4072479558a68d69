"""The names that LET and LAMBDA give: every use of one becomes a `Local`, every call of one an `Apply`."""

from __future__ import annotations

from ...formula.nodes import Apply, Binary, Call, Local, NameRef, Node, TableRef, children, rebuilt, walk

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
            return _chain(node, names)
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


def _chain(node: Binary, names: frozenset[str]) -> Node:
    """Operators down the left side in a loop: a sum may have thousands of terms."""
    run: list[Binary] = []
    left: Node = node
    while isinstance(left, Binary):
        run.append(left)
        left = left.left
    left = _in_scope(left, names)
    for part in reversed(run):
        left = Binary(part.op, left, _in_scope(part.right, names))
    return left
