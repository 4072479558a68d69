"""By how much links swing and slides travel, and how the times of the two ways compare."""

from __future__ import annotations

from livesheet.formula.nodes import Boolean, Node, Symbol, Text
from mechsheet.model import Way
from mechsheet.sheet.checks.extremes import about, about_turns, where_bounded
from mechsheet.sheet.findings.finding import Finding, Line
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import places
from mechsheet.units import turn as whole_turn
from mechsheet.words.symbols import plain

HIGH_LOW: tuple[Way, Way] = ("max", "min")


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
        return self._line(on, on.plan.mechanism.angle_unit.text, value, places(on.plan, "angle"), words)


class Stroke(_Extent):
    """How far a slide on the ground travels."""

    kind = "stroke"

    def line(self, on: Reading) -> Line:
        unit, digits = on.plan.mechanism.length_unit, places(on.plan, "length")
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
