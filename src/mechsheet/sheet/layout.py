"""A mechanism's workbook as plain data, and the map of where everything stands in it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from livesheet.workbook import Cell, Column, Properties, Sheet, Workbook
from mechsheet.kinematics.equations import Equations
from mechsheet.model import Mechanism
from mechsheet.sheet.as_typed import with_typed_constants
from mechsheet.sheet.asked.requested import table_sheets
from mechsheet.sheet.checks.checks import Checks, checks_sheet
from mechsheet.sheet.checks.extremes import Extremes
from mechsheet.sheet.drawing.charts import chart_requests, charts_of, with_charts
from mechsheet.sheet.drawing.drawing import drawing_of
from mechsheet.sheet.first.mechanism import controls, mechanism_sheet
from mechsheet.sheet.notes import notes_sheet, with_formulas
from mechsheet.sheet.plan import HIDDEN, Plan
from mechsheet.sheet.planning import plan_of
from mechsheet.sheet.synthesis.alt import alt_sheet
from mechsheet.sheet.synthesis.sheet import synthesis_sheet
from mechsheet.sheet.table.iterations import iterations_sheet
from mechsheet.sheet.table.positions import positions_sheet
from mechsheet.sheet.table.rates import forces_sheet, rates_sheet
from mechsheet.sheet.table.tolerance import Tolerance

DESCRIPTION_MARK = "mechsheet description, format 1"
"""First cell of the hidden sheet that carries the description: one line of it per row follows."""

DESCRIPTION_SHEET = "description"


def lay_out(mechanism: Mechanism, equations: Equations) -> tuple[Workbook, Plan]:
    """The workbook (its formulas have no values yet) and the plan that it follows."""
    plan = plan_of(mechanism, equations)
    extremes, checks, tolerance = Extremes(plan), Checks(plan), Tolerance(plan)
    requests = chart_requests(plan)
    drawing = drawing_of(plan, requests)
    notes, places = notes_sheet(plan)
    sheets = (
        with_charts(
            mechanism_sheet(plan, checks, extremes, tolerance, controls(plan)),
            partial(charts_of, plan, requests, drawing),
        ),
        *((synthesis_sheet(plan),) if plan.synthesis else ()),
        *((alt_sheet(plan),) if "alt" in plan.at.titles else ()),
        positions_sheet(plan),
        *((rates_sheet(plan),) if plan.rates else ()),
        *((forces_sheet(plan),) if plan.forces else ()),
        *((tolerance.sheet(),) if plan.bands else ()),
        *table_sheets(plan),
        notes,
        drawing.sheet,
        checks_sheet(plan, checks),
        extremes.sheet(),
        *((iterations_sheet(plan),) if plan.iterations else ()),
        description_sheet(plan),
    )
    hidden = {plan.at.titles.get(key) for key in HIDDEN}
    sheets = tuple(replace(sheet, hidden=sheet.hidden or sheet.title in hidden) for sheet in sheets)
    workbook = with_typed_constants(Workbook(sheets, tuple(plan.names), properties_of(plan)))
    return with_formulas(workbook, notes.title, places), plan


def properties_of(plan: Plan) -> Properties:
    """What the file says of itself."""
    return Properties(
        title=plan.mechanism.title.of(plan.language),
        subject=plan.mechanism.source.of(plan.language),
        comments=plan.text("made"),
        keywords="mechanism, linkage, mechsheet",
        language=plan.language,
        author="mechsheet",
    )


def description_sheet(plan: Plan) -> Sheet:
    """The description itself, so that `check` can judge a file that someone has edited."""
    lines = [DESCRIPTION_MARK, *plan.mechanism.text.split("\n")]
    cells = tuple(Cell(row, 0, line) for row, line in enumerate(lines) if line)
    return Sheet(plan.at.titles[DESCRIPTION_SHEET], cells, columns=(Column(0, 0, 120),), hidden=True)
