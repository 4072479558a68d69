"""One worksheet of an .xlsx: everything but its cells, its charts too, in XlsxWriter's terms."""

from __future__ import annotations

from typing import Any

from livesheet.formula.nodes import CellRef, Node
from livesheet.formula.printer import print_formula, quote_sheet
from livesheet.formula.references import absolute_name
from livesheet.workbook import Axis, Chart, PrintSetup, Properties, Series, SeriesRef, Sheet, Validation

from ..house_style import (
    AXIS_COLOR,
    FONT,
    GRID_COLOR,
    HAIR_LINE,
    MARGIN_END,
    MARGIN_SIDE,
    MARGIN_TOP,
    NOTE_PIXELS,
    TEXT_COLOR,
    TEXT_SIZE,
    TITLE_SIZE,
    excel_column_pixels,
    locale,
    note_height,
)
from ..xml_text import legal
from .library import DataWorksheet, FullScatter
from .styles import conditional_properties

_GRID, _AXIS, _TEXT = f"#{GRID_COLOR}", f"#{AXIS_COLOR}", f"#{TEXT_COLOR}"
_DASHES = {"solid": "solid", "dash": "dash", "dot": "round_dot"}


def new_chart(chart: Chart, language: str) -> FullScatter:
    """The chart with all its series; its size is the anchor's."""
    made = FullScatter(language, chart.smooth)
    made.embedded = True
    made.chart_name = legal(chart.name)
    made.set_title({"name_font": _font(TITLE_SIZE, True)} if chart.title else {"none": True})
    made.title.name = chart.title
    for series in chart.series:
        made.add_series(_series(series))
        if isinstance(series.name, str):
            # Not by the option: XlsxWriter takes a constant such as "A!B1" for a reference.
            made.series[-1]["name"] = series.name
    made.set_x_axis(_axis(chart.x_axis))
    made.set_y_axis(_axis(chart.y_axis))
    made.x_axis["title"].name = chart.x_axis.title
    made.y_axis["title"].name = chart.y_axis.title
    made.set_legend(_legend(chart))
    plot: dict[str, Any] = {"border": {"none": True}, "fill": {"none": True}}
    if chart.inner:
        plot["layout"] = dict(zip(("x", "y", "width", "height"), chart.inner, strict=True))
    made.set_plotarea(plot)
    made.set_chartarea({"border": {"color": _GRID, "width": HAIR_LINE}, "fill": {"color": "#FFFFFF"}})
    made.set_size({"width": chart.anchor.width, "height": chart.anchor.height})
    made.show_na_as_empty_cell()
    return made


def _font(size: float, bold: bool = False) -> dict[str, Any]:
    return {"name": FONT, "size": size, "bold": bold, "color": _TEXT}


def _axis(axis: Axis) -> dict[str, Any]:
    return {
        "name_font": _font(TEXT_SIZE),
        "num_font": _font(TEXT_SIZE),
        "num_format": axis.number_format,
        "min": axis.low,
        "max": axis.high,
        "major_unit": axis.step,
        "visible": axis.visible,
        "line": {"color": _AXIS, "width": HAIR_LINE},
        "major_gridlines": {"visible": axis.gridlines, "line": {"color": _GRID, "width": HAIR_LINE}},
        "crossing": "min",
    }


def _series(series: Series) -> dict[str, Any]:
    line: dict[str, Any] = {"none": True}
    if series.line:
        line = {"color": f"#{series.line}", "width": series.width, "dash_type": _DASHES[series.dash]}
    marker: dict[str, Any] = {"type": "none"}
    if series.marker:
        edge = series.marker_line or series.line
        marker = {
            "type": series.marker,
            "size": series.marker_size,
            "border": {"color": f"#{edge}"} if edge else {"none": True},
            "fill": {"color": f"#{series.marker_fill}"} if series.marker_fill else {"none": True},
        }
    options: dict[str, Any] = {
        "categories": f"={area_reference(series.x)}",
        "values": f"={area_reference(series.y)}",
        "line": line,
        "marker": marker,
    }
    if isinstance(series.name, CellRef):
        options["name_formula"] = f"={_cell_reference(series.name)}"
    if series.show_name:
        font = _font(series.label_size)
        options["data_labels"] = {"series_name": True, "position": series.label_side, "font": font}
    return options


def _cell_reference(name: CellRef) -> str:
    if name.sheet is None:
        raise ValueError("the cell that names a series needs its sheet")
    return f"{quote_sheet(name.sheet)}!{absolute_name(name.row, name.col)}"


def _legend(chart: Chart) -> dict[str, Any]:
    hidden = [i for i, series in enumerate(chart.series) if not series.in_legend]
    if not chart.legend or len(hidden) == len(chart.series):
        return {"none": True}
    return {"position": chart.legend, "delete_series": hidden, "font": _font(TEXT_SIZE)}


def area_reference(ref: SeriesRef) -> str:
    """The range as charts name it: 'Sheet 1'!$A$1:$A$9."""
    area = ref.area
    first = absolute_name(area.first_row, area.first_col)
    last = absolute_name(area.last_row, area.last_col)
    return f"{quote_sheet(ref.sheet)}!{first}" + ("" if first == last else f":{last}")


_A4 = 9
_TITLE_LENGTH, _MESSAGE_LENGTH = 32, 255


