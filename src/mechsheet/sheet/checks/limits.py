"""Stretches of the sweep in which the mechanism closes, and their ends: the limit positions, between two rows.

A row closes where the margins of all groups are above 0; the least of them is smooth in the driver beside a limit, or has a
kink there. Probes look for where it is 0 (`search_rules`). Values of the driver are counted in rows (`search_table`).
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.nodes import Call, CellRef, Node, Symbol, with_symbols
from mechsheet.sheet import styles
from mechsheet.sheet.checks import search_rules as rules
from mechsheet.sheet.checks.search_table import KNOWN, LABEL, VALUE_COL, SearchTable, whole
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.places import Stretch
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import ALL, formula, joined

LIMITS = 4
"""Limits that are found; further ones are counted."""

PLACE, INSIDE, OUTSIDE, FOUND, DRIVER, REST = range(6)
"""Working cells of a limit: its number in order, the rows beside it, and what is found."""

COUNT, UNSETTLED, ROWS_ONLY = range(1, 4)
"""Working cells of all: how many stretches there are, whether a limit is known to a step only, whether nothing is known
between rows."""

FIRST_ROW, LAST_ROW, FROM, TO, WORDS = range(5)
"""Cells of a stretch, beside each other: its rows (from 1), where it begins and ends between rows, and its rows in words."""


class Limits:
    """The blocks of stretches and limits; `row` is their first row, `end` the first one below them.

    stretches, found  the places of the first stretches, and of the driver's values at limits
    """

    def __init__(self, table: SearchTable, row: int) -> None:
        self.table = table
        self.plan: Plan = table.plan
        self.row = row
        self.stretch_rows = [row + 2 + number for number in range(rules.STRETCHES)]
        stepped = not self.plan.mechanism.driver.values and self.plan.rows > 1
        self.count = LIMITS if self.plan.equations.margins and stepped else 0
        # no margin says where a slot's pin comes to lie on its pivot, or where lines turn parallel
        loose = self.plan.equations.crossings or any(group.only_undetermined for group in self.plan.equations.groups)
        self.unprobed = bool(stepped and not self.count and not self.plan.newton and loose)
        start = row + 2 + rules.STRETCHES + 1
        self.rows = [start + number * (rules.LIMIT_PROBES + 2) for number in range(self.count)]
        self.end = start + self.count * (rules.LIMIT_PROBES + 2)
        self.found = [table.spot(first, DRIVER) for first in self.rows]
        self.stretches = [
            Stretch(*(table.spot(first, work) for work in (FIRST_ROW, LAST_ROW, FROM, TO, WORDS)))
            for first in self.stretch_rows
        ]

    def of_stretch(self, number: int, work: int) -> CellRef:
        """A cell of a stretch, counted from 1."""
        return self.table.fixed(self.stretch_rows[number - 1], work)

    # --- writing ----------------------------------------------------------------------------------------------

    def write(self) -> None:
        """All cells."""
        table, plan = self.table, self.plan
        table.put(self.row, table.side, plan.text("extremes.stretches"), styles.LABEL)
        table.work(self.row, COUNT, "MAX(begun)", begun=plan.checked.begun.whole(table.title))
        stretches = table.fixed(self.row, COUNT)
        for work, key in enumerate(("first", "last", "from", "to")):
            table.put(self.row + 1, table.side + work, plan.text(f"extremes.{key}"), styles.HEAD)
        rests = [table.fixed(row, REST) for row in self.rows]
        first, last = (self.of_stretch(1, work) for work in (FIRST_ROW, LAST_ROW))
        unsettled = table.work(
            self.row, UNSETTLED,
            "rests>settled" if rests else "IF(stretches=0,FALSE,last-first+1<rows)" if self.unprobed else "FALSE",
            rests=Call("MAX", tuple(rests)), settled=rules.SETTLED_LIMIT, first=first, last=last, rows=table.rows,
            stretches=stretches,
        )  # fmt: skip
        table.work(
            self.row, ROWS_ONLY, "only", only=with_symbols(
                rules.ONLY_ROWS, {"stretches": stretches, "first": first, "last": last, "unsettled": unsettled}
            ),
        )  # fmt: skip
        for number in range(1, rules.STRETCHES + 1):
            self._stretch(number, stretches)
        for number, row in enumerate(self.rows, 1):
            if number == 1:
                table.heads(row - 1, KNOWN, (*rules.CROSSING, "share"))
            self._limit(number, row, stretches)

    def _number(self, row: int, key: str, number: int) -> None:
        """The number of a stretch or a limit, which the formulas beside it read, shown with what it is the number of."""
        before, _, after = self.plan.text(f"extremes.{key}", number=0).partition("0")
        shown = "0".join(f'"{words}"' if words else "" for words in (before, after))
        self.table.put(row, LABEL, float(number), styles.numbered(styles.LABEL, shown))

    def _stretch(self, number: int, stretches: CellRef) -> None:
        """Rows of a stretch, and its ends: the limits beside them, where there are."""
        table, row = self.table, self.stretch_rows[number - 1]
        self._number(row, "stretch", number)
        begun, nth = self.plan.checked.begun.whole(), CellRef(row, LABEL, False, True)
        first = table.work(row, FIRST_ROW, 'IF(stretches<nth,"",MATCH(nth,begun,0))',
                            stretches=stretches, nth=nth, begun=begun)  # fmt: skip
        last = table.work(row, LAST_ROW, 'IF(stretches<nth,"",first+COUNTIFS(begun,nth,said,ok)-1)',
                           stretches=stretches, nth=nth, first=first, begun=begun,
                           said=self.plan.places.status.whole(), ok=self.plan.ok)  # fmt: skip
        ends = [formula("ROUND(INDEX(drivers,row),2)", drivers=Symbol(ALL + self.plan.mechanism.driver.symbol), row=edge)
                for edge in (first, last)]  # fmt: skip
        between = formula('IF(nth>1,"; ","")', nth=nth)
        table.work(row, WORDS, 'IF(ISNUMBER(first),words,"")', first=first,
                    words=joined(between, ends[0], " … ", ends[1]))  # fmt: skip
        if not self.count:
            table.work(row, FROM, "first", first=first)
            table.work(row, TO, "last", last=last)
            return
        # limits in order are beginning and end of each stretch, without the first where the sweep begins inside
        limits = table.down(self.rows[0], FOUND, self.rows[-1] - self.rows[0] + 1)
        begin, apart = table.fixed(self.stretch_rows[0], FIRST_ROW), rules.LIMIT_PROBES + 2
        for work, edge, outside, place in ((FROM, first, "edge>1", "2*nth-1"), (TO, last, "edge<rows", "2*nth")):
            limit = formula(f"INDEX(limits,1+apart*({place}-1-(begin=1)))", limits=limits, apart=apart, begin=begin,
                            nth=nth)  # fmt: skip
            table.work(row, work, f'IF(ISNUMBER(edge),IF({outside},IFERROR(limit,edge),edge),"")',
                       edge=edge, rows=table.rows, limit=limit)  # fmt: skip

    def _limit(self, number: int, row: int, stretches: CellRef) -> None:
        """One limit: the row that closes beside it, the one that does not, and where between them the least margin is 0."""
        table, plan = self.table, self.plan
        self._number(row, "limit", number)
        # in order: beginning and end of each stretch; the first is none when the sweep begins inside
        place = table.work(row, PLACE, "number+IF(first=1,1,0)", number=CellRef(row, LABEL, False, True),
                           first=table.fixed(self.stretch_rows[0], FIRST_ROW))  # fmt: skip
        first, last = (table.down(self.stretch_rows[0], work, rules.STRETCHES) for work in (FIRST_ROW, LAST_ROW))
        inside = table.work(
            row, INSIDE, "IF(nth>MIN(stretches,most),NA(),IF(ISODD(place),INDEX(first,nth),INDEX(last,nth)))", place=place,
            nth=formula("ROUNDUP(place/2,0)", place=place), stretches=stretches, most=rules.STRETCHES, first=first,
            last=last,
        )  # fmt: skip
        outside = table.work(
            row, OUTSIDE, "IF(ISODD(place),inside-1,IF(inside<rows,inside+1,NA()))",
            place=place, inside=inside, rows=table.rows,
        )  # fmt: skip
        margins = [*plan.equations.margins.values()]
        begin = {
            "near": inside,
            "newest": outside,
            "f_newest": rules.least_margin([self._in_row(symbol, Symbol("newest")) for symbol in margins]),
            "other": inside,
            "f_other": rules.least_margin([self._in_row(symbol, Symbol("other")) for symbol in margins]),
            "share": rules.FIRST_SHARE,
        }
        probing = {"share": rules.SHARE, "probe": rules.SHARED}
        known = table.search(row, rules.LIMIT_PROBES + 1, begin, rules.CROSSING, rules.CROSSED, probing)
        table.lay(row, rules.LIMIT_PROBES, margins)
        least = rules.least_margin([table.quantity(row, symbol) for symbol in margins])
        table.fill(row, VALUE_COL, least, rules.LIMIT_PROBES)
        self._result(
            row, {name: replace(known[name], row=row + rules.LIMIT_PROBES) for name in rules.CROSSING}, known["f_other"]
        )

    def _result(self, row: int, last: dict[str, CellRef], margin: CellRef) -> None:
        """Where the limit is by the last row, the driver's value there, and what is left."""
        table = self.table
        known = last | {"inside": table.near(row, INSIDE), "outside": table.near(row, OUTSIDE), "margin": margin}
        found = table.work(row, FOUND, "found", found=with_symbols(rules.FOUND, known))
        table.work(row, DRIVER, "driver", styles.RESULT, driver=driver_at(self.plan, replace(found, col_abs=False)))
        table.work(row, REST, "rest", rest=with_symbols(rules.REST, known))

    def _in_row(self, symbol: str, row: Node) -> Node:
        """A margin in a row of the table."""
        return formula("INDEX(column,row_there)", column=whole(symbol), row_there=row)
