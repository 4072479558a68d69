"""A workbook as the engine sees it, plain data: constants, blocks of equal formulas, names, the values stored in the file.

A *block* is a rectangle filled with one formula, as fill-down and fill-right make it; a formula that stands alone is a block
of one cell. Nothing here evaluates anything: readers fill a book, the engine recalculates it.
"""

from __future__ import annotations

from array import array
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from ..diagnostics import Fault
from .nodes import MAX_COLUMNS, MAX_ROWS, CellRef, Node, Scalar, shifted

Kind: TypeAlias = Literal["fill", "array", "spill"]


@dataclass(frozen=True, slots=True)
class Block:
    """`rows` x `cols` cells from (row, col) on, filled with `formula`, which is written as seen from the first of them.

    kind  "fill"   every cell has the formula, as fill-down and fill-right write it
          "array"  an array formula (Ctrl+Shift+Enter): one value, an array, shown in these cells
          "spill"  a dynamic array: as many cells as the array has; `rows` and `cols` are what the file had room for
    """

    row: int
    col: int
    rows: int
    cols: int
    formula: Node
    kind: Kind = "fill"

    def __post_init__(self) -> None:
        inside = 0 <= self.row <= self.row + self.rows - 1 < MAX_ROWS
        if not (inside and 0 <= self.col <= self.col + self.cols - 1 < MAX_COLUMNS):
            raise ValueError(f"a block outside the sheet: {self.row, self.col, self.rows, self.cols}")

    def around(self, down: int, right: int) -> list[Block]:
        """The parts of a filled block around one of its cells, counted from the first: above, left, right, below."""
        parts = (
            (0, 0, down, self.cols),
            (down, 0, 1, right),
            (down, right + 1, 1, self.cols - right - 1),
            (down + 1, 0, self.rows - down - 1, self.cols),
        )
        return [
            Block(self.row + row, self.col + col, rows, cols, shifted(self.formula, row, col))
            for row, col, rows, cols in parts
            if rows and cols
        ]


@dataclass(slots=True)
class Run:
    """Cells of one column without a gap, from `row` on. Numbers alone are held as an array of 8 bytes each."""

    row: int
    values: array[float] | list[Scalar]

    @property
    def end(self) -> int:
        """The row after the last one."""
        return self.row + len(self.values)


class CellStore:
    """Values of single cells, column by column, in runs. Filling down a column in order is the cheap way to fill it."""

    def __init__(self) -> None:
        self._columns: dict[int, list[Run]] = {}
        self._late: dict[int, dict[int, Scalar]] = {}
        self._texts: dict[int, list[tuple[int, bytes]]] = {}

    def put(self, row: int, col: int, value: Scalar) -> None:
        """Set one cell; a cell that is set twice keeps the last value."""
        runs = self._columns.get(col)
        if runs is None:
            runs = self._columns[col] = []
        number = type(value) is float or type(value) is int
        if runs:
            last = runs[-1]
            values = last.values
            end = last.row + len(values)
            if row == end and (type(values) is array) is number:
                values.append(value)  # type: ignore[arg-type]
                return
            if row < end:
                self._late.setdefault(col, {})[row] = value
                return
        runs.append(_run(row, value))

    def extend(self, row: int, col: int, values: Sequence[Scalar] | array[float]) -> None:
        """Set the cells from (row, col) down."""
        if isinstance(values, array):
            runs = self._columns.setdefault(col, [])
            if not runs or runs[-1].end < row:
                runs.append(Run(row, values[:]))
                return
            last = runs[-1].values
            if runs[-1].end == row and isinstance(last, array):
                last.extend(values)
                return
        for offset, value in enumerate(values):
            self.put(row + offset, col, value)

    def later(self, row: int, col: int, texts: bytes) -> None:
        """Set the cells from (row, col) down to finite numbers, written with blanks between them.

        Nothing may stand in these cells yet. They are converted when the store is first read: who recalculates a workbook
        has no use for the values that are stored in it.
        """
        self._texts.setdefault(col, []).append((row, texts))

    def settle_texts(self) -> None:
        """Convert what was put with `later`: values that are put from now on are the later ones."""
        if self._texts:
            self._convert()

    def settle(self) -> None:
        """Put everything where it belongs that was not put there at once."""
        self.settle_texts()
        if self._late:
            self._sort_in()

    def _convert(self) -> None:
        for col, texts in self._texts.items():
            runs = [Run(row, array("d", map(float, text.split()))) for row, text in texts]
            runs = sorted([*self._columns.get(col, ()), *runs], key=lambda run: run.row)
            joined = runs[:1]
            for run in runs[1:]:
                last = joined[-1]
                if run.row == last.end and isinstance(run.values, array) and isinstance(last.values, array):
                    last.values.extend(run.values)
                else:
                    joined.append(run)
            self._columns[col] = joined
        self._texts.clear()

    def _sort_in(self) -> None:
        """Put the cells that came out of order where they belong, each column in one go: a file may have many of them."""
        for col, late in self._late.items():
            runs = self._columns[col]
            if len(late) <= _FEW:
                for row, value in late.items():
                    _replace(runs, row, value)
                continue
            cells = {run.row + offset: value for run in runs for offset, value in enumerate(run.values)}
            cells.update(late)
            self._columns[col] = []
            sorted_store = CellStore()
            for row in sorted(cells):
                sorted_store.put(row, col, cells[row])
            self._columns[col] = sorted_store._columns[col]
        self._late.clear()

    def get(self, row: int, col: int) -> Scalar:
        """The value of a cell, None where nothing was put."""
        runs = self.columns.get(col)
        if not runs:
            return None
        index = bisect_right(runs, row, key=lambda run: run.row) - 1
        if index < 0 or row >= runs[index].end:
            return None
        return runs[index].values[row - runs[index].row]

    @property
    def columns(self) -> Mapping[int, Sequence[Run]]:
        """Column -> its runs from the top down."""
        self.settle()
        return self._columns

    def items(self) -> Iterator[tuple[int, int, Scalar]]:
        """(row, col, value) of every cell, column by column."""
        for col, runs in sorted(self.columns.items()):
            for run in runs:
                for offset, value in enumerate(run.values):
                    yield run.row + offset, col, value

    def copy(self) -> CellStore:
        """A store that can be changed apart from this one."""
        new = CellStore()
        new._columns = {col: [Run(run.row, run.values[:]) for run in runs] for col, runs in self.columns.items()}
        return new


