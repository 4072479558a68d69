"""A workbook judged: what of it is asked, right or wrong, with mends; table by table."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, replace

from livesheet.diagnostics import WorkbookError
from livesheet.formula.nodes import shifted
from mechsheet import reference
from mechsheet.homework.agreement import agrees, plain_reading
from mechsheet.homework.expected_values import AskedFor, Truth, other_assemblies, without_limits
from mechsheet.homework.formula_strips import Strip, Work, upright
from mechsheet.homework.mends.faults import Mend, Suspect, first_wrong, many, mended_sheet
from mechsheet.homework.mends.thinned import thinned
from mechsheet.homework.mends.trial import Effort
from mechsheet.homework.mends.typed_over import typed_over
from mechsheet.homework.series import Run
from mechsheet.homework.understanding import Understanding, other_runs, others_of, understand
from mechsheet.homework.verdicts import Finding, Sheet, findings, in_convention, with_doubt, with_liveness
from mechsheet.model import Mechanism
from mechsheet.words.catalogue import is_key, said

MOST_TABLES = 4
"""Tables of one workbook that are looked at."""


@dataclass(frozen=True, slots=True)
class Judged:
    """Everything that was found in a workbook.

    truth   of the assembly that the sheet shows
    first   of each asked quantity what is found in the sheet as it is;  last  the same with the mends in place: `mended`
    """

    found: Understanding
    truth: Truth
    asked: Mapping[str, float]
    first: Mapping[str, Finding]
    last: Mapping[str, Finding]
    mends: Sequence[Mend]
    suspect: Suspect | None
    mended: Sheet
    unusual: bool = False

    @property
    def promising(self) -> bool:
        """Whether anything asked is found, as it is or with mends."""
        return bool(self.mends) or any(
            one.verdict in ("right", "not live", "other assembly", "unclear") for one in self.first.values()
        )


@dataclass(frozen=True, slots=True)
class _Seen:
    """A workbook understood, before faults are looked for; the parts as `Judged` has them."""

    sheet: Sheet
    truth: Truth
    first: dict[str, Finding]
    asked: Mapping[str, float]
    unusual: bool = False

    @property
    def right(self) -> int:
        """How many asked quantities are right."""
        return sum(one.verdict == "right" for one in self.first.values())


def judged_tables(work: Work, mechanism: Mechanism, wanted: AskedFor, shown: str) -> list[Judged]:
    """Everything found in a workbook, table by table: the first is the largest; what is not right in it is looked for in the
    others. Each asked quantity is in one of them. Tables of numbers, and two-way tables, may go down or to the right.

    Raises WorkbookError where nothing is a table of the mechanism.
    """
    try:
        return _tables(_directed(work, mechanism, wanted), mechanism, wanted)
    except WorkbookError as error:
        raise _told(error, mechanism, shown) from error


def _directed(work: Work, mechanism: Mechanism, wanted: AskedFor) -> Work:
    """A workbook that may go down or to the right in the direction in which something is right as it is, or there is a table
    at all; in its own where that is so both ways."""
    best: tuple[int, Work] = (-1, work)
    for way in (work, upright(work.book, not work.across)) if work.undecided else ():
        with contextlib.suppress(WorkbookError):
            right = _seen(way, mechanism, wanted).right
            best = max(best, (right, way), key=lambda pair: pair[0])
    return best[1]


def _tables(work: Work, mechanism: Mechanism, wanted: AskedFor) -> list[Judged]:
    """The tables of a workbook that go in its direction. Raises WorkbookError."""
    effort = Effort()
    main = _judged(work, mechanism, wanted, effort)
    parts = [main]
    used = [main.found]
    while len(parts) < MOST_TABLES:
        lost = {symbol: marks for symbol, marks in main.asked.items() if _rank(parts, symbol) > FOLLOWS}
        runs = other_runs(main.found.graph, used) if lost else []
        if not runs:
            break
        try:
            part = _judged(work, mechanism, replace(wanted, marks=lost), effort, runs)
        except WorkbookError:  # another table, of something else
            break
        used.append(part.found)
        better = {symbol for symbol in part.asked if _place(part, symbol) < _rank(parts, symbol)}
        if not better:
            break
        parts = [_only(one, set(one.asked) - better) for one in parts] + [_only(part, better)]
    parts = [parts[0], *(part for part in parts[1:] if part.asked)]
    return [each for part in parts for each in _with_settings(part, effort)]


RIGHT, FOLLOWS, WRONG = 0, 1, 3


def _place(part: Judged, symbol: str) -> int:
    """How well a table has a quantity: a smaller number is better."""
    first, last = part.first[symbol].verdict, part.last[symbol].verdict
    if first in ("right", "not live", "other assembly"):
        return RIGHT
    return FOLLOWS if last == "right" else WRONG if first == "wrong" else WRONG + 1


def _rank(parts: Sequence[Judged], symbol: str) -> int:
    return min((_place(part, symbol) for part in parts if symbol in part.asked), default=WRONG + 1)


def _only(part: Judged, symbols: Set[str]) -> Judged:
    """A table with a part of what is asked, and the faults that matter to that."""
    mends = [mend for mend in part.mends if symbols & set(mend.rights)]
    wrong = any(symbol in symbols and one.verdict == "wrong" for symbol, one in part.last.items())
    return replace(
        part,
        asked={symbol: marks for symbol, marks in part.asked.items() if symbol in symbols},
        first={symbol: one for symbol, one in part.first.items() if symbol in symbols},
        last={symbol: one for symbol, one in part.last.items() if symbol in symbols},
        mends=mends,
        suspect=part.suspect if wrong else None,
    )


def _judged(
    work: Work, mechanism: Mechanism, wanted: AskedFor, effort: Effort, runs: Sequence[Run] | None = None
) -> Judged:
    """Everything found in one table. `runs`: what may be its driver's values, where it is not the largest table."""
    seen = _seen(work, mechanism, wanted, runs=runs)
    if (
        mechanism.driver.law is not None and runs is None and not seen.right
    ):  # looked for before mends are: they are many
        timed = _seen(work, mechanism, wanted, unusual=True)
        seen = timed if timed.right else seen
    other = None
    if mechanism.synthesis is not None and seen.right < len(seen.first):
        other = _seen(work, _found_once(mechanism), wanted, runs=runs)
    judged = _of_both(seen, other, effort) if other is not None else _with_mends(seen, effort)
    if not judged.promising and runs is None:
        unusual = _seen(work, mechanism, wanted, unusual=True)
        if unusual.right:
            judged = _with_mends(unusual, effort)
    return judged


