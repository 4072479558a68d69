"""What the first sheet says of the mechanism, live: one line under the title, and the block of lines that it is made of.

Every line has a named cell. All is said of the motion between the first and the last value of the driver as they stand there,
rows that exist only; whether these make a whole turn is asked of the cells.
"""

from __future__ import annotations

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol, Text
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.naming import link_words
from mechsheet.model import Link
from mechsheet.sheet import styles
from mechsheet.sheet.blocks import Writer
from mechsheet.sheet.checks import ROUNDING, Checks
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.extremes import Extremes
from mechsheet.sheet.geometry import distance
from mechsheet.sheet.limits import LIMITS, STRETCHES
from mechsheet.sheet.plan import MEANING, SYMBOL, TOLERANCE, VALUE, VERDICT_ROW
from mechsheet.sheet.positions import places
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Area, Conditional, Content, Merge, Style

POOR = 40.0
"""Angles of transmission [deg] below this are poor: most of the force only loads the joints."""


def write_verdicts(writer: Writer, checks: Checks, extremes: Extremes) -> list[Merge]:
    """Fill the block and the line under the title in; the merged cells of the line."""
    block = _Block(writer, checks, extremes)
    writer.heading("verdicts", writer.plan.text("head.at"))
    found = writer.plan.found
    block.rows_closed()
    if found.limits:
        block.limits()
        block.input_range()
        block.passes()
    block.gap_and_leaps()
    for loop in found.four_bars:
        block.grashof(loop)
    for link in found.swings:
        block.swing(link, [loop for loop in found.four_bars if link in (loop.first, loop.last)])
    for joint in found.strokes:
        block.stroke(joint.symbol)
    for symbol in found.returning:
        block.ratio(symbol)
    for group in found.transmission:
        block.transmission(group)
    block.line_under_the_title()
    return [Merge(Area(VERDICT_ROW, SYMBOL, VERDICT_ROW, MEANING))]


