"""Where names stand beside their places, chosen as for pictures when the workbook is laid out.

For the positions of the description's own dimensions, or so many of them, places are looked for that lie on no line, ring or
other name; a name stays where it was in the position before as long as it covers nothing there. So a list of changes says
all: from which position on which name stands where.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from livesheet.formula.nodes import CellRef, Node, RangeRef
from livesheet.workbook import Cell
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Mechanism
from mechsheet.shapes.forms import Kind
from mechsheet.shapes.positions import Positions
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import NUMBER_STYLE, Page
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

MOST = 73
"""Positions for which places are looked for: every five degrees of a turn."""

DIGITS = 3

NONE = "–"
"""Where there is no room for a name."""


@dataclass(frozen=True, slots=True)
class _Solved:
    mechanism: Mechanism
    equations: Equations
    driver: Array
    values: Mapping[str, Array]


def as_described(plan: Plan, vectors: Collection[Kind]) -> Positions:
    """All positions with the description's own dimensions."""
    driver = plan.given[plan.mechanism.driver.symbol]
    return Positions(_Solved(plan.mechanism, plan.equations.equations, driver, plan.nominal), vectors)


def ways_beside(page: Page, positions: Positions, letters: float, name: CellRef) -> Node:
    """How far from its place the name with the number in a cell stands in x, filled right in y [half windows].

    The changes are sorted by  number rows + position,  so that one look-up finds the last before the position shown.
    """
    plan, first, left = page.plan, page.first, page.col
    changes = _changes(plan, positions, letters)
    heads = (plan.text("drawing.change"), plan.text("drawing.name.x"), plan.text("drawing.name.y"))
    page.cells += [Cell(first - 1, col, head, styles.HEAD) for col, head in enumerate(heads, left)]
    for row, (number, position, *ways) in enumerate(changes, first):
        page.cells.append(Cell(row, left, float(number * plan.rows + position), styles.decimals(styles.INNER, 0)))
        for col, way in enumerate(ways, left + 1):
            page.cells.append(Cell(row, col, NONE if math.isnan(way) else way, NUMBER_STYLE))
    page.col += len(heads)
    last = first + max(0, len(changes) - 1)
    keys = RangeRef(CellRef(first, left, True, True), CellRef(last, left, True, True))
    column = RangeRef(CellRef(first, left + 1, True), CellRef(last, left + 1, True))
    shown = plan.at.bind(there(plan.places.position).cell, page.title)
    found = formula("MATCH(name*rows+MIN(shown,rows-1),keys,1)", name=name, rows=plan.rows, shown=shown, keys=keys)
    return formula("INDEX(column,found)", column=column, found=found)


def _changes(plan: Plan, positions: Positions, letters: float) -> list[tuple[int, int, float, float]]:
    """(number of a name, counted from 1; position from which on; how far in x and in y), sorted; NaN where there is no room.

    Between two positions that were looked at the nearer one counts.
    """
    # np.unique would load numpy.ma, which nothing else here needs
    rows = sorted(set(np.linspace(0, plan.rows - 1, min(MOST, plan.rows)).astype(int).tolist()))
    places = np.round(positions.beside(rows, letters), DIGITS) + 0.0
    found = []
    for index in range(places.shape[1]):
        before = None
        for number, (x, y) in enumerate(places[:, index].tolist()):
            if str((x, y)) != before:  # NaN is NaN
                start = (rows[number - 1] + rows[number] + 1) // 2 if number else 0
                found.append((index + 1, start, x, y))
            before = str((x, y))
    return found
