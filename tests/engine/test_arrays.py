"""Array formulas: the case files, alone, in a legacy array formula, and by IronCalc and LibreOffice; how arrays spill."""

import ironcalc
import openpyxl
import pytest
from openpyxl.worksheet.formula import ArrayFormula

from engine_cases import COLUMN, FIRST_ROW, FOLDER, array_cases, book_of, cells, load, same
from livesheet.engine import Live, compile_book
from livesheet.engine.layout import Area
from livesheet.formula.book import BookBuilder, Table
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from livesheet.formula.references import parse_cell
from mechsheet.checking.programs import convert_with_libreoffice

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


# --- references and names of every kind -----------------------------------------------------------------------------

TABLE = Table("Sales", "S", 0, 0, 5, ("Item", "Qty", "Unit price", "the two ", "#[x]'s"), 1, 1)
ITEMS = {
    "A1": "Item", "B1": "Qty", "C1": "Unit price", "D1": "the two ", "A2": "a", "A3": "b", "A4": "c", "A5": "sum", "B2": 1.0,
    "B3": 2.0, "B4": 3.0, "C2": 10.0, "C3": 20.0, "C4": 30.0, "D4": 7.0, "E4": 8.0, "B5": 6.0,
}  # fmt: skip

STRUCTURED = {
    "SUM(Sales[Qty])": 6.0, "SUM(sales[[qty]:[Unit price]])": 66.0, "ROWS(Sales[#All])": 5.0, "ROWS(Sales)": 3.0,
    "ROWS(Sales[])": 3.0, "Sales[[#Headers],[Qty]]": "Qty", "Sales[[#Totals],[Qty]]": 6.0, "COUNTA(Sales[#Headers])": 4.0,
    "SUM(Sales[[#Data],[#Totals],[Qty]])": 12.0, "ROWS(Sales[[#Headers],[#Data],[Qty]])": 4.0, "SUM(Sales[the two ])": 7.0,
    "SUM(Sales['#'[x']''s])": 8.0, "Sales[Nope]": ErrorValue("#REF!"), "Nope[Qty]": ErrorValue("#REF!"),
    "Sales[[#This Row],[Qty]]": ErrorValue("#VALUE!"), "VLOOKUP(\"b\",Sales,3,FALSE)": 20.0,
    "INDEX(Sales[Item],MATCH(20,Sales[Unit price],0))": "b", "SUM(INDIRECT(\"Sales[Qty]\"))": 6.0,
    "SUMPRODUCT(Sales[Qty]*Sales[Unit price])": 140.0, "SUM(Sales)": 81.0,
}  # fmt: skip


def with_table(blocks):
    made = book(ITEMS, blocks)
    made.tables.append(TABLE)
    return compile_book(made).evaluate()


def test_structured_references():
    values = with_table([(f"I{row}", formula, "fill") for row, formula in enumerate(STRUCTURED, 10)])
    assert values.remarks == ()
    for row, (formula, expected) in enumerate(STRUCTURED.items(), 9):
        assert same(values.get("S", row, 8), expected), (formula, values.get("S", row, 8))


def test_structured_references_to_the_own_row():
    blocks = [
        ("G2:G4", "Sales[[#This Row],[Qty]]*Sales[[#This Row],[Unit price]]", "fill"), ("H2:H4", "Sales[@Qty]+1", "fill"),
        ("I2:I4", "SUM(Sales[@[Qty]:[Unit price]])", "fill"), ("J2:J4", "Sales[Qty]*2", "array"),
        ("K2", "Sales[Unit price]/10", "spill"), ("L2:L4", "Sales[Qty]", "fill"), ("M1", "[@Qty]", "fill"),
    ]  # fmt: skip
    values = with_table(blocks)
    assert column(values, "G", 2, 4) == [10, 40, 90]
    assert column(values, "H", 2, 4) == [2, 3, 4]
    assert column(values, "I", 2, 4) == [11, 22, 33]
    assert column(values, "J", 2, 4) == [2, 4, 6]
    assert column(values, "K", 2, 4) == [1, 2, 3]
    assert column(values, "L", 2, 4) == [1, 2, 3]  # the cell beside the formula
    assert values.get("S", 0, 12) == ErrorValue("#REF!")  # stands in no table


