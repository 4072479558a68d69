"""Engineering: units, numbers in other bases, bits, steps."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any, NamedTuple

from ...formula.nodes import Scalar
from ..values.coerce import Problem, to_strict_number, to_text

_FOOT, _INCH, _YARD, _MILE, _SEA_MILE = 0.3048, 0.0254, 0.9144, 1609.344, 1852.0
_LIGHT_YEAR, _POINT = 9460730472580800.0, 0.0254 / 72
_GALLON = 231 * _INCH**3 * 1000
_UK_GALLON = 4.54609
_HORSEPOWER = 745.69987158227022


class Unit(NamedTuple):
    """What it measures, how many base units it is, and the power in which its prefixes count (0: it takes none)."""

    kind: str
    size: float
    prefixed: int = 0


_TABLE: dict[str, list[tuple[str, float, int]]] = {
    "mass": [
        ("g", 1.0, 1), ("sg", 14593.902937206364829, 0), ("lbm", 453.59237, 0), ("u", 1.66053100460465e-24, 1),
        ("ozm", 28.349523125, 0), ("grain", 0.06479891, 0), ("cwt shweight", 45359.237, 0),
        ("uk_cwt lcwt hweight", 50802.34544, 0), ("stone", 6350.29318, 0), ("ton", 907184.74, 0),
        ("uk_ton LTON brton", 1016046.9088, 0),
    ],
    "length": [
        ("m", 1.0, 1), ("mi", _MILE, 0), ("Nmi", _SEA_MILE, 0), ("in", _INCH, 0), ("ft", _FOOT, 0), ("yd", _YARD, 0),
        ("ang", 1e-10, 1), ("ell", 1.143, 0), ("ly", _LIGHT_YEAR, 1), ("parsec pc", 3.08567758128155e16, 1),
        ("Picapt Pica", _POINT, 0), ("pica", _INCH / 6, 0), ("survey_mi", 6336000 / 3937, 0),
    ],
    "time": [("yr", 31557600.0, 0), ("day d", 86400.0, 0), ("hr", 3600.0, 0), ("mn min", 60.0, 0), ("sec s", 1.0, 1)],
    "pressure": [
        ("Pa p", 1.0, 1), ("atm at", 101325.0, 1), ("mmHg", 133.322, 1), ("psi", 6894.757293168361, 0),
        ("Torr", 101325 / 760, 0),
    ],
    "force": [("N", 1.0, 1), ("dyn dy", 1e-5, 1), ("lbf", 4.4482216152605, 0), ("pond", 0.00980665, 1)],
    "energy": [
        ("J", 1.0, 1), ("e", 1e-7, 1), ("c", 4.184, 1), ("cal", 4.1868, 1), ("eV ev", 1.602176487e-19, 1),
        ("HPh hh", _HORSEPOWER * 3600, 0), ("Wh wh", 3600.0, 1), ("flb", 1.3558179483314004, 0),
        ("BTU btu", 1055.05585262, 0),
    ],
    "power": [("HP h", _HORSEPOWER, 0), ("W w", 1.0, 1), ("PS", 735.49875, 0)],
    "magnetic flux density": [("T", 1.0, 1), ("ga", 1e-4, 1)],
    "volume": [
        ("tsp", _GALLON / 768, 0), ("tspm", 0.005, 0), ("tbs", _GALLON / 256, 0), ("oz", _GALLON / 128, 0),
        ("cup", _GALLON / 16, 0), ("pt us_pt", _GALLON / 8, 0), ("uk_pt", _UK_GALLON / 8, 1), ("qt", _GALLON / 4, 0),
        ("uk_qt", _UK_GALLON / 4, 0), ("gal", _GALLON, 0), ("uk_gal", _UK_GALLON, 0), ("l L lt", 1.0, 1),
        ("ang3 ang^3", 1e-27, 3), ("barrel", 42 * _GALLON, 0), ("bushel", 35.23907016688, 0),
        ("ft3 ft^3", _FOOT**3 * 1000, 0), ("in3 in^3", _INCH**3 * 1000, 0), ("ly3 ly^3", _LIGHT_YEAR**3 * 1000, 0),
        ("m3 m^3", 1000.0, 3), ("mi3 mi^3", _MILE**3 * 1000, 0), ("yd3 yd^3", _YARD**3 * 1000, 0),
        ("Nmi3 Nmi^3", _SEA_MILE**3 * 1000, 0), ("Picapt3 Picapt^3 Pica3 Pica^3", _POINT**3 * 1000, 0),
        ("GRT regton", 100 * _FOOT**3 * 1000, 0), ("MTON", 40 * _FOOT**3 * 1000, 0),
    ],
    "area": [
        ("uk_acre", 4046.8564224, 0), ("us_acre", 4840 * (3600 / 3937) ** 2, 0), ("ang2 ang^2", 1e-20, 2), ("ar", 100.0, 1),
        ("ft2 ft^2", _FOOT**2, 0), ("ha", 10000.0, 0), ("in2 in^2", _INCH**2, 0), ("ly2 ly^2", _LIGHT_YEAR**2, 0),
        ("m2 m^2", 1.0, 2), ("Morgen", 2500.0, 0), ("mi2 mi^2", _MILE**2, 0), ("Nmi2 Nmi^2", _SEA_MILE**2, 0),
        ("Picapt2 Picapt^2 Pica2 Pica^2", _POINT**2, 0), ("yd2 yd^2", _YARD**2, 0),
    ],
    "information": [("bit", 1.0, 1), ("byte", 8.0, 1)],
    "speed": [
        ("admkn", 0.514773333333333, 0), ("kn", 1852 / 3600, 0), ("m/h m/hr", 1 / 3600, 1), ("m/s m/sec", 1.0, 1),
        ("mph", 0.44704, 1),
    ],
}  # fmt: skip

UNITS = {
    name: Unit(kind, size, prefixed)
    for kind, rows in _TABLE.items()
    for names, size, prefixed in rows
    for name in names.split()
}
"""The units of CONVERT, as Microsoft's documentation lists them: each in the base unit of its kind. Case counts.

