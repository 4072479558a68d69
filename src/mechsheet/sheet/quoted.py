"""Formulas written as they read: `formula("IF(ISNUMBER(low), high - low, NA())", low=..., high=...)`.

A name in the text is a hole when an argument of that name is given, else the symbol of a quantity (`theta14`, `C.x`), which
`Addresses.bind` turns into a cell; cells that are no quantities come through holes, as `Plan.places` has them. `ALL(x)` is
the whole column of x, `SHOWN(x)` its cell as people read it (degrees, not radians). A symbol that would read as a cell's
address (`s14`) comes through a hole of another name.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from livesheet.formula.nodes import Binary, Call, CellRef, NameRef, Node, Number, Symbol, Text, transform, walk
from livesheet.formula.parser import parse_formula

ALL, SHOWN = "ALL ", "SHOWN "
"""What the names of symbols begin with that stand for a whole column, or for a cell as people read it."""


def formula(text: str, **holes: Node | float | str) -> Node:
    """The tree of a formula in the spreadsheets' English spelling. A hole takes a tree, a number or a text constant."""
    given = {name: _node(value) for name, value in holes.items()}

    def change(part: Node) -> Node:
        match part:
            case NameRef(name, None) if name in given:
                return given[name]
            case NameRef(name, None):
                return Symbol(name)
            case Call("ALL" | "SHOWN" as way, (Symbol(name),)):
                return Symbol(f"{way} {name}")
        return part

    return transform(_parsed(text), change)


@cache
def _parsed(text: str) -> Node:
    tree = parse_formula(text)
    if any(isinstance(part, CellRef) for part in walk(tree)):
        raise ValueError(f"a name in it reads as a cell's address: {text}")
    return tree


def _node(value: Node | float | str) -> Node:
    if isinstance(value, str):
        return Text(value)
    return Number(float(value)) if isinstance(value, int | float) else value


def joined(*parts: Node | str) -> Node:
    """Texts one after another: `a & "b" & c`; empty ones are left out, constants side by side are one, and what is joined
    already needs no brackets."""
    nodes: list[Node] = []
    for part in (each for given in parts if given != "" for each in _joints(_node(given))):
        if nodes and isinstance(part, Text) and isinstance(before := nodes[-1], Text):
            nodes[-1] = Text(before.value + part.value)
        else:
            nodes.append(part)
    if not nodes:
        return Text("")
    result = nodes[0]
    for node in nodes[1:]:
        result = formula("a & b", a=result, b=node)
    return result


def _joints(node: Node) -> Iterator[Node]:
    """The texts that a tree joins."""
    match node:
        case Binary("&", left, right):
            yield from _joints(left)
            yield from _joints(right)
        case _:
            yield node
