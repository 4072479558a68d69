"""A recalculated workbook against the values stored in its file: which cells differ, and which of them came first."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

from mechsheet.checking.report import text_of
from mechsheet.formula.book import Block, Book, BookSheet, Run
from mechsheet.formula.functions import FUNCTIONS
from mechsheet.formula.nodes import (
    Binary,
    Call,
    CellRef,
    ErrorValue,
    NameRef,
    Node,
    RangeRef,
    Scalar,
    Unary,
    shifted,
    walk,
)
from mechsheet.formula.printer import print_formula
from mechsheet.formula.references import cell_address

TOLERANCE = 1e-9
"""Largest relative difference of two numbers that count as equal."""
ROUNDING = 1e-14
"""What is lost when numbers cancel, as a part of the largest number that the formula reads."""

MAX_TRACED = 5_000
"""Up to so many differences are told apart into causes and what follows from them: each is compared with all."""

Place = tuple[str, int, int]


@dataclass(frozen=True, slots=True)
class Difference:
    """A cell whose stored value is not the one computed.

    kind      "number", "text", "type" (a number against a text ...), "error" (an error against a value), "which error"
    size      relative difference of two numbers, infinity for what differs in kind
    functions of its formula, outermost first; "" when it has none
    follows   whether it reads cells that differ themselves: then it need not be at fault
    excused   whether volatile functions (NOW, RAND ...) account for it
    """

    sheet: str
    row: int
    col: int
    kind: str
    size: float
    ours: Scalar
    theirs: Scalar
    functions: str
    formula: str
    follows: bool = False
    excused: bool = False

    @property
    def address(self) -> str:
        """Sheet!A1."""
        return cell_address(self.sheet, self.row, self.col)


@dataclass(frozen=True, slots=True)
class Group:
    """Differences of one kind under the same functions; `first` is the one that differs most."""

    functions: str
    kind: str
    cells: int
    first: Difference


@dataclass(frozen=True, slots=True)
class Stored:
    """What the comparison found.

    formulas     cells with formulas that were computed;  equal, unstored  of these: as stored; without a stored value
    kept         cells whose formulas could not be read and whose stored values were taken
    differences  in the order of sheets, columns and rows
    """

    formulas: int
    equal: int
    unstored: int
    kept: int
    differences: tuple[Difference, ...] = field(default=())

    @property
    def agrees(self) -> bool:
        """True when nothing differs but by volatile functions."""
        return all(item.excused for item in self.differences)

    def groups(self) -> list[Group]:
        """The differences that count and follow from no other, the largest groups first."""
        found = [item for item in self.differences if not (item.follows or item.excused)]
        key = lambda item: (item.functions, item.kind)  # noqa: E731
        groups = [
            (functions, kind, list(items)) for (functions, kind), items in groupby(sorted(found, key=key), key=key)
        ]
        groups.sort(key=lambda group: (-len(group[2]), group[0], group[1]))
        return [Group(f, kind, len(items), max(items, key=lambda item: item.size)) for f, kind, items in groups]

    def as_dict(self) -> dict[str, Any]:
        """The findings as JSON data."""
        return {
            "agrees": self.agrees,
            "formulas": self.formulas,
            "equal": self.equal,
            "without a stored value": self.unstored,
            "kept": self.kept,
            "groups": [
                {"functions": g.functions, "kind": g.kind, "cells": g.cells, "worst": _json_size(g.first.size)}
                for g in self.groups()
            ],
            "differences": [
                {
                    "cell": item.address,
                    "formula": item.formula,
                    "functions": item.functions,
                    "kind": item.kind,
                    "size": _json_size(item.size),
                    "computed": text_of(item.ours),
                    "stored": text_of(item.theirs),
                    "follows": item.follows,
                    "volatile": item.excused,
                }
                for item in self.differences
            ],
        }


def _json_size(size: float) -> float | None:
    return size if math.isfinite(size) else None


def compare_with_stored(book: Book, values: Any, which_error: bool = True) -> Stored:
    """The values computed against those stored in the file `book` was read from.

    which_error  whether different errors are a difference (LibreOffice's files have fewer of them than Excel's)
    """
    differences: list[tuple[Difference, Node]] = []
    counts: Counter[str] = Counter()
    for sheet in book.sheets:
        for block in sheet.blocks:
            for col in range(block.col, block.col + block.cols):
                differences += _column(sheet, block, col, values, which_error, counts)
        counts["stored"] += sum(len(run.values) for runs in sheet.cached.columns.values() for run in runs)
    stored = counts["formulas"] - counts["unstored"]
    return Stored(
        counts["formulas"],
        stored - len(differences),
        counts["unstored"],
        max(counts["stored"] - stored, 0),
        _causes(book, differences),
    )


def _column(
    sheet: BookSheet, block: Block, col: int, values: Any, which_error: bool, counts: Counter[str]
) -> Iterator[tuple[Difference, Node]]:
    """The differences in one column of a block."""
    first, last = block.row, block.row + block.rows - 1
    ours: list[Scalar] = values.column(sheet.title, col, first, last)
    theirs = _values(sheet.cached.columns.get(col, ()), first, last)
    counts["formulas"] += block.rows
    counts["unstored"] += theirs.count(None)
    if ours == theirs and list(map(type, ours)) == list(map(type, theirs)):
        return
    for row, (mine, other) in enumerate(zip(ours, theirs, strict=True), first):
        if other is None or (type(mine) is type(other) and mine == other):
            continue
        kind, size = _apart(mine, other)
        if not kind or size <= TOLERANCE or (kind == "which error" and not which_error):
            continue
        filled = block.kind == "fill"
        formula = shifted(block.formula, row - block.row, col - block.col) if filled else block.formula
        if (
            isinstance(mine, float)
            and isinstance(other, float)
            and _is_rounding(formula, sheet.title, values, mine, other)
        ):
            continue
        names, text = _functions(formula), print_formula(formula)
        yield Difference(sheet.title, row, col, kind, size, mine, other, names, text), formula


def _values(runs: Sequence[Run], first: int, last: int) -> list[Scalar]:
    """The values of rows first..last of a column, None where there is none."""
    found: list[Scalar] = [None] * (last - first + 1)
    for run in runs:
        start, stop = max(run.row, first), min(run.end, last + 1)
        if start < stop:
            found[start - first : stop - first] = run.values[start - run.row : stop - run.row]
    return found


def _apart(ours: Scalar, theirs: Scalar) -> tuple[str, float]:
    """(kind, size) of the difference of two values; ("", 0) when there is none."""
    if isinstance(ours, ErrorValue) or isinstance(theirs, ErrorValue):
        both = isinstance(ours, ErrorValue) and isinstance(theirs, ErrorValue)
        same = both and str(ours).upper() == str(theirs).upper()
        return ("", 0.0) if same else ("which error" if both else "error", math.inf)
    if type(ours) is float and type(theirs) is float:
        return "number", abs(ours - theirs) / max(abs(ours), abs(theirs), 5e-324)
    if (ours is None or ours == "") and theirs == "":
        return "", 0.0
    if isinstance(ours, str) and isinstance(theirs, str):
        return ("", 0.0) if ours == theirs else ("text", math.inf)
    return ("", 0.0) if ours == theirs and type(ours) is type(theirs) else ("type", math.inf)


def _is_rounding(formula: Node, title: str, values: Any, ours: float, theirs: float) -> bool:
    """Whether a difference is what remains when large numbers cancel: nothing beside the numbers that the formula reads."""
    largest = 0.0
    for part in walk(formula):
        cells: list[CellRef] = []
        if isinstance(part, CellRef):
            cells = [part]
        elif isinstance(part, RangeRef):
            cells = [part.start, part.end]
        for cell in cells:
            try:
                value = values.get(cell.sheet or title, cell.row, cell.col)
            except KeyError:
                continue
            if isinstance(value, float):
                largest = max(largest, abs(value))
    return abs(ours - theirs) <= ROUNDING * largest


def _functions(formula: Node) -> str:
    """The functions of a formula, outermost first, at most three; the operators of one without functions."""
    names = list(dict.fromkeys(part.name for part in walk(formula) if isinstance(part, Call)))
    if names:
        return ", ".join(names[:3])
    operators = dict.fromkeys(part.op for part in walk(formula) if isinstance(part, Binary | Unary))
    return " ".join(operators)


def _causes(book: Book, differences: Sequence[tuple[Difference, Node]]) -> tuple[Difference, ...]:
    """The differences with what they follow from: other differences that they read, and volatile functions."""
    if len(differences) > MAX_TRACED:
        return tuple(item for item, _ in differences)
    places = {(item.sheet.casefold(), item.row, item.col): number for number, (item, _) in enumerate(differences)}
    rows: dict[str, list[Place]] = {}
    for place in places:
        rows.setdefault(place[0], []).append(place)
    names = {name.name.casefold(): name.formula for name in book.names}
    reads: list[set[int]] = []
    volatile: list[bool] = []
    for number, (item, formula) in enumerate(differences):
        parts = [part for node in _with_names(formula, names) for part in walk(node)]
        found = {places[place] for part in parts for place in _read(part, item.sheet, places, rows)}
        reads.append(found - {number})
        volatile.append(any(isinstance(part, Call) and _is_volatile(part.name) for part in parts))
    excused = _spread(volatile, reads)
    return tuple(
        replace(item, follows=bool(reads[number]), excused=excused[number])
        for number, (item, _) in enumerate(differences)
    )


def _is_volatile(name: str) -> bool:
    row = FUNCTIONS.get(name)
    return row is not None and row.volatile


def _with_names(formula: Node, names: Mapping[str, Node]) -> Iterator[Node]:
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


def _read(part: Node, title: str, places: Mapping[Place, int], rows: Mapping[str, list[Place]]) -> list[Place]:
    """Cells that differ among those that a reference means."""
    if isinstance(part, CellRef):
        place = ((part.sheet or title).casefold(), part.row, part.col)
        return [place] if place in places else []
    if isinstance(part, RangeRef):
        start, end = part.start, part.end
        top, bottom = sorted((start.row, end.row))
        left, right = sorted((start.col, end.col))
        here = rows.get((start.sheet or title).casefold(), [])
        return [place for place in here if top <= place[1] <= bottom and left <= place[2] <= right]
    return []


def _spread(volatile: Sequence[bool], reads: Sequence[set[int]]) -> list[bool]:
    """Which differences volatile functions account for: their own, or those of all the differing cells they read."""
    excused = list(volatile)
    changed = True
    while changed:
        changed = False
        for number, read in enumerate(reads):
            if not excused[number] and read and all(excused[other] for other in read):
                excused[number] = changed = True
    return excused
