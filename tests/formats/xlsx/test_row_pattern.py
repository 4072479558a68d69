"""Rows taken out before the parser: what is read is what the parser alone reads."""

import re

import pytest
import xlsxwriter
from hypothesis import given, settings
from hypothesis import strategies as st
from row_by_row import alone, everything, rows_taken, short_tables  # noqa: F401 (a fixture for all tests here)
from xlsx_files import packed, parts_of

from chosen import examples
from folders import ROOT
from livesheet.diagnostics import WorkbookError
from livesheet.formats.reading import package as package_module
from livesheet.formats.xlsx.read import read_xlsx

STRINGS = "<si><t>one</t></si><si><t>two &amp; three</t></si>"

# What a column may hold: {r} is the row, {u} the one above, {d} the second below, {v} a value.
COLUMNS = [
    '<c r="{c}{r}"><v>{v}</v></c>',
    '<c r="{c}{r}" s="3"><f>{p}{r}*2+$A$1</f><v>{v}</v></c>',
    '<c r="{c}{r}"><f>{p}{u}+{p}{r}-$A{d}*10</f><v>{v}</v></c>',
    '<c r="{c}{r}" t="n"><f aca="false">IF({p}{r}&lt;5,&quot;A5 ö&quot;&amp;{p}{r},"&gt;")</f><v>{v}</v></c>',
    '<c r="{c}{r}" t="str"><f>"n"&amp;ROW()</f><v>text {v}</v></c>',
    '<c r="{c}{r}" t="str"><f>"ö"&amp;{p}{r}</f><v>ö {v}</v></c>',
    '<c r="{c}{r}" s="1" t="s"><v>1</v></c>',
    '<c r="{c}{r}" s="1"/>',
    '<c r="{c}{r}"><f>{p}{r}*4</f><v></v></c>',
    '<c r="{c}{r}"><f>{p}{r}*5</f><v/></c>',
    '<c r="{c}{r}" t="inlineStr"><is><t>text {v}</t></is></c>',
    '<c r="{c}{r}" t="b"><v>1</v></c>',
    '<c r="{c}{r}" t="e"><f>NA()</f><v>#N/A</v></c>',
    "<c r=\"{c}{r}\"><f>SUM({p}$1:{p}{r},{r}:{d},'Sheet 5'!A{r})</f><v>{v}</v></c>",
]
ODD = [
    "<c r=\"{c}{r}\"><f>'Sheet {r}'!A{r}</f><v>{v}</v></c>",
    '<c r="{c}{r}"><f>"A{r}"&amp;{p}{r}</f><v>{v}</v></c>',
    '<c r="{c}{r}"><f>SUM(2:{r})+{p}1{r}</f><v>{v}</v></c>',
    '<c t="n" r="{c}{r}"><v>{v}</v></c>',
    '<c r="{c}{r}" t="inlineStr"><is><t>a</t><t>{v}</t></is></c>',
    '<c r="{c}{r}" t="inlineStr"><v>{v}</v></c>',
    '<c r="{c}{r}"><is><t>{v}</t></is></c>',
    '<c r="{c}{r}" t="str"><f>{p}{r}*5</f><v></v></c>',
    '<c r="{c}{r}"><f t="array" ref="{c}{r}">{p}{r}*2</f><v>{v}</v></c>',
    '<c r="{c}{r}" cm="1"><f>{p}{r}*2</f><v>{v}</v></c>',
]
"""What makes no pattern."""
SHARED = (
    '<c r="{c}{r}"><f t="shared" si="{s}"/><v>{v}</v></c>',
    ('<c r="{c}{r}"><f t="shared" ref="A1:Z99" si="{s}">{p}{u}+{p}{r}</f><v>{v}</v></c>'),
)

