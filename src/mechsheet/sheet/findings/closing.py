"""In how many rows a mechanism closes, how far its joints are apart there, and whether the rows are near enough together.

Of groups that Newton's method solves: how well it has found each row, in how many passes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node
from mechsheet.kinematics.points_in_link import number_points
from mechsheet.sheet import styles
from mechsheet.sheet.checks.checks import LEAP
from mechsheet.sheet.checks.rows import misfits_of
from mechsheet.sheet.findings.finding import Finding, InTitle, Level, Line, bad, good, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.grashof import why_nowhere
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.table.iterations import assemblies_lost
from mechsheet.words.equations import link_words

SMALL = styles.numbered(styles.RESULT, styles.ERROR.number_format)
"""How numbers stand that are nothing but rounding where all is well."""

GAP = 1e-9
"""A gap of a joint, as a part of the size, that is nothing but rounding."""


class RowsClosed(Finding):
    """In how many rows it closes, and in which stretches."""

    key, by_rows = "rows_closed", True

    def line(self, on: Reading) -> Line:
        count, rows = on.value(self.key), on.of_rows
        counted, of_rows = on.count_rows()
        some, stretches = closes_in_some(on.plan, count, rows), on.stretches()
        if stretches is not None:
            some = on.while_there("extremes", stretches, some)
        words = formula(
            "IF(count=0,nowhere,IF(count=rows,everywhere,some))", count=count, rows=rows, nowhere=on.text("rows.none"),
            everywhere=on.text("rows.all"), some=some,
        )  # fmt: skip
        levels = [
            bad("count=0", count=count),
            look("count<rows", count=count, rows=rows),
            good("count=rows", count=count, rows=rows),
        ]
        below = on.rows_below()
        if below is not None:
            before, after = on.text("rows.below", rows="#").split("#")
            words = joined(words, formula('IF(below>0,said,"")', below=below, said=joined(before, below, after)))
            # a rule reads the cells of its sheet alone
            beyond = formula("ISNUMBER(SEARCH(after,words))", after=after, words=on.words(self.key))
            levels.insert(1, Level("look", beyond))
        torn = on.rows_torn()
        if torn is not None:
            words = formula("IF(torn>0,said,words)", torn=torn, said=on.text("rows.torn"), words=words)
            levels.insert(0, bad("said=torn", said=on.words(self.key), torn=on.text("rows.torn")))
        return Line(on.text("rows"), counted, words, of_rows, itself=("words",), levels=levels)

    def in_title(self, on: Reading) -> InTitle:
        return InTitle(here=closes_in(on.plan, on.value(self.key), on.of_rows))

    def left(self, on: Reading) -> Node | str:
        return formula('words&"; "', words=on.words(self.key))

    def overrules(self, on: Reading, title: Node) -> Node:
        nowhere = why_nowhere(on.plan, on.meaning)
        if on.plan.found.newton:
            nowhere = formula("IF(ends>0,ended,nowhere)", ends=assemblies_lost(on.plan), ended=on.text("line.ended"),
                              nowhere=nowhere)  # fmt: skip
        title = formula("IF(count=0,nowhere,title)", count=on.value(self.key), nowhere=nowhere, title=title)
        if on.rows_torn() is None:
            return title
        return formula("IF(said=torn,said,title)", said=on.words(self.key), torn=on.text("rows.torn"), title=title)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        return {self.key: Expected([float(motion.search.count)])}


class LargestGap(Finding):
    """The largest gap of a joint."""

    key, placed = "largest_gap", True

    def line(self, on: Reading) -> Line:
        plan, gap = on.plan, on.value(self.key)
        rounding, closed = plan.checked.rounding.cell, on.text("gap.closed")
        wrong = {"open": on.text("gap.open", sheet=on.checks.title)}
        left_open: Node = formula("open", open=wrong["open"])
        for number, (link, group) in enumerate(misfits_of(plan), 1):
            wrong[f"misfit_{number}"] = misfit = on.text("gap.redundant", link=link, sheet=on.checks.title)
            left_open = formula("IF(own>rounding,misfit,other)", own=on.checks.worst("gap", group), rounding=rounding,
                                misfit=misfit, other=left_open)  # fmt: skip
        wrong["apart"] = on.text("gap.apart", notes=plan.at.titles["notes"])
        wrong["over"] = on.text("gap.typed", sheet=on.checks.title)
        words = formula(
            'IF(rows_apart>0,apart,IF(typed>0,over,IF(count=0,"",IF(gap>rounding,open,closed))))',
            rows_apart=plan.searched.rows_apart.cell, apart=wrong["apart"], over=wrong["over"],
            typed=plan.checked.typed.cell, count=on.value("rows_closed"), gap=gap, rounding=rounding, closed=closed,
            open=left_open,
        )  # fmt: skip
        said = on.words(self.key)
        some = ",".join(f"said={name}" for name in wrong)
        return Line(
            on.text("gap"), on.checks.worst("gap"), words, plan.mechanism.length_unit, SMALL,
            occurs=formula('IFERROR(place,"")', place=on.checks.worst_at("gap")),
            levels=(bad(f"OR({some})", said=said, **wrong), good("said=closed", said=said, closed=closed)),
        )  # fmt: skip

    def overrules(self, on: Reading, title: Node) -> Node:
        return formula("IF(gap=closed,title,gap)", gap=on.words(self.key), closed=on.text("gap.closed"), title=title)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        if not motion.search.count:
            return {}
        return {self.key: Expected([misfit_of(motion)[0]], GAP * motion.search.size, told=False)}


class Leaps(Finding):
    """How often a link turns far between two rows: then nobody sees what is between them."""

    key = "leaps"

    def line(self, on: Reading) -> Line:
        count = on.value(self.key)
        words = formula('IF(closed=0,"",IF(count=0,none,some))', closed=on.value("rows_closed"), count=count,
                        none=on.text("leaps.none"), some=on.text("leaps.some"))  # fmt: skip
        return Line(on.text("leaps"), self._counted(on), words, levels=(look("count>0", count=count),))

    def _counted(self, on: Reading) -> Node:
        """Of the links that follow, as their rows have it; the driver's steps are all alike."""
        followers, step = on.checks.worst("leap"), on.plan.places.step
        if step is None or on.plan.mechanism.driver.unit.kind != "angle":
            return followers
        most = LEAP if on.plan.mechanism.driver.unit.in_degrees else round(math.radians(LEAP), 4)
        far = formula("IFERROR(IF(ABS(step)>most,rows-1,0),0)", step=step.cell, most=most, rows=on.of_rows)
        return al.add(followers, far)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        if not (motion.sure or (motion.leaps and not (motion.search.holes or motion.search.doubtful))):
            return {}
        return {self.key: Expected([float(motion.leaps)], warning=True, told=False)}


