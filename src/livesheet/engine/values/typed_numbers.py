"""Dates, times and amounts as people type them in English: from a text to the number that Excel takes it for."""

from __future__ import annotations

import re
from datetime import date
from functools import lru_cache

_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_FULL = (
    *("january", "february", "march", "april", "may", "june", "july"),
    *("august", "september", "october", "november", "december"),
)
_MONTH = rf"(?P<name>{'|'.join(_FULL)}|{'|'.join(_MONTHS)})\.?"
# patterns as texts, which `re` compiles when they are first used: few workbooks hold such texts
_DATES = (
    r"(?P<year>\d{4})(?P<s>[-/])(?P<month>\d{1,2})(?P=s)(?P<day>\d{1,2})",
    r"(?P<month>\d{1,2})(?P<s>[-/])(?P<day>\d{1,2})(?P=s)(?P<year>\d{4}|\d{1,2})",
    r"(?P<month>\d{1,2})[-/](?P<day>\d{1,2})",
    r"(?P<month>\d{1,2})[-/](?P<year>\d{4})",
    rf"(?P<day>\d{{1,2}})[-/ ]{_MONTH}(?:[-/ ,]\s*(?P<year>\d{{4}}|\d{{2}}))?",
    rf"{_MONTH}[-/ ](?P<day>\d{{1,2}}),?\s+(?P<year>\d{{4}})",
    rf"{_MONTH}[-/ ](?P<year>\d{{4}})",
    rf"{_MONTH}[-/ ](?P<day>\d{{1,2}})",
)
_TIME = (
    r"(?P<hour>\d{1,4}):(?P<minute>\d{1,2})(?::(?P<second>\d{1,2}(?:\.\d*)?))?(?:\s*(?P<half>[ap]m?))?"
    r"|(?P<hour12>\d{1,2})\s+(?P<half12>[ap]m?)"
)
_MONEY = "$€£¥"
_AMOUNT = rf"(?P<open>\()?(?P<sign>[-+])?\s*[{_MONEY}]?\s*(?P<inner>[-+])?(?P<number>[\d.,]+)\s*€?\s*(?P<close>\))?"
_FRACTION = r"(?P<sign>[-+])?(?P<whole>\d+) (?P<above>\d{1,5})/(?P<below>\d{1,5})"
_GROUPED = r"(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d*)?|\.\d+"
_ZERO = date(1899, 12, 30).toordinal()


class Serial(float):
    """A day as a number, counted from 1900: workbooks that count from 1904 show it smaller."""


@lru_cache(maxsize=4096)
def shown_number(text: str) -> float | None:
    """The number of a text that shows a date, a time, both, an amount of money or a mixed fraction; else None."""
    body = text.strip()
    if (
        not body
        or not (body[0] in f"(+-.{_MONEY}" or body[0].isalnum())
        or not any(c.isdigit() for c in body)
        or len(body) > 64
    ):
        return None
    for kind in (amount, fraction, date_and_time):
        if kind is date_and_time and body != text:
            return None  # Excel takes no date with spaces around it
        found = kind(body)
        if found is not None:
            return found
    return None


def amount(body: str) -> float | None:
    """`$1,234.50`, `-$5`, `(5)`."""
    match = re.fullmatch(_AMOUNT, body)
    if match is None or not re.fullmatch(_GROUPED, match["number"]) or bool(match["open"]) != bool(match["close"]):
        return None
    signs = [sign for sign in (match["sign"], match["inner"]) if sign]
    if len(signs) > 1 or (signs and match["open"]):
        return None
    value = float(match["number"].replace(",", ""))
    return -value if match["open"] or "-" in signs else value


def fraction(body: str) -> float | None:
    """`2 1/2`."""
    match = re.fullmatch(_FRACTION, body)
    if match is None or int(match["below"]) == 0:
        return None
    value = int(match["whole"]) + int(match["above"]) / int(match["below"])
    return -value if match["sign"] == "-" else value


def date_and_time(body: str) -> float | None:
    """A date, a time, or a date and a time, as one number: a Serial where there is a date."""
    parts = day_and_time(body)
    if parts is None:
        return None
    return Serial(parts[0] + parts[1]) if parts[0] else parts[1]


def day_and_time(body: str) -> tuple[float, float] | None:
    """(day number, part of a day) of a date, a time, or a date and a time with a space (or a T) between them."""
    for day, time in ((body, ""), ("", body), *_splits(body)):
        days = _day_number(day) if day else 0.0
        hours = time_part(time) if time else 0.0
        if days is not None and hours is not None:
            return days, hours
    return None


def _splits(body: str) -> list[tuple[str, str]]:
    return [(body[: m.start()].rstrip(" ,"), body[m.end() :].strip()) for m in re.finditer(r"\s+|(?<=\d)T(?=\d)", body)]


def time_part(body: str) -> float | None:
    """A time as a part of a day, without whole days; hours beyond 24 count on."""
    match = re.fullmatch(_TIME, body, re.IGNORECASE)
    if match is None:
        return None
    hour = int(match["hour"] or match["hour12"])
    half = (match["half"] or match["half12"] or "")[:1].lower()
    minute, second = int(match["minute"] or 0), float(match["second"] or 0)
    if minute > 59 or second >= 60 or (half and not 0 <= hour <= 12):
        return None
    if half:
        hour = hour % 12 + (12 if half == "p" else 0)
    return (hour * 3600 + minute * 60 + second) / 86400


def _day_number(body: str) -> float | None:
    for pattern in _DATES:
        match = re.fullmatch(pattern, body, re.IGNORECASE)
        if match is None:
            continue
        parts = match.groupdict()
        month = _MONTHS.index(parts["name"][:3].lower()) + 1 if parts.get("name") else int(parts["month"])
        found = _serial(_year(parts.get("year")), month, int(parts.get("day") or 1))
        if found is not None:
            return found
    return None


def _year(shown: str | None) -> int:
    if shown is None:
        return date.today().year
    year = int(shown)
    return year if len(shown) == 4 else year + (2000 if year < 30 else 1900)


def _serial(year: int, month: int, day: int) -> float | None:
    if (year, month, day) == (1900, 2, 29):
        return 60.0
    try:
        serial = date(year, month, day).toordinal() - _ZERO
    except ValueError:
        return None
    serial -= serial < 61
    return float(serial) if serial > 0 else None
