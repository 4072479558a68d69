"""What stands in a written .ods, element by element, and that the schema knows all of it."""

from __future__ import annotations

import math
import zipfile

import pytest
from lxml import etree
from samples import FIRST, FRONT, LEFT_OUT, STEPS, TABLE, sample

from livesheet.diagnostics import OutputError
from livesheet.formats.ods.charts import chart_content
from livesheet.formats.ods.write import write_ods
from livesheet.formula.nodes import Binary, CellRef, ErrorValue, Number, shifted
from livesheet.formula.printer import print_formula
from livesheet.workbook import (
    Anchor,
    Area,
    Axis,
    Cell,
    Chart,
    Column,
    Conditional,
    Fill,
    Name,
    PrintSetup,
    Series,
    SeriesRef,
    Sheet,
    Style,
    Workbook,
)
from odf import schema_errors

NS = {
    "office": "urn:oasis:names:tc:opendocument:xmlns:office:1.0",
    "table": "urn:oasis:names:tc:opendocument:xmlns:table:1.0",
    "text": "urn:oasis:names:tc:opendocument:xmlns:text:1.0",
    "style": "urn:oasis:names:tc:opendocument:xmlns:style:1.0",
    "draw": "urn:oasis:names:tc:opendocument:xmlns:drawing:1.0",
    "svg": "urn:oasis:names:tc:opendocument:xmlns:svg-compatible:1.0",
    "chart": "urn:oasis:names:tc:opendocument:xmlns:chart:1.0",
    "form": "urn:oasis:names:tc:opendocument:xmlns:form:1.0",
    "dc": "http://purl.org/dc/elements/1.1/",
    "fo": "urn:oasis:names:tc:opendocument:xmlns:xsl-fo-compatible:1.0",
    "xlink": "http://www.w3.org/1999/xlink",
    "config": "urn:oasis:names:tc:opendocument:xmlns:config:1.0",
    "manifest": "urn:oasis:names:tc:opendocument:xmlns:manifest:1.0",
    "calcext": "urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0",
    "loext": "urn:org:documentfoundation:names:experimental:office:xmlns:loext:1.0",
}


def get(element, name):
    prefix, local = name.split(":")
    return element.get(f"{{{NS[prefix]}}}{local}")


def written(workbook, folder):
    path = folder / "a.ods"
    write_ods(workbook, path)
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def tree(parts, name="content.xml"):
    return etree.fromstring(parts[name])


def grid(root, title):
    """Every cell of a table by place, with what is repeated unrolled (up to 30 columns)."""
    (table,) = root.xpath(f"//table:table[@table:name={quoted(title)}]", namespaces=NS)
    cells, row = {}, 0
    for element in table.iter(f"{{{NS['table']}}}table-row"):
        col = 0
        for cell in element:
            for _ in range(min(int(get(cell, "table:number-columns-repeated") or 1), 30)):
                cells[row, col] = cell
                col += 1
        row += int(get(element, "table:number-rows-repeated") or 1)
    return cells


def quoted(text):
    return f'"{text}"'


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    made = tmp_path_factory.mktemp("ods") / "sample.ods"
    write_ods(sample(), made)
    return made


