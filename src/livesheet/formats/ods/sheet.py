"""One table of an .ods: its rows as text, a column of a band at a time, and what stands around them.

Beside their content cells have notes, charts, rules of what may be typed, and looks under conditions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from livesheet.formula.nodes import ErrorValue, Node, Scalar
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_address
from livesheet.workbook import (
    PLAIN,
    Area,
    Cell,
    Chart,
    Column,
    Comment,
    Conditional,
    Control,
    Fill,
    Rich,
    Sheet,
    Style,
    Validation,
)

from ..archive import FIXED_TIME
from ..bands import Band, Place, bands, column_values, linked_value
from ..fill_down_text import ColumnTexts
from ..house_style import COLUMN_PIXELS, DIGIT_PIXELS, NOTE_PIXELS, PADDING_PIXELS, note_height
from ..xml_text import attribute, escaped, numbers, plain_value
from .charts import chart_ranges
from .styles import OdsStyles
from .text import address, area_address, paragraphs, points, result_attributes, value_attributes

_KINDS = {
    "decimal": "cell-content-is-decimal-number() and ",
    "whole": "cell-content-is-whole-number() and ",
}


@dataclass(frozen=True, slots=True)
class Rules:
    """The rules of one sheet.

    maps         area -> <style:map> element, in the order of the sheet
    validations  area -> name of the <table:content-validation>
    """

    maps: tuple[tuple[Area, str], ...]
    validations: tuple[tuple[Area, str], ...]

    @property
    def areas(self) -> list[Area]:
        """All areas that have a rule."""
        return [area for area, _ in (*self.maps, *self.validations)]


def sheet_rules(sheet: Sheet, styles: OdsStyles, number: int) -> Rules:
    """The rules of a sheet; its validations are numbered from `number` + 1."""
    maps = tuple((rule.area, _map(rule, sheet.title, styles)) for rule in sheet.conditionals)
    names = tuple((rule.area, f"val{number + i}") for i, rule in enumerate(sheet.validations, 1))
    return Rules(maps, names)


def _map(rule: Conditional, title: str, styles: OdsStyles) -> str:
    base = address(title, rule.area.first_row, rule.area.first_col)
    condition = f"is-true-formula({_formula(rule.condition)})"
    return (
        f'<style:map style:condition="{attribute(condition)}"'
        f' style:apply-style-name="{styles.conditional(rule.style)}" style:base-cell-address="{attribute(base)}"/>'
    )


def content_validations(sheets: tuple[Sheet, ...]) -> str:
    """The <table:content-validations> of the document, "" when it has none; numbered as `sheet_rules` names them."""
    rules = [(sheet.title, rule) for sheet in sheets for rule in sheet.validations]
    body = "".join(_validation(f"val{i}", title, rule) for i, (title, rule) in enumerate(rules, 1))
    return f"<table:content-validations>{body}</table:content-validations>" if body else ""


def _validation(name: str, title: str, rule: Validation) -> str:
    base = address(title, rule.area.first_row, rule.area.first_col)
    display = ' table:display-list="unsorted"' if rule.kind == "list" else ""
    kind = "stop" if rule.stop else "warning"
    help_message = _message("help-message", "", rule.input_title, rule.input_message)
    error_message = _message("error-message", f' table:message-type="{kind}"', rule.error_title, rule.error_message)
    return (
        f'<table:content-validation table:name="{name}" table:condition="{attribute(_condition(rule))}"'
        f' table:allow-empty-cell="true"{display} table:base-cell-address="{attribute(base)}">'
        f"{help_message}{error_message}</table:content-validation>"
    )


def _message(element: str, kind: str, title: str, text: str) -> str:
    shown = f' table:title="{attribute(title)}"' if title else ""
    body = paragraphs(text) if text else ""
    return f'<table:{element}{kind}{shown} table:display="true">{body}</table:{element}>'


def _condition(rule: Validation) -> str:
    if rule.kind == "list":
        if rule.low is not None:
            return f"of:cell-content-is-in-list({_formula(rule.low)})"
        choices = ";".join('"' + choice.replace('"', '""') + '"' for choice in rule.choices)
        return f"of:cell-content-is-in-list({choices})"
    if rule.kind == "custom":
        return f"of:is-true-formula({_formula(rule.low)})"
    if rule.operator == "between":
        return f"of:{_KINDS[rule.kind]}cell-content-is-between({_formula(rule.low)},{_formula(rule.high)})"
    return f"of:{_KINDS[rule.kind]}cell-content(){rule.operator}{_formula(rule.low)}"


def _formula(node: Node | None) -> str:
    if node is None:
        raise ValueError("a rule without its formula reached the writer")
    return print_formula(node, "openformula")


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
        self.covered = {place for area in self.spans.values() for place in area.places()} - self.spans.keys()
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
        maps = tuple(element for area, element in self.rules.maps if area.holds(row, col))
        name = self.styles.cell(style, maps)
        valid = next((name for area, name in self.rules.validations if area.holds(row, col)), "")
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


_ALL_COLUMNS = 1024
"""Columns that are given our width; LibreOffice's own is wider."""
_COMPONENTS = {"scroll": "ScrollBar", "spin": "SpinButton"}


