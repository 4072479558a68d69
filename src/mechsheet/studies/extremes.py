"""The smallest and the largest value of quantities over a motion, of many designs at once: as the workbook finds them.

All rules are the workbook's own trees (`sheet/checks/search_rules.py`, `rivals.py`, `boundless.py`), evaluated over arrays:
where a search begins, where it probes, what is said of what it finds, and where a stretch of rows begins and ends between
them. Places count rows from 1.

The remarks and their limits are those of the first sheet: *(about)* where the last probe still changed the extreme, *(or
beyond)* where it may be beside another row or in a spike, *(grows without bound)* where there is none, *(rows only)* where
nobody looked between the rows. A design is set apart where a condition or an objective reads a number of the last two kinds:
it is kept and told of, but not compared with others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, transform, with_symbols
from mechsheet.kinematics.numeric import value as value_of
from mechsheet.sheet.checks import boundless, rivals
from mechsheet.sheet.checks import search_rules as rules
from mechsheet.words.catalogue import Language, words

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Rows = NDArray[np.intp]
State = dict[str, Any]
"""Values of names that rules read: numbers, or arrays of one for each design."""

Way = Literal["min", "max"]

SENSES: Mapping[Way, float] = {"min": 1.0, "max": -1.0}

HERE, FIRST, LAST = range(3)
"""The rows in which angles are known: that from which a search begins, the first and the last one of the stretch."""


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
    looked_at = there & (begun <= rules.STRETCHES)
    in_first = there & (begun == 1)
    first = np.argmax(in_first, axis=1) + 1
    last = first + in_first.sum(axis=1) - 1
    last_row = rows - np.argmax(looked_at[:, ::-1], axis=1)
    shown = there & (number <= rules.STRETCHES)[:, None]
    return Stretches(there.sum(axis=1), number, first, last, last_row), shown


def best_rows(way: Way, column: Array, shown: Mask | None) -> tuple[Rows, Array]:
    """The best row of each design, from 0, and the value there; no finite one where no row is shown.

    shown  the rows of which it is taken; None where all designs that somebody asks of close in all rows
    """
    if shown is not None and not shown.all():
        column = np.where(shown, column, np.inf if way == "min" else -np.inf)
    place = np.argmin(column, axis=1) if way == "min" else np.argmax(column, axis=1)
    return place, column[np.arange(len(column)), place]


# --- what the rows say ----------------------------------------------------------------------------------------------------


@dataclass(slots=True)
class Anchors:
    """What is known of one extreme from the rows, for each design: columns (n,).

    of_rows, other   the best value of all rows, and the other extreme of them;  best: the row (from 1) of the best
    here, value      the row from which the probes go on, and its value;  before, after: those of the rows beside it
    of_first, of_last  values in the first and in the last row of the stretch
    whole            1, 2 or 0: what the rows cover
    wraps            1, 2 where the ends of the motion are neighbours for probes (their row twice, or not), else 0
    angles           (n, angles, 3) of the angles without jumps that probes need, in the rows `HERE`, `FIRST`, `LAST`
    offer            the most that another row promises beside it (`rivals`)
    pole             whether three rows are those around a place where the quantity has no bound
    """

    of_rows: Array
    other: Array
    best: Array
    here: Array
    value: Array
    before: Array
    after: Array
    of_first: Array
    of_last: Array
    whole: Array
    wraps: Array
    angles: Array
    offer: Array
    pole: Mask


@dataclass(frozen=True, slots=True)
class Asked:
    """An extreme, and what decides where its search begins.

    wraps   whether the rows at the ends of whole turns are neighbours for its quantity: the tree
    moves   whether probes go on beyond the ends there: never by a motion law, whose rows end in time
    limits  whether the sheet looks for limits, and has a probe at both ends of the motion
    pole    whether it is asked for a place without bound
    """

    way: Way
    wraps: Node
    moves: bool
    limits: bool
    pole: bool


def anchors_of(
    asked: Asked, column: Array, best: tuple[Rows, Array], other: Array, stretches: Stretches, whole: Array,
    angles: list[Array], divisor: Array | None,
) -> Anchors:  # fmt: skip
    """What the rows say of an extreme.

    column   the quantity, designs by rows;  best: its best rows and values;  other: its other extreme in the rows
    whole    1, 2 or 0 for each design: what the rows cover
    angles   angles without jumps, designs by rows
    divisor  what the quantity is divided by only as an absolute value, designs by rows
    """
    designs, rows = column.shape
    each = np.arange(designs)

    def at(place: Any, column: Array = column) -> Array:
        """Of each design the value in a row of its own; of a row that there is not, that of the nearest."""
        return np.asarray(column[each, np.clip(place, 1, rows).astype(np.intp) - 1])

    known: State = {"sense": SENSES[asked.way], "rows": rows, "whole": whole, "of_rows": best[1], "other": other}
    known |= {"first": stretches.first, "last": stretches.last, "best": best[0] + 1.0}
    known |= {"start": column[:, 0], "end": column[:, -1], "half": math.pi, "span": np.abs(best[1] - other)}
    known["wraps"] = value_of(asked.wraps, known) if asked.moves else np.zeros(designs)
    known["here"] = _begun_from(asked, column, known)
    known |= {"start": known["here"], "low": known["first"], "high": known["last"]}
    beside_it = [value_of(tree, known) for tree in (rules.LOWER, rules.UPPER)]
    known["before"], known["after"] = (at(value_of(rules.ROW_AT, known | {"place": place})) for place in beside_it)
    known |= {"value": at(known["here"]), "of_first": at(known["first"]), "of_last": at(known["last"])}
    known["angles"] = np.empty((designs, len(angles), 3))
    for number, angle in enumerate(angles):
        for row, name in enumerate(("here", "first", "last")):
            known["angles"][:, number, row] = at(known[name], angle)
    known["offer"] = _offer(column, known, at)
    known["pole"] = _pole(known, at, divisor) if asked.pole else np.zeros(designs, bool)
    return Anchors(*(known[field.name] for field in fields(Anchors)))


def _begun_from(asked: Asked, column: Array, known: State) -> Array:
    """The rows from which probes go on: the best ones, or, where that is the motion's first or last, others."""
    here, rows = known["best"].copy(), column.shape[1]
    if not asked.limits or rows < rules.LEAST_INNER:
        return np.asarray(here)
    every = (known["wraps"] == 0) & (known["first"] == 1) & (known["last"] == rows)
    for end, inward, inner in ((0, 1, slice(2, None)), (rows - 1, -1, slice(None, -2))):
        designs = np.flatnonzero(every & (known["best"] == end + 1))
        if len(designs):
            y = column[designs]
            place, other = best_rows(asked.way, y[:, inner], None)
            values = (y[:, end + step * inward] for step in range(3))
            ends = dict(zip(("end", "next", "third"), values, strict=True))
            moved = value_of(rules.INNER, {"sense": known["sense"], "other": other, **ends})
            here[designs[moved]] = place[moved] + 1.0 + (inner.start or 0)
    return np.asarray(here)


