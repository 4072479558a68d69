"""A recalculated workbook against the values stored in its file: which cells differ, and which of them came first.

This is the one judgement of stored values: `check` and `recalc --check` both ask `judge_stored`.

A cell follows when its stored value is what its formula gives for the stored values of the cells it reads (`following`).
When all cells of a file follow, its stored values are a solution of its formulas: what differs then is rounding that grew.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault
from livesheet.engine import steady_plan
from livesheet.formula.book import Block, Book, BookSheet, Run
from livesheet.formula.nodes import (
    Binary,
    Call,
    ErrorValue,
    Node,
    Scalar,
    Unary,
    shifted,
    walk,
)
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_address
from livesheet.said import say
from mechsheet.checking.cells_apart import Ignored, Rounding, Rules, ignored_in, texts_apart, unmeant
from mechsheet.checking.comparison import Comparison, text_of
from mechsheet.checking.following import Suspect, explained

JUDGE = "stored values"
"""What the stored values are called among the judges."""

LIBREOFFICE = "LibreOffice"

WRITTEN = 1e-20
"""LibreOffice writes numbers into .ods with twenty decimals: what rounding leaves of a force of 0 loses digits there."""

COMPUTE_ANEW = say(
    "saved by LibreOffice without being computed: open the file there, press Ctrl+Shift+F9, save it again"
)


@dataclass(frozen=True, slots=True)
class Difference:
    """A cell whose stored value is not the one computed.

    kind      "number", "text", "type" (a number against a text ...), "error" (an error against a value), "which error"
    size      relative difference of two numbers, infinity for what differs in kind
    functions of its formula, outermost first; "" when it has none
    follows   whether the stored value is what the formula gives for the stored values of the cells it reads: then it is
              not at fault, they are
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
    kept         cells that cannot be computed (another workbook, an unknown function) and whose stored values were taken
    volatile     cells with NOW, TODAY, RAND and their like: their stored values were taken too
    ignored      cells that the rules leave out;  accepted  differences that a baseline accepts
    uncomputed   cells that LibreOffice saved without computing them
    worst        largest relative difference of two numbers that count as equal
    differences  in the order of sheets, columns and rows
    sheets       titles of the sheets with formulas
    remarks      what could not be computed as it is meant, with its cells
    unmeant      what was to be ignored and means no cells of this workbook
    unsure       numbers of the blocks whose values the workbook alone does not say, and of those that depend on them
    """

    formulas: int
    equal: int
    unstored: int
    kept: int
    volatile: int = 0
    ignored: int = 0
    accepted: int = 0
    uncomputed: tuple[str, ...] = ()
    worst: float = 0.0
    differences: tuple[Difference, ...] = ()
    sheets: tuple[str, ...] = ()
    remarks: tuple[Fault, ...] = ()
    unmeant: dict[str, Fault] = field(default_factory=dict)
    unsure: frozenset[int] = frozenset()

    @property
    def agrees(self) -> bool:
        """True when every stored value is what its formula gives for the stored values that it reads."""
        return all(item.follows for item in self.differences)

    @property
    def nothing_stored(self) -> bool:
        """Whether there are formulas, and no value is stored for any of them: then nothing was compared."""
        return self.unstored == self.formulas > 0

    @property
    def not_computed(self) -> int:
        """Cells of which nothing says whether they are right: those kept, and those saved without being computed."""
        return self.kept + len(self.uncomputed)

    @property
    def doubts(self) -> tuple[Fault, ...]:
        """What cannot be computed as it is meant; what changes by itself is computed as it is meant."""
        return tuple(fault for fault in self.remarks if fault.doubtful)

    def own(self) -> list[Difference]:
        """The differences that follow from no other."""
        return [item for item in self.differences if not item.follows]

    def groups(self) -> list[Group]:
        """The differences that follow from no other, the largest groups first."""
        key = lambda item: (item.functions, item.kind)  # noqa: E731
        groups = [
            (functions, kind, list(items)) for (functions, kind), items in groupby(sorted(self.own(), key=key), key=key)
        ]
        groups.sort(key=lambda group: (-len(group[2]), group[0], group[1]))
        return [Group(f, kind, len(items), max(items, key=lambda item: item.size)) for f, kind, items in groups]

    def comparison(self) -> Comparison:
        """The same as one judge's answers among others."""
        own = self.own()
        cells = self.formulas - self.unstored
        if not own:
            return Comparison(JUDGE, cells, self.worst)
        worst = max(own, key=lambda item: item.size)
        theirs = (text_of(worst.ours), text_of(worst.theirs))
        return Comparison(JUDGE, cells, worst.size, worst.address, *theirs, agrees=False)

    def as_dict(self) -> dict[str, Any]:
        """The findings as JSON data."""
        return {
            "agrees": self.agrees,
            "formulas": self.formulas,
            "equal": self.equal,
            "without a stored value": self.unstored,
            "kept": self.kept,
            "volatile": self.volatile,
            "ignored": self.ignored,
            "accepted": self.accepted,
            "uncomputed": list(self.uncomputed),
            "remarks": [
                {"cells": fault.key, "message": fault.message, "hint": fault.hint, "about": fault.about}
                for fault in self.remarks
            ],
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
                }
                for item in self.differences
            ],
        }


