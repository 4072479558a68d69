"""The sheet of extremes: the smallest and the largest value of a quantity over the motion, not only over the rows.

From the best row on probes look for it: by parabolas (`parabolas`), or, where the table has a quantity's derivatives by
the driver, where the first of them changes sign (`turning`). What is given has been attained: the best of the row, the
probes and both ends of the stretch, where a quantity may change steeply beyond its last row. Over a whole turn the rows
at its ends are neighbours, which is decided by formulas: start and step may change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol, Text
from livesheet.workbook import Column, PrintSetup, Sheet
from mechsheet.kinematics.equations import FORCES, RATES
from mechsheet.kinematics.means import LEAST_OF_TURN
from mechsheet.model import WAYS
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks import parabolas, rivals, turning
from mechsheet.sheet.checks.boundless import (
    STRAIGHT,
    STRAIGHT_SIGNED,
    at_pole,
    beyond_rows,
    in_row,
    may_grow,
    unsigned_divisor,
)
from mechsheet.sheet.checks.checks import rows_apart
from mechsheet.sheet.checks.limits import FIRST_ROW, FROM, LAST_ROW, STRETCHES, TO, Limits
from mechsheet.sheet.checks.parabolas import BESIDE, DIFFERENCES, Parabolas, neighbours, vertex_of
from mechsheet.sheet.checks.probes import ALL_ROWS, AT, SIDE, VALUE, Block, Probes
from mechsheet.sheet.checks.same_angle import same_angle
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.columns.bands import band_of_constant
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.over_rows import ends_meet
from mechsheet.sheet.plan import DRIVER, LEAST_PROBED, NUMBER, ROW_COUNT, STATUS, Plan
from mechsheet.sheet.plan import VALUE as FIRST_SHEET_VALUE
from mechsheet.sheet.quoted import ALL, SHOWN, formula
from mechsheet.sheet.symbols import plain
from mechsheet.sheet.table.positions import heading
from mechsheet.sheet.transmission import acute
from mechsheet.units import turn as whole_turn

BOUNDLESS = SIDE + 7
"""The working cell that says whether a quantity grows without bound."""

REACH = 6
"""The working cell of a loop that says whether tolerances reach a change point; how far they reach stands before it."""

SETTLED, IMPROVED = 1e-4, 5e-4
"""The last probe may be worse than the best by the first part of the range, and better than all others by the second; more,
and the value is said to be about right."""

SURE, ABOUT, BEYOND, ROWS = 1, 2, 3, 4
"""What the cell beside an extreme says: that it is right, about right, that it may be elsewhere, beyond what is
given, or that it is of rows only."""

STEEP, COUNTED, ROWS_APART = 5, 6, 7
"""The working cells that say whether velocities and forces have a spike between two rows, how many rows there are, and
whether all sheets have the same ones; behind it, whether each has."""

NEARER = 0.5
"""An angle of transmission that is less than this part of the rows' least one between them makes such a spike: velocities
and forces go with one over its sine, so they are twice as large there."""

TURN = DIFFERENCES
"""Working cells: where the quantity turns back, whether that is about right only, where one more probe would be."""

MOVED = 0.02
"""A place that is moved farther [rows] beyond the probes is about right only: of 500 time ratios those of places that were
moved less far were off by 1.3e-4 at most."""

LEAST_INNER = 7
"""Rows, at least, where an extreme is also looked for between those that are no neighbours of the best."""

TITLE_ROW, ABOUT_ROW, HEAD_ROW, FIRST = 0, 1, 3, 4

Way = Literal["min", "max"]


class Extremes:
    """The sheet, planned before any formula that reads it is written."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.probes = Probes(plan, plan.at.titles["extremes"])
        self.quantities = quantities_of(plan)
        self.whole_row = FIRST
        self.limits = Limits(self.probes, FIRST + 2)
        row = self.limits.end
        self.gaps: dict[int, Block] = {}
        for number in plan.equations.margins if self.limits.count else ():
            self.gaps[number] = Block(row, 2)
            row += 4
        self.loops = {loop.group: row + number for number, loop in enumerate(plan.found.four_bars)}
        row += len(self.loops) + 1 if self.loops else 0
        self.ends: dict[int, Block] = {}
        if self.limits.count and self.quantities and plan.rows >= LEAST_PROBED:
            self.ends = {FROM: Block(row, 1), TO: Block(row + 3, 1)}
            row += 6
        self.blocks: dict[tuple[str, Way], Block] = {}
        for symbol in self.quantities:
            for way in ("min", "max"):
                probes = turning.PROBES if turning.known(plan, symbol) else parabolas.PROBES
                self.blocks[symbol, way] = Block(row, probes)
                row += probes + len(self.ends) + 2
        self.bands: dict[tuple[str, Way], Block] = {}
        for extreme in () if plan.rows_only else banded_extremes(plan):
            self.bands[extreme] = Block(row, 1)
            row += 3
        self._places()

    def _places(self) -> None:
        """Where other sheets find what is here."""
        spots, title = self.plan.at.spots, self.probes.title
        whole = self.probes.cell(self.whole_row, 1)
        spots["#whole"] = Spot(title, whole.row, whole.col)
        spots["#fine"] = Spot(title, whole.row, whole.col + 1)
        spots["#there"] = Spot(title, whole.row, whole.col + 2)
        spots["#rows_apart"] = Spot(title, whole.row, whole.col + ROWS_APART - 1)
        spots[ALL_ROWS.name] = Spot(title, whole.row, whole.col + COUNTED - 1)
        if len(self.plan.found.transmission) > 1:
            spots["#worst_group"] = Spot(title, whole.row, whole.col + 3)
        for (symbol, way), block in self.blocks.items():
            for key, work in ((f"#{way}_{symbol}", 3), (f"#{way}_at_{symbol}", 4), (f"#{way}_about_{symbol}", 5)):
                cell = self.probes.cell(block.row + 2, SIDE + work - 3)
                spots[key] = Spot(title, cell.row, cell.col)
            if symbol in self.plan.found.returning:
                for key, work in (("turns", TURN), ("turns_about", TURN + 1)):
                    cell = self.probes.cell(block.row, work)
                    spots[f"#{way}_{key}_{symbol}"] = Spot(title, cell.row, cell.col)
        for symbol in self.quantities:
            wraps = self._wraps_of(symbol)
            spots[f"#wraps_{symbol}"] = Spot(title, wraps.row, wraps.col)
            for way in ("min", "max") if may_grow(self.plan, symbol) else ():
                cell = self.probes.cell(self.blocks[symbol, way].row + 2, BOUNDLESS)
                spots[f"#{way}_boundless_{symbol}"] = Spot(title, cell.row, cell.col)
        for (symbol, way), block in self.bands.items():
            for name in self.plan.banded[symbol].derivatives:
                spots[f"#{way} {name}"] = Spot(title, block.row + 1, self.probes.at.spots[name].col)
        for group, row in self.loops.items() if self.plan.mechanism.bands is not None else ():
            cell = self.probes.cell(row, REACH)
            spots[f"#reach_{group}"] = Spot(title, cell.row, cell.col)
        for number, block in self.gaps.items():
            for key, work in ((f"#gap_least_{number}", 0), (f"#gap_row_{number}", 1)):
                cell = self.probes.cell(block.row, SIDE + work)
                spots[key] = Spot(title, cell.row, cell.col)

    def sheet(self) -> Sheet:
        """The finished sheet."""
        plan, probes = self.plan, self.probes
        probes.put(TITLE_ROW, 0, plan.text("extremes.title"), styles.TITLE)
        probes.put(ABOUT_ROW, 0, plan.text("extremes.about"), styles.SUBTITLE)
        for column in probes.columns:
            if column.col != STATUS:
                probes.put(HEAD_ROW, column.col, heading(plan, column), styles.HEAD)
        for work, key in ((AT, "row"), (VALUE, "value")):
            probes.put(HEAD_ROW, probes.side + work, plan.text(f"extremes.{key}"), styles.HEAD)
        self._whole()
        probes.work(self.whole_row, 2, "fine", fine=self._inputs_are_fine())
        there = "SUMPRODUCT((numbers=_position)*ISNUMBER(_position))=1"
        probes.work(self.whole_row, 3, there, numbers=Symbol(f"{ALL}#number"))
        if len(plan.found.transmission) > 1:
            rows = [plan.blocks["verdicts"].rows[f"transmission_{group.number}"] for group in plan.found.transmission]
            least = RangeRef(*(CellRef(row, FIRST_SHEET_VALUE, True, True, plan.main) for row in (rows[0], rows[-1])))
            probes.work(self.whole_row, 4, "MATCH(MIN(least),least,0)", least=least)
        if self._steepest:
            probes.work(self.whole_row, STEEP, "steep", steep=self._steepest)
        probes.work(self.whole_row, COUNTED, "rows", rows=ROW_COUNT)
        each = [
            probes.work(self.whole_row, work, "apart", apart=apart)
            for work, apart in enumerate(rows_apart(plan), ROWS_APART + 1)
        ]
        probes.work(self.whole_row, ROWS_APART, "apart", apart=al.total(each))
        self.limits.write()
        for number, block in self.gaps.items():
            self._gap(number, block)
        for loop in plan.found.four_bars:
            self._loop(loop)
        for end, block in self.ends.items():
            self._end(end, block)
        for (symbol, way), block in self.blocks.items():
            self._extreme(symbol, way, block)
            if may_grow(plan, symbol):
                self._boundless(symbol, way, block)
        for (symbol, way), block in self.bands.items():
            self._band(symbol, way, block)
        return Sheet(
            probes.title,
            tuple(probes.cells),
            tuple(probes.alike([*self.limits.blocks, *self.blocks.values()])),
            columns=(
                Column(NUMBER, NUMBER, 5), Column(DRIVER, DRIVER, 11), Column(STATUS, STATUS, 14),
                Column(STATUS + 1, probes.side - 2, 11), Column(probes.side - 1, probes.side - 1, 14),
                Column(probes.side, probes.side + rivals.TWIN, 11),
            ),
            row_heights=((TITLE_ROW, 26.0), (HEAD_ROW, 30.0)),
            freeze=(FIRST, STATUS),
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(footer=plan.footer),
        )  # fmt: skip

    def lengths_of(self, loop: FourBar) -> RangeRef:
        """The cells of a loop's four lengths: ground, first link, coupler, last link; as another sheet reads them."""
        cells = self.probes.cells_across(self.loops[loop.group], 1, 4)
        return RangeRef(replace(cells.start, sheet=self.probes.title), replace(cells.end, sheet=self.probes.title))

    def _loop(self, loop: FourBar) -> None:
        """The four lengths of a loop, and how far tolerances reach in the sum that its type follows from, at most."""
        plan, row = self.plan, self.loops[loop.group]
        self.probes.put(row, self.probes.side, loop.name, styles.LABEL)
        poses = plan.equations.poses
        for work, (link, start, end) in enumerate(loop.sides(plan.mechanism.ground), 1):
            self.probes.work(row, work, "length", length=length_in_cells(link, start, end, poses))
        if plan.mechanism.bands is None:
            return
        bands = [
            band_of_constant(plan.mechanism, plan.equations.equations, length_in_cells(*side, poses))
            for side in loop.sides(plan.mechanism.ground)
        ]
        self.probes.work(
            row, REACH, 'IF(AND(excess<>0,ABS(excess)<=band),words,"")', excess=Symbol(f"#grashof_{loop.group}"),
            band=self.probes.work(row, REACH - 1, "band", band=al.total(bands)), words=plan.text("verdict.grashof.reach"),
        )  # fmt: skip

    def _whole(self) -> None:
        """What the sweep covers: 1 for whole turns whose last row is the first again, 2 where that row is left out,
        else 0."""
        plan, probes = self.plan, self.probes
        probes.put(self.whole_row, probes.side, plan.text("extremes.whole"), styles.LABEL)
        driver = plan.mechanism.driver
        if not driver.link or driver.values or plan.rows < LEAST_OF_TURN:
            probes.work(self.whole_row, 1, "0")
            return
        turn = whole_turn(driver.unit.in_degrees)
        covered = formula("ABS(_step)*(rows-1)/turn", rows=ALL_ROWS, turn=turn)
        if driver.law is not None:
            covered = formula("ABS(last-first)/turn", first=Symbol(SHOWN + driver.law.start),
                              last=Symbol(SHOWN + driver.law.stop), turn=turn)  # fmt: skip
        if tied := plan.equations.equations.tied:
            back = Call("AND", tuple(self._is_back(symbol) for symbol in tied))
            probes.work(
                self.whole_row, 1,
                "IF(AND(ABS(ROUND(covered,0)-covered)<1E-9,ROUND(covered,0)>0),IFERROR(IF(back,1,0),0),0)",
                covered=covered, back=back,
            )  # fmt: skip
            return
        if driver.law is not None:
            probes.work(
                self.whole_row, 1, "IF(AND(covered>0.5,ABS(ROUND(covered,0)-covered)<1E-9),1,0)", covered=covered
            )
            return
        probes.work(
            self.whole_row, 1,
            "IF(ABS(ROUND(covered,0)-covered)<1E-9,IF(ROUND(covered,0)>0,1,0),"
            "IF(ABS(ROUND(more,0)-more)<1E-9,2,0))",
            covered=covered,
            more=formula("ABS(_step)*rows/turn", rows=ALL_ROWS, turn=turn),
        )  # fmt: skip

    def _is_back(self, symbol: str) -> Node:
        """Whether what a gear or a further driver decides is in the last row what it was in the first."""
        spot = self.plan.at.spots[symbol]
        last, first = (
            CellRef(row, spot.col, True, True, spot.sheet) for row in (self.plan.at.last, self.plan.at.first)
        )
        if self.plan.equations.of(symbol).unit.kind != "angle":
            return formula("ABS(last-first)<1E-9*size", last=last, first=first, size=self.plan.size)
        way = formula("(last-first)/turn", last=last, first=first, turn=whole_turn(spot.degrees))
        return formula("ABS(ROUND(way,0)-way)<1E-9", way=way)

    def _inputs_are_fine(self) -> Node:
        """Whether the yellow cells hold what can be, there is such a position, and all that is derived is a number."""
        rows = self.plan.blocks["derived"].rows.values()
        derived = RangeRef(
            CellRef(min(rows), FIRST_SHEET_VALUE, True, True, self.plan.main),
            CellRef(max(rows), FIRST_SHEET_VALUE, True, True, self.plan.main),
        )
        return formula("AND(_inputs=0,_there,ISNUMBER(SUM(derived)))", derived=derived)

    def _end(self, end: int, block: Block) -> None:
        """All quantities where the stretch begins or ends; of several stretches nobody asks, their rows are all."""
        probes, row = self.probes, block.row
        probes.put(row, STATUS, self.plan.text(f"extremes.{'from' if end == FROM else 'to'}"), styles.LABEL)
        edge = self.limits.of_stretch(1, FIRST_ROW if end == FROM else LAST_ROW)
        probes.work(row, AT, "edge", edge=edge)
        probes.work(row + 1, AT, "place", place=self.limits.of_stretch(1, end))
        probes.lay(block, self.quantities)

    # --- one extreme ------------------------------------------------------------------------------------------

    def _extreme(self, symbol: str, way: Way, block: Block) -> None:
        """The block of the smallest or largest value of a quantity."""
        plan, probes, row = self.plan, self.probes, block.row
        column = Symbol(ALL + symbol)
        name = heading(plan, next(column for column in probes.columns if column.symbol == symbol))
        probes.put(row, STATUS, plan.text(f"extremes.{way}"), styles.LABEL)
        probes.put(row + 1, STATUS, name, styles.LABEL)
        of_rows, at = self._best_row(column, way, block)
        if plan.rows_only:
            probes.work(row, AT, "place", place=at)
            probes.work(row, VALUE, "value", value=of_rows)
            if way == "max":
                probes.work(row + 1, SIDE + 2, "0")
            self._result(symbol, way, block)
            return
        wraps = self._wraps_of(symbol)
        if way == "max":
            self._wraps(symbol, wraps)
        probes.work(row, AT, "place", place=self._begun_from(symbol, way, block, at))
        if turning.known(plan, symbol):
            turn = turning.write(probes, block, symbol, way, wraps, self._rows_of_stretch(), self._ends_of_stretch())
        else:
            probes.lay(block, [symbol])
            found = Parabolas(
                probes, block, way, column, self._around(wraps), self._rows_of_stretch(), self._ends_of_stretch(),
                bool(self.ends),
            )  # fmt: skip
            found.write()
            turn = found.turn() if symbol in plan.found.returning else al.ZERO
        here = probes.work(row, VALUE, "INDEX(column,here)", column=column, here=probes.cell(row, AT))
        for index in range(1, block.probes + 1):
            cell = CellRef(row + index, probes.at.spots[symbol].col, False, True)
            probes.work(row + index, VALUE, "IFERROR(cell,best)", cell=cell, best=here)
        for index, end in enumerate(self.ends.values(), block.probes + 1):
            probes.work(row + index, AT, "place", place=probes.cell(end.row + 1, AT))
            cell = CellRef(end.row + 1, probes.at.spots[symbol].col, True, True)
            probes.work(row + index, VALUE, "IFERROR(cell,best)", cell=cell, best=here)
        self._result(symbol, way, block)
        if symbol in plan.found.returning:
            self._turns(block, turn)

    def _best_row(self, column: Node, way: Way, block: Block) -> tuple[CellRef, Node]:
        """The best value of all rows that exist, of no more stretches than are looked at, and its row."""
        probes, row, limits = self.probes, block.row, self.limits
        for number in range(1, STRETCHES + 1):
            first, last = limits.of_stretch(number, FIRST_ROW), limits.of_stretch(number, LAST_ROW)
            probes.work(
                row, SIDE + number - 1,
                f'IF(ISNUMBER(first),{way.upper()}(INDEX(column,first):INDEX(column,last)),"")',
                first=first, last=last, column=column,
            )  # fmt: skip
        bests = probes.cells_across(row, SIDE, STRETCHES)
        most = probes.work(row, SIDE + 3, f"IF(OR(COUNT(bests)=0,_stretches>most),NA(),{way.upper()}(bests))", bests=bests,
                           most=STRETCHES)  # fmt: skip
        begin = formula(
            "INDEX(firsts,MATCH(most,bests,0))", most=most, bests=bests,
            firsts=probes.cells_down(limits.stretch_rows[0], FIRST_ROW, STRETCHES),
        )  # fmt: skip
        at = formula("begin-1+MATCH(most,INDEX(column,begin):INDEX(column,rows),0)", begin=begin, rows=ALL_ROWS,
                     most=most, column=column)  # fmt: skip
        return most, at

    def _begun_from(self, symbol: str, way: Way, block: Block, at: Node) -> Node:
        """The row from which the probes go on: the best one.

        Where that is the motion's first or last row, and the parabola through the three rows there has its vertex outside or
        no farther inside than 0.15 rows, an extreme between other rows may be better: of all but the two rows there the
        best one, if it is better than the end's neighbour. The row at the end has a probe of its own.
        """
        plan, probes, rows = self.plan, self.probes, self.plan.rows
        if not self.ends or rows < LEAST_INNER:
            return at
        best = probes.work(block.row, SIDE + 4, "at", at=at)
        first, col = plan.at.first, plan.at.spots[symbol].col
        y = {index: CellRef(first + index - 1, col, True, True, plan.table) for index in range(1, rows + 1)}
        later, earlier = RangeRef(y[3], y[rows]), RangeRef(y[1], y[rows - 2])
        other = probes.work(
            block.row, SIDE + 5, f"IF(best=1,{way.upper()}(later),IF(best=rows,{way.upper()}(earlier),NA()))",
            best=best, rows=ALL_ROWS, later=later, earlier=earlier,
        )  # fmt: skip
        better, worse = ("<", ">=") if way == "min" else (">", "<=")
        at_first, at_last = (
            formula(f"AND(3.4*next{worse}2.7*end+0.7*third,other{better}next)", end=end, next=next_, third=third,
                    other=other)
            for end, next_, third in ((y[1], y[2], y[3]), (y[rows], y[rows - 1], y[rows - 2]))
        )  # fmt: skip
        return formula(
            "IFERROR(IF(AND(wraps=0,IF(best=1,at_first,at_last)),MATCH(other,column,0),best),best)",
            wraps=self._around(self._wraps_of(symbol)), best=best, at_first=at_first, at_last=at_last, other=other,
            column=Symbol(ALL + symbol),
        )  # fmt: skip

    def _wraps_of(self, symbol: str) -> CellRef:
        return self.probes.cell(self.blocks[symbol, "max"].row + 1, SIDE + 2)

    def _wraps(self, symbol: str, cell: CellRef) -> None:
        """Whether the ends of the rows are neighbours: what the whole sheet says, or 0 where something is missing or the
        quantity does not come back."""
        plan, probes = self.plan, self.probes
        first, last = self._rows_of_stretch()
        ends = [CellRef(at, plan.at.spots[symbol].col, True, True, plan.table) for at in (plan.at.first, plan.at.last)]
        unit = plan.mechanism.given_unit(symbol) or plan.equations.of(symbol).unit
        meet = ends_meet(plan, symbol, unit, Symbol(ALL + symbol), (ends[0], ends[1]))
        probes.work(
            cell.row, SIDE + 2, "IFERROR(IF(AND(_whole>0,first=1,last=rows,meet),_whole,0),0)",
            first=first, last=last, rows=ALL_ROWS, meet=meet,
        )  # fmt: skip

    def _rows_of_stretch(self) -> tuple[CellRef, CellRef]:
        """The first and the last row of the first stretch."""
        return self.limits.of_stretch(1, FIRST_ROW), self.limits.of_stretch(1, LAST_ROW)

    def _ends_of_stretch(self) -> tuple[CellRef, CellRef]:
        """Where the first stretch begins and ends, between rows."""
        return self.limits.of_stretch(1, FROM), self.limits.of_stretch(1, TO)

    def _around(self, wraps: Node) -> Node:
        """Whether probes go on beyond the last row, into the first: never by a motion law, whose rows end in time."""
        return wraps if self.plan.mechanism.driver.law is None else al.ZERO

    def _result(self, symbol: str, way: Way, block: Block) -> None:
        """The best of the row and the probes, where it is, and whether the probes have settled."""
        plan, probes, row = self.plan, self.probes, block.row
        count = 1 if plan.rows_only else block.probes + len(self.ends) + 1
        values = probes.cells_down(row, VALUE, count)
        # each stretch would need probes of its own, and where it ends must be known
        known = "best" if count == 1 else "IF(_rows_only,of_rows,best)"
        value = probes.work(
            row + 2, SIDE, known, styles.RESULT, best=Call(way.upper(), (values,)), of_rows=probes.cell(row, SIDE + 3)
        )
        place = self._place(row, count)
        if count == 1:
            probes.work(row + 2, SIDE + 1, "INDEX(drivers,place)", styles.RESULT, place=place,
                        drivers=Symbol(ALL + plan.mechanism.driver.symbol))  # fmt: skip
            probes.work(row + 2, SIDE + 2, "sure", sure=SURE)
            return
        wraps = self._around(self._wraps_of(symbol))
        within = formula(
            "IF(wraps>0,1+MOD(place-1,IF(wraps=1,rows-1,rows)),place)", wraps=wraps, place=place, rows=ALL_ROWS
        )
        probes.work(row + 2, SIDE + 1, "driver", styles.RESULT, driver=driver_at(plan, within))
        other = probes.cell(self.blocks[symbol, "max" if way == "min" else "min"].row, SIDE + 3)
        low, high = self._ends_of_stretch()
        # where the last probe is worse than the best, the quantity is no parabola there; at an end that is as it should be
        probes.work(
            row + 2, SIDE + 2,
            f"IF(_rows_only,{ROWS},IFERROR(IF(elsewhere,{BEYOND},IF(AND(wraps=0,OR(place=low,place=high)),{SURE},"
            "IF(OR(ABS(value-last)>settled*ABS(value-other),ABS(value-before)>improved*ABS(value-other)),"
            f"{ABOUT},{SURE}))),{SURE}))",
            elsewhere=self._elsewhere(symbol, row),
            value=value, last=probes.cell(row + block.probes, VALUE), settled=SETTLED, improved=IMPROVED, other=other,
            before=Call(way.upper(), (probes.cells_down(row, VALUE, block.probes),)), wraps=wraps, place=place,
            low=low, high=high,
        )  # fmt: skip
        most = probes.cell(row, SIDE + 3)
        allowed = formula("settled*ABS(most-other)", settled=SETTLED, most=most, other=other)
        rivals.write(
            probes, row, way, symbol, self._rows_of_stretch(), wraps, value, allowed, probes.cell(row, AT), most
        )

    @cached_property
    def _steepest(self) -> Node | None:
        """Whether a group comes much nearer to a dead centre between the rows than in them: then its velocities and forces
        have a spike there, of which the rows show nothing. None without an angle of transmission."""
        tests = []
        for group in () if self.plan.rows_only else self.plan.found.transmission:
            low, high = (self.blocks[group.transmission, way].row for way in WAYS.values())
            found, rows = (
                Call("MIN", acute(self.probes.cell(low + at, SIDE + work), self.probes.cell(high + at, SIDE + work),
                                  group.kind != "RRR"))
                for at, work in ((2, 0), (0, 3))
            )  # fmt: skip
            tests.append(formula("found<part*rows", found=found, rows=rows, part=NEARER))
        return Call("OR", tuple(tests)) if tests else None

    def _elsewhere(self, symbol: str, row: int) -> Node:
        """Whether a quantity may be beyond what the probes have found: beside another row, or, where it is or reads a
        velocity or a force, in a spike."""
        rival = rivals.there_are(self.probes, row)
        roles = {each.symbol: each.equation.role for each in self.probes.columns if each.equation is not None}
        if self._steepest is None or not any(
            roles.get(name) in (*RATES, *FORCES) for name in self.probes.needed([symbol])
        ):
            return rival
        return formula("OR(rival,spikes)", rival=rival, spikes=self.probes.cell(self.whole_row, STEEP))

    def _turns(self, block: Block, turn: Node) -> None:
        """Where the quantity turns back, for a ratio of times, and whether that is about right only.

        Beside an extreme a quantity is flat: the best probe has its value long before it has its place. So the place is
        followed to where one more probe would be, unless that is far away.
        """
        probes, row, best = self.probes, block.row, self._place(block.row, block.probes + len(self.ends) + 1)
        there = probes.work(row, TURN + 2, 'IFERROR(turn,"")', turn=turn)
        probes.work(row, TURN, "IFERROR(IF(ABS(there-best)>most,best,there),best)", there=there, best=best, most=BESIDE)
        probes.work(
            row, TURN + 1, f"IF(IFERROR(ABS(there-best)>most,TRUE),{ABOUT},{SURE})", there=there, best=best, most=MOVED
        )

    def _boundless(self, symbol: str, way: Way, block: Block) -> None:
        """Whether the quantity has no largest or smallest value."""
        probes, row = self.probes, block.row
        worst = probes.cell(self.blocks[symbol, "max" if way == "min" else "min"].row, SIDE + 3)
        found = beyond_rows(probes.cell(row + 2, SIDE), probes.cell(row, SIDE + 3), worst, self._rows_of_stretch())
        if not turning.known(self.plan, symbol):
            before, here, after = (probes.cell(row + 1, SIDE + work) for work in (4, 5, 6))
            straight = STRAIGHT
            if (divisor := unsigned_divisor(self.plan, symbol)) is not None:
                before, after = self._signed(symbol, divisor, block)
                straight = STRAIGHT_SIGNED
            found = formula("OR(found,pole)", found=found, pole=at_pole(before, here, after, straight))
        probes.work(row + 2, BOUNDLESS, "IFERROR(found,FALSE)", found=found)

    def _signed(self, symbol: str, divisor: Node, block: Block) -> tuple[CellRef, CellRef]:
        """The quantity in the rows beside the middle one of three: with the other sign where what it is divided by as an
        absolute value has another sign there."""
        probes, row = self.probes, block.row
        around = self._around(self._wraps_of(symbol))
        before, here, after = (
            in_row(self.plan, divisor, number)
            for number in neighbours(probes.cell(row + 1, SIDE + 3), around, ALL_ROWS)
        )
        value = {work: probes.cell(row + 1, SIDE + work) for work in (4, 6)}
        return (
            probes.work(row + 2, SIDE + 4, "value*SIGN(there*here)", value=value[4], there=before, here=here),
            probes.work(row + 2, SIDE + 6, "value*SIGN(there*here)", value=value[6], there=after, here=here),
        )

    def _band(self, symbol: str, way: Way, block: Block) -> None:
        """The derivatives by dimensions where a quantity is smallest or largest: as this changes, so does the extreme."""
        probes, extreme = self.probes, self.blocks[symbol, way]
        probes.put(block.row, STATUS, self.plan.text("extremes.band", symbol=plain(symbol)), styles.LABEL)
        probes.work(block.row, AT, "anchor", anchor=probes.cell(extreme.row, AT))
        place = self._place(extreme.row, extreme.probes + len(self.ends) + 1)
        probes.work(block.row + 1, AT, "place", place=place)
        probes.lay(block, self.plan.banded[symbol].derivatives)

    def _place(self, row: int, count: int) -> Node:
        """Where the best of a block's row and probes is."""
        values, places = self.probes.cells_down(row, VALUE, count), self.probes.cells_down(row, AT, count)
        value = self.probes.cell(row + 2, SIDE)
        return formula("INDEX(places,MATCH(value,values,0))", places=places, value=value, values=values)

    # --- between the rows -------------------------------------------------------------------------------------

    def _gap(self, number: int, block: Block) -> None:
        """The least margin of a group between rows that exist: two probes where the parabola through the rows dips
        lowest."""
        plan, probes, row = self.plan, self.probes, block.row
        symbol = plan.equations.margins[number]
        margins, least = Symbol(ALL + symbol), Symbol(f"{ALL}#least_{number}")
        probes.put(row, probes.side - 1, plan.text("extremes.gap", number=number), styles.LABEL)
        here = probes.work(row, AT, "IF(COUNT(least)=0,NA(),MATCH(MIN(least),least,0))", least=least)
        probes.lay(block, [symbol])
        before, value, after = (
            probes.work(row + (0 if index == 1 else 1), VALUE if index == 1 else SIDE + index,
                        f"INDEX(margins,here{step})", margins=margins, here=here)
            for index, step in enumerate(("-1", "", "+1"))
        )  # fmt: skip
        probes.work(row + 1, AT, "here+IFERROR(MAX(-1,MIN(1,(before-after)/(2*(before-2*value+after)))),0)",
                    here=here, before=before, value=value, after=after)  # fmt: skip
        for index in (1, 2):
            cell = CellRef(row + index, plan.at.spots[symbol].col, False, True)
            probes.work(row + index, VALUE, "cell", cell=cell)
        first, there = probes.cell(row + 1, AT), probes.cell(row + 1, VALUE)
        # of a dip that is no parabola the first probe may be higher than the row: then it lies on the other side
        right = formula("(first>here)=(there<=value)", first=first, here=here, there=there, value=value)
        outer = formula("IF(right,here+1,here-1)", right=right, here=here)
        beyond = formula("IF(right,after,before)", right=right, before=before, after=after)
        vertex = vertex_of([(here, value), (first, there), (outer, beyond)])
        probes.work(row + 2, AT, "IFERROR(MAX(here-1,MIN(here+1,vertex)),here)", here=here, vertex=vertex)
        probes.work(row, SIDE, "MIN(margins)", margins=probes.cells_down(row, VALUE, 3))
        probes.work(row, SIDE + 1, "first", first=first)


