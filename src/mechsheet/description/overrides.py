"""Changing a description's dimensions as the command line asks: the values as typed are checked, then written into its text.

The text is changed first and read afterwards, so what is read is what the workbook will carry.
"""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Mapping

from mechsheet.description.index import Path
from mechsheet.description.numbers import typed_number
from mechsheet.description.quoting import quoted
from mechsheet.description.report import suggestion
from mechsheet.description.rewrite import with_value
from mechsheet.description.source import Source
from mechsheet.diagnostics import Fault


def with_values(source: Source, values: Mapping[str, str]) -> tuple[Source, list[Fault]]:
    """The source with dimensions changed to `values` (in their own units), and what is wrong with these."""
    faults: list[Fault] = []
    entries = source.data.get("dimensions")
    entries = entries if isinstance(entries, dict) else {}
    inputs = [name for name, entry in entries.items() if not (isinstance(entry, dict) and "formula" in entry)]
    for given, value in values.items():
        name, key = unicodedata.normalize("NFC", given.strip()), f"overrides: {given}={value}"
        number = typed_number(value)
        plain = number is not None and not number.unit and math.isfinite(float(number.text))
        if name not in entries:
            hint = suggestion(name, inputs, "inputs")
            faults.append(Fault(f"no dimension is called {quoted(name)}", source.file, key=key, hint=hint))
        elif name not in inputs:
            message = f"the dimension {quoted(name)} is derived from others"
            hint = "change the dimensions in its formula instead; " + suggestion(name, inputs, "inputs")
            faults.append(Fault(message, source.file, key=key, hint=hint))
        elif number is None or not plain or number.why:
            message = f"expected a number, found {quoted(value.strip())}"
            hint = number.hint if number and plain else "a plain number in the dimension's own unit"
            faults.append(Fault(message, source.file, key=key, hint=hint))
        elif (place := _place(name, entries[name])) in source.spots:  # without a value the reader will complain
            source = with_value(source, place, number.text)
    return source, faults


def _place(name: str, entry: object) -> Path:
    return ("dimensions", name, "value") if isinstance(entry, dict) else ("dimensions", name)
