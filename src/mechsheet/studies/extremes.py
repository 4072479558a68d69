"""The smallest and the largest value of quantities over a motion, of many designs at once: as the workbook finds them.

As the sheet of extremes does (`sheet/checks/extremes.py`): the best row (or the best away from an end of the motion), a
probe at the vertex of the parabola through it and its neighbours, one beside it or on the row's other side, then two at the
vertices of parabolas through what is known; beside a limit all parabolas are over the root of the distance from it; where
the workbook has the quantity's derivatives, two probes where the first changes its sign. What is given has been attained:
the best of the row, the probes and both ends of the stretch. Of several stretches, and of one of one row, the rows are all.
Places count rows from 1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from mechsheet.kinematics.period import SAME_AGAIN
from mechsheet.studies.remarks import ABOUT, BEYOND, Codes, at_pole, unsettled
from mechsheet.studies.rivals import beyond, promised

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

BESIDE = 0.1
"""How far beside the first probe the second is made, in rows."""

FROM_LIMIT = 0.125
"""How far from a limit the second probe is made, at least: as a part of the root of the row's distance."""

AT_LIMIT = 1e-3
"""The same where the quantity has no number at the limit, where the row's then stands: it may grow without bound there."""

BEFORE = -9.0
"""A place before all others: of no limit."""

FROM_END = 0.25
"""How far from the motion's first or last row the first probe is made, where the parabola's vertex lies beyond it."""

STRETCHES = 3
"""Stretches of rows that are looked at: of more there are no extremes."""

LEAST_INNER = 7
"""Rows, at least, where an extreme is also looked for between those that are no neighbours of the best."""

INWARDS = 1e-9
"""How far inside the limit its value is given, in rows: there the mechanism still closes."""

HALVINGS = 45

Way = Literal["min", "max"]


@dataclass(frozen=True, slots=True)
class Stretches:
    """Where designs close: in how many rows, in how many stretches of rows that follow one another, and the first and last
    row (from 1) of the first of them; `last_row`: of all. Columns (n,): nothing here is as long as the table."""

    count: NDArray[np.int64]
    number: NDArray[np.int64]
    first: NDArray[np.int64]
    last: NDArray[np.int64]
    last_row: NDArray[np.int64]


def stretches_of(there: Mask, closes: Mask) -> tuple[Stretches, Mask]:
    """The stretches of designs, and the rows of which extremes are taken.

    there  a row for each design, a column for each row of its table;  closes: in all
    """
    designs, rows = there.shape
    ones = np.ones(designs, np.int64)
    if closes.all():
        return Stretches(ones * rows, ones, ones, ones * rows, ones * rows), there
    begins = np.diff(there, axis=1, prepend=False) & there
    begun = np.cumsum(begins, axis=1)
    number = np.asarray(begun[:, -1], np.int64)
    looked_at = there & (begun <= STRETCHES)
    in_first = there & (begun == 1)
    first = np.argmax(in_first, axis=1) + 1
    last = first + in_first.sum(axis=1) - 1
    last_row = rows - np.argmax(looked_at[:, ::-1], axis=1)
    shown = there & (number <= STRETCHES)[:, None]
    return Stretches(there.sum(axis=1), number, first, last, last_row), shown


def best_rows(way: Way, column: Array, shown: Mask | None) -> tuple[NDArray[np.intp], Array]:
    """The best row of each design, from 0, and the value there; no finite one where no row is shown.

    shown  the rows of which it is taken; None where all designs that somebody asks of close in all rows
    """
    if shown is not None and not shown.all():
        column = np.where(shown, column, np.inf if way == "min" else -np.inf)
    place = np.argmin(column, axis=1) if way == "min" else np.argmax(column, axis=1)
    return place, column[np.arange(len(column)), place]


