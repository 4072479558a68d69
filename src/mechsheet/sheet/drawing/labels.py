"""Where names stand beside their places, chosen as for pictures when the workbook is laid out.

For the positions of the description's own dimensions, or so many of them, places are looked for that lie on no line, ring or
other name; a name stays where it was in the position before as long as it covers nothing there.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import CellRef, Node, RangeRef
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Mechanism
from mechsheet.shapes.forms import Kind, Shapes
from mechsheet.shapes.positions import Positions
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import NUMBER_STYLE, Page
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.workbook import Cell

MOST = 37
"""Positions for which places are looked for: every ten degrees of a turn."""

DIGITS = 3

NONE = "–"
"""Where there is no room for a name."""

Way: TypeAlias = Node | float | str
"""How far along one axis: a formula, a number, or `NONE`."""


@dataclass(frozen=True, slots=True)
class _Solved:
    mechanism: Mechanism
    equations: Equations
    driver: Array
    values: Mapping[str, Array]


def columns_beside(page: Page, found: Shapes, vectors: Collection[Kind]) -> list[tuple[Way, Way]]:
    """Of each name how far from its place it stands in x and in y [half windows]: numbers, or what a column with a row for
    each position that was looked at has."""
    plan = page.plan
    values = plan.nominal
    solved = _Solved(plan.mechanism, plan.equations.equations, plan.given[plan.mechanism.driver.symbol], values)
    rows = np.unique(np.linspace(0, plan.rows - 1, min(MOST, plan.rows)).astype(int))
    places = np.round(Positions(solved, vectors).beside(rows.tolist(), page.letters), DIGITS) + 0.0
    position = plan.at.cell("#position", page.title, None)
    number: Node = position
    if len(rows) < plan.rows:
        step = (plan.rows - 1) / (len(rows) - 1)
        number = formula("ROUND(position/step,0)", position=position, step=step)
    return [_beside(page, name.text, places[:, index], number) for index, name in enumerate(found.names)]


def _beside(page: Page, name: str, places: Array, number: Node) -> tuple[Way, Way]:
    """Of one name: `places` (rows, 2)."""
    if len(np.unique(places, axis=0)) == 1:
        x, y = (NONE if math.isnan(place) else place for place in places[0].tolist())
        return x, y
    x, y = (
        _column(page, f"{axis} {name}", column, number) for axis, column in zip("xy", places.T.tolist(), strict=True)
    )
    return x, y


def _column(page: Page, head: str, places: Sequence[float], number: Node) -> Node:
    first, col = page.first, page.col
    page.col += 1
    page.cells.append(Cell(first - 1, col, head, styles.HEAD))
    for row, place in enumerate(places, first):
        page.cells.append(Cell(row, col, NONE if math.isnan(place) else place, NUMBER_STYLE))
    column = RangeRef(CellRef(first, col, True, True), CellRef(first + len(places) - 1, col, True, True))
    return formula("INDEX(column,number)", column=column, number=al.add(number, al.ONE))
