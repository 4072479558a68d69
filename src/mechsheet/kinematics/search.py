"""What a motion does between the first and the last value of its driver, searched: where it closes, what is extreme.

The equations as mathematics (`sweep`) at many places between the rows, then halving and narrowing around what was found.
No formula of a sheet is read: the verdicts of the first sheet are held against this. Places `u` count rows from 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Call, Direction, Node
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.driving import at_values, given_between, step_of
from mechsheet.kinematics.equations import Condition, Equations
from mechsheet.kinematics.numeric import Array, runs_of, value
from mechsheet.kinematics.sweep import sweep
from mechsheet.kinematics.whole_turns import LEAST_OF_TURN, SAME_AGAIN, rows_count_alike
from mechsheet.model import Mechanism

FINE = 20
"""Places looked at between two rows, where that makes no more than `MOST`."""

MOST = 40_000
TURN = 2 * math.pi
HALVINGS = 45
NARROWINGS = 6
BASINS = 5
"""So many of the best places of the grid are looked at closer."""

NEARLY = 1e-9
"""A margin that dips to less than this part of the size may close there or not: nothing is said of it."""

WITHIN = 1e-7
"""So far from an edge [rows] a quantity has its own sign: what goes to 0 there as a root does is no rounding any more."""

LEAPT = 1e3
"""A value at an edge, of the other sign, that is so many times the one within is a number divided by rounding."""

Change = Callable[[Array], Array]
Mask = NDArray[np.bool_]
Extremes = tuple[float, float, float, float]
"""(least, where, largest, where)"""


def edges(places: Array, there: Mask, exists: Callable[[Array], Mask], halvings: int) -> Array:
    """Places where it begins or stops closing, on the side where it closes: between two of `places`, by halving; four times
    at once, as many places together take little longer than one.

    there  at which of them it closes;  exists  the same of any places
    """
    changes = np.flatnonzero(there[1:] != there[:-1])
    low, high, state = places[changes], places[changes + 1], there[changes]
    each = np.arange(len(changes))
    for _ in range(-(-halvings // 4) if len(changes) else 0):
        steps = low[:, None] + (high - low)[:, None] * np.arange(17) / 16
        same = exists(steps[:, 1:-1].ravel()).reshape(-1, 15) == state[:, None]
        last = np.where(same.all(axis=1), 15, np.argmin(same, axis=1))
        low, high = steps[each, last], steps[each, last + 1]
    return np.where(state, low, high)


class Search:
    """The motion with the dimensions of `mechanism` and the assemblies of `equations`.

    given    of every row the driver's value [rad or length unit], and what is given beside it (`given_values`)
    stepped  False where the values are listed, or each row follows from the row above: there is nothing between the rows
    u, at    the places looked at, and every symbol's values there;  there  where it closes
    last     the last place: the last row, or one more where that would be the first row again and all rows close
    dips     places off the grid where it does not close, between some where it does, to a part of the grid's distance where
             lines turn parallel;  peeps  the other way round
    doubt    places where it nearly comes apart, or where lines turn parallel or pins coincide between two places
    """

    def __init__(self, mechanism: Mechanism, equations: Equations, given: Mapping[str, Array]) -> None:
        from_row_to_row = any(group.system for group in equations.groups)
        self._listed = bool(mechanism.driver.values)
        self._alike = rows_count_alike(mechanism, given[mechanism.driver.symbol], bool(equations.tied))
        stepped = not (self._listed or from_row_to_row)
        if from_row_to_row:
            mechanism = replace(mechanism, driver=at_values(mechanism.driver, given[mechanism.driver.symbol]))
        self.mechanism = mechanism
        self.equations = equations
        self.given = given
        driver = given[mechanism.driver.symbol]
        self.rows = len(driver)
        self.stepped = stepped and self.rows > 1
        self.step = step_of(driver) if self.stepped else 0.0
        self.dimensions = dimension_values(mechanism)
        self.size = largest_length(mechanism, self.dimensions) or 1.0
        self.fine = max(1, min(FINE, MOST // self.rows)) if self.stepped else 1
        self.last = self.rows
        self._look()
        self.row_there = self.there[:: self.fine]
        if self._one_row_more and self.row_there.all():
            self.last += 1
            self._look()
        self._known_extremes: dict[tuple[str, bool], Extremes | None] = {}
        self._known_behind: dict[str, Equations] = {}
        self.edges = edges(self.u, self.there, lambda u: self.exists(self.known(u)), HALVINGS if self.stepped else 0)
        self.dips: list[float] = []
        self.peeps: list[float] = []
        self.doubt: list[float] = []
        if self.stepped:
            self._margins()
            self._crossings()

    # --- places --------------------------------------------------------------------------------------------------------

    def _look(self) -> None:
        self.u = 1 + np.arange((self.last - 1) * self.fine + 1) / self.fine
        self.at = self.known(self.u)
        self.there = self.exists(self.at)

    def in_rows(self, symbol: str) -> Array:
        """A symbol's values in the rows."""
        return self.at[symbol][:: self.fine][: self.rows]

    def driver(self, u: Array | float) -> Array:
        """The driver's value at places."""
        return self._given(u)[self.mechanism.driver.symbol]

    def _given(self, u: Array | float) -> dict[str, Array]:
        """The same, and what is given beside it."""
        places = np.asarray(u, float)
        if not self.stepped:
            rows = np.rint(places - 1).astype(int)
            return {name: np.asarray(column[rows]) for name, column in self.given.items()}
        return given_between(self.mechanism, self.dimensions, self.given, places)

    def known(self, u: Array, symbol: str = "") -> dict[str, Array]:
        """Every symbol's values at places; with a symbol only its own, what it follows from, and whether every group closes.

        What gears and racks drive depends on how often a link has turned round: that is counted from place to place of the
        grid, never from one of a few scattered places to the next.
        """
        equations = self._behind(symbol) if symbol else self.equations
        with np.errstate(all="ignore"):
            if not self._counts_turns or u is self.u:
                return sweep(self.mechanism, equations, self._given(u))
            places = np.concatenate((self.u, u))
            order = np.argsort(places, kind="stable")
            found = sweep(self.mechanism, equations, self._given(places[order]))
            back = np.argsort(order)[len(self.u) :]
            return {name: column[back] for name, column in found.items()}

    def _behind(self, symbol: str) -> Equations:
        """The equations that say a symbol, and whether every group closes: no rates and forces that nobody asks for."""
        if symbol not in self._known_behind:
            behind = {
                each.symbol
                for each in self.equations.behind([symbol, *(each.closes for each in self.equations.groups)])
            }
            columns = tuple(each for each in self.equations.columns if each.symbol in behind)
            self._known_behind[symbol] = replace(self.equations, columns=columns)
        return self._known_behind[symbol]

    @cached_property
    def _counts_turns(self) -> bool:
        """Whether anything that gears or racks decide follows from an angle that goes on without a jump."""
        behind = self.equations.behind(self.equations.tied)
        return self.stepped and any(isinstance(each.expression, Direction) for each in behind)

    def exists(self, known: dict[str, Array]) -> Mask:
        """Where every group closes."""
        return self.equations.closed(known)

    def _narrow(self, function: Change, places: Array) -> tuple[Array, Array]:
        """Around each place, up to the next of the grid, the one with the least value of the function; and that value."""
        best, half = np.asarray(places, float), np.full(len(places), 1.0 / self.fine)
        offsets = np.linspace(-1, 1, 9)
        least = np.full(len(best), math.inf)
        for _ in range(NARROWINGS if len(best) else 0):
            u = np.clip(best[:, None] + half[:, None] * offsets, 1, self.last)
            found = function(u.ravel()).reshape(u.shape)
            found = np.where(np.isnan(found), np.inf, found)
            best, half = u[np.arange(len(u)), np.argmin(found, axis=1)], half / 3.5
            least = np.min(found, axis=1)
        return best, least

    def _values(self, node: Node, known: dict[str, Array], count: int) -> Array:
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(value(node, known), float), (count,))

    def _conditions(self, reach: bool) -> list[Condition]:
        """What must hold in a row: that links reach each other (of each group the first), or the other conditions."""
        found: dict[object, Condition] = {}
        for equation in self.equations.positions.columns:  # a dead centre, or a cam's straight piece, leaves it closed
            for condition in equation.exists:
                if condition.reach == reach:
                    found.setdefault(equation.group if reach else condition.margin, condition)
        return list(found.values())

    def _margins(self) -> None:
        """Between two places of the grid a group may come apart and close again, or the other way round."""
        for condition in self._conditions(reach=True):
            margin = self._values(condition.margin, self.at, len(self.u))
            for sign, found in ((1.0, self.dips), (-1.0, self.peeps)):
                v = sign * margin
                low = (v[1:-1] <= v[:-2]) & (v[1:-1] <= v[2:]) & (v[1:-1] < 0.2 * self.size) & (v[1:-1] >= 0)

                def of(u: Array, sign: float = sign, margin: Node = condition.margin) -> Array:
                    return sign * self._values(margin, self.known(u), len(u))

                places, least = self._narrow(of, self.u[np.flatnonzero(low) + 1])
                self.doubt += list(places[np.abs(least) < NEARLY * self.size])
                found += list(places[least <= -NEARLY * self.size])

    def _crossings(self) -> None:
        """Lines that turn parallel, pins that coincide, between two places of the grid."""
        for condition in self._conditions(reach=False):
            if isinstance(condition.margin, Call) and condition.margin.name == "ABS":
                self._parallel(condition.margin.args[0])
            c = self._values(condition.margin, self.at, len(self.u))
            inner = np.flatnonzero((c[1:-1] <= c[:-2]) & (c[1:-1] <= c[2:])) + 1
            if not len(inner) or np.ptp(c[np.isfinite(c)]) == 0:
                continue

            def near(u: Array, margin: Node = condition.margin) -> Array:
                return self._values(margin, self.known(u), len(u))

            order = np.argsort(c[inner])[: 4 * BASINS]
            places, least = self._narrow(near, self.u[inner[order]])
            self.doubt += list(places[least < 1e-4 * np.nanmax(c)])

    def _parallel(self, sine: Node) -> None:
        """Where the sine of the angle between two lines changes its sign they meet nowhere."""
        s = self._values(sine, self.at, len(self.u))
        changes = np.flatnonzero(self.there[1:] & self.there[:-1] & (s[1:] * s[:-1] < 0))
        share = s[changes] / (s[changes] - s[changes + 1])
        self.dips += list(self.u[changes] + share * (self.u[changes + 1] - self.u[changes]))

    # --- where it closes -------------------------------------------------------------------------------------------------

    @property
    def count(self) -> int:
        """Rows that close."""
        return int(self.row_there.sum())

    @property
    def row_stretches(self) -> list[tuple[int, int]]:
        """(first row, last row) of each stretch of rows that close, from 1."""
        return [(first + 1, end) for first, end in runs_of(self.row_there)]

    def _between_closed(self, u: float) -> bool:
        low, high = math.floor(u) - 1, min(self.last, math.ceil(u)) - 1
        return bool(self.row_there[low % self.rows] and self.row_there[high % self.rows])

    @cached_property
    def holes(self) -> list[float]:
        """Places between two neighbouring rows that close, where it does not; none where nothing is between the rows."""
        if not self.stepped:
            return []
        return [float(u) for u in (*self.dips, *self.edges) if self._between_closed(float(u))]

    def limits(self) -> list[tuple[int, list[float]]]:
        """(row before, possible places) for each change between neighbouring rows."""
        rows = map(int, np.flatnonzero(self.row_there[1:] != self.row_there[:-1]) + 1)
        return [(row, self.edges_between(row, row + 1)) for row in rows]

    def edges_between(self, row: float, other: float) -> list[float]:
        """Edges between two rows."""
        low, high = min(row, other) - 1e-9, max(row, other) + 1e-9
        return [float(edge) for edge in self.edges if low <= edge <= high]

    @property
    def whole(self) -> bool:
        """Whether the driver covers whole turns: its last value is its first again, or the next one would be."""
        if not self.mechanism.driver.link or not self.stepped or self.rows < LEAST_OF_TURN:
            return False
        covered = abs(self.step) * (self.rows - 1) / TURN
        if self.equations.tied:  # what gears turn is not back with every turn of the driver
            return abs(round(covered) - covered) < 1e-9 and round(covered) > 0 and self._ties_are_back()
        return self._one_row_more or (abs(round(covered) - covered) < 1e-9 and round(covered) > 0)

    @property
    def _one_row_more(self) -> bool:
        """Whether one row more would be the first again."""
        return self.stepped and self._alike

    @cached_property
    def counts_alike(self) -> bool:
        """Whether all rows count alike in a mean (`rows_count_alike`)."""
        return self._alike and bool(self._listed or self.row_there.all())

    def _ties_are_back(self) -> bool:
        """Whether what gears and further drivers decide is after the last row what it was in the first."""
        for symbol in self.equations.tied:
            way = float(self.at[symbol][-1] - self.at[symbol][0])
            left = way / TURN - round(way / TURN) if self.is_angle(symbol) else way / self.size
            if not abs(left) < 1e-9:
                return False
        return True

    @property
    def closes_everywhere(self) -> bool:
        """Whether it closes between the rows too."""
        return bool(self.there.all()) and not self.dips

    @property
    def doubtful(self) -> bool:
        """Whether it nearly comes apart somewhere: then little is sure."""
        return bool(self.doubt)

    # --- quantities ------------------------------------------------------------------------------------------------------

    def extremes(self, symbol: str, of: Change | None = None, rows_only: bool = False) -> Extremes | None:
        """(least, where, largest, where) of a quantity over all that exists; None where it is nowhere a number."""
        if of is not None:
            return self._extremes(symbol, of, rows_only)
        if (symbol, rows_only) not in self._known_extremes:
            self._known_extremes[symbol, rows_only] = self._extremes(symbol, lambda column: column, rows_only)
        return self._known_extremes[symbol, rows_only]

    def _extremes(self, symbol: str, change: Change, rows_only: bool) -> Extremes | None:
        column = np.asarray(change(self.at[symbol]), float)
        shown = self._of_rows()
        back = self.last == self.rows or abs(column[-1] - column[0]) <= SAME_AGAIN * np.ptp(column)
        last = self.last if back else self.rows  # what does not come back with the mechanism has ends
        shown &= self.u <= last
        if rows_only:
            shown = shown & (np.arange(len(self.u)) % self.fine == 0)
        found: list[float] = []
        for sign in (1.0, -1.0):
            v = np.where(shown & np.isfinite(column), sign * column, np.inf)
            if not np.isfinite(v).any():
                return None
            padded = np.concatenate(([np.inf], v, [np.inf]))
            low = np.flatnonzero(np.isfinite(v) & (v <= padded[:-2]) & (v <= padded[2:]))
            low = low[np.argsort(v[low])][:BASINS]
            best, where = float(v[low[0]]), float(self.u[low[0]])
            if self.stepped and not rows_only:
                closer, place = self._closer(symbol, change, column, sign, self.u[low], shown, last)
                best, where = (closer, place) if closer < best else (best, where)
            found += [sign * best, where]
        return found[0], found[1], found[2], found[3]

    def _closer(
        self, symbol: str, change: Change, column: Array, sign: float, starts: Array, shown: Mask, end: int
    ) -> tuple[float, float]:
        """The least value (with a sign) between the places of the grid, up to the row `end`, at the edges of what is shown,
        and where pieces of the motion meet; its place."""
        held, turns = self._held(column), self.is_angle(symbol)

        def near(u: Array) -> Array:
            known = self.known(u, symbol)
            raw = np.asarray(change(known[symbol]), float)
            if turns:  # near the nearest place that exists
                nearest = held[np.clip(np.rint((u - 1) * self.fine).astype(int), 0, len(self.u) - 1)]
                raw = raw - TURN * np.round((raw - nearest) / TURN)
            return np.where(self.exists(known) & (u <= end), sign * raw, np.nan)

        places, values = self._narrow(near, starts)
        if len(self._seams):
            places = np.concatenate((places, self._seams))
            values = np.concatenate((values, np.nan_to_num(near(self._seams), nan=np.inf)))
        last = len(shown) - 1
        beside = [
            edge for edge in self.edges
            if shown[max(0, math.ceil((edge - 1) * self.fine) - 1)]
            or shown[min(last, math.floor((edge - 1) * self.fine) + 1)]
        ]  # fmt: skip
        if beside:
            places = np.concatenate((places, beside))
            values = np.concatenate((values, np.nan_to_num(self._at_edges(near, np.array(beside)), nan=np.inf)))
        pick = int(np.argmin(values))
        return float(values[pick]), float(places[pick])

    @cached_property
    def _seams(self) -> Array:
        """Places where pieces of the driver's motion meet: what follows from it need not turn back there to be extreme."""
        if not self.stepped or not self.mechanism.seams:
            return np.zeros(0)
        angles = np.array([float(value(each, self.dimensions)) for each in self.mechanism.seams])
        ahead = (angles - float(self.driver(1))) * math.copysign(1.0, self.step) % TURN
        places = 1 + ahead / abs(self.step)
        return np.asarray(places[places <= self.last])

    @staticmethod
    def _at_edges(near: Change, edges: Array) -> Array:
        """The values at edges. Where a denominator goes to 0 there, its sign is that of rounding: then the values just
        within, which have the quantity's own."""
        at, before, after = near(edges), near(np.maximum(edges - WITHIN, 1)), near(edges + WITHIN)
        within = np.where(np.isnan(before), after, before)
        return np.where((at * within < 0) & (np.abs(at) > LEAPT * np.abs(within)), within, at)

    def _of_rows(self) -> Mask:
        """The places in stretches with a row: what closes only between two rows that do not is not spoken of."""
        found = np.zeros(len(self.u), dtype=bool)
        for begin, end in runs_of(self.there):
            if -(-begin // self.fine) * self.fine < end:
                found[begin:end] = True
        return found

    def is_angle(self, symbol: str) -> bool:
        """Whether a quantity is an angle that is known up to whole turns."""
        if symbol == self.mechanism.driver.symbol:
            return False
        return self.equations.is_angle(self.mechanism, symbol)

    def _held(self, column: Array) -> Array:
        """The column with the nearest value before it, or the first, in places that do not exist."""
        good = np.flatnonzero(np.isfinite(column) & self.there)
        return column[good[np.clip(np.searchsorted(good, np.arange(len(column)), side="right") - 1, 0, len(good) - 1)]]

    def turns_between_rows(self) -> dict[str, Array]:
        """By how much each link's angle differs between neighbouring rows."""
        found = {}
        for link in self.mechanism.links[1:]:
            symbol = link.angle_symbol
            known = (self.mechanism.driver.symbol, *self.equations.tied)
            if symbol not in known and self.equations.of(symbol).reads:
                found[symbol] = np.abs(np.diff(self.in_rows(symbol)))
        return found

    def is_crank(self, symbol: str) -> bool:
        """Whether a link turns on and on while the driver does whole turns."""
        return self.whole and self.closes_everywhere and abs(self.at[symbol][-1] - self.at[symbol][0]) > math.pi
