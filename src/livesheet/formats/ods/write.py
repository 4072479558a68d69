"""Workbooks as .ods (OpenDocument 1.3), written piece by piece as text: no library writes charts into this format."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from xml.sax.saxutils import escape

from livesheet.workbook import Module, PrintSetup, Properties, Sheet, Workbook

from ..archive import FIXED_TIME, Archive, new_archive, seal
from ..house_style import MARGIN_END, MARGIN_HEADER, MARGIN_SIDE, MARGIN_TOP
from ..limits import check_workbook
from ..xml_text import attribute, escaped
from .charts import MEDIA_TYPE, chart_content, chart_styles
from .sheet import TableRows, cell_extras, content_validations, enter_columns, sheet_rules, table
from .styles import FONT_FACES, OdsStyles
from .text import DECLARATION, SHEET_TYPE, VERSION, absolute, opened

_DOCTYPE = '<!DOCTYPE {0}:{1} PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "{2}.dtd">\n'
_LIBRARY = 'xmlns:library="http://openoffice.org/2000/library"'
_MANIFEST = "urn:oasis:names:tc:opendocument:xmlns:manifest:1.0"
_SIDES = {"L": "left", "C": "center", "R": "right"}
_FIELDS = {
    "P": "<text:page-number>1</text:page-number>",
    "N": "<text:page-count>1</text:page-count>",
    "A": "<text:sheet-name>???</text:sheet-name>",
    "F": "<text:file-name>???</text:file-name>",
    "D": "<text:date/>",
    "&": "&amp;",
}
"""Codes of headers and footers (&P ...), as in Excel."""


def manifest(folders: Iterable[str], chart_type: str, macros: Iterable[str] = ()) -> str:
    """META-INF/manifest.xml for the document, the folders of its charts, and the parts of its macros."""
    entries = [("/", SHEET_TYPE), *((f"{name}.xml", "text/xml") for name in ("content", "styles", "meta", "settings"))]
    for folder in folders:
        entries += [(f"{folder}/", chart_type)]
        entries += [(f"{folder}/{name}.xml", "text/xml") for name in ("content", "styles")]
    entries += [(part, "text/xml") for part in macros]
    body = "".join(
        f'<manifest:file-entry manifest:full-path="{path}" manifest:media-type="{kind}"'
        + (f' manifest:version="{VERSION}"' if path.endswith("/") else "")
        + "/>"
        for path, kind in entries
    )
    return (
        f'{DECLARATION}<manifest:manifest xmlns:manifest="{_MANIFEST}" manifest:version="{VERSION}">'
        f"{body}</manifest:manifest>"
    )


def meta(properties: Properties, sealed: str) -> str:
    """meta.xml: the properties, with a fixed time and the seal."""
    author = attribute(properties.author)
    time = FIXED_TIME.strftime("%Y-%m-%dT%H:%M:%S")
    given = (
        ("dc:title", properties.title),
        ("dc:description", properties.comments),
        ("dc:subject", properties.subject),
        ("meta:keyword", properties.keywords),
        ("meta:initial-creator", properties.author),
        ("dc:creator", properties.author),
        ("dc:language", properties.language),
    )
    body = "".join(f"<{tag}>{escaped(text)}</{tag}>" for tag, text in given if text)
    return (
        f"{opened('office:document-meta')}<office:meta><meta:generator>{author}</meta:generator>{body}"
        f"<meta:creation-date>{time}</meta:creation-date><dc:date>{time}</dc:date>"
        f'<meta:user-defined meta:name="{author}" meta:value-type="string">{sealed}</meta:user-defined></office:meta>'
        "</office:document-meta>"
    )


def settings(workbook: Workbook) -> str:
    """settings.xml: frozen panes, cursors, zoom and grid of each sheet, and the sheet that is shown first."""
    tables = "".join(_table_settings(sheet) for sheet in workbook.sheets)
    first = next(sheet.title for sheet in workbook.sheets if not sheet.hidden)
    return (
        f"{opened('office:document-settings')}<office:settings>"
        '<config:config-item-set config:name="ooo:view-settings"><config:config-item-map-indexed config:name="Views">'
        f"<config:config-item-map-entry>{_item('ViewId', 'string', 'view1')}"
        f'<config:config-item-map-named config:name="Tables">{tables}</config:config-item-map-named>'
        f"{_item('ActiveTable', 'string', first)}</config:config-item-map-entry></config:config-item-map-indexed>"
        "</config:config-item-set></office:settings></office:document-settings>"
    )


def _item(name: str, kind: str, value: object) -> str:
    return f'<config:config-item config:name="{name}" config:type="{kind}">{escaped(str(value))}</config:config-item>'


def _table_settings(sheet: Sheet) -> str:
    row, col = sheet.freeze or (0, 0)
    # Panes: 0 top left, 1 top right, 2 bottom left, 3 bottom right.
    pane = 3 if row and col else 1 if col else 2
    items = (
        ("CursorPositionX", "int", sheet.selected[1]),
        ("CursorPositionY", "int", sheet.selected[0]),
        ("HorizontalSplitMode", "short", 2 if col else 0),
        ("VerticalSplitMode", "short", 2 if row else 0),
        ("HorizontalSplitPosition", "int", col),
        ("VerticalSplitPosition", "int", row),
        ("ActiveSplitRange", "short", pane),
        ("PositionLeft", "int", 0),
        ("PositionRight", "int", col),
        ("PositionTop", "int", 0),
        ("PositionBottom", "int", row),
        ("ZoomType", "short", 0),
        ("ZoomValue", "int", 100),
        ("PageViewZoomValue", "int", 60),
        ("ShowGrid", "boolean", str(sheet.gridlines).lower()),
    )
    body = "".join(_item(*item) for item in items)
    return f'<config:config-item-map-entry config:name="{attribute(sheet.title)}">{body}</config:config-item-map-entry>'


def styles_part(workbook: Workbook, styles: OdsStyles) -> str:
    """styles.xml: the named styles and a page for each sheet."""
    layouts = "".join(_layout(i, sheet.print_setup) for i, sheet in enumerate(workbook.sheets, 1))
    masters = "".join(_master(i, sheet.print_setup) for i, sheet in enumerate(workbook.sheets, 1))
    return (
        f"{opened('office:document-styles')}{FONT_FACES}"
        f"<office:styles>{styles.common(workbook.properties.language)}</office:styles>"
        f"<office:automatic-styles>{layouts}</office:automatic-styles>"
        f"<office:master-styles>{masters}</office:master-styles></office:document-styles>"
    )


def _layout(number: int, setup: PrintSetup) -> str:
    width, height = ("29.7cm", "21cm") if setup.landscape else ("21cm", "29.7cm")
    # A side that is left out takes as many pages as it needs.
    fit = (
        f' style:scale-to="{setup.scale}%"'
        if setup.scale
        else "".join(
            f' style:scale-to-{side}="{pages}"'
            for side, pages in (("X", setup.fit_width), ("Y", setup.fit_height))
            if pages
        )
    )
    margins = f' fo:margin-left="{MARGIN_SIDE}in" fo:margin-right="{MARGIN_SIDE}in"'
    bands = ""
    for side, kind, text in (("top", "header", ""), ("bottom", "footer", setup.footer)):
        # A page's margin ends at its header where it has one.
        margins += f' fo:margin-{side}="{MARGIN_HEADER if text else MARGIN_TOP}in"'
        inner = "bottom" if side == "top" else "top"
        bands += (
            f'<style:{kind}-style><style:header-footer-properties fo:min-height="{MARGIN_END - MARGIN_HEADER:.2f}in"'
            f' fo:margin-left="0in" fo:margin-right="0in" fo:margin-{inner}="0.1in"/></style:{kind}-style>'
        )
    return (
        f'<style:page-layout style:name="pm{number}"><style:page-layout-properties fo:page-width="{width}"'
        ' style:first-page-number="continue"'
        f' fo:page-height="{height}" style:print-orientation="{"landscape" if setup.landscape else "portrait"}"'
        f"{margins}{fit}/>{bands}</style:page-layout>"
    )


def _master(number: int, setup: PrintSetup) -> str:
    return (
        f'<style:master-page style:name="Page{number}" style:page-layout-name="pm{number}">'
        f'<style:header style:display="false"/>{_footer(setup.footer)}</style:master-page>'
    )


def _footer(text: str) -> str:
    """A footer from Excel's codes: &L &C &R begin the parts, &P &N &A &F &D are fields."""
    if not text:
        return '<style:footer style:display="false"/>'
    parts = {"left": "", "center": "", "right": ""}
    side = "center"
    for code, plain in re.findall(r"&(.)|([^&]+)", text):
        if code in _SIDES:
            side = _SIDES[code]
        else:
            parts[side] += _FIELDS.get(code, "") if code else escaped(plain)
    regions = "".join(
        f"<style:region-{side}><text:p>{body}</text:p></style:region-{side}>" for side, body in parts.items() if body
    )
    return f"<style:footer>{regions}</style:footer>"


