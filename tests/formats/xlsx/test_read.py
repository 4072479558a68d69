"""Reading .xlsx files of every origin, and refusing what is none."""

import openpyxl
import pytest
import xlsxwriter
from hypothesis import given, settings
from hypothesis import strategies as st
from xlsx_files import MAIN, packed, parts_of

from chosen import examples
from livesheet.diagnostics import WorkbookError
from livesheet.engine import evaluate
from livesheet.formats import update_values
from livesheet.formats.xlsx.read import read_xlsx
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.printer import print_formula
from livesheet.formula.references import area_name
from mechsheet.checking.programs import convert_with_libreoffice

NA = ErrorValue("#N/A")


@pytest.fixture
def read(tmp_path):
    """Reads a workbook from its parts, or from the XML of one sheet's rows."""

    def reader(parts, **more):
        path = tmp_path / "book.xlsx"
        path.write_bytes(packed(parts_of(parts, **more) if isinstance(parts, str) else parts))
        return read_xlsx(path)

    return reader


def blocks(book, sheet=0):
    return {area_name(b.row, b.col, b.rows, b.cols): print_formula(b.formula) for b in book.sheets[sheet].blocks}


def constants(book, sheet=0):
    return {area_name(row, col, 1, 1): value for row, col, value in book.sheets[sheet].constants.items()}


def cached(book, sheet=0):
    return {area_name(row, col, 1, 1): value for row, col, value in book.sheets[sheet].cached.items()}


# --- what cells hold ------------------------------------------------------------------------------------------------


def test_kinds_of_cells(read):
    book = read(
        '<row r="1"><c r="A1"><v>1.5</v></c><c r="B1" t="s"><v>1</v></c><c r="C1" t="b"><v>1</v></c>'
        '<c r="D1" t="e"><v>#N/A</v></c>'
        '<c r="E1" t="inlineStr"><is><r><t>in</t></r><r><t xml:space="preserve"> line</t></r><rPh><t>no</t></rPh></is></c>'
        '<c r="F1" s="3"/><c r="G1"><v></v></c><c r="H1" t="str"><v>a&amp;b&#10;_x0041_</v></c></row>'
        '<row><c><v>-1E-3</v></c><c t="n"><v> 7 </v></c></row>',
        strings="<si><t>zero</t></si><si><r><t>on</t></r><r><t>e</t></r><rPh><t>not</t></rPh></si>",
    )
    assert constants(book) == {
        "A1": 1.5, "B1": "one", "C1": True, "D1": NA, "E1": "in line", "H1": "a&b\nA", "A2": -0.001, "B2": 7.0,
    }  # fmt: skip


def test_formulas_with_every_kind_of_stored_value(read):
    book = read(
        '<row r="2"><c r="A2"><f>1+1</f><v>2</v></c><c r="B2" t="str"><f>"a"&amp;"b"</f><v>ab</v></c>'
        '<c r="C2" t="b"><f>1&lt;2</f><v>1</v></c><c r="D2" t="e"><f>NA()</f><v>#N/A</v></c><c r="E2"><f>B1</f></c>'
        '<c r="F2" t="str"><f>""</f><v></v></c></row>'
    )
    assert blocks(book) == {"A2": "1+1", "B2": '"a"&"b"', "C2": "1<2", "D2": "NA()", "E2": "B1", "F2": '""'}
    assert cached(book) == {"A2": 2.0, "B2": "ab", "C2": True, "D2": NA, "F2": ""}
    assert constants(book) == {}


def test_a_prefix_before_every_tag_and_any_order_of_attributes(read):
    parts = parts_of("")
    parts["xl/worksheets/sheet1.xml"] = (
        f'<x:worksheet xmlns:x="{MAIN}"><x:sheetData><x:row spans="1:2" r="1"><x:c t="n" r="A1"><x:v>3</x:v></x:c>'
        '<!-- nothing --><x:c r="B1"><x:f><![CDATA[A1<4]]></x:f><x:v>1</x:v></x:c></x:row></x:sheetData></x:worksheet>'
    )
    book = read(parts)
    assert (constants(book), blocks(book)) == ({"A1": 3.0}, {"B1": "A1<4"})


# --- formulas gathered into blocks ----------------------------------------------------------------------------------


