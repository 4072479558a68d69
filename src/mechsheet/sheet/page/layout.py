"""A mechanism as one sheet, which can be copied into another workbook and leaves no link behind."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from livesheet.workbook import (
    Anchor,
    Area,
    Chart,
    Column,
    Control,
    PrintSetup,
    SeriesRef,
    Sheet,
    Workbook,
)
from mechsheet.kinematics.equations import Equations
from mechsheet.model import ChartRequest, Mechanism
from mechsheet.sheet.as_typed import with_typed_constants
from mechsheet.sheet.asked.requested import table_sheets
from mechsheet.sheet.cells import height_of, label_lines
from mechsheet.sheet.drawing.charts import chart_requests, curve_chart, driver_axis
from mechsheet.sheet.first.mechanism import position_controls
from mechsheet.sheet.layout import description_sheet, properties_of
from mechsheet.sheet.page.drawing import PageDrawing
from mechsheet.sheet.page.paper import CHART_HEIGHT, CHART_WIDTH, GAP, NARROW, Box, cut_down, on_paper, pixels
from mechsheet.sheet.page.plan import FIRST_ROW, ROW_HEIGHT, PagePlan, plan_page
from mechsheet.sheet.page.reading import MEANING
from mechsheet.sheet.page.table import Table, note_last
from mechsheet.sheet.page.top import LAST, Top
from mechsheet.sheet.plan import UNIT, VALUE, VERDICT_ROW

TOP_WIDTHS, WIDER = (11.0, 11.0, 9.0, 12.0, 12.0, 12.0), 1.0
"""Least widths of the columns over which the top stands, in characters; and by how much those are wider that say what a line
is, where the line under the title would take more than two lines."""

ABOVE_NOTE, NOTE_LINE, BELOW_NOTE, NOTE_CHARACTERS = 8.0, 15.0, 6.0, 1.1
"""Heights of the empty row above the note, of a line of it, and of what it leaves free [pixels]; characters of it in a
character's width."""

CHARTS_ROW, CHARTS_BELOW = 2, 4
"""The row where the drawing and the first charts begin, and so many pixels below its upper end."""

AXIS_STEPS = 8
"""So many steps at most of the driver's axis: a page's charts are narrow."""

BELOW_DRAWING = 4
"""Pixels from the drawing, whose scale is in its lower corner, to the scroll bar."""

BOLD, FEW_LINES, LINE_HEIGHT = 1.08, 2, 20
"""Of the line under the title: its letters are bold, so much wider than others; so many lines have room; pixels of one."""

TITLE_HEIGHT, HEAD_HEIGHT = 28.0, 24.0


def lay_out_page(mechanism: Mechanism, equations: Equations) -> tuple[Workbook, PagePlan]:
    """The workbook of one visible sheet (its formulas have no values yet) and the plan that it follows."""
    plan = plan_page(mechanism, equations)
    page, plan = _page(plan)
    sheets = (page, *table_sheets(plan), description_sheet(plan))
    return with_typed_constants(Workbook(sheets, tuple(plan.names), properties_of(plan))), plan


def _page(plan: PagePlan) -> tuple[Sheet, PagePlan]:
    """The sheet, and the plan with all that its layout decides."""
    table = Table(plan)
    widths, top = _with_top(plan, table, TOP_WIDTHS)
    if _lines(top, widths) > FEW_LINES:
        widths, top = _with_top(plan, table, [width + WIDER * (col >= MEANING) for col, width in enumerate(TOP_WIDTHS)])
    requests = [request for request in chart_requests(plan) if request.y and _has_columns(plan, request)]
    own = [request for request in chart_requests(plan) if (request.hodographs or request.profile) and plan.drawn]
    note_lines = math.ceil(len(_note(table)) / (NOTE_CHARACTERS * sum(widths[: note_last(plan) + 1])))
    heights = {row: float(ROW_HEIGHT) for row in range(2, plan.at.first)}
    line = height_of(max(FEW_LINES, _lines(top, widths)), LINE_HEIGHT)
    heights |= top.heights | {
        0: TITLE_HEIGHT, VERDICT_ROW: line, plan.note_row - 1: ABOVE_NOTE,
        plan.note_row: NOTE_LINE * note_lines + BELOW_NOTE, plan.symbol_row: HEAD_HEIGHT,
        plan.symbol_row + 1: table.formula_height,
    }  # fmt: skip
    down = cut_down(heights, plan.note_row, plan.at.first, plan.rows, ROW_HEIGHT)
    above = math.ceil(sum(heights[row] for row in range(CHARTS_ROW))) + CHARTS_BELOW
    paper = on_paper(widths, down, above, _left(widths), len(own) + plan.drawn, len(requests))
    right = max(len(widths), _columns_to(widths, max((box.right for box in paper.charts), default=0)))
    # Until here the top was only measured: formulas that it holds read the column right of the charts, and where these end
    # follows from the heights of its rows.
    plan = replace(plan, marks=right)
    top = Top(plan, top.room)
    drawing = PageDrawing(plan, right + 1, _charted(requests)) if plan.drawn else None
    framed = [drawing.square(request) for request in own] if drawing else []
    charts = _placed(plan, widths, heights, requests, drawing, framed, paper.charts)
    columns = [Column(col, col, width) for col, width in enumerate(widths)]
    # a column that begins a sheet of paper stands by itself
    starts = [len(widths), *(col for col in paper.begins if col > len(widths)), right + 1]
    columns += [Column(col, end - 1, NARROW) for col, end in pairwise(starts) if col < end]
    last = max(plan.status_column, right - 1)
    sheet = Sheet(
        plan.main,
        (*top.cells, *table.cells, *(drawing.cells if drawing else ())),
        (*top.fills, *table.fills, *(drawing.fills if drawing else ())),
        columns=(*columns, *(drawing.columns if drawing else ())),
        row_heights=tuple(sorted(heights.items())),
        merges=(*top.merges, *table.merges),
        charts=charts,
        controls=_controls(plan, heights),
        validations=tuple(top.validations),
        conditionals=(*top.conditionals, *table.colours()),
        comments=(*top.comments, *table.comments),
        selected=(FIRST_ROW, VALUE),
        gridlines=False,
        tab_color="1F4E79",
        print_setup=PrintSetup(
            footer=plan.footer,
            repeat_rows=(plan.symbol_row, plan.symbol_row),
            repeat_cols=(0, 0) if paper.begins else None,
            area=Area(0, 0, plan.at.last, last),
            fit_width=0 if paper.scale else 1,
            fit_height=0 if paper.scale else 1,
            scale=paper.scale,
            page_at=paper.begins,
            row_at=paper.rows,
        ),
    )
    return sheet, plan


