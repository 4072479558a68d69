"""What is remarked of formulas, a line for each thing and not for each cell; what differs from stored values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from livesheet.diagnostics import Fault
from livesheet.said import Said, say

if TYPE_CHECKING:
    from mechsheet.checking import Stored

MOST_LINES = 50
"""Most notes and most groups of differences that are printed; --json has all of them."""

MOST_PLACES = 4
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
    named = ", ".join(places[:MOST_PLACES])
    if len(places) <= MOST_PLACES:
        return named
    return say("{places} and {count} more", places=named, count=len(places) - MOST_PLACES)


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

    one = len(stored.differences) == 1
    head = say("{count} formula" if stored.formulas == 1 else "{count} formulas", count=stored.formulas)
    differ = say("{count} differs" if one else "{count} differ", count=len(stored.differences))
    lines = [say("{formulas}: {equal} as stored, {differ}", formulas=head, equal=stored.equal, differ=differ)]
    if stored.nothing_stored:
        lines.append(say("  no value is stored: nothing was compared"))
    else:
        lines += _counted(
            stored.unstored,
            say("  {count} has no stored value", count=stored.unstored),
            say("  {count} have no stored value", count=stored.unstored),
        )
    lines += _counted(
        stored.kept,
        say("  {count} more was not computed: its stored value was taken", count=stored.kept),
        say("  {count} more were not computed: their stored values were taken", count=stored.kept),
    )
    lines += _counted(
        stored.volatile,
        say(
            "  {count} more changes by itself (NOW, RAND ...): left out, its stored value was taken",
            count=stored.volatile,
        ),
        say(
            "  {count} more change by themselves (NOW, RAND ...): left out, their stored values were taken",
            count=stored.volatile,
        ),
    )
    lines += _counted(
        stored.ignored,
        say("  {count} more is ignored", count=stored.ignored),
        say("  {count} more are ignored", count=stored.ignored),
    )
    lines += _counted(
        stored.accepted,
        say("  {count} more difference is accepted by the baseline", count=stored.accepted),
        say("  {count} more differences are accepted by the baseline", count=stored.accepted),
    )
    uncomputed = len(stored.uncomputed)
    lines += _counted(
        uncomputed,
        say("  {count} more was {why}", count=uncomputed, why=COMPUTE_ANEW),
        say("  {count} more were {why}", count=uncomputed, why=COMPUTE_ANEW),
    )
    if stored.uncomputed:
        lines.append(say("    {places}", places=_first(stored.uncomputed)))
    return lines + _difference_lines(stored)


def _counted(count: int, one: Said, many: Said) -> list[Said]:
    """A line about so many; none about nothing."""
    return [one if count == 1 else many] if count > 0 else []


def _difference_lines(stored: Stored) -> list[Said]:
    lines = []
    follow = sum(item.follows for item in stored.differences)
    if follow:
        lines.append(
            say(
                "  {count} reads cells that differ themselves; the others, by their functions:"
                if follow == 1
                else "  {count} read cells that differ themselves; the others, by their functions:",
                count=follow,
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
        lines.append(say("  and {count} group more" if more == 1 else "  and {count} groups more", count=more))
    return lines
