"""What the sheet has of each quantity that is asked: right, wrong, missing, of the other assembly, not live.

A column that says its quantity in another sense, from another zero or in another turn is right; then what the description
computes from it by a formula, or takes from it over the rows, is right as it follows from the column as the sheet has it
(`in_convention`): whoever counts an angle from another zero computes outputs and summaries from that angle.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

import numpy as np

from livesheet.engine import Values
from livesheet.formula.nodes import Call, Number, symbols, walk
from mechsheet.homework.agreement import FEWEST, Reading, gaps, most_like, reading_of, wrapped
from mechsheet.homework.claims import answers, claimed, exchanged, read_on, rivals
from mechsheet.homework.expected_values import Array, Truth, truth_of, vocabulary
from mechsheet.homework.formula_strips import Place, Stretch, Strip
from mechsheet.homework.headings import around, contains, labels, labels_of, names_over, says
from mechsheet.homework.inputs import MOST_UNREAD, is_length, single_cells, typed_numbers
from mechsheet.homework.series import Series
from mechsheet.homework.summaries import holds, reading_of_number, span_of
from mechsheet.homework.understanding import SMALL, Understanding, anything, as_counted, retyped
from mechsheet.model import Mechanism, Summary

Verdict: TypeAlias = Literal["right", "in part", "follows", "wrong", "other assembly", "not live", "unclear", "missing"]

SHARE = 0.1
"""A column is live when it follows a change of the dimensions but for this part of what changes."""
STEPS = (1.0, 0.4, 0.1, 0.02)
"""Parts of the retyped changes that are tried one after the other, until no row vanishes."""
RETYPED = (0.03, -0.02)


@dataclass(frozen=True, slots=True)
class Finding:
    """One asked quantity.

    series   the cells that are it, or are meant for it; None where nothing is
    reading  how they say it, where they do
    dead     dimensions that they do not follow
    instead  the quantity that they are, where each of the two stands under the other's heading
    live     False where they are of the other assembly and would be not live for that
    """

    symbol: str
    verdict: Verdict
    series: Series | None = None
    reading: Reading | None = None
    dead: tuple[str, ...] = ()
    instead: str = ""
    live: bool = True


@dataclass
class Sheet:
    """An understood workbook with its columns read once, and what it is asked for."""

    found: Understanding
    asked: Sequence[str]
    values: Values | None = None
    columns: dict[tuple[str, int, int], Array] = field(default_factory=dict)

    def column(self, series: Series) -> Array:
        """The numbers of a series."""
        if series.key not in self.columns:
            self.columns[series.key] = series.column(self.found.work, self.values)
        return self.columns[series.key]

    def matrix(self, several: Sequence[Series]) -> Array:
        """The numbers of several series, shape (series, rows)."""
        return np.array([self.column(series) for series in several]).reshape(len(several), self.found.driver.length)


def findings(sheet: Sheet, truth: Truth | None = None) -> dict[str, Finding]:
    """Each asked quantity: right where a series agrees with it, else wrong or missing. Nothing is retyped here."""
    found = sheet.found
    truth = found.truth if truth is None else truth
    results: dict[str, Finding] = {}
    wanted = [symbol for symbol in sheet.asked if symbol in truth.columns]
    for symbol in wanted:
        best = agreeing(sheet, truth, symbol)
        if best is not None:
            results[symbol] = Finding(symbol, "right", best[0], best[1])
    taken = {finding.series.key for finding in results.values() if finding.series is not None}
    spare = [series for series in found.series if series.key not in taken]
    for symbol in wanted:
        if symbol not in results:
            series = _headed(sheet, symbol, spare)
            if series is not None:
                others = [other for other in wanted if other != symbol]
                instead = exchanged(found, symbol, others, series, _reader(sheet, truth))
                results[symbol] = Finding(symbol, "wrong", series, instead=instead)
                spare = [other for other in spare if other.key != series.key]
    _left_over(sheet, truth, results, spare)
    for summary in found.mechanism.summaries:
        if summary.symbol in sheet.asked:
            single = _single(sheet, truth, summary)
            if single is not None:
                results[summary.symbol] = single
    return {symbol: results.get(symbol, Finding(symbol, "missing")) for symbol in sheet.asked}


def agreeing(sheet: Sheet, truth: Truth, symbol: str) -> tuple[Series, Reading] | None:
    """The series that is a quantity: read plainly before in another sense, headed so before not, computed before typed, in
    the sheet's own unit before another. With a quantity that hardly moves many a column agrees: then the nearest. Last, one
    that a dimension leads to before one that happens to be the same. Which series are asked at all: see `claims`."""
    found = sheet.found
    quantity = truth.quantity(symbol)
    still = found.is_still(quantity)
    best: tuple[tuple[bool, bool, bool, bool, float, bool], Series, Reading] | None = None
    read_as = _reader(sheet, truth)
    for series in answers(found, symbol, read_as)[0]:
        column = sheet.column(series)
        reading = read_as(series, symbol)
        if reading is None:
            continue
        own = quantity.kind != "length" or reading.unit == found.length_unit
        apart = float(gaps(column, quantity, reading).max(initial=0.0)) if still else 0.0
        called = says(found.heading(series), symbol)
        rank = reading.plain, called, series.main is not None, own, -apart, _led(found, series)
        if best is None or rank > best[0]:
            best = rank, series, reading
    return None if best is None else best[1:]


def _reader(sheet: Sheet, truth: Truth) -> Callable[[Series, str], Reading | None]:
    """How a series says a column of the mechanism, None where it does not; each is looked at once."""
    found = sheet.found
    known: dict[tuple[tuple[str, int, int], str], Reading | None] = {}

    def read_as(series: Series, symbol: str) -> Reading | None:
        key = series.key, symbol
        if key not in known:
            quantity = truth.quantity(symbol)
            reading = reading_of(sheet.column(series), quantity, found.allowed(quantity), found.zeros)
            if reading is not None and not (of_output(found, symbol, reading) and _conventional(reading, series)):
                reading = None
            known[key] = reading
        return known[key]

    return read_as


def of_output(found: Understanding, symbol: str, reading: Reading) -> bool:
    """Whether an output may be read so: it is computed by a formula, so that only the sense of an angle, or its other side,
    is a choice; of one that follows the convention of its columns not even that."""
    if all(output.symbol != symbol for output in found.mechanism.outputs) or reading.plain:
        return True
    return symbol not in found.by_convention and abs(math.remainder(reading.offset, math.pi)) < 1e-3


def mostly(sheet: Sheet, truth: Truth, symbol: str, series: Series) -> Reading | None:
    """How a series says a column of the mechanism in most of its rows."""
    quantity = truth.quantity(symbol)
    return most_like(sheet.column(series), quantity, sheet.found.allowed(quantity), sheet.found.zeros)


def _conventional(reading: Reading, series: Series) -> bool:
    """Whether another sense or zero is a choice: clockwise from the vertical out of ATAN2 is its arguments turned around."""
    if reading.plain or series.main is None:
        return True
    quarter = abs(abs(math.remainder(reading.offset, math.pi)) - math.pi / 2) < 1e-3
    arcs = any(isinstance(part, Call) and part.name == "ATAN2" for part in walk(series.main.formula))
    return not (reading.sense == -1 and quarter and arcs)


def _headed(sheet: Sheet, symbol: str, spare: Sequence[Series]) -> Series | None:
    """The series that is called as a quantity: the one that claims to be it, else one whose heading says it among others,
    a computed one first."""
    found = sheet.found
    claims = [series for series in claimed(found, symbol) if series in spare]
    if claims:
        return claims[-1]
    words = labels(found.mechanism, symbol)
    named = [
        series
        for series in spare
        if says(found.heading(series), symbol) or any(contains(found.heading(series), label) for label in words)
    ]
    named.sort(key=lambda series: series.main is None)
    return named[0] if named else None


def _left_over(sheet: Sheet, truth: Truth, results: dict[str, Finding], spare: Sequence[Series]) -> None:
    """One quantity and one unexplained last column: they belong together. `spare` are series that nothing has claimed."""
    open_symbols = [symbol for symbol in sheet.asked if symbol not in results and symbol in truth.columns]
    if len(open_symbols) != 1 or not spare:
        return
    ends = [series for series in unexplained(sheet, truth, spare) if not read_on(sheet.found, series)]
    ends = [series for series in ends if not _called_otherwise(sheet, series, open_symbols[0])]
    if len(ends) == 1:
        results[open_symbols[0]] = Finding(open_symbols[0], "wrong", ends[0])


def _single(sheet: Sheet, truth: Truth, summary: Summary) -> Finding | None:
    """The single cell that is a summary. One that is called so is the answer, right or wrong: a formula before a typed
    number, one with the name beside it before one below it, and of several the last one. Else a formula beside words that
    name it, or one that is computed from the table."""
    found = sheet.found
    work = found.work
    span = span_of(truth, summary.symbol)
    labelled = labels(found.mechanism, summary.symbol)

    def named(text: str) -> bool:
        return says(text, summary.symbol) or any(contains(text, label) for label in labelled)

    def finding(place: Place, main: Strip | None) -> Finding:
        reading = reading_of_number(work.number(place, sheet.values), span, truth.size, found.tolerance)
        series = Series(place[0], place[2], place[1], 1, main, 0, 0)
        return Finding(summary.symbol, "wrong" if reading is None else "right", series, reading)

    singles = [strip for strip in work.strips if strip.length <= 2]
    singles = [strip for strip in singles if not any(series.cells.begins(strip) for series in found.series)]
    cells: list[tuple[Place, Strip | None]] = [(place, strip) for strip in singles for place in strip.places()]
    typed = list(itertools.islice(typed_numbers(found.graph), MOST_UNREAD))
    for some in (cells, [(place, None) for place in typed]):
        beside: list[tuple[Place, Strip | None]] = []
        over: list[tuple[Place, Strip | None]] = []
        for place, strip in some:
            left, above = labels_of(work, place)
            if named(left):
                beside.append((place, strip))
            elif any(map(named, (above, *names_over(work, [place])))):
                over.append((place, strip))
        claims = beside or over
        # a formula that makes a text beside such a word, "worst 33.8° at 60°", is a remark
        numbers = [claim for claim in claims if not isinstance(work.value(claim[0], sheet.values), str)] or claims
        if numbers:
            return finding(*numbers[-1])
    best: tuple[tuple[bool, bool], Finding] | None = None
    for place, strip in cells:
        one = finding(place, strip)
        told = any(map(named, around(work, place)))
        right = one.verdict == "right" and (told or _of_the_table(found, strip))
        if (right or told) and (best is None or (right, told) > best[0]):
            best = (right, told), one
    return None if best is None else best[1]


def _of_the_table(found: Understanding, strip: Strip | None) -> bool:
    """Whether a formula is computed from the columns beside the driver."""
    graph = found.graph
    lines = {(series.sheet, series.line) for series in found.series}
    above = graph.above({graph.work.strips.index(strip)}) if strip is not None else set()
    return any(
        (sheet, line) in lines and high - low >= FEWEST - 1
        for number in above
        for sheet, low, high, left, right in graph.areas(number)
        for line in range(left, min(right, left + 500) + 1)
    )


def _called_otherwise(sheet: Sheet, series: Series, symbol: str) -> bool:
    words = sheet.found.heading(series)
    return any(says(words, other) for other in sheet.found.truth.columns if other != symbol)


def unexplained(sheet: Sheet, truth: Truth, spare: Sequence[Series]) -> list[Series]:
    """Computed series that are nothing of the mechanism, the driver's own value in another unit included."""
    words = vocabulary(truth)
    found = sheet.found
    computed = [series for series in spare if series.main is not None and np.isfinite(sheet.column(series)).any()]
    known = anything(sheet.matrix(computed), words, found.allowed, found.zeros)
    return [series for series, one in zip(computed, known, strict=True) if not one]


