"""Values of cells as OpenDocument spells them: numbers, dates, times, errors. Dates are numbers in formulas."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import date, timedelta

from mechsheet.formula.nodes import ErrorValue

NULL_DATE = date(1899, 12, 30)
"""Day 0 where a document does not say otherwise (OpenDocument 1.3 part 3, 19.614)."""
NULL_DATE_1904 = date(1904, 1, 1)

_DATE = re.compile(r"([0-9]{4})-([0-9]{2})-([0-9]{2})(?:T([0-9]{2}):([0-9]{2}):([0-9]{2}(?:\.[0-9]+)?))?Z?")
_DURATION = re.compile(r"(-?)P(?:([0-9]+)D)?(?:T(?:([0-9]+)H)?(?:([0-9]+)M)?(?:([0-9]+(?:[.,][0-9]+)?)S)?)?")
_LIBREOFFICE = re.compile(r"Err:[0-9]{3}")
_LOCAL: Mapping[str, str] = {
    local: error
    for error, names in {
        "#NULL!": "#NUL! #¡NULO! #NULLO! #NULO! #BOŞ! #LEEG!",
        "#DIV/0!": "#¡DIV/0! #SAYI/0! #DEEL/0!",
        "#REF!": "#BEZUG! #¡REF! #RIF! #BAŞV! #VERW!",
        "#NAME?": "#NOM? #¿NOMBRE? #NOME? #AD? #NAAM?",
        "#NUM!": "#ZAHL! #NOMBRE! #¡NUM! #NÚM! #SAYI! #GETAL!",
        "#N/A": "#NV #N/D #YOK #N/B",
    }.items()
    for local in names.split()
}
"""Excel's errors in German, French, Spanish, Italian, Portuguese, Turkish and Dutch, but for those of #VALUE!."""
_FOREIGN = re.compile(r"#[^\W\d_]+[!?]|#[A-Z]{2,}")
_CODES: Mapping[str, str] = {"Err:503": "#NUM!", "Err:521": "#NULL!", "Err:524": "#REF!", "Err:525": "#NAME?"}
"""LibreOffice's numbers of errors that have a code of their own; all others are #VALUE!, as its own .xlsx export has it."""
_ERRORS = frozenset(("#NULL!", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#N/A"))


def error_of(text: str) -> ErrorValue | None:
    """The error that a cell shows as `text`, None when it shows none."""
    if text in _ERRORS:
        return ErrorValue(text)
    return ErrorValue(_CODES.get(text, "#VALUE!")) if _LIBREOFFICE.fullmatch(text) else None


def error_shown(text: str) -> ErrorValue | None:
    """The error that a cell with the number 0 shows, which is how Excel writes errors, in its user's language."""
    error = error_of(text)
    if error is None and (text in _LOCAL or _FOREIGN.fullmatch(text)):
        error = ErrorValue(_LOCAL.get(text, "#VALUE!"))
    return error


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


def time_number(text: str) -> float | None:
    """The duration `PT12H30M00S` as a part of a day, None when it is none."""
    match = _DURATION.fullmatch(text)
    if match is None or len(text) > 40:
        return None
    sign, days, hours, minutes, seconds = match.groups()
    total = 3600 * int(hours or 0) + 60 * int(minutes or 0) + float((seconds or "0").replace(",", "."))
    return (-1 if sign else 1) * (int(days or 0) + total / 86400)


def date_text(number: float, null_date: date) -> str | None:
    """Days since `null_date` as a date, with the time of day where there is one; None beyond the years 1 to 9999."""
    days, milliseconds = divmod(round(number * 86_400_000), 86_400_000)
    try:
        day = null_date + timedelta(days)
    except OverflowError:
        return None
    if not milliseconds:
        return day.isoformat()
    hours, rest = divmod(milliseconds, 3_600_000)
    minutes, rest = divmod(rest, 60_000)
    return f"{day.isoformat()}T{hours:02}:{minutes:02}:{_seconds(rest)}"


def time_text(number: float) -> str:
    """A part of a day as a duration."""
    hours, rest = divmod(round(abs(number) * 86_400_000), 3_600_000)
    minutes, rest = divmod(rest, 60_000)
    return f"{'-' if number < 0 else ''}PT{hours:02}H{minutes:02}M{_seconds(rest)}S"


def _seconds(milliseconds: int) -> str:
    return f"{milliseconds // 1000:02}" + (f".{milliseconds % 1000:03}" if milliseconds % 1000 else "")
