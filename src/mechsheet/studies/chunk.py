"""A chunk of a study's designs, from their numbers to those that meet all conditions, with their summaries.

Conditions that dimensions decide come first, for all designs of a chunk; then the motion of those that are left (`motion`);
then the conditions that read it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechsheet.kinematics.numeric import Array
from mechsheet.model import Condition
from mechsheet.studies.designs import Designs
from mechsheet.studies.extremes import Codes, Texts, apart, said
from mechsheet.studies.motion import Motion
from mechsheet.studies.questions import holds, number_of, turns_fully

Mask = NDArray[np.bool_]
Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Kept:
    """The designs of a chunk that meet all conditions: their numbers from 0 and columns, and how many failed each condition.

    failed   by the first condition that a design was found to fail, in the order of `Questions.conditions`
    remarks  what the workbook says of a design's numbers, None where nothing;  apart: which designs are set apart
    """

    numbers: Numbers
    columns: dict[str, Array]
    failed: Numbers
    remarks: Texts
    apart: Mask


def kept_of(designs: Designs, first: int, count: int) -> Kept:
    """The designs from number `first` on, so many, that meet all conditions."""
    questions = designs.questions
    chunk = _Chunk(designs, np.arange(first, first + count, dtype=np.int64))
    failed = np.zeros(len(questions.conditions), np.int64)
    for number, condition in enumerate(questions.cheap):
        failed[number] = chunk.keep(chunk.cheap(condition))
    others = failed[len(questions.cheap) :]
    others += chunk.move()
    for number, condition in enumerate(questions.others):
        if condition.kind == "compare":
            others[number] += chunk.keep(holds(condition, chunk.known, len(chunk.numbers)))
    count = len(chunk.numbers)
    remarks = said(chunk.remarks, designs.mechanism.language, count)
    return Kept(chunk.numbers, chunk.columns(), failed, remarks, apart(chunk.remarks, designs.decisive, count))


class _Chunk:
    """Some designs on their way through the conditions: all arrays have one entry for each that is left.

    shown   the dimensions that vary, in their own units;  inside: in the program's, as columns
    out     what rows do not change;  found: summaries and extremes, in the units shown;  remarks: what is said of them
    """

    def __init__(self, designs: Designs, numbers: Numbers) -> None:
        self.designs = designs
        self.numbers = numbers
        shown = designs.sampling.values(numbers)
        self.shown = {symbol: np.ascontiguousarray(shown[:, at]) for at, symbol in enumerate(designs.varied)}
        units = designs.units
        self.inside = {symbol: units[symbol].to_internal(column)[:, None] for symbol, column in self.shown.items()}
        self.found: dict[str, Array] = {}
        self.remarks: dict[str, Codes] = {}
        self.out = designs.unchanged(self.inside, len(numbers))

    def keep(self, fine: Mask) -> int:
        """Go on with the designs that are fine; how many are left behind."""
        left = int(len(fine) - np.count_nonzero(fine))
        if left:
            self.numbers = self.numbers[fine]
            for part in (self.shown, self.inside, self.found, self.out):
                for name, column in part.items():
                    part[name] = column[fine]
            self.remarks = {name: codes[fine] for name, codes in self.remarks.items()}
        return left

    @property
    def known(self) -> dict[str, Array]:
        """What conditions and objectives read: dimensions and summaries in the units shown."""
        designs = self.designs
        known = {dim: np.asarray(designs.units[dim].to_shown(number)) for dim, number in designs.dimensions.items()}
        known |= {dim: designs.units[dim].to_shown(self.out[dim]) for dim in designs.dependent}
        return known | self.shown | self.found

    def cheap(self, condition: Condition) -> Mask:
        """Whether designs meet a condition that dimensions decide."""
        if condition.kind == "compare":
            return holds(condition, self.known, len(self.numbers))
        lengths = [self.out[name] for name in self.designs.lengths[condition.name]]
        fine = turns_fully(lengths)
        return np.asarray(fine != condition.other, bool)

    def move(self) -> Numbers:
        """Find the summaries of the designs that are left; how many each further condition leaves behind by the rows."""
        motion = Motion(self.designs, self.inside, self.known)
        self.keep(motion.alive)
        self.found, self.remarks = motion.quantities, motion.remarks
        return motion.failed

    def columns(self) -> dict[str, Array]:
        """The columns of the result."""
        known, count = self.known, len(self.numbers)
        known |= {each.text: number_of(each.value, known, count) for each in self.designs.study.objectives}
        return {
            name: np.ascontiguousarray(np.broadcast_to(known[name], (count,)), float) for name in self.designs.names
        }