# --- retyped dimensions -----------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Retyped:
    """Dimensions changed on both sides: what the mechanism does then, and what the sheet says."""

    truth: Truth
    values: Values
    cells: Mapping[Place, float]

    def again(self, found: Understanding) -> Retyped:
        """The same cells retyped in another state of the workbook."""
        return replace(self, values=found.work.plan.evaluate(self.cells))


def retype(found: Understanding, symbols: Sequence[str], turn: int, steps: Sequence[float] = STEPS) -> Retyped | None:
    """Some dimensions retyped, all at once, by +3 % and -2 % in turn; less where rows would vanish."""
    base = found.truth
    for part in steps:
        changes = {}
        for number, symbol in enumerate(symbols):
            value = base.dimensions[symbol]
            span = abs(value) if value else (base.size if is_length(found.mechanism, symbol) else 1.0)
            changes[symbol] = value + span * part * RETYPED[(number + turn) % 2]
        result = _typed(found, changes)
        if result is not None and result.truth.exists[base.exists].all():
            return result
    return None


def _typed(found: Understanding, changes: Mapping[str, float]) -> Retyped | None:
    dimensions, cells = retyped(found, changes)
    values = found.work.plan.evaluate(cells)
    column = found.driver.column(found.work, values)
    if not np.isfinite(column).all():
        return None
    truth = truth_of(found.mechanism, dimensions, column * found.factor + found.offset, found.truth.poses)
    return None if truth is None else Retyped(as_counted(found, truth, values), values, cells)


