"""Rows of an .ods taken out before the parser: what is read is what the parser alone reads."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ods_files import content, table, write_ods
from row_by_row import alone, everything, rows_taken, short_tables  # noqa: F401 (a fixture for all tests here)

from chosen import examples
from folders import ROOT
from livesheet.formats.reading import package as package_module

FLOAT = 'office:value-type="float" office:value="{v}"'
COLUMNS = [
    f"<table:table-cell {FLOAT}/>",
    f'<table:table-cell table:style-name="ce{{r}}" table:formula="of:=[.{{p}}{{r}}]*2+[.$A$1]" {FLOAT}'
    ' calcext:value-type="float"><text:p>{v}</text:p></table:table-cell>',
    f'<table:table-cell table:formula="of:=[.{{p}}{{u}}]+[$S.{{p}}{{r}}:.$A{{d}}]*10" {FLOAT}/>',
    f'<table:table-cell table:formula="of:=IF([.A{{r}}]&lt;5;&quot;ö A5&quot;;[.B{{r}}]&gt;1)" {FLOAT}/>',
    f'<table:table-cell table:formula="=SUM([.A$1:.B$1])" {FLOAT.replace("float", "percentage")}/>',
    '<table:table-cell office:value-type="string"><text:p>same</text:p></table:table-cell>',
    '<table:table-cell table:formula="of:=[.A{r}]&amp;&quot;&quot;" office:value-type="string"><text:p>ö {v}</text:p>'
    "</table:table-cell>",
    '<table:table-cell office:value-type="date" office:date-value="2024-01-1{k}"><text:p>x</text:p></table:table-cell>',
    '<table:table-cell office:value-type="boolean" office:boolean-value="true"/>',
    '<table:table-cell table:number-columns-repeated="2"/>'
    '<table:table-cell office:value-type="time" office:time-value="PT0{k}H"/>',
    '<table:table-cell table:formula="of:=NA()" office:value-type="string" office:string-value=""'
    ' calcext:value-type="error"><text:p>#N/A</text:p></table:table-cell>',
]
ODD = [
    "<table:covered-table-cell/>" + COLUMNS[0],
    f"<table:table-cell table:formula=\"of:=[$'Sheet {{r}}'.A1]\" {FLOAT}/>",
    f'<table:table-cell table:formula="msoxl:=A{{r}}" {FLOAT}/>',
    '<table:table-cell office:value-type="string"><text:p>a<text:s/>b</text:p></table:table-cell>',
    '<table:table-cell office:value-type="string"><text:p>a</text:p><text:p>b</text:p></table:table-cell>',
    f'<table:table-cell table:number-matrix-columns-spanned="1" table:number-matrix-rows-spanned="1"'
    f' table:formula="of:=[.A1]" {FLOAT}/>',
    '<table:table-cell office:value-type="string"><office:annotation><text:p>n</text:p></office:annotation><text:p>b'
    "</text:p></table:table-cell>",
]
CHANGES = {
    "odd number": (r'office:value="[^"]*"', 'office:value="1_0"'),
    "infinite": (r'office:value="[^"]*"', 'office:value="1e400"'),
    "formula": (r"\*2", "*3"),
    "repeated row": (r"^<table:table-row", '<table:table-row table:number-rows-repeated="3"'),
    "repeated cell": (r"<table:table-cell ", '<table:table-cell table:number-columns-repeated="2" '),
    "comment": (r"^", "<!-- </table:table-row> -->"),
    "comment inside": (r"</table:table-row>$", "<!--</table:table-row><table:table-row>--></table:table-row>"),
    "gap": (r"^.*$", ""),
    "empty row": (r"^.*$", "<table:table-row/>"),
    "broken": (r"</table:table-row>$", ""),
    "kind": (r'"float"', '"string"'),
    "unknown kind": (r'"float"', '"flat"'),
    "spaces": (r"<text:p>([^<]*)<", r"<text:p> \1  \1 <"),
    "entity": (r"<text:p>", "<text:p>&amp;"),
    "header": (r"^(.*)$", r"<table:table-header-rows>\1</table:table-header-rows>"),
    "nested": (r"^(.*)$", r"\1<table:shapes><table:table table:name='T'>\1\1\1</table:table></table:shapes>"),
    "nested before": (r"^(.*)$", r"<table:shapes><table:table table:name='T'>\1\1\1</table:table></table:shapes>\1"),
    "table": (r"^(.*)$", r"\1</table:table><table:table table:name='{n}'>\1"),
    "cache": (r"^(.*)$", r"\1</table:table><table:table table:name='&apos;file:///a&apos;#b'>\1\1"),
    "new lines": ("><", ">\n<"),
    "other digits": (r"^(.*)<table:table-cell ", "\\1<table:table-cell table:number-columns-repeated='\u0661' "),
    "digits": (r"<table:table-cell ", "<table:table-cell table:number-columns-repeated=\"\u0661\" "),
    "single quotes": (r'value-type="float"', "value-type='float'"),
}  # fmt: skip


def rows_of(columns, count):
    return [
        "<table:table-row>"
        + "".join(
            text.format(r=row, u=row - 1, d=row + 2, p=chr(64 + col), v=row * 0.37 + col, k=row % 10)
            for col, text in enumerate(columns, 1)
        )
        + "</table:table-row>"
        for row in range(1, count + 1)
    ]


def written(path, rows, **more):
    return write_ods(path, content(table("".join(rows)), **more))


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("rows") / "book.ods"


@settings(max_examples=examples(150), deadline=None)
@given(
    st.lists(st.sampled_from(COLUMNS) | st.sampled_from([*COLUMNS, *ODD]), min_size=1, max_size=5),
    st.integers(9, 40),
    st.lists(st.tuples(st.integers(0, 39), st.sampled_from(sorted(CHANGES))), max_size=3),
    st.sampled_from([16, 100, 999, 1 << 16]),
)
def test_what_is_read_is_what_the_parser_alone_reads(place, columns, count, changes, piece):
    rows = rows_of(columns, count)
    for number, (index, name) in enumerate(changes):
        pattern, new = CHANGES[name]
        if index < len(rows):
            new = new.replace("{n}", f"T{number}")
            rows[index] = re.sub(pattern, new, rows[index], count=1, flags=re.DOTALL)
    written(place, rows)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(package_module, "_PIECE", piece)
        assert everything(place) == alone(place)


@pytest.mark.parametrize("column", COLUMNS)
def test_rows_of_every_kind_are_taken(place, column):
    written(place, rows_of([column], 40))
    assert rows_taken(place) == 40 - 9
    assert everything(place) == alone(place)


@pytest.mark.parametrize("column", ODD)
def test_other_rows_are_parsed(place, column):
    written(place, rows_of([column], 40))
    assert rows_taken(place) == 0
    assert everything(place) == alone(place)


@pytest.mark.parametrize("change", ["formula", "repeated row", "empty row", "header", "kind", "nested"])
def test_after_an_odd_row_rows_are_taken_again(place, change):
    rows = rows_of(COLUMNS[:2], 60)
    rows[25] = re.sub(*CHANGES[change], rows[25])
    written(place, rows)
    assert rows_taken(place) >= 60 - 9 - 1 - 9
    assert everything(place) == alone(place)


def test_rows_inside_a_drawing_are_passed_over(place):
    """They follow an end of row, look like the rows of the table, and are none."""
    rows = rows_of(COLUMNS[:1], 20)
    inner = "".join(rows)
    written(place, [*rows, f"<table:shapes><table:table table:name='T'>{inner}</table:table></table:shapes>", *rows])
    found = everything(place)
    assert found == alone(place)
    assert len(found[0][0]) == 40


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar.ods", "adjustable-pump.ods"])
def test_our_own_workbooks(name):
    path = ROOT / "generated" / name
    assert everything(path) == alone(path)