Sources: International Yard and Pound agreement, SI brochure; where Excel's own constants are older, Excel's (u, eV).
"""

PREFIXES = {
    "Y": 24, "Z": 21, "E": 18, "P": 15, "T": 12, "G": 9, "M": 6, "k": 3, "h": 2, "da": 1, "e": 1,
    "d": -1, "c": -2, "m": -3, "u": -6, "n": -9, "p": -12, "f": -15, "a": -18, "z": -21, "y": -24,
}  # fmt: skip
"""Prefix -> its power of ten."""

BINARY_PREFIXES = {"ki": 2.0**10, "Mi": 2.0**20, "Gi": 2.0**30, "Ti": 2.0**40, "Pi": 2.0**50, "Ei": 2.0**60} | {
    "Zi": 2.0**70,
    "Yi": 2.0**80,
}

TEMPERATURES: dict[str, tuple[float, float]] = {
    "C": (1.0, 0.0), "cel": (1.0, 0.0), "F": (5 / 9, 32.0), "fah": (5 / 9, 32.0), "K": (1.0, 273.15),
    "kel": (1.0, 273.15), "Rank": (5 / 9, 491.67), "Reau": (1.25, 0.0),
}  # fmt: skip
"""Scale -> (degrees Celsius of one degree, what it shows at 0 degrees Celsius)."""


def power_of_ten(size: float, exponent: int) -> float:
    """size x 10^exponent, rounded once."""
    return size * 10.0**exponent if exponent >= 0 else size / 10.0**-exponent


def unit(name: str) -> Unit | None:
    """The unit of a name, perhaps with a prefix; None where there is none."""
    found = UNITS.get(name)
    if found is not None:
        return found
    for prefix, exponent in PREFIXES.items():
        base = UNITS.get(name.removeprefix(prefix)) if name.startswith(prefix) else None
        if base is not None and base.prefixed:
            return Unit(base.kind, power_of_ten(base.size, exponent * base.prefixed))
    for prefix, factor in BINARY_PREFIXES.items():
        base = UNITS.get(name.removeprefix(prefix)) if name.startswith(prefix) else None
        if base is not None and base.kind == "information":
            return Unit(base.kind, base.size * factor)
    return None


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
