"""Dates and times as formats show them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .calendar import LAST_DAY, Day, day_of, weekday

DATE_TOKEN = r"AM/PM|A/P|y+|m+|d+|h+|s+(?:\.0+)?|e+"
"""A regular expression for the tokens of dates."""

MONTHS = (
    *("January", "February", "March", "April", "May", "June", "July"),
    *("August", "September", "October", "November", "December"),
)
WEEKDAYS = ("Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday")

Tokens = Sequence[tuple[str, str]]


def moment(tokens: Tokens, value: float) -> str | None:
    """A day and time by the tokens of a format; None where there is none (negative, or after the year 9999)."""
    decimals = max((len(text.partition(".")[2]) for kind, text in tokens if kind == "date"), default=0)
    if not 0 <= value < LAST_DAY + 1:
        return None
    ticks = math.floor(value * 86400 * 10**decimals + 0.5)
    seconds, part = divmod(ticks, 10**decimals)
    days, second = divmod(seconds, 86400)
    if days > LAST_DAY:
        return None
    marked = any(kind == "date" and text.upper() in ("AM/PM", "A/P") for kind, text in tokens)
    day = day_of(days)
    out = ""
    for place, (kind, text) in enumerate(tokens):
        if kind == "elapsed":
            out += str(seconds // {"h": 3600, "m": 60, "s": 1}[text[0]]).rjust(len(text), "0")
        elif kind == "date":
            out += _piece(tokens, place, day, days, second, part, decimals, marked)
        else:
            out += text
    return out


def _piece(tokens: Tokens, place: int, day: Day, days: int, second: int, part: int, decimals: int, marked: bool) -> str:
    text = tokens[place][1]
    letter, length = text[0].lower(), len(text)
    if letter == "y" or letter == "e":
        return f"{day.year % 100:02d}" if letter == "y" and length <= 2 else f"{day.year:04d}"
    if letter == "m" and not _is_minute(tokens, place):
        return _month(day.month, length)
    if letter == "d":
        return _day(day.day, days, length)
    if letter == "a":
        half = "AM" if second < 43200 else "PM"
        return half if "/P" in text.upper() and length > 3 else half[0] if text[0].isupper() else half[0].lower()
    if letter == "h":
        hour = second // 3600
        return str((hour - 1) % 12 + 1 if marked else hour).rjust(min(length, 2), "0")
    if letter == "m":
        return str(second // 60 % 60).rjust(min(length, 2), "0")
    whole, _, fraction = text.partition(".")
    shown = str(second % 60).rjust(min(len(whole), 2), "0")
    return f"{shown}.{str(part).rjust(decimals, '0')[: len(fraction)]}" if fraction else shown


def _month(month: int, length: int) -> str:
    name = MONTHS[month - 1]
    return {1: str(month), 2: f"{month:02d}", 3: name[:3], 5: name[0]}.get(length, name)


def _day(day: int, days: int, length: int) -> str:
    name = WEEKDAYS[weekday(days)]
    return {1: str(day), 2: f"{day:02d}", 3: name[:3]}.get(length, name)


def _is_minute(tokens: Tokens, place: int) -> bool:
    """Whether an m means minutes: after hours, or before seconds."""
    if len(tokens[place][1]) > 2:
        return False
    before = [
        text[0].lower() for kind, text in tokens[:place] if kind in ("date", "elapsed") and text[0].lower() != "a"
    ]
    after = [text[0].lower() for kind, text in tokens[place + 1 :] if kind in ("date", "elapsed")]
    return before[-1:] == ["h"] or after[:1] == ["s"]
