"""The sheet of extremes: the smallest and the largest value of a quantity over the motion, not only over the rows.

A search (`search_table`, `search_rules`) begins from the best row and its neighbours, or from where the stretch begins or
ends between two rows. What is given has been attained. Over a whole turn the rows at its ends are neighbours, which is
decided by formulas: start and step may change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Number, RangeRef, Symbol, Text, with_symbols
from livesheet.workbook import Column, PrintSetup, Sheet
from mechsheet.kinematics.whole_turns import LEAST_OF_TURN
from mechsheet.model import WAYS, Way
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.boundless import may_grow
from mechsheet.sheet.checks.checks import rows_apart
from mechsheet.sheet.checks.corners import WORKING, Corners, corners_of
from mechsheet.sheet.checks.limits import COUNT, FIRST_ROW, FROM, LAST_ROW, ROWS_ONLY, TO, UNSETTLED, Limits
from mechsheet.sheet.checks.one_extreme import (
    ABOUT_VALUE,
    BOUNDLESS,
    COLUMNS,
    HERE,
    PLACED,
    TURN,
    TURN_ABOUT,
    VALUE,
    WHERE,
    WRAPS,
    Searches,
    Sought,
)
from mechsheet.sheet.checks.search_rules import BRACKET, PROBES
from mechsheet.sheet.checks.search_table import (
    COLUMN,
    DRIVER_COL,
    KNOWN,
    LABEL,
    NEAR,
    PLACE_COL,
    SENSE,
    SIDE,
    VALUE_COL,
    SearchTable,
)
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.columns.bands import band_of_constant
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.grashof import turns_up_to
from mechsheet.sheet.inputs import rest_fits
from mechsheet.sheet.over_rows import both_means, is_back, may_leave_out, rows_that_close, whole_turns
from mechsheet.sheet.places import Extreme, Searched, there
from mechsheet.sheet.plan import LEAST_PROBED, Plan
from mechsheet.sheet.plan import VALUE as FIRST_SHEET_VALUE
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.sheet.table.positions import heading
from mechsheet.sheet.transmission import same_angle
from mechsheet.units import turn as whole_turn
from mechsheet.words.symbols import plain

BAND, REACH, BOUND, SHORTEST, WHICH = range(5, 10)
"""Working cells of a loop behind its four lengths: how far tolerances reach, whether that is to a change point, up to which
length its first link turns fully, how long its shortest side is, and which of the four that is."""

LOOP_HEADS = ("ground", "first", "coupler", "last", "band", "reach", "bound", "shortest", "which")
"""What stands over them."""

DOUBTS = ("about", "beyond", "rows.only")
"""What is added to the words of an extreme of which the search is not sure, by how much: behind nothing, which is 1."""

WHOLE, FINE, THERE, WORST_GROUP, STEEP, COUNTED, ROWS_APART = range(1, 8)
"""Working cells of all: what the sweep covers, whether inputs can be, whether the position that is drawn is one; which of
several angles of transmission is the least, whether velocities and forces have a spike between two rows, how many rows there
are, and in how many sheets others; behind it, where there are several, whether each has."""

TITLE_ROW, ABOUT_ROW, HEAD_ROW, FIRST = 0, 1, 3, 4


class Extremes:
    """The sheet, planned before any formula that reads it is written."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.table = SearchTable(plan, plan.at.titles["extremes"])
        self.quantities = quantities_of(plan)
        self.whole_row = FIRST
        self.limits = Limits(self.table, FIRST + 2)
        row = self.limits.end
        # below the row of their heads
        self.loops = {loop.group: row + number for number, loop in enumerate(plan.found.four_bars, 1)}
        row += len(self.loops) + 2 if self.loops else 0
        self.ends: dict[int, int] = {}
        if self.limits.count and self.quantities and plan.rows >= LEAST_PROBED:
            self.ends = {FROM: row, TO: row + 1}
            row += 3
        self.corners: Corners | None = None
        if self.quantities and (angles := corners_of(plan)):
            self.corners = Corners(self.table, row, angles, COLUMNS + 1)
            row += len(angles) + 1
        self.head = row
        row += 1
        self.gaps: dict[int, int] = {}
        for number in plan.equations.margins if self.limits.count else ():
            self.gaps[number] = row
            row += PROBES + 2
        self.sought: dict[tuple[str, Way], Sought] = {}
        height = 4 if plan.rows_only else PROBES + 2
        for symbol in self.quantities:
            for way in WAYS.values():
                self.sought[symbol, way] = Sought(symbol, way, row)
                row += height
        self.bands: dict[tuple[str, Way], int] = {}
        for extreme in () if plan.rows_only else banded_extremes(plan):
            self.bands[extreme] = row
            row += 1
        self.means: dict[str, int] = {symbol: row + number for number, symbol in enumerate(_means_of(plan))}
        self.searches = Searches(
            self.table, self.limits, self.ends, self.corners, self.sought, self.table.fixed(self.whole_row, STEEP)
        )

    @property
    def places(self) -> Searched:
        """Where other sheets find what is here."""
        plan, limits, spot = self.plan, self.limits, self.table.spot
        several = len(plan.found.transmission) > 1
        return Searched(
            whole=spot(self.whole_row, WHOLE),
            fine=spot(self.whole_row, FINE),
            there=spot(self.whole_row, THERE),
            rows=spot(self.whole_row, COUNTED),
            rows_apart=spot(self.whole_row, ROWS_APART),
            count=spot(limits.row, COUNT),
            unsettled=spot(limits.row, UNSETTLED),
            rows_only=spot(limits.row, ROWS_ONLY),
            worst_group=spot(self.whole_row, WORST_GROUP) if several else None,
            doubts=RangeRef(*(replace(end, sheet=self.table.title) for end in self._doubts())),
            stretches=limits.stretches,
            limits=limits.found,
            extremes={(way, symbol): self._place(sought) for (symbol, way), sought in self.sought.items()},
            wraps={symbol: spot(self.sought[symbol, "max"].row, WRAPS) for symbol in self.quantities},
            derivatives={
                (way, name): replace(spot(row, 0), col=self.table.at.spots[name].col)
                for (symbol, way), row in self.bands.items()
                for name in plan.banded[symbol].derivatives
            },
            means={symbol: (spot(row, 1), spot(row, 2)) for symbol, row in self.means.items()},
            gaps={number: (spot(row, VALUE), spot(row, WHERE)) for number, row in self.gaps.items()},
            reach={group: spot(row, REACH) for group, row in self.loops.items()} if plan.mechanism.bands else {},
        )

    def _place(self, sought: Sought) -> Extreme:
        """The place of an extreme."""
        value, occurs, doubt, turns, turns_doubt, boundless = (
            self.table.spot(sought.row, work) for work in (VALUE, WHERE, ABOUT_VALUE, TURN, TURN_ABOUT, BOUNDLESS)
        )
        returns, grows = sought.symbol in self.plan.found.returning, may_grow(self.plan, sought.symbol)
        return Extreme(
            value, occurs, doubt, turns if returns else None, turns_doubt if returns else None,
            boundless if grows else None,
        )  # fmt: skip

    def sheet(self) -> Sheet:
        """The finished sheet."""
        plan, table = self.plan, self.table
        table.put(TITLE_ROW, 0, plan.text("extremes.title"), styles.TITLE)
        table.put(ABOUT_ROW, 0, plan.text("extremes.about"), styles.SUBTITLE)
        for column in table.columns:
            table.put(HEAD_ROW, column.col, heading(plan, column), styles.HEAD)
        for col, key in (
            (COLUMN, "column"),
            (NEAR, "near"),
            (SENSE, "sense"),
            (PLACE_COL, "row"),
            (VALUE_COL, "value"),
        ):
            table.put(HEAD_ROW, col, plan.text(f"extremes.{key}"), styles.HEAD)
        self._whole()
        table.work(self.whole_row, FINE, "fine", fine=self._inputs_are_fine())
        table.work(
            self.whole_row, THERE, "COUNTIF(numbers,position)*ISNUMBER(position)=1",
            numbers=there(plan.places.number).whole(), position=there(plan.places.position).cell,
        )  # fmt: skip
        if len(plan.found.transmission) > 1:
            rows = [plan.blocks["verdicts"].rows[f"transmission_{group.number}"] for group in plan.found.transmission]
            least = RangeRef(*(CellRef(row, FIRST_SHEET_VALUE, True, True, plan.main) for row in (rows[0], rows[-1])))
            table.work(self.whole_row, WORST_GROUP, "MATCH(MIN(least),least,0)", least=least)
        if self.searches.steepest:
            table.work(self.whole_row, STEEP, "steep", steep=self.searches.steepest)
        table.work(self.whole_row, COUNTED, "rows", rows=plan.places.rows.cell)
        each = rows_apart(plan)
        if len(each) > 1:
            each = [
                table.work(self.whole_row, work, "apart", apart=apart)
                for work, apart in enumerate(each, ROWS_APART + 1)
            ]
        table.work(self.whole_row, ROWS_APART, "apart", apart=al.total(each))
        self._doubts_in_words()
        self.limits.write()
        if self.loops:
            heads = [plan.text(f"extremes.loop.{key}") for key in LOOP_HEADS]
            for work, head in enumerate(heads if plan.mechanism.bands else _without_bands(heads), 1):
                if head:
                    table.put(min(self.loops.values()) - 1, table.side + work, head, styles.HEAD)
        for loop in plan.found.four_bars:
            self._loop(loop)
        self._heads()
        for end, row in self.ends.items():
            self._end(end, row)
        if self.corners is not None:
            self.corners.write(self.quantities)
        for number, row in self.gaps.items():
            self._gap(number, row)
        for sought in self.sought.values():
            self.searches.write(sought)
        for (symbol, way), row in self.bands.items():
            self._band(symbol, way, row)
        for symbol, row in self.means.items():
            table.put(row, LABEL, plan.text("extremes.mean", symbol=plain(symbol)), styles.LABEL)
            means = both_means(plan.at.column(symbol, table.title), rows_that_close(plan, table.title))
            for work, mean in enumerate(means, 1):
                table.work(row, work, "mean", mean=mean)
        return Sheet(
            table.title,
            tuple(table.cells),
            tuple(table.fills),
            columns=(
                Column(LABEL, LABEL, 16), Column(COLUMN, SIDE, 7), Column(KNOWN, PLACE_COL, 10),
                Column(DRIVER_COL, table.side + COLUMNS + len(WORKING if self.corners else ()), 11),
            ),
            row_heights=((TITLE_ROW, 26.0), (HEAD_ROW, 30.0)),
            freeze=(FIRST, NEAR),
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(footer=plan.footer),
        )  # fmt: skip

    def _heads(self) -> None:
        """What the columns of searches hold."""
        if not (self.gaps or (self.sought and not self.plan.rows_only)):
            return
        self.table.heads(self.head, KNOWN, (*BRACKET, "vertex"))

    def lengths_of(self, loop: FourBar) -> RangeRef:
        """The cells of a loop's four lengths: ground, first link, coupler, last link; as another sheet reads them."""
        ends = (self.table.fixed(self.loops[loop.group], work) for work in (1, 4))
        return RangeRef(*(replace(end, sheet=self.table.title) for end in ends))

    def of_loop(self, loop: FourBar, work: int) -> CellRef:
        """A working cell of a loop, as another sheet reads it."""
        return replace(self.table.fixed(self.loops[loop.group], work), sheet=self.table.title)

    def _loop(self, loop: FourBar) -> None:
        """The four lengths of a loop, up to which length its first link turns fully, which side is the shortest, and how far
        tolerances reach in the sum that its type follows from, at most."""
        plan, row = self.plan, self.loops[loop.group]
        self.table.put(row, self.table.side, loop.name, styles.LABEL)
        poses = plan.equations.poses
        lengths = [
            self.table.work(row, work, "length", length=length_in_cells(link, start, end, poses))
            for work, (link, start, end) in enumerate(loop.sides(plan.mechanism.ground), 1)
        ]
        self.table.work(row, BOUND, "bound", bound=turns_up_to(lengths))
        four = RangeRef(lengths[0], lengths[-1])
        shortest = self.table.work(row, SHORTEST, "MIN(four)", four=four)
        self.table.work(row, WHICH, "MATCH(shortest,four,0)", shortest=shortest, four=four)
        if plan.mechanism.bands is None:
            return
        bands = [
            band_of_constant(plan.mechanism, plan.equations.equations, length_in_cells(*side, poses))
            for side in loop.sides(plan.mechanism.ground)
        ]
        self.table.work(
            row, REACH, 'IF(AND(excess<>0,ABS(excess)<=band),words,"")', excess=plan.places.excess(loop.group).cell,
            band=self.table.work(row, BAND, "band", band=al.total(bands)), words=plan.text("verdict.grashof.reach"),
        )  # fmt: skip

    def _doubts(self) -> tuple[CellRef, CellRef]:
        """The first and the last cell of what is added to words, by doubt."""
        return self.table.fixed(ABOUT_ROW, 1), self.table.fixed(ABOUT_ROW, len(DOUBTS) + 1)

    def _doubts_in_words(self) -> None:
        """What is added to words, by doubt: in cells that all lines of the first sheet look up."""
        plan, table = self.plan, self.table
        table.put(ABOUT_ROW, table.side, plan.text("extremes.doubts"), styles.LABEL)
        table.work(ABOUT_ROW, 1, '""', styles.LABEL)
        for number, word in enumerate(DOUBTS, 2):
            table.put(ABOUT_ROW, table.side + number, plan.text(f"verdict.{word}"), styles.LABEL)

    def _whole(self) -> None:
        """What the sweep covers: 1 for whole turns whose last row is the first again, 2 where that row is left out,
        else 0."""
        plan, table = self.plan, self.table
        table.put(self.whole_row, table.side, plan.text("extremes.whole"), styles.LABEL)
        driver = plan.mechanism.driver
        if not driver.link or driver.values or plan.rows < LEAST_OF_TURN:
            table.work(self.whole_row, WHOLE, "0")
            return
        known: dict[str, Node] = {"turn": Number(whole_turn(driver.unit.in_degrees))}
        if driver.law is not None:
            ends = {"first": Symbol(SHOWN + driver.law.start), "last": Symbol(SHOWN + driver.law.stop)}
            known["covered"] = with_symbols(formula("ABS(last-first)/turn"), known | ends)
        else:
            known |= {"step": there(plan.places.step).cell, "rows": table.rows}
            known["covered"] = with_symbols(formula("ABS(step)*(rows-1)/turn"), known)
            known["more"] = with_symbols(formula("ABS(step)*rows/turn"), known)
        tied = plan.equations.equations.tied
        known["back"] = Call("AND", tuple(self._is_back(symbol) for symbol in tied))
        turns = with_symbols(whole_turns(driver.law is not None, bool(tied)), known)
        table.work(self.whole_row, WHOLE, "turns", turns=turns)

    def _is_back(self, symbol: str) -> Node:
        """Whether what a gear or a further driver decides is in the last row what it was in the first."""
        spot = self.plan.at.spots[symbol]
        last, first = (
            CellRef(row, spot.col, True, True, spot.sheet) for row in (self.plan.at.last, self.plan.at.first)
        )
        angle, turn = self.plan.equations.of(symbol).unit.kind == "angle", Number(whole_turn(spot.degrees))
        return with_symbols(
            is_back(angle), {"last": last, "first": first, "turn": turn, "size": Number(self.plan.size)}
        )

    def _inputs_are_fine(self) -> Node:
        """Whether the yellow cells hold what can be, there is such a position, and all that follows from them too."""
        none_wrong = formula("inputs=0", inputs=self.plan.places.inputs.cell)
        return Call("AND", (none_wrong, self.plan.searched.there.cell, *rest_fits(self.plan, self.table.title)))

    # --- searches ---------------------------------------------------------------------------------------------

    def _end(self, end: int, row: int) -> None:
        """All quantities where the stretch begins or ends; of several stretches nobody asks, their rows are all."""
        table = self.table
        table.put(row, LABEL, self.plan.text(f"extremes.{'from' if end == FROM else 'to'}"), styles.LABEL)
        table.fill(row, NEAR, self.limits.of_stretch(1, FIRST_ROW if end == FROM else LAST_ROW))
        table.fill(row, PLACE_COL, self.limits.of_stretch(1, end))
        table.lay(row, 1, self.quantities)

    def _gap(self, number: int, row: int) -> None:
        """The least margin of a group between rows that close: where it dips lowest between those beside each other."""
        plan, table = self.plan, self.table
        symbol = plan.equations.margins[number]
        least = plan.checked.least[number].whole()
        table.put(row, LABEL, plan.text("extremes.gap", number=number), styles.LABEL)
        here = table.work(row, HERE, "IF(COUNT(least)=0,NA(),MATCH(MIN(least),least,0))", least=least)
        table.fill(row, COLUMN, table.number_of(symbol))
        begin: dict[str, Node] = {"near": here, "sense": al.ONE}
        for name, step in (("left", "-1"), ("middle", ""), ("right", "+1")):
            begin[name] = formula(f"here{step}", here=here)
            begin[f"f_{name}"] = table.in_row(symbol, row, Symbol(name))
        self.searches.search(row, begin)
        table.lay(row, PROBES, [symbol])
        self.searches.value(row, symbol)
        table.work(row, VALUE, "least", least=self.searches.known(row + PROBES, "f_middle"))
        table.work(row, WHERE, "place", place=self.searches.known(row + PROBES, "middle"))

    def _band(self, symbol: str, way: Way, row: int) -> None:
        """The derivatives by dimensions where a quantity is smallest or largest: as this changes, so does the extreme."""
        table, extreme = self.table, self.sought[symbol, way].row
        table.put(row, LABEL, self.plan.text("extremes.band", symbol=plain(symbol)), styles.LABEL)
        table.fill(row, NEAR, CellRef(extreme, NEAR, False, True))
        table.fill(row, PLACE_COL, table.near(extreme, PLACED))
        table.lay(row, 1, self.plan.banded[symbol].derivatives)


