"""The sheet of forces: in the rows of the positions the driver's effort, found twice, then each group's joint forces.

Grey are mass centres, their accelerations, and the sums of what acts on each link; black is what people read. Groups stand
in the order in which their forces are found: the last one first, the driver last.
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.nodes import Node
from livesheet.workbook import Sheet
from mechsheet.sheet.deleted import READS, are_there, missing_words
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.rates import sheet_beside


def forces_sheet(plan: Plan) -> Sheet:
    """The sheet; what it says of a row is what the rates say, or the positions where there is no group; or that the rates
    were deleted."""
    said: Node = (plan.places.rates or plan.places.status).in_row(plan.at.first)
    present = are_there(plan, READS["forces"])
    if present is not None:
        missing = replace(missing_words(plan), sheet=plan.main)
        said = formula("IF(present,said,missing)", present=present, said=said, missing=missing)
    return sheet_beside(plan, "forces", plan.forces, said, "B91C1C")
