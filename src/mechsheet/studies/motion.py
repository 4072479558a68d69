"""The motion of many designs: block by block over the rows, then, of those that the rows have not ruled out, between them.

What a row shows bounds an extreme: a smallest transmission angle of 30 degrees in some row cannot be above 40. So most
designs are ruled out before anybody looks between the rows.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mechsheet.formula.nodes import Node, Symbol, symbols
from mechsheet.kinematics.numeric import Array, value
from mechsheet.model import Condition
from mechsheet.studies.extremes import (
    Anchors,
    Stretches,
    Way,
    anchors_of,
    best_rows,
    edges_of,
    least_between,
    refined,
    stretches_of,
)
from mechsheet.studies.lowering import ANCHOR, INSIDE, THERE

if TYPE_CHECKING:
    from mechsheet.studies.designs import Designs
    from mechsheet.studies.questions import Quantity

BLOCK = 16_384
"""Numbers in an array of a block of designs: a dozen of them fit the second cache."""

Mask = NDArray[np.bool_]
Extreme = tuple[str, Way]

_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
_COMPARED = {"<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal}


class Motion:
    """The motion of some designs.

    alive       which of them the rows have not ruled out;  failed: how many each of `Questions.others` has
    quantities  of those alive: summaries and extremes, in the units shown, NaN where there is none
    """

    def __init__(self, designs: Designs, inside: Mapping[str, Array], known: Mapping[str, Array]) -> None:
        self.designs = designs
        quantities = designs.questions.quantities
        self.extremes: tuple[Extreme, ...] = tuple(
            dict.fromkeys((quantity.of, way) for quantity in quantities for way in quantity.ways)
        )
        self.failed = np.zeros(len(designs.questions.others), np.int64)
        self._bounds = _bounds(designs, known)
        self._blocks: list[_Block] = []
        count = len(next(iter(inside.values())))
        with np.errstate(all="ignore"):
            of_designs = designs.in_rows.run.designs(inside)
            size = max(1, BLOCK // designs.rows)
            for first in range(0, count, size):
                self._blocks.append(_Block(self, inside, of_designs, slice(first, min(first + size, count))))
            masks: list[Mask] = [block.alive for block in self._blocks]
            self.alive = np.concatenate(masks) if masks else np.zeros(0, bool)
            left = {symbol: column[self.alive] for symbol, column in inside.items()}
            self.quantities = (
                self._quantities(left) if self.alive.any() else {each.name: np.zeros(0) for each in quantities}
            )

    # --- between the rows -------------------------------------------------------------------------------------------------

    def _quantities(self, inside: Mapping[str, Array]) -> dict[str, Array]:
        designs = self.designs
        parts = [block for block in self._blocks if block.alive.any()]
        stretches = Stretches.joined([block.stretches for block in parts])
        anchors = {key: Anchors.joined([block.anchors[key] for block in parts]) for key in self.extremes}
        found = {key: each.best for key, each in anchors.items()}
        if not designs.rows_only:
            found |= self._refined(anchors, stretches, inside)
        result = {}
        for quantity in designs.questions.quantities:
            if quantity.take == "range":
                number = found[quantity.of, "max"] - found[quantity.of, "min"]
            elif quantity.ways:
                number = found[quantity.of, "min" if quantity.take == "min" else "max"]
            else:
                number = np.concatenate([block.taken[quantity.name] for block in parts])
            fine = (stretches.count > 0) & np.isfinite(number)
            result[quantity.name] = np.where(fine, number * quantity.factor, np.nan)
        return result

    def _refined(
        self, anchors: Mapping[Extreme, Anchors], stretches: Stretches, inside: Mapping[str, Array]
    ) -> dict[Extreme, Array]:
        """The extremes of all but what is given row by row."""
        designs = self.designs
        first, last = stretches.first.astype(float), stretches.last.astype(float)
        low, high = first.copy(), last.copy()
        part = (stretches.number == 1) & ((first > 1) | (last < designs.rows))
        if designs.limits and part.any():
            own = {symbol: column[part] for symbol, column in inside.items()}
            low[part], high[part] = self._edges(first[part], last[part], own)
        moves = designs.mechanism.driver.law is None
        found = {}
        for (symbol, way), own_anchors in anchors.items():
            if symbol in designs.given:
                continue
            program = designs.at_places[symbol]
            of_designs = program.run.designs(inside)
            names = [ANCHOR.format(symbol=angle) for angle in program.anchors]
            columns = [designs.in_rows.anchors.index(angle) for angle in program.anchors]
            near = {name: own_anchors.turns[:, at][:, None] for name, at in zip(names, columns, strict=True)}
            given = {**inside, **near}

            def probe(places: Array, symbol: str = symbol, of: Mapping[str, Array] = of_designs,
                      given: Mapping[str, Array] = given) -> Array:  # fmt: skip
                out = designs.at_places[symbol].run.both(of, given={**given, **designs.driven(places)})
                return np.broadcast_to(out[symbol], places.shape)

            found[symbol, way] = refined(way, own_anchors, stretches, (low, high), moves, probe)
        return found

    def _edges(self, first: Array, last: Array, inside: Mapping[str, Array]) -> tuple[Array, Array]:
        run = self.designs.closing.run
        of_designs = run.designs(inside)

        def meets(places: Array) -> Mask:
            out = run.both(of_designs, given={**inside, **self.designs.driven(places)})
            return np.broadcast_to(np.asarray(out[INSIDE], bool), places.shape)

        return edges_of(first, last, self.designs.rows, meets)


class _Block:
    """Some designs over all rows: who is alive, and of these what the rows say."""

    def __init__(
        self, motion: Motion, inside: Mapping[str, Array], of_designs: Mapping[str, Array], part: slice
    ) -> None:
        self.designs = designs = motion.designs
        self.count = part.stop - part.start
        self._given = {symbol: column[part] for symbol, column in inside.items()}
        known = {name: column[part] for name, column in of_designs.items()}
        self._out = designs.in_rows.run.both(designs.of_rows, known, given={**self._given, **designs.row_given})
        there = np.broadcast_to(np.asarray(self._out[THERE], bool), (self.count, designs.rows))
        self.closes: Mask = np.asarray(there.all(axis=1), bool)
        self.alive: Mask = np.ones(self.count, bool)
        others = designs.questions.others
        for number, condition in enumerate(others):
            if condition.kind == "closes":
                motion.failed[number] += self._keep(self.closes != condition.other)
        if not self.alive.any():
            return
        stretches = stretches_of(there, self.closes)
        columns = {symbol: self._column(symbol) for symbol in designs.wanted}
        whole = designs.whole(columns, self.count)
        best = {key: best_rows(key[1], columns[key[0]], stretches) for key in motion.extremes}
        for number, condition in enumerate(others):
            if condition.kind == "crank":
                motion.failed[number] += self._keep(self._turns(condition, columns, whole) != condition.other)
            for bound in motion._bounds.get(number, ()):
                motion.failed[number] += self._keep(bound.met(best, part))
        designs_left = np.flatnonzero(self.alive)
        self.stretches = stretches.taken(designs_left)
        angles = [self._whole(self._out[ANCHOR.format(symbol=symbol)]) for symbol in designs.in_rows.anchors]
        ends = designs.mechanism.driver.law is None
        self.anchors = {
            (symbol, way): anchors_of(
                columns[symbol], designs_left, best[symbol, way], self.stretches, whole[designs_left],
                math.pi if designs.is_angle(symbol) else math.inf, ends, angles,
            )
            for symbol, way in motion.extremes
        }  # fmt: skip
        self.taken = {
            quantity.name: taken(quantity.take, columns[quantity.of][designs_left], self.stretches)
            for quantity in designs.questions.quantities
            if not quantity.ways
        }

    def _keep(self, fine: Mask) -> int:
        """Rule out those that are not fine; how many more these are."""
        before = np.count_nonzero(self.alive)
        self.alive &= fine
        return int(before - np.count_nonzero(self.alive))

    def _whole(self, column: Array) -> Array:
        return np.broadcast_to(column, (self.count, self.designs.rows))

    def _column(self, symbol: str) -> Array:
        given = self.designs.given
        return self._whole(given[symbol][None, :] if symbol in given else self._out[symbol])

    def _turns(self, condition: Condition, columns: Mapping[str, Array], whole: Array) -> Mask:
        """Whether a link goes on turning while the driver does whole turns."""
        designs = self.designs
        fine = self.alive & self.closes & (whole > 0)
        symbol = designs.cranks[condition.name]
        if symbol != designs.mechanism.driver.symbol:
            fine &= np.abs(columns[symbol][:, -1] - columns[symbol][:, 0]) > math.pi
        if not fine.any():
            return fine
        tolerance = np.broadcast_to(self._out[designs.equations.tolerance], (self.count, 1))[fine, 0]
        own = {name: column[fine] for name, column in self._given.items()}
        run = designs.closing.run
        of_designs = run.designs(own)
        closed = np.ones(np.count_nonzero(fine), bool)
        for key in designs.in_rows.margins:

            def margin(places: Array, key: str = key) -> Array:
                return np.broadcast_to(run.both(of_designs, given={**own, **designs.driven(places)})[key], places.shape)

            closed &= least_between(self._whole(self._out[key])[fine], margin) >= -tolerance
        fine[fine] = closed
        return fine


# --- bounds --------------------------------------------------------------------------------------------------------------


class _Bound:
    """What a condition asks of one extreme that its rows can only fall short of."""

    def __init__(self, quantity: Quantity, operator: str, limit: Array) -> None:
        self.quantity, self.operator, self.limit = quantity, operator, limit

    def met(self, best: Mapping[Extreme, tuple[NDArray[np.intp], Array]], part: slice) -> Mask:
        """Whether the rows still allow it."""
        quantity = self.quantity
        values = [best[quantity.of, "min" if way == "min" else "max"][1] for way in quantity.ways]
        number = (values[1] - values[0] if len(values) == 2 else values[0]) * quantity.factor
        return np.asarray(np.isfinite(number) & _COMPARED[self.operator](number, self.limit[part]))


def _bounds(designs: Designs, known: Mapping[str, Array]) -> dict[int, list[_Bound]]:
    """Bounds by the number of their condition."""
    quantities = {quantity.name: quantity for quantity in designs.questions.quantities}
    count = len(next(iter(known[symbol] for symbol in designs.varied)))
    found: dict[int, list[_Bound]] = {}

    def add(number: int, side: Node, operator: str, other: Node) -> None:
        match side:
            case Symbol(name) if name in quantities and not set(symbols(other)) & quantities.keys():
                falls = quantities[name].take == "min"
                if quantities[name].ways and operator.startswith(">" if falls else "<"):
                    limit = np.broadcast_to(np.asarray(value(other, known), float), (count,))
                    found.setdefault(number, []).append(_Bound(quantities[name], operator, limit))

    for number, condition in enumerate(designs.questions.others):
        if condition.kind == "compare" and not condition.other:
            for left, operator, right in zip(condition.sides, condition.operators, condition.sides[1:], strict=False):
                add(number, left, operator, right)
                add(number, right, _TURNED[operator], left)
    return found


def taken(take: str, column: Array, stretches: Stretches) -> Array:
    """The mean of the rows that exist, or the value of the first or the last of them."""
    designs = np.arange(len(column))
    if take == "first":
        return np.asarray(column[designs, stretches.first - 1])
    if take == "last":
        return np.asarray(column[designs, stretches.last_row - 1])
    return np.asarray(np.where(stretches.there, column, 0.0).sum(axis=1) / np.maximum(stretches.count, 1))