def _json_size(size: float) -> float | None:
    return size if math.isfinite(size) else None


def judge_stored(book: Book, rules: Rules | None = None) -> tuple[Stored, Any]:
    """Compute a book anew and compare with what its file holds; with the values computed.

    Volatile functions keep their stored values, so that what reads them can be judged.
    """
    plan = steady_plan(book)
    values = plan.evaluate()
    own, reached = plan.unsure()
    found = compare_with_stored(book, values, rules or Rules(), own, plan.resolved.unsteady)
    return replace(found, remarks=(*book.remarks, *values.remarks), unsure=reached), values


def compare_with_stored(
    book: Book, values: Any, rules: Rules, unsure: Collection[int] = (), unsteady: Collection[int] = ()
) -> Stored:
    """The values computed against those stored in the file `book` was read from.

    unsure    numbers of blocks that are not judged;  unsteady  those of them that hold volatile functions
    """
    work = _Comparing(book, values, rules)
    number = 0
    for sheet in book.sheets:
        for block in sheet.blocks:
            if number in unsteady:
                work.counts["volatile"] += block.rows * block.cols
            elif number in unsure:
                work.counts["kept"] += work.stored_in(sheet, block)
            else:
                for col in range(block.col, block.col + block.cols):
                    work.column(sheet, block, col)
            work.counts["in blocks"] += work.stored_in(sheet, block)
            number += 1
        work.counts["stored"] += sum(len(run.values) for runs in sheet.cached.columns.values() for run in runs)
    return work.result()


