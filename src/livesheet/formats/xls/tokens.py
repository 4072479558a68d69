"""The tokens of a formula, as an .xls holds them: how long each is, and the form in which fill-down leaves them equal.

A formula is a sequence in postfix order; references stand in it as they are in that cell. `normal` writes the relative ones
as distances from the formula's own cell, as shared formulas have them, so that equal bytes are equal formulas.
Source: Microsoft, [MS-XLS] 2.5.198.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from enum import IntEnum

from livesheet.said import say

from .records import DamagedError

ROWS, COLUMNS = 1 << 16, 1 << 8
"""Of a sheet of these files."""


class Token(IntEnum):
    """Tokens that hold something; those of values come in three classes, which mean the same here."""

    CELL_OF_FORMULA = 0x01
    TABLE = 0x02
    PARENTHESES = 0x15
    MISSING = 0x16
    TEXT = 0x17
    LABEL = 0x18
    ATTRIBUTE = 0x19
    ERROR = 0x1C
    BOOLEAN = 0x1D
    INTEGER = 0x1E
    NUMBER = 0x1F
    ARRAY = 0x20
    FUNCTION = 0x21
    FUNCTION_OF_MANY = 0x22
    NAME = 0x23
    CELL = 0x24
    AREA = 0x25
    MEMORY_AREA = 0x26
    MEMORY_ERROR = 0x27
    MEMORY_NONE = 0x28
    MEMORY_FUNCTION = 0x29
    CELL_LOST = 0x2A
    AREA_LOST = 0x2B
    CELL_AWAY = 0x2C
    AREA_AWAY = 0x2D
    NAME_ELSEWHERE = 0x39
    CELL_OF_SHEET = 0x3A
    AREA_OF_SHEET = 0x3B
    CELL_OF_SHEET_LOST = 0x3C
    AREA_OF_SHEET_LOST = 0x3D


BINARY = {
    0x03: "+", 0x04: "-", 0x05: "*", 0x06: "/", 0x07: "^", 0x08: "&", 0x09: "<", 0x0A: "<=", 0x0B: "=", 0x0C: ">=",
    0x0D: ">", 0x0E: "<>", 0x0F: " ", 0x10: ",", 0x11: ":",
}  # fmt: skip
UNARY = {0x12: "+", 0x13: "-", 0x14: "%"}

_SIZES = {
    **dict.fromkeys((*BINARY, *UNARY, Token.PARENTHESES, Token.MISSING), 0),
    Token.CELL_OF_FORMULA: 4, Token.TABLE: 4, Token.LABEL: 5, Token.ERROR: 1, Token.BOOLEAN: 1, Token.INTEGER: 2,
    Token.NUMBER: 8,
    Token.ARRAY: 7, Token.FUNCTION: 2, Token.FUNCTION_OF_MANY: 3, Token.NAME: 4, Token.CELL: 4, Token.AREA: 8,
    Token.MEMORY_AREA: 6, Token.MEMORY_ERROR: 6, Token.MEMORY_NONE: 6, Token.MEMORY_FUNCTION: 2,
    Token.CELL_LOST: 4, Token.AREA_LOST: 8, Token.CELL_AWAY: 4, Token.AREA_AWAY: 8, Token.NAME_ELSEWHERE: 6,
    Token.CELL_OF_SHEET: 6, Token.AREA_OF_SHEET: 10, Token.CELL_OF_SHEET_LOST: 6, Token.AREA_OF_SHEET_LOST: 10,
}  # fmt: skip
"""Bytes behind the token itself."""

ATTRIBUTE_CHOOSE, ATTRIBUTE_SUM = 0x04, 0x10
_ROW_RELATIVE, _COLUMN_RELATIVE = 0x8000, 0x4000


def tokens(code: bytes) -> Iterator[tuple[int, int, int]]:
    """(token without its class, where what it holds begins, where that ends). Raises DamagedError."""
    at = 0
    while at < len(code):
        token = code[at]
        if token >= 0x40:
            token = token & 0x1F | 0x20
        start = at + 1
        size = _SIZES.get(token)
        if size is None:
            size = _size_of(token, code, start)
        at = start + size
        if at > len(code):
            raise DamagedError(say("a formula that is cut off"))
        yield token, start, at


def _size_of(token: int, code: bytes, start: int) -> int:
    """The bytes of tokens that tell their own size."""
    try:
        if token == Token.TEXT:
            return 2 + code[start] * (2 if code[start + 1] & 1 else 1)
        if token == Token.ATTRIBUTE:
            choices = struct.unpack_from("<H", code, start + 1)[0]
            return 3 + 2 * (choices + 1) if code[start] & ATTRIBUTE_CHOOSE else 3
    except (IndexError, struct.error):
        raise DamagedError(say("a formula that is cut off")) from None
    raise DamagedError(say("the token {token:#04x} of a formula is not known", token=token))


_AWAY = {Token.CELL: Token.CELL_AWAY, Token.AREA: Token.AREA_AWAY}


def normal(code: bytes, row: int, col: int) -> bytes:
    """The tokens of a formula in (row, col) with every relative reference as a distance. Raises DamagedError."""
    found = bytearray(code)
    for token, start, _ in tokens(code):
        if token in (Token.CELL, Token.CELL_OF_SHEET):
            at = start if token == Token.CELL else start + 2
            there, column = struct.unpack_from("<HH", code, at)
            struct.pack_into("<HH", found, at, *_distance(there, column, row, col))
        elif token in (Token.AREA, Token.AREA_OF_SHEET):
            at = start if token == Token.AREA else start + 2
            top, bottom, left, right = struct.unpack_from("<HHHH", code, at)
            left, right = _whole(top, bottom, left, right)
            top, left = _distance(top, left, row, col)
            bottom, right = _distance(bottom, right, row, col)
            struct.pack_into("<HHHH", found, at, top, bottom, left, right)
        if token in _AWAY:
            found[start - 1] = _AWAY[Token(token)]
    return bytes(found)


def _whole(top: int, bottom: int, left: int, right: int) -> tuple[int, int]:
    """The columns of an area with their marks: the rows of whole columns, and the columns of whole rows, are anchored."""
    if (top, bottom) == (0, ROWS - 1):
        left, right = left & ~_ROW_RELATIVE, right & ~_ROW_RELATIVE
    if (left & 0xFF, right & 0xFF) == (0, COLUMNS - 1):
        left, right = left & ~_COLUMN_RELATIVE, right & ~_COLUMN_RELATIVE
    return left, right


def _distance(there: int, column: int, row: int, col: int) -> tuple[int, int]:
    """A place with its relative parts as distances."""
    if column & _ROW_RELATIVE:
        there = (there - row) % ROWS
    if column & _COLUMN_RELATIVE:
        column = column & 0xFF00 | (column - col) % COLUMNS
    return there, column


def place(there: int, column: int, row: int, col: int) -> tuple[int, int, bool, bool]:
    """(row, column, row anchored, column anchored) of a place as `normal` has it, seen from (row, col)."""
    rows, columns = not column & _ROW_RELATIVE, not column & _COLUMN_RELATIVE
    letter = column & 0xFF
    return there if rows else (row + there) % ROWS, letter if columns else (col + letter) % COLUMNS, rows, columns
