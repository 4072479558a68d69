"""`check --perturb`: random inputs in the workbook's own cells."""

import random

import pytest
from edited import TEMPLATES, edited, laid_out, saved

import mechsheet
from chosen import ALL, part
from livesheet.engine import compile_book
from livesheet.evaluation import book_of, computed
from livesheet.formats import read, write
from livesheet.formula.nodes import Unary
from mechsheet.checking import check, perturb
from mechsheet.checking.against_reference import against_plan
from mechsheet.checking.perturbation import drawn
from mechsheet.checking.programs import PROGRAMS, stored_values
from mechsheet.diagnostics import MechsheetError, MissingProgramError

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    return saved(laid_out("four-bar")[0], tmp_path_factory.mktemp("perturb") / "four-bar.xlsx")


def test_the_reference_agrees_and_most_sets_assemble(four_bar):
    count = 12 if ALL else 4
    found = perturb(four_bar, count)
    assert found.agrees
    assert [item.worst.judge for item in found.judged] == ["reference"]
    assert found.whole + found.partly >= 0.75 * count
    assert found.whole + found.partly + found.nowhere == count
    assert 0 < found.judged[0].worst.worst < 1e-9


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", ["crank-rocker-swing", "rigid-body-guidance"])
def test_inputs_of_a_task_are_changed_and_the_reference_finds_the_same(tmp_path, name):
    path = saved(laid_out(name)[0], tmp_path / f"{name}.xlsx")
    found = perturb(path, 4 if ALL else 2)
    assert found.agrees
    task = laid_out(name)[1].mechanism.synthesis
    assert set(task.inputs) <= found.judged[0].setting.inputs.keys()


def test_the_seed_decides(tmp_path):
    yoke = saved(laid_out("scotch-yoke")[0], tmp_path / "scotch-yoke.xlsx")
    one, same, other = perturb(yoke, 3), perturb(yoke, 3), perturb(yoke, 3, seed=1)
    assert one == same
    assert one.judged[0].setting.inputs != other.judged[0].setting.inputs


def test_modes_are_flipped_and_dimensions_changed():
    settings = [drawn(laid_out("four-bar")[1], random.Random(seed)) for seed in range(5)]
    assert {setting["mode_1"] for setting in settings} == {1.0, -1.0}
    assert len({setting["a2"] for setting in settings}) == 5


def test_a_description_is_built_aside():
    assert perturb(TEMPLATES / "scotch-yoke.toml", 2).agrees


@pytest.mark.parametrize("suffix", part(["ods", "xlsx"], 2))
def test_a_program_that_believes_stored_values_is_found_out(four_bar, tmp_path, monkeypatch, suffix):
    """The copies for other programs keep the results of the unchanged file."""
    path = saved(laid_out("four-bar")[0], tmp_path / f"four-bar.{suffix}")
    monkeypatch.setitem(PROGRAMS, "believer", stored_values)
    found = perturb(path, 2, programs=["believer"])
    assert not found.agrees
    assert found.judged[0].differing == 0
    believer = found.judged[1]
    assert believer.differing == 2
    assert believer.worst.worst > 1e-3


def test_the_copies_hold_the_inputs(four_bar, monkeypatch):
    seen = []

    def look(path):
        book = read(path)
        seen.append(book.sheet("Mechanism").constants)
        return stored_values(path)

    monkeypatch.setitem(PROGRAMS, "looker", look)
    found = perturb(four_bar, 2, programs=["looker"])
    _, plan = laid_out("four-bar")
    spot = plan.at.spots["a2"]
    held = [constants.get(spot.row, spot.col) for constants in seen]
    assert found.judged[1].setting.inputs["a2"] in held
    assert len(set(held)) == 2


def test_another_evaluator(tmp_path):
    """On one sheet: the several have ranges that IronCalc does not know."""
    pytest.importorskip("ironcalc")
    (page,) = mechsheet.build(mechsheet.template("four-bar"), tmp_path / "page.xlsx", layout="page")
    found = perturb(page, 3, programs=["ironcalc"])
    assert found.agrees
    assert found.judged[1].cells > 3 * 300