_FEW = 16
"""Up to so many cells of a column out of order are put in one by one."""


def _run(row: int, value: Scalar) -> Run:
    number = type(value) is float or type(value) is int
    return Run(row, array("d", (value,)) if number else [value])  # type: ignore[arg-type]


def _replace(runs: list[Run], row: int, value: Scalar) -> None:
    """Set a cell above the end: split the run it stands in, or stand between two."""
    index = bisect_right(runs, row, key=lambda run: run.row) - 1
    if index >= 0 and row < runs[index].end:
        run = runs[index]
        at = row - run.row
        parts = [Run(run.row, run.values[:at]), _run(row, value), Run(row + 1, run.values[at + 1 :])]
        runs[index : index + 1] = [part for part in parts if part.values]
    else:
        runs.insert(index + 1, _run(row, value))


@dataclass(slots=True)
class BookSheet:
    """One sheet: what was typed (`constants`), what is computed (`blocks`), and the values stored for it (`cached`).

    hidden    rows that are not shown, as (first, end) with the end excluded;  filtered  those of them that a filter hides
    """

    title: str
    constants: CellStore = field(default_factory=CellStore)
    blocks: list[Block] = field(default_factory=list)
    cached: CellStore = field(default_factory=CellStore)
    hidden: list[tuple[int, int]] = field(default_factory=list)
    filtered: list[tuple[int, int]] = field(default_factory=list)

    def constant(self, row: int, col: int, value: Scalar) -> None:
        """A cell that holds a value."""
        self.constants.put(row, col, value)

    def block(self, row: int, col: int, rows: int, cols: int, formula: Node, kind: Kind = "fill") -> None:
        """A rectangle filled with one formula, written as seen from its first cell; or an array formula over it."""
        self.blocks.append(Block(row, col, rows, cols, formula, kind))

    def hide(self, first: int, end: int, by_filter: bool = False) -> None:
        """Rows first..end-1 are not shown."""
        for rows in (self.hidden, self.filtered) if by_filter else (self.hidden,):
            if rows and rows[-1][1] == first:
                rows[-1] = rows[-1][0], end
            else:
                rows.append((first, end))

    def keep(self, areas: Iterable[tuple[int, int, int, int]]) -> None:
        """Cells (row, column, rows, columns) hold their stored values as constants: their formulas cannot be computed."""
        for top, left, rows, cols in areas:
            for col in range(left, left + cols):
                for row in range(top, top + rows):
                    value = self.cached.get(row, col)
                    if value is not None:
                        self.constants.put(row, col, value)

    def formula_at(self, row: int, col: int) -> Block | None:
        """The block that a cell belongs to, None for a constant or an empty cell."""
        for block in self.blocks:
            if block.row <= row < block.row + block.rows and block.col <= col < block.col + block.cols:
                return block
        return None