@pytest.fixture(scope="module")
def parts(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture(scope="module")
def front(parts):
    return grid(tree(parts), FRONT)


@pytest.fixture(scope="module")
def table(parts):
    return grid(tree(parts), TABLE)


def test_the_schema_finds_nothing(path):
    assert schema_errors(path) == []


def test_equal_workbooks_give_equal_bytes(path, tmp_path):
    write_ods(sample(), tmp_path / "again.ods")
    assert (tmp_path / "again.ods").read_bytes() == path.read_bytes()


def test_the_media_type_comes_first_and_is_not_compressed(path):
    data = path.read_bytes()
    assert data[30:84] == b"mimetypeapplication/vnd.oasis.opendocument.spreadsheet"


def test_every_part_is_in_the_manifest(parts):
    listed = {get(entry, "manifest:full-path") for entry in tree(parts, "META-INF/manifest.xml")}
    assert listed - {"/", "Object 1/", "Object 2/"} == set(parts) - {"mimetype", "META-INF/manifest.xml"}


def test_formulas_and_values_of_every_cell(parts):
    root = tree(parts)
    for sheet in sample().sheets:
        cells = grid(root, sheet.title)
        for fill in sheet.fills:
            for row in range(fill.row, fill.row + fill.rows):
                for col in range(fill.col, fill.col + fill.cols):
                    node = shifted(fill.formula, row - fill.row, col - fill.col)
                    cell = cells[row, col]
                    assert get(cell, "table:formula") == "of:=" + print_formula(node, "openformula")
                    assert value_of(cell) == fill.value(row, col)


def value_of(cell):
    kind = get(cell, "office:value-type")
    if get(cell, "calcext:value-type") == "error":
        return ErrorValue(cell.findtext("text:p", namespaces=NS))
    if kind == "float":
        return float(get(cell, "office:value"))
    if kind == "boolean":
        return get(cell, "office:boolean-value") == "true"
    return cell.findtext("text:p", namespaces=NS) or ""


@pytest.mark.parametrize(
    ("place", "text"),
    [
        ((8, 0), "=1+1"),
        ((9, 0), "+A1 @x  _x0041_ ]]> <text:tab/>\u00a0tab"),
        ((10, 0), "<r>no run</r>"),
        ((13, 0), None),
    ],
)
def test_texts_are_texts(front, place, text):
    cell = front[place]
    assert get(cell, "office:value-type") == "string"
    assert get(cell, "table:formula") is None
    if text and "tab" not in text:
        assert cell.findtext("text:p", namespaces=NS) == text


def test_spaces_tabs_and_line_breaks_survive(front):
    spaces = front[13, 0].find("text:p", NS)
    assert [get(s, "text:c") for s in spaces.findall("text:s", NS)] == ["2", "2"]
    assert front[9, 0].find("text:p/text:tab", NS) is not None
    assert [p.text for p in front[14, 0].findall("text:p", NS)] == ["two", "lines"]


def test_rich_text_has_subscripts(front):
    spans = front[3, 0].findall("text:p/text:span", NS)
    assert [(get(s, "text:style-name"), s.text) for s in spans] == [("italic", "R"), ("sub", "12"), ("super", "2")]


def test_inputs_keep_all_their_digits(front):
    assert get(front[4, 1], "office:value") == "0.30000000000000004"


def test_merged_cells_cover_their_neighbours(front):
    assert get(front[15, 0], "table:number-columns-spanned") == "3"
    assert get(front[15, 0], "table:number-rows-spanned") == "1"
    assert {etree.QName(front[15, col]).localname for col in (1, 2)} == {"covered-table-cell"}
    assert get(front[15, 3], "office:value") == "40"


def test_names_are_those_of_the_workbook(parts):
    names = tree(parts).findall(".//table:named-expressions/table:named-range", NS)
    assert {get(n, "table:name"): get(n, "table:cell-range-address") for n in names} == {
        "ÇıkışUzvu": f"$'{FRONT}'.$B$4",
        "Adım": f"$'{FRONT}'.$B$6",
        "a_1": f"$'{FRONT}'.$B$5",
    }


def test_styles_are_named_and_carry_number_formats(parts, front):
    root, common = tree(parts), tree(parts, "styles.xml")
    shown = {get(s, "style:name"): get(s, "style:display-name") for s in common.iter(f"{{{NS['style']}}}style")}
    assert {"Title", "Heading 3", "Input", "Calculation", "Angle", "Note text"} <= set(shown.values())
    styles = {get(s, "style:name"): s for s in root.iter(f"{{{NS['style']}}}style")}
    used = styles[get(front[3, 1], "table:style-name")]
    assert shown[get(used, "style:parent-style-name")] == "Input"
    cell = used.find("style:table-cell-properties", NS)
    assert get(cell, "fo:background-color") == "#FFF2CC"
    assert get(cell, "style:cell-protect") == "none"
    data = get(used, "style:data-style-name")
    (number,) = root.xpath(f"//*[@style:name='{data}']/*", namespaces=NS)
    assert number.get("{urn:oasis:names:tc:opendocument:xmlns:datastyle:1.0}decimal-places") == "1"


def test_conditions_map_to_styles(parts, front, table):
    root = tree(parts)
    styles = {get(s, "style:name"): s for s in root.iter(f"{{{NS['style']}}}style")}
    maps = styles[get(front[8, 1], "table:style-name")].findall("style:map", NS)
    assert [get(m, "style:condition") for m in maps] == ["is-true-formula(ISNA([.B8]))"]
    assert get(maps[0], "style:base-cell-address") == f"'{FRONT}'.B8"
    for col in range(6):
        style = styles[get(table[FIRST + STEPS, col], "table:style-name")]
        assert len(style.findall("style:map", NS)) == 1
    assert not styles[get(front[16, 1], "table:style-name")].findall("style:map", NS)


def test_empty_cells_under_a_condition_get_it_too(tmp_path):
    rule = Conditional(Area(1, 1, 4, 3), Binary("=", CellRef(1, 0), Number(1)), Style(fill="FF0000"))
    parts = written(Workbook((Sheet("S", cells=(Cell(2, 2, 5.0),), conditionals=(rule,)),)), tmp_path)
    cells = grid(tree(parts), "S")
    styles = {(row, col) for (row, col), cell in cells.items() if get(cell, "table:style-name")}
    assert styles == {(row, col) for row in range(1, 5) for col in range(1, 4)}
    assert schema_errors(tmp_path / "a.ods") == []


def test_validations(parts, front):
    rules = {get(v, "table:name"): v for v in tree(parts).iter(f"{{{NS['table']}}}content-validation")}

    def condition(row, col):
        return get(rules[get(front[row, col], "table:content-validation-name")], "table:condition")

    assert condition(3, 1) == "of:cell-content-is-decimal-number() and cell-content()>0"
    assert condition(6, 1) == f"of:cell-content-is-whole-number() and cell-content-is-between(0,{STEPS})"
    assert condition(16, 0) == 'of:cell-content-is-in-list("open";"crossed")'
    assert condition(5, 1) == "of:is-true-formula([.$B$6]>0)"
    radius = rules[get(front[3, 1], "table:content-validation-name")]
    assert get(radius, "table:base-cell-address") == f"'{FRONT}'.B4"
    assert radius.findtext("table:help-message/text:p", namespaces=NS) == "A length above 0 <mm>"
    assert get(radius.find("table:error-message", NS), "table:message-type") == "stop"


def test_notes(front):
    note = front[3, 1].find("office:annotation", NS)
    assert [p.text for p in note.findall("text:p", NS)] == ["The radius.", "Change it & look."]
    assert note.findtext("dc:date", namespaces=NS).startswith("2000")


def test_controls_are_bound_to_their_cell(parts, front):
    root = tree(parts)
    scroll, spin = root.iter(f"{{{NS['form']}}}value-range")
    expected = {"linked-cell": f"'{FRONT}'.B7", "value": "12", "min-value": "0", "max-value": "72", "step-size": "1"}
    for control in (scroll, spin):
        assert {key: get(control, f"form:{key}") for key in expected} == expected
    assert get(scroll, "form:control-implementation") == "ooo:com.sun.star.form.component.ScrollBar"
    assert get(scroll, "form:page-step-size") == "10"
    assert get(spin, "form:control-implementation") == "ooo:com.sun.star.form.component.SpinButton"
    assert [get(c, "form:orientation") for c in (scroll, spin)] == ["horizontal", "vertical"]
    shape = front[6, 3].find("draw:control", NS)
    assert get(shape, "draw:control") == get(scroll, "form:id")
    assert (get(shape, "svg:width"), get(shape, "svg:height")) == ("150pt", "15pt")
    assert get(shape, "draw:style-name") == "frame"


def test_frames_of_charts_have_no_box_and_keep_their_size(parts, front):
    frame = front[2, 5].find("draw:frame", NS)
    assert (get(frame, "svg:width"), get(frame, "svg:height")) == ("270pt", "270pt")
    assert get(frame, "draw:name") == "Path"
    assert frame.findtext("svg:desc", namespaces=NS) == 'The path, "true" scale'
    (style,) = tree(parts).xpath("//style:style[@style:name='frame']/style:graphic-properties", namespaces=NS)
    assert (get(style, "draw:stroke"), get(style, "draw:fill")) == ("none", "none")
    objects = [get(o, "xlink:href") for o in tree(parts).iter(f"{{{NS['draw']}}}object")]
    assert objects == ["./Object 1", "./Object 2"]


def test_the_circles_chart(parts):
    chart = tree(parts, "Object 1/content.xml")
    region = chart.find(".//chart:plot-area/chart:coordinate-region", NS)
    assert [get(region, f"svg:{side}") for side in ("x", "y", "width", "height")] == ["27pt", "27pt", "216pt", "216pt"]
    series = chart.findall(".//chart:series", NS)
    assert [get(s, "chart:label-cell-address") for s in series] == [
        "'Ömer''s table'.B2:'Ömer''s table'.B2",
        f"'{FRONT}'.A20:'{FRONT}'.A20",
    ]
    assert get(series[0], "chart:values-cell-range-address") == "'Ömer''s table'.E3:'Ömer''s table'.E75"
    domains = [get(s.find("chart:domain", NS), "table:cell-range-address") for s in series]
    assert domains[0] == "'Ömer''s table'.D3:'Ömer''s table'.D75"
    styles = {get(s, "style:name"): s for s in chart.iter(f"{{{NS['style']}}}style")}
    for axis in chart.findall(".//chart:axis", NS):
        look = styles[get(axis, "chart:style-name")].find("style:chart-properties", NS)
        assert (get(look, "chart:minimum"), get(look, "chart:maximum")) == ("-1", "1")
        assert get(look, "chart:visible") == "false"
        assert get(look, "chart:link-data-style-to-source") == "false"
    label = styles[get(series[1], "chart:style-name")].find("style:chart-properties", NS)
    assert get(label, "chart:data-label-series") == "true"
    assert get(label, "chart:data-label-number") == "none"
    assert chart.find(".//chart:legend", NS) is None


def test_separators_in_names_of_series_survive():
    """LibreOffice cuts a name at its list separator and shows "Column B" in its place: other signs look the same."""
    ref = SeriesRef("A", Area(0, 0, 9, 0))
    chart = Chart("", Anchor(0, 0, 100, 100), (Series("v_C,x; y", ref, ref),), Axis(), Axis())
    assert 'label-string="&quot;v_C\u201ax\u037e y&quot;"' in chart_content(chart)


def test_the_curves_chart(parts):
    chart = tree(parts, "Object 2/content.xml")
    assert [get(s, "loext:label-string") for s in chart.findall(".//chart:series", NS)] == ['"x [mm]"', '"A!B1"']
    circle = tree(parts, "Object 1/content.xml").findall(".//chart:series", NS)
    assert [get(s, "loext:hide-legend") for s in circle] == [None, "true"]
    assert [t.text for t in chart.findall(".//chart:title/text:p", NS)] == ["x and y over α", "α [°]", "x, y [mm]"]
    plot = chart.find(".//chart:plot-area", NS)
    (look,) = chart.xpath(f"//style:style[@style:name='{get(plot, 'chart:style-name')}']/*", namespaces=NS)
    assert get(look, "chart:treat-empty-cells") == "leave-gap"
    assert get(look, "chart:include-hidden-cells") == "true"
    dashes = tree(parts, "Object 2/styles.xml").iter(f"{{{NS['draw']}}}stroke-dash")
    assert "dash" in {get(d, "draw:name") for d in dashes}
    assert "smooth" not in parts["Object 2/content.xml"].decode()


def test_frozen_panes_cursor_and_grid(parts):
    settings = tree(parts, "settings.xml")
    entries = settings.xpath("//config:config-item-map-named/config:config-item-map-entry", namespaces=NS)
    views = {get(e, "config:name"): {get(i, "config:name"): i.text for i in e} for e in entries}
    assert list(views) == [FRONT, TABLE, "_description"]
    view = views[FRONT]
    assert (view["VerticalSplitMode"], view["VerticalSplitPosition"]) == ("2", "2")
    assert (view["HorizontalSplitMode"], view["CursorPositionX"], view["CursorPositionY"]) == ("0", "1", "3")
    assert (view["ZoomValue"], view["ShowGrid"]) == ("100", "false")
    assert views[TABLE]["HorizontalSplitPosition"] == "1"


def test_hidden_sheet_pages_and_headings(parts):
    root, common = tree(parts), tree(parts, "styles.xml")
    shown = [get(p, "table:display") for p in root.iter(f"{{{NS['style']}}}table-properties")]
    assert shown == ["true", "true", "false"]
    layouts = list(common.iter(f"{{{NS['style']}}}page-layout-properties"))
    assert [get(layout, "style:print-orientation") for layout in layouts] == ["landscape", "portrait", "landscape"]
    assert {get(layout, "style:first-page-number") for layout in layouts} == {
        "continue"
    }  # else each sheet has a page 1
    tables = root.findall(".//table:table", NS)
    assert get(tables[0], "table:print-ranges") == f"'{FRONT}'.A1:'{FRONT}'.U41"
    for one in tables[:2]:
        heading = one.find("table:table-header-rows", NS)
        assert sum(int(get(row, "table:number-rows-repeated") or 1) for row in heading) == 2
    footer = common.find(".//style:footer", NS)
    assert footer.find("style:region-left/text:p/text:sheet-name", NS) is not None
    assert [etree.QName(e).localname for e in footer.find("style:region-center/text:p", NS)] == [
        "page-number",
        "page-count",
    ]
    assert footer.findtext("style:region-right/text:p", namespaces=NS) == "<mechsheet> & co"


@pytest.mark.parametrize("heading", [(0, 0), (1, 2), (3, 6), (5, 6)])
def test_repeated_rows_anywhere(tmp_path, heading):
    fill = Fill(1, 0, Number(1), rows=4, values=(1.0,) * 4)
    book = Workbook((Sheet("S", fills=(fill,), print_setup=PrintSetup(repeat_rows=heading)),))
    root = tree(written(book, tmp_path))
    before = root.find(".//table:table-header-rows", NS)
    count = lambda rows: sum(int(get(row, "table:number-rows-repeated") or 1) for row in rows)  # noqa: E731
    earlier = [e for e in before.getparent() if e.tag.endswith("}table-row") and before in e.itersiblings()]
    assert (count(earlier), count(before)) == (heading[0], heading[1] - heading[0] + 1)
    assert [value_of(grid(root, "S")[row, 0]) for row in range(1, 5)] == [1.0] * 4
    assert schema_errors(tmp_path / "a.ods") == []


def test_a_scale_and_a_column_that_begins_a_page(tmp_path):
    setup = PrintSetup(landscape=False, scale=60, page_at=(2,))
    sheet = Sheet("S", (Cell(0, 0, 1.0),), columns=(Column(0, 1, 9), Column(2, 5, 9)), print_setup=setup)
    root = tree(written(Workbook((sheet,)), tmp_path))
    styles = {get(style, "style:name"): style for style in root.iter(f"{{{NS['style']}}}style")}
    begins = []
    for column in root.iter(f"{{{NS['table']}}}table-column"):
        properties = styles[get(column, "table:style-name")].find("style:table-column-properties", NS)
        begins += [get(properties, "fo:break-before") == "page"] * int(
            get(column, "table:number-columns-repeated") or 1
        )
    assert begins[:7] == [False, False, True, False, False, False, False]
    with zipfile.ZipFile(tmp_path / "a.ods") as archive:
        page = etree.fromstring(archive.read("styles.xml")).find(".//style:page-layout-properties", NS)
    assert (get(page, "style:scale-to"), get(page, "style:scale-to-X")) == ("60%", None)
    assert schema_errors(tmp_path / "a.ods") == []


def test_columns_widths_and_groups(tmp_path):
    columns = (Column(1, 1, 10), Column(2, 3, 5, level=1), Column(4, 4, 5, level=2, hidden=True), Column(6, 6, 20))
    root = tree(written(Workbook((Sheet("S", columns=columns),)), tmp_path))
    styles = {get(s, "style:name"): s for s in root.iter(f"{{{NS['style']}}}style")}
    found = []
    for column in root.iter(f"{{{NS['table']}}}table-column"):
        depth = sum(1 for parent in column.iterancestors() if parent.tag.endswith("column-group"))
        width = get(
            styles[get(column, "table:style-name")].find("style:table-column-properties", NS), "style:column-width"
        )
        found.append((int(get(column, "table:number-columns-repeated") or 1), width, depth))
    # A digit is 7.4 pixels wide and a column has 5 more; 96 pixels are 72 points.
    assert found[:6] == [
        (1, "48pt", 0),
        (1, "59.25pt", 0),
        (2, "31.5pt", 1),
        (1, "31.5pt", 2),
        (1, "48pt", 0),
        (1, "114.75pt", 0),
    ]
    assert schema_errors(tmp_path / "a.ods") == []


def test_properties_and_language(parts):
    meta, common = tree(parts, "meta.xml"), tree(parts, "styles.xml")
    assert meta.findtext(".//dc:title", namespaces=NS) == "Daire & çember"
    assert meta.findtext(".//dc:date", namespaces=NS) == "2000-01-01T00:00:00"
    text = common.find(".//style:default-style/style:text-properties", NS)
    assert (get(text, "fo:language"), get(text, "fo:country")) == ("tr", "TR")


def test_rows_that_do_not_exist_are_errors(table):
    assert value_of(table[FIRST + LEFT_OUT, 1]) == ErrorValue("#N/A")
    assert get(table[FIRST + LEFT_OUT, 1], "office:string-value") == ""


@pytest.mark.parametrize("value", [math.nan, -math.inf, None])
def test_what_only_a_bug_can_bring_is_no_user_error(tmp_path, value):
    book = Workbook((Sheet("S", fills=(Fill(0, 0, Number(1), rows=2, values=(1.0, value)),)),))
    with pytest.raises(ValueError, match="reached a file writer"):
        write_ods(book, tmp_path / "a.ods")
    assert not list(tmp_path.iterdir())


def test_bad_names_are_refused(tmp_path):
    book = Workbook((Sheet("S"),), (Name("A1", "S", 0, 0),))
    with pytest.raises(OutputError, match='the cell name "A1"'):
        write_ods(book, tmp_path / "a.ods")


def test_an_empty_sheet_is_valid(tmp_path):
    write_ods(Workbook((Sheet("S"),)), tmp_path / "a.ods")
    assert schema_errors(tmp_path / "a.ods") == []


def test_long_columns_are_complete(tmp_path):
    rows = 3000
    values = [0.1 * i for i in range(rows)]
    values[1500:1503] = [ErrorValue("#N/A"), "text", True]
    formula = Binary("*", CellRef(0, 1), Number(2))
    book = Workbook((Sheet("S", fills=(Fill(0, 0, formula, rows=rows, values=values),)),))
    cells = grid(tree(written(book, tmp_path)), "S")
    assert [value_of(cells[row, 0]) for row in range(rows)] == values
    assert get(cells[rows - 1, 0], "table:formula") == f"of:=[.B{rows}]*2"
