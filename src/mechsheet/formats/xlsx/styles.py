"""Cell styles in XlsxWriter's terms, and named styles, which it does not write by itself."""

from __future__ import annotations

from typing import Any

from xlsxwriter.format import Format
from xlsxwriter.styles import Styles, XFormatType

from mechsheet.sheet.workbook import PLAIN, Rich, Style

from ..house_style import FONT
from ..xml_text import attribute, number, ooxml_escaped

_BUILTIN_STYLES = {
    "Title": 15, "Heading 1": 16, "Heading 2": 17, "Heading 3": 18, "Heading 4": 19, "Input": 20, "Output": 21,
    "Calculation": 22, "Check Cell": 23, "Linked Cell": 24, "Total": 25, "Good": 26, "Bad": 27, "Neutral": 28,
    "Note": 10, "Warning Text": 11, "Explanatory Text": 53,
}  # fmt: skip
"""Styles that Excel has under these names (ECMA-376-1, 18.8.7): redefining one must give its number."""


class NamedFormat(Format):  # type: ignore[misc]
    """A format that belongs to a named style; equal looks under two names stay two formats."""

    def _get_format_key(self) -> str:
        return f"{super()._get_format_key()}:{self.xf_id}"


class NamedStyles(Styles):  # type: ignore[misc]
    """styles.xml with the named styles: (name, format) pairs, number i + 1 in the file."""

    def __init__(self, named: list[tuple[str, Format]]) -> None:
        super().__init__()
        self.named = named

    def _write_cell_style_xfs(self) -> None:
        self._xml_start_tag("cellStyleXfs", [("count", 1 + len(self.named))])
        for look in (self.xf_formats[0], *(look for _, look in self.named)):
            self._write_xf(look, XFormatType.STYLE)
        self._xml_end_tag("cellStyleXfs")

    def _write_cell_styles(self) -> None:
        self._xml_start_tag("cellStyles", [("count", 1 + len(self.named))])
        self._write_cell_style()
        for index, (name, _) in enumerate(self.named, 1):
            builtin = _BUILTIN_STYLES.get(name)
            kind = [] if builtin is None else [("builtinId", builtin), ("customBuiltin", 1)]
            self._xml_empty_tag("cellStyle", [("name", name), ("xfId", index), *kind])
        self._xml_end_tag("cellStyles")


class StyleTable:
    """The formats of one workbook: one for each style, made when it is first asked for."""

    def __init__(self, book: Any) -> None:
        self._book = book
        self._formats: dict[Style, Format] = {}
        self.named: list[tuple[str, Format]] = []

    def index(self, style: Style) -> int:
        """The number of the style in <cellXfs>."""
        if style == PLAIN:
            return 0
        if style not in self._formats:
            self._formats[style] = self._new(style)
        return int(self._formats[style]._get_xf_index())

    def _new(self, style: Style) -> Format:
        book = self._book
        properties = {**book.default_format_properties, **cell_properties(style)}
        look = NamedFormat(properties, book.xf_format_indices, book.dxf_format_indices)
        names = [name for name, _ in self.named]
        if style.name in names:
            look.xf_id = names.index(style.name) + 1
        elif style.name:
            self.named.append((style.name, look))
            look.xf_id = len(self.named)
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
    return "".join(_run(text, kind, style) for text, kind in content.parts if text)


def _run(text: str, kind: str, style: Style) -> str:
    marks = "<b/>" if style.bold else ""
    if style.italic or kind == "italic":
        marks += "<i/>"
    script = {"sub": "subscript", "super": "superscript"}.get(kind)
    if script:
        marks += f'<vertAlign val="{script}"/>'
    font = (
        f'<rPr>{marks}<sz val="{number(style.size)}"/><color rgb="FF{attribute(style.color)}"/>'
        f'<rFont val="{FONT}"/><family val="2"/></rPr>'
    )
    return f'<r>{font}<t xml:space="preserve">{ooxml_escaped(text)}</t></r>'
