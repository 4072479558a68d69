"""Where the first fault is, and what would mend it: every single change of the formulas that wrong columns depend on, then
two changes in one formula."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import CellRef, Node, Number, RangeRef
from mechsheet.homework.agreement import (
    Reading,
    agrees,
    gaps,
    likely,
    otherwise,
    reading_of,
    units_of,
    wrapped,
    zeros_of,
)
from mechsheet.homework.expected_values import Array, Quantity, kind_of, vocabulary
from mechsheet.homework.formula_strips import Place, Strip, with_formula
from mechsheet.homework.headings import around, names_over, says
from mechsheet.homework.inputs import single_cells
from mechsheet.homework.mends.candidates import Candidate, Surroundings, candidates, pairs
from mechsheet.homework.mends.trial import Effort, Trial, UntriableError
from mechsheet.homework.series import Graph, Series
from mechsheet.homework.summaries import holding, span_of
from mechsheet.homework.understanding import columns_beside
from mechsheet.homework.verdicts import (
    Finding,
    Retyped,
    Sheet,
    agreeing,
    findings,
    follows,
    in_convention,
    mostly,
    retype,
)

MOST_FAULTS = 5
OF_VERIFYING = 10_000
"""What it costs to try a mend in the workbook itself, in cells computed, besides the workbook's own cells."""
VERIFIED = 12
"""Mends of one formula that are tried under retyped dimensions."""
SURE = 1.3
"""Where a mend of less weight puts all right that is wrong, only smaller changes are looked for, though more is missing."""
LIGHT = 1.7
"""Candidates up to this weight are tried in all formulas before heavier ones in any. In a large linkage the formula at fault
may be one of the last (its wrong values can still be those of another link), and the heavy candidates, terms and factors
from anywhere in the sheet, are most of all: those of earlier formulas would use up what may be spent."""
MOST_AROUND = 60
"""Cells that a formula may have meant instead."""
FROM_ELSEWHERE = 2
"""The last way of a mend: rather than an angle that it makes count from anywhere two changes are tried."""
WAYS = (0, 1, FROM_ELSEWHERE)
MOST_OF_PAIRS = 3
"""Formulas in which two changes are tried."""


@dataclass(frozen=True, slots=True)
class Mend:
    """A formula, what it should be, and the asked quantities that this puts right.

    way      how those are said then: themselves (0), in the other sense or from half a turn (1), from another zero (2)
    lines    of a two-way table how many columns beside each other have the formula
    """

    strip: Strip
    formula: Node
    kind: str
    weight: float
    rights: tuple[str, ...]
    live: bool = True
    way: int = 0
    lines: int = 1


@dataclass(frozen=True, slots=True)
class Suspect:
    """The first cell whose inputs are right and whose value is not: what stands there and what is wanted."""

    strip: Strip
    place: Place
    found: float
    wanted: float | None
    of: str


def goals_of(sheet: Sheet, results: Mapping[str, Finding]) -> list[tuple[str, Series]]:
    """What is wrong, and the series (of a summary the cell) that should be it; for what is missing every series that nothing
    is known of. Of what stands under another's heading the formulas are right."""
    goals = [
        (symbol, finding.series)
        for symbol, finding in results.items()
        if finding.verdict == "wrong" and finding.series is not None and not finding.instead
    ]
    claimed = {finding.series.key for finding in results.values() if finding.series is not None}
    lost = [
        symbol
        for symbol, finding in results.items()
        if finding.verdict == "missing" and symbol in sheet.found.truth.columns
    ]
    if lost:
        loose = [series for series in sheet.found.series if series.key not in claimed and series.main is not None]
        goals += [(symbol, series) for symbol in lost for series in loose]
    return goals