def rows(texts):
    """Rows of formulas, one list of texts a row; None leaves a cell out."""
    found = []
    for r, row in enumerate(texts, 1):
        cells = (f'<c r="{chr(65 + c)}{r}"><f>{text}</f><v>0</v></c>' for c, text in enumerate(row) if text)
        found.append(f'<row r="{r}">{"".join(cells)}</row>')
    return "".join(found)


def test_full_texts_make_runs(read):
    formulas = [
        [f"E{r}*2+$F$1", f"SUM(E$1:E{r})", f"Sheet9!A{r + 5}" if r != 3 else "7", f'"A{r}"'] for r in range(1, 12)
    ]
    book = read(rows(formulas))
    assert blocks(book) == {
        "A1:A11": "E1*2+$F$1", "B1:B11": "SUM(E$1:E1)", "C1:C2": "Sheet9!A6", "C3": "7", "C4:C11": "Sheet9!A9",
        **{f"D{r}": f'"A{r}"' for r in range(1, 12)},
    }  # fmt: skip


def test_what_looks_like_a_reference_and_is_none_breaks_no_run(read):
    formulas = [[f"LOG10(E{r})+a_1", f"'A1'!E{r}", f'IF(E{r}=1,"E1",A1b)', f"10+E{r}"] for r in range(9, 12)]
    book = read(rows([[None]] * 8 + formulas))
    assert set(blocks(book)) == {"A9:A11", "B9:B11", "C9:C11", "D9:D11"}


def test_columns_side_by_side_make_tables(read):
    formulas = [[f"{c}$9*$Z{r}" for c in "ABC"] + [f"Y{r}"] for r in range(1, 4)]
    assert blocks(read(rows(formulas))) == {"A1:C3": "A$9*$Z1", "D1:D3": "Y1"}


def test_shared_formulas(read):
    """Excel's way: one text, members by number, with holes, over several columns, the first cell anywhere."""
    book = read(
        '<row r="1"><c r="A1"><f t="shared" ref="A1:B3" si="0">D1+$E$1</f><v>1</v></c>'
        '<c r="B1"><f t="shared" si="0"/><v>2</v></c></row>'
        '<row r="2"><c r="A2"><f t="shared" si="0"/><v>3</v></c><c r="B2"><v>9</v></c></row>'
        '<row r="3"><c r="A3"><f t="shared" si="0"/><v>4</v></c><c r="B3"><f t="shared" si="0"></f><v>5</v></c>'
        '<c r="C3"><f t="shared" ref="C3" si="1">A3</f></c></row>'
    )
    assert blocks(book) == {"A1:A3": "D1+$E$1", "B1": "E1+$E$1", "B3": "E3+$E$1", "C3": "A3"}
    assert constants(book) == {"B2": 9.0}
    assert cached(book) == {"A1": 1.0, "A2": 3.0, "A3": 4.0, "B1": 2.0, "B3": 5.0}


# --- the workbook around them ---------------------------------------------------------------------------------------


def test_names_and_calendar(read):
    book = read(
        '<row r="1"><c r="A1"><v>2</v></c></row>',
        names='<definedName name="rate">S!$A$1</definedName><definedName name="own" localSheetId="0">S!$A$1*2</definedName>'
        '<definedName name="_xlnm.Print_Area" localSheetId="0">S!$A$1:$B$2</definedName>'
        '<definedName name="broken">[1]Other!$A$1</definedName><definedName name="lost" localSheetId="7">1</definedName>',
        workbook='<workbookPr date1904="1"/>',
    )
    assert {(n.name, n.sheet, print_formula(n.formula)) for n in book.names} == {
        ("rate", None, "S!$A$1"),
        ("own", "S", "S!$A$1*2"),
        ("broken", None, "[1]Other!$A$1"),
    }
    assert book.date1904
    assert book.source.endswith("book.xlsx")


