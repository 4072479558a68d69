"""Complex numbers, written as texts such as "3+4i"."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from ...formula.nodes import ErrorValue, Scalar
from ..values.coerce import Problem, number_to_text, text_to_number

_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_COMPLEX = re.compile(rf"(?P<real>[-+]?{_NUMBER})?(?:(?P<imaginary>[-+]?(?:{_NUMBER})?)(?P<unit>[ij]))?")


class Complex(NamedTuple):
    """A complex number and its unit, i or j ("" for a real one)."""

    value: complex
    unit: str = ""


def parsed(value: Scalar) -> Complex:
    """The complex number that a value shows: #NUM! for other texts, #VALUE! for truth values."""
    if isinstance(value, ErrorValue):
        raise Problem(value.code)
    if isinstance(value, bool):
        raise Problem("#VALUE!")
    if value is None or isinstance(value, float | int):
        return Complex(complex(float(value or 0), 0.0))
    match = _COMPLEX.fullmatch(value)
    if match is None or not value:
        raise Problem("#NUM!")
    real, imaginary, unit = match["real"], match["imaginary"], match["unit"]
    if unit is None:
        return Complex(complex(float(real), 0.0))
    if real is not None and imaginary == "":  # "5i": the pattern took the number for the real part
        real, imaginary = None, real
    if real is not None and imaginary[:1] not in ("+", "-"):
        raise Problem("#NUM!")
    part = float(f"{imaginary}1") if imaginary in ("", "+", "-") else float(imaginary)
    return Complex(complex(float(real or 0), part), unit)


def written(value: complex, unit: str) -> str:
    """A complex number as a text: 15 digits, parts that are 0 left out."""
    if not (math.isfinite(value.real) and math.isfinite(value.imag)):
        raise Problem("#NUM!")
    sign = unit or "i"
    if value.imag == 0:
        return number_to_text(value.real)
    imaginary = {1.0: "", -1.0: "-"}.get(value.imag, number_to_text(value.imag))
    if value.real == 0:
        return f"{imaginary}{sign}"
    return f"{number_to_text(value.real)}{'' if imaginary.startswith('-') else '+'}{imaginary}{sign}"


def _common_unit(parts: Iterable[Complex]) -> str:
    units = {part.unit for part in parts} - {""}
    if len(units) > 1:
        raise Problem("#VALUE!")
    return units.pop() if units else ""


def _of(function: Callable[..., complex]) -> Callable[..., str]:
    """A function of complex numbers that gives one."""

    def of(*values: Scalar) -> str:
        parts = [parsed(value) for value in values]
        unit = _common_unit(parts)
        return written(function(*(part.value for part in parts)), unit)

    return of


def _reciprocal(function: Callable[[complex], complex]) -> Callable[..., str]:
    return _of(lambda z: 1 / function(z))


def complex_text(real: Scalar, imaginary: Scalar, unit: Scalar = "i") -> str:
    """COMPLEX: #VALUE! for other units than i and j."""
    sign = "i" if unit in (None, "") else unit
    if sign not in ("i", "j"):
        raise Problem("#VALUE!")
    parts = []
    for part in (real, imaginary):
        if isinstance(part, bool):
            raise Problem("#VALUE!")
        number = text_to_number(part) if isinstance(part, str) else float(part or 0)  # type: ignore[arg-type]
        if number is None:
            raise Problem("#VALUE!")
        parts.append(number)
    return written(complex(*parts), str(sign))


def argument(value: Scalar) -> float:
    """IMARGUMENT: #DIV/0! of 0."""
    z = parsed(value).value
    if z == 0:
        raise Problem("#DIV/0!")
    return cmath.phase(z)


def power(value: Scalar, exponent: float) -> str:
    """IMPOWER, through polar coordinates."""
    z, unit = parsed(value)
    if z == 0:
        if exponent <= 0:
            raise Problem("#NUM!")
        return written(0j, unit)
    return written(cmath.rect(abs(z) ** exponent, cmath.phase(z) * exponent), unit)


def root(value: Scalar) -> str:
    """IMSQRT."""
    z, unit = parsed(value)
    return written(cmath.rect(math.sqrt(abs(z)), cmath.phase(z) / 2), unit)


def _many(function: Callable[[list[complex]], complex]) -> Callable[..., str]:
    def of(*lists: list[Scalar]) -> str:
        parts = [parsed(value) for values in lists for value in values if value is not None]
        unit = _common_unit(parts)
        return written(function([part.value for part in parts]), unit)

    return of


def _product(values: list[complex]) -> complex:
    found = 1 + 0j
    for value in values:
        found *= value
    return found


PLAIN: dict[str, Callable[..., Any]] = {
    "COMPLEX": complex_text,
    "IMREAL": lambda value: parsed(value).value.real,
    "IMAGINARY": lambda value: parsed(value).value.imag,
    "IMABS": lambda value: abs(parsed(value).value),
    "IMARGUMENT": argument,
    "IMCONJUGATE": _of(lambda z: z.conjugate()),
    "IMSUM": _many(lambda values: sum(values, 0j)),
    "IMPRODUCT": _many(_product),
    "IMSUB": _of(lambda a, b: a - b),
    "IMDIV": _of(lambda a, b: a / b),
    "IMPOWER": power,
    "IMSQRT": root,
    "IMEXP": _of(cmath.exp),
    "IMLN": _of(cmath.log),
    "IMLOG10": _of(lambda z: cmath.log(z) / math.log(10)),
    "IMLOG2": _of(lambda z: cmath.log(z) / math.log(2)),
    "IMSIN": _of(cmath.sin),
    "IMCOS": _of(cmath.cos),
    "IMTAN": _of(cmath.tan),
    "IMSINH": _of(cmath.sinh),
    "IMCOSH": _of(cmath.cosh),
    "IMSEC": _reciprocal(cmath.cos),
    "IMCSC": _reciprocal(cmath.sin),
    "IMCOT": _reciprocal(cmath.tan),
    "IMSECH": _reciprocal(cmath.cosh),
    "IMCSCH": _reciprocal(cmath.sinh),
}
