"""Workbooks as .xlsx.

XlsxWriter writes everything but the cells (its way of writing numbers loses a digit, and it cannot share formulas),
the controls, the anchors of charts and the named styles. Its classes are extended where it leaves an opening; the
release is pinned, because these openings are not part of its public interface.
"""

from __future__ import annotations

import copy
import io
from pathlib import Path
from typing import Any, TextIO

from xlsxwriter.contenttypes import ContentTypes
from xlsxwriter.core import Core
from xlsxwriter.packager import Packager
from xlsxwriter.workbook import Workbook as XlsxWorkbook

from mechsheet.formula.printer import print_formula, quote_sheet
from mechsheet.formula.references import column_letters
from mechsheet.sheet.workbook import Cell, Rich, Sheet, Workbook

from ..archive import FIXED_TIME, Archive, new_archive
from ..bands import linked_value
from ..house_style import COLUMN_PIXELS, FONT, FONT_SIZE, ROW_PIXELS, locale
from ..limits import check_workbook
from ..seal import seal
from ..xml_text import legal, ooxml_escaped
from .cells import SheetData, calls_one_of, formula_texts
from .controls import CONTENT_TYPE, ControlVml, control_properties
from .sheet import DataWorksheet, fill_sheet, place_control
from .styles import NamedStyles, StyleTable, rich_text

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
    book._store_workbook()
    with new_archive(path) as archive:
        book.package.write_parts(archive)


class _Book(XlsxWorkbook):  # type: ignore[misc]
    """XlsxWriter's workbook, filled from ours; storing it only prepares `package`, which writes the parts."""

    package: _Package

    def __init__(self, source: Workbook) -> None:
        # XlsxWriter's own zip file stays empty and in memory.
        # A copy of the defaults: XlsxWriter writes into them, and the next workbook would differ from the first.
        super().__init__(io.BytesIO(), copy.deepcopy(_DEFAULTS))
        self.source = source
        self.styles = StyleTable(self)
        properties = source.properties
        self.set_properties(
            {
                "title": legal(properties.title),
                "subject": legal(properties.subject),
                "author": legal(properties.author),
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
            cell = f"${column_letters(name.col)}${name.row + 1}"
            self.define_name(name.name, f"={quote_sheet(name.sheet)}!{cell}")
        for function in source.functions:
            self.define_name(function.name, f"={print_formula(function.formula)}")

    def _fill(self, page: DataWorksheet, sheet: Sheet) -> None:
        strings = {
            (cell.row, cell.col): self.str_table._get_shared_string_index(_shared_string(cell))
            for cell in sheet.cells
            if isinstance(cell.content, (str, Rich))
        }
        # Numbered now, because styles are written from the table that this fills.
        for style in [cell.style for cell in sheet.cells] + [fill.style for fill in sheet.fills]:
            self.styles.index(style)
        functions = frozenset(function.name for function in self.source.functions)
        page.data = SheetData(sheet, self.styles.index, strings, formula_texts(sheet), functions)
        page.has_dynamic_arrays = any(calls_one_of(fill.formula, functions) for fill in sheet.fills)
        properties = self.source.properties
        fill_sheet(page, sheet, self, locale(properties.language), legal(properties.author))
        placed = sum(len(other.buttons_list) for other in self.worksheets())
        page.controls = [
            place_control(page, control, linked_value(sheet, control), placed + i)
            for i, control in enumerate(sheet.controls, 1)
        ]
        page.buttons_list = page.controls
        page.has_vml = page.has_vml or bool(page.controls)

    def _get_packager(self) -> Packager:
        self.package = _Package()
        return self.package


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


class _Part(io.StringIO):
    """What XlsxWriter takes for a text in memory, and is a part of the archive."""

    def __init__(self, stream: TextIO) -> None:
        super().__init__()
        self.stream = stream

    def write(self, text: str) -> int:
        return self.stream.write(text)


class _CoreProperties(Core):  # type: ignore[misc]
    """Core properties with the document's language and its seal."""

    def __init__(self, language: str, identifier: str) -> None:
        super().__init__()
        self.language = language
        self.identifier = identifier

    def _write_cp_category(self) -> None:
        self._xml_data_element("dc:language", self.language)
        self._xml_data_element("dc:identifier", self.identifier)


class _Package(Packager):  # type: ignore[misc]
    """The parts of the file, written into an archive one after another."""

    archive: Archive
    part: TextIO | None = None

    def _filename(self, xml_filename: str) -> _Part:
        self._end_part()
        self.part = self.archive.text(xml_filename)
        return _Part(self.part)

    def _end_part(self) -> None:
        if self.part is not None:
            self.part.close()
            self.part = None

    def _create_package(self) -> list[Any]:
        # Called while XlsxWriter holds its own zip file open: nothing may fail here, so nothing is written yet.
        return []

    def write_parts(self, archive: Archive) -> None:
        """Write all parts of the prepared workbook."""
        self.archive = archive
        super()._create_package()
        for page in self.workbook.worksheets():
            for placed in page.controls:
                self._filename(f"xl/ctrlProps/ctrlProp{placed.number}.xml").write(control_properties(placed))
        self._write_properties()
        self._end_part()

    def _write_content_types_file(self) -> None:
        content = ContentTypes()
        pages = self.workbook.worksheets()
        for number in range(1, len(pages) + 1):
            content._add_worksheet_name(f"sheet{number}")
        for number in range(1, self.chart_count + 1):
            content._add_chart_name(f"chart{number}")
        for number in range(1, self.drawing_count + 1):
            content._add_drawing_name(f"drawing{number}")
        if self.num_vml_files:
            content._add_vml_name()
        for number in range(1, self.num_comment_files + 1):
            content._add_comment_name(f"comments{number}")
        for placed in (placed for page in pages for placed in page.controls):
            content._add_override((f"/xl/ctrlProps/ctrlProp{placed.number}.xml", CONTENT_TYPE))
        if self.workbook.str_table.count:
            content._add_shared_strings()
        if self.workbook.has_metadata:
            content._add_metadata()
        content._set_xml_writer(self._filename("[Content_Types].xml"))
        content._assemble_xml_file()

    def _write_vml_files(self) -> None:
        pages = [page for page in self.workbook.worksheets() if page.has_vml]
        for number, page in enumerate(pages, 1):
            vml = ControlVml()
            vml._set_xml_writer(self._filename(f"xl/drawings/vmlDrawing{number}.vml"))
            vml._assemble_xml_file(page.vml_data_id, page.vml_shape_id, page.comments_list, page.buttons_list)

    def _write_styles_file(self) -> None:
        book = self.workbook
        styles = NamedStyles(book.styles.named)
        styles._set_style_properties(
            [
                book.xf_formats, book.palette, book.font_count, book.num_formats, book.border_count,
                book.fill_count, book.custom_colors, book.dxf_formats, book.has_comments,
            ]
        )  # fmt: skip
        styles._set_xml_writer(self._filename("xl/styles.xml"))
        styles._assemble_xml_file()

    def _write_core_file(self) -> None:
        # Written last of all: it holds the seal of the others.
        return

    def _write_properties(self) -> None:
        self._end_part()
        core = _CoreProperties(self.workbook.source.properties.language, seal(self.archive.contents()))
        core._set_properties(self.workbook.doc_properties)
        core._set_xml_writer(self._filename("docProps/core.xml"))
        core._assemble_xml_file()
