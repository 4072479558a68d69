"""The two-way tables whose value is a summary: one dimension down, another across, what the sweep amounts to in the cells.

Right of the chart, folded away, each pair of values has a column: its two values, below them the quantity at the driver's
values (one formula, filled both ways), and below these probes between the rows, by the same formula, at vertices of
parabolas. Places count rows from the middle of three neighbours. What is given has been attained.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Text, transform, with_symbols
from livesheet.workbook import Area, Axis, Cell, Column, Conditional, Fill, Style
from mechsheet.model import WAYS, Dimension, Quantity, Summary, TableRequest, Way
from mechsheet.sheet import styles
from mechsheet.sheet.asked.cell_formula import Blocks, CellFormula, helper_blocks
from mechsheet.sheet.asked.two_way import CORNER_ROW, FIRST, HEAD_ROW, NAME_ROW, Body, Table, bracketed
from mechsheet.sheet.checks import rivals
from mechsheet.sheet.checks.search_rules import PARABOLA, SETTLED
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.over_rows import ENDS, NUMBERS, ends_meet, may_leave_out, mean_of_motion
from mechsheet.sheet.plan import LEAST_PROBED, Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import input_validation, rich, shown_unit
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.words.symbols import plain

PROBES = 4
"""Probes of each extreme."""

BESIDE = 0.1
"""How far beside the first probe the second is made, in rows."""


class SummaryTable(Table):
    """One of them while it is being laid out."""

    def __init__(self, plan: Plan, request: TableRequest, title: str) -> None:
        super().__init__(plan, request, title)
        self.last = FIRST + len(request.row_values) - 1
        self.row: Dimension = next(dim for dim in plan.mechanism.dimensions if dim.symbol == request.rows)
        self.summary: Summary = next(each for each in plan.mechanism.summaries if each.symbol == request.value)
        self.pairs = self.count * len(request.row_values)
        self.at = self.helpers_at + 1
        self.rows_end = FIRST + plan.rows - 1
        self.probed = not plan.mechanism.driver.values and plan.rows >= LEAST_PROBED

    def heads(self) -> list[tuple[str, tuple[Quantity, ...], list[tuple[int, int]]]]:
        """Those of the columns, and of the rows."""
        down = [(FIRST + index, 0) for index in range(len(self.request.row_values))]
        return [*super().heads(), ("rows", self.request.row_values, down)]

    def varied(self) -> list[Dimension]:
        """The dimensions of the heads."""
        return [self.column, self.row]

    # --- what is written around -------------------------------------------------------------------------------

    def hint_words(self) -> str:
        """What may be changed, and what the colours say."""
        return self.plan.text("table.summary.hint")

    def value_words(self) -> str:
        """The summary and its unit."""
        return plain(self.request.value) + bracketed(shown_unit(self.plan, self.summary.of))

    def rows_words(self) -> str:
        """The dimension that goes down, and its unit."""
        return plain(self.row.symbol) + bracketed(self.row.unit.text)

    def labelled_rows(self) -> str:
        """The same with its label."""
        return self.labelled(self.row)

    def x_axis(self) -> Axis:
        """The chart's axis of that dimension."""
        return Axis(self.rows_words())

    @property
    def found(self) -> CellFormula:
        """The formula of the quantity at a value of the driver, and the helpers that it needs."""
        return self.helpers.found

    @cached_property
    def helpers(self) -> Helpers:
        """Their columns."""
        return Helpers(self)

    def body(self) -> Body:
        """The heads of the rows, the table, and the helpers."""
        return self.helpers.body()


