"""What `check` and `recalc` both say of remarks and of stored values: a line for each thing and not for each cell."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from livesheet.diagnostics import Fault
from livesheet.said import Said, say, say_count

if TYPE_CHECKING:
    from mechsheet.checking.stored import Stored

MOST_LINES = 50
"""Most notes and most groups of differences that are printed; --json has all of them."""

MOST_DECIMALS = 4
"""Places that are named of one note."""

_KINDS = {
    "number": say("number"),
    "text": say("text"),
    "type": say("type"),
    "error": say("error"),
    "which error": say("which error"),
}
"""How two values differ: see `checking.stored.Difference`."""


def grouped(remarks: Iterable[Fault]) -> list[tuple[Fault, list[str]]]:
    """What is remarked of several cells in the same words, once, with the cells."""
    found: dict[tuple[str, str], tuple[Fault, list[str]]] = {}
    for fault in remarks:
        _, places = found.setdefault((fault.message, fault.hint), (fault, []))
        if fault.key:
            places.append(fault.key)
    return list(found.values())


def remark_lines(remarks: Iterable[Fault]) -> list[Said]:
    """A line for each thing that is remarked."""
    groups = grouped(remarks)
    lines = [remark_line(fault, places) for fault, places in groups[:MOST_LINES]]
    return lines + ([say("and {count} more", count=len(groups) - MOST_LINES)] if len(groups) > MOST_LINES else [])


def remark_line(fault: Fault, places: list[str]) -> Said:
    """`Plan!C2, Plan!D4 and 3 more: unknown function FOO (did you mean ...)`."""
    line = say("{message} ({hint})", message=fault.message, hint=fault.hint) if fault.hint else fault.message
    return say("{where}: {line}", where=_first(places), line=line) if places else say("{line}", line=line)


def _first(places: Sequence[str]) -> str:
    """`Plan!C2, Plan!D4 and 3 more`."""
    named = ", ".join(places[:MOST_DECIMALS])
    if len(places) <= MOST_DECIMALS:
        return named
    return say("{places} and {count} more", places=named, count=len(places) - MOST_DECIMALS)


def cell_text(value: object) -> str:
    """A value as a table shows it: numbers with all their digits, TRUE and FALSE."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    return str(value)


def stored_lines(stored: Stored) -> list[Said]:
    """What a comparison with the stored values found."""
    from mechsheet.checking.stored import COMPUTE_ANEW

    head = say_count("{count} formula", "{count} formulas", stored.formulas)
    differ = say_count("{count} differs", "{count} differ", len(stored.differences))
    lines = [say("{formulas}: {equal} as stored, {differ}", formulas=head, equal=stored.equal, differ=differ)]
    counts = [
        (stored.kept, "  {count} more was not computed: its stored value was taken",
         "  {count} more were not computed: their stored values were taken"),
        (stored.volatile, "  {count} more changes by itself (NOW, RAND ...): left out, its stored value was taken",
         "  {count} more change by themselves (NOW, RAND ...): left out, their stored values were taken"),
        (stored.ignored, "  {count} more is ignored", "  {count} more are ignored"),
        (stored.accepted, "  {count} more difference is accepted by the baseline",
         "  {count} more differences are accepted by the baseline"),
        (len(stored.uncomputed), "  {count} more was {why}", "  {count} more were {why}"),
    ]  # fmt: skip
    if stored.nothing_stored:
        lines.append(say("  no value is stored: nothing was compared"))
    else:
        counts.insert(0, (stored.unstored, "  {count} has no stored value", "  {count} have no stored value"))
    lines += [say_count(one, many, count, why=COMPUTE_ANEW) for count, one, many in counts if count]
    if stored.uncomputed:
        lines.append(say("    {places}", places=_first(stored.uncomputed)))
    return lines + _difference_lines(stored)


def _difference_lines(stored: Stored) -> list[Said]:
    lines = []
    follow = sum(item.follows for item in stored.differences)
    if follow:
        lines.append(
            say_count(
                "  {count} reads cells that differ themselves; the others, by their functions:",
                "  {count} read cells that differ themselves; the others, by their functions:",
                follow,
            )
        )
    groups = stored.groups()
    for group in groups[:MOST_LINES]:
        lines.append(
            say(
                "  {cells:>7} {kind}{size}  {functions}",
                cells=group.cells,
                kind=_KINDS[group.kind],
                size=say(" by {size:.1e}", size=group.first.size) if math.isfinite(group.first.size) else "",
                functions=group.functions or say("references"),
            )
        )
        shown = group.first.formula if len(group.first.formula) <= 80 else group.first.formula[:77] + "..."
        lines.append(say("{line}", line=f"{'':>10}{group.first.address} ={shown}"))
        ours, theirs = cell_text(group.first.ours), cell_text(group.first.theirs)
        nothing = say("nothing")
        lines.append(say("          computed {ours}, stored {theirs}", ours=ours or nothing, theirs=theirs or nothing))
    if (more := len(groups) - MOST_LINES) > 0:
        lines.append(say_count("  and {count} group more", "  and {count} groups more", more))
    return lines