def _with_settings(judged: Judged, effort: Effort) -> list[Judged]:
    """A two-way table judged in all its columns: what is right in one of them has to be so in the others, each with its own
    dimension; what mends one mends those with the same formula. Others where it is wrong are a table of their own."""
    if not judged.found.settings:
        return [judged]
    mends = [replace(mend, lines=_alike(judged.found, mend)) for mend in judged.mends]
    judged = replace(judged, mends=mends)
    answers = {one.series.key for one in judged.last.values() if one.series is not None and one.verdict == "right"}
    main = next((one for one in judged.found.settings.values() if one.key in answers), None)
    if main is None:
        return [judged]
    symbol = next(s for s, one in judged.last.items() if one.series is not None and one.series.key == main.key)
    reading, asked = judged.last[symbol].reading, {symbol: judged.asked[symbol]}
    wrong: list[Judged] = []
    for series, found in others_of(judged.found):
        quantity = found.truth.quantity(symbol)
        same = series.main is not None and main.main is not None and _one_formula(main.main, series.main, found.work)
        right = reading is not None and agrees(series.column(found.work), quantity, reading, found.allowed(quantity))
        if not right and not (same and judged.mends):
            sheet = Sheet(found, list(asked))
            wrong.append(_with_mends(_Seen(sheet, *_assembly(sheet, findings(sheet)), asked), effort))
    if not wrong:
        return [judged]
    wrong[0] = replace(wrong[0], mends=[*judged.mends, *(mend for part in wrong for mend in part.mends)])
    return [_only(judged, judged.asked.keys() - asked.keys()), wrong[0]]


def _alike(found: Understanding, mend: Mend) -> int:
    """How many columns of a two-way table, from that of a mend on, have the formula that it mends."""
    strip, work, count = mend.strip, found.work, 1
    while (number := work.strip_at((strip.sheet, strip.start, strip.line + count))) is not None:
        if not _one_formula(strip, work.strips[number], work):
            break
        count += 1
    return count


def _one_formula(strip: Strip, other: Strip, work: Work) -> bool:
    """Whether the formula of one column is that of another filled to the side."""
    moved = shifted(strip.formula, other.start - strip.start, other.line - strip.line)
    return strip.length == other.length and work.bound(moved, other) == work.bound(other.formula, other)


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


def _seen(
    work: Work, mechanism: Mechanism, wanted: AskedFor, unusual: bool = False, runs: Sequence[Run] | None = None
) -> _Seen:
    """A workbook understood. `unusual`: the driver may be counted clockwise, or from another zero."""
    found = understand(work, mechanism, list(wanted.marks), wanted.tolerance, unusual, runs)
    asked = _moving(found, wanted)
    sheet = Sheet(found, list(asked))
    first = findings(sheet)
    if any(one.verdict != "right" for one in first.values()):
        # a fault may hide what the sheet has in rows at a limit: a mend is not held against them
        found = replace(found, truth=without_limits(found.truth))
        sheet, first = in_convention(Sheet(found, list(asked)))
    return _Seen(sheet, *_assembly(sheet, first), asked, unusual)


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
        suspect = first_wrong(last_sheet, last)
    first = with_doubt(seen.sheet, truth, with_liveness(found, first))
    if truth is not found.truth:
        others = {symbol: start[symbol] for symbol, one in first.items() if one.verdict == "other assembly"}
        live = with_liveness(replace(found, truth=truth), others)
        first |= {symbol: replace(first[symbol], live=live[symbol].verdict != "not live") for symbol in others}
    return Judged(found, truth, seen.asked, first, last, mends, suspect, last_sheet, seen.unusual)


