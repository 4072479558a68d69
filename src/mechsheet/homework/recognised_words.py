"""What a workbook seems to be, in words and as JSON data."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from livesheet.diagnostics import readable_name
from mechsheet.homework.headings import around
from mechsheet.homework.recognition import Recognised, Table
from mechsheet.homework.series import Series
from mechsheet.words.catalogue import said

MOST = 40
"""Columns that are listed."""


def lines(tables: Sequence[Table], known: Recognised | None, workbook: Path, language: str) -> list[str]:
    """Which linkage it is, its driver, its dimensions, its columns; what is there, where it is none that is known."""
    name = readable_name(workbook)
    if known is None:
        return [said(language, "unrecognised", file=name), *_there(tables, language)]
    found = known.found
    work, mechanism = found.work, found.mechanism
    first = said(language, "recognised", file=name, title=mechanism.title.of(language), template=known.template)
    rows = [(mechanism.driver.symbol, _cells(known), said(language, "driver"))]
    for one in found.inputs:
        rows.append((one.symbol, work.where(*one.place), f"{work.number(one.place):.10g}"))
    for series, quantity, reading in known.quantities:
        rows.append((quantity, series.where(work), "" if reading.plain else said(language, "otherwise")))
    zero = [
        symbol
        for symbol, value in found.truth.dimensions.items()
        if value == 0.0 and symbol not in known.missing and symbol not in {one.symbol for one in found.inputs}
    ]
    told = [first, *_aligned(rows)]
    if zero:
        told.append(said(language, "taken as zero", symbols=", ".join(zero)))
    if known.missing:
        told.append(said(language, "not there", symbols=", ".join(known.missing)))
    open_columns = [series.where(work) for series in _unexplained(known)]
    if open_columns:
        told.append(said(language, "unexplained", cells=", ".join(open_columns[:MOST])))
    return told


def _cells(known: Recognised) -> str:
    run = known.found.driver
    return known.found.work.where(run.sheet, run.start, run.line, run.length)


def _unexplained(known: Recognised) -> list[Series]:
    keys = {series.key for series, _, _ in known.quantities}
    return [series for series in known.found.series if series.key not in keys]


def _there(tables: Sequence[Table], language: str) -> list[str]:
    """The driver, the numbers and the columns of the likeliest table."""
    if not tables:
        return [said(language, "no table")]
    table = tables[0]
    work = table.graph.work
    rows = [
        (said(language, "driver"), work.where(table.run.sheet, table.run.start, table.run.line, table.run.length), "")
    ]
    rows += [(" ".join(around(work, cell)[:1]), work.where(*cell), f"{work.number(cell):.10g}") for cell in table.cells]
    rows += [("", series.where(work), "") for series in table.series[:MOST]]
    return _aligned(rows)


def _aligned(rows: Sequence[tuple[str, str, str]]) -> list[str]:
    wide = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    return [f"{one:<{wide[0]}}  {two:<{wide[1]}}  {three}".rstrip() for one, two, three in rows]


def as_dict(known: Recognised | None) -> dict[str, Any]:
    """As JSON data."""
    if known is None:
        return {"template": None}
    found = known.found
    return {
        "template": known.template,
        "driver": _cells(known),
        "dimensions": {
            one.symbol: {"cell": found.work.where(*one.place), "value": found.work.number(one.place)}
            for one in found.inputs
        },
        "quantities": {quantity: series.where(found.work) for series, quantity, _ in known.quantities},
        "missing": list(known.missing),
        "unexplained": [series.where(found.work) for series in _unexplained(known)],
    }
