"""Functions of mechanisms: what they compute, and the workbooks that call them."""

import math
import shutil
import zipfile
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from command_line import run
from folders import TEMPLATES
from livesheet.diagnostics import OutputError
from livesheet.engine import evaluate
from livesheet.evaluation import computed
from livesheet.formats import read, write
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet.checking.programs import answers
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.dynamics.solve import solve
from mechsheet.exporting.functions.all_functions import functions_of
from mechsheet.exporting.functions.lambdas import named_functions
from mechsheet.exporting.functions.routines import Source, matches
from mechsheet.exporting.functions.sheets import DIFFERENCE_ROW, LESSON_TITLE
from mechsheet.exporting.functions.sheets import FIRST as FIRST_CALL
from mechsheet.exporting.functions.workbooks import NEEDS_ROW, functions_workbook
from mechsheet.library.building import build
from mechsheet.library.recalculation import recalc
from mechsheet.sheet.asked.two_way import CHART_COLUMNS, FIRST
from mechsheet.sheet.layout import lay_out
from office_macros import Job as Office
from office_macros import with_macros
from random_mechanisms import Grower

pytestmark = pytest.mark.slow

PUMP, FOUR_BAR = TEMPLATES / "adjustable-pump.toml", TEMPLATES / "four-bar.toml"

TABLES = """
[[tables]]
rows = "theta12"
columns = { a4 = [40, 56, 90] }
value = "mu"
[[tables]]
rows = "theta12"
columns = { a1 = [60, 70, 100] }
value = "theta13"
"""


@cache
def four_bar_with_tables():
    """Angles in tables, two of them; some positions do not exist."""
    return loads(FOUR_BAR.read_text(encoding="utf-8").replace("[workbook]", TABLES + "\n[workbook]") + "")


def values_of(mechanism, formulas: list[str]) -> list:
    """What the engine computes from formulas that call the mechanism's functions, written as LAMBDA."""
    source = Source(Compiled(mechanism))
    functions = functions_of(source, "tr")
    builder = BookBuilder()
    for function in named_functions(functions, {function.key: function.name for function in functions}):
        builder.name(function.name, function.formula)
    sheet = builder.sheet("S")
    for row, formula in enumerate(formulas):
        sheet.block(row, 0, 1, 1, parse_formula(formula))
    return list(evaluate(builder.build()).column("S", 0, 0, len(formulas) - 1))


# --- the functions --------------------------------------------------------------------------------------------------

MISSING = ErrorValue("#N/A")

KNOWN = {
    # right triangles, a parallelogram, limits that are reached exactly
    "Boy(3,4)": 5.0,
    "Açı(-1,0)": math.pi,
    "Açı(1,-1)": -math.pi / 4,
    "AçıCos(3,4,5)": math.pi / 2,
    "AçıCos(1,1,2)": math.pi,
    "AçıCos(2,1,1)": 0.0,
    "AçıCos(1,1,2.1)": MISSING,
    "ÜçgenAlanı(3,4,5,1E-12)": 6.0,
    "DikKenar(5,3,1E-12)": 4.0,
    "DikKenar(5,6,1E-12)": MISSING,
    "DörtÇubuk(1,2,1,2,1,PI()/2)": math.pi / 2,
    "DörtÇubukBiyel(1,2,1,2,1,PI()/2)": 0.0,
    "DörtÇubuk(1,1,1,9,1,0)": MISSING,
    "KolKızak(1,2,PI()/2)": math.pi - math.atan(0.5),
    "KolKızak(1,2,-PI()/2)": math.pi + math.atan(0.5),
    "KolKızakE(1,2,0,1,PI()/2)": math.pi - math.atan(0.5),
    "KolKızakE(1,2,0,-1,PI()/2)": -math.atan(0.5),
    "KolKızakÖtelenmesi(3,0,0,1,1)": 3.0,
    "DiyadRRR(0,0,5,6,0,5,1)": math.atan2(4, -3),
    "DiyadRRRBirinci(0,0,5,6,0,5,1)": math.atan2(4, 3),
    "DiyadRRR(0,0,5,6,0,5,-1)": 2 * math.pi - math.atan2(4, -3),
    "DiyadRRR(0,0,5,0,0,5,1)": MISSING,
    "DiyadRRP(0,0,5,1,3,0,1)": 3.0,
    "DiyadRRP(0,0,5,1,3,0,-1)": -5.0,
    "DiyadRRPBirinci(0,0,5,1,3,0,1)": math.atan2(3, 4),
    "DiyadRPR(0,0,4,3,0,1)": math.atan2(3, 4),
    "DiyadRPR(0,0,5,0,3,1)": -math.atan2(3, 4),
    "DiyadRPRÖtelenme(0,0,5,0,3,1)": 4.0,
    "DiyadRPR(0,0,2,0,3,1)": MISSING,
    "DiyadPRP(0,0,PI()/4,2,0,PI()/2)": math.sqrt(8),
    "DiyadPRPİkinci(0,0,PI()/4,2,0,PI()/2)": 2.0,
    "DiyadPRP(0,0,1,2,0,1)": MISSING,
    "DiyadRPP(3,4,0,0,0,PI()/2)": 3.0,
    "DiyadRPPKanal(3,4,0,0,0,PI()/2)": 4.0,
}