def about(plan: Plan, symbol: str, ways: Sequence[Way] = ("min", "max")) -> Node:
    """What is added to the words of an extreme, or of two: how much it is to be doubted."""
    rows = plan.text("verdict.rows.only")
    if plan.between_unseen:
        return Text(rows)
    said = _doubt(plan, symbol, ways, ("about",), ("about", "beyond", "rows.only"))
    if not may_grow(plan, symbol):
        return said
    return formula("IF(_rows_only,rows,said)", rows=rows, said=said)  # whether there is a bound nobody knows then


def about_turns(plan: Plan, symbol: str) -> Node:
    """The same of a ratio of times over whole turns: places count, too; one that may be elsewhere makes it about right."""
    return _doubt(plan, symbol, ("min", "max"), ("about", "turns_about"), ("about", "about"))


def _doubt(plan: Plan, symbol: str, ways: Sequence[Way], flags: Sequence[str], words: Sequence[str]) -> Node:
    """The words of the largest doubt: those of the cells' numbers from 2 on."""
    doubt = Call("MAX", tuple(Symbol(f"#{way}_{flag}_{symbol}") for flag in flags for way in ways))
    said: Node = Call("CHOOSE", (doubt, Text(""), *(Text(plan.text(f"verdict.{word}")) for word in words)))
    without = boundless(plan, symbol, ways)
    if without is not None:
        said = formula("IF(without,words,said)", without=without, words=plan.text("verdict.boundless"), said=said)
    return said


