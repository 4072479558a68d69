"""Array formulas: the case files, alone, in a legacy array formula, and by IronCalc and LibreOffice; how arrays spill."""

import ironcalc
import openpyxl
import pytest
from openpyxl.worksheet.formula import ArrayFormula

from engine_cases import COLUMN, FIRST_ROW, FOLDER, array_cases, book_of, cells, load, same
from mechsheet.engine import compile_book
from mechsheet.formula.book import BookBuilder
from mechsheet.formula.nodes import ErrorValue
from mechsheet.formula.parser import parse_formula
from mechsheet.formula.printer import print_formula
from mechsheet.formula.references import parse_cell
from mechsheet.programs import convert_with_libreoffice

CASES = array_cases()
STEP = 7
SPILL, NA, NUM = ErrorValue("#SPILL!"), ErrorValue("#N/A"), ErrorValue("#NUM!")


def shown(values, row, col, rows, cols, sheet="S"):
    return [[values.get(sheet, row + down, col + right) for right in range(cols)] for down in range(rows)]


def equal(found, expected):
    return all(
        same(a, b, 1e-12)
        for ours, theirs in zip(found, expected, strict=True)
        for a, b in zip(ours, theirs, strict=True)
    )


@pytest.mark.parametrize("kind", ["spill", "array"])
@pytest.mark.parametrize("file", sorted({stem for stem, _, _ in CASES}))
def test_cases(file, kind):
    """A dynamic array grows from one cell; a legacy array formula has its area, and #N/A beyond the array."""
    chosen = [(formula, rows) for stem, formula, rows in CASES if stem == file]
    book = book_of([])
    for index, (formula, rows) in enumerate(chosen):
        size = (1, 1) if kind == "spill" else (len(rows) + 1, len(rows[0]))
        book.sheets[0].block(FIRST_ROW + STEP * index, COLUMN, *size, parse_formula(formula), kind)
    plan = compile_book(book)
    for _ in range(2):
        values = plan.evaluate()
        wrong = []
        for index, (formula, rows) in enumerate(chosen):
            row = FIRST_ROW + STEP * index
            expected = rows
            if kind == "array":
                expected = [*rows, rows[0] if len(rows) == 1 else [NA] * len(rows[0])]
            elif values.spill("S", row, COLUMN) != (len(rows), len(rows[0])):
                wrong.append((formula, values.spill("S", row, COLUMN)))
                continue
            found = shown(values, row, COLUMN, len(expected), len(rows[0]))
            if not equal(found, expected):
                wrong.append((formula, expected, found))
        assert wrong == []
        assert values.remarks == ()


def test_ironcalc():
    """What IronCalc computes of the case files is the same, but for the differences listed."""
    known = load(FOLDER / "arrays" / "differences.toml")["ironcalc"]
    model = ironcalc.create("cases", "en", "UTC", "en")
    model.rename_sheet(0, "S")
    for row, col, value in cells():
        text = '=""' if value == "" else f"'{value}" if isinstance(value, str) else str(value).upper()
        model.set_user_input(0, row + 1, col + 1, text)
    for index, (_, formula, _) in enumerate(CASES):
        model.set_user_input(0, FIRST_ROW + STEP * index + 1, COLUMN + 1, "=" + formula)
    model.evaluate()
    for index, (_, formula, rows) in enumerate(CASES):
        place = FIRST_ROW + STEP * index + 1, COLUMN + 1
        found = [
            [_scalar(model.get_cell_value(0, place[0] + down, place[1] + right)) for right in range(len(rows[0]))]
            for down in range(len(rows))
        ]
        assert equal(found, rows) != (formula in known), (formula, found, rows)


def _scalar(value):
    if isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    return ErrorValue(value) if isinstance(value, str) and value.startswith("#") else value