# What may happen to a row.
CHANGES = {
    "value": (r"<v>([^<#t]*)</v></c></row>$", r'<v>1e400</v></c></row>'),
    "odd number": (r"<v>([0-9.]+)</v>", r"<v>+1_0</v>"),
    "spaces": (r"<v>([0-9.]+)</v>", r"<v> \1 </v>"),
    "long number": (r"<v>([0-9.]+)</v>", r"<v>12345678901234567890.5E-5</v>"),
    "infinite": (r"<v>([0-9.]+)</v>", r"<v>inf</v>"),
    "error": (r'(<c r="[A-Z]+\d+")><f>', r'\1 t="e"><f>'),
    "formula": (r"\*2", "*3"),
    "row below": (r"([A-Z])(\d+)\*2", r"\1\g<2>1*2"),
    "absolute": (r"\$A(\d+)", r"$A$\1"),
    "style": (r' s="\d+"', ' s="77"'),
    "comment": ("^<row", "<!-- <row r='1'><c r='A1'><v>5</v></c></row> --><row"),
    "comment inside": ("</row>$", "<!--</row><row r='3'>--></row>"),
    "cdata": (r"<f>([^<&]*)</f>", r"<f><![CDATA[\1]]></f>"),
    "instruction": ("^<row", "<?x </row>?><row"),
    "no number": (r'<row r="\d+"', "<row"),
    "another number": (r'<row r="\d+"', '<row r="4"'),
    "missing cell": (r"<c [^>]*/>", ""),
    "height": ("^<row", '<row ht="20"'),
    "new lines": ("><", ">\n<"),
    "broken": ("</c></row>$", "</row>"),
    "entity": (r'(<c r="[A-Z]+\d+" t="str">.*?<v>)', r"\1&amp;&#65;"),
    "no value": (r"<v>[^<]*</v>", "<v/>"),
    "text": (r'<c r="([A-Z]+)(\d+)"><v>[^<]*</v></c>', r'<c r="\1\2" t="inlineStr"><is><t>a</t></is></c>'),
    "twice": (r"(<c [^>]*/>)", r"\1\1"),
    "gap": ("^.*$", ""),
    "unknown text": (r't="s"><v>1<', 't="s"><v>7<'),
    "control": (r"<v>text ", "<v>text \x01"),
    "tab": (r"<v>text ", "<v>text \r\n\t"),
}  # fmt: skip


def letter(col):
    return chr(65 + col)


def rows_of(columns, count, first=5):
    """The XML of rows whose columns are filled down."""
    rows = []
    for row in range(first, first + count):
        cells = []
        for col, text in enumerate(columns, 1):
            if text == "shared":
                text = SHARED[row == first]
            places = {"c": letter(col), "p": letter(col - 1), "r": row, "u": row - 1, "d": row + 2, "s": col}
            cells.append(text.format(v=f"{row * 0.37 + col}", **places))
        rows.append(f'<row r="{row}" spans="1:9">{"".join(cells)}</row>')
    return rows


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("rows") / "book.xlsx"


@pytest.mark.slow
@settings(max_examples=examples(150), deadline=None)
@given(
    st.lists(st.sampled_from([*COLUMNS, "shared"]) | st.sampled_from([*COLUMNS, *ODD]), min_size=1, max_size=5),
    st.integers(9, 40),
    st.lists(st.tuples(st.integers(0, 60), st.sampled_from(sorted(CHANGES))), max_size=3),
    st.booleans(),
    st.sampled_from([16, 100, 999, 1 << 16]),
)
def test_what_is_read_is_what_the_parser_alone_reads(place, columns, count, changes, again, piece):
    rows = rows_of(columns, count)
    if again:
        rows += rows_of(columns, 12, first=5 + count + 2)
    for index, name in changes:
        pattern, new = CHANGES[name]
        if index < len(rows):
            rows[index] = re.sub(pattern, new, rows[index], flags=re.DOTALL)
    place.write_bytes(packed(parts_of("".join(rows), strings=STRINGS)))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(package_module, "_PIECE", piece)
        assert everything(place) == alone(place)


