"""The sheet of synthesis, second in the workbook: task, result, verdicts, charts; then each step, and tables."""

from __future__ import annotations

from livesheet.formula.nodes import Call, CellRef
from livesheet.workbook import Area, Column, PrintSetup, Sheet
from mechsheet.sheet import styles
from mechsheet.sheet.mathematics import written
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import input_validation, rich
from mechsheet.sheet.synthesis.page import Page
from mechsheet.sheet.synthesis.pictures import write_curve_chart, write_figure
from mechsheet.sheet.synthesis.requirement_checks import Does, can_be
from mechsheet.sheet.synthesis.tables import sensitivity_columns, write_asked, write_changes, write_curve
from mechsheet.sheet.task_rows import (
    HINT_ROW,
    LINE_ROW,
    MEANING,
    REMARK,
    ROUNDED,
    SYMBOL,
    TITLE_ROW,
    UNIT,
    USED,
    VALUE,
)
from mechsheet.synthesis.writing import says

ROW_HEIGHT, LINE_HEIGHT = 20.0, 34.0

WIDTHS = {SYMBOL: 14, VALUE: 14, UNIT: 7, ROUNDED: 13, USED: 13, MEANING: 40, REMARK: 46}
"""Of the columns, in characters."""


def synthesis_sheet(plan: Plan) -> Sheet:
    """The sheet of a mechanism whose dimensions are found from a task."""
    task, rows = plan.mechanism.synthesis, plan.synthesis
    if task is None or rows is None:
        raise ValueError("the mechanism has no synthesis")
    page = Page(plan, task, rows)
    page.put(TITLE_ROW, SYMBOL, page.text(f"kind.{task.kind}"), styles.TITLE)
    page.put(HINT_ROW, SYMBOL, page.text("hint"), styles.SUBTITLE)
    _task(page)
    _results(page)
    Does(page).write()
    _solution(page)
    folded = write_changes(page)
    write_asked(page)
    write_figure(page)
    write_curve(page)
    write_curve_chart(page)
    return Sheet(
        page.title,
        tuple(page.cells),
        tuple(page.fills),
        columns=(*(Column(col, col, width) for col, width in WIDTHS.items()), *folded),
        row_heights=(
            (TITLE_ROW, 26.0),
            (LINE_ROW, LINE_HEIGHT),
            *((row, ROW_HEIGHT) for row in range(HINT_ROW, rows.next_row)),
        ),
        merges=tuple(page.merges),
        charts=tuple(page.charts),
        validations=tuple(page.validations),
        conditionals=tuple(page.conditionals),
        selected=(rows.heads["task"] + 1, VALUE),
        gridlines=False,
        tab_color="B8860B",
        print_setup=PrintSetup(
            # what the charts show is not printed as numbers once more
            area=Area(TITLE_ROW, SYMBOL, rows.heads["figure"] - 2, sensitivity_columns(task)[0] - 1),
            footer=plan.footer,
        ),
    )


def _task(page: Page) -> None:
    """The yellow cells."""
    page.heading("task")
    for symbol in page.given.inputs:
        dim, row = page.dimensions[symbol], page.rows.of["task", symbol]
        page.put(row, SYMBOL, rich(symbol), styles.SYMBOL)
        page.put(row, VALUE, dim.shown, styles.INPUT)
        page.put(row, UNIT, dim.unit.text, styles.UNIT)
        page.across(row, ROUNDED, MEANING, dim.label.of(page.plan.language) if dim.label else "", styles.LABEL)
        area = Area(row, VALUE, row, VALUE)
        page.validations.append(input_validation(page.plan, area, symbol))
        wrong = formula("NOT(good)", good=can_be(page, symbol))
        page.colour(area, wrong, styles.BAD)


def _results(page: Page) -> None:
    """Exact, rounded, as the mechanism uses it; amber where somebody has typed over the mechanism's dimension."""
    page.heading("result", value=page.text("exact"), rounded=page.text("rounded"), used=page.text("used"))
    used = page.used
    for name, symbol in page.given.results.items():
        row, dim = page.rows.of["result", name], page.dimensions[symbol]
        style = page.dimension_style(dim, styles.RESULT)
        page.put(row, SYMBOL, rich(name), styles.SYMBOL)
        page.formula(row, VALUE, page.cell(symbol), style)
        page.put(row, UNIT, dim.unit.text, styles.UNIT)
        rounds = page.rounds and dim.unit.kind == "length"
        if rounds:
            exact, step = page.cell(symbol), page.cell(page.given.rounding)
            page.formula(row, ROUNDED, formula("step*ROUND(exact/step,0)", exact=exact, step=step), style)
        else:
            page.put(row, ROUNDED, None, style)
        if name in used:
            page.formula(row, USED, used[name], style)
            here, found = CellRef(row, USED, True, True), CellRef(row, ROUNDED if rounds else VALUE, True, True)
            apart = formula("IFERROR(ABS(here-found)>0.000000001*(1+ABS(found)),FALSE)", here=here, found=found)
            page.colour(Area(row, USED, row, USED), apart, styles.WARN)
        else:
            page.put(row, USED, None, style)
        page.put(row, MEANING, dim.label.of(page.plan.language) if dim.label else "", styles.LABEL)


def _solution(page: Page) -> None:
    """Each step: symbol, value, the equation as a textbook has it, what it is or why it is not."""
    page.heading("solution", REMARK)
    reasons = dict(page.given.reasons)
    for symbol in page.given.steps:
        dim, row = page.dimensions[symbol], page.rows.of["solution", symbol]
        node = dim.value
        if isinstance(node, float):
            continue
        page.put(row, SYMBOL, rich(symbol), styles.SYMBOL)
        bound = Call("DEGREES", (node,)) if dim.unit.in_degrees else node
        page.formula(row, VALUE, bound, page.dimension_style(dim, styles.RESULT))
        page.put(row, UNIT, dim.unit.text, styles.UNIT)
        page.across(row, ROUNDED, MEANING, written(says(node), page.plan.language), styles.LABEL)
        label = dim.label.of(page.plan.language) if dim.label else ""
        if symbol in reasons:
            words = formula("IF(ISNUMBER(value),label,reason)", value=CellRef(row, VALUE, True, True), label=label,
                            reason=reasons[symbol].of(page.plan.language))  # fmt: skip
            page.formula(row, REMARK, words, styles.LABEL)
        else:
            page.put(row, REMARK, label, styles.LABEL)
