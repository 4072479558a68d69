"""`audit`: one workbook against a mechanism."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mechsheet import reference
from mechsheet.diagnostics import WorkbookError, readable_name
from mechsheet.formats import read
from mechsheet.homework.faults import Mend, Suspect, first_wrong, many, mended_sheet
from mechsheet.homework.inputs import Input
from mechsheet.homework.marking_rules import AskedFor, asked_of
from mechsheet.homework.own_dimensions import changed_by, other_dimensions
from mechsheet.homework.remarks import Judged, remarks_of
from mechsheet.homework.series import Series
from mechsheet.homework.thinned import thinned
from mechsheet.homework.trial import Effort
from mechsheet.homework.truth import Truth, other_assemblies, without_limits
from mechsheet.homework.understanding import Understanding, understand
from mechsheet.homework.upright import Work, upright
from mechsheet.homework.verdicts import Finding, Sheet, Verdict, findings, with_liveness
from mechsheet.model import Mechanism
from mechsheet.words.homework import HOMEWORK, said


@dataclass(frozen=True, slots=True)
class AskedResult:
    """One asked quantity: its cells and the verdict; `plain` without follow-through."""

    cells: str
    verdict: Verdict
    plain: Verdict


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

    @property
    def right(self) -> bool:
        """Whether all that is asked is right."""
        return all(one.verdict == "right" for one in self.asked.values())

    def as_dict(self) -> dict[str, Any]:
        """As JSON data."""
        return {
            "asked": {symbol: {"cells": one.cells, "verdict": one.verdict} for symbol, one in self.asked.items()},
            "faults": [
                {"cells": f.cells, "formula": f.formula, "mend": f.mend, "rights": list(f.rights), "kind": f.kind}
                for f in self.faults
            ],
            "marks": {"of": self.of, "plain": self.plain, "follow_through": self.follow_through},
            "remarks": list(self.remarks),
        }


def audit(book: str | Path, mechanism: Mechanism, assembly: str = "") -> Audit:
    """Find in a workbook that somebody made by hand the quantities that a description asks for, and the faults.

    book       .xlsx, .xlsm, .ods, .ots, .xls, laid out in any way
    mechanism  what it should be: `mechsheet.load(...)`; its dimensions are only what the sheet does not give itself
    assembly   "any": another assembly than the description's sketch is right, too

    Raises WorkbookError where the file cannot be read, or holds no table of this mechanism.
    """
    path = Path(book)
    return audited(upright(read(path)), mechanism, asked_of(mechanism), readable_name(path), assembly == "any")


def audited(
    work: Work,
    mechanism: Mechanism,
    wanted: AskedFor,
    shown: str,
    any_assembly: bool = False,
    own_dimensions: bool = False,
) -> Audit:
    """The audit of a workbook that has been read.

    shown           what messages call it
    own_dimensions  the mechanism has a student's own dimensions: another one in the sheet is a fault of its own
    """
    judged = _judged(work, mechanism, wanted, shown)
    asked, first, last, mends = judged.asked, judged.first, judged.last, judged.mends
    results = {symbol: _result(judged.found, first[symbol], last[symbol], mends) for symbol in asked}
    if any_assembly:
        results = {s: replace(r, verdict="right") if r.verdict == "other assembly" else r for s, r in results.items()}
    faults = [_fault(judged.found, mend) for mend in mends]
    if judged.suspect is not None and not mends:
        faults.append(_unmended(judged.found, judged.suspect))
    if own_dimensions:
        others = other_dimensions(judged.found)
        faults = [_other(judged.found, one) for one in others] + faults
        for symbol in changed_by(judged, others):
            if results[symbol].verdict == "right":
                results[symbol] = replace(results[symbol], verdict="follows", plain="wrong")
    plain = _earned(asked, wanted, {symbol: one.plain for symbol, one in results.items()})
    earned = _earned(asked, wanted, {symbol: one.verdict for symbol, one in results.items()})
    return Audit(
        shown,
        results,
        tuple(faults),
        sum(asked.values()),
        round(sum(plain.values()), 6),
        round(sum(earned.values()), 6),
        tuple(remarks_of(judged, mechanism.language)),
        mechanism.language,
        _given(judged.found),
        earned,
    )


def _found_once(mechanism: Mechanism) -> Mechanism:
    """A mechanism with dimensions found from a task, as numbers: a sheet may have them typed, as they were found."""
    given = reference.dimension_values(mechanism)
    found = tuple(
        dim if dim.place or isinstance(dim.value, float) else replace(dim, value=given[dim.symbol], written="")
        for dim in mechanism.dimensions
    )
    return replace(mechanism, dimensions=found)


def _given(found: Understanding) -> dict[str, Given]:
    units = {dim.symbol: dim.unit for dim in found.mechanism.dimensions}
    return {
        one.symbol: Given(
            found.work.where(*one.place), float(units[one.symbol].to_shown(found.truth.dimensions[one.symbol]))
        )
        for one in found.inputs
    }


@dataclass(frozen=True, slots=True)
class _Seen:
    """A workbook understood, before faults are looked for; the parts as `Judged` has them."""

    sheet: Sheet
    truth: Truth
    asked: Mapping[str, float]
    first: dict[str, Finding]
    unusual: bool

    @property
    def right(self) -> int:
        """How many asked quantities are right."""
        return sum(one.verdict == "right" for one in self.first.values())


def _judged(work: Work, mechanism: Mechanism, wanted: AskedFor, shown: str) -> Judged:
    """Everything found in a workbook."""
    effort = Effort()
    try:
        seen = _seen(work, mechanism, wanted)
        other = None
        if mechanism.synthesis is not None and seen.right < len(seen.first):
            other = _seen(work, _found_once(mechanism), wanted)
        judged = _of_both(seen, other, effort) if other is not None else _with_mends(seen, effort)
        if not judged.promising:
            unusual = _seen(work, mechanism, wanted, unusual=True)
            if unusual.right:
                judged = _with_mends(unusual, effort)
    except WorkbookError as error:
        raise _told(error, mechanism, shown) from error
    return judged


def _of_both(typed: _Seen, computed: _Seen, effort: Effort) -> Judged:
    """A sheet read with the dimensions of a task typed, or computed: as more is right. A fault can leave nothing right
    either way, and any number near a dimension may be taken for it: then as more is right with mends, computed first."""
    if typed.right != computed.right:
        return _with_mends(max(typed, computed, key=lambda one: one.right), effort)
    judged = _with_mends(computed, effort)
    if all(one.verdict == "right" for one in judged.last.values()):
        return judged
    return max(
        _with_mends(typed, Effort()), judged, key=lambda one: sum(f.verdict == "right" for f in one.last.values())
    )


def _seen(work: Work, mechanism: Mechanism, wanted: AskedFor, unusual: bool = False) -> _Seen:
    """A workbook understood. `unusual`: the driver may be counted clockwise, or from another zero."""
    found = understand(work, mechanism, list(wanted.marks), wanted.tolerance, unusual)
    asked = _moving(found, wanted)
    sheet = Sheet(found, list(asked))
    first = findings(sheet)
    if any(one.verdict != "right" for one in first.values()):
        # a fault may hide what the sheet has in rows at a limit: a mend is not held against them
        found = replace(found, truth=without_limits(found.truth))
        sheet = Sheet(found, list(asked))
        first = findings(sheet)
    truth, first = _assembly(sheet, first)
    return _Seen(sheet, truth, asked, first, unusual)


def _with_mends(seen: _Seen, effort: Effort) -> Judged:
    """Mends, where something is wrong; what is right and does not follow the dimensions."""
    found, first, truth = seen.sheet.found, seen.first, seen.truth
    start = {s: replace(f, verdict="right") if f.verdict == "other assembly" else f for s, f in first.items()}
    if seen.unusual:
        mends, last_sheet, last = list[Mend](), seen.sheet, start
    else:
        mends, last_sheet, last = _mends(seen.sheet, truth, start, effort)
    suspect = None
    if any(one.verdict == "wrong" for one in last.values()):
        suspect = first_wrong(last_sheet, truth, last)
    if truth is found.truth and found.mechanism.synthesis is None:  # lengths that a task gives have no say of their own
        first = with_liveness(found, first)
    return Judged(found, truth, seen.asked, first, last, mends, suspect, seen.unusual)


def _mends(
    sheet: Sheet, truth: Truth, start: dict[str, Finding], effort: Effort
) -> tuple[list[Mend], Sheet, dict[str, Finding]]:
    """As `many`; of a long table the mends are looked for in a part of its rows."""
    wrong = any(one.verdict in ("wrong", "missing") for one in start.values())
    part = thinned(sheet.found, truth) if wrong else None
    if part is None:
        return many(sheet, truth, start, effort)
    small = Sheet(part.found, sheet.asked)
    found, _, _ = many(small, part.truth, findings(small, part.truth), effort)
    mends: list[Mend] = []
    for mend in found:
        whole = part.back(mend, sheet.found.work)
        if whole is not None:
            mends.append(whole)
            sheet = mended_sheet(sheet, whole.strip, whole.formula)
    return mends, sheet, findings(sheet, truth) if mends else start


def _moving(found: Understanding, wanted: AskedFor) -> dict[str, float]:
    """What is asked, without what does not move and nobody has asked for by name."""
    exercise = found.mechanism.exercise
    explicit = exercise.asked if exercise is not None else {}
    return {
        symbol: marks
        for symbol, marks in wanted.marks.items()
        if symbol not in found.truth.columns
        or symbol in explicit
        or found.truth.quantity(symbol).moves(found.truth.size)
    }


def _assembly(sheet: Sheet, first: dict[str, Finding]) -> tuple[Truth, dict[str, Finding]]:
    """The assembly that the sheet shows, and its findings: another one where all that is there is right for it."""
    base = sheet.found.truth
    there = [symbol for symbol, finding in first.items() if finding.verdict != "missing"]
    if all(first[symbol].verdict == "right" for symbol in there):
        return base, first
    for truth in other_assemblies(base):
        found = findings(sheet, truth)
        if all(_as_right(found[symbol], first[symbol]) for symbol in there):
            return truth, {
                symbol: replace(one, verdict="other assembly")
                if one.verdict == "right" and first[symbol].verdict != "right"
                else first[symbol]
                for symbol, one in found.items()
            }
    return base, first


def _as_right(other: Finding, own: Finding) -> bool:
    """Whether a quantity is right for another assembly, and not less plainly so than for the description's own: what is
    plainly right for that in its column is not of another one because some other column holds what it would be there."""
    if other.verdict != "right" or other.reading is None:
        return False
    if own.verdict != "right" or own.reading is None or not own.reading.plain:
        return True
    assert other.series is not None and own.series is not None
    return other.reading.plain and other.series.key == own.series.key


def _result(found: Understanding, first: Finding, last: Finding, mends: Sequence[Mend]) -> AskedResult:
    """The verdict with the mends in place: a quantity whose own cells hold a fault stays wrong."""
    series = first.series or last.series
    cells = "" if series is None else series.where(found.work)
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


def _earned(asked: Mapping[str, float], wanted: AskedFor, verdicts: Mapping[str, Verdict]) -> dict[str, float]:
    """The marks of each quantity by its verdict."""
    parts = {"right": 1.0, "follows": 1.0 if wanted.follow_through else 0.0, "not live": wanted.not_live}
    return {symbol: marks * parts.get(verdicts[symbol], 0.0) for symbol, marks in asked.items()}


def _fault(found: Understanding, mend: Mend) -> FaultFound:
    work = found.work
    strip = mend.strip
    return FaultFound(
        work.where(strip.sheet, strip.start, strip.line, strip.length),
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
    return FaultFound(cells, found.work.shown(strip.formula, strip.sheet), "", (), "no single change mends it")


def _told(error: WorkbookError, mechanism: Mechanism, shown: str) -> WorkbookError:
    return WorkbookError(
        replace(fault, file=shown, message=said(mechanism.language, fault.about)) if fault.about in HOMEWORK else fault
        for fault in error.faults
    )
