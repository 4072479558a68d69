"""Money: annuities, rates of return, flows of money, depreciation."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..values.cells import NUMBER, Cells, Numbers
from ..values.coerce import Problem, need, raise_first
from .math import paired

MOST_PERIODS = 1e6
"""As many periods are added one by one; #NUM! beyond."""


def growth(rate: float, periods: float) -> float:
    """(1 + rate)^periods."""
    return math.pow(1 + rate, periods)


def _factor(rate: float, periods: float) -> float:
    """What payments of 1 at the end of each period grow to."""
    if rate == 0:
        return periods
    if abs(rate) < 1e-5:
        return math.expm1(periods * math.log1p(rate)) / rate
    return (growth(rate, periods) - 1) / rate


def future_value(rate: float, periods: float, payment: float, present: float = 0.0, due: float = 0.0) -> float:
    """FV."""
    if rate == -1 and periods < 0:
        raise Problem("#DIV/0!")
    return -(present * growth(rate, periods) + payment * (1 + rate * bool(due)) * _factor(rate, periods))


def present_value(rate: float, periods: float, payment: float, future: float = 0.0, due: float = 0.0) -> float:
    """PV."""
    if rate == -1 and periods > 0:
        raise Problem("#DIV/0!")
    return -(future + payment * (1 + rate * bool(due)) * _factor(rate, periods)) / growth(rate, periods)


def payment(rate: float, periods: float, present: float, future: float = 0.0, due: float = 0.0) -> float:
    """PMT."""
    need(rate > -1)
    return -(future + present * growth(rate, periods)) / ((1 + rate * bool(due)) * _factor(rate, periods))


def number_of_periods(rate: float, pay: float, present: float, future: float = 0.0, due: float = 0.0) -> float:
    """NPER."""
    if rate == 0:
        if pay == 0:
            raise Problem("#NUM!")
        return -(present + future) / pay
    part = pay * (1 + rate * bool(due)) / rate
    return math.log((part - future) / (part + present)) / math.log1p(rate)


def interest_part(
    rate: float, period: float, periods: float, present: float, future: float = 0.0, due: float = 0.0
) -> float:
    """IPMT."""
    need(1 <= period < periods + 1)
    if rate == 0 or (due and period == 1):
        return 0.0
    found = -_balance(rate, period - 1, periods, present, future) * rate
    return found / (1 + rate) if due else found


def _balance(rate: float, after: float, periods: float, present: float, future: float) -> float:
    """What is still owed after some periods: present at the start, -future at the end."""
    whole = math.expm1(periods * math.log1p(rate))
    part = math.expm1(after * math.log1p(rate))
    return present * ((whole - part) / whole) - future * (part / whole)


def principal_part(
    rate: float, period: float, periods: float, present: float, future: float = 0.0, due: float = 0.0
) -> float:
    """PPMT."""
    return payment(rate, periods, present, future, due) - interest_part(rate, period, periods, present, future, due)


def _cumulative(part: Callable[..., float]) -> Callable[..., float]:
    def of(rate: float, periods: float, present: float, first: float, last: float, due: float) -> float:
        start, end = math.ceil(first), math.trunc(last)
        need(
            rate > 0,
            periods > 0,
            present > 0,
            1 <= first <= last <= periods,
            due in (0, 1),
            last - first < MOST_PERIODS,
        )
        return math.fsum(part(rate, period, periods, present, 0.0, due) for period in range(start, end + 1))

    return of


def solved(function: Callable[[float], float], guess: float) -> float:
    """A rate above -1 where a function is 0: Newton's method from the guess, then halving over a grid of rates."""
    rate = guess
    for _ in range(50):
        value, step = function(rate), 1e-7 * (1 + abs(rate))
        slope = (function(rate + step) - function(rate - step)) / (2 * step)
        if slope == 0 or not math.isfinite(value) or not math.isfinite(slope):
            break
        new = rate - value / slope
        if new <= -1:
            rate = (rate - 1) / 2
            continue
        if abs(new - rate) <= 1e-15 * max(1.0, abs(new)):
            return new
        rate = new
    return _by_halving(function, guess)


_GRID = (
    -0.999999,
    -0.99,
    -0.9,
    -0.75,
    -0.5,
    -0.3,
    -0.2,
    -0.1,
    -0.05,
    0.0,
    0.05,
    0.1,
    0.2,
    0.3,
    0.5,
    0.75,
    1.0,
    2.0,
    5.0,
)