@dataclass(slots=True)
class Anchors:
    """What is known of one extreme from the rows, for each design: columns (n,).

    most, worst          the best value of all rows, and the other extreme of them
    here, best           the row (from 1) from which the probes go on, and its value
    middle               the row whose neighbours the first parabola goes through; before, value, after: values there
    wraps                1, 2 where the ends of the motion are neighbours (their row twice, or not), else 0
    turns                values, in the best row, of the angles without jumps that probes need
    rival                the most that another row promises beside it (`rivals`)
    pole                 whether the middle row and its neighbours are those beside a place where the quantity has no bound
    """

    most: Array
    worst: Array
    here: Array
    best: Array
    middle: Array
    before: Array
    value: Array
    after: Array
    wraps: Array
    turns: Array
    rival: Array
    pole: Mask


def anchors_of(
    way: Way,
    column: Array,
    best: tuple[NDArray[np.intp], Array],
    worst: Array,
    stretches: Stretches,
    whole: Array,
    half_turn: float,
    ends: bool,
    limits: bool,
    angles: list[Array],
    divisor: Array | None,
) -> Anchors:
    """What the rows say of an extreme.

    column     the quantity, designs by rows;  best: its best rows and values;  worst: its other extreme in the rows
    whole      1, 2 or 0 for each design: whether rows cover whole turns
    half_turn  pi where the quantity is an angle whose whole turns count, 0 where it need not come back with the mechanism:
               its rows say whether it does; else infinite
    ends       whether the ends of a whole turn are neighbours for probes: never by a motion law
    limits     whether the sheet looks for limits, and has a probe at both ends of the motion
    angles     angles without jumps, designs by rows
    divisor    what the quantity is divided by only as an absolute value, designs by rows
    """
    designs, rows = column.shape
    each = np.arange(designs)
    place, most = best
    first, last = stretches.first, stretches.last
    apart = np.abs(column[:, 0] - column[:, -1])
    meet = apart < half_turn if half_turn else (whole == 1) & (apart <= SAME_AGAIN * np.abs(most - worst))
    around = (whole > 0) & (first == 1) & (last == rows) & meet
    wraps = np.where(around, whole, 0.0)
    beyond = wraps if ends else np.zeros(designs)
    if limits and rows >= LEAST_INNER:
        place = _begun_from(way, column, place, (beyond == 0) & (first == 1) & (last == rows))
    value = column[each, place]
    middle = np.where(beyond > 0, place, np.maximum(first, np.minimum(last - 2, place)))
    turned = np.where(beyond > 0, np.where(beyond == 1, rows - 1, rows), 2 * rows).astype(np.int64)
    beside = [np.minimum(index, rows - 1) for index in ((middle - 1) % turned, middle, (middle + 1) % turned)]
    before, here, after = (column[each, index] for index in beside)
    signs = [1.0, 1.0, 1.0] if divisor is None else [np.sign(divisor[each, index]) for index in beside]
    pole = at_pole(before * signs[0] * signs[1], here, after * signs[2] * signs[1], signed=divisor is not None)
    turns = np.empty((designs, len(angles)))
    for at, angle in enumerate(angles):
        turns[:, at] = angle[each, place]
    at_row, at_middle = (np.asarray(index + 1.0, float) for index in (place, middle))
    rival = promised(way == "max", column, place, (first, last), beyond, most, worst)
    return Anchors(most, worst, at_row, value, at_middle, before, here, after, wraps, turns, rival, pole)


def _begun_from(way: Way, column: Array, place: NDArray[np.intp], looked_at: Mask) -> NDArray[np.intp]:
    """The rows (from 0) from which probes go on: where the best is the first or the last and no vertex lies inside, the best
    of all but the two there, if it is better than the neighbour of that end."""
    sign, last = (1.0 if way == "max" else -1.0), column.shape[1] - 1
    best = place  # the other one may be at the other end
    for end, inward in ((0, 1), (last, -1)):
        designs = np.flatnonzero(looked_at & (best == end))
        if not len(designs):
            continue
        y = sign * column[designs]
        other = np.argmax(y[:, 2:], axis=1) + 2 if end == 0 else np.argmax(y[:, :-2], axis=1)
        near = y[:, end + inward]
        outside = 3.4 * near <= 2.7 * y[:, end] + 0.7 * y[:, end + 2 * inward]
        taken = outside & (y[np.arange(len(y)), other] > near)
        place = place.copy()
        place[designs[taken]] = other[taken]
    return place


