"""In which steps a book is computed: blocks that go together in segments, those that read each other by themselves."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple, Protocol

from ...formula.book import CellStore
from ...formula.nodes import Node
from ..fast.lowered_functions import FUNCTIONS
from ..fast.lowering import Lowering, UnsuitableError
from ..fast.segments import Member, Segment, worth_at_once
from ..graph import Functions, ordered
from ..interpreter.evaluator import Evaluator
from ..layout import Layout
from ..results import Marks
from .array_steps import ArrayStep, Kept
from .cell_by_cell import Together
from .row_by_row import row_by_row


class Step(Protocol):
    """Something that computes cells, and marks those of its blocks that do not consist of numbers alone."""

    @property
    def producers(self) -> Sequence[int]:
        """The numbers of its blocks."""

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells of the step."""


class Special(NamedTuple):
    """What is not simply a formula filled down, and how the steps will be used.

    functions  what names that stand for functions mean
    kept       blocks that keep their stored values -> those values, and the code of the error where there is none
    blocked    dynamic arrays with something in their way
    apart      blocks that share no segment, as they may have to wait for others at any time
    texts      producers known to hold texts and nothing else; the steps add theirs
    once       the book will be computed only once: no code is prepared for blocks too small to be worth it then
    """

    functions: Functions
    kept: Mapping[int, tuple[CellStore, int]]
    blocked: frozenset[int]
    apart: frozenset[int]
    texts: set[int]
    once: bool


def schedule(
    layout: Layout, formulas: Sequence[Node], reads: Sequence[set[int]], special: Special, blocks: Collection[int]
) -> list[Step]:
    """The steps of some blocks in order; a block stands in the earliest segment of its height that comes after all it reads.

    What they read besides comes before.
    """
    steps: list[Step] = []
    place: dict[int, int] = {}
    alike: dict[tuple[int, int], list[int]] = {}
    for group in ordered(reads, blocks):
        number = group[0]
        if len(group) > 1 or number in reads[number]:
            place.update(dict.fromkeys(group, len(steps)))
            together = Together(layout, formulas, group, special.functions, special.blocked)
            steps.append(row_by_row(layout, formulas, group) or together)
            continue
        lone = _lone_step(layout, number, formulas[number], special)
        if lone is not None:
            place[number] = len(steps)
            steps.append(lone)
            continue
        member = Member(layout, number, formulas[number])
        after = max((place[read] for read in reads[number] if read in place), default=0)
        # Cells of one row are quicker one by one (`fast/cell_code`): no two of them need change together.
        if member.block.rows == 1 or (special.once and not worth_at_once(member.block.rows, member.block.cols)):
            place[number] = len(steps)
            steps.append(Segment(layout, member, None))
            continue
        # A wide block shares nothing with others but is a segment of its own.
        key = (member.block.rows, 1) if member.block.cols == 1 else (-number, member.block.cols)
        if number in special.apart:
            key = -number, -1
        for index in alike.setdefault(key, []):
            segment = steps[index]
            if index >= after and isinstance(segment, Segment) and segment.joined(member):
                place[number] = index
                if segment.is_full:
                    alike[key].remove(index)
                break
        else:
            place[number] = len(steps)
            segment = _new_segment(layout, member, Lowering(layout, layout.sheets, FUNCTIONS, special.texts))
            if segment.lowering is not None:
                alike[key].append(len(steps))
            steps.append(segment)
    return steps


def _lone_step(layout: Layout, number: int, formula: Node, special: Special) -> Step | None:
    """The step of a block that no segment can take."""
    if number in special.kept:
        return Kept(layout, number, *special.kept[number])
    if layout.blocks[number].kind != "fill":
        return ArrayStep(layout, number, formula, number in special.blocked)
    return None


def _new_segment(layout: Layout, member: Member, lowering: Lowering) -> Segment:
    try:
        lowering.add(member.number, member.formula)
    except UnsuitableError:
        return Segment(layout, member, None)
    return Segment(layout, member, lowering)