At = Callable[..., Array]
"""Of each design the value in a row of its own."""


def _turned(tree: Node) -> Node:
    """A rule over values that are turned so that the least is sought."""
    return transform(with_symbols(tree, {"sense": al.ONE}), al.tidied)


_PEAK, _NO_TWIN = [_turned(tree) for tree in rivals.PEAK], _turned(rivals.NO_TWIN)
_AT_END = _turned(Call("AND", rivals.AT_END))


def _offer(column: Array, known: State, at: At) -> Array:
    """The most that a row promises beside it that is neither near the one the probes begin from nor a twin of the best one;
    infinite the other way where there is none."""
    sense, first, last, rows = known["sense"], known["first"], known["last"], column.shape[1]
    y = column if sense > 0 else -column
    known = known | {"allowed": value_of(rivals.ALLOWED, known)}
    known |= {"twin": sense * value_of(rivals.TWIN_BELOW, known), "again": value_of(rivals.AGAIN, known)}
    inner = {"own": y[:, 1:-1], "before": y[:, :-2], "after": y[:, 2:]}
    found = value_of(_PEAK[0], inner) & value_of(_PEAK[1], inner)
    part, every = np.flatnonzero(last - first + 1 < rows), np.arange(1, rows + 1)[None, :]
    missing = np.isnan(y)
    if len(part):  # of a part of the table no peak is asked for
        within = (every >= first[part, None]) & (every <= last[part, None])
        found[part] = within[:, :-2] & within[:, 2:]
        missing[part] &= within
    found &= value_of(_NO_TWIN, {"own": inner["own"], "twin": known["twin"][:, None]})
    design, row = np.nonzero(found)
    most = np.full(len(y), np.inf)
    if len(design):
        there: State = {name: each[design, row] for name, each in inner.items()}
        there |= {"number": row + 1, "here": known["here"][design], "again": known["again"][design]}
        far = value_of(rivals.FAR[0], there) & value_of(rivals.FAR[1], there)
        np.minimum.at(most, design[far], value_of(rules.OFFER, there)[far])
    for end, other, inward in ((first, last, 1), (last, first, -1)):
        after, third, near = end + inward, end + 2 * inward, other - inward
        places: State = {"own": end, "after": after, "third": third, "far": other, "near": near}
        known |= {name: at(place, y) for name, place in places.items()} | {"end": end, "other_end": other}
        known["before"] = known["outside"] = value_of(rivals.OUTSIDE, known)
        rival = value_of(_AT_END, known)
        most = np.where(rival, np.fmin(most, value_of(rules.OFFER, known)), most)
    # where the quantity has no value in some row of the stretch, the sheet says nothing
    return np.asarray(sense * np.where(missing.any(axis=1) | (last - first < 2), np.inf, most))


