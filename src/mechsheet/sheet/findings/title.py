"""The line under the title, which says all in one: whether it closes, what it is, how well it transmits force; or what is
wrong, and where."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from livesheet.formula.nodes import Call, Node
from mechsheet.sheet.deleted import FIRST_OF_ALL, are_there
from mechsheet.sheet.findings.finding import Finding, Level, Line, good
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.quoted import formula, joined


def title_words(on: Reading, findings: Sequence[Finding]) -> Node:
    """What each finding adds, in order; what the first of them overrules it by comes before all else."""
    parts = [finding.in_title(on) for finding in findings]
    first, last = [part.first for part in parts], [part.last for part in parts]
    title = joined(*first, joined(*(part.here for part in parts)), *last)
    for finding in reversed(findings):
        title = finding.overrules(on, title)
    return title


def left_words(on: Reading, findings: Iterable[Finding]) -> Node:
    """What can be said where other sheets were deleted, and which these are."""
    said, present = joined(*(finding.left(on) for finding in findings)), are_there(on.plan, FIRST_OF_ALL)
    if present is not None:
        said = formula('IF(present,said,"")', present=present, said=said)
    return formula('IF(count=0,"",said&words)', count=on.value("sheets"), said=said, words=on.words("sheets"))


def title_levels(on: Reading, lines: Iterable[Line]) -> list[Level]:
    """It is as bad as the worst line that decides it, and good where every row closes and no line says otherwise."""
    levels = [level for line in lines for level in line.levels if level.decides]

    def some(kind: str) -> Node:
        tests = (formula("IFERROR(test,FALSE)", test=level.test) for level in levels if level.kind == kind)
        return Call("OR", tuple(tests))

    everywhere = good("count=rows", count=on.value("rows_closed"), rows=on.of_rows)
    return [Level("bad", some("bad")), Level("look", some("look")), everywhere]
