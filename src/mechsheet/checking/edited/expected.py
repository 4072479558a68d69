"""The workbook as the description inside a file would build it: what an edited one is held against."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from livesheet.evaluation import book_of
from livesheet.formula.book import Book
from livesheet.formula.nodes import Call
from livesheet.workbook import Workbook
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.report import located
from mechsheet.diagnostics import MechanismError
from mechsheet.sheet.layout import DESCRIPTION_SHEET
from mechsheet.sheet.plan import TOLERANCE, Plan

Inputs = dict[tuple[str, int, int], str]
"""(sheet, row, column) of each input cell -> what it holds."""


@dataclass(frozen=True, slots=True)
class Expected:
    """The workbook as data, the same as a book of constants and formulas, and where everything stands in it."""

    workbook: Workbook
    book: Book
    compiled: Compiled

    @property
    def plan(self) -> Plan:
        """Where everything is in it."""
        return self.compiled.plan

    @property
    def description_sheet(self) -> str:
        """Title of the hidden sheet that carries the description."""
        return self.plan.at.titles[DESCRIPTION_SHEET]

    def inputs(self) -> Inputs:
        """The cells that are there to be changed, and what each holds: dimensions, modes, the driver, tolerances …"""
        named = {"start": self.plan.places.start, "step": self.plan.places.step, **self.plan.at.spots}
        by_cell = {(spot.sheet, spot.row, spot.col): symbol for symbol, spot in named.items() if spot is not None}
        found = {}
        for sheet in self.workbook.sheets:
            for cell in sheet.cells:
                if not cell.style.locked and not isinstance(cell.content, str):
                    place = (sheet.title, cell.row, cell.col)
                    found[place] = by_cell.get(place, "")
        tolerated = self.plan.blocks["dimensions"].rows if self.plan.mechanism.layout == "sheets" else {}
        for symbol, row in tolerated.items():
            found[self.plan.main, row, TOLERANCE] = f"the tolerance of {symbol}"
        return found


def expected_for(text: str, file: str, functions: str = "") -> Expected:
    """What the description `text` builds; `file` is what messages call it. Raises MechsheetError.

    functions  "lambda" for the workbook whose tables call functions (`functions_in` tells)
    """
    loads(text, file=file)  # its faults name the file
    try:
        return _built(text, functions)
    except MechanismError as error:
        raise located(error, text, file) from error


@lru_cache(maxsize=1)
def _built(text: str, functions: str) -> Expected:
    """The last is kept: the .xlsx and the .ods of one description are judged one after the other."""
    compiled = Compiled(loads(text))
    if functions:
        from mechsheet.exporting.functions.workbooks import functions_workbook, in_sheets

        compiled = in_sheets(compiled)
        workbook = functions_workbook(compiled, functions)
    else:
        workbook = compiled.layout
    return Expected(workbook, book_of(workbook), compiled)


def functions_in(book: Book) -> str:
    """The form of a workbook whose names stand for functions: "lambda"; else nothing."""
    has = any(isinstance(name.formula, Call) and name.formula.name == "LAMBDA" for name in book.names)
    return "lambda" if has else ""


def inside(shown: str) -> str:
    """What messages call the description in a workbook's file."""
    return f"{shown} (description inside)"
