"""`audit`: one workbook against a mechanism."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import readable_name
from livesheet.formats import read
from livesheet.formula.nodes import Number
from mechsheet import reference
from mechsheet.homework.drawn_by_numbers import Picture, picture_of
from mechsheet.homework.expected_values import Truth
from mechsheet.homework.formula_strips import Work, upright
from mechsheet.homework.inputs import Input
from mechsheet.homework.judging import Judged, judged_tables
from mechsheet.homework.marking_rules import AskedFor, asked_of
from mechsheet.homework.mends.faults import Mend, Suspect
from mechsheet.homework.own_dimensions import changed_by, other_dimensions
from mechsheet.homework.remarks import remarks_of
from mechsheet.homework.rows_asked import over_asked_rows, rows_answered
from mechsheet.homework.series import Series
from mechsheet.homework.summaries import reading_of_number, span_of
from mechsheet.homework.two_way import where
from mechsheet.homework.understanding import Understanding
from mechsheet.homework.verdicts import Finding, Verdict
from mechsheet.model import Mechanism
from mechsheet.words.catalogue import said

MARKED = ("right", "follows", "not live")
"""Verdicts that have marks."""


@dataclass(frozen=True, slots=True)
class AskedResult:
    """One asked quantity: its cells and the verdict; `plain` without follow-through.

    share  the part of the rows asked for that its table answers
    """

    cells: str
    verdict: Verdict
    plain: Verdict
    share: float = 1.0


@dataclass(frozen=True, slots=True)
class FaultFound:
    """A fault: cells, the formula there, what would mend it ("" where no single change does), what that puts right."""

    cells: str
    formula: str
    mend: str
    rights: tuple[str, ...]
    kind: str


@dataclass(frozen=True, slots=True)
class Given:
    """A dimension that the sheet has: its cell, and its value in the description's own unit."""

    cell: str
    value: float


@dataclass(frozen=True, slots=True)
class Audit:
    """What was found in one workbook.

    of, plain, follow_through  marks: of how many, without and with those for what is right but for an earlier fault
    given   the dimensions that were found in its cells;  earned  the marks of each quantity, with follow-through
    picture of the mechanism by its own numbers, where some are wrong
    """

    file: str
    asked: Mapping[str, AskedResult]
    faults: tuple[FaultFound, ...]
    of: float
    plain: float
    follow_through: float
    remarks: tuple[str, ...]
    language: str = "en"
    given: Mapping[str, Given] = field(default_factory=dict)
    earned: Mapping[str, float] = field(default_factory=dict)
    picture: Picture | None = None

    @property
    def right(self) -> bool:
        """Whether all that is asked is right."""
        return all(one.verdict == "right" for one in self.asked.values())

    def as_dict(self) -> dict[str, Any]:
        """As JSON data."""
        return {
            "asked": {
                symbol: {"cells": one.cells, "verdict": one.verdict} | ({"share": one.share} if one.share < 1 else {})
                for symbol, one in self.asked.items()
            },
            "faults": [
                {"cells": f.cells, "formula": f.formula, "mend": f.mend, "rights": list(f.rights), "kind": f.kind}
                for f in self.faults
            ],
            "marks": {"of": self.of, "plain": self.plain, "follow_through": self.follow_through},
            "remarks": list(self.remarks),
        }


def audit(book: str | Path, mechanism: Mechanism, assembly: str = "", functions: Sequence[str | Path] = ()) -> Audit:
    """Find in a workbook that somebody made by hand the quantities that a description asks for, and the faults.

    book       .xlsx, .xlsm, .ods, .ots, .xls, laid out in any way
    mechanism  what it should be: `mechsheet.load(...)`; its dimensions are only what the sheet does not give itself
    assembly   "any": another assembly than the description's sketch is right, too
    functions  modules in Basic (.bas) whose functions the workbook calls

    The rows are the workbook's own; of a description with [exercise] they are to be those that it asks for.
    Raises WorkbookError where the file cannot be read, or holds no table of this mechanism.
    """
    path = Path(book)
    asks = mechanism.exercise is not None
    shown = readable_name(path)
    work = upright(read(path), modules=[Path(file) for file in functions])
    return audited(work, mechanism, asked_of(mechanism), shown, assembly == "any", all_rows=asks)


