"""A workbook opened once, whose inputs are set and whose values are read as often as one likes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault, FormulaError, WorkbookError, near_miss
from livesheet.engine import Live, compile_book
from livesheet.engine.layout import Area
from livesheet.engine.values.cells import BOOLEAN, NUMBER
from livesheet.formula.book import Book
from livesheet.formula.dialects import MAX_NESTING
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, CellRef, ErrorValue, NameRef, Node, RangeRef, Scalar
from livesheet.formula.parser import parse_formula
from livesheet.said import say
from mechsheet.arguments.values import cell_value

if TYPE_CHECKING:
    from livesheet.engine.values.cells import Cells

Numbers: TypeAlias = NDArray[np.float64]
Value: TypeAlias = "float | int | str | bool | ErrorValue | np.number[Any] | None"
"""What can be put into a cell."""

_SHOWN_NAMES = 20


def open_book(path: str | Path) -> Session:
    """Read a workbook (.xlsx, .xlsm, .ods, .ots, .xls) and compute it once.

    What cannot be computed as it is meant is in `remarks`. Raises WorkbookError: not a workbook, a damaged one.

    >>> import mechsheet
    >>> book = mechsheet.open_book("four-bar.xlsx")         # doctest: +SKIP
    >>> book["a1"] = 65.0                                   # doctest: +SKIP
    >>> book["Positions!F4:F364"].max()                     # doctest: +SKIP
    """
    from livesheet.formats import read
    from mechsheet.library.routines import with_routines

    path = Path(path)
    return Session(with_routines(read(path)), path)


class Session:
    """A workbook in memory. `where` is a defined name (`a1` finds `a_1`), a cell `Sheet!B2` or a range `Sheet!B2:D9`.

    Setting an input costs next to nothing; asking for a value computes what that value needs and what a change has
    touched. All values are those that a full recalculation with the same inputs gives, to the last bit.
    Not to be used by several threads at once.
    """

    def __init__(self, book: Book, path: Path | None = None) -> None:
        self._book = book
        self._path = path
        self._titles = {sheet.title.casefold(): index for index, sheet in enumerate(book.sheets)}
        self._areas: dict[str, Area] = {}
        self._live = Live(compile_book(book))
        self._live.values()

    @property
    def names(self) -> tuple[str, ...]:
        """The defined names of the workbook."""
        return tuple(defined.name for defined in self._book.names)

    @property
    def remarks(self) -> tuple[Fault, ...]:
        """What to know before trusting the values as they are now, with the cells: as `recalc` gives them. Computes all."""
        return (*self._book.remarks, *self._live.values().remarks)

    # inputs

    def set(self, where: str, value: Value, force: bool = False) -> None:
        """Put a value into a cell: a number of any type, numpy's too; a text or a truth value where no number stands.

        A cell that holds a number in the file takes numbers only: a text or None there would spoil what is computed from
        it without a word. With `force` it takes anything, None to empty it. Raises WorkbookError when there is no such
        cell, when a formula computes it, for a value that it cannot take, or a number that is not finite.
        """
        self.update({_place(where): value}, force)

    __setitem__ = set

    def update(self, changes: Mapping[str, Value], force: bool = False) -> None:
        """Set several cells, or none of them when one cannot be set (the WorkbookError then has one fault for each)."""
        faults: list[Fault] = []
        cells: dict[tuple[int, int, int], Scalar] = {}
        for where, value in changes.items():
            try:
                cell = self._cell(where)
            except WorkbookError as problem:
                faults += problem.faults
                continue
            sheet, row, col = cell
            found = cell_value(where, value, self._book.sheets[sheet].constants.get(row, col), force)
            if isinstance(found, Fault):
                faults.append(found)
            else:
                cells[cell] = found
        if faults:
            raise WorkbookError(faults)
        if not all(map(self._live.holds_constant, cells)):
            self._make_room(cells)
        for cell, scalar in cells.items():
            self._live.set(cell, scalar)

    def reset(self, *where: str) -> None:
        """Restore the file's values in some cells; without an argument, in all of them."""
        for cell in [self._cell(place) for place in where] if where else list(self._live.inputs):
            self._live.reset(cell)

    def _cell(self, where: str) -> tuple[int, int, int]:
        """The one cell that is to be set."""
        area = self._area(where)
        if area.rows * area.cols > 1:
            raise _error(where, "several cells, which cannot be set at once")
        cell = area.sheet, area.row, area.col
        if not self._live.holds_constant(cell) and self._book.sheets[area.sheet].formula_at(area.row, area.col):
            raise _error(where, "computed by a formula: set what it is computed from")
        return cell

    def _make_room(self, cells: Mapping[tuple[int, int, int], Scalar]) -> None:
        """A plan in which empty cells that are to be set hold constants."""
        old = self._live
        empty = frozenset(cell for cell in cells if not old.holds_constant(cell))
        self._live = Live(old.plan.with_constants_in(empty))
        for cell, value in old.inputs.items():
            self._live.set(cell, value)

    # values

    def get(self, where: str) -> Scalar | Numbers:
        """The value of a cell: a float, a text, a truth value, an ErrorValue or None; of a range the array of its numbers.

        The array has one axis for cells of one row or column, else two (rows, columns), with NaN where a cell shows no
        number. It is a view of the session's values wherever that is possible, read-only, and good until the next
        change: copy what is to be kept.
        """
        area = self._area(where)
        cells = self._live.read(area)
        return self._numbers(area, cells) if area.rows * area.cols > 1 else self._scalar(cells, 0, 0)

    __getitem__ = get

    def number(self, where: str) -> float:
        """The number in a cell. Raises WorkbookError when it shows none, with what it shows."""
        value = self.get(where)
        if not isinstance(value, float):
            shown = "several cells" if isinstance(value, np.ndarray) else "nothing" if value is None else str(value)
            raise _error(where, f"{shown}, no number")
        return value

    def array(self, where: str) -> Numbers:
        """As `get`, an array also for a single cell."""
        area = self._area(where)
        return self._numbers(area, self._live.read(area))

    def table(self, where: str) -> list[list[Scalar]]:
        """What the cells of a range show, row by row, of any kind."""
        area = self._area(where)
        cells = self._live.read(area)
        return [[self._scalar(cells, col, row) for col in range(area.cols)] for row in range(area.rows)]

    def _scalar(self, cells: Cells, col: int, row: int) -> Scalar:
        code = NUMBER if cells.codes is None else int(cells.codes[col, row])
        return self._live.texts.decode(float(cells.numbers[col, row]), code)

    @staticmethod
    def _numbers(area: Area, cells: Cells) -> Numbers:
        numbers = cells.numbers
        if cells.codes is not None:
            numbers = np.where((cells.codes == NUMBER) | (cells.codes == BOOLEAN), numbers, np.nan)
        found: Numbers = numbers[0] if area.cols == 1 else numbers[:, 0] if area.rows == 1 else numbers.T
        found.flags.writeable = False
        return found

    def write(self, output: str | Path) -> None:
        """Write the workbook with its values as they are now and nothing else changed. Raises OutputError."""
        from livesheet.formats import update_values

        if self._path is None:
            raise ValueError("a session of a book that was not read from a file")
        titles = [sheet.title for sheet in self._book.sheets]
        changes = {(titles[sheet], row, col): value for (sheet, row, col), value in self._live.inputs.items()}
        update_values(self._path, Path(output), self._book, self._live.values(), changes)

    # places

    def _area(self, where: str) -> Area:
        found = self._areas.get(_place(where))
        if found is None:
            found = self._found(where)
            if found.rows == MAX_ROWS or found.cols == MAX_COLUMNS:  # whole columns, rows: as far as there is something
                found = self._live.plan.layout.clipped(found)
            self._areas[where] = found
        return found

    def _found(self, where: str) -> Area:
        """What a name, a cell or a range means."""
        node = self._named(where, None)
        if node is None:
            try:
                node = parse_formula(_quoted(where))
            except FormulaError:
                node = NameRef(where)
        for _ in range(MAX_NESTING):
            if not isinstance(node, NameRef):
                break
            node = self._named(node.name, node.sheet)
        corners = (node.start, node.end) if isinstance(node, RangeRef) else (node, node)
        if isinstance(corners[0], CellRef) and isinstance(corners[1], CellRef):
            sheet = self._titles.get((corners[0].sheet or "").casefold())
            if sheet is not None:
                rows, cols = (sorted(getattr(corner, axis) for corner in corners) for axis in ("row", "col"))
                return Area(sheet, rows[0], cols[0], rows[1] - rows[0] + 1, cols[1] - cols[0] + 1)
        if "!" in where:
            hint = f"sheets: {', '.join(sheet.title for sheet in self._book.sheets)}"
        else:
            hint = near_miss(where, self.names) or f"names: {', '.join(self.names[:_SHOWN_NAMES]) or 'none'}"
        raise _error(where, "no cell or range of this workbook", hint)

    def _named(self, name: str, sheet: str | None) -> Node | None:
        """What a defined name stands for, `a1` also for `a_1`."""
        found = self._book.name(name, sheet)
        if found is None and sheet is None:
            found = self._book.name_like(name)
        return None if found is None else found.formula


def _place(where: object) -> str:
    """Places are texts. Raises WorkbookError."""
    if isinstance(where, str):
        return where
    raise WorkbookError(
        Fault(say("{where!r} is no name of a cell", where=where), hint=say('a text: "a1", "Sheet!B2", "Sheet!B2:D9"'))
    )


def _quoted(where: str) -> str:
    """`My sheet!A1` as formulas spell it: 'My sheet'!A1."""
    sheet, mark, place = where.rpartition("!")
    if not mark or sheet.startswith("'"):
        return where
    return "'" + sheet.replace("'", "''") + f"'!{place}"


def _error(where: str, message: str, hint: str = "") -> WorkbookError:
    return WorkbookError(Fault(message, key=where, hint=hint))