@pytest.mark.parametrize("column", [*COLUMNS, "shared"])
def test_rows_of_every_kind_are_taken(place, column):
    place.write_bytes(packed(parts_of("".join(rows_of([column], 40)), strings=STRINGS)))
    assert rows_taken(place) == 40 - 9
    assert everything(place) == alone(place)


@pytest.mark.parametrize("column", ODD)
def test_other_rows_are_parsed(place, column):
    place.write_bytes(packed(parts_of("".join(rows_of([COLUMNS[0], column], 40)))))
    assert rows_taken(place) == 0
    assert everything(place) == alone(place)


@pytest.mark.parametrize("change", ["error", "formula", "style", "height", "spaces", "gap", "no number", "new lines"])
def test_after_an_odd_row_rows_are_taken_again(place, change):
    rows = rows_of([COLUMNS[0], COLUMNS[1], "shared"], 60)
    rows[25] = re.sub(*CHANGES[change], rows[25])
    place.write_bytes(packed(parts_of("".join(rows))))
    assert rows_taken(place) >= 60 - 9 - 1 - 9
    assert everything(place) == alone(place)


@pytest.mark.parametrize(
    "head",
    ['<?xml version="1.0" encoding="windows-1254"?>', '<?xml version="1.0" encoding="UTF-8"?><!-- a comment -->'],
)
def test_parts_whose_bytes_might_mean_something_else_are_parsed(place, head):
    parts = parts_of("".join(rows_of(COLUMNS[:2], 40)))
    name = "xl/worksheets/sheet1.xml"
    place.write_bytes(packed({**parts, name: re.sub(r"<\?xml.*?\?>", head, parts[name])}))
    assert rows_taken(place) == 0
    assert everything(place) == alone(place)


def test_a_damaged_end_is_found_behind_rows_that_were_taken(place):
    parts = parts_of("".join(rows_of(COLUMNS[:2], 40)))
    name = "xl/worksheets/sheet1.xml"
    place.write_bytes(packed({**parts, name: parts[name].replace("</sheetData>", "</sheet>")}))
    with pytest.raises(WorkbookError, match=re.escape("sheet1.xml: the part is no proper XML (mismatched tag)")):
        read_xlsx(place)


def test_text_that_is_not_utf8(place):
    rows = rows_of([COLUMNS[5]], 40)
    parts = parts_of("".join(rows))
    name = "xl/worksheets/sheet1.xml"
    data = parts[name].encode().replace(b"<v>\xc3\xb6 12", b"<v>\xf6 12")
    place.write_bytes(packed({**parts, name: data}))
    with pytest.raises(WorkbookError, match=r"not UTF-8|not well-formed"):
        read_xlsx(place)


def test_sheets_that_never_repeat_cost_little_more(place):
    """The parser gets whole pieces when rows go on making no pattern."""
    rows = [f'<row r="{n}"><c r="A{n}"{" t=" + chr(34) + "b" + chr(34) if n % 2 else ""}><v>1</v></c></row>'
            for n in range(1, 5000)]  # fmt: skip
    place.write_bytes(packed(parts_of("".join(rows))))
    assert everything(place) == alone(place)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar.xlsx", "adjustable-pump.xlsx", "klann.xlsx"])
def test_our_own_workbooks(name):
    path = ROOT / "generated" / name
    assert everything(path) == alone(path)


def test_numbers_are_converted_when_they_are_read(tmp_path):
    path = tmp_path / "book.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet()
        for row in range(300):
            sheet.write_number(row, 0, row / 4)
            sheet.write_formula(row, 1, f"=A{row + 1}*3", None, row / 8)
    found = read_xlsx(path).sheets[0]
    assert found.cached._texts
    assert found.cached.get(299, 1) == 299 / 8
    assert not found.cached._texts
    assert [value for _, _, value in found.cached.items()] == [row / 8 for row in range(300)]
    assert [value for _, _, value in found.constants.items()] == [row / 4 for row in range(300)]
