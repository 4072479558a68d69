"""Where names stand beside their places, chosen as for pictures when the workbook is laid out.

For the positions of the description's own dimensions, or so many of them, places are looked for that lie on no line, ring or
other name; a name stays where it was in the position before as long as it covers nothing there.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from typing import TypeAlias

import numpy as np

from mechsheet.formula.nodes import CellRef, Node, RangeRef
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Mechanism
from mechsheet.shapes.forms import Kind
from mechsheet.shapes.positions import Positions
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import NUMBER_STYLE, Page
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.workbook import Cell

MOST = 73
"""Positions for which places are looked for: every five degrees of a turn."""

DIGITS = 3

NONE = "–"
"""Where there is no room for a name."""

Way: TypeAlias = float | str
"""How far along one axis [half windows], or `NONE`."""


@dataclass(frozen=True, slots=True)
class _Solved:
    mechanism: Mechanism
    equations: Equations
    driver: Array
    values: Mapping[str, Array]


@dataclass(frozen=True, slots=True)
class Beside:
    """How far from their places names stand.

    ways   of each name two numbers, or where they are not the same in all positions the first of its two columns of `table`
    table  a row for each position that was looked at;  row  which of them belongs to the position shown, counted from 1
    """

    ways: Sequence[tuple[Way, Way] | int]
    table: RangeRef
    row: Node


def places_beside(page: Page, vectors: Collection[Kind]) -> Beside:
    """Of all names of the list."""
    plan = page.plan
    driver = plan.given[plan.mechanism.driver.symbol]
    rows = np.unique(np.linspace(0, plan.rows - 1, min(MOST, plan.rows)).astype(int))
    positions = Positions(_Solved(plan.mechanism, plan.equations.equations, driver, plan.nominal), vectors)
    places = np.round(positions.beside(rows.tolist(), page.letters), DIGITS) + 0.0
    by_name = [places[:, index] for index in range(places.shape[1])]
    alike = [len(np.unique(each, axis=0)) == 1 for each in by_name]
    columns = count(1, 2)
    ways: list[tuple[Way, Way] | int] = [
        (_or_none(each[0, 0]), _or_none(each[0, 1])) if same else next(columns)
        for each, same in zip(by_name, alike, strict=True)
    ]
    return Beside(ways, *_table(page, [each for each, same in zip(by_name, alike, strict=True) if not same], len(rows)))


def _table(page: Page, names: Sequence[Array], count: int) -> tuple[RangeRef, Node]:
    """Two columns for each name, and which row of them belongs to the position shown."""
    plan, first, left = page.plan, page.first, page.col
    position = plan.at.cell("#position", page.title, None)
    row: Node = formula("position+1", position=position)
    if count < plan.rows:
        row = formula("ROUND(position/step,0)+1", position=position, step=(plan.rows - 1) / (count - 1))
    for places in names:
        for axis, column in zip("xy", places.T.tolist(), strict=True):
            page.cells.append(Cell(first - 1, page.col, axis, styles.HEAD))
            page.cells += [Cell(at, page.col, _or_none(place), NUMBER_STYLE) for at, place in enumerate(column, first)]
            page.col += 1
    corners = (first, left), (first + count - 1, page.col - 1)
    return RangeRef(*(CellRef(at, col, True, True) for at, col in corners)), row


def _or_none(place: float) -> float | str:
    return NONE if math.isnan(place) else place
