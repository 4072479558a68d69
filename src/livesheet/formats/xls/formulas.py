"""Formulas of an .xls: from tokens in postfix order straight to the tree."""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, replace

from livesheet.formula.dialects import MAX_NESTING
from livesheet.formula.functions import canonical_name
from livesheet.formula.nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Foreign,
    Missing,
    NameRef,
    Node,
    Number,
    RangeRef,
    SheetsRef,
    Text,
    Unary,
)
from livesheet.said import say

from .contents import Contents
from .function_numbers import FUNCTION_NUMBERS
from .records import DamagedError, Reader
from .tokens import ATTRIBUTE_SUM, BINARY, COLUMNS, ROWS, UNARY, Token, place, tokens

ERRORS = {0x00: "#NULL!", 0x07: "#DIV/0!", 0x0F: "#VALUE!", 0x17: "#REF!", 0x1D: "#NAME?", 0x24: "#NUM!", 0x2A: "#N/A"}
_NAMED = 255
"""The function whose first argument is a name: a macro, an add-in's, or one younger than the format."""
_LOST = (Token.CELL_LOST, Token.AREA_LOST, Token.CELL_OF_SHEET_LOST, Token.AREA_OF_SHEET_LOST)
_MARKS = (Token.PARENTHESES, Token.MEMORY_ERROR, Token.MEMORY_NONE, Token.MEMORY_FUNCTION)
"""Tokens that say nothing of what is computed: the order of the others has all of it."""
_NO_SHEET = 0xFFFE


class UnreadableError(Exception):
    """Why a formula cannot be read; its cells keep their stored values."""


@dataclass(frozen=True, slots=True)
class _Part:
    """What has been read of a formula: a tree, and how deep it is nested."""

    node: Node
    depth: int = 0


class Formulas:
    """Makes trees of tokens; `sheet` is the title of the one at hand."""

    def __init__(self, contents: Contents) -> None:
        self._contents = contents

    def tree(self, code: bytes, extra: bytes, row: int = 0, col: int = 0) -> Node:
        """The tree of tokens in the form of `normal`, as seen from (row, col).

        extra  what follows the tokens: the constants of arrays
        Raises UnreadableError, and DamagedError.
        """
        return _Decoding(self._contents, Reader([extra]), row, col).tree(code)

    def tree_of_name(self, code: bytes, extra: bytes) -> Node:
        """The tree of a defined name: relative references as seen from A1, before it the last rows and columns."""
        return _Decoding(self._contents, Reader([extra]), 0, 0, wide=True).tree(code)


