"""Differences that somebody has accepted, as a text that is kept beside the workbooks: one line a cell, sorted.

    models/plan.xlsx<tab>Plan!B5<tab>computed 2<tab>stored 2.5

Only cells that are at fault have lines, not those that follow from them. A file is named from the folder of the baseline.
An entry accepts the difference with these two values and no other.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from livesheet.diagnostics import Fault, WorkbookError, readable_name
from livesheet.formula.nodes import ErrorValue, Scalar
from livesheet.formula.references import parse_reference
from livesheet.said import say
from mechsheet.checking.comparison import TOLERANCE
from mechsheet.checking.stored import Difference, Stored

HEAD = "# Differences accepted by mechsheet --baseline; --update-baseline writes this file anew."
_COMPUTED, _STORED = "computed ", "stored "


@dataclass(frozen=True, slots=True)
class Entry:
    """A cell of a file with the values that are accepted there, as `shown` spells them."""

    file: str
    cell: str
    computed: str
    stored: str

    def line(self) -> str:
        """The entry as it stands in the file."""
        return "\t".join((self.file, self.cell, _COMPUTED + self.computed, _STORED + self.stored))

    def key(self) -> tuple[str, str, int, int]:
        """What entries are sorted by."""
        place = parse_reference(self.cell)
        return (self.file, place.sheet or "", place.row, place.col) if place else (self.file, self.cell, 0, 0)

    def accepts(self, found: Difference) -> bool:
        """Whether a difference in its cell is the one that was accepted."""
        return _alike(self.computed, shown(found.ours)) and _alike(self.stored, shown(found.theirs))


def shown(value: Scalar) -> str:
    """A value as entries spell it: numbers with 12 digits, texts in quotation marks, nothing for an empty cell."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, ErrorValue):
        return str(value)
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else f"{value:.12g}"


def _alike(one: str, other: str) -> bool:
    if one == other:
        return True
    try:
        return math.isclose(float(one), float(other), rel_tol=TOLERANCE)
    except ValueError:
        return False


class Baseline:
    """The entries of one baseline file. `unused` grows with every file that is checked against it."""

    def __init__(self, path: Path, entries: Iterable[Entry] = ()) -> None:
        self.path = path
        self.entries = sorted(entries, key=Entry.key)
        self.checked: dict[str, list[Entry]] = {}
        self.unused: list[Entry] = []

    def name_of(self, file: Path) -> str:
        """A file as entries name it: from the baseline's folder."""
        try:
            return Path(os.path.relpath(file, self.path.parent)).as_posix()
        except ValueError:  # another drive
            return file.absolute().as_posix()

    def accept(self, file: Path, found: Stored) -> Stored:
        """What remains of the differences of a file."""
        name = self.name_of(file)
        entries: Mapping[str, Entry] = {entry.cell: entry for entry in self.entries if entry.file == name}
        used, kept = set(), []
        for item in found.differences:
            entry = entries.get(item.address)
            if entry is not None and not item.follows and entry.accepts(item):
                used.add(entry)
            else:
                kept.append(item)
        self.checked[name] = [_entry(name, item) for item in found.own()]
        self.unused += [entry for entry in entries.values() if entry not in used]
        return replace(found, differences=tuple(kept), accepted=len(used))

    def updated(self) -> str:
        """The file with the differences of all files that were checked, and the entries of the others."""
        entries = [entry for entry in self.entries if entry.file not in self.checked]
        entries += [entry for found in self.checked.values() for entry in found]
        lines = [HEAD, *(entry.line() for entry in sorted(entries, key=Entry.key))]
        return "\n".join(lines) + "\n"


def _entry(name: str, item: Difference) -> Entry:
    return Entry(name, item.address, shown(item.ours), shown(item.theirs))


def read_baseline(path: Path, must_exist: bool = True) -> Baseline:
    """The baseline in a file. Raises WorkbookError when it cannot be read, or a line is no entry."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        if not must_exist:
            return Baseline(path)
        hint = say("write one with --update-baseline")
        raise WorkbookError(Fault(say("there is no such baseline"), readable_name(path), hint=hint)) from None
    except (OSError, UnicodeDecodeError) as problem:
        raise WorkbookError(Fault(say("cannot be read: {reason}", reason=problem), readable_name(path))) from problem
    entries, faults = [], []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        parts = line.split("\t")
        if len(parts) == 4 and parts[2].startswith(_COMPUTED) and parts[3].startswith(_STORED):
            entries.append(Entry(parts[0], parts[1], parts[2][len(_COMPUTED) :], parts[3][len(_STORED) :]))
        else:
            message = say("no entry of a baseline: file, cell, computed, stored, with tabs between them")
            faults.append(Fault(message, readable_name(path), number, source=line))
    if faults:
        raise WorkbookError(faults)
    return Baseline(path, entries)
