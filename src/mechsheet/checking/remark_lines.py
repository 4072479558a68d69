"""What is remarked of formulas, a line for each thing and not for each cell; what differs from stored values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from mechsheet.counted import counted
from mechsheet.diagnostics import Fault

if TYPE_CHECKING:
    from mechsheet.checking import Stored

MOST_LINES = 50
"""Most notes and most groups of differences that are printed; --json has all of them."""

MOST_PLACES = 4
"""Places that are named of one note."""


def grouped(remarks: Iterable[Fault]) -> list[tuple[Fault, list[str]]]:
    """What is remarked of several cells in the same words, once, with the cells."""
    found: dict[tuple[str, str], tuple[Fault, list[str]]] = {}
    for fault in remarks:
        _, places = found.setdefault((fault.message, fault.hint), (fault, []))
        if fault.key:
            places.append(fault.key)
    return list(found.values())


def remark_lines(remarks: Iterable[Fault]) -> list[str]:
    """A line for each thing that is remarked."""
    groups = grouped(remarks)
    lines = [remark_line(fault, places) for fault, places in groups[:MOST_LINES]]
    return lines + ([f"and {len(groups) - MOST_LINES} more"] if len(groups) > MOST_LINES else [])


def remark_line(fault: Fault, places: list[str]) -> str:
    """`Plan!C2, Plan!D4 and 3 more: unknown function FOO (did you mean ...)`."""
    where = _first(places)
    return f"{where}{': ' if where else ''}{fault.message}{f' ({fault.hint})' if fault.hint else ''}"


def _first(places: Sequence[str]) -> str:
    """`Plan!C2, Plan!D4 and 3 more`."""
    more = f" and {len(places) - MOST_PLACES} more" if len(places) > MOST_PLACES else ""
    return ", ".join(places[:MOST_PLACES]) + more


def cell_text(value: object) -> str:
    """A value as a table shows it: numbers with all their digits, TRUE and FALSE."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    return str(value)


def stored_lines(stored: Stored) -> list[str]:
    """What a comparison with the stored values found."""
    from mechsheet.checking.stored import COMPUTE_ANEW

    differ = counted(len(stored.differences), "differs", "differ")
    lines = [f"{counted(stored.formulas, 'formula')}: {stored.equal} as stored, {differ}"]
    if stored.nothing_stored:
        lines.append("  no value is stored: nothing was compared")
    elif stored.unstored:
        lines.append(f"  {counted(stored.unstored, 'has', 'have')} no stored value")
    if stored.kept:
        words = (
            "more was not computed: its stored value was taken",
            "more were not computed: their stored values were taken",
        )
        lines.append(f"  {counted(stored.kept, *words)}")
    if stored.volatile:
        own = "more changes by itself (NOW, RAND ...): left out, its stored value was taken"
        all_ = "more change by themselves (NOW, RAND ...): left out, their stored values were taken"
        lines.append(f"  {counted(stored.volatile, own, all_)}")
    if stored.ignored:
        lines.append(f"  {counted(stored.ignored, 'more is ignored', 'more are ignored')}")
    if stored.accepted:
        words = "more difference is accepted by the baseline", "more differences are accepted by the baseline"
        lines.append(f"  {counted(stored.accepted, *words)}")
    if stored.uncomputed:
        lines.append(f"  {counted(len(stored.uncomputed), 'more was', 'more were')} {COMPUTE_ANEW}")
        lines.append(f"    {_first(stored.uncomputed)}")
    return lines + _difference_lines(stored)


def _difference_lines(stored: Stored) -> list[str]:
    lines = []
    follow = sum(item.follows for item in stored.differences)
    if follow:
        words = counted(follow, "reads cells that differ themselves", "read cells that differ themselves")
        lines.append(f"  {words}; the others, by their functions:")
    groups = stored.groups()
    for group in groups[:MOST_LINES]:
        size = f" by {group.first.size:.1e}" if math.isfinite(group.first.size) else ""
        lines.append(f"  {group.cells:>7} {group.kind}{size}  {group.functions or 'references'}")
        shown = group.first.formula if len(group.first.formula) <= 80 else group.first.formula[:77] + "..."
        lines.append(f"{'':>10}{group.first.address} ={shown}")
        ours, theirs = cell_text(group.first.ours), cell_text(group.first.theirs)
        lines.append(f"{'':>10}computed {ours or 'nothing'}, stored {theirs or 'nothing'}")
    if len(groups) > MOST_LINES:
        lines.append(f"  and {counted(len(groups) - MOST_LINES, 'group')} more")
    return lines
