"""Workbooks that strict readers open: their rules, held against the raw XML of what is written."""

import itertools
import math
import os
import re
import zipfile
from dataclasses import replace

import openpyxl
import pytest
from strict_xlsx import faults

from chosen import ALL, part
from folders import TEMPLATE_FILES
from livesheet.evaluation import computed
from livesheet.formats import write
from livesheet.formula.nodes import Binary, Call, CellRef, ErrorValue, Number, Unary
from livesheet.workbook import Area, Cell, Comment, Conditional, Fill, Name, Sheet, Style, Workbook, with_values
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.dynamics.solve import solve
from mechsheet.exporting.functions.workbooks import functions_workbook
from mechsheet.sheet.as_typed import typed, with_typed_constants
from mechsheet.sheet.layout import lay_out
from random_mechanisms import Grower

pytestmark = pytest.mark.slow

RANDOM = int(os.environ.get("MECHSHEET_RANDOM", "12"))
"""How many random mechanisms a full run draws; 300 of them passed when the rules were written."""


def built(workbook, path, values=False):
    """The workbook as `build` writes it, with its values or (much sooner) with zeros for them."""
    write(computed(workbook) if values else with_values(workbook, zeros(workbook)), path)
    return path


def zeros(workbook):
    return ((0.0,) * (fill.rows * fill.cols) for sheet in workbook.sheets for fill in sheet.fills)


def laid_out(mechanism):
    return lay_out(mechanism, solve(mechanism))[0]


def template(name):
    return next(path for path in TEMPLATE_FILES if path.stem == name)


def in_language(path, language):
    text = path.read_text(encoding="utf-8")
    return loads(re.sub(r"^language = .*$", f'language = "{language}"', text, flags=re.MULTILINE))


@pytest.mark.cases(2)
@pytest.mark.parametrize("path", part(TEMPLATE_FILES, 10), ids=lambda path: path.stem)
def test_templates(path, tmp_path):
    for language in ("en", "tr") if ALL else ("tr",):
        assert faults(built(laid_out(in_language(path, language)), tmp_path / f"{language}.xlsx")) == []


def test_random_mechanisms(tmp_path):
    for seed in range(RANDOM if ALL else 2):
        mechanism = loads(Grower(11_000 + seed, 1 + seed % 4).text(9, 15.0, ("en", "tr")[seed % 2]))
        assert faults(built(laid_out(mechanism), tmp_path / "a.xlsx")) == [], seed


@pytest.mark.parametrize("name", ["slider-crank", "adjustable-pump"])
def test_function_workbooks(name, tmp_path):
    workbook = functions_workbook(Compiled(load(template(name))), "lambda")
    assert faults(built(workbook, tmp_path / "a.xlsx")) == []


@pytest.mark.ci
def test_the_validator_finds_nothing(tmp_path):
    from openxml_audit import OpenXmlValidator

    mechanism = load(template("slider-crank"))
    for workbook in (laid_out(mechanism), functions_workbook(Compiled(mechanism), "lambda")):
        path = built(workbook, tmp_path / "a.xlsx")
        errors = OpenXmlValidator().validate(path).errors
        assert [error for error in errors if "dispNaAsBlank" not in str(error.path)] == []
        openpyxl.load_workbook(path)


# --- each rule can fail -------------------------------------------------------------------------------------------


def damaged(source, path, part, old, new):
    with zipfile.ZipFile(source) as archive, zipfile.ZipFile(path, "w") as other:
        for name in archive.namelist():
            data = archive.read(name).decode()
            if name == part:
                assert re.search(old, data), part
                data = re.sub(old, new, data, count=1)
            other.writestr(name, data)


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    path = tmp_path_factory.mktemp("strict") / "a.xlsx"
    return built(laid_out(load(template("four-bar"))), path, values=True)


SHEET = "xl/worksheets/sheet2.xml"
DAMAGE = {
    "anchor": ("xl/drawings/vmlDrawing1.vml", r", (\d+)</x:Anchor>", r", \1.0</x:Anchor>"),
    "shared": (SHEET, r'(<f t="shared" ref[^>]*>)', r"\1Mechanism!$B$2+"),
    "holds -0": (SHEET, r"<v>0</v>", "<v>-0</v>"),
    "15 digits": (SHEET, r'(<f t="shared" ref[^>]*>)', r"\g<1>0.30000000000000004+"),
    "-0 in": (SHEET, r'(<f t="shared" ref[^>]*>)', r"\g<1>-0+"),
    "characters": (SHEET, r'(<f t="shared" ref[^>]*>)', r"\1" + "SQRT(2)+" * 800),
    "another sheet": (SHEET, r"<formula>", "<formula>Mechanism!$B$2+"),
    "round corners": ("xl/charts/chart1.xml", r'<c:roundedCorners val="0"/>', ""),
    "name ": ("xl/workbook.xml", r'definedName name="[^_][^"]*"', 'definedName name="L"'),
    "theme's font": ("xl/styles.xml", r"(<name val=\"Arial\"/><family val=\"2\"/>)", r'\1<scheme val="minor"/>'),
}


