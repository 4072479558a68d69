"""The arguments of a call that are single values, so that an array there means one result for each of its cells.

A slot is the way to an argument: (2,) the third one, (0, 1) the second argument of the function in the first one, which
gives a reference (`SUBTOTAL(9, OFFSET(A1, {0;1;2}, 0))` is three sums).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from ...formula.functions import FUNCTIONS
from ...formula.nodes import Call, Missing, Node
from .intersections import SINGLES

Slot: TypeAlias = tuple[int, ...]
_GIVING_REFERENCES = ("OFFSET", "INDIRECT")


def slots(node: Call) -> list[Slot]:
    """The slots of a call, its own and those of the references it is given."""
    found: list[Slot] = []
    for place, (arg, kind) in enumerate(zip(node.args, FUNCTIONS[node.name].kinds_of(len(node.args)), strict=True)):
        if kind in SINGLES or kind == "q":
            found.append((place,))
        elif isinstance(arg, Call) and arg.name in _GIVING_REFERENCES:
            found += [(place, *inner) for inner in slots(arg) if not isinstance(at_slot(arg, inner), Missing)]
    return found


def at_slot(node: Call, slot: Slot) -> Node:
    """The argument in a slot."""
    found: Node = node
    for place in slot:
        assert isinstance(found, Call)
        found = found.args[place]
    return found


def with_slots(node: Call, new: Mapping[Slot, Node]) -> Call:
    """The call with other arguments in some slots."""
    args = list(node.args)
    for place, arg in enumerate(args):
        inner = {slot[1:]: value for slot, value in new.items() if slot[0] == place}
        if () in inner:
            args[place] = inner[()]
        elif inner and isinstance(arg, Call):
            args[place] = with_slots(arg, inner)
    return Call(node.name, tuple(args))
