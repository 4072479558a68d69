"""A mechanism as a chain of simpler ones, as the text's five-link: columns call functions with each other's output."""

from functools import cache

import pytest

from folders import TEMPLATES
from livesheet.evaluation import computed
from livesheet.formats import read, write
from livesheet.formula.names import folded
from livesheet.formula.nodes import shifted
from livesheet.formula.printer import print_formula
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, load
from mechsheet.exporting.functions.lesson import chain_of
from mechsheet.exporting.functions.sheets import DIFFERENCE_ROW, FIRST, LESSON_TITLE
from mechsheet.exporting.functions.workbooks import functions_workbook
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.library.building import build
from mechsheet.library.recalculation import recalc
from office_macros import Job, with_macros

pytestmark = pytest.mark.slow

WITHOUT = {
    "cam-flat", "cam-linkage", "cam-rocker", "cam-slide", "cam-valve", "cardan-gear", "double-butterfly",
    "excavator", "five-bar-robot", "geared-five-bar", "planar-3rpr", "rack-slider", "scissor-lift-between-arms",
    "stephenson-ii-class-iv", "stephenson-ii-motor", "stephenson-iii-output", "sun-and-planet",
}  # fmt: skip
"""Cams, gears, further drivers, a driver between moving links, groups that Newton's method solves."""
WITH = sorted(
    {path.stem for path in TEMPLATES.glob("*.toml") if "[synthesis]" not in path.read_text("utf-8")} - WITHOUT
)


@cache
def template(name, language="en"):
    return Compiled(load(TEMPLATES / f"{name}.toml", Overrides(language=language)))


def lesson_of(book, language):
    return book.sheet(LESSON_TITLE.of(language))


def formula_in(sheet, row, col):
    block = sheet.formula_at(row, col)
    return print_formula(shifted(block.formula, row - block.row, col - block.col))


@pytest.fixture(scope="module")
def fivelink(tmp_path_factory):
    path = tmp_path_factory.mktemp("lesson") / "fivelink-lambda.xlsx"
    write(computed(functions_workbook(template("fivelink", "tr"), "lambda")), path)
    return path


def test_the_five_link_is_the_texts(fivelink):
    """Six columns: the crank in degrees and radians, a call for each mechanism, both in degrees."""
    sheet = lesson_of(read(fivelink), "tr")
    formulas, last = ([formula_in(sheet, row, col) for col in range(6)] for row in (FIRST, FIRST + 18))
    assert list(map(folded, formulas)) == [folded(formula) for formula in (
        "başlangıç+(ROW()-ROW($A$6)-1)*adım",
        "RADIANS(A7)",
        "KolKızak(Krank,SabitUzuv,$B7-Alfa1)+Alfa1-PI()/2",
        "DörtÇubuk(Krank2,Biyel,ÇıkışUzvu,SabitUzuv4,mode_2,$C7+Alfa2p)-Alfa2p",
        "DEGREES(C7)",
        "DEGREES(D7)",
    )]  # fmt: skip
    assert [formula.replace("25", "7") for formula in last] == formulas
    assert [sheet.cached.get(FIRST, col) for col in (2, 3)] == pytest.approx([1.8347600504, 1.8689154494])


@pytest.mark.cases(1)
@pytest.mark.parametrize("settings", [{}, {"Krank": 400, "SabitU_D": -300}, {"SabitU_D4ç": -200, "mode_2": -1}])
def test_it_follows_dimensions_and_modes(fivelink, settings):
    """Alfa1 and SabitUzuv were found to be what the loop needs: they are so for other dimensions, too."""
    found = recalc(fivelink, settings).values
    assert all(found.get(LESSON_TITLE.of("tr"), DIFFERENCE_ROW, col) < 1e-10 for col in (4, 5))
    assert all(isinstance(value, float) for value in found.column(LESSON_TITLE.of("tr"), 3, FIRST, FIRST + 18))


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", WITH)
def test_every_chain_gives_the_angles_of_the_table(name):
    compiled = template(name)
    chain = chain_of(compiled)
    assert chain
    workbook = computed(functions_workbook(compiled, "lambda"))
    (sheet,) = (sheet for sheet in workbook.sheets if sheet.title == LESSON_TITLE.of("en"))
    worst = [fill.values[0] for fill in sheet.fills if fill.row == DIFFERENCE_ROW]
    assert len(worst) == len(chain)
    assert max(worst) < 1e-10 * max(1.0, largest_length(compiled.mechanism, dimension_values(compiled.mechanism)))
    longest = max((print_formula(fill.formula) for fill in sheet.fills if fill.col < 2 + 2 * len(chain)), key=len)
    assert len(longest) <= 250, longest


@pytest.mark.cases(13)
@pytest.mark.parametrize("name", sorted(WITHOUT))
def test_where_no_chain_of_functions_leads_there_is_no_such_sheet(name):
    assert chain_of(template(name)) == ()


@pytest.mark.ci
def test_libreoffice_computes_the_chain_by_its_basic(tmp_path):
    files = [build(template(name).mechanism, tmp_path, (), ("basic",))[-1] for name in ("fivelink", "slotted-lever")]
    for path, found in zip(files, with_macros([Job(document=path) for path in files]), strict=True):
        sheet = lesson_of(read(path), "en")
        for block in sheet.blocks:
            for row in range(block.row, block.row + block.rows):
                value = sheet.cached.get(row, block.col)
                assert found.get(sheet.title, row, block.col) == pytest.approx(value, rel=1e-9, abs=1e-9)
