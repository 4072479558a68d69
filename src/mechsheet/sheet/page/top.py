"""The top of a page: title, the verdict line, dimensions, start and step, modes, and what can be said of the rows below."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, Text, transform
from livesheet.workbook import Area, Comment, Content, Fill, Style
from mechsheet.kinematics.whole_turns import LEAST_OF_TURN
from mechsheet.model import WAYS, Dimension, Summary
from mechsheet.sheet import styles
from mechsheet.sheet.as_typed import degrees_together, in_degrees
from mechsheet.sheet.cells import Cells, height_of, label_lines, longest_said
from mechsheet.sheet.findings.finding import Finding, Line
from mechsheet.sheet.findings.inputs import marks_of
from mechsheet.sheet.findings.listing import title_words, words_where_well
from mechsheet.sheet.first.blocks import (
    output_words,
    over_summaries,
    quantity_style,
    summary_words,
    value_style,
    where_it_closes,
    write_legend,
)
from mechsheet.sheet.first.verdicts import write_title_line, write_value
from mechsheet.sheet.over_rows import (
    LEAST,
    MOST,
    NUMBERS,
    at_end,
    may_leave_out,
    mean_of_motion,
    stretches_of,
    with_torn,
)
from mechsheet.sheet.page.plan import ROW_HEIGHT, PagePlan
from mechsheet.sheet.page.reading import MEANING, PageReading
from mechsheet.sheet.plan import SYMBOL, UNIT, VALUE, VERDICT_ROW
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.shown import input_validation, label_of, rich, unit_of_column
from mechsheet.units import LENGTH, Unit, turn
from mechsheet.words.equations import given_words
from mechsheet.words.symbols import plain

LAST = 5
"""The last column of the top: the meaning has three of the table's columns."""

SMALLER = 0.98
"""So much smaller what a formula says may be printed where it then takes one line: of 10 points at 67 % stay 6.5."""

SOURCE = replace(styles.SUBTITLE, name="", valign="center", indent=1)


