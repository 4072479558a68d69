"""How strongly operators bind in each dialect: one table each, read by the parser and by the printer.

A sheet and mathematics differ in two places. In a sheet the unary minus binds tighter than everything but the
reference operators, and `^` leans left: `-2^2` is 4, `2^3^2` is 64. In mathematics, and so in a description, `^` binds
tighter and leans right: -4 and 512.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

DialectName: TypeAlias = Literal["excel", "openformula", "description", "text"]

MAX_NESTING = 64
"""How deep parentheses, functions and signs may stand inside one another: Excel's limit for functions."""


@dataclass(frozen=True, slots=True)
class Dialect:
    """Binding powers and separators.

    infix      operator of the tree -> how strongly it binds
    leans_right  operators that group from the right
    prefix     how strongly a sign binds;  postfix: how strongly `%` does (0: there is none)
    spelling   tree operator -> text, where they differ
    argument, array_column, array_row  separators
    spaced     operators that get a space on either side
    """

    name: DialectName
    infix: dict[str, int]
    prefix: int
    postfix: int
    leans_right: frozenset[str] = frozenset()
    spelling: dict[str, str] = field(default_factory=dict)
    argument: str = ","
    array_column: str = ","
    array_row: str = ";"
    spaced: frozenset[str] = frozenset()


_COMPARISONS = dict.fromkeys(("=", "<>", "<", "<=", ">", ">="), 10)
_SHEET = {**_COMPARISONS, "&": 20, "+": 30, "-": 30, "*": 40, "/": 40, "^": 50}
_MATHEMATICS = {"+": 30, "-": 30, "*": 40, "/": 40, "^": 50}

EXCEL = Dialect("excel", {**_SHEET, ",": 80, " ": 90, ":": 100}, prefix=70, postfix=60, spelling={",": "~"})
"""A union is written as a comma inside parentheses of its own; `~` for it is read because LibreOffice writes that."""

OPENFORMULA = Dialect(
    "openformula",
    {**_SHEET, ",": 80, " ": 90, ":": 100},
    prefix=70,
    postfix=60,
    spelling={",": "~", " ": "!"},
    argument=";",
    array_column=";",
    array_row="|",
)

DESCRIPTION = Dialect(
    "description",
    _MATHEMATICS,
    prefix=45,
    postfix=0,
    leans_right=frozenset("^"),
    argument=", ",
    spaced=frozenset("+-"),
)

TEXT = Dialect(
    "text",
    {**_COMPARISONS, "&": 20, **_MATHEMATICS, ",": 80, " ": 90, ":": 100},
    prefix=45,
    postfix=60,
    leans_right=frozenset("^"),
    argument="; ",
    array_column="; ",
    array_row=" | ",
    spaced=frozenset(("+", "-", "&", *_COMPARISONS)),
)
"""For people: mathematics' binding, small letters, `;` between arguments (a decimal comma may stand in numbers beside it).
Functions keep the tree's order of arguments: `atan2(x; y)` takes x first, as the cell beside the text does."""

DIALECTS: dict[str, Dialect] = {d.name: d for d in (EXCEL, OPENFORMULA, DESCRIPTION, TEXT)}
