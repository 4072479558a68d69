"""Formulas made ready for evaluation: names replaced by what they stand for, every reference with its sheet.

Unknown functions and names are found here, all at once.
"""

from __future__ import annotations

from dataclasses import replace

from ..diagnostics import Fault, WorkbookError, near_miss
from ..formula.book import Block, Book, DefinedName
from ..formula.dialects import MAX_NESTING
from ..formula.functions import FUNCTIONS, MANY
from ..formula.nodes import Call, CellRef, ErrorValue, NameRef, Node, Previous, Symbol, shifted, transform, walk
from ..formula.references import area_name
from .kernels import KERNELS


def resolve(book: Book) -> list[Node]:
    """The formula of every block, sheet by sheet, ready for evaluation.

    Raises WorkbookError with one fault for every unknown function, name or wrong number of arguments, naming the cells.
    A reference to a sheet that does not exist is #REF!.
    """
    resolver = _Resolver(book)
    formulas = [resolver.formula(block, sheet.title) for sheet in book.sheets for block in sheet.blocks]
    if resolver.faults:
        raise WorkbookError(resolver.faults)
    return formulas


class _Resolver:
    def __init__(self, book: Book) -> None:
        self.book = book
        self.titles = {sheet.title.casefold(): sheet.title for sheet in book.sheets}
        self.names = {(d.name.casefold(), d.sheet and d.sheet.casefold()): d for d in reversed(book.names)}
        self.faults: list[Fault] = []

    def formula(self, block: Block, sheet: str) -> Node:
        """The block's formula. Faults are collected with its cells."""
        place = f"{sheet}!{area_name(block.row, block.col, block.rows, block.cols)}"
        node = self.named(block.formula, block, sheet, place, ())
        self.examine(node, place)
        return node

    def named(self, node: Node, block: Block, sheet: str, place: str, inside: tuple[str, ...]) -> Node:
        """The tree with its names replaced and its references given their sheet."""

        def change(part: Node) -> Node:
            if isinstance(part, CellRef):
                title = self.titles.get((part.sheet or sheet).casefold())
                return replace(part, sheet=title) if title is not None else ErrorValue("#REF!")
            if not isinstance(part, NameRef):
                return part
            defined = self.find(part, sheet)
            if defined is None:
                return self.unknown_name(part, place)
            if defined.name in inside:
                self.fault(place, f"the name {defined.name} stands for itself: {' -> '.join((*inside, defined.name))}")
                return ErrorValue("#NAME?")
            if len(inside) >= MAX_NESTING:
                self.fault(place, f"names that stand for one another, more than {MAX_NESTING} deep")
                return ErrorValue("#NAME?")
            home = defined.sheet or sheet
            moved = shifted(defined.formula, block.row, block.col, wrap=True)
            return self.named(moved, block, home, place, (*inside, defined.name))

        return transform(node, change)

    def find(self, reference: NameRef, sheet: str) -> DefinedName | None:
        """The sheet's own name before the book's."""
        name = reference.name.casefold()
        return self.names.get((name, (reference.sheet or sheet).casefold())) or self.names.get((name, None))

    def unknown_name(self, reference: NameRef, place: str) -> Node:
        known = [defined.name for defined in self.book.names]
        self.fault(place, f"unknown name {reference.name}", near_miss(reference.name, known))
        return ErrorValue("#NAME?")

    def examine(self, node: Node, place: str) -> None:
        for part in walk(node):
            if isinstance(part, Call):
                self.function(part, place)
            elif isinstance(part, Symbol | Previous):
                raise TypeError(f"{place}: {part} is not bound to a cell")

    def function(self, call: Call, place: str) -> None:
        row = FUNCTIONS.get(call.name)
        if row is None or call.name not in KERNELS:
            self.fault(place, f"unknown function {call.name}", near_miss(call.name, KERNELS))
        elif not row.least <= len(call.args) <= row.most:
            at_least = "at least " if row.most == MANY else ""
            many = f"{row.least}" if row.most in (row.least, MANY) else f"{row.least} to {row.most}"
            message = f"{call.name} takes {at_least}{many} argument{'s' * (many != '1')}, found {len(call.args)}"
            self.fault(place, message)

    def fault(self, place: str, message: str, hint: str = "") -> None:
        self.faults.append(Fault(message, file=self.book.source, key=place, hint=hint))
