"""What a person should know of an audit beside its verdicts and faults."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from livesheet.formula.nodes import CellRef, NameRef, walk
from mechsheet import reference
from mechsheet.homework.agreement import Reading, gaps, units_of
from mechsheet.homework.inputs import SAME
from mechsheet.homework.judging import Judged
from mechsheet.homework.mends.candidates import terms
from mechsheet.homework.mends.faults import Mend, Suspect, first_difference
from mechsheet.homework.summaries import span_of
from mechsheet.homework.understanding import Understanding
from mechsheet.homework.verdicts import Finding, Sheet, mostly
from mechsheet.model import Mechanism
from mechsheet.words.catalogue import said, words_of_count

MOST_OF_ENGINE = 5
"""Remarks of the formula engine that are passed on."""


def remarks_of(judged: Judged, language: str) -> Iterator[str]:
    """The remarks, in sentences."""
    found = judged.found
    if judged.unusual:
        usual = found.factor > 0 and found.offset == 0.0
        yield said(language, "remark.law.driver" if usual else "remark.zero.driver")
    for text in found.work.remarks:
        key, _, rest = text.partition(" ")
        if key == "comma":
            yield words_of_count(language, "homework.remark.comma", int(rest))
        else:
            yield text
    if found.work.large:
        yield said(language, "remark.large")
    yield from _of_dimensions(found, language)
    for symbol, finding in judged.first.items():
        yield from _of_reading(symbol, finding.reading or judged.last[symbol].reading, found, language)
        if finding.verdict == "not live":
            dead = ", ".join(finding.dead)
            key = "remark.dead" if dead else "remark.typed"
            yield said(language, key, symbol=symbol, dimensions=dead)
        if finding.instead:
            yield said(language, "remark.instead", symbol=symbol, other=finding.instead)
        elif finding.verdict == "wrong" and finding.series is not None and symbol in found.truth.columns:
            yield from _of_rows(symbol, finding, judged, language)
    if judged.mends:
        yield from _of_mend(judged, judged.mends[0], language)
    if judged.suspect is not None:
        yield _of_suspect(judged, judged.suspect, language)
    yield from [str(fault) for fault in found.work.values.remarks][:MOST_OF_ENGINE]


def _of_dimensions(found: Understanding, language: str) -> Iterator[str]:
    """Dimensions that are others than the description's, and those without a cell."""
    mechanism = found.mechanism
    given = reference.dimension_values(mechanism)
    own = []
    for one in found.inputs:
        value = found.truth.dimensions[one.symbol]
        if abs(value - given[one.symbol]) > SAME * max(abs(given[one.symbol]), 1e-12):
            own.append(f"{one.symbol} = {_shown(mechanism, one.symbol, value)}")
    if own:
        yield said(language, "remark.own", given=", ".join(own))
    turned = [one.symbol for one in found.inputs if one.factor < 0]
    if turned:
        yield said(language, "remark.sign", symbols=", ".join(turned))
    if mechanism.driver.joint and found.factor != 1.0:
        yield said(language, "remark.unit", symbol=mechanism.driver.symbol, factor=found.factor)


def _shown(mechanism: Mechanism, symbol: str, value: float) -> str:
    unit = next(dim.unit for dim in mechanism.dimensions if dim.symbol == symbol)
    return f"{math.degrees(value):.10g}°" if unit.kind == "angle" else f"{value:.10g}"


def _of_reading(symbol: str, reading: Reading | None, found: Understanding, language: str) -> Iterator[str]:
    if reading is None:
        return
    single = symbol not in found.truth.columns
    quantity = span_of(found.truth, symbol).quantity if single else found.truth.quantity(symbol)
    if reading.sense < 0:
        yield said(language, "remark.clockwise" if quantity.kind == "angle" else "remark.backwards", symbol=symbol)
    if reading.offset:
        offset = math.degrees(math.remainder(-reading.offset, math.tau))
        yield said(language, "remark.zero", symbol=symbol, offset=offset)
    if quantity.kind != "angle" and reading.unit != 1.0:
        key = "remark.unit" if quantity.kind == "length" else "remark.unit.number"
        yield said(language, key, symbol=symbol, factor=reading.unit)


def _of_rows(symbol: str, finding: Finding, judged: Judged, language: str) -> Iterator[str]:
    """In how many rows a wrong quantity is right, where in some."""
    assert finding.series is not None
    quantity = judged.truth.quantity(symbol)
    sheet = Sheet(judged.found, list(judged.asked))
    column = sheet.column(finding.series)
    known = np.isfinite(quantity.values)
    allowed = judged.found.allowed(quantity)
    reading = mostly(sheet, judged.truth, symbol, finding.series)
    ways = [reading] if reading else [Reading(unit) for unit in units_of(quantity)]
    right = max(int((gaps(column, quantity, way)[known] <= allowed).sum()) for way in ways)
    if right >= max(2, known.sum() // 10):
        yield said(language, "remark.rows", symbol=symbol, right=right, rows=int(known.sum()))


def _of_mend(judged: Judged, mend: Mend, language: str) -> Iterator[str]:
    """What a mended fault did to the first quantity that it made wrong; where a term that is too many stands as well."""
    found = judged.found
    sheet = Sheet(replace(found, truth=judged.mended.found.truth), list(judged.asked))
    for symbol in mend.rights:
        series, last = judged.first[symbol].series, judged.last[symbol]
        if judged.first[symbol].verdict == "wrong" and series is not None:
            mended = (judged.mended, last.reading) if last.verdict == "right" and last.reading is not None else None
            yield _of_suspect(judged, first_difference(sheet, mend.strip, series, symbol, mended), language)
            break
    left = Counter(terms(mend.strip.formula)) - Counter(terms(mend.formula))
    lost = [term for term in left if isinstance(term, CellRef | NameRef)]
    if mend.kind != "term too many" or len(lost) != 1:
        return
    work = found.work
    bound = work.bound(lost[0], mend.strip)
    for number in sorted(found.graph.readers[work.strips.index(mend.strip)]) if mend.strip in work.strips else ():
        if bound in set(walk(found.graph.formulas[number])):
            strip = work.strips[number]
            where = work.where(strip.sheet, strip.start, strip.line)
            yield said(language, "remark.again", term=work.shown(bound, mend.strip.sheet), cell=where)


def _of_suspect(judged: Judged, suspect: Suspect, language: str) -> str:
    work = judged.found.work
    cell = work.where(*suspect.place)
    if suspect.wanted is None:
        return said(language, "remark.first", cell=cell)
    key = "remark.suspect" if math.isfinite(suspect.found) else "remark.suspect.none"
    return said(language, key, symbol=suspect.of, cell=cell, found=suspect.found, wanted=suspect.wanted)
