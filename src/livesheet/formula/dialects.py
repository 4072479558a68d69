"""How strongly operators bind in each dialect: one table each, read by the parser and by the printer.

A sheet and mathematics differ in two places. In a sheet the unary minus binds tighter than everything but the
reference operators, and `^` leans left: `-2^2` is 4, `2^3^2` is 64. In mathematics, and so in a description, `^` binds
tighter and leans right: -4 and 512.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

DialectName: TypeAlias = Literal[
    "excel", "openformula", "description", "text", "octave", "python", "latex", "numbers", "basic", "geogebra"
]

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
    small      numbers are written 1e-9, not 1E-9
    calls      function of the tree -> what is written, with {0}, {1} for the arguments; with it, no other function can be
               said, and symbols are spelt by the printer's `names`
    short      the same for a single argument that is a plain symbol
    shapes     operator -> what is written where it is no operator between two operands (a fraction, a raised exponent)
    sets_signs_apart  a sign that follows an operator gets parentheses: a - (-b)
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
    small: bool = False
    calls: dict[str, str] = field(default_factory=dict)
    short: dict[str, str] = field(default_factory=dict)
    shapes: dict[str, str] = field(default_factory=dict)
    sets_signs_apart: bool = False


COMPARISONS = dict.fromkeys(("=", "<>", "<", "<=", ">", ">="), 10)
_SHEET = {**COMPARISONS, "&": 20, "+": 30, "-": 30, "*": 40, "/": 40, "^": 50}
MATHEMATICS = {"+": 30, "-": 30, "*": 40, "/": 40, "^": 50}

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
    MATHEMATICS,
    prefix=45,
    postfix=0,
    leans_right=frozenset("^"),
    argument=", ",
    spaced=frozenset("+-"),
    small=True,
)

TEXT = Dialect(
    "text",
    {**COMPARISONS, "&": 20, **MATHEMATICS, ",": 80, " ": 90, ":": 100},
    prefix=45,
    postfix=60,
    leans_right=frozenset("^"),
    argument="; ",
    array_column="; ",
    array_row=" | ",
    spaced=frozenset(("+", "-", "&", *COMPARISONS)),
    small=True,
)
"""For people: mathematics' binding, small letters, `;` between arguments (a decimal comma may stand in numbers beside it).
Functions keep the tree's order of arguments: `atan2(x; y)` takes x first, as the cell beside the text does."""

DIALECTS: dict[str, Dialect] = {d.name: d for d in (EXCEL, OPENFORMULA, DESCRIPTION, TEXT)}
