"""Dates, times and working days."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...formula.nodes import ErrorValue, Scalar
from ..texts.calendar import (
    LAST_DAY,
    clock_number,
    day_of,
    is_leap,
    iso_week,
    month_length,
    moved_months,
    number_of,
    seconds_of,
    today,
    weekday,
    whole_day,
)
from ..values.coerce import Problem, Serial, day_and_time, to_number


def date_(year: float, month: float, day: float) -> Serial:
    """DATE: years below 1900 count from 1900."""
    years = math.trunc(year)
    if not 0 <= years <= 9999:
        raise Problem("#NUM!")
    if max(abs(month), abs(day)) > 1e7:
        raise Problem("#NUM!")
    return number_of(years + (1900 if years < 1900 else 0), math.trunc(month), math.trunc(day))


def time_(hour: float, minute: float, second: float) -> float:
    """TIME: a part of a day; whole days are left out."""
    parts = [math.trunc(part) for part in (hour, minute, second)]
    seconds = parts[0] * 3600 + parts[1] * 60 + parts[2]
    if max(parts) > 32767 or seconds < 0:
        raise Problem("#NUM!")
    return seconds % 86400 / 86400


def _shown(text: str) -> tuple[float, float]:
    found = day_and_time(text.strip()) if text.strip() else None
    if found is None:
        raise Problem("#VALUE!")
    return found


def date_value(text: str) -> Serial:
    """DATEVALUE: the day that a text shows."""
    found, _ = _shown(text)
    if found < 1:
        raise Problem("#VALUE!")
    return Serial(found)


def time_value(text: str) -> float:
    """TIMEVALUE: the time of day that a text shows."""
    return _shown(text)[1] % 1.0


def weekday_(number: float, kind: float = 1.0) -> float:
    """WEEKDAY: 1 Sunday first, 2 Monday first, 3 Monday as 0, 11 to 17 Monday to Sunday first."""
    day, which = weekday(whole_day(number)), math.trunc(kind)
    if which == 3:
        return float((day - 1) % 7)
    if which not in (1, 2, *range(11, 18)):
        raise Problem("#NUM!")
    return float((day - _week_start(which)) % 7 + 1)


def _week_start(kind: int) -> int:
    """The first day of the week, 0 for Sunday."""
    return {1: 0, 2: 1}.get(kind, (kind - 10) % 7)


def week_number(number: float, kind: float = 1.0) -> float:
    """WEEKNUM: the week that holds 1 January is the first one; 21 counts as ISO 8601 does."""
    day, which = whole_day(number), math.trunc(kind)
    if which == 21:
        return float(iso_week(day))
    if which not in (1, 2, *range(11, 18)):
        raise Problem("#NUM!")
    first = int(number_of(day_of(day).year, 1, 1))
    before = (weekday(first) - _week_start(which)) % 7
    return float((day - first + before) // 7 + 1)


# --- differences -----------------------------------------------------------------------------------------------------


def days_360(start: float, end: float, european: bool = False) -> float:
    """DAYS360: as if every month had 30 days."""
    first, last = day_of(start), day_of(end)
    a, b = first.day, last.day
    if european:
        a, b = min(a, 30), min(b, 30)
    else:
        if a == month_length(first.year, first.month):
            a = 30
        if b == 31 and a >= 30:
            b = 30
    return float((last.year - first.year) * 360 + (last.month - first.month) * 30 + b - a)


def year_fraction(start: float, end: float, basis: float = 0.0) -> float:
    """YEARFRAC: 0 US 30/360, 1 actual/actual, 2 actual/360, 3 actual/365, 4 European 30/360."""
    first, last, which = whole_day(start), whole_day(end), math.trunc(basis)
    if which not in range(5):
        raise Problem("#NUM!")
    first, last = min(first, last), max(first, last)
    if which in (0, 4):
        return (_us_days(first, last) if which == 0 else days_360(first, last, european=True)) / 360
    length = {1: _year_length(first, last), 2: 360.0, 3: 365.0}[which]
    return (last - first) / length


def _us_days(start: int, end: int) -> float:
    """The days of 30/360 as YEARFRAC counts them: the ends of February count as 30, too."""
    first, last = day_of(start), day_of(end)
    a, b = first.day, last.day
    from_february = first.month == 2 and a == month_length(first.year, 2)
    if from_february and last.month == 2 and b == month_length(last.year, 2):
        b = 30
    if from_february:
        a = 30
    if b == 31 and a >= 30:
        b = 30
    return float((last.year - first.year) * 360 + (last.month - first.month) * 30 + b - min(a, 30))


def _year_length(start: int, end: int) -> float:
    """The mean length of a year between two days, by Excel's rule for basis 1."""
    first, last = day_of(start), day_of(end)
    within = last.year == first.year or (last.year == first.year + 1 and first[1:] >= last[1:])
    if not within:
        years = range(first.year, last.year + 1)
        return sum(365 + is_leap(year) for year in years) / len(years)
    if first.year == last.year:
        return 365.0 + is_leap(first.year)
    leap_day = any(is_leap(year) and start <= number_of(year, 2, 29) <= end for year in (first.year, last.year))
    return 365.0 + leap_day


