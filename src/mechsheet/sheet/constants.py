"""Constants as a spreadsheet takes them from a keyboard: 15 digits, and no -0.

Excel reads no more digits of a number in a formula, and keeps no more of one that is typed. So the numbers are rounded
before the workbook is computed: what is stored beside a formula is what every program computes from the file.
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.nodes import Node, Number, transform, walk
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