def _pole(known: State, at: At, divisor: Array | None) -> Mask:
    """Whether three rows are those around a place where the quantity has no bound."""
    known = known | {"middle": value_of(boundless.MIDDLE, known)}
    before, after = (value_of(tree, known) for tree in boundless.NEIGHBOURS)
    places = {"before": before, "here": known["middle"], "after": after}
    values = {name: at(place) for name, place in places.items()}
    if divisor is not None:
        signs = {name: at(place, divisor) for name, place in places.items()}
        for name in ("before", "after"):
            beside = {"value": values[name], "there": signs[name], "here": signs["here"]}
            values[name] = value_of(boundless.SIGNED, beside)
    return np.asarray(value_of(boundless.at_pole(divisor is not None), values), bool)


OfDesigns = TypeVar("OfDesigns", Stretches, Anchors)


def joined(parts: list[OfDesigns]) -> OfDesigns:
    """What is known of several blocks of designs, as that of one."""
    if len(parts) == 1:
        return parts[0]
    kind = type(parts[0])
    return kind(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(kind)))


# --- between the rows -----------------------------------------------------------------------------------------------------

Probe = Callable[[Array], Array]
"""A quantity at a place of each design, (n,)."""


def _probed(state: State, probe: Probe) -> State:
    """What the last row of a search knows, what the last probe has found, and the best before it."""
    for number in range(rules.PROBES):
        state["vertex"] = value_of(rules.VERTEX, state)
        state["probe"] = value_of(rules.PROBE if number else rules.FIRST_PROBE, state)
        state["before"] = state["f_middle"]
        values = probe(value_of(rules.PLACE, state))
        state["value"] = state["last_probe"] = np.where(np.isfinite(values), values, state["f_middle"])
        above = {f"{name}_above": state[name] for name in ("probe", "middle")}
        state |= {name: value_of(tree, state) for name, tree in rules.NARROWED.items()} | above
    return state


