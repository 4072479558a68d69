"""The plain export of a description, laid out in the ways in which people lay out a table."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from homework.plain_export import plain_book
from livesheet.formula.book import Block, Book, BookSheet, DefinedName
from livesheet.formula.nodes import CellRef, NameRef, Node, transform
from mechsheet.homework.formula_strips import turned
from mechsheet.model import Mechanism


def _top(book: Book) -> int:
    """The row of the headings."""
    return min(block.row for block in book.sheets[0].blocks if block.rows > 3) - 1


def _anchored(part: Node) -> bool:
    return isinstance(part, CellRef) and part.row_abs and part.col_abs


def across(book: Book) -> Book:
    """The table to the right."""
    (sheet,) = book.sheets
    found = BookSheet(sheet.title)
    for row, col, value in sheet.constants.items():
        found.constants.put(col, row, value)
    found.blocks = [Block(b.col, b.row, b.cols, b.rows, turned(b.formula)) for b in sheet.blocks]
    return Book([found])


def two_sheets(book: Book) -> Book:
    """Dimensions on one sheet, the table on another."""
    (sheet,) = book.sheets
    top = _top(book)
    given, table = BookSheet("Veri"), BookSheet("Tablo")
    for row, col, value in sheet.constants.items():
        (given if row < top else table).constants.put(row, col, value)

    def change(part: Node) -> Node:
        return replace(part, sheet="Veri") if isinstance(part, CellRef) and _anchored(part) else part

    for block in sheet.blocks:
        if block.row < top:
            given.blocks.append(block)
        else:
            table.blocks.append(replace(block, formula=transform(block.formula, change)))
    return Book([given, table])


def names(book: Book) -> Book:
    """The dimensions by names."""
    (sheet,) = book.sheets
    top = _top(book)
    found = BookSheet(sheet.title)
    called: dict[int, str] = {}
    for row, col, value in sheet.constants.items():
        found.constants.put(row, col, value)
        if col == 0 and row < top and isinstance(value, str):
            called[row] = "v_" + value.replace(".", "_")

    def change(part: Node) -> Node:
        if isinstance(part, CellRef) and _anchored(part) and part.col == 1 and part.row in called:
            return NameRef(called[part.row])
        return part

    found.blocks = [replace(block, formula=transform(block.formula, change)) for block in sheet.blocks]
    places = {row: CellRef(row, 1, True, True, sheet.title) for row in called}
    return Book([found], [DefinedName(name, places[row]) for row, name in called.items()])


def turkish(book: Book) -> Book:
    """Turkish headings."""
    (sheet,) = book.sheets
    top = _top(book)
    found = BookSheet("Sayfa1", blocks=sheet.blocks)
    for row, col, value in sheet.constants.items():
        if isinstance(value, str) and row >= top:
            if value.endswith((".x", ".y")):
                value = value[-1] + value[:-2]
            elif value.startswith("theta"):
                value = f"Teta {value[5:]} (radyan)"
            elif value.startswith("s") and value[1:].isdigit():
                value = f"{value} yolu (mm)"
        found.constants.put(row, col, value)
    return Book([found])


STYLES: Mapping[str, Callable[[Mechanism], Book]] = {
    "down": plain_book,
    "to the right": lambda mechanism: across(plain_book(mechanism)),
    "two sheets": lambda mechanism: two_sheets(plain_book(mechanism)),
    "names": lambda mechanism: names(plain_book(mechanism)),
    "no headings": lambda mechanism: plain_book(mechanism, headings=False),
    "Turkish headings": lambda mechanism: turkish(plain_book(mechanism)),
}