def _lines(top: Top, widths: list[float]) -> int:
    """How many lines the line under the title takes."""
    return label_lines(top.longest_line, sum(map(pixels, widths[: LAST + 1])) / BOLD)


def _note(table: Table) -> str:
    return next(str(cell.content) for cell in table.cells if cell.row == table.plan.note_row)


def _with_top(plan: PagePlan, table: Table, least: Sequence[float]) -> tuple[list[float], Top]:
    """Widths of the table's columns, of which the first are wide enough for the top over them; and the top."""
    widths = list(table.widths) + list(least[len(table.widths) :])
    widths = [max(pair) for pair in zip(widths, least, strict=False)] + widths[len(least) :]
    return widths, Top(plan, sum(map(pixels, widths[MEANING : LAST + 1])))


def _left(widths: list[float]) -> int:
    """Where the charts begin: beside the top."""
    return sum(map(pixels, widths[: LAST + 1])) + GAP


def _columns_to(widths: list[float], wanted: int) -> int:
    """How many columns reach so far [pixels]."""
    col, reached = 0, 0
    while reached < wanted:
        reached += pixels(widths[col] if col < len(widths) else NARROW)
        col += 1
    return col


def _has_columns(plan: PagePlan, request: ChartRequest) -> bool:
    return all(plan.at.spots[symbol].column for symbol in (request.x, *request.y))


def _charted(requests: list[ChartRequest]) -> list[str]:
    return list(dict.fromkeys(symbol for request in requests for symbol in (request.x, *request.y)))


# --- charts ----------------------------------------------------------------------------------------------------------


def _placed(
    plan: PagePlan,
    widths: list[float],
    heights: Mapping[int, float],
    requests: list[ChartRequest],
    drawing: PageDrawing | None,
    framed: list[Chart],
    boxes: Sequence[Box],
) -> tuple[Chart, ...]:
    """The drawing, what has a frame of its own, and curves, each in its box."""
    charts = [drawing.chart, *framed] if drawing else []
    charts += [_curves(plan, request, drawing) for request in requests]
    found = []
    for chart, box in zip(charts, boxes, strict=True):
        col, dx = 0, box.x
        while dx >= (wide := pixels(widths[col] if col < len(widths) else NARROW)):
            dx -= wide
            col += 1
        row, dy = _row_at(heights, box.y)
        anchor = Anchor(row, col, box.width, box.height, dx=dx, dy=dy)
        found.append(replace(chart, anchor=anchor))
    return tuple(found)


def _row_at(heights: Mapping[int, float], y: int) -> tuple[int, int]:
    """The row that stands so far below the upper end of the charts, and how far into it [pixels]."""
    row, dy = CHARTS_ROW, y + CHARTS_BELOW
    while dy >= (high := int(heights.get(row, ROW_HEIGHT))):
        dy -= high
        row += 1
    return row, dy


def _curves(plan: PagePlan, request: ChartRequest, drawing: PageDrawing | None) -> Chart:
    def at(symbol: str) -> SeriesRef | None:
        cell = drawing.shown[symbol] if drawing else None
        return SeriesRef(plan.main, Area(cell.row, cell.col, cell.row, cell.col)) if cell else None

    axis = driver_axis(plan, request.x, request.x_ends, AXIS_STEPS)
    return curve_chart(plan, request, at, (CHART_WIDTH, CHART_HEIGHT), axis, "bottom")


def _controls(plan: PagePlan, heights: Mapping[int, float]) -> tuple[Control, ...]:
    """The scroll bar under the drawing."""
    if not plan.drawn or plan.rows < 2:
        return ()
    row, dy = _row_at(heights, CHART_HEIGHT + BELOW_DRAWING)
    below = Anchor(row, LAST + 1, CHART_HEIGHT, 18, dx=GAP, dy=dy)
    return position_controls(plan, below, VALUE, UNIT)
