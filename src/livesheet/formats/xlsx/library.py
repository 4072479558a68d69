"""XlsxWriter, extended: the only module that calls or overrides what is not its public interface.

XlsxWriter writes everything but the cells (its way of writing numbers loses a digit, and it cannot share formulas), the
controls, the anchors of charts and the named styles. Beside each class stands what of it is private and why it is needed;
wherever text does as well, text is written. `tests/formats/xlsx/test_library.py` finds names that a release no longer has.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any, TextIO

from xlsxwriter.chart_scatter import ChartScatter
from xlsxwriter.contenttypes import ContentTypes
from xlsxwriter.core import Core
from xlsxwriter.drawing import Drawing, DrawingInfo
from xlsxwriter.format import Format
from xlsxwriter.packager import Packager
from xlsxwriter.styles import Styles, XFormatType
from xlsxwriter.vml import Vml
from xlsxwriter.workbook import Workbook
from xlsxwriter.worksheet import Worksheet

from livesheet.workbook import Anchor, Area

from ..archive import Archive, seal
from ..xml_text import attribute, number, ooxml_escaped
from .cells import SheetData
from .controls import CONTENT_TYPE, EMU, PlacedControl, anchor_text, control_properties, control_shape, controls_element
from .ignored_errors import ignored_errors

_BUILTIN_STYLES = {
    "Title": 15, "Heading 1": 16, "Heading 2": 17, "Heading 3": 18, "Heading 4": 19, "Input": 20, "Output": 21,
    "Calculation": 22, "Check Cell": 23, "Linked Cell": 24, "Total": 25, "Good": 26, "Bad": 27, "Neutral": 28,
    "Note": 10, "Warning Text": 11, "Explanatory Text": 53,
}  # fmt: skip
"""Styles that Excel has under these names (ECMA-376-1, 18.8.7): redefining one must give its number."""


POINT = 12700
"""What a drawing counts in [of a point]."""

SHOWN_DIGITS = 6
"""Digits of the copy of its values that a chart keeps, for programs that draw without reading cells."""


class DataWorksheet(Worksheet):  # type: ignore[misc]
    """A worksheet whose cells come from `data` and whose scroll bars and spin buttons are `controls`.

    _write_sheet_data        the cells are ours
    _get_range_data          so are the values that charts keep a copy of
    _prepare_formula         would spell formulas anew that are spelled for the file already
    _prepare_chart           makes the drawing, which is to be another one
    _write_legacy_drawing    <controls> follows this element
    _write_ignored_errors    its public form takes one range for each kind, which may not overlap in the file
    _button_vertices         asks a button for its place; controls know theirs
    _position_object_pixels  the place of an object by column widths and row heights
    """

    data: SheetData
    controls: list[PlacedControl]
    drawing: Any

    def _write_sheet_data(self) -> None:
        self.fh.write("<sheetData>")
        for rows in self.data.rows():
            self.fh.write(rows)
        self.fh.write("</sheetData>")

    def _get_range_data(self, *corners: int) -> Sequence[float | str | None]:
        return self.data.copies.of(Area(*corners))

    def _prepare_formula(self, formula: str, expand_future_functions: bool = False) -> str:
        # The printer has spelled it as the file wants it.
        return formula.removeprefix("=")

    def _prepare_chart(self, index: int, chart_id: int, drawing_id: int) -> None:
        if not self.drawing:
            self.drawing = OneCellDrawing()
            self.drawing.embedded = 1
            self.external_drawing_links.append(["/drawing", f"../drawings/drawing{drawing_id}.xml"])
        super()._prepare_chart(index, chart_id, drawing_id)

    def _write_legacy_drawing(self) -> None:
        super()._write_legacy_drawing()
        if not self.controls:
            return
        # The relationships of our parts follow the drawing's: XlsxWriter lists them where those of tables would be.
        self.fh.write(controls_element(self.controls, self.vml_shape_id + 1, self.rel_count + 1))
        self.rel_count += len(self.controls)
        for placed in self.controls:
            self.external_table_links.append(["/ctrlProp", f"../ctrlProps/ctrlProp{placed.number}.xml"])

    def _write_ignored_errors(self) -> None:
        ignored = ignored_errors(self.data.sheet)
        if ignored:
            self.fh.write("<ignoredErrors>")
            for ranges, kinds in ignored:
                flags = "".join(f' {kind}="1"' for kind in kinds)
                self.fh.write(f'<ignoredError sqref="{ranges}"{flags}/>')
            self.fh.write("</ignoredErrors>")

    def _button_vertices(self, placed: PlacedControl) -> tuple[float, ...]:
        return placed.vertices

    def vertices(self, anchor: Anchor) -> tuple[float, ...]:
        """Where an object lies: col, row, dx, dy, end col, end row, dx, dy, x, y, width, height [pixels]."""
        place = self._position_object_pixels(
            anchor.col, anchor.row, anchor.dx, anchor.dy, anchor.width, anchor.height, 0
        )
        return (*place, anchor.width, anchor.height)


class OneCellDrawing(Drawing):  # type: ignore[misc]
    """A drawing whose charts are held by one corner and keep their size: LibreOffice stretches those held by two.

    _write_two_cell_anchor             the element that is to be another one
    _write_from, _write_graphic_frame  two of its children
    _dimensions, _width, _height       of a chart's DrawingInfo, its place and its size [pixels]
    """

    def _write_two_cell_anchor(self, index: int, drawing: DrawingInfo) -> None:
        col, row, dx, dy = drawing._dimensions[:4]
        self.fh.write("<xdr:oneCellAnchor>")
        self._write_from(col, row, dx, dy)
        self.fh.write(f'<xdr:ext cx="{drawing._width * EMU}" cy="{drawing._height * EMU}"/>')
        self._write_graphic_frame(index, drawing)
        self.fh.write("<xdr:clientData/></xdr:oneCellAnchor>")


class FullScatter(ChartScatter):  # type: ignore[misc]
    """A scatter chart that says of every series whether it is smooth, and all else that programs take in several ways.

    LibreOffice takes a series without the element for a smooth one unless the file says it is Excel 2007's, and one
    smooth series bends all others of the chart. The public options leave elements out that have XlsxWriter's defaults.

    _write_lang, _write_disp_blanks_as, _write_plot_vis_only, _write_c_smooth, _write_number_format, _write_d_lbls
                                         elements that are said in full
    _write_a_ln, _write_a_solid_fill     lines, with round ends
    _write_num_ref                       leaves the copy of the values out where there is none; a picture needs few digits
    _write_axis_font                     the font of labels
    """

    def __init__(self, language: str, smooth: bool) -> None:
        super().__init__({"subtype": "straight_with_markers"})
        self.language = language
        self.smooth = smooth

    def _write_lang(self) -> None:
        # Corners said: a missing element means square ones to Excel, round ones to readers that follow the schema.
        self.fh.write(f'<c:lang val="{attribute(self.language)}"/><c:roundedCorners val="0"/>')

    def _write_disp_blanks_as(self) -> None:
        self.fh.write('<c:dispBlanksAs val="gap"/>')

    def _write_plot_vis_only(self) -> None:
        # Folding helper columns away must not empty the charts.
        self.fh.write('<c:plotVisOnly val="0"/>')

    def _write_c_smooth(self, smooth: object) -> None:
        self.fh.write(f'<c:smooth val="{int(self.smooth)}"/>')

    def _write_a_ln(self, line: dict[str, Any]) -> None:
        # Round ends and corners, as Excel's own scatter charts have them; dashes keep their length.
        if line.get("none") or not {"color", "width"} <= line.keys() or line.get("dash_type"):
            super()._write_a_ln(line)
            return
        self.fh.write(f'<a:ln w="{round(line["width"] * POINT)}" cap="rnd">')
        self._write_a_solid_fill(line)
        self.fh.write("<a:round/></a:ln>")

    def _write_number_format(self, axis: dict[str, Any]) -> None:
        # Never linked to the source: LibreOffice would number the axis with the decimals of the cells.
        self.fh.write(f'<c:numFmt formatCode="{attribute(axis["num_format"] or "General")}" sourceLinked="0"/>')

    def _write_d_lbls(self, labels: dict[str, Any] | None) -> None:
        # All flags are said: a missing one means yes to some programs and no to others.
        if not labels:
            return
        self.fh.write("<c:dLbls>")
        self._write_axis_font(labels["font"])
        self.fh.write(f'<c:dLblPos val="{labels["position"] or "r"}"/>')
        for tag in ("LegendKey", "Val", "CatName", "SerName", "Percent", "BubbleSize"):
            self.fh.write(f'<c:show{tag} val="{int(tag == "SerName")}"/>')
        self.fh.write("</c:dLbls>")

    def _write_num_ref(self, formula: str, data: Sequence[float | None], ref_type: str) -> None:
        copy = ""
        if data:
            shown = [(i, float(f"{v:.{SHOWN_DIGITS}g}")) for i, v in enumerate(data) if v is not None]
            points = [f'<c:pt idx="{i}"><c:v>{number(v)}</c:v></c:pt>' for i, v in shown]
            count = f'<c:formatCode>General</c:formatCode><c:ptCount val="{len(data)}"/>'
            copy = f"<c:numCache>{count}{''.join(points)}</c:numCache>"
        self.fh.write(f"<c:numRef><c:f>{ooxml_escaped(formula.removeprefix('='))}</c:f>{copy}</c:numRef>")


class ControlVml(Vml):  # type: ignore[misc]
    """A VML drawing whose buttons are our controls; comments follow in the same part, as Excel wants it.

    _write_anchor        of a comment, in whole numbers
    _write_button_shape  the controls instead of buttons
    """

    def _write_anchor(self, vertices: Sequence[float]) -> None:
        self.fh.write(f"<x:Anchor>{anchor_text(vertices)}</x:Anchor>")

    def _write_button_shape(self, shape_id: int, z_index: int, placed: PlacedControl) -> None:
        self.fh.write(control_shape(placed, shape_id, z_index))


class NamedFormat(Format):  # type: ignore[misc]
    """A format that belongs to a named style; equal looks under two names stay two formats.

    _get_format_key  by which equal formats are one
    _get_xf_index    its number in <cellXfs>
    """

    def _get_format_key(self) -> str:
        return f"{super()._get_format_key()}:{self.xf_id}"

    @property
    def index(self) -> int:
        """Its number in <cellXfs>."""
        return int(self._get_xf_index())


class NamedStyles(Styles):  # type: ignore[misc]
    """styles.xml with the named styles: (name, format) pairs, number i + 1 in the file.

    _write_cell_style_xfs, _write_cell_styles  the elements that list them
    _write_xf                                  one of the former
    """

    named: list[tuple[str, NamedFormat]]

    def _write_cell_style_xfs(self) -> None:
        self.fh.write(f'<cellStyleXfs count="{1 + len(self.named)}">')
        for look in (self.xf_formats[0], *(look for _, look in self.named)):
            self._write_xf(look, XFormatType.STYLE)
        self.fh.write("</cellStyleXfs>")

    def _write_cell_styles(self) -> None:
        self.fh.write(f'<cellStyles count="{1 + len(self.named)}"><cellStyle name="Normal" xfId="0" builtinId="0"/>')
        for index, (name, _) in enumerate(self.named, 1):
            builtin = _BUILTIN_STYLES.get(name)
            kind = "" if builtin is None else f' builtinId="{builtin}" customBuiltin="1"'
            self.fh.write(f'<cellStyle name="{attribute(name)}" xfId="{index}"{kind}/>')
        self.fh.write("</cellStyles>")


class PartsWorkbook(Workbook):  # type: ignore[misc]
    """A workbook whose file is our archive: closing it only prepares `package`, which writes the parts.

    language      of the document
    named_styles  name and format of each named style, in order of their numbers

    _get_packager             makes what writes the parts
    _get_shared_string_index  of the table of strings: enters a text, without a cell
    """

    package: PartsPackage

    def __init__(self, options: dict[str, Any], language: str) -> None:
        # XlsxWriter's own zip file stays empty and in memory.
        super().__init__(io.BytesIO(), options)
        self.language = language
        self.named_styles: list[tuple[str, NamedFormat]] = []

    def _get_packager(self) -> Packager:
        self.package = PartsPackage()
        return self.package

    def string_index(self, text: str) -> int:
        """The number of a text in the table of shared strings; runs of rich text as they will stand in the file."""
        return int(self.str_table._get_shared_string_index(text))


class _Part(io.StringIO):
    """What XlsxWriter takes for a text in memory, and is a part of the archive."""

    def __init__(self, stream: TextIO) -> None:
        super().__init__()
        self.stream = stream

    def write(self, text: str) -> int:
        return self.stream.write(text)


class CoreProperties(Core):  # type: ignore[misc]
    """Core properties with the document's language and its seal.

    _write_cp_category  they follow in its place
    """

    added: dict[str, str]

    def _write_cp_category(self) -> None:
        self.fh.write("".join(f"<{tag}>{ooxml_escaped(text)}</{tag}>" for tag, text in self.added.items()))


class PartsPackage(Packager):  # type: ignore[misc]
    """The parts of the file, written into an archive one after another.

    _create_package                       writes all parts, too early
    _filename                             where a part is written to
    _write_content_types_file, _write_vml_files, _write_styles_file, _write_core_file
                                          parts that are made by classes of ours, or list ours
    _add_worksheet_name, _add_chart_name, _add_drawing_name, _add_vml_name, _add_comment_name, _add_override,
    _add_shared_strings, _add_metadata    of ContentTypes: what it lists
    _set_style_properties, _set_properties, _set_xml_writer, _assemble_xml_file
                                          of parts: what they hold, where they are written to, and that they are
    """

    archive: Archive
    part: TextIO | None = None

    def _filename(self, xml_filename: str) -> _Part:
        self._end_part()
        self.part = self.archive.text(xml_filename)
        return _Part(self.part)

    def _end_part(self) -> None:
        if self.part is not None:
            self.part.close()
            self.part = None

    def _create_package(self) -> list[Any]:
        # Called while XlsxWriter holds its own zip file open: nothing may fail here, so nothing is written yet.
        return []

    def write_parts(self, archive: Archive) -> None:
        """Write all parts of the prepared workbook."""
        self.archive = archive
        super()._create_package()
        for page in self.workbook.worksheets():
            for placed in page.controls:
                self._filename(f"xl/ctrlProps/ctrlProp{placed.number}.xml").write(control_properties(placed))
        self._end_part()
        core, author = CoreProperties(), self.workbook.doc_properties["author"]
        core.added = {"dc:language": self.workbook.language, "dc:identifier": seal(author, archive.contents())}
        core._set_properties(self.workbook.doc_properties)
        self._assemble(core, "docProps/core.xml")
        self._end_part()

    def _write_content_types_file(self) -> None:
        content = ContentTypes()
        pages = self.workbook.worksheets()
        for i in range(1, len(pages) + 1):
            content._add_worksheet_name(f"sheet{i}")
        for i in range(1, self.chart_count + 1):
            content._add_chart_name(f"chart{i}")
        for i in range(1, self.drawing_count + 1):
            content._add_drawing_name(f"drawing{i}")
        if self.num_vml_files:
            content._add_vml_name()
        for i in range(1, self.num_comment_files + 1):
            content._add_comment_name(f"comments{i}")
        for placed in (placed for page in pages for placed in page.controls):
            content._add_override((f"/xl/ctrlProps/ctrlProp{placed.number}.xml", CONTENT_TYPE))
        if self.workbook.str_table.count:
            content._add_shared_strings()
        if self.workbook.has_metadata:
            content._add_metadata()
        self._assemble(content, "[Content_Types].xml")

    def _write_vml_files(self) -> None:
        pages = [page for page in self.workbook.worksheets() if page.has_vml]
        for i, page in enumerate(pages, 1):
            shapes = page.vml_data_id, page.vml_shape_id, page.comments_list, page.buttons_list
            self._assemble(ControlVml(), f"xl/drawings/vmlDrawing{i}.vml", *shapes)

    def _write_styles_file(self) -> None:
        book = self.workbook
        styles = NamedStyles()
        styles.named = book.named_styles
        styles._set_style_properties(
            [
                book.xf_formats, book.palette, book.font_count, book.num_formats, book.border_count,
                book.fill_count, book.custom_colors, book.dxf_formats, book.has_comments,
            ]
        )  # fmt: skip
        self._assemble(styles, "xl/styles.xml")

    def _write_core_file(self) -> None:
        return  # Written last of all, because it holds the seal of the others.

    def _assemble(self, part: Any, name: str, *content: Any) -> None:
        part._set_xml_writer(self._filename(name))
        part._assemble_xml_file(*content)
