"""The cells of one sheet of an .xlsx, read in one pass over its XML."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import Any
from xml.parsers import expat

from livesheet.diagnostics import Fault
from livesheet.formula.book import BookSheet
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, ErrorValue, Scalar
from livesheet.formula.references import CELL, cell_name, column_index, parse_area
from livesheet.said import say

from ..reading.formulas import Area, ArrayText, CellFaults, FormulaRuns, array_text, give_arrays
from ..reading.package import Package, local_name, unescaped
from ..reading.repeated_rows import RepeatedRows
from ..xml_text import NULL_DATE, NULL_DATE_1904, day_number, finite


class SheetScan:
    """Expat's handlers for one sheet, and what they gather."""

    def __init__(
        self,
        package: Package,
        part: str,
        sheet: BookSheet,
        strings: Sequence[str],
        date1904: bool,
        dynamic: Collection[str] = (),
    ) -> None:
        self.dynamic = dynamic
        self.arrays: list[ArrayText] = []
        self.filters: list[str] = []
        self.date1904 = date1904
        self.package = package
        self.part = part
        self.sheet = sheet
        self.strings = strings
        self.faults = CellFaults(package.name, sheet.title, "excel")
        self.runs = FormulaRuns(self.faults.formula, unknown=self._no_master)
        # The row at hand, the lowest one so far, and how many of the next ones only tell the parser where it is.
        self.row = self.lowest = -1
        self.told = 0
        self.rows_begun = 0

    def run(self, rows: RepeatedRows) -> list[Fault]:
        """Read the part, `rows` apart, into the sheet; the faults found, one for each cell that cannot be understood."""
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.buffer_size = 1 << 16
        texts = _handlers(self, parser)
        self.package.parse(self.part, parser, texts, rows)
        self.sheet.blocks.extend(self.runs.blocks())
        self.sheet.keep(self.runs.kept)
        give_arrays(self.sheet, self.arrays, self.faults)
        _give_filters(self.sheet, self.filters)
        return self.faults.found

    def at_row(self, row: int) -> None:
        """A row begins, mostly the one below the lowest so far."""
        if self.told:
            self.told -= 1
        elif row <= self.lowest:
            self.sheet.cached.settle_texts()  # what comes now is the later value of its cells
        else:
            self.lowest = row
        self.row = row
        self.rows_begun += 1

    def _no_master(self, number: str, area: Area) -> None:
        self.faults.remark(
            say("the shared formula {number} has no text: stored values are kept", number=number[:20]), area
        )

    def cell(
        self,
        row: int,
        col: int,
        kind: str,
        text: str,
        formula: str | None,
        about: dict[str, str] | None,
        mark: str | None = None,
    ) -> None:
        """A cell with its type, the text of its value, its formula with that one's attributes, and its metadata."""
        value = self.value(kind, text, row, col)
        if about is None:
            if value is not None:
                self.sheet.constants.put(row, col, value)
            return
        if value is not None:
            self.sheet.cached.put(row, col, value)
        sort = about.get("t", "normal")
        if sort == "normal" and formula:
            self.runs.text(row, col, formula)
        elif sort == "shared" and "si" in about:
            if formula:
                self.runs.master(row, col, about["si"], formula)
            else:
                self.runs.member(row, col, about["si"])
        elif sort == "array" and formula:
            found = array_text(row, col, about.get("ref", ""), formula, mark in self.dynamic)
            if found is None:
                self.faults.note(say("an array formula without a proper area"), row, col)
            else:
                self.arrays.append(found)
        elif sort == "dataTable":
            self._what_if(row, col, value, about)
        elif value is not None:  # an empty formula: the value is all there is
            self.sheet.constants.put(row, col, value)

    def _what_if(self, row: int, col: int, value: Scalar, about: dict[str, str]) -> None:
        """A what-if table ({=TABLE(...)}): one cell holds the formula of all of them."""
        if value is not None:
            self.sheet.constants.put(row, col, value)
        where = about.get("ref", "")[:40] or cell_name(row, col)
        self.faults.remark(
            say("the what-if table {where} is not computed: stored values are kept", where=where), (row, col, 1, 1)
        )

    def value(self, kind: str, text: str, row: int, col: int) -> Scalar:
        """What a cell's text means in its type, None for nothing."""
        if kind in ("str", "inlineStr"):
            return unescaped(text)
        if not text:
            return None
        if kind == "n":
            number = finite(text)
            if number is not None:
                return number
            self.faults.note(say('"{text}" is no number', text=text[:40]), row, col)
            return None
        if kind == "s":
            if text.isdecimal() and int(text) < len(self.strings):
                return self.strings[int(text)]
            self.faults.note(say("there is no shared text {text}", text=text[:40]), row, col)
            return None
        if kind == "b":
            return text.strip() in ("1", "true")
        if kind == "e":
            return ErrorValue(text)
        if kind == "d":
            number = serial_number(text, self.date1904)
            if number is None:
                self.faults.note(say('"{text}" is no date', text=text[:40]), row, col)
            return number
        return text


