"""The sheet itself."""

from __future__ import annotations

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, CellRef, Node, Text
from mechsheet.model import Dimension, Synthesis
from mechsheet.sheet import styles
from mechsheet.sheet.first.blocks import input_validation
from mechsheet.sheet.notes.mathematics import written
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.synthesis.planning import UNSOLVED
from mechsheet.sheet.synthesis.rows import (
    HINT_ROW,
    LINE_ROW,
    MEANING,
    REMARK,
    ROUNDED,
    SYMBOL,
    TITLE_ROW,
    UNIT,
    USED,
    VALUE,
    Rows,
)
from mechsheet.sheet.workbook import (
    Area,
    Cell,
    Column,
    Conditional,
    Content,
    Fill,
    Merge,
    PrintSetup,
    Sheet,
    Style,
    Validation,
)
from mechsheet.synthesis.writing import says
from mechsheet.units import Unit

ROW_HEIGHT, LINE_HEIGHT = 20.0, 34.0

SOLVED, WRONG_INPUT, NO_SOLUTION = 0, 1, 2
"""What the cell `unsolved` holds."""


def synthesis_sheet(plan: Plan) -> Sheet:
    """The sheet of a mechanism whose dimensions are found from a task."""
    task, rows = plan.mechanism.synthesis, plan.synthesis
    if task is None or rows is None:
        raise ValueError("the mechanism has no synthesis")
    page = _Page(plan, task, rows)
    page.head()
    page.task()
    page.results()
    page.solution()
    return page.sheet()