def follows(found: Understanding, finding: Finding, after: Retyped) -> bool:
    """Whether a series that is right goes on being right, but for a small part of what the change makes."""
    assert finding.series is not None and finding.reading is not None
    if finding.symbol not in found.truth.columns:
        return _summary_follows(found, finding, after)
    before, now = found.truth.quantity(finding.symbol), after.truth.quantity(finding.symbol)
    now = replace(now, values=np.where(np.isfinite(before.values), now.values, np.nan))
    reading = finding.reading
    column = finding.series.column(found.work, after.values)
    change = now.values - before.values
    change = np.abs(wrapped(change) if now.kind == "angle" else change)
    allowed = 10 * found.allowed(now) + SHARE * float(np.nanmax(change, initial=0.0))
    apart = gaps(column, now, reading)
    if reading.offset:  # counted from an angle that may have been retyped, too: then all rows are off by the same
        turned = reading.of(column) - now.values
        known = np.flatnonzero(np.isfinite(turned))
        shift = turned[known[0]] if len(known) else 0.0
        apart = gaps(column, now, replace(reading, offset=reading.offset + shift))
    return bool(apart.max() <= allowed)


def _summary_follows(found: Understanding, finding: Finding, after: Retyped) -> bool:
    assert finding.series is not None and finding.reading is not None
    before, now = span_of(found.truth, finding.symbol), span_of(after.truth, finding.symbol)
    number = found.work.number(finding.series.cells.places()[0], after.values)
    allowed = SHARE * abs(now.low - before.low) + 10 * found.tolerance * abs(now.high)
    return bool(holds(now, np.array(number), finding.reading, allowed))


