"""The motion of many designs: block by block over the rows, then, of those that the rows have not ruled out, between them.

What a row shows bounds an extreme: a smallest transmission angle of 30 degrees in some row cannot be above 40. So most
designs are ruled out before anybody looks between the rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Call, Node, Symbol, symbols
from mechsheet.kinematics.numeric import OPERATORS, Array, value
from mechsheet.kinematics.whole_turns import mean_of_motion
from mechsheet.model import WAYS, Condition, Take
from mechsheet.sheet.checks.boundless import BEYOND_ROWS
from mechsheet.sheet.checks.search_rules import ONLY_ROWS, SPIKES, least_margin
from mechsheet.sheet.transmission import acute
from mechsheet.studies.designs import DIVISOR, Called, Designs
from mechsheet.studies.extremes import (
    BEYOND,
    BOUNDLESS,
    ROWS_ONLY,
    SEVERAL,
    Anchors,
    Codes,
    Rows,
    Stretches,
    Way,
    anchors_of,
    best_rows,
    edges_of,
    joined,
    least_gap,
    refined,
    stretches_of,
)
from mechsheet.studies.lowering import ANCHOR, THERE
from mechsheet.studies.questions import Quantity

BLOCK = 65_536
"""Numbers in an array of a block of designs: with a quarter of it 25 rows take a fifth longer, 361 rows twice as long."""

Mask = NDArray[np.bool_]
Extreme = tuple[str, Way]
Found = tuple[NDArray[np.intp], Array]

_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}


class Motion:
    """The motion of some designs.

    alive       which of them the rows have not ruled out;  failed: how many each of `Questions.others` has
    quantities  of those alive: summaries and extremes, in the units shown, NaN where there is none
    remarks     what the workbook says of them, as codes (`remarks`)
    """

    def __init__(self, designs: Designs, inside: Mapping[str, Array], known: Mapping[str, Array]) -> None:
        self.designs = designs
        quantities = designs.questions.quantities
        extremes = [(quantity.of, way) for quantity in quantities for way in quantity.ways]
        extremes += [(group.transmission, way) for group in designs.spiking for way in WAYS.values()]
        self.extremes: tuple[Extreme, ...] = tuple(dict.fromkeys(extremes))
        self.failed = np.zeros(len(designs.questions.others), np.int64)
        self.alive: Mask = np.ones(len(next(iter(inside.values()))), bool)
        with np.errstate(all="ignore"):
            if designs.questions.others:
                self._rule_out(inside, _bounds(designs, known))
            left = {symbol: column[self.alive] for symbol, column in inside.items()}
            self.quantities = {each.name: np.zeros(0) for each in quantities}
            self.remarks: dict[str, Codes] = {each.name: np.zeros(0, np.int8) for each in quantities}
            if self.alive.any():
                self._find(left)

    def _rule_out(self, inside: Mapping[str, Array], bounds: Mapping[int, list[_Bound]]) -> None:
        """What rows alone decide, from the columns that this needs."""
        for part, rows in _blocks(self.designs, self.designs.ruling, inside, len(self.alive)):
            alive: Mask = np.ones(rows.count, bool)
            best: dict[Extreme, Found] = {}
            for number, condition in enumerate(self.designs.questions.others):
                before = np.count_nonzero(alive)
                if condition.kind == "closes":
                    alive &= rows.closes != condition.other
                elif condition.kind == "crank":
                    alive &= rows.turns(condition, alive) != condition.other
                for bound in bounds.get(number, ()):
                    alive &= bound.met(rows, best, part, alive)
                self.failed[number] += before - np.count_nonzero(alive)
            self.alive[part] = alive

    # --- between the rows -------------------------------------------------------------------------------------------------

    def _find(self, inside: Mapping[str, Array]) -> None:
        """The quantities and what is said of them."""
        designs = self.designs
        count = len(next(iter(inside.values())))
        parts: list[Stretches] = []
        found_anchors: dict[Extreme, list[Anchors]] = {key: [] for key in self.extremes}
        of_rows: dict[str, list[Array]] = {}
        for _, rows in _blocks(designs, designs.in_rows, inside, count):
            parts.append(rows.stretches)
            for key in self.extremes:
                found_anchors[key].append(rows.anchors(key))
            for quantity in designs.questions.quantities:
                if not quantity.ways:
                    of_rows.setdefault(quantity.name, []).append(taken(quantity.take, rows.column(quantity.of), rows))
        stretches = joined(parts)
        anchors = {key: joined(each) for key, each in found_anchors.items()}
        found = {key: each.of_rows for key, each in anchors.items()}
        known = dict(found)
        doubts: dict[Extreme, Codes] = {}
        low, high, only_rows = self._edges(stretches, inside)
        if not designs.rows_only:
            corners = designs.corners(inside, next(iter(anchors.values())).whole) if anchors else []
            for (symbol, way), own in anchors.items():
                if symbol not in designs.given:
                    probe = self._probe(symbol, own, inside)
                    key = (symbol, way)
                    found[key], doubts[key], known[key] = refined(
                        way, own, stretches, (low, high), only_rows, probe, corners
                    )
        spikes = self._spikes(anchors, found, count)
        for quantity in designs.questions.quantities:
            if quantity.ways:
                number = _of_extremes(quantity, {way: found[quantity.of, way] for way in quantity.ways})
            else:
                number = np.concatenate(of_rows[quantity.name])
            without = self._without_bound(quantity, anchors, known, found, stretches)
            several = (stretches.number > 1) & designs.equations.range_has_gaps(quantity.of, quantity.take)
            fine = (stretches.count > 0) & np.isfinite(number) & ~without & ~several
            self.quantities[quantity.name] = np.where(fine, number * quantity.factor, np.nan)
            said = np.zeros(count, np.int8)
            for way in quantity.ways:
                said = np.maximum(said, doubts.get((quantity.of, way), said))
            if quantity.ways and quantity.of in designs.spiky:
                said[spikes] = BEYOND
            said[without] = BOUNDLESS
            if quantity.ways and quantity.of != designs.mechanism.driver.symbol:
                said[only_rows] = ROWS_ONLY
            said[several] = SEVERAL
            self.remarks[quantity.name] = said

    def _spikes(self, anchors: Mapping[Extreme, Anchors], found: Mapping[Extreme, Array], count: int) -> Mask:
        """Where a group comes much nearer to a dead centre between the rows than in them."""
        spikes = np.zeros(count, bool)
        for group in self.designs.spiking:
            low, high = ((group.transmission, way) for way in WAYS.values())
            angle = Call("MIN", acute(Symbol("low"), Symbol("high"), group.kind != "RRR"))
            between = value(angle, {"low": found[low], "high": found[high]})
            of_rows = value(angle, {"low": anchors[low].of_rows, "high": anchors[high].of_rows})
            spikes |= value(SPIKES, {"found": between, "of_rows": of_rows})
        return spikes

    def _without_bound(
        self,
        quantity: Quantity,
        anchors: Mapping[Extreme, Anchors],
        of_rows: Mapping[Extreme, Array],
        found: Mapping[Extreme, Array],
        stretches: Stretches,
    ) -> Mask:
        """Whether a quantity has no smallest or no largest value; `of_rows`: the best of rows and corners."""
        designs = self.designs
        without = np.zeros(len(stretches.count), bool)
        if quantity.of not in designs.may_grow:
            return without
        for way in quantity.ways:
            own = anchors[quantity.of, way]
            known = {"extreme": found[quantity.of, way], "of_rows": of_rows[quantity.of, way], "other": own.other}
            without |= value(BEYOND_ROWS, known | {"first": stretches.first, "last": stretches.last})
            without |= own.pole
        return without & (stretches.count > 0)

    def _edges(self, stretches: Stretches, inside: Mapping[str, Array]) -> tuple[Array, Array, Mask]:
        """Where stretches begin and end between rows, and of which designs nothing is known there."""
        designs = self.designs
        low, high = stretches.first.astype(float), stretches.last.astype(float)
        unsettled = designs.unprobed & (stretches.count < designs.rows)
        part = (stretches.number == 1) & (stretches.count < designs.rows)
        if designs.limits and not designs.rows_only and part.any():
            closing = designs.closing
            at_places = _at_places(designs, closing, {symbol: column[part] for symbol, column in inside.items()})
            least = least_margin([Symbol(key) for key in closing.margins])
            found = edges_of(low[part], high[part], designs.rows, lambda places: value(least, at_places(places)))
            low[part], high[part], unsettled[part] = found
        known = {
            "stretches": stretches.number,
            "first": stretches.first,
            "last": stretches.last,
            "unsettled": unsettled,
        }
        only_rows = value(ONLY_ROWS, known) | designs.between_unseen
        return low, high, np.asarray(only_rows & (stretches.count > 0), bool)

    def _probe(self, symbol: str, anchors: Anchors, inside: Mapping[str, Array]) -> Callable[[Array, Rows], Array]:
        """A quantity at a place of each design, and angles near what they are in a row."""
        designs = self.designs
        program = designs.at_places[symbol]
        columns = {ANCHOR.format(symbol=angle): designs.in_rows.anchors.index(angle) for angle in program.anchors}
        designs_ = np.arange(len(anchors.here))

        def probe(places: Array, row: Rows) -> Array:
            near = {name: anchors.angles[designs_, at, row][:, None] for name, at in columns.items()}
            return _column_of(symbol, _at_places(designs, program, {**inside, **near}))(places)

        return probe


def _at_places(designs: Designs, program: Called, given: Mapping[str, Array]) -> Callable[[Array], dict[str, Array]]:
    """A program at places of each design's own, counted in rows from 1: of places (designs, k) its columns in that shape."""
    of_designs = program.run.designs(given)

    def at_places(places: Array) -> dict[str, Array]:
        out = program.run.both(of_designs, given={**given, **designs.driven(places)})
        return {key: np.broadcast_to(column, places.shape) for key, column in out.items()}

    return at_places