def cell_extras(sheet: Sheet, author: str, objects: dict[int, str], first_control: int) -> Extras:
    """The notes, charts and controls of a sheet.

    author         who wrote the notes
    objects        the folder of each chart's document, by its place in `sheet.charts`
    first_control  number of the sheet's first control in the document
    """
    extras = Extras()
    for comment in sheet.comments:
        extras.notes[comment.row, comment.col] = _note(comment, author)
    depth = 0
    for i, chart in enumerate(sheet.charts):
        place = (chart.anchor.row, chart.anchor.col)
        extras.shapes[place] = extras.shapes.get(place, "") + _frame(chart, objects[i], depth)
        depth += 1
    for i, control in enumerate(sheet.controls):
        place = (control.anchor.row, control.anchor.col)
        extras.shapes[place] = extras.shapes.get(place, "") + _control_shape(control, first_control + i, depth)
        depth += 1
    return extras


def table(sheet: Sheet, rows: TableRows, styles: OdsStyles, style: str, first_control: int) -> Iterator[str]:
    """The <table:table> element in pieces; `style` is its automatic style."""
    setup = sheet.print_setup
    printed = f' table:print-ranges="{attribute(area_address(sheet.title, setup.area))}"' if setup.area else ""
    yield f'<table:table table:name="{attribute(sheet.title)}" table:style-name="{style}"{printed}>'
    if sheet.controls:
        yield _forms(sheet, first_control)
    yield _columns(sheet, styles)
    yield from rows.rows()
    yield "</table:table>"


def enter_columns(sheet: Sheet, styles: OdsStyles) -> None:
    """Enter the styles of the sheet's columns, which are written before the tables."""
    _columns(sheet, styles)


def _columns(sheet: Sheet, styles: OdsStyles) -> str:
    text, level, next_col = "", 0, 0
    setup = sheet.print_setup
    heading = setup.repeat_cols
    for column in sorted(sheet.columns, key=lambda column: column.first):
        if column.first > next_col:
            text += _to_level(level, 0, True) + _column(styles, COLUMN_PIXELS, column.first - next_col)
            level = 0
        text += _to_level(level, column.level, not column.hidden)
        level = column.level
        width = DIGIT_PIXELS * column.width + PADDING_PIXELS
        text += "<table:table-header-columns>" if heading and column.first == heading[0] else ""
        first = column.first
        if first in setup.page_at:
            text += _column(styles, width, 1, column, begins_page=True)
            first += 1
        if first <= column.last:
            text += _column(styles, width, column.last - first + 1, column)
        text += "</table:table-header-columns>" if heading and column.last == heading[1] else ""
        next_col = column.last + 1
    rest = _column(styles, COLUMN_PIXELS, max(_ALL_COLUMNS - next_col, 1))
    return text + _to_level(level, 0, True) + rest


