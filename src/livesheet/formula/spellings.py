"""How long a formula is for those who read it in another language: SQRT is PIERWIASTEK in Polish, KAREKÖK in Turkish.

A file holds English names. Excel counts the characters of a formula as its user reads it: one of 8,000 characters here may
have 12,000 there, and can then not be edited any more.
"""

from __future__ import annotations

from livesheet.formula.nodes import Call, Node, walk
from livesheet.formula.printer import print_formula

LONGEST_NAMES = {
    "ABS": 12, "ACOS": 7, "AND": 4, "ASIN": 7, "ATAN": 7, "ATAN2": 8, "CHOOSE": 15, "COLUMN": 11, "COS": 3, "COUNT": 12,
    "COUNTIF": 11, "COUNTIFS": 18, "DEGREES": 7, "EXP": 11, "IF": 6, "IFERROR": 11, "INDEX": 7, "INT": 13, "ISNA": 19,
    "ISNUMBER": 10, "ISTEXT": 9, "LARGE": 13, "LN": 8, "LOG10": 5, "MATCH": 13, "MAX": 6, "MIN": 6, "MOD": 7, "NA": 16,
    "NOT": 5, "OR": 5, "PI": 8, "RADIANS": 9, "ROUND": 11, "ROW": 8, "SIGN": 11, "SIN": 4, "SMALL": 13, "SQRT": 11, "SUM": 6,
    "SUMIF": 11, "SUMPRODUCT": 19, "SUMSQ": 14, "TAN": 3, "TEXT": 15, "VALUE": 11,
}  # fmt: skip
"""Characters of a function's longest name among 17 languages of Excel (bg cs da de es fi fr hu it nb nl pl pt pt-BR ru sv
tr; the lists of PhpSpreadsheet 5)."""

MORE = 8
"""So many characters longer a function may be that is not among them."""


def longest_spelling(node: Node) -> int:
    """Characters of a formula, without the equals sign, in the language where it has most."""
    return len(print_formula(node, "excel")) + extra_characters(node)


def extra_characters(node: Node) -> int:
    """By how many characters a formula is longer in the language where it has most."""
    calls = (part.name for part in walk(node) if isinstance(part, Call))
    return sum(max(0, LONGEST_NAMES.get(name, len(name) + MORE) - len(name)) for name in calls)
