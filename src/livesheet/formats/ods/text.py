"""Small pieces of OpenDocument: addresses, lengths, paragraphs, the namespaces of its parts."""

from __future__ import annotations

import re

from livesheet.formula.nodes import ErrorValue
from livesheet.formula.references import absolute_name, cell_name
from livesheet.workbook import Area, Content, Rich

from ..xml_text import attribute, escaped, number

NAMESPACES = {
    "office": "urn:oasis:names:tc:opendocument:xmlns:office:1.0",
    "style": "urn:oasis:names:tc:opendocument:xmlns:style:1.0",
    "text": "urn:oasis:names:tc:opendocument:xmlns:text:1.0",
    "table": "urn:oasis:names:tc:opendocument:xmlns:table:1.0",
    "draw": "urn:oasis:names:tc:opendocument:xmlns:drawing:1.0",
    "fo": "urn:oasis:names:tc:opendocument:xmlns:xsl-fo-compatible:1.0",
    "xlink": "http://www.w3.org/1999/xlink",
    "dc": "http://purl.org/dc/elements/1.1/",
    "meta": "urn:oasis:names:tc:opendocument:xmlns:meta:1.0",
    "number": "urn:oasis:names:tc:opendocument:xmlns:datastyle:1.0",
    "svg": "urn:oasis:names:tc:opendocument:xmlns:svg-compatible:1.0",
    "chart": "urn:oasis:names:tc:opendocument:xmlns:chart:1.0",
    "form": "urn:oasis:names:tc:opendocument:xmlns:form:1.0",
    "config": "urn:oasis:names:tc:opendocument:xmlns:config:1.0",
    "of": "urn:oasis:names:tc:opendocument:xmlns:of:1.2",
    "ooo": "http://openoffice.org/2004/office",
    "calcext": "urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0",
    "loext": "urn:org:documentfoundation:names:experimental:office:xmlns:loext:1.0",
}
SHEET_TYPE = "application/vnd.oasis.opendocument.spreadsheet"
"""What a spreadsheet of OpenDocument is by its media type."""
DECLARATION = '<?xml version="1.0" encoding="UTF-8"?>\n'
VERSION = "1.3"
_PLAIN_SHEET = re.compile(r"[A-Za-z]+")
_SPACES = re.compile(r"(?<= ) +|^ +| +$|\t")


def opened(element: str) -> str:
    """The start of a part whose root is `element`, with all namespaces."""
    names = "".join(f' xmlns:{prefix}="{uri}"' for prefix, uri in NAMESPACES.items())
    return f'{DECLARATION}<{element}{names} office:version="{VERSION}">'


def sheet_name(title: str) -> str:
    """A sheet's name as addresses spell it."""
    return title if _PLAIN_SHEET.fullmatch(title) else "'" + title.replace("'", "''") + "'"


def address(title: str, row: int, col: int) -> str:
    """Sheet.A1, not yet escaped."""
    return f"{sheet_name(title)}.{cell_name(row, col)}"


def absolute(title: str, row: int, col: int) -> str:
    """$Sheet.$A$1, not yet escaped."""
    return f"${sheet_name(title)}.{absolute_name(row, col)}"


def area_address(title: str, area: Area) -> str:
    """Sheet.A1:Sheet.B9, not yet escaped; one cell is a range too."""
    first = address(title, area.first_row, area.first_col)
    return f"{first}:{address(title, area.last_row, area.last_col)}"


def points(pixels: float) -> str:
    """A length in pixels at 96 dpi, in points."""
    return f"{number(pixels * 0.75)}pt"


def value_attributes(value: Content | ErrorValue) -> str:
    """The type and value of a cell, as attributes."""
    match value:
        case bool():
            return f' office:value-type="boolean" office:boolean-value="{str(value).lower()}"'
        case ErrorValue():
            # As LibreOffice writes it: OpenDocument has no type for errors.
            return ' office:value-type="string" office:string-value="" calcext:value-type="error"'
        case str() | Rich():
            return ' office:value-type="string"'
        case None:
            return ""
        case _:
            return f' office:value-type="float" office:value="{number(value)}"'


def result_attributes(value: float | str | bool | ErrorValue) -> str:
    """The type and value of a formula's result.

    A text says that it is one, because #N/A could be an error; and it stands in the attribute too, because from the
    paragraph alone LibreOffice takes 0 for some results until the next recalculation.
    """
    attributes = value_attributes(value)
    if not isinstance(value, str):
        return attributes
    return f'{attributes} office:string-value="{attribute(value)}" calcext:value-type="string"'


def paragraphs(content: str | Rich) -> str:
    """A text as <text:p> elements, a line each; runs of rich text as spans in the styles sub, super and italic."""
    if isinstance(content, str):
        return "".join(f"<text:p>{_line(line)}</text:p>" for line in content.split("\n"))
    spans = []
    for text, kind in content.parts:
        line = _line(text.replace("\n", " "))
        spans.append(f'<text:span text:style-name="{kind}">{line}</text:span>' if kind else line)
    return f"<text:p>{''.join(spans)}</text:p>"


def _line(text: str) -> str:
    """A line with its spaces and tabs: a reader may drop all but one of the spaces that are not elements."""

    def kept(match: re.Match[str]) -> str:
        found = match.group()
        return "<text:tab/>" if found == "\t" else f'<text:s text:c="{len(found)}"/>'

    return _SPACES.sub(kept, escaped(text))
