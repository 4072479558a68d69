"""Where each quantity stands, and formulas bound to those places.

A `Spot` is a cell (a dimension, a constant, a mode) or a column of the table of positions (then `row` is its first row).
Angles that people read in degrees are read as RADIANS(cell), so that every formula computes in radians.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from livesheet.formula.nodes import Call, CellRef, NameRef, Node, Previous, RangeRef, Symbol, transform
from mechsheet.sheet.quoted import ALL, SHOWN


@dataclass(frozen=True, slots=True)
class Spot:
    """A quantity's place. `degrees`: the cell holds degrees. `name`: the cell's defined name, if it has one."""

    sheet: str
    row: int
    col: int
    column: bool = False
    degrees: bool = False
    name: str = ""


@dataclass
class Addresses:
    """All places of a workbook.

    spots    where a quantity stands: formulas read it there, and people
    titles   sheet titles by key ("mechanism", "positions", …)
    first, last  rows of the table of positions
    """

    references: Literal["names", "anchors"]
    titles: dict[str, str]
    first: int
    last: int
    spots: dict[str, Spot] = field(default_factory=dict)

    def reference(self, symbol: str, sheet: str, row: int | None, above: int | None = None) -> Node:
        """The quantity in internal units as a formula on `sheet` reads it.

        row    the row that stands for one position there (None: a cell outside the table)
        above  the row to read in place of it, when the quantity of the position before is meant
        """
        spot = self.spots[symbol]
        cell = self.cell(symbol, sheet, row if above is None else above)
        return Call("RADIANS", (cell,)) if spot.degrees else cell

    def cell(self, symbol: str, sheet: str, row: int | None) -> Node:
        """The quantity as people read it: no conversion."""
        spot = self.spots[symbol]
        other = None if spot.sheet == sheet else spot.sheet
        if spot.column:
            if row is None:
                raise ValueError(f"a column cannot be read from outside the table: {spot}")
            return CellRef(row, spot.col, sheet=other)
        if spot.name and self.references == "names":
            return NameRef(spot.name)
        return CellRef(spot.row, spot.col, True, True, other)

    def bind(self, node: Node, sheet: str, row: int | None = None) -> Node:
        """The tree with every symbol replaced by a reference, as a formula in `row` of `sheet` has it.

        Quantities come in internal units (radians); as people read them come those whose names begin with "#",
        `SHOWN(x)` and whole columns, `ALL(x)` (see `quoted`).
        """

        def change(part: Node) -> Node:
            match part:
                case Symbol(name) if name.startswith(ALL):
                    return self.column(name.removeprefix(ALL), sheet)
                case Symbol(name) if name.startswith(("#", SHOWN)):
                    return self.cell(name.removeprefix(SHOWN), sheet, row)
                case Symbol(name):
                    return self.reference(name, sheet, row)
                case Previous(name):
                    return self.reference(name, sheet, row, above=None if row is None else row - 1)
            return part

        return transform(node, change)

    def column(self, symbol: str, sheet: str) -> RangeRef:
        """The whole column of a quantity, anchored."""
        spot = self.spots[symbol]
        other = None if spot.sheet == sheet else spot.sheet
        last = spot.row + self.last - self.first
        return RangeRef(CellRef(spot.row, spot.col, True, True, other), CellRef(last, spot.col, True, True, other))