class Helpers:
    """The cells of the columns of helpers, row by row from the top.

    value, sure  the first cells of the rows with what the table shows, and whether that is of all positions and settled
    """

    def __init__(self, table: SummaryTable) -> None:
        self.table, self.plan = table, table.plan
        blocks = Blocks(FIRST, HEAD_ROW, table.helpers_at, table.at + table.pairs + 1, table.pairs)
        closing = [group.closes for group in self.plan.equations.groups]
        of = table.summary.of
        self.found = CellFormula(self.plan, table.title, of, self._heads(), blocks, closing)
        decimals = decimals_of_kind(self.plan, self.found.unit(of).kind) + 1
        self.style = styles.decimals(styles.INNER, decimals)
        self.shown = styles.decimals(styles.COLUMN, decimals)
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.next_row = table.rows_end + 2
        top = CellRef(FIRST, table.at, row_abs=True)
        self.column = RangeRef(top, CellRef(table.rows_end, table.at, row_abs=True))
        self.settled: list[CellRef] = []
        self._rows()
        count = self._line("count", "COUNT(column)")
        self.value = self._value()
        every = formula("count=rows", count=count, rows=self.of_rows)
        self.sure = self._line("sure", "IFERROR(IF(every,1,0),0)", every=al.all_of([every, *self.settled]))

    @property
    def of_rows(self) -> Node:
        """How many rows there are."""
        return formula("ROWS(column)", column=self.column)

    def _heads(self) -> dict[str, CellRef]:
        """The cells of a column's two values."""
        request = self.table.request
        return {
            request.rows: CellRef(NAME_ROW, self.table.at, row_abs=True),
            request.column: CellRef(HEAD_ROW, self.table.at, row_abs=True),
        }

    # --- all --------------------------------------------------------------------------------------------------

    def body(self) -> Body:
        """Everything below the table's heads and beside its chart."""
        table, plan, request = self.table, self.plan, self.table.request
        conditionals = [table.missing()]
        for index in range(len(request.row_values)):
            row, first = FIRST + index, table.at + index * table.count
            self.fills.append(Fill(row, 1, CellRef(self.value.row, first), self.shown, cols=table.count))
            unsure = formula("cell=0", cell=CellRef(self.sure.row, first, row_abs=True))
            conditionals.append(Conditional(Area(row, 1, row, table.count), unsure, styles.WARN))
        last = self.found.blocks.col(len(self.found.helpers)) - 2
        return Body(
            tuple(self.cells),
            tuple(self.fills),
            (
                Column(table.helpers_at, table.helpers_at, 24, level=1, hidden=True),
                Column(table.at, last, 11, level=1, hidden=True),
                Column(last + 1, last + 1, 3, collapsed=True),
            ),
            tuple(conditionals),
            (input_validation(plan, Area(FIRST, 0, table.last, 0), request.rows),),
        )

    def _rows(self) -> None:
        """The driver's values, the heads of the columns, and the quantity in every row."""
        table, plan, found = self.table, self.plan, self.found
        of = table.summary.of
        title = rich(table.summary.take.column(of), bracketed(shown_unit(plan, of)))
        self.cells += [
            Cell(CORNER_ROW, table.helpers_at, plan.text("table.helpers"), styles.SECTION),
            Cell(CORNER_ROW, table.at, title, styles.SECTION),
            *(Cell(CORNER_ROW, table.at + col, None, styles.SECTION) for col in range(1, table.pairs)),
            Cell(NAME_ROW, table.helpers_at, table.rows_words(), styles.HEAD),
            Cell(HEAD_ROW, table.helpers_at, table.labelled(table.column), styles.HEAD),
        ]
        for index in range(len(table.request.row_values)):
            first = table.at + index * table.count
            row_head = CellRef(FIRST + index, 0, True, True)
            self.fills.append(Fill(NAME_ROW, first, row_head, styles.HEAD, cols=table.count))
            self.fills.append(Fill(HEAD_ROW, first, CellRef(HEAD_ROW, 1, True), styles.HEAD, cols=table.count))
        self.fills.append(table.driver_fill(table.helpers_at))
        value = table.summary.take.row(found.formula)
        self.fills.append(Fill(FIRST, table.at, value, self.style, rows=plan.rows, cols=table.pairs))
        cells, fills = helper_blocks(found, CORNER_ROW)
        self.cells += cells
        self.fills += fills

    def _line(self, key: str, text: str, style: Style | None = None, /, **holes: Node | float | str) -> CellRef:
        """A row of formulas below, one in each column; its first cell."""
        if "column" not in holes:
            holes["column"] = self.column
        node = self.plan.at.bind(formula(text, **holes), self.table.title)
        return self._put(self.plan.text(f"table.{key}"), node, style)

    def _put(self, label: str, node: Node, style: Style | None = None) -> CellRef:
        row = self.next_row
        self.next_row += 1
        self.cells.append(Cell(row, self.table.helpers_at, label, styles.LABEL))
        self.fills.append(Fill(row, self.table.at, node, style or styles.INNER, cols=self.table.pairs))
        return CellRef(row, self.table.at)

    # --- the summary ------------------------------------------------------------------------------------------

    def _value(self) -> CellRef:
        """The row of what the table shows."""
        take = self.table.summary.take
        if not take.ways:
            return self._line("result", "value", self.shown, value=take.over(self._of_rows))
        wraps = self._wraps()
        style = self.shown if take.occurs_with else self.style
        found = {part: self._extreme(way, wraps, style) for part, way in WAYS.items() if part in take.parts}
        return found.get(take.occurs_with) or self._line(
            "result", "value", self.shown, value=take.over(found.__getitem__)
        )

    def _of_rows(self, part: str) -> Node:
        """A part that the rows alone decide."""
        if part == "mean":
            return formula("IFERROR(mean,NA())", mean=self._mean())
        return formula(f"IF(COUNT(column)=0,NA(),{ENDS[part]})", column=self.column)

    def _mean(self) -> Node:
        plan = self.plan
        turns: Node | None = None
        if may_leave_out(plan):
            turns = formula(
                "AND(whole=2,COUNT(column)=rows)", whole=plan.searched.whole.cell, column=self.column, rows=self.of_rows
            )
        return mean_of_motion(plan.mechanism.driver, self.column, [(self.column, NUMBERS)], turns, headed=False)

    def _wraps(self) -> CellRef | None:
        """Whether the rows at the ends are neighbours, as on the sheet of extremes: nothing is missing, and what is asked
        comes back."""
        if not self.table.probed:
            return None
        if self.plan.mechanism.driver.law is not None:  # whose rows end in time
            return self._line("wraps", "0")
        of, column = self.table.summary.of, self.column
        meet = ends_meet(self.plan, of, self.found.unit(of), column, (column.start, column.end))
        return self._line("wraps", "IFERROR(IF(AND(COUNT(column)=rows,meet),whole,0),0)", rows=self.of_rows, meet=meet,
                          whole=self.plan.searched.whole.cell)  # fmt: skip

    def _extreme(self, way: Way, wraps: CellRef | None, style: Style) -> CellRef:
        """The rows of the smallest or largest value; the last of them has it."""
        best = self._line(
            f"best.{way}", "IF(COUNT(column)=0,NA(),most)", self.style,
            most=self._over_rows(way),
        )  # fmt: skip
        if wraps is None:
            return self._line("result", "best", style, best=best)
        here = self._line("row", "MATCH(best,column,0)", best=best)
        middle = self._line(
            "middle",
            'IF(wraps>0,here,IF(ISNUMBER(IF(here>1,INDEX(column,here-1),"")),'
            'IF(ISNUMBER(IF(here<rows,INDEX(column,here+1),"")),here,here-1),here+1))',
            wraps=wraps, here=here, rows=self.of_rows,
        )  # fmt: skip
        turn = formula("IF(wraps=1,rows-1,IF(wraps=2,rows,2*rows))", wraps=wraps, rows=self.of_rows)
        around = [
            self._line(key, f"INDEX(column,1+MOD(middle{beside}-1,turn))", self.style, middle=middle, turn=turn)
            for key, beside in (("before", "-1"), ("at.middle", ""), ("after", "+1"))
        ]
        values = self._probes(best, here, middle, around)
        known = [formula("IFERROR(value,best)", value=value, best=best) for value in values]
        result = self._line("result", "all", style, all=Call(way.upper(), (best, *known)))
        # where the last probe is worse than the best, the quantity is no parabola there; at an end that is as it should be
        self.settled.append(
            self._line(
                "settled",
                "AND(rivals=0,OR(AND(here<>middle,result=best),ABS(result-last)<=allowed))",
                rivals=self._rivals(way, wraps, here, best, result), here=here, middle=middle, result=result, best=best,
                last=known[-1], allowed=self._allowed(),
            )
        )  # fmt: skip
        return result

    def _rivals(self, way: Way, wraps: CellRef, here: CellRef, best: CellRef, result: CellRef) -> CellRef:
        """How many other rows may have more beside them, as on the sheet of extremes, where every position exists."""
        own, before, after = (
            RangeRef(
                replace(self.column.start, row=FIRST + at), replace(self.column.end, row=self.table.rows_end - 2 + at)
            )
            for at in (1, 0, 2)
        )
        allowed = self._line("allowed", "allowed", self.style, allowed=self._allowed())
        known: dict[str, Node] = {"sense": al.number(1.0 if way == "min" else -1.0), "wraps": wraps, "here": here}
        known |= {"rows": self.of_rows, "of_rows": best, "found": result, "allowed": allowed}
        known["twin"] = self._line("twin", "twin", self.style, twin=with_symbols(rivals.TWIN_BELOW, known))
        known["promise"] = self._line("promise", "most", self.style, most=with_symbols(rivals.PROMISE_BEYOND, known))
        again = self._line("again", "again", again=with_symbols(rivals.AGAIN, known))
        rows: dict[str, Node] = {"own": own, "before": before, "after": after, "again": again}
        rows["number"] = formula("ROW(own)-offset", own=own, offset=FIRST + 1)
        count = Call("SUMPRODUCT", (with_symbols(rivals.RIVALS, known | rows),))
        inside = self._line("inside", "count", count=count)
        ends = [self._rival_at_end(at, known) for at in (0, 1)]
        return self._line("rivals", "IFERROR(inside+one+other,0)", inside=inside, one=ends[0], other=ends[1])

    def _rival_at_end(self, at: int, known: Mapping[str, Node]) -> CellRef:
        """The same of the first row (at 0) or the last one."""
        rows = [replace(self.column.start, row=row) for row in range(FIRST, self.table.rows_end + 1)]
        own, after, third, *_, near, far = rows if at == 0 else rows[::-1]
        end, other = (al.ONE, self.of_rows) if at == 0 else (self.of_rows, al.ONE)
        known = {**known, "own": own, "after": after, "third": third, "near": near, "far": far}
        known |= {"end": end, "other_end": other}
        known["outside"] = self._line("outside", "y", self.style, y=with_symbols(rivals.OUTSIDE, known))
        return self._line(f"end.{at}", "rival", rival=with_symbols(rivals.RIVAL_AT_END, known))

    def _allowed(self) -> Node:
        """By so much more is nothing."""
        return formula(
            "settled*(most-least)", settled=SETTLED, most=self._over_rows("max"), least=self._over_rows("min")
        )

    def _over_rows(self, way: Way) -> Node:
        return Call(f"{way.upper()}IFS", (self.column, self.column, Text(NUMBERS)))

    def _probes(self, best: CellRef, here: CellRef, middle: CellRef, around: Sequence[CellRef]) -> list[CellRef]:
        """The rows of the probes: each its place, the driver's value there, and the quantity. A place is beside the best row
        on the side where there are positions."""
        before, centre, after = around
        vertex = formula("(before-after)/(2*(before-2*centre+after))", before=before, centre=centre, after=after)
        best_at = formula("here-middle", here=here, middle=middle)
        known: list[tuple[Node, Node]] = [(best_at, best)]
        found: list[CellRef] = []
        for number in range(1, PROBES + 1):
            if number == 2:
                near = formula("at+IF(at>best_at,-beside,beside)", at=known[1][0], best_at=best_at, beside=BESIDE)
            else:
                near = vertex if number == 1 else vertex_of(known[-3:])
            place = formula(
                "IFERROR(MAX(IF(here>middle,0,-1),MIN(IF(here<middle,0,1),near)),last)",
                here=here, middle=middle, near=near, last=known[-1][0],
            )  # fmt: skip
            at = self._line("place", "place", place=place)
            driven = self._line(
                "driven", "value", value=driver_at(self.plan, formula("middle+at", middle=middle, at=at))
            )
            found.append(self._probe(driven, middle))
            known.append((at, found[-1]))
        return found

    def _probe(self, driven: CellRef, row: CellRef) -> CellRef:
        """The quantity at another value of the driver, and all its helpers; an angle near what it is in a row."""
        found, blocks, number = self.found, self.found.blocks, self.next_row
        there: dict[Node, Node] = {found.driver_cell: driven}
        for index in range(len(found.helpers)):
            col = blocks.col(index)
            column = RangeRef(CellRef(FIRST, col, row_abs=True), CellRef(self.table.rows_end, col, row_abs=True))
            there[found.helper(index)] = CellRef(number, col)
            there[found.above(index)] = formula("INDEX(column,row)", column=column, row=row)

        def moved(node: Node) -> Node:
            return transform(node, lambda part: there.get(part, part) if isinstance(part, CellRef) else part)

        for index, (_, helper) in enumerate(found.helpers):
            self.fills.append(Fill(number, blocks.col(index), moved(helper), styles.INNER, cols=blocks.count))
        return self._put(self.plan.text("table.probe"), moved(found.formula), self.style)


def vertex_of(points: Sequence[tuple[Node, Node]]) -> Node:
    """Where the parabola through three points (u, y) has its vertex."""
    names = (("left", "f_left"), ("middle", "f_middle"), ("right", "f_right"))
    known = {
        name: node for pair, point in zip(names, points, strict=True) for name, node in zip(pair, point, strict=True)
    }
    return with_symbols(PARABOLA, known)
