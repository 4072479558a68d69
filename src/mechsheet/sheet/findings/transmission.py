"""How well each group transmits force: its worst angle of transmission."""

from __future__ import annotations

from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol
from mechsheet.kinematics.equations import Group
from mechsheet.sheet.findings.finding import Finding, InTitle, Line, good, look
from mechsheet.sheet.findings.ratios import HIGH_LOW
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import MEANING, SYMBOL, VALUE
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.table.positions import places
from mechsheet.sheet.transmission import acute, poor_limit, worst_of_rows, worst_words
from mechsheet.units import behind_number


class Transmission(Finding):
    """The angle of transmission that is farthest from 90 degrees, as an acute angle; that of the rows where the sheet of
    extremes was deleted.

    all  the groups that have one: the line under the title names the worst
    """

    placed = True

    def __init__(self, group: Group, all: tuple[Group, ...]) -> None:
        self.group, self.all = group, all
        self.key = key_of(group)

    def line(self, on: Reading) -> Line:
        plan, group, value = on.plan, self.group, on.value(self.key)
        high, low = (on.found.extremes[way, group.transmission] for way in HIGH_LOW)
        folded = acute(low.value.cell, high.value.cell, from_right=group.kind != "RRR")
        unit = plan.mechanism.angle_unit
        poor = formula("value<limit", value=value, limit=poor_limit(plan.mechanism))
        of_rows = plan.between_unseen if plan.rows_only else on.found.rows_only.cell
        said = worst_words(plan, value, on.place(self.key), poor, of_rows)
        column = Symbol(ALL + group.transmission)
        in_rows = acute(over_rows(LEAST, column), over_rows(MOST, column), from_right=group.kind != "RRR")
        least = on.while_there("extremes", Call("MIN", folded), Call("MIN", in_rows))
        said = on.while_there("extremes", joined(said, on.about(group.transmission)), worst_of_rows(plan, value, poor))
        words = formula('IFERROR(said,"")', said=said)
        if unit.in_degrees:
            least = formula("DEGREES(least)", least=least)
        at_low = formula(
            "IF(one<=other+1E-6,place,elsewhere)", one=folded[0], other=folded[1], place=low.occurs.cell,
            elsewhere=high.occurs.cell,
        )  # fmt: skip
        return Line(
            f"μ{group.number}", formula("IFERROR(value,NA())", value=least),
            words, unit.text,
            places(plan, "angle"), place=formula("IFERROR(place,NA())", place=at_low),
            itself=("value", "words"),
            levels=(
                look("AND(ISNUMBER(value),poor)", value=value, poor=poor),
                good("ISNUMBER(FIND(fair,said))", said=on.words(self.key), fair=on.text("fair")),
            ),
        )  # fmt: skip

    def in_title(self, on: Reading) -> InTitle:
        if self.group != self.all[0]:
            return InTitle()
        what = f"; {on.text('line.transmission')} "
        if len(self.all) == 1:
            return InTitle(here=formula('IF(ISNUMBER(value),what&words,"")', value=on.value(self.key), what=what,
                                        words=on.words(self.key)))  # fmt: skip
        symbols, said = (column(on, self.all, col) for col in (SYMBOL, MEANING))
        return InTitle(here=formula(
            'IFERROR(what&INDEX(symbols,worst)&" "&INDEX(said,worst),"")', what=what, symbols=symbols, said=said,
            worst=there(on.found.worst_group).cell,
        ))  # fmt: skip

    def left(self, on: Reading) -> Node | str:
        if self.group != self.all[0]:
            return ""
        unit, angles = on.plan.mechanism.angle_unit, column(on, self.all, VALUE)
        least = formula("ROUND(MIN(angles),digits)", angles=angles, digits=1 if unit.in_degrees else 2)
        said = joined(f"{on.text('line.transmission')} ", least, f"{behind_number(unit.text)}; ")
        return formula('IF(COUNT(angles)>0,said,"")', angles=angles, said=said)


def key_of(group: Group) -> str:
    """The key of a group's line."""
    return f"transmission_{group.number}"


def column(on: Reading, groups: tuple[Group, ...], col: int) -> RangeRef:
    """The cells of a column in the lines of all angles of transmission."""
    rows = [on.rows[key_of(group)] for group in groups]
    return RangeRef(CellRef(rows[0], col, True, True), CellRef(rows[-1], col, True, True))