def misfit_of(motion: SearchedMotion) -> tuple[float, str]:
    """By how much the length of a redundant link is off in the worst row, which is the only gap that there can be; and
    the last of those that do not fit, "" where all do."""
    search, mechanism = motion.search, motion.plan.mechanism
    worst, found = 0.0, ""
    for each in mechanism.redundant:
        slot = next(joint for joint in mechanism.joints if joint.symbol == each.symbol)
        places = number_points(each.link, search.dimensions)
        (x, y), (x_end, y_end) = places[str(slot.through)], places[slot.point]
        length = portable.hypot(x_end - x, y_end - y)
        column = search.in_rows(each.symbol)[search.row_there]
        off = float(np.max(np.abs(np.abs(column) - length)))  # of the other assembly it points the other way
        worst = max(worst, off)
        if off > GAP * search.size:
            found = link_words(each.link).of(mechanism.language)
    return worst, found


def closes_in_some(plan: Plan, count: Node, rows: Node) -> Node:
    """In how many of how many positions, where these are not all."""
    end = plan.text("verdict.line.positions")
    return joined(plan.text("verdict.line.closes"), " ", count, " / ", rows, end)


def closes_in(plan: Plan, count: Node, rows: Node) -> Node:
    """In how many of how many positions; of all what `closes_in_all` says, of the rows that there are."""
    text = plan.text
    begin, end = (
        text("verdict.line.closes") + " ",
        text("verdict.line.positions").rstrip(),
    )  # no empty text is a translation
    before, after = text("verdict.line.all", rows="#").split("#")
    common = begin if before.startswith(begin) and plan.rows > 1 else ""  # both begin so: it is said once
    some, everywhere = joined(begin.removeprefix(common), count, " / ", rows), joined(before.removeprefix(common), rows)
    if plan.rows == 1:
        everywhere = formula("IF(rows=1,one,many)", rows=rows, one=closes_in_all(plan), many=joined(everywhere, after))
        after = ""
    if after != end:  # else it is said once
        everywhere, some, end = joined(everywhere, after), joined(some, end), ""
    return joined(
        common, formula("IF(count=rows,everywhere,some)", count=count, rows=rows, everywhere=everywhere, some=some), end
    )