class _Page:
    """Collects the cells."""

    def __init__(self, plan: Plan, task: Synthesis, rows: Rows) -> None:
        self.plan, self.given, self.rows = plan, task, rows
        self.title = plan.at.titles["synthesis"]
        self.dimensions: dict[str, Dimension] = {dim.symbol: dim for dim in plan.mechanism.dimensions}
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.merges: list[Merge] = []
        self.validations: list[Validation] = []
        self.conditionals: list[Conditional] = []

    def sheet(self) -> Sheet:
        """What was collected."""
        widths = {SYMBOL: 13, VALUE: 14, UNIT: 7, ROUNDED: 13, USED: 13, MEANING: 40, REMARK: 46}
        return Sheet(
            self.title,
            tuple(self.cells),
            tuple(self.fills),
            columns=tuple(Column(col, col, width) for col, width in widths.items()),
            row_heights=(
                (TITLE_ROW, 26.0),
                (LINE_ROW, LINE_HEIGHT),
                *((row, ROW_HEIGHT) for row in range(HINT_ROW, self.rows.next_row)),
            ),
            merges=tuple(self.merges),
            validations=tuple(self.validations),
            conditionals=tuple(self.conditionals),
            selected=(self.rows.heads["task"] + 1, VALUE),
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(footer=self.plan.footer),
        )

    # --- pieces

    def put(self, row: int, col: int, content: Content, style: Style) -> None:
        """A constant."""
        self.cells.append(Cell(row, col, content, style))

    def formula(self, row: int, col: int, node: Node, style: Style) -> None:
        """A formula over symbols."""
        self.fills.append(Fill(row, col, self.plan.at.bind(node, self.title), style))

    def heading(self, block: str, **columns: str) -> None:
        """The heading of a block across the columns, with what stands over single ones."""
        row = self.rows.heads[block]
        over = {VALUE: "exact", ROUNDED: "rounded", USED: "used"}
        for col in range(SYMBOL, MEANING + 1):
            content = self.plan.text(f"synthesis.{block}") if col == SYMBOL else columns.get(over.get(col, ""))
            self.put(row, col, content, styles.SECTION)

    def across(self, row: int, first: int, last: int) -> None:
        """Cells shown as one."""
        self.merges.append(Merge(Area(row, first, row, last)))

    def number_style(self, unit: Unit, style: Style) -> Style:
        """As many decimals as say something: four of a length or an angle in degrees, six of a ratio."""
        places = 4 if unit.kind == "length" or unit.in_degrees else 6
        return styles.decimals(style, places)

    # --- blocks

    def head(self) -> None:
        """Title, the line that says whether the task is solved, the hint."""
        text = self.plan.text
        self.put(TITLE_ROW, SYMBOL, text(f"synthesis.kind.{self.given.kind}"), styles.TITLE)
        self.put(HINT_ROW, SYMBOL, text("synthesis.hint"), styles.SUBTITLE)
        said = CellRef(self.rows.of["does", UNSOLVED], ROUNDED, True, True)
        self.formula(LINE_ROW, SYMBOL, said, styles.LINE)
        self.across(LINE_ROW, SYMBOL, MEANING)
        area = Area(LINE_ROW, SYMBOL, LINE_ROW, MEANING)
        for test, style in (("unsolved>0", styles.BAD), ("unsolved=0", styles.GOOD)):
            condition = formula(test, unsolved=self.plan.at.cell("#unsolved", self.title, None))
            self.conditionals.append(Conditional(area, condition, style))

    def _why(self) -> Node:
        """What is wrong with the task, or why it has no solution, or that it is solved."""
        why: Node = Text(self.plan.text("synthesis.nothing"))
        for symbol, _ in reversed(self.given.reasons):
            said = CellRef(self.rows.of["solution", symbol], REMARK, True, True)
            # the first step without a value says why
            why = formula("IF(ISNUMBER(step),why,said)", step=self._cell(symbol), why=why, said=said)
        return formula(
            "IF(_unsolved=wrong,input,IF(_unsolved=none,why,solved))", wrong=WRONG_INPUT, none=NO_SOLUTION,
            input=self._first_wrong(), why=why, solved=self.plan.text("synthesis.solved"),
        )  # fmt: skip

    def _first_wrong(self) -> Node:
        """`look at theta_p2: no value that it can have`."""
        before, after = self.plan.text("verdict.inputs.wrong", symbol="#").split("#")
        name: Node = Text("")
        for symbol in reversed(self.given.inputs):
            name = formula("IF(can_be,name,own)", can_be=self._can_be(symbol), name=name, own=plain(symbol))
        return joined(before, name, after)

    def _can_be(self, symbol: str) -> Node:
        cell = self.plan.at.cell(symbol, self.title, None)
        return formula("N(cell)>0" if symbol in self.given.positive else "ISNUMBER(cell)", cell=cell)

    def task(self) -> None:
        """The yellow cells, and whether they can be and have a solution."""
        self.heading("task")
        for symbol in self.given.inputs:
            dim, row = self.dimensions[symbol], self.rows.of["task", symbol]
            self.put(row, SYMBOL, rich(symbol), styles.SYMBOL)
            self.put(row, VALUE, dim.shown, styles.INPUT)
            self.put(row, UNIT, dim.unit.text, styles.UNIT)
            self._words(row, ROUNDED, MEANING, dim.label.of(self.plan.language) if dim.label else "")
            area = Area(row, VALUE, row, VALUE)
            self.validations.append(input_validation(self.plan, area, symbol))
            wrong = formula("NOT(can_be)", can_be=self._can_be(symbol))
            self.conditionals.append(Conditional(area, self.plan.at.bind(wrong, self.title), styles.BAD))
        can_be = al.all_of([self._can_be(symbol) for symbol in self.given.inputs])
        solved = al.all_of([formula("ISNUMBER(step)", step=self._cell(symbol)) for symbol in self._ends()])
        state = formula("IF(can_be,IF(solved,yes,none),wrong)", can_be=can_be, solved=solved, yes=SOLVED,
                        none=NO_SOLUTION, wrong=WRONG_INPUT)  # fmt: skip
        self.heading("does")
        row = self.rows.of["does", UNSOLVED]
        self.put(row, SYMBOL, self.plan.text("synthesis.does.unsolved"), styles.SYMBOL)
        self.formula(row, VALUE, state, styles.decimals(styles.RESULT, 0))
        self.put(row, UNIT, "", styles.UNIT)
        self._said(row, self._why())

    def _said(self, row: int, words: Node) -> None:
        """The words of a verdict, across."""
        self.formula(row, ROUNDED, words, styles.VERDICT)
        for col in range(ROUNDED + 1, MEANING + 1):
            self.put(row, col, None, styles.VERDICT)
        self.across(row, ROUNDED, MEANING)

    def _ends(self) -> tuple[str, ...]:
        """The steps that the mechanism's dimensions are; all results where it takes none."""
        names = tuple(self.given.taken.values()) or tuple(self.given.results)
        return tuple(dict.fromkeys(self.given.results[name] for name in names))

    def _cell(self, symbol: str) -> Node:
        return self.plan.at.cell(symbol, self.title, None)

    def results(self) -> None:
        """Exact, rounded, as the mechanism uses it; amber where somebody has typed over the mechanism's dimension."""
        text = self.plan.text
        self.heading(
            "result", exact=text("synthesis.exact"), rounded=text("synthesis.rounded"), used=text("synthesis.used")
        )
        used = {name: symbol for symbol, name in self.given.taken.items()}
        for name, symbol in self.given.results.items():
            row, dim = self.rows.of["result", name], self.dimensions[symbol]
            style = self.number_style(dim.unit, styles.RESULT)
            self.put(row, SYMBOL, rich(name), styles.SYMBOL)
            self.formula(row, VALUE, self._cell(symbol), style)
            self.put(row, UNIT, dim.unit.text, styles.UNIT)
            rounds = bool(self.given.rounding) and dim.unit.kind == "length"
            if rounds:
                steps = formula("round_to*ROUND(exact/round_to,0)", exact=self._cell(symbol),
                                round_to=self._cell(self.given.rounding))  # fmt: skip
                self.formula(row, ROUNDED, steps, style)
            else:
                self.put(row, ROUNDED, None, style)
            if name in used:
                self.formula(row, USED, self._cell(used[name]), style)
                here, found = CellRef(row, USED, True, True), CellRef(row, ROUNDED if rounds else VALUE, True, True)
                apart = formula("IFERROR(ABS(here-found)>0.000000001*(1+ABS(found)),FALSE)", here=here, found=found)
                self.conditionals.append(Conditional(Area(row, USED, row, USED), apart, styles.WARN))
            else:
                self.put(row, USED, None, style)
            self.put(row, MEANING, dim.label.of(self.plan.language) if dim.label else "", styles.LABEL)

    def solution(self) -> None:
        """Each step: symbol, value, the equation as a textbook has it, what it is."""
        self.heading("solution")
        reasons = dict(self.given.reasons)
        for symbol in self.given.steps:
            dim, row = self.dimensions[symbol], self.rows.of["solution", symbol]
            node = dim.value
            if isinstance(node, float):
                continue
            self.put(row, SYMBOL, rich(symbol), styles.SYMBOL)
            bound = Call("DEGREES", (node,)) if dim.unit.in_degrees else node
            self.formula(row, VALUE, bound, self.number_style(dim.unit, styles.RESULT))
            self.put(row, UNIT, dim.unit.text, styles.UNIT)
            said = says(node)
            self._words(row, ROUNDED, MEANING, written(said, self.plan.language))
            label = dim.label.of(self.plan.language) if dim.label else ""
            if symbol in reasons:
                words = formula("IF(ISNUMBER(value),label,reason)", value=CellRef(row, VALUE, True, True), label=label,
                                reason=reasons[symbol].of(self.plan.language))  # fmt: skip
                self.formula(row, REMARK, words, styles.LABEL)
            else:
                self.put(row, REMARK, label, styles.LABEL)

    def _words(self, row: int, first: int, last: int, content: Content) -> None:
        self.put(row, first, content, styles.LABEL)
        for col in range(first + 1, last + 1):
            self.put(row, col, None, styles.LABEL)
        self.across(row, first, last)