def with_liveness(found: Understanding, results: Mapping[str, Finding]) -> dict[str, Finding]:
    """The findings, with those that are right but do not follow the dimensions as not live.

    Lengths that a task gives have no say of their own: of such a mechanism only what no cell of a dimension leads to is.
    """
    if found.mechanism.synthesis is not None:
        return {
            symbol: replace(one, verdict="not live") if one.verdict == "right" and not _fed(found, one) else one
            for symbol, one in results.items()
        }
    symbols = [one.symbol for one in found.inputs]
    pairs = [retype(found, symbols, turn) for turn in (0, 1)] if symbols else []
    tests = [after for after in pairs if after is not None]
    doubtful = [
        finding
        for finding in results.values()
        if finding.verdict == "right" and not all(follows(found, finding, after) for after in tests)
    ]
    dead: dict[str, list[str]] = {}
    for symbol in symbols if doubtful else ():
        # by much and by little: a row at which the mechanism comes apart in between says nothing of the sheet
        sizes = [retype(found, [symbol], 0, STEPS[:3]), retype(found, [symbol], 0, STEPS[1:3])]
        for finding in doubtful:
            if all(after is not None and not follows(found, finding, after) for after in sizes):
                dead.setdefault(finding.symbol, []).append(symbol)
    changed = dict(results)
    for finding in doubtful:
        if finding.symbol in dead:
            changed[finding.symbol] = replace(finding, verdict="not live", dead=tuple(dead[finding.symbol]))
    for symbol, finding in changed.items():
        if finding.verdict == "right" and finding.series is not None:
            inside = typed_dimensions(found, finding)
            if inside or not _fed(found, finding):
                changed[symbol] = replace(finding, verdict="not live", dead=inside)
    return changed


