"""Charts of an .xlsx: a workbook's chart in XlsxWriter's terms."""

from __future__ import annotations

from typing import Any

from livesheet.formula.nodes import CellRef
from livesheet.formula.printer import quote_sheet
from livesheet.formula.references import column_letters
from livesheet.workbook import Axis, Chart, Series, SeriesRef

from ..house_style import AXIS_COLOR, FONT, GRID_COLOR, HAIR_LINE, TEXT_COLOR, TEXT_SIZE, TITLE_SIZE
from ..xml_text import legal
from .library import FullScatter

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
    return f"{quote_sheet(name.sheet)}!${column_letters(name.col)}${name.row + 1}"


def _legend(chart: Chart) -> dict[str, Any]:
    hidden = [i for i, series in enumerate(chart.series) if not series.in_legend]
    if not chart.legend or len(hidden) == len(chart.series):
        return {"none": True}
    return {"position": chart.legend, "delete_series": hidden, "font": _font(TEXT_SIZE)}


def area_reference(ref: SeriesRef) -> str:
    """The range as charts name it: 'Sheet 1'!$A$1:$A$9."""
    area = ref.area
    first = f"${column_letters(area.first_col)}${area.first_row + 1}"
    last = f"${column_letters(area.last_col)}${area.last_row + 1}"
    return f"{quote_sheet(ref.sheet)}!{first}" + ("" if first == last else f":{last}")