OfDesigns = TypeVar("OfDesigns", Stretches, Anchors)


def joined(parts: list[OfDesigns]) -> OfDesigns:
    """What is known of several blocks of designs, as that of one."""
    if len(parts) == 1:
        return parts[0]
    kind = type(parts[0])
    return kind(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(kind)))


Probe = Callable[[Array], Array]
"""The quantity at places (n, k)."""

Slopes = Callable[[Array], tuple[Array, Array]]
"""Its first and second derivative by the number of the row at places (n,)."""


@dataclass(frozen=True, slots=True)
class Around:
    """Where an extreme is sought, for each design.

    low, high  where the stretch begins and ends, between rows;  first, last: its rows
    beyond     whether the ends of the motion are neighbours, so that places go on beyond them
    """

    low: Array
    high: Array
    first: NDArray[np.int64]
    last: NDArray[np.int64]
    beyond: Mask

    def within(self, places: Array) -> Array:
        """Places, none beyond the stretch."""
        return np.where(self.beyond, places, np.maximum(self.low, np.minimum(self.high, places)))


def refined(
    way: Way,
    anchors: Anchors,
    stretches: Stretches,
    edges: tuple[Array, Array],
    ends: bool,
    probe: Probe,
    slopes: Slopes | None = None,
) -> tuple[Array, Codes]:
    """The extremes of designs of one stretch, and what is to be said of them.

    edges   where their stretches begin and end, between rows;  ends: as in `anchors_of`
    slopes  where the workbook has the quantity's derivatives, too
    """
    first, last = stretches.first, stretches.last
    low, high = edges
    here, best = anchors.here, anchors.best
    around = Around(low, high, first, last, anchors.wraps > 0 if ends else np.zeros(len(here), bool))

    def found(*places: Array) -> list[Array]:
        values = probe(np.stack(places, axis=1))
        return [np.where(np.isfinite(column), column, best) for column in values.T]

    with np.errstate(all="ignore"):
        partial = (low < first) | (high > last)
        at_ends = [best, best]
        if partial.any():
            at_ends = found(np.where(partial, low, here), np.where(partial, high, here))
            at_ends = [np.where(partial, column, best) for column in at_ends]
        if slopes is None:
            places, probed = _by_parabolas(way, anchors, around, at_ends, found)
        else:
            places = list(_where_it_turns(way, anchors, around, slopes))
            probed = found(*places)
        # what is best of all only in a row is so in one at an end
        stacked = np.array([best, *probed, *at_ends, anchors.most])
        taken = np.argmin(stacked, axis=0) if way == "min" else np.argmax(stacked, axis=0)
        extreme = stacked[taken, np.arange(len(best))]
        place = np.array([here, *places, low, high, np.where(taken > 0, low, here)])[taken, np.arange(len(best))]
        at_end = ~around.beyond & ((place == low) | (place == high))
        about = unsettled(best, probed, extreme, anchors.worst, at_end)
    of_rows = (stretches.number > 1) | (first == last) | ~np.isfinite(best)
    elsewhere = beyond(way == "max", anchors.rival, extreme, anchors.most, anchors.worst)
    codes = np.where(of_rows, 0, np.where(elsewhere, BEYOND, np.where(about, ABOUT, 0))).astype(np.int8)
    return np.where(of_rows, anchors.most, extreme), codes


Point = tuple[Array, Array]


