"""Workbooks that somebody has edited, made for tests: the same workbook with other cells, every value fitting."""

from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path

from mechsheet.checking.edited.edits import Edits, edits_of
from mechsheet.checking.edited.expected import expected_for
from mechsheet.checking.inputs import description_in
from mechsheet.compiled.evaluation import book_of, computed
from mechsheet.description import load
from mechsheet.dynamics.solve import solve
from mechsheet.formats import write
from mechsheet.formula.nodes import Node, shifted
from mechsheet.formula.parser import parse_formula
from mechsheet.formula.references import parse_cell
from mechsheet.sheet.layout import lay_out
from mechsheet.sheet.workbook import Cell, Fill, Sheet, Workbook

TEMPLATES = Path(__file__).parent.parent.parent / "templates"


@cache
def laid_out(name):
    """(workbook, plan) of a template; both are only read."""
    mechanism = load(TEMPLATES / f"{name}.toml")
    return lay_out(mechanism, solve(mechanism))


def edited(workbook: Workbook, **cells: object) -> Workbook:
    """With other cells: `Positions_D9=3.5` a number, `"=A1"` a formula, None an emptied cell."""
    for place, content in cells.items():
        title, _, name = place.rpartition("_")
        sheets = tuple(_edited(sheet, name, content) if sheet.title == title else sheet for sheet in workbook.sheets)
        assert sheets != workbook.sheets, place
        workbook = replace(workbook, sheets=sheets)
    return workbook


def _edited(sheet: Sheet, name: str, content: object) -> Sheet:
    row, col = parse_cell(name)
    cells = tuple(cell for cell in sheet.cells if (cell.row, cell.col) != (row, col))
    fills = tuple(piece for fill in sheet.fills for piece in _without(fill, row, col))
    if isinstance(content, str) and content.startswith("="):
        fills = (*fills, Fill(row, col, parse_formula(content[1:])))
    elif content is not None:
        cells = (*cells, Cell(row, col, content))
    return replace(sheet, cells=cells, fills=fills)


def _without(fill: Fill, row: int, col: int) -> list[Fill]:
    down, right = row - fill.row, col - fill.col
    if not (0 <= down < fill.rows and 0 <= right < fill.cols):
        return [fill]
    assert fill.cols == 1, "a column is enough"
    pieces = [(0, down), (down + 1, fill.rows - down - 1)]
    return [
        replace(fill, row=fill.row + start, rows=rows, formula=shifted(fill.formula, start))
        for start, rows in pieces
        if rows
    ]


def with_column(workbook: Workbook, title: str, col: int, change) -> Workbook:
    """With another formula in a whole column."""

    def new(fill: Fill) -> Fill:
        formula: Node = change(fill.formula) if fill.col == col and fill.rows > 1 else fill.formula
        return replace(fill, formula=formula)

    sheets = tuple(
        replace(sheet, fills=tuple(map(new, sheet.fills))) if sheet.title == title else sheet
        for sheet in workbook.sheets
    )
    assert sheets != workbook.sheets
    return replace(workbook, sheets=sheets)


def saved(workbook: Workbook, path: Path) -> Path:
    """The file, every formula with its value."""
    write(computed(workbook), path)
    return path


def audited(workbook: Workbook) -> Edits:
    """What somebody edited, without a file and without values."""
    book = book_of(workbook)
    text = description_in(book)
    assert text is not None
    return edits_of(book, expected_once(text))


expected_once = lru_cache(maxsize=8)(lambda text: expected_for(text, "inside"))
