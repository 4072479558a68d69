"""Which of the other sheets a person has deleted, and what can be said without them."""

from __future__ import annotations

from collections.abc import Sequence

from livesheet.formula.nodes import CellRef, Node, RangeRef
from mechsheet.sheet.deleted import FIRST_OF_ALL, are_there
from mechsheet.sheet.findings.finding import Finding, Line, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.quoted import formula, joined


class OtherSheets(Finding):
    """How many of the sheets that the first one reads were deleted; while some are, the line under the title says what the
    `others` say without them."""

    key = "sheets"

    def __init__(self, others: Sequence[Finding]) -> None:
        self.others = others

    def line(self, on: Reading) -> Line:
        plan, count = on.plan, on.value(self.key)
        cells = [CellRef(spot.row, spot.col, True, True) for spot in plan.places.sheets.values()]
        gone = joined(*(
            formula('IF(there,"",gone)', there=cell, gone=f"; {on.text('sheets.deleted', sheet=plan.at.titles[key])}")
            for cell, key in zip(cells, plan.places.sheets, strict=True)
        ))  # fmt: skip
        words = formula("IF(count=0,all,MID(gone,3,999))", count=count, all=on.text("sheets.all"), gone=gone)
        marks = formula("COUNTIF(marks,0)", marks=RangeRef(cells[0], cells[-1]))
        return Line(on.text("sheets"), marks, words, levels=(look("count>0", count=count),), itself=("value", "words"))

    def overrules(self, on: Reading, title: Node) -> Node:
        count, words = on.value(self.key), on.words(self.key)
        left = joined(*(finding.left(on) for finding in self.others))
        present = are_there(on.plan, FIRST_OF_ALL)
        if present is not None:
            left = formula('IF(present,left,"")', present=present, left=left)
        return formula("IF(count>0,left&words,title)", count=count, left=left, words=words, title=title)
