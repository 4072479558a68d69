"""How well Newton's method has found each row: of the same assembly, how well the links meet, in how many passes."""

from __future__ import annotations

from livesheet.formula.nodes import Node
from mechsheet.sheet import styles
from mechsheet.sheet.findings.closing import SMALL
from mechsheet.sheet.findings.finding import Finding, Line, bad, good, look
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.start_table import assemblies_lost


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