def _means_of(plan: Plan) -> tuple[str, ...]:
    """Quantities whose mean is asked for, where rows may be a turn without the one that closes it."""
    if not may_leave_out(plan) or plan.rows == 1:
        return ()
    asked = (each for each in plan.mechanism.summaries if "mean" in each.take.parts and has_column(plan, each.of))
    return tuple(dict.fromkeys(each.take.column(each.of) for each in asked))


def _without_bands(heads: Sequence[str]) -> list[str]:
    """The heads of a loop's cells where no dimension has a tolerance: over the cells of these stands nothing."""
    return ["" if work in (BAND, REACH) else head for work, head in enumerate(heads, 1)]


def about(
    plan: Plan,
    symbol: str,
    ways: Sequence[Way] = ("min", "max"),
    unsure: Node | None = None,
    none: Node | None = None,
) -> Node:
    """What is added to the words of an extreme, or of two: how much it is to be doubted. `unsure`: where the value is about
    right although the search has no doubt. `none`: whether there is no number; then some row has no value, as at a dead
    centre, or there is no bound."""
    rows = plan.text("verdict.rows.only")
    gaps = plan.text("verdict.gaps")
    if plan.between_unseen:
        return Text(rows) if none is None else formula("IF(none,gaps,rows)", none=none, gaps=gaps, rows=rows)
    doubts = [plan.searched.extremes[way, symbol].doubt for way in ways]
    said = _doubt(plan, doubts, unsure)
    if none is not None:
        said = formula("IF(none,gaps,said)", none=none, gaps=gaps, said=said)
    said = _without_bound(plan, symbol, ways, said)
    if not may_grow(plan, symbol):
        return said
    # whether there is a bound nobody knows where only rows are known
    return formula("IF(rows_only,rows,said)", rows_only=plan.searched.rows_only.cell, rows=rows, said=said)


