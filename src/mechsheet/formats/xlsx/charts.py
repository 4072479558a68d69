"""Charts of an .xlsx: a workbook's chart in XlsxWriter's terms, and the few elements it writes otherwise than needed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from xlsxwriter.chart_scatter import ChartScatter
from xlsxwriter.drawing import Drawing, DrawingInfo

from mechsheet.formula.nodes import CellRef, Scalar
from mechsheet.formula.printer import quote_sheet
from mechsheet.formula.references import column_letters
from mechsheet.sheet.workbook import Area, Axis, Chart, Rich, Series, SeriesRef, Sheet

from ..bands import column_values
from ..house_style import AXIS_COLOR, FONT, GRID_COLOR, HAIR_LINE, TEXT_COLOR, TEXT_SIZE, TITLE_SIZE
from ..xml_text import legal, number

MAX_CACHED_POINTS = 4096
"""Longer series carry no copy of their values: every program reads them from the cells anyway."""

EMU = 9525
"""English Metric Units in a pixel at 96 dpi."""

_GRID, _AXIS, _TEXT = f"#{GRID_COLOR}", f"#{AXIS_COLOR}", f"#{TEXT_COLOR}"
_DASHES = {"solid": "solid", "dash": "dash", "dot": "round_dot"}


class OneCellDrawing(Drawing):  # type: ignore[misc]
    """A drawing whose charts are held by one corner and keep their size: LibreOffice stretches those held by two."""

    def _write_two_cell_anchor(self, index: int, drawing: DrawingInfo) -> None:
        col, row, dx, dy = drawing._dimensions[:4]
        self._xml_start_tag("xdr:oneCellAnchor")
        self._write_from(col, row, dx, dy)
        self._write_xdr_ext(drawing._width * EMU, drawing._height * EMU)
        self._write_graphic_frame(index, drawing)
        self._write_client_data()
        self._xml_end_tag("xdr:oneCellAnchor")


class StraightScatter(ChartScatter):  # type: ignore[misc]
    """A scatter chart that says of every series that it is not smooth.

    LibreOffice takes a series without the element for a smooth one unless the file says it is Excel 2007's, and one
    smooth series bends all others of the chart.
    """

    def __init__(self, language: str) -> None:
        super().__init__({"subtype": "straight_with_markers"})
        self.language = language

    def _write_lang(self) -> None:
        self._xml_empty_tag("c:lang", [("val", self.language)])
        # Said, because a missing one means square corners to Excel and round ones to readers that follow the schema.
        self._xml_empty_tag("c:roundedCorners", [("val", 0)])

    def _write_disp_blanks_as(self) -> None:
        self._xml_empty_tag("c:dispBlanksAs", [("val", "gap")])

    def _write_plot_vis_only(self) -> None:
        # Folding helper columns away must not empty the charts.
        self._xml_empty_tag("c:plotVisOnly", [("val", 0)])

    def _write_c_smooth(self, smooth: object) -> None:
        self._xml_empty_tag("c:smooth", [("val", 0)])

    def _write_number_format(self, axis: dict[str, Any]) -> None:
        # Never linked to the source: LibreOffice would number the axis with the decimals of the cells.
        self._xml_empty_tag("c:numFmt", [("formatCode", axis["num_format"] or "General"), ("sourceLinked", 0)])

    def _write_d_lbls(self, labels: dict[str, Any] | None) -> None:
        # All flags are said: a missing one means yes to some programs and no to others.
        if not labels:
            return
        self._xml_start_tag("c:dLbls")
        self._write_axis_font(labels["font"])
        self._write_d_lbl_pos(labels["position"] or "r")
        for tag in ("LegendKey", "Val", "CatName", "SerName", "Percent", "BubbleSize"):
            self._xml_empty_tag(f"c:show{tag}", [("val", int(tag == "SerName"))])
        self._xml_end_tag("c:dLbls")

    def _write_num_cache(self, data: Sequence[float | None]) -> None:
        points = [f'<c:pt idx="{i}"><c:v>{number(v)}</c:v></c:pt>' for i, v in enumerate(data) if v is not None]
        self.fh.write(
            f'<c:numCache><c:formatCode>General</c:formatCode><c:ptCount val="{len(data)}"/>{"".join(points)}'
            "</c:numCache>"
        )

    def _write_num_ref(self, formula: str, data: Sequence[float | None], ref_type: str) -> None:
        self._xml_start_tag("c:numRef")
        self._write_series_formula(formula)
        if data:
            self._write_num_cache(data)
        self._xml_end_tag("c:numRef")


def new_chart(chart: Chart, language: str) -> StraightScatter:
    """The chart with all its series; its size is the anchor's."""
    made = StraightScatter(language)
    made.embedded = True
    made.chart_name = legal(chart.name)
    made.set_title({"name_font": _font(TITLE_SIZE, True)} if chart.title else {"none": True})
    made.title.name = chart.title
    for series in chart.series:
        made.add_series(_series(series))
        if isinstance(series.name, str):
            # Not by the option: XlsxWriter takes a constant such as "A!B1" for a reference.
            made.series[-1]["name"] = series.name
    # In XlsxWriter as in the file, where an axis stands is said by the other one.
    made.set_x_axis(_axis(chart.x_axis, chart.y_axis))
    made.set_y_axis(_axis(chart.y_axis, chart.x_axis))
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


def _axis(axis: Axis, other: Axis) -> dict[str, Any]:
    options: dict[str, Any] = {
        "name_font": _font(TEXT_SIZE),
        "num_font": _font(TEXT_SIZE),
        "num_format": axis.number_format,
        "min": axis.low,
        "max": axis.high,
        "major_unit": axis.step,
        "visible": axis.visible,
        "line": {"color": _AXIS, "width": HAIR_LINE},
        "major_gridlines": {"visible": axis.gridlines, "line": {"color": _GRID, "width": HAIR_LINE}},
    }
    if other.crosses_low:
        options["crossing"] = "min"
    return options


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


def cached_values(sheet: Sheet, area: Area) -> list[float | str | None]:
    """The numbers and texts that stand in a column or row of cells; None where there is none or an error.

    Empty when there are more than MAX_CACHED_POINTS.
    """
    first_row, first_col, last_row, last_col = area.first_row, area.first_col, area.last_row, area.last_col
    if (last_row - first_row + 1) * (last_col - first_col + 1) > MAX_CACHED_POINTS:
        return []
    found: dict[tuple[int, int], Scalar] = {}
    for cell in sheet.cells:
        if first_row <= cell.row <= last_row and first_col <= cell.col <= last_col:
            found[cell.row, cell.col] = cell.content.plain if isinstance(cell.content, Rich) else cell.content
    for fill in sheet.fills:
        top, bottom = max(first_row, fill.row), min(last_row + 1, fill.row + fill.rows)
        for col in range(max(first_col, fill.col), min(last_col + 1, fill.col + fill.cols)):
            if top < bottom:
                for row, value in enumerate(column_values(fill, col, top, bottom), top):
                    found[row, col] = value
    places = [(r, c) for r in range(first_row, last_row + 1) for c in range(first_col, last_col + 1)]
    return [_cached(found.get(place)) for place in places]


def _cached(value: Scalar) -> float | str | None:
    return value if isinstance(value, (float, int, str)) and not isinstance(value, bool) else None
