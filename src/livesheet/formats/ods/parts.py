"""The small parts of an .ods: pages, properties, view settings, modules of Basic, the list of parts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from xml.sax.saxutils import escape

from livesheet.workbook import Module, PrintSetup, Properties, Sheet, Workbook

from ..archive import FIXED_TIME
from ..house_style import MARGIN_END, MARGIN_HEADER, MARGIN_SIDE, MARGIN_TOP
from ..xml_text import attribute, escaped
from .styles import FONT_FACES, OdsStyles
from .text import DECLARATION, VERSION, opened

_DOCTYPE = '<!DOCTYPE {0}:{1} PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "{2}.dtd">\n'
_LIBRARY = 'xmlns:library="http://openoffice.org/2000/library"'
SHEET_TYPE = "application/vnd.oasis.opendocument.spreadsheet"
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
