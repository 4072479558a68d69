"""Formulas of an .xls: from tokens in postfix order straight to the tree.

References stand among the tokens as they are in that cell. `normal` writes the relative ones as distances from the formula's
own cell, as shared formulas have them, so that equal bytes are equal formulas, whoever filled them down.
Source: Microsoft, [MS-XLS] 2.5.198; of the numbers of functions 2.5.198.17 (Ftab).
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import IntEnum

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
from .records import DamagedError, Reader

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


_ROWS = """
0 COUNT 0, 1 IF 2, 2 ISNA 1, 3 ISERROR 1, 4 SUM 0, 5 AVERAGE 1, 6 MIN 1, 7 MAX 1, 8 ROW 0, 9 COLUMN 0, 10 NA 0,
11 NPV 2, 12 STDEV 1, 13 DOLLAR 1, 14 FIXED 2, 15 SIN 1, 16 COS 1, 17 TAN 1, 18 ATAN 1, 19 PI 0, 20 SQRT 1,
21 EXP 1, 22 LN 1, 23 LOG10 1, 24 ABS 1, 25 INT 1, 26 SIGN 1, 27 ROUND 2, 28 LOOKUP 2, 29 INDEX 2, 30 REPT 2,
31 MID 3, 32 LEN 1, 33 VALUE 1, 34 TRUE 0, 35 FALSE 0, 36 AND 1, 37 OR 1, 38 NOT 1, 39 MOD 2, 40 DCOUNT 3,
41 DSUM 3, 42 DAVERAGE 3, 43 DMIN 3, 44 DMAX 3, 45 DSTDEV 3, 46 VAR 1, 47 DVAR 3, 48 TEXT 2, 49 LINEST 1,
50 TREND 1, 51 LOGEST 1, 52 GROWTH 1, 56 PV 3, 57 FV 3, 58 NPER 3, 59 PMT 3, 60 RATE 3, 61 MIRR 3, 62 IRR 1,
63 RAND 0, 64 MATCH 2, 65 DATE 3, 66 TIME 3, 67 DAY 1, 68 MONTH 1, 69 YEAR 1, 70 WEEKDAY 1, 71 HOUR 1, 72 MINUTE 1,
73 SECOND 1, 74 NOW 0, 75 AREAS 1, 76 ROWS 1, 77 COLUMNS 1, 78 OFFSET 3, 82 SEARCH 2, 83 TRANSPOSE 1, 86 TYPE 1,
92 SERIESSUM 4, 97 ATAN2 2, 98 ASIN 1, 99 ACOS 1, 100 CHOOSE 2, 101 HLOOKUP 3, 102 VLOOKUP 3, 105 ISREF 1,
109 LOG 1, 111 CHAR 1, 112 LOWER 1, 113 UPPER 1, 114 PROPER 1, 115 LEFT 1, 116 RIGHT 1, 117 EXACT 2, 118 TRIM 1,
119 REPLACE 4, 120 SUBSTITUTE 3, 121 CODE 1, 124 FIND 2, 125 CELL 1, 126 ISERR 1, 127 ISTEXT 1, 128 ISNUMBER 1,
129 ISBLANK 1, 130 T 1, 131 N 1, 140 DATEVALUE 1, 141 TIMEVALUE 1, 142 SLN 3, 143 SYD 4, 144 DDB 4, 148 INDIRECT 1,
162 CLEAN 1, 163 MDETERM 1, 164 MINVERSE 1, 165 MMULT 2, 167 IPMT 4, 168 PPMT 4, 169 COUNTA 0, 183 PRODUCT 0,
184 FACT 1, 189 DPRODUCT 3, 190 ISNONTEXT 1, 193 STDEVP 1, 194 VARP 1, 195 DSTDEVP 3, 196 DVARP 3, 197 TRUNC 1,
198 ISLOGICAL 1, 199 DCOUNTA 3, 204 USDOLLAR 1, 205 FINDB 2, 206 SEARCHB 2, 207 REPLACEB 4, 208 LEFTB 1,
209 RIGHTB 1, 210 MIDB 3, 211 LENB 1, 212 ROUNDUP 2, 213 ROUNDDOWN 2, 214 ASC 1, 215 DBCS 1, 216 RANK 2,
219 ADDRESS 2, 220 DAYS360 2, 221 TODAY 0, 222 VDB 5, 227 MEDIAN 1, 228 SUMPRODUCT 1, 229 SINH 1, 230 COSH 1,
231 TANH 1, 232 ASINH 1, 233 ACOSH 1, 234 ATANH 1, 235 DGET 3, 244 INFO 1, 247 DB 4, 252 FREQUENCY 2,
261 ERROR.TYPE 1, 269 AVEDEV 1, 270 BETADIST 3, 271 GAMMALN 1, 272 BETAINV 3, 273 BINOMDIST 4, 274 CHIDIST 2,
275 CHIINV 2, 276 COMBIN 2, 277 CONFIDENCE 3, 278 CRITBINOM 3, 279 EVEN 1, 280 EXPONDIST 3, 281 FDIST 3, 282 FINV 3,
283 FISHER 1, 284 FISHERINV 1, 285 FLOOR 2, 286 GAMMADIST 4, 287 GAMMAINV 3, 288 CEILING 2, 289 HYPGEOMDIST 4,
290 LOGNORMDIST 3, 291 LOGINV 3, 292 NEGBINOMDIST 3, 293 NORMDIST 4, 294 NORMSDIST 1, 295 NORMINV 3, 296 NORMSINV 1,
297 STANDARDIZE 3, 298 ODD 1, 299 PERMUT 2, 300 POISSON 3, 301 TDIST 3, 302 WEIBULL 4, 303 SUMXMY2 2,
304 SUMX2MY2 2, 305 SUMX2PY2 2, 306 CHITEST 2, 307 CORREL 2, 308 COVAR 2, 309 FORECAST 3, 310 FTEST 2,
311 INTERCEPT 2, 312 PEARSON 2, 313 RSQ 2, 314 STEYX 2, 315 SLOPE 2, 316 TTEST 4, 317 PROB 3, 318 DEVSQ 1,
319 GEOMEAN 1, 320 HARMEAN 1, 321 SUMSQ 0, 322 KURT 1, 323 SKEW 1, 324 ZTEST 2, 325 LARGE 2, 326 SMALL 2,
327 QUARTILE 2, 328 PERCENTILE 2, 329 PERCENTRANK 2, 330 MODE 1, 331 TRIMMEAN 2, 332 TINV 2, 336 CONCATENATE 0,
337 POWER 2, 342 RADIANS 1, 343 DEGREES 1, 344 SUBTOTAL 2, 345 SUMIF 2, 346 COUNTIF 2, 347 COUNTBLANK 1,
350 ISPMT 4, 351 DATEDIF 3, 352 DATESTRING 1, 353 NUMBERSTRING 2, 354 ROMAN 1, 358 GETPIVOTDATA 2, 359 HYPERLINK 1,
360 PHONETIC 1, 361 AVERAGEA 1, 362 MAXA 1, 363 MINA 1, 364 STDEVPA 1, 365 VARPA 1, 366 STDEVA 1, 367 VARA 1,
368 BAHTTEXT 1, 369 THAIDAYOFWEEK 1, 370 THAIDIGIT 1, 371 THAIMONTHOFYEAR 1, 372 THAINUMSOUND 1,
373 THAINUMSTRING 1, 374 THAISTRINGLENGTH 1, 375 ISTHAIDIGIT 1, 376 ROUNDBAHTDOWN 1, 377 ROUNDBAHTUP 1,
378 THAIYEAR 1, 379 RTD 2
"""


def _row(text: str) -> tuple[int, tuple[str, int]]:
    number, name, least = text.split()
    return int(number), (name, int(least))


FUNCTION_NUMBERS = dict(map(_row, _ROWS.split(",")))
"""Number -> (name, fewest arguments: all of them, where a formula does not say how many)."""


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
