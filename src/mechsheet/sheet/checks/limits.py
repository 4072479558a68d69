"""Stretches of the sweep in which the mechanism closes, and their ends: the limit positions, between two rows.

The margin of the group that comes apart is smooth in the driver on both sides of the limit. Three probes look for
where it is 0: the first by the chord through the two rows beside it, the others by the parabola through three points known,
between which its sign changes: there such a parabola has one zero (Muller, A Method for Solving Algebraic Equations Using an
Automatic Computer, 1956). Values of the driver are counted in rows (`probes`).
"""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.formula import algebra as al
from mechsheet.formula.names import folded, safe_name
from mechsheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.probes import ALL_ROWS, AT, SIDE, VALUE, Block, Probes
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.table.status import first_open
from mechsheet.sheet.workbook import Name

STRETCHES = 3
"""Stretches that are looked at; further ones are counted."""

LIMITS = 4
"""Limits that are found; further ones are counted."""

PROBES = 3
INWARDS = 1e-9
"""How far inside the limit its value is given, in parts of a row: there the mechanism still closes."""

ASIDE = 2e-3
"""How far inside [rows] it is looked whether another group is open there."""

APART = 1e-7
"""So far [rows] the next probe is from the last, at least: a slope can be seen."""

SETTLED = 1e-5
"""What the last probe lacks to the limit, in parts of the margin in the row beside it; more, and it is said to be
known to a step."""

GROUP, BEND = 4, 5
"""Working cells beside a probe: the number of the group that comes apart, the bend of a parabola through it."""

Point = tuple[Node, Node]
"""A place and the margin there."""

FIRST_ROW, LAST_ROW, FROM, TO, WORDS = range(5)
"""Cells of a stretch, beside each other: its rows (from 1), where it begins and ends between rows, and its rows in words."""


def last_rows(plan: Plan) -> RangeRef:
    """The last row of every stretch: one range, so that it reads back as it was written."""
    top, bottom = (plan.at.spots[f"#last_{number}"] for number in (1, STRETCHES))
    return RangeRef(*(CellRef(spot.row, spot.col, True, True, spot.sheet) for spot in (top, bottom)))


