"""How the first sheet is divided into pages; `test_paper` measures what LibreOffice prints."""

from itertools import pairwise
from pathlib import Path

import pytest

from mechsheet.description import load
from mechsheet.library.building import compile_workbook
from mechsheet.sheet import printing

TEMPLATES = Path(__file__).parents[2] / "templates"


@pytest.mark.slow
@pytest.mark.cases(6)
@pytest.mark.parametrize("name", [path.stem for path in sorted(TEMPLATES.glob("*.toml"))])
def test_no_page_of_the_first_sheet_goes_on_upon_another(name):
    """The end of a block stood alone on a page where blocks were larger than an even part of the sheet, and where a chart
    stood beside every heading at which a page could begin."""
    first = compile_workbook(load(TEMPLATES / f"{name}.toml"))[0].sheets[0]
    if first.print_setup.fit_width:  # all on one page
        return
    heights, setup = dict(first.row_heights), first.print_setup
    breaks = [0, *setup.row_at, max(heights) + 1]
    parts = [sum(heights[row] for row in range(*part)) for part in pairwise(breaks)]
    assert max(parts) * setup.scale / 100 <= printing.UPRIGHT_DOWN
    assert setup.scale >= 100 * printing.READABLE - 1
