"""A link of many points, a traced outline for example: the workbook grows with their number, and holds what Excel takes."""

import pytest

from livesheet.formula.nodes import Call, walk
from livesheet.formula.printer import longest_spelling
from mechsheet.compiled import Compiled
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.library.changed import loads

MOST_ARGUMENTS, MOST_CHARACTERS = 255, 8192
"""Of a function, and of a formula, in Excel."""


def formulas(points):
    outline = ", ".join(f"P{number} = [{number % 50}, {number // 50}]" for number in range(points))
    text = template_text("four-bar").replace("C = {", f"{outline}, C = {{")
    return [fill.formula for sheet in Compiled(loads(text)).layout.sheets for fill in sheet.fills]


@pytest.mark.ci
def test_an_outline_of_hundreds_of_points():
    few, many = formulas(65), formulas(130)  # two places each: more than a function takes
    assert len(many) < 2.1 * len(few)
    assert max(len(part.args) for node in many for part in walk(node) if isinstance(part, Call)) <= MOST_ARGUMENTS
    assert max(map(longest_spelling, many)) <= MOST_CHARACTERS


def test_thousands_of_points_are_refused_at_once_and_in_a_line():
    with pytest.raises(DescriptionError, match=r"expected at most 1000 points, found 1203\n"):
        formulas(1200)
