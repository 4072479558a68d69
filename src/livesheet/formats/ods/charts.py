"""Charts of an .ods: embedded documents that refer to the cells of the spreadsheet."""

from __future__ import annotations

from livesheet.formula.nodes import CellRef
from livesheet.workbook import Area, Axis, Chart, Series

from ..house_style import AXIS_COLOR, FONT, GRID_COLOR, HAIR_LINE, TEXT_COLOR, TEXT_SIZE, TITLE_SIZE
from ..xml_text import attribute, number
from .styles import number_style
from .text import area_address, opened, paragraphs, points

MEDIA_TYPE = "application/vnd.oasis.opendocument.chart"
_SYMBOLS = {
    "circle": "circle", "square": "square", "diamond": "diamond", "triangle": "arrow-up", "plus": "plus", "x": "x",
}  # fmt: skip
_LABEL_SIDES = {"right": "right", "left": "left", "above": "top", "below": "bottom", "center": "center"}
_LEGEND_SIDES = {"right": "end", "bottom": "bottom", "top": "top"}
_NO_SEPARATORS = str.maketrans({",": "\u201a", ";": "\u037e"})
"""LibreOffice cuts a series' name at its list separator, even within quotes, and shows "Column B" in its place: signs that
look the same (a low quotation mark, the Greek question mark) are none."""

_DASHES = {"dash": ("rect", "400%", "300%"), "dot": ("round", "100%", "150%")}
"""Shape, length and distance of the strokes, in widths of the line."""

SMOOTH = ' chart:interpolation="cubic-spline" chart:spline-resolution="20"'


def chart_styles() -> str:
    """The styles part of every chart: the dashes that its lines may have."""
    dashes = "".join(
        f'<draw:stroke-dash draw:name="{name}" draw:style="{shape}" draw:dots1="1" draw:dots1-length="{length}"'
        f' draw:distance="{distance}"/>'
        for name, (shape, length, distance) in _DASHES.items()
    )
    return f"{opened('office:document-styles')}<office:styles>{dashes}</office:styles></office:document-styles>"


def chart_ranges(chart: Chart) -> list[str]:
    """The cells that the chart shows, as addresses, each once."""
    found: dict[str, None] = {}
    for series in chart.series:
        if isinstance(series.name, CellRef):
            found[_name_address(series.name)] = None
        found |= {area_address(ref.sheet, ref.area): None for ref in (series.x, series.y)}
    return list(found)


def chart_content(chart: Chart) -> str:
    """The content part of the chart's document."""
    styles = _Styles()
    body = _chart(chart, styles)
    return (
        f"{opened('office:document-content')}<office:automatic-styles>{styles.text}</office:automatic-styles>"
        f"<office:body><office:chart>{body}</office:chart></office:body></office:document-content>"
    )


class _Styles:
    """The automatic styles of a chart, as text that grows."""

    def __init__(self) -> None:
        self.text = ""
        self._count = 0

    def add(self, chart: str = "", graphic: str = "", text: str = "", format_code: str = "") -> str:
        """Enter a style of these properties (attributes) and give its name."""
        self._count += 1
        name, data = f"ch{self._count}", ""
        if format_code:
            self.text += number_style(f"N{self._count}", format_code)
            data = f' style:data-style-name="N{self._count}"'
        kinds = (("chart", chart), ("graphic", graphic), ("text", text))
        properties = "".join(f"<style:{kind}-properties {given}/>" for kind, given in kinds if given)
        self.text += f'<style:style style:name="{name}" style:family="chart"{data}>{properties}</style:style>'
        return name


def _font(size: float, bold: bool = False) -> str:
    weight = ' fo:font-weight="bold"' if bold else ""
    return f'fo:font-family="{FONT}" fo:font-size="{number(size)}pt" fo:color="#{TEXT_COLOR}"{weight}'


def _stroke(color: str, width: float) -> str:
    return f'draw:stroke="solid" svg:stroke-width="{number(width)}pt" svg:stroke-color="#{color}"'


def _chart(chart: Chart, styles: _Styles) -> str:
    width, height = chart.anchor.width, chart.anchor.height
    frame = styles.add(graphic=f'{_stroke(GRID_COLOR, HAIR_LINE)} draw:fill="solid" draw:fill-color="#ffffff"')
    title = ""
    if chart.title:
        look = styles.add('chart:auto-position="true"', text=_font(TITLE_SIZE, True))
        title = f'<chart:title chart:style-name="{look}">{paragraphs(chart.title)}</chart:title>'
    legend = ""
    if chart.legend and any(series.in_legend for series in chart.series):
        look = styles.add('chart:auto-position="true"', 'draw:stroke="none" draw:fill="none"', _font(TEXT_SIZE))
        wide = "high" if chart.legend == "right" else "wide"
        legend = (
            f'<chart:legend chart:legend-position="{_LEGEND_SIDES[chart.legend]}"'
            f' style:legend-expansion="{wide}" chart:style-name="{look}"/>'
        )
    return (
        f'<chart:chart svg:width="{points(width)}" svg:height="{points(height)}" xlink:href=".."'
        f' xlink:type="simple" chart:class="chart:scatter" chart:style-name="{frame}">'
        f"{title}{legend}{_plot(chart, styles)}</chart:chart>"
    )


