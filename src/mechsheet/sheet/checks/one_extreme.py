"""One search of an extreme: from where it begins, what it finds, and how sure that is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Text, with_symbols
from mechsheet.kinematics.equations import FORCES, RATES
from mechsheet.model import WAYS, Way
from mechsheet.sheet import styles
from mechsheet.sheet.checks import rivals
from mechsheet.sheet.checks.boundless import (
    STRAIGHT,
    STRAIGHT_SIGNED,
    at_pole,
    beyond_rows,
    in_row,
    may_grow,
    seen_by_rates,
    unsigned_divisor,
)
from mechsheet.sheet.checks.bracket import BRACKET, FIRST_PROBE, NARROWED, PLACE, PROBE, PROBES, ROOTED, VERTEX
from mechsheet.sheet.checks.limits import FIRST_ROW, FROM, LAST_ROW, STRETCHES, TO, Limits
from mechsheet.sheet.checks.search_table import (
    KNOWN,
    LABEL,
    LIMIT,
    PLACE_COL,
    PROBE_COL,
    SENSE,
    SIDE,
    VERTEX_COL,
    SearchTable,
    whole,
)
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.over_rows import ends_meet
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.positions import heading
from mechsheet.sheet.transmission import acute

(
    OF_ROWS,
    BEST,
    HERE,
    WRAPS,
    AT_LOW,
    AT_HIGH,
    START,
    LEFT,
    RIGHT,
    OTHER,
    VALUE,
    PLACED,
    WHERE,
    ABOUT_VALUE,
    TURN,
    TURN_ABOUT,
    BOUNDLESS,
) = range(1, 18)
"""Working cells beside the first row of a search: the best value of the rows, its row, that from which the search begins;
whether the ends of the rows are neighbours; values where the stretch begins and ends; the place from which the search begins
and those beside it; the best of other rows; what is found, its place, the value of the driver there, how sure it is; where
the quantity turns back, and how sure that is; whether it is without bound."""

MIDDLE, BEFORE, CENTRE, AFTER = range(BOUNDLESS + 1, BOUNDLESS + 5)
"""Behind them: three rows that follow one another, and the quantity in them."""

DIFFERENCES, VERTEX_OF_ALL = BOUNDLESS + 5, BOUNDLESS + 8
"""Behind them, beside the probes: their divided differences of first, second and third order; and where the curve through
them turns back."""

RIVALS = BOUNDLESS + 9
"""Behind them, in four rows, those of `rivals`."""

COLUMNS = RIVALS + rivals.TWIN
"""How many working cells there are beside a search."""

SETTLED = 1e-4
"""The last probe may be worse than the best, or better than all others, by this part of the range; more, and the value is
said to be about right."""

SURE, ABOUT, BEYOND, ROWS = 1, 2, 3, 4
"""What the cell beside an extreme says: that it is right, about right, that it may be elsewhere, beyond what is
given, or that it is of rows only."""

NEARER = 0.5
"""An angle of transmission that is less than this part of the rows' least one between them makes such a spike: velocities
and forces go with one over its sine, so they are twice as large there."""

MOVED = 0.02
"""A place that is moved farther [rows] beyond the probes is about right only: of 500 time ratios those of places that were
moved less far were off by 1.3e-4 at most."""


LEAST_INNER = 7
"""Rows, at least, where an extreme is also looked for between those that are no neighbours of the best."""

ARRIVED = 1e-6
"""Two probes that are no farther from each other [rows] have found the place; their difference is rounding."""

FAR = 0.1
"""A place is followed no farther [rows] beyond the best probe to where the quantity turns back."""


@dataclass(frozen=True, slots=True)
class Sought:
    """An extreme that is searched: the first row of its search on the sheet."""

    symbol: str
    way: Way
    row: int


@dataclass
class Searches:
    """All of them.

    ends     rows with all quantities where the stretch begins and ends; none where nobody looks for limits
    sought   by quantity and way;  steep: the cell that says whether velocities and forces have a spike
    """

    table: SearchTable
    limits: Limits
    ends: Mapping[int, int]
    sought: Mapping[tuple[str, Way], Sought]
    steep: CellRef

    @property
    def plan(self) -> Plan:
        """The plan of the workbook."""
        return self.table.plan

    def search(self, row: int, begin: dict[str, Node]) -> None:
        """The rows of a bracket; places count by roots beside a limit, where the sheet looks for these."""
        probing = {VERTEX_COL: ("vertex", VERTEX), PLACE_COL: ("probe", PROBE)}
        if "side" in begin:
            probing = {VERTEX_COL: ("vertex", VERTEX), PROBE_COL: ("probe", PROBE), PLACE_COL: ("place", PLACE)}
        self.table.search(row, PROBES + 1, begin | {"probe": FIRST_PROBE}, BRACKET, NARROWED, probing)

    def value(self, row: int, symbol: str) -> None:
        """What the probes have found: where there is no position, nothing better than what is known."""
        table = self.table
        known = CellRef(row, KNOWN + BRACKET.index("f_middle"), False, True)
        value = formula("IFERROR(cell,known)", cell=table.quantity(row, symbol), known=known)
        table.fill(row, table.value_col, value, PROBES)

    def known(self, row: int, name: str) -> CellRef:
        """A cell of what a row of a search knows."""
        return CellRef(row, KNOWN + BRACKET.index(name), False, True)

    @staticmethod
    def _sense(row: int) -> CellRef:
        return CellRef(row, SENSE, False, True)

    def _place_of(self, row: int, counted: Node) -> Node:
        """A place of a search in rows; `counted`: as the bracket counts it."""
        if not self.ends:
            return counted
        return with_symbols(
            PLACE,
            {"probe": counted, "side": CellRef(row, SIDE, False, True), "limit": CellRef(row, LIMIT, False, True)},
        )

    def write(self, sought: Sought) -> None:
        """The search of the smallest or largest value of a quantity."""
        plan, table, row, symbol = self.plan, self.table, sought.row, sought.symbol
        name = heading(plan, next(column for column in table.columns if column.symbol == symbol))
        table.put(row, LABEL, name, styles.LABEL)
        table.put(row + 1, LABEL, plan.text(f"extremes.{sought.way}"), styles.LABEL)
        self._best_row(sought)
        if plan.rows_only:
            if sought.way == "max":
                table.work(row, WRAPS, "0")
            self._result_of_rows(sought)
            return
        self._wraps(sought)
        here = table.work(row, HERE, "here", here=self._begun_from(sought))
        value = formula("INDEX(column,here)", column=whole(symbol), here=here)
        self.search(row, self._begin(sought, here, value))
        table.lay(row, PROBES, [symbol])
        self.value(row, symbol)
        self._result(sought)
        if symbol in plan.found.returning:
            self._turns(sought)
        if may_grow(plan, symbol):
            self._boundless(sought)

    def _best_row(self, sought: Sought) -> None:
        """The best value of all rows that close, of no more stretches than are looked at, and the first row that has it."""
        table, row, column = self.table, sought.row, whole(sought.symbol)
        said, stretches = self.plan.places.status.whole(), self.plan.searched.count.cell
        bests = Call(f"{sought.way.upper()}IFS", (column, said, Text(self.plan.ok)))
        best = table.work(
            row, OF_ROWS, "IF(OR(stretches=0,stretches>most),NA(),bests)", stretches=stretches, most=STRETCHES, bests=bests,
        )  # fmt: skip
        table.work(
            row, BEST, "begin-1+MATCH(best,INDEX(column,begin):INDEX(column,rows),0)", begin=self._rows_of_stretch()[0],
            rows=table.rows, best=best, column=column,
        )  # fmt: skip

    def _begin(self, sought: Sought, here: Node, value: Node) -> dict[str, Node]:
        """What the first row knows: the best row (or the end of the stretch, where that is better) and its neighbours."""
        table, row, column = self.table, sought.row, whole(sought.symbol)
        first, last = self._rows_of_stretch()
        low, high = self._ends_of_stretch()
        wraps = self._around(sought)
        begin: dict[str, Node] = {"sense": al.number(1.0 if sought.way == "min" else -1.0)}
        start: Node = here
        if self.ends:
            at_low, at_high = (
                table.work(row, work, "IFERROR(cell,value)", cell=replace(table.quantity(at, sought.symbol), row_abs=True),
                           value=value)
                for work, at in zip((AT_LOW, AT_HIGH), self.ends.values(), strict=True)
            )  # fmt: skip
            start = table.work(
                row, START, "IF(wraps>0,here,IF(AND(low<first,sense*(at_low-value)<0),IF(sense*(at_high-at_low)<0,high,low),"
                "IF(AND(high>last,sense*(at_high-value)<0),high,here)))", sense=self._sense(row),
                wraps=wraps, here=here, low=low, high=high, first=first, last=last, at_low=at_low, at_high=at_high,
                value=value,
            )  # fmt: skip
        left = formula("IF(wraps>0,start-1,MAX(low,ROUNDUP(start,0)-1))", wraps=wraps, start=start, low=low)
        right = formula("IF(wraps>0,start+1,MIN(high,ROUNDDOWN(start,0)+1))", wraps=wraps, start=start, high=high)
        turned = formula("IF(wraps=1,rows-1,rows)", wraps=wraps, rows=table.rows)
        before, after = (
            formula("INDEX(column,IF(wraps>0,1+MOD(place-1,turned),place))", column=column, wraps=wraps, turned=turned,
                    place=place)
            for place in (left, right)
        )  # fmt: skip
        if not self.ends:
            begin |= {"near": here, "left": left, "middle": here, "right": right, "f_left": before, "f_middle": value,
                      "f_right": after}  # fmt: skip
            return begin
        lefts, rights = (table.work(row, work, "place", place=place) for work, place in ((LEFT, left), (RIGHT, right)))
        before, after = (
            formula("IF(AND(wraps=0,place=end),at_end,INDEX(column,IF(wraps>0,1+MOD(place-1,turned),place)))", column=column,
                    wraps=wraps, turned=turned, place=place, end=end, at_end=at_end)
            for place, end, at_end in ((lefts, low, at_low), (rights, high, at_high))
        )  # fmt: skip
        side = formula(
            "IF(wraps>0,0,IF(AND(left=low,low<first),1,IF(AND(right=high,high>last),-1,0)))", wraps=wraps, left=lefts,
            right=rights, low=low, high=high, first=first, last=last,
        )  # fmt: skip
        counted = {
            name: with_symbols(ROOTED, {"place": place})
            for name, place in (("left", lefts), ("middle", start), ("right", rights))
        }
        return begin | counted | {
            "near": formula("MAX(first,MIN(last,ROUND(start,0)))", first=first, last=last, start=start),
            "side": side,
            "limit": formula("IF(side<0,high,low)", low=low, high=high),
            "f_left": before,
            "f_middle": formula("IF(start=here,value,IF(start=low,at_low,at_high))", start=start, here=here, value=value,
                                low=low, at_low=at_low, at_high=at_high),
            "f_right": after,
        }  # fmt: skip

    def _begun_from(self, sought: Sought) -> Node:
        """The row from which the search begins: the best one.

        Where that is the motion's first or last row, and the parabola through the three rows there has its vertex outside or
        no farther inside than 0.15 rows, an extreme between other rows may be better: of all but the two rows there the
        best one, if it is better than the end's neighbour. The row at the end has a probe of its own.
        """
        plan, table, rows, way = self.plan, self.table, self.plan.rows, sought.way
        best = table.near(sought.row, BEST)
        if not self.ends or rows < LEAST_INNER:
            return best
        first, col = plan.at.first, plan.at.spots[sought.symbol].col
        y = {
            index: CellRef(first + index - 1, col, True, True, plan.at.spots[sought.symbol].sheet)
            for index in range(1, rows + 1)
        }
        later, earlier = RangeRef(y[3], y[rows]), RangeRef(y[1], y[rows - 2])
        other = table.work(
            sought.row, OTHER, f"IF(best=1,{way.upper()}(later),IF(best=rows,{way.upper()}(earlier),NA()))",
            best=best, rows=table.rows, later=later, earlier=earlier,
        )  # fmt: skip
        at_first, at_last = (
            formula("AND(sense*(2.7*end+0.7*third-3.4*next)<=0,sense*(other-next)<0)", sense=self._sense(sought.row),
                    end=end, next=next_, third=third, other=other)
            for end, next_, third in ((y[1], y[2], y[3]), (y[rows], y[rows - 1], y[rows - 2]))
        )  # fmt: skip
        return formula(
            "IFERROR(IF(AND(wraps=0,IF(best=1,at_first,at_last)),MATCH(other,column,0),best),best)",
            wraps=self._around(sought), best=best, at_first=at_first, at_last=at_last, other=other,
            column=whole(sought.symbol),
        )  # fmt: skip

    def _wraps(self, sought: Sought) -> None:
        """Whether the ends of the rows are neighbours: what the whole sheet says, or 0 where something is missing or the
        quantity does not come back."""
        plan, row, symbol = self.plan, sought.row, sought.symbol
        if sought.way == "min":
            self.table.work(row, WRAPS, "wraps", wraps=self.table.near(self.opposite(sought).row, WRAPS))
            return
        first, last = self._rows_of_stretch()
        spot = plan.at.spots[symbol]
        ends = [CellRef(at, spot.col, True, True, spot.sheet) for at in (plan.at.first, plan.at.last)]
        unit = plan.mechanism.given_unit(symbol) or plan.equations.of(symbol).unit
        meet = ends_meet(plan, symbol, unit, whole(symbol), (ends[0], ends[1]))
        self.table.work(
            row, WRAPS, "IFERROR(IF(AND(whole>0,first=1,last=rows,meet),whole,0),0)", whole=plan.searched.whole.cell,
            first=first, last=last, rows=self.table.rows, meet=meet,
        )  # fmt: skip

    def _rows_of_stretch(self) -> tuple[CellRef, CellRef]:
        """The first and the last row of the first stretch."""
        return self.limits.of_stretch(1, FIRST_ROW), self.limits.of_stretch(1, LAST_ROW)

    def _ends_of_stretch(self) -> tuple[CellRef, CellRef]:
        """Where the first stretch begins and ends, between rows."""
        return self.limits.of_stretch(1, FROM), self.limits.of_stretch(1, TO)

    def _around(self, sought: Sought) -> Node:
        """Whether probes go on beyond the last row, into the first: never by a motion law, whose rows end in time."""
        return self.table.near(sought.row, WRAPS) if self.plan.mechanism.driver.law is None else al.ZERO

    def _result_of_rows(self, sought: Sought) -> None:
        """The best of the rows, where nobody looks between them."""
        table, row = self.table, sought.row
        table.work(row, VALUE, "best", styles.RESULT, best=table.near(row, OF_ROWS))
        table.work(row, WHERE, "INDEX(drivers,place)", styles.RESULT, place=table.near(row, BEST),
                   drivers=whole(self.plan.mechanism.driver.symbol))  # fmt: skip
        table.work(row, ABOUT_VALUE, "sure", sure=SURE)

    def _result(self, sought: Sought) -> None:
        """The best of the rows and the probes, where it is, and whether the search has settled."""
        table, row, last = self.table, sought.row, sought.row + PROBES
        of_rows, wraps = table.near(row, OF_ROWS), self._around(sought)
        found, rows_only = self.known(last, "f_middle"), self.plan.searched.rows_only.cell
        # each stretch would need a search of its own, and where it ends must be known
        value = table.work(
            row, VALUE, "IF(rows_only,of_rows,IFERROR(best,of_rows))", styles.RESULT, rows_only=rows_only, of_rows=of_rows,
            best=formula("IF(sense*(of_rows-found)<0,of_rows,found)", sense=self._sense(row), of_rows=of_rows, found=found),
        )  # fmt: skip
        place = table.work(
            row, PLACED, "IF(rows_only,best,IF(value=found,place,best))", rows_only=rows_only, value=value, found=found,
            best=table.near(row, BEST), place=self._place_of(last, self.known(last, "middle")),
        )  # fmt: skip
        within = formula(
            "IF(wraps>0,1+MOD(place-1,IF(wraps=1,rows-1,rows)),place)", wraps=wraps, place=place, rows=table.rows
        )
        table.work(row, WHERE, "driver", styles.RESULT, driver=driver_at(self.plan, within))
        other = table.near(self.opposite(sought).row, OF_ROWS)
        low, high = self._ends_of_stretch()
        # where the last probe is worse than the best, the quantity is no parabola there; at an end that is as it should be
        table.work(
            row, ABOUT_VALUE,
            f"IF(rows_only,{ROWS},IFERROR(IF(elsewhere,{BEYOND},IF(AND(wraps=0,OR(place=low,place=high)),{SURE},"
            f"IF(MAX(ABS(value-last),ABS(value-before))>settled*ABS(value-other),{ABOUT},{SURE}))),{SURE}))",
            rows_only=rows_only, elsewhere=self._elsewhere(sought), value=value,
            last=CellRef(last - 1, table.value_col, False, True), settled=SETTLED, other=other,
            before=self.known(last - 1, "f_middle"), wraps=wraps,
            place=place, low=low, high=high,
        )  # fmt: skip
        allowed = formula("settled*ABS(most-other)", settled=SETTLED, most=of_rows, other=other)
        rivals.write(table, row, RIVALS, self._sense(row), sought.symbol, self._rows_of_stretch(), wraps, value, allowed,
                     table.near(row, HERE), of_rows)  # fmt: skip

    def opposite(self, sought: Sought) -> Sought:
        """The search of the quantity's other extreme."""
        return self.sought[sought.symbol, "max" if sought.way == "min" else "min"]

    @cached_property
    def steepest(self) -> Node | None:
        """Whether a group comes much nearer to a dead centre between the rows than in them: then its velocities and forces
        have a spike there, of which the rows show nothing. None without an angle of transmission."""
        tests = []
        for group in () if self.plan.rows_only else self.plan.found.transmission:
            low, high = (self.sought[group.transmission, way].row for way in WAYS.values())
            found, rows = (
                Call("MIN", acute(self.table.near(low, work), self.table.near(high, work), group.kind != "RRR"))
                for work in (VALUE, OF_ROWS)
            )  # fmt: skip
            tests.append(formula("found<part*rows", found=found, rows=rows, part=NEARER))
        return Call("OR", tuple(tests)) if tests else None

    def _elsewhere(self, sought: Sought) -> Node:
        """Whether a quantity may be beyond what the probes have found: beside another row, or, where it is or reads a
        velocity or a force, in a spike."""
        rival = rivals.there_are(self.table, sought.row, RIVALS)
        roles = {each.symbol: each.equation.role for each in self.table.columns if each.equation is not None}
        if self.steepest is None or not any(
            roles.get(name) in (*RATES, *FORCES) for name in self.table.needed([sought.symbol])
        ):
            return rival
        return formula("OR(rival,spikes)", rival=rival, spikes=self.steep)

    def _turns(self, sought: Sought) -> None:
        """Where the quantity turns back, for a ratio of times, and whether that is about right only.

        Beside an extreme a quantity is flat: the best probe has its value long before it has its place. So the place is
        followed to where the curve through the probes turns, unless that is far away.
        """
        table, row, best = self.table, sought.row, self.table.near(sought.row, PLACED)
        counted = table.work(row + 1, VERTEX_OF_ALL, "vertex", vertex=self._cubic(row + 1))
        there = table.work(row, VERTEX_OF_ALL, 'IFERROR(place,"")', place=self._place_of(row, counted))
        table.work(row, TURN, "IFERROR(IF(ABS(there-best)>most,best,there),best)", there=there, best=best, most=FAR)
        table.work(
            row,
            TURN_ABOUT,
            f"IF(IFERROR(ABS(there-best)>most,TRUE),{ABOUT},{SURE})",
            there=there,
            best=best,
            most=MOVED,
        )

    def _cubic(self, row: int) -> Node:
        """Where the cubic through the probes of four rows (Newton's form, over the way from the last) has its extreme."""
        table = self.table
        counted = PROBE_COL if self.ends else PLACE_COL
        at, known = (
            [CellRef(row + index, col, False, True) for index in range(4)] for col in (counted, table.value_col)
        )
        for order in range(1, 4):
            for index in range(3, order - 1, -1):
                known[index] = table.work(
                    row + index, DIFFERENCES + order - 1, 'IFERROR((y-y_before)/(x-x_before),"")', y=known[index],
                    y_before=known[index - 1], x=at[index], x_before=at[index - order],
                )  # fmt: skip
        first, second, third = (table.near(row + 3, DIFFERENCES + order) for order in range(3))
        far, before, last = at[1:]
        linear = formula("2*(second+third*(2*last-before-far))", second=second, third=third, last=last, before=before,
                         far=far)  # fmt: skip
        constant = formula("first+(last-before)*(second+third*(last-far))", first=first, second=second, third=third,
                           last=last, before=before, far=far)  # fmt: skip
        # of both roots the one beside the last probe
        way = formula("2*constant/(linear+SIGN(linear)*SQRT(linear^2-12*third*constant))", linear=linear,
                      constant=constant, third=third)  # fmt: skip
        return formula("IF(ABS(last-before)<arrived,last,last-way)", last=last, before=before, arrived=ARRIVED, way=way)

    def _boundless(self, sought: Sought) -> None:
        """Whether the quantity has no largest or smallest value."""
        plan, table, row, symbol = self.plan, self.table, sought.row, sought.symbol
        first, last = self._rows_of_stretch()
        worst = table.near(self.opposite(sought).row, OF_ROWS)
        found = beyond_rows(table.near(row, VALUE), table.near(row, OF_ROWS), worst, (first, last))
        if not seen_by_rates(plan.mechanism, {column.symbol for column in plan.rates}, symbol):
            wraps = self._around(sought)
            middle = table.work(row, MIDDLE, "IF(wraps>0,here,MAX(first+1,MIN(last-1,here)))", wraps=wraps,
                                here=table.near(row, HERE), first=first, last=last)  # fmt: skip
            places = neighbours(middle, wraps, table.rows)
            straight, divisor = STRAIGHT, unsigned_divisor(plan, symbol)
            of_rows = [formula("INDEX(column,number)", column=whole(symbol), number=place) for place in places]
            if divisor is not None:
                straight = STRAIGHT_SIGNED
                before, here, after = (in_row(plan, divisor, place) for place in places)
                for at, there in ((0, before), (2, after)):
                    of_rows[at] = formula("value*SIGN(there*here)", value=of_rows[at], there=there, here=here)
            cells = [
                table.work(row, work, "value", value=value)
                for work, value in zip((BEFORE, CENTRE, AFTER), of_rows, strict=True)
            ]
            found = formula("OR(found,pole)", found=found, pole=at_pole(cells[0], cells[1], cells[2], straight))
        table.work(row, BOUNDLESS, "IFERROR(found,FALSE)", found=found)


def neighbours(middle: Node, around: Node, rows: Node) -> tuple[Node, Node, Node]:
    """The numbers of a row and those beside it: the first row's neighbour is the last, where the motion goes around."""
    turned = formula("IF(wraps=1,rows-1,rows)", wraps=around, rows=rows)
    before, after = (
        formula(
            f"1+MOD(middle{sign}1-1,IF(wraps>0,turned,2*rows))", middle=middle, wraps=around, turned=turned, rows=rows
        )
        for sign in "-+"
    )
    return before, middle, after
