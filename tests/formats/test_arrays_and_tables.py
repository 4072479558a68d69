"""Array formulas, dynamic arrays and tables in files that other libraries wrote: read, recalculated, and written back."""

import openpyxl
import pytest
import xlsxwriter
from ods_files import cell, content, number, row, table, write_ods
from openpyxl.worksheet.formula import ArrayFormula
from openpyxl.worksheet.table import Table

from livesheet.formats import read
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.printer import print_formula
from mechsheet.library.recalculation import recalc


@pytest.fixture
def by_xlsxwriter(tmp_path):
    path = tmp_path / "arrays.xlsx"
    book = xlsxwriter.Workbook(path)
    sheet = book.add_worksheet("S")
    sheet.write_column("A1", [4, 2, 3])
    sheet.write_array_formula("C1:C3", "{=A1:A3*2}", value=8)
    sheet.write_dynamic_array_formula(
        "E1:E4", "=_xlfn.MAKEARRAY(A1,1,_xlfn.LAMBDA(_xlpm.r,_xlpm.c,_xlpm.r*10))", value=10
    )
    sheet.write_column("E2", [20, 30, 40])
    sheet.write_formula("G1", "=SUM(_xlfn.ANCHORARRAY(E1))", value=100)
    columns = [{"header": "a"}, {"header": "b c", "formula": "=[@a]*2"}]
    sheet.add_table("I1:J4", {"name": "Pairs", "columns": columns, "data": [[1], [2], [3]]})
    sheet.write_formula("L1", "=SUM(Pairs[b c])")
    sheet.write_formula("L2", "=SUM(Pairs[[#Headers],[a]:[b c]])+ROWS(Pairs[#All])")
    book.close()
    return path


def test_what_is_read(by_xlsxwriter):
    book = read(by_xlsxwriter)
    (sheet,) = book.sheets
    kinds = {(block.row, block.col): (block.kind, block.rows, block.cols) for block in sheet.blocks}
    assert kinds[0, 2] == ("array", 3, 1)
    assert kinds[0, 4] == ("spill", 4, 1)
    assert kinds[1, 9] == ("fill", 3, 1)
    # the values of an array's other cells are results, no constants
    assert [sheet.constants.get(down, 4) for down in range(4)] == [None] * 4
    assert [sheet.cached.get(down, 4) for down in range(4)] == [10, 20, 30, 40]
    (found,) = book.tables
    assert (found.name, found.sheet, found.row, found.col, found.rows) == ("Pairs", "S", 0, 8, 4)
    assert (found.columns, found.headers, found.totals) == (("a", "b c"), 1, 0)
    assert book.remarks == []


def test_recalculated_with_another_size_and_written_back(by_xlsxwriter, tmp_path):
    output = tmp_path / "out.xlsx"
    for count in (4, 2, 6):
        result = recalc(by_xlsxwriter, {"S!A1": str(count)})
        assert result.remarks == ()
        assert [result.get("S", down, 4) for down in range(7)] == [10.0 * n for n in range(1, count + 1)] + [None] * (
            7 - count
        )
        assert result.get("S", 0, 6) == sum(10 * n for n in range(1, count + 1))
        assert [result.get("S", row, 11) for row in (0, 1)] == [12, 4]
        result.write(output)
        again = recalc(output)
        assert again.as_dict() == result.as_dict()
        spill = again.book.sheets[0].formula_at(0, 4)
        assert spill.rows == count


def test_a_file_of_openpyxl(tmp_path):
    path = tmp_path / "openpyxl.xlsx"
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "Data"
    for values in (["item", "weight"], ["a", 2], ["b", 3], ["c", 4]):
        sheet.append(values)
    sheet.add_table(Table(displayName="Items", ref="A1:B4"))
    sheet["D1"] = "=SUM(Items[weight])"
    sheet["D2"] = ArrayFormula("D2:D4", "=Items[weight]*10")
    sheet["E1"] = ArrayFormula("E1", '=SUM((Items[item]<>"b")*Items[weight])')
    sheet["F1"] = "=SUM(B2:B4*2)"
    book.save(path)
    result = recalc(path)
    assert [result.get("Data", down, 3) for down in range(4)] == [9, 20, 30, 40]
    assert result.get("Data", 0, 4) == 6
    assert result.get("Data", 0, 5) == ErrorValue("#VALUE!")  # no array formula, and nothing beside it


def test_an_array_formula_of_opendocument(tmp_path):
    first = cell(
        'table:formula="of:=[.A1:.A2]*2" table:number-matrix-columns-spanned="1" table:number-matrix-rows-spanned="2" '
        'office:value-type="float" office:value="6"'
    )
    path = write_ods(tmp_path / "a.ods", content(table(row(number(3), first) + row(number(4), number(8)))))
    book = read(path)
    (block,) = book.sheets[0].blocks
    assert (block.kind, block.rows, block.cols, print_formula(block.formula)) == ("array", 2, 1, "A1:A2*2")
    title = book.sheets[0].title
    assert [recalc(path, {f"{title}!A2": "5"}).get(title, down, 1) for down in range(2)] == [6, 10]
