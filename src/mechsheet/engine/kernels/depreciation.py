"""Depreciation."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ..values.calling import need
from .finance import MOST_PERIODS, division


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
    "SLN": straight,
    "SYD": sum_of_digits,
    "DB": fixed_declining,
    "DDB": double_declining,
    "VDB": variable_declining,
}