def closes_in_all(plan: Plan, rows: int = 0) -> str:
    """What the line says first of a mechanism that closes in all positions, of so many rows, or as were built."""
    count = rows or plan.rows
    return plan.text("verdict.line.one") if count == 1 else plan.text("verdict.line.all", rows=count)


class SameAssembly(Finding):
    """Whether each row is of the same assembly."""

    key = "same_assembly"

    def line(self, on: Reading) -> Line:
        count, said = on.value(self.key), on.words(self.key)
        kept, lost, begun = (on.text(f"{self.key}.{word}") for word in ("kept", "lost", "begun"))
        words = formula('IF(closed=0,"",IF(count>0,lost,IF(ends>0,begun,kept)))', closed=on.value("rows_closed"),
                        count=count, kept=kept, lost=lost, begun=begun, ends=assemblies_lost(on.plan))  # fmt: skip
        return Line(
            on.text(self.key), on.checks.worst("assembly"), words,
            levels=(
                bad("count>0", count=count), look("said=begun", said=said, begun=begun),
                good("said=kept", said=said, kept=kept),
            ),
        )  # fmt: skip

    def overrules(self, on: Reading, title: Node) -> Node:
        return formula(
            "IF(lost=kept,title,lost)", lost=on.words(self.key), kept=on.text(f"{self.key}.kept"), title=title
        )


class LargestResidual(Finding):
    """How well the links meet."""

    key = "largest_residual"

    def line(self, on: Reading) -> Line:
        words = on.where_it_closes(on.text("residual.fine"))
        return Line(on.text("residual"), on.checks.worst("residual"), words, style=SMALL)


class PassesNeeded(Finding):
    """How many passes that took."""

    key = "passes_needed"

    def line(self, on: Reading) -> Line:
        count = on.value(self.key)
        most = max(group.system.passes for group in on.plan.equations.groups if group.system is not None)
        words = formula("IF(count>most,many,fine)", count=count, most=most, many=on.text(f"{self.key}.many", passes=most),
                        fine=on.text(f"{self.key}.fine", passes=most))  # fmt: skip
        return Line(on.text(self.key), on.checks.worst("needed"), on.where_it_closes(words),
                    levels=(look("count>most", count=count, most=most),))  # fmt: skip


class LeastDeterminant(Finding):
    """The least |det|, which is 0 where assemblies meet."""

    key, placed = "least_det", True

    def line(self, on: Reading) -> Line:
        return Line(
            on.text(self.key), on.checks.worst("det"), on.where_it_closes(on.text(f"{self.key}.words")),
            style=styles.numbered(styles.RESULT, styles.DETERMINANT),
            occurs=formula('IFERROR(place,"")', place=on.checks.worst_at("det")),
        )  # fmt: skip