def macro_parts(modules: Sequence[Module]) -> dict[str, str]:
    """Name -> content of every part that modules of Basic need: the library Standard, LibreOffice's own addition."""
    if not modules:
        return {}
    elements = "".join(f'<library:element library:name="{attribute(module.name)}"/>' for module in modules)
    parts = {
        "Basic/script-lc.xml": f"{DECLARATION}{_DOCTYPE.format('library', 'libraries', 'libraries')}"
        f'<library:libraries {_LIBRARY} xmlns:xlink="http://www.w3.org/1999/xlink">'
        '<library:library library:name="Standard" library:link="false"/></library:libraries>',
        "Basic/Standard/script-lb.xml": f"{DECLARATION}{_DOCTYPE.format('library', 'library', 'library')}"
        f'<library:library {_LIBRARY} library:name="Standard" library:readonly="false"'
        f' library:passwordprotected="false">{elements}</library:library>',
    }
    for module in modules:
        parts[f"Basic/Standard/{module.name}.xml"] = (
            f"{DECLARATION}{_DOCTYPE.format('script', 'module', 'module')}"
            f'<script:module xmlns:script="http://openoffice.org/2000/script" script:name="{attribute(module.name)}"'
            f' script:language="StarBasic">{escape(module.text)}</script:module>'
        )
    return parts


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
