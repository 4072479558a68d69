"""By how much links swing and slides travel, and how the times of the two ways compare."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from livesheet.formula.nodes import Boolean, Node, Symbol, Text
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.search import TURN
from mechsheet.model import Way
from mechsheet.sheet.checks.extremes import about, about_turns, where_bounded
from mechsheet.sheet.findings.finding import Finding, Line
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import EXACT, Expected, SearchedMotion
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import turn as whole_turn
from mechsheet.words.symbols import plain

HIGH_LOW: tuple[Way, Way] = ("max", "min")

FLAT = 1e-4
"""So much of its range an extreme may be off: where it is flat, its place is less sure than its value."""


class _Extent(Finding):
    """How far a quantity goes: of one stretch; #N/A of several, which the mechanism cannot pass between."""

    kind: str

    def __init__(self, symbol: str) -> None:
        self.symbol = symbol
        self.key = f"{self.kind}_{symbol}"

    def _range(self, on: Reading) -> Node:
        high, low = (on.found.extremes[way, self.symbol].value.cell for way in HIGH_LOW)
        return where_bounded(on.plan, self.symbol, formula("high-low", high=high, low=low))

    def _line(self, on: Reading, unit: str, value: Node, digits: int, words: Node) -> Line:
        node = formula("IF(stretches<>1,NA(),IFERROR(value,NA()))", stretches=on.found.count.cell, value=value)
        said = formula(
            'IF(stretches=0,"",IF(stretches>1,several,IF(leaps>0,unsure,words&about)))', words=words,
            stretches=on.found.count.cell, leaps=on.plan.places.leaps.cell,
            about=about(on.plan, self.symbol), several=on.text("swing.several"), unsure=on.text("unsure"),
        )  # fmt: skip
        return Line(rich(self.symbol), node, said, unit, digits)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        search = motion.search
        found = self._extent(motion, motion.says(self.key, "rows.only"))
        if not found and len(search.row_stretches) == 1:
            return {}
        if found and not motion.sure:
            return {}
        found = motion.as_far(self.key, found, self._extent(motion, rows_only=True))
        least = 1e-8 * (motion.scale(self.symbol) if search.is_angle(self.symbol) else search.size)
        return {self.key: Expected(found, motion.part(self.key) * max(found, default=0.0) + least)}

    def _extent(self, motion: SearchedMotion, rows_only: bool) -> list[float]:
        """Of one stretch, or of its rows; of several there is none."""
        search, symbol = motion.search, self.symbol
        extremes = search.extremes(symbol, rows_only=rows_only) if len(search.row_stretches) == 1 else None
        if extremes is None:
            return []
        whole = search.is_angle(symbol) and search.is_crank(symbol)
        return [(TURN if whole else extremes[2] - extremes[0]) * motion.scale(symbol)]


class Swing(_Extent):
    """By how much a link turns, and whether it is a crank or a rocker."""

    kind = "swing"

    def line(self, on: Reading) -> Line:
        turn = whole_turn(on.plan.at.spots[self.symbol].degrees)
        closed = formula("AND(whole>0,count=rows)", whole=on.found.whole.cell, count=on.value("rows_closed"),
                         rows=on.of_rows)  # fmt: skip
        if on.plan.newton:  # of what is between the rows nothing is said
            closed = Boolean(False)
        back = on.found.wraps[self.symbol].cell  # the ends of the whole turn are neighbours
        words = formula(
            "IF(closed,IF(back>0,rocker,crank),part)", closed=closed, back=back,
            crank=on.text("crank"), rocker=on.text("rocker"), part=on.text("turned"),
        )  # fmt: skip
        value = formula("IF(AND(closed,back=0),turn,range)", closed=closed, back=back, turn=turn, range=self._range(on))
        return self._line(on, on.plan.mechanism.angle_unit.text, value, decimals_of_kind(on.plan, "angle"), words)


class Stroke(_Extent):
    """How far a slide on the ground travels."""

    kind = "stroke"

    def line(self, on: Reading) -> Line:
        unit, digits = on.plan.mechanism.length_unit, decimals_of_kind(on.plan, "length")
        return self._line(on, unit, self._range(on), digits, Text(on.text("stroke")))


