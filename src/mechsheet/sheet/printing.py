"""How sheets are printed: as large as can be read, on pages that are filled evenly. Letters of cells have 10 points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate, chain, pairwise

from livesheet.workbook import Area, Chart, PrintSetup, Sheet
from mechsheet.sheet import styles

ACROSS, DOWN = 1007, 679
"""Pixels across A4, lying, and down it to the footer, at full size."""

READABLE = 0.67
"""At least so large all is printed: letters of 10 points are 6.7 high."""

LARGEST = 0.9
"""Of a sheet that would fill a page at a larger size: what is read beside other sheets need not be larger than they are."""

SURE = 0.97
"""Of the paper so much is used where the scale is given: programs round the sizes of columns and rows, each its own way."""

ROW = 17
"""Pixels of a row of a table."""

ROWS_OF_ONE_PAGE = 49
"""So many rows of the first sheet, with its charts beside them, can be read on one page, lying."""

UPRIGHT_DOWN, WIDE = 1004, 0.78
"""Pixels down an upright page to the footer; as large two charts side by side are as wide as it."""

CHARTS_DOWN = math.floor(SURE * UPRIGHT_DOWN / WIDE) - 100
"""Down to there below the first row of charts they stand on one page."""


def column_pixels(width: float) -> float:
    """Of a column, from its width in characters, in LibreOffice, whose columns are the widest."""
    return 7.4 * width + 5


def table_setup(
    widths: Sequence[float], head: float, first: int, rows: int, repeated: tuple[int, int], footer: str
) -> PrintSetup:
    """Of a table with a heading on every page: pages across and down of about as many columns and rows each.

    widths    of its columns from the left [characters]
    head      height of the heading [pixels];  first: the row below it
    repeated  first and last of the columns that stand on every page
    """
    sizes = [column_pixels(width) for width in widths]
    scale = min(LARGEST, SURE * ACROSS / sum(sizes))
    page_at: tuple[int, ...] = ()
    if scale < READABLE:
        page_at, widest = _columns(sizes, repeated, SURE * ACROSS / READABLE)
        scale = min(LARGEST, SURE * ACROSS / widest)
    fitting = max(1, math.floor((SURE * DOWN / scale - head) / ROW))
    pages = math.ceil(rows / fitting)
    each = math.ceil(rows / pages)
    return PrintSetup(
        fit_width=0,
        scale=math.floor(100 * scale),
        page_at=page_at,
        row_at=tuple(range(first + each, first + rows, each)),
        repeat_rows=(0, first - 1),
        repeat_cols=repeated,
        footer=footer,
    )


def _columns(sizes: Sequence[float], repeated: tuple[int, int], wide: float) -> tuple[tuple[int, ...], float]:
    """The columns that begin a page, so that pages are about as wide, and how wide the widest is."""
    again, kept = sum(sizes[repeated[0] : repeated[1] + 1]), sum(sizes[: repeated[1] + 1])
    rest = sizes[repeated[1] + 1 :]
    pages = max(2, math.ceil(sum(rest) / max(wide - kept, wide / 4)))
    while True:
        begins, found = [repeated[1] + 1], [0.0]
        for col, size in enumerate(rest, repeated[1] + 1):
            if found[-1] and found[-1] + size / 2 > sum(rest) / pages:
                begins.append(col)
                found.append(0.0)
            found[-1] += size
        widest = max(kept + found[0], again + max(found))
        if widest <= wide or len(begins) == len(rest):
            return tuple(begins[1:]), widest
        pages += 1


def first_setup(sheet: Sheet, starts: Sequence[int], last_col: int) -> tuple[PrintSetup, bool]:
    """Of the first sheet, whose row heights are all given: lying where one page takes it, else upright, its blocks on pages
    down, its charts on pages of their own behind them. And whether all blocks are whole.

    starts  columns that begin a page of charts
    """
    heights = dict(sheet.row_heights)
    rows = max(heights) + 1
    edges = [0.0, *accumulate(heights[row] for row in range(rows))]
    if edges[-1] <= ROWS_OF_ONE_PAGE * heights[rows - 1] and len(starts) == 1:
        return sheet.print_setup, True
    down = SURE * UPRIGHT_DOWN
    fewest = math.ceil(edges[-1] * READABLE / down)
    # as large as whole blocks fill so many pages, else one page more
    found = (
        (scale, _between_blocks(sheet, edges, 100 * down / scale, pages))
        for pages in (fewest, fewest + 1)
        for scale in _scales(math.floor(100 * min(WIDE, pages * down / edges[-1])))
    )
    largest = next(found)
    tried = chain([largest], found)
    whole = next(((scale, begins) for scale, begins in tried if _fits(edges, begins, 100 * down / scale)), None)
    scale, row_at = whole or largest
    setup = replace(
        sheet.print_setup, landscape=False, fit_width=0, fit_height=0, scale=scale, page_at=tuple(starts), row_at=row_at,
        area=Area(0, 0, rows - 1, last_col),
    )  # fmt: skip
    return setup, whole is not None


def _scales(largest: int) -> range:
    """From the largest down to what can be read [per cent]."""
    return range(largest, math.floor(100 * READABLE) - 1, -1)


def _fits(edges: Sequence[float], begins: Sequence[int], page: float) -> bool:
    """Whether no part between two page breaks is higher than a page."""
    parts = pairwise([0.0, *(edges[row] for row in begins), edges[-1]])
    return all(end - begin <= page for begin, end in parts)


def _between_blocks(sheet: Sheet, edges: Sequence[float], page: float, pages: int) -> tuple[int, ...]:
    """Headings of blocks that begin one of so many pages: the first that leave no more behind them than other pages take; no
    chart is cut."""
    free = [row for row in headings_of(sheet) if not any(_crosses(chart, edges, edges[row]) for chart in sheet.charts)]
    begins: list[int] = []
    begun, left = 0.0, pages - 1
    while left > 0:
        fitting = [row for row in free if begun < edges[row] <= begun + page]
        enough = [row for row in fitting if edges[-1] - edges[row] <= left * page]
        if not fitting:
            break
        begins.append(min(enough, default=max(fitting)))
        begun, left = edges[begins[-1]], left - 1
    return tuple(begins)


def headings_of(sheet: Sheet) -> list[int]:
    """Rows of the headings of blocks."""
    return sorted({cell.row for cell in sheet.cells if cell.col == 0 and cell.style == styles.SECTION})


def _crosses(chart: Chart, edges: Sequence[float], edge: float) -> bool:
    """Whether a chart lies above and below an edge."""
    top = edges[chart.anchor.row] + chart.anchor.dy
    return top < edge < top + chart.anchor.height
