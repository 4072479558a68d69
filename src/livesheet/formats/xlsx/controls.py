"""Scroll bars and spin buttons of an .xlsx, which no library writes.

Excel reads a control from three parts that must agree: a shape in the sheet's VML drawing (all that Excel 2007 needs),
`xl/ctrlProps/ctrlPropN.xml`, and a <controls> element of the sheet that joins the two by the shape's number and a
relationship. Sources: ECMA-376-4 (VML for spreadsheets), [MS-XLSX] (formControlPr), and what Excel 2010 writes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from livesheet.formula.references import absolute_name
from livesheet.workbook import Control

from ..xml_text import attribute

CONTENT_TYPE = "application/vnd.ms-excel.controlproperties+xml"
X14 = "http://schemas.microsoft.com/office/spreadsheetml/2009/9/main"
_MC = "http://schemas.openxmlformats.org/markup-compatibility/2006"
_XDR = "http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing"
_OBJECT_TYPE = {"scroll": "Scroll", "spin": "Spin"}
EMU = 9525
"""English Metric Units in a pixel at 96 dpi."""
_BAR_WIDTH = 16
"""Width of the arrows [pixels], Excel's own."""


@dataclass(slots=True)
class PlacedControl:
    """A control on its sheet.

    value     where it stands: the number in the linked cell, within its limits
    number    N of its ctrlPropN.xml, counted through the workbook
    vertices  XlsxWriter's place of an object: col, row, dx, dy, end col, end row, dx, dy, x, y, width, height [pixels]
    """

    control: Control
    value: int
    number: int
    vertices: tuple[float, ...]

    @property
    def link(self) -> str:
        """The cell it moves, $B$8."""
        return absolute_name(self.control.linked_row, self.control.linked_col)

    @property
    def horizontal(self) -> bool:
        """Only scroll bars lie; Excel's spin button always stands."""
        return self.control.horizontal and self.control.kind == "scroll"


def control_properties(placed: PlacedControl) -> str:
    """The text of the control's ctrlProp part."""
    control = placed.control
    horizontal = ' horiz="1"' if placed.horizontal else ""
    return (
        '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
        f'<formControlPr xmlns="{X14}" objectType="{_OBJECT_TYPE[control.kind]}" dx="{_BAR_WIDTH}"'
        f' fmlaLink="{placed.link}"{horizontal} inc="{control.step}" max="{control.high}" min="{control.low}"'
        f' page="{control.page}" val="{placed.value}"/>'
    )


def controls_element(controls: list[PlacedControl], first_shape: int, first_relationship: int) -> str:
    """The <controls> of a sheet, wrapped for programs before Excel 2010.

    first_shape         number of the first control's VML shape
    first_relationship  number of the first control's relationship, rIdN
    """
    items = "".join(
        _control_element(placed, first_shape + i, first_relationship + i) for i, placed in enumerate(controls)
    )
    return (
        f'<mc:AlternateContent xmlns:mc="{_MC}"><mc:Choice xmlns:x14="{X14}" Requires="x14">'
        f"<controls>{items}</controls></mc:Choice></mc:AlternateContent>"
    )


def _control_element(placed: PlacedControl, shape: int, relationship: int) -> str:
    col, row, dx, dy, end_col, end_row, end_dx, end_dy = _whole(placed.vertices)
    name = attribute(placed.control.name)
    return (
        f'<mc:AlternateContent xmlns:mc="{_MC}"><mc:Choice xmlns:x14="{X14}" Requires="x14">'
        f'<control shapeId="{shape}" r:id="rId{relationship}" name="{name}">'
        '<controlPr defaultSize="0" print="0" autoPict="0"><anchor moveWithCells="1">'
        f"<from>{_corner(col, dx, row, dy)}</from><to>{_corner(end_col, end_dx, end_row, end_dy)}</to>"
        "</anchor></controlPr></control></mc:Choice></mc:AlternateContent>"
    )


def _corner(col: int, dx: int, row: int, dy: int) -> str:
    """A corner as cell and offset, in EMU."""
    values = (("col", col), ("colOff", dx * EMU), ("row", row), ("rowOff", dy * EMU))
    return "".join(f'<xdr:{tag} xmlns:xdr="{_XDR}">{value}</xdr:{tag}>' for tag, value in values)


def _whole(vertices: Sequence[float]) -> tuple[int, ...]:
    """The first eight numbers of an object's place, which a file holds as whole pixels; heights of rows may be fractions."""
    return tuple(round(value) for value in vertices[:8])


def control_shape(placed: PlacedControl, shape: int, z_index: int) -> str:
    """The <v:shape> of a control in the sheet's VML drawing; `shape` is its number there."""
    left, top, width, height = (0.75 * pixels for pixels in placed.vertices[8:12])
    style = (
        f"position:absolute;margin-left:{left:.15g}pt;margin-top:{top:.15g}pt;"
        f"width:{width:.15g}pt;height:{height:.15g}pt;z-index:{z_index}"
    )
    content = "".join(f"<{tag}>{value}</{tag}>" if value else f"<{tag}/>" for tag, value in _client_data(placed))
    return (
        f'<v:shape id="_x0000_s{shape}" o:spid="_x0000_s{shape}" type="#_x0000_t201" style="{style}" stroked="f"'
        ' strokecolor="windowText [64]" o:insetmode="auto"><o:lock v:ext="edit" rotation="t"/>'
        f'<x:ClientData ObjectType="{_OBJECT_TYPE[placed.control.kind]}">{content}</x:ClientData></v:shape>'
    )


def anchor_text(vertices: Sequence[float]) -> str:
    """What <x:Anchor> holds: eight whole numbers, or strict readers refuse the workbook."""
    col, row, dx, dy, end_col, end_row, end_dx, end_dy = _whole(vertices)
    return f"{col}, {dx}, {row}, {dy}, {end_col}, {end_dx}, {end_row}, {end_dy}"


def _client_data(placed: PlacedControl) -> list[tuple[str, str]]:
    """The children of <x:ClientData>, in the order Excel writes them."""
    control = placed.control
    return [
        ("x:Anchor", anchor_text(placed.vertices)),
        ("x:PrintObject", "False"),
        ("x:FmlaLink", placed.link),
        ("x:Val", str(placed.value)),
        ("x:Min", str(control.low)),
        ("x:Max", str(control.high)),
        ("x:Inc", str(control.step)),
        ("x:Page", str(control.page)),
        *([("x:Horiz", "")] if placed.horizontal else []),
        ("x:Dx", str(_BAR_WIDTH)),
    ]