class _Block:
    """The lines; each has a short symbol, a value, its unit, where it occurs, and words."""

    def __init__(self, writer: Writer, checks: Checks, extremes: Extremes) -> None:
        self.writer = writer
        self.plan = writer.plan
        self.checks = checks
        self.extremes = extremes
        self.rows = writer.plan.blocks["verdicts"].rows
        self.driver = writer.plan.mechanism.driver
        self.turning = self.driver.unit.kind == "angle"
        self.unit = _after_number(self.driver.unit.text)

    # --- small things -----------------------------------------------------------------------------------------

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"verdict.{key}", **parts)

    def bound(self, text: str, **holes: Node | float | str) -> Node:
        """A formula of the first sheet."""
        return self.plan.at.bind(formula(text, **holes), self.plan.main)

    def line(self, key: str, symbol: Content, unit: str, value: Node, digits: int, words: Node) -> CellRef:
        """One line; the cell of its value."""
        row = self.rows[key]
        self.writer.line(row, symbol, unit, None)
        self.writer.formula(row, VALUE, value, styles.decimals(styles.RESULT, digits))
        self.writer.formula(row, MEANING, words, styles.VERDICT)
        return self.value(key)

    def value(self, key: str) -> CellRef:
        """The cell of a line's value."""
        return CellRef(self.rows[key], VALUE, True, True)

    def words(self, key: str) -> CellRef:
        """The cell of a line's words."""
        return CellRef(self.rows[key], MEANING, True, True)

    def at(self, key: str, place: Node) -> None:
        """Where it occurs: a value of the driver."""
        self.writer.formula(self.rows[key], TOLERANCE, place, styles.decimals(styles.RESULT, self._driver_places()))

    def colour(self, key: str, test: str, style: Style, **holes: Node | float | str) -> None:
        """The words' colour where a test of this sheet's own cells holds: other programs refuse another's cells."""
        row = self.rows[key]
        area = Area(row, MEANING, row, MEANING)
        self.writer.conditionals.append(Conditional(area, formula(test, **holes), style))

    def driver_text(self, value: Node) -> Node:
        """A value of the driver in words: 48.3°."""
        return joined(formula("ROUND(value,2)", value=value), self.unit)

    def _driver_places(self) -> int:
        return places(self.plan, "angle" if self.turning else "length")

    # --- rows and stretches -----------------------------------------------------------------------------------

    def rows_closed(self) -> None:
        """In how many rows it closes, and in which stretches."""
        plan = self.plan
        key, rows = "rows_closed", float(plan.rows)
        count = self.bound("COUNTIF(ALL(_status),ok)".replace("ALL(_status)", "said"),
                           said=Symbol(f"{ALL}#status"), ok=plan.text("status.ok"))  # fmt: skip
        stretches: list[Node | str] = []
        for number in range(1, STRETCHES + 1):
            ends = [
                formula("INDEX(drivers,row)", drivers=self._drivers(), row=Symbol(f"#{key_}_{number}"))
                for key_ in ("first", "last")
            ]
            stretch = joined("; " if number > 1 else "", self.driver_text(ends[0]), " … ", self.driver_text(ends[1]))
            stretches.append(formula('IF(_stretches<number,"",stretch)', number=number, stretch=stretch))
        more = formula('IF(_stretches>most," …","")', most=STRETCHES)
        some = joined(self.text("rows.some"), " ", *stretches, more)
        cell = self.value(key)
        words = self.bound(
            "IF(count=0,nowhere,IF(count=rows,everywhere,some))", count=cell, rows=rows,
            nowhere=self.text("rows.none"), everywhere=self.text("rows.all"), some=some,
        )  # fmt: skip
        self.line(key, self.text("rows"), f"/ {plan.rows}", count, 0, words)
        self.colour(key, "count=0", styles.BAD, count=cell)
        self.colour(key, "count<rows", styles.WARN, count=cell, rows=rows)
        self.colour(key, "count=rows", styles.GOOD, count=cell, rows=rows)

    def _drivers(self) -> RangeRef:
        return self.plan.at.column(self.driver.symbol, self.plan.main)

    def limits(self) -> None:
        """The limit positions within the sweep: how many, and where."""
        said = f"{ALL}#status"
        spot = self.plan.at.spots["#status"]
        column = self.plan.at.column("#status", self.plan.main)
        if self.plan.rows == 1:
            self.line("limits", self.text("limits"), "", al.ZERO, 0, Text(self.text("limits.none")))
            return
        del said
        later = RangeRef(CellRef(column.start.row + 1, spot.col, True, True, spot.sheet), column.end)
        earlier = RangeRef(column.start, CellRef(column.end.row - 1, spot.col, True, True, spot.sheet))
        count = self.bound("SUMPRODUCT(--((later=ok)<>(earlier=ok)))", later=later, earlier=earlier,
                           ok=self.plan.text("status.ok"))  # fmt: skip
        cell = self.value("limits")
        parts: list[Node | str] = []
        for number in range(1, self.extremes.limits.count + 1):
            place = Symbol(f"#limit_{number}")
            named = joined("; " if number > 1 else "", self.driver_text(place))
            parts.append(formula('IF(count<number,"",named)', count=cell, number=number, named=named))
        more = formula('IF(count>most," …","")', count=cell, most=LIMITS)
        words = self.bound(
            "IF(count=0,none,found)", count=cell, none=self.text("limits.none"), found=joined(*parts, more)
        )
        self.line("limits", self.text("limits"), "", count, 0, words)
        self.colour("limits", "count>0", styles.WARN, count=cell)

    def _driver_at(self, row: Node) -> Node:
        """The driver's value at a place counted in rows."""
        return formula("_start+(row-1)*_step", row=row)

    def input_range(self) -> None:
        """From where to where the driver can go in the first stretch."""
        if self.driver.values or self.plan.rows == 1:
            ends = [
                formula("INDEX(drivers,row)", drivers=self._drivers(), row=Symbol(f"#{key}_1"))
                for key in ("first", "last")
            ]
        else:
            ends = [self._driver_at(Symbol(f"#{key}_1")) for key in ("from", "to")]
        unit = self.driver.unit.text
        everywhere = formula("AND(count=rows,_whole>0)", count=self.value("rows_closed"), rows=self.plan.rows)
        free = formula("IF(everywhere,free,range)", everywhere=everywhere, free=self.text("input.free"),
                       range=self.text("input.range"))  # fmt: skip
        words = self.bound("IF(_stretches=0,nowhere,IF(_stretches>1,first,free))", nowhere=self.text("rows.none"),
                           first=self.text("input.first"), free=free)  # fmt: skip
        digits = self._driver_places()
        low, high = (self.bound("IF(_stretches=0,NA(),value)", value=end) for end in ends)
        self.line("input_from", self.text("input"), unit, low, digits, words)
        self.line("input_to", "", unit, high, digits, Text(""))

    def passes(self) -> None:
        """Whether a group comes apart between two rows that exist."""
        tolerance = self.plan.at.bind(Symbol(self.plan.equations.tolerance), self.plan.main)
        found: Node = al.ZERO
        where: Node = Text("")
        for number in reversed(self.extremes.gaps):
            dips = formula("IFERROR(least<-tolerance,FALSE)", least=Symbol(f"#gap_least_{number}"), tolerance=tolerance)
            found = (
                al.add(formula("IF(dips,1,0)", dips=dips), found)
                if found != al.ZERO
                else formula("IF(dips,1,0)", dips=dips)
            )
            place = self._driver_at(Symbol(f"#gap_row_{number}"))
            where = formula("IF(dips,place,other)", dips=dips, place=place, other=where)
        cell = self.value("passes")
        words = formula("IF(count=0,through,between)", count=cell, through=self.text("passes.all"),
                        between=self.text("passes.not"))  # fmt: skip
        self.line("passes", self.text("passes"), "", self.bound("found", found=found), 0, words)
        self.at("passes", self.bound("where", where=where))
        self.colour("passes", "count>0", styles.WARN, count=cell)

    def gap_and_leaps(self) -> None:
        """The largest gap of a joint, and links that turn far between two rows."""
        plan = self.plan
        key, cell = "largest_gap", self.value("largest_gap")
        rounding = plan.at.cell("#rounding", plan.main, None)
        tight = formula("IFERROR(gap<=rounding,FALSE)", gap=cell, rounding=rounding)
        words = formula("IF(typed>0,over,IF(nothing,none,IF(tight,closed,open)))", typed=plan.at.cell("#typed", plan.main, None),
                        over=self.text("gap.typed", sheet=self.checks.title), tight=tight,
                        nothing=formula("count=0", count=self.value("rows_closed")), none=self.text("rows.none"),
                        closed=self.text("gap.closed"), open=self.text("gap.open", sheet=self.checks.title))  # fmt: skip
        self.line(key, self.text("gap"), plan.mechanism.length_unit, self.checks.worst("gap"), 4, words)
        self.writer.fills[-2] = _restyled(
            self.writer.fills[-2], styles.numbered(styles.RESULT, styles.ERROR.number_format)
        )
        self.at(key, self.checks.worst_at("gap"))
        self.colour(key, "OR(said=open,said=over)", styles.BAD, said=self.words(key),
                    open=self.text("gap.open", sheet=self.checks.title), over=self.text("gap.typed", sheet=self.checks.title))  # fmt: skip
        self.colour(key, "said=closed", styles.GOOD, said=self.words(key), closed=self.text("gap.closed"))
        cell = self.value("leaps")
        words = formula("IF(count=0,none,some)", count=cell, none=self.text("leaps.none"), some=self.text("leaps.some"))
        self.line("leaps", self.text("leaps"), "", self.checks.worst("leap"), 0, words)
        self.colour("leaps", "count>0", styles.WARN, count=cell)

    # --- four-bar loops ---------------------------------------------------------------------------------------

    def _lengths(self, loop: FourBar) -> tuple[Node, Node, Node, Node]:
        """Ground, first link, coupler, last link."""
        ground = self.plan.mechanism.ground
        ends = (
            (ground, loop.start, loop.end),
            (loop.first, loop.start, loop.pin),
            (loop.coupler, loop.pin, loop.inner),
            (loop.last, loop.end, loop.inner),
        )
        a, b, c, d = (self.plan.at.bind(distance(*end), self.plan.main, None) for end in ends)
        return a, b, c, d

    def _rounding(self) -> Node:
        return formula("times*tolerance", times=ROUNDING,
                       tolerance=self.plan.at.bind(Symbol(self.plan.equations.tolerance), self.plan.main))  # fmt: skip

    def grashof(self, loop: FourBar) -> None:
        """Shortest + longest - the other two: negative where some link turns fully; and the loop's type in words."""
        key = f"grashof_{loop.group}"
        ground, first, coupler, last = lengths = self._lengths(loop)
        all_four = Call("SUM", lengths)
        shortest, longest = Call("MIN", lengths), Call("MAX", lengths)
        cell = self.value(key)

        def named(word: str, turning: Link | None = None) -> str:
            link = link_words(turning).of(self.plan.language) if turning else ""
            return self.text(f"grashof.{word}", loop=loop.name, link=link)

        which = formula(
            "IF(ground=shortest,both,IF(first=shortest,crank,IF(coupler=shortest,rockers,follower)))",
            ground=ground, first=first, coupler=coupler, shortest=shortest,
            both=named("both"), crank=named("one", loop.first), rockers=named("coupler"), follower=named("one", loop.last),
        )  # fmt: skip
        del last
        words = formula(
            "IF(2*longest-total>rounding,open,IF(ABS(excess)<=rounding,change,IF(excess>0,none,which)))",
            longest=longest, total=all_four, rounding=self._rounding(), excess=cell, which=which,
            open=named("open"), change=named("change"), none=named("none"),
        )  # fmt: skip
        excess = formula("2*(shortest+longest)-total", shortest=shortest, longest=longest, total=all_four)
        self.line(
            key, self.text("grashof"), self.plan.mechanism.length_unit, excess, places(self.plan, "length"), words
        )
        self.colour(key, "said=open", styles.BAD, said=self.words(key), open=named("open"))
        self.colour(key, "said=change", styles.WARN, said=self.words(key), change=named("change"))

    def swing(self, link: Link, loops: list[FourBar]) -> None:
        """By how much a link turns, and whether it is a crank or a rocker."""
        symbol = link.angle_symbol
        key = f"swing_{symbol}"
        column = Symbol(ALL + symbol)
        turn = 360.0 if self.plan.at.spots[symbol].degrees else 6.283185307179586
        on = formula("ABS(INDEX(column,rows)-INDEX(column,1))>half", column=column, rows=self.plan.rows, half=turn / 2)
        whole = formula("AND(_whole>0,count=rows)", count=self.value("rows_closed"), rows=self.plan.rows)
        words = self.bound(
            "IF(_stretches>1,several,IF(whole,IF(on,crank,rocker),part))", whole=whole, on=on,
            several=self.text("swing.several"), crank=self.text("crank"), rocker=self.text("rocker"), part=self.text("turned"),
        )  # fmt: skip
        del loops
        value = formula("IF(AND(whole,on),turn,range)", whole=whole, on=on, turn=turn, range=self._range(symbol))
        self._extent(key, symbol, self.plan.mechanism.angle_unit.text, value, "angle", words)

    def _range(self, symbol: str) -> Node:
        return formula("high-low", high=Symbol(f"#max_{symbol}"), low=Symbol(f"#min_{symbol}"))

    def _extent(self, key: str, symbol: str, unit: str, value: Node, kind: str, words: Node) -> None:
        """A swing or stroke: of one stretch; #N/A of several, which the mechanism cannot pass between."""
        node = self.bound("IF(_stretches<>1,NA(),IFERROR(value,NA()))", value=value)
        about = self.bound('IF(IFERROR(OR(low,high),FALSE),about,"")', low=Symbol(f"#min_about_{symbol}"),
                           high=Symbol(f"#max_about_{symbol}"), about=self.text("about"))  # fmt: skip
        self.line(key, rich(symbol), unit, node, places(self.plan, kind), joined(words, about))

    # --- slides, time ratio, transmission ---------------------------------------------------------------------

    def stroke(self, symbol: str) -> None:
        """How far a slide on the ground travels."""
        words = self.bound(
            "IF(_stretches>1,several,stroke)", several=self.text("swing.several"), stroke=self.text("stroke")
        )
        unit = self.plan.mechanism.length_unit
        self._extent(f"stroke_{symbol}", symbol, unit, self._range(symbol), "length", words)

    def ratio(self, symbol: str) -> None:
        """Time of the slower way between the extremes over that of the faster, for a driver that turns evenly."""
        turn = 360.0 if self.driver.unit.in_degrees else 6.283185307179586
        way = formula(
            "MOD(high-low,turn)", high=Symbol(f"#max_at_{symbol}"), low=Symbol(f"#min_at_{symbol}"), turn=turn
        )
        value = formula("MAX(way,turn-way)/MIN(way,turn-way)", way=way, turn=turn)
        column = Symbol(ALL + symbol)
        there_and_back = formula("AND(_whole>0,count=rows)", count=self.value("rows_closed"), rows=self.plan.rows)
        if self.plan.equations.of(symbol).unit.kind == "angle":
            half = 180.0 if self.plan.at.spots[symbol].degrees else 3.141592653589793
            there_and_back = formula("AND(whole,ABS(INDEX(column,rows)-INDEX(column,1))<half)", whole=there_and_back,
                                     column=column, rows=self.plan.rows, half=half)  # fmt: skip
        node = self.bound("IF(there_and_back,IFERROR(value,NA()),NA())", there_and_back=there_and_back, value=value)
        cell = self.value(f"time_ratio_{symbol}")
        words = formula("IF(ISNUMBER(ratio),ways,none)", ratio=cell, ways=self.text("ratio", symbol=plain(symbol)),
                        none=self.text("ratio.none", symbol=plain(symbol)))  # fmt: skip
        self.line(f"time_ratio_{symbol}", self.text("ratio.symbol"), "", node, 3, words)

    def transmission(self, group: Group) -> None:
        """The angle of transmission that is farthest from 90 degrees, as an acute angle."""
        key = f"transmission_{group.number}"
        low, high = Symbol(f"#min_{group.transmission}"), Symbol(f"#max_{group.transmission}")
        at = [Symbol(f"#{way}_at_{group.transmission}") for way in ("min", "max")]
        if group.kind == "RRR":  # the angle between coupler and follower itself, 0 to 180 degrees
            folded = (low, formula("PI()-high", high=high))
            ends: tuple[Node, Node] = (low, high)
        else:  # the rod against the guide: the angle of transmission is what is missing to 90 degrees
            folded = (formula("PI()/2+low", low=low), formula("PI()/2-high", high=high))
            most = formula("MAX(high,-low)", low=low, high=high)
            ends = (formula("PI()/2-most", most=most), formula("PI()/2-MAX(0,low,-high)", low=low, high=high))
        degrees = self.plan.mechanism.angle_unit.in_degrees
        least = Call("MIN", folded)
        unit = self.plan.mechanism.angle_unit.text
        cell = self.value(key)
        shown = [formula("ROUND(value,1)", value=_in(end, degrees)) for end in ends]
        poor = formula("value<limit", value=cell, limit=POOR if degrees else 0.698)
        range_ = joined(shown[0], f"{_after_number(unit)} … ", shown[1], _after_number(unit))
        grade = formula("IF(poor,bad,good)", poor=poor, bad=self.text("poor"), good=self.text("fair"))
        words = self.bound('IFERROR(range&": "&grade,"")', range=range_, grade=grade)
        label = f"μ{group.number}"
        node = self.bound("IFERROR(value,NA())", value=_in(least, degrees))
        self.line(key, label, unit, node, places(self.plan, "angle"), words)
        at_low = formula(
            "IF(one<=other+1E-6,place,elsewhere)", one=folded[0], other=folded[1], place=at[0], elsewhere=at[1]
        )
        self.at(key, self.bound("IFERROR(place,NA())", place=at_low))
        self.colour(key, "AND(ISNUMBER(value),poor)", styles.WARN, value=cell, poor=poor)
        self.colour(key, "ISNUMBER(value)", styles.GOOD, value=cell)

    # --- the line under the title -----------------------------------------------------------------------------

    def line_under_the_title(self) -> None:
        """All in one line: whether it closes, what it is, how well it transmits force; or what is wrong, and where."""
        plan = self.plan
        count, rows = self.value("rows_closed"), float(plan.rows)
        wrong = formula("ISNUMBER(tolerance)", tolerance=plan.at.bind(Symbol(plan.equations.tolerance), plan.main))
        closed = joined(self.text("line.closes"), " ", count, f" / {plan.rows} ", self.text("line.positions"))
        parts: list[Node | str] = [formula("IF(count=rows,everywhere,some)", count=count, rows=rows,
                                           everywhere=self.text("line.all", rows=plan.rows), some=closed)]  # fmt: skip
        if plan.found.limits:
            parts.append(
                formula('IF(passes>0,dips,"")', passes=self.value("passes"), dips=f"; {self.text('passes.not')}")
            )
        for loop in plan.found.four_bars[:1]:
            parts += ["; ", self.words(f"grashof_{loop.group}")]
        for group in plan.found.transmission[:1]:
            parts.append(formula('IF(ISNUMBER(value),"; "&what&" "&words,"")', value=self.value(f"transmission_{group.number}"),
                                 what=self.text("line.transmission"), words=self.words(f"transmission_{group.number}")))  # fmt: skip
        gap = self.words("largest_gap")
        bad = formula("OR(said=open,said=over)", said=gap, open=self.text("gap.open", sheet=self.checks.title),
                      over=self.text("gap.typed", sheet=self.checks.title))  # fmt: skip
        words = formula(
            "IF(fine,IF(count=0,nowhere,IF(bad,gap,good)),inputs)", fine=wrong, count=count,
            nowhere=self.text("line.nowhere"), bad=bad, gap=gap, good=joined(*parts), inputs=self.text("line.inputs"),
        )  # fmt: skip
        self.writer.formula(VERDICT_ROW, SYMBOL, words, styles.LINE)
        area = Area(VERDICT_ROW, SYMBOL, VERDICT_ROW, MEANING)
        holes: dict[str, Node | float | str] = {"fine": wrong, "count": count, "bad": bad, "rows": rows}
        self.writer.conditionals.append(Conditional(area, formula("OR(NOT(fine),count=0,bad)", **holes), styles.BAD))
        doubts = formula("count<rows", **holes)
        if plan.found.limits:
            doubts = formula("OR(doubts,passes>0)", doubts=doubts, passes=self.value("passes"))
        self.writer.conditionals.append(Conditional(area, doubts, styles.WARN))
        self.writer.conditionals.append(Conditional(area, formula("count=rows", **holes), styles.GOOD))


def _restyled(fill, style):  # type: ignore[no-untyped-def]
    from dataclasses import replace

    return replace(fill, style=style)


def _in(value: Node, degrees: bool) -> Node:
    return formula("DEGREES(value)", value=value) if degrees else value


def _after_number(unit: str) -> str:
    return unit if unit in ("°", "") else f" {unit}"
