"""Styles of an .ods: cells, columns, rows, texts, numbers, and the named styles that people see in the list.

Number formats are written as codes (0.00, +0.0" mm", 0%, 0.0E+00), and become OpenDocument's elements here.
"""

from __future__ import annotations

import re

from livesheet.workbook import PLAIN, Style

from ..house_style import COUNTRIES, FONT, FONT_SIZE, ROW_PIXELS
from ..xml_text import attribute, escaped, number
from .text import points

_TOKEN = re.compile(
    r"""
      (?P<general>General)
    | "(?P<quoted>[^"]*)"
    | \\(?P<single>.)
    | _(?P<width>.)
    | \*(?P<repeated>.)
    | \[(?P<bracket>[^\]]*)\]
    | (?=[0\#?.])(?P<whole>[0\#?,]*)(?:\.(?P<decimals>[0\#?]*))?(?:E(?P<sign>[+-])(?P<exponent>0+))?
    | (?P<sign_or_space>[-+()/:\ ])
    | (?P<percent>%)
    | (?P<text>@)
    | (?P<other>[^A-Za-z"\\_*\[])
    """,
    re.VERBOSE,
)
_COLORS = {"red": "FF0000", "blue": "0000FF", "green": "008000", "black": "000000"}
_CONDITIONS = {2: ("value()&gt;=0",), 3: ("value()&gt;0", "value()&lt;0")}
"""When the sections before the last one hold: two sections are for numbers from 0 up and below, the third is for 0."""


def number_style(name: str, code: str) -> str:
    """The style elements for a number format; the one called `name` comes last.

    Raises ValueError for a code that has something else in it than digits, texts, %, @, exponents and colours.
    """
    sections = _sections(code)
    if len(sections) > 3:
        raise ValueError(f"the number format {code!r} has more than three sections")
    *first, last = sections
    parts, maps = [], ""
    for i, (section, condition) in enumerate(zip(first, _CONDITIONS.get(len(sections), ()), strict=True)):
        parts.append(_style(f"{name}P{i}", section, "", ' style:volatile="true"'))
        maps += f'<style:map style:condition="{condition}" style:apply-style-name="{name}P{i}"/>'
    return "".join(parts) + _style(name, last, maps, "")


def _sections(code: str) -> list[str]:
    """The code cut at semicolons that stand in no text."""
    return re.findall(r'(?:"[^"]*"|\\.|[^;"\\])+', code) or ["General"]


def _style(name: str, section: str, maps: str, kind: str) -> str:
    element, color, body = "number", "", ""
    position = 0
    while position < len(section):
        match = _TOKEN.match(section, position)
        if match is None or match.end() == position:
            raise ValueError(f"the number format {section!r} cannot be written to .ods")
        position = match.end()
        found = match.groupdict()
        if found["bracket"] is not None:
            if found["bracket"].lower() not in _COLORS:
                raise ValueError(f"the number format {section!r} cannot be written to .ods")
            color = f'<style:text-properties fo:color="#{_COLORS[found["bracket"].lower()]}"/>'
        elif found["text"]:
            element, body = "text", body + "<number:text-content/>"
        elif found["percent"]:
            element, body = "percentage", body + "<number:text>%</number:text>"
        elif found["general"]:
            body += '<number:number number:min-integer-digits="1"/>'
        elif found["whole"] is not None:
            body += _digits(found["whole"], found["decimals"] or "", found["sign"], found["exponent"])
        elif not found["repeated"]:
            text = found["quoted"] or found["single"] or found["sign_or_space"] or found["other"] or " "
            body += f"<number:text>{escaped(text)}</number:text>"
    # Texts that follow one another are one element of the schema.
    body = body.replace("</number:text><number:text>", "")
    return f'<number:{element}-style style:name="{name}"{kind}>{color}{body}{maps}</number:{element}-style>'