def _mends(
    sheet: Sheet, truth: Truth, start: dict[str, Finding], effort: Effort
) -> tuple[list[Mend], Sheet, dict[str, Finding]]:
    """Numbers typed over formulas, then as `many`; of a long table the mends are looked for in a part of its rows."""
    sheet = Sheet(replace(sheet.found, truth=truth), sheet.asked)
    mends, sheet, start = typed_over(sheet, start)
    wrong = any(one.verdict in ("wrong", "missing") for one in start.values())
    part = thinned(sheet.found) if wrong else None
    if part is None:
        more, sheet, start = many(sheet, start, effort)
        return [*mends, *more], sheet, start
    found, _, _ = many(*in_convention(Sheet(part.found, sheet.asked)), effort)
    for mend in found:
        whole = part.back(mend, sheet.found.work)
        if whole is not None:
            mends.append(whole)
            sheet = mended_sheet(sheet, whole.strip, whole.formula)
    return mends, *(in_convention(sheet) if mends else (sheet, start))


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
    """The assembly that the sheet shows, and its findings: another one where all that is there is right for it.

    The angle of a rod in its other assembly may be that of the description's counted the other way round. It is of the other
    assembly where something else in the sheet is, too; an angle that both assemblies have in common is not.
    """
    base = sheet.found.truth
    there = [symbol for symbol, finding in first.items() if finding.verdict != "missing"]
    turned = {symbol for symbol in there if _turned(base, first[symbol])}
    right = all(first[symbol].verdict == "right" for symbol in there)
    if right and not turned:
        return base, first
    own = _shown(sheet, base) if right else set()
    for truth in other_assemblies(base):
        found = findings(sheet, truth)
        if all(_as_right(found[symbol], first[symbol]) for symbol in there) and (
            not right or _shown(sheet, truth) - own
        ):
            return truth, {
                symbol: replace(one, verdict="other assembly")
                if one.verdict == "right"
                and (first[symbol].verdict != "right" or (symbol in turned and one.reading != first[symbol].reading))
                else first[symbol]
                for symbol, one in found.items()
            }
    return base, first


def _turned(truth: Truth, one: Finding) -> bool:
    """Whether an angle, a displacement or a place of a link, which no two assemblies have in common, is right in another
    sense or from another zero alone."""
    outputs = {output.symbol for output in truth.mechanism.outputs}
    return one.symbol not in outputs and one.verdict == "right" and one.reading is not None and not one.reading.plain


def _shown(sheet: Sheet, truth: Truth) -> set[tuple[str, int, int]]:
    """The series that are places of links or displacements of an assembly."""
    found: set[tuple[str, int, int]] = set()
    for symbol, kind in truth.kinds.items():
        quantity = truth.quantity(symbol)
        allowed = sheet.found.allowed(quantity)
        if kind == "length" and not sheet.found.is_still(quantity):
            found |= {
                series.key
                for series in sheet.found.series
                if plain_reading(sheet.column(series), quantity, allowed) is not None
            }
    return found


def _as_right(other: Finding, own: Finding) -> bool:
    """Whether a quantity is right for another assembly, and not less plainly so than for the description's own: what is
    plainly right for that in its column is not of another one because some other column holds what it would be there."""
    if other.verdict != "right" or other.reading is None:
        return False
    if own.verdict != "right" or own.reading is None or not own.reading.plain:
        return True
    assert other.series is not None and own.series is not None
    return other.reading.plain and other.series.key == own.series.key


def _found_once(mechanism: Mechanism) -> Mechanism:
    """A mechanism with dimensions found from a task, as numbers: a sheet may have them typed, as they were found."""
    given = reference.dimension_values(mechanism)
    found = tuple(
        dim if dim.path or isinstance(dim.value, float) else replace(dim, value=given[dim.symbol], written="")
        for dim in mechanism.dimensions
    )
    return replace(mechanism, dimensions=found)


def _told(error: WorkbookError, mechanism: Mechanism, shown: str) -> WorkbookError:
    return WorkbookError(
        replace(fault, file=shown, message=said(mechanism.language, fault.about))
        if is_key(f"homework.{fault.about}")
        else fault
        for fault in error.faults
    )