def audited(
    work: Work,
    mechanism: Mechanism,
    wanted: AskedFor,
    shown: str,
    any_assembly: bool = False,
    own_dimensions: bool = False,
    all_rows: bool = False,
) -> Audit:
    """The audit of a workbook that has been read.

    shown           what messages call it
    any_assembly    every assembly of the mechanism is right, not only the one that the description means
    own_dimensions  the mechanism has a student's own dimensions: another one in the sheet is a fault of its own
    all_rows        answers count as far as they cover the rows that the description asks for
    """
    parts = judged_tables(work, mechanism, wanted, shown)
    asked = {symbol: marks for symbol, marks in wanted.marks.items() if any(symbol in part.asked for part in parts)}
    found = {symbol: result for part in parts for symbol, result in _results(part).items()}
    results = {symbol: found[symbol] for symbol in asked}
    if any_assembly:
        live = {symbol: part.first[symbol].live for part in parts for symbol in part.asked}
        accepted: dict[str, Verdict] = {symbol: "right" if one else "not live" for symbol, one in live.items()}
        results = {
            symbol: replace(one, verdict=accepted[symbol], plain=accepted[symbol])
            if one.verdict == "other assembly"
            else one
            for symbol, one in results.items()
        }
    faults = [fault for part in parts for fault in _faults(part)]
    for part in parts if own_dimensions else ():
        others = other_dimensions(part.found)
        faults = [_other(part.found, one) for one in others] + faults
        for symbol in changed_by(part, others):
            if results[symbol].verdict == "right":
                results[symbol] = replace(results[symbol], verdict="follows", plain="wrong")
    covered = [rows_answered(part.found) for part in parts] if all_rows else []
    for part, rows in zip(parts, covered, strict=False):
        results |= _of_rows(part, results, rows)
    plain = _earned(asked, wanted, results, plainly=True)
    earned = _earned(asked, wanted, results)
    remarks = [text for part in parts for text in remarks_of(part, mechanism.language)]
    remarks += [
        said(mechanism.language, "remark.part", symbols=", ".join(lost), answered=int(rows.sum()), asked=len(rows))
        for part, rows in zip(parts, covered, strict=False)
        if (lost := [symbol for symbol in part.asked if results[symbol].share < 1])
    ]
    return Audit(
        shown,
        results,
        tuple(faults),
        sum(asked.values()),
        round(sum(plain.values()), 6),
        round(sum(earned.values()), 6),
        tuple(dict.fromkeys(remarks)),
        mechanism.language,
        _given(parts[0].found),
        earned,
        next(filter(None, map(picture_of, parts)), None),
    )


def _given(found: Understanding) -> dict[str, Given]:
    units = {dim.symbol: dim.unit for dim in found.mechanism.dimensions}
    return {
        one.symbol: Given(
            found.work.where(*one.place), float(units[one.symbol].to_shown(found.truth.dimensions[one.symbol]))
        )
        for one in found.inputs
    }


def _results(part: Judged) -> dict[str, AskedResult]:
    return {symbol: _result(part.found, part.first[symbol], part.last[symbol], part.mends) for symbol in part.asked}


def _faults(part: Judged) -> list[FaultFound]:
    faults = [_fault(part.found, mend) for mend in part.mends]
    if part.suspect is not None and not part.mends:
        faults.append(_unmended(part.found, part.suspect))
    return faults


