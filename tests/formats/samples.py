"""Workbooks built by hand that use everything a writer must spell."""

from __future__ import annotations

import math

from livesheet import portable
from livesheet.formula.nodes import (
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    NameRef,
    Number,
    RangeRef,
    Text,
    Unary,
)
from livesheet.workbook import (
    Anchor,
    Area,
    Axis,
    Cell,
    Chart,
    Column,
    Comment,
    Conditional,
    Control,
    Fill,
    Merge,
    Name,
    PrintSetup,
    Properties,
    Rich,
    Series,
    SeriesRef,
    Sheet,
    Style,
    Validation,
    Workbook,
)

TITLE = Style(name="Title", bold=True, size=16, color="1F3864")
HEAD = Style(name="Heading 3", bold=True, fill="D9E2F3", border="thin", align="center", wrap=True)
INPUT = Style(name="Input", fill="FFF2CC", border="thin", number_format="0.0", locked=False)
INTEGER = Style(name="Input", fill="FFF2CC", border="thin", number_format="0", locked=False)
RESULT = Style(name="Calculation", fill="F2F2F2", border="thin", number_format="0.000", border_color="7F7F7F")
DEGREES = Style(name="Angle", number_format='0.0"°"', align="right")
NUMBER = Style(number_format="0.0000")
NOTE = Style(name="Note text", italic=True, color="595959", wrap=True, valign="top", indent=1)

FRONT, TABLE = "Giriş & Çıkış", "Ömer's table"
STEPS, RADIUS = 72, 40.0
FIRST = 2  # first row of the table
LEFT_OUT = 20  # rows from here to 29 do not exist


def cell(row, col, sheet=None, fixed=True):
    return CellRef(row, col, fixed, fixed, sheet)