def _by_halving(function: Callable[[float], float], guess: float) -> float:
    grid = sorted({*_GRID, 10.0, 100.0, 1e4, guess})
    found = [function(rate) for rate in grid]
    brackets = [
        (abs((a + b) / 2 - guess), a, b)
        for a, b, x, y in zip(grid, grid[1:], found, found[1:], strict=False)
        if math.isfinite(x) and math.isfinite(y) and (x < 0 < y or y < 0 < x)
    ]
    if not brackets:
        raise Problem("#NUM!")
    _, low, high = min(brackets)
    rising = function(high) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        if (function(middle) > 0) == rising:
            high = middle
        else:
            low = middle
    return (low + high) / 2


def rate(
    periods: float, pay: float, present: float, future: float = 0.0, due: float = 0.0, guess: float = 0.1
) -> float:
    """RATE."""
    need(periods > 0)

    def left(r: float) -> float:
        return present * growth(r, periods) + pay * (1 + r * bool(due)) * _factor(r, periods) + future

    return solved(left, guess)


# --- flows of money --------------------------------------------------------------------------------------------------


def net_present_value(discount: float, *parts: Numbers) -> float:
    """NPV: the first value at the end of the first period."""
    if discount == -1:
        raise Problem("#DIV/0!")
    values = np.concatenate(parts)
    return float(np.sum(values / (1 + discount) ** np.arange(1, len(values) + 1)))


def internal_rate(values: Numbers, guess: float = 0.1) -> float:
    """IRR."""
    need(len(values) > 1, bool(np.any(values > 0)), bool(np.any(values < 0)))
    times = np.arange(len(values))
    return solved(lambda r: float(np.sum(values * (1 + r) ** -times.astype(float))), guess)


def modified_rate(values: Numbers, finance: float, reinvest: float) -> float:
    """MIRR."""
    n = len(values)
    times = np.arange(n, dtype=float)
    paid, gained = values < 0, values > 0
    costs = float(np.sum(values[paid] / (1 + finance) ** times[paid]))
    gains = float(np.sum(values[gained] * (1 + reinvest) ** (n - 1 - times[gained])))
    if costs == 0:
        raise Problem("#DIV/0!")
    return math.pow(gains / -costs, 1 / (n - 1)) - 1


def _dated(values: Cells, dates: Cells) -> tuple[Numbers, Numbers]:
    if values.numbers.size != dates.numbers.size:
        raise Problem("#NUM!")
    for table in (values, dates):
        raise_first(table.codes)
        if np.any(table.codes != NUMBER):
            raise Problem("#VALUE!")
    amounts, days = paired(values, dates)
    days = np.floor(days)
    need(len(days) > 0, bool(np.all(days >= days[0])))
    return amounts, (days - days[0]) / 365


def dated_value(discount: float, values: Cells, dates: Cells) -> float:
    """XNPV."""
    amounts, years = _dated(values, dates)
    need(discount >= 0)
    return float(np.sum(amounts / (1 + discount) ** years))


def dated_rate(values: Cells, dates: Cells, guess: float = 0.1) -> float:
    """XIRR."""
    amounts, years = _dated(values, dates)
    need(bool(np.any(amounts > 0)), bool(np.any(amounts < 0)), guess > -1)
    return solved(lambda r: float(np.sum(amounts * (1 + r) ** -years)), guess)


def division() -> float:
    """#DIV/0!."""
    raise Problem("#DIV/0!")


# --- rates -----------------------------------------------------------------------------------------------------------


def effective(nominal: float, periods: float) -> float:
    """EFFECT."""
    many = math.trunc(periods)
    need(nominal > 0, many >= 1)
    return math.expm1(many * math.log1p(nominal / many))


def nominal_rate(effect: float, periods: float) -> float:
    """NOMINAL."""
    many = math.trunc(periods)
    need(effect > 0, many >= 1)
    return many * math.expm1(math.log1p(effect) / many)


def periods_needed(rate_: float, present: float, future: float) -> float:
    """PDURATION."""
    need(rate_ > 0, present > 0, future > 0)
    return math.log(future / present) / math.log1p(rate_)


def equal_rate(periods: float, present: float, future: float) -> float:
    """RRI."""
    need(periods > 0, present != 0)
    return math.pow(future / present, 1 / periods) - 1


def interest_linear(rate_: float, period: float, periods: float, present: float) -> float:
    """ISPMT."""
    return present * rate_ * (period / periods - 1) if periods else division()