@dataclass(frozen=True, slots=True)
class Roots:
    """Places by the root of their distance from a limit, as a part of the best row's; without limit, by the distance from a
    place before all."""

    here: Array
    limit: Array
    limited: Mask

    def of(self, places: Array) -> Array:
        """The roots of places."""
        part = (places - self.limit) / (self.here - self.limit)
        return np.where(self.limited, np.sqrt(part), part)

    def place(self, roots: Array) -> Array:
        """The other way round."""
        return np.asarray(self.limit + (self.here - self.limit) * np.where(self.limited, roots**2, roots))

    def first(self, there: Array, best: Array, value: Array) -> Array:
        """Where the parabolas through the limit (`there` is the value), the row and the next have their vertices:

        y(w) = y0 + b w + c w^2 with w^2 = |u - limit|.
        """
        far, rise, next_rise = np.abs(self.here - self.limit), best - there, value - there
        root = ((far + 1) * rise - far * next_rise) / (2 * (np.sqrt(far + 1) * rise - np.sqrt(far) * next_rise))
        root = np.where(np.isfinite(root), np.maximum(0.0, root), 0.0)
        return self._off(np.maximum(far / 4.0, np.minimum(far + 1.0, root**2)))

    def second(self, there: Array, best: Array, one: Point) -> Array:
        """The same through the limit, the first probe and the row."""
        far, w, rise, row_rise = np.abs(self.here - self.limit), self.of(one[0]), one[1] - there, best - there
        root = (rise - w**2 * row_rise) / (2 * (rise - w * row_rise))
        root = np.where(np.isfinite(root), np.maximum(FROM_LIMIT, root), FROM_LIMIT)
        root = np.where(there == best, AT_LIMIT, root)
        return self._off(np.minimum(far + 1.0, far * root**2))

    def _off(self, far: Array) -> Array:
        return np.asarray(self.limit + np.sign(self.here - self.limit) * far)


def _by_parabolas(
    way: Way, anchors: Anchors, around: Around, at_ends: list[Array], found: Callable[..., list[Array]]
) -> tuple[list[Array], list[Array]]:
    """The places of four probes and the values there, each placed by what is known before it."""
    low, high, beyond = around.low, around.high, around.beyond
    here, best = anchors.here, anchors.best
    before, value, after = anchors.before, anchors.value, anchors.after
    step = (before - after) / (2.0 * (before - 2.0 * value + after))
    vertex = anchors.middle + np.where(np.isfinite(step), step, 0.0)
    at_first, at_last = ~beyond & (here == around.first), ~beyond & (here == around.last)
    least = np.where(at_first & (low == around.first), here + FROM_END, low)
    most = np.where(at_last & (high == around.last), here - FROM_END, high)
    near = np.minimum(here + 1.0, vertex)
    one = np.where(beyond, np.maximum(here - 1.0, near),
                   np.maximum(np.maximum(least, here - 1.0), np.minimum(most, near)))  # fmt: skip
    at_low = at_first & (low < around.first)
    limited = at_low | (at_last & (high > around.last))
    roots = Roots(here, np.where(at_low, low, np.where(limited, high, BEFORE)), limited)
    there = np.where(at_low, *at_ends)
    one = np.where(limited, roots.first(there, best, value), one)
    (y_one,) = found(one)
    worse = y_one > best if way == "min" else y_one < best
    aside = np.where(worse, 2.0 * here - one, one + np.where(one - here > 1e-6, -BESIDE, BESIDE))
    two = around.within(np.where(limited, roots.second(there, best, (one, y_one)), aside))
    (y_two,) = found(two)
    three = _further(one, (here + one) / 2.0, around, roots, (here, best), (one, y_one), (two, y_two))
    (y_three,) = found(three)
    four = _further(one, one, around, roots, (one, y_one), (two, y_two), (three, y_three))
    return [one, two, three, four], [y_one, y_two, y_three, *found(four)]


def _where_it_turns(way: Way, anchors: Anchors, around: Around, slopes: Slopes) -> tuple[Array, Array]:
    """The two places of `sheet/checks/turning.py`: inverse Hermite interpolation of the derivative, then a Newton step."""
    here = anchors.here
    once, twice = slopes(here)
    side = np.where(once > 0 if way == "max" else once < 0, 1.0, -1.0)
    turned = np.where(anchors.wraps == 1, around.last - 1, around.last)
    neighbour = np.maximum(around.first, np.minimum(around.last, here + side))
    there_once, there_twice = slopes(np.where(around.beyond, 1.0 + (here + side - 1.0) % turned, neighbour))
    t = once / (once - there_once)
    t = np.where(np.isfinite(t), t, 0.0)
    s = t**2 * (3 - 2 * t) + side * t * (1 - t) * (there_once - once) * ((1 - t) / twice - t / there_twice)
    inside = (t > 0) & (t < 1)

    def newton(at: Array, rate: Array, change: Array) -> Array:
        step = np.maximum(here - 1.0, np.minimum(here + 1.0, at - rate / change))
        return np.where(np.isfinite(step), around.within(step), at)

    one = np.where(inside, here + side * np.where((s > 0) & (s < 1), s, t), newton(here, once, twice))
    return one, newton(one, *slopes(one))


