"""Workbooks as .xlsx: XlsxWriter's workbook filled from ours."""

from __future__ import annotations

import copy
from pathlib import Path

from livesheet.formula.printer import print_formula, quote_sheet
from livesheet.formula.references import absolute_name
from livesheet.workbook import Cell, Rich, Sheet, Workbook

from ..archive import FIXED_TIME, new_archive
from ..bands import linked_value
from ..house_style import COLUMN_PIXELS, FONT, FONT_SIZE, ROW_PIXELS
from ..limits import check_workbook
from ..xml_text import legal, ooxml_escaped
from .cells import SheetData, calls_one_of, formula_texts
from .controls import PlacedControl
from .library import DataWorksheet, PartsWorkbook
from .sheet import fill_sheet
from .styles import StyleTable, rich_text

_DEFAULTS = {
    # Without a scheme: with one, Excel shows the theme's font (Calibri) and not the one that is named.
    "default_format_properties": {"font_name": FONT, "font_size": FONT_SIZE, "font_scheme": "none"},
    "default_row_height": ROW_PIXELS,
    "default_column_width": COLUMN_PIXELS,
}


def write_xlsx(workbook: Workbook, path: Path) -> None:
    """Write the workbook to `path`, replacing what is there only when all went well.

    Every fill must carry its values. Raises OutputError for names, titles or formulas that Excel does not allow and for
    everything the system refuses; ValueError for what only a bug can cause (a missing value, a number that is not
    finite, two contents in one cell).
    """
    check_workbook(workbook)
    book = _Book(workbook)
    book.close()
    with new_archive(path) as archive:
        book.package.write_parts(archive)


class _Book(PartsWorkbook):
    """XlsxWriter's workbook, filled from ours."""

    def __init__(self, source: Workbook) -> None:
        # A copy of the defaults: XlsxWriter writes into them, and the next workbook would differ from the first.
        super().__init__(copy.deepcopy(_DEFAULTS), source.properties.language)
        self.source = source
        self.styles = StyleTable(self)
        properties = source.properties
        self.set_properties(
            {
                "title": legal(properties.title),
                "subject": legal(properties.subject),
                "author": properties.author,
                "comments": legal(properties.comments),
                "keywords": legal(properties.keywords),
                "created": FIXED_TIME,
            }
        )
        for sheet in source.sheets:
            self.add_worksheet(sheet.title, DataWorksheet)
        for page, sheet in zip(self.worksheets(), source.sheets, strict=True):
            self._fill(page, sheet)
        for name in source.names:
            self.define_name(name.name, f"={quote_sheet(name.sheet)}!{absolute_name(name.row, name.col)}")
        for function in source.functions:
            self.define_name(function.name, f"={print_formula(function.formula)}")

    def _fill(self, page: DataWorksheet, sheet: Sheet) -> None:
        strings = {
            (cell.row, cell.col): self.string_index(_shared_string(cell))
            for cell in sheet.cells
            if isinstance(cell.content, (str, Rich))
        }
        # Numbered now, because styles are written from the table that this fills.
        for style in [cell.style for cell in sheet.cells] + [fill.style for fill in sheet.fills]:
            self.styles.index(style)
        functions = frozenset(function.name for function in self.source.functions)
        page.data = SheetData(sheet, self.styles.index, strings, formula_texts(sheet), functions)
        page.has_dynamic_arrays = any(calls_one_of(fill.formula, functions) for fill in sheet.fills)
        fill_sheet(page, sheet, self, self.source.properties)
        placed = sum(len(other.buttons_list) for other in self.worksheets())
        page.controls = [
            PlacedControl(control, linked_value(sheet, control), placed + i, page.vertices(control.anchor))
            for i, control in enumerate(sheet.controls, 1)
        ]
        page.buttons_list = page.controls
        page.has_vml = page.has_vml or bool(page.controls)


def _shared_string(cell: Cell) -> str:
    """The text as XlsxWriter's table of strings wants it: runs of rich text as they will stand in the file."""
    content = cell.content
    if isinstance(content, Rich):
        return rich_text(content, cell.style)
    text = str(content)
    if text.startswith("<r>") and text.endswith("</r>"):
        # XlsxWriter would take this for runs.
        return f'<r><t xml:space="preserve">{ooxml_escaped(text)}</t></r>'
    return text