def serial_number(text: str, date1904: bool) -> float | None:
    """The serial number of an ISO 8601 date (the type of cells "d"), None when it is none."""
    if text.startswith("T") or text[2:3] == ":":
        text = "1899-12-30T" + text.removeprefix("T")
        return day_number(text, NULL_DATE)
    days = day_number(text, NULL_DATE_1904 if date1904 else NULL_DATE)
    # The calendar of 1900 has a 29th of February, as serial number 60.
    return days - 1 if days is not None and not date1904 and days < 61 else days


def _handlers(scan: SheetScan, parser: expat.XMLParserType) -> list[str]:
    """Closures over local state: attributes of an object cost half as much again here, where every cell passes.

    Returns where the text at hand is gathered.
    """
    columns: dict[str, int] = {}
    row = col = -1
    row_text = filter_area = ""
    kind = "n"
    cell: dict[str, Any] = {}
    formula: str | None = None
    about: dict[str, str] | None = None
    value = ""
    pieces: list[str] = []
    tags: dict[str, str] = {}
    skipping = 0

    put, add_text = scan.sheet.cached.put, scan.runs.text

    def start(tag: str, attributes: dict[str, Any]) -> None:
        nonlocal filter_area, row, col, row_text, kind, cell, formula, about, value, skipping
        name = tags.get(tag) or tags.setdefault(tag, local_name(tag))
        if name == "c":
            place = attributes.get("r")
            if place is None:
                col += 1
            else:
                letters = place[: -len(row_text)] if row_text and place.endswith(row_text) else ""
                found = columns.get(letters)
                if found is None:
                    found = _column(scan, place, row, columns)
                col = found
            cell = attributes
            kind = attributes.get("t", "n")
            formula = about = None
            value = ""
        elif name == "v" or name == "t":
            pieces.clear()
        elif name == "f":
            pieces.clear()
            about = attributes
        elif name == "row":
            place = attributes.get("r")
            row = _row(scan, str(row + 2) if place is None else place)
            row_text = str(row + 1)
            col = -1
            scan.at_row(row)
            if attributes.get("hidden", "0") in ("1", "true"):
                scan.sheet.hide(row, row + 1)
        elif name == "rPh":
            skipping += 1
        elif name == "autoFilter":
            filter_area = attributes.get("ref", "")
        elif name == "filterColumn":
            scan.filters.append(filter_area)

    def end(tag: str) -> None:
        nonlocal value, formula, skipping
        name = tags[tag]
        if name == "v":
            value = "".join(pieces)
        elif name == "f":
            formula = "".join(pieces)
        elif name == "c":
            if col >= MAX_COLUMNS:
                raise scan.package.fault(say("a cell outside the sheet"), scan.part)
            if about is not None and kind == "n" and formula and not about:
                # By far the most cells: a formula of its own with a number.
                number = finite(value)
                if number is not None:
                    put(row, col, number)
                    add_text(row, col, formula)
                    return
            if kind != "n" or value or about is not None:
                scan.cell(row, col, kind, value, formula, about, cell.get("cm"))
        elif name == "t" and not skipping:
            value += "".join(pieces)
        elif name == "rPh":
            skipping -= 1

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = pieces.append
    return pieces


def _row(scan: SheetScan, place: str) -> int:
    if not place.isdecimal() or not 1 <= int(place) <= MAX_ROWS:
        raise scan.package.fault(say('"{place}" is no row of a sheet', place=place[:40]), scan.part)
    return int(place) - 1


def _column(scan: SheetScan, place: str, row: int, columns: dict[str, int]) -> int:
    """The column of a cell's address, remembered; the address must be of the row at hand."""
    match = CELL.fullmatch(place)
    if match is None or match[1] or match[3] or int(match[4]) - 1 != row or column_index(match[2]) >= MAX_COLUMNS:
        raise scan.package.fault(say('"{place}" is no cell of row {row}', place=place[:40], row=row + 1), scan.part)
    columns[match[2]] = column_index(match[2])
    return columns[match[2]]


def _give_filters(sheet: BookSheet, areas: Iterable[str]) -> None:
    """Note the hidden rows below the first one of each area ("A1:C9") with a filter that filters.

    SUBTOTAL leaves those out always, the others only if it is asked to.
    """
    below: list[tuple[int, int]] = []
    for area in dict.fromkeys(areas):
        corners = parse_area(area)
        if corners is not None:
            below.append((corners[0] + 1, corners[2] + 1))
    sheet.hidden.sort()
    found = {
        (max(top, first), min(bottom, end))
        for top, bottom in below
        for first, end in sheet.hidden
        if max(top, first) < min(bottom, end)
    }
    sheet.filtered = sorted(found)