def _digits(whole: str, decimals: str, sign: str | None, exponent: str | None) -> str:
    attributes = (
        f'number:decimal-places="{len(decimals)}" number:min-decimal-places="{decimals.count("0")}"'
        f' number:min-integer-digits="{whole.count("0")}"'
    )
    if "," in whole:
        attributes += ' number:grouping="true"'
    if exponent is None:
        return f"<number:number {attributes}/>"
    forced = "true" if sign == "+" else "false"
    return (
        f'<number:scientific-number {attributes} number:min-exponent-digits="{len(exponent)}"'
        f' number:forced-exponent-sign="{forced}"/>'
    )


_INDENT_PIXELS = 9
"""One step of a cell's indent: three spaces of the default font."""
_ALIGN = {"left": "start", "center": "center", "right": "end"}
_VALIGN = {"top": "top", "center": "middle", "bottom": "bottom"}

FONT_FACES = (
    f'<office:font-face-decls><style:font-face style:name="{FONT}" svg:font-family="{FONT}"'
    ' style:font-family-generic="swiss" style:font-pitch="variable"/></office:font-face-decls>'
)
TEXT_STYLES = "".join(
    f'<style:style style:name="{name}" style:family="text"><style:text-properties {properties}/></style:style>'
    for name, properties in (
        ("sub", 'style:text-position="sub 58%"'),
        ("super", 'style:text-position="super 58%"'),
        ("italic", 'fo:font-style="italic"'),
    )
)
"""The runs of rich text."""
FRAME_STYLE = (
    '<style:style style:name="frame" style:family="graphic">'
    '<style:graphic-properties draw:stroke="none" draw:fill="none"/></style:style>'
)
"""Charts and controls: without it LibreOffice draws a blue box around them."""

BEGINS_PAGE = ' fo:break-before="page"'


class OdsStyles:
    """The tables of styles of one workbook; asking for a style's name enters it.

    A cell style with conditions is another automatic style, which maps the conditions to named styles.
    """

    def __init__(self) -> None:
        self._formats: dict[str, str] = {}
        self._named: dict[str, tuple[str, Style]] = {}
        self._cells: dict[tuple[Style, tuple[str, ...]], str] = {}
        self._conditional: dict[Style, str] = {}
        self._columns: dict[tuple[float, bool], str] = {}
        self._rows: dict[tuple[float | None, bool], str] = {}

    def cell(self, style: Style, maps: tuple[str, ...] = ()) -> str:
        """The name of the automatic style of a cell; `maps` are its <style:map> elements. "" is the default."""
        if style == PLAIN and not maps:
            return ""
        if (style, maps) not in self._cells:
            self._number(style.number_format)
            if style.name:
                self._named.setdefault(style.name, (f"named{len(self._named) + 1}", style))
            self._cells[style, maps] = f"ce{len(self._cells) + 1}"
        return self._cells[style, maps]

    def conditional(self, style: Style) -> str:
        """The name of the style that a condition applies."""
        return self._conditional.setdefault(style, f"condition{len(self._conditional) + 1}")

    def column(self, width: float, begins_page: bool = False) -> str:
        """The name of a column's style; the width is in pixels."""
        return self._columns.setdefault((width, begins_page), f"co{len(self._columns) + 1}")

    def row(self, height: float | None, begins_page: bool = False) -> str:
        """The name of a row's style; the height is in pixels, None is as high as its content."""
        return self._rows.setdefault((height, begins_page), f"ro{len(self._rows) + 1}")

    def _number(self, code: str) -> str:
        return self._formats.setdefault(code, f"N{len(self._formats) + 1}")

    def common(self, language: str) -> str:
        """The content of <office:styles>: the default, the named styles and those of conditions."""
        country = COUNTRIES.get(language, "none")
        parts = [
            '<style:default-style style:family="table-cell">'
            '<style:paragraph-properties style:tab-stop-distance="36pt"/>'
            f'<style:text-properties style:font-name="{FONT}" fo:font-size="{FONT_SIZE}pt"'
            f' fo:language="{attribute(language)}" fo:country="{country}"/></style:default-style>',
            *(number_style(name, code) for code, name in self._named_formats()),
            '<style:style style:name="Default" style:family="table-cell"/>',
        ]
        for name, (internal, style) in self._named.items():
            parts.append(
                f'<style:style style:name="{internal}" style:display-name="{attribute(name)}"'
                f' style:family="table-cell" style:parent-style-name="Default"'
                f' style:data-style-name="{self._number(style.number_format)}">{_properties(style)}</style:style>'
            )
        for style, internal in self._conditional.items():
            parts.append(
                f'<style:style style:name="{internal}" style:family="table-cell"'
                f' style:parent-style-name="Default">{_conditional_properties(style)}</style:style>'
            )
        return "".join(parts)

    def _named_formats(self) -> list[tuple[str, str]]:
        codes = dict.fromkeys(style.number_format for _, style in self._named.values())
        return [(code, self._number(code)) for code in codes]

    def automatic(self) -> str:
        """The styles of columns, rows, numbers, cells, texts and frames, for <office:automatic-styles>."""
        parts = [
            f'<style:style style:name="{name}" style:family="table-column">'
            f"<style:table-column-properties{BEGINS_PAGE if page else ''}"
            f' style:column-width="{points(width)}"/></style:style>'
            for (width, page), name in self._columns.items()
        ]
        for (height, page), name in self._rows.items():
            free = "true" if height is None else "false"
            parts.append(
                f'<style:style style:name="{name}" style:family="table-row"><style:table-row-properties'
                f'{BEGINS_PAGE if page else ""} style:row-height="{points(ROW_PIXELS if height is None else height)}"'
                f' style:use-optimal-row-height="{free}"/></style:style>'
            )
        parts += [number_style(name, code) for code, name in self._formats.items()]
        for (style, maps), name in self._cells.items():
            parent = self._named[style.name][0] if style.name else "Default"
            parts.append(
                f'<style:style style:name="{name}" style:family="table-cell" style:parent-style-name="{parent}"'
                f' style:data-style-name="{self._number(style.number_format)}">'
                f"{_properties(style)}{''.join(maps)}</style:style>"
            )
        return "".join(parts) + TEXT_STYLES + FRAME_STYLE


