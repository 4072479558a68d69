"""A description written out as by hand: dimensions, one column a quantity, no checks, no helper sheets."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from livesheet.formula.book import Block, Book, BookSheet
from livesheet.formula.nodes import (
    Binary,
    Call,
    CellRef,
    Direction,
    Node,
    Number,
    Symbol,
    TriangleAngle,
    symbols,
    transform,
)
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equation
from mechsheet.kinematics.solve import solve
from mechsheet.model import Mechanism

Angle = Callable[[Node, Callable[[Node], CellRef]], Node]
"""How the angle with a given cosine is written; the second argument gives a formula a column, and that column's cell."""


def by_arc_cosine(cosine: Node, _: Callable[[Node], CellRef]) -> Node:
    """As the text has it."""
    return Call("ACOS", (cosine,))


def plain_book(mechanism: Mechanism, headings: bool = True, degrees: bool = True, angle: Angle = by_arc_cosine) -> Book:
    """The workbook: inputs in column B, derived ones below, from there the table, angles in radians but for the driver's."""
    equations = solve(mechanism)
    sheet = BookSheet("Sheet1")
    cells: dict[str, Node] = {}
    modes = {group.mode: Number(float(group.mode_value)) for group in equations.groups if group.mode}
    numbers = dimension_values(mechanism)

    def put(row: int, symbol: str, content: float | Node) -> None:
        sheet.constant(row, 0, symbol)
        if isinstance(content, float):
            sheet.constant(row, 1, content)
        else:
            sheet.blocks.append(Block(row, 1, 1, 1, written(content, cells, modes, lambda c: Call("ACOS", (c,)))))
        cells[symbol] = CellRef(row, 1, True, True)

    row = 1
    for dim in mechanism.dimensions:
        put(row, dim.symbol, numbers[dim.symbol] if not dim.derived else dim.value)
        row += 1
    for equation in equations.constants:
        if equation.symbol not in cells:
            put(row, equation.symbol, equation.expression)
            row += 1
    top = row + 3
    driver = driver_values(mechanism, numbers)
    turns = not mechanism.driver.joint and degrees
    for number, value in enumerate(driver):
        sheet.constant(top + number, 0, float(value * 180 / 3.141592653589793 if turns else value))
    columns = _wanted(equations.columns)
    symbol = mechanism.driver.symbol
    cells[symbol] = CellRef(top, 0, False, True)
    if headings:
        sheet.constant(top - 1, 0, symbol)
    col = 1
    if turns:
        sheet.blocks.append(Block(top, 1, len(driver), 1, Call("RADIANS", (cells[symbol],))))
        cells[symbol] = CellRef(top, 1, False, False)
        if headings:
            sheet.constant(top - 1, 1, f"{symbol} rad")
        col = 2

    def column(formula: Node, heading: str = "") -> CellRef:
        """The next column; its cell in the first row."""
        nonlocal col
        sheet.blocks.append(Block(top, col, len(driver), 1, formula))
        if headings and heading:
            sheet.constant(top - 1, col, heading)
        col += 1
        return CellRef(top, col - 1)

    for equation in columns:
        if equation.symbol != symbol:
            formula = written(equation.expression, cells, modes, lambda cosine: angle(cosine, column))
            cells[equation.symbol] = column(formula, equation.symbol)
    return Book([sheet])


def _wanted(columns: Sequence[Equation]) -> list[Equation]:
    """The quantities that people compute, and what these read."""
    roles = ("driver", "intermediate", "variable", "point", "output")
    needed: set[str] = set()
    for equation in reversed(columns):
        if equation.role in roles or equation.symbol in needed:
            needed |= {equation.symbol, *symbols(equation.expression)}
    return [equation for equation in columns if equation.symbol in needed]


def written(node: Node, cells: dict[str, Node], modes: dict[str, Node], angle: Callable[[Node], Node]) -> Node:
    """An expression of the equations as a textbook has it, for cells; `angle` writes the one with a given cosine."""

    def change(part: Node) -> Node:
        match part:
            case Symbol(name):
                return cells[name] if name in cells else modes[name]
            case Direction(y, x):
                return Call("ATAN2", (x, y))
            case TriangleAngle(opposite, beside, other):
                squares = Binary("+", Binary("^", beside, Number(2.0)), Binary("^", other, Number(2.0)))
                top = Binary("-", squares, Binary("^", opposite, Number(2.0)))
                return angle(Binary("/", top, Binary("*", Binary("*", Number(2.0), beside), other)))
            case Call("HYPOT", (x, y)):
                return Call("SQRT", (Binary("+", Binary("^", x, Number(2.0)), Binary("^", y, Number(2.0))),))
        return part

    return transform(node, change)