class _Decoding:
    """One formula. `wide`: what lies before A1 is in the last rows and columns of the large sheet."""

    def __init__(self, contents: Contents, extra: Reader, row: int, col: int, wide: bool = False) -> None:
        self.contents, self.extra = contents, extra
        self.row, self.col, self.wide = row, col, wide
        self.stack: list[_Part] = []

    def tree(self, code: bytes) -> Node:
        for token, start, end in tokens(code):
            self.take(token, code, start, end)
        if len(self.stack) != 1:
            raise UnreadableError(say("a formula that is not complete"))
        return self.stack[0].node

    def take(self, token: int, code: bytes, start: int, end: int) -> None:
        if token in BINARY:
            left, right = self.pop(2)
            self.push(_joined(BINARY[token], left.node, right.node), max(left.depth, right.depth + 1))
        elif token in UNARY:
            (operand,) = self.pop(1)
            self.push(Unary(UNARY[token], operand.node), operand.depth + 1)  # type: ignore[arg-type]
        elif token == Token.FUNCTION:
            number = struct.unpack_from("<H", code, start)[0]
            self.call(number, None)
        elif token == Token.FUNCTION_OF_MANY:
            count, number = struct.unpack_from("<BH", code, start)
            self.call(number, count & 0x7F)
        elif token == Token.ATTRIBUTE:
            if code[start] & ATTRIBUTE_SUM:
                (operand,) = self.pop(1)
                self.push(Call("SUM", (operand.node,)), operand.depth + 1)
        elif token == Token.MEMORY_AREA:
            self.extra.skip(8 * self.extra.unpack("<H")[0])
        elif token not in _MARKS:
            self.push(self.operand(token, code, start, end))

    def push(self, node: Node, depth: int = 0) -> None:
        if depth > MAX_NESTING:
            raise UnreadableError(say("nested deeper than {most} levels", most=MAX_NESTING))
        self.stack.append(_Part(node, depth))

    def pop(self, count: int) -> list[_Part]:
        if len(self.stack) < count:
            raise UnreadableError(say("a formula that is not complete"))
        found = self.stack[len(self.stack) - count :]
        del self.stack[len(self.stack) - count :]
        return found

    def call(self, number: int, count: int | None) -> None:
        """A function of its number with the arguments that lie ready; the 255th has its name among them."""
        if number == _NAMED and count:
            named, *args = self.pop(count)
            depth = max((part.depth for part in args), default=0) + 1
            if isinstance(named.node, NameRef):
                self.push(Call(canonical_name(named.node.name), tuple(part.node for part in args)), depth)
            else:
                self.push(named.node if isinstance(named.node, Foreign) else Foreign("?", say("an unknown function")))
            return
        if number not in FUNCTION_NUMBERS:
            raise UnreadableError(say("the function number {number}, which is not known", number=number))
        name, least = FUNCTION_NUMBERS[number]
        args = self.pop(least if count is None else count)
        if name in ("TRUE", "FALSE") and not args:
            self.push(Boolean(name == "TRUE"))
        else:
            self.push(Call(name, tuple(part.node for part in args)), max((p.depth for p in args), default=0) + 1)

    def operand(self, token: int, code: bytes, start: int, end: int) -> Node:
        """A constant, a reference, a name."""
        match token:
            case Token.INTEGER:
                return Number(float(struct.unpack_from("<H", code, start)[0]))
            case Token.NUMBER:
                value = struct.unpack_from("<d", code, start)[0]
                return Number(value) if math.isfinite(value) else ErrorValue("#NUM!")
            case Token.TEXT:
                return Text(Reader([code[start + 1 : end]]).text(code[start]))
            case Token.BOOLEAN:
                return Boolean(code[start] != 0)
            case Token.ERROR:
                return ErrorValue(ERRORS.get(code[start], "#N/A"))
            case Token.MISSING:
                return Missing()
            case Token.ARRAY:
                return self.array()
            case Token.NAME:
                return self.name(struct.unpack_from("<H", code, start)[0])
            case Token.NAME_ELSEWHERE:
                return self.name_elsewhere(*struct.unpack_from("<HH", code, start))
            case Token.CELL_AWAY | Token.CELL:
                return self.cell(*struct.unpack_from("<HH", code, start))
            case Token.AREA_AWAY | Token.AREA:
                return self.area(*struct.unpack_from("<HHHH", code, start))
            case Token.CELL_OF_SHEET:
                return self.on_sheets(struct.unpack_from("<H", code, start)[0], self.cell(*_two(code, start + 2)))
            case Token.AREA_OF_SHEET:
                area = self.area(*struct.unpack_from("<HHHH", code, start + 2))
                return self.on_sheets(struct.unpack_from("<H", code, start)[0], area)
        if token == Token.LABEL:
            raise UnreadableError(say("the words over a column in place of a reference"))
        if token in _LOST:
            return ErrorValue("#REF!")
        raise UnreadableError(say("the token {token:#04x} of a formula is not known here", token=token))

    # --- references ---------------------------------------------------------------------------------------------------

    def cell(self, there: int, column: int) -> CellRef:
        row, col, rows, columns = place(there, column, self.row, self.col)
        if self.wide and not rows and row >= ROWS // 2:
            row += MAX_ROWS - ROWS
        if self.wide and not columns and col >= COLUMNS // 2:
            col += MAX_COLUMNS - COLUMNS
        return CellRef(row, col, rows, columns)

    def area(self, top: int, bottom: int, left: int, right: int) -> RangeRef:
        start, end = self.cell(top, left), self.cell(bottom, right)
        if (top, bottom) == (0, ROWS - 1) and start.row_abs and end.row_abs:
            end = replace(end, row=MAX_ROWS - 1)
        if (left & 0xFF, right & 0xFF) == (0, COLUMNS - 1) and start.col_abs and end.col_abs:
            end = replace(end, col=MAX_COLUMNS - 1)
        return RangeRef(start, end)

    def on_sheets(self, number: int, area: CellRef | RangeRef) -> Node:
        """Cells of the sheets that a number stands for."""
        if number >= len(self.contents.spans):
            raise UnreadableError(say("a reference to sheets that are not there"))
        book_number, first, last = self.contents.spans[number]
        if book_number >= len(self.contents.books):
            raise UnreadableError(say("a reference to a workbook that is not there"))
        book = self.contents.books[book_number]
        if book.kind == "other":
            sheet = book.sheets[first] if first < len(book.sheets) else "?"
            return Foreign(f"'[{book.file}]{sheet}'!…")
        sheets = self.contents.sheets
        if book.kind == "add-in" or first >= len(sheets) or last >= len(sheets):
            return ErrorValue("#REF!")
        if first != last:
            return SheetsRef(sheets[first].title, sheets[last].title, area)
        title = sheets[first].title
        if isinstance(area, CellRef):
            return replace(area, sheet=title)
        return RangeRef(replace(area.start, sheet=title), replace(area.end, sheet=title))

    def name(self, number: int) -> Node:
        names = self.contents.names
        if not 1 <= number <= len(names):
            raise UnreadableError(say("a name that is not there"))
        return NameRef(names[number - 1].name)

    def name_elsewhere(self, span: int, number: int) -> Node:
        """A name of a sheet, of an add-in (a function), or of another workbook."""
        spans, books = self.contents.spans, self.contents.books
        if span >= len(spans) or spans[span][0] >= len(books):
            raise UnreadableError(say("a reference to a workbook that is not there"))
        book = books[spans[span][0]]
        if book.kind == "own":
            found = self.name(number)
            first = spans[span][1]
            if isinstance(found, NameRef) and first < min(_NO_SHEET, len(self.contents.sheets)):
                return NameRef(found.name, self.contents.sheets[first].title)
            return found
        if not 1 <= number <= len(book.names):
            raise UnreadableError(say("a name that is not there"))
        if book.kind == "add-in":
            return NameRef(book.names[number - 1])
        return Foreign(f"[{book.file}]{book.names[number - 1]}")

    # --- constants of arrays ------------------------------------------------------------------------------------------

    def array(self) -> ArrayLiteral:
        last_col, last_row = self.extra.unpack("<BH")
        return ArrayLiteral(tuple(tuple(self.item() for _ in range(last_col + 1)) for _ in range(last_row + 1)))

    def item(self) -> Node:
        kind = self.extra.take(1)[0]
        if kind == 0x02:
            return Text(self.extra.text(self.extra.unpack("<H")[0]))
        data = self.extra.take(8)
        match kind:
            case 0x01:
                value = struct.unpack("<d", data)[0]
                return Number(value) if math.isfinite(value) else ErrorValue("#NUM!")
            case 0x04:
                return Boolean(data[0] != 0)
            case 0x10:
                return ErrorValue(ERRORS.get(data[0], "#N/A"))
            case 0x00:
                return Text("")
        raise DamagedError(say("a constant of an array that is none"))


def _two(code: bytes, at: int) -> tuple[int, int]:
    first, second = struct.unpack_from("<HH", code, at)
    return first, second


def _joined(op: str, left: Node, right: Node) -> Node:
    """Two operands; two cells and a colon are one range."""
    if op == ":" and isinstance(left, CellRef) and isinstance(right, CellRef) and right.sheet in (None, left.sheet):
        return RangeRef(left, replace(right, sheet=left.sheet))
    return Binary(op, left, right)
