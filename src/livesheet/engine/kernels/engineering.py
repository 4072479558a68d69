"""Engineering: units, numbers in other bases, bits, steps."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

from ...formula.nodes import Scalar
from ..values.calling import Problem, to_strict_number
from ..values.coerce import to_text
from .units import PREFIXES, TEMPERATURES, power_of_ten, unit

_MOST_BITS = 2**48


def convert(number: float, source: str, target: str) -> float:
    """CONVERT: #N/A for units that are not known or measure different things."""
    old, new = _temperature(source), _temperature(target)
    if old is not None and new is not None:
        if old == new:
            return number
        return (number - old[1]) * old[0] / new[0] + new[1]
    first, second = unit(source), unit(target)
    if first is None or second is None or first.kind != second.kind:
        raise Problem("#N/A")
    return number if first.size == second.size else number * first.size / second.size


def _temperature(name: str) -> tuple[float, float] | None:
    if name in TEMPERATURES:
        return TEMPERATURES[name]
    for kelvin in ("kel", "K"):
        exponent = PREFIXES.get(name.removesuffix(kelvin)) if name.endswith(kelvin) else None
        if exponent is not None:
            return power_of_ten(1.0, exponent), power_of_ten(273.15, -exponent)
    return None


# --- other bases: ten digits, negative numbers as the complement ------------------------------------------------------

_BASES = {"BIN": 2, "OCT": 8, "HEX": 16}
_DIGITS = 10
_NO_PLACES = math.inf
"""Stands for an argument left out."""


def read_base(value: Scalar, base: int) -> int:
    """The number that up to ten digits write in a base; the tenth carries the sign."""
    if isinstance(value, bool):
        raise Problem("#VALUE!")
    text = to_text(value)
    if not text:
        return 0
    if len(text) > _DIGITS or not re.fullmatch("[0-9A-Fa-f]+", text) or any(int(d, 16) >= base for d in text):
        raise Problem("#NUM!")
    number = int(text, base)
    whole = base**_DIGITS
    return number - whole if number >= whole // 2 else number


def write_base(number: int, base: int, places: Scalar) -> str:
    """A number in a base, at least so many digits long; negative ones always with ten."""
    whole = base**_DIGITS
    if not -whole // 2 <= number < whole // 2:
        raise Problem("#NUM!")
    rest, text = number % whole, ""
    while rest:
        rest, digit = divmod(rest, base)
        text = "0123456789ABCDEF"[digit] + text
    text = text or "0"
    if places == _NO_PLACES:
        return text
    least = math.trunc(to_strict_number(places))
    if not 0 < least <= _DIGITS or (number >= 0 and len(text) > least):
        raise Problem("#NUM!")
    return text.rjust(least, "0")


def _to_decimal(base: int) -> Callable[[Scalar], float]:
    return lambda value: float(read_base(value, base))


def _from_decimal(base: int) -> Callable[..., str]:
    return lambda value, places=_NO_PLACES: write_base(math.trunc(to_strict_number(value)), base, places)


def _between(source: int, target: int) -> Callable[..., str]:
    return lambda value, places=_NO_PLACES: write_base(read_base(value, source), target, places)


# --- bits ------------------------------------------------------------------------------------------------------------


def _bits(number: float) -> int:
    if number != math.trunc(number) or not 0 <= number < _MOST_BITS:
        raise Problem("#NUM!")
    return int(number)


def shifted(number: float, by: float) -> float:
    """BITLSHIFT: to the left, or to the right for a negative number of bits."""
    bits, places = _bits(number), math.trunc(by)
    if abs(places) > 53:
        raise Problem("#NUM!")
    found = bits << places if places >= 0 else bits >> -places
    if found >= _MOST_BITS:
        raise Problem("#NUM!")
    return float(found)


def delta(first: Scalar, second: Scalar = 0.0) -> float:
    """DELTA: 1 when two numbers are equal."""
    return float(to_strict_number(first) == to_strict_number(second))


def step(number: Scalar, bound: Scalar = 0.0) -> float:
    """GESTEP: 1 from a bound on."""
    return float(to_strict_number(number) >= to_strict_number(bound))


def erf(low: float, high: float | None = None) -> float:
    """ERF: from 0 to `low`, or from `low` to `high`."""
    if high is None:
        return math.erf(low)
    if low > 0 and high > 0:
        return math.erfc(low) - math.erfc(high)
    return math.erf(high) - math.erf(low)


PLAIN: dict[str, Callable[..., Any]] = {
    "CONVERT": convert,
    "ERF": erf,
    "ERF.PRECISE": erf,
    "ERFC": math.erfc,
    "ERFC.PRECISE": math.erfc,
    **{f"{name}2DEC": _to_decimal(base) for name, base in _BASES.items()},
    **{f"DEC2{name}": _from_decimal(base) for name, base in _BASES.items()},
    **{
        f"{source}2{target}": _between(_BASES[source], _BASES[target])
        for source in _BASES
        for target in _BASES
        if source != target
    },
    "BITAND": lambda a, b: float(_bits(a) & _bits(b)),
    "BITOR": lambda a, b: float(_bits(a) | _bits(b)),
    "BITXOR": lambda a, b: float(_bits(a) ^ _bits(b)),
    "BITLSHIFT": shifted,
    "BITRSHIFT": lambda number, by: shifted(number, -by),
    "DELTA": delta,
    "GESTEP": step,
}