@pytest.mark.ci
@pytest.mark.libreoffice
def test_libreoffice(four_bar):
    assert perturb(four_bar, 5, seed=2, programs=["libreoffice"]).agrees


def test_a_wrong_formula_is_seen_with_some_set(tmp_path):
    """For the dimensions of the file the wrong formula has the right value: 35 is a2."""
    workbook, plan = laid_out("four-bar")
    spot = plan.at.spots["A.x"]

    cells = {f"Positions_{chr(65 + spot.col)}{spot.row + 1}": "=35*COS(0)"}
    path = saved(edited(workbook, **cells), tmp_path / "wrong.xlsx")
    assert all(item.agrees for item in check(path).comparisons)
    assert not perturb(path, 2).agrees


def test_no_description_no_sets(tmp_path):
    workbook, _ = laid_out("scotch-yoke")
    from dataclasses import replace

    write(computed(replace(workbook, sheets=workbook.sheets[:-1])), tmp_path / "foreign.xlsx")
    with pytest.raises(MechsheetError, match="carries no description"):
        perturb(tmp_path / "foreign.xlsx", 1)


def test_an_unknown_program(four_bar):
    with pytest.raises(MissingProgramError, match="libreofice"):
        perturb(four_bar, 1, programs=["libreofice"])


def test_a_derived_dimension_that_does_not_exist(tmp_path):
    """Found by --perturb: c3 = 250 leaves no triangle ABC, and asking the reference ended in a traceback."""
    workbook, plan = laid_out("four-bar")
    path = saved(edited(workbook, **{f"Mechanism_B{plan.at.spots['c3'].row + 1}": 250.0}), tmp_path / "c3.xlsx")
    report = check(path)
    assert report.values_agree
    assert report.red_line == "look at the yellow cells: they do not fit"
    assert any("gamma3 has no value with these dimensions: the arc cosine" in remark for remark in report.remarks)
    reference = next(item for item in report.comparisons if item.judge == "reference")
    assert reference.cells == 2 * plan.rows  # C.x and C.y read it; nothing else is shown from it


def test_a_number_shown_from_a_dimension_that_does_not_exist_is_seen(tmp_path):
    workbook, plan = laid_out("four-bar")
    spot = plan.at.spots["C.x"]
    from edited import with_column

    wrong = with_column(
        workbook, "Positions", spot.col, lambda node: Unary("-", plan.at.reference("B.x", "Positions", 3))
    )
    cells = {f"Mechanism_B{plan.at.spots['c3'].row + 1}": 250.0}
    report = check(saved(edited(wrong, **cells), tmp_path / "c3.xlsx"))
    assert not next(item for item in report.comparisons if item.judge == "reference").agrees


def test_behind_a_gap_any_assembly_may_be_found_with_the_rates_that_it_has():
    """Typed lengths with which rows 13 to 26 cannot be joined: behind them sheet and reference stand in two assemblies."""
    layout, plan = laid_out("stephenson-ii-class-iv")
    book = book_of(layout)
    typed = {"r": 1.14997, "d": 6.40928, "b": 2.55182, "c": 2.69559, "gamma": 39.4888, "e": 3.72715, "g": 2.3147,
             "delta": 24.2808, "u": 3.12829, "v": 3.19686, "mode_1": 2.0}  # fmt: skip
    places = {symbol: plan.at.spots[symbol] for symbol in typed}
    changes = {(places[symbol].sheet, places[symbol].row, places[symbol].col): value for symbol, value in typed.items()}
    values = compile_book(book).evaluate(changes)
    assert against_plan(book, values, plan, "typed")[0].agrees
    spot = plan.at.spots["omega13"]
    for row, told in ((2, True), (34, False)):

        class Damaged:
            """A rate of one row is another."""

            def get(self, sheet, at, col, row=row):
                found = values.get(sheet, at, col)
                return found * 1.5 if (sheet, at, col) == (spot.sheet, plan.at.first + row, spot.col) else found

            def column(self, sheet, col, first, last):
                return [self.get(sheet, at, col) for at in range(first, last + 1)]

        assert against_plan(book, Damaged(), plan, "damaged")[0].agrees is not told
