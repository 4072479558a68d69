"""The top of a page: title, the verdict line, dimensions, start and step, modes, and what can be said of the rows below."""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Boolean, Call, CellRef, Node, Number, RangeRef, Symbol, symbols, transform
from livesheet.workbook import Area, Comment, Content, Fill, Merge, Style
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.means import LEAST_OF_TURN
from mechsheet.model import WAYS, Summary, Synthesis
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.degrees import degrees_together, in_degrees
from mechsheet.sheet.findings import inputs, task
from mechsheet.sheet.findings.closing import closes_in
from mechsheet.sheet.first.blocks import value_style
from mechsheet.sheet.first.summaries import output_words, over_summaries, summary_words
from mechsheet.sheet.grashof import (
    Sides,
    bound_of,
    excess_of,
    in_summary,
    is_all,
    named,
    names_of_sides,
    turning_types,
    type_of,
    why_nowhere,
)
from mechsheet.sheet.over_rows import LEAST, MOST, NUMBERS, at_end, may_leave_out, mean_of_motion, over_rows
from mechsheet.sheet.page.plan import PagePlan, sides_of
from mechsheet.sheet.plan import LEGEND_ROW, VERDICT_ROW
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.shown import input_validation, unit_of_column
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import places_of
from mechsheet.sheet.transmission import poor_limit, some_poor, worst_words
from mechsheet.sheet.wrapping import height_of, label_lines
from mechsheet.units import ANGLE, LENGTH, Unit, turn
from mechsheet.words.given import given_words
from mechsheet.words.symbols import plain

SYMBOL, VALUE, UNIT, MEANING, LAST = 0, 1, 2, 3, 5
"""Columns of the top; the meaning has three of the table's columns."""

SOURCE = replace(styles.SUBTITLE, name="", valign="center", indent=1)


