"""Every number fits its column: what does not is shown as ###."""

import re
from itertools import product

import pytest

from livesheet.engine.texts.number_formats import formatted
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.sheet.table.positions import decimals_of_unit
from mechsheet.units import Unit


def too_wide(workbook):
    """(sheet, row, column, what would be shown) of every computed number that is wider than its column in characters."""
    found = []
    for sheet in workbook.sheets:
        wide = {col: each.width for each in sheet.columns for col in range(each.first, each.last + 1)}
        for fill in sheet.fills:
            form = fill.style.number_format
            for row, col in product(range(fill.rows), range(fill.cols)):
                value = fill.value(fill.row + row, fill.col + col)
                if isinstance(value, float) and form != "General":
                    shown = formatted(value, form)
                    if len(shown) > wide.get(fill.col + col, 8.43):
                        found.append((sheet.title, fill.row + row, fill.col + col, shown))
    return found


@pytest.mark.parametrize(
    ("name", "layout"),
    [
        pytest.param("sun-and-planet", "sheets", marks=pytest.mark.ci),
        pytest.param("six-link-dwell", "page", marks=pytest.mark.slow),
    ],
)
def test_no_number_is_wider_than_its_column(name, layout):
    """Determinants, areas, moments in N mm: numbers whose size the description decides, and none of its lengths."""
    text = re.sub(r"(?m)^layout *=.*$|^\[workbook\]$", "", template_text(name))
    mechanism = loads(f'{text}\n[workbook]\nlayout = "{layout}"\n', overrides=Overrides(rows="3"))
    assert too_wide(Compiled(mechanism).workbook) == []


def test_decimals_are_those_that_say_something():
    """Second coefficients of a slide [1/mm²] are far below 1e-4 in millimetres, its D [mm²] far above 1e4."""
    plan = Compiled(loads(template_text("four-bar"), overrides=Overrides(rows="3"))).plan
    assert plan.size == 126.6
    units = {"mm": "length", "mm²": "number", "1/mm": "number", "1/mm²": "number", "1": "number"}
    assert [decimals_of_unit(plan, Unit(kind, name)) for name, kind in units.items()] == [2, 0, 7, 7, 4]
    vars(plan)["pace"] = 100.0  # a fast driver: accelerations of 1e6 mm/s²
    assert [decimals_of_unit(plan, Unit("length", "mm", per=per)) for per in (1, 2)] == [0, 0]
    vars(plan)["pace"] = 0.01
    assert [decimals_of_unit(plan, Unit("length", "mm", per=per)) for per in (1, 2)] == [4, 6]
