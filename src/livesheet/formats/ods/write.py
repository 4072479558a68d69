"""Workbooks as .ods (OpenDocument 1.3), written piece by piece as text: no library writes charts into this format."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from livesheet.workbook import Sheet, Workbook

from ..archive import Archive, new_archive
from ..limits import check_workbook
from ..seal import seal
from ..xml_text import attribute
from .cells import TableRows
from .charts import MEDIA_TYPE, chart_content, chart_styles
from .parts import SHEET_TYPE, macro_parts, manifest, meta, settings, styles_part
from .rules import content_validations, sheet_rules
from .sheet import cell_extras, enter_columns, table
from .styles import FONT_FACES, OdsStyles
from .text import absolute, opened

_CALCULATION = (
    '<table:calculation-settings table:case-sensitive="false" table:automatic-find-labels="false"'
    ' table:use-regular-expressions="false" table:use-wildcards="true"/>'
)
"""Comparisons and searches of texts as in an .xlsx: OpenDocument's own defaults differ."""


def write_ods(workbook: Workbook, path: Path) -> None:
    """Write the workbook to `path`, replacing what is there only when all went well.

    Every fill must carry its values. Raises OutputError for names and titles that spreadsheet programs do not allow and
    for everything the system refuses; ValueError for what only a bug can cause (a missing value, a number that is not
    finite, two contents in one cell).
    """
    check_workbook(workbook)
    document = _Document(workbook)
    with new_archive(path) as archive:
        document.store(archive)


class _Document:
    """The workbook with everything that must be known before the first row is written."""

    def __init__(self, workbook: Workbook) -> None:
        self.workbook = workbook
        self.styles = OdsStyles()
        self.charts = [chart for sheet in workbook.sheets for chart in sheet.charts]
        self.folders = [f"Object {i}" for i in range(1, len(self.charts) + 1)]
        self.rows: list[TableRows] = []
        self.first_control: list[int] = []
        charts = controls = validations = 0
        for sheet in workbook.sheets:
            objects = dict(enumerate(self.folders[charts : charts + len(sheet.charts)]))
            extras = cell_extras(sheet, workbook.properties.author, objects, controls + 1)
            rules = sheet_rules(sheet, self.styles, validations)
            self.rows.append(TableRows(sheet, self.styles, rules, extras))
            self.first_control.append(controls + 1)
            enter_columns(sheet, self.styles)
            charts += len(sheet.charts)
            controls += len(sheet.controls)
            validations += len(sheet.validations)

    def store(self, archive: Archive) -> None:
        """Write all parts; the media type comes first and is not compressed, so that programs can look for it."""
        archive.stored("mimetype", SHEET_TYPE)
        parts = {
            "settings.xml": settings(self.workbook),
            "styles.xml": styles_part(self.workbook, self.styles),
        }
        for folder, chart in zip(self.folders, self.charts, strict=True):
            parts[f"{folder}/content.xml"] = chart_content(chart)
            parts[f"{folder}/styles.xml"] = chart_styles()
        macros = macro_parts(self.workbook.modules)
        parts |= macros
        parts["META-INF/manifest.xml"] = manifest(self.folders, MEDIA_TYPE, macros)
        for name, text in parts.items():
            with archive.text(name) as part:
                part.write(text)
        with archive.text("content.xml") as part:
            part.writelines(self._content())
        sealed = meta(self.workbook.properties, seal(self.workbook.properties.author, archive.contents()))
        with archive.text("meta.xml") as part:
            part.write(sealed)

    def _content(self) -> Iterator[str]:
        sheets = self.workbook.sheets
        tables = "".join(_table_style(i, sheet) for i, sheet in enumerate(sheets, 1))
        yield opened("office:document-content") + FONT_FACES
        yield f"<office:automatic-styles>{tables}{self.styles.automatic()}</office:automatic-styles>"
        yield f"<office:body><office:spreadsheet>{_CALCULATION}{content_validations(sheets)}"
        for i, sheet in enumerate(sheets):
            yield from table(sheet, self.rows[i], self.styles, f"ta{i + 1}", self.first_control[i])
        yield _names(self.workbook)
        yield "</office:spreadsheet></office:body></office:document-content>"


def _table_style(number: int, sheet: Sheet) -> str:
    color = f' table:tab-color="#{sheet.tab_color}"' if sheet.tab_color else ""
    return (
        f'<style:style style:name="ta{number}" style:family="table" style:master-page-name="Page{number}">'
        f'<style:table-properties table:display="{str(not sheet.hidden).lower()}"{color}/></style:style>'
    )


def _names(workbook: Workbook) -> str:
    names = "".join(
        f'<table:named-range table:name="{attribute(name.name)}"'
        f' table:base-cell-address="{attribute(absolute(name.sheet, 0, 0))}"'
        f' table:cell-range-address="{attribute(absolute(name.sheet, name.row, name.col))}"/>'
        for name in workbook.names
    )
    return f"<table:named-expressions>{names}</table:named-expressions>" if names else ""