def test_basic_functions():
    found = values_of(load(PUMP), list(KNOWN))
    for (formula, wanted), value in zip(KNOWN.items(), found, strict=True):
        if wanted is MISSING:  # which error, differs: the direction of no vector is #DIV/0! in Excel
            assert isinstance(value, ErrorValue), formula
        else:
            assert value == pytest.approx(wanted, abs=1e-12), formula


def test_the_slider_crank_of_the_text():
    """s14 = 273.9, theta13 = 174.7 degrees (the coupler's axis points from the slider to the crank there)."""
    displacement, angle = values_of(
        load(PUMP), ["KrankBiyel(50,250,20,1,PI()/3)", "KrankBiyelAçısı(50,250,20,1,PI()/3)"]
    )
    assert displacement == pytest.approx(273.9118, abs=1e-4)
    assert math.degrees(angle) + 180 == pytest.approx(174.652, abs=1e-3)


def test_what_a_workbook_refuses_has_no_value():
    """A rod of length -165 or 0, a mode that is neither 1 nor -1."""
    pump = "AyarlıPompa_s15(55,240,{rod},185,70,250,RADIANS(20),{mode})"
    given = [(165, 1), (-165, 1), (0, 1), (165, 0.5), (165, 2)]
    found = values_of(load(PUMP), [pump.format(rod=rod, mode=mode) for rod, mode in given])
    assert [value == MISSING for value in found] == [False, True, True, True, True]


def test_the_pump_of_the_text_in_degrees():
    formulas = ["AyarlıPompa(55,240,165,185,70,20,0,1)", "AyarlıPompa_s15(55,240,165,185,70,250,RADIANS(20),1)"]
    assert values_of(load(PUMP), formulas) == pytest.approx([252.0937, 245.9161], abs=6e-5)


@pytest.mark.parametrize(
    ("pattern", "node", "found"),
    [
        ("SQRT(x^2+y^2)", "SQRT((a-1)^2+b^2)", {"x": "a-1", "y": "b"}),
        ("SQRT(x^2+x^2)", "SQRT(a^2+b^2)", None),
        ("SQRT(x^2+y^2)", "SQRT(a^2-b^2)", None),
        ("SQRT(x^2+y^2)", "ABS(a^2+b^2)", None),
        ("SQRT(x^2+y^2)", "SQRT(a^3+b^2)", None),
        ("MAX(x,y)", "MAX(a,b,c)", None),
    ],
)
def test_matches(pattern, node, found):
    from livesheet.formula.nodes import NameRef, Symbol, transform

    def as_symbols(text):
        return transform(parse_formula(text), lambda part: Symbol(part.name) if isinstance(part, NameRef) else part)

    bound: dict = {}
    assert matches(as_symbols(pattern), as_symbols(node), bound) == (found is not None)
    if found:
        assert bound == {name: as_symbols(text) for name, text in found.items()}


# --- LAMBDA ---------------------------------------------------------------------------------------------------------


SEARCHED = ("Mechanism", "Mekanizma", "Drawing", "Çizim", "Extremes", "Uç değerler", "Checks", "Denetim")
"""Sheets that read ranges like INDEX(…):INDEX(…), which IronCalc does not know; and Checks, which says in which row the
largest rounding is: another program's last digits put it elsewhere."""


def compared(one, other, left_out=()) -> tuple[int, float]:
    """Cells of every formula of `other` compared with those of `one`: how many, the worst relative difference."""
    count, worst = 0, 0.0
    for sheet in other.sheets:
        if sheet.title in left_out:
            continue
        for block in sheet.blocks:
            if sheet.title.startswith(("Table", "Tablo")) and block.col > CHART_COLUMNS + 2:
                continue  # blocks of angles beside the table: functions need none
            for row in range(block.row, block.row + block.rows):
                for col in range(block.col, block.col + block.cols):
                    wanted, found = sheet.cached.get(row, col), one.get(sheet.title, row, col)
                    count += 1
                    if isinstance(wanted, float) and isinstance(found, float):
                        worst = max(worst, abs(wanted - found) / max(1.0, abs(wanted)))
                    else:
                        assert (found or None) == (wanted or None), (sheet.title, row, col)
    return count, worst


class Stored:
    """The stored values of a book."""

    def __init__(self, book):
        self.book = book

    def get(self, title, row, col):
        return self.book.sheet(title).cached.get(row, col)


