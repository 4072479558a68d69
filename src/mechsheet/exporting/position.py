"""One position as the engine computes it: the value of every quantity of the equations list."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mechsheet.plotting.sampling import Sample
from mechsheet.sheet.addresses import Spot


@dataclass(frozen=True, slots=True)
class Position:
    """A row of a sample's table: what the workbook shows there."""

    sample: Sample
    row: int

    def value(self, symbol: str) -> float:
        """A quantity in internal units: dimension, constant, mode, driver or column. NaN where it has no number."""
        spot = self.sample.plan.at.spots[symbol]
        number = self.number(spot)
        return math.radians(number) if spot.degrees else number

    def number(self, spot: Spot) -> float:
        """What stands in a cell, or in this row of a column; NaN for anything but a number."""
        row = self.sample.plan.at.first + self.row if spot.column else spot.row
        sheet = self.sample.workbook.sheet(spot.sheet)
        for fill in sheet.fills:
            if fill.row <= row < fill.row + fill.rows and fill.col <= spot.col < fill.col + fill.cols:
                value = fill.value(row, spot.col)
                return value if isinstance(value, float) else math.nan
        for cell in sheet.cells:
            if (cell.row, cell.col) == (row, spot.col) and isinstance(cell.content, float):
                return cell.content
        return math.nan
