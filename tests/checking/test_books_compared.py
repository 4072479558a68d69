"""`check scotch-yoke.xlsx scotch-yoke.ods`: are the two one workbook?"""

from __future__ import annotations

import json
import os
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import mechsheet
from chosen import ALL
from command_line import run
from folders import TEMPLATES
from livesheet.engine import evaluate
from livesheet.evaluation import computed
from livesheet.formats import read, write
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import Unary
from livesheet.formula.parser import parse_formula
from mechsheet.checking import check, with_twins
from mechsheet.checking.books_compared import compare_twins
from mechsheet.checking.cells_apart import EqualRows, difference
from mechsheet.checking.inputs import Inputs, OfTheLast
from mechsheet.description import load
from mechsheet.dynamics.solve import solve
from mechsheet.library.building import FORMATS
from mechsheet.sheet.layout import lay_out

OTHER = "adjustable-pump" if ALL else "elliptic-trammel"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Twins of two mechanisms: a scotch-yoke, and on `make full` a pump in Turkish with a two-way table."""
    made = tmp_path_factory.mktemp("twins")
    for name in ("scotch-yoke", OTHER):
        workbook = computed(laid_out(name))
        for suffix in FORMATS:
            write(workbook, made / f"{name}.{suffix}")
    return made


@cache
def laid_out(name):
    mechanism = load(TEMPLATES / f"{name}.toml")
    return lay_out(mechanism, solve(mechanism))[0]


def with_twin(*paths):
    return with_twins([check(path) for path in paths])


@pytest.mark.slow
def test_twins_agree(folder):
    for name in ("scotch-yoke", OTHER):
        first, second = with_twin(folder / f"{name}.xlsx", folder / f"{name}.ods")
        assert [item.judge for item in first.comparisons] == ["stored values", "reference", "search"]
        twin = second.comparisons[-1]
        assert (twin.judge, twin.agrees, twin.worst, twin.subject) == ("twin .xlsx", True, 0.0, "this file")
        # Constants and formulas, and the stored value of each formula.
        book = read(folder / f"{name}.ods")
        formulas = sum(block.rows * block.cols for sheet in book.sheets for block in sheet.blocks)
        constants = sum(1 for sheet in book.sheets for _ in sheet.constants.items())
        assert twin.cells == 1 + len(book.names) + 2 * formulas + constants


def test_what_twins_have_in_common_is_found_once_and_anew_for_other_inputs():
    """Search and reference read the inputs only: a number typed into one of the twins, and they are asked again."""
    plan, other, found = object(), object(), OfTheLast()
    inputs = Inputs({"a2": 50.0}, {"mode_1": 1}, {"theta12": np.array([0.0, 0.1, np.nan])})
    asked = []

    def count(of_plan, **changes):
        found.of(of_plan, replace(inputs, **changes), lambda: asked.append(1))
        return len(asked)

    assert [count(plan), count(plan), count(plan, remarks=("told",))] == [1, 1, 1]
    changes = (
        {"dimensions": {"a2": 50.5}},
        {"modes": {"mode_1": -1}},
        {"given": {"theta12": np.array([0.0, 0.2, np.nan])}},
    )
    assert [count(plan, **change) for change in changes] == [2, 3, 4]
    assert [count(plan), count(other)] == [5, 6]


@pytest.mark.slow
def test_files_that_are_no_twins_are_let_be(folder):
    reports = with_twin(folder / "scotch-yoke.xlsx", folder / f"{OTHER}.ods", TEMPLATES / "scotch-yoke.toml")
    assert all("twin" not in item.judge for report in reports for item in report.comparisons)


@pytest.mark.slow
def test_another_description(folder, tmp_path):
    for source, name in (("scotch-yoke.xlsx", "a.xlsx"), (f"{OTHER}.ods", "a.ods")):
        (tmp_path / name).write_bytes((folder / source).read_bytes())
    _, second = with_twin(tmp_path / "a.xlsx", tmp_path / "a.ods")
    assert second.agrees
    assert second.remarks == ("a.xlsx does not carry the same description: not compared",)


def damaged(workbook, **changes):
    """The workbook with another first sheet; all its values fit."""
    return computed(replace(workbook, sheets=(replace(workbook.sheets[0], **changes), *workbook.sheets[1:])))


@pytest.mark.slow
@pytest.mark.parametrize("what", ["constant", "formula", "value", "name", "sheet"])
def test_every_difference_is_seen(folder, tmp_path, what):
    workbook = laid_out("scotch-yoke")
    first = workbook.sheets[0]
    if what == "constant":
        cells = tuple(replace(cell, content=50.0001) if cell.content == 50.0 else cell for cell in first.cells)
        other = damaged(workbook, cells=cells)
        where = ""  # what is computed from it may differ more
    elif what == "formula":
        plus = replace(first.fills[0], formula=Unary("+", first.fills[0].formula))
        other = damaged(workbook, fills=(plus, *first.fills[1:]))
        where = "Mechanism!"
    elif what == "value":
        good = computed(workbook)
        table = good.sheets[1]
        fill = next(
            fill for fill in table.fills if fill.rows > 1 and isinstance(fill.values[-1], float) and fill.values[-1]
        )
        wrong = replace(fill, values=(*fill.values[:-1], fill.values[-1] + 1e-6))
        fills = tuple(wrong if each is fill else each for each in table.fills)
        other = replace(good, sheets=(good.sheets[0], replace(table, fills=fills), *good.sheets[2:]))
        where = "Positions!"
    elif what == "name":
        more = replace(workbook.names[0], name="one_more")
        other = computed(replace(workbook, names=(*workbook.names, more)))
        where = "name one_more"
    else:
        other = computed(replace(workbook, sheets=workbook.sheets[:-1]))
        where = "sheets"
    write(other, tmp_path / "b.ods")
    found = compare_twins(read(folder / "scotch-yoke.xlsx"), read(tmp_path / "b.ods"), "twin .ods")
    assert not found.agrees
    assert found.where.startswith(where)
    assert found.ours != found.theirs


def book_with(formulas, title="S"):
    builder = BookBuilder()
    sheet = builder.sheet(title)
    for (row, col, rows, cols), text in formulas.items():
        sheet.block(row, col, rows, cols, parse_formula(text))
    return builder.build()


def test_how_formulas_are_grouped_and_spelt_does_not_matter():
    one = book_with({(0, 1, 4, 1): "2*A1+Foo", (0, 2, 4, 1): "SUM(S!A1:A3)"})
    other = book_with(
        {(0, 1, 1, 1): "2*S!A1+foo", (1, 1, 3, 1): "2*s!A2+FOO", (0, 2, 2, 1): "sum(A1:A3)", (2, 2, 2, 1): "SUM(A3:A5)"}
    )
    found = compare_twins(one, other, "twin")
    assert found.agrees
    assert found.cells == 1 + 8
    changed = book_with({(0, 1, 3, 1): "2*A1+Foo", (3, 1, 1, 1): "2*A5+Foo", (0, 2, 3, 1): "SUM(A1:A3)"})
    found = compare_twins(one, changed, "twin")
    assert (found.agrees, found.where, found.ours, found.theirs) == (False, "S!B4", "=2*A4+foo", "=2*A5+foo")


@pytest.mark.slow
def test_on_the_command_line(folder):
    xlsx, ods = (os.fspath(folder / f"scotch-yoke.{suffix}") for suffix in FORMATS)
    shown = run("check", "-v", xlsx, ods)
    assert shown.exit_code == 0
    assert "twin .xlsx     agrees" in shown.output
    data = json.loads(run("check", ods, xlsx, "--json").output)
    assert [item["judge"] for item in data[1]["comparisons"]] == ["stored values", "reference", "search", "twin .ods"]


@pytest.mark.slow
def test_a_difference_on_the_command_line(folder, tmp_path):
    workbook = laid_out("scotch-yoke")
    cells = tuple(replace(cell, content=50.5) if cell.content == 50.0 else cell for cell in workbook.sheets[0].cells)
    for made, name in ((computed(workbook), "a.xlsx"), (damaged(workbook, cells=cells), "a.ods")):
        write(made, tmp_path / name)
    shown = run("check", os.fspath(tmp_path / "a.xlsx"), os.fspath(tmp_path / "a.ods"))
    assert shown.exit_code == 1
    assert "twin .xlsx     DIFFERS" in shown.output
    assert "this file" in shown.output


@pytest.mark.slow
@pytest.mark.parametrize("program", ["ironcalc", "formulas"])
def test_judges_that_read_xlsx_only(folder, program):
    ods = folder / "page.ods"
    mechsheet.build(mechsheet.template("scotch-yoke"), ods, layout="page")
    shown = run("check", os.fspath(ods), "--with", program)
    assert shown.exit_code == 2
    assert f"{program} reads .xlsx only" in shown.output
    assert "Traceback" not in shown.output


class TestCellsThatSayWhere:
    """INDEX(places; MATCH(extreme; column; 0)): of equal extremes each program may take another."""

    @pytest.fixture
    def book(self):
        builder = BookBuilder()
        sheet = builder.sheet("S")
        for row, (place, value) in enumerate([(0.0, 1.0), (15.0, 4.0), (30.0, 4.0 - 4e-16), (45.0, 3.9), (60.0, 4.0)]):
            sheet.constant(row, 0, place)
            sheet.constant(row, 1, value)
        sheet.block(0, 2, 1, 1, parse_formula("MAX(B1:B5)"))
        return builder.build()

    @pytest.mark.parametrize("sought", ["C1", "MAX(B1:B5)", "S!$C$1"])
    @pytest.mark.parametrize(
        ("theirs", "right"), [(15.0, True), (30.0, True), (60.0, True), (45.0, False), ("", False)]
    )
    def test_rows(self, book, sought, theirs, right):
        formula = parse_formula(f'IFERROR(INDEX(A1:A5,MATCH({sought},B1:B5,0)),"")')
        assert EqualRows(evaluate(book), 1.0).has(formula, "S", theirs) is right

    def test_other_formulas(self, book):
        for text in ("INDEX(A1:A5,2)", "MATCH(C1,B1:B5,0)", "A2"):
            assert not EqualRows(evaluate(book), 1.0).has(parse_formula(text), "S", 30.0)


def test_numbers_in_texts_are_numbers():
    assert difference("0.05 m", "0.049999999999999997 m") < 1e-15
    assert difference("12.5° … 40°", "12.5° … 40.001°") > 1e-6
    assert difference("B12", "C12") > 1
    assert difference("row 3", "row 4") > 1e-2
    assert difference("", None) == 0
    assert difference("0", "0.0") == 0
