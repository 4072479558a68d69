"""What is put on a sheet, one cell after the other: every writer of a sheet collects it so."""

from __future__ import annotations

from typing import Literal

from livesheet.formula.nodes import Node
from livesheet.workbook import Area, Cell, Comment, Conditional, Content, Fill, Merge, Style, Validation
from mechsheet.sheet.plan import Plan


class Cells:
    """The cells of a sheet with such a title, and what belongs to them."""

    def __init__(self, plan: Plan, title: str) -> None:
        self.plan, self.title = plan, title
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.merges: list[Merge] = []
        self.validations: list[Validation] = []
        self.conditionals: list[Conditional] = []
        self.comments: list[Comment] = []
        self.heights: dict[int, float] = {}

    def put(self, row: int, col: int, content: Content, style: Style) -> None:
        """A constant."""
        self.cells.append(Cell(row, col, content, style))

    def formula(self, row: int, col: int, node: Node, style: Style, rows: int = 1) -> None:
        """A formula over symbols and places, filled down."""
        self.fills.append(Fill(row, col, self.plan.at.bind(node, self.title), style, rows=rows))

    def takes(
        self, row: int, col: int, kind: Literal["decimal", "whole", "list"], title: str, message: str,
        operator: Literal["between", ">="] = "between", low: Node | None = None, high: Node | None = None,
        choices: tuple[str, ...] = (), stop: bool = True,
    ) -> None:  # fmt: skip
        """What may be typed into a cell, as it is said before and after."""
        area = Area(row, col, row, col)
        self.validations.append(
            Validation(area, kind, operator, low, high, choices, title, message, title, message, stop)
        )

    def colour(self, area: Area, test: Node, style: Style) -> None:
        """How cells look where a test of them, written for the upper left one, holds."""
        self.conditionals.append(Conditional(area, self.plan.at.bind(test, self.title), style))

    def merge(self, row: int, first: int, last: int) -> None:
        """Cells side by side that are shown as one."""
        self.merges.append(Merge(Area(row, first, row, last)))