def boundless(plan: Plan, symbol: str, ways: Sequence[Way]) -> Node | None:
    """Whether a quantity has no smallest or no largest value; None where it cannot grow without bound."""
    if not may_grow(plan, symbol):
        return None
    flags = tuple(Symbol(f"#{way}_boundless_{symbol}") for way in ways)
    return Call("OR", flags) if len(flags) > 1 else flags[0]


def where_bounded(plan: Plan, symbol: str, value: Node, ways: Sequence[Way] = ("min", "max")) -> Node:
    """A value that follows from extremes; #N/A where there are none."""
    without = boundless(plan, symbol, ways)
    return value if without is None else formula("IF(without,NA(),value)", without=without, value=value)


def banded_extremes(plan: Plan) -> list[tuple[str, Way]]:
    """The extremes that summaries with a band are of."""
    asked = plan.mechanism.bands.summaries if plan.mechanism.bands else ()
    summaries = [summary for summary in plan.mechanism.summaries if summary.symbol in asked]
    return list(dict.fromkeys((each.of, way) for each in summaries for way in each.take.ways))


def quantities_of(plan: Plan) -> tuple[str, ...]:
    """Symbols whose extremes are asked for: by the lines of the first sheet, and by the description's summaries."""
    wanted = [each.of for each in plan.mechanism.summaries if each.take.ways and same_angle(plan, each.of) is None]
    driver = plan.mechanism.driver.symbol
    asked = [*plan.found.extremes, *(name for name in wanted if has_column(plan, name))]
    return tuple(dict.fromkeys(name for name in asked if name != driver))


def has_column(plan: Plan, symbol: str) -> bool:
    """Whether a quantity changes from row to row: not a fixed point's coordinate, nor a speed that is one number."""
    return plan.at.spots[symbol].column