def _fed(found: Understanding, finding: Finding) -> bool:
    """Whether a cell of a dimension leads to a series, where what it should be depends on the dimensions."""
    series = finding.series
    if series is None or series.main is None:
        return False
    return _led(found, series) or not _depends(found, finding.symbol)


def _led(found: Understanding, series: Series) -> bool:
    """Whether a cell of a dimension leads to a series; where a task gives these, any number typed beside the table."""
    if series.main is None:
        return False
    graph = found.graph
    above = graph.above({graph.work.strips.index(series.main)})
    task = found.mechanism.synthesis is not None
    cells = single_cells(graph, found.driver) if task else [one.place for one in found.inputs]
    return any(above & graph.readers_of(Stretch(sheet, line, pos, 1)) for sheet, pos, line in cells)


def _depends(found: Understanding, symbol: str) -> bool:
    """Whether a quantity has other values with other dimensions."""
    base = found.truth
    inputs = [dim.symbol for dim in found.mechanism.free_dimensions]
    for part in STEPS if inputs else ():  # the dimensions of a task are found all at once
        changed = {
            symbol: base.dimensions[symbol] * (1 + part * RETYPED[number % 2]) for number, symbol in enumerate(inputs)
        }
        other = truth_of(found.mechanism, changed, base.driver, base.poses)
        if other is not None and other.exists[base.exists].all():
            if symbol not in base.columns:
                one, two = span_of(base, symbol), span_of(other, symbol)
                return abs(one.low - two.low) > found.tolerance * max(abs(one.low), 1e-12)
            quantity = replace(base.quantity(symbol), values=np.where(base.exists, base.columns[symbol], np.nan))
            return bool(
                gaps(other.columns[symbol], quantity, Reading()).max(initial=0.0) > SMALL * found.allowed(quantity)
            )
    return True


def with_doubt(sheet: Sheet, truth: Truth, results: Mapping[str, Finding]) -> dict[str, Finding]:
    """The findings, with what is right only because one of several columns happens to be as unclear: where nothing is called
    so, and there are more columns that might have been meant than answers that are missing."""
    found = sheet.found
    taken = {one.series.key for one in results.values() if one.series is not None}
    nameless = {
        symbol: one
        for symbol, one in results.items()
        if one.verdict in ("right", "not live") and one.series is not None and symbol in truth.columns
        if symbol not in found.called(one.series).symbols
    }
    if not nameless:
        return dict(results)
    spare = [series for series in found.series if series.key not in taken]
    known = anything(sheet.matrix(spare), vocabulary(truth), found.allowed, found.zeros)
    spare = [series for series, one in zip(spare, known, strict=True) if not one]
    excused = sum(one.verdict == "missing" for one in results.values())
    changed = dict(results)
    for symbol, one in nameless.items():
        if one.series is not None and rivals(found, one.series, spare, sheet.column) > excused:
            changed[symbol] = replace(one, verdict="unclear")
    return changed


