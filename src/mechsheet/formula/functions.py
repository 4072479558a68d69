"""Every spreadsheet function that the program knows: one row each. `engine/kernels.py` has the array code of the same names.

Arities are Excel's. A row is written for the reader of a formula (near misses, too few arguments), for the printers (the two
spellings) and for the engine (`evaluated`); the manual's list of functions can be printed from it.
"""

from __future__ import annotations

from dataclasses import dataclass

MANY = 255
"""Excel's limit of arguments."""


@dataclass(frozen=True, slots=True)
class Function:
    """One function.

    name       as in the tree: Excel's English name
    least, most  how many arguments it takes
    ooxml      how an .xlsx spells it (`_xlfn.` before functions younger than the format)
    odf        how OpenFormula spells it
    volatile   recalculated at every change, whatever changed
    note       what is worth knowing about arguments or differences between programs
    """

    name: str
    least: int
    most: int
    ooxml: str
    odf: str
    volatile: bool = False
    note: str = ""


def _row(
    name: str,
    least: int,
    most: int | None = None,
    *,
    ooxml: str = "",
    odf: str = "",
    volatile: bool = False,
    note: str = "",
) -> Function:
    return Function(name, least, least if most is None else most, ooxml or name, odf or name, volatile, note)


_ROWS = (
    # logic and information
    _row("IF", 1, 3, note="only the branch taken can make an error"),
    _row("IFERROR", 2),
    _row("IFNA", 2, ooxml="_xlfn.IFNA"),
    _row("AND", 1, MANY, note="texts and blanks in ranges are ignored"),
    _row("OR", 1, MANY, note="texts and blanks in ranges are ignored"),
    _row("NOT", 1),
    _row("NA", 0),
    _row("ISNUMBER", 1),
    _row("ISTEXT", 1),
    _row("ISLOGICAL", 1),
    _row("ISBLANK", 1),
    _row("ISNA", 1),
    _row("ISERR", 1, note="every error but #N/A"),
    _row("ISERROR", 1),
    _row("N", 1),
    _row("T", 1),
    # trigonometry
    _row("PI", 0),
    _row("SIN", 1),
    _row("COS", 1),
    _row("TAN", 1),
    _row("ASIN", 1, note="#NUM! outside -1..1"),
    _row("ACOS", 1, note="#NUM! outside -1..1"),
    _row("ATAN", 1),
    _row("ATAN2", 2, note="x first, then y; ATAN2(0,0) is #DIV/0! (0 in LibreOffice)"),
    _row("SINH", 1),
    _row("COSH", 1),
    _row("TANH", 1),
    _row("ASINH", 1),
    _row("ACOSH", 1),
    _row("ATANH", 1),
    _row("RADIANS", 1),
    _row("DEGREES", 1),
    # arithmetic
    _row("SQRT", 1),
    _row("SUMSQ", 1, MANY),
    _row("ABS", 1),
    _row("SIGN", 1),
    _row("EXP", 1),
    _row("LN", 1),
    _row("LOG", 1, 2),
    _row("LOG10", 1),
    _row("POWER", 2, note="a root of a negative number is #NUM! (LibreOffice takes odd roots)"),
    _row("MOD", 2, note="has the sign of the divisor"),
    _row("INT", 1, note="downwards"),
    _row("ROUND", 2, note="halves away from zero"),
    _row("ROUNDUP", 2),
    _row("ROUNDDOWN", 2),
    _row("TRUNC", 1, 2),
    _row("FLOOR", 2, odf="COM.MICROSOFT.FLOOR"),
    _row("CEILING", 2, odf="COM.MICROSOFT.CEILING"),
    # aggregation
    _row("SUM", 0, MANY),
    _row("PRODUCT", 1, MANY),
    _row("AVERAGE", 1, MANY),
    _row("MIN", 1, MANY),
    _row("MAX", 1, MANY),
    _row("COUNT", 1, MANY),
    _row("COUNTA", 1, MANY),
    _row("COUNTBLANK", 1),
    _row("COUNTIF", 2),
    _row("SUMIF", 2, 3),
    _row("AVERAGEIF", 2, 3),
    _row("COUNTIFS", 2, MANY),
    _row("SUMIFS", 3, MANY),
    _row("AVERAGEIFS", 3, MANY),
    _row("MINIFS", 3, MANY, ooxml="_xlfn.MINIFS", odf="COM.MICROSOFT.MINIFS"),
    _row("MAXIFS", 3, MANY, ooxml="_xlfn.MAXIFS", odf="COM.MICROSOFT.MAXIFS"),
    _row("SUMPRODUCT", 1, MANY),
    _row("MEDIAN", 1, MANY),
    _row("LARGE", 2),
    _row("SMALL", 2),
    _row("AGGREGATE", 3, MANY, ooxml="_xlfn.AGGREGATE", odf="COM.MICROSOFT.AGGREGATE"),
    # look-up
    _row("INDEX", 2, 4),
    _row("MATCH", 2, 3),
    _row("CHOOSE", 2, MANY),
    _row("LOOKUP", 2, 3),
    _row("VLOOKUP", 3, 4),
    _row("HLOOKUP", 3, 4),
    _row("ROW", 0, 1),
    _row("COLUMN", 0, 1),
    _row("ROWS", 1),
    _row("COLUMNS", 1),
    # text
    _row("TEXT", 2),
    _row("FIXED", 1, 3),
    _row("VALUE", 1),
    _row("CONCATENATE", 1, MANY),
    _row("CONCAT", 1, MANY, ooxml="_xlfn.CONCAT", odf="COM.MICROSOFT.CONCAT"),
    _row("LEN", 1),
    _row("LEFT", 1, 2),
    _row("RIGHT", 1, 2),
    _row("MID", 3),
    _row("REPT", 2),
    _row("UPPER", 1),
    _row("LOWER", 1),
    _row("TRIM", 1),
    _row("EXACT", 2),
)

FUNCTIONS = {row.name: row for row in _ROWS}
"""Name in the tree -> its row."""

_PREFIXES = ("_XLFN.", "_XLWS.", "COM.MICROSOFT.", "ORG.OPENOFFICE.", "ORG.LIBREOFFICE.")
_BY_ODF = {row.odf: row.name for row in _ROWS}


def canonical_name(spelling: str, dialect: str = "excel") -> str:
    """The tree's name of a function spelt in a file: `_xlfn.IFNA` is IFNA. Unknown names come back in capitals."""
    name = spelling.upper()
    if dialect == "openformula" and name in _BY_ODF:
        return _BY_ODF[name]
    found = True
    while found:
        found = False
        for prefix in _PREFIXES:
            if name.startswith(prefix):
                name, found = name[len(prefix) :], True
    return name


def spelling(name: str, dialect: str) -> str:
    """How `dialect` ("excel" or "openformula") spells a function of the tree; a name that is not known stays as it is."""
    row = FUNCTIONS.get(name)
    if row is None:
        return name
    return row.odf if dialect == "openformula" else row.ooxml
