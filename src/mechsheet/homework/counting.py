"""The mechanism as a sheet counts it: outputs and summaries of angles from another zero, in another turn, or sense."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from livesheet.engine import Values
from mechsheet.homework.agreement import Reading
from mechsheet.homework.expected_values import Shift, Truth
from mechsheet.homework.series import Series
from mechsheet.homework.understanding import Understanding
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
