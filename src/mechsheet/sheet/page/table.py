"""The table of a page: a heading, the formula as mathematics, one row for each driver value; made to be filled down."""

from __future__ import annotations

import math

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Number, Symbol, Text, transform, walk
from livesheet.workbook import Area, Comment, Conditional, Fill, plain_text
from mechsheet.kinematics.equations import Group
from mechsheet.sheet import styles
from mechsheet.sheet.as_typed import degrees_together
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.driving import rows_before
from mechsheet.sheet.page.plan import STATUS_GROUP, PagePlan
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import TableColumn
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.sheet.table.positions import (
    cell_formula,
    given_in_row,
    group_headings,
    group_title,
    heading,
    listed_values,
    mathematics,
    style_of,
)
from mechsheet.sheet.table.status import first_open, links_of, undetermined, while_inputs_can_be

NARROWEST, WIDEST = 9.0, 26.0
"""Widths of columns in characters."""

STATUS_WIDTH = 13.0
NOTE_COLUMNS = 13
CHARACTERS, LINE, MOST_LINES, LEFT_FREE = 1.28, 15.0, 3, 0.3
"""Slanted characters in a character's width, the height of such a line [pixels], the lines before a column widens, and what
they leave free where they are broken [lines]."""


class Table(Cells):
    """Collects the cells of the table."""

    def __init__(self, plan: PagePlan) -> None:
        super().__init__(plan, plan.main)
        self.plan: PagePlan = plan
        self.mathematics = {column.col: mathematics(plan, column) for column in plan.columns}
        self.widths = [self._width(column) for column in plan.columns]
        self._note()
        if plan.grouped:
            cells, merges = group_headings(plan.columns, plan.symbol_row - 1, self._group_title)
            self.cells += cells
            self.merges += merges
        for column in plan.columns:
            self._column(column)

    # --- over the table ---------------------------------------------------------------------------------------

    def _note(self) -> None:
        """How exact the angles are."""
        plan = self.plan
        parts = [part for each in plan.equations.columns for part in walk(each.expression)]
        used = {part.name for part in parts if isinstance(part, Call)}
        key = "page.note" if "ACOS" in used else "page.note.legs" if "ASIN" in used else "page.note.plain"
        left_out = any(request.of_summary for request in plan.mechanism.tables)
        note = plan.text(key) + (" " + plan.text("page.note.summaries") if left_out else "")
        self.put(plan.note_row, 0, note, styles.NOTE)
        self.merge(plan.note_row, 0, note_last(plan))

    def _group_title(self, number: int) -> str:
        plan = self.plan
        if number <= 0:
            return group_title(plan, number) if number != STATUS_GROUP else ""
        group = plan.equations.groups[number - 1]
        return plan.text("page.group", number=number, links=links_of(plan, group))

    def _width(self, column: TableColumn) -> float:
        if column.kind == "status":
            return STATUS_WIDTH
        length = len(plain_text(self.mathematics[column.col]))
        wanted = length / (CHARACTERS * (MOST_LINES - LEFT_FREE))
        return max(NARROWEST, min(WIDEST, math.ceil(10 * wanted) / 10))

    @property
    def formula_height(self) -> float:
        """Height of the row of formulas [pixels]."""
        lines = [
            math.ceil(LEFT_FREE + len(plain_text(self.mathematics[col])) / (CHARACTERS * width))
            for col, width in enumerate(self.widths)
        ]
        return LINE * max(2, *lines)

    # --- columns ----------------------------------------------------------------------------------------------

    def _column(self, column: TableColumn) -> None:
        plan = self.plan
        title = heading(plan, column) if column.kind != "status" else None
        self.put(plan.symbol_row, column.col, title, styles.HEAD)
        self.put(plan.symbol_row + 1, column.col, self.mathematics[column.col] or None, styles.FORMULA_TEXT)
        if column.equation is not None:
            self.comments.append(Comment(plan.symbol_row, column.col, column.equation.label.of(plan.language)))
        if column.symbol in plan.mechanism.listed:
            cells, fills = listed_values(plan, column, plan.main)
            self.cells += cells
            self.fills += fills
            return
        first = plan.at.first
        self.fills.append(Fill(first, column.col, self._formula(column), style_of(plan, column), rows=plan.rows))

    def _formula(self, column: TableColumn) -> Node:
        """What the cells of a column hold."""
        plan, equation, first = self.plan, column.equation, self.plan.at.first
        if equation is None:
            node = status(plan) if column.kind == "status" else given_in_row(plan, column, rows_before(plan))
            if column.kind == "time" or (column.kind == "driver" and plan.mechanism.driver.law is None):
                node = while_inputs_can_be(plan, node)
            return transform(plan.at.bind(node, plan.main, first), degrees_together)
        value = cell_formula(plan, plan.at, column, equation.expression, plan.main, first)
        if equation.first is None:
            return value
        # anew under the heading, and after a row without a value; an error where the row above was deleted
        turn: Node = Number(360.0) if plan.at.spots[column.symbol].degrees else al.mul(al.TWO, al.PI)
        return formula(
            "value+turn*IFERROR(ROUND((above-value)/turn,0),0/ISREF(above))",
            value=value, turn=turn, above=CellRef(first - 1, column.col),
        )  # fmt: skip

    # --- colours ----------------------------------------------------------------------------------------------

    def colours(self) -> list[Conditional]:
        """The row that is drawn stands out; rows without a position are grey."""
        plan, first = self.plan, self.plan.at.first
        area = Area(first, 0, plan.last_looked_at, plan.status_column)
        said = CellRef(first, plan.status_column, col_abs=True)
        found = [Conditional(area, formula('said<>""', said=said), styles.MISSING)]
        if plan.drawn:
            top = CellRef(first, 0, True, True)
            position = there(plan.places.position).cell
            shown = plan.at.bind(formula("ROW()-ROW(top)=position", top=top, position=position), plan.main)
            found.insert(0, Conditional(area, shown, styles.CURRENT))
        return found


