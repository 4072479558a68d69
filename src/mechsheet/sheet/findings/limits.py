"""Where the mechanism begins to close and ceases to: limit positions, the driver's range, gaps between two rows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, Text
from mechsheet.sheet.checks.limits import LIMITS
from mechsheet.sheet.driving import driver_at
from mechsheet.sheet.findings.finding import Finding, InTitle, Line, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.over_rows import but_first, but_last
from mechsheet.sheet.quoted import formula, joined


class Limits(Finding):
    """The limit positions within the sweep: how many, and where."""

    key = "limits"

    def line(self, on: Reading) -> Line:
        column, symbol = on.plan.places.status.whole(), on.text("limits")
        if on.plan.rows == 1:
            return Line(symbol, al.ZERO, Text(""))
        count = formula("SUMPRODUCT(((later=ok)<>(earlier=ok))*1)", later=but_first(column),
                        earlier=but_last(column), ok=on.plan.text("status.ok"))  # fmt: skip
        cell = on.value(self.key)
        parts: list[Node | str] = []
        for number, spot in enumerate(on.found.limits, 1):
            named = joined("; " if number > 1 else "", on.driver_text(spot.cell))
            parts.append(formula('IF(count<number,"",named)', count=cell, number=number, named=named))
        more = formula('IF(count>most," …","")', count=cell, most=LIMITS)
        if on.found.limits:
            more = joined(more, _within_a_step(on))
        words = formula(
            'IF(count>0,IFERROR(found,""),IF(AND(closed>0,passes=0),none,""))', count=cell, closed=on.value("rows_closed"),
            passes=on.value("passes"), none=on.text("limits.none"), found=joined(*parts, more),
        )  # fmt: skip
        return Line(symbol, count, words, levels=(look("count>0", count=cell),))

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        limits = motion.search.limits()
        found = {self.key: Expected([float(len(limits))])}
        if motion.search.stepped:
            allowed = motion.allowed_where()
            places = [motion.drivers(where) for _, where in limits]
            places += [[]] * (len(motion.plan.searched.limits) - len(limits))
            found |= {f"limit_{number}": Expected(place, allowed) for number, place in enumerate(places, 1)}
        return found


def _within_a_step(on: Reading) -> Node:
    """What is added to limits that the probes have not found."""
    return formula('IF(unsettled,within,"")', unsettled=on.found.unsettled.cell, within=on.text("within"))


class InputEnd(Finding):
    """From where, or to where, the driver can go in the first stretch; words stand beside the first of the two."""

    def __init__(self, end: Literal["from", "to"]) -> None:
        self.end = end
        self.key = f"input_{end}"

    def line(self, on: Reading) -> Line:
        stretch, count = on.found.stretches[0], on.found.count.cell
        first = self.end == "from"
        if on.driver.values or on.plan.rows == 1:  # listed values may go to and fro
            end = formula(f"{'MIN' if first else 'MAX'}(INDEX(drivers,first):INDEX(drivers,last))", drivers=on.drivers,
                          first=stretch.first.cell, last=stretch.last.cell)  # fmt: skip
        else:
            end = driver_at(on.plan, (stretch.begin if first else stretch.end).cell)
        value = formula("IF(stretches=0,NA(),value)", stretches=count, value=end)
        words = self._words(on, count) if first else Text("")
        return Line(on.text("input") if first else "", value, words, on.driver.unit.text, on.driver_decimals())

    def _words(self, on: Reading, count: Node) -> Node:
        everywhere = formula("AND(count=rows,whole>0,passes=0)", count=on.value("rows_closed"), rows=on.of_rows,
                             whole=on.found.whole.cell, passes=on.value("passes"))  # fmt: skip
        free = formula("IF(everywhere,free,range)", everywhere=everywhere, free=on.text("input.free"),
                       range=on.text("input.range"))  # fmt: skip
        return formula("IF(stretches=0,nowhere,IF(stretches>1,first,free)&within)", stretches=count,
                       nowhere=on.text("rows.none"), first=on.text("input.first"), free=free,
                       within=_within_a_step(on))  # fmt: skip

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        search = motion.search
        if not search.count:
            return {self.key: Expected([])}
        first, last = search.row_stretches[0]
        if motion.plan.mechanism.driver.values:  # they may go to and fro
            pick = min if self.end == "from" else max
            found = [pick(motion.drivers(range(first, last + 1)))]
        else:
            row, other = (first, first - 1) if self.end == "from" else (last, last + 1)
            inside = search.stepped and 1 <= other <= search.rows
            found = motion.drivers((search.edges_between(row, other) if inside else []) or [float(row)])
        return {self.key: Expected(found, motion.allowed_where())}


class Passes(Finding):
    """Whether a group comes apart between two rows that exist, or lines of it turn parallel."""

    key, placed = "passes", True

    def line(self, on: Reading) -> Line:
        tolerance = Symbol(on.plan.equations.tolerance)
        found: Node = al.ZERO
        where: Node = Text("")
        for least, row in reversed([*on.found.gaps.values()]):
            dips = formula("IFERROR(least<-tolerance,FALSE)", least=least.cell, tolerance=tolerance)
            found = al.add(formula("IF(dips,1,0)", dips=dips), found)
            where = formula("IF(dips,place,other)", dips=dips, place=driver_at(on.plan, row.cell), other=where)
        for least, occurs in () if on.driver.values else on.plan.checked.crossed.values():
            turned = formula("IFERROR(least<0,FALSE)", least=least.cell)
            found = al.add(formula("IF(turned,1,0)", turned=turned), found)
            where = formula("IF(turned,place,other)", turned=turned, place=occurs.cell, other=where)
        count = on.value(self.key)
        before, after = on.text("passes.not", place="#").split("#")
        between = joined(before, formula("ROUND(place,1)", place=on.beside(self.key, where)), on.unit, after)
        words = formula('IF(closed=0,"",IF(count=0,through,between))', closed=on.value("rows_closed"), count=count,
                        through=on.text("passes.all"), between=between)  # fmt: skip
        return Line(on.text("passes"), found, words, occurs=where, levels=(look("count>0", count=count),))

    def in_title(self, on: Reading) -> InTitle:
        return InTitle(here=formula('IF(passes>0,"; "&dips,"")', passes=on.value(self.key), dips=on.words(self.key)))

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        if motion.search.doubtful:
            return {}
        return {self.key: Expected([float(bool(motion.search.holes))], warning=True, told=False)}
