"""Would anybody notice? Each fault is built into a workbook that is otherwise right, its values fitting the fault."""

from dataclasses import replace

import pytest
from edited import laid_out

from chosen import part
from livesheet.evaluation import computed
from livesheet.formats import write
from livesheet.formula.nodes import Call, CellRef, Unary, transform, walk
from livesheet.workbook import Cell
from mechsheet.checking import check

pytestmark = pytest.mark.slow


@pytest.fixture(params=part(["four-bar", "slider-crank"], 2))
def built(request):
    return laid_out(request.param)


def with_formula(workbook, plan, symbol, change):
    """The workbook with the formula of a column damaged in every row."""
    spot = plan.at.spots[symbol]

    def damage(fill):
        if fill.col != spot.col or fill.rows == 1:
            return fill
        damaged = replace(fill, formula=transform(fill.formula, change))
        assert damaged != fill, f"nothing to damage in {symbol}"
        return damaged

    sheets = tuple(
        replace(sheet, fills=tuple(map(damage, sheet.fills))) if sheet.title == plan.table else sheet
        for sheet in workbook.sheets
    )
    return replace(workbook, sheets=sheets)


def judged(workbook, tmp_path):
    path = tmp_path / "damaged.xlsx"
    write(computed(workbook), path)
    return {item.judge: item for item in check(path).comparisons}


def intermediate(plan, function):
    """A column whose formula calls a function."""
    for equation in plan.equations.columns:
        called = {node.name for node in walk(equation.expression) if isinstance(node, Call)}
        if function in called and equation.role == "intermediate":
            return equation.symbol
    raise AssertionError(function)


def test_undamaged(built, tmp_path):
    workbook, _ = built
    assert all(item.agrees for item in judged(workbook, tmp_path).values())


def test_atan2_arguments_swapped(built, tmp_path):
    workbook, plan = built

    def swap(node):
        return Call("ATAN2", node.args[::-1]) if isinstance(node, Call) and node.name == "ATAN2" else node

    assert not judged(with_formula(workbook, plan, intermediate(plan, "ATAN2"), swap), tmp_path)["reference"].agrees


def test_mode_with_the_wrong_sign(built, tmp_path):
    workbook, plan = built
    symbol = next(eq.symbol for eq in plan.equations.columns if eq.role == "variable" and "mode_1" in eq.reads)
    mode = plan.at.reference("mode_1", plan.table, None)
    damaged = with_formula(workbook, plan, symbol, lambda node: Unary("-", node) if node == mode else node)
    assert not judged(damaged, tmp_path)["reference"].agrees


def test_reference_shifted_by_one_row(built, tmp_path):
    workbook, plan = built

    def down(node):
        return replace(node, row=node.row + 1) if isinstance(node, CellRef) and not node.row_abs else node

    assert not judged(with_formula(workbook, plan, "B.x", down), tmp_path)["reference"].agrees


def test_unit_factor_dropped(built, tmp_path):
    """The driver's column, which holds degrees, read as radians."""
    workbook, plan = built

    def drop(node):
        return node.args[0] if isinstance(node, Call) and node.name == "RADIANS" else node

    assert not judged(with_formula(workbook, plan, "A.x", drop), tmp_path)["reference"].agrees


def test_stored_value_zeroed(built, tmp_path):
    workbook, plan = built
    workbook = computed(workbook)
    spot = plan.at.spots["B.x"]

    def zero(fill):
        if fill.col != spot.col or fill.rows == 1:
            return fill
        values = list(fill.values)
        values[7] = 0.0
        return replace(fill, values=values)

    sheets = tuple(
        replace(sheet, fills=tuple(map(zero, sheet.fills))) if sheet.title == plan.table else sheet
        for sheet in workbook.sheets
    )
    path = tmp_path / "damaged.xlsx"
    write(replace(workbook, sheets=sheets), path)
    stored = next(item for item in check(path).comparisons if item.judge == "stored values")
    assert not stored.agrees
    assert stored.theirs == "0.0"
    assert stored.where.startswith(plan.table)


def test_a_flipped_mode_cell_is_another_assembly_not_a_fault(built, tmp_path):
    workbook, plan = built
    spot = plan.at.spots["mode_1"]

    def flip(cell):
        return replace(cell, content=-cell.content) if (cell.row, cell.col) == (spot.row, spot.col) else cell

    sheets = tuple(
        replace(sheet, cells=tuple(map(flip, sheet.cells))) if sheet.title == plan.main else sheet
        for sheet in workbook.sheets
    )
    assert any(isinstance(cell, Cell) for cell in sheets[0].cells)
    path = tmp_path / "flipped.xlsx"
    write(computed(replace(workbook, sheets=sheets)), path)
    report = check(path)
    assert report.agrees
    assert any("mode_1 is -1" in remark for remark in report.remarks)
