"""What an evaluation finds: the values of a book, and which of its blocks hold something other than numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..diagnostics import Fault, MissingSheetError
from ..formula.nodes import Scalar
from .layout import Area, Layout
from .values.cells import BOOLEAN, NUMBER, TEXT, Cells, Codes, Numbers, Texts


class Values:
    """What every cell shows: constants and results alike.

    remarks  what is not as it is meant, with its cells: unknown functions, references to other workbooks, volatile
             functions, circles (#REF! in their cells)
    kept     formulas that could not be computed, (sheet's title, row, column): they show what the file holds, else #VALUE!
    """

    def __init__(
        self,
        layout: Layout,
        numbers: Numbers,
        codes: Codes,
        texts: Texts,
        remarks: Sequence[Fault] = (),
        kept: Iterable[tuple[int, int, int]] = (),
    ) -> None:
        self.remarks = tuple(remarks)
        self.kept = frozenset((layout.titles[sheet], row, col) for sheet, row, col in kept)
        self._layout = layout
        self._numbers = numbers
        self._codes = codes
        self.texts = texts
        self._sheets = {title.casefold(): index for index, title in enumerate(layout.titles)}

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """A cell's value, None when it is empty. Raises KeyError for a sheet that does not exist."""
        place = self._layout.place(self._sheet(sheet), row, col)
        return None if place < 0 else self.texts.decode(float(self._numbers[place]), int(self._codes[place]))

    def column(self, sheet: str, col: int, first_row: int, last_row: int) -> list[Scalar]:
        """The values of a column's rows first_row..last_row, both included."""
        numbers, codes = self._read(sheet, col, first_row, last_row)
        if not codes.any():
            return list(numbers.tolist())
        return [self.texts.decode(n, c) for n, c in zip(numbers.tolist(), codes.tolist(), strict=True)]

    def arrays(self, sheet: str, col: int, first_row: int, last_row: int) -> tuple[Numbers, Codes]:
        """The same rows as (float64 array, uint8 codes): NaN wherever the cell holds no number or truth value.

        Codes: 0 number, 1 blank, 2 text, 3 truth value, from 16 on errors in the order of `values.ERROR_NAMES`.
        """
        numbers, codes = self._read(sheet, col, first_row, last_row)
        return np.where((codes == NUMBER) | (codes == BOOLEAN), numbers, np.nan), codes

    def spill(self, sheet: str, row: int, col: int) -> tuple[int, int] | None:
        """Rows and columns of the array whose formula stands in a cell, None when there is none."""
        area = self._layout.spill_at(self._sheet(sheet), row, col)
        return None if area is None else (area.rows, area.cols)

    def items(self, sheet: str) -> Iterator[tuple[int, int, Scalar]]:
        """(row, col, value) of every cell of a sheet that is not empty, column by column."""
        index = self._sheet(sheet)
        for col, column in sorted(self._layout.columns[index].items()):
            for band in column.bands:
                values = self.column(sheet, col, band.row, band.row + band.rows - 1)
                yield from ((row, col, value) for row, value in enumerate(values, band.row))

    def read(self, area: Area) -> Cells:
        """The cells of an area, shape (cols, rows)."""
        return self._layout.read(area, self._numbers, self._codes)

    def _sheet(self, title: str) -> int:
        found = self._sheets.get(title.casefold())
        if found is None:
            raise MissingSheetError(title)
        return found

    def _read(self, sheet: str, col: int, first_row: int, last_row: int) -> tuple[Numbers, Codes]:
        area = Area(self._sheet(sheet), first_row, col, last_row - first_row + 1, 1)
        found = self.read(area)
        numbers = np.array(found.numbers[0])
        codes = np.zeros(len(numbers), np.uint8) if found.codes is None else np.array(found.codes[0])
        return numbers, codes


@dataclass(slots=True)
class Marks:
    """By the numbers of producers (`Layout.producers`).

    dirty  hold something other than numbers;  texts  those of them that hold texts and nothing else
    """

    dirty: set[int] = field(default_factory=set)
    texts: set[int] = field(default_factory=set)

    def copy(self) -> Marks:
        """Marks that can be changed apart from these."""
        return Marks(set(self.dirty), set(self.texts))

    def note(self, producer: int, codes: Any) -> None:
        """Take note of (some of) the codes of what a producer holds."""
        if codes.any():
            self.dirty.add(producer)
        if producer in self.texts and not (codes == TEXT).all():
            self.texts.discard(producer)

    def note_one(self, producer: int, code: int) -> None:
        """The same of the code of one cell."""
        if code:
            self.dirty.add(producer)
        if code != TEXT:
            self.texts.discard(producer)


def marks_of_constants(layout: Layout) -> Marks:
    """What the constants hold."""
    marks = Marks()
    for producer, run in enumerate(layout.constants, len(layout.blocks)):
        if run.codes is not None:
            marks.dirty.add(producer)
            if (run.codes == TEXT).all():
                marks.texts.add(producer)
    return marks
