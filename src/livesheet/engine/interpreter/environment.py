"""What an evaluation knows of the book beyond the values of its cells: functions, formulas, and what has been computed."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

from ...diagnostics import Fault
from ...formula.book import Book
from ...formula.nodes import FunctionRef, Node, Scalar
from ...formula.references import cell_address
from ...said import say
from ..kernels.arithmetic import FAST, Arithmetic
from ..layout import Area
from .budget import Budget

_MOST = 100
"""Cells of which the same is remarked."""


def _no_reference(text: str, in_a1: bool, sheet: str, row: int, col: int) -> Node | None:
    del text, in_a1, sheet, row, col
    return None


def _all_there(area: Area, but: Collection[int]) -> None:
    del area, but


@dataclass(slots=True)
class Environment:
    """`reference` reads a text as a reference; `check` raises NotReadyError for cells of an area that are not computed yet
    and not of some producers.

    arithmetic  which code the elementary functions have
    closely  whether every cell that is read is checked, not only those that no formula names
    sizes    the size that each dynamic array has, by its block
    remarks  what could not be computed as it is meant, with its cell
    budget   how much work formulas have been
    kept     formulas that could not be computed, (sheet, row, column)
    """

    book: Book = field(default_factory=lambda: Book([]))
    functions: Mapping[FunctionRef, Node] = field(default_factory=dict)
    reference: Callable[[str, bool, str, int, int], Node | None] = _no_reference
    check: Callable[[Area, Collection[int]], None] = _all_there
    arithmetic: Arithmetic = FAST
    closely: bool = False
    sizes: dict[int, tuple[int, int]] = field(default_factory=dict)
    remarks: list[Fault] = field(default_factory=list)
    budget: Budget = field(default_factory=Budget)
    kept: set[tuple[int, int, int]] = field(default_factory=set)
    _said: dict[str, int] = field(default_factory=dict)

    def need(self, area: Area) -> None:
        """Raise NotReadyError when not all cells of an area have been computed."""
        self.check(area, ())

    def stored(self, sheet: int, row: int, col: int) -> Scalar:
        """The value that the file holds for a formula, None where it holds none."""
        return self.book.sheets[sheet].cached.get(row, col) if sheet < len(self.book.sheets) else None

    def remark(self, message: str, sheet: int, row: int, col: int) -> None:
        """Note what could not be computed in a cell."""
        place = cell_address(self.book.sheets[sheet].title, row, col) if sheet < len(self.book.sheets) else ""
        said = self._said[message] = self._said.get(message, 0) + 1
        if said <= _MOST:
            fault = Fault(
                say("{message} (and more cells)", message=message) if said == _MOST else message,
                file=self.book.source,
                key=place,
            )
            if fault not in self.remarks:
                self.remarks.append(fault)