def _to_level(level: int, wanted: int, shown: bool) -> str:
    """The ends or beginnings of column groups between two levels of the outline."""
    if wanted <= level:
        return "</table:table-column-group>" * (level - wanted)
    folded = "" if shown else ' table:display="false"'
    return f"<table:table-column-group{folded}>" * (wanted - level)


def _column(
    styles: OdsStyles, width: float, count: int, column: Column | None = None, begins_page: bool = False
) -> str:
    repeated = f' table:number-columns-repeated="{count}"' if count > 1 else ""
    hidden = ""
    if column is not None and column.hidden:
        # A column of a folded group is filtered by the group; one without a group is hidden by hand.
        hidden = ' table:visibility="collapse"'
    return (
        f'<table:table-column table:style-name="{styles.column(width, begins_page)}"{repeated}{hidden}'
        ' table:default-cell-style-name="Default"/>'
    )


def _note(comment: Comment, author: str) -> str:
    return (
        f'<office:annotation office:display="false" svg:width="{points(NOTE_PIXELS)}"'
        f' svg:height="{points(note_height(comment.text))}"><dc:creator>{escaped(author)}</dc:creator>'
        f"<dc:date>{FIXED_TIME:%Y-%m-%dT%H:%M:%S}</dc:date>{paragraphs(comment.text)}</office:annotation>"
    )


def _frame(chart: Chart, folder: str, depth: int) -> str:
    anchor = chart.anchor
    ranges = attribute(" ".join(chart_ranges(chart)))
    name = f' draw:name="{attribute(chart.name)}"' if chart.name else ""
    description = f"<svg:desc>{escaped(chart.alt_text)}</svg:desc>" if chart.alt_text else ""
    return (
        f'<draw:frame draw:z-index="{depth}"{name} draw:style-name="frame" svg:x="{points(anchor.dx)}"'
        f' svg:y="{points(anchor.dy)}" svg:width="{points(anchor.width)}" svg:height="{points(anchor.height)}">'
        f'<draw:object draw:notify-on-update-of-ranges="{ranges}" xlink:href="./{folder}" xlink:type="simple"'
        f' xlink:show="embed" xlink:actuate="onLoad"/>{description}</draw:frame>'
    )


def _control_shape(control: Control, number: int, depth: int) -> str:
    anchor = control.anchor
    return (
        f'<draw:control draw:z-index="{depth}" draw:style-name="frame" svg:x="{points(anchor.dx)}"'
        f' svg:y="{points(anchor.dy)}" svg:width="{points(anchor.width)}" svg:height="{points(anchor.height)}"'
        f' draw:control="control{number}"/>'
    )


def _forms(sheet: Sheet, first_control: int) -> str:
    items = "".join(_value_range(sheet, control, first_control + i) for i, control in enumerate(sheet.controls))
    return (
        '<office:forms form:automatic-focus="false" form:apply-design-mode="false">'
        '<form:form form:name="Form" form:control-implementation="ooo:com.sun.star.form.component.Form">'
        f"{items}</form:form></office:forms>"
    )


def _value_range(sheet: Sheet, control: Control, number: int) -> str:
    horizontal = "horizontal" if control.horizontal and control.kind == "scroll" else "vertical"
    linked = address(sheet.title, control.linked_row, control.linked_col)
    return (
        f'<form:value-range form:name="{attribute(control.name)}"'
        f' form:control-implementation="ooo:com.sun.star.form.component.{_COMPONENTS[control.kind]}"'
        f' xml:id="control{number}" form:id="control{number}" form:printable="false"'
        f' form:orientation="{horizontal}" form:linked-cell="{attribute(linked)}"'
        f' form:value="{linked_value(sheet, control)}" form:min-value="{control.low}"'
        f' form:max-value="{control.high}" form:step-size="{control.step}" form:page-step-size="{control.page}"'
        ' form:delay-for-repeat="PT0.05S"/>'
    )
