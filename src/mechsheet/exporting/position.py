"""One position as the engine computes it: the value of every quantity of the equations list."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mechsheet.model import Mechanism
from mechsheet.plotting.sampling import Sample, sample
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.lowering import Assignments
from mechsheet.sheet.plan import Plan


@dataclass(frozen=True, slots=True)
class Position:
    """A row of a computed workbook."""

    sample: Sample
    row: int

    @property
    def plan(self) -> Plan:
        """Where everything stands."""
        return self.sample.plan

    @property
    def equations(self) -> Assignments:
        """The equations that the workbook was laid out from."""
        return self.sample.plan.equations

    def value(self, symbol: str) -> float:
        """A quantity in internal units: dimension, constant, mode, driver or column. NaN where it has no number."""
        spot = self.plan.at.spots[symbol]
        number = self.number(spot)
        return math.radians(number) if spot.degrees else number

    def number(self, spot: Spot) -> float:
        """What stands in a cell, or in this row of a column; NaN for anything but a number."""
        row = self.plan.at.first + self.row if spot.column else spot.row
        sheet = self.sample.workbook.sheet(spot.sheet)
        for fill in sheet.fills:
            if fill.row <= row < fill.row + fill.rows and fill.col <= spot.col < fill.col + fill.cols:
                value = fill.value(row, spot.col)
                return value if isinstance(value, float) else math.nan
        for cell in sheet.cells:
            if (cell.row, cell.col) == (row, spot.col) and isinstance(cell.content, float):
                return cell.content
        return math.nan


def position_at(mechanism: Mechanism, at: float | None) -> Position:
    """The position at a value of the driver in its own unit, or the first that exists.

    Raises MechanismError when there is none.
    """
    found = sample(mechanism, at, None)
    return Position(found, found.shown)
