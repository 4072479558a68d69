"""The tables of an .xlsx (`xl/tables/*.xml`), for structured references; and which hidden rows a filter hides."""

from __future__ import annotations

from collections.abc import Iterable
from xml.parsers import expat

from livesheet.formula.book import BookSheet, Table
from livesheet.formula.references import parse_cell

from ..reading.package import Package, local_name, relationships, unescaped


def tables_of(package: Package, part: str, title: str, filters: list[str]) -> list[Table]:
    """The tables of the sheet `title`, whose part is `part`. One without a proper area is left out: it is then unknown.

    filters  is given the areas in which a filter hides rows
    """
    targets = sorted(target for kind, target in relationships(package, part).values() if kind == "table")
    found = [_table(package, target, title, filters) for target in targets if target in package]
    return [table for table in found if table is not None]


def _table(package: Package, part: str, title: str, filters: list[str]) -> Table | None:
    about: dict[str, str] = {}
    columns: list[str] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        name = local_name(tag)
        if name == "table":
            about.update(attributes)
        elif name == "tableColumn":
            columns.append(unescaped(attributes.get("name", "")))
        elif name == "filterColumn":
            filters.append(about.get("ref", ""))

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    package.parse(part, parser)
    first, _, last = about.get("ref", "").partition(":")
    corners = parse_cell(first), parse_cell(last or first)
    if corners[0] is None or corners[1] is None or corners[1][1] - corners[0][1] + 1 != len(columns):
        return None
    name = about.get("displayName") or about.get("name", "")
    rows = corners[1][0] - corners[0][0] + 1
    headers, totals = (about.get(key, default) for key, default in (("headerRowCount", "1"), ("totalsRowCount", "0")))
    if not (headers.isdecimal() and totals.isdecimal() and len(headers + totals) < 9 and rows > 0):
        return None
    return Table(name, title, *corners[0], rows, tuple(columns), int(headers), int(totals))


def give_filters(sheet: BookSheet, areas: Iterable[str]) -> None:
    """Note the hidden rows below the first one of each area ("A1:C9") with a filter that filters.

    SUBTOTAL leaves those out always, the others only if it is asked to.
    """
    below: list[tuple[int, int]] = []
    for area in dict.fromkeys(areas):
        first, _, last = area.partition(":")
        corners = parse_cell(first), parse_cell(last or first)
        if corners[0] is not None and corners[1] is not None:
            below.append((corners[0][0] + 1, corners[1][0] + 1))
    sheet.hidden.sort()
    found = {
        (max(top, first), min(bottom, end))
        for top, bottom in below
        for first, end in sheet.hidden
        if max(top, first) < min(bottom, end)
    }
    sheet.filtered = sorted(found)
