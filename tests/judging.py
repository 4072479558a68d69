"""A mechanism judged without a file: laid out, recalculated by the engine, compared with the reference."""

from mechsheet.checking import Comparison
from mechsheet.checking.against_reference import against_reference
from mechsheet.compute import book_of
from mechsheet.engine import evaluate
from mechsheet.kinematics.solve import solve
from mechsheet.model import Mechanism
from mechsheet.sheet.layout import lay_out


def judged(mechanism: Mechanism, changes: dict[str, float] | None = None) -> Comparison:
    """Engine against reference, with input cells changed: `changes` maps dimensions or modes to what the cell then holds."""
    workbook, plan = lay_out(mechanism, solve(mechanism))
    overrides = {}
    for symbol, value in (changes or {}).items():
        spot = plan.at.spots[symbol]
        overrides[spot.sheet, spot.row, spot.col] = value
    book = book_of(workbook)
    comparison, _ = against_reference(book, evaluate(book, overrides), mechanism.text, mechanism.name)
    return comparison
