"""What stands in a written .xlsx, read back by others and element by element."""

from __future__ import annotations

import math
import subprocess
import sys
import zipfile
from dataclasses import replace

import openpyxl
import pytest
from lxml import etree
from samples import FIRST, FRONT, LEFT_OUT, STEPS, TABLE, circle, sample

from livesheet.diagnostics import OutputError
from livesheet.formats.xlsx.cells import can_be_shared
from livesheet.formats.xlsx.write import write_xlsx
from livesheet.formula.nodes import MAX_ROWS, Binary, CellRef, ErrorValue, NameRef, Number, Text, shifted
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from livesheet.workbook import Area, Cell, Fill, Name, PrintSetup, Sheet, Style, Validation, Workbook

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
X14 = "{http://schemas.microsoft.com/office/spreadsheetml/2009/9/main}"
REL = "{http://schemas.openxmlformats.org/package/2006/relationships}"
ID = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
CHART = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"
VML = {"v": "urn:schemas-microsoft-com:vml", "x": "urn:schemas-microsoft-com:office:excel"}


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    made = tmp_path_factory.mktemp("xlsx") / "sample.xlsx"
    write_xlsx(sample(), made)
    return made


@pytest.fixture(scope="module")
def parts(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def tree(parts, name):
    return etree.fromstring(parts[name])


def test_openpyxl_reads_the_formulas_and_the_values_back(path):
    formulas = openpyxl.load_workbook(path)
    values = openpyxl.load_workbook(path, data_only=True)
    for sheet in sample().sheets:
        for cell in sheet.cells:
            content = getattr(cell.content, "plain", cell.content)
            if content is not None:
                read = formulas[sheet.title].cell(cell.row + 1, cell.col + 1)
                assert read.value == (content.replace("\x01", "_x0001_") if isinstance(content, str) else content)
                assert read.data_type != "f"
        for fill in sheet.fills:
            for row in range(fill.row, fill.row + fill.rows):
                for col in range(fill.col, fill.col + fill.cols):
                    place = (row + 1, col + 1)
                    text = print_formula(shifted(fill.formula, row - fill.row, col - fill.col))
                    assert formulas[sheet.title].cell(*place).value == f"={text}"
                    value = fill.value(row, col)
                    read = values[sheet.title].cell(*place).value
                    # openpyxl has no value for an empty text
                    assert read == (str(value) if isinstance(value, ErrorValue) else value if value != "" else None)


def test_names_read_back(path):
    names = openpyxl.load_workbook(path).defined_names
    assert {name: names[name].attr_text for name in names} == {
        "ÇıkışUzvu": f"'{FRONT}'!$B$4",
        "Adım": f"'{FRONT}'!$B$6",
        "a_1": f"'{FRONT}'!$B$5",
    }


def test_inputs_keep_all_their_digits(parts):
    values = tree(parts, "xl/worksheets/sheet1.xml").iter(f"{MAIN}c")
    texts = {cell.get("r"): cell.findtext(f"{MAIN}v") for cell in values}
    assert texts["B5"] == "0.30000000000000004"
    assert texts["B4"] == "40"


@pytest.mark.parametrize(
    ("place", "kind", "value"),
    [
        ("B8", None, "6.283185307179586"),
        ("B9", "e", "#N/A"),
        ("B10", "e", "#DIV/0!"),
        ("B11", "str", "<Açı> 1.50"),
        ("B12", "b", "1"),
        ("B13", "str", ""),
        ("B14", None, "-4"),
    ],
)
def test_formula_cells_carry_typed_values(parts, place, kind, value):
    cell = next(c for c in tree(parts, "xl/worksheets/sheet1.xml").iter(f"{MAIN}c") if c.get("r") == place)
    assert cell.get("t") == kind
    assert (cell.findtext(f"{MAIN}v") or "") == value


def test_fill_down_runs_are_shared_formulas(parts):
    formulas = list(tree(parts, "xl/worksheets/sheet2.xml").iter(f"{MAIN}f"))
    heads = {f.get("si"): f.get("ref") for f in formulas if f.get("ref")}
    assert sorted(heads.values()) == ["A3:A75", "B3:B75", "C3:C75", "F3:F75"]  # D and E name another sheet
    assert all(f.text is None for f in formulas if f.get("t") and not f.get("ref"))
    count = {si: sum(f.get("si") == si for f in formulas) for si in heads if si}
    assert sorted(count.values()) == [73, 73, 73, 73]


@pytest.mark.parametrize(
    ("formula", "shared"),
    [
        ("A1+$B$2", True),
        ("A1+length", True),
        ('IF(SUM(A1:B2)>=-5%,"x"&TRUE,)', True),
        ("A1+Sheet2!$B$2", False),
        ("A1+Sheet2!B2", False),
        ("A1+Sheet2!$B2", False),
        ("SUM(Sheet2!$A1:$A9)", False),
        ("SUM(Sheet2!$A$1:$A$9)", False),
        ("SUM(Sheet2:Sheet3!$A$1)", False),
        ("Sheet2!length", False),
        ("SUM((A1:A2,B1:B2))", False),
        ("SUM(A1:B2 B1:B5)", False),
        ("SUM(A1:INDEX(B1:B5,2))", False),
        ("SUM({1,2})", False),
        ("A1+#REF!", False),
        ("IFS(A1>0,1)", False),
        ("LET(x,A1,x+1)", False),
        ("Pump(A1)", False),
        ("SUM(Table1[x])", False),
    ],
)
def test_what_can_be_shared(formula, shared):
    assert can_be_shared(Fill(0, 2, parse_formula(formula), rows=3)) is shared


def test_what_leaves_the_sheet_further_down_is_not_shared():
    assert can_be_shared(Fill(0, 2, CellRef(MAX_ROWS - 3, 0), rows=3))
    assert not can_be_shared(Fill(0, 2, CellRef(MAX_ROWS - 2, 0), rows=3))


def test_what_cannot_be_shared_is_written_out(tmp_path):
    formula = Binary("+", CellRef(0, 0, sheet="Other"), Number(1))
    book = Workbook((Sheet("One", fills=(Fill(0, 1, formula, rows=3, values=(1.0, 2.0, 3.0)),)), Sheet("Other")))
    write_xlsx(book, tmp_path / "a.xlsx")
    read = openpyxl.load_workbook(tmp_path / "a.xlsx")["One"]
    assert [read.cell(row, 2).value for row in (1, 2, 3)] == ["=Other!A1+1", "=Other!A2+1", "=Other!A3+1"]


def test_styles_are_named_and_inputs_unlocked(path):
    book = openpyxl.load_workbook(path)
    sheet = book[FRONT]
    assert {"Title", "Heading 3", "Input", "Calculation", "Angle", "Note text"} <= set(book.named_styles)
    assert sheet["B4"].style == sheet["B7"].style == "Input"
    assert (sheet["B4"].number_format, sheet["B7"].number_format) == ("0.0", "0")
    assert not sheet["B4"].protection.locked
    assert sheet["B8"].protection.locked
    assert sheet["B4"].fill.fgColor.rgb == "FFFFF2CC"
    assert sheet["A1"].font.sz == 16
    assert sheet["A3"].border.left.style == "thin"


def test_view_print_and_structure(path):
    book = openpyxl.load_workbook(path)
    front, table, source = book.worksheets
    assert (front.freeze_panes, table.freeze_panes) == ("A3", "B3")
    assert source.sheet_state == "hidden"
    assert front.sheet_view.selection[-1].activeCell == "B4"
    assert not front.sheet_view.showGridLines
    assert front.page_setup.orientation == "landscape"
    assert table.page_setup.orientation == "portrait"
    assert front.page_setup.paperSize == 9
    assert front.print_title_rows == "$1:$2"
    assert [str(area) for area in front.merged_cells.ranges] == ["A16:C16"]
    assert table.column_dimensions["D"].outlineLevel == 1
    assert front.row_dimensions[1].height == 22.5
    assert front["B4"].comment.text == "The radius.\nChange it & look."
    rules = {str(rule.sqref): rule for rule in front.data_validations.dataValidation}
    assert (rules["B4"].type, rules["B4"].operator, rules["B4"].formula1) == ("decimal", "greaterThan", "0")
    assert (rules["B7"].type, rules["B7"].formula1, rules["B7"].formula2) == ("whole", "0", str(STEPS))
    assert rules["A17"].formula1 == '"open,crossed"'
    assert rules["B6"].errorStyle == "warning"
    (area, (rule,)) = next(iter(front.conditional_formatting._cf_rules.items()))
    assert (str(area.sqref), rule.formula) == ("B8:B10", ["ISNA(B8)"])


def test_a_scale_and_a_column_that_begins_a_page(tmp_path):
    """Excel forgets breaks by hand where a sheet is fitted to pages."""
    setup = PrintSetup(landscape=False, scale=60, page_at=(2,))
    write_xlsx(Workbook((Sheet("S", (Cell(0, 0, 1.0),), print_setup=setup),)), tmp_path / "a.xlsx")
    page = openpyxl.load_workbook(tmp_path / "a.xlsx").active
    assert (page.page_setup.scale, page.page_setup.orientation, page.sheet_properties.pageSetUpPr.fitToPage) == (
        60, "portrait", None,
    )  # fmt: skip
    assert [found.id for found in page.col_breaks.brk] == [2]


def test_properties_are_the_workbooks_and_without_a_clock(path):
    properties = openpyxl.load_workbook(path).properties
    assert (properties.title, properties.language) == ("Daire & çember", "tr")
    assert properties.created == properties.modified
    assert properties.created.year == 2000


# The controls, part by part: what Excel needs to show them.


def relationships(parts):
    return {r.get("Id"): r for r in tree(parts, "xl/worksheets/_rels/sheet1.xml.rels").iter(f"{REL}Relationship")}


def test_controls_element_names_shape_and_part(parts):
    sheet = tree(parts, "xl/worksheets/sheet1.xml")
    order = [etree.QName(child).localname for child in sheet]
    assert order[-3:] == ["drawing", "legacyDrawing", "AlternateContent"]
    controls = list(sheet.iter(f"{MAIN}control"))
    assert [c.get("name") for c in controls] == ["Position", "Step by step"]
    assert [c.get("shapeId") for c in controls] == ["1025", "1026"]
    kinds = relationships(parts)
    assert [kinds[c.get(ID)].get("Target") for c in controls] == [
        "../ctrlProps/ctrlProp1.xml",
        "../ctrlProps/ctrlProp2.xml",
    ]
    assert all(kinds[c.get(ID)].get("Type").endswith("/officeDocument/2006/relationships/ctrlProp") for c in controls)
    choices = sheet.findall(".//{http://schemas.openxmlformats.org/markup-compatibility/2006}Choice")
    assert {choice.get("Requires") for choice in choices} == {"x14"}
    assert all(choice.nsmap["x14"] == X14[1:-1] for choice in choices)


def test_control_properties_parts(parts):
    scroll, spin = (tree(parts, f"xl/ctrlProps/ctrlProp{n}.xml") for n in (1, 2))
    assert scroll.tag == f"{X14}formControlPr"
    assert dict(scroll.attrib) == {
        "objectType": "Scroll", "dx": "16", "fmlaLink": "$B$7", "horiz": "1", "inc": "1", "max": "72", "min": "0",
        "page": "10", "val": "12",
    }  # fmt: skip
    assert spin.get("objectType") == "Spin"
    assert "horiz" not in spin.attrib


def test_content_types_name_the_control_parts(parts):
    types = tree(parts, "[Content_Types].xml")
    overrides = {o.get("PartName"): o.get("ContentType") for o in types if o.get("PartName")}
    for n in (1, 2):
        assert overrides[f"/xl/ctrlProps/ctrlProp{n}.xml"] == "application/vnd.ms-excel.controlproperties+xml"
    defaults = {o.get("Extension"): o.get("ContentType") for o in types if o.get("Extension")}
    assert defaults["vml"] == "application/vnd.openxmlformats-officedocument.vmlDrawing"


def test_vml_holds_controls_and_comments(parts):
    vml = tree(parts, "xl/drawings/vmlDrawing1.vml")
    shapes = vml.findall("v:shape", VML)
    assert [shape.get("id") for shape in shapes] == [f"_x0000_s{n}" for n in (1025, 1026, 1027, 1028)]
    kinds = [shape.find("x:ClientData", VML).get("ObjectType") for shape in shapes]
    assert kinds == ["Scroll", "Spin", "Note", "Note"]
    types = {kind.get("id") for kind in vml.findall("v:shapetype", VML)}
    assert {shape.get("type") for shape in shapes} == {f"#{kind}" for kind in types}
    data = {etree.QName(child).localname: child.text for child in shapes[0].find("x:ClientData", VML)}
    assert data == {
        "Anchor": "3, 4, 6, 2, 5, 37, 7, 5", "PrintObject": "False", "FmlaLink": "$B$7", "Val": "12", "Min": "0",
        "Max": "72", "Inc": "1", "Page": "10", "Horiz": None, "Dx": "16",
    }  # fmt: skip
    drawing = relationships(parts)[tree(parts, "xl/worksheets/sheet1.xml").find(f"{MAIN}legacyDrawing").get(ID)]
    assert drawing.get("Target") == "../drawings/vmlDrawing1.vml"


def test_every_relationship_has_its_part(parts):
    inside = [
        (name, relation.get("Target").removeprefix("/"))
        for name in parts
        if name.endswith(".rels")
        for relation in tree(parts, name)
        if relation.get("TargetMode") != "External"
    ]
    assert len(inside) > 5
    for name, target in inside:
        folder = name.split("_rels/")[0]
        base = folder.rstrip("/").split("/") if folder else []
        for step in target.split("/"):
            base = base[:-1] if step == ".." else [*base, step]
        assert "/".join(base) in parts, (name, target)


# Charts.


def test_charts_are_held_by_one_corner(parts):
    drawing = parts["xl/drawings/drawing1.xml"].decode()
    assert drawing.count("<xdr:oneCellAnchor>") == 2
    assert "twoCellAnchor" not in drawing
    assert f'cx="{360 * 9525}" cy="{360 * 9525}"' in drawing


def test_no_series_is_smooth_and_axes_keep_their_own_format(parts):
    for n in (1, 2):
        chart = tree(parts, f"xl/charts/chart{n}.xml")
        series = list(chart.iter(f"{CHART}ser"))
        assert series
        assert all(one.find(f"{CHART}smooth").get("val") == "0" for one in series)
        assert all(f.get("sourceLinked") == "0" for f in chart.iter(f"{CHART}numFmt"))
        assert chart.find(f".//{CHART}dispBlanksAs").get("val") == "gap"
        assert b"dispNaAsBlank" in parts[f"xl/charts/chart{n}.xml"]
        assert chart.find(f"{CHART}lang").get("val") == "tr-TR"


def test_circle_has_a_square_plot_and_fixed_axes(parts):
    chart = tree(parts, "xl/charts/chart1.xml")
    layout = chart.find(f".//{CHART}plotArea/{CHART}layout/{CHART}manualLayout")
    assert layout.find(f"{CHART}layoutTarget").get("val") == "inner"
    assert [float(layout.find(f"{CHART}{side}").get("val")) for side in "xywh"] == pytest.approx([0.1, 0.1, 0.8, 0.8])
    limits = [
        (s.find(f"{CHART}min").get("val"), s.find(f"{CHART}max").get("val")) for s in chart.iter(f"{CHART}scaling")
    ]
    assert limits == [("-1", "1"), ("-1", "1")]


def test_series_carry_their_values_and_gaps(parts):
    chart = tree(parts, "xl/charts/chart2.xml")
    cache = chart.find(f".//{CHART}yVal/{CHART}numRef/{CHART}numCache")
    assert cache.find(f"{CHART}ptCount").get("val") == str(STEPS + 1)
    there = {int(pt.get("idx")): float(pt.findtext(f"{CHART}v")) for pt in cache.iter(f"{CHART}pt")}
    assert there[0] == 40
    assert not any(LEFT_OUT <= index < LEFT_OUT + 10 for index in there)
    names = [s.find(f"{CHART}tx") for s in chart.iter(f"{CHART}ser")]
    assert [name.findtext(f".//{CHART}v") for name in names] == ["x [mm]", "A!B1"]
    assert names[1].find(f"{CHART}strRef") is None


def test_a_label_shows_the_name_of_its_series_from_a_cell(parts):
    bar = list(tree(parts, "xl/charts/chart1.xml").iter(f"{CHART}ser"))[1]
    assert bar.findtext(f"{CHART}tx/{CHART}strRef/{CHART}f") == f"'{FRONT}'!$A$20"
    assert bar.findtext(f"{CHART}tx/{CHART}strRef/{CHART}strCache/{CHART}pt/{CHART}v") == "40 mm"
    shown = {etree.QName(e).localname: e.get("val") for e in bar.find(f"{CHART}dLbls") if e.get("val")}
    assert shown == {
        "dLblPos": "t", "showLegendKey": "0", "showVal": "0", "showCatName": "0", "showSerName": "1",
        "showPercent": "0", "showBubbleSize": "0",
    }  # fmt: skip


# The file as a whole.


@pytest.mark.slow
def test_the_validator_finds_nothing(path):
    from openxml_audit import OpenXmlValidator

    result = OpenXmlValidator().validate(path)
    # Excel writes the attribute; the validator's table does not have it.
    real = [error for error in result.errors if "dispNaAsBlank" not in str(error.path)]
    assert not real, real


def test_equal_workbooks_give_equal_bytes(path, tmp_path):
    write_xlsx(sample(), tmp_path / "again.xlsx")
    assert (tmp_path / "again.xlsx").read_bytes() == path.read_bytes()


def test_all_that_excel_refuses_is_reported_at_once(tmp_path):
    long = Text("x" * 32768)
    sheets = (
        Sheet("a" * 32, cells=(Cell(0, 0, "y" * 32768),)),
        Sheet("a:b", fills=(Fill(1, 1, long, values=("",)),)),
        Sheet("Same"),
        Sheet("SAME"),
    )
    names = tuple(Name(name, "Same", 0, 0) for name in ("a1", "RC", "R1C", "XFE1", "Açı", "AÇI", "two words"))
    with pytest.raises(OutputError) as caught:
        write_xlsx(Workbook(sheets, (*names, Name("lost", "Nowhere", 0, 0))), tmp_path / "a.xlsx")
    text = str(caught.value)
    for word in ("longer than 31", "holds one of", "two sheets", '"a1"', '"RC"', '"R1C"', '"XFE1"', '"AÇI"',
                 '"two words"', "Nowhere", "32768 characters"):  # fmt: skip
        assert word in text
    assert not list(tmp_path.iterdir())


def test_a_formula_that_is_too_long_is_named_with_its_cell(tmp_path):
    formula = Number(1.0)
    for _ in range(60):
        formula = Binary("+", formula, NameRef("n" * 200))
    book = Workbook((Sheet("S", fills=(Fill(4, 2, formula, values=(1.0,)),)),))
    with pytest.raises(OutputError, match=r"S!C5: the formula has \d+ characters, Excel allows 8192"):
        write_xlsx(book, tmp_path / "a.xlsx")


def test_other_limits_of_excel(tmp_path):
    sheet = replace(
        sample().sheets[0],
        fills=(Fill(30, 0, Text("x" * 256), values=("",)),),
        charts=(replace(circle(), series=()),),
        controls=(replace(sample().sheets[0].controls[0], high=30001),),
        validations=(Validation(Area(0, 0, 0, 0), "list", choices=("a", "b,c")),),
    )
    with pytest.raises(OutputError) as caught:
        write_xlsx(Workbook((sheet,)), tmp_path / "a.xlsx")
    for words in ("0 series", "0 to 30000", "hold a comma"):
        assert words in str(caught.value)
    text = Sheet("S", fills=sheet.fills)
    with pytest.raises(OutputError, match="S!A31: the formula holds a text of 256 characters, Excel allows 255"):
        write_xlsx(Workbook((text,)), tmp_path / "a.xlsx")


@pytest.mark.parametrize("value", [math.nan, math.inf, None])
@pytest.mark.parametrize("rows", [1, 3])
def test_what_only_a_bug_can_bring_is_no_user_error(tmp_path, value, rows):
    fill = Fill(0, 0, Number(1), rows=rows, values=(1.0,) * (rows - 1) + (value,))
    with pytest.raises(ValueError, match="reached a file writer"):
        write_xlsx(Workbook((Sheet("S", fills=(fill,)),)), tmp_path / "a.xlsx")
    assert not list(tmp_path.iterdir())


def test_a_missing_value_and_a_double_cell_are_bugs(tmp_path):
    fill = Fill(0, 0, Number(1), rows=2, values=(1.0,))
    with pytest.raises(ValueError, match="has 1 values"):
        write_xlsx(Workbook((Sheet("S", fills=(fill,)),)), tmp_path / "a.xlsx")
    both = Sheet("S", cells=(Cell(1, 0, 3.0),), fills=(replace(fill, values=(1.0, 1.0)),))
    with pytest.raises(ValueError, match="S!A2 is written twice"):
        write_xlsx(Workbook((both,)), tmp_path / "a.xlsx")


def test_equal_looks_under_two_names_stay_two_styles(tmp_path):
    one, two = Style(name="One", bold=True), Style(name="Two", bold=True)
    book = Workbook((Sheet("S", cells=(Cell(0, 0, 1.0, one), Cell(1, 0, 2.0, two))),))
    write_xlsx(book, tmp_path / "a.xlsx")
    sheet = openpyxl.load_workbook(tmp_path / "a.xlsx")["S"]
    assert (sheet["A1"].style, sheet["A2"].style) == ("One", "Two")


def test_long_columns_are_complete(tmp_path):
    rows = 3000
    values = [0.1 * i for i in range(rows)]
    values[1500:1503] = [ErrorValue("#N/A"), "text", True]
    formula = Binary("*", CellRef(0, 1), Number(2))
    book = Workbook((Sheet("S", fills=(Fill(0, 0, formula, rows=rows, values=values),)),))
    write_xlsx(book, tmp_path / "a.xlsx")
    read = openpyxl.load_workbook(tmp_path / "a.xlsx", data_only=True)["S"]
    assert [read.cell(row + 1, 1).value for row in range(rows)] == [
        str(v) if isinstance(v, ErrorValue) else v for v in values
    ]
    assert openpyxl.load_workbook(tmp_path / "a.xlsx")["S"].cell(rows, 1).value == f"=B{rows}*2"


def test_first_row_of_the_table(path):
    assert openpyxl.load_workbook(path)[TABLE].cell(FIRST + 1, 1).value == "=(ROW()-3)*Adım"


def test_the_second_workbook_of_a_process_has_the_same_bytes(tmp_path):
    """XlsxWriter writes into the options it is given: they must not be shared."""
    code = (
        "import sys; from pathlib import Path\n"
        "from livesheet.formats import write\n"
        "from livesheet.workbook import Cell, Sheet, Workbook\n"
        "book = Workbook((Sheet('S', (Cell(0, 0, 1.0),)),))\n"
        "for name in sys.argv[1:]: write(book, Path(name))\n"
    )
    paths = [tmp_path / "first.xlsx", tmp_path / "second.xlsx"]
    subprocess.run([sys.executable, "-c", code, *map(str, paths)], check=True)
    assert paths[0].read_bytes() == paths[1].read_bytes()