def test_sheets_in_a_row():
    builder = BookBuilder()
    for place, title in enumerate(("One", "Two", "Three 3", "Four"), 1):
        sheet = builder.sheet(title)
        sheet.constant(0, 0, float(place))
        sheet.constant(1, 0, 10.0 * place)
    formulas = {
        "SUM(One:'Three 3'!A1)": 6.0, "SUM('One:Three 3'!A1:A2)": 66.0, "AVERAGE(Two:Four!A1)": 3.0,
        "MAX(Four:One!A2)": 40.0, "COUNT(One:Four!A:A)": 8.0, "SUM(One:Nowhere!A1)": ErrorValue("#REF!"),
        "SHEETS(One:'Three 3'!A1)": 3.0,
    }  # fmt: skip
    last = builder.sheet("Last")
    for row, formula in enumerate(formulas):
        text = formula.replace("One:'Three 3'!", "'One:Three 3'!")
        last.block(row, 2, 1, 1, parse_formula(text))
    values = compile_book(builder.build()).evaluate()
    assert [values.get("Last", row, 2) for row in range(len(formulas))] == list(formulas.values())


NAMED = [
    ("k", "5"), ("word", '"hi"'), ("three", "{1,2,3}"), ("twice", "S!$B$1:$B$3*2"), ("both", "(S!$B$1,S!$B$3)"),
    ("second_row", "S!$2:$2"), ("grown", "OFFSET(S!$B$1,0,0,COUNT(S!$B:$B),1)"), ("alias", "k+1"), ("lost", "#REF!"),
]  # fmt: skip


def test_names_of_every_kind():
    formulas = {
        "k*2": 10.0, "word&1": "hi1", "SUM(three)": 6.0, "SUM(twice)": 120.0, "SUM(both)": 40.0, "SUM(second_row)": 20.0,
        "SUM(grown)": 60.0, "alias": 6.0, "lost": ErrorValue("#REF!"), "AREAS(both)": 2.0, "INDEX(three,2)": 2.0,
        "ROWS(grown)": 3.0, "MATCH(30,grown,0)": 3.0, "SUMPRODUCT(twice)": 120.0,
    }  # fmt: skip
    blocks = [(f"J{row}", formula, "fill") for row, formula in enumerate(formulas, 20)]
    values = compile_book(book(NUMBERS, blocks, NAMED)).evaluate()
    assert values.remarks == ()
    for row, (formula, expected) in enumerate(formulas.items(), 19):
        assert same(values.get("S", row, 9), expected), (formula, values.get("S", row, 9))


