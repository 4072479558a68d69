"""Functions of texts, scalar by scalar."""

from __future__ import annotations

import re
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..formula.nodes import ErrorValue, Missing, Node, Scalar
from .coerce import each, number_to_text, text_to_number, to_text
from .frames import Frame, UnsupportedError
from .values import Cells, codes_of

if TYPE_CHECKING:
    from .careful import Evaluator

Args = tuple[Node, ...]
VALUE = ErrorValue("#VALUE!")


def _number(value: Scalar) -> float | None:
    """A scalar as a number, None for a text that shows none."""
    if value is None:
        return 0.0
    if isinstance(value, str):
        return text_to_number(value)
    return float(value) if isinstance(value, bool | float | int) else None


class Format(NamedTuple):
    """A number format: what stands around the number, and how the number is written."""

    before: str
    after: str
    decimals: int
    optional: int
    whole: int
    point: bool
    thousands: bool
    percent: bool
    exponent: int


_PATTERN = re.compile(
    r"""(?P<before>(?:"[^"]*"|\\.|[-+ ()$:/])*)
        (?P<whole>(?:\#,\#\#)?[\#]*0*)(?:\.(?P<decimals>0*)(?P<optional>\#*))?
        (?:[eE]\+(?P<exponent>0+))?(?P<percent>%?)
        (?P<after>(?:"[^"]*"|\\.|[-+ ()$:/])*)""",
    re.VERBOSE,
)


def _literal(part: str) -> str:
    """The characters that quotation marks and backslashes protect."""
    return re.sub(r'"([^"]*)"|\\(.)', lambda m: m[1] if m[1] is not None else m[2], part)


@cache
def number_format(text: str) -> Format | None:
    """The format that a text says (`0`, `0.00`, `#,##0.0`, `0.0E+00`, `0%`), None when it is not known here."""
    match = _PATTERN.fullmatch(text)
    if match is None or not (match["whole"] or match["decimals"] or match["optional"]):
        return None
    return Format(
        before=_literal(match["before"]),
        after=_literal(match["after"]),
        decimals=len(match["decimals"] or ""),
        optional=len(match["optional"] or ""),
        whole=match["whole"].count("0"),
        point=match["decimals"] is not None,
        thousands="," in match["whole"],
        percent=bool(match["percent"]),
        exponent=len(match["exponent"] or ""),
    )


def formatted(value: float, pattern: str) -> str | None:
    """TEXT of a number; None when the format is not known here."""
    if pattern.strip().upper() in ("GENERAL", "@"):
        return number_to_text(value)
    if pattern == "":
        return ""
    sections = pattern.split(";")
    if len(sections) > 1 and '"' not in pattern:
        chosen = 1 if value < 0 else 2 if value == 0 and len(sections) > 2 else 0
        return formatted(abs(value) if chosen == 1 else value, sections[chosen])
    shape = number_format(pattern)
    return None if shape is None else _written(value, shape)


def _written(value: float, shape: Format) -> str:
    exponent = ""
    if shape.percent:
        value *= 100
    if shape.exponent:
        power = 0 if value == 0 else int(f"{value:.{shape.decimals + shape.optional}e}".partition("e")[2])
        value /= 10.0**power
        exponent = f"E{'-' if power < 0 else '+'}{abs(power):0{shape.exponent}d}"
    # Excel rounds the decimal number of 15 digits that a person sees, halves away from zero.
    number = Decimal(f"{value:.15g}").quantize(Decimal(1).scaleb(-shape.decimals - shape.optional), ROUND_HALF_UP)
    sign = "-" if value < 0 else ""  # also before what is rounded to 0, as Excel shows it
    whole, _, fraction = f"{abs(number):f}".partition(".")
    kept = fraction[: shape.decimals] + fraction[shape.decimals :].rstrip("0")
    if shape.whole == 0 and whole == "0":
        whole = ""
    whole = whole.rjust(shape.whole, "0")
    if shape.thousands:
        whole = re.sub(r"(?<=\d)(?=(?:\d{3})+$)", ",", whole)
    body = whole + ("." + kept if shape.point else "") + exponent
    return f"{sign}{shape.before}{body}{'%' if shape.percent else ''}{shape.after}"


