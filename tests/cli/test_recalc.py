"""`mechsheet recalc` as a user types it, on workbooks that other programs have made."""

import json

import openpyxl
import pytest
import xlsxwriter

from command_line import run


@pytest.fixture
def book(tmp_path):
    """Two sheets with a name, values of every kind, stored values that are right."""
    path = tmp_path / "book.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        sheet, other = workbook.add_worksheet("Plan"), workbook.add_worksheet("It's = odd")
        workbook.define_name("rate", "=Plan!$B$1")
        workbook.define_name("table", "=Plan!$A$1:$C$2")
        sheet.write_row("A1", ["rate", 0.5])
        sheet.write_formula("C1", '=IF(rate>1,"high","low\tish")', value="low\tish")
        sheet.write_formula("A2", "=rate*4", value=2)
        sheet.write_formula("B2", "=1/(A2-2)", value="#DIV/0!")
        sheet.write_formula("C2", "=A2>1", value=True)
        other.write_formula("B3", "=Plan!A2+1", value=3)
    return path


def test_ranges_are_printed_as_tables(book):
    result = run("recalc", book, "--print", "Plan!A1:C2", "--print", "'It''s = odd'!$B$3", "--set", "rate=1.25")
    assert result.exit_code == 0
    assert result.stdout == "rate\t1.25\thigh\n5\t0.3333333333333333\tTRUE\n\n6\n"
    assert run("recalc", book, "--print", "table").stdout == 'rate\t0.5\t"low\tish"\n2\t#DIV/0!\tTRUE\n'


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("plan!b:b", "0.5\n#DIV/0!\n"),
        ("Plan!2:2", "2\t#DIV/0!\tTRUE\n"),
        ("Plan!B1", "0.5\n"),
        ("Plan!C2:B1", "0.5\t\"low\tish\"\n#DIV/0!\tTRUE\n"),
        ("rate", "0.5\n"),
        ("Plan!E9:E10", '""\n""\n'),
    ],
)  # fmt: skip
def test_what_ranges_mean(book, text, expected):
    assert run("recalc", book, "--print", text).stdout == expected


@pytest.mark.parametrize(
    "text", ["Nowhere!A1", "Plan!A0", "Plan!A1:", "Plan!", "none", "Plan!A", "Plan!XFE1", "Plan!A1:B2:C3"]
)
def test_ranges_that_mean_nothing(book, text):
    result = run("recalc", book, "--print", text)
    assert result.exit_code == 2
    assert "book.xlsx" in result.stderr
    assert result.stdout == ""


def test_json_of_ranges_only(book):
    cells = json.loads(run("recalc", book, "--print", "Plan!A2:D2", "--print", "Plan!B1", "--json").stdout)
    assert cells == {"Plan": {"A2": 2.0, "B2": "#DIV/0!", "C2": True, "D2": None, "B1": 0.5}}


def test_cells_are_set_by_address_and_as_typed(book):
    result = run(
        "recalc", book, "--set", "'It''s = odd'!A1=x=y", "--set", "Plan!B9=TRUE", "--set", "Plan!A1='12", "--json"
    )
    cells = json.loads(result.stdout)
    assert cells["It's = odd"] == {"A1": "x=y", "B3": 3.0}
    assert (cells["Plan"]["B9"], cells["Plan"]["A1"], cells["Plan"]["A2"]) == (True, "12", 2.0)


def test_what_is_set_is_written(book, tmp_path):
    output = tmp_path / "new.xlsx"
    assert run("recalc", book, "--set", "rate=2", "--set", "Plan!D9=new", "-o", output).exit_code == 0
    sheet = openpyxl.load_workbook(output, data_only=True)["Plan"]
    assert [cell.value for cell in sheet[1]][:3] == ["rate", 2, "high"]
    assert (sheet["A2"].value, sheet["D9"].value) == (8, "new")
    assert openpyxl.load_workbook(output)["Plan"]["A2"].value == "=rate*4"


def test_check_agrees(book):
    result = run("recalc", book, "--check")
    assert (result.exit_code, result.stdout) == (0, "5 formulas: 5 as stored, 0 differ\n")


@pytest.fixture
def stale(tmp_path):
    """Stored values that are not what the formulas say."""
    path = tmp_path / "stale.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("S")
        for row in range(20):
            sheet.write_number(row, 0, row)
            sheet.write_formula(row, 1, f"=SQRT(A{row + 1})", value=row**0.5 + (0.5 if row in (4, 9) else 0))
        sheet.write_formula("C1", "=SUM(B1:B20)", value=sum(row**0.5 for row in range(20)) + 1)
        sheet.write_formula("C2", "=A1&B2", value="x")
        sheet.write_formula("C3", "=NA()", value=1)
        sheet.write_formula("C4", "=A5+0.1-5+0.9", value=1e-17)  # what is left when numbers cancel
        sheet.write_formula("C5", "=A4*2", value="six")
    return path


def test_check_finds_what_differs_and_where_it_begins(stale):
    result = run("recalc", stale, "--check")
    assert result.exit_code == 1
    assert "25 formulas" in result.stdout
    assert "2 number by 2.0e-01  SQRT\n          S!B5 =SQRT(A5)\n          computed 2, stored 2.5" in result.stdout
    assert "SUM" not in result.stdout  # follows from the other two
    assert "1 reads cells that differ themselves" in result.stdout
    [report] = json.loads(run("recalc", stale, "--check", "--json").stdout)
    assert [(item["cell"], item["kind"], item["follows"]) for item in report["differences"]] == [
        ("S!B5", "number", False),
        ("S!B10", "number", False),
        ("S!C1", "number", True),
        ("S!C2", "text", False),
        ("S!C3", "error", False),
        ("S!C5", "type", False),
    ]
    assert [(group["functions"], group["kind"], group["cells"]) for group in report["groups"]] == [
        ("SQRT", "number", 2), ("&", "text", 1), ("*", "type", 1), ("NA", "error", 1)
    ]  # fmt: skip
    assert (report["agrees"], report["formulas"], report["equal"]) == (False, 25, 19)


def test_check_knows_nothing_of_settings(book):
    result = run("recalc", book, "--check", "--set", "rate=3")
    assert result.exit_code == 2
    assert "--check compares with the stored values" in result.stderr


def test_files_without_stored_values(tmp_path):
    workbook = openpyxl.Workbook()
    workbook.active.append([1, "=A1+1"])
    workbook.save(tmp_path / "a.xlsx")
    result = run("recalc", tmp_path / "a.xlsx", "--check")
    assert (result.exit_code, result.stdout) == (
        0,
        "1 formula: 0 as stored, 0 differ\n  no value is stored: nothing was compared\n",
    )


@pytest.fixture
def broken(tmp_path):
    """A workbook with a formula that is none."""
    path = tmp_path / "broken.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("S")
        sheet.write_formula("A1", "=SUM(A9,", value=42)
        sheet.write_formula("A2", "=A1+1", value=43)
    return path


def test_what_cannot_be_computed_is_noted_and_strictly_refused(broken):
    result = run("recalc", broken, "--print", "S!A1:A2")
    assert (result.exit_code, result.stdout) == (0, "42\n43\n")
    assert result.stderr.startswith("note: S!A1: ")
    assert run("recalc", broken, "--strict").exit_code == 1
    checked = run("recalc", broken, "--check")
    assert checked.exit_code == 0
    assert "1 more was not computed: its stored value was taken" in checked.stdout
