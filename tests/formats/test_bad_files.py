"""Whatever a file is, `recalc` ends soon, within bounded memory, with one clear message and exit code 2."""

import time
import tracemalloc

import pytest
from bad_files import BAD, formula, packed, sheet, xlsx

from command_line import run
from livesheet.formula.nodes import ErrorValue
from mechsheet.library.recalculation import recalc


@pytest.mark.cases(63)
@pytest.mark.parametrize("name", BAD)
def test_one_message(tmp_path, name):
    path = tmp_path / f"bad{BAD[name].suffix}"
    path.write_bytes(BAD[name].make())
    began = time.perf_counter()
    result = run("recalc", path, "-o", tmp_path / f"out{BAD[name].suffix}")
    assert time.perf_counter() - began < 5
    assert result.exit_code == 2
    assert result.stdout == ""
    assert BAD[name].message in result.stderr
    assert path.name in result.stderr
    assert sum(not line.startswith(" ") for line in result.stderr.splitlines()) == 1
    assert [left.name for left in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("name", ["laughs-sheet", "overlapping", "one-long-text", "ods-filled"])
def test_little_memory(tmp_path, name):
    path = tmp_path / f"bad{BAD[name].suffix}"
    path.write_bytes(BAD[name].make())
    tracemalloc.start()
    run("recalc", path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 64 << 20


def test_a_folder_and_nothing(tmp_path):
    assert "this is a folder" in run("recalc", tmp_path).stderr
    assert "cannot be read" in run("recalc", tmp_path / "nothing.xlsx").stderr
    assert run("recalc", tmp_path / "nothing.xlsx").exit_code == 2


DEEP = {
    "parentheses": "(" * 5000 + "1" + ")" * 5000,
    "signs": "-" * 8000 + "1",
    "functions": "ABS(" * 2000 + "1" + ")" * 2000,
    "powers": "^".join(["1"] * 4000),
    "arrays": "{" * 4000 + "1" + "}" * 4000,
    "percents": "1" + "%" * 8000,
    "open": "SUM(" * 4000,
    "quotes": '"' * 8191,
    "brackets": "[" * 8000,
    "colons": ":".join(["B1"] * 2700),
    "spaces": "B1" + " " * 8000 + "B1",
}


@pytest.mark.parametrize("name", DEEP)
def test_formulas_beyond_all_measure(tmp_path, name):
    """Read or remarked with their cell, never a traceback."""
    path = tmp_path / "deep.xlsx"
    path.write_bytes(formula(DEEP[name]))
    began = time.perf_counter()
    result = run("recalc", path)
    assert time.perf_counter() - began < 5
    assert result.exit_code == 0
    assert not result.stderr or "S!A1" in result.stderr


def test_formulas_as_long_and_deep_as_excel_allows(tmp_path):
    """8,192 characters, 64 levels."""
    terms = 4000
    formulas = [
        "1" + "+1" * terms,
        "B1" + "&amp;B1" * 2000,
        "IF(B1," * 64 + "7" + ",0)" * 64,
        "(" * 64 + "B1" + ")" * 64,
        "SUM(" + ",".join(["B1"] * 255) + ")",
        "-" * 60 + "B1",
    ]
    cells = "".join(f'<c r="{letter}2"><f>{text}</f></c>' for letter, text in zip("ABCDEF", formulas, strict=True))
    path = tmp_path / "long.xlsx"
    path.write_bytes(sheet(f'<row r="1"><c r="B1"><v>2</v></c></row><row r="2">{cells}</row>'))
    result = recalc(path)
    assert result.remarks == ()
    assert [result.get("S", 1, col) for col in range(6)] == [terms + 1.0, "2" * 2001, 7.0, 2.0, 510.0, 2.0]


def test_names_that_stand_for_each_other(tmp_path):
    circles = {"a": "b+1", "b": "a*2", "c": "c"}
    names = "".join(f'<definedName name="{name}">{text}</definedName>' for name, text in circles.items())
    path = tmp_path / "names.xlsx"
    path.write_bytes(packed(xlsx('<row r="1"><c r="A1"><f>a</f></c><c r="B1"><f>c+1</f></c></row>', names)))
    result = run("recalc", path, "--print", "S!A1:B1", "--strict")
    assert result.exit_code in (1, 2)
    assert "stands for itself" in result.stderr
    assert "S!A1" in result.stderr
    assert "S!B1" in result.stderr


def test_a_circle_is_named(tmp_path):
    path = tmp_path / "circle.xlsx"
    path.write_bytes(sheet('<row r="1"><c r="A1"><f>B1+1</f></c><c r="B1"><f>A1+1</f></c></row>'))
    result = run("recalc", path, "--strict")
    assert result.exit_code == 1
    assert "circular reference: S!A1 -> S!B1 -> S!A1" in result.stderr


def test_a_shared_formula_that_leaves_the_sheet(tmp_path):
    path = tmp_path / "shared.xlsx"
    path.write_bytes(
        sheet(
            '<row r="3"><c r="B3"><f t="shared" ref="A1:XFD1048576" si="0">A1*2</f></c></row>'
            '<row r="4"><c r="A4"><f t="shared" si="0"/></c><c r="B4"><f t="shared" si="0"/></c></row>'
        )
    )
    result = recalc(path)
    assert (result.get("S", 3, 0), result.get("S", 3, 1)) == (ErrorValue("#REF!"), 0.0)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("rows", [20_000, pytest.param(1_048_576, marks=[pytest.mark.slow, pytest.mark.ci])])
def test_a_full_sheet(tmp_path, rows):
    """1,048,576 rows: shared formulas, and a reference to the whole column."""
    first = f'<row r="1"><c r="A1"><f t="shared" ref="A1:A{rows}" si="0">ROW()</f><v>1</v></c>'
    first += '<c r="B1"><f>SUM(A:A)</f></c></row>'
    others = "".join(f'<row r="{r}"><c r="A{r}"><f t="shared" si="0"/><v>{r}</v></c></row>' for r in range(2, rows + 1))
    path = tmp_path / "full.xlsx"
    path.write_bytes(sheet(first + others))
    result = recalc(path)
    assert result.get("S", 0, 1) == rows * (rows + 1) / 2
    assert result.compare_with_stored().equal == rows
