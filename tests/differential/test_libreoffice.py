"""Engine, reference and LibreOffice on the same files: random linkages, also with other dimensions typed into the cells."""

import os
from dataclasses import replace

import numpy as np
import pytest

from chosen import ALL
from livesheet.engine import evaluate
from livesheet.evaluation import computed
from livesheet.formats import read, write
from mechsheet.checking import check
from mechsheet.checking.cells import compare_program
from mechsheet.checking.programs import convert_with_libreoffice, stored_values
from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.layout import lay_out
from random_mechanisms import KINDS, Grower

SAMPLE = int(os.environ.get("MECHSHEET_SAMPLE", "20" if ALL else "2"))
"""How many of each; a file takes LibreOffice and us some three seconds."""

pytestmark = pytest.mark.libreoffice


def written(seed, kinds, dyads, folder):
    """A random mechanism's workbook; in every second one some dimensions are changed and modes flipped in the cells."""
    mechanism = loads(Grower(seed, dyads, kinds).text(5))
    workbook, plan = lay_out(mechanism, solve(mechanism))
    if seed % 2:
        random = np.random.default_rng(seed)
        inputs = {plan.at.spots[dim.symbol].row for dim in mechanism.dimensions if random.random() < 0.3}
        modes = {
            plan.at.spots[group.mode].row for group in plan.equations.groups if group.mode and random.random() < 0.5
        }
        main = workbook.sheets[0]

        def changed(cell):
            if cell.col != 1 or not isinstance(cell.content, float):
                return cell
            if cell.row in modes:
                return replace(cell, content=-cell.content)
            return replace(cell, content=cell.content * random.uniform(0.98, 1.02)) if cell.row in inputs else cell

        cells = tuple(map(changed, main.cells))
        assert cells != main.cells or not inputs | modes
        workbook = replace(workbook, sheets=(replace(main, cells=cells), *workbook.sheets[1:]))
    path = folder / f"random-{seed}.xlsx"
    write(computed(workbook), path)
    return path, plan


def agree(cases, tmp_path, say):
    paths = [path for path, _ in cases]
    folder = tmp_path / "libreoffice"
    folder.mkdir()
    worst = {"reference": 0.0, "libreoffice": 0.0}
    for (path, plan), answer in zip(cases, convert_with_libreoffice(paths, "xlsx", folder), strict=True):
        report = check(path)
        assert report.agrees, report
        book = read(path)
        theirs = compare_program("libreoffice", book, evaluate(book), stored_values(answer).get, plan, path.name)
        assert theirs.agrees, (path.name, theirs)
        worst["libreoffice"] = max(worst["libreoffice"], theirs.worst)
        worst["reference"] = max(worst["reference"], *(item.worst for item in report.comparisons))
    say(f"{len(cases)} files, worst: {worst}")


@pytest.mark.ci
def test_four_bars_and_slider_cranks(tmp_path, record_property):
    cases = [written(seed, ("RRR", "RRP"), 1 + seed % 3, tmp_path) for seed in range(1000, 1000 + SAMPLE)]
    agree(cases, tmp_path, lambda text: record_property("worst", text))


@pytest.mark.ci
def test_all_five_dyads(tmp_path, record_property):
    cases = [written(seed, KINDS, 1 + seed % 6, tmp_path) for seed in range(1200, 1200 + SAMPLE)]
    agree(cases, tmp_path, lambda text: record_property("worst", text))


FOLDED = (
    'format = 1\n[mechanism]\nname = "folded"\n[dimensions]\na1 = 80\na2 = 35\n'
    '[links.ground]\npoints = { A0 = [0, 0], B0 = ["a1", 0] }\n[links.crank]\npoints = { A0 = [0, 0], A = ["a2", 0] }\n'
    '[links.coupler]\npoints = { A = [0, 0], B = ["a1", 0] }\nmass = 2\ncenter = "B"\n'
    '[links.rocker]\npoints = { B0 = [0, 0], B = ["a2", 0] }\n'
    '[driver]\nlink = "crank"\nstart = 150\nstop = 180\nstep = 10\nspeed = 4\n[assembly]\nB = [50, 20]\n'
)
"""A parallelogram that folds in its last row: no velocities and forces there, numbers beside it."""


