"""One table of an .ods: what stands around its rows, and what stands in cells beside their content."""

from __future__ import annotations

from collections.abc import Iterator

from livesheet.workbook import Chart, Column, Comment, Control, Sheet

from ..archive import FIXED_TIME
from ..bands import linked_value
from ..house_style import COLUMN_PIXELS, DIGIT_PIXELS, NOTE_PIXELS, PADDING_PIXELS, note_height
from ..xml_text import attribute, escaped
from .cells import Extras, TableRows
from .charts import chart_ranges
from .styles import OdsStyles
from .text import address, area_address, paragraphs, points

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