class Top(Cells):
    """Collects the cells of the top; the table, the drawing and the charts have their own.

    room     pixels of the columns that say what a line is
    heights  of rows in which that takes several lines
    longest_line  the longest text of the line under the title where all is well
    """

    def __init__(self, plan: PagePlan, room: int) -> None:
        super().__init__(plan, plan.main)
        self.plan: PagePlan = plan
        self.room = room
        self.on = PageReading(plan)
        self._title()
        self._dimensions()
        self._sweep()
        self._modes()
        self._position()
        self._derived()
        self._findings()
        for row, marked in marks_of(plan).items():
            self.formula(row, plan.marks, marked, styles.MARK)
        self._summaries()

    # --- small things -----------------------------------------------------------------------------------------

    def line(self, row: int, symbol: Content, unit: str | None, meaning: str | Node) -> None:
        """All of a line but its value (and its unit, when that is a formula: None)."""
        self.put(row, SYMBOL, symbol, styles.SYMBOL)
        if unit is not None:
            self.put(row, UNIT, unit, styles.UNIT)
        if isinstance(meaning, str):
            lines = label_lines(meaning, self.room)
            self.put(row, MEANING, meaning, styles.LABEL if lines == 1 else styles.LABEL_LINES)
        else:
            lines = label_lines(longest_said(meaning), self.room / SMALLER)
            self.formula(row, MEANING, meaning, styles.LABEL_SAID if lines == 1 else styles.LABEL_LINES)
        if lines > 1:
            self.heights[row] = height_of(lines, ROW_HEIGHT)
        for col in range(MEANING + 1, LAST + 1):
            self.put(row, col, None, styles.LABEL)
        self.merge(row, MEANING, LAST)

    def cell(self, key: str) -> Node:
        """A cell on top by its key."""
        return self.plan.at.cell(key, self.plan.main, None)

    # --- inputs -----------------------------------------------------------------------------------------------

    def _title(self) -> None:
        plan = self.plan
        self.put(0, 0, plan.mechanism.title.of(plan.language), styles.TITLE)
        write_legend(self)
        source = plan.mechanism.source.of(plan.language)
        if source:
            self.put(VERDICT_ROW, LAST + 1, plan.text("source", source=source), SOURCE)

    def _dimensions(self) -> None:
        plan = self.plan
        for dim in plan.mechanism.dimensions:
            if dim.derived:
                continue
            row = plan.blocks["dimensions"].rows[dim.symbol]
            label = self._label(dim)
            if dim.tolerance:
                label = f"{label} (±{dim.tolerance:g})".strip()
            self.line(row, rich(dim.symbol), dim.unit.text, label)
            if isinstance(dim.value, float):
                shown = dim.shown if dim.shown is not None else dim.unit.written(dim.value)
                self.put(row, VALUE, shown, styles.INPUT)
            self.validations.append(input_validation(plan, Area(row, VALUE, row, VALUE), dim.symbol))

    def _label(self, dim: Dimension) -> str:
        return label_of(self.plan, dim) or given_words(self.plan.mechanism, self.plan.language, dim)

    def _sweep(self) -> None:
        plan, driver = self.plan, self.plan.mechanism.driver
        if "sweep" not in plan.blocks:
            return
        rows, degrees = plan.blocks["sweep"].rows, driver.unit.in_degrees
        meanings = {"start": plan.text("page.start", driver=plain(driver.symbol)), "step": plan.text("page.step.words")}
        for key, quantity in (("start", driver.start), ("step", driver.step)):
            self.line(rows[key], plan.text(f"name.{key}"), driver.unit.text, meanings[key])
            if isinstance(quantity, float):
                self.put(rows[key], VALUE, driver.unit.written(quantity), styles.INPUT)
            else:
                self._result(rows[key], quantity, degrees, styles.RESULT)

    def _modes(self) -> None:
        plan = self.plan
        for group in plan.equations.groups:
            if group.mode:
                row = plan.blocks["assembly"].rows[group.mode]
                plus, minus = (words.of(plan.language) for words in group.assemblies)
                self.line(row, rich(group.mode), "", formula("IF(mode>0,plus,minus)", mode=self.cell(group.mode),
                                                             plus=plus, minus=minus))  # fmt: skip
                self.put(row, VALUE, float(group.mode_value), styles.INPUT)
                title, message = plan.text("hint.mode.title"), plan.text("hint.mode")
                self.takes(row, VALUE, "list", title, message, choices=("1", "-1"))

    def _position(self) -> None:
        plan = self.plan
        for row in plan.blocks["position"].rows.values() if plan.drawn else ():
            self.line(row, plan.text("name.position"), "", plan.text("page.position"))
            self.put(row, VALUE, float(plan.first_shown), styles.INPUT)
            title, message = plan.text("hint.position.title"), plan.text("hint.position", last=plan.rows - 1)
            last = Number(plan.rows - 1.0)
            self.takes(row, VALUE, "whole", title, message, low=Number(0.0), high=last, stop=False)

    # --- results ----------------------------------------------------------------------------------------------

    def _result(self, row: int, expression: Node, degrees: bool, style: Style) -> None:
        bound = transform(self.plan.at.bind(expression, self.plan.main), degrees_together)
        self.fills.append(Fill(row, VALUE, in_degrees(bound) if degrees else bound, style))

    def _derived(self) -> None:
        plan = self.plan
        rows = plan.blocks["derived"].rows
        for dim in plan.mechanism.dimensions:
            if not isinstance(dim.value, float):
                self.line(rows[dim.symbol], rich(dim.symbol), dim.unit.text, self._label(dim) or dim.written)
                self._result(rows[dim.symbol], dim.value, dim.unit.in_degrees, quantity_style(plan, dim.unit))
        for key, tree in plan.lengths.items():
            words = plan.text("page.length", name=key)
            row = plan.places.lengths[key].row
            self.line(row, key, plan.mechanism.length_unit, words)
            self._result(row, tree, False, value_style(plan, LENGTH))
        for equation in plan.equations.constants:
            row = rows[equation.symbol]
            self.line(
                row, rich(equation.symbol), plan.mechanism.shown(equation.unit).text, equation.label.of(plan.language)
            )
            small = equation.symbol == plan.equations.tolerance
            style = styles.numbered(styles.RESULT, "0.0E+00") if small else value_style(plan, equation.unit)
            self._result(row, equation.expression, plan.at.spots[equation.symbol].degrees, style)

    def _findings(self) -> None:
        """What can be said of the rows below, and the line under the title."""
        plan, on = self.plan, self.on
        lines = {finding: finding.line(on) for finding in plan.findings}
        for finding, line in lines.items():
            row = on.rows[finding.key]
            words = line.words.value if isinstance(line.words, Text) else line.words
            self.line(row, line.symbol, line.unit if isinstance(line.unit, str) else None, words)
            write_value(self, row, line, Area(row, MEANING, row, LAST))
            if line.occurs is not None and finding.key_at in on.rows:
                below, driver = on.rows[finding.key_at], plan.mechanism.driver
                self.line(below, rich(driver.symbol), driver.unit.text, plan.text("page.occurs"))
                self.formula(below, VALUE, line.occurs, styles.decimals(styles.RESULT, on.driver_decimals()))
            if line.note:
                self.comments.append(Comment(row, SYMBOL, line.note))
            if line.beside is not None:
                below = on.rows[finding.key_beside(plan)]
                self.line(below, line.beside.symbol, plan.mechanism.length_unit, line.beside.words)
                self.formula(below, VALUE, line.beside.value, replace(styles.RESULT, name=""))
        # right of the charts: there it is not printed, and takes no row
        self.formula(VERDICT_ROW, plan.marks, words_where_well(on, plan.findings), styles.LABEL)
        well = CellRef(VERDICT_ROW, plan.marks, True, True)
        write_title_line(self, on, title_words(on, plan.findings, well), lines.values(), LAST)
        self.longest_line = self._longest_line(lines)

    def _longest_line(self, lines: Mapping[Finding, Line]) -> str:
        """The longest text of the line under the title where all is well, and nothing is to be mended."""
        words = {self.on.words(finding.key): line.words for finding, line in lines.items()}
        counts = {self.on.of_rows, self.on.value("rows_closed")}
        mended = {self.on.beside(finding.key, Text("")) for finding, line in lines.items() if line.beside is not None}

        def change(part: Node) -> Node:
            match part:
                case Call("IF", (Binary("=", CellRef() as bound, Text("")), nothing, _)) if bound in mended:
                    return nothing
                case CellRef() if part in words:
                    return transform(words[part], change)
                case CellRef() if part in counts:
                    return Text(str(self.plan.rows))
            return part

        said = [finding.in_title(self.on) for finding in lines]
        return longest_said(transform(joined(*(each for title in said for each in (title.first, title.here))), change))

    def _summaries(self) -> None:
        plan = self.plan
        for summary in plan.mechanism.summaries:
            unit = unit_of_column(plan, summary.of)
            one = plan.equations.equations.range_has_gaps(summary.of, summary.take)
            key = "page.take.stretch" if one else "page.take.rows"
            words: str | Node = plan.text(key, label=summary_words(plan, summary))
            if "mean" in summary.take.parts and plan.at.spots[summary.of].column:
                words = with_torn(plan, words, self.on.column(summary.take.column(summary.of)))
            self._summary(summary.symbol, unit, words, self._taken(summary))
        for output in plan.mechanism.motion_outputs:
            unit = plan.mechanism.shown(output.unit)
            words = plan.text("page.take.rows", label=output_words(plan, output))
            self._summary(output.symbol, unit, words, over_summaries(plan, output))

    def _summary(self, symbol: str, unit: Unit, words: str | Node, value: Node) -> None:
        """A line with one number of all rows; none where no row closes."""
        plan = self.plan
        row = plan.blocks["summary"].rows[symbol]
        self.line(row, rich(symbol), unit.text, words)
        self.formula(row, VALUE, where_it_closes(plan, value), value_style(plan, unit))

    def _taken(self, summary: Summary) -> Node:
        """Over the rows in which the quantity has a value."""
        if not self.plan.at.spots[summary.of].column:
            return summary.take.of_constant(self.cell(summary.of))

        def part(name: str) -> Node:
            if name in WAYS:
                return self.on.over_rows(summary.of, LEAST if name == "least" else MOST)
            if name == "mean":
                return self._mean(summary.take.column(summary.of))
            return at_end(name, self.on.column(summary.of), *self.on.closing(summary.of))

        value = summary.take.over(part)
        if not self.plan.equations.equations.range_has_gaps(summary.of, summary.take):
            return value
        stretches = stretches_of(self.on.column(summary.of), self.on.closing(summary.of))
        return formula("IF(stretches>1,NA(),value)", stretches=stretches, value=value)

    def _mean(self, symbol: str) -> Node:
        """The mean over the motion; of a turn without the row that closes it, all rows count alike."""
        plan = self.plan
        turns: Node | None = None
        if may_leave_out(plan) and plan.places.step is not None:
            step = CellRef(plan.places.step.row, plan.places.step.col, True, True)
            turns = formula(
                "AND(n=rows,n>=least,ABS(ROUND(step*rows/turn,0)*turn-step*rows)<1E-7)", n=plan.places.closed.cell,
                least=LEAST_OF_TURN, rows=plan.places.rows.cell, step=step, turn=turn(plan.mechanism.driver.unit.in_degrees),
            )  # fmt: skip
        tests = [(self.on.column(symbol), NUMBERS), *((each, "") for each in self.on.closing(symbol))]
        return mean_of_motion(plan.mechanism.driver, self.on.column(symbol), tests, turns)
