"""Statistics of one set of numbers: spread, shape, ranks and percentiles."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..interpreter.calling import Args, is_reference
from ..interpreter.closures import Evaluation
from ..values.cells import BLANK, DIV0, ERROR, NUM, NUMBER, TEXT, Cells, Frame, Numbers, codes_of
from ..values.coerce import Problem, need, numbers_of, raise_first
from .fold import count, fold, folded, mean, total, united
from .logic import _first_of, _flat


def _deviations(numbers: Any, counts: Any) -> tuple[Any, Any]:
    """(sum of squared differences from the mean, how many)."""
    many = count(numbers, counts)
    mean = total(numbers, counts) / np.where(many == 0, 1.0, many)
    return np.add.reduce(np.where(counts, np.square(numbers - mean), 0.0)), many


def _spread(sample: bool, root: bool) -> Callable[[Any, Any], Any]:
    def function(numbers: Any, counts: Any) -> Any:
        squares, many = _deviations(numbers, counts)
        below = many - 1 if sample else many
        found = squares / np.where(below <= 0, 1.0, below)
        return np.sqrt(found) if root else found, np.where(below <= 0, np.uint8(DIV0), np.uint8(0))

    return function


def _devsq(numbers: Any, counts: Any) -> Any:
    squares, many = _deviations(numbers, counts)
    return squares, np.where(many == 0, np.uint8(NUM), np.uint8(0))


def _extreme(largest: bool) -> Callable[[Any, Any], Any]:
    def function(numbers: Any, counts: Any) -> Any:
        start = -np.inf if largest else np.inf
        reduce = np.maximum.reduce if largest else np.minimum.reduce
        found = reduce(np.where(counts, numbers, start), initial=start)
        return np.where(np.logical_or.reduce(counts), found, 0.0)

    return function


def _counting_all(function: Callable[[Any, Any], Any]) -> Any:
    """The functions that end in A: in cells, truth values count as 0 and 1, and texts as 0."""

    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        del spread
        numbers, counts, errors = [], [], []
        for arg in united(args):
            cells = ev.value(arg, frame, spread=True)
            inside = is_reference(arg) or np.ndim(cells.numbers) > 2
            codes = np.broadcast_to(codes_of(cells), cells.shape)
            if inside:
                shown, faults = (
                    np.where(codes == TEXT, 0.0, cells.numbers),
                    np.where(codes >= ERROR, codes, np.uint8(0)),
                )
            else:
                shown, own = numbers_of(cells, ev.texts)
                faults = np.zeros(cells.shape, np.uint8) if own is None else np.broadcast_to(own, cells.shape)
            used = (codes != BLANK) if inside else np.ones(cells.shape, bool)
            numbers.append(_flat(np.where(used & (faults == 0), shown, 0.0)))
            counts.append(_flat(used))
            errors.append(_flat(faults))
        tail = np.broadcast_shapes(*(part.shape[1:] for part in numbers))

        def joined(parts: list[Any]) -> Any:
            return np.concatenate([np.broadcast_to(part, (len(part), *tail)) for part in parts])

        faults = joined(errors)
        return folded(function, joined(numbers), joined(counts), _first_of(faults) if faults.any() else None)

    return kernel


SPREADS = {
    "STDEV.S": _spread(True, True), "STDEV.P": _spread(False, True), "VAR.S": _spread(True, False),
    "VAR.P": _spread(False, False),
}  # fmt: skip
_STDEV, _STDEV_P, _VAR, _VAR_P = SPREADS.values()

KERNELS: dict[str, Any] = {
    "STDEV": fold(_STDEV), "STDEV.S": fold(_STDEV), "STDEVP": fold(_STDEV_P), "STDEV.P": fold(_STDEV_P),
    "VAR": fold(_VAR), "VAR.S": fold(_VAR), "VARP": fold(_VAR_P), "VAR.P": fold(_VAR_P), "DEVSQ": fold(_devsq),
    "STDEVA": _counting_all(_STDEV), "STDEVPA": _counting_all(_STDEV_P), "VARA": _counting_all(_VAR),
    "VARPA": _counting_all(_VAR_P), "AVERAGEA": _counting_all(mean), "MAXA": _counting_all(_extreme(True)),
    "MINA": _counting_all(_extreme(False)),
}  # fmt: skip


# --- of all numbers of a call ----------------------------------------------------------------------------------------


def _joined(function: Callable[[Numbers], float], least: int = 1, code: str = "#NUM!") -> Callable[..., float]:
    """A function of all numbers of the arguments; `code` of fewer than `least`."""

    def of(*parts: Numbers) -> float:
        numbers = np.concatenate(parts)
        if len(numbers) < least:
            raise Problem(code)
        return float(function(numbers))

    return of


def _geometric(numbers: Numbers) -> float:
    need(bool(np.all(numbers > 0)))
    product = float(np.prod(numbers))
    if 1e-300 < product < 1e300:
        return math.pow(product, 1 / len(numbers))
    return math.exp(float(np.mean(np.log(numbers))))


def _harmonic(numbers: Numbers) -> float:
    need(bool(np.all(numbers > 0)))
    return float(len(numbers) / np.sum(1 / numbers))


def _standard(numbers: Numbers, sample: bool) -> Numbers:
    """The differences from the mean, in standard deviations; #DIV/0! where there are none."""
    away = numbers - numbers.mean()
    deviation = math.sqrt(float(np.sum(away * away)) / (len(numbers) - sample))
    if deviation == 0:
        raise Problem("#DIV/0!")
    return np.asarray(away / deviation, np.float64)