def date_difference(start: float, end: float, unit: str) -> float:
    """DATEDIF: whole years (Y), months (M), days (D), or what is left of them (YM, MD, YD)."""
    first, last = whole_day(start), whole_day(end)
    if first > last:
        raise Problem("#NUM!")
    a, b = day_of(first), day_of(last)
    months = (b.year - a.year) * 12 + b.month - a.month - (b.day < a.day)
    match unit.upper():
        case "Y":
            return float(months // 12)
        case "M":
            return float(months)
        case "D":
            return float(last - first)
        case "YM":
            return float(months % 12)
        case "MD":
            before = (b.year, b.month - 1) if b.month > 1 else (b.year - 1, 12)
            return float(b.day - a.day if b.day >= a.day else b.day + month_length(*before) - a.day)
        case "YD":
            year = b.year if a[1:] <= b[1:] else b.year - 1
            return float(last - number_of(year, a.month, a.day))
        case _:
            raise Problem("#NUM!")


def _time_unit(size: int, count: int) -> Callable[[float], float]:
    return lambda number: float(seconds_of(number) // size % count)


# --- working days ----------------------------------------------------------------------------------------------------


_SATURDAY, _SUNDAY = 6, 0


def weekend(which: Scalar) -> frozenset[int]:
    """The free days of a week (0 Sunday): a number of Excel's list, or seven characters from Monday on, 1 for a free day."""
    if which is None:
        which = 1.0
    if isinstance(which, str):
        if len(which) != 7 or set(which) - {"0", "1"}:
            raise Problem("#VALUE!")
        return frozenset((place + 1) % 7 for place, flag in enumerate(which) if flag == "1")
    number = math.trunc(to_number(which))
    if 1 <= number <= 7:
        return frozenset({(number + 5) % 7, (number + 6) % 7})
    if 11 <= number <= 17:
        return frozenset({number - 11})
    raise Problem("#NUM!")


def _holidays(values: list[Scalar] | None) -> frozenset[int]:
    found = set()
    for value in values or []:
        if isinstance(value, ErrorValue):
            raise Problem(value.code)
        if value is not None and value != "":
            found.add(math.floor(to_number(value)))
    return frozenset(found)


def days_between(start: float, end: float, free: frozenset[int], holidays: frozenset[int]) -> float:
    """Working days from one day to another, both counted; negative backwards."""
    first, last = whole_day(start), whole_day(end)
    sign = 1.0
    if first > last:
        first, last, sign = last, first, -1.0
    weeks, rest = divmod(last - first + 1, 7)
    count = weeks * (7 - len(free)) + sum(weekday(first + i) not in free for i in range(rest))
    count -= sum(first <= day <= last and weekday(day) not in free for day in holidays)
    return sign * count


def day_after(start: float, days: float, free: frozenset[int], holidays: frozenset[int]) -> Serial:
    """The day so many working days later."""
    day, left = whole_day(start), math.trunc(days)
    step = 1 if left > 0 else -1
    left = abs(left)
    if left and len(free) == 7:
        raise Problem("#VALUE!")
    near = sorted(holidays)
    if left > 400 and not near:
        weeks = (left - 1) // (7 - len(free)) - 1
        day, left = day + step * 7 * weeks, left - weeks * (7 - len(free))
    while left:
        day += step
        if not 0 <= day <= LAST_DAY:
            raise Problem("#NUM!")
        left -= weekday(day) not in free and day not in holidays
    return Serial(day)


_USUAL = frozenset({_SATURDAY, _SUNDAY})


PLAIN: dict[str, Callable[..., Any]] = {
    "DATE": date_,
    "TIME": time_,
    "DATEVALUE": date_value,
    "TIMEVALUE": time_value,
    "YEAR": lambda number: float(day_of(number).year),
    "MONTH": lambda number: float(day_of(number).month),
    "DAY": lambda number: float(day_of(number).day),
    "HOUR": _time_unit(3600, 24),
    "MINUTE": _time_unit(60, 60),
    "SECOND": _time_unit(1, 60),
    "WEEKDAY": weekday_,
    "WEEKNUM": week_number,
    "ISOWEEKNUM": lambda number: float(iso_week(whole_day(number))),
    "EDATE": lambda number, months: moved_months(number, months, to_end=False),
    "EOMONTH": lambda number, months: moved_months(number, months, to_end=True),
    "DAYS": lambda end, start: float(whole_day(end) - whole_day(start)),
    "DAYS360": days_360,
    "YEARFRAC": year_fraction,
    "DATEDIF": date_difference,
    "TODAY": lambda: number_of(today().year, today().month, today().day),
    "NOW": lambda: Serial(clock_number()),
    "NETWORKDAYS": lambda start, end, holidays=None: days_between(start, end, _USUAL, _holidays(holidays)),
    "NETWORKDAYS.INTL": lambda start, end, free=None, holidays=None: days_between(
        start, end, weekend(free), _holidays(holidays)
    ),
    "WORKDAY": lambda start, days, holidays=None: day_after(start, days, _USUAL, _holidays(holidays)),
    "WORKDAY.INTL": lambda start, days, free=None, holidays=None: day_after(
        start, days, weekend(free), _holidays(holidays)
    ),
}
