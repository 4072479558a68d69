"""Stretches of the sweep in which the mechanism closes, and their ends: the limit positions, between two rows.

The margin of the group that comes apart is smooth in the driver on both sides of the limit. Three probes look for
where it is 0: the first by the chord through the two rows beside it, the others by the inverse parabola through three
points known (Brent, Algorithms for Minimization without Derivatives, 1973). Values of the driver are counted in rows
(`probes`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mechsheet.formula import algebra as al
from mechsheet.formula.names import folded, safe_name
from mechsheet.formula.nodes import Call, CellRef, Node, Symbol
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.probes import AT, SIDE, VALUE, Block, Probes
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.table.positions import first_open
from mechsheet.sheet.workbook import Name

STRETCHES = 3
"""Stretches that are looked at; further ones are counted."""

LIMITS = 4
"""Limits that are found; further ones are counted."""

PROBES = 3
INWARDS = 1e-10
"""How far inside the limit its value is given, in parts of a row: there the mechanism still closes."""

ASIDE = 2e-3
"""How far inside [rows] it is looked whether another group is open there."""

APART = 1e-7
"""So far [rows] the next probe is from the last, at least: a slope can be seen."""

SETTLED = 1e-5
"""What the last probe lacks to the limit, in parts of the margin in the row beside it; more, and it is said to be
about right."""

FIRST_ROW, LAST_ROW, FROM, TO, WORDS = range(5)
"""Cells of a stretch, beside each other: its rows (from 1), where it begins and ends between rows, and its rows in words."""


class Limits:
    """The blocks of stretches and limits; `row` is their first row, `end` the first one below them."""

    def __init__(self, probes: Probes, row: int) -> None:
        self.probes = probes
        self.plan: Plan = probes.plan
        self.row = row
        self.stretch_rows = [row + 2 + number for number in range(STRETCHES)]
        stepped = not self.plan.mechanism.driver.values and self.plan.rows > 1
        self.count = LIMITS if self.plan.equations.margins and stepped else 0
        start = row + 2 + STRETCHES + 1
        self.blocks = [Block(start + number * (PROBES + 2), PROBES) for number in range(self.count)]
        self.end = start + self.count * (PROBES + 2)
        for number, block in enumerate(self.blocks, 1):
            self._name(number, probes.cell(block.row, SIDE + 5))
            rest = probes.cell(block.row, SIDE + 7)
            self.plan.at.spots[f"#rest_{number}"] = Spot(probes.title, rest.row, rest.col)
        n = probes.cell(row, 1)
        self.plan.at.spots["#stretches"] = Spot(probes.title, n.row, n.col)
        self.plan.at.spots["#unsettled"] = Spot(probes.title, n.row, n.col + 1)
        for number in range(1, STRETCHES + 1):
            for key, work in (("first", FIRST_ROW), ("last", LAST_ROW), ("from", FROM), ("to", TO), ("stretch", WORDS)):
                spot = self.of_stretch(number, work)
                self.plan.at.spots[f"#{key}_{number}"] = Spot(probes.title, spot.row, spot.col)

    def _name(self, number: int, cell: CellRef) -> None:
        """The driver's value at a limit has a name, the same in both languages."""
        names = self.plan.names
        name = safe_name(f"limit_{number}", {folded(each.name) for each in names})
        names.append(Name(name, self.probes.title, cell.row, cell.col))
        self.plan.at.spots[f"#limit_{number}"] = Spot(self.probes.title, cell.row, cell.col, name=name)

    def of_stretch(self, number: int, work: int) -> CellRef:
        """A cell of a stretch, counted from 1."""
        return self.probes.cell(self.stretch_rows[number - 1], work)

    def _found(self, block: Block) -> CellRef:
        return self.probes.cell(block.row, SIDE + 4)

    # --- writing ----------------------------------------------------------------------------------------------

    def write(self) -> None:
        """All cells."""
        probes, plan = self.probes, self.plan
        probes.put(self.row, probes.side, plan.text("extremes.stretches"), styles.LABEL)
        begun = plan.at.spots["#begun"]
        last = CellRef(begun.row + plan.rows - 1, begun.col, True, True, begun.sheet)
        stretches = probes.work(self.row, 1, "last", last=last)
        for work, key in enumerate(("first", "last", "from", "to")):
            probes.put(self.row + 1, probes.side + work, plan.text(f"extremes.{key}"), styles.HEAD)
        rests = [self.plan.at.cell(f"#rest_{number}", probes.title, None) for number in range(1, self.count + 1)]
        probes.work(
            self.row, 2, "rests>settled" if rests else "FALSE", rests=Call("MAX", tuple(rests)), settled=SETTLED
        )
        for number in range(1, STRETCHES + 1):
            self._stretch(number, stretches)
        for number, block in enumerate(self.blocks, 1):
            self._limit(number, block, stretches)

    def _stretch(self, number: int, stretches: CellRef) -> None:
        """Rows of a stretch, and its ends: the limits beside them, where there are."""
        probes, row = self.probes, self.stretch_rows[number - 1]
        ok = self.plan.text("status.ok")
        first = probes.work(row, FIRST_ROW, 'IF(stretches<number,"",MATCH(number,ALL(_begun),0))',
                            stretches=stretches, number=number)  # fmt: skip
        last = probes.work(row, LAST_ROW, 'IF(stretches<number,"",first+COUNTIFS(ALL(_begun),number,said,ok)-1)',
                           stretches=stretches, number=number, first=first, said=Symbol(f"{ALL}#status"), ok=ok)  # fmt: skip
        ends = [formula("ROUND(INDEX(drivers,row),2)", drivers=Symbol(ALL + self.plan.mechanism.driver.symbol), row=edge)
                for edge in (first, last)]  # fmt: skip
        probes.work(row, WORDS, 'IF(ISNUMBER(first),words,"")', first=first,
                    words=joined("; " if number > 1 else "", ends[0], " … ", ends[1]))  # fmt: skip
        if not self.count:
            probes.work(row, FROM, "first", first=first)
            probes.work(row, TO, "last", last=last)
            return
        begun_outside = probes.cell(self.stretch_rows[0], FIRST_ROW)
        # The first limit is the first stretch's beginning where the sweep begins outside: then all come one later.
        for work, edge, outside, offset in (
            (FROM, first, "edge>1", 2 * number - 2),
            (TO, last, "edge<rows", 2 * number - 1),
        ):
            slots = [
                self._found(self.blocks[index]) if 0 <= index < self.count else edge for index in (offset - 1, offset)
            ]
            probes.work(
                row, work, f'IF(ISNUMBER(edge),IF({outside},IF(begun_outside>1,later,earlier),edge),"")',
                edge=edge, rows=self.plan.rows, begun_outside=begun_outside, earlier=slots[0], later=slots[1],
            )  # fmt: skip

    def _limit(self, number: int, block: Block, stretches: CellRef) -> None:
        """One limit: the row that exists beside it, the missing one, and where between them the margin is 0."""
        probes, row = self.probes, block.row
        plan, side = self.plan, SIDE
        probes.put(row, probes.side - 1, plan.text("extremes.limit", number=number), styles.LABEL)
        # in order: beginning and end of each stretch; the first is none when the sweep begins inside
        place = probes.work(row, side, "number+IF(first=1,1,0)", number=number,
                            first=probes.cell(self.stretch_rows[0], FIRST_ROW))  # fmt: skip
        first = probes.cells_down(self.stretch_rows[0], FIRST_ROW, STRETCHES)
        last = probes.cells_down(self.stretch_rows[0], LAST_ROW, STRETCHES)
        inside = probes.work(
            row, side + 1,
            "IF(nth>MIN(stretches,most),NA(),IF(ISODD(place),INDEX(first,nth),INDEX(last,nth)))", place=place,
            nth=formula("ROUNDUP(place/2,0)", place=place), stretches=stretches, most=STRETCHES, first=first, last=last,
        )  # fmt: skip
        outside = probes.work(
            row, side + 2, "IF(ISODD(place),inside-1,IF(inside<rows,inside+1,NA()))",
            place=place, inside=inside, rows=plan.rows,
        )  # fmt: skip
        probes.work(row, AT, "inside", inside=inside)
        symbols = plan.equations.margins
        probes.lay(block, list(symbols.values()) + [g.closes for g in plan.equations.groups[:-1]])
        opened = probes.work(row, side + 3, "opened", opened=self._opened(outside))
        here = self._margin_of_row(row, VALUE, opened, inside)
        beyond = self._margin_of_row(row + 1, side, opened, outside)
        probes.work(row + 1, AT, "inside+(outside-inside)*here/(here-beyond)",
                    inside=inside, outside=outside, here=here, beyond=beyond)  # fmt: skip
        several = len(symbols) > 1
        # another group may come apart before the one that is open in the missing row: the second probe shows it
        group = opened
        if several:
            group = probes.work(row + 1, side + 1, "first", first=self._open_at(row + 2, opened))
        for index in range(1, PROBES + 1):
            cells = self._margins_at(row + index)
            named: dict[str, Node] = {f"group{number}x": cell for number, cell in zip(symbols, cells, strict=True)}
            probes.work(row + index, VALUE, _chosen(symbols), **named, group=opened if index == 1 else group)
        known, end = (probes.cell(row, AT), here), (outside, beyond)
        one: tuple[Node, Node]
        one, two, three = ((probes.cell(row + index, AT), probes.cell(row + index, VALUE)) for index in (1, 2, 3))
        # with several groups a little inside: where one is just open, nothing is known of those after it
        # where the margin is least near the missing row, it goes there as a square does: u(m) is no parabola
        second = "IFERROR(IF(f<beyond/2,chord,zero),one)" + ("+(inside-outside)*aside" if several else "")
        probes.work(
            row + 2, AT, second, zero=self._zero((known, end, one), inside, outside, APART), one=one[0], inside=inside,
            chord=formula("one+(inside-one)*SQRT(-f/(here-f))", inside=inside, one=one[0], here=here, f=one[1]),
            outside=outside, aside=ASIDE, f=one[1], beyond=beyond,
        )  # fmt: skip
        if several:  # then all begins anew from the row that exists
            here = self._margin_of_row(row + 2, side, group, inside)
            known = (known[0], here)
            same = formula("group=opened", group=group, opened=opened)
            place, margin = (
                probes.work(
                    row + 2, side + work, "IF(same,probed,row_there)", same=same, probed=probed, row_there=there
                )
                for work, probed, there in ((1, one[0], known[0]), (2, one[1], here))
            )
            one = (place, margin)
        chord = formula("inside+(two-inside)*here/(here-f)", inside=inside, two=two[0], here=here, f=two[1])
        zero = self._zero((known, one, two), inside, outside, APART)
        probes.work(row + 3, AT, "IFERROR(zero,IFERROR(chord,two))", zero=zero, chord=chord, two=two[0])
        best = probes.work(row, side + 6, "IF(ISNUMBER(outside),IFERROR(zero,last),NA())", outside=outside, last=three[0],
                           zero=self._zero((one, two, three), inside, outside, 0.0))  # fmt: skip
        # a little inside, by a part of what the last step still changed
        found = probes.work(
            row, side + 4, "MEDIAN(inside,outside,best+(inside-outside)*(ABS(best-probed)*part+inwards))",
            best=best, inside=inside, outside=outside, probed=three[0], part=1e-4, inwards=INWARDS,
        )  # fmt: skip
        probes.work(row, side + 5, "driver", styles.RESULT, driver=driver_at(self.plan, found))
        least = Call("MIN", tuple(self._margins_at(row + PROBES)))
        probes.work(row, side + 7, "IF(ISNUMBER(outside),IFERROR(MAX(ABS(f),-least)/here,1),0)",
                    outside=outside, f=three[1], least=least, here=here)  # fmt: skip

    def _margins_at(self, row: int) -> list[Node]:
        """The cells of all margins of a probe."""
        spots = self.plan.at.spots
        return [CellRef(row, spots[symbol].col, False, True) for symbol in self.plan.equations.margins.values()]

    def _open_at(self, row: int, opened: Node) -> Node:
        """The number of the first group that is not joined in a probe; where all are, the one open in the row beyond."""
        found = opened
        for number, cell in reversed([*zip(self.plan.equations.margins, self._margins_at(row), strict=True)]):
            found = formula("IF(IFERROR(margin<0,FALSE),number,found)", margin=cell, number=number, found=found)
        return found

    def _opened(self, row: Node) -> Node:
        """The number of the group that is not joined in a row of the table."""
        closing = [
            formula("ISNUMBER(INDEX(column,row_there))", column=Symbol(ALL + group.closes), row_there=row)
            for group in self.plan.equations.groups
        ]
        return first_open(closing)

    def _margin_of_row(self, row: int, work: int, group: Node, table_row: Node) -> CellRef:
        """The margin of the group in a row of the table."""
        symbols = self.plan.equations.margins
        values: dict[str, Node] = {
            f"group{number}x": formula("INDEX(column,row_there)", column=Symbol(ALL + symbol), row_there=table_row)
            for number, symbol in symbols.items()
        }
        return self.probes.work(row, work, _chosen(symbols), **values, group=group)

    def _zero(self, known: Sequence[tuple[Node, Node]], inside: Node, outside: Node, apart: float) -> Node:
        """Where a parabola u(m) through three points is 0, on the side of the last point where the limit is, apart
        from it."""
        (one, f_one), (two, f_two), (three, f_three) = known
        total: Node = al.ZERO
        for place, f, g, h in (
            (one, f_one, f_two, f_three),
            (two, f_two, f_one, f_three),
            (three, f_three, f_one, f_two),
        ):
            total = al.add(total, formula("place*(g/(f-g))*(h/(f-h))", place=place, f=f, g=g, h=h))
        edge = formula("IF(f<0,inside,outside)", f=f_three, inside=inside, outside=outside)
        near = formula("last+(inside-outside)*IF(f<0,apart,-apart)", last=three, inside=inside, outside=outside,
                       f=f_three, apart=apart) if apart else three  # fmt: skip
        return formula("MEDIAN(near,edge,zero)", near=near, edge=edge, zero=total)


def _chosen(symbols: Mapping[int, str]) -> str:
    """The quantity of the group that comes apart, of those that have a margin."""
    text = "NA()"
    for number in reversed(symbols):
        text = f"IF(group={number},group{number}x,{text})"
    return text
