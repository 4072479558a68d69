"""What the first sheet says of the mechanism, live: one line under the title, and the block of lines that it is made of.

Every line has a named cell. All is said of the motion between the first and the last value of the driver as they stand
there, rows that exist only; whether these make a whole turn is asked of the cells.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Boolean, Call, CellRef, Node, Number, RangeRef, Symbol, Text
from livesheet.workbook import Area, Merge
from mechsheet.kinematics.equations import Group
from mechsheet.model import ENERGY, Link, Synthesis, Way, inertia_unit
from mechsheet.sheet import styles
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.efforts import AGREES
from mechsheet.sheet.checks.extremes import Extremes, about, about_turns, where_bounded
from mechsheet.sheet.checks.gaps import misfits_of
from mechsheet.sheet.checks.limits import LIMITS
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.first import cam, inputs, task
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.first.other_sheets import missing_words
from mechsheet.sheet.first.title_line import closes_in_some, write_marks, write_title_line
from mechsheet.sheet.first.verdict_lines import VerdictLines
from mechsheet.sheet.grashof import (
    BEGINS,
    Sides,
    bound_of,
    excess_of,
    is_all,
    named,
    names_of_sides,
    turning_types,
    type_of,
)
from mechsheet.sheet.over_rows import LEAST, MOST, but_first, but_last, over_rows
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import MEANING, SYMBOL, TOLERANCE, VALUE, VERDICT_ROW
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import places, places_of
from mechsheet.sheet.table.start_table import assemblies_lost
from mechsheet.sheet.transmission import acute, poor_limit, worst_of_rows, worst_words
from mechsheet.units import turn as whole_turn
from mechsheet.words.symbols import plain

HIGH_LOW: tuple[Way, Way] = ("max", "min")


def write_verdicts(writer: Writer, checks: Checks, extremes: Extremes) -> list[Merge]:
    """Fill the block and the line under the title in; the merged cells of the line."""
    block = _Verdicts(writer, checks, extremes)
    writer.heading("verdicts", writer.plan.text("head.at"))
    found = writer.plan.found
    block.inputs()
    if found.task is not None:
        block.task(found.task)
    block.rows_closed()
    if found.limits:
        block.limits()
        block.input_range()
        block.passes()
    block.gap_and_leaps()
    if found.newton:
        block.newton()
    for loop in found.four_bars:
        block.grashof(loop)
    for link in found.swings:
        block.swing(link)
    for joint in found.strokes:
        block.stroke(joint.symbol)
    for symbol in found.returning:
        block.ratio(symbol)
    for group in found.transmission:
        block.transmission(group)
    if found.rates:
        block.dead_centres()
        block.fits("velocity", "velocities_fit")
        block.fits("acceleration", "accelerations_fit")
    if found.forces:
        block.efforts()
    if found.cam:
        cam.write(block)
    if found.flywheel:
        block.flywheel()
    write_marks(block)
    write_title_line(block)
    return [Merge(Area(VERDICT_ROW, SYMBOL, VERDICT_ROW, MEANING))]


class _Verdicts(VerdictLines):
    """What each of the lines says."""

    # --- inputs -----------------------------------------------------------------------------------------------

    def inputs(self) -> None:
        """Which yellow cell holds what cannot be; it is red, and so is the line."""
        cell, said = self.value("inputs"), self.words("inputs")
        fine = self.text("inputs.fine")
        fits = formula(
            "IF(known,fine,misfit)", known=self.found.fine.cell, fine=fine, misfit=self.text("inputs.misfit")
        )
        others = formula("IF(present,IF(position,fits,no_position),missing)", present=self.there("extremes"), fits=fits,
                         position=self.found.there.cell, no_position=inputs.no_position(self.plan),
                         missing=missing_words(self.plan))  # fmt: skip
        words = inputs.words(self.plan, cell, others)
        self.says_itself("inputs", MEANING)
        self.line("inputs", self.text("inputs"), "", inputs.first_wrong(self.plan), 0, words)
        self.colour("inputs", "said<>fine", styles.BAD, said=said, fine=fine)
        self.colour("inputs", "said=fine", styles.GOOD, said=said, fine=fine)
        nowhere = formula("said=words", said=said, words=inputs.no_position(self.plan))
        self.writer.conditionals.extend(inputs.red_where_wrong(self.plan, nowhere))

    def task(self, asked: Synthesis) -> None:
        """Whether the dimensions that are found from a task do what it asks."""
        if self.plan.synthesis is None:
            raise ValueError("a task without the rows of its sheet")
        words = task.said(self.plan, self.plan.synthesis, self.value("task"))
        doubt = task.doubtful(self.plan, self.words("task"))
        self.line("task", self.text("task"), "", task.wrong(self.plan, asked), 0, words)
        self.colour("task", "wrong>0", styles.BAD, wrong=self.value("task"))
        self.colour("task", "doubt", styles.WARN, doubt=doubt)
        self.colour("task", "said=exactly", styles.GOOD, said=self.words("task"), exactly=task.exactly(self.plan))

    # --- rows and stretches -----------------------------------------------------------------------------------

    def rows_closed(self) -> None:
        """In how many rows it closes, and in which stretches."""
        plan = self.plan
        key, rows = "rows_closed", self.of_rows
        said, ok = plan.places.status.whole(), plan.text("status.ok")
        count = formula("COUNTIF(said,ok)", said=said, ok=ok)
        stretches = [stretch.words.cell for stretch in self.found.stretches]
        more = formula('IF(stretches>most," …","")', stretches=self.found.count.cell, most=len(stretches))
        cell = self.value(key)
        some = formula("IF(present,stretches,part)", present=self.there("extremes"), part=closes_in_some(plan, cell, rows),
                       stretches=joined(self.text("rows.some"), " ", *stretches, self.unit, more))  # fmt: skip
        self.says_itself(key, MEANING)
        words = formula(
            "IF(count=0,nowhere,IF(count=rows,everywhere,some))", count=cell, rows=rows,
            nowhere=self.text("rows.none"), everywhere=self.text("rows.all"), some=some,
        )  # fmt: skip
        self.line(key, self.text("rows"), formula("ROWS(said)", said=said), count, 0, words)
        self.colour(key, "count=0", styles.BAD, count=cell)
        self.colour(key, "count<rows", styles.WARN, count=cell, rows=rows)
        self.colour(key, "count=rows", styles.GOOD, count=cell, rows=rows)

    def _drivers(self) -> RangeRef:
        return self.plan.at.column(self.driver.symbol, self.plan.main)

    def limits(self) -> None:
        """The limit positions within the sweep: how many, and where."""
        column = self.plan.places.status.whole()
        if self.plan.rows == 1:
            self.line("limits", self.text("limits"), "", al.ZERO, 0, Text(""))
            return
        count = formula("SUMPRODUCT(((later=ok)<>(earlier=ok))*1)", later=but_first(column),
                        earlier=but_last(column), ok=self.plan.text("status.ok"))  # fmt: skip
        cell = self.value("limits")
        parts: list[Node | str] = []
        for number, spot in enumerate(self.found.limits, 1):
            place = spot.cell
            named = joined("; " if number > 1 else "", self.driver_text(place))
            parts.append(formula('IF(count<number,"",named)', count=cell, number=number, named=named))
        more = formula('IF(count>most," …","")', count=cell, most=LIMITS)
        if self.found.limits:
            more = joined(more, self._within_a_step())
        words = formula(
            'IF(count>0,IFERROR(found,""),IF(AND(closed>0,passes=0),none,""))', count=cell, closed=self.value("rows_closed"),
            passes=self.value("passes"), none=self.text("limits.none"), found=joined(*parts, more),
        )  # fmt: skip
        self.line("limits", self.text("limits"), "", count, 0, words)
        self.colour("limits", "count>0", styles.WARN, count=cell)

    def _within_a_step(self) -> Node:
        """What is added to limits that the probes have not found."""
        return formula('IF(unsettled,within,"")', unsettled=self.found.unsettled.cell, within=self.text("within"))

    def input_range(self) -> None:
        """From where to where the driver can go in the first stretch."""
        stretch, count = self.found.stretches[0], self.found.count.cell
        if self.driver.values or self.plan.rows == 1:  # listed values may go to and fro
            ends = [
                formula(f"{most}(INDEX(drivers,first):INDEX(drivers,last))", drivers=self._drivers(),
                        first=stretch.first.cell, last=stretch.last.cell)
                for most in ("MIN", "MAX")
            ]  # fmt: skip
        else:
            ends = [driver_at(self.plan, end.cell) for end in (stretch.begin, stretch.end)]
        unit = self.driver.unit.text
        everywhere = formula("AND(count=rows,whole>0,passes=0)", count=self.value("rows_closed"), rows=self.of_rows,
                             whole=self.found.whole.cell, passes=self.value("passes"))  # fmt: skip
        free = formula("IF(everywhere,free,range)", everywhere=everywhere, free=self.text("input.free"),
                       range=self.text("input.range"))  # fmt: skip
        words = formula("IF(stretches=0,nowhere,IF(stretches>1,first,free)&within)", stretches=count,
                        nowhere=self.text("rows.none"), first=self.text("input.first"), free=free,
                        within=self._within_a_step())  # fmt: skip
        digits = self.driver_places()
        low, high = (formula("IF(stretches=0,NA(),value)", stretches=count, value=end) for end in ends)
        self.line("input_from", self.text("input"), unit, low, digits, words)
        self.line("input_to", "", unit, high, digits, Text(""))

    def passes(self) -> None:
        """Whether a group comes apart between two rows that exist, or lines of it turn parallel."""
        tolerance = Symbol(self.plan.equations.tolerance)
        found: Node = al.ZERO
        where: Node = Text("")
        for least, row in reversed([*self.found.gaps.values()]):
            dips = formula("IFERROR(least<-tolerance,FALSE)", least=least.cell, tolerance=tolerance)
            found = al.add(formula("IF(dips,1,0)", dips=dips), found)
            place = driver_at(self.plan, row.cell)
            where = formula("IF(dips,place,other)", dips=dips, place=place, other=where)
        for least, occurs in () if self.driver.values else self.plan.checked.crossed.values():
            turned = formula("IFERROR(least<0,FALSE)", least=least.cell)
            found = al.add(formula("IF(turned,1,0)", turned=turned), found)
            where = formula("IF(turned,place,other)", turned=turned, place=occurs.cell, other=where)
        cell = self.value("passes")
        before, after = self.text("passes.not", place="#").split("#")
        place = CellRef(self.rows["passes"], TOLERANCE, True, True)
        words = formula('IF(closed=0,"",IF(count=0,through,between))', closed=self.value("rows_closed"), count=cell,
                        through=self.text("passes.all"),
                        between=joined(before, formula("ROUND(place,1)", place=place), self.unit, after))  # fmt: skip
        self.line("passes", self.text("passes"), "", found, 0, words)
        self.at("passes", where)
        self.colour("passes", "count>0", styles.WARN, count=cell)

    def gap_and_leaps(self) -> None:
        """The largest gap of a joint, and links that turn far between two rows."""
        plan = self.plan
        key, cell = "largest_gap", self.value("largest_gap")
        rounding = plan.checked.rounding.cell
        wrong = {"open": self.text("gap.open", sheet=self.checks.title)}
        left_open: Node = Text(wrong["open"])
        for number, (link, group) in enumerate(misfits_of(plan), 1):
            wrong[f"misfit_{number}"] = misfit = self.text("gap.redundant", link=link, sheet=self.checks.title)
            left_open = formula("IF(own>rounding,misfit,other)", own=self.checks.worst("gap", group), rounding=rounding,
                                misfit=misfit, other=left_open)  # fmt: skip
        wrong["apart"] = self.text("gap.apart", notes=plan.at.titles["notes"])
        words = formula('IF(_rows_apart>0,apart,IF(typed>0,over,IF(count=0,"",IF(gap>rounding,open,closed))))',
                        apart=wrong["apart"],
                        typed=plan.checked.typed.cell, count=self.value("rows_closed"), gap=cell,
                        rounding=rounding, over=self.text("gap.typed", sheet=self.checks.title),
                        closed=self.text("gap.closed"), open=left_open)  # fmt: skip
        style = styles.numbered(styles.RESULT, styles.ERROR.number_format)
        self.line(key, self.text("gap"), plan.mechanism.length_unit, self.checks.worst("gap"), style, words)
        self.at(key, formula('IFERROR(place,"")', place=self.checks.worst_at("gap")))
        wrong["over"] = self.text("gap.typed", sheet=self.checks.title)
        said = ",".join(f"said={name}" for name in wrong)
        self.colour(key, f"OR({said})", styles.BAD, said=self.words(key), **wrong)
        self.colour(key, "said=closed", styles.GOOD, said=self.words(key), closed=self.text("gap.closed"))
        cell = self.value("leaps")
        words = formula('IF(closed=0,"",IF(count=0,none,some))', closed=self.value("rows_closed"), count=cell,
                        none=self.text("leaps.none"), some=self.text("leaps.some"))  # fmt: skip
        self.line("leaps", self.text("leaps"), "", self.checks.worst("leap"), 0, words)
        self.colour("leaps", "count>0", styles.WARN, count=cell)

    # --- groups solved by Newton's method ---------------------------------------------------------------------

    def newton(self) -> None:
        """Whether each row is of the same assembly, how well the links meet, how many passes that took, the least |det|."""
        key, cell = "same_assembly", self.value("same_assembly")
        kept, lost, begun = (self.text(f"{key}.{word}") for word in ("kept", "lost", "begun"))
        words = formula('IF(closed=0,"",IF(count>0,lost,IF(ends>0,begun,kept)))', closed=self.value("rows_closed"),
                        count=cell, kept=kept, lost=lost, begun=begun, ends=assemblies_lost(self.plan))  # fmt: skip
        self.line(key, self.text(key), "", self.checks.worst("assembly"), 0, words)
        self.colour(key, "count>0", styles.BAD, count=cell)
        self.colour(key, "said=begun", styles.WARN, said=self.words(key), begun=begun)
        self.colour(key, "said=kept", styles.GOOD, said=self.words(key), kept=kept)
        style = styles.numbered(styles.RESULT, styles.ERROR.number_format)
        self.line("largest_residual", self.text("residual"), "", self.checks.worst("residual"), style,
                  self.where_it_closes(self.text("residual.fine")))  # fmt: skip
        key, cell = "passes_needed", self.value("passes_needed")
        most = max(group.system.passes for group in self.plan.equations.groups if group.system is not None)
        words = formula("IF(count>most,many,fine)", count=cell, most=most, many=self.text(f"{key}.many", passes=most),
                        fine=self.text(f"{key}.fine", passes=most))  # fmt: skip
        self.line(key, self.text(key), "", self.checks.worst("needed"), 0, self.where_it_closes(words))
        self.colour(key, "count>most", styles.WARN, count=cell, most=most)
        key = "least_det"
        words = self.where_it_closes(self.text(f"{key}.words"))
        style = styles.numbered(styles.RESULT, styles.DETERMINANT)
        self.line(key, self.text(key), "", self.checks.worst("det"), style, words)
        self.at(key, formula('IFERROR(place,"")', place=self.checks.worst_at("det")))

    # --- four-bar loops ---------------------------------------------------------------------------------------

    def grashof(self, loop: FourBar) -> None:
        """Shortest + longest - the other two: negative where some link turns fully; and the loop's type in words."""
        key = f"grashof_{loop.group}"
        lengths = self.extremes.lengths_of(loop)
        shortest, most, total = (Call(name, (lengths,)) for name in ("MIN", "MAX", "SUM"))

        def text(word: str, **parts: object) -> str:
            return self.text(f"grashof.{word}", **parts)

        which = formula(
            "CHOOSE(MATCH(shortest,lengths,0),both,crank,rockers,follower)", lengths=lengths, shortest=shortest,
            **turning_types(loop, self.plan.language, text),
        )  # fmt: skip
        bound: CellRef | None = None
        if is_all(loop, self.plan):
            bound = CellRef(self.rows[key], TOLERANCE, True, True)
            self._bound(key, loop, lengths, shortest)
        said = type_of(shortest, self.value(key), which, text, bound)
        begin = f"{named(loop, self.plan)}: "
        bands = self.plan.mechanism.bands is not None
        reach = self.found.reach[loop.group].cell if bands else ""
        words = formula('IFERROR(said,"")', said=joined(begin, said, reach))
        excess = formula("excess", excess=excess_of(self.plan, shortest, most, total))
        self.line(
            key, self.text("grashof"), self.plan.mechanism.length_unit, excess, places(self.plan, "length"), words
        )
        self.colour(key, BEGINS, styles.BAD, said=self.words(key), begin=begin + text("open"))
        self.colour(key, "said=change", styles.WARN, said=self.words(key), change=begin + text("change"))
        if bands:
            self.colour(key, "ISNUMBER(FIND(reach,said))", styles.WARN, said=self.words(key), reach=text("reach"))

    def _bound(self, key: str, loop: FourBar, lengths: RangeRef, shortest: Node) -> None:
        """Up to which length the longest link closes, or the first turns fully: beside the type of a four-bar."""
        names = names_of_sides(loop, self.plan)
        cells = [replace(lengths.start, col=lengths.start.col + at) for at in range(4)]

        def longest(length: Node) -> Node:
            return Call("CHOOSE", (Call("MATCH", (length, lengths, Number(0.0))), *map(Text, names)))

        sides = Sides(cells, (lengths,), names, longest, places(self.plan, "length"))
        mend = formula('IFERROR(mend,"")', mend=bound_of(sides, shortest, self.value(key)))
        self.writer.formula(self.rows[key], TOLERANCE, mend, replace(styles.UNIT, name="", align="right"))

    def swing(self, link: Link) -> None:
        """By how much a link turns, and whether it is a crank or a rocker."""
        symbol = link.angle_symbol
        turn = whole_turn(self.plan.at.spots[symbol].degrees)
        closed = formula("AND(whole>0,count=rows)", whole=self.found.whole.cell, count=self.value("rows_closed"),
                         rows=self.of_rows)  # fmt: skip
        if self.plan.newton:  # of what is between the rows nothing is said
            closed = Boolean(False)
        back = self.found.wraps[symbol].cell  # the ends of the whole turn are neighbours
        words = formula(
            "IF(closed,IF(back>0,rocker,crank),part)", closed=closed, back=back,
            crank=self.text("crank"), rocker=self.text("rocker"), part=self.text("turned"),
        )  # fmt: skip
        value = formula(
            "IF(AND(closed,back=0),turn,range)", closed=closed, back=back, turn=turn, range=self._range(symbol)
        )
        self._extent(f"swing_{symbol}", symbol, self.plan.mechanism.angle_unit.text, value, "angle", words)

    def _range(self, symbol: str) -> Node:
        extent = formula("high-low", high=self.extreme("max", symbol), low=self.extreme("min", symbol))
        return where_bounded(self.plan, symbol, extent)

    def _extent(self, key: str, symbol: str, unit: str, value: Node, kind: str, words: Node) -> None:
        """A swing or stroke: of one stretch; #N/A of several, which the mechanism cannot pass between."""
        node = formula("IF(stretches<>1,NA(),IFERROR(value,NA()))", stretches=self.found.count.cell, value=value)
        said = formula(
            'IF(stretches=0,"",IF(stretches>1,several,IF(leaps>0,unsure,words&about)))', words=words,
            stretches=self.found.count.cell, leaps=self.plan.places.leaps.cell,
            about=about(self.plan, symbol), several=self.text("swing.several"), unsure=self.text("unsure"),
        )  # fmt: skip
        self.line(key, rich(symbol), unit, node, places(self.plan, kind), said)

    def extreme(self, way: Way, symbol: str) -> Node:
        """The smallest or the largest value of a quantity."""
        return self.found.extremes[way, symbol].value.cell

    def about(self, symbol: str) -> Node:
        """What is added where the probes of an extreme have not settled, or the rows are too far apart."""
        return formula(
            "IF(leaps>0,about,more)",
            leaps=self.plan.places.leaps.cell,
            about=self.text("about"),
            more=about(self.plan, symbol),
        )

    # --- slides, time ratio, transmission ---------------------------------------------------------------------

    def stroke(self, symbol: str) -> None:
        """How far a slide on the ground travels."""
        unit = self.plan.mechanism.length_unit
        self._extent(f"stroke_{symbol}", symbol, unit, self._range(symbol), "length", Text(self.text("stroke")))

    def ratio(self, symbol: str) -> None:
        """Time of the slower way between the extremes over that of the faster: of a driver that turns evenly, or by its
        motion law, again and again; of one whose speed follows from its angle there is none."""
        law, none = self.plan.mechanism.driver.law, "ratio.none"
        turn = whole_turn(self.driver.unit.in_degrees)
        closes = formula("wraps>0", wraps=self.found.wraps[symbol].cell)
        if law is not None:
            first, last = Symbol(SHOWN + law.start), Symbol(SHOWN + law.stop)
            closes = formula("AND(closes,ABS(ABS(last-first)/turn-1)<1E-9)", closes=closes, first=first, last=last,
                             turn=turn)  # fmt: skip
        else:
            step = there(self.plan.places.step).cell
        if self.plan.equations.equations.tied:  # what gears move is back after one turn, or after several
            if law is None:
                closes = formula("AND(closes,ABS(step)*(rows-1)<1.5*turn)", closes=closes, rows=self.of_rows, step=step,
                                 turn=turn)  # fmt: skip
            none = "ratio.gears"
        # in rows, which are equally far from each other in time
        high, low = (there(self.found.extremes[way, symbol].turns).cell for way in HIGH_LOW)
        period = formula("rows-1", rows=self.of_rows) if law else formula("turn/ABS(step)", turn=turn, step=step)
        way = formula("MOD(high-low,period)", high=high, low=low, period=period)
        value = formula("MAX(way,period-way)/MIN(way,period-way)", way=way, period=period)
        node = formula("IF(closes,IFERROR(value,NA()),NA())", value=value, closes=closes)
        if self.driver.uneven:
            node, none = formula("NA()"), "ratio.uneven"
        cell = self.value(f"time_ratio_{symbol}")
        words = formula(
            'IF(stretches=0,"",IF(ISNUMBER(ratio),IF(leaps>0,unsure,ways&about),none))',
            stretches=self.found.count.cell, leaps=self.plan.places.leaps.cell,
            ratio=cell, unsure=self.text("unsure"), about=about_turns(self.plan, symbol),
            ways=self.text("ratio", symbol=plain(symbol)), none=self.text(none, symbol=plain(symbol)),
        )  # fmt: skip
        self.line(f"time_ratio_{symbol}", self.text("ratio.symbol"), "", node, 3, words)

    def transmission(self, group: Group) -> None:
        """The angle of transmission that is farthest from 90 degrees, as an acute angle; without the sheet of extremes that
        of the rows."""
        key = f"transmission_{group.number}"
        high, low = (self.found.extremes[way, group.transmission] for way in HIGH_LOW)
        folded = acute(low.value.cell, high.value.cell, from_right=group.kind != "RRR")
        unit, cell = self.plan.mechanism.angle_unit, self.value(key)
        poor = formula("value<limit", value=cell, limit=poor_limit(self.plan.mechanism))
        place = CellRef(self.rows[key], TOLERANCE, True, True)
        of_rows = self.plan.between_unseen if self.plan.rows_only else self.found.rows_only.cell
        said = worst_words(self.plan, cell, place, poor, of_rows)
        present = self.there("extremes")
        words = formula('IFERROR(IF(present,said&about,of_rows),"")', present=present, said=said,
                        about=self.about(group.transmission), of_rows=worst_of_rows(self.plan, cell, poor))  # fmt: skip
        column = Symbol(ALL + group.transmission)
        in_rows = acute(over_rows(LEAST, column), over_rows(MOST, column), from_right=group.kind != "RRR")
        worst = formula(
            "IF(present,worst,in_rows)", present=present, worst=Call("MIN", folded), in_rows=Call("MIN", in_rows)
        )
        node = formula("IFERROR(value,NA())", value=_in(worst, unit.in_degrees))
        self.says_itself(key, VALUE, MEANING)
        self.line(key, f"μ{group.number}", unit.text, node, places(self.plan, "angle"), words)
        at_low = formula(
            "IF(one<=other+1E-6,place,elsewhere)",
            one=folded[0],
            other=folded[1],
            place=low.occurs.cell,
            elsewhere=high.occurs.cell,
        )
        self.at(key, formula("IFERROR(place,NA())", place=at_low))
        self.colour(key, "AND(ISNUMBER(value),poor)", styles.WARN, value=cell, poor=poor)
        good = formula("ISNUMBER(FIND(good,said))", said=self.words(key), good=self.text("fair"))
        self.colour(key, "good", styles.GOOD, good=good)

    # --- velocities -------------------------------------------------------------------------------------------

    def dead_centres(self) -> None:
        """In how many rows that close there are no velocities."""
        key, cell = "dead_centres", self.value("dead_centres")
        said = there(self.plan.places.rates).whole()
        count = formula("closed-COUNTIF(said,ok)", closed=self.value("rows_closed"), said=said,
                        ok=self.plan.text("status.ok"))  # fmt: skip
        some = self.text("dead_centres.some", rates=self.plan.at.titles["rates"])
        words = formula("IF(count=0,none,some)", count=cell, none=self.text("dead_centres.none"), some=some)
        self.line(key, self.text(key), self.of_rows, count, 0, self.where_it_closes(words))
        self.colour(key, "count>0", styles.WARN, count=cell)

    def fits(self, kind: Literal["velocity", "acceleration"], key: str) -> None:
        """The largest difference between the two ways round a group."""
        rounding = self.plan.checked.rounding.cell
        self._agrees(key, kind, self.plan.mechanism.length_unit, rounding, "rates")

    def _agrees(
        self, key: str, what: Literal["velocity", "acceleration", "torque"], unit: str, most: Node | float, said: str
    ) -> None:
        """How far two ways to the same numbers are apart, green up to `most`; `said`: where its words are."""
        wrong, fine = self.text(f"{said}.not", sheet=self.checks.title), self.text(f"{said}.fit")
        words = formula("IF(gap>most,wrong,fine)", gap=self.value(key), most=most, wrong=wrong, fine=fine)
        style = styles.numbered(styles.RESULT, styles.ERROR.number_format)
        self.writer.needs[self.rows[key]] = {"forces" if what == "torque" else "rates"}
        self.line(key, self.text(key), unit, self.checks.worst(what), style, self.where_it_closes(words))
        self.colour(key, "said=wrong", styles.BAD, said=self.words(key), wrong=wrong)
        self.colour(key, "said=fine", styles.GOOD, said=self.words(key), fine=fine)

    # --- forces -----------------------------------------------------------------------------------------------

    def efforts(self) -> None:
        """The largest effort of the driver and the largest joint force, over rows; whether virtual work says the same."""
        plan = self.plan
        effort = plan.efforts[0]
        unit = plan.equations.of(effort).unit
        style = styles.decimals(styles.RESULT, places_of(plan, unit))
        key = "largest_effort"
        self.writer.needs[self.rows[key]] = {"forces"}
        self.line(key, rich(effort), unit.text, self.checks.worst("effort"), style,
                  self.where_it_closes(self.text(key)))  # fmt: skip
        self.at(key, formula('IFERROR(place,"")', place=self.checks.worst_at("effort")))
        key, cell = "largest_force", self.value("largest_force")
        names: list[Node | str] = [
            formula('IF(COUNTIF(column,most)>0,name,"")', column=Symbol(ALL + name), most=cell, name=f" {plain(name)}")
            for name in plan.equations.equations.forces("size")
        ]
        force_unit = plan.mechanism.dynamics.force_unit if plan.mechanism.dynamics else ""
        style = styles.decimals(styles.RESULT, places(plan, "force"))
        self.line(key, self.text(key), force_unit, self.checks.worst("force"), style,
                  self.where_it_closes(joined(self.text(f"{key}.words"), *names)))  # fmt: skip
        self.at(key, formula('IFERROR(place,"")', place=self.checks.worst_at("force")))
        self._agrees("effort_fits", "torque", "", AGREES, "effort")

    def flywheel(self) -> None:
        """Mean torque, change of energy over the turn, and the moment of inertia that keeps the speed within its bounds."""
        plan, torque = self.plan, self.plan.efforts[0]
        speed, acceleration = (Symbol(name) for name in plan.mechanism.driver_rates)
        even = formula("AND(whole=1,count=rows,speed<>0,acceleration=0)", count=self.value("rows_closed"),
                       rows=self.of_rows, whole=self.found.whole.cell, speed=speed, acceleration=acceleration)  # fmt: skip
        column = plan.at.column(torque, plan.main)
        mean = formula("IF(even,(SUM(column)-(first+last)/2)/steps,NA())", even=even, column=column, first=column.start,
                       last=column.end, steps=formula("MAX(1,rows-1)", rows=self.of_rows))  # fmt: skip
        style = styles.decimals(styles.RESULT, places(plan, "moment"))
        missing = self.text("flywheel.missing")

        def said(key: str, words: Node | str) -> Node:
            known = formula("IF(ISNUMBER(value),words,missing)", value=self.value(key), words=words, missing=missing)
            return self.where_it_closes(known)

        unit = plan.equations.of(torque).unit.text
        self.line("mean_torque", self.text("mean_torque"), unit, mean, style,
                  said("mean_torque", self.text("mean_torque.words")))  # fmt: skip
        # the change of energy is that from the mean torque, which is one of a whole turn
        self.writer.needs |= {self.rows[key]: {"extremes"} for key in ("energy_change", "flywheel")}
        energy, drivers = plan.at.column(ENERGY, plan.main), self._drivers()
        ends = [
            self.driver_text(formula(f"INDEX(drivers,MATCH({way}(energy),energy,0))", drivers=drivers, energy=energy))
            for way in ("MAX", "MIN")
        ]
        words = joined(self.text("energy_change.slow"), " ", ends[0], self.text("energy_change.fast"), " ", ends[1])
        change = formula("MAX(energy)-MIN(energy)", energy=energy)
        self.line("energy_change", "ΔE", plan.equations.of(ENERGY).unit.text, change, style,
                  said("energy_change", words))  # fmt: skip
        inertia = formula("change/(fluctuation*speed^2)", change=self.value("energy_change"),
                          fluctuation=Symbol("fluctuation"), speed=speed)  # fmt: skip
        style, dynamics = styles.numbered(styles.RESULT, "0.000E+00"), plan.mechanism.dynamics
        unit = inertia_unit(dynamics, plan.mechanism.length_unit) if dynamics else ""
        self.line("flywheel", self.text("flywheel"), unit, inertia, style,
                  said("flywheel", self.text("flywheel.words")))  # fmt: skip


def _in(value: Node, degrees: bool) -> Node:
    return formula("DEGREES(value)", value=value) if degrees else value
