"""One search of an extreme: from where it begins, what it finds, and how sure that is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, Text, with_symbols
from mechsheet.kinematics.equations import FORCES, RATES
from mechsheet.model import WAYS, Way
from mechsheet.sheet import styles
from mechsheet.sheet.checks import boundless, rivals
from mechsheet.sheet.checks import search_rules as rules
from mechsheet.sheet.checks.boundless import in_row, may_grow, seen_by_rates, unsigned_divisor
from mechsheet.sheet.checks.corners import Corners
from mechsheet.sheet.checks.limits import FIRST_ROW, FROM, LAST_ROW, TO, Limits
from mechsheet.sheet.checks.search_table import (
    COLUMN,
    KNOWN,
    LABEL,
    LIMIT,
    PROBE_COL,
    SENSE,
    SIDE,
    VALUE_COL,
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
    WORST,
    BEST,
    HERE,
    WRAPS,
    LEFT,
    AT_LOW,
    START,
    OTHER,
    RIGHT,
    AT_HIGH,
    VALUE,
    PLACED,
    WHERE,
    ABOUT_VALUE,
    TURN,
    TURN_ABOUT,
    BOUNDLESS,
) = range(1, 19)
"""Working cells beside the first row of a search: the best and the worst value of the rows; the best row, that from which
the search begins; whether the ends of the rows are neighbours; the place from which the search begins and those beside it,
two columns apart as the places of a bracket are, and between them values where the stretch begins and ends and the best of
other rows; what is found, its place, the value of the driver there, how sure it is; where the quantity turns back, and how
sure that is; whether it is without bound. Where the best row is at an end of the motion, three of them in the rows below say
between which rows another is looked for, and what the two rows beside that end have."""

MIDDLE, BEFORE, CENTRE, AFTER = range(BOUNDLESS + 1, BOUNDLESS + 5)
"""Behind them: three rows that follow one another, and the quantity in them."""

DIFFERENCES, VERTEX_OF_ALL = BOUNDLESS + 5, BOUNDLESS + 8
"""Behind them, beside the probes: their divided differences of first, second and third order; and where the curve through
them turns back."""

RIVALS = BOUNDLESS + 9
"""Behind them, in four rows, those of `rivals`."""

COLUMNS = RIVALS + rivals.OTHER_END
"""How many working cells there are beside a search."""

MOVED = 0.02
"""A place that is moved farther [rows] beyond the probes is about right only: of 500 time ratios those of places that were
moved less far were off by 1.3e-4 at most."""

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
    corners  rows with all quantities where pieces of the motion meet
    sought   by quantity and way;  steep: the cell that says whether velocities and forces have a spike
    """

    table: SearchTable
    limits: Limits
    ends: Mapping[int, int]
    corners: Corners | None
    sought: Mapping[tuple[str, Way], Sought]
    steep: CellRef

    @property
    def plan(self) -> Plan:
        """The plan of the workbook."""
        return self.table.plan

    def search(self, row: int, begin: dict[str, Node]) -> None:
        """The rows of a bracket."""
        probing = {"vertex": rules.VERTEX, "probe": rules.PROBE}
        self.table.search(
            row, rules.PROBES + 1, begin | {"probe": rules.FIRST_PROBE}, rules.BRACKET, rules.NARROWED, probing
        )

    def value(self, row: int, symbol: str) -> None:
        """What the probes have found: where there is no position, nothing better than what is known."""
        table = self.table
        known = CellRef(row, KNOWN + rules.BRACKET.index("f_middle"), False, True)
        value = formula("IFERROR(cell,known)", cell=table.probed(symbol, row), known=known)
        table.fill(row, VALUE_COL, value, rules.PROBES)

    def known(self, row: int, name: str) -> CellRef:
        """A cell of what a row of a search knows."""
        return CellRef(row, KNOWN + rules.BRACKET.index(name), False, True)

    def _read(self, sought: Sought) -> dict[str, Node]:
        """What the rules of a search read, by name."""
        table, plan, row = self.table, self.plan, sought.row
        near = {"best": BEST, "here": HERE, "of_rows": OF_ROWS, "extreme": VALUE}
        stretch = {"first": FIRST_ROW, "last": LAST_ROW, "low": FROM, "high": TO}
        corners = {} if self.corners is None else self.corners.beside(row)
        return {
            **{name: table.near(row, work) for name, work in near.items()},
            **corners,
            **{name: self.limits.of_stretch(1, work) for name, work in stretch.items()},
            "sense": CellRef(row, SENSE, False, True),
            "wraps": self._around(sought),
            "other": table.near(row, WORST),
            "rows": table.rows,
            "rows_only": plan.searched.rows_only.cell,
            "whole": plan.searched.whole.cell,
        }

    @staticmethod
    def _sense(sought: Sought) -> float:
        return 1.0 if sought.way == "min" else -1.0

    def _place_of(self, row: int, counted: Node) -> Node:
        """A place of a search in rows; `counted`: as the bracket counts it."""
        return with_symbols(
            rules.PLACE,
            {"probe": counted, "side": CellRef(row, SIDE, False, True), "limit": CellRef(row, LIMIT, False, True)},
        )

    def write(self, sought: Sought) -> None:
        """The search of the smallest or largest value of a quantity."""
        plan, table, row, symbol = self.plan, self.table, sought.row, sought.symbol
        name = heading(plan, next(column for column in table.columns if column.symbol == symbol))
        table.put(row, LABEL, name, styles.LABEL)
        table.put(row + 1, LABEL, plan.text(f"extremes.{sought.way}"), styles.LABEL)
        self._best_row(sought)
        table.fill(row, COLUMN, table.number_of(symbol))
        if plan.rows_only:
            table.put(row, SENSE, self._sense(sought), styles.INNER)
            if sought.way == "max":
                table.work(row, WRAPS, "0")
            self._result_of_rows(sought)
            return
        self._wraps(sought)
        here = table.work(row, HERE, "here", here=self._begun_from(sought))
        self.search(row, self._begin(sought, table.in_row(symbol, row, here)))
        table.lay(row, rules.PROBES, [symbol])
        self.value(row, symbol)
        self._result(sought)
        if symbol in plan.found.returning:
            self._turns(sought)
        if may_grow(plan, symbol):
            self._boundless(sought)

    def _best_row(self, sought: Sought) -> None:
        """The best value of all rows that close, of no more stretches than are looked at, and the first row that has it."""
        table, row, symbol = self.table, sought.row, sought.symbol
        said, stretches = self.plan.places.status.whole(), self.plan.searched.count.cell
        least, largest = (
            Call(name, (table.in_rows(symbol, row), said, Text(self.plan.ok))) for name in ("MINIFS", "MAXIFS")
        )
        begin, sense = (self._read(sought)[name] for name in ("first", "sense"))
        best = table.work(
            row, OF_ROWS, "IF(OR(stretches=0,stretches>most),NA(),IF(sense>0,least,largest))", stretches=stretches,
            most=rules.STRETCHES, sense=sense, least=least, largest=largest,
        )  # fmt: skip
        if not self.plan.rows_only:
            table.work(row, WORST, "IF(sense<0,least,largest)", sense=sense, least=least, largest=largest)
        table.work(
            row, BEST, "begin-1+MATCH(best,from_begin,0)", begin=begin, best=best,
            from_begin=table.in_rows(symbol, row, begin),
        )  # fmt: skip

    def _begin(self, sought: Sought, value: Node) -> dict[str, Node]:
        """What the first row knows: the best row (a corner or the end of the stretch, where these are better) and its
        neighbours."""
        table, row, symbol = self.table, sought.row, sought.symbol
        sense = Number(self._sense(sought))
        known = self._read(sought) | {"value": value}
        trees = rules.begun(corners=self.corners is not None, limits=bool(self.ends))
        if self.corners is not None:
            beside = (with_symbols(tree, known) for tree in rules.BESIDE_HERE)
            for name, place in zip(("earlier", "later"), beside, strict=True):
                known[name] = table.in_row(symbol, row, place)
            self.corners.write_beside(row, symbol, sought.way, known)
        if not self.ends:
            return {"sense": sense, **self._between_rows(sought, known, trees)}
        for name, work, at in zip(("at_low", "at_high"), (AT_LOW, AT_HIGH), self.ends.values(), strict=True):
            cell = table.probed(symbol, at, anchored=True)
            known[name] = table.work(row, work, "IFERROR(cell,value)", cell=cell, value=value)
        places: dict[str, CellRef] = {}
        for name, work in (("start", START), ("lower", LEFT), ("upper", RIGHT)):
            places[name] = table.work(row, work, "place", place=with_symbols(trees.pop(name), known | places))
        known |= places
        for name in ("lower", "upper"):
            known[f"of_{name}"] = self._at_place(sought, known | {"place": known[name]})
        begun = {name: with_symbols(tree, known) for name, tree in trees.items()}
        to_fill_right = known | {name: replace(cell, col_abs=False) for name, cell in places.items()}
        begun |= {name: with_symbols(trees[name], to_fill_right) for name in ("left", "middle", "right")}
        return {"sense": sense, **begun}

    def _between_rows(self, sought: Sought, known: dict[str, Node], trees: Mapping[str, Node]) -> dict[str, Node]:
        """The same where the sheet looks for no limits: between two rows."""
        begun: dict[str, Node] = {}
        start = known["here"]
        if self.corners is not None:
            start = self.table.work(sought.row, START, "place", place=with_symbols(trees["start"], known))
        known["start"] = begun["middle"] = start
        begun["near"] = start if self.corners is None else with_symbols(trees["near"], known)
        begun["f_middle"] = with_symbols(trees["f_middle"], known)
        for name, side in (("left", "lower"), ("right", "upper")):
            begun[name] = with_symbols(trees[side], known)
            begun[f"f_{name}"] = self._at_place(sought, known | {"place": begun[name]})
        return begun

    def _at_place(self, sought: Sought, known: Mapping[str, Node]) -> Node:
        """The value in a row beside the one from which a search begins."""
        return self.table.in_row(sought.symbol, sought.row, with_symbols(rules.ROW_AT, known))

    def _begun_from(self, sought: Sought) -> Node:
        """The row from which the search begins: the best one, or, where that is the motion's first or last, another one
        (`rules.INNER`). Where not all rows close, a quantity may well have values in those that do not."""
        table, row, symbol = self.table, sought.row, sought.symbol
        known = self._read(sought)
        if not self.ends or self.plan.rows < rules.LEAST_INNER:
            return known["best"]
        best, rows = known["best"], table.rows
        begin = table.work(row + 1, HERE, "IF(best=1,3,1)", best=best)
        end = table.work(row + 2, HERE, "IF(best=1,rows,rows-2)", best=best, rows=rows)
        inner = Binary(":", *(table.in_row(symbol, row, place) for place in (begin, end)))
        other = table.work(
            row, OTHER, "IF(OR(best=1,best=rows),IF(sense>0,MIN(inner),MAX(inner)),NA())", best=best, rows=rows,
            sense=known["sense"], inner=inner,
        )  # fmt: skip
        for name, work, first, last in (("next", OTHER, "2", "rows-1"), ("third", WRAPS, "3", "rows-2")):
            place = formula(f"IF(best=1,{first},{last})", best=best, rows=rows)
            known[name] = table.work(row + 1, work, "value", value=table.in_row(symbol, row, place))
        is_inner = with_symbols(rules.INNER, known | {"end": known["of_rows"], "other": other})
        return formula(
            "IFERROR(IF(AND(wraps=0,first=1,last=rows,is_inner),begin-1+MATCH(other,inner,0),best),best)",
            wraps=known["wraps"], first=known["first"], last=known["last"], rows=rows, best=best, is_inner=is_inner,
            begin=begin, other=other, inner=inner,
        )  # fmt: skip

    def _wraps(self, sought: Sought) -> None:
        """Whether the ends of the rows are neighbours: what the whole sheet says, or 0 where something is missing or the
        quantity does not come back."""
        plan, table, row, symbol = self.plan, self.table, sought.row, sought.symbol
        start, end = (table.in_row(symbol, row, place) for place in (al.ONE, table.rows))
        unit = plan.unit_of(symbol)
        meet = ends_meet(plan, symbol, unit, table.in_rows(symbol, row), (start, end))
        table.work(row, WRAPS, "wraps", wraps=with_symbols(rules.WRAPS, self._read(sought) | {"meet": meet}))

    def _around(self, sought: Sought) -> Node:
        """Whether probes go on beyond the last row, into the first: never by a motion law, whose rows end in time."""
        return self.table.near(sought.row, WRAPS) if self.plan.mechanism.driver.law is None else al.ZERO

    def _result_of_rows(self, sought: Sought) -> None:
        """The best of the rows, where nobody looks between them."""
        table, row = self.table, sought.row
        table.work(row, VALUE, "best", styles.RESULT, best=table.near(row, OF_ROWS))
        table.work(row, WHERE, "INDEX(drivers,place)", styles.RESULT, place=table.near(row, BEST),
                   drivers=whole(self.plan.mechanism.driver.symbol))  # fmt: skip
        table.work(row, ABOUT_VALUE, "sure", sure=rules.SURE)

    def _result(self, sought: Sought) -> None:
        """The best of the rows and the probes, where it is, and whether the search has settled."""
        table, row, last = self.table, sought.row, sought.row + rules.PROBES
        known = self._read(sought) | {
            "found": self.known(last, "f_middle"),
            "before": self.known(last - 1, "f_middle"),
            "last_probe": CellRef(last - 1, VALUE_COL, False, True),
        }
        extreme, placed = rules.EXTREME, rules.PLACED
        if self.corners is not None:
            extreme, placed = rules.EXTREME_OF_CORNERS, rules.PLACED_OF_CORNERS
        table.work(row, VALUE, "value", styles.RESULT, value=with_symbols(extreme, known))
        known["place"] = self._place_of(last, self.known(last, "middle"))
        known["place"] = table.work(row, PLACED, "place", place=with_symbols(placed, known))
        within = with_symbols(rules.ROW_AT, known)
        table.work(row, WHERE, "driver", styles.RESULT, driver=driver_at(self.plan, within))
        known["elsewhere"] = self._elsewhere(sought)
        if self.corners is not None:
            for name in ("before", "last_probe"):
                known[name] = with_symbols(rules.UNLESS_CORNER, known | {"probed": known[name]})
        table.work(row, ABOUT_VALUE, "doubt", doubt=with_symbols(rules.DOUBT, known))
        rivals.write(table, row, RIVALS, sought.symbol, known | {"found": known["extreme"]})

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
            tests.append(with_symbols(rules.SPIKES, {"found": found, "of_rows": rows}))
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
            f"IF(IFERROR(ABS(there-best)>most,TRUE),{rules.ABOUT},{rules.SURE})",
            there=there,
            best=best,
            most=MOVED,
        )

    def _cubic(self, row: int) -> Node:
        """Where the cubic through the probes of four rows (Newton's form, over the way from the last) has its extreme."""
        table = self.table
        at, known = ([CellRef(row + index, col, False, True) for index in range(4)] for col in (PROBE_COL, VALUE_COL))
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
        known = self._read(sought)
        best = known["of_rows"] if self.corners is None else known["best_known"]
        found = with_symbols(boundless.BEYOND_ROWS, known | {"of_rows": best})
        if not seen_by_rates(plan.mechanism, {column.symbol for column in plan.rates}, symbol):
            known["middle"] = table.work(row, MIDDLE, "row", row=with_symbols(boundless.MIDDLE, known))
            before, after = (with_symbols(tree, known) for tree in boundless.NEIGHBOURS)
            places, divisor = (before, known["middle"], after), unsigned_divisor(plan, symbol)
            of_rows = [table.in_row(symbol, row, place) for place in places]
            if divisor is not None:
                signs = [in_row(plan, divisor, place) for place in places]
                for at in (0, 2):
                    beside = {"value": of_rows[at], "there": signs[at], "here": signs[1]}
                    of_rows[at] = with_symbols(boundless.SIGNED, beside)
            cells = {
                name: table.work(row, work, "value", value=value)
                for name, work, value in zip(("before", "here", "after"), (BEFORE, CENTRE, AFTER), of_rows, strict=True)
            }
            pole = with_symbols(boundless.at_pole(divisor is not None), cells)
            found = formula("OR(found,pole)", found=found, pole=pole)
        table.work(row, BOUNDLESS, "IFERROR(found,FALSE)", found=found)