def refined(
    way: Way, anchors: Anchors, stretches: Stretches, edges: tuple[Array, Array], rows_only: Mask,
    probe: Callable[[Array, Rows], Array], corners: Sequence[Array] = (),
) -> tuple[Array, Codes, Array]:  # fmt: skip
    """The extremes of designs, what is to be said of them, and the best of rows and corners.

    corners  places of each where pieces of its motion meet
    edges  where their stretches begin and end, between rows;  rows_only: of which nothing is known there
    probe  the quantity at a place of each design, angles near what they are in a row (`HERE`, `FIRST`, `LAST`)
    """
    state: State = {field.name: getattr(anchors, field.name) for field in fields(Anchors)}
    state |= {"sense": SENSES[way], "first": stretches.first, "last": stretches.last, "rows_only": rows_only}
    state["low"], state["high"] = edges
    ends = (("at_low", state["low"] < state["first"], FIRST), ("at_high", state["high"] > state["last"], LAST))
    with np.errstate(all="ignore"):
        for (name, limited, row), end in zip(ends, ("low", "high"), strict=True):
            state[name] = state["of_first" if row == FIRST else "of_last"]
            if limited.any():
                values = probe(state[end], np.full(len(limited), row))
                values = np.where(np.isfinite(values), values, state["value"])
                state[name] = np.where(limited, values, state[name])
        if corners:
            _best_corner(state, corners, probe)
        trees = rules.begun(corners=bool(corners))
        state["start"] = start = value_of(trees.pop("start"), state)
        state |= {name: value_of(trees.pop(name), state) for name in ("lower", "upper")}
        near = np.where(start == state["here"], HERE, np.where(start == state["low"], FIRST, LAST))
        state["of_lower"] = np.where(start == state["here"], anchors.before, anchors.of_last)
        state["of_upper"] = np.where(start == state["here"], anchors.after, anchors.of_first)
        if corners:
            near = np.where(state["cornered"], HERE, near)
            for name in ("lower", "upper"):
                of_row = probe(state[name], near)
                state[f"of_{name}"] = np.where(state["cornered"], of_row, state[f"of_{name}"])
        for name, tree in trees.items():  # the limit depends on the side
            state[name] = value_of(tree, state)
        state = _probed(state, lambda places: probe(places, near))
        state["found"] = state["f_middle"]
        result, placed = (
            (rules.EXTREME_OF_CORNERS, rules.PLACED_OF_CORNERS) if corners else (rules.EXTREME, rules.PLACED)
        )
        state["extreme"] = extreme = value_of(result, state)
        state["place"] = value_of(rules.PLACE, state | {"probe": state["middle"]})
        state["place"] = value_of(placed, state)
        given = state | {"allowed": value_of(rivals.ALLOWED, state), "found": extreme}
        given["promise"] = value_of(rivals.PROMISE_BEYOND, given)
        state["elsewhere"] = value_of(rivals.MORE, given)
        if corners:
            for name in ("before", "last_probe"):
                state[name] = value_of(rules.UNLESS_CORNER, state | {"probed": state[name]})
        doubts = value_of(rules.DOUBT, state)
    known = np.asarray(state["best_known"] if corners else anchors.of_rows, float)
    return np.asarray(extreme, float), OF_DOUBTS[np.asarray(doubts, np.intp)], known


def _best_corner(state: State, corners: Sequence[Array], probe: Callable[[Array, Rows], Array]) -> None:
    """The best value of all corners, its place, and whether it is better than the best row."""
    here = np.full(len(state["here"]), HERE)
    values = np.stack([probe(places, here) for places in corners])
    best = (np.argmin if state["sense"] > 0 else np.argmax)(values, axis=0)
    each = np.arange(len(best))
    state["at_corner"], state["corner"] = values[best, each], np.stack(corners)[best, each]
    state["cornered"] = value_of(rules.CORNERED, state | {"earlier": state["before"], "later": state["after"]})
    state["best_known"] = value_of(rules.OF_ROWS_AND_CORNERS, state)