def _skew(numbers: Numbers) -> float:
    n = len(numbers)
    return float(np.sum(_standard(numbers, True) ** 3)) * n / ((n - 1) * (n - 2))


def _kurtosis(numbers: Numbers) -> float:
    n = len(numbers)
    fourth = float(np.sum(_standard(numbers, True) ** 4))
    return fourth * n * (n + 1) / ((n - 1) * (n - 2) * (n - 3)) - 3 * (n - 1) ** 2 / ((n - 2) * (n - 3))


def _modes(numbers: Numbers) -> Numbers:
    """The most frequent numbers in order of appearance; #N/A when none appears twice."""
    found, first, many = np.unique(numbers, return_index=True, return_counts=True)
    if not len(many) or many.max() < 2:
        raise Problem("#N/A")
    most = many == many.max()
    return np.asarray(found[most][np.argsort(first[most])], np.float64)


def share_of(part: Numbers, whole: Numbers) -> float:
    """PERCENTOF: the sum of a part in that of the whole."""
    if float(whole.sum()) == 0:
        raise Problem("#DIV/0!")
    return float(part.sum() / whole.sum())


def trimmed_mean(numbers: Numbers, share: float) -> float:
    """TRIMMEAN: without a share of the numbers, half of it at each end."""
    need(0 <= share < 1, len(numbers) > 0)
    cut = math.trunc(len(numbers) * share) // 2
    return float(np.sort(numbers)[cut : len(numbers) - cut].mean())


# --- ranks -----------------------------------------------------------------------------------------------------------


def percentile(numbers: Numbers, share: float, exclusive: bool = False) -> float:
    """PERCENTILE.INC and .EXC: between the two nearest numbers by the part of the way."""
    ordered, n = np.sort(numbers), len(numbers)
    need(n > 0)
    place = share * (n + 1) - 1 if exclusive else share * (n - 1)
    need(0 <= place <= n - 1 if exclusive else 0 <= share <= 1, 0 < share < 1 or not exclusive)
    low = math.floor(place)
    part = place - low
    if part == 0 or low + 1 >= n:
        return float(ordered[low])
    return float(ordered[low] + part * (ordered[low + 1] - ordered[low]))


def quartile(numbers: Numbers, quarter: float, exclusive: bool = False) -> float:
    """QUARTILE.INC and .EXC."""
    which = math.trunc(quarter) if quarter >= 0 else -1
    need(1 <= which <= 3 if exclusive else 0 <= which <= 4)
    return percentile(numbers, which / 4, exclusive)