def front() -> Sheet:
    return Sheet(
        FRONT,
        cells=(
            Cell(0, 0, "A circle, & what <programs> make of it", TITLE),
            Cell(2, 0, "Symbol", HEAD),
            Cell(2, 1, "Value", HEAD),
            Cell(2, 2, "Unit", HEAD),
            Cell(3, 0, Rich((("R", "italic"), ("12", "sub"), (" = r", ""), ("2", "super"))), Style(size=11)),
            Cell(3, 1, RADIUS, INPUT),
            Cell(3, 2, "mm"),
            Cell(4, 0, "x_M"),
            Cell(4, 1, 0.1 + 0.2, INPUT),
            Cell(5, 0, "step"),
            Cell(5, 1, 5.0, INPUT),
            Cell(6, 0, "position"),
            Cell(6, 1, 12, INTEGER),
            Cell(8, 0, "=1+1"),
            Cell(9, 0, "+A1 @x \x01 _x0041_ ]]> \t tab"),
            Cell(10, 0, "<r>no run</r>"),
            Cell(11, 0, True),
            Cell(12, 0, 1e-300),
            Cell(13, 0, "  spaces at both ends  "),
            Cell(14, 0, "two\nlines", NOTE),
            Cell(15, 0, "merged over three", HEAD),
            Cell(16, 0, "open", INPUT),
            Cell(17, 0, "to the table"),
            Cell(18, 0, "to the web"),
        ),
        fills=(
            Fill(7, 1, Binary("*", Number(2), Call("PI")), RESULT, values=(2 * math.pi,)),
            Fill(8, 1, Call("NA"), RESULT, values=(ErrorValue("#N/A"),)),
            Fill(9, 1, Binary("/", Number(1), Number(0)), RESULT, values=(ErrorValue("#DIV/0!"),)),
            Fill(10, 1, Binary("&", Text("<Açı> "), Call("TEXT", (Number(1.5), Text("0.00")))), values=("<Açı> 1.50",)),
            Fill(11, 1, Binary("<", Number(1), Number(2)), values=(True,)),
            Fill(12, 1, Text(""), values=("",)),
            Fill(13, 1, Unary("-", Binary("^", Number(2), Number(2))), values=(-4.0,)),
            Fill(14, 1, Call("IF", (Boolean(False), Number(1), Text("no"))), values=("no",)),
            Fill(15, 3, NameRef("ÇıkışUzvu"), RESULT, values=(RADIUS,)),
            Fill(16, 1, Call("INDEX", (RangeRef(cell(FIRST, 0, TABLE), cell(FIRST + STEPS, 0, TABLE)),
                                       Binary("+", cell(6, 1), Number(1)))), DEGREES, values=(60.0,)),
            Fill(19, 0, Binary("&", Call("TEXT", (NameRef("ÇıkışUzvu"), Text("0"))), Text(" mm")), values=("40 mm",)),
            Fill(20, 0, Unary("-", Number(0.5)), values=(-0.5,)),
            Fill(21, 0, Unary("-", Number(0.9)), values=(-0.9,)),
            Fill(20, 1, Unary("-", Number(0.9)), values=(-0.9,)),
            Fill(21, 1, Unary("-", Number(0.9)), values=(-0.9,)),
        ),
        columns=(Column(0, 0, 24), Column(1, 2, 11), Column(3, 3, 14)),
        row_heights=((0, 30), (14, 40)),
        merges=(Merge(Area(15, 0, 15, 2)),),
        charts=(circle(), curve()),
        controls=(
            Control("scroll", "Position", Anchor(6, 3, 200, 20, 4, 2), 6, 1, 0, STEPS, 1, 10),
            Control("spin", "Step by step", Anchor(5, 3, 24, 40, 220, 0), 6, 1, 0, STEPS, 1, 10, False),
        ),
        validations=(
            Validation(Area(3, 1, 3, 1), "decimal", ">", Number(0), input_title="Radius",
                       input_message="A length above 0 <mm>", error_title="Not a radius",
                       error_message='The radius "R" must be above 0'),
            Validation(Area(6, 1, 6, 1), "whole", "between", Number(0), Number(STEPS)),
            Validation(Area(16, 0, 16, 0), "list", choices=("open", "crossed")),
            Validation(Area(5, 1, 5, 1), "custom", low=Binary(">", cell(5, 1), Number(0)), stop=False),
        ),
        conditionals=(
            Conditional(Area(7, 1, 9, 1), Call("ISNA", (cell(7, 1, fixed=False),)),
                        Style(color="9C0006", fill="FFC7CE", bold=True)),
        ),
        comments=(Comment(3, 1, "The radius.\nChange it & look."), Comment(8, 1, "not available")),
        freeze=(2, 0),
        selected=(3, 1),
        gridlines=False,
        tab_color="1F3864",
        print_setup=PrintSetup(repeat_rows=(0, 1), area=Area(0, 0, 40, 20), footer="&L&A&C&P / &N&R<mechsheet> && co"),
    )  # fmt: skip


def points() -> list[tuple[float | None, float | None]]:
    made: list[tuple[float | None, float | None]] = []
    for i in range(STEPS + 1):
        angle = math.radians(5.0 * i)
        gone = LEFT_OUT <= i < LEFT_OUT + 10
        made.append((None, None) if gone else (portable.cos(angle), portable.sin(angle)))
    return made


