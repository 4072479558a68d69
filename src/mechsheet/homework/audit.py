"""`audit`: one workbook against a mechanism: what it has marks for, its faults, and both in words.

Of an exercise it is also asked how many of the rows wanted the workbook's own rows answer, and which of a student's own
dimensions are others in the sheet.
"""

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
from mechsheet.homework.agreement import Reading, gaps
from mechsheet.homework.drawn_by_numbers import Picture, picture_of
from mechsheet.homework.expected_values import Array, AskedFor, Truth, asked_of, driver_asked, truth_of
from mechsheet.homework.formula_strips import Work, upright
from mechsheet.homework.inputs import Input
from mechsheet.homework.judging import Judged, judged_tables
from mechsheet.homework.mends.faults import Mend, Suspect
from mechsheet.homework.remarks import remarks_of
from mechsheet.homework.summaries import reading_of_number, span_of
from mechsheet.homework.understanding import Understanding, where
from mechsheet.homework.verdicts import Finding, Verdict
from mechsheet.model import Mechanism
from mechsheet.words.catalogue import is_key, marks_of, said

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
    if series is not None and any(series.cells.meets(mend.strip) for mend in mends):
        verdict = "wrong"
    plain: Verdict = verdict if verdict != "follows" else "wrong"
    return AskedResult(cells, verdict, plain)


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
    number = part.found.work.number(finding.series.cells.places()[0])
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
        strip.where(work, mend.lines),
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
    cells = strip.where(found.work)
    if isinstance(strip.formula, Number):
        there = f"{suspect.found:.10g}" if math.isfinite(suspect.found) else ""
        return FaultFound(cells, there, f"{suspect.wanted:.6g}", (), "wrong number" if there else "no number")
    return FaultFound(cells, found.work.shown(strip.formula, strip.sheet), "", (), "no single change mends it")


# --- in words --------------------------------------------------------------------------------------------------------


def audit_lines(audit: Audit) -> list[str]:
    """A line for each asked quantity, then faults, marks and remarks."""
    wide = max((len(symbol) for symbol in audit.asked), default=0)
    cells = max((len(one.cells) for one in audit.asked.values()), default=0)
    found = [
        f"{symbol:<{wide}}  {one.cells:<{cells}}  {said(audit.language, one.verdict)}".rstrip()
        for symbol, one in audit.asked.items()
    ]
    found += [fault_line(fault, audit.language) for fault in audit.faults]
    marks = marks_of(audit.language, audit.follow_through, audit.of)
    if audit.plain != audit.follow_through:
        marks += f" ({said(audit.language, 'marks.plain', plain=f'{audit.plain:g}')})"
    found.append(marks)
    found += [said(audit.language, "remark", text=text) for text in audit.remarks]
    return found


def fault_line(fault: FaultFound, language: str) -> str:
    """`Sayfa1!B13:B31  RADIANS(A13)-Alfa1: a term too many; RADIANS(A13) makes theta13, theta15 right`."""
    text = said(language, "fault", cells=fault.cells, formula=fault.formula, kind=kind_words(fault.kind, language))
    if fault.mend:
        key = "mend" if fault.rights else "mend.wanted"
        text += "; " + said(language, key, mend=fault.mend, rights=", ".join(fault.rights))
    return text


def kind_words(kind: str, language: str) -> str:
    """A kind of fault in a language."""
    return said(language, kind) if is_key(f"homework.{kind}") else kind


# --- own dimensions of a student -------------------------------------------------------------------------------------


OTHER = 1e-3
"""A number that differs by more than this part of a dimension is another one, not the same one rounded."""


def is_other(value: float, own: float) -> bool:
    """Whether a number is another one than a student's own."""
    return abs(value - own) > OTHER * max(abs(own), 1e-12)


def other_dimensions(found: Understanding) -> list[Input]:
    """The cells whose values are not the mechanism's own."""
    own = reference.dimension_values(found.mechanism)
    derived = {dim.symbol for dim in found.mechanism.dimensions if dim.derived}
    return [
        one
        for one in found.inputs
        if one.symbol not in derived and is_other(found.truth.dimensions[one.symbol], own[one.symbol])
    ]


