"""Texts that show numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal
from typing import Any

from ..texts.number_formats import WIDE, formatted
from ..values.calling import Problem, to_number


def number_value(text: str, decimal: str = ".", group: str = ",") -> float:
    """NUMBERVALUE: with the signs for decimals and groups given."""
    if not decimal or not group:
        raise Problem("#VALUE!")
    point, comma = decimal[0], group[0]
    body = re.sub(r"\s", "", text)
    percents = len(body) - len(body.rstrip("%"))
    body = body.rstrip("%")
    whole, sign, rest = body.partition(point)
    if point in rest or comma in rest:
        raise Problem("#VALUE!")
    plain = whole.replace(comma, "") + ("." + rest if sign else "")
    if not plain:
        return 0.0
    return to_number(plain) / 100.0**percents


def dollar(number: float, decimals: float = 2.0) -> str:
    """DOLLAR."""
    places = math.trunc(decimals)
    if places > 127:
        raise Problem("#VALUE!")
    if places < 0:
        scale = Decimal(10) ** -places
        number = float((Decimal(f"{number:.15g}") / scale).quantize(Decimal(1), ROUND_HALF_UP, WIDE) * scale)
    body = "$#,##0" + ("." + "0" * places if places > 0 else "")
    return formatted(number, f"{body};({body})") or ""


PLAIN: dict[str, Callable[..., Any]] = {"NUMBERVALUE": number_value, "DOLLAR": dollar}
