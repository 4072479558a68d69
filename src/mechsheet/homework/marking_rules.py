"""What is asked of a workbook, and how it is marked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from livesheet.formula.nodes import symbols
from mechsheet.kinematics.solve import solve
from mechsheet.model import Mechanism

TOLERANCE = 1e-4
NOT_LIVE = 0.5


@dataclass(frozen=True, slots=True)
class AskedFor:
    """Marks by what is asked; the rest as `Exercise` has it."""

    marks: Mapping[str, float]
    tolerance: float = TOLERANCE
    follow_through: bool = True
    not_live: float = NOT_LIVE


def asked_of(mechanism: Mechanism) -> AskedFor:
    """What a description asks for: by default every link angle, displacement and output, a mark each; not what drives and
    has its values in a column, nor the angle of a link that cannot turn, which `audit` would leave out too."""
    exercise = mechanism.exercise
    if exercise is not None:
        rules = exercise.tolerance, exercise.follow_through, exercise.not_live
        return AskedFor(exercise.asked or asked_of(replace(mechanism, exercise=None)).marks, *rules)
    names = [link.angle_symbol for link in mechanism.links[1:]]
    names += [joint.symbol for joint in mechanism.joints] + [output.symbol for output in mechanism.outputs]
    still = {equation.symbol for equation in solve(mechanism).all if not symbols(equation.expression)}
    given = {mechanism.driver.symbol, *mechanism.listed_symbols}
    return AskedFor({name: 1.0 for name in names if name not in given | still})
