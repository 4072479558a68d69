"""The workbook stays small: cells, columns, files, and formulas short enough to be read."""

import pytest
from budgets import (
    A_PASS,
    ALL,
    BESIDE,
    ELSEWHERE,
    FOUR_BAR,
    FOUR_BAR_COLUMNS,
    IN_TABLE,
    KILOBYTES,
    LARGE_BESIDE_FEW_ROWS,
    LOADED,
    LONGER,
    MORE_ROWS,
    MOVED,
    PLAIN,
    PLAIN_TOGETHER,
    ROOT,
    SHARE,
    SYNTHESIS,
    TEMPLATES,
    compiled,
    many_rows,
    size_of,
)

from chosen import some
from mechsheet.description import load
from mechsheet.kinematics.newton.system import FIRST_PASSES
from mechsheet.library.building import build
from mechsheet.sheet.table.positions import heading


@pytest.mark.parametrize(("layout", "references"), FOUR_BAR)
def test_four_bar(layout, references):
    """The template has anchors, the smallest form has names, and both have a budget."""
    size = size_of(compiled("four-bar", layout, references))
    assert size.cells <= FOUR_BAR[layout, references]
    assert size.columns <= FOUR_BAR_COLUMNS[layout]


@pytest.mark.ci  # builds them all; a single one's budget is held everywhere
def test_all_templates():
    assert sum(size_of(compiled(name)).cells for name in TEMPLATES) <= ALL
    assert len(PLAIN) == 29
    assert sum(size_of(compiled(name)).cells for name in PLAIN) <= PLAIN_TOGETHER


@pytest.mark.parametrize("name", TEMPLATES)
def test_cells_beside_the_table(name):
    size = size_of(compiled(name))
    # what follows from the unknowns of Newton's method stands in its passes
    passes = [group.system.passes for group in compiled(name).equations.groups if group.system]
    assert size.rates <= 1.6 * (size.table + size.iterations / (max(passes, default=0) + 1))
    assert size.forces <= 2.5 * size.table
    bands = compiled(name).plan.mechanism.bands
    assert size.tolerance <= size.table * (len(bands.quantities) if bands else 0)
    beside = LARGE_BESIDE_FEW_ROWS.get(name, BESIDE) + (SYNTHESIS if compiled(name).mechanism.synthesis else 0)
    most = SHARE * size.table + MOVED * size.rates + LOADED * size.forces + size.tolerance + beside
    assert size.cells - size.two_way <= most


def test_velocities_and_forces_of_a_four_bar_with_three_masses():
    """Nineteen columns for velocities with a point, thirty-five for forces: 1,350 formulas where there are 25 rows."""
    found = compiled("four-bar-forces")
    size, rows = size_of(found), found.plan.rows
    assert len(found.mechanism.dynamics.masses) == 3
    assert (size.rates, size.forces) == (19 * rows, 35 * rows)


@pytest.mark.parametrize("name", TEMPLATES)
def test_iterations(name):
    """Passes, unknowns and rows decide how large the sheet of Newton's method is; its start what leads to the group, too."""
    found = compiled(name)
    systems = [group.system for group in found.equations.groups if group.system]
    start = FIRST_PASSES + 1
    most = sum(A_PASS * len(each.unknowns) * ((each.passes + 1) * found.plan.rows + start) for each in systems)
    most += sum(start * (len(each.described) + len(each.way) + 2) for each in systems)
    assert size_of(found).iterations <= most


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_heading_stands_over_two_columns(name):
    plan = compiled(name).plan
    heads = [str(getattr(head, "plain", head)) for head in (heading(plan, column) for column in plan.columns)]
    assert len(set(heads)) == len(heads)


FORMS = [(name, "names") for name in TEMPLATES] + [(name, "anchors") for name in some(TEMPLATES, 2)]
"""Pages: see page/test_page.py."""


@pytest.mark.parametrize(("name", "references"), FORMS)
def test_formulas_are_short(name, references):
    size = size_of(compiled(name, "sheets", references))
    assert size.longest <= IN_TABLE["sheets", references]
    assert size.elsewhere <= max(LONGER.get(name, 0), ELSEWHERE[references])
    assert size.ifs <= 1


@pytest.mark.parametrize("layout", KILOBYTES)
def test_files_are_small(layout, tmp_path):
    (path,) = build(load(ROOT / "templates/four-bar.toml"), tmp_path / "four-bar.xlsx", layout=layout)
    assert path.stat().st_size <= 1000 * KILOBYTES[layout]


@pytest.mark.ci  # the longer one takes seconds
@pytest.mark.parametrize("rows", MORE_ROWS)
def test_files_of_many_rows_are_small(rows, tmp_path):
    found = build(many_rows(rows), tmp_path / "four-bar.xlsx")
    assert found[0].stat().st_size <= 1000 * MORE_ROWS[rows]
