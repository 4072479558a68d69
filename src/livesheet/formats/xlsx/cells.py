"""The <sheetData> of a worksheet as text, a column of a band at a time."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field

from livesheet.diagnostics import Fault, OutputError
from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.nodes import (
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Missing,
    NameRef,
    Node,
    Number,
    RangeRef,
    Scalar,
    Text,
    Unary,
    shifted,
    walk,
)
from livesheet.formula.printer import print_formula
from livesheet.formula.references import area_name, cell_address, column_letters
from livesheet.said import say
from livesheet.workbook import Area, Cell, Fill, Rich, Sheet, Style

from ..bands import Band, bands, column_values
from ..fill_down_text import ColumnTexts, Piece, row_numbers, rowwise
from ..xml_text import number, numbers, ooxml_escaped, plain_value

MAX_CACHED_POINTS = 4096
"""Longer series carry no copy of their values: every program reads them from the cells anyway."""
MAX_FORMULA = 8192
"""Most characters of a formula in Excel, without the equals sign."""
MAX_FORMULA_TEXT = 255
"""Most characters of a text in a formula in Excel."""


@dataclass(slots=True)
class SheetData:
    """What is needed to write the cells of one sheet.

    style_index  the number of a style in the workbook's table
    strings      the numbers of the texts in the workbook's table, by place
    texts      the first formula of each fill, by the place where it begins
    functions  names of the workbook that are functions
    shared     the number of each shared formula, by the same place, in order of writing
    shareable  whether a fill can be shared, by the same place
    copies     what charts keep copies of
    """

    sheet: Sheet
    style_index: Callable[[Style], int]
    strings: dict[tuple[int, int], int]
    texts: dict[tuple[int, int], str]
    functions: frozenset[str] = frozenset()
    shared: dict[tuple[int, int], int] = field(default_factory=dict)
    shareable: dict[tuple[int, int], bool] = field(default_factory=dict)
    fill_down: ColumnTexts = field(default_factory=lambda: ColumnTexts("excel", ooxml_escaped))
    copies: Copies = field(init=False)

    def __post_init__(self) -> None:
        self.copies = Copies(self.sheet)

    def rows(self) -> Iterator[str]:
        """The rows as text, in pieces of a few megabytes at most."""
        heights = dict(self.sheet.row_heights)
        for band in bands(self.sheet):
            columns = [self._constant(cell) for cell in band.cells]
            for fill in band.fills:
                columns += self._fill(fill, band)
            columns.sort(key=lambda column: column[0])
            height = heights.get(band.first)
            # Heights are in pixels, the file wants points.
            kind = "" if height is None else f' ht="{number(height * 0.75)}" customHeight="1"'
            cells = [piece for _, pieces in columns for piece in pieces]
            row = ['<row r="', _numbers(band), f'"{kind}>', *cells, "</row>"]
            yield "".join(rowwise(row, band.last - band.first))

    def _constant(self, cell: Cell) -> tuple[int, list[Piece]]:
        head = f'<c r="{column_letters(cell.col)}{cell.row + 1}" s="{self.style_index(cell.style)}"'
        match cell.content:
            case None:
                return cell.col, [f"{head}/>"]
            case bool(value):
                return cell.col, [f'{head} t="b"><v>{int(value)}</v></c>']
            case str() | Rich():
                return cell.col, [f'{head} t="s"><v>{self.strings[cell.row, cell.col]}</v></c>']
            case value:
                return cell.col, [f"{head}><v>{number(value)}</v></c>"]

    def _fill(self, fill: Fill, band: Band) -> Iterator[tuple[int, list[Piece]]]:
        style = self.style_index(fill.style)
        dynamic = calls_one_of(fill.formula, self.functions)
        mark = ' cm="1"' if dynamic else ""
        for col in range(fill.col, fill.col + fill.cols):
            letters = column_letters(col)
            types, values = _values(column_values(fill, col, band.first, band.last), band, col, self.sheet.title)
            formulas = self._dynamic(fill, col, band) if dynamic else self._formulas(fill, col, band)
            head: list[Piece] = [f'<c r="{letters}', _numbers(band), f'" s="{style}"{mark}', types, ">"]
            yield col, [*head, *formulas, "<v>", values, "</v></c>"]

    def _formulas(self, fill: Fill, col: int, band: Band) -> list[Piece]:
        """The <f> elements of one column of a fill."""
        start = (fill.row, fill.col)
        if fill.rows * fill.cols == 1:
            return [f"<f>{self.texts[start]}</f>"]
        if not self._is_shared(fill):
            return ["<f>", *self.fill_down.pieces(fill, col, band.first, band.last), "</f>"]
        index = self.shared.setdefault(start, len(self.shared))
        if (band.first, col) == start:
            area = area_name(fill.row, fill.col, fill.rows, fill.cols)
            return [f'<f t="shared" ref="{area}" si="{index}">{self.texts[start]}</f>']
        return [f'<f t="shared" si="{index}"/>']

    def _is_shared(self, fill: Fill) -> bool:
        """Whether the cells of a fill refer to its first formula; asked band by band, found once."""
        start = (fill.row, fill.col)
        if start not in self.shareable:
            self.shareable[start] = can_be_shared(fill)
        return self.shareable[start]

    def _dynamic(self, fill: Fill, col: int, band: Band) -> list[Piece]:
        """The <f> elements of dynamic arrays of one cell each: without, Excel shows `=@Pump(...)` for a call of a LAMBDA."""
        texts = self.fill_down.pieces(fill, col, band.first, band.last)
        return [f'<f t="array" ref="{column_letters(col)}', _numbers(band), '">', *texts, "</f>"]


def _numbers(band: Band) -> Piece:
    return row_numbers(band.first + 1, band.last + 1)


def _values(values: Sequence[Scalar], band: Band, col: int, title: str) -> tuple[Piece, Piece]:
    """The type attributes of a column of a band, and its values."""
    texts = numbers(values)
    if texts is not None:
        return "", texts
    place = cell_address(title, band.first, col)
    typed = [_typed(plain_value(value, place)) for value in values]
    return [kind for kind, _ in typed], [text for _, text in typed]


def _typed(value: float | str | bool | ErrorValue) -> tuple[str, str]:
    """The type attribute of a formula's cell and its value."""
    match value:
        case bool():
            return ' t="b"', str(int(value))
        case str():
            return ' t="str"', ooxml_escaped(value)
        case ErrorValue(code):
            return ' t="e"', code
        case _:
            return "", number(value)


