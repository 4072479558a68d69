"""The rows of a table of an .ods as text, a column of a band at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from livesheet.formula.nodes import ErrorValue, Scalar
from livesheet.formula.references import cell_address
from livesheet.workbook import PLAIN, Area, Cell, Fill, Rich, Sheet, Style

from ..bands import Band, Place, bands, column_values
from ..fill_down_text import ColumnTexts
from ..xml_text import attribute, numbers, plain_value
from .rules import Rules
from .styles import OdsStyles
from .text import paragraphs, result_attributes, value_attributes

_END = "</table:table-cell>"


@dataclass(frozen=True, slots=True)
class Extras:
    """What stands in cells beside their content, by place.

    notes   <office:annotation> elements;  shapes  frames and controls
    """

    notes: dict[Place, str] = field(default_factory=dict)
    shapes: dict[Place, str] = field(default_factory=dict)

    @property
    def places(self) -> set[Place]:
        """All cells that have something."""
        return {*self.notes, *self.shapes}


class TableRows:
    """The rows of one sheet. Making it enters the styles of all its cells, because they are written before."""

    def __init__(self, sheet: Sheet, styles: OdsStyles, rules: Rules, extras: Extras) -> None:
        self.sheet, self.styles, self.rules, self.extras = sheet, styles, rules, extras
        self.heights = dict(sheet.row_heights)
        self.fill_down = ColumnTexts("openformula", attribute)
        self.spans = {(merge.area.first_row, merge.area.first_col): merge.area for merge in sheet.merges}
        self.covered = {place for area in self.spans.values() for place in _places(area)} - self.spans.keys()
        heading = sheet.print_setup.repeat_rows
        self.heading = None if heading is None else Area(heading[0], 0, heading[1], 0)
        self.begins = frozenset(sheet.print_setup.row_at)
        areas = (
            rules.areas
            + ([self.heading] if self.heading else [])
            + [Area(row, 0, row, 0) for row in sorted(self.begins)]
        )
        self.bands = list(bands(sheet, areas, extras.places))
        self.edges = sorted({edge for area in rules.areas for edge in (area.first_col, area.last_col + 1)})
        used = [cell.col + 1 for band in self.bands for cell in band.cells] + self.edges
        self.columns = max(used + [fill.col + fill.cols for fill in sheet.fills], default=1)
        self._enter_styles()

    def _enter_styles(self) -> None:
        self.styles.row(None)
        for band in self.bands:
            self.styles.row(self.heights.get(band.first), band.first in self.begins)
            for cell in band.cells:
                self._look(cell.style, band.first, cell.col)
            for fill in band.fills:
                for col in range(fill.col, fill.col + fill.cols):
                    self._look(fill.style, band.first, col)
            for edge in self.edges:
                self._look(PLAIN, band.first, edge)

    def rows(self) -> Iterator[str]:
        """The rows from the first to the last that is used, in pieces of a few megabytes at most."""
        end = max([1, *(band.last for band in self.bands)])
        if self.heading is None:
            yield from self._between(0, end)
            return
        first, last = self.heading.first_row, self.heading.last_row + 1
        yield from self._between(0, first)
        yield "<table:table-header-rows>"
        yield from self._between(first, last)
        yield "</table:table-header-rows>"
        yield from self._between(last, end)

    def _between(self, first: int, last: int) -> Iterator[str]:
        """Rows first..last-1."""
        for band in self.bands:
            if first <= band.first < last:
                yield self._empty_rows(band.first - first)
                yield self._band(band)
                first = band.last
        yield self._empty_rows(last - first)

    def _empty_rows(self, count: int) -> str:
        style = self.styles.row(None)
        repeated = _repeated("rows", count)
        row = f'<table:table-row table:style-name="{style}"{repeated}><table:table-cell/></table:table-row>'
        return row if count > 0 else ""

    def _band(self, band: Band) -> str:
        columns = [(cell.col, [self._constant(cell)]) for cell in band.cells]
        for fill in band.fills:
            columns += [(col, self._formulas(fill, col, band)) for col in range(fill.col, fill.col + fill.cols)]
        columns.sort(key=lambda column: column[0])
        count = band.last - band.first
        height = self.styles.row(self.heights.get(band.first), band.first in self.begins)
        pieces = [[f'<table:table-row table:style-name="{height}">'] * count]
        next_col = 0
        for col, texts in columns:
            pieces += [[self._gap(band.first, next_col, col)] * count, texts]
            next_col = col + 1
        pieces += [[self._gap(band.first, next_col, self.columns) + "</table:table-row>"] * count]
        return "".join(map("".join, zip(*pieces, strict=True)))

    def _gap(self, row: int, first: int, last: int) -> str:
        """Cells without content, first..last-1: a run for each set of rules."""
        edges = [first, *(edge for edge in self.edges if first < edge < last), last] if first < last else []
        return "".join(
            f"<table:table-cell{self._look(PLAIN, row, start)}{_repeated('columns', stop - start)}/>"
            for start, stop in pairwise(edges)
        )

    def _look(self, style: Style, row: int, col: int) -> str:
        """The attributes of a cell that come from its style, the conditions there, and what may be typed."""
        maps = tuple(element for area, element in self.rules.maps if _holds(area, row, col))
        name = self.styles.cell(style, maps)
        valid = next((name for area, name in self.rules.validations if _holds(area, row, col)), "")
        text = f' table:style-name="{name}"' if name else ""
        return f'{text} table:content-validation-name="{valid}"' if valid else text

    def _head(self, style: Style, row: int, col: int) -> str:
        area = self.spans.get((row, col))
        spans = ""
        if area:
            cols, rows = area.last_col - area.first_col + 1, area.last_row - area.first_row + 1
            spans = f' table:number-columns-spanned="{cols}" table:number-rows-spanned="{rows}"'
        return f"<table:table-cell{self._look(style, row, col)}{spans}"

    def _constant(self, cell: Cell) -> str:
        place = (cell.row, cell.col)
        if place in self.covered:
            return f"<table:covered-table-cell{self._look(cell.style, *place)}/>"
        content = cell.content
        text = paragraphs(content) if isinstance(content, (str, Rich)) else ""
        value = "" if content is None else value_attributes(content)
        return f"{self._head(cell.style, *place)}{value}>{self._inside(place, text)}{_END}"

    def _inside(self, place: Place, text: str) -> str:
        return self.extras.notes.get(place, "") + text + self.extras.shapes.get(place, "")

    def _formulas(self, fill: Fill, col: int, band: Band) -> list[str]:
        """One column of a fill."""
        place = (band.first, col)
        formulas = self.fill_down.rows(fill, col, band.first, band.last)
        head = f'{self._head(fill.style, *place)} table:formula="of:='
        values = column_values(fill, col, band.first, band.last)
        address = cell_address(self.sheet.title, *place)
        if place in self.extras.places:
            value = plain_value(values[0], address)
            return [f'{head}{formulas[0]}"{result_attributes(value)}>{self._inside(place, _shown(value))}{_END}']
        return _formula_cells(head, formulas, values, address)


def _formula_cells(head: str, formulas: Sequence[str], values: Sequence[Scalar], place: str) -> list[str]:
    texts = numbers(values)
    if texts is not None:
        return [
            f'{head}{formula}" office:value-type="float" office:value="{text}"/>'
            for formula, text in zip(formulas, texts, strict=True)
        ]
    checked = (plain_value(value, place) for value in values)
    return [
        f'{head}{formula}"{result_attributes(value)}>{_shown(value)}{_END}'
        for formula, value in zip(formulas, checked, strict=True)
    ]


def _shown(value: float | str | bool | ErrorValue) -> str:
    """The paragraphs of a formula's cell: texts and errors are read from there."""
    return paragraphs(str(value)) if isinstance(value, (str, ErrorValue)) else ""


def _repeated(what: str, count: int) -> str:
    return f' table:number-{what}-repeated="{count}"' if count > 1 else ""


def _holds(area: Area, row: int, col: int) -> bool:
    return area.first_row <= row <= area.last_row and area.first_col <= col <= area.last_col


def _places(area: Area) -> Iterator[Place]:
    return (
        (row, col)
        for row in range(area.first_row, area.last_row + 1)
        for col in range(area.first_col, area.last_col + 1)
    )
