"""The smallest and the largest value of quantities over a motion, of many designs at once: as the workbook finds them.

From the best row (or the best away from an end of the motion), or from where the stretch begins or ends, the search goes on
by the workbook's own rule (`sheet/checks/bracket.py`), evaluated over arrays. What is given has been attained. Of several
stretches, and of one of one row, the rows are all. Places count rows from 1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from mechsheet.kinematics.numeric import value as value_of
from mechsheet.kinematics.period import SAME_AGAIN
from mechsheet.sheet.checks.bracket import FIRST_PROBE, NARROWED, PLACE, PROBE, PROBES, ROOTED, VERTEX
from mechsheet.studies.remarks import ABOUT, BEYOND, Codes, at_pole, unsettled
from mechsheet.studies.rivals import beyond as beyond_found
from mechsheet.studies.rivals import promised

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

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
    edges                values in the first and the last row of the stretch;  beside: in the rows before and after `here`
    wraps                1, 2 where the ends of the motion are neighbours (their row twice, or not), else 0
    turns                values, in the best row, of the angles without jumps that probes need
    rival                the most that another row promises beside it (`rivals`)
    pole                 whether that row and its neighbours are those beside a place where the quantity has no bound
    """

    most: Array
    worst: Array
    here: Array
    best: Array
    edges: Array
    beside: Array
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
    before_and_after = [
        np.where(beyond > 0, (place + step) % turned, np.clip(place + step, first - 1, last - 1)) for step in (-1, 1)
    ]
    neighbours = np.stack([column[each, np.minimum(index, rows - 1)] for index in before_and_after], axis=1)
    edges = np.stack([column[each, first - 1], column[each, last - 1]], axis=1)
    rival = promised(way == "max", column, place, (first, last), beyond, most, worst)
    return Anchors(most, worst, np.asarray(place + 1.0, float), value, edges, neighbours, wraps, turns, rival, pole)


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


def refined(
    way: Way, anchors: Anchors, stretches: Stretches, edges: tuple[Array, Array], ends: bool, probe: Probe
) -> tuple[Array, Codes]:
    """The extremes of designs of one stretch, and what is to be said of them.

    edges   where their stretches begin and end, between rows;  ends: as in `anchors_of`
    """
    first, last = stretches.first, stretches.last
    low, high = edges
    here, best = anchors.here, anchors.best
    beyond = anchors.wraps > 0 if ends else np.zeros(len(here), bool)

    def found(places: Array, known: Array) -> Array:
        values = probe(places[:, None])[:, 0]
        return np.where(np.isfinite(values), values, known)

    with np.errstate(all="ignore"):
        limited = ((low < first) & ~beyond, (high > last) & ~beyond)
        at_low, at_high = (
            found(np.where(there, end, here), best) if there.any() else best
            for there, end in zip(limited, (low, high), strict=True)
        )
        state = _begun(1.0 if way == "min" else -1.0, anchors, (low, high), limited, (at_low, at_high), beyond)
        before = last_value = best
        for number in range(PROBES):
            state["vertex"] = value_of(VERTEX, state)
            state["probe"] = value_of(PROBE if number else FIRST_PROBE, state)
            before = state["f_middle"]
            state["value"] = last_value = found(np.asarray(value_of(PLACE, state)), before)
            above = {f"{name}_above": state[name] for name in ("probe", "middle")}
            state |= {name: value_of(tree, state) for name, tree in NARROWED.items()} | above
        probed = state["f_middle"]
        extreme = np.where(state["sense"] * (anchors.most - probed) < 0, anchors.most, probed)
        place = np.where(extreme == probed, value_of(PLACE, state | {"probe": state["middle"]}), low)
        at_end = ~beyond & ((place == low) | (place == high))
        about = unsettled(extreme, last_value, before, anchors.worst, at_end)
    of_rows = (stretches.number > 1) | (first == last) | ~np.isfinite(best)
    elsewhere = beyond_found(way == "max", anchors.rival, extreme, anchors.most, anchors.worst)
    codes = np.where(of_rows, 0, np.where(elsewhere, BEYOND, np.where(about, ABOUT, 0))).astype(np.int8)
    return np.where(of_rows, anchors.most, extreme), codes


def _begun(
    sense: float,
    anchors: Anchors,
    ends: tuple[Array, Array],
    limited: tuple[Mask, Mask],
    at_ends: tuple[Array, Array],
    beyond: Mask,
) -> dict[str, Array]:
    """What the first row of each search knows.

    ends     where the stretches begin and end;  limited: whether at limits;  at_ends: values there
    beyond   whether the ends of the motion are neighbours, so that places go on beyond them
    """
    here, best = anchors.here, anchors.best
    (low, high), (at_low, at_high) = ends, at_ends
    from_high = limited[1] & (sense * (at_high - best) < 0)
    from_low = limited[0] & (sense * (at_low - best) < 0)
    from_high = np.where(from_low, sense * (at_high - at_low) < 0, from_high)
    from_low &= ~from_high
    start = np.where(from_low, low, np.where(from_high, high, here))
    left = np.where(beyond, start - 1, np.maximum(low, np.ceil(start) - 1))
    right = np.where(beyond, start + 1, np.minimum(high, np.floor(start) + 1))
    at_left, at_right = limited[0] & (left == low), limited[1] & (right == high)
    side = np.where(at_left, 1.0, np.where(at_right, -1.0, 0.0))
    counted = {"side": side, "limit": np.where(side < 0, high, low), "sense": np.full(len(here), sense)}
    places = {"left": left, "middle": start, "right": right}
    before, after = anchors.beside.T
    return counted | {
        "f_left": np.where(at_left, at_low, np.where(from_high, anchors.edges[:, 1], before)),
        "f_middle": np.where(from_low, at_low, np.where(from_high, at_high, best)),
        "f_right": np.where(at_right, at_high, np.where(from_low, anchors.edges[:, 0], after)),
        **{name: np.asarray(value_of(ROOTED, counted | {"place": place})) for name, place in places.items()},
    }


Point = tuple[Array, Array]


def vertex_of(one: Point, two: Point, three: Point) -> Array:
    """Where the parabolas through three points (u, y) have their vertices."""
    (u_one, y_one), (u_two, y_two), (u_three, y_three) = one, two, three
    a, b = u_two - u_one, u_two - u_three
    return np.asarray(
        u_two
        - (a**2 * (y_two - y_three) - b**2 * (y_two - y_one)) / (2 * (a * (y_two - y_three) - b * (y_two - y_one)))
    )


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
