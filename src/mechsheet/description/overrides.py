"""Changing a description's text as the command line asks: single numbers, in place, with every comment kept.

The text is changed first and read afterwards, so what is read is what the workbook will carry.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping

from mechsheet.description.index import Path
from mechsheet.description.quoting import quoted
from mechsheet.description.report import suggestion
from mechsheet.description.source import Source
from mechsheet.diagnostics import Fault

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_WHOLE = re.compile(r"[+-]?\d{1,15}", re.ASCII)


def with_values(source: Source, values: Mapping[str, str]) -> tuple[str, list[Fault]]:
    """The text with dimensions changed to `values` (in their own units), and what is wrong with these."""
    faults: list[Fault] = []
    changes: list[tuple[int, int, str]] = []
    entries = source.data.get("dimensions")
    entries = entries if isinstance(entries, dict) else {}
    inputs = [name for name, entry in entries.items() if not (isinstance(entry, dict) and "formula" in entry)]
    for given, value in values.items():
        name, key = unicodedata.normalize("NFC", given.strip()), f"overrides: {given}={value}"
        if name not in entries:
            hint = suggestion(name, inputs, "inputs")
            faults.append(Fault(f"no dimension is called {quoted(name)}", source.file, key=key, hint=hint))
        elif name not in inputs:
            message = f"the dimension {quoted(name)} is derived from others"
            hint = "change the dimensions in its formula instead; " + suggestion(name, inputs, "inputs")
            faults.append(Fault(message, source.file, key=key, hint=hint))
        elif reason := _reason_against(value):
            faults.append(Fault(reason[0], source.file, key=key, hint=reason[1]))
        elif spot := source.spots.get(_place(name, entries[name])):  # without a value the reader will complain
            changes.append((spot.start, spot.end, toml_number(value)))
    return _replaced(source.text, changes), faults


def _place(name: str, entry: object) -> Path:
    return ("dimensions", name, "value") if isinstance(entry, dict) else ("dimensions", name)


def _reason_against(value: str) -> tuple[str, str] | None:
    text = value.strip()
    if _NUMBER.fullmatch(text) and math.isfinite(float(text)):
        return None
    comma = text.replace(",", ".")
    hint = f"write {comma}" if _NUMBER.fullmatch(comma) else "a plain number in the dimension's own unit"
    return f"expected a number, found {quoted(text)}", hint


def toml_number(value: str) -> str:
    """A number as typed (`.5`, `05`, `+3.`) in TOML's spelling."""
    text = value.strip()
    return str(int(text)) if _WHOLE.fullmatch(text) else repr(float(text))


def with_language(source: Source, language: str) -> str:
    """The text with `workbook.language` set, wherever a description may keep that key."""
    text, line = source.text, f'language = "{language}"'
    spots = source.spots
    if ("workbook", "language") in spots:
        spot = spots["workbook", "language"]
        return _replaced(text, [(spot.start, spot.end, f'"{language}"')])
    table = spots.get(("workbook",))
    if table is None:
        return text.rstrip("\n") + f"\n\n[workbook]\n{line}\n"
    if table.how == "header":
        return _replaced(text, [(table.end, table.end, f"\n{line}")])
    if table.how == "inline":
        comma = ", " if source.data["workbook"] else ""
        return _replaced(text, [(table.start + 1, table.start + 1, f" {line}{comma}")])
    # `workbook.references = …` at the root: one more such line before it.
    start = text.rfind("\n", 0, table.start) + 1
    return _replaced(text, [(start, start, f"workbook.{line}\n")])


def _replaced(text: str, changes: list[tuple[int, int, str]]) -> str:
    for start, end, new in sorted(changes, reverse=True):
        text = text[:start] + new + text[end:]
    return text
