"""One convention through a table: whoever counts an angle from another zero computes outputs and summaries from that angle.

A column that says its quantity in another sense, from another zero or in another turn is right; then what the description
computes from it by a formula, or takes from it over the rows, is right as it follows from the column as the sheet has it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechsheet.engine import Values
from mechsheet.formula.nodes import symbols
from mechsheet.homework.agreement import Reading
from mechsheet.homework.series import Series
from mechsheet.homework.truth import Shift, Truth
from mechsheet.homework.understanding import Understanding
from mechsheet.model import Mechanism
from mechsheet.reference.expressions import column as computed


def as_counted(found: Understanding, truth: Truth, values: Values | None = None) -> Truth:
    """A truth with the conventions of the sheet's columns, as these are in some state of the workbook."""
    shifts = {}
    for symbol, (series, reading) in found.counted.items():
        shift = _shift(found, truth, symbol, series, reading, values)
        if shift is not None:
            shifts[symbol] = shift
    if not shifts:
        return truth
    known = {name: np.array(value) for name, value in truth.dimensions.items()} | dict(truth.columns)
    known |= {symbol: shift.counted(truth.columns[symbol]) for symbol, shift in shifts.items()}
    columns = dict(truth.columns)
    for output in found.mechanism.outputs:
        if output.symbol in found.by_convention:
            values_ = computed(output.formula, known, len(truth.driver))
            columns[output.symbol] = known[output.symbol] = np.where(truth.exists, values_, np.nan)
    return replace(truth, columns=columns, shifts=shifts, spans={})


def _shift(
    found: Understanding, truth: Truth, symbol: str, series: Series, reading: Reading, values: Values | None
) -> Shift | None:
    """How a column counts: by the same in most rows, else it has no convention; None where it is the quantity itself."""
    own = reading.unit * series.column(found.work, values)
    apart = reading.sense * own - truth.columns[symbol]
    known = apart[np.isfinite(apart)]
    if not len(known):
        return None
    offset = float(np.median(known))
    allowed = found.allowed(truth.quantity(symbol))
    if 2 * (np.abs(known - offset) <= 2 * allowed).sum() <= len(known):
        return None
    return None if reading.sense == 1 and abs(offset) <= allowed else Shift(reading.sense, offset)


def behind(mechanism: Mechanism, names: set[str]) -> set[str]:
    """These quantities and all that their formulas name."""
    formulas = {output.symbol: output.formula for output in mechanism.outputs}

    def all_of(symbol: str) -> Iterator[str]:
        yield symbol
        for name in symbols(formulas[symbol]) if symbol in formulas else ():
            yield from all_of(name)

    return {name for symbol in names for name in all_of(symbol)}
