"""Numbers as people type them: a decimal comma, a unit behind, a minus sign that no keyboard has; and what they mean."""

from __future__ import annotations

import re
from dataclasses import dataclass

from livesheet.said import say
from mechsheet.description.text.measured import EXAMPLES, measured, unit_named
from mechsheet.diagnostics import quoted
from mechsheet.units import behind_number

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
