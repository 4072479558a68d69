"""What a check found: comparisons, their running tally, and how far two values are apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Scalar
from livesheet.said import say, say_count

if TYPE_CHECKING:
    from livesheet.diagnostics import Fault
    from mechsheet.checking.stored import Stored

Array = NDArray[np.float64]

TOLERANCE = 1e-9
"""Largest difference that counts as agreement: of lengths as a part of the mechanism's size, of angles in radians."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """One judge's answers against the engine's.

    judge   "stored values", "reference", or the name of a program
    cells   how many values were compared
    worst   largest difference (lengths as a part of the size, angles in radians, other numbers relative), 0 if none
    where   cell and quantity of the worst difference;  ours, theirs  the two values there
    agrees  nothing differs by more than the tolerance, and errors stand in the same cells
    subject whose values `ours` are
    """

    judge: str
    cells: int
    worst: float = 0.0
    where: str = ""
    ours: str = ""
    theirs: str = ""
    agrees: bool = True
    subject: str = "engine"


@dataclass(frozen=True, slots=True)
class Edit:
    """A place in a workbook that is not as its description would build it.

    kind   "changed" a formula is another one; "out of its run" so it is in a part of a filled range; "overwritten" a
           constant stands in its place; "emptied" nothing does; "formula" one stands in the place of an input; "value" a
           number that is no input; "name", "sheet" changed or missing; "deleted" rows or columns,
           "inserted" so inside a filled range
    where  the range, the name, or the sheet;  was, now  formulas or values there
    note   what else there is to say of the place
    """

    kind: str
    where: str
    was: str
    now: str
    note: str = ""


@dataclass(frozen=True, slots=True)
class Report:
    """What `check` found in one file.

    edits    what somebody changed that is not there to be changed
    remarks  what a person should know (an input that was changed, a mode that was flipped …)
    stored   the stored values, cell by cell
    missing  programs that were asked for and are not there, with what to install: the check is not what was asked for
    red_line   what the line under the title of a workbook of ours says where it is red
    nameless   whether it is a workbook of ours without its description: there is nothing to compare it with
    stale      what the description file of its name says otherwise than the description it was built from
    """

    file: str
    comparisons: tuple[Comparison, ...]
    remarks: tuple[str, ...] = ()
    edits: tuple[Edit, ...] = ()
    stored: Stored | None = None
    missing: tuple[Fault, ...] = ()
    red_line: str = ""
    nameless: bool = False
    stale: str = ""

    @property
    def values_agree(self) -> bool:
        """True when all judges agree."""
        return all(comparison.agrees for comparison in self.comparisons)

    @property
    def agrees(self) -> bool:
        """True when all judges agree, nothing was edited but inputs, the workbook itself calls nothing wrong, and it
        is the one that its description builds."""
        return self.values_agree and not (self.edits or self.red_line or self.stale)

    @property
    def compared(self) -> bool:
        """Whether any judge has compared anything."""
        return any(comparison.cells for comparison in self.comparisons)

    @property
    def unjudged(self) -> list[str]:
        """What keeps an agreement from being one of the whole workbook."""
        found: list[str] = [
            say("no value is stored") if comparison.judge == "stored values" else
            say("nothing was compared: {judge}", judge=say(comparison.judge))
            for comparison in self.comparisons
            if not comparison.cells
        ]  # fmt: skip
        if self.stored is not None and (count := self.stored.not_computed):
            found.append(say_count("{count} cell was not computed", "{count} cells were not computed", count))
        if self.nameless:
            found.append(say("it carries no description"))
        return found

    def _repr_pretty_(self, printer: Any, _cycle: bool) -> None:
        """Its lines, for notebooks: what `mechsheet check` prints."""
        from mechsheet.checking.report_lines import report_lines

        printer.text("\n".join(report_lines(self)))

    def as_dict(self) -> dict[str, Any]:
        """The report as JSON data."""
        return {
            "file": self.file,
            "agrees": self.agrees,
            "unjudged": list(map(str, self.unjudged)),
            "red line": self.red_line,
            "stale": self.stale,
            "remarks": list(self.remarks),
            "edits": [
                {"kind": edit.kind, "where": edit.where, "was": edit.was, "now": edit.now} for edit in self.edits
            ],
            "comparisons": [
                {
                    "judge": item.judge,
                    "cells": item.cells,
                    "worst": item.worst,
                    "where": item.where,
                    "ours": item.ours,
                    "theirs": item.theirs,
                    "agrees": item.agrees,
                }
                for item in self.comparisons
            ],
            "stored": self.stored.as_dict() if self.stored is not None else None,
            "missing": [fault.message for fault in self.missing],
        }


@dataclass
class Tally:
    """The running worst of a comparison."""

    judge: str
    cells: int = 0
    worst: float = -1.0
    where: str = ""
    ours: str = ""
    theirs: str = ""
    agrees: bool = True
    tolerance: float = TOLERANCE

    def note(self, difference: float, where: str, ours: Scalar, theirs: Scalar) -> None:
        """Count one pair; NaN or infinity is a difference in kind (a number against an error)."""
        self.cells += 1
        if not math.isfinite(difference):
            difference = math.inf
        if difference > self.tolerance:
            self.agrees = False
        if difference > self.worst:
            self.worst, self.where = difference, where
            self.ours, self.theirs = text_of(ours), text_of(theirs)

    def note_column(self, symbol: str, apart: Array, address: Callable[[int], str], ours: Array, theirs: Array) -> None:
        """Count a column, and note the row where the two are farthest apart; `address`: the cell in a row."""
        self.cells += len(apart) - 1
        row = int(np.argmax(apart))
        self.note(float(apart[row]), f"{address(row)} ({symbol}, row {row})", float(ours[row]), float(theirs[row]))

    def result(self) -> Comparison:
        """The finished comparison."""
        return Comparison(self.judge, self.cells, max(self.worst, 0.0), self.where, self.ours, self.theirs, self.agrees)


def text_of(value: Scalar) -> str:
    """A value as a report shows it: numbers with all digits, nothing for an empty cell."""
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    return repr(value) if isinstance(value, float) else str(value)