@dataclass(frozen=True, slots=True)
class DefinedName:
    """A name for a formula, mostly a cell's reference; `sheet` is the title of the sheet it belongs to, None for the book's.

    Relative references in it are written as seen from cell A1; what is above or left of the formula's cell is then in the
    last rows and columns of the sheet.
    """

    name: str
    formula: Node
    sheet: str | None = None


@dataclass(frozen=True, slots=True)
class Table:
    """A table of a sheet, for structured references: its whole area, and how many of its rows are headers and totals."""

    name: str
    sheet: str
    row: int
    col: int
    rows: int
    columns: tuple[str, ...]
    headers: int = 1
    totals: int = 0


@dataclass(frozen=True, slots=True)
class Settings:
    """What a workbook sets about computing. The defaults are how Excel computes, and .xlsx files cannot say otherwise of the
    first four.

    case_sensitive   whether "a" = "A" is false (look-ups and criteria never mind)
    searching        what texts that are searched for may hold: "wildcards", "expressions" (regular ones), "plain"
    whole_cells      whether what is searched for must be the whole of a cell's text
    beginnings       whether a text among the criteria of DSUM and its like stands for its beginning
    as_shown         whether every value is rounded to what its cell shows
    iterates         whether circular references are computed again and again
    """

    case_sensitive: bool = False
    searching: Literal["wildcards", "expressions", "plain"] = "wildcards"
    whole_cells: bool = True
    beginnings: bool = True
    as_shown: bool = False
    iterates: bool = False


@dataclass(slots=True)
class Book:
    """A workbook. Titles of sheets and names are found without regard to case, as spreadsheet programs do.

    remarks  what a reader could not understand, with its cells (their stored values stand in the book as constants)
    macros   "VBA" or "Basic" where the file carries macros, which may define functions; else ""
    program  the program that saved the file, as the file names it
    settings what the workbook sets about computing
    """

    sheets: list[BookSheet]
    names: list[DefinedName] = field(default_factory=list)
    date1904: bool = False
    source: str = ""
    remarks: list[Fault] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    macros: str = ""
    program: str = ""
    settings: Settings = field(default_factory=Settings)

    def sheet(self, title: str) -> BookSheet | None:
        """The sheet of that title, None when there is none."""
        folded = title.casefold()
        return next((sheet for sheet in self.sheets if sheet.title.casefold() == folded), None)

    def name(self, name: str, sheet: str | None = None) -> DefinedName | None:
        """What a name means in `sheet`: the sheet's own name before the book's."""
        folded = name.casefold()
        found = None
        for defined in self.names:
            if defined.name.casefold() == folded:
                if defined.sheet is None:
                    found = found or defined
                elif sheet is not None and defined.sheet.casefold() == sheet.casefold():
                    return defined
        return found

    def name_like(self, name: str) -> DefinedName | None:
        """The name that a symbol stands for where it could not be a name itself: that of the cell beside which it stands
        (`crank` for a), or `a_1` for a1."""
        plain = name.replace("_", "").casefold()
        beside = (defined for defined in self.names if self._left_of(defined.formula) == name)
        alike = (defined for defined in self.names if defined.name.replace("_", "").casefold() == plain)
        return next(beside, None) or next(alike, None)

    def _left_of(self, node: Node) -> Scalar:
        """What stands to the left of a cell, unless a formula computes it."""
        sheet = self.sheet(node.sheet or "") if isinstance(node, CellRef) and node.col else None
        return sheet.constants.get(node.row, node.col - 1) if sheet and isinstance(node, CellRef) else None


class BookBuilder:
    """Fills a book sheet by sheet: `sheet(title).constant(...)`, `.block(...)`, then `build()`."""

    def __init__(self, source: str = "") -> None:
        self._book = Book([], source=source)

    def sheet(self, title: str) -> BookSheet:
        """A new sheet after the others."""
        if self._book.sheet(title) is not None:
            raise ValueError(f"two sheets called {title}")
        self._book.sheets.append(BookSheet(title))
        return self._book.sheets[-1]

    def name(self, name: str, formula: Node, sheet: str | None = None) -> None:
        """A defined name, of the whole book or of the sheet of that title."""
        self._book.names.append(DefinedName(name, formula, sheet))

    def build(self) -> Book:
        """The book as filled so far."""
        return self._book