class TimeRatio(Finding):
    """Time of the slower way between the extremes over that of the faster: of a driver that turns evenly, or by its
    motion law, again and again; of one whose speed follows from its angle there is none."""

    def __init__(self, symbol: str) -> None:
        self.symbol = symbol
        self.key = f"time_ratio_{symbol}"

    def line(self, on: Reading) -> Line:
        plan, symbol = on.plan, self.symbol
        law, none = on.driver.law, "ratio.none"
        turn = whole_turn(on.driver.unit.in_degrees)
        closes = formula("wraps>0", wraps=on.found.wraps[symbol].cell)
        if law is not None:
            first, last = Symbol(SHOWN + law.start), Symbol(SHOWN + law.stop)
            closes = formula("AND(closes,ABS(ABS(last-first)/turn-1)<1E-9)", closes=closes, first=first, last=last,
                             turn=turn)  # fmt: skip
        else:
            step = there(plan.places.step).cell
        if plan.equations.equations.tied:  # what gears move is back after one turn, or after several
            if law is None:
                closes = formula("AND(closes,ABS(step)*(rows-1)<1.5*turn)", closes=closes, rows=on.of_rows, step=step,
                                 turn=turn)  # fmt: skip
            none = "ratio.gears"
        # in rows, which are equally far from each other in time
        high, low = (there(on.found.extremes[way, symbol].turns).cell for way in HIGH_LOW)
        period = formula("rows-1", rows=on.of_rows) if law else formula("turn/ABS(step)", turn=turn, step=step)
        way = formula("MOD(high-low,period)", high=high, low=low, period=period)
        value = formula("MAX(way,period-way)/MIN(way,period-way)", way=way, period=period)
        node = formula("IF(closes,IFERROR(value,NA()),NA())", value=value, closes=closes)
        if on.driver.uneven:
            node, none = formula("NA()"), "ratio.uneven"
        words = formula(
            'IF(stretches=0,"",IF(ISNUMBER(ratio),IF(leaps>0,unsure,ways&about),none))',
            stretches=on.found.count.cell, leaps=plan.places.leaps.cell, ratio=on.value(self.key),
            unsure=on.text("unsure"), about=about_turns(plan, symbol),
            ways=on.text("ratio", symbol=plain(symbol)), none=on.text(none, symbol=plain(symbol)),
        )  # fmt: skip
        return Line(on.text("ratio.symbol"), node, words, style=3)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        if not motion.sure:
            return {}
        ratios = self.ratios(motion)
        part = max(motion.part(self.key), 5 * EXACT)  # two places, each with its own step beside it
        return {self.key: Expected(ratios, part * min(ratios, default=1.0))}

    def ratios(self, motion: SearchedMotion) -> list[float]:
        """What a search finds: of extremes that are flat several are as true."""
        search, symbol = motion.search, self.symbol
        if search.mechanism.driver.uneven:
            return []
        step = abs(search.step)
        if search.mechanism.driver.law is not None:  # its rows are equally far from each other in time
            if abs(step * (search.rows - 1) / TURN - 1) > 1e-9:
                return []
            step = TURN / (search.rows - 1)
        if (
            search.equations.tied and step * (search.rows - 1) > 1.5 * TURN
        ):  # gears may be back after several, or sooner
            return []
        turns = search.whole and search.closes_everywhere and not (search.is_angle(symbol) and search.is_crank(symbol))
        extremes = search.extremes(symbol) if turns else None
        if extremes is None or extremes[2] - extremes[0] < 1e-7 * (1.0 if search.is_angle(symbol) else search.size):
            return []
        low, at_low, high, at_high = extremes
        ratios = []
        for one in (at_low, *self._ties(motion, low, high - low)):
            for other in (at_high, *self._ties(motion, high, high - low)):
                way = abs(other - one) * step % TURN
                if 0 < way < TURN:
                    ratios.append(max(way, TURN - way) / min(way, TURN - way))
        return ratios

    def _ties(self, motion: SearchedMotion, best: float, span: float) -> Array:
        """Where else the quantity is as extreme: some places of where it is flat, and wherever it turns back."""
        u, values = motion.search.u, motion.search.at[self.symbol]
        as_good = np.abs(values - best) < FLAT * span
        flat = u[as_good]
        before, after = values[1:-1] - values[:-2], values[2:] - values[1:-1]
        turns = as_good[1:-1] & (before * after <= 0) & (before != after)
        # between the places of the grid, at the vertex of the parabola through three of them
        vertex = (u[1:-1] + 0.5 * (u[1] - u[0]) * (before + after) / np.where(turns, before - after, 1.0))[turns]
        return np.concatenate((flat[:: max(1, len(flat) // 20)], vertex))


class SlowWay(Finding):
    """By how much a driver that turns evenly turns during the slower way: the angle between the dead centres."""

    def __init__(self, symbol: str) -> None:
        self.symbol, self.ratio = symbol, TimeRatio(symbol)
        self.key = f"slow_way_{symbol}"

    def line(self, on: Reading) -> Line:
        ratio, unit = on.value(self.ratio.key), on.driver.unit
        value = formula("IFERROR(turn*ratio/(ratio+1),NA())", turn=whole_turn(unit.in_degrees), ratio=ratio)
        said = on.text("slow_way", symbol=plain(self.symbol))
        words = formula('IF(ISNUMBER(value),IF(leaps>0,unsure,said&about),"")', value=on.value(self.key), said=said,
                        leaps=on.plan.places.leaps.cell, unsure=on.text("unsure"),
                        about=about_turns(on.plan, self.symbol))  # fmt: skip
        return Line(on.text("slow_way.symbol"), value, words, unit.text, decimals_of_kind(on.plan, "angle"))

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        if not motion.sure:
            return {}
        turn = TURN * motion.driver_scale
        angles = [turn * ratio / (ratio + 1) for ratio in self.ratio.ratios(motion)]
        return {self.key: Expected(angles, max(motion.part(self.key), 5 * EXACT) * turn / 2)}
