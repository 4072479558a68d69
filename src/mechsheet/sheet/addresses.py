"""Where each quantity stands, and formulas bound to those places.

A `Spot` is a cell (a dimension, a constant, a mode) or a column of the table of positions (then `row` is its first row).
Angles that people read in degrees are read as RADIANS(cell), so that every formula computes in radians.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from mechsheet.formula.nodes import Call, CellRef, NameRef, Node, Previous, RangeRef, Symbol, transform


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

    spots    where formulas read a quantity (internal units, or degrees when the spot says so)
    shown    where people read it (degrees where the mechanism's angle unit is that)
    titles   sheet titles by key ("mechanism", "positions", …)
    first, last  rows of the table of positions
    """

    references: Literal["names", "anchors"]
    titles: dict[str, str]
    first: int
    last: int
    spots: dict[str, Spot] = field(default_factory=dict)
    shown: dict[str, Spot] = field(default_factory=dict)

    def reference(self, symbol: str, sheet: str, row: int | None, up: int = 0) -> Node:
        """The quantity as a formula on `sheet` reads it from table row `row` (None: a cell outside the table)."""
        return self._reading(self.spots[symbol], sheet, row, up)

    def reading_shown(self, symbol: str, sheet: str, row: int | None) -> Node:
        """The quantity as people read it: no conversion."""
        return self._cell(self.shown[symbol], sheet, row, 0)

    def _reading(self, spot: Spot, sheet: str, row: int | None, up: int) -> Node:
        cell = self._cell(spot, sheet, row, up)
        return Call("RADIANS", (cell,)) if spot.degrees else cell

    def _cell(self, spot: Spot, sheet: str, row: int | None, up: int) -> Node:
        other = None if spot.sheet == sheet else spot.sheet
        if spot.column:
            if row is None:
                raise ValueError(f"a column cannot be read from outside the table: {spot}")
            return CellRef(row - up, spot.col, sheet=other)
        if spot.name and self.references == "names":
            return NameRef(spot.name)
        return CellRef(spot.row, spot.col, True, True, other)

    def bind(self, node: Node, sheet: str, row: int | None) -> Node:
        """The tree with every symbol replaced by a reference, as a formula in `row` of `sheet` has it."""

        def change(part: Node) -> Node:
            match part:
                case Symbol(name):
                    return self.reference(name, sheet, row)
                case Previous(name):
                    return self.reference(name, sheet, row, up=1)
            return part

        return transform(node, change)

    def column(self, symbol: str, sheet: str) -> RangeRef:
        """The whole shown column of a quantity, anchored."""
        return self.area(self.shown[symbol], sheet)

    def area(self, spot: Spot, sheet: str) -> RangeRef:
        """The whole column at a spot, anchored."""
        other = None if spot.sheet == sheet else spot.sheet
        return RangeRef(
            CellRef(self.first, spot.col, True, True, other), CellRef(self.last, spot.col, True, True, other)
        )