@pytest.fixture(scope="module")
def workbook(tmp_path_factory):
    """The cases as array formulas in a file without stored values."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "S"
    for row, col, value in cells():
        cell = sheet.cell(row + 1, col + 1)
        if isinstance(value, ErrorValue):
            cell.value, cell.data_type = value.code, "e"
        else:
            cell.value = '=""' if value == "" else value
            cell.data_type = "s" if isinstance(value, str) and value else cell.data_type
    for index, (file, formula, rows) in enumerate(CASES):
        if file != "functions":  # LET and LAMBDA are younger than these programs
            first = sheet.cell(FIRST_ROW + STEP * index + 1, COLUMN + 1)
            last = sheet.cell(first.row + len(rows) - 1, first.column + len(rows[0]) - 1)
            area = f"{first.coordinate}:{last.coordinate}"
            sheet[first.coordinate] = ArrayFormula(area, "=" + print_formula(parse_formula(formula)))
    path = tmp_path_factory.mktemp("arrays") / "arrays.xlsx"
    book.save(path)
    return path


def disagreements(path):
    sheet = openpyxl.load_workbook(path, data_only=True)["S"]
    for index, (file, formula, rows) in enumerate(CASES):
        if file == "functions":
            continue
        row, col = FIRST_ROW + STEP * index + 1, COLUMN + 1
        found = [
            [_scalar(sheet.cell(row + down, col + right).value) for right in range(len(rows[0]))]
            for down in range(len(rows))
        ]
        if not all(
            _agree(a, b) for ours, theirs in zip(rows, found, strict=True) for a, b in zip(ours, theirs, strict=True)
        ):
            yield formula, found


def _agree(ours, theirs):
    """Any error is as good as any other; LibreOffice writes truth values of arrays as numbers, blanks as nothing."""
    if isinstance(ours, ErrorValue):
        return isinstance(theirs, ErrorValue)
    if isinstance(ours, bool):
        return theirs in (ours, float(ours))
    return same(ours, theirs, 1e-12) or (ours in (0.0, "") and theirs in (None, ""))


@pytest.mark.libreoffice
def test_libreoffice(workbook, tmp_path):
    (path,) = convert_with_libreoffice([workbook], "xlsx", tmp_path)
    known = load(FOLDER / "arrays" / "differences.toml")["libreoffice"]
    assert sorted(formula for formula, _ in disagreements(path)) == sorted(known)


# --- how arrays spill -----------------------------------------------------------------------------------------------


def book(constants, blocks, names=()):
    """A sheet S: constants by cell, blocks as (area, formula, kind)."""
    builder = BookBuilder("book.xlsx")
    sheet = builder.sheet("S")
    for place, value in constants.items():
        sheet.constant(*parse_cell(place), value)
    for area, text, kind in blocks:
        first, _, last = area.partition(":")
        (row, col), (bottom, right) = parse_cell(first), parse_cell(last or first)
        sheet.block(row, col, bottom - row + 1, right - col + 1, parse_formula(text), kind)
    for name, text in names:
        builder.name(name, parse_formula(text))
    return builder.build()


def column(values, letter, first, last):
    return values.column("S", ord(letter) - 65, first - 1, last - 1)


NUMBERS = {"A1": 3.0, "B1": 10.0, "B2": 20.0, "B3": 30.0}


def test_an_array_grows_and_shrinks_and_what_reads_it_follows():
    plan = compile_book(
        book(
            NUMBERS,
            [("D1:D2", "MAKEARRAY(A1,1,LAMBDA(r,c,r))", "spill"), ("E1", "SUM(D1#)", "fill"), ("F1", "D1#*10", "spill"),
             ("G1:G5", "D1", "fill"), ("H1", "ROWS(D1#)", "fill"), ("I1", "SUM(D1:D9)", "fill")],
        )
    )  # fmt: skip
    for count in (3, 1, 5, 3):
        values = plan.evaluate({("S", 0, 0): float(count)})
        expected = [float(place) for place in range(1, count + 1)]
        assert column(values, "D", 1, count + 1) == [*expected, None]
        assert column(values, "F", 1, count) == [10 * each for each in expected]
        assert column(values, "G", 1, 5) == (expected + [0.0] * 5)[:5]
        assert [values.get("S", 0, col) for col in (4, 7, 8)] == [sum(expected), count, sum(expected)]


def test_what_stands_in_the_way():
    plan = compile_book(book({**NUMBERS, "D2": "here"}, [("D1", "B1:B3", "spill"), ("E1", "SUM(D1#)", "fill")]))
    values = plan.evaluate()
    assert column(values, "D", 1, 3) == [SPILL, "here", None]
    assert values.get("S", 0, 4) == SPILL
    # emptied, there is room
    assert column(plan.evaluate({("S", 1, 3): None}), "D", 1, 3) == [10, 20, 30]
    assert column(plan.evaluate(), "D", 1, 3) == [SPILL, "here", None]
    # and what is typed into the array stands in its way
    free = compile_book(book(NUMBERS, [("D1:D3", "B1:B3", "spill")]))
    assert column(free.evaluate({("S", 2, 3): 7.0}), "D", 1, 3) == [SPILL, None, 7]
    assert column(free.evaluate(), "D", 1, 3) == [10, 20, 30]


def test_two_arrays_that_meet():
    """The first one in the book has its way."""
    values = compile_book(book(NUMBERS, [("D1", "B1:B3", "spill"), ("C2", "B1:B2+{1,2}", "spill")])).evaluate()
    assert column(values, "D", 1, 3) == [10, 20, 30]
    assert values.get("S", 1, 2) == SPILL


def test_beyond_the_edge_of_the_sheet():
    values = compile_book(book(NUMBERS, [("D1048575", "B1:B3", "spill")])).evaluate()
    assert values.get("S", 1048574, 3) == SPILL


def test_a_legacy_array_reads_itself():
    values = compile_book(book(NUMBERS, [("D1:D3", "B1:B3+D2", "array")])).evaluate()
    assert [fault.message for fault in values.remarks] == ["circular reference: S!D1 -> S!D1"]
    assert column(values, "D", 1, 3) == [ErrorValue("#REF!")] * 3


def test_an_array_between_columns_that_read_each_other():
    """Each cell of C reads the array in D, which reads the first cell of C."""
    values = compile_book(
        book({**NUMBERS, "C1": 1.0}, [("C2:C4", "C1+D1", "fill"), ("D1:D3", "B1:B3*C1", "array"), ("E1", "C4", "fill")])
    ).evaluate()
    assert column(values, "C", 1, 4) == [1, 11, 31, 61]
    assert values.get("S", 0, 4) == 61


def test_the_stored_size_is_a_first_guess():
    plan = compile_book(book(NUMBERS, [("D1:D3", "B1:B3", "spill"), ("E1", "SUM(D1:D9)", "fill")]))
    assert plan.resized(plan.sizes) is plan
    assert plan.evaluate().get("S", 0, 4) == 60


def test_names_that_are_functions():
    names = [
        ("fact", "LAMBDA(n,IF(n<2,1,n*FACT_(n-1)))"), ("FACT_", "LAMBDA(n,IF(n<2,1,n*fact(n-1)))"),
        ("area", "LAMBDA(r,PI()*r^2)"), ("beside_", "LAMBDA(x,x+S!B1)"), ("endless", "LAMBDA(n,endless(n)+1)"),
        ("add", "LET(one,1,LAMBDA(x,x+one))"), ("scale", "LAMBDA(k,LAMBDA(x,k*x))"),
    ]  # fmt: skip
    blocks = [
        ("D1", "fact(10)", "fill"), ("D2", "area(2)", "fill"), ("D3", "SUM(MAP(B1:B3,area))", "fill"),
        ("D4", "endless(1)", "fill"), ("D5", "add(2)", "fill"), ("D6", "scale(3)(5)", "fill"), ("D7", "area", "fill"),
        ("E1:E3", "beside_(1)", "fill"), ("D8", "fact(200)/fact(199)", "fill"), ("D9", "IFERROR(endless(1),0)", "fill"),
        ("D10", "MAP(1,2,area)", "fill"), ("D11", "LET(area,LAMBDA(x,0),area(3))", "fill"),
    ]  # fmt: skip
    values = compile_book(book(NUMBERS, blocks, names)).evaluate()
    assert values.remarks == ()
    assert column(values, "D", 1, 2) == pytest.approx([3628800.0, 12.566370614359172])
    assert values.get("S", 2, 3) == pytest.approx(3.141592653589793 * 1400)
    assert column(values, "D", 4, 7) == [NUM, 3, 15, ErrorValue("#CALC!")]
    assert values.get("S", 7, 3) == NUM  # beyond the largest number
    assert column(values, "D", 9, 11) == [0, ErrorValue("#VALUE!"), 0]
    # relative to A1 the name means the next column of the same row: from E1 that is F1, which is blank
    assert column(values, "E", 1, 3) == [1, 1, 1]


def test_what_functions_read_is_computed_before():
    names = [("total", "LAMBDA(k,k*SUM(S!$E$1:$E$3))")]
    values = compile_book(
        book(NUMBERS, [("D1:D2", "total(2)", "fill"), ("E1:E3", "F1+1", "fill"), ("F1:F3", "B1", "fill")], names)
    ).evaluate()
    assert column(values, "D", 1, 2) == [126, 126]
