"""What a study asks of a mechanism: quantities, conditions and objectives, over names that the equations know."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault, near_miss
from livesheet.formula.nodes import Node, symbols
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import OPERATORS, Array, value
from mechsheet.model import ENERGY, TAKES, Condition, Mechanism, Study, Take, Way
from mechsheet.sheet.classification import FourBar, classification
from mechsheet.sheet.columns.lowering import lowered
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.grashof import SAME

Mask = NDArray[np.bool_]

_EXTREME = re.compile(r"(min|max)\((.+)\)")


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of a design's motion: a summary of the description, or an extreme that a condition names.

    of, take  as in `Summary`;  factor  from the program's own numbers to the unit shown;  unit  what people read
    """

    name: str
    of: str
    take: Take
    factor: float
    unit: str

    @property
    def ways(self) -> tuple[Way, ...]:
        """The extremes that it is made of."""
        return self.take.ways


@dataclass(frozen=True, slots=True)
class Questions:
    """All that is asked of each design.

    quantities  columns of the result: the description's summaries, then what conditions and objectives ask besides
    cheap       conditions that dimensions decide;  others: those that need the motion
    loops       of each loop asked for: the four lengths of its sides
    """

    quantities: tuple[Quantity, ...]
    cheap: tuple[Condition, ...]
    others: tuple[Condition, ...]
    loops: Mapping[str, tuple[Node, ...]]

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """All, in the order in which they are asked."""
        return self.cheap + self.others


def questions_of(mechanism: Mechanism, study: Study, equations: Equations) -> Questions:
    """The questions of a study. Raises MechanismError with all that the mechanism has no answer to."""
    loops, faults = _loops(mechanism, equations, study.keep)
    summaries = {summary.symbol: (summary.of, summary.take) for summary in mechanism.summaries}
    asked = dict(summaries)
    nodes = [side for condition in study.keep for side in condition.sides]
    for name in (name for node in (*nodes, *(each.value for each in study.objectives)) for name in symbols(node)):
        found = _EXTREME.fullmatch(name)
        if found is not None:
            asked[name] = (found[2], TAKES[found[1]])
    quantities = []
    known = {equation.symbol: equation.unit for equation in (*equations.all, *equations.listed)}
    for name, (of, take) in asked.items():
        unit = mechanism.given_unit(of) or known.get(of)
        if of == ENERGY or unit is None:
            hint = say("leave it out of [summary] for the study")
            faults.append(
                Fault(
                    say('a study does not find "{of}", of which "{name}" is', of=of, name=name),
                    key=f"summary.{name}",
                    hint=hint,
                )
            )
            continue
        shown = mechanism.shown(unit)
        quantities.append(Quantity(name, of, take, float(shown.to_shown(1.0)), shown.text))
    faults += _grounded_cranks(mechanism, study.keep)
    if faults:
        raise MechanismError(faults)
    names = {quantity.name for quantity in quantities}
    cheap = [
        each for each in study.keep if each.kind == "grashof" or (each.kind == "compare" and not _reads(each, names))
    ]
    others = [each for each in study.keep if each not in cheap]
    return Questions(tuple(quantities), tuple(cheap), tuple(others), loops)


def _reads(condition: Condition, names: set[str]) -> bool:
    return any(name in names for side in condition.sides for name in symbols(side))


def _loops(
    mechanism: Mechanism, equations: Equations, keep: Iterable[Condition]
) -> tuple[dict[str, tuple[Node, ...]], list[Fault]]:
    asked = [condition for condition in keep if condition.kind == "grashof"]
    if not asked:
        return {}, []
    known: dict[str, FourBar] = {
        loop.name: loop for loop in classification(mechanism, lowered(mechanism, equations)).four_bars
    }
    found, faults = {}, []
    for condition in asked:
        if condition.name not in known:
            hint = (
                say("loops: {known}", known=", ".join(known)) if known else say("it has no four-bar loop on the ground")
            )
            if near := near_miss(condition.name, known):
                hint = say("{near} {hint}", near=near, hint=hint)
            faults.append(
                Fault(say('no four-bar loop is called "{name}"', name=condition.name), key="study.keep", hint=hint)
            )
            continue
        sides = known[condition.name].sides(mechanism.ground)
        found[condition.name] = tuple(length_in_cells(link, one, other, equations.poses) for link, one, other in sides)
    return found, faults


def _grounded_cranks(mechanism: Mechanism, keep: Iterable[Condition]) -> list[Fault]:
    """The ground cannot be asked whether it turns."""
    ground = mechanism.ground.name
    return [
        Fault(say('the ground "{ground}" does not turn', ground=ground), key="study.keep")
        for condition in keep
        if condition.kind == "crank" and condition.name == ground
    ]


def turns_fully(lengths: Sequence[Array]) -> Mask:
    """Whether some link of a four-bar loop can turn fully: shortest + longest < the other two (Grashof); not at a change
    point, where they are equal but for rounding."""
    sides = np.array(np.broadcast_arrays(*lengths))
    excess = 2.0 * (sides.min(axis=0) + sides.max(axis=0)) - sides.sum(axis=0)
    return np.asarray(excess < -SAME * sides.max(axis=0), bool)


def holds(condition: Condition, known: Mapping[str, Array], designs: int) -> Mask:
    """Whether designs meet a comparison; what has no number meets none."""
    sides = [np.broadcast_to(np.asarray(_number(side, known), float), (designs,)) for side in condition.sides]
    fine = np.ones(designs, bool)
    with np.errstate(invalid="ignore"):
        for left, operator, right in zip(sides, condition.operators, sides[1:], strict=False):
            fine &= OPERATORS[operator](left, right)
    numbers = np.logical_and.reduce([np.isfinite(side) for side in sides])
    return np.asarray(numbers & (fine != condition.other), bool)


def number_of(node: Node, known: Mapping[str, Array], designs: int) -> Array:
    """The value of an objective for each design, NaN where it has none."""
    found = np.broadcast_to(np.asarray(_number(node, known), float), (designs,))
    return np.where(np.isfinite(found), found, np.nan)


def _number(node: Node, known: Mapping[str, Array]) -> Array:
    with np.errstate(all="ignore"):
        return np.asarray(value(node, known))
