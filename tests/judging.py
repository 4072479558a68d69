"""A mechanism judged without a file: laid out, recalculated by the engine, compared with the reference."""

from dataclasses import replace

from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.nodes import CellRef, walk
from livesheet.workbook import Fill, Workbook
from mechsheet.checking import Comparison
from mechsheet.checking.against_reference import against_plan
from mechsheet.compiled import Compiled
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan


def judged(mechanism: Mechanism, changes: dict[str, float] | None = None) -> Comparison:
    """Engine against reference, with input cells changed: `changes` maps dimensions or modes to what the cell then holds."""
    workbook, plan = positions_only(mechanism)
    overrides = {}
    for symbol, value in (changes or {}).items():
        spot = plan.at.spots[symbol]
        overrides[spot.sheet, spot.row, spot.col] = value
    book = book_of(workbook)
    comparison, _ = against_plan(book, evaluate(book, overrides), plan, mechanism.name)
    return comparison


def positions_only(mechanism: Mechanism) -> tuple[Workbook, Plan]:
    """The workbook without what reads the positions: that is most of its formulas, and not what is judged here."""
    compiled = Compiled(mechanism)
    return only_positions(compiled.layout, compiled.plan), compiled.plan


def only_positions(workbook: Workbook, plan: Plan) -> Workbook:
    """The sheets that positions are found on, without formulas that read others."""
    kept = {plan.main, plan.table, *(plan.at.titles.get(name, plan.main) for name in ("synthesis", "iterations"))}

    def stays(fill: Fill) -> bool:
        read = {node.sheet for node in walk(fill.formula) if isinstance(node, CellRef) and node.sheet is not None}
        return read <= kept

    sheets = tuple(
        replace(sheet, fills=tuple(filter(stays, sheet.fills))) for sheet in workbook.sheets if sheet.title in kept
    )
    return replace(workbook, sheets=sheets, names=tuple(name for name in workbook.names if name.sheet in kept))
