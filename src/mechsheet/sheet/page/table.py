"""The table of a page: a heading, the formula as mathematics, one row for each driver value; made to be filled down."""

from __future__ import annotations

import math

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Number, Symbol, Text, transform, walk
from livesheet.workbook import Area, Comment, Conditional, Fill, Rich, Style, plain_text
from mechsheet.kinematics.equations import CAM, Group
from mechsheet.model import TIME
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.degrees import degrees_together, in_degrees
from mechsheet.sheet.driving import by_time, driver_after, rows_before, time_after
from mechsheet.sheet.mathematics import written
from mechsheet.sheet.page.plan import PagePlan
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import TableColumn
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.sheet.shown import shown_unit
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import (
    group_headings,
    places,
    places_of,
)
from mechsheet.sheet.table.status import first_open, links_of, undetermined, while_inputs_can_be
from mechsheet.units import SECONDS

NARROWEST, WIDEST = 10.0, 26.0
"""Widths of columns in characters."""

STATUS_WIDTH = 14.0
NOTE_COLUMNS = 12
CHARACTERS, LINE, MOST_LINES = 1.65, 12.0, 4
"""Small characters in a character's width, the height of such a line [pixels], and the lines before a column widens."""


class Table(Cells):
    """Collects the cells of the table."""

    def __init__(self, plan: PagePlan) -> None:
        super().__init__(plan, plan.main)
        self.plan: PagePlan = plan
        self.mathematics = {column.col: self._mathematics(column) for column in plan.columns}
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
            titles = {0: "group.driver", -1: "group.outputs", CAM: "block.cam"}
            return plan.text(titles[number]) if number in titles else ""
        group = plan.equations.groups[number - 1]
        return plan.text("page.group", number=number, links=links_of(plan, group))

    def _mathematics(self, column: TableColumn) -> Rich | str:
        """The formula as people write it."""
        plan = self.plan
        law = plan.mechanism.driver.law
        if law is not None and column.kind in ("driver", "time"):
            return written(time_after(law, Symbol("n")) if column.kind == "time" else law.value, plan.language)
        if column.kind == "driver" and plan.mechanism.driver.stepped:
            return f"{plan.text('name.start')} + n·{plan.text('name.step')}"
        return "" if column.equation is None else written(column.equation.says, plan.language)

    def _width(self, column: TableColumn) -> float:
        if column.kind == "status":
            return STATUS_WIDTH
        length = len(plain_text(self.mathematics[column.col]))
        return max(NARROWEST, min(WIDEST, length / (CHARACTERS * (MOST_LINES - 1))))

    @property
    def formula_height(self) -> float:
        """Height of the row of formulas [pixels]."""
        lines = [
            math.ceil(0.3 + len(plain_text(self.mathematics[col])) / (CHARACTERS * width))
            for col, width in enumerate(self.widths)
        ]
        return LINE * max(2, *lines)

    # --- columns ----------------------------------------------------------------------------------------------

    def _column(self, column: TableColumn) -> None:
        plan, first = self.plan, self.plan.at.first
        unit = shown_unit(plan, column.symbol) if column.kind != "status" else ""
        title = rich(column.symbol, f" [{unit}]" if unit else "") if column.kind != "status" else ""
        self.put(plan.symbol_row, column.col, title or None, styles.HEAD)
        self.put(plan.symbol_row + 1, column.col, self.mathematics[column.col] or None, styles.FORMULA_TEXT)
        match column.kind:
            case "driver":
                self._driver()
            case "listed":
                own = plan.mechanism.given_unit(column.symbol) or SECONDS
                self._listed(column.symbol, column.col, styles.decimals(styles.COLUMN, places_of(plan, own)))
            case "time" if plan.mechanism.driver.law is not None:
                time = while_inputs_can_be(plan, time_after(plan.mechanism.driver.law, rows_before(plan)))
                self._fill(
                    column.col, self._bound(time, first), styles.decimals(styles.COLUMN, places_of(plan, SECONDS))
                )
            case "status":
                self._fill(column.col, self._bound(status(plan), first), styles.STATUS)
            case _:
                self._equation(column)

    def _fill(self, col: int, node: Node, style: Style) -> None:
        self.fills.append(Fill(self.plan.at.first, col, node, style, rows=self.plan.rows))

    def _bound(self, node: Node, row: int) -> Node:
        return transform(self.plan.at.bind(node, self.plan.main, row), degrees_together)

    def _driver(self) -> None:
        plan, driver, first = self.plan, self.plan.mechanism.driver, self.plan.at.first
        style = styles.decimals(styles.COLUMN, places(plan, driver.unit.kind))
        if driver.values:
            self._listed(driver.symbol, 0, style)
            return
        if driver.law is not None:
            self._fill(0, self._bound(by_time(driver.law, Symbol(TIME)), first), style)
            return
        stepped = while_inputs_can_be(plan, driver_after(plan, rows_before(plan)))
        self._fill(0, self._bound(stepped, first), style)

    def _listed(self, symbol: str, col: int, style: Style) -> None:
        """What is listed row by row, as inputs."""
        unit = self.plan.mechanism.given_unit(symbol) or SECONDS
        for row, value in enumerate(self.plan.mechanism.listed[symbol], self.plan.at.first):
            if isinstance(value, float):
                self.put(row, col, unit.written(value), styles.INPUT)
            else:
                node = self._bound(value, row)
                self.fills.append(Fill(row, col, in_degrees(node) if unit.in_degrees else node, style))

    def _equation(self, column: TableColumn) -> None:
        plan, equation, first = self.plan, column.equation, self.plan.at.first
        if equation is None:
            raise ValueError(f"a column without an equation: {column.symbol}")
        self.comments.append(Comment(plan.symbol_row, column.col, equation.label.of(plan.language)))
        inner = styles.INNER if column.inner else styles.COLUMN
        style = styles.decimals(inner, places_of(plan, equation.unit))
        node = self._bound(equation.expression, first)
        degrees = plan.at.spots[column.symbol].degrees
        value = in_degrees(node) if degrees else node
        if plan.mechanism.driver.values and column.symbol in plan.page.closes.values():
            value = plan.at.bind(while_inputs_can_be(plan, value), plan.main)
        if equation.first is not None:  # anew under the heading, and after a row without a value
            turn: Node = Number(360.0) if degrees else al.mul(al.TWO, al.PI)
            value = formula(
                "value+turn*IFERROR(ROUND((above-value)/turn,0),0)",
                value=value, turn=turn, above=CellRef(first - 1, column.col),
            )  # fmt: skip
        self._fill(column.col, value, style)

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
