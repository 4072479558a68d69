"""The kinds of export: one module and one line each."""

from __future__ import annotations

from mechsheet.exporting import table
from mechsheet.exporting.job import Kind

_ROWS = (
    Kind("csv", ".csv", "the variables over the sweep, with units", table.write),
)  # fmt: skip

KINDS = {kind.name: kind for kind in _ROWS}
"""Name -> kind, in the order of the help."""
