"""Numbers and dates as files of both formats spell them. Dates are numbers in formulas."""

from __future__ import annotations

import math
import re
from datetime import date

NULL_DATE = date(1899, 12, 30)
"""Day 0 where a document does not say otherwise (OpenDocument 1.3 part 3, 19.614)."""
NULL_DATE_1904 = date(1904, 1, 1)

_DATE = re.compile(r"([0-9]{4})-([0-9]{2})-([0-9]{2})(?:T([0-9]{2}):([0-9]{2}):([0-9]{2}(?:\.[0-9]+)?))?Z?")


def finite(text: str) -> float | None:
    """A number, None when `text` is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) and "_" not in text else None


def day_number(text: str, null_date: date) -> float | None:
    """`2024-02-29T12:00:00` as days since `null_date`, None when it is no date."""
    match = _DATE.fullmatch(text)
    if match is None:
        return None
    year, month, day, hours, minutes, seconds = match.groups()
    if (year, month, day) == ("1900", "02", "29"):  # a day of Excel's calendar only
        month, day = "02", "28"
    try:
        days = (date(int(year), int(month), int(day)) - null_date).days
    except ValueError:
        return None
    return days + (3600 * int(hours or 0) + 60 * int(minutes or 0) + float(seconds or 0)) / 86400