_ANYBODYS = (0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 90.0, 180.0, 270.0, 360.0)
"""Numbers that stand in formulas for themselves."""


def typed_dimensions(found: Understanding, finding: Finding) -> tuple[str, ...]:
    """Dimensions that no cell holds and whose value stands as a number in a formula that the series depends on."""
    series = finding.series
    if series is None or series.main is None:
        return ()
    graph = found.graph
    above = graph.above({graph.work.strips.index(series.main)})
    numbers = {
        abs(part.value)
        for number in above
        for part in walk(graph.formulas[number])
        if isinstance(part, Number) and abs(part.value) not in _ANYBODYS
    }
    given = {one.symbol for one in found.inputs}
    result = []
    for dim in found.mechanism.dimensions if numbers else ():
        value = abs(found.truth.dimensions[dim.symbol])
        factors = (1.0, math.pi / 180) if dim.unit.kind == "angle" else (1.0,)
        there = any(abs(factor * number - value) <= 1e-9 * value for number in numbers for factor in factors)
        if not dim.path and dim.symbol not in given and there:
            result.append(dim.symbol)
    return tuple(result)


# --- one convention through a table ----------------------------------------------------------------------------------


def in_convention(sheet: Sheet) -> tuple[Sheet, dict[str, Finding]]:
    """A sheet and what is found in it, where what is not right is held against the conventions of the columns that it
    follows from."""
    found, first = sheet.found, findings(sheet)
    mechanism, truth = found.mechanism, found.truth
    names = {output.symbol for output in mechanism.outputs}
    open_ = {symbol for symbol, one in first.items() if one.verdict in ("wrong", "missing")}
    of = {summary.symbol: summary.of for summary in mechanism.summaries}
    followed = open_ & names | {of[symbol] for symbol in open_ & of.keys()}
    ways = {
        symbol: _counted(sheet, first, symbol) for symbol in sorted(_behind(mechanism, followed) & truth.columns.keys())
    }
    counted = {symbol: way for symbol, way in ways.items() if way is not None}
    if not counted:
        return sheet, first
    following = found.by_convention | set(_in_one_sense(mechanism, open_ & names, counted))
    found = replace(found, counted={**found.counted, **counted}, by_convention=following)
    found = replace(found, truth=as_counted(found, truth))
    if not found.truth.shifts:
        return sheet, first
    sheet = Sheet(found, sheet.asked)
    return sheet, first | {symbol: one for symbol, one in findings(sheet).items() if symbol in open_}


def _counted(sheet: Sheet, first: Mapping[str, Finding], symbol: str) -> tuple[Series, Reading] | None:
    """The column of a quantity and how it says it, most of its rows where some are wrong."""
    one = first.get(symbol)
    if one is None or one.series is None:
        return agreeing(sheet, sheet.found.truth, symbol)
    reading = one.reading or mostly(sheet, sheet.found.truth, symbol, one.series)
    return None if reading is None or not of_output(sheet.found, symbol, reading) else (one.series, reading)


def _in_one_sense(
    mechanism: Mechanism, outputs: Collection[str], counted: Mapping[str, tuple[Series, Reading]]
) -> Iterator[str]:
    """The outputs that may follow the columns' conventions: angles counted one way and the other give no sum."""
    angles = {link.angle_symbol for link in mechanism.links}
    for output in mechanism.outputs:
        named = angles.intersection(_behind(mechanism, {output.symbol}))
        senses = {counted[symbol][1].sense if symbol in counted else 1 for symbol in named}
        if output.symbol in outputs and output.symbol not in counted and len(senses) <= 1:
            yield output.symbol


def _behind(mechanism: Mechanism, names: set[str]) -> set[str]:
    """These quantities and all that their formulas name."""
    formulas = {output.symbol: output.formula for output in mechanism.outputs}

    def all_of(symbol: str) -> Iterator[str]:
        yield symbol
        for name in symbols(formulas[symbol]) if symbol in formulas else ():
            yield from all_of(name)

    return {name for symbol in names for name in all_of(symbol)}