def edges_of(first: Array, last: Array, rows: int, margin: Probe) -> tuple[Array, Array, Mask]:
    """Where the first stretches of designs begin and end between rows, and which of them are known to a row only.

    margin  the least margin of all groups at places (n, 2)
    """
    inside, outside = np.stack((first, last), axis=1), np.stack((first - 1.0, last + 1.0), axis=1)
    outside[(outside < 1) | (outside > rows)] = np.nan
    state: State = {"inside": inside, "outside": outside, "newest": outside, "other": inside, "oldest": outside}
    state["f_other"] = state["margin"] = margin(inside)
    state["f_newest"] = state["f_oldest"] = margin(outside)
    for number in range(rules.LIMIT_PROBES):
        state["share"] = value_of(rules.SHARE if number else rules.FIRST_SHARE, state)
        state["probe"] = value_of(rules.SHARED, state)
        state["value"] = margin(state["probe"])
        state |= {name: value_of(tree, state) for name, tree in rules.CROSSED.items()}
    found = np.where(np.isnan(outside), inside, value_of(rules.FOUND, state))
    unsettled = np.asarray(value_of(rules.REST, state) > rules.SETTLED_LIMIT).any(axis=1)
    return found[:, 0], found[:, 1], np.asarray(unsettled, bool)


def least_gap(margins: Array, margin: Probe) -> Array:
    """The least margin of designs that close in every row, also between rows.

    margins  designs by rows;  margin: at a place of each design
    """
    if margins.shape[1] < 3:
        return np.asarray(margins.min(axis=1))
    rows = {"before": margins[:, :-2], "here": margins[:, 1:-1], "after": margins[:, 2:]}
    with np.errstate(all="ignore"):
        place = np.argmin(value_of(rules.DIP, rows), axis=1)
        state: State = {"sense": 1.0, "side": 0.0, "limit": 0.0}
        for name, step in (("left", 0), ("middle", 1), ("right", 2)):
            state[name] = place + step + 1.0
            state[f"f_{name}"] = margins[np.arange(len(margins)), place + step]
        return np.asarray(_probed(state, margin)["f_middle"])


# --- what is said of it ----------------------------------------------------------------------------------------------------

Codes = NDArray[np.int8]
Texts = NDArray[np.object_]

ABOUT, BEYOND, BOUNDLESS, ROWS_ONLY, SEVERAL = 1, 2, 3, 4, 5
"""Codes of remarks, 0 for none: of two the larger is said, as on the first sheet."""

OF_DOUBTS: Codes = np.zeros(5, np.int8)
OF_DOUBTS[[rules.ABOUT, rules.BEYOND, rules.ROWS]] = ABOUT, BEYOND, ROWS_ONLY
"""The code of what the sheet of extremes says beside a value, by its number."""

WORDS = {
    ABOUT: "verdict.about",
    BEYOND: "verdict.beyond",
    BOUNDLESS: "verdict.boundless",
    ROWS_ONLY: "verdict.rows.only",
    SEVERAL: "verdict.several",
}


def said(codes: Mapping[str, Codes], language: Language, count: int) -> Texts:
    """The remarks of designs, as one text each: "swing (rows only), v_max (grows without bound)"; None without any.

    codes  of each quantity, by its name
    """
    found: Texts = np.full(count, None, object)
    for name, column in codes.items():
        for place in np.flatnonzero(column):
            text = name + words(language, WORDS[int(column[place])])
            found[place] = text if found[place] is None else f"{found[place]}, {text}"
    return found


def apart(codes: Mapping[str, Codes], decisive: Iterable[str], count: int) -> Mask:
    """Which designs are set apart; `decisive`: names of quantities that conditions and objectives read."""
    found = np.zeros(count, bool)
    for name in decisive:
        found |= codes[name] >= BOUNDLESS
    return found