_SHARED_SIGNS = frozenset(["+", "-", "*", "/", "^", "&", "%", "=", "<", ">", "<=", ">=", "<>"])
"""Operators of a shared formula: no union, no intersection, no range between what is computed."""

_NOT_SHARED = frozenset({"LET", "LAMBDA"})


def can_be_shared(fill: Fill) -> bool:
    """Whether the cells of a fill may refer to its first formula instead of repeating it.

    A shared formula holds references to its own sheet, names of the workbook, constants, operators and functions of Excel
    2007: no sheet, union, intersection, array constant, #REF! or structured reference, relative or not ([MS-XLS] 2.5.198.103
    SharedParsedFormula; none of 7,594 shared formulas in Excel's own files has one). Strict readers
    refuse a workbook with another one, and Excel moves it wrongly (github.com/JanKallman/EPPlus issue 92).
    """
    # In its last row or column a reference may leave the sheet.
    last = shifted(fill.formula, fill.rows - 1, fill.cols - 1)
    return all(_fits_shared(node) for node in walk(fill.formula)) and not any(
        isinstance(node, ErrorValue) for node in walk(last)
    )


def _fits_shared(node: Node) -> bool:
    match node:
        case Number() | Text() | Boolean() | Missing() | RangeRef() | NameRef(_, None) | CellRef(sheet=None):
            return True
        case Unary(op, _) | Binary(op, _, _):
            return op in _SHARED_SIGNS
        case Call(name, _):
            known = FUNCTIONS.get(name)
            return known is not None and name not in _NOT_SHARED and not known.ooxml.startswith("_xlfn.")
    return False


def calls_one_of(formula: Node, functions: Collection[str]) -> bool:
    """Whether a formula calls a function that is a name of the workbook."""
    return bool(functions) and any(isinstance(node, Call) and node.name in functions for node in walk(formula))


GROWS = 5
"""A formula filled down and across is at most so many times as long: from A1 to XFD1048576."""


def formula_texts(sheet: Sheet) -> dict[tuple[int, int], str]:
    """The text of each fill's first formula, escaped, by its place.

    Raises OutputError for all that are longer than Excel can hold, in their first cell or in their last.
    """
    texts: dict[tuple[int, int], str] = {}
    faults = []
    for fill in sheet.fills:
        text = print_formula(fill.formula, "excel")
        last = text
        if fill.rows * fill.cols > 1 and GROWS * len(text) > MAX_FORMULA:
            last = print_formula(shifted(fill.formula, fill.rows - 1, fill.cols - 1), "excel")
        length = max(len(text), len(last))
        if length > MAX_FORMULA:
            place = cell_address(sheet.title, fill.row, fill.col)
            faults.append(
                Fault(
                    say("the formula has {length} characters, Excel allows {most}", length=length, most=MAX_FORMULA),
                    key=place,
                )
            )
        longest = max((len(node.value) for node in walk(fill.formula) if isinstance(node, Text)), default=0)
        if longest > MAX_FORMULA_TEXT:
            place = cell_address(sheet.title, fill.row, fill.col)
            message = say(
                "the formula holds a text of {longest} characters, Excel allows {most}",
                longest=longest,
                most=MAX_FORMULA_TEXT,
            )
            faults.append(Fault(message, key=place))
        texts[fill.row, fill.col] = ooxml_escaped(text)
    if faults:
        raise OutputError(faults)
    return texts


class Copies:
    """What the cells of a sheet hold, for the copies that charts keep; looked up by columns, of which charts read many."""

    def __init__(self, sheet: Sheet) -> None:
        self._cells: dict[int, dict[int, Scalar]] = {}
        for cell in sheet.cells:
            self._cells.setdefault(cell.col, {})[cell.row] = cell.value
        self._fills: dict[int, list[Fill]] = {}
        for fill in sheet.fills:
            for col in range(fill.col, fill.col + fill.cols):
                self._fills.setdefault(col, []).append(fill)

    def of(self, area: Area) -> list[float | str | None]:
        """The numbers and texts in a column or row of cells; None where there is none or an error.

        Empty when there are more than MAX_CACHED_POINTS.
        """
        first, end = area.first_row, area.last_row + 1
        if (end - first) * (area.last_col - area.first_col + 1) > MAX_CACHED_POINTS:
            return []
        columns = [self._column(col, first, end) for col in range(area.first_col, area.last_col + 1)]
        return [_cached(column.get(row)) for row in range(first, end) for column in columns]

    def _column(self, col: int, first: int, end: int) -> dict[int, Scalar]:
        cells = self._cells.get(col, {})
        found: dict[int, Scalar] = {row: cells[row] for row in range(first, end) if row in cells}
        for fill in self._fills.get(col, ()):
            top, bottom = max(first, fill.row), min(end, fill.row + fill.rows)
            if top < bottom:
                found |= zip(range(top, bottom), column_values(fill, col, top, bottom), strict=True)
        return found


def _cached(value: Scalar) -> float | str | None:
    return value if isinstance(value, (float, int, str)) and not isinstance(value, bool) else None
