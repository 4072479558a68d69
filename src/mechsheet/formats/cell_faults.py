"""What is wrong with the cells of a sheet while it is read."""

from __future__ import annotations

from mechsheet.diagnostics import Fault, FormulaError
from mechsheet.formula.nodes import ErrorValue, Node
from mechsheet.formula.parser import parse_formula
from mechsheet.formula.references import cell_address

MAX_FAULTS = 100
"""Most faults that one sheet reports: a file of another kind would have one for each cell."""
_SHOWN = 60


class CellFaults:
    """The faults of one sheet, each with its cell; formulas are parsed here, because that is where most of them come from.

    dialect  the spelling of the formulas, as `parse_formula` names it
    """

    def __init__(self, file: str, title: str, dialect: str) -> None:
        self.file, self.title, self.dialect = file, title, dialect
        self.found: list[Fault] = []

    def note(self, message: str, row: int, col: int, hint: str = "") -> None:
        """Note what is wrong with a cell."""
        if len(self.found) < MAX_FAULTS:
            place = cell_address(self.title, row, col)
            self.found.append(Fault(message, file=self.file, key=place, hint=hint))

    def formula(self, text: str, row: int, col: int) -> Node:
        """The tree of a cell's formula, an error in its place when it cannot be parsed."""
        try:
            return parse_formula(text, self.dialect)
        except FormulaError as problem:
            fault = problem.faults[0]
            text = text.removeprefix("of:").removeprefix("=")
            shown = text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
            self.note(f"{fault.message} of ={shown}", row, col, fault.hint)
            return ErrorValue("#NAME?")