def note_last(plan: PagePlan) -> int:
    """The last of the columns over which the note stands: no more than a screen shows."""
    return min(plan.status_column, NOTE_COLUMNS - 1)


def status(plan: PagePlan) -> Node:
    """Nothing where every group closes, else the first that does not, or is undetermined."""
    groups = [group for group in plan.equations.groups if plan.page.closes[group.number]]
    values = [Symbol(f"{SHOWN}{plan.page.closes[group.number]}") for group in groups]
    closing = [formula("ISNUMBER(value)", value=value) for value in values]
    if not closing:
        return formula('IF(wrong>0,words,"")', wrong=plan.places.inputs.cell, words=plan.text("status.inputs"))
    free = [_undetermined(plan, group) for group in groups]
    keys = ["undetermined" if group.only_undetermined else "open" for group in groups]
    if len(closing) == 1:
        said, loose = (plan.text(f"page.{key}", links=links_of(plan, groups[0])) for key in (keys[0], "undetermined"))
        words: Node = Text(said)
        if free[0] is not None:
            words = formula("IF(free,loose,said)", free=free[0], loose=loose, said=said)
        return formula('IF(closes,"",words)', closes=closing[0], words=words)
    numbers = [group.number for group in groups]
    if "undetermined" in keys or any(each is not None for each in free):
        tests, texts = list[Node](), list[str]()
        for closes, turns, key, number in zip(closing, free, keys, numbers, strict=True):
            if turns is not None:  # after a group that is open nothing is known of it
                tests.append(formula("IFERROR(NOT(free),TRUE)", free=turns))
                texts.append(f"{plan.text('page.undetermined.group')}{number}")
            tests.append(closes)
            texts.append(f"{plan.text(f'page.{key}.group')}{number}")
        return Call("CHOOSE", (first_open(tests), *map(Text, texts), Text("")))
    first: Node = first_open(closing)
    if numbers != list(range(1, len(numbers) + 1)):
        first = Call("CHOOSE", (first, *(Number(float(number)) for number in numbers)))
    return formula(
        'IF(counted=count,"",words&first)',
        counted=Call("COUNT", tuple(values)), count=float(len(values)), words=plan.text("page.open.group"), first=first,
    )  # fmt: skip


def _undetermined(plan: PagePlan, group: Group) -> Node | None:
    """As `undetermined`, over what has cells."""
    free = undetermined(plan, group)

    def seen(node: Node) -> Node:
        if isinstance(node, Symbol) and node.name in plan.page.plain:
            return transform(plan.page.plain[node.name], seen)
        return node

    return None if free is None else transform(free, seen)
