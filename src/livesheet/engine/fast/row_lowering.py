"""Lowering of columns that are computed row by row: what a row reads of rows above it are values kept from there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ...formula.book import Block
from ...formula.nodes import Binary, CellRef
from ..graph import area_read
from ..layout import Area, Layout
from .lowering import Effect, Functions, Lowering, UnsuitableError

MOST_ABOVE = 16
"""Rows above a row that are kept: a recurrence reads one, a moving average a dozen."""


class RowBlock(NamedTuple):
    """Rows of one column that are computed: as many as the others', the formula as seen from the first of them."""

    producer: int
    sheet: int
    block: Block
    offset: int


class RowLowering(Lowering):
    """Columns in their order. `columns` says where what is read from other columns lies, `cells` single cells: all are to
    hold numbers. `above`: (column, how many rows above) whose values are kept."""

    def __init__(
        self, layout: Layout, sheets: dict[str, int], functions: Functions, blocks: Sequence[RowBlock], group: set[int]
    ) -> None:
        super().__init__(layout, sheets, functions, set())
        self.blocks = blocks
        self.columns: set[int] = set()
        self.cells: set[int] = set()
        self.above: set[tuple[int, int]] = set()
        self.kept: list[int] = []
        self._at = 0
        # Whatever else reads blocks of the set (ranges, say) is not for this loop.
        self.results = dict.fromkeys(group, -1)
        self._places: dict[tuple[int, int], list[int]] = {}
        for number, (_, sheet, block, _) in enumerate(blocks):
            self._places.setdefault((sheet, block.col), []).append(number)
        for number in range(len(blocks)):
            self._at = number
            self._keep(number)

    @property
    def block(self) -> Block:
        """The rows being lowered."""
        return self.blocks[self._at].block

    def _keep(self, number: int) -> None:
        formula = self.block.formula
        try:
            result = self.lower(formula)
        except RecursionError as problem:
            raise UnsuitableError from problem
        if isinstance(formula, Binary) and formula.op in "+-":
            result = self._snapped(result)
        if self.values[result].kind != "number":
            raise UnsuitableError
        self.kept.append(result)
        self.effect(Effect("keep", result, number))

    def _cell(self, node: CellRef) -> int:
        area = area_read(node, self.block, self.sheets)
        if area is None:
            raise UnsuitableError
        if area.rows > 1:
            return self._column(area)
        place = self.layout.place(area.sheet, area.row, area.col)
        if place < 0 or self._covering(area) is not None:
            raise UnsuitableError
        self.cells.add(place)
        return self.value("cell", (), place)

    def _covering(self, area: Area) -> int | None:
        """The column of the loop that computes the last cell of an area."""
        last = area.row + area.rows - 1
        for number in self._places.get((area.sheet, area.col), ()):
            block = self.blocks[number].block
            if block.row <= last < block.row + block.rows:
                return number
        return None

    def _column(self, area: Area) -> int:
        number = self._covering(area)
        if number is None:
            return self._elsewhere(area)
        above = self.blocks[number].block.row - area.row
        if above == 0:
            return self.kept[number]
        if not 0 < above <= MOST_ABOVE:
            raise UnsuitableError
        self.above.add((number, above))
        return self.value("above", (), (number, above), True)

    def _elsewhere(self, area: Area) -> int:
        """A column that is there before the loop starts."""
        column = self.layout.columns[area.sheet].get(area.col)
        band = None if column is None else column.band_at(area.row)
        if band is None or area.row + area.rows > band.row + band.rows:
            raise UnsuitableError
        place = band.offset + area.row - band.row
        self.columns.add(place)
        return self.value("column", (), place, True)
