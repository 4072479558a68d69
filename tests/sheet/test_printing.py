"""How sheets are divided into pages, by widths and heights; `test_paper` measures what LibreOffice prints."""

from itertools import pairwise
from pathlib import Path

import pytest

from livesheet.formats.house_style import MARGIN_END, MARGIN_SIDE, MARGIN_TOP
from mechsheet.description import Overrides, load
from mechsheet.diagnostics import MechsheetError
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


LEAST, LETTERS = 6.5, 10
"""Points of a number on paper, at least, and on the screen."""
ACROSS, DOWN = ((long - margins) * 96 for long, margins in ((11.69, 2 * MARGIN_SIDE), (8.27, MARGIN_TOP + MARGIN_END)))
"""Pixels across A4, lying, and down it."""


def sizes(sheet):
    """Widths of its columns, heights of its rows [pixels]."""
    area = sheet.print_setup.area
    cells = [(cell.row, cell.col) for cell in sheet.cells]
    cells += [(fill.row + fill.rows - 1, fill.col + fill.cols - 1) for fill in sheet.fills]
    rows, cols = (area.last_row, area.last_col) if area else map(max, zip(*cells, strict=True))
    given = {col: one.width for one in sheet.columns for col in range(one.first, one.last + 1)}
    heights = dict(sheet.row_heights)
    return (
        [printing.column_pixels(given.get(col, 11)) for col in range(cols + 1)],
        [heights.get(row, printing.ROW) for row in range(rows + 1)],
    )


def printed_scale(sheet):
    """Of its size on the screen: given, or what fits."""
    setup, (widths, heights) = sheet.print_setup, sizes(sheet)
    fits = [(setup.fit_width, ACROSS, sum(widths)), (setup.fit_height, DOWN, sum(heights))]
    return setup.scale / 100 or min(1, *(pages * room / total for pages, room, total in fits if pages))


@pytest.mark.slow
@pytest.mark.cases(6)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("name", [path.stem for path in sorted(TEMPLATES.glob("*.toml"))])
def test_first_sheets_and_tables_can_be_read_on_paper(name, layout):
    """Numbers have 6.5 points at least; a table on several pages across has its first column and its headings on each, and
    no page is wider than paper, so that nothing else is cut."""
    try:
        workbook = compile_workbook(load(TEMPLATES / f"{name}.toml", Overrides(layout=layout)))[0]
    except MechsheetError:
        pytest.skip("not on one sheet")
    for sheet in (one for one in workbook.sheets if not one.hidden and one.fills):
        setup, (widths, _) = sheet.print_setup, sizes(sheet)
        assert LETTERS * printed_scale(sheet) >= LEAST - 0.05, sheet.title
        if (sheet.title != workbook.sheets[0].title and setup.scale) or (layout == "page" and setup.page_at):
            assert setup.repeat_rows and setup.repeat_cols, sheet.title
            again = sum(widths[setup.repeat_cols[0] : setup.repeat_cols[1] + 1])
            for first, end in pairwise([0, *setup.page_at, len(widths)]):
                wide = sum(widths[first:end]) + (again if first else 0)
                assert wide * setup.scale / 100 <= ACROSS, sheet.title