@pytest.mark.parametrize("fault", DAMAGE)
def test_the_rules_can_fail(fault, plain, tmp_path):
    assert faults(plain) == []
    damaged(plain, tmp_path / "b.xlsx", *DAMAGE[fault])
    assert any(fault in found for found in faults(tmp_path / "b.xlsx")), faults(tmp_path / "b.xlsx")


# --- the causes ---------------------------------------------------------------------------------------------------


def anchors(path):
    with zipfile.ZipFile(path) as archive:
        data = b"".join(archive.read(name) for name in archive.namelist() if name.endswith(".vml"))
    return [[int(n) for n in a.split(",")] for a in re.findall(r"<x:Anchor>(.*?)</x:Anchor>", data.decode())]


def test_notes_stand_whole_beside_rows_of_any_height(tmp_path):
    heights = tuple((row, 17.3 + 0.7 * row) for row in range(9))
    comments = tuple(Comment(row, row, "a note\nof two lines") for row in range(8))
    cells = tuple(Cell(row, row, 1.0) for row in range(9))
    write(Workbook((Sheet("S", cells, row_heights=heights, comments=comments),)), tmp_path / "a.xlsx")
    assert faults(tmp_path / "a.xlsx") == []
    found = anchors(tmp_path / "a.xlsx")
    sizes = dict(heights)
    for col, dx, row, dy, end_col, end_dx, end_row, end_dy in found:
        top, bottom = (sum(sizes.get(r, 17) for r in range(n)) + d for n, d in ((row, dy), (end_row, end_dy)))
        assert bottom - top == pytest.approx(45, abs=1.01)  # two lines and a half, as asked for
        assert (end_col - col) * 64 + end_dx - dx == pytest.approx(220, abs=1.01)


def test_minus_zero_is_written_as_zero(tmp_path):
    fill = Fill(0, 1, Unary("-", Number(0.0)), rows=3, values=(-0.0, 1.0, ErrorValue("#N/A")))
    for suffix in ("xlsx", "ods"):
        path = tmp_path / f"a.{suffix}"
        numbers = replace(fill, row=5, values=(-0.0, 1.0, -0.0))
        write(Workbook((Sheet("S", (Cell(0, 0, -0.0),), (fill, numbers)),)), path)
        with zipfile.ZipFile(path) as archive:
            data = archive.read("xl/worksheets/sheet1.xml" if suffix == "xlsx" else "content.xml").decode()
        assert not re.search(r'(<v>|office:value=")-0', data)


@pytest.mark.parametrize(
    ("value", "kept"), [(0.1 + 0.2, 0.3), (-0.0, 0.0), (1e-300, 1e-300), (2 / 3, 0.666666666666667)]
)
def test_constants_as_typed(value, kept):
    assert (typed(value), math.copysign(1, typed(value))) == (kept, 1.0)
    rule = Conditional(Area(0, 0, 0, 0), Binary("<", CellRef(0, 0), Number(value)), Style())
    sheet = Sheet(
        "S", (Cell(0, 0, value), Cell(1, 0, True)), (Fill(2, 0, Call("ABS", (Number(value),))),), conditionals=(rule,)
    )
    (sheet,) = with_typed_constants(Workbook((sheet,), (Name("x_1", "S", 0, 0),))).sheets
    found = (sheet.cells[0].content, sheet.fills[0].formula.args[0].value, sheet.conditionals[0].condition.right.value)
    assert [repr(number) for number in found] == [repr(kept)] * 3
    assert sheet.cells[1].content is True


def test_an_input_of_17_digits_is_computed_as_it_is_stored(tmp_path):
    text = template("four-bar").read_text(encoding="utf-8")
    mechanism = loads(re.sub(r"^a1 = .*$", "a1 = 70.00000000000001234", text, flags=re.MULTILINE))
    workbook = laid_out(mechanism)
    assert 70.0 in [cell.content for cell in workbook.sheets[0].cells]
    assert faults(built(workbook, tmp_path / "a.xlsx")) == []


def test_warnings_are_off_where_they_would_be_false(plain):
    with zipfile.ZipFile(plain) as archive:
        data = archive.read(SHEET).decode()
    ignored = dict(re.findall(r'<ignoredError sqref="([^"]*)"([^/]*)/>', data))
    kinds = [(set(ranges.split()), kind) for ranges, kind in ignored.items()]
    assert any("evalError" in kind for _, kind in kinds)
    # Somebody who changes a formula in the middle of a column is still warned.
    inside = [ranges for ranges, kind in kinds if "formula" not in kind]
    assert any(re.match(r"A5:", one) for one in itertools.chain(*inside))