def test_several_sheets_and_a_chart_sheet(tmp_path):
    path = tmp_path / "book.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        workbook.add_worksheet("One").write_number(0, 0, 1)
        chart = workbook.add_chart({"type": "line"})
        chart.add_series({"values": "=One!$A$1:$A$2"})
        workbook.add_chartsheet("Chart").set_chart(chart)
        workbook.add_worksheet("Two words").write_formula(0, 0, "=One!A1+local", value=3)
        workbook.define_name("'Two words'!local", "=2")
    book = read_xlsx(path)
    assert [sheet.title for sheet in book.sheets] == ["One", "Two words"]
    assert [(name.name, name.sheet) for name in book.names] == [("local", "Two words")]
    assert evaluate(book).get("Two words", 0, 0) == 3.0


def filled(path, rows=30):
    """A workbook by XlsxWriter with formulas of each kind, and the values that its cells show."""
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("Data & more")
        workbook.define_name("step", "='Data & more'!$D$1")
        sheet.write_number("D1", 0.5)
        for row in range(rows):
            sheet.write_number(row, 0, row)
            sheet.write_formula(row, 1, f"=A{row + 1}*step", value=row * 0.5)
            sheet.write_formula(row, 2, f'=IF(B{row + 1}>3,"big",NA())', value="big" if row > 6 else "#N/A")
    return {"B": [row * 0.5 for row in range(rows)], "C": ["big" if row > 6 else NA for row in range(rows)]}


def test_xlsxwriter(tmp_path):
    expected = filled(tmp_path / "book.xlsx")
    book = read_xlsx(tmp_path / "book.xlsx")
    assert blocks(book) == {"B1:B30": "A1*step", "C1:C30": 'IF(B1>3,"big",NA())'}
    values = evaluate(book)
    for col, letter in enumerate("BC", 1):
        assert values.column("Data & more", col, 0, 29) == expected[letter]
        assert [book.sheets[0].cached.get(row, col) for row in range(30)] == expected[letter]


def test_openpyxl(tmp_path):
    filled(tmp_path / "book.xlsx")
    workbook = openpyxl.load_workbook(tmp_path / "book.xlsx")
    workbook.save(tmp_path / "again.xlsx")
    again = read_xlsx(tmp_path / "again.xlsx")
    assert blocks(again) == blocks(read_xlsx(tmp_path / "book.xlsx"))
    assert cached(again) == {}


@pytest.mark.ci
@pytest.mark.libreoffice
def test_libreoffice(tmp_path):
    expected = filled(tmp_path / "book.xlsx")
    (tmp_path / "out").mkdir()
    (path,) = convert_with_libreoffice([tmp_path / "book.xlsx"], "xlsx", tmp_path / "out")
    book = read_xlsx(path)
    assert blocks(book) == {"B1:B30": "A1*step", "C1:C30": 'IF(B1>3,"big",NA())'}
    assert [book.sheets[0].cached.get(row, 2) for row in range(30)] == expected["C"]


# --- what is refused ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the file is empty"),
        (b"a,b\n1,2\n", "not a workbook: this is no zip file"),
        (bytes(range(256)) * 9, "not a workbook: this is no zip file"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + b"\0" * 600, "an .xls of the old kind"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + "EncryptedPackage".encode("utf-16-le"), "protected by a password"),
        (b"PK\x03\x04 and no more", "the file is damaged or cut off"),
        (packed({"x.txt": "x"}), "not a workbook: the zip file holds no part xl/workbook.xml"),
        (packed({"content.xml": "<x/>"}), "an OpenDocument file"),
        (packed(parts_of(""))[:-30], "the file is damaged or cut off"),
        (packed(parts_of(""))[:300], "the file is damaged or cut off"),
    ],
)
def test_files_that_are_no_workbook(tmp_path, content, message):
    path = tmp_path / "book.xlsx"
    path.write_bytes(content)
    with pytest.raises(WorkbookError) as caught:
        read_xlsx(path)
    assert len(caught.value.faults) == 1
    assert message in str(caught.value)
    assert "book.xlsx" in str(caught.value)


def test_a_folder_and_a_file_that_is_not_there(tmp_path):
    with pytest.raises(WorkbookError, match="a folder"):
        read_xlsx(tmp_path)
    with pytest.raises(WorkbookError, match="cannot be read"):
        read_xlsx(tmp_path / "nothing.xlsx")


SHEET = "xl/worksheets/sheet1.xml"
BOMB = '<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]>'


