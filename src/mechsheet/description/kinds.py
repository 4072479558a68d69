"""Angle, length, or neither: as much of a unit check as can be made without ever refusing a sound expression."""

from __future__ import annotations

import math
from collections.abc import Mapping

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary, symbols, walk
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


_TAKE_ANGLES = frozenset(("SIN", "COS", "TAN"))

_ADVICE = "write radians({number}) for {number} degrees"


def meant_in_degrees(node: Node, kinds: Mapping[str, str]) -> tuple[Said, Said] | None:
    """What is wrong with an expression that takes an angle to be in degrees, and what to write; None where nothing is.

    A round number above a turn, added to an angle or compared with one, or under a sine, is a number of degrees; an angle
    is in radians already; a sine takes no degrees.
    """
    for part in walk(node):
        beside: tuple[Node, ...]
        match part:
            case Binary("+" | "-", left, right):
                beside = (left, right)
            case Call(name, args) if name in _KEEP_KIND:
                beside = args
            case Call(name, (arg,)) if name in _TAKE_ANGLES:
                if kind_of(arg, kinds) == DEGREES:
                    return say("{name}() takes radians", name=name.lower()), say("leave degrees() out")
                if _is_degrees(arg):
                    return _in_radians(arg)
                continue
            case Call("RADIANS", (arg,)) if kind_of(arg, kinds) == ANGLE:
                return say("radians() of an angle, which is in radians already"), say("leave radians() out")
            case _:
                continue
        # 1500*theta12 may be a moment: a multiple has its own unit
        if any(kind_of(each, kinds, multiples=False) == ANGLE for each in beside):
            for each in filter(_is_degrees, beside):
                return _in_radians(each)
    return None


def _is_degrees(node: Node) -> bool:
    """Whether it is a number that nobody writes for radians: above a turn, and whole or a half."""
    value = _plain(node)
    return value is not None and abs(value) > math.tau and (2 * value).is_integer()


def _plain(node: Node) -> float | None:
    """The value of a plain number, perhaps with a sign."""
    match node:
        case Number(value):
            return value
        case Unary("-" | "+" as sign, Number(value)):
            return -value if sign == "-" else value
    return None


def _in_radians(node: Node) -> tuple[Said, Said]:
    number = f"{_plain(node):g}"
    return say("{number} would be radians, as angles in expressions are", number=number), say(_ADVICE, number=number)


_TWO = (2.0, 0.5)
"""Twice a length and half of one are lengths to everybody; x/50 may be an arc over its radius."""


def length_as_angle(node: Node, kinds: Mapping[str, str]) -> Node | None:
    """The length in an expression that stands where an angle is needed: a length itself, or one beside a plain constant."""
    match node:
        case Unary(_, operand):
            return length_as_angle(operand, kinds)
        case Binary("+" | "-", left, right) if not symbols(left) or not symbols(right):
            return length_as_angle(left if symbols(left) else right, kinds)
        case Binary("*", Number(number), other) | Binary("*" | "/", other, Number(number)) if number in _TWO:
            return length_as_angle(other, kinds)
    return node if kind_of(node, kinds, multiples=False) == LENGTH else None


def length_for_angle(node: Node, kinds: Mapping[str, str]) -> tuple[Node, Said] | None:
    """A length that an expression takes for an angle, and where it does so; None where there is none."""
    for part in walk(node):
        beside: tuple[Node, ...] = ()
        match part:
            case Call(name, (arg,)) if name in (*_TAKE_ANGLES, "RADIANS", "DEGREES"):
                if length := length_as_angle(arg, kinds):
                    return length, say("{name}() of a length", name=name.lower())
            case Binary("+" | "-", left, right):
                beside = (left, right)
            case Call(name, args) if name in _KEEP_KIND:
                beside = args
        by_kind = {kind_of(each, kinds, multiples=False): each for each in beside}
        if LENGTH in by_kind and ANGLE in by_kind:
            return by_kind[LENGTH], say("a length beside an angle")
    return None


def is_number_of_degrees(node: Node) -> bool:
    """Whether an expression is made of numbers alone, and one is of degrees (30, 360/72) or it is itself above a turn: an
    angle in degrees, to most who write it."""
    parts = list(walk(node))
    if any(isinstance(part, Symbol | Call) for part in parts):
        return False
    return any(map(_is_degrees, parts)) or abs(_plain(node) or 0.0) > math.tau
