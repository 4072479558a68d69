"""Numbers as people write them: with their unit ("60 rpm", "2 kN", "0.3 N/mm"), and what they are in another one; with a
decimal comma, a minus sign that no keyboard has, a unit behind, and what is meant by that.

The units are those of the field. A package of units (pint) knows thousands more, and weighs more than what it would save.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from livesheet.said import say
from mechsheet.description.kinds import plain_unit
from mechsheet.diagnostics import quoted
from mechsheet.model import inertia_label
from mechsheet.units import behind_number

LARGEST, SMALLEST = 1e100, 1e-100
"""Sizes of numbers that can be multiplied a few times without leaving what a spreadsheet can hold."""


@dataclass(frozen=True, slots=True)
class Known:
    """A unit: what one of it is in m, kg, s and rad, as factor·π^turns; `powers` are those of the four."""

    factor: Fraction
    turns: int = 0
    powers: tuple[int, int, int, int] = (0, 0, 0, 0)

    def times(self, other: Known, power: int) -> Known:
        """The product with a power of another unit."""
        both = zip(self.powers, other.powers, strict=True)
        length, mass, time, angle = (own + power * its for own, its in both)
        return Known(self.factor * other.factor**power, self.turns + power * other.turns, (length, mass, time, angle))


def _known(factor: str, *powers: int, turns: int = 0) -> Known:
    length, mass, time, angle = powers
    return Known(Fraction(factor), turns, (length, mass, time, angle))


_FORCE, _WORK, _POWER = (1, 1, -2, 0), (2, 1, -2, 0), (2, 1, -3, 0)
_RPM = _known("1/30", 0, 0, -1, 1, turns=1)
_WORDS: dict[str, Known] = {
    "µm": _known("1e-6", 1, 0, 0, 0),
    "mm": _known("1e-3", 1, 0, 0, 0),
    "cm": _known("1e-2", 1, 0, 0, 0),
    "dm": _known("1e-1", 1, 0, 0, 0),
    "m": _known("1", 1, 0, 0, 0),
    "km": _known("1e3", 1, 0, 0, 0),
    "in": _known("0.0254", 1, 0, 0, 0),
    "ft": _known("0.3048", 1, 0, 0, 0),
    "yd": _known("0.9144", 1, 0, 0, 0),
    "g": _known("1e-3", 0, 1, 0, 0),
    "kg": _known("1", 0, 1, 0, 0),
    "t": _known("1e3", 0, 1, 0, 0),
    "lb": _known("0.45359237", 0, 1, 0, 0),
    "slug": Known(Fraction("4.4482216152605") / Fraction("0.3048"), 0, (0, 1, 0, 0)),
    "ms": _known("1e-3", 0, 0, 1, 0),
    "s": _known("1", 0, 0, 1, 0),
    "min": _known("60", 0, 0, 1, 0),
    "h": _known("3600", 0, 0, 1, 0),
    "rad": _known("1", 0, 0, 0, 1),
    "deg": _known("1/180", 0, 0, 0, 1, turns=1),
    "rev": _known("2", 0, 0, 0, 1, turns=1),
    "rpm": _RPM,
    "N": _known("1", *_FORCE),
    "kN": _known("1e3", *_FORCE),
    "MN": _known("1e6", *_FORCE),
    "kgf": _known("9.80665", *_FORCE),
    "lbf": _known("4.4482216152605", *_FORCE),
    "kip": _known("4448.2216152605", *_FORCE),
    "J": _known("1", *_WORK),
    "W": _known("1", *_POWER),
    "kW": _known("1e3", *_POWER),
}
_SPELLED = {
    "inch": "in",
    "lbm": "lb",
    "slugs": "slug",
    "milimetre": "mm",
    "santimetre": "cm",
    "metre": "m",
    "millimetre": "mm",
    "millimeter": "mm",
    "centimetre": "cm",
    "centimeter": "cm",
    "meter": "m",
    "gr": "g",
    "gram": "g",
    "kilogram": "kg",
    "newton": "N",
    "sn": "s",
    "sec": "s",
    "μm": "µm",
}
_WHOLE = {
    **dict.fromkeys(("1/min", "r/min", "U/min", "d/dk", "dev/dk", "dev/dak", "devir/dakika", "min^-1"), _RPM),
    "Hz": _known("2", 0, 0, -1, 1, turns=1),
}
"""Units that mean something else than their parts: 1/min and Hz of a shaft are turns."""

_TOUCHED = ("kN", "kgf", "lbf", "kip", "N", "kg")
"""Units that people write the next one at without a blank: Nm, kNm, Ns/mm, kgm²."""

EXAMPLES = "mm, cm, m, in, deg, rad, rpm, mm/s, N, kN, N m, N/mm, N s/mm, kg, kg m², s; in, ft, lbf, lb, slug"

_PART = r"(?:°|[^\W\d_]+)(?:[²³23]|\^-?[1-9])?"
_UNIT = rf"(?:1/)?{_PART}(?:[ *·⋅./]{_PART})*"
_MEASURED = re.compile(rf"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{{1,3}})?)[ \t]*({_UNIT})\.?")
_PIECE = re.compile(r"([ /]?)([^\W\d_]+)(?:\^(-?[1-9]))?")
_WORD, _RAISED, _DOT = (
    re.compile(r"[^\W\d_]+"),
    re.compile(r"(?<=[^\W\d_])[23](?![\w.])"),
    re.compile(r"(?<=\w)\.(?=\w)"),
)


@dataclass(frozen=True, slots=True)
class Measured:
    """A number with its unit: both as written, the unit with ^ for raised digits."""

    number: str
    unit: str

    @property
    def value(self) -> float:
        """The number."""
        return float(self.number)

    def in_unit(self, unit: str) -> float | None:
        """The number in another unit, rounded once; None where that is of another kind, or one of the two is not known."""
        if spelled(unit) == self.unit:
            return self.value
        own, other = unit_named(self.unit), unit_named(unit)
        if own is None or other is None or own.powers != other.powers:
            return None
        exact = Fraction(self.number) * own.factor / other.factor
        return float(exact) * math.pi ** (own.turns - other.turns)


def measured(text: str) -> Measured | None:
    """What a text says as a number with its unit; None for other texts, and for sizes that no sheet can hold.

    No expression is one: nothing can stand behind a number there without an operator.
    """
    found = _MEASURED.fullmatch(text.strip())
    if found is None:
        return None
    unit = spelled(found[2])
    size = abs(float(found[1]))
    if (size and not SMALLEST <= size <= LARGEST) or (unit_named(unit) is None and not unit.isalpha()):
        return None
    return Measured(found[1], unit)


def unit_behind(text: str) -> str | None:
    """What stands behind the number of a text in the form of a number with its unit, known or not; None for other texts."""
    found = _MEASURED.fullmatch(text.strip())
    return None if found is None else found[2]


def spelled(unit: str) -> str:
    """A unit as this module spells it: `N·s/mm` and `Ns/mm` are `N s/mm`, `m/s²` and `m/s2` are `m/s^2`, `°` is `deg`."""
    unit = _DOT.sub(" ", re.sub(r"[*·⋅]", " ", unit.strip())).replace("²", "^2").replace("³", "^3")
    unit = _RAISED.sub(r"^\g<0>", unit)
    unit = unit.replace("°", "deg").replace("degC", "°C")
    if unit.isalpha():
        word = plain_unit(unit)
        unit = _SPELLED.get(word, word)
    return _WORD.sub(lambda word: _parted(word[0]), unit)


def _parted(word: str) -> str:
    """A word that is two units without a blank between them, with the blank; others as they are."""
    if word in _WORDS or word in _SPELLED:
        return word
    halves = ((first, word.removeprefix(first)) for first in _TOUCHED if word.startswith(first))
    return next((f"{first} {second}" for first, second in halves if second in _WORDS), word)


def like(unit: str) -> str:
    """The known unit that differs from this one by upper and lower case alone; "" where there is none."""
    return next((known for known in (*_WORDS, *_SPELLED) if known.casefold() == unit.casefold()), "")


@lru_cache(maxsize=256)
def unit_named(unit: str) -> Known | None:
    """The unit that a text means; None where it is not known."""
    unit = spelled(unit)
    if unit in _WHOLE:
        return _WHOLE[unit]
    whole, at = Known(Fraction(1)), 0
    while at < len(unit):
        found = _PIECE.match(unit, at)
        word = None if found is None else _WORDS.get(_SPELLED.get(found[2], found[2]))
        if found is None or word is None or bool(found[1]) != bool(at):
            return None
        power = int(found[3] or 1)
        whole = whole.times(word, -power if found[1] == "/" else power)
        at = found.end()
    return whole if unit else None


# --- in which unit a dimension has it ---------------------------------------------------------------------------------

METRES = {"mm": 0.001, "cm": 0.01, "dm": 0.1, "m": 1.0}
"""Length unit -> metres: with these masses are in kg and forces in N."""

CONSISTENT = {"in": ("lbf", "lbf s²/in"), "ft": ("lbf", "slug")}
"""Length unit -> the units of forces and masses that go with it, so that a force is a mass times an acceleration: there is
no factor in any formula. A mass in pounds is written with its unit, and its cell has it in these."""


def consistent(force: str, mass: str, length: str) -> bool | None:
    """Whether one of the force is one of the mass times one of the length per s²; None where one of them is not known."""
    units = [unit_named(unit) for unit in (force, mass, length, "s")]
    if any(unit is None for unit in units):
        return None
    one, body, way, second = (unit for unit in units if unit is not None)
    return one == body.times(way, 1).times(second, -2)


def labels_of(length_unit: str) -> tuple[str, ...]:
    """Units of dimensions that are neither lengths nor angles: those in which the program computes, so that a formula may
    read the cell as it is. With lengths in a unit of one's own nobody knows what goes with it.
    """
    turning = ("rad/s", "rad/s²", "s")
    if length_unit in CONSISTENT:
        force, mass = CONSISTENT[length_unit]
        per_length = (f"{force}/{length_unit}", f"{force} s/{length_unit}", f"{length_unit}/s", f"{length_unit}/s²")
        torque = f"{force} {length_unit}"
        return (force, torque, mass, inertia_label(mass, length_unit), f"{torque}/s", *per_length, *turning)
    if length_unit not in METRES:
        return turning
    per_length = (f"N/{length_unit}", f"N s/{length_unit}", f"{length_unit}/s", f"{length_unit}/s²")
    return ("N", "N m", "kg", "kg m²", "m/s²", "W", *per_length, *turning)


def home(found: Measured, length_unit: str) -> tuple[float, str] | None:
    """A number with its unit in the unit that a dimension has; None where there is none.

    Where several fit (m/s² and mm/s²) the one that is written comes first.
    """
    units = (length_unit, "deg", "rad", *labels_of(length_unit))
    for unit in sorted(units, key=lambda unit: spelled(unit) != found.unit):
        if (number := found.in_unit(unit)) is not None:
            return number, unit
    return None


# --- as people type them ----------------------------------------------------------------------------------------------

MINUS = "−–‒—﹣－"
"""Signs that word processors and web pages write for a minus."""

BLANKS = "\u00a0\u2000-\u200b\u202f\u205f\u2060\u3000\ufeff"
"""For a regular expression: spaces that look like one and are none, also those without any width."""

_TYPED = re.compile(
    rf"(?P<sign>[+\-{MINUS}]?)[ {BLANKS}]*"
    r"(?P<number>(?:[0-9]{1,3}(?:\.[0-9]{3})+,[0-9]+|[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)(?:[eE][+\-]?[0-9]+)?)"
    rf"[ \t{BLANKS}]*(?P<unit>[^\W\d_][^\W\d_]*\.?|[°%′″]?)"
)


@dataclass(frozen=True, slots=True)
class Typed:
    """A number that was meant: `text` is how TOML and expressions write it, `unit` what stood behind it, "" for nothing.

    why  what is wrong with it as it stands, "" when it is only in quotes
    """

    text: str
    unit: str
    why: str

    @property
    def hint(self) -> str:
        """What to write instead."""
        if not self.unit:
            return say("write {new}", new=self.text)
        if self.measured is None:
            return say("units that are known: {units}", units=EXAMPLES)
        return say("write {new}", new=f'"{self.measured}"')

    @property
    def measured(self) -> str | None:
        """The number with its unit as a description takes it, without the quotes; None where the unit is not known."""
        text = self.text + behind_number(self.unit)
        return None if unit_named(self.unit) is None or measured(text) is None else text


def typed_number(text: str) -> Typed | None:
    """The number that a text is meant as; None for anything else, and for names that begin with a digit."""
    found = _TYPED.fullmatch(text.strip())
    if found is None:
        return None
    number, unit = found["number"], found["unit"].rstrip(".")
    plain = number.replace(".", "").replace(",", ".") if "," in number else number
    plain = ("0" if plain[0] == "." else "") + plain
    plain = re.sub(r"\.(?=[eE]|$)", "", plain)
    plain = re.sub(r"^0+(?=\d)", "", plain)
    sign = "-" if found["sign"] in tuple(MINUS) else found["sign"]
    return Typed(sign + plain, unit, _why(found["sign"], number, unit))


def _why(sign: str, number: str, unit: str) -> str:
    if sign in tuple(MINUS):
        return say("{sign} (U+{code:04X}) is not the minus sign of a keyboard", sign=quoted(sign), code=ord(sign))
    if "," in number:
        return say("the decimal sign is a point")
    if unit:
        return say("the unit {unit} stands behind the number", unit=quoted(unit))
    return ""


_WITH_COMMA = re.compile(rf"[+\-{MINUS}]?[0-9]+(?:,[0-9]+)?")


def with_points(items: str) -> list[str] | None:
    """The numbers of a list that was written with decimal commas: `[50,5, 55,2]` and `[50,5, 3]`; None for other lists.

    A decimal comma has digits on both sides and no blank, the commas between the items have a blank behind them; or there
    is no blank at all: `[50,5,55,2]`.
    """
    inside = items.strip()[1:-1].strip()
    parts = re.split(r",\s+", inside) if re.search(r"\s", inside) else re.findall(r"[^,]+,[^,]+", inside)
    if not any("," in part for part in parts) or not all(_WITH_COMMA.fullmatch(part) for part in parts):
        return None
    return [part.replace(",", ".") for part in parts]