@cache
def built(folder: Path, path: Path | None) -> tuple[Path, Path]:
    """(default workbook, the same with LAMBDA)."""
    mechanism = four_bar_with_tables() if path is None else load(path)
    default, other = build(mechanism, folder, ("xlsx",), ("lambda",))
    return default, other


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("functions")


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("path", "program"),
    [
        (PUMP, ""),
        pytest.param(PUMP, "ironcalc", marks=[pytest.mark.slow, pytest.mark.ci]),
        pytest.param(None, "", marks=[pytest.mark.slow, pytest.mark.ci]),
        pytest.param(None, "ironcalc", marks=pytest.mark.slow),
    ],
)
def test_every_cell_of_the_lambda_workbook_equals_the_default(path, program, folder):
    default, other = built(folder, path)
    assert other.name.endswith("-lambda.xlsx")
    found = answers(program, other) if program else Stored(read(other))
    count, worst = compared(found, read(default), SEARCHED if program == "ironcalc" else ())
    assert count > (500 if program == "ironcalc" else 1500)
    assert worst < 1e-10
    result = recalc(other)
    assert not result.remarks
    left_out = (*SEARCHED, "Step by step", "Adım adım") if program == "ironcalc" else ()  # it finds no name with a ç
    assert compared(found, read(other), left_out)[1] < 1e-10


def test_the_table_calls_the_function_as_the_text_does(folder):
    _, other = built(folder, PUMP)
    sheet = read(other).sheet("Tablo s15")
    block = sheet.formula_at(FIRST, 1)
    # Each cell is a dynamic array of its own: without, Excel shows =@AyarlıPompa(...).
    assert (block.kind, block.rows, block.cols) == ("spill", 1, 1)
    assert sheet.formula_at(FIRST + 18, 6).kind == "spill"
    assert print_formula(block.formula).casefold() == "ayarlipompa(krank,biyel,arakol,sabitu_y,eksantrik,b$7,$a8)"
    assert "LAMBDA" in read(other).sheets[0].constants.get(NEEDS_ROW, 0)
    result = run("check", other)
    assert (result.exit_code, "all agree" in result.stdout) == (0, True), result.output


