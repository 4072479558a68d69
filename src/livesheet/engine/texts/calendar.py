"""Days as Excel counts them from 1900: day 1 is 1 January 1900, day 60 is a 29 February that never was."""

from __future__ import annotations

import math
from datetime import date, timedelta
from typing import NamedTuple

from ..values.coerce import Problem, Serial

LAST_DAY = 2958465
"""31 December 9999."""

_ZERO = date(1899, 12, 30).toordinal()


class Day(NamedTuple):
    """A day of the calendar; day 0 of January 1900 and 29 February 1900 are among them."""

    year: int
    month: int
    day: int


def whole_day(number: float) -> int:
    """The day that a date and time belong to; #NUM! outside 0 to the last day."""
    found = math.floor(number)
    if not 0 <= found <= LAST_DAY:
        raise Problem("#NUM!")
    return found


def day_of(number: float) -> Day:
    """The calendar's day of a day number."""
    serial = whole_day(number)
    if serial == 60:
        return Day(1900, 2, 29)
    if serial == 0:
        return Day(1900, 1, 0)
    found = date.fromordinal(_ZERO + serial + (serial < 60))
    return Day(found.year, found.month, found.day)


def number_of(year: int, month: int, day: int) -> Serial:
    """The day number of a day; months and days beyond the year and the month count on."""
    year, month = year + (month - 1) // 12, (month - 1) % 12 + 1
    if not 1900 <= year <= 9999:
        raise Problem("#NUM!")
    first = date(year, month, 1).toordinal() - _ZERO
    serial = first - (first < 61) + day - 1
    if not 0 <= serial <= LAST_DAY:
        raise Problem("#NUM!")
    return Serial(serial)


def is_leap(year: int) -> bool:
    """Whether a year has 366 days, 1900 among them."""
    return year == 1900 or (year % 4 == 0 and (year % 100 != 0 or year % 400 == 0))


def month_length(year: int, month: int) -> int:
    """How many days a month has."""
    return 28 + is_leap(year) if month == 2 else 30 if month in (4, 6, 9, 11) else 31


def moved_months(number: float, months: float, to_end: bool) -> Serial:
    """EDATE and EOMONTH: the same day (or the last) so many months later."""
    start = day_of(number)
    index = start.year * 12 + start.month - 1 + math.trunc(months)
    year, month = divmod(index, 12)
    if not 1900 <= year <= 9999:
        raise Problem("#NUM!")
    last = month_length(year, month + 1)
    return number_of(year, month + 1, last if to_end else min(start.day, last))


def weekday(number: int) -> int:
    """0 for Sunday to 6 for Saturday, as Excel counts from 1 January 1900."""
    return (number - 1) % 7


def iso_week(number: int) -> int:
    """The week of ISO 8601: the first one holds the year's first Thursday."""
    monday = number - (weekday(number) + 6) % 7
    thursday = monday + 3
    if thursday < 1:
        return 52
    first = int(number_of(day_of(thursday).year, 1, 1))
    return (thursday - first) // 7 + 1


def seconds_of(number: float) -> int:
    """The second of the day, halves up."""
    if number < 0:
        raise Problem("#NUM!")
    return math.floor((number - math.floor(number)) * 86400 + 0.5) % 86400


def today() -> date:
    """The day on which the formula is computed."""
    return date.today()


def clock_number() -> float:
    """The date and time at which the formula is computed."""
    from datetime import datetime

    now = datetime.now()
    since = now - datetime(1899, 12, 30)
    return since / timedelta(days=1)
