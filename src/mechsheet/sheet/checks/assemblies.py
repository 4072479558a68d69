"""Whether a group that Newton's method solves stays in its assembly: each unknown goes on nearly as it went.

The determinant's sign is asked where the position itself is (`lowering`): a row with the other sign is none. Among
assemblies of one sign a leap shows in the unknowns: from row to row each changes as in the rows before, up to `LEAP`.
"""

from __future__ import annotations

import math
from typing import Literal

from livesheet.formula.nodes import Call, CellRef, Node
from mechsheet.kinematics.newton.changed_dimensions import LEAP
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

ArrivedKind = Literal["assembly", "residual", "needed", "det"]


def assembly_columns(plan: Plan, sheet: str, begun: CellRef) -> list[tuple[ArrivedKind, int, Node]]:
    """(kind, number of the group, formula for the first row): 1 in a row that may be of another assembly than the one
    before, and of rows that have a position the residual, the passes needed, |det|.

    begun  how many stretches of positions have begun by the first row

    A row behind rows without a position counts as another assembly: nobody knows how the mechanism came there.
    """
    found: list[tuple[ArrivedKind, int, Node]] = []
    first = plan.at.first
    for group in plan.equations.groups:
        system = group.system
        if system is None:
            continue
        steps = []
        for name in system.variables:
            here, before, earlier = (plan.at.cell(name, sheet, first - back) for back in range(3))
            angle = plan.equations.of(name).unit.kind == "angle"
            most = plan.size * math.radians(LEAP)
            if angle:
                most = LEAP if plan.at.spots[name].degrees else round(math.radians(LEAP), 4)
            trend = formula("ABS(IFERROR(here-2*before+earlier,here-before))/most", here=here, before=before,
                            earlier=earlier, most=most)  # fmt: skip
            steps.append(trend)
        here, before = (plan.at.cell(system.variables[0], sheet, first - back) for back in (0, 1))
        node = formula(
            "IF(ISNUMBER(here),IF(ISNUMBER(before),IFERROR(IF(largest>1,1,0),0),IF(begun>1,1,0)),0)",
            here=here, before=before, begun=begun, largest=Call("MAX", tuple(steps)),
        )  # fmt: skip
        found.append(("assembly", group.number, node))
        kept: tuple[tuple[ArrivedKind, Node], ...] = (
            ("residual", plan.at.cell(system.residual, sheet, first)),
            ("needed", plan.places.starts[group.number].needed.in_row(first)),
            ("det", Call("ABS", (plan.at.cell(system.determinant, sheet, first),))),
        )
        for kind, cell in kept:
            found.append((kind, group.number, formula('IF(ISNUMBER(here),value,"")', here=here, value=cell)))
    return found