def test_an_edited_function_is_found(folder, tmp_path):
    """Another formula behind one of the names."""
    _, other = built(folder, PUMP)
    edited = tmp_path / "edited.xlsx"
    with zipfile.ZipFile(other) as old, zipfile.ZipFile(edited, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "xl/workbook.xml":
                assert content.count(b"SQRT(_xlpm.X_1^2+_xlpm.Y_1^2)") == 1
                content = content.replace(b"SQRT(_xlpm.X_1^2+_xlpm.Y_1^2)", b"SQRT(_xlpm.Y_1^2+_xlpm.X_1^2)")
            new.writestr(name, content)
    result = run("check", edited)
    assert result.exit_code == 1
    assert "Boy" in result.stdout


@pytest.mark.ci
def test_the_assembly_mode_reaches_the_functions(folder):
    default, other = built(folder, PUMP)
    one, two = (recalc(path, {"mode_1": -1.0}).values for path in (default, other))
    as_built = recalc(default).values
    found = [list(values.column("Tablo s15", 1, FIRST, FIRST + 18)) for values in (one, two, as_built)]
    assert found[1] == pytest.approx(found[0], rel=1e-12)
    assert found[1] != pytest.approx(found[2], rel=1e-3)


WHEEL = """
[links.wheel]
points = { B0 = [0, 0], E = [20, 0] }
[[joints]]
type = "gear"
link = "wheel"
on = "rocker"
arm = "ground"
ratio = 2.5
"""


@pytest.mark.cases(1)
@pytest.mark.parametrize("seed", [None, 2, 5, 9])
def test_functions_of_other_mechanisms_equal_the_table_of_positions(seed):
    """Random ones, and what a rack and a gear make of an angle, of which whole turns would count."""
    if seed is None:
        text = (PUMP.parent / "rack-slider.toml").read_text(encoding="utf-8").replace("step = 15", "step = 60")
        mechanism = loads(text + WHEEL)
    else:
        mechanism = loads(Grower(seed, 1 + seed % 3).text(rows=7))
    workbook = computed(functions_workbook(Compiled(mechanism), "lambda"))
    sheet = workbook.sheet("Functions")
    gaps = [fill.values[0] for fill in sheet.fills if fill.row == DIFFERENCE_ROW]
    assert len(gaps) > 5
    assert max(gaps) < 1e-9
    values = [fill.values for fill in sheet.fills if fill.row == FIRST_CALL and 1 < fill.col < 2 + len(gaps)]
    assert sum(isinstance(value, float) for column in values for value in column) > len(gaps)


def test_names_of_a_description_that_functions_use_themselves():
    """A dimension called driver, results of other names, and formulas that name cells by their addresses."""
    text = PUMP.read_text(encoding="utf-8")
    text = text.replace("c4", "driver").replace("b1", "mode").replace("a3", "Tol")
    mechanism = loads(text.replace('language = "tr"', 'language = "tr"\nreferences = "anchors"'))
    workbook = computed(functions_workbook(Compiled(mechanism), "lambda"))
    (table,) = [fill for fill in workbook.sheet("Tablo s15").fills if (fill.row, fill.col) == (FIRST, 1)]
    assert table.values[:2] == pytest.approx([252.0937, 247.4078], abs=6e-5)


def test_a_function_too_long_for_excel_is_refused(tmp_path):
    workbook = computed(functions_workbook(Compiled(load(PUMP)), "lambda"))
    long = replace(workbook.functions[0], name="Uzun", formula=parse_formula("+".join(["1234567"] * 1100)))
    with pytest.raises(OutputError, match=r"Uzun.*8192"):
        write(replace(workbook, functions=(*workbook.functions, long)), tmp_path / "long.xlsx")
    assert not (tmp_path / "long.xlsx").exists()


# --- Basic ----------------------------------------------------------------------------------------------------------


def test_the_basic_workbook_holds_its_module(tmp_path):
    path = tmp_path / "pump.ods"
    write(computed(functions_workbook(Compiled(load(PUMP)), "basic")), path)
    with zipfile.ZipFile(path) as archive:
        names = set(archive.namelist())
        module = archive.read("Basic/Standard/Mechsheet.xml").decode()
        manifest = archive.read("META-INF/manifest.xml").decode()
    for part in ("Basic/script-lc.xml", "Basic/Standard/script-lb.xml", "Basic/Standard/Mechsheet.xml"):
        assert part in names
        assert f'"{part}"' in manifest
    assert "Public Function AyarliPompa_s15(" in module
    assert "Attribute VB_Name" not in module
    assert "makrolar" in str(read(path).sheets[0].cached.get(NEEDS_ROW, 0))


def test_the_default_workbook_has_no_macros_and_no_functions():
    workbook, _ = lay_out(load(PUMP), solve(load(PUMP)))
    assert workbook.functions == workbook.modules == ()


@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.skipif(shutil.which("soffice") is None, reason="LibreOffice is not installed")
def test_libreoffice_computes_the_basic_workbooks(tmp_path):
    """Every cell, by the functions that the file carries; also where positions do not exist."""
    files = [build(mechanism, tmp_path, (), ("basic",))[-1] for mechanism in (load(PUMP), four_bar_with_tables())]
    for path, found in zip(files, with_macros([Office(document=path) for path in files]), strict=True):
        book = read(path)
        missing = 0
        for sheet in book.sheets:
            if sheet.title in ("Checks", "Denetim", "Extremes", "Uç değerler"):
                continue  # which error a cell has, and which of two equal rows is probed, is not the same in all programs
            for block in sheet.blocks:
                for row in range(block.row, block.row + block.rows):
                    for col in range(block.col, block.col + block.cols):
                        wanted, value = sheet.cached.get(row, col), found.get(sheet.title, row, col)
                        if isinstance(wanted, float):
                            assert value == pytest.approx(wanted, rel=1e-9, abs=1e-9), (sheet.title, row, col)
                        elif wanted and sheet.title in (
                            LESSON_TITLE.of("en"),
                            LESSON_TITLE.of("tr"),
                        ):  # plain calls, whose errors are texts there
                            assert not isinstance(value, float), (sheet.title, row, col)
                        elif wanted:
                            missing += isinstance(wanted, ErrorValue)
                            assert value == wanted, (sheet.title, row, col)
        assert (missing > 0) == (path.name.startswith("four-bar"))


# --- the command ----------------------------------------------------------------------------------------------------


def test_the_command_writes_extra_files_and_knows_its_words(tmp_path):
    result = run("build", PUMP, "-o", tmp_path, "--functions", "basic, basic")
    assert result.exit_code == 0, result.output
    names = [Path(line).name for line in result.stdout.split()]
    assert names == ["adjustable-pump.xlsx", "adjustable-pump-basic.ods"]
    result = run("build", PUMP, "-o", tmp_path, "--functions", "vba")
    assert result.exit_code == 0, result.output
    written = [Path(line) for line in result.stdout.split()]
    assert [path.name for path in written] == [
        "adjustable-pump.xlsx",
        "adjustable-pump-vba.xlsx",
        "adjustable-pump-vba.bas",
    ]
    assert "End Function" in written[-1].read_text(encoding="ascii")
    result = run("build", PUMP, "-o", tmp_path / "no", "--functions", "fortran")
    assert result.exit_code == 2
    assert "--functions" in result.stderr
    assert not (tmp_path / "no").exists()
