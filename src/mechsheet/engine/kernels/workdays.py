"""Working days."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...formula.nodes import ErrorValue, Scalar
from ..texts.calendar import LAST_DAY, weekday, whole_day
from ..values.calling import Problem, Serial, to_number

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
    "NETWORKDAYS": lambda start, end, holidays=None: days_between(start, end, _USUAL, _holidays(holidays)),
    "NETWORKDAYS.INTL": lambda start, end, free=None, holidays=None: days_between(
        start, end, weekend(free), _holidays(holidays)
    ),
    "WORKDAY": lambda start, days, holidays=None: day_after(start, days, _USUAL, _holidays(holidays)),
    "WORKDAY.INTL": lambda start, days, free=None, holidays=None: day_after(
        start, days, weekend(free), _holidays(holidays)
    ),
}
