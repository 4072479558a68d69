"""Whether a mechanism whose dimensions are found from a task does what is asked: a line of the first sheet, or of a page.

Its number is how many things are wrong: on sheets how many verdicts of the sheet of synthesis are red, on a page, which
has no such sheet, how many things that are asked are missed; there the largest miss has a line of its own. Its words are
those of the first red verdict, else how well what is asked is met. The line under the title says them too.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, RangeRef, Text
from mechsheet.model import Synthesis
from mechsheet.sheet import styles
from mechsheet.sheet.findings.finding import Finding, InTitle, Level, Line, bad, good
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.synthesis.page import Naming
from mechsheet.sheet.synthesis.requirement_checks import EXACT, NO
from mechsheet.sheet.synthesis.tables import apart
from mechsheet.sheet.task_rows import LINE_ROW, ROUNDED, SYMBOL, USED, Rows, verdicts_of
from mechsheet.synthesis.kinds import kind_of


class Task(Finding):
    """Whether the dimensions that are found from a task do what it asks."""

    key, by_rows = "task", True

    def __init__(self, asked: Synthesis) -> None:
        self.asked = asked

    def line(self, on: Reading) -> Line:
        plan, count, words = on.plan, on.value(self.key), on.words(self.key)
        if plan.synthesis is None:
            met = said_of_miss(plan, count, on.value(LargestMiss.key))
        else:
            met = said(plan, plan.synthesis, count)
        return Line(
            on.text(self.key), wrong(plan, self.asked), met,
            levels=(
                bad("wrong>0", wrong=count), Level("look", doubtful(plan, words)),
                good("said=exactly", said=words, exactly=exactly(plan)),
            ),
        )  # fmt: skip

    def in_title(self, on: Reading) -> InTitle:
        first, last = (
            formula(text, count=on.value(self.key), words=on.words(self.key))
            for text in ('IF(count>0,words&"; ","")', 'IF(count>0,"","; "&words)')
        )
        return InTitle(first=first, last=last)


class LargestMiss(Finding):
    """By how much what is asked is missed: on a page, which has no sheet of synthesis."""

    key, by_rows = "task_miss", True

    def __init__(self, asked: Synthesis) -> None:
        self.asked = asked

    def line(self, on: Reading) -> Line:
        miss = formula("IFERROR(most,NA())", most=most_missed(on.plan, self.asked))
        words = Text(on.text("task.miss"))
        return Line(on.text("task"), miss, words, style=styles.numbered(styles.RESULT, "0.0E+00"))


def exactly(plan: Plan) -> str:
    """What is said where nothing is missed."""
    return plan.text("synthesis.meets.exactly")


def doubtful(plan: Plan, words: Node) -> Node:
    """Whether the words say something else."""
    return formula("words<>exactly", words=words, exactly=exactly(plan))


def wrong(plan: Plan, task: Synthesis) -> Node:
    """How many things are wrong; of lengths that are rounded on a page, with the exact ones: the others are a doubt."""
    if plan.synthesis is None:
        misses = _misses(plan, task, exact=bool(task.rounding))
        return al.total(formula(f"IFERROR(IF(miss>{EXACT},1,0),1)", miss=miss) for miss in misses)
    rows = [plan.synthesis.of["does", key] for key in verdicts_of(task, bool(plan.found.four_bars))]
    title = plan.at.titles["synthesis"]
    marks = RangeRef(CellRef(rows[0], ROUNDED, True, True, title), CellRef(rows[-1], ROUNDED, True, True))
    return formula("COUNTIF(marks,mark)", marks=marks, mark=NO)


def most_missed(plan: Plan, task: Synthesis) -> Node:
    """By how much the mechanism of a page misses what is asked, at most: with the lengths that it has."""
    return al.largest(_misses(plan, task, exact=False))


def said(plan: Plan, rows: Rows, count: CellRef) -> Node:
    """The words, from the sheet of synthesis with such rows; `count` is the cell of the number."""
    title = plan.at.titles["synthesis"]
    line = CellRef(LINE_ROW, SYMBOL, True, True, title)
    meets = CellRef(rows.of["does", "meets"], USED, True, True, title)
    return formula("IF(count>0,line,met)", count=count, line=line, met=meets)


def said_of_miss(plan: Plan, count: CellRef, most: CellRef) -> Node:
    """The words of a page; `count` and `most` are the cells of the number and of the largest miss."""
    about = joined(plan.text("synthesis.meets.about"), formula("ROUND(most,4)", most=most))
    return formula(
        f"IFERROR(IF(most>{EXACT},about,exactly),IF(count>0,lost,rounded))", most=most, about=about,
        exactly=exactly(plan), count=count, lost=plan.text("synthesis.meets.not"),
        rounded=plan.text("synthesis.meets.rounded"),
    )  # fmt: skip


def _misses(plan: Plan, task: Synthesis, exact: bool) -> list[Node]:
    """How far each thing that is asked is missed, as people read it. `exact`: by the lengths before they are rounded."""
    naming, found = Naming(plan, task, exact), []
    for asked in kind_of(task).asked(task):
        got, wanted = naming.tree(asked.got_alone), naming.tree(asked.wanted)
        if asked.measure != "angle":
            found.append(formula("ABS(got-wanted)", got=got, wanted=wanted))
            continue
        off = apart(got, wanted)
        degrees = plan.mechanism.angle_unit.in_degrees
        found.append(formula("ABS(DEGREES(off))" if degrees else "ABS(off)", off=off))
    return found
