"""Angle, length, or neither: as much of a unit check as can be made without ever refusing a sound expression."""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary
from livesheet.said import Said, say
from mechsheet.units import Unit

ANGLE, LENGTH, DEGREES, ANY = "angle", "length", "number of degrees", ""

_YIELD_ANGLES = frozenset(("ACOS", "ASIN", "ATAN", "ATAN2", "RADIANS"))
_KEEP_KIND = frozenset(("ABS", "MAX", "MIN"))


_SPELLED = {
    "deg": ("°", "degs", "degree", "degrees", "derece"),
    "rad": ("rads", "radian", "radians", "radyan"),
}
_LENGTHS = ("µm", "mm", "cm", "dm", "m", "km", "in", "inch", "ft", "milimetre", "santimetre", "metre")


def plain_unit(unit: str) -> str:
    """A unit as the model knows it: "°", "degrees" and "derece" are "deg", "radyan" is "rad"; others as they are."""
    word = unit.strip().rstrip(".").lower()
    return next((known for known, others in _SPELLED.items() if word == known or word in others), unit)


def label_fault(
    node: Node, text: str, kinds: Mapping[str, str], unit: str, length_unit: str
) -> tuple[Said | None, str]:
    """Why a free label cannot stand behind an expression, written `text`, and what to write; (None, "") where it can.

    An angle is in radians and a length in the length unit: a label that says otherwise would be wrong. A multiple by a plain
    number may be a conversion, which is the writer's own business.
    """
    kind = kind_of(node, kinds, multiples=False)
    if kind == ANGLE:
        message = say(
            '{text} is an angle, in radians unless `unit` says "deg": the label "{unit}" would stand behind radians',
            text=text,
            unit=unit,
        )
        return message, say('write unit = "deg" or unit = "rad", or convert it in the formula')
    if kind == LENGTH and unit in _LENGTHS and unit != length_unit:
        return (
            say('{text} is a length in {length}, not in "{unit}"', text=text, length=length_unit, unit=unit),
            say('write unit = "{length}", or convert it in the formula', length=length_unit),
        )
    return None, ""


def unit_kind(unit: Unit) -> str:
    """The kind of a quantity shown in `unit`; ANY for plain numbers and for labels that say nothing to us."""
    return unit.kind if unit.kind in (ANGLE, LENGTH) else ANY


def kind_of(node: Node, kinds: Mapping[str, str], multiples: bool = True) -> str:
    """The kind that an expression surely has, or ANY. `kinds` are those of its symbols.

    Signs, sums of one kind and multiples by a plain number keep the kind; arc functions make angles. Everything else
    (products of lengths, a sum with a bare number) is left undecided; so are multiples where `multiples` is False.
    """
    match node:
        case Symbol(name):
            return kinds.get(name, LENGTH if name.endswith((".x", ".y")) else ANY)
        case Unary(_, operand):
            return kind_of(operand, kinds, multiples)
        case Binary("+" | "-", left, right):
            return _common(kind_of(left, kinds, multiples), kind_of(right, kinds, multiples))
        case Binary("*", Number(), other) | Binary("*" | "/", other, Number()) if multiples:
            return kind_of(other, kinds)
        case Call("DEGREES", _):
            return DEGREES
        case Call(name, _) if name in _YIELD_ANGLES:
            return ANGLE
        case Call(name, args) if name in _KEEP_KIND and args:
            return _common(*(kind_of(arg, kinds, multiples) for arg in args))
    return ANY


def _common(*kinds: str) -> str:
    return kinds[0] if len(set(kinds)) == 1 else ANY