def table() -> Sheet:
    rows = STEPS + 1
    angle = CellRef(FIRST, 0, False, True)
    gone = Call(
        "AND",
        (
            Binary(">=", Call("ROW"), Number(FIRST + LEFT_OUT + 1)),
            Binary("<=", Call("ROW"), Number(FIRST + LEFT_OUT + 10)),
        ),
    )
    na = ErrorValue("#N/A")
    xs = [na if x is None else RADIUS * x for x, _ in points()]
    ys = [na if y is None else RADIUS * y for _, y in points()]
    radius = NameRef("ÇıkışUzvu")
    return Sheet(
        TABLE,
        cells=(
            Cell(0, 0, "Table", TITLE),
            Cell(1, 0, "α [°]", HEAD),
            Cell(1, 1, "x", HEAD),
            Cell(1, 2, "y", HEAD),
        ),
        fills=(
            Fill(FIRST, 0, Binary("*", Binary("-", Call("ROW"), Number(FIRST + 1)), NameRef("Adım")), DEGREES, rows, 1,
                 tuple(5.0 * i for i in range(rows))),
            Fill(FIRST, 1, Call("IF", (gone, Call("NA"), Binary("*", radius, Call("COS", (Call("RADIANS", (angle,)),))))),
                 NUMBER, rows, 1, tuple(xs)),
            Fill(FIRST, 2, Call("IF", (gone, Call("NA"), Binary("*", radius, Call("SIN", (Call("RADIANS", (angle,)),))))),
                 NUMBER, rows, 1, tuple(ys)),
            # Both ways: B3/$R with mixed anchors.
            Fill(FIRST, 3, Binary("/", CellRef(FIRST, 1), cell(3, 1, FRONT)), NUMBER, rows, 2,
                 tuple(v if v is na else v / RADIUS for pair in zip(xs, ys, strict=True) for v in pair)),
            Fill(FIRST, 5, Call("IF", (Call("ISNA", (CellRef(FIRST, 1),)), Text("no position"), Text(""))), NOTE, rows, 1,
                 tuple("no position" if x is na else "" for x in xs)),
        ),
        columns=(Column(0, 0, 10), Column(1, 2, 12), Column(3, 4, 12, level=1), Column(5, 5, 16)),
        conditionals=(
            Conditional(Area(FIRST, 0, FIRST + STEPS, 5),
                        Binary("=", Binary("-", Call("ROW"), Number(FIRST + 1)), cell(6, 1, FRONT)),
                        Style(fill="FFE699", bold=True)),
        ),
        freeze=(FIRST, 1),
        selected=(FIRST, 0),
        print_setup=PrintSetup(landscape=False, repeat_rows=(0, 1), repeat_cols=(0, 0), footer="&C&A"),
    )  # fmt: skip


def _column(col: int) -> SeriesRef:
    return SeriesRef(TABLE, Area(FIRST, col, FIRST + STEPS, col))


def circle() -> Chart:
    return Chart(
        "Path",
        Anchor(2, 5, 360, 360, 10, 5),
        (
            Series(cell(1, 1, TABLE), _column(3), _column(4), line="2F5597", width=2, marker="circle",
                   marker_size=4, marker_fill="FFFFFF"),
            Series(cell(19, 0, FRONT), SeriesRef(FRONT, Area(20, 0, 21, 0)), SeriesRef(FRONT, Area(20, 1, 21, 1)),
                   line="C00000", width=3, show_name=True, label_side="above", in_legend=False),
        ),
        Axis(low=-1, high=1, step=0.5, visible=False, gridlines=False),
        Axis(low=-1, high=1, step=0.5, visible=False, gridlines=False),
        legend="",
        inner=(0.1, 0.1, 0.8, 0.8),
        name="Path",
        alt_text='The path, "true" scale',
    )  # fmt: skip


def curve() -> Chart:
    return Chart(
        "x and y over α",
        Anchor(2, 12, 480, 300),
        (
            Series("x [mm]", _column(0), _column(1), line="548235", width=1.5),
            Series("A!B1", _column(0), _column(2), line="C55A11", width=1.5, dash="dash"),
        ),
        Axis("α [°]", 0, 360, 45, "0"),
        Axis("x, y [mm]", number_format="0"),
        name="Curve",
    )


def sample() -> Workbook:
    """Two sheets and a hidden one, with all features, in Turkish and with awkward names."""
    source = Sheet(
        "_description",
        cells=tuple(Cell(i, 0, line) for i, line in enumerate(("[mechanism]", 'name = "=daire"', "R = 40"))),
        hidden=True,
    )
    return Workbook(
        (front(), table(), source),
        (Name("ÇıkışUzvu", FRONT, 3, 1), Name("Adım", FRONT, 5, 1), Name("a_1", FRONT, 4, 1)),
        Properties("Daire & çember", "Örnek", "made <by hand>", "circle, test", "tr"),
    )