def changed_by(judged: Judged, others: Sequence[Input]) -> list[str]:
    """The asked quantities that have other values with the mechanism's own dimensions; all where that has no position."""
    if not others:
        return []
    found, truth = judged.found, judged.truth
    own = truth_of(found.mechanism, {}, truth.driver, truth.poses)
    if own is None:
        return list(judged.asked)
    changed = []
    for symbol in judged.asked:
        if symbol in truth.columns:
            quantity = own.quantity(symbol)
            apart = gaps(truth.columns[symbol], quantity, Reading()).max(initial=0.0) > found.allowed(quantity)
        else:
            one, other = span_of(truth, symbol), span_of(own, symbol)
            apart = abs(one.high - other.high) + abs(one.low - other.low) > found.tolerance * max(
                abs(other.high), 1e-12
            )
        if apart:
            changed.append(symbol)
    return changed


# --- the rows asked for ----------------------------------------------------------------------------------------------


COARSE = 2.0
"""Between two rows of a sheet what is asked is answered when they are no farther apart than so many of the steps asked for:
a step of 20 degrees in place of 15 is the sheet's own business, one of 90 is not."""
EXACT = 1e-6
"""Steps that agree to this part of them are equal."""


def rows_answered(found: Understanding) -> NDArray[np.bool_]:
    """Which of the rows that the description asks for, with the sheet's dimensions, a table answers; with dimensions that
    give no rows its own count."""
    asked = driver_asked(found.truth.mechanism, found.truth.dimensions)
    if asked is None:
        return np.ones(1, bool)
    return answered(asked, found.truth.driver, not found.mechanism.driver.joint)


def over_asked_rows(found: Understanding) -> Truth | None:
    """The mechanism of the sheet in the rows that the description asks for."""
    asked = driver_asked(found.truth.mechanism, found.truth.dimensions)
    truth = found.truth
    return None if asked is None else truth_of(truth.mechanism, truth.dimensions, asked, truth.poses)


def answered(asked: Array, given: Array, turns: bool) -> NDArray[np.bool_]:
    """Which of the values asked for the `given` rows answer: those that are within half a step of one, or between two that
    are at most COARSE steps apart. `turns`: an angle may be given a whole turn away, and 0 is 360 of a whole turn."""
    step = _steps(asked) * (1 + EXACT)
    ordered = np.unique(given)
    if not turns:
        return _near(asked, ordered, step)
    if np.ptp(ordered) >= math.tau - COARSE * float(step.min()):
        once = np.remainder(ordered, math.tau)
        around = np.unique(np.concatenate([once - math.tau, once, once + math.tau]))
        return _near(np.remainder(asked, math.tau), around, step)
    away = math.tau * round(float(np.mean(asked) - np.mean(ordered)) / math.tau)
    return max((_near(asked, ordered + turn, step) for turn in (0.0, away)), key=np.count_nonzero)


def _near(asked: Array, ordered: Array, step: Array) -> NDArray[np.bool_]:
    after = np.searchsorted(ordered, asked)
    below = ordered[np.maximum(after - 1, 0)]
    above = ordered[np.minimum(after, len(ordered) - 1)]
    nearest = np.minimum(np.abs(asked - below), np.abs(above - asked))
    between = (below <= asked) & (asked <= above) & (above - below <= COARSE * step)
    return np.asarray(between | (nearest <= step / 2))


def _steps(asked: Array) -> Array:
    """The step at each of the values asked for: the larger of those to the values beside it; one value has every other."""
    ordered = np.unique(asked)
    if len(ordered) < 2:
        return np.full(len(asked), math.inf)
    gaps = np.diff(ordered)
    at = np.searchsorted(ordered, asked)
    steps: Array = np.maximum(gaps[np.maximum(at - 1, 0)], gaps[np.minimum(at, len(gaps) - 1)])
    return steps
