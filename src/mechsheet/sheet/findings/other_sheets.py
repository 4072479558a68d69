"""Which of the other sheets a person has deleted, and what can be said without them."""

from __future__ import annotations

from collections.abc import Iterable

from livesheet.formula.nodes import CellRef, Node, RangeRef, Text
from mechsheet.sheet.deleted import FIRST_OF_ALL, TELLS_OF_ROWS, are_there, readers_of
from mechsheet.sheet.findings.finding import Finding, Line, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import formula, joined

MOST_CHARACTERS = 999
"""More than the words of all sheets have together: what follows the first "; " is taken whole."""


class OtherSheets(Finding):
    """How many of the sheets that the first one reads were deleted; while some are, the line under the title says what is
    left without them."""

    key = "sheets"

    def line(self, on: Reading) -> Line:
        plan, count = on.plan, on.value(self.key)
        cells = [CellRef(spot.row, spot.col, True, True) for spot in plan.places.sheets.values()]
        gone = joined(*(
            formula('IF(there,"",gone)', there=cell, gone=_gone(on, key))
            for cell, key in zip(cells, plan.places.sheets, strict=True)
        ))  # fmt: skip
        words = formula("IF(count=0,all,MID(gone,3,most))", count=count, all=on.text("sheets.all"), gone=gone,
                        most=MOST_CHARACTERS)  # fmt: skip
        marks = formula("COUNTIF(marks,0)", marks=RangeRef(cells[0], cells[-1]))
        return Line(on.text("sheets"), marks, words, levels=(look("count>0", count=count),), itself=("value", "words"))

    def overrules(self, on: Reading, title: Node) -> Node:
        return formula(
            "IF(count>0,left,title)", count=on.value(self.key), left=there(on.plan.places.left).cell, title=title
        )


def _gone(on: Reading, key: str) -> Node:
    """That a sheet was deleted, and which ones have no numbers without it; or, of the one that tells it, that rows were."""
    title, readers = on.plan.at.titles[key], readers_of(on.plan, key)
    said = on.text("sheets.deleted", sheet=title)
    if readers:
        said = on.text("sheets.deleted.read", sheet=title, readers=", ".join(readers))
    if key != TELLS_OF_ROWS:
        return Text(f"; {said}")
    return formula("IF(ISREF(cell),torn,gone)", cell=CellRef(0, 0, True, True, title), gone=f"; {said}",
                   torn=f"; {on.text('sheets.torn')}")  # fmt: skip


def left_words(on: Reading, findings: Iterable[Finding]) -> Node:
    """What can be said where other sheets were deleted, and which these are."""
    said, present = joined(*(finding.left(on) for finding in findings)), are_there(on.plan, FIRST_OF_ALL)
    if present is not None:
        said = formula('IF(present,said,"")', present=present, said=said)
    return formula('IF(count=0,"",said&words)', count=on.value("sheets"), said=said, words=on.words("sheets"))