def about_turns(plan: Plan, symbol: str) -> Node:
    """The same of a ratio of times over whole turns: places count, too; one that may be elsewhere makes it about right."""
    ends = [plan.searched.extremes[way, symbol] for way in WAYS.values()]
    doubts = [*(end.doubt for end in ends), *(there(end.turns_doubt) for end in ends)]
    return _without_bound(
        plan, symbol, ("min", "max"), _in_words(plan, formula("MIN(2,doubt)", doubt=_largest(doubts)))
    )


def _doubt(plan: Plan, doubts: Sequence[Spot], unsure: Node | None) -> Node:
    """The words of the largest doubt; `unsure`: where the search has none and the value is about right all the same."""
    doubt = _largest(doubts)
    if unsure is not None:
        doubt = formula("MAX(doubt,1+(unsure))", doubt=doubt, unsure=unsure)
    return _in_words(plan, doubt)


def _largest(doubts: Sequence[Spot]) -> Node:
    cells = tuple(each.cell for each in doubts)
    return Call("MAX", cells) if len(cells) > 1 else cells[0]


def _in_words(plan: Plan, doubt: Node) -> Node:
    return formula("INDEX(words,1,doubt)", words=plan.searched.doubts, doubt=doubt)


def _without_bound(plan: Plan, symbol: str, ways: Sequence[Way], said: Node) -> Node:
    """Where a quantity grows without bound that, else what is said."""
    without = boundless(plan, symbol, ways)
    if without is not None:
        said = formula("IF(without,words,said)", without=without, words=plan.text("verdict.boundless"), said=said)
    return said


def boundless(plan: Plan, symbol: str, ways: Sequence[Way]) -> Node | None:
    """Whether a quantity has no smallest or no largest value; None where it cannot grow without bound."""
    if not may_grow(plan, symbol):
        return None
    flags = tuple(there(plan.searched.extremes[way, symbol].boundless).cell for way in ways)
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