def _plot(chart: Chart, styles: _Styles) -> str:
    place = region = ""
    if chart.inner:
        # The box of the plot area holds the numbers of the axes too; the region inside is what must be square.
        x, y, width, height = chart.inner
        across, down = chart.anchor.width, chart.anchor.height
        box = (("x", x * across), ("y", y * down), ("width", width * across), ("height", height * down))
        place = "".join(f' svg:{side}="{points(round(value, 6))}"' for side, value in box)
        region = f"<chart:coordinate-region{place}/>"
    position = "" if chart.inner else ' chart:auto-position="true" chart:auto-size="true"'
    position += SMOOTH if chart.smooth else ""
    look = styles.add(f'chart:treat-empty-cells="leave-gap" chart:include-hidden-cells="true"{position}')
    wall = styles.add(graphic='draw:stroke="none" draw:fill="none"')
    ranges = attribute(" ".join(chart_ranges(chart)))
    return (
        f'<chart:plot-area chart:style-name="{look}" table:cell-range-address="{ranges}"'
        f' chart:data-source-has-labels="none"{place}>{region}'
        f"{_axis('x', chart.x_axis, styles)}{_axis('y', chart.y_axis, styles)}"
        f"{''.join(_series(series, styles) for series in chart.series)}"
        f'<chart:wall chart:style-name="{wall}"/></chart:plot-area>'
    )


def _axis(dimension: str, axis: Axis, styles: _Styles) -> str:
    shown = "true" if axis.visible else "false"
    options = (
        f'chart:visible="{shown}" chart:display-label="{shown}" chart:logarithmic="false"'
        ' chart:reverse-direction="false" text:line-break="false" chart:link-data-style-to-source="false"'
        ' chart:tick-marks-major-outer="true" chart:tick-marks-major-inner="false"'
        ' chart:axis-position="start"'
    )
    for name, value in (("minimum", axis.low), ("maximum", axis.high), ("interval-major", axis.step)):
        if value is not None:
            options += f' chart:{name}="{number(value)}"'
    look = styles.add(options, _stroke(AXIS_COLOR, HAIR_LINE), _font(TEXT_SIZE), axis.number_format)
    title = grid = ""
    if axis.title:
        turned = ' style:rotation-angle="90"' if dimension == "y" else ""
        title_look = styles.add(f'chart:auto-position="true"{turned}', text=_font(TEXT_SIZE))
        title = f'<chart:title chart:style-name="{title_look}">{paragraphs(axis.title)}</chart:title>'
    if axis.gridlines:
        grid_look = styles.add(graphic=_stroke(GRID_COLOR, HAIR_LINE))
        grid = f'<chart:grid chart:style-name="{grid_look}" chart:class="major"/>'
    return (
        f'<chart:axis chart:dimension="{dimension}" chart:name="primary-{dimension}"'
        f' chart:style-name="{look}">{title}{grid}</chart:axis>'
    )


def _series(series: Series, styles: _Styles) -> str:
    look = styles.add(_points_look(series), _line_look(series), _font(series.label_size))
    if isinstance(series.name, CellRef):
        name = f' chart:label-cell-address="{attribute(_name_address(series.name))}"'
    else:
        # OpenDocument knows no constant names; LibreOffice reads its own attribute, as a text in quotes.
        quoted = '"' + series.name.translate(_NO_SEPARATORS).replace('"', '""') + '"'
        name = f' loext:label-string="{attribute(quoted)}"'
    if not series.in_legend:
        name += ' loext:hide-legend="true"'
    area = series.y.area
    count = (area.last_row - area.first_row + 1) * (area.last_col - area.first_col + 1)
    return (
        f'<chart:series chart:style-name="{look}" chart:class="chart:scatter"'
        f' chart:values-cell-range-address="{attribute(area_address(series.y.sheet, area))}"{name}>'
        f'<chart:domain table:cell-range-address="{attribute(area_address(series.x.sheet, series.x.area))}"/>'
        f'<chart:data-point chart:repeated="{count}"/></chart:series>'
    )


def _points_look(series: Series) -> str:
    """Markers and labels. In LibreOffice a marker has one colour, the line's."""
    options = 'chart:symbol-type="none"'
    if series.marker:
        size = f"{number(series.marker_size)}pt"
        options = (
            f'chart:symbol-type="named-symbol" chart:symbol-name="{_SYMBOLS[series.marker]}"'
            f' chart:symbol-width="{size}" chart:symbol-height="{size}"'
        )
    if series.show_name:
        options += (
            ' chart:data-label-number="none" chart:data-label-text="false" chart:data-label-symbol="false"'
            f' chart:data-label-series="true" chart:label-position="{_LABEL_SIDES[series.label_side]}"'
        )
    return options


def _line_look(series: Series) -> str:
    if not series.line:
        color = series.marker_fill or series.marker_line or TEXT_COLOR
        return f'draw:stroke="none" draw:fill-color="#{color}" svg:stroke-color="#{color}"'
    stroke = _stroke(series.line, series.width)
    if series.dash == "solid":
        stroke += ' svg:stroke-linecap="round" draw:stroke-linejoin="round"'
    else:
        stroke = stroke.replace('"solid"', f'"dash" draw:stroke-dash="{series.dash}"')
    return f'{stroke} draw:fill-color="#{series.line}"'


def _name_address(name: CellRef) -> str:
    if name.sheet is None:
        raise ValueError("the cell that names a series needs its sheet")
    return area_address(name.sheet, Area(name.row, name.col, name.row, name.col))