def _result(found: Understanding, first: Finding, last: Finding, mends: Sequence[Mend]) -> AskedResult:
    """The verdict with the mends in place: a quantity whose own cells hold a fault stays wrong."""
    series = first.series or last.series
    cells = "" if series is None else where(found, series)
    verdict = first.verdict
    if verdict in ("wrong", "missing") and last.verdict == "right":
        verdict = "follows"
    if series is not None and any(_holds(series, mend) for mend in mends):
        verdict = "wrong"
    plain: Verdict = verdict if verdict != "follows" else "wrong"
    return AskedResult(cells, verdict, plain)


def _holds(series: Series, mend: Mend) -> bool:
    strip = mend.strip
    inside = series.origin < strip.end and strip.start < series.origin + series.rows
    return (series.sheet, series.line) == (strip.sheet, strip.line) and inside


def _of_rows(part: Judged, results: Mapping[str, AskedResult], rows: NDArray[np.bool_]) -> dict[str, AskedResult]:
    """What a table has marks for, where it does not answer all rows asked for; a summary is one of all these rows."""
    share = float(rows.mean())
    whole = over_asked_rows(part.found) if share < 1 else None
    found: dict[str, AskedResult] = {}
    for symbol in part.asked if share < 1 else ():
        one = results[symbol]
        if one.verdict in MARKED and not (whole is not None and _holds_over(part, symbol, whole)):
            partly: Verdict = "in part" if one.verdict == "right" else one.verdict
            plain: Verdict = "in part" if one.plain == "right" else one.plain
            found[symbol] = replace(one, verdict=partly, plain=plain, share=share)
    return found


def _holds_over(part: Judged, symbol: str, whole: Truth) -> bool:
    """Whether a single number is what is asked over all rows asked for, too."""
    finding = part.last[symbol] if part.first[symbol].verdict in ("wrong", "missing") else part.first[symbol]
    if symbol in whole.columns or finding.series is None:
        return False
    number = part.found.work.number(finding.series.places()[0])
    return reading_of_number(number, span_of(whole, symbol), whole.size, part.found.tolerance) is not None


def _earned(
    asked: Mapping[str, float], wanted: AskedFor, results: Mapping[str, AskedResult], plainly: bool = False
) -> dict[str, float]:
    """The marks of each quantity by its verdict and the rows that it answers. `plainly`: without follow-through."""
    parts = {"right": 1.0, "in part": 1.0, "not live": wanted.not_live}
    parts["follows"] = 1.0 if wanted.follow_through else 0.0
    verdicts = {symbol: one.plain if plainly else one.verdict for symbol, one in results.items()}
    return {
        symbol: round(marks * parts.get(verdicts[symbol], 0.0) * results[symbol].share, 6)
        for symbol, marks in asked.items()
    }


def _fault(found: Understanding, mend: Mend) -> FaultFound:
    work = found.work
    strip = mend.strip
    return FaultFound(
        work.where(strip.sheet, strip.start, strip.line, strip.length, mend.lines),
        work.shown(strip.formula, strip.sheet),
        work.shown(mend.formula, strip.sheet),
        mend.rights,
        mend.kind,
    )


def _other(found: Understanding, one: Input) -> FaultFound:
    """A dimension that is not the student's own."""
    dim = next(dim for dim in found.mechanism.dimensions if dim.symbol == one.symbol)
    own = reference.dimension_values(found.mechanism)[one.symbol]
    there, wanted = (f"{float(dim.unit.to_shown(value)):.10g}" for value in (found.truth.dimensions[one.symbol], own))
    return FaultFound(found.work.where(*one.place), there, wanted, (), "other dimension")


def _unmended(found: Understanding, suspect: Suspect) -> FaultFound:
    strip = suspect.strip
    cells = found.work.where(strip.sheet, strip.start, strip.line, strip.length)
    if isinstance(strip.formula, Number):
        there = f"{suspect.found:.10g}" if math.isfinite(suspect.found) else ""
        return FaultFound(cells, there, f"{suspect.wanted:.6g}", (), "wrong number" if there else "no number")
    return FaultFound(cells, found.work.shown(strip.formula, strip.sheet), "", (), "no single change mends it")
