"""Rows without velocities, and whether velocities and accelerations are the same both ways round each group."""

from __future__ import annotations

from typing import Literal

from livesheet.formula.nodes import Node
from mechsheet.sheet.checks.efforts import AGREES
from mechsheet.sheet.findings.closing import SMALL
from mechsheet.sheet.findings.finding import Finding, Line, bad, good, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import formula


class DeadCentres(Finding):
    """In how many rows that close there are no velocities."""

    key = "dead_centres"

    def line(self, on: Reading) -> Line:
        count, closed = on.value(self.key), on.value("rows_closed")
        said, ok = there(on.plan.places.rates).whole(), on.plan.text("status.ok")
        some = on.text("dead_centres.some", rates=on.plan.at.titles["rates"])
        words = formula("IF(count=0,none,some)", count=count, none=on.text("dead_centres.none"), some=some)
        return Line(
            on.text(self.key), formula("closed-COUNTIF(said,ok)", closed=closed, said=said, ok=ok),
            on.where_it_closes(words), on.of_rows, levels=(look("count>0", count=count),),
        )  # fmt: skip


class Agrees(Finding):
    """How far two ways to the same numbers are apart.

    of     whose worst value the sheet of checks has;  words: where its words are
    """

    def __init__(self, key: str, of: Literal["velocity", "acceleration", "torque"], words: str) -> None:
        self.key, self.of, self.said = key, of, words
        self.needs = ("forces",) if of == "torque" else ("rates",)

    def line(self, on: Reading) -> Line:
        effort, said = self.of == "torque", on.words(self.key)
        most: Node | float = AGREES if effort else on.plan.checked.rounding.cell
        wrong, fine = on.text(f"{self.said}.not", sheet=on.checks.title), on.text(f"{self.said}.fit")
        words = formula("IF(gap>most,wrong,fine)", gap=on.value(self.key), most=most, wrong=wrong, fine=fine)
        return Line(
            on.text(self.key), on.checks.worst(self.of), on.where_it_closes(words),
            "" if effort else on.plan.mechanism.length_unit, SMALL,
            levels=(bad("said=wrong", said=said, wrong=wrong), good("said=fine", said=said, fine=fine)),
        )  # fmt: skip
