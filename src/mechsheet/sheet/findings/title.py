"""The line under the title, which says all in one: whether it closes, what it is, how well it transmits force; or what is
wrong, and where."""

from __future__ import annotations

from collections.abc import Sequence

from livesheet.formula.nodes import Node
from mechsheet.sheet.findings import task
from mechsheet.sheet.findings.finding import Finding, Level, bad, good
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.transmission import column
from mechsheet.sheet.plan import VALUE
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.transmission import some_poor


def title_words(on: Reading, findings: Sequence[Finding]) -> Node:
    """What each finding adds, in order; what the first of them overrules it by comes before all else."""
    parts = [finding.in_title(on) for finding in findings]
    first, last = [part.first for part in parts], [part.last for part in parts]
    title = joined(*first, joined(*(part.here for part in parts)), *last)
    for finding in reversed(findings):
        title = finding.overrules(on, title)
    return title


def title_colours(on: Reading, said: Node) -> list[Level]:
    """Its levels; `said`: its words."""
    plan, count, rows = on.plan, on.value("rows_closed"), on.of_rows
    # rules read this sheet only: other programs refuse another's cells
    wrong = formula("OR(n=0,said=inputs,said=gap)", said=said, gap=on.words("largest_gap"), n=count,
                    inputs=on.words("inputs"))  # fmt: skip
    if plan.found.task is not None:
        wrong = formula("OR(bad,wrong>0)", bad=wrong, wrong=on.value("task"))
    lost = on.words("same_assembly") if plan.found.newton else None
    if lost is not None:
        wrong = formula("OR(bad,count=0,leapt>0)", bad=wrong, count=count, leapt=on.value("same_assembly"))
    doubts = formula("count<rows", count=count, rows=rows)
    if plan.found.limits:
        doubts = formula("OR(doubts,passes>0)", doubts=doubts, passes=on.value("passes"))
    if plan.found.transmission:
        poor = some_poor(plan.mechanism, column(on, plan.found.transmission, VALUE))
        doubts = formula("OR(doubts,poor)", doubts=doubts, poor=poor)
    if plan.found.task is not None:
        doubts = formula("OR(doubts,doubt)", doubts=doubts, doubt=task.doubtful(plan, on.words("task")))
    if plan.found.four_bars and plan.mechanism.bands is not None:
        doubts = formula("OR(doubts,ISNUMBER(FIND(reach,said)))", doubts=doubts, said=said,
                         reach=on.text("grashof.reach"))  # fmt: skip
    if lost is not None:
        doubts = formula("OR(doubts,lost=begun)", doubts=doubts, lost=lost, begun=on.text("same_assembly.begun"))
    return [bad("wrong", wrong=wrong), Level("look", doubts), good("count=rows", count=count, rows=rows)]
