"""Where the names of the points stand in the drawing: on that side of the point where no link leaves it.

Of eight directions u the one is taken whose largest cosine with the directions n to the point's neighbours is smallest,

    score(u) = max over neighbours of  u . n / |n|,

plus a little that grows from direction to direction, lest rounding decide between equals. So a name moves round its
point as the mechanism moves, and never lies on a link of that point.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, Number, RangeRef
from livesheet.workbook import Fill
from mechsheet.model import Mechanism
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import EIGHTH, FIRST, NAME, NINTH, NUMBER_STYLE, SEVENTH, Page
from mechsheet.sheet.drawing.outlines import block_point
from mechsheet.sheet.drawing.points import PointCells, labelled_points
from mechsheet.sheet.drawing.shapes import Guide
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.symbols import rich

DIRECTIONS = (45, 135, 90, 0, 180, 315, 225, 270)
"""In degrees; of equally free ones the first is taken."""

PREFERENCE = 1e-4
"""What each direction's score is raised by over that of the one before."""

FEW = 3
"""Of a point with more neighbours the distances stand in cells of their own: its score stays short enough to be read."""

MOST = 16
"""Neighbours that a name keeps clear of: twice as many as there are directions. Of links with more points joints first."""

REACH, BLOCK_REACH = 0.085, 0.125
"""How far from its point a name stands: from a joint, and from a sliding block."""

SUPPORT_SIDES = (225.0, 270.0, 315.0)
"""Directions in which the support of a fixed pin lies."""


def place_names(page: Page, cells: Mapping[str, PointCells], guides: Sequence[Guide]) -> None:
    """The scores of the directions, and from them the names' places in the table of points."""
    mechanism, text = page.plan.mechanism, page.plan.text
    page.section(text("drawing.names"))
    first = page.row
    for name, function in (("cos", portable.cos), ("sin", portable.sin)):
        page.put(NAME, name)
        for n, direction in enumerate(DIRECTIONS):
            page.put(FIRST + n, round(function(math.radians(direction)), 6) + 0.0, NUMBER_STYLE)
        page.row += 1
    page.put(NAME, "+")
    for n in range(len(DIRECTIONS)):
        page.put(FIRST + n, n * PREFERENCE, NUMBER_STYLE)
    page.row += 1
    cosines, sines = _across(first), _across(first + 1)
    c, s, handicap = (CellRef(first + n, FIRST, row_abs=True) for n in range(3))
    for name in labelled_points(mechanism):
        here = cells[name]
        page.put(NAME, rich(name), styles.SYMBOL)
        neighbours = [cells[other] for other in _neighbours(mechanism, name)]
        lengths = [_distance(here, other) for other in neighbours]
        if len(lengths) > FEW:
            lengths = [page.formula(FIRST + n, length) for n, length in enumerate(lengths)]
            page.row += 1
            page.put(NAME, rich(name), styles.SYMBOL)
        terms = [_cosine(here, other, length, c, s) for other, length in zip(neighbours, lengths, strict=True)]
        at_block = [guide for guide in guides if block_point(mechanism, guide.joint) == name]
        for guide in at_block:
            along = al.add(al.mul(guide.cosine, c), al.mul(guide.sine, s))
            terms.append(formula("ABS(along)", along=along))
        if name in mechanism.ground.points:
            terms += [_fixed(math.radians(side), c, s) for side in SUPPORT_SIDES]
        # Rounded, so that of equally free directions every program takes the same.
        score = al.add(al.largest(terms), handicap) if terms else handicap
        page.fills.append(Fill(page.row, FIRST, score, NUMBER_STYLE, cols=len(DIRECTIONS)))
        scores = _across(page.row)
        row = here.x.row
        least = formula("MATCH(MIN(scores),scores,0)", scores=scores)
        side = page.formula(SEVENTH, least, styles.decimals(styles.INNER, 0), row)
        # gnumeric takes the number after a range of one row for that of a row: both are given.
        reach = Number(BLOCK_REACH if at_block else REACH)
        for col, place, parts in ((EIGHTH, here.chart_x, cosines), (NINTH, here.chart_y, sines)):
            there = formula("place+reach*INDEX(parts,1,side)", place=place, reach=reach, parts=parts, side=side)
            page.formula(col, there, row=row)
        page.row += 1


def _across(row: int) -> RangeRef:
    return RangeRef(CellRef(row, FIRST, True, True), CellRef(row, FIRST + len(DIRECTIONS) - 1, True, True))


def _neighbours(mechanism: Mechanism, name: str) -> tuple[str, ...]:
    """Points that share a moving link with this one; of many, some: a cell for each pair of thousands is in nobody's use."""
    links = [link for link in mechanism.links[1:] if name in link.points]
    found = tuple(dict.fromkeys(point for link in links for point in link.points if point != name))
    if len(found) <= MOST:
        return found
    joints = {point for point in found if sum(point in link.points for link in mechanism.links) > 1}
    return tuple(sorted(found, key=lambda point: point not in joints)[:MOST])


def _distance(here: PointCells, other: PointCells) -> Node:
    """How far another point is, not quite 0."""
    dx, dy = al.sub(other.chart_x, here.chart_x), al.sub(other.chart_y, here.chart_y)
    return formula("MAX(least,SQRT(dx^2+dy^2))", least=1e-9, dx=dx, dy=dy)


def _cosine(here: PointCells, other: PointCells, length: Node, c: Node, s: Node) -> Node:
    """Cosine of the angle between the direction (c, s) and the way to another point, which is so far."""
    dx, dy = al.sub(other.chart_x, here.chart_x), al.sub(other.chart_y, here.chart_y)
    return al.div(al.add(al.mul(dx, c), al.mul(dy, s)), length)


def _fixed(direction: float, c: Node, s: Node) -> Node:
    x, y = round(portable.cos(direction), 6), round(portable.sin(direction), 6)
    return al.add(al.mul(al.number(x), c), al.mul(al.number(y), s))
