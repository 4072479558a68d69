"""What part of a block is being computed, what a reference means there, and why that may not work."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ..interpreter.closures import Bound


class Frame(NamedTuple):
    """The cells being computed: their first cell, how many, and how far that is from the block's first cell.

    names  what the names of LET and LAMBDA stand for there
    """

    sheet: int
    row: int
    col: int
    rows: int
    cols: int
    down: int = 0
    right: int = 0
    names: Mapping[str, Bound] | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of a full operand."""
        if self.cols > 1:
            return (self.cols, self.rows)
        return (self.rows,) if self.rows > 1 else ()

    def cell(self, down: int, right: int) -> Frame:
        """One cell of the frame."""
        down_there, right_there = self.down + down, self.right + right
        return Frame(self.sheet, self.row + down, self.col + right, 1, 1, down_there, right_there, self.names)

    def within(self, names: Mapping[str, Bound] | None) -> Frame:
        """The same cells with other names."""
        return self if names is self.names else self._replace(names=names)


class Span(NamedTuple):
    """What a reference means all over a frame: where it starts, its size, and whether it moves with rows and columns."""

    sheet: int
    row: int
    col: int
    height: int
    width: int
    moves_down: bool
    moves_right: bool


class VaryingSizeError(Exception):
    """A range whose size differs from cell to cell (`A$1:A5` filled down): to be evaluated cell by cell."""


class ArrayArgumentError(Exception):
    """An array where a function wants a single value: to be evaluated for each of its cells."""


class NotReadyError(Exception):
    """A cell that is needed has not been computed yet; what fills it (`Layout.producers`), -1 for one of the step itself."""

    def __init__(self, producer: int) -> None:
        super().__init__()
        self.producer = producer


class UnsupportedError(Exception):
    """Something that a kernel cannot do; the message says what."""
