"""What counts as a difference when workbooks are checked: tolerances, cells that are left out, differences accepted."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from livesheet.diagnostics import Fault, WorkbookError
from livesheet.formula.book import Book
from livesheet.said import say
from mechsheet.arguments.values import Area, area_of
from mechsheet.checking.report import TOLERANCE


@dataclass(frozen=True, slots=True)
class Rules:
    """What a check is to overlook.

    relative   largest relative difference of two numbers that count as equal
    absolute   largest difference of two numbers that count as equal, however small they are
    ignore     cells that are left out: `Sheet!A1:B9`, a name, a whole sheet
    """

    relative: float = TOLERANCE
    absolute: float = 0.0
    ignore: tuple[str, ...] = field(default=())

    def __post_init__(self) -> None:
        for name, value in (("relative", self.relative), ("absolute", self.absolute)):
            if not (0 <= value < math.inf):
                raise WorkbookError(
                    Fault(
                        say("{value} cannot be the largest difference: expected a number from 0 on", value=value),
                        key=name,
                    )
                )


@dataclass(frozen=True, slots=True)
class Ignored:
    """The cells of one book that are left out."""

    areas: tuple[Area, ...] = ()

    def has(self, sheet: str, row: int, col: int) -> bool:
        """Whether a cell is one of them."""
        return any(
            area.sheet == sheet and area.row <= row < area.row + area.rows and area.col <= col < area.col + area.cols
            for area in self.areas
        )


def ignored_in(book: Book, texts: Sequence[str]) -> Ignored:
    """The cells that `texts` mean in a book; `unmeant` has those that mean none."""
    found = (area_of(book, text) for text in texts)
    return Ignored(tuple(area for area in found if isinstance(area, Area)))


def unmeant(book: Book, texts: Sequence[str]) -> dict[str, Fault]:
    """The texts that mean no cells of a book, with why."""
    found = {text: area_of(book, text) for text in texts}
    return {
        text: replace(fault, file=book.source, key=f"ignore {text}")
        for text, fault in found.items()
        if isinstance(fault, Fault)
    }