def _column_of(key: str, at_places: Callable[[Array], dict[str, Array]]) -> Callable[[Array], Array]:
    """One of its columns, at a place of each design."""
    return lambda places: at_places(places[:, None])[key][:, 0]


def _blocks(
    designs: Designs, program: Called, inside: Mapping[str, Array], count: int
) -> Iterator[tuple[slice, _Rows]]:
    """Designs over all rows, so many at a time that the cache holds their arrays."""
    of_designs = program.run.designs(inside)
    size = max(1, BLOCK // designs.rows)
    for first in range(0, count, size):
        part = slice(first, min(first + size, count))
        given = {symbol: column[part] for symbol, column in inside.items()}
        yield part, _Rows(designs, program, given, {name: column[part] for name, column in of_designs.items()})


class _Rows:
    """Some designs over all rows.

    there  where they close;  closes: whether in all rows
    """

    def __init__(
        self, designs: Designs, program: Called, given: Mapping[str, Array], of_designs: Mapping[str, Array]
    ) -> None:
        self.designs, self.program, self._given = designs, program, given
        self.count = len(next(iter(given.values())))
        self._out = program.run.both(program.of_rows, of_designs, given={**given, **designs.row_given})
        self.there: Mask = np.broadcast_to(np.asarray(self._out[THERE], bool), (self.count, designs.rows))
        self.closes: Mask = np.asarray(self.there.all(axis=1), bool)

    @cached_property
    def _stretches(self) -> tuple[Stretches, Mask]:
        return stretches_of(self.there, self.closes)

    @property
    def stretches(self) -> Stretches:
        """The stretches of rows in which they close."""
        return self._stretches[0]

    @cached_property
    def _covered(self) -> Array:
        columns = {symbol: self.column(symbol) for symbol in self.designs.equations.tied}
        return self.designs.whole(columns, self.count)

    @property
    def alike(self) -> Mask:
        """Where all rows count alike in a mean: of listed values, and of a whole turn without the row that closes it."""
        if self.designs.mechanism.driver.values:
            return np.ones(self.count, bool)
        return np.asarray((self._covered == 2) & self.closes)

    def _whole(self, column: Array) -> Array:
        return np.broadcast_to(column, (self.count, self.designs.rows))

    def column(self, symbol: str) -> Array:
        """A quantity, designs by rows."""
        given = self.designs.row_given
        return self._whole(given[symbol] if symbol in given else self._out[symbol])

    def best(self, extreme: Extreme, among: Mask | None = None) -> Found:
        """The best rows of an extreme, and the values there; `among`: of what designs anybody wants to know."""
        symbol, way = extreme
        if symbol == self.designs.mechanism.driver.symbol:  # it has its values whether or not the links meet
            return best_rows(way, self.column(symbol), None)
        everywhere = among is not None and bool((self.closes | ~among).all())
        return best_rows(way, self.column(symbol), None if everywhere else self._stretches[1])

    def anchors(self, extreme: Extreme) -> Anchors:
        """What the rows say of an extreme."""
        designs = self.designs
        names = [ANCHOR.format(symbol=symbol) for symbol in self.program.anchors]
        symbol, way = extreme
        return anchors_of(
            designs.asked(symbol, way),
            self.column(symbol),
            self.best(extreme),
            self.best((symbol, "max" if way == "min" else "min"))[1],
            self.stretches,
            self._covered,
            [self._whole(self._out[name]) for name in names],
            self._whole(self._out[DIVISOR.format(symbol=symbol)]) if symbol in designs.divisors else None,
        )

    def turns(self, condition: Condition, among: Mask) -> Mask:
        """Whether a link goes on turning while the driver does whole turns; asked of some designs only."""
        designs = self.designs
        fine = among & self.closes & (self._covered > 0)
        symbol = designs.cranks[condition.name]
        if symbol != designs.mechanism.driver.symbol:
            column = self.column(symbol)
            fine &= np.abs(column[:, -1] - column[:, 0]) > math.pi
        if not fine.any():
            return fine
        tolerance = self._whole(self._out[designs.equations.tolerance])[fine, 0]
        own = {name: column[fine] for name, column in self._given.items()}
        closing = _at_places(designs, designs.closing, own)
        closed = np.ones(np.count_nonzero(fine), bool)
        for key in self.program.margins:
            margins = self._whole(self._out[key])[fine]
            closed &= least_gap(margins, _column_of(key, closing)) >= -tolerance
        fine[fine] = closed
        return fine


# --- bounds --------------------------------------------------------------------------------------------------------------


class _Bound:
    """What a condition asks of one extreme that its rows can only fall short of."""

    def __init__(self, quantity: Quantity, operator: str, limit: Array) -> None:
        self.quantity, self.operator, self.limit = quantity, operator, limit

    def met(self, rows: _Rows, best: dict[Extreme, Found], part: slice, alive: Mask) -> Mask:
        """Whether the rows of those alive still allow it; `best` keeps what was found."""
        quantity = self.quantity
        for way in quantity.ways:
            if (quantity.of, way) not in best:
                best[quantity.of, way] = rows.best((quantity.of, way), alive)
        extremes = {way: best[quantity.of, way][1] for way in quantity.ways}
        number = _of_extremes(quantity, extremes) * quantity.factor
        return np.asarray(np.isfinite(number) & OPERATORS[self.operator](number, self.limit[part]))


def _bounds(designs: Designs, known: Mapping[str, Array]) -> dict[int, list[_Bound]]:
    """Bounds by the number of their condition."""
    quantities = {quantity.name: quantity for quantity in designs.questions.quantities}
    count = len(next(iter(known[symbol] for symbol in designs.varied)))
    found: dict[int, list[_Bound]] = {}

    def add(number: int, side: Node, operator: str, other: Node) -> None:
        match side:
            case Symbol(name) if name in quantities and not set(symbols(other)) & quantities.keys():
                falls = quantities[name].ways == ("min",)
                if quantities[name].ways and operator.startswith(">" if falls else "<"):
                    limit = np.broadcast_to(np.asarray(value(other, known), float), (count,))
                    found.setdefault(number, []).append(_Bound(quantities[name], operator, limit))

    for number, condition in enumerate(designs.questions.others):
        if condition.kind == "compare" and not condition.other:
            for left, operator, right in zip(condition.sides, condition.operators, condition.sides[1:], strict=False):
                add(number, left, operator, right)
                add(number, right, _TURNED[operator], left)
    return found


def _of_extremes(quantity: Quantity, extremes: Mapping[Way, Array]) -> Array:
    """A quantity from the smallest and the largest values of designs."""
    return np.asarray(
        value(quantity.take.value, {part: extremes[way] for part, way in WAYS.items() if way in extremes})
    )


def taken(take: Take, column: Array, rows: _Rows) -> Array:
    """A take of what the rows of designs alone decide: the first or the last value that exists, the mean over the motion."""
    designs, stretches = np.arange(len(column)), rows.stretches
    parts: dict[str, Callable[[], Array]] = {
        "first": lambda: np.asarray(column[designs, stretches.first - 1]),
        "last": lambda: np.asarray(column[designs, stretches.last_row - 1]),
        "mean": lambda: mean_of_motion(np.asarray(value(take.row(Symbol("x")), {"x": column})), rows.there, rows.alike),
    }
    return np.asarray(value(take.value, {part: parts[part]() for part in take.parts}))
