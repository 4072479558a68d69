"""Cell styles in XlsxWriter's terms, and named styles, which it does not write by itself."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from livesheet.workbook import PLAIN, Rich, Style

from ..house_style import FONT
from ..xml_text import attribute, number, ooxml_escaped
from .library import NamedFormat, PartsWorkbook


class StyleTable:
    """The formats of one workbook: one for each style, made when it is first asked for."""

    def __init__(self, book: PartsWorkbook) -> None:
        self._book = book
        self._formats: dict[Style, NamedFormat] = {}

    def index(self, style: Style) -> int:
        """The number of the style in <cellXfs>."""
        if style == PLAIN:
            return 0
        if style not in self._formats:
            self._formats[style] = self._new(style)
        return self._formats[style].index

    def _new(self, style: Style) -> NamedFormat:
        book = self._book
        properties = {**book.default_format_properties, **cell_properties(style)}
        look = NamedFormat(properties, book.xf_format_indices, book.dxf_format_indices)
        names = [name for name, _ in book.named_styles]
        if style.name in names:
            look.xf_id = names.index(style.name) + 1
        elif style.name:
            book.named_styles.append((style.name, look))
            look.xf_id = len(book.named_styles)
        book.formats.append(look)
        return look


def cell_properties(style: Style) -> dict[str, Any]:
    """The style as XlsxWriter's format properties."""
    properties: dict[str, Any] = {
        "font_name": FONT,
        "font_size": style.size,
        "font_color": f"#{style.color}",
        "bold": style.bold,
        "italic": style.italic,
        "num_format": style.number_format,
        "text_wrap": style.wrap,
        "shrink": style.shrink,
        "indent": style.indent,
        "locked": style.locked,
    }
    if style.fill:
        properties |= {"pattern": 1, "fg_color": f"#{style.fill}"}
    if style.border:
        sides = ("left", "right", "top", "bottom") if style.border == "thin" else (style.border,)
        for side in sides:
            properties |= {side: 1, f"{side}_color": f"#{style.border_color}"}
    if style.align:
        properties["align"] = style.align
    if style.valign:
        properties["valign"] = "vcenter" if style.valign == "center" else style.valign
    return properties


def conditional_properties(style: Style) -> dict[str, Any]:
    """What a conditional format may change: colour, bold, italic and fill."""
    properties: dict[str, Any] = {"font_color": f"#{style.color}", "bold": style.bold, "italic": style.italic}
    if style.fill:
        properties |= {"bg_color": f"#{style.fill}"}
    return properties


def rich_text(content: Rich, style: Style) -> str:
    """The runs of a shared string; every run repeats the cell's font, which it would lose otherwise."""
    return "".join(
        f'<r>{_run_font(kind, style)}<t xml:space="preserve">{ooxml_escaped(text)}</t></r>'
        for text, kind in content.parts
        if text
    )


@lru_cache(maxsize=256)
def _run_font(kind: str, style: Style) -> str:
    marks = "<b/>" if style.bold else ""
    if style.italic or kind == "italic":
        marks += "<i/>"
    script = {"sub": "subscript", "super": "superscript"}.get(kind)
    if script:
        marks += f'<vertAlign val="{script}"/>'
    return (
        f'<rPr>{marks}<sz val="{number(style.size)}"/><color rgb="FF{attribute(style.color)}"/>'
        f'<rFont val="{FONT}"/><family val="2"/></rPr>'
    )