class Top(Cells):
    """Collects the cells of the top; the table, the drawing and the charts have their own.

    room     pixels of the columns that say what a line is
    heights  of rows in which that takes several lines
    """

    def __init__(self, plan: PagePlan, room: int) -> None:
        super().__init__(plan, plan.main)
        self.plan: PagePlan = plan
        self.room = room
        self._title()
        self._dimensions()
        self._sweep()
        self._modes()
        self._position()
        self._derived()
        self._verdicts()
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
            if lines > 1:
                self.heights[row] = height_of(lines)
        else:
            self.formula(row, MEANING, meaning, styles.LABEL_SAID)
        for col in range(MEANING + 1, LAST + 1):
            self.put(row, col, None, styles.LABEL)
        self.merge(row, MEANING, LAST)

    def column(self, symbol: str) -> RangeRef:
        """The cells of a column, and those below that a person may fill."""
        return self.plan.filled(self.plan.at.spots[symbol])

    def over_rows(self, symbol: str, function: str) -> Node:
        """Over a column, as people read it, in rows in which every group closes."""
        return over_rows(function, self.column(symbol), *self._closing(symbol))

    def _closing(self, symbol: str) -> list[RangeRef]:
        """Columns that have a number where groups close of which this column says nothing: what it reads does close."""
        page = self.plan.page
        by_symbol = {each.symbol: each for each in page.columns}
        read, waiting = {symbol}, [symbol]
        while waiting:
            name = waiting.pop()
            reads = by_symbol[name].reads if name in by_symbol else ()
            reads = symbols(page.plain[name]) if name in page.plain else reads
            waiting += [each for each in reads if each not in read]
            read.update(reads)
        others = dict.fromkeys(name for name in page.closes.values() if name and name not in read)
        return [self.column(name) for name in others]

    def cell(self, key: str) -> Node:
        """A cell on top by its key."""
        return self.plan.at.cell(key, self.plan.main, None)

    # --- inputs -----------------------------------------------------------------------------------------------

    def _title(self) -> None:
        plan = self.plan
        self.put(0, 0, plan.mechanism.title.of(plan.language), styles.TITLE)
        self.put(LEGEND_ROW, SYMBOL, plan.text("legend.input"), styles.numbered(styles.INPUT, "@"))
        self.put(LEGEND_ROW, VALUE, plan.text("legend.result"), styles.RESULT)
        source = plan.mechanism.source.of(plan.language)
        if source:
            self.put(VERDICT_ROW, LAST + 1, plan.text("source", source=source), SOURCE)

    def _dimensions(self) -> None:
        plan = self.plan
        for dim in plan.mechanism.dimensions:
            if dim.derived:
                continue
            row = plan.blocks["dimensions"].rows[dim.symbol]
            label = dim.label.of(plan.language) if dim.label else given_words(plan.mechanism, plan.language, dim)
            if dim.tolerance:
                label = f"{label} (±{dim.tolerance:g})".strip()
            self.line(row, rich(dim.symbol), dim.unit.text, label)
            if isinstance(dim.value, float):
                shown = dim.shown if dim.shown is not None else dim.unit.written(dim.value)
                self.put(row, VALUE, shown, styles.INPUT)
            self.validations.append(input_validation(plan, Area(row, VALUE, row, VALUE), dim.symbol))

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
            self.put(row, VALUE, float(plan.first_existing), styles.INPUT)
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
                label = (
                    dim.label.of(plan.language)
                    if dim.label
                    else given_words(plan.mechanism, plan.language, dim) or dim.written
                )
                self.line(rows[dim.symbol], rich(dim.symbol), dim.unit.text, label)
                rate = styles.decimals(styles.RESULT, places_of(plan, dim.unit))
                style = rate if dim.unit.per else value_style(plan, dim.unit)
                self._result(rows[dim.symbol], dim.value, dim.unit.in_degrees, style)
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

    def _verdicts(self) -> None:
        plan = self.plan
        rows = plan.blocks["verdicts"].rows
        filled, said = self.column(plan.mechanism.driver.symbol), plan.filled(plan.places.status)
        row = rows["rows_closed"]
        self.line(row, "n", None, plan.text("page.rows"))
        self._inputs(rows["inputs"], self._there())
        count = formula('COUNTIFS(filled,numbers,said,"")', filled=filled, numbers=NUMBERS, said=said)
        self.formula(row, VALUE, count, styles.decimals(styles.RESULT, 0))
        of_rows = f'"{plan.text("page.of")}"0'
        self.formula(row, UNIT, Call("COUNT", (filled,)), styles.numbered(styles.UNIT, of_rows))
        if plan.found.task is not None:
            self._task(rows["task"], rows["task_miss"], plan.found.task)
        for loop in plan.found.four_bars:
            self._grashof(rows[f"grashof_{loop.group}"], loop)
        for group in plan.found.transmission:
            self._transmission(rows[f"transmission_{group.number}"], group)
        self._line_under_the_title()

    def _inputs(self, row: int, there: Node) -> None:
        """The number of the first yellow cell that cannot be; it is red."""
        plan = self.plan
        self.line(row, plan.text("verdict.inputs"), "", plan.text("page.inputs"))
        self.formula(row, VALUE, inputs.first_wrong(plan), styles.decimals(styles.RESULT, 0))
        no_position = plan.at.bind(Call("NOT", (there,)), plan.main)
        self.conditionals += inputs.red_where_wrong(plan, no_position if plan.drawn else None)

    def _task(self, row: int, row_of_miss: int, asked: Synthesis) -> None:
        """Whether the dimensions that are found from a task do what it asks, and by how much they miss it."""
        plan, count = self.plan, CellRef(row, VALUE, True, True)
        self.line(
            row, plan.text("verdict.task"), "", task.said_of_miss(plan, count, CellRef(row_of_miss, VALUE, True, True))
        )
        self.line(row_of_miss, plan.text("verdict.task"), "", plan.text("verdict.task.miss"))
        miss = formula("IFERROR(most,NA())", most=task.most_missed(plan, asked))
        self.formula(row_of_miss, VALUE, miss, styles.numbered(styles.RESULT, "0.0E+00"))
        self.formula(row, VALUE, task.wrong(plan, asked), styles.decimals(styles.RESULT, 0))
        area, words = Area(row, MEANING, row, LAST), CellRef(row, MEANING, True, True)
        doubt = task.doubtful(plan, words)
        self.colour(area, formula("count>0", count=count), styles.BAD)
        self.colour(area, doubt, styles.WARN)

    def _there(self) -> Node:
        """Whether the position that is drawn is a row of the table."""
        position, rows = self.plan.places.position, self.plan.places.rows.cell
        if position is None:
            return formula("TRUE")
        return formula("AND(ISNUMBER(shown),INT(N(shown))=shown,shown>=0,shown<rows)", shown=position.cell, rows=rows)

    def _grashof(self, row: int, loop: FourBar) -> None:
        """The type of a four-bar by its shortest and longest link; words, and the excess that decides."""
        plan = self.plan
        lengths = tuple(self._length(key, tree) for key, tree in sides_of(plan, loop))
        ground, first, coupler, _ = lengths
        shortest, longest, total = (Call(name, lengths) for name in ("MIN", "MAX", "SUM"))
        excess = CellRef(row, VALUE, True, True)

        def text(word: str, **parts: object) -> str:
            return plan.text(f"verdict.grashof.{word}", **parts)

        others = [Call("MIN", (*lengths[:index], *lengths[index + 1 :])) for index in range(3)]
        which = formula(
            "IF(ground<=a,both,IF(first<=b,crank,IF(coupler<=c,rockers,follower)))",
            ground=ground, first=first, coupler=coupler, a=others[0], b=others[1], c=others[2],
            **turning_types(loop, plan.language, text),
        )  # fmt: skip
        mend: CellRef | None = None
        if is_all(loop, plan):
            mend = CellRef(plan.blocks["verdicts"].rows[f"bound_{loop.group}"], VALUE, True, True)
            self._bound(mend.row, loop, lengths, excess)
        said = type_of(shortest, excess, which, text, mend)
        words = formula('IFERROR(said,"")', said=joined(f"{named(loop, plan)}: ", said))
        self.line(row, loop.name, plan.mechanism.length_unit, words)
        self.comments.append(Comment(row, SYMBOL, plan.text("notes.use.grashof")))
        value = excess_of(plan, shortest, longest, total)
        self.formula(row, VALUE, value, value_style(plan, LENGTH))

    def _bound(self, row: int, loop: FourBar, lengths: tuple[Node, ...], excess: Node) -> None:
        """Up to which length the longest link closes, or the first turns fully."""
        plan, (ground, first, coupler, _), names = self.plan, lengths, names_of_sides(loop, self.plan)

        def longest(length: Node) -> Node:
            return formula(
                "IF(length=ground,a,IF(length=first,b,IF(length=coupler,c,d)))", length=length, ground=ground, first=first,
                coupler=coupler, **dict(zip("abcd", names, strict=True)),
            )  # fmt: skip

        sides = Sides(lengths, lengths, names, longest, places_of(plan, LENGTH))
        self.line(row, "≤", plan.mechanism.length_unit, plan.text("page.bound"))
        mend = formula('IFERROR(mend,"")', mend=bound_of(sides, Call("MIN", lengths), excess))
        self.formula(row, VALUE, mend, replace(styles.RESULT, name=""))

    def _length(self, key: str, length: Node) -> Node:
        """A length without the bars that its sign does not need; one that is no dimension has a cell."""
        match length:
            case Call("ABS", (Symbol(name),)) if name in self.plan.equations.positive:
                return length.args[0]
        lengths = self.plan.places.lengths
        return lengths[key].cell if key in lengths else length

    def _transmission(self, row: int, group: Group) -> None:
        """The least acute angle of transmission over the rows of the table, and no others."""
        plan = self.plan
        low, high = (self.over_rows(group.transmission, function) for function in (LEAST, MOST))
        half = 180.0 if plan.at.spots[group.transmission].degrees else al.PI
        if group.kind == "RRR":
            least = formula("MIN(low,half-high)", low=low, high=high, half=half)
        else:  # the rod against the guide: the angle of transmission is what is missing to a right one
            least = formula("half/2-MAX(high,-low)", low=low, high=high, half=half)
        cell, limit = CellRef(row, VALUE, True, True), poor_limit(plan.mechanism)
        unit = plan.mechanism.angle_unit
        poor = formula("AND(ISNUMBER(value),value<limit)", value=cell, limit=limit)
        drivers, angles = (self.column(symbol) for symbol in (plan.mechanism.driver.symbol, group.transmission))
        if group.kind == "RRR":  # the angle itself, or what is missing to 180 degrees
            place = formula("IFERROR(INDEX(drivers,MATCH(cell,angles,0)),INDEX(drivers,MATCH(high,angles,0)))",
                            drivers=drivers, angles=angles, cell=cell, high=high)  # fmt: skip
        else:
            place = formula("INDEX(drivers,MATCH(IF(cell=half/2-high,high,low),angles,0))", drivers=drivers,
                            angles=angles, cell=cell, half=half, high=high, low=low)  # fmt: skip
        which = f"μ{group.number} " if len(plan.found.transmission) > 1 else ""  # the line under the title says it
        words = joined(which, worst_words(plan, cell, place, poor, True), plan.text("verdict.rows.only"))
        self.line(row, f"μ{group.number}", unit.text, formula('IFERROR(words,"")', words=words))
        self.colour(Area(row, MEANING, row, LAST), poor, styles.WARN)
        value = formula("IF(n=0,NA(),IFERROR(least,NA()))", n=plan.places.closed.cell, least=least)
        self.formula(row, VALUE, value, value_style(plan, ANGLE))

    def _line_under_the_title(self) -> None:
        """Whether it closes in the rows of the table, its type, its transmission; or that an input is none."""
        plan, text = self.plan, self.plan.text
        count, rows = plan.places.closed.cell, plan.places.rows.cell
        parts: list[Node | str] = [closes_in(plan, count, rows)]
        for loop in plan.found.four_bars[:1]:
            kind = CellRef(plan.blocks["verdicts"].rows[f"grashof_{loop.group}"], MEANING, True, True)
            parts.append(in_summary(loop, plan, kind, formula("n=rows", n=count, rows=rows)))
        any_poor: Node = Boolean(False)
        if plan.found.transmission:
            lines = [plan.blocks["verdicts"].rows[f"transmission_{each.number}"] for each in plan.found.transmission]
            said, angles = (
                RangeRef(CellRef(lines[0], col, True, True), CellRef(lines[-1], col, True, True))
                for col in (MEANING, VALUE)
            )
            any_poor = some_poor(plan.mechanism, angles)
            worst = formula("INDEX(said,MATCH(MIN(angles),angles,0))", said=said, angles=angles)
            what = f"; {text('verdict.line.transmission')} "
            parts += [what, worst if len(lines) > 1 else said.start]
        wrong, there = plan.places.inputs.cell, self._there()
        closes: Node = joined(*parts)
        missed: Node = Boolean(False)
        doubts: Node = Boolean(False)
        if plan.found.task is not None:
            row = plan.blocks["verdicts"].rows["task"]
            number, met = (CellRef(row, col, True, True) for col in (VALUE, MEANING))
            closes = task.with_task(closes, number, met)
            missed = formula("number>0", number=number)
            doubts = task.doubtful(plan, met)
        good = formula("IF(n=0,nowhere,good)", n=count, good=closes, nowhere=why_nowhere(plan, MEANING))
        words = inputs.words(plan, wrong, inputs.where_it_is(plan, there, good))
        self.formula(VERDICT_ROW, SYMBOL, words, styles.LINE)
        area = Area(VERDICT_ROW, SYMBOL, VERDICT_ROW, LAST)
        self.merges.append(Merge(area))
        for test, style in (
            ("OR(wrong>0,NOT(there),n=0,missed)", styles.BAD),
            ("OR(n<rows,poor,doubts)", styles.WARN),
            ("n=rows", styles.GOOD),
        ):
            condition = formula(
                test, wrong=wrong, there=there, n=count, rows=rows, poor=any_poor, missed=missed, doubts=doubts
            )
            self.colour(area, condition, style)

    def _summaries(self) -> None:
        plan = self.plan
        for summary in plan.mechanism.summaries:
            unit = unit_of_column(plan, summary.of)
            self._summary(summary.symbol, unit, summary_words(plan, summary), self._taken(summary))
        for output in plan.mechanism.motion_outputs:
            unit = plan.mechanism.shown(output.unit)
            self._summary(output.symbol, unit, output_words(plan, output), over_summaries(plan, output))

    def _summary(self, symbol: str, unit: Unit, label: str, value: Node) -> None:
        """A line with one number of all rows; none where no row closes."""
        plan = self.plan
        row = plan.blocks["summary"].rows[symbol]
        self.line(row, rich(symbol), unit.text, plan.text("page.take.rows", label=label))
        found = formula("IF(n=0,NA(),IFERROR(value,NA()))", n=plan.places.closed.cell, value=value)
        self.formula(row, VALUE, found, value_style(plan, unit))

    def _taken(self, summary: Summary) -> Node:
        """Over the rows in which the quantity has a value."""
        if not self.plan.at.spots[summary.of].column:
            return summary.take.of_constant(self.cell(summary.of))

        def part(name: str) -> Node:
            if name in WAYS:
                return self.over_rows(summary.of, LEAST if name == "least" else MOST)
            if name == "mean":
                return self._mean(summary.take.column(summary.of))
            return at_end(name, self.column(summary.of), *self._closing(summary.of))

        return summary.take.over(part)

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
        tests = [(each, NUMBERS) for each in (self.column(symbol), *self._closing(symbol))]
        return mean_of_motion(plan.mechanism.driver, self.column(symbol), tests, turns)