class Search:
    """One search for a mend in one workbook."""

    def __init__(self, sheet: Sheet, results: Mapping[str, Finding], effort: Effort) -> None:
        self.sheet, self.results, self.effort = sheet, results, effort
        self.found, self.truth = sheet.found, sheet.found.truth
        self.graph: Graph = sheet.found.graph
        self.goals = goals_of(sheet, results)
        self.trial = Trial(self.graph, effort)

    @cached_property
    def retyped(self) -> list[Retyped]:
        """The workbook with its dimensions retyped, twice."""
        symbols = [one.symbol for one in self.found.inputs]
        found = [retype(self.found, symbols, turn) for turn in (0, 1)] if symbols else []
        return [one for one in found if one is not None]

    def mend(self) -> Mend | None:
        """The best mend; see the module."""
        if not self.goals:
            return None
        best: Mend | None = None
        wanted = {symbol for symbol, _ in self.goals if self.results[symbol].verdict == "wrong"}
        everything = {symbol for symbol, _ in self.goals}
        changes: dict[int, list[Candidate]] = {}
        for heavy in (False, True):
            for number in self.suspects:
                if self.effort.spent:
                    break
                if number not in changes:
                    changes[number] = self._candidates(number)
                later = 0.0 if self._is_doubtful(number) else 1.0  # a formula that is known is right as it stands
                tried = [one for one in changes[number] if (one.weight > LIGHT) is heavy]
                if (
                    best is not None
                    and best.live
                    and best.way == 0
                    and (everything <= set(best.rights) or (wanted <= set(best.rights) and best.weight < SURE))
                ):
                    tried = [one for one in tried if one.weight + later < best.weight]
                mend = self._of_strip(number, tried) if tried else None
                if mend is not None:
                    mend = replace(mend, weight=mend.weight + later)
                    best = mend if best is None or _rank(mend) < _rank(best) else best
        return best if best is not None and best.way < FROM_ELSEWHERE else self._of_pairs() or best

    def _of_pairs(self) -> Mend | None:
        """The first mend of two changes in one formula, of those that are not known to be right; for a column, not for one
        number: that is soon hit."""
        if not any(symbol in self.truth.columns for symbol, _ in self.goals):
            return None
        for number in list(filter(self._is_doubtful, self.suspects))[:MOST_OF_PAIRS]:
            if self.effort.spent:
                break
            mend = self._of_strip(number, pairs(self.graph.formulas[number], self._around(number)), (0,))
            if mend is not None and mend.live:
                return mend
        return None

    def _is_doubtful(self, number: int) -> bool:
        """Whether a formula is not known to be right."""
        return number not in self.known or self.derived.get(number) is False

    @cached_property
    def suspects(self) -> list[int]:
        """Formulas that wrong series depend on: those that are nothing of the mechanism though all they read is, first."""
        work = self.graph.work
        above = self.graph.above({strip for _, series in self.goals for strip in series.strips(work)})
        driver = self.found.driver
        above = {
            number
            for number in above
            if (work.strips[number].sheet, work.strips[number].line) != (driver.sheet, driver.line)
        }
        order = self.graph.order
        known = self.known
        odd = self._odd()

        def rank(number: int) -> tuple[int, int, int]:
            fine = number in known
            fed = all(other in known for other in self.graph.reads[number] - {number})
            wrong = number in odd or self.derived.get(number) is False
            return 0 if wrong else 3 if fine else 1 if fed else 2, order[number], number

        return sorted(above, key=rank)

    @cached_property
    def known(self) -> set[int]:
        """Strips that are plainly something of the mechanism or lead to what is right, or beside no table; not what is to be
        something else."""
        words = vocabulary(self.truth)
        work = self.graph.work
        by_main = {strip: number for number, strip in enumerate(work.strips)}
        found = {number for number, strip in enumerate(work.strips) if not self._beside(strip)}
        turned: set[int] = set()
        computed = [series for series in self.found.series if series.main is not None]
        columns = self.sheet.matrix(computed)
        for word in words:
            allowed = self.found.allowed(word)
            if self.found.is_still(word):
                continue
            for place in np.flatnonzero(likely(columns, word, allowed)).tolist():
                reading = reading_of(columns[place], word, allowed)
                main = computed[place].main
                if reading is None or main is None:
                    continue
                if reading.plain or word.kind == "length":  # a length the other way round is a choice
                    found.add(by_main[main])
                if not reading.plain and says(self.found.heading(computed[place]), word.name):
                    turned.add(by_main[main])  # but not where the column is called as the length itself
        found -= turned
        mains = [series.main for symbol, series in self.goals if self.results[symbol].verdict == "wrong"]
        wrong = {by_main[strip] for strip in mains if strip is not None}
        right = [one.series for one in self.results.values() if one.verdict in ("right", "not live")]
        for series in right:
            if series is not None and series.rows > 1:  # a difference of two wrong angles may be right
                found |= self.graph.above(set(series.strips(work)), wrong)
        return found - wrong

    @cached_property
    def derived(self) -> dict[int, bool]:
        """Single computed cells called as a derived dimension or a fixed point's place: whether they have its value."""
        called_so = self._standing()
        work = self.graph.work
        found = {}
        for number, strip in enumerate(work.strips) if called_so else ():
            place = (strip.sheet, strip.start, strip.line)
            if strip.length > 1 or self._beside(strip):
                continue
            words = [*around(work, place)[:1], *names_over(work, [place])]
            called = [one for one in called_so if any(says(text, one.name) for text in words)]
            if len(called) == 1:
                (one,) = called
                apart = [gaps(np.array([work.number(place)]), one, Reading(unit)) for unit in units_of(one)]
                found[number] = bool(min(float(gap[0]) for gap in apart) <= self.found.allowed(one))
        return found

    def _standing(self) -> list[Quantity]:
        """Derived dimensions, and what of the mechanism does not move."""
        dims = [dim for dim in self.found.mechanism.dimensions if dim.derived]
        found = [
            Quantity(dim.symbol, kind_of(dim.unit.kind), np.array([self.truth.dimensions[dim.symbol]])) for dim in dims
        ]
        names = {one.name for one in found}
        row = int(np.flatnonzero(self.truth.exists)[0])
        for symbol in self.truth.columns:
            quantity = self.truth.quantity(symbol)
            if symbol not in names and not quantity.moves(self.truth.size):
                found.append(replace(quantity, values=quantity.values[row : row + 1]))
        return found

    def _beside(self, strip: Strip) -> bool:
        """Whether a single cell stands in a series."""
        return any(series.cells.begins(strip) for series in self.found.series)

    def _odd(self) -> set[int]:
        """Formulas that break the run they stand in."""
        work = self.graph.work
        return {
            number
            for number, strip in enumerate(work.strips)
            if strip.length < 3 and self._beside(strip) and self._run_of(strip) is not None
        }

    def _run_of(self, strip: Strip) -> Strip | None:
        """The run that a strip breaks: the main formula of its series, where it is another one."""
        for series in self.found.series:
            if series.main not in (None, strip) and series.cells.begins(strip):
                return series.main
        return None

    # --- one formula --------------------------------------------------------------------------------------------------

    def _of_strip(self, number: int, tried: Sequence[Candidate], ways: Sequence[int] = WAYS) -> Mend | None:
        """The best of some changes of one formula. `ways`: as `way` of a mend."""
        strip = self.graph.work.strips[number]
        goals = list({series.key: series for _, series in self.goals}.values())
        try:
            columns = self.trial.columns(number, [one.formula for one in tried], goals)
        except UntriableError:
            return None
        by_key = {series.key: found for series, found in zip(goals, columns, strict=True)}
        spare: Mend | None = None
        for way in ways:
            told: list[dict[str, None]] = [{} for _ in tried]
            for symbol, series in self.goals:
                for index in np.flatnonzero(self._are(symbol, by_key[series.key], way)).tolist():
                    told[index][symbol] = None
            rights = np.array([len(each) for each in told])
            order = np.lexsort((np.array([one.weight for one in tried]), -rights))
            for index in [int(place) for place in order if rights[place]][:VERIFIED]:
                mend = self.verified(strip, tried[index], tuple(told[index]))
                if mend is not None and mend.live:
                    return replace(mend, way=way)
                spare = spare or mend
        return spare

    def _are(self, symbol: str, columns: Array, way: int) -> NDArray[np.bool_]:
        """Which columns, shape (columns, rows), are what is asked, in whatever unit; `way`: as of a mend."""
        if symbol not in self.truth.columns:
            right = holding(columns[:, 0], span_of(self.truth, symbol), self.truth.size, self.found.tolerance)
            return right & (way == 0)
        quantity = self.truth.quantity(symbol)
        allowed = self.found.allowed(quantity)
        if way:
            zeros = zeros_of(self.found.zeros) if way == FROM_ELSEWHERE else [0.0, math.pi]
            return otherwise(columns, quantity, allowed, zeros)
        good = np.zeros(len(columns), bool)
        for unit in units_of(quantity):
            good |= agrees(columns, quantity, Reading(unit), allowed)
        return good

    def _candidates(self, number: int) -> list[Candidate]:
        """The changes of a strip's formula; a cell that breaks its run may first have the run's formula."""
        work = self.graph.work
        strip = work.strips[number]
        found = candidates(self.graph.formulas[number], self._around(number))
        run = self._run_of(strip)
        if run is not None:
            found.insert(0, Candidate(work.bound(run.at(strip.start), strip), "breaks its column", 0.1))
        return found

    def _around(self, number: int) -> Surroundings:
        """What the formula could have read, but for what depends on it."""
        work = self.graph.work
        strip = work.strips[number]
        below = self.graph.below({number})

        def free(place: Place) -> bool:
            return work.strip_at(place) not in below

        single = single_cells(self.graph, self.found.driver)
        single += [
            (other.sheet, other.start, other.line)
            for other in work.strips
            if other.length == 1 and not self._beside(other)
        ]
        single = [place for place in dict.fromkeys(single) if free(place)][:MOST_AROUND]
        driver = self.found.driver
        own = next((one for one in self.found.series if one.cells.begins(strip)), None)
        lines = [(driver.sheet, driver.line, driver.start), *(series.key for series in self.found.series)]
        row = []
        columns = []
        for sheet, line, first in lines:
            pos = first if own is None else first + strip.start - own.origin
            if pos < 0 or not free((sheet, pos, line)):
                continue
            if own is None:
                end = CellRef(first + driver.length - 1, line, True, True, sheet)
                columns.append(RangeRef(CellRef(first, line, True, True, sheet), end))
            else:
                row.append(CellRef(pos, line, False, False, sheet))
        return Surroundings(
            tuple(CellRef(pos, line, True, True, sheet) for sheet, pos, line in single),
            tuple(row[:MOST_AROUND]),
            tuple(work.number(place) for place in single),
            tuple(columns[:MOST_AROUND]),
        )

    # --- in the workbook itself ---------------------------------------------------------------------------------------

    def verified(self, strip: Strip, candidate: Candidate, rights: tuple[str, ...]) -> Mend | None:
        """The mend, when with it nothing that was right is wrong; `live` when it stays right under retyped dimensions."""
        self.effort.spend(OF_VERIFYING + sum(one.length for one in self.graph.work.strips))
        mended = mended_sheet(Sheet(self.found, self.sheet.asked), strip, candidate.formula)
        after = findings(mended, self.truth)
        for symbol, finding in self.results.items():
            if finding.verdict in ("right", "not live") and after[symbol].verdict != "right":
                return None
        fixed = tuple(
            symbol
            for symbol, finding in self.results.items()
            if finding.verdict not in ("right", "not live") and after[symbol].verdict == "right"
            if self._by_its_column(mended, strip, symbol)
        )
        if not set(fixed) & set(rights):
            return None
        understanding = mended.found
        live = all(
            follows(understanding, after[symbol], one.again(understanding)) for one in self.retyped for symbol in fixed
        )
        return Mend(strip, candidate.formula, candidate.kind, candidate.weight, fixed, live)

    def _by_its_column(self, mended: Sheet, strip: Strip, symbol: str) -> bool:
        """One number is soon hit: a mend in a column counts for a summary when there is the column that it is taken of."""
        if symbol in self.truth.columns or not self._beside(strip):
            return True
        return agreeing(mended, self.truth, self.truth.summary(symbol).of) is not None