@pytest.mark.cases(1)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("program", ["libreoffice", pytest.param("gnumeric", marks=pytest.mark.gnumeric), "ironcalc"])
def test_velocities_and_forces_beside_a_dead_centre(program, layout, tmp_path):
    """Every program has #N/A and numbers where the engine has them. IronCalc reads a page only (`docs/proof.md`)."""
    if program == "ironcalc":
        pytest.importorskip("ironcalc")
        if layout == "sheets":
            pytest.skip("IronCalc knows no range INDEX(...):INDEX(...)")
    path = tmp_path / "folded.toml"
    path.write_text(FOLDED + f'[workbook]\nlayout = "{layout}"\n', encoding="utf-8")
    report = check(path, program)
    assert [comparison.judge for comparison in report.comparisons][-1] == program
    assert report.agrees, report


ENDS = (
    'format = 1\n[mechanism]\nname = "ends"\n[dimensions]\na1 = 80\na2 = 60\na3 = 50\na4 = 45\n'
    '[links.ground]\npoints = { A0 = [0, 0], B0 = ["a1", 0] }\n[links.crank]\npoints = { A0 = [0, 0], A = ["a2", 0] }\n'
    '[links.coupler]\npoints = { A = [0, 0], B = ["a3", 0] }\n[links.rocker]\npoints = { B0 = [0, 0], B = ["a4", 0] }\n'
    '[driver]\nlink = "crank"\nstart = 120\nstop = -120\nstep = -30\n[assembly]\nB = [60, 40]\n'
    '[summary]\nbegun = { of = "theta14", take = "first" }\nended = { of = "theta14", take = "last" }\n'
)
"""It closes in no row at either end."""

TABLES = "".join(
    f'[[tables]]\nrows = {{ a2 = [60] }}\ncolumns = {{ a1 = [80] }}\nvalue = "{value}"\n'
    for value in ("begun", "ended")
)


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("program", "more"),
    [
        pytest.param("gnumeric", TABLES, marks=pytest.mark.gnumeric, id="gnumeric, tables"),
        pytest.param("libreoffice", '[workbook]\nlayout = "page"\n', id="libreoffice, page"),
    ],
)
def test_the_first_and_the_last_number_between_rows_that_do_not_close(program, more, tmp_path):
    """gnumeric knows no ISNUMBER of many cells in a product, LibreOffice no LOOKUP among errors as they are."""
    path = tmp_path / "ends.toml"
    path.write_text(ENDS + more, encoding="utf-8")
    report = check(path, program)
    assert report.agrees, report
    assert report.comparisons[-1].judge == program


@pytest.mark.ci
def test_a_motion_law_with_arrows_and_a_hodograph(tmp_path):
    """LibreOffice computes time, driver, velocities, the arrows of the drawing and the hodograph as the engine does."""
    text = (
        'format = 1\n[mechanism]\nname = "law"\n[dimensions]\na1 = 80\na2 = 35\na3 = 70\na4 = 60\n'
        '[links.ground]\npoints = { A0 = [0, 0], B0 = ["a1", 0] }\n[links.crank]\npoints = { A0 = [0, 0], A = ["a2", 0] }\n'
        '[links.coupler]\npoints = { A = [0, 0], B = ["a3", 0], C = [35, 20] }\nmass = 2\ncenter = "C"\n'
        '[links.rocker]\npoints = { B0 = [0, 0], B = ["a4", 0] }\n[driver]\nlink = "crank"\nstart = 30\nstop = 150\n'
        'motion = { law = "polynomial", duration = 0.7, rows = 9 }\n[[charts]]\nhodographs = ["C"]\n'
        "[assembly]\nB = [80, 60]\n"
    )
    path = tmp_path / "law.toml"
    path.write_text(text, encoding="utf-8")
    report = check(path, "libreoffice")
    assert [each.judge for each in report.comparisons] == ["stored values", "reference", "search", "libreoffice"]
    assert report.agrees, report
    assert report.comparisons[-1].worst < 1e-12