def text(value: Scalar, pattern: Scalar) -> Scalar:
    """TEXT(value, format). The format's decimal sign is the point."""
    number = _number(value)
    if number is None or isinstance(value, bool):
        return to_text(value)
    shown = formatted(number, to_text(pattern))
    if shown is None:
        raise UnsupportedError(f'TEXT with the format "{to_text(pattern)}" is not supported')
    return shown


def fixed(value: Scalar, decimals: Scalar = 2.0, plain: Scalar = False) -> Scalar:
    """FIXED(number, decimals, no commas)."""
    number, places = _number(value), _number(decimals)
    if number is None or places is None:
        return VALUE
    whole_places = int(places)
    if whole_places < 0:
        scale = Decimal(10) ** -whole_places
        number = float((Decimal(f"{number:.15g}") / scale).quantize(Decimal(1), ROUND_HALF_UP) * scale)
    comma = "0" if _number(plain) else "#,##0"
    return formatted(number, comma + ("." + "0" * whole_places if whole_places > 0 else ""))


def _counted(value: Scalar, many: Scalar) -> tuple[str, int] | None:
    number = _number(many)
    return None if number is None or number < 0 else (to_text(value), int(number))


def left(value: Scalar, many: Scalar = 1.0) -> Scalar:
    """LEFT."""
    parts = _counted(value, many)
    return VALUE if parts is None else parts[0][: parts[1]]


def right(value: Scalar, many: Scalar = 1.0) -> Scalar:
    """RIGHT."""
    parts = _counted(value, many)
    return VALUE if parts is None else parts[0][max(0, len(parts[0]) - parts[1]) :]


def mid(value: Scalar, first: Scalar, many: Scalar) -> Scalar:
    """MID: from the `first`-th character (counted from 1)."""
    parts, start = _counted(value, many), _number(first)
    if parts is None or start is None or start < 1:
        return VALUE
    return parts[0][int(start) - 1 : int(start) - 1 + parts[1]]


def rept(value: Scalar, many: Scalar) -> Scalar:
    """REPT: #VALUE! beyond what a cell can hold (32,767 characters)."""
    parts = _counted(value, many)
    return VALUE if parts is None or len(parts[0]) * parts[1] > 32767 else parts[0] * parts[1]


def value_(shown: Scalar) -> Scalar:
    """VALUE: the number that a text shows."""
    number = None if isinstance(shown, bool) else _number(shown)
    return VALUE if number is None else number


def _each(function: Callable[..., Scalar]) -> Any:
    def kernel(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
        cells = tuple(
            Cells(np.float64(0)) if isinstance(arg, Missing) else ev.value(arg, frame, spread) for arg in args
        )
        return each(function, cells, ev.texts)

    return kernel


def concat(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """CONCAT: like CONCATENATE, but takes ranges too, row by row."""
    del spread
    parts: list[Cells] = []
    for arg in args:
        cells = ev.value(arg, frame, spread=True)
        if len(cells.shape) <= 2:
            parts.append(cells)
            continue
        shape = cells.shape
        numbers, codes = np.broadcast_to(cells.numbers, shape), np.broadcast_to(codes_of(cells), shape)
        for i in range(shape[0]):
            for j in range(shape[1]):
                tail = tuple(n for n in shape[2:] if n > 1) or ()
                parts.append(Cells(numbers[i, j].reshape(tail), codes[i, j].reshape(tail)))
    return each(lambda *values: "".join(map(to_text, values)), tuple(parts), ev.texts)


KERNELS: dict[str, Any] = {
    "TEXT": _each(text), "FIXED": _each(fixed), "VALUE": _each(value_), "CONCAT": concat,
    "CONCATENATE": _each(lambda *values: "".join(map(to_text, values))),
    "LEN": _each(lambda value: float(len(to_text(value)))), "LEFT": _each(left), "RIGHT": _each(right),
    "MID": _each(mid), "REPT": _each(rept), "UPPER": _each(lambda value: to_text(value).upper()),
    "LOWER": _each(lambda value: to_text(value).lower()),
    "TRIM": _each(lambda value: re.sub(" +", " ", to_text(value)).strip(" ")),
    "EXACT": _each(lambda a, b: to_text(a) == to_text(b)),
}  # fmt: skip