@pytest.mark.parametrize(
    ("part", "text", "message"),
    [
        (SHEET, f'{BOMB}<worksheet xmlns="{MAIN}">&b;</worksheet>', "declares a document type"),
        ("xl/workbook.xml", f"{BOMB}<workbook/>", "declares a document type"),
        ("xl/sharedStrings.xml", '<!DOCTYPE s SYSTEM "file:///etc/passwd"><sst/>', "declares a document type"),
        (SHEET, "<worksheet><sheetData>", "no proper XML"),
        (SHEET, "", "no proper XML"),
        (SHEET, None, 'the sheet "S" has no part in the file'),
        ("xl/workbook.xml", "<workbook/>", "the workbook has no sheet with cells"),
        (SHEET, '<worksheet><row r="0"/></worksheet>', '"0" is no row of a sheet'),
        (SHEET, '<worksheet><row r="1048577"/></worksheet>', '"1048577" is no row of a sheet'),
        (SHEET, '<worksheet><row r="1"><c r="XFE1"/></row></worksheet>', '"XFE1" is no cell of row 1'),
        (SHEET, '<worksheet><row r="1"><c r="A2"/></row></worksheet>', '"A2" is no cell of row 1'),
    ],
)  # fmt: skip
def test_parts_that_cannot_be_read(read, part, text, message):
    parts = parts_of('<row r="1"><c r="A1"><v>1</v></c></row>')
    if text is None:
        del parts[part]
    else:
        parts[part] = text
    with pytest.raises(WorkbookError) as caught:
        read(parts)
    assert len(caught.value.faults) == 1
    assert message in str(caught.value)


def test_all_values_that_cannot_be_understood_are_named(read):
    with pytest.raises(WorkbookError) as caught:
        read(
            '<row r="1"><c r="A1"><v>1_000</v></c><c r="B1"><v>nan</v></c><c r="C1" t="s"><v>5</v></c>'
            '<c r="D1" t="d"><v>2023-02-29</v></c></row>'
        )
    assert [fault.key for fault in caught.value.faults] == [f"S!{letter}1" for letter in "ABCD"]
    assert "1_000" in caught.value.faults[0].message


def test_formulas_that_cannot_be_understood_keep_their_stored_values(read):
    book = read(
        '<row r="1"><c r="A1"><f>SUM(</f><v>7</v></c><c r="B1"><f t="shared" si="3"/><v>8</v></c>'
        '<c r="C1"><f t="dataTable" ref="C1:C2" dt2D="0" r1="A1"/><v>9</v></c><c r="D1" t="str"><f>A1~</f><v>x</v></c>'
        f'<c r="E1"><f>1{"+1" * 40_000}</f><v>40001</v></c></row>'
        '<row r="2"><c r="A2"><f>A1*2</f><v>14</v></c></row>'
    )
    assert [remark.key for remark in book.remarks] == ["S!C1", "S!A1", "S!B1", "S!D1", "S!E1"]
    assert all("stored values are kept" in remark.message for remark in book.remarks)
    assert constants(book) == {"A1": 7.0, "B1": 8.0, "C1": 9.0, "D1": "x", "E1": 40001.0}
    assert evaluate(book).get("S", 1, 0) == 14.0


def test_shared_formulas_in_any_order(read):
    """Members before the cell with the text, a number that is used again, rows and cells out of order."""
    book = read(
        '<row r="3"><c r="B3"><f t="shared" si="0"/></c><c r="A3"><v>3</v></c></row>'
        '<row r="2"><c r="B2"><f t="shared" ref="Z99" si="0">A2*10</f></c><c r="A2"><v>2</v></c></row>'
        '<row r="1"><c r="B1"><f t="shared" si="0"/></c><c r="A1"><v>1</v></c></row>'
        '<row r="4"><c r="A4"><v>4</v></c><c r="B4"><f t="shared" ref="B4:B5" si="0">A4*100</f></c></row>'
        '<row><c r="A5"><v>5</v></c><c><f t="shared" si="0"/></c><c r="C5"><f t="shared" si="1" ref="C5">B4</f></c></row>'
        '<row r="1"><c r="C1"><f t="shared" si="1"/></c></row>'
    )
    values = evaluate(book)
    assert [values.get("S", row, 1) for row in range(5)] == [10.0, 20.0, 30.0, 400.0, 500.0]
    assert values.get("S", 0, 2) == ErrorValue("#REF!")  # four rows above: outside the sheet
    assert [values.get("S", row, 0) for row in range(5)] == [1.0, 2.0, 3.0, 4.0, 5.0]


