"""Where each quantity stands, and formulas bound to those places.

A `Spot` is a cell (a dimension, a constant, a mode) or a column of the table of positions (then `row` is its first row).
Angles that people read in degrees are read as RADIANS(cell), so that every formula computes in radians.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from livesheet.formula.nodes import Call, CellRef, NameRef, Node, Previous, RangeRef, Symbol, transform
from mechsheet.sheet.quoted import ALL, SHOWN


@dataclass(frozen=True, slots=True)
class Spot:
    """A place: a cell, or a column of `rows` rows of a table (then `row` is its first row).

    degrees  the cell holds degrees;  name: the cell's defined name, if it has one;  named: formulas read it by that name
    """

    sheet: str
    row: int
    col: int
    rows: int = 0
    degrees: bool = False
    name: str = ""
    named: bool = False

    @property
    def column(self) -> bool:
        """Whether it is a column of a table."""
        return self.rows > 0

    @property
    def cell(self) -> Node:
        """What the cell shows, as every sheet reads it: `bind` leaves the title out on its own one."""
        if self.column:
            raise ValueError(f"a column cannot be read from outside the table: {self}")
        return NameRef(self.name) if self.named else CellRef(self.row, self.col, True, True, self.sheet)

    def in_row(self, row: int) -> CellRef:
        """What the column shows in a row of its table."""
        return CellRef(row, self.col, sheet=self.sheet)

    def whole(self, sheet: str = "") -> RangeRef:
        """The whole column, anchored, as a formula on `sheet` reads it."""
        title = None if sheet == self.sheet else self.sheet
        start, end = (CellRef(row, self.col, True, True, title) for row in (self.row, self.row + self.rows - 1))
        return RangeRef(start, end)


@dataclass(frozen=True)
class Addresses:
    """Where the quantities of a workbook stand.

    spots    where a quantity stands: formulas read it there, and people
    titles   sheet titles by key ("mechanism", "positions", …)
    first, last  rows of the table of positions
    """

    titles: Mapping[str, str]
    first: int
    last: int
    spots: Mapping[str, Spot] = field(default_factory=dict)

    def beside(self, spots: Mapping[str, Spot]) -> Addresses:
        """These and further quantities, or the same ones elsewhere."""
        return replace(self, spots={**self.spots, **spots})

    def reference(self, symbol: str, sheet: str, row: int | None, above: int | None = None) -> Node:
        """The quantity in internal units as a formula on `sheet` reads it.

        row    the row that stands for one position there (None: a cell outside the table)
        above  the row to read in place of it, when the quantity of the position before is meant
        """
        cell = self.cell(symbol, sheet, row if above is None else above)
        return Call("RADIANS", (cell,)) if self.spots[symbol].degrees else cell

    def cell(self, symbol: str, sheet: str, row: int | None) -> Node:
        """The quantity as people read it: no conversion."""
        spot = self.spots[symbol]
        return at_home(spot.cell if row is None or not spot.column else spot.in_row(row), sheet)

    def bind(self, node: Node, sheet: str, row: int | None = None) -> Node:
        """The tree with every symbol replaced by a reference, as a formula in `row` of `sheet` has it.

        Quantities come in internal units (radians), `SHOWN(x)` and whole columns, `ALL(x)`, as people read them (see
        `quoted`). Cells of the sheet itself are read without its title.
        """

        def change(part: Node) -> Node:
            match part:
                case Symbol(name) if name.startswith(ALL):
                    return self.column(name.removeprefix(ALL), sheet)
                case Symbol(name) if name.startswith(SHOWN):
                    return self.cell(name.removeprefix(SHOWN), sheet, row)
                case Symbol(name):
                    return self.reference(name, sheet, row)
                case Previous(name):
                    return self.reference(name, sheet, row, above=None if row is None else row - 1)
                case CellRef():
                    return at_home(part, sheet)
            return part

        return transform(node, change)

    def column(self, symbol: str, sheet: str) -> RangeRef:
        """The whole column of a quantity, anchored."""
        return self.spots[symbol].whole(sheet)


def at_home(part: Node, sheet: str) -> Node:
    """A reference as a formula on `sheet` has it: to a cell of this sheet without the title."""
    if not isinstance(part, CellRef) or part.sheet != sheet:
        return part
    return CellRef(part.row, part.col, part.row_abs, part.col_abs)  # `replace` takes twice as long
