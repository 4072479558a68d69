"""One convention through a table: whoever counts an angle from another zero computes outputs and summaries from that angle.

A column that says its quantity in another sense, from another zero or in another turn is right; then what the description
computes from it by a formula, or takes from it over the rows, is right as it follows from the column as the sheet has it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from livesheet.formula.nodes import symbols
from mechsheet.homework.agreement import Reading
from mechsheet.homework.counting import as_counted
from mechsheet.homework.series import Series
from mechsheet.homework.verdicts import Finding, Sheet, agreeing, findings, mostly, of_output
from mechsheet.model import Mechanism


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
