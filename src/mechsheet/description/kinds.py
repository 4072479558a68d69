"""Angle, length, or neither: as much of a unit check as can be made without ever refusing a sound expression."""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary

ANGLE, LENGTH, DEGREES, ANY = "angle", "length", "number of degrees", ""

_YIELD_ANGLES = frozenset(("ACOS", "ASIN", "ATAN", "ATAN2", "RADIANS"))
_KEEP_KIND = frozenset(("ABS", "MAX", "MIN"))


def unit_kind(unit: str, length_unit: str) -> str:
    """The kind of a quantity shown in `unit`; ANY for plain numbers and for labels that say nothing to us."""
    if unit in ("deg", "rad"):
        return ANGLE
    return LENGTH if unit == length_unit else ANY


def kind_of(node: Node, kinds: Mapping[str, str]) -> str:
    """The kind that an expression surely has, or ANY. `kinds` are those of its symbols.

    Signs, sums of one kind and multiples by a plain number keep the kind; arc functions make angles. Everything else
    (products of lengths, a sum with a bare number) is left undecided.
    """
    match node:
        case Symbol(name):
            return LENGTH if "." in name else kinds.get(name, ANY)
        case Unary(_, operand):
            return kind_of(operand, kinds)
        case Binary("+" | "-", left, right):
            return _common(kind_of(left, kinds), kind_of(right, kinds))
        case Binary("*", Number(), other) | Binary("*" | "/", other, Number()):
            return kind_of(other, kinds)
        case Call("DEGREES", _):
            return DEGREES
        case Call(name, _) if name in _YIELD_ANGLES:
            return ANGLE
        case Call(name, args) if name in _KEEP_KIND and args:
            return _common(*(kind_of(arg, kinds) for arg in args))
    return ANY


def _common(*kinds: str) -> str:
    return kinds[0] if len(set(kinds)) == 1 else ANY
