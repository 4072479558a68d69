"""Workbooks that somebody has edited, made for tests: the same workbook with other cells, every value fitting."""

from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path

from folders import TEMPLATES
from livesheet.evaluation import book_of, computed
from livesheet.formats import write
from livesheet.formula.nodes import CellRef, ErrorValue, Node, RangeRef, shifted, transform
from livesheet.formula.parser import parse_formula
from livesheet.formula.references import parse_cell
from livesheet.workbook import Cell, Fill, Sheet, Workbook
from mechsheet.checking.edited.edits import Edits, edits_of
from mechsheet.checking.edited.inserted_rows import NOTHING
from mechsheet.checking.inputs import description_in, expected_for
from mechsheet.description import load
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.layout import lay_out


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


def moved(workbook, title, rows=NOTHING, cols=NOTHING, now=None):
    """The workbook after a spreadsheet program has inserted or deleted there, or renamed the sheet."""
    now = now or title

    def new_ref(ref, own):
        if (ref.sheet or own) != title:
            return ref
        row, col = rows.now(ref.row), cols.now(ref.col)
        if row is None or col is None:
            return ErrorValue("#REF!")
        return replace(ref, row=row, col=col, sheet=None if ref.sheet is None else now)

    def new_formula(node, own):
        def change(part):
            return new_ref(part, own) if isinstance(part, CellRef) else part

        def ranged(part):
            if isinstance(part, RangeRef) and part.start.sheet is not None:
                return RangeRef(part.start, replace(part.end, sheet=part.start.sheet))
            return part

        return transform(transform(node, ranged), change)

    def pieces(fill, own):
        """In one if its first and its last cell, and their references, move alike: one shift begins in one place."""
        down, right = fill.rows - 1, fill.cols - 1
        first, last = new_formula(fill.formula, own), new_formula(shifted(fill.formula, down, right), own)
        corners = [(fill.row, fill.col), (fill.row + down, fill.col + right)]
        if own == title:
            corners = [(rows.now(row), cols.now(col)) for row, col in corners]
        if None not in sum(corners, ()) and shifted(first, down, right) == last:
            (top, left), (bottom, end) = corners
            if (bottom - top, end - left) == (down, right):
                yield replace(fill, row=top, col=left, formula=first)
                return
        for row in range(fill.row, fill.row + fill.rows):
            for col in range(fill.col, fill.col + fill.cols):
                formula = new_formula(shifted(fill.formula, row - fill.row, col - fill.col), own)
                place = (rows.now(row), cols.now(col)) if own == title else (row, col)
                if None not in place:
                    yield Fill(*place, formula)

    def new_sheet(sheet):
        fills = tuple(piece for fill in sheet.fills for piece in pieces(fill, sheet.title))
        if sheet.title != title:
            return replace(sheet, fills=fills)
        cells = [(rows.now(cell.row), cols.now(cell.col), cell) for cell in sheet.cells]
        kept = tuple(replace(cell, row=row, col=col) for row, col, cell in cells if row is not None and col is not None)
        return replace(
            sheet, title=now, cells=kept, fills=fills, merges=(), validations=(), conditionals=(), charts=(), controls=(),
            comments=(),
        )  # fmt: skip

    names = tuple(
        replace(name, sheet=now, row=rows.now(name.row), col=cols.now(name.col)) if name.sheet == title else name
        for name in workbook.names
    )
    sheets = tuple(
        replace(new_sheet(sheet), charts=(), controls=(), conditionals=(), validations=()) for sheet in workbook.sheets
    )
    return replace(workbook, sheets=sheets, names=names)


def filled_down(workbook: Workbook, title: str, source: int, last: int, columns: int) -> Workbook:
    """The workbook after a person has filled a row of a sheet down to another, in so many columns."""

    def new_sheet(sheet: Sheet) -> Sheet:
        if sheet.title != title:
            return sheet
        kept: list[Fill] = []
        new: list[Fill] = []
        for fill in sheet.fills:
            if fill.col >= columns or fill.cols > 1:
                kept.append(fill)
                continue
            if fill.row <= source < fill.row + fill.rows:
                formula = shifted(fill.formula, source - fill.row)
                new.append(replace(fill, row=source, rows=last - source + 1, formula=formula))
            above, below = min(source - fill.row, fill.rows), fill.row + fill.rows - 1 - last
            if above > 0:
                kept.append(replace(fill, rows=above))
            if below > 0:
                start = max(fill.row, last + 1)
                rows = fill.row + fill.rows - start
                kept.append(replace(fill, row=start, rows=rows, formula=shifted(fill.formula, start - fill.row)))
        return replace(sheet, fills=(*kept, *new))

    return replace(workbook, sheets=tuple(map(new_sheet, workbook.sheets)))
