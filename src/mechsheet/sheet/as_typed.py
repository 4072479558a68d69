"""Formulas as people type them: numbers of 15 digits, no -0, and sums of degrees that are added as they are.

Excel reads no more digits of a number in a formula, and keeps no more of one that is typed. So the numbers are rounded
before the workbook is computed: what is stored beside a formula is what every program computes from the file.

Angles read as in a sheet made by hand: `θ14 = φ − ψ` is `=F14-G14`.
"""

from __future__ import annotations

import math
from dataclasses import replace

from livesheet.formula.nodes import Binary, Call, Node, Number, Unary, transform, walk
from livesheet.workbook import Cell, Conditional, Sheet, Validation, Workbook

DIGITS = 15


def typed(value: float) -> float:
    """The number that remains when `value` is typed into a cell: rounded to 15 digits, 0 for -0."""
    return float(f"{value:.{DIGITS}g}") + 0.0


def with_typed_constants(workbook: Workbook) -> Workbook:
    """The workbook with all its constants, in cells, formulas, rules and functions, as they can be typed."""
    return replace(
        workbook,
        sheets=tuple(_sheet(sheet) for sheet in workbook.sheets),
        functions=tuple(replace(function, formula=_formula(function.formula)) for function in workbook.functions),
    )


def _sheet(sheet: Sheet) -> Sheet:
    return replace(
        sheet,
        cells=tuple(_cell(cell) for cell in sheet.cells),
        fills=tuple(replace(fill, formula=_formula(fill.formula)) for fill in sheet.fills),
        validations=tuple(_validation(rule) for rule in sheet.validations),
        conditionals=tuple(_conditional(rule) for rule in sheet.conditionals),
    )


def _cell(cell: Cell) -> Cell:
    return replace(cell, content=typed(cell.content)) if isinstance(cell.content, float) else cell


def _validation(rule: Validation) -> Validation:
    low, high = (None if node is None else _formula(node) for node in (rule.low, rule.high))
    return replace(rule, low=low, high=high)


def _conditional(rule: Conditional) -> Conditional:
    return replace(rule, condition=_formula(rule.condition))


def _formula(formula: Node) -> Node:
    # Looking is quicker than building anew, and few formulas hold such a number.
    for node in walk(formula):
        if isinstance(node, Number) and _typed_number(node) is not node:
            return transform(formula, _typed_number)
    return formula


def _typed_number(node: Node) -> Node:
    if not isinstance(node, Number):
        return node
    value = typed(node.value)
    # Told apart by their texts: 0 and -0 are equal.
    return node if repr(value) == repr(float(node.value)) else Number(value)


HALF_TURN = 180.0


def in_degrees(node: Node) -> Node:
    """An angle given in radians, in degrees: each branch and each term for itself."""
    match node:
        case Call("NA", ()):
            return node
        case Call("IF", (test, one, other)):
            return Call("IF", (test, in_degrees(one), in_degrees(other)))
        case Call("IFERROR", (one, other)):
            return Call("IFERROR", (in_degrees(one), in_degrees(other)))
        case Call("RADIANS", (angle,)):
            return angle
        case Call("PI", ()):
            return Number(HALF_TURN)
        case Number(value):
            return Number(float(f"{math.degrees(value):.15g}"))
        case Unary(op, angle) if reads_degrees(angle):
            return Unary(op, in_degrees(angle))
        case Binary("+" | "-" as sign, left, right) if reads_degrees(left) or reads_degrees(right):
            return Binary(sign, in_degrees(left), in_degrees(right))
        case Binary("*", left, right) if reads_degrees(right):
            return _product(left, in_degrees(right))
        case Binary("*", left, right) if reads_degrees(left):
            return _product(in_degrees(left), right)
        case Binary("/", left, Number(count)) if reads_degrees(left):
            return _parted(in_degrees(left), count)
    return Call("DEGREES", (node,))


def degrees_together(node: Node) -> Node:
    """RADIANS(a) + RADIANS(b) as RADIANS(a + b)."""
    match node:
        case Binary("+" | "-" as sign, Call("RADIANS", (one,)), Call("RADIANS", (other,))):
            return Call("RADIANS", (Binary(sign, one, other),))
    return node


def _product(left: Node, right: Node) -> Node:
    """Of two numbers one: 3 * 180 is 540."""
    match left, right:
        case Number(one), Number(other):
            return Number(one * other)
    return Binary("*", left, right)


def _parted(angle: Node, count: float) -> Node:
    """A part of an angle; of a number of degrees it is a number."""
    match angle:
        case Number(value):
            return Number(value / count)
        case Binary("*", Number(value), factor):
            return Binary("*", Number(value / count), factor)
        case Binary("*", factor, Number(value)):
            return Binary("*", Number(value / count), factor)
    return Binary("/", angle, Number(count))


def reads_degrees(node: Node) -> bool:
    """Whether a tree is an angle that is read from cells in degrees."""
    match node:
        case Call("RADIANS", _) | Call("PI", ()):
            return True
        case Unary(_, angle):
            return reads_degrees(angle)
        case Binary("+" | "-" | "*", left, right):
            return reads_degrees(left) or reads_degrees(right)
        case Binary("/", left, Number()):
            return reads_degrees(left)
    return False
