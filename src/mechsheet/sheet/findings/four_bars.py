"""The type of each four-bar loop by its lengths (Grashof), and what would mend one that cannot be closed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.nodes import Call, Node, Number, RangeRef, Text
from mechsheet.kinematics.numeric import value
from mechsheet.sheet import styles
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.findings.finding import Finding, InTitle, Level, Line, bad, look, note
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.grashof import (
    BEGINS,
    Sides,
    bound_of,
    excess_of,
    in_summary,
    is_all,
    named,
    names_of_sides,
    turning_types,
    type_of,
)
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.table.positions import places


class FourBarType(Finding):
    """Shortest + longest - the other two: negative where some link turns fully; and the loop's type in words.

    first  whether the line under the title says it, too
    """

    def __init__(self, loop: FourBar, first: bool) -> None:
        self.loop, self.first = loop, first
        self.key = f"grashof_{loop.group}"

    def line(self, on: Reading) -> Line:
        plan, loop, said = on.plan, self.loop, on.words(self.key)
        lengths = on.extremes.lengths_of(loop)
        shortest, most, total = (Call(name, (lengths,)) for name in ("MIN", "MAX", "SUM"))

        def text(word: str, **parts: object) -> str:
            return on.text(f"grashof.{word}", **parts)

        which = formula(
            "CHOOSE(MATCH(shortest,lengths,0),both,crank,rockers,follower)", lengths=lengths, shortest=shortest,
            **turning_types(loop, plan.language, text),
        )  # fmt: skip
        alone = is_all(loop, plan)
        kind = type_of(shortest, on.value(self.key), which, text, on.place(self.key) if alone else None)
        begin = f"{named(loop, plan)}: "
        levels: tuple[Level, ...] = (
            bad(BEGINS, said=said, begin=begin + text("open")),
            note("said=change", said=said, change=begin + text("change")),
        )
        reach: Node | str = ""
        if plan.mechanism.bands is not None:
            reach = on.found.reach[loop.group].cell
            levels += (look("ISNUMBER(FIND(reach,said))", said=said, reach=text("reach")),)
        words = formula('IFERROR(said,"")', said=joined(begin, kind, reach))
        excess = formula("excess", excess=excess_of(plan, shortest, most, total))
        return Line(
            on.text("grashof"), excess, words, plan.mechanism.length_unit, places(plan, "length"),
            place=self._bound(on, lengths, shortest) if alone else None,
            place_style=replace(styles.UNIT, name="", align="right"), levels=levels,
        )  # fmt: skip

    def _bound(self, on: Reading, lengths: RangeRef, shortest: Node) -> Node:
        """Up to which length the longest link closes, or the first turns fully: beside the type of a four-bar."""
        names = names_of_sides(self.loop, on.plan)
        cells = [replace(lengths.start, col=lengths.start.col + at) for at in range(4)]

        def longest(length: Node) -> Node:
            return Call("CHOOSE", (Call("MATCH", (length, lengths, Number(0.0))), *map(Text, names)))

        sides = Sides(cells, (lengths,), names, longest, places(on.plan, "length"))
        return formula('IFERROR(mend,"")', mend=bound_of(sides, shortest, on.value(self.key)))

    def in_title(self, on: Reading) -> InTitle:
        if not self.first:
            return InTitle()
        complete = formula("count=rows", count=on.value("rows_closed"), rows=on.of_rows)
        return InTitle(here=in_summary(self.loop, on.plan, on.words(self.key), complete))

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        search, wrong = motion.search, motion.number("inputs")
        if isinstance(wrong, float) and wrong > 0:  # of inputs that cannot be nothing is said
            return {self.key: Expected([])}
        known = {name: column[0] for name, column in search.at.items()}
        poses, sides = motion.plan.equations.poses, self.loop.sides(search.mechanism.ground)
        lengths = [float(value(length_in_cells(link, one, other, poses), known)) for link, one, other in sides]
        return {self.key: Expected([2 * (min(lengths) + max(lengths)) - sum(lengths)], 1e-8 * search.size)}
