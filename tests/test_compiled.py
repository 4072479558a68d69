"""The sweep in numpy (`Linkage.solve`, `show`, csv) says what the cells of the workbook say."""

import math

import numpy as np
import pytest

from chosen import ALL, some
from folders import TEMPLATE_FILES
from mechsheet.compiled import Compiled, motion_of
from mechsheet.description import load, loads
from random_mechanisms import Grower

pytestmark = pytest.mark.slow


def shown_in_cells(compiled, symbol):
    """What stands in the column, in rows with a position; NaN for anything but a number.

    In other rows the sheet goes on with what does not depend on the group that comes apart; here they are empty.
    """
    cells = [compiled.value(compiled.plan.at.spots[symbol], row) for row in range(compiled.plan.rows)]
    numbers = np.array([cell if isinstance(cell, float) else math.nan for cell in cells])
    is_driver = symbol == compiled.mechanism.driver.symbol
    return numbers if is_driver else np.where(compiled.exists, numbers, math.nan)


def assert_same(mechanism):
    compiled = Compiled(mechanism)
    columns, units = motion_of(compiled)
    size = max([abs(value.value) for value in mechanism.dimensions if isinstance(value.value, float)], default=1.0)
    for symbol, column in columns.items():
        cells = shown_in_cells(compiled, symbol)
        assert (np.isnan(column) == np.isnan(cells)).all(), symbol
        scale = 1.0 if units[symbol] in ("", "°", "rad") else size
        scale = np.nanmax(np.abs(column)) if symbol.endswith(".j") else scale  # by the third power of the speed
        assert np.nanmax(np.abs(column - cells), initial=0.0) <= 1e-9 * max(scale, 1.0), symbol


@pytest.mark.cases(1)
@pytest.mark.parametrize("template", some(TEMPLATE_FILES, 2), ids=lambda path: path.stem)
def test_templates(template):
    assert_same(load(template))


@pytest.mark.cases(2)
@pytest.mark.parametrize("seed", range(12 if ALL else 3))
def test_random_mechanisms(seed):
    assert_same(loads(Grower(seed, 1 + seed % 3).text(), "random.toml"))
