"""livesheet: spreadsheet workbooks as plain data, read, written and recalculated; nothing in it knows what they are about.

>>> import livesheet
>>> from pathlib import Path
>>> book = livesheet.read(Path("budget.xlsx"))                # doctest: +SKIP
>>> livesheet.evaluate(book).get("Sheet1", 6, 1)              # doctest: +SKIP

`formula` has the expression tree with its parsers and printers, `engine` recalculates, `formats` reads and writes files,
`portable` has the functions with the same bits on every machine, `workbook` what a person will see, as data.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .on_demand import names_of

if TYPE_CHECKING:
    from .diagnostics import FormulaError, OutputError, UserError, WorkbookError
    from .engine import Live, Values, compile_book, evaluate
    from .evaluation import computed
    from .formats import read, update_values, write
    from .formula.book import Book
    from .formula.parser import parse_formula
    from .workbook import Cell, Fill, Sheet, Workbook

_HOMES = {
    "Book": "formula.book",
    "Cell": "workbook",
    "Fill": "workbook",
    "FormulaError": "diagnostics",
    "Live": "engine",
    "OutputError": "diagnostics",
    "Sheet": "workbook",
    "UserError": "diagnostics",
    "Values": "engine",
    "Workbook": "workbook",
    "WorkbookError": "diagnostics",
    "compile_book": "engine",
    "computed": "evaluation",
    "evaluate": "engine",
    "parse_formula": "formula.parser",
    "read": "formats",
    "update_values": "formats",
    "write": "formats",
}
"""Name -> module: imported when first used, as none of them needs all the others."""

__all__ = [
    "Book",
    "Cell",
    "Fill",
    "FormulaError",
    "Live",
    "OutputError",
    "Sheet",
    "UserError",
    "Values",
    "Workbook",
    "WorkbookError",
    "compile_book",
    "computed",
    "evaluate",
    "parse_formula",
    "read",
    "update_values",
    "write",
]

__getattr__ = names_of(__name__, _HOMES)
