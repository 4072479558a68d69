"""In which steps a book is computed: blocks that go together in segments, those that read each other by themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from ..formula.nodes import Node
from .careful import Evaluator
from .graph import ordered
from .layout import Layout
from .lowered_functions import FUNCTIONS
from .lowering import Lowering, UnsuitableError
from .marks import Marks, marks_of_constants
from .recurrence import recognise
from .segments import Member, Segment, worth_at_once
from .sequence import Together


class Step(Protocol):
    """Something that computes cells, and marks those of its blocks that do not consist of numbers alone."""

    @property
    def producers(self) -> Sequence[int]:
        """The numbers of its blocks."""

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells of the step."""


def schedule(layout: Layout, formulas: Sequence[Node], reads: Sequence[set[int]], once: bool = False) -> list[Step]:
    """The steps in order; a block stands in the earliest segment of its height that comes after all it reads.

    once  the book will be computed only once: no code is prepared for blocks too small to be worth it then
    """
    steps: list[Step] = []
    place: dict[int, int] = {}
    alike: dict[tuple[int, int], list[int]] = {}
    sheets = {title: index for index, title in enumerate(layout.titles)}
    texts = marks_of_constants(layout).texts
    for group in ordered(reads):
        number = group[0]
        recurrence = recognise(layout, number, formulas[number]) if number in reads[number] else None
        if len(group) > 1 or (number in reads[number] and recurrence is None):
            place.update(dict.fromkeys(group, len(steps)))
            steps.append(Together(layout, formulas, group))
            continue
        member = Member(layout, number, formulas[number], recurrence)
        after = max((place[read] for read in reads[number] if read in place), default=0)
        if once and not worth_at_once(member.block.rows, member.block.cols):
            place[number] = len(steps)
            steps.append(Segment(layout, member, None))
            continue
        # A wide block shares nothing with others but is a segment of its own.
        key = (member.block.rows, 1) if member.block.cols == 1 else (-number, member.block.cols)
        for index in alike.setdefault(key, []):
            segment = steps[index]
            if index >= after and isinstance(segment, Segment) and segment.joined(member):
                place[number] = index
                break
        else:
            place[number] = len(steps)
            segment = _new_segment(layout, member, Lowering(layout, sheets, FUNCTIONS, texts))
            if segment.lowering is not None:
                alike[key].append(len(steps))
            steps.append(segment)
    return steps


def _new_segment(layout: Layout, member: Member, lowering: Lowering) -> Segment:
    try:
        lowering.add(member.number, member.formula, member.recurrence)
    except UnsuitableError:
        return Segment(layout, member, None)
    return Segment(layout, member, lowering)
