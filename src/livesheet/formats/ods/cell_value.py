"""One cell of an .ods with another value: its attributes and paragraphs change, its style, formula and notes stay."""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import date

from livesheet.formula.nodes import ErrorValue, Scalar

from ..reading.raw_xml import TAG, Edit, attributes_named, edited, end_tag, opened, with_attributes
from ..xml_text import number
from .text import NAMESPACES, paragraphs, result_attributes
from .values import date_text, time_text

_VALUE = attributes_named(
    "office:value-type", "office:value", "office:string-value", "office:boolean-value", "office:date-value",
    "office:time-value", "calcext:value-type",
)  # fmt: skip
COLUMNS_REPEATED, ROWS_REPEATED = "table:number-columns-repeated", "table:number-rows-repeated"
_REPEATED = {name: attributes_named(name) for name in (COLUMNS_REPEATED, ROWS_REPEATED)}
_KIND = re.compile(rb"\soffice:value-type\s*=\s*[\"']([a-z]+)")
_MARKUP = re.compile(rb"<[^>]*>")
_SHOWN = re.compile(r"(-?)[0-9]+(?:([.,])([0-9]+))?(%?)")
DECLARATION = f' xmlns:calcext="{NAMESPACES["calcext"]}"'


@dataclass(frozen=True, slots=True)
class CellXml:
    """A cell's element as bytes.

    paragraphs  where its own text stands, start and stop
    before      where a text would stand if it has none
    declared    whether the prefix `calcext` means something there
    """

    data: bytes
    paragraphs: tuple[tuple[int, int], ...]
    before: int
    declared: bool


def with_value(cell: CellXml, value: Scalar, null_date: date) -> bytes:
    """The element with another value; a number keeps the kind of number it was (percentage, date ...)."""
    match = TAG.match(cell.data)
    head = cell.data[: match.end() if match else 0]
    found = _KIND.search(head)
    kind = found[1].decode() if found else ""
    attributes = _attributes(value, kind, null_date)
    if "calcext:" in attributes and not cell.declared:
        attributes += DECLARATION
    new_head = with_attributes(head, _VALUE, attributes)
    old = cell.data[slice(*cell.paragraphs[0])] if cell.paragraphs else None
    text = _text(value, kind, old).encode()
    if len(head) == len(cell.data):
        return opened(new_head) + text + end_tag(head) if text else new_head
    edits = [Edit(0, len(head), new_head)]
    if not cell.paragraphs:
        edits.append(Edit(cell.before, cell.before, text))
    edits += [Edit(start, stop, b"" if n else text) for n, (start, stop) in enumerate(cell.paragraphs)]
    return edited(cell.data, edits)


def _attributes(value: Scalar, kind: str, null_date: date) -> str:
    """The type and value, as attributes."""
    if value is None:
        return ""
    if not isinstance(value, float) or kind not in ("percentage", "currency", "date", "time"):
        return result_attributes(value)
    if kind == "time":
        return f' office:value-type="time" office:time-value="{time_text(value)}"'
    if kind == "date":
        day = date_text(value, null_date)
        return result_attributes(value) if day is None else f' office:value-type="date" office:date-value="{day}"'
    return f' office:value-type="{kind}" office:value="{number(value)}"'


def _text(value: Scalar, kind: str, old: bytes | None) -> str:
    """The paragraphs. Programs show numbers by the cell's format whatever stands here, so a simple text will do."""
    if value is None:
        return ""
    if isinstance(value, str | ErrorValue):
        return paragraphs(str(value))
    if old is None:
        return ""
    if isinstance(value, bool):
        return paragraphs(str(value).upper())
    match = _SHOWN.fullmatch(_MARKUP.sub(b"", old).decode(errors="replace"))
    if match is None or kind in ("date", "time"):
        return paragraphs(f"{value:.15g}")
    _, sign, decimals, percent = match.groups()
    text = f"{value * 100 if percent else value:.{len(decimals or '')}f}"
    return paragraphs(text.replace(".", sign or ".") + percent)


def repeated(element: bytes, name: str, count: int) -> bytes:
    """A cell or row that stands for `count` of its kind; `name` is the attribute that says so."""
    match = TAG.match(element)
    head = element[: match.end() if match else 0]
    return with_attributes(head, _REPEATED[name], f' {name}="{count}"' if count > 1 else "") + element[len(head) :]