def _rank(mend: Mend) -> tuple[bool, int, int, float]:
    return not mend.live, mend.way, -len(mend.rights), mend.weight


def mended_sheet(sheet: Sheet, strip: Strip, formula: Node) -> Sheet:
    """The sheet with a mend in place."""
    work = with_formula(sheet.found.work, strip, formula)
    graph = Graph(work)
    series, settings = columns_beside(graph, sheet.found.driver, sheet.found.inputs)
    headings = dict(sheet.found.headings)
    found = replace(sheet.found, graph=graph, series=series, settings=settings, headings=headings)
    return Sheet(found, sheet.asked)


def first_wrong(sheet: Sheet, results: Mapping[str, Finding]) -> Suspect | None:
    """Where no single change mends: the first series that is nothing of the mechanism though all that it reads is; of
    numbers alone the first wrong one."""
    search = Search(sheet, results, Effort())
    numbers = search.suspects
    if not numbers:
        typed = [(symbol, series) for symbol, series in search.goals if series.main is None]
        return next((_wrong_number(sheet, series, symbol) for symbol, series in typed), None)
    strip = sheet.found.work.strips[numbers[0]]
    for symbol, series in search.goals:
        if series.main == strip:
            return first_difference(sheet, strip, series, symbol)
    place = (strip.sheet, strip.start, strip.line)
    return Suspect(strip, place, sheet.found.work.number(place), None, "")


