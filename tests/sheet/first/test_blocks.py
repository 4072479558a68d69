"""What may be typed into an input: every length above 0, every number elsewhere; what is refused, and why. The order of
what stands on the first sheet.
"""

from pathlib import Path
from types import SimpleNamespace

import pytest

from livesheet.formula.scalar import evaluate
from livesheet.workbook import Area
from mechsheet.description import load
from mechsheet.library.building import compile_workbook
from mechsheet.sheet.cells import ROW_HEIGHT, label_lines
from mechsheet.sheet.first.blocks import COLUMN, MEANING_WIDTH
from mechsheet.sheet.plan import LEGEND_ROW, MEANING
from mechsheet.sheet.shown import input_validation

TEMPLATES = Path(__file__).parents[3] / "templates"

PLAN = SimpleNamespace(equations=SimpleNamespace(positive={"a1"}), text=lambda key, **parts: (key, *parts.values()))


def taken(rule, number):
    low, high = (limit and evaluate(limit, {}) for limit in (rule.low, rule.high))
    return {">": lambda: number > low, "between": lambda: low <= number <= high}[rule.operator]()


@pytest.mark.parametrize(("symbol", "yes", "no"), [("a1", (1e-3, 0.5, 1.0, 1e9), (0.0, -1.0)),
                                                   ("beta", (-1e9, -0.5, 0.0, 1e9), ())])  # fmt: skip
def test_what_may_be_typed(symbol, yes, no):
    rule = input_validation(PLAN, Area(1, 2, 3, 4), symbol)
    assert rule.area == Area(1, 2, 3, 4) and rule.kind == "decimal"
    assert all(taken(rule, number) for number in yes) and not any(taken(rule, number) for number in no)
    said = "hint.positive" if no else "hint.number"
    assert rule.input_title == rule.error_title == (f"{said}.title",)
    assert rule.input_message[0] == rule.error_message[0] == said


@pytest.mark.slow
def test_what_was_asked_for_stands_below_the_dimensions_and_what_went_wrong_stays_in_sight():
    """The numbers asked for are beside the drawing while a dimension is typed; the line that names the first cell that
    became amber or red does not scroll away, however far below one types."""
    workbook, plan = compile_workbook(load(TEMPLATES / "six-link-dwell.toml"))
    assert list(plan.blocks)[:3] == ["position", "dimensions", "summary"]
    first = workbook.sheets[0]
    assert first.freeze == (LEGEND_ROW + 1, 0)
    assert min(chart.anchor.row for chart in first.charts) >= first.freeze[0], "no chart is cut in two"


@pytest.mark.slow
def test_no_word_of_the_last_blocks_goes_on_over_its_column():
    """In print it stood alone on a page behind the charts."""
    workbook, plan = compile_workbook(load(TEMPLATES / "excavator.toml"))
    words = [cell for cell in workbook.sheets[0].cells if cell.row > plan.blocks["reasons"].row and cell.col == MEANING]
    long = [
        cell
        for cell in words
        if isinstance(cell.content, str) and label_lines(cell.content, COLUMN * MEANING_WIDTH) > 1
    ]
    heights = dict(workbook.sheets[0].row_heights)
    assert long and all(cell.style.wrap and heights[cell.row] > ROW_HEIGHT for cell in long)
