"""How far may two right answers differ: a cell's value beside somebody else's.

By the tolerances of the `Rules`; beyond them for reasons that are told from the formula and from what it reads. Large
numbers that cancel leave nothing but rounding. A cell that only says where something is may name another row, if the rows
are equal up to rounding.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from livesheet.diagnostics import Fault, WorkbookError
from livesheet.formula.book import Book
from livesheet.formula.nodes import (
    Binary,
    Call,
    CellRef,
    ErrorValue,
    NameRef,
    Node,
    Number,
    RangeRef,
    Scalar,
    Unary,
    walk,
)
from livesheet.said import say
from mechsheet.arguments.values import Area, area_of
from mechsheet.checking.comparison import TOLERANCE


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


def difference(ours: Scalar, theirs: Scalar, scale: float = 1.0, period: float | None = None) -> float:
    """How far two cell values are apart: numbers as a part of `scale` (or of themselves, if larger); else 0 or infinity.

    Numbers with a period are compared modulo it, as a part of it. Any error equals any error: programs name the same
    fault differently (#NUM! and #VALUE!). Texts as in `texts_apart`.
    """
    if isinstance(ours, ErrorValue) or isinstance(theirs, ErrorValue):
        return 0.0 if isinstance(ours, ErrorValue) and isinstance(theirs, ErrorValue) else math.inf
    if isinstance(ours, bool) or isinstance(theirs, bool):
        return 0.0 if ours == theirs else math.inf
    if isinstance(ours, float | int) and isinstance(theirs, float | int):
        if period is not None:
            return abs(math.remainder(ours - theirs, period)) / period
        return abs(ours - theirs) / max(scale, abs(ours), abs(theirs)) if ours != theirs else 0.0
    if (ours or "") == (theirs or ""):
        return 0.0
    return texts_apart(ours, theirs) if isinstance(ours, str) and isinstance(theirs, str) else math.inf


_NUMBER = re.compile(r"([0-9]+\.[0-9]+(?:[eE][-+]?[0-9]+)?|[0-9]+)")


_COMMA = re.compile(r"(?<=[0-9]),(?=[0-9])")


def texts_apart(ours: str, theirs: str) -> float:
    """The largest relative difference of the numbers in two texts, infinity when anything else differs.

    Programs write numbers into texts with 15 or 17 digits, and with the decimal sign of their user's language: a comma
    between two digits counts as a point.
    """
    parts = [_NUMBER.split(_COMMA.sub(".", text)) for text in (ours, theirs)]
    if parts[0][::2] != parts[1][::2]:
        return math.inf
    numbers = zip(map(float, parts[0][1::2]), map(float, parts[1][1::2]), strict=True)
    return max((abs(one - other) / max(one, other) for one, other in numbers if one != other), default=0.0)


def column_scale(column: Sequence[Scalar], size: float) -> float:
    """What a difference in a column is measured by: its largest value, or the size where the values are smaller still.

    A column that passes through zero has rounding errors of its large values there.
    """
    numbers = [abs(value) for value in column if isinstance(value, float) and math.isfinite(value)]
    return max([size, *numbers])


ROUNDING = 1e-14
"""What is lost when numbers cancel, as a part of the largest number that the formula reads."""

PIECE = 1024
"""Rows of a range that are looked through together."""


class Rounding:
    """What is lost in the formulas of one book when large numbers cancel."""

    def __init__(self, book: Book, values: Any) -> None:
        self._values = values
        self._names: Mapping[str, Node] = {name.name.casefold(): name.formula for name in book.names}
        self._largest: dict[tuple[str, int, int, int], float] = {}

    def accounts_for(self, formula: Node, title: str, ours: Scalar, theirs: Scalar) -> bool:
        """Whether a difference is what remains when large numbers cancel: nothing beside the numbers that are read."""
        if type(ours) is not float or type(theirs) is not float:
            return False
        apart = abs(ours - theirs)
        return any(apart <= ROUNDING * size for size in self._sizes(formula, title))

    def _sizes(self, formula: Node, title: str) -> Iterator[float]:
        arithmetic = self._with_loss(formula, title)
        if arithmetic is not None:  # its products may be larger than all that it reads
            yield arithmetic[1]
        for node in with_names(formula, self._names):
            for part in walk(node):
                if isinstance(part, Binary) and part.op == "/":
                    yield from self._divided(part, title)
                if isinstance(part, Number):
                    yield abs(part.value)
                elif isinstance(part, CellRef):
                    yield self._column(part.sheet or title, part.col, part.row, part.row)
                elif isinstance(part, RangeRef) and isinstance(part.start, CellRef) and isinstance(part.end, CellRef):
                    sheet = part.start.sheet or title
                    left, right = sorted((part.start.col, part.end.col))
                    top, bottom = sorted((part.start.row, part.end.row))
                    for col in range(left, right + 1):
                        yield self._column(sheet, col, top, bottom)

    def _divided(self, quotient: Binary, title: str) -> Iterator[float]:
        """What is lost in dividend and divisor, as in those of a slope between two places, is divided with them."""
        found = self._with_loss(quotient, title)
        if found is not None:
            yield found[1]

    def _with_loss(self, node: Node, title: str) -> tuple[float, float] | None:
        """What arithmetic over cells gives, and what is lost in it if of each number a part of 1 is; None for all else."""
        match node:
            case Number(number):
                return number, abs(number)
            case CellRef(row, col, _, _, sheet):
                found = self._values.get(sheet or title, row, col)
                return (found, abs(found)) if type(found) is float else None
            case Unary("-", operand):
                inner = self._with_loss(operand, title)
                return None if inner is None else (-inner[0], inner[1])
            case Binary(op, left, right):
                one, other = self._with_loss(left, title), self._with_loss(right, title)
                return None if one is None or other is None else _lost(op, one, other)
        return None

    def _column(self, sheet: str, col: int, top: int, bottom: int) -> float:
        """The largest number in rows top..bottom: long ranges piece by piece, as many formulas may read nearly the same."""
        first, last = -(-top // PIECE), (bottom + 1) // PIECE
        if last - first < 2:
            return self._largest_of(sheet, col, top, bottom)
        whole = max(self._largest_of(sheet, col, at * PIECE, at * PIECE + PIECE - 1) for at in range(first, last))
        ends = ((top, first * PIECE - 1), (last * PIECE, bottom))
        return max(whole, *(self._largest_of(sheet, col, start, end) for start, end in ends if start <= end))

    def _largest_of(self, sheet: str, col: int, top: int, bottom: int) -> float:
        key = sheet, col, top, bottom
        if key not in self._largest:
            try:
                numbers, _ = self._values.arrays(sheet, col, top, bottom)
            except KeyError:
                numbers = np.zeros(1)
            numbers = np.abs(numbers[np.isfinite(numbers)])
            self._largest[key] = float(numbers.max(initial=0.0))
        return self._largest[key]


def _lost(op: str, one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float] | None:
    """The same of an operator between two operands."""
    (x, in_x), (y, in_y) = one, other
    match op:
        case "+":
            return x + y, in_x + in_y
        case "-":
            return x - y, in_x + in_y
        case "*":
            return x * y, abs(x) * in_y + abs(y) * in_x
        case "/" if y:
            return x / y, (in_x + abs(x / y) * in_y) / abs(y)
        case "^" if y == 2:
            return x * x, 2 * abs(x) * in_x
    return None


class EqualRows:
    """Rows that are equal up to rounding: of a formula with INDEX(spots; MATCH(sought; column; 0)) in it, each is an answer.

    values  the engine's;  scale  the length that counts as one
    """

    def __init__(self, values: Any, scale: float) -> None:
        self._values, self._scale = values, scale

    def has(self, formula: Node, title: str, theirs: Scalar) -> bool:
        """Whether `theirs` stands in `spots` beside a value of `column` that is what is sought, to the tolerance."""
        for part in walk(formula):
            match part:
                case Call("INDEX", (RangeRef() as spots, Call("MATCH", (sought, RangeRef() as column, Number(0.0))))):
                    target = self._sought(sought, title)
                    pairs = zip(self._column(spots, title), self._column(column, title), strict=False)
                    if isinstance(target, float) and any(
                        isinstance(found, float)
                        and difference(found, target, self._scale) <= TOLERANCE
                        and difference(spot, theirs) <= TOLERANCE
                        for spot, found in pairs
                    ):
                        return True
        return False

    def _sought(self, node: Node, title: str) -> Scalar:
        """A cell, or the extreme of a column."""
        match node:
            case CellRef(row, col, _, _, other):
                found: Scalar = self._values.get(other or title, row, col)
                return found
            case Call("MAX" | "MIN" as name, (RangeRef() as area,)):
                numbers = [value for value in self._column(area, title) if isinstance(value, float)]
                return (max if name == "MAX" else min)(numbers, default=math.nan)
            case _:
                return None

    def _column(self, area: RangeRef, title: str) -> list[Scalar]:
        if area.start.col != area.end.col:
            return []
        sheet = area.start.sheet or title
        found: list[Scalar] = self._values.column(sheet, area.start.col, area.start.row, area.end.row)
        return found


def with_names(formula: Node, names: Mapping[str, Node]) -> Iterator[Node]:
    """The formula, and what the names in it stand for (each once)."""
    waiting, seen = [formula], set[str]()
    while waiting:
        node = waiting.pop()
        yield node
        for part in walk(node):
            if isinstance(part, NameRef) and part.name.casefold() not in seen:
                seen.add(part.name.casefold())
                if part.name.casefold() in names:
                    waiting.append(names[part.name.casefold()])