def _wrong_number(sheet: Sheet, series: Series, symbol: str) -> Suspect:
    strip = Strip(series.sheet, series.line, series.origin, series.rows, Number(0.0))
    found = first_difference(sheet, strip, series, symbol)
    return replace(found, strip=replace(strip, start=found.place[1], length=1))


def first_difference(
    sheet: Sheet, strip: Strip, series: Series, symbol: str, mended: tuple[Sheet, Reading] | None = None
) -> Suspect:
    """The first cell of what is asked that is not what it should be, and what is wanted there as the sheet counts: what the
    mended one has, and how that says it; else as most of its rows do, in the unit of that size."""
    column, truth = sheet.column(series), sheet.found.truth
    if symbol not in truth.columns:
        span = span_of(truth, symbol)
        wanted = span.rows / sheet.found.meant_unit(column, replace(span.quantity, values=np.array([span.rows])))
        row = 0
    else:
        quantity = truth.quantity(symbol)
        reading = mended[1] if mended else mostly(sheet, truth, symbol, series)
        reading = reading or Reading(sheet.found.meant_unit(column, quantity))
        gap = reading.of(column) - quantity.values
        gap = wrapped(gap) if quantity.kind == "angle" else gap
        rows = np.flatnonzero(~(np.abs(gap) <= sheet.found.allowed(quantity)) & np.isfinite(quantity.values))
        row = int(rows[0]) if len(rows) else 0
        turned = np.rint((reading.of(column) - quantity.values) / math.tau) if quantity.kind == "angle" else np.zeros(1)
        there = turned[np.isfinite(turned)]
        turn = float(np.median(there)) if len(there) else 0.0  # that of the other rows
        right = float(quantity.values[row]) + reading.offset + math.tau * turn
        wanted = reading.sense * right / reading.unit
    if mended is not None:
        wanted = float(series.column(mended[0].found.work)[row])
    return Suspect(strip, series.cells.places()[row], float(column[row]), wanted, symbol)


def many(sheet: Sheet, results: Mapping[str, Finding], effort: Effort) -> tuple[list[Mend], Sheet, dict[str, Finding]]:
    """One mend after the other, up to MOST_FAULTS: (mends, the sheet with all of them, what is found in it)."""
    mends: list[Mend] = []
    current = dict(results)
    while len(mends) < MOST_FAULTS and any(one.verdict in ("wrong", "missing") for one in current.values()):
        mend = Search(sheet, current, effort).mend()
        if mend is None:
            break
        sheet, after = in_convention(mended_sheet(sheet, mend.strip, mend.formula))
        mends.append(replace(mend, rights=newly_right(current, after)))
        current |= after
    return mends, sheet, current


def newly_right(before: Mapping[str, Finding], after: Mapping[str, Finding]) -> tuple[str, ...]:
    """What was not right and is."""
    was = {symbol for symbol, one in before.items() if one.verdict in ("right", "not live", "other assembly")}
    return tuple(symbol for symbol, one in after.items() if symbol not in was and one.verdict == "right")