def vertex_of(one: Point, two: Point, three: Point) -> Array:
    """Where the parabolas through three points (u, y) have their vertices."""
    (u_one, y_one), (u_two, y_two), (u_three, y_three) = one, two, three
    a, b = u_two - u_one, u_two - u_three
    return np.asarray(
        u_two
        - (a**2 * (y_two - y_three) - b**2 * (y_two - y_one)) / (2 * (a * (y_two - y_three) - b * (y_two - y_one)))
    )


def _further(middle: Array, known: Array, around: Around, roots: Roots, *points: Point) -> Array:
    """The vertex through three points, no farther than a row from the middle; where there is none the place known."""
    one, two, three = ((roots.of(place), value) for place, value in points)
    vertex = roots.place(np.maximum(0.0, vertex_of(one, two, three)))
    place = around.within(np.maximum(middle - 1.0, np.minimum(middle + 1.0, vertex)))
    return np.where(np.isfinite(place), place, known)


def edges_of(first: Array, last: Array, rows: int, inside: Callable[[Array], Mask]) -> tuple[Array, Array]:
    """Where the first stretches of designs begin and end between rows: where the last margin becomes 0, by halving.

    inside  whether the margins of all groups are above 0, at places (n, 2)
    """
    closed = np.stack((first, last), axis=1)
    open_ = np.stack((np.maximum(first - 1.0, 1.0), np.minimum(last + 1.0, rows)), axis=1)
    there, beyond = closed.copy(), open_.copy()
    for _ in range(HALVINGS):
        middle = (there + beyond) / 2.0
        meets = inside(middle)
        there, beyond = np.where(meets, middle, there), np.where(meets, beyond, middle)
    way = np.sign(closed - open_)
    edges = np.where(
        way == 0, closed, np.where(way > 0, np.minimum(there + INWARDS, closed), np.maximum(there - INWARDS, closed))
    )
    return edges[:, 0], edges[:, 1]


def least_between(margins: Array, margin: Callable[[Array], Array]) -> Array:
    """The least margin of designs that close in every row, also between rows: beside the two lowest rows.

    margins  designs by rows;  margin  at places (n, k)
    """
    designs, rows = margins.shape
    least = margins.min(axis=1)
    if rows < 3:
        return np.asarray(least)
    padded = np.pad(margins, ((0, 0), (1, 1)), constant_values=np.inf)
    lowest = np.where((margins <= padded[:, :-2]) & (margins <= padded[:, 2:]), margins, np.inf)
    order = np.argsort(lowest, axis=1, kind="stable")[:, :2]
    each = np.arange(designs)[:, None]
    middle = np.minimum(np.maximum(order, 1), rows - 2)
    before, value, after = (margins[each, middle + step] for step in (-1, 0, 1))
    with np.errstate(all="ignore"):
        step = np.clip((before - after) / (2.0 * (before - 2.0 * value + after)), -1.0, 1.0)
        one = middle + 1.0 + np.where(np.isfinite(step), step, 0.0)
        y_one = margin(one)
        outer = np.where(one > middle + 1.0, middle + 2.0, middle)
        y_outer = np.where(one > middle + 1.0, after, before)
        two = vertex_of((middle + 1.0, value), (one, y_one), (outer, y_outer))
        two = np.clip(np.where(np.isfinite(two), two, one), middle, middle + 2.0)
        places = [y_one, margin(two)]
    between = np.concatenate(places, axis=1)
    return np.asarray(np.minimum(least, np.nanmin(np.where(np.isnan(between), np.inf, between), axis=1)))
