"""What is best of the designs kept: the Pareto front of the objectives, and the designs nearest to what cannot be had.

A design is on the front where no other is at least as good in every objective and better in one. Of one objective the best
are those with the best values; of several those nearest to the ideal point, which has the best of each: each objective
counts from 0 (its best value of all) to 1 (its worst value on the front). Designs that are set apart are neither: a number
that the workbook marks is not compared with one that it does not. The files are read one after another; what is held is the
front and the list of the best.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.model import Objective
from mechsheet.studies.designs import APART, DESIGN, Designs
from mechsheet.studies.folder import Folder, Result
from mechsheet.studies.packages import arrow
from mechsheet.studies.parts import Order

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

MOST = 200_000
"""Designs of a front that are held: a front of more is thinned, evenly along the first objective."""


@dataclass(frozen=True, slots=True)
class Ranked:
    """front: numbers of its designs (from 1), by the first objective; whole: False where it was thinned
    best   numbers of the best designs, in order;  apart: of the first designs that are set apart, as many"""

    front: Numbers
    best: Numbers
    apart: Numbers
    whole: bool = True


def ranked(paths: Sequence[Any], objectives: Sequence[Objective], count: int) -> Ranked:
    """The front and the best of the designs in some files."""
    apart = _first(paths, count, apart=True)
    if not objectives:
        return Ranked(np.zeros(0, np.int64), _first(paths, count), apart)
    signs = np.array([-1.0 if each.largest else 1.0 for each in objectives])
    names = [each.text for each in objectives]
    front, at, whole = np.zeros((0, len(names))), np.zeros(0, np.int64), True
    for numbers, values in _columns(paths, names):
        points = np.concatenate([front, values * signs])
        numbers = np.concatenate([at, numbers])
        kept = front_of(points)
        if len(kept) > MOST:
            kept, whole = kept[np.linspace(0, len(kept) - 1, MOST // 2).astype(int)], False
        front, at = points[kept], numbers[kept]
    if not len(front):
        return Ranked(at, _first(paths, count), apart)
    ideal, worst = front.min(axis=0), front.max(axis=0)
    span = np.where(worst > ideal, worst - ideal, 1.0)
    far, best = np.zeros(0), np.zeros(0, np.int64)
    for numbers, values in _columns(paths, names):
        distances = (
            values[:, 0] * signs[0]
            if len(names) == 1
            else np.sqrt((((values * signs - ideal) / span) ** 2).sum(axis=1))
        )
        far, best = np.concatenate([far, distances]), np.concatenate([best, numbers])
        order = np.lexsort((best, far))[:count]
        far, best = far[order], best[order]
    return Ranked(at, best, apart, whole)


def front_of(points: Array) -> Numbers:
    """The places of the points that none is better than, all coordinates to be small; of equal points the first. Sorted by
    the coordinates.

    Raises nothing: no point, no front. Up to two coordinates by sorting alone, three by sorting and a staircase.
    """
    if not len(points):
        return np.zeros(0, np.int64)
    order = np.lexsort(points.T[::-1])  # stable: of equal points the first comes first
    sorted_ = points[order]
    fresh = np.ones(len(order), bool)
    fresh[1:] = np.any(sorted_[1:] != sorted_[:-1], axis=1)
    order, sorted_ = order[fresh], sorted_[fresh]
    if points.shape[1] == 1:
        return order[:1]
    if points.shape[1] == 2:
        least = np.minimum.accumulate(sorted_[:, 1])
        better = np.ones(len(order), bool)
        better[1:] = sorted_[1:, 1] < least[:-1]
        return order[better]
    return order[_staircase(sorted_[:, 1:])]


def _staircase(points: Array) -> list[int]:
    """Of points in order, those not dominated in both coordinates by one before: a staircase of what is best so far."""
    across: list[float] = []
    down: list[float] = []  # falls as `across` rises
    kept = []
    for number, (x, y) in enumerate(points.tolist()):
        place = bisect_right(across, x)
        if place and down[place - 1] <= y:
            continue
        kept.append(number)
        first = bisect_left(across, x)
        last = first
        while last < len(across) and down[last] >= y:
            last += 1
        across[first:last], down[first:last] = [x], [y]
    return kept


def _columns(paths: Sequence[Any], names: Sequence[str]) -> Any:
    """Of each file the numbers and objectives of the designs that have all objectives and are not set apart."""
    for path in paths:
        table = arrow().parquet.read_table(path, columns=[DESIGN, *dict.fromkeys(names), APART])
        values = np.stack([table.column(name).to_numpy(zero_copy_only=False).astype(float) for name in names], axis=1)
        fine = np.isfinite(values).all(axis=1) & ~table.column(APART).to_numpy()
        if fine.any():
            yield table.column(DESIGN).to_numpy()[fine], values[fine]


def _first(paths: Sequence[Any], count: int, apart: bool = False) -> Numbers:
    """The first designs, where nothing says which are best; of those that are set apart, or of the others."""
    found: list[int] = []
    for path in paths:
        table = arrow().parquet.read_table(path, columns=[DESIGN], filters=[(APART, "=", apart)])
        found += table.column(0)[: count - len(found)].to_pylist()
        if len(found) >= count:
            break
    return np.array(found, np.int64)


def rows_of(paths: Sequence[Any], order: Order, numbers: Numbers) -> Any:
    """The rows of some designs, in the order of the numbers, as a pyarrow table; None of no designs."""
    pa = arrow()
    parts = np.unique((numbers - 1) // order.size)
    tables = []
    for part in parts:
        wanted = numbers[(numbers - 1) // order.size == part]
        tables.append(pa.parquet.read_table(paths[part], filters=[(DESIGN, "in", wanted.tolist())]))
    if not tables:
        return None
    table = pa.concat_tables(tables)
    there = {number: place for place, number in enumerate(table.column(DESIGN).to_pylist())}
    return table.take([there[number] for number in numbers.tolist()])


@dataclass(frozen=True, slots=True)
class Studied:
    """A study that has come to its end.

    best, front, apart  tables of designs, every column of the parts;  ranked  their numbers
    """

    designs: Designs
    order: Order
    folder: Folder
    result: Result
    ranked: Ranked
    best: Any
    front: Any
    apart: Any
