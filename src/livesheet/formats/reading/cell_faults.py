"""What is wrong with the cells of a sheet while it is read."""

from __future__ import annotations

from livesheet.diagnostics import Fault, FormulaError
from livesheet.formula.nodes import Node
from livesheet.formula.parser import parse_formula
from livesheet.formula.references import area_name
from livesheet.said import say

MAX_FAULTS = 100
"""Most faults that one sheet reports: a file of another kind would have one for each cell."""
MAX_FORMULA = 1 << 16
"""Most characters of a formula: Excel takes 8,192, the files spell some of them longer."""
_SHOWN = 60

Area = tuple[int, int, int, int]
"""Row, column, rows, columns."""


class CellFaults:
    """The faults and remarks of one sheet, each with its cells; formulas are parsed here, where most remarks come from.

    dialect  the spelling of the formulas, as `parse_formula` names it
    found    what refuses the file;  remarks  what is read in another way than it is meant
    """

    def __init__(self, file: str, title: str, dialect: str) -> None:
        self.file, self.title, self.dialect = file, title, dialect
        self.found: list[Fault] = []
        self.remarks: list[Fault] = []

    def note(self, message: str, row: int, col: int, hint: str = "") -> None:
        """Note what is wrong with a cell."""
        if len(self.found) < MAX_FAULTS:
            self.found.append(self._fault(message, (row, col, 1, 1), hint))

    def remark(self, message: str, area: Area, hint: str = "") -> None:
        """Note what is not as it is meant in the cells of `area`."""
        if len(self.remarks) < MAX_FAULTS:
            self.remarks.append(self._fault(message, area, hint))

    def _fault(self, message: str, area: Area, hint: str) -> Fault:
        return Fault(message, file=self.file, key=f"{self.title}!{area_name(*area)}", hint=hint)

    def formula(self, text: str, area: Area) -> Node | None:
        """The tree of a formula. None when it cannot be parsed, which is remarked: its cells keep their stored values."""
        if len(text) > MAX_FORMULA:
            self.remark(
                say("a formula of {count} characters, which is not read: stored values are kept", count=len(text)), area
            )
            return None
        try:
            return parse_formula(text, self.dialect)
        except FormulaError as problem:
            fault = problem.faults[0]
            text = text.removeprefix("=")
            shown = text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
            self.remark(
                say("{message} of ={shown}: stored values are kept", message=fault.message, shown=shown),
                area,
                fault.hint,
            )
            return None