class _Comparing:
    """A comparison while it runs."""

    def __init__(self, book: Book, values: Any, rules: Rules) -> None:
        self.book, self.values, self.rules = book, values, rules
        self.ignored: Ignored = ignored_in(book, rules.ignore)
        self.rounding = Rounding(book, values)
        self.counts: Counter[str] = Counter()
        self.worst = 0.0
        self.found: list[tuple[Difference, Suspect]] = []
        self.libreoffice = LIBREOFFICE in book.program
        self.ods = Path(book.source).suffix.lower() in (".ods", ".ots")

    def stored_in(self, sheet: BookSheet, block: Block) -> int:
        """How many cells of a block have a stored value."""
        last = block.row + block.rows - 1
        columns = (sheet.cached.columns.get(col, ()) for col in range(block.col, block.col + block.cols))
        return sum(max(0, min(run.end, last + 1) - max(run.row, block.row)) for runs in columns for run in runs)

    def column(self, sheet: BookSheet, block: Block, col: int) -> None:
        """One column of a block."""
        first, last = block.row, block.row + block.rows - 1
        ours: list[Scalar] = self.values.column(sheet.title, col, first, last)
        theirs = _values(sheet.cached.columns.get(col, ()), first, last)
        for title, row, at in self.values.kept:  # not computed: nothing says whether what is stored is right
            if (title, at) == (sheet.title, col) and first <= row <= last and theirs[row - first] is not None:
                ours[row - first] = theirs[row - first] = 0.0
                self.counts["formulas"] -= 1
                self.counts["kept"] += 1
        if self.ignored.areas:
            left_out = [row for row in range(first, last + 1) if self.ignored.has(sheet.title, row, col)]
            self.counts["ignored"] += len(left_out)
            self.counts["formulas"] -= len(left_out)
            for row in left_out:
                ours[row - first] = theirs[row - first] = 0.0
        self.counts["formulas"] += block.rows
        self.counts["unstored"] += theirs.count(None)
        if ours == theirs and list(map(type, ours)) == list(map(type, theirs)):
            return
        for row, (mine, other) in enumerate(zip(ours, theirs, strict=True), first):
            if other is not None and not (type(mine) is type(other) and mine == other):
                self.cell(sheet, block, (row, col), mine, other)

    def cell(self, sheet: BookSheet, block: Block, place: tuple[int, int], ours: Scalar, theirs: Scalar) -> None:
        """One cell whose values are not the same to the last bit."""
        kind, size = self.apart(ours, theirs)
        if not kind and size <= self.worst:
            return
        row, col = place
        filled = block.kind == "fill"
        formula = shifted(block.formula, row - block.row, col - block.col) if filled else block.formula
        if self.rounding.accounts_for(formula, sheet.title, ours, theirs):
            return
        if not kind:
            self.worst = size
            return
        difference = Difference(
            sheet.title, row, col, kind, size, ours, theirs, _functions(formula), print_formula(formula)
        )
        self.found.append((difference, Suspect(sheet.title, row, col, block, theirs)))

    def apart(self, ours: Scalar, theirs: Scalar) -> tuple[str, float]:
        """(kind, size) of the difference of two values; kind "" when they count as equal."""
        if isinstance(ours, ErrorValue) or isinstance(theirs, ErrorValue):
            both = isinstance(ours, ErrorValue) and isinstance(theirs, ErrorValue)
            # LibreOffice's files have fewer kinds of errors than Excel's.
            same = both and (self.ods or self.libreoffice or str(ours).upper() == str(theirs).upper())
            return ("", 0.0) if same else ("which error" if both else "error", math.inf)
        if isinstance(ours, bool | float) and isinstance(theirs, bool | float):
            if isinstance(ours, bool) is not isinstance(theirs, bool):  # LibreOffice has no type for truth values
                return ("", 0.0) if ours == theirs else ("type", math.inf)
            gap = abs(ours - theirs)
            size = gap / max(abs(ours), abs(theirs), 5e-324)
            unwritten = self.libreoffice and self.ods and gap <= WRITTEN
            return ("" if size <= self.rules.relative or gap <= self.rules.absolute or unwritten else "number"), size
        if (ours is None or ours == "") and theirs == "":
            return "", 0.0
        if isinstance(ours, str) and isinstance(theirs, str):
            size = 0.0 if ours == theirs else texts_apart(ours, theirs)
            return ("" if size <= self.rules.relative else "text"), size
        return "type", math.inf

    def is_uncomputed(self, item: Difference) -> bool:
        """Whether LibreOffice has saved a cell without computing it: it writes 0 then."""
        return self.libreoffice and not item.follows and item.kind in ("type", "error") and item.theirs == 0.0

    def result(self) -> Stored:
        """What was found, with what follows from what."""
        follows = explained(self.book, self.values, [suspect for _, suspect in self.found], self.apart)
        judged = [replace(item, follows=known) for (item, _), known in zip(self.found, follows, strict=True)]
        differences = [item for item in judged if not self.is_uncomputed(item)]
        uncomputed = tuple(item.address for item in judged if self.is_uncomputed(item))
        # where nothing is at fault, what differs is rounding that grew on its way
        differences = [] if all(item.follows for item in differences) else differences
        counts = self.counts
        return Stored(
            counts["formulas"],
            counts["formulas"] - counts["unstored"] - len(differences) - len(uncomputed),
            counts["unstored"],
            counts["kept"] + max(counts["stored"] - counts["in blocks"], 0),
            counts["volatile"],
            counts["ignored"],
            uncomputed=uncomputed,
            worst=self.worst,
            differences=tuple(differences),
            sheets=tuple(sheet.title for sheet in self.book.sheets if sheet.blocks),
            unmeant=unmeant(self.book, self.rules.ignore),
        )


def _values(runs: Sequence[Run], first: int, last: int) -> list[Scalar]:
    """The values of rows first..last of a column, None where there is none."""
    found: list[Scalar] = [None] * (last - first + 1)
    for run in runs:
        start, stop = max(run.row, first), min(run.end, last + 1)
        if start < stop:
            found[start - first : stop - first] = run.values[start - run.row : stop - run.row]
    return found


def _functions(formula: Node) -> str:
    """The functions of a formula, outermost first, at most three; the operators of one without functions."""
    names = list(dict.fromkeys(part.name for part in walk(formula) if isinstance(part, Call)))
    if names:
        return ", ".join(names[:3])
    return " ".join(_operators(formula))


def _operators(formula: Node) -> Iterator[str]:
    yield from dict.fromkeys(part.op for part in walk(formula) if isinstance(part, Binary | Unary))