def test_a_whole_column_that_index_gives_in_a_filled_block():
    """In some rows only: each cell takes the one beside it, as it does alone, and as LibreOffice has it."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [10.0, 20.0, 30.0, 40.0, 50.0, 60.0])
    sheet.constants.extend(0, 1, [0.0, 0.0, 2.0, 0.0, 3.0, 0.0, 0.0])
    sheet.block(0, 2, 7, 1, parse_formula("INDEX($A$1:$A$6,$B1)"))
    sheet.block(0, 3, 7, 1, parse_formula("SUM(INDEX($A$1:$A$6,$B1))"))
    for row in range(7):
        sheet.block(row, 4, 1, 1, parse_formula(f"INDEX($A$1:$A$6,$B{row + 1})"))
    values = compile_book(builder.build()).evaluate()
    beside = [10.0, 20.0, 20.0, 40.0, 30.0, 60.0, ErrorValue("#VALUE!")]
    assert values.column("S", 2, 0, 6) == values.column("S", 4, 0, 6) == beside
    assert values.column("S", 3, 0, 6) == [210.0, 210.0, 20.0, 210.0, 30.0, 210.0, 210.0]


def test_a_cell_beside_the_formula():
    """Only array formulas sum arrays of expressions: others take the cell of their row, as `@` says it."""
    blocks = [
        ("E1:E3", "SUM(B1:B3*2)", "fill"), ("F1:F3", "SUM(@B1:B3*2)", "fill"), ("G1:G3", "SUM(B1:B3)*2", "fill"),
        ("H1:H4", "B$1:B$3+1", "fill"), ("I1:I3", "SUMPRODUCT(B$1:B$3*2)", "fill"), ("J9", "SUM(B1:B3*2)", "fill"),
        ("N1:N3", "SUM(IF(B$1:B$3>15,B$1:B$3))", "fill"), ("O1:O3", "SUM(CHOOSE(2,1,B$1:B$3))", "fill"),
        ("P1:P3", "SUM(ABS(SUM(B$1:B$3)-B$1:B$3))", "fill"),
        ("K1:K3", "AND(B$1:B$3>15)", "fill"), ("L1", "@B1:B3", "spill"), ("M2", "@{4,5}", "fill"),
    ]  # fmt: skip
    values = compile_book(book(NUMBERS, blocks)).evaluate()
    assert column(values, "E", 1, 3)[0] == 20
    assert column(values, "F", 1, 3)[0] == 20
    assert column(values, "H", 1, 4) == [11, 21, 31, ErrorValue("#VALUE!")]
    assert column(values, "I", 1, 3) == [120, 120, 120]
    assert values.get("S", 8, 9) == ErrorValue("#VALUE!")
    assert column(values, "K", 1, 3) == [False, True, True]
    assert column(values, "N", 1, 3) == [0, 60, 60]  # the condition is one cell, the branch the whole range
    assert column(values, "O", 1, 3) == [60, 60, 60]
    assert column(values, "P", 1, 3) == [50, 40, 30]
    assert (values.get("S", 0, 11), values.get("S", 1, 12)) == (10, 4)


# --- order that depends on values -----------------------------------------------------------------------------------


def test_references_that_are_computed_come_after_what_they_mean():
    blocks = [
        ("A2", 'INDIRECT("C"&A1)', "fill"), ("C3", "OFFSET(D1,2,0)+1", "fill"), ("D3", "E1*2", "fill"), ("E1", "7", "fill"),
        ("F1:F5", 'IF(ROW()=1,1,INDIRECT("R[-1]C",FALSE)*2)', "fill"), ("G5", "SUM(G1:OFFSET(G5,-1,0))", "fill"),
        ("G1:G4", "F1", "fill"), ("H1:H4", "OFFSET(H1,1,0)+1", "fill"), ("H5", "1", "fill"),
    ]  # fmt: skip
    plan = compile_book(book(NUMBERS, blocks))
    for _ in range(2):
        values = plan.evaluate()
        assert values.remarks == ()
        assert values.get("S", 1, 0) == 15
        assert column(values, "F", 1, 5) == [1, 2, 4, 8, 16]
        assert values.get("S", 4, 6) == 15
        assert column(values, "H", 1, 5) == [5, 4, 3, 2, 1]
    # another value of A1, another order
    assert plan.evaluate({("S", 0, 0): 9.0}).get("S", 1, 0) == 0


def test_a_circle_through_a_reference_that_is_computed():
    values = compile_book(book(NUMBERS, [("C1", 'INDIRECT("D1")+1', "fill"), ("D1", "C1*2", "fill")])).evaluate()
    assert [fault.message for fault in values.remarks] == ["circular reference: S!C1 -> S!D1 -> S!C1"]
    assert values.get("S", 0, 3) == ErrorValue("#REF!")


def test_a_branch_that_is_not_taken_closes_no_circle():
    blocks = [
        ("C1", 'CHOOSE(2,C1,"no circle")', "fill"), ("D1", "IF(A1>0,B1,E1)", "fill"), ("E1", "IF(A1>0,D1,1)", "fill"),
        ("F1", "IFERROR(B1,G1)", "fill"), ("G1", "F1+1", "fill"),
    ]  # fmt: skip
    plan = compile_book(book(NUMBERS, blocks))
    values = plan.evaluate()
    assert values.remarks == ()
    assert [values.get("S", 0, col) for col in range(2, 7)] == ["no circle", 10, 10, 10, 11]
    assert [values.get("S", 0, col) for col in (3, 4)] == [10, 10]
    assert plan.evaluate({("S", 0, 0): -1.0}).get("S", 0, 3) == 1


def test_many_references():
    """OFFSET and INDIRECT with an array among their arguments mean many references, one after the other."""
    formulas = {
        "SUMPRODUCT(SUBTOTAL(9,OFFSET(B1,ROW(B1:B3)-ROW(B1),0)))": 60.0, "SUM(N(OFFSET(B1,{0,2},0)))": 40.0,
        'SUMPRODUCT(SUMIF(INDIRECT("B"&ROW(INDIRECT("1:3"))),">15"))': 50.0, "SUM(OFFSET(B1,0,0,A1,1))": 60.0,
        'SUMPRODUCT(COUNTIF(OFFSET(B1,0,0,{1;2;3}),">0"))': 6.0, "SUM(OFFSET(B1,B1:B3,0))": ErrorValue("#VALUE!"),
    }  # fmt: skip
    blocks = [(f"J{row}", formula, "fill") for row, formula in enumerate(formulas, 20)]
    values = compile_book(book(NUMBERS, [*blocks, ("F1", "SUBTOTAL(9,OFFSET(B1,{0;1},0,2))", "spill")])).evaluate()
    for row, (formula, expected) in enumerate(formulas.items(), 19):
        assert same(values.get("S", row, 9), expected), (formula, values.get("S", row, 9))
    assert column(values, "F", 1, 2) == [30, 50]


def test_what_a_function_of_places_takes_is_not_read():
    blocks = [
        ("C5", "ROW(C5)+ROWS(C1:C9)", "fill"),
        ("D1", 'CELL("row",D1)', "fill"),
        ("E3", "SUM(B1:OFFSET(E3,-1,-3))", "fill"),
    ]
    values = compile_book(book(NUMBERS, blocks)).evaluate()
    assert values.remarks == ()
    assert [values.get("S", 4, 2), values.get("S", 0, 3), values.get("S", 2, 4)] == [14, 1, 30]


def test_other_workbooks_keep_their_values():
    blocks = [
        ("C1:C3", "[1]S!A1*2", "fill"), ("D1", "SUM(C1:C3)", "fill"), ("E1", "far+1", "fill"), ("F1", "NOW()>0", "fill"),
    ]  # fmt: skip
    made = book(NUMBERS, blocks, [("far", "[2]T!$A$1")])
    for row, value in enumerate((1.0, 2.0, "text")):
        made.sheets[0].cached.put(row, 2, value)
    values = compile_book(made).evaluate()
    assert column(values, "C", 1, 3) == [1, 2, "text"]
    assert values.get("S", 0, 3) == 3
    assert values.get("S", 0, 4) == ErrorValue("#REF!")  # no value is stored
    assert [(fault.key, fault.message.partition(",")[0]) for fault in values.remarks] == [
        ("S!C1:C3", "a reference to another workbook"), ("S!E1", "a reference to another workbook"),
        ("S!F1", "NOW gives another value at every recalculation"),
    ]  # fmt: skip


def test_values_kept_while_inputs_change():
    """A book in which sizes and order depend on values, set and read again and again, is what a new evaluation gives."""
    blocks = [
        ("D1:D2", "MAKEARRAY(A1,1,LAMBDA(r,c,r))", "spill"), ("E1", "SUM(D1#)", "fill"),
        ("F1", "SUM(OFFSET(B1,0,0,A1,1))", "fill"), ("G1:G3", "B1*E$1", "fill"),
    ]  # fmt: skip
    plan = compile_book(book(NUMBERS, blocks))
    live = Live(plan)
    for count, first in ((3.0, 10.0), (1.0, 10.0), (2.0, 7.0), (3.0, 10.0)):
        live.set((0, 0, 0), count)
        live.set((0, 0, 1), first)
        fresh = plan.evaluate({("S", 0, 0): count, ("S", 0, 1): first})
        assert list(live.values().items("S")) == list(fresh.items("S"))
        cells = live.read(Area(0, 0, 5, 1, 1))
        assert cells.numbers[0, 0] == fresh.get("S", 0, 5)
    live.reset((0, 0, 1))
    assert live.values().get("S", 0, 6) == 60


def test_long_columns_of_a_book_that_settles():
    """On the fast path as well: what goes wrong in an array is seen there, and becomes the error it is."""
    rows = 40_000
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [float(row % 7) for row in range(rows)])
    sheet.block(0, 1, rows, 1, parse_formula("1/A1+OFFSET($D$1,0,0)*0"))
    sheet.block(0, 2, rows, 1, parse_formula("SQRT(A1-1)"))
    sheet.block(0, 3, 1, 1, parse_formula('SUM(INDIRECT("A1:A7"))'))
    sheet.block(0, 4, rows, 1, parse_formula("D$1/A1"))
    plan = compile_book(builder.build())
    for _ in range(3):
        values = plan.evaluate()
        assert column(values, "C", 1, 3) == [NUM, 0, 1]
        assert column(values, "E", 7, 9) == [21 / 6, ErrorValue("#DIV/0!"), 21]
        assert column(values, "B", 1, 2) == [ErrorValue("#DIV/0!"), 1]
        _, codes = values.arrays("S", 4, 0, rows - 1)
        assert (codes != 0).sum() == len(range(0, rows, 7))


def test_a_range_with_many_ends_is_no_value():
    """It was told as a fault of this program."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [1.0, 2.0, 3.0])
    for row, text in enumerate(("MAX(A1:INDEX(A1:A3,A1:A3))", "SUM(INDEX(A1:A3,A1:A3):A2)")):
        sheet.block(row, 1, 1, 1, parse_formula(text))
    values = compile_book(builder.build()).evaluate()
    assert column(values, "B", 1, 2) == [ErrorValue("#VALUE!")] * 2
    assert not values.remarks