def from_fraction(value: float, denominator: float) -> float:
    """DOLLARDE: 1.02 in sixteenths is 1.125."""
    whole, below, digits = _whole_and_parts(value, denominator)
    return whole + (value - whole) * digits / below


def to_fraction(value: float, denominator: float) -> float:
    """DOLLARFR."""
    whole, below, digits = _whole_and_parts(value, denominator)
    return whole + (value - whole) * below / digits


def _whole_and_parts(value: float, denominator: float) -> tuple[int, int, float]:
    """The whole part, the denominator as a whole number, and the power of ten that has room for the numerator."""
    below = math.trunc(denominator)
    need(denominator >= 0)
    if below == 0:
        raise Problem("#DIV/0!")
    return math.trunc(value), below, math.pow(10, math.ceil(math.log10(below)))


def grown(principal: float, rates: Cells) -> float:
    """FVSCHEDULE."""
    raise_first(rates.codes)
    if np.any((rates.codes != NUMBER) & (rates.codes != 1)):
        raise Problem("#VALUE!")
    return principal * float(np.prod(1 + rates.numbers))


# --- depreciation ----------------------------------------------------------------------------------------------------


def straight(cost: float, salvage: float, life: float) -> float:
    """SLN."""
    return (cost - salvage) / life if life else division()


def sum_of_digits(cost: float, salvage: float, life: float, period: float) -> float:
    """SYD."""
    need(life > 0, 0 < period <= life, salvage >= 0)
    return (cost - salvage) * (life - period + 1) * 2 / (life * (life + 1))


def fixed_declining(cost: float, salvage: float, life: float, period: float, months: float = 12.0) -> float:
    """DB: the rate is rounded to three decimals."""
    first = math.trunc(months)
    need(
        cost >= 0,
        salvage >= 0,
        life > 0,
        period >= 1,
        1 <= first <= 12,
        period <= min(life + (first < 12), MOST_PERIODS),
    )
    if cost == 0:
        return 0.0
    share = math.floor((1 - math.pow(salvage / cost, 1 / life)) * 1000 + 0.5) / 1000
    total = cost * share * first / 12
    if math.trunc(period) == 1:
        return total
    part = total
    for _ in range(2, math.trunc(period) + 1):
        part = (cost - total) * share
        total += part
    if period > life:
        return (cost - (total - part)) * share * (12 - first) / 12
    return part


def double_declining(cost: float, salvage: float, life: float, period: float, factor: float = 2.0) -> float:
    """DDB."""
    need(cost >= 0, salvage >= 0, life > 0, 0 < period <= life, factor > 0)
    share, period = min(factor / life, 1.0), max(period, 1.0)
    before = cost * math.pow(1 - share, period - 1) if share < 1 or period > 1 else cost
    after = cost * math.pow(1 - share, period)
    return max(0.0, before - max(after, salvage))


def variable_declining(
    cost: float, salvage: float, life: float, start: float, end: float, factor: float = 2.0, stay: bool = False
) -> float:
    """VDB: switches to straight-line depreciation where that is more, unless `stay`."""
    need(cost >= 0, salvage >= 0, life > 0, 0 <= start <= end <= min(life, MOST_PERIODS), factor > 0)
    total, left = 0.0, cost
    for period in range(math.ceil(end)):
        part = min(left * min(factor / life, 1.0), max(0.0, left - salvage))
        if not stay:
            part = max(part, (left - salvage) / (life - period)) if life > period else part
        overlap = min(end, period + 1) - max(start, period)
        total += part * max(0.0, overlap)
        left -= part
    return total


PLAIN: dict[str, Callable[..., Any]] = {
    "FV": future_value, "PV": present_value, "PMT": payment, "NPER": number_of_periods, "RATE": rate,
    "IPMT": interest_part, "PPMT": principal_part, "CUMIPMT": _cumulative(interest_part),
    "CUMPRINC": _cumulative(principal_part), "ISPMT": interest_linear, "NPV": net_present_value, "IRR": internal_rate,
    "MIRR": modified_rate, "XNPV": dated_value, "XIRR": dated_rate, "EFFECT": effective,
    "NOMINAL": nominal_rate, "PDURATION": periods_needed, "RRI": equal_rate, "DOLLARDE": from_fraction,
    "DOLLARFR": to_fraction, "FVSCHEDULE": grown,
    "SLN": straight,
    "SYD": sum_of_digits,
    "DB": fixed_declining,
    "DDB": double_declining,
    "VDB": variable_declining,
}  # fmt: skip