def fill_sheet(page: DataWorksheet, sheet: Sheet, book: Any, properties: Properties) -> None:
    """Everything of the sheet but its cells and controls; `book` is XlsxWriter's workbook."""
    _view(page, sheet)
    _print_setup(page, sheet.print_setup)
    for column in sheet.columns:
        options = {"level": column.level, "hidden": column.hidden, "collapsed": column.collapsed}
        page.set_column_pixels(column.first, column.last, excel_column_pixels(column.width), None, options)
    for row, height in sheet.row_heights:
        page.set_row_pixels(row, height)
    for merge in sheet.merges:
        area = merge.area
        page.merge.append([area.first_row, area.first_col, area.last_row, area.last_col])
    for validation in sheet.validations:
        area = validation.area
        page.data_validation(area.first_row, area.first_col, area.last_row, area.last_col, _validation(validation))
    for conditional in sheet.conditionals:
        area = conditional.area
        look = book.add_format(conditional_properties(conditional.style))
        rule = {"type": "formula", "criteria": _formula(conditional.condition), "format": look}
        page.conditional_format(area.first_row, area.first_col, area.last_row, area.last_col, rule)
    for comment in sheet.comments:
        page.write_comment(comment.row, comment.col, comment.text, _note_look(comment.text, properties.author))
    for chart in sheet.charts:
        made = new_chart(chart, locale(properties.language))
        made.id = -1
        book.charts.append(made)
        place = {"x_offset": chart.anchor.dx, "y_offset": chart.anchor.dy, "description": legal(chart.alt_text)}
        page.insert_chart(chart.anchor.row, chart.anchor.col, made, place)
    _dimension(page, sheet)


def _view(page: DataWorksheet, sheet: Sheet) -> None:
    if sheet.freeze:
        page.freeze_panes(*sheet.freeze)
    page.set_selection(*sheet.selected, *sheet.selected)
    if sheet.hidden:
        page.hide()
    # 1 hides them on paper, 2 also on the screen.
    page.hide_gridlines(1 if sheet.gridlines else 2)
    if sheet.tab_color:
        page.set_tab_color(f"#{sheet.tab_color}")


def _print_setup(page: DataWorksheet, setup: PrintSetup) -> None:
    if setup.landscape:
        page.set_landscape()
    page.set_paper(_A4)
    page.set_margins(MARGIN_SIDE, MARGIN_SIDE, MARGIN_TOP, MARGIN_END)
    if setup.scale:
        page.set_print_scale(setup.scale)
    elif setup.fit_width or setup.fit_height:
        page.fit_to_pages(setup.fit_width, setup.fit_height)
    if setup.page_at:
        page.set_v_pagebreaks(list(setup.page_at))
    if setup.row_at:
        page.set_h_pagebreaks(list(setup.row_at))
    if setup.repeat_rows:
        page.repeat_rows(*setup.repeat_rows)
    if setup.repeat_cols:
        page.repeat_columns(*setup.repeat_cols)
    if setup.area:
        area = setup.area
        page.print_area(area.first_row, area.first_col, area.last_row, area.last_col)
    if setup.footer:
        page.set_footer(legal(setup.footer))


def _dimension(page: DataWorksheet, sheet: Sheet) -> None:
    rows = [cell.row for cell in sheet.cells] + [fill.row for fill in sheet.fills]
    cols = [cell.col for cell in sheet.cells] + [fill.col for fill in sheet.fills]
    if rows:
        page.dim_rowmin, page.dim_colmin = min(rows), min(cols)
        page.dim_rowmax = max(rows + [fill.row + fill.rows - 1 for fill in sheet.fills])
        page.dim_colmax = max(cols + [fill.col + fill.cols - 1 for fill in sheet.fills])


def _formula(node: Node | None) -> str:
    if node is None:
        raise ValueError("a rule without its formula reached the writer")
    return "=" + print_formula(node, "excel")


def _validation(rule: Validation) -> dict[str, Any]:
    options: dict[str, Any] = {
        "validate": {"whole": "integer"}.get(rule.kind, rule.kind),
        "input_title": _short(rule.input_title, _TITLE_LENGTH),
        "input_message": _short(rule.input_message, _MESSAGE_LENGTH),
        "error_title": _short(rule.error_title, _TITLE_LENGTH),
        "error_message": _short(rule.error_message, _MESSAGE_LENGTH),
        "error_type": "stop" if rule.stop else "warning",
    }
    options = {key: value for key, value in options.items() if value}
    if rule.kind == "list":
        return options | {"source": list(rule.choices) if rule.low is None else _formula(rule.low)}
    if rule.kind == "custom":
        return options | {"value": _formula(rule.low)}
    options["criteria"] = rule.operator
    if rule.operator == "between":
        return options | {"minimum": _formula(rule.low), "maximum": _formula(rule.high)}
    return options | {"value": _formula(rule.low)}


def _short(text: str, length: int) -> str:
    """The text, cut to what Excel's message boxes take."""
    text = legal(text)
    return text if len(text) <= length else text[: length - 1] + "…"


def _note_look(text: str, author: str) -> dict[str, Any]:
    return {"author": author, "width": NOTE_PIXELS, "height": note_height(text), "font_size": TEXT_SIZE}
