"""The sweep in numpy (`Linkage.solve`, `show`, csv) says what the cells of the workbook say."""

import math
from pathlib import Path

import numpy as np
import pytest

from chosen import IN_CI, some
from mechsheet.compiled import Compiled
from mechsheet.compiled.motion import motion_of
from mechsheet.description import load, loads
from mechsheet.library.building import compile_workbook
from random_mechanisms import Grower

TEMPLATES = sorted((Path(__file__).parent.parent.parent / "templates").glob("*.toml"))


def shown_in_cells(workbook, plan, symbol):
    """What stands in the column that people read; NaN for anything but a number."""
    spot = plan.at.shown[symbol]
    sheet = workbook.sheet(spot.sheet)
    rows = range(plan.at.first, plan.at.last + 1)
    cells = {cell.row: cell.content for cell in sheet.cells if cell.col == spot.col}
    for fill in sheet.fills:
        if fill.col <= spot.col < fill.col + fill.cols:
            cells |= {row: fill.value(row, spot.col) for row in range(fill.row, fill.row + fill.rows)}
    return np.array([cells[row] if isinstance(cells.get(row), float) else math.nan for row in rows])


def assert_same(mechanism):
    workbook, plan = compile_workbook(mechanism)
    columns, units = motion_of(Compiled(mechanism))
    size = max([abs(value.value) for value in mechanism.dimensions if isinstance(value.value, float)], default=1.0)
    for symbol, column in columns.items():
        cells = shown_in_cells(workbook, plan, symbol)
        assert (np.isnan(column) == np.isnan(cells)).all(), symbol
        scale = 1.0 if units[symbol] in ("", "°", "rad") else size
        assert np.nanmax(np.abs(column - cells), initial=0.0) <= 1e-9 * max(scale, 1.0), symbol


@pytest.mark.parametrize("template", some(TEMPLATES, 2), ids=lambda path: path.stem)
def test_templates(template):
    assert_same(load(template))


@pytest.mark.parametrize("seed", range(12 if IN_CI else 3))
def test_random_mechanisms(seed):
    assert_same(loads(Grower(seed, 1 + seed % 3).text(), "random.toml"))