def _properties(style: Style) -> str:
    cell = f' style:cell-protect="{"protected" if style.locked else "none"}"'
    if style.fill:
        cell += f' fo:background-color="#{style.fill}"'
    if style.border:
        side = "" if style.border == "thin" else f"-{style.border}"
        cell += f' fo:border{side}="0.75pt solid #{style.border_color}"'
    if style.valign:
        cell += f' style:vertical-align="{_VALIGN[style.valign]}"'
    if style.wrap:
        cell += ' fo:wrap-option="wrap"'
    if style.shrink:
        cell += ' style:shrink-to-fit="true"'
    align = style.align or ("left" if style.indent else "")
    paragraph = ""
    if align:
        cell += ' style:text-align-source="fix"'
        margin = f' fo:margin-left="{points(_INDENT_PIXELS * style.indent)}"' if style.indent else ""
        paragraph = f'<style:paragraph-properties fo:text-align="{_ALIGN[align]}"{margin}/>'
    weight = f' fo:font-weight="{"bold" if style.bold else "normal"}"'
    slant = f' fo:font-style="{"italic" if style.italic else "normal"}"'
    text = f' fo:color="#{style.color}" fo:font-size="{number(style.size)}pt"{weight}{slant}'
    return f"<style:table-cell-properties{cell}/>{paragraph}<style:text-properties{text}/>"


def _conditional_properties(style: Style) -> str:
    cell = f'<style:table-cell-properties fo:background-color="#{style.fill}"/>' if style.fill else ""
    text = f' fo:color="#{style.color}"'
    if style.bold:
        text += ' fo:font-weight="bold"'
    if style.italic:
        text += ' fo:font-style="italic"'
    return f"{cell}<style:text-properties{text}/>"