class Limits:
    """The blocks of stretches and limits; `row` is their first row, `end` the first one below them."""

    def __init__(self, probes: Probes, row: int) -> None:
        self.probes = probes
        self.plan: Plan = probes.plan
        self.row = row
        self.stretch_rows = [row + 2 + number for number in range(STRETCHES)]
        stepped = not self.plan.mechanism.driver.values and self.plan.rows > 1
        self.count = LIMITS if self.plan.equations.margins and stepped else 0
        # no margin says where a slot's pin comes to lie on its pivot, or where lines turn parallel
        loose = self.plan.equations.crossings or any(group.only_undetermined for group in self.plan.equations.groups)
        self.unprobed = bool(stepped and not self.count and not self.plan.newton and loose)
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
        self.plan.at.spots["#rows_only"] = Spot(probes.title, n.row, n.col + 2)
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
        first, last = (self.of_stretch(1, work) for work in (FIRST_ROW, LAST_ROW))
        unsettled = probes.work(
            self.row, 2,
            "rests>settled" if rests else "IF(stretches=0,FALSE,last-first+1<rows)" if self.unprobed else "FALSE",
            rests=Call("MAX", tuple(rests)), settled=SETTLED, first=first, last=last, rows=ALL_ROWS, stretches=stretches,
        )  # fmt: skip
        probes.work(
            self.row, 3, "OR(stretches>1,unsettled,AND(stretches=1,first=last))",
            stretches=stretches, first=first, last=last, unsettled=unsettled,
        )  # fmt: skip
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
                edge=edge, rows=ALL_ROWS, begun_outside=begun_outside, earlier=slots[0], later=slots[1],
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
            place=place, inside=inside, rows=ALL_ROWS,
        )  # fmt: skip
        probes.work(row, AT, "inside", inside=inside)
        self._look(block, inside, outside)

    def _look(self, block: Block, inside: CellRef, outside: CellRef) -> None:
        """Where between a row that exists and one that does not the margin is 0, and what the last probe lacks."""
        probes, row, side = self.probes, block.row, SIDE
        plan = self.plan
        symbols = plan.equations.margins
        several = len(symbols) > 1
        probes.lay(block, list(symbols.values()) + [g.closes for g in plan.equations.groups[:-1]])
        # the group that is open in the missing row; another may come apart before it: the probes show it
        opened = probes.work(row, side + 3, "opened", opened=self._opened(outside)) if several else None
        here = self._margin_of_row(row, VALUE, opened, inside)
        beyond = self._margin_of_row(row + 1, side, opened, outside)
        probes.work(row + 1, AT, "inside+(outside-inside)*here/(here-beyond)",
                    inside=inside, outside=outside, here=here, beyond=beyond)  # fmt: skip
        one: Point
        one, two, three = ((probes.cell(row + index, AT), probes.cell(row + index, VALUE)) for index in (1, 2, 3))
        group = self._group_at(row + 1, opened)
        probes.work(row + 1, VALUE, _chosen(symbols), **self._named_margins(row + 1, group))
        parabola = formula(
            "inside+(outside-inside)*2*part/(1+bend+SQRT((1+bend)^2-4*bend*part))", inside=inside, outside=outside,
            part=formula("ABS(one-inside)", one=one[0], inside=inside),
            bend=formula("f*(here-beyond)/(here*beyond)", f=one[1], here=here, beyond=beyond),
        )  # fmt: skip
        if group is not None and opened is not None:
            here = self._margin_of_row(row + 1, side + 2, group, inside)
            same = formula("group=opened", group=group, opened=opened)
            parabola = formula("IF(same,parabola,chord)+(inside-outside)*aside", same=same,
                               parabola=parabola, chord=_chord((inside, here), one), inside=inside, outside=outside,
                               aside=ASIDE)  # fmt: skip
        probes.work(row + 2, AT, "IFERROR(parabola,one)", parabola=parabola, one=one[0])
        group = self._group_at(row + 2, group)
        for index in (2, 3):
            probes.work(row + index, VALUE, _chosen(symbols), **self._named_margins(row + index, group))
        if several:
            here = self._margin_of_row(row + 2, side + 1, group, inside)
            one = (one[0], probes.work(row + 2, side + 2, _chosen(symbols), **self._named_margins(row + 1, group)))
        # the end whose margin has the other sign where both probes have the same
        end, margin = (
            formula("IF(MIN(f,g)>0,far,near)", f=one[1], g=two[1], far=there, near=known)
            for there, known in ((outside, inside), (beyond, here))
        )
        begin, way = (inside, here), al.sub(inside, outside)
        place = self._zero(row + 2, begin, (end, margin), one, two, way)
        # apart from the last probe, so that the slope can be seen
        apart = formula("MEDIAN(v+way*IF(g<0,apart,-apart),IF(g<0,inside,outside),place)", v=two[0], g=two[1], way=way,
                        apart=APART, inside=inside, outside=outside, place=place)  # fmt: skip
        probes.work(row + 3, AT, "apart", apart=apart)
        zero = self._zero(row + 3, begin, one, two, three, way)
        # where the row itself is the limit, the probes coincide
        best = probes.work(row, side + 6, "IF(ISNUMBER(outside),IFERROR(zero,probed),NA())", outside=outside, zero=zero,
                           probed=three[0])  # fmt: skip
        # a little inside, by a part of what the last step still changed; the row inside where there is no margin outside:
        # a group is not apart there but undetermined
        found = probes.work(
            row, side + 4,
            "IF(ISNUMBER(outside),IFERROR(MEDIAN(inside,outside,best+(inside-outside)*(ABS(best-probed)*part+inwards)),"
            "inside),NA())",
            best=best, inside=inside, outside=outside, probed=three[0], part=1e-4, inwards=INWARDS,
        )  # fmt: skip
        probes.work(row, side + 5, "driver", styles.RESULT, driver=driver_at(self.plan, found))
        # of groups after one that is open nothing is known
        least = Call("MIN", tuple(formula("IFERROR(margin,0)", margin=cell) for cell in self._margins_at(row + PROBES)))
        probes.work(row, side + 7, "IF(ISNUMBER(outside),IFERROR(MAX(ABS(f),-least)/here,1),0)",
                    outside=outside, f=three[1], least=least, here=here)  # fmt: skip

    def _margins_at(self, row: int) -> list[Node]:
        """The cells of all margins of a probe."""
        spots = self.plan.at.spots
        return [CellRef(row, spots[symbol].col, False, True) for symbol in self.plan.equations.margins.values()]

    def _named_margins(self, row: int, group: CellRef | None) -> dict[str, Node]:
        """The same and the group whose margin is asked for, as `_chosen` reads them."""
        symbols = self.plan.equations.margins
        named: dict[str, Node] = {
            f"group{number}x": cell for number, cell in zip(symbols, self._margins_at(row), strict=True)
        }
        return named if group is None else {**named, "group": group}

    def _group_at(self, row: int, before: CellRef | None) -> CellRef | None:
        """The number of the first group that is not joined in a probe; where all are, that of the probe before."""
        if before is None:
            return None
        found: Node = before
        for number, cell in reversed([*zip(self.plan.equations.margins, self._margins_at(row), strict=True)]):
            found = formula("IF(IFERROR(margin<0,FALSE),number,found)", margin=cell, number=number, found=found)
        return self.probes.work(row, SIDE + GROUP, "group", group=found)

    def _opened(self, row: Node) -> Node:
        """The number of the group that is not joined in a row of the table."""
        closing = [
            formula("ISNUMBER(INDEX(column,row_there))", column=Symbol(ALL + group.closes), row_there=row)
            for group in self.plan.equations.groups
        ]
        return first_open(closing)

    def _margin_of_row(self, row: int, work: int, group: CellRef | None, table_row: Node) -> CellRef:
        """The margin of the group in a row of the table."""
        symbols = self.plan.equations.margins
        values: dict[str, Node] = {
            f"group{number}x": formula("INDEX(column,row_there)", column=Symbol(ALL + symbol), row_there=table_row)
            for number, symbol in symbols.items()
        }
        named = values if group is None else {**values, "group": group}
        return self.probes.work(row, work, _chosen(symbols), **named)

    def _zero(self, row: int, inside: Point, end: Point, one: Point, two: Point, way: Node) -> Node:
        """Where the parabola m(u) through an end and two probes, the last of them `two`, is 0 and falls outwards; `way`:
        1 or -1, for inwards.

        Its bend, m[one, two, end], stands in a working cell of `row`.
        """
        (u, f), (v, g) = one, two
        bend = self.probes.work(row, SIDE + BEND, "((g-f)/(v-u)-(f-margin)/(u-end))/(v-end)", u=u, f=f, v=v, g=g,
                                end=end[0], margin=end[1])  # fmt: skip
        slope = formula("(g-f)/(v-u)+(v-u)*bend", u=u, f=f, v=v, g=g, bend=bend)
        zero = formula("v-2*g/(slope+way*SQRT(slope^2-4*g*bend))", v=v, g=g, slope=slope, way=way, bend=bend)
        return formula("IFERROR(zero,IF(g<0,chord,v))", zero=zero, g=g, v=v, chord=_chord(inside, two))


def _chord(one: Point, two: Point) -> Node:
    """Where the chord of two points is 0."""
    (u, f), (v, g) = one, two
    return formula("u+(v-u)*f/(f-g)", u=u, f=f, v=v, g=g)


def _chosen(symbols: Mapping[int, str]) -> str:
    """The margin of the group that comes apart, of those that have one."""
    *others, last = symbols
    if not others:
        return f"group{last}x"
    text = "NA()"
    for number in reversed(symbols):
        text = f"IF(group={number},group{number}x,{text})"
    return text