def _percent_rank(exclusive: bool) -> Callable[..., float]:
    def of(numbers: Numbers, x: float, digits: float = 3.0) -> float:
        ordered, n, places = np.sort(numbers), len(numbers), math.trunc(digits)
        need(n > 0, places >= 1)
        if not ordered[0] <= x <= ordered[-1]:
            raise Problem("#N/A")
        below = int(np.searchsorted(ordered, x, "left"))
        rank = float(below)
        if ordered[below] != x:
            low, high = ordered[below - 1], ordered[below]
            rank = below - 1 + float((x - low) / (high - low))
        share = (rank + 1) / (n + 1) if exclusive else rank / (n - 1) if n > 1 else 1.0
        return math.floor(share * 10.0**places + 1e-9) / 10.0**places

    return of


def _rank(average: bool) -> Callable[..., float]:
    def of(number: float, table: Cells, order: float = 0.0) -> float:
        raise_first(table.codes)
        numbers = table.numbers[table.codes == NUMBER]
        equal = int(np.count_nonzero(numbers == number))
        if not equal:
            raise Problem("#N/A")
        before = int(np.count_nonzero(numbers < number if order else numbers > number))
        return before + 1 + (equal - 1) / 2 if average else before + 1.0

    return of


def standardized(x: float, mean: float, deviation: float) -> float:
    """STANDARDIZE."""
    need(deviation > 0)
    return (x - mean) / deviation


def frequency(numbers: Numbers, bounds: Numbers) -> Numbers:
    """FREQUENCY: how many numbers up to each bound (and above the one before it), and how many beyond, in a column."""
    order = np.argsort(bounds, kind="stable")
    up_to = np.searchsorted(np.sort(numbers), bounds[order], "right")
    found = np.zeros(len(bounds) + 1)
    found[order] = np.diff(up_to, prepend=0)
    found[-1] = len(numbers) - (up_to[-1] if len(bounds) else 0)
    return found[:, None]


def probability(places: Cells, shares: Cells, low: float, high: float | None = None) -> float:
    """PROB: the probability of values between two bounds."""
    if places.numbers.size != shares.numbers.size:
        raise Problem("#N/A")
    raise_first(places.codes)
    raise_first(shares.codes)
    p = np.where(shares.codes.ravel() == NUMBER, shares.numbers.ravel(), 0.0)
    if not np.any((places.codes.ravel() == NUMBER) & (shares.codes.ravel() == NUMBER)):
        raise Problem("#DIV/0!")
    need(bool(np.all((p >= 0) & (p <= 1))), abs(float(p.sum()) - 1) < 1e-7)
    x = places.numbers.ravel()
    inside = (x == low) if high is None else (x >= low) & (x <= high)
    return float(np.sum(p[inside & (places.codes.ravel() == NUMBER)]))


MODES = _joined(lambda numbers: float(_modes(numbers)[0]), 1, "#N/A")
"""MODE.SNGL."""

PLAIN: dict[str, Callable[..., Any]] = {
    "AVEDEV": _joined(lambda numbers: float(np.mean(np.abs(numbers - numbers.mean())))),
    "GEOMEAN": _joined(_geometric),
    "HARMEAN": _joined(_harmonic),
    "SKEW": _joined(_skew, 3, "#DIV/0!"),
    "SKEW.P": _joined(lambda numbers: float(np.mean(_standard(numbers, False) ** 3)), 3, "#DIV/0!"),
    "KURT": _joined(_kurtosis, 4, "#DIV/0!"),
    "MODE": MODES,
    "MODE.SNGL": MODES,
    "MODE.MULT": lambda *parts: _modes(np.concatenate(parts))[:, None],
    "PERCENTOF": share_of,
    "TRIMMEAN": trimmed_mean,
    "PERCENTILE": percentile,
    "PERCENTILE.INC": percentile,
    "PERCENTILE.EXC": lambda numbers, share: percentile(numbers, share, exclusive=True),
    "QUARTILE": quartile,
    "QUARTILE.INC": quartile,
    "QUARTILE.EXC": lambda numbers, quarter: quartile(numbers, quarter, exclusive=True),
    "PERCENTRANK": _percent_rank(False),
    "PERCENTRANK.INC": _percent_rank(False),
    "PERCENTRANK.EXC": _percent_rank(True),
    "RANK": _rank(False),
    "RANK.EQ": _rank(False),
    "RANK.AVG": _rank(True),
    "STANDARDIZE": standardized,
    "FREQUENCY": frequency,
    "PROB": probability,
}
