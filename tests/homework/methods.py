"""The plain export by other methods than the arc cosine: what is right by another way is right."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from homework.plain_export import plain_book
from livesheet.engine import Values, evaluate
from livesheet.formula.book import Block, Book
from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, transform
from mechsheet.model import Mechanism

ITERATIONS = 4


class NotConvergedError(Exception):
    """Newton's method does not lead to the angle in some row, as at a dead centre: the sheet would be wrong."""


def short_pi(mechanism: Mechanism) -> Book:
    """Degrees into radians by a pi of eight digits."""

    def change(part: Node) -> Node:
        if isinstance(part, Call) and part.name == "RADIANS":
            return Binary("/", Binary("*", part.args[0], Number(3.1415926)), Number(180.0))
        return part

    book = plain_book(mechanism)
    (sheet,) = book.sheets
    sheet.blocks = [replace(block, formula=transform(block.formula, change)) for block in sheet.blocks]
    return book


def half_angle(mechanism: Mechanism) -> Book:
    """Angles of triangles by half of them: tan(x/2) = sin x / (1 + cos x), the cosine in a column of its own."""

    def angle(cosine: Node, column: Callable[[Node], CellRef]) -> Node:
        cell, one = column(cosine), Number(1.0)
        sine = Call("SQRT", (Binary("-", one, Binary("^", cell, Number(2.0))),))
        return Binary("*", Number(2.0), Call("ATAN2", (Binary("+", one, cell), sine)))

    return plain_book(mechanism, angle=angle)


def newton(mechanism: Mechanism) -> Book:
    """Angles of triangles by Newton's method on cos x = c, from typed starting values, an iteration a column.

    Raises NotConvergedError.
    """
    ways: list[tuple[int, int]] = []

    def angle(cosine: Node, column: Callable[[Node], CellRef]) -> Node:
        given = column(cosine)
        found = start = column(Call("ACOS", (given,)))
        for _ in range(ITERATIONS):
            over = Binary("-", Call("COS", (found,)), given)
            found = column(Binary("+", found, Binary("/", over, Call("SIN", (found,)))))
        ways.append((start.col, found.col))
        return found

    book = plain_book(mechanism, angle=angle)
    (sheet,) = book.sheets
    exact = evaluate(book)
    starts = {block.col: block for block in sheet.blocks if block.rows > 1}
    sheet.blocks = [b for b in sheet.blocks if b.rows == 1 or b.col not in {start for start, _ in ways}]
    wanted = {start: _numbers(exact, sheet.title, starts[start], start) for start, _ in ways}
    for start, angles in wanted.items():
        typed = [round(value, 1) or 0.1 if value == value else 1.0 for value in angles.tolist()]
        sheet.constants.extend(starts[start].row, start, typed)
    found = evaluate(book)
    for start, end in ways:
        apart = np.abs(_numbers(found, sheet.title, starts[start], end) - wanted[start])
        if not (apart[np.isfinite(wanted[start])] < 1e-6).all():
            raise NotConvergedError
    return book


def _numbers(values: Values, sheet: str, block: Block, col: int) -> np.ndarray:
    cells = [values.get(sheet, block.row + row, col) for row in range(block.rows)]
    return np.array([cell if isinstance(cell, float) else np.nan for cell in cells])


METHODS: Mapping[str, Callable[[Mechanism], Book]] = {
    "a short pi": short_pi,
    "half the angle": half_angle,
    "Newton in columns": newton,
}
