"""What is put on a sheet, one cell after the other: every writer of a sheet collects it so.

How high a row must be for texts that are broken into lines is decided here: not every program finds that out when it
opens a file.
"""

from __future__ import annotations

import math
import unicodedata
from typing import Literal

from livesheet.formula.nodes import Binary, Call, Node, Text
from livesheet.workbook import Area, Cell, Comment, Conditional, Content, Fill, Merge, Style, Validation, plain_text
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


_WIDTHS = {
    191: "'", 222: "ijl", 260: "|", 278: " !,./:;I[\\]ft\N{LATIN SMALL LETTER DOTLESS I}",
    333: "()-`r₀₁₂₃₄₅₆₇₈₉", 355: '"', 400: "°",
    500: "Jcksvxyz", 556: "0123456789abdeghnopqu?_", 584: "+<=>~−±·", 611: "FTZ",
    667: "&ABEKPSVXY", 722: "CDHNRUw", 778: "GOQ", 833: "Mm", 889: "%", 944: "W", 1000: "→…—", 1015: "@",
}  # fmt: skip
_WIDTH = {sign: width for width, signs in _WIDTHS.items() for sign in signs}
"""Widths of signs in thousandths of the font's size: Arial's, and its substitutes'. Accents add nothing."""

_OTHER = 620
"""Of a sign that is not listed: most are narrower."""

_FONT_PIXELS = 10 * 96 / 72

_INDENT = 16
"""Pixels that a column needs besides its text: the indent of a label and the padding of cells."""

ROW_HEIGHT, FURTHER = 20, 14
"""Pixels of a row with one line of text, and of each further line."""


def label_lines(text: str, columns: float) -> int:
    """How many lines a label takes in so many pixels, broken between words as spreadsheet programs do it."""
    room = columns - _INDENT
    lines, used = 1, 0.0
    for word in text.split(" "):
        wide = _pixels(word)
        if used and used + _pixels(" ") + wide > room:
            lines, used = lines + 1, 0.0
        used += wide + (_pixels(" ") if used else 0.0)
        if used > room:  # a word that is longer than a line is broken anywhere
            lines += math.ceil(used / room) - 1
            used = used % room
    return lines


NUMBER = "000.0"
"""About as wide as a number in a text that a formula writes."""


def longest_said(node: Node) -> str:
    """The longest of the texts that a formula may write."""
    match node:
        case Text(value):
            return value
        case Binary("&", left, right):
            return longest_said(left) + longest_said(right)
        case Call("IF" | "CHOOSE", (_, *chosen)) | Call("IFERROR", (*chosen,)):
            return max(map(longest_said, chosen), key=_pixels, default="")
    return NUMBER


def height_of(lines: int, one: int = ROW_HEIGHT) -> float:
    """Pixels of a row whose label takes so many lines; `one` of a row with one line."""
    return float(one + (lines - 1) * FURTHER)


def _pixels(text: str) -> float:
    letters = (sign for sign in unicodedata.normalize("NFD", text) if not unicodedata.combining(sign))
    return sum(_WIDTH.get(sign, _OTHER) for sign in letters) * _FONT_PIXELS / 1000


def wrapped_lines(content: Content, width: float) -> int:
    """How many lines a text takes in a column of `width` characters, generously: words break early, capitals are wide."""
    if content is None or isinstance(content, bool | float):
        return 1
    return max(1, sum(math.ceil(len(line) / (width * 1.05)) for line in plain_text(content).split("\n")))
