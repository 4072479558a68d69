"""The type of each four-bar loop by its lengths (Grashof), and what would mend one that cannot be closed."""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula.nodes import Call, Node
from mechsheet.kinematics.numeric import value
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.findings.finding import Beside, Finding, InTitle, Level, Line, bad, look, note
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.grashof import (
    AT_MOST,
    BEGINS,
    bound_of,
    excess_of,
    has_advice,
    in_summary,
    named,
    names_of_sides,
    turning_types,
    type_of,
)
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.table.positions import decimals_of_kind


class FourBarType(Finding):
    """Shortest + longest - the other two: negative where some link turns fully; and the loop's type in words.

    first  whether the line under the title says it, too
    """

    by_rows = True

    def __init__(self, loop: FourBar, first: bool) -> None:
        self.loop, self.first = loop, first
        self.key = f"grashof_{loop.group}"

    def key_beside(self, plan: Plan) -> str:
        return f"bound_{self.loop.group}" if has_advice(self.loop, plan) else ""

    def line(self, on: Reading) -> Line:
        plan, loop, said, excess = on.plan, self.loop, on.words(self.key), on.value(self.key)
        sides = on.sides(loop, names_of_sides(loop, plan))
        shortest, (most, total) = sides.shortest, (Call(name, sides.all) for name in ("MAX", "SUM"))

        def text(word: str, **parts: object) -> str:
            return on.text(f"grashof.{word}", **parts)

        bound = mended = None
        if has_advice(loop, plan):
            mend = formula('IFERROR(mend,"")', mend=bound_of(sides, shortest, excess))
            bound = Beside(mend, AT_MOST.strip(), plan.text("page.bound"))
            mended = on.beside(self.key, mend)
        kind = type_of(shortest, excess, sides.first("MIN", turning_types(loop, plan, text)), text, mended)
        begin = f"{named(loop, plan)}: "
        levels: tuple[Level, ...] = (
            bad(BEGINS, said=said, begin=begin + text("open")),
            note("said=change", said=said, change=begin + text("change")),
        )
        reach: Node | str = ""
        if plan.mechanism.bands is not None and plan.extremes is not None:  # a page has no bands
            reach = on.found.reach[loop.group].cell
            levels += (look("ISNUMBER(FIND(reach,said))", said=said, reach=text("reach")),)
        words = formula('IFERROR(said,"")', said=joined(begin, kind, reach))
        return Line(
            on.text("grashof"), excess_of(plan, shortest, most, total), words, plan.mechanism.length_unit,
            decimals_of_kind(plan, "length"), beside=bound, note=plan.text("notes.use.grashof"), levels=levels,
        )  # fmt: skip

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