@pytest.mark.ci
def test_many_rows_from_the_bottom_up(read):
    count = 4_000
    cells = (
        f'<row r="{r}"><c r="A{r}"><v>{r}</v></c><c r="B{r}"><f>A{r}*2</f><v>{2 * r}</v></c></row>'
        for r in range(count, 0, -1)
    )
    book = read("".join(cells))
    sheet = book.sheets[0]
    assert [len(run.values) for run in sheet.constants.columns[0]] == [count]
    assert [run.values[-1] for run in sheet.cached.columns[1]] == [2.0 * count]
    assert evaluate(book).get("S", 999, 1) == 2_000.0


def test_dates_as_texts_of_a_strict_file(read):
    cells = "".join(
        f'<c t="d"><v>{text}</v></c>' for text in ("2024-02-29T12:00:00", "1900-02-28", "1900-01-01", "T06:00:00")
    )
    assert list(constants(read(f"<row>{cells}</row>")).values()) == [45351.5, 59.0, 1.0, 0.25]
    book = read(f"<row>{cells}</row>", workbook='<workbookPr date1904="true"/>')
    assert next(iter(constants(book).values())) == 45351.5 - 1462


def test_part_names_with_backslashes_and_other_letters(read, tmp_path):
    """Some programs write zip files as Windows spells paths."""
    parts = parts_of('<row r="1"><c r="A1"><f>1+1</f></c></row>')
    book = read({name.replace("/", "\\").replace("sheet1", "Sheet1"): text for name, text in parts.items()})
    assert blocks(book) == {"A1": "1+1"}
    update_values(tmp_path / "book.xlsx", tmp_path / "new.xlsx", book, evaluate(book), {})
    assert cached(read_xlsx(tmp_path / "new.xlsx")) == {"A1": 2.0}


def test_sheets_without_a_part_of_their_own(read):
    """Excel lists modules of macros among the sheets."""
    parts = parts_of('<row r="1"><c r="A1"><v>1</v></c></row>')
    parts["xl/workbook.xml"] = parts["xl/workbook.xml"].replace(
        "<sheets>", '<sheets><sheet name="Module1" sheetId="7" state="veryHidden" r:id=""/>'
    )
    assert [sheet.title for sheet in read(parts).sheets] == ["S"]


@settings(max_examples=examples(150), deadline=None)
@given(st.data())
def test_damaged_bytes_are_refused_or_read(tmp_path_factory, data):
    """No traceback, whatever a byte becomes."""
    content = bytearray(packed(parts_of(rows([["B1+1", "SUM(A1:A9)"]] * 4), strings="<si><t>x</t></si>")))
    for _ in range(data.draw(st.integers(1, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.getbasetemp() / "damaged.xlsx"
    path.write_bytes(content)
    try:
        read_xlsx(path)
    except WorkbookError as problem:
        assert problem.faults


@pytest.mark.slow
@settings(max_examples=examples(150), deadline=None)
@given(st.text("<>/cfvrt=\"A1 &;'s0", max_size=60))
def test_any_xml_is_refused_or_read(tmp_path_factory, text):
    path = tmp_path_factory.getbasetemp() / "strange.xlsx"
    path.write_bytes(packed(parts_of(f'<row r="1">{text}</row>')))
    try:
        read_xlsx(path)
    except WorkbookError as problem:
        assert problem.faults


def test_a_name_that_cannot_be_read_keeps_the_values_of_its_cells(read):
    book = read(
        '<row r="1"><c r="A1"><f>odd+1</f><v>7</v></c><c r="B1"><f>A1*2</f><v>0</v></c></row>',
        names='<definedName name="odd">1 +* 2</definedName>',
    )
    values = evaluate(book)
    assert [values.get("S", 0, col) for col in (0, 1)] == [7, 14]
    assert [fault.message for fault in values.remarks] == [
        "a name that cannot be read, odd = 1 +* 2: stored values are kept"
    ]
