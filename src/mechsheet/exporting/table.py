"""csv: the driver, the variables, points and outputs over the sweep, one row per position, a unit in each heading."""

from __future__ import annotations

import csv
import io
import math

from mechsheet.compiled import motion_of
from mechsheet.exporting.job import Job

PLAIN = {"°": "deg"}
"""Units in letters that every program reads."""


def write(job: Job) -> list[bytes]:
    """The table in UTF-8, every number with all its digits; nothing where the position does not exist."""
    columns, units = motion_of(job.compiled)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_heading(symbol, PLAIN.get(units[symbol], units[symbol])) for symbol in columns)
    for row in zip(*(column.tolist() for column in columns.values()), strict=True):
        writer.writerow([repr(value) if math.isfinite(value) else "" for value in row])
    return [text.getvalue().encode()]


def _heading(symbol: str, unit: str) -> str:
    return f"{symbol} [{unit}]" if unit else symbol
