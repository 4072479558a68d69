"""The report of a check, and what `check` and `recalc` say of a workbook: a line for each thing and not for each cell."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from livesheet.diagnostics import Fault
from livesheet.said import Said, say, say_count

if TYPE_CHECKING:
    from mechsheet.checking.report import Comparison, Edit
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


@dataclass(frozen=True, slots=True)
class Report:
    """What `check` found in one file.

    edits    what somebody changed that is not there to be changed
    remarks  what a person should know (an input that was changed, a mode that was flipped …)
    stored   the stored values, cell by cell
    missing  programs that were asked for and are not there, with what to install: the check is not what was asked for
    red_line   what the line under the title of a workbook of ours says where it is red
    nameless   whether it is a workbook of ours without its description: there is nothing to compare it with
    stale      what the description file of its name says otherwise than the description it was built from
    """

    file: str
    comparisons: tuple[Comparison, ...]
    remarks: tuple[str, ...] = ()
    edits: tuple[Edit, ...] = ()
    stored: Stored | None = None
    missing: tuple[Fault, ...] = ()
    red_line: str = ""
    nameless: bool = False
    stale: str = ""

    @property
    def values_agree(self) -> bool:
        """True when all judges agree."""
        return all(comparison.agrees for comparison in self.comparisons)

    @property
    def agrees(self) -> bool:
        """True when all judges agree, nothing was edited but inputs, the workbook itself calls nothing wrong, and it
        is the one that its description builds."""
        return self.values_agree and not (self.edits or self.red_line or self.stale)

    @property
    def compared(self) -> bool:
        """Whether any judge has compared anything."""
        return any(comparison.cells for comparison in self.comparisons)

    @property
    def unjudged(self) -> list[str]:
        """What keeps an agreement from being one of the whole workbook."""
        found: list[str] = [
            say("no value is stored") if comparison.judge == "stored values" else
            say("nothing was compared: {judge}", judge=say(comparison.judge))
            for comparison in self.comparisons
            if not comparison.cells
        ]  # fmt: skip
        if self.stored is not None and (count := self.stored.not_computed):
            found.append(say_count("{count} cell was not computed", "{count} cells were not computed", count))
        if self.nameless:
            found.append(say("it carries no description"))
        return found

    def _repr_pretty_(self, printer: Any, _cycle: bool) -> None:
        """Its lines, for notebooks: what `mechsheet check` prints."""
        printer.text("\n".join(report_lines(self)))

    def as_dict(self) -> dict[str, Any]:
        """The report as JSON data."""
        return {
            "file": self.file,
            "agrees": self.agrees,
            "unjudged": list(map(str, self.unjudged)),
            "red line": self.red_line,
            "stale": self.stale,
            "remarks": list(self.remarks),
            "edits": [
                {"kind": edit.kind, "where": edit.where, "was": edit.was, "now": edit.now} for edit in self.edits
            ],
            "comparisons": [
                {
                    "judge": item.judge,
                    "cells": item.cells,
                    "worst": item.worst,
                    "where": item.where,
                    "ours": item.ours,
                    "theirs": item.theirs,
                    "agrees": item.agrees,
                }
                for item in self.comparisons
            ],
            "stored": self.stored.as_dict() if self.stored is not None else None,
            "missing": [fault.message for fault in self.missing],
        }


LONG = 100
"""Longer formulas are shown around the place in which they differ; with --json in full."""

AROUND = 30
"""So many signs of them before and behind it."""

EDITS = 40
"""So many edits are listed; with --json all."""


def report_lines(report: Report) -> list[str]:
    """A check: a line for each judge, the edits, the remarks."""
    lines: list[str] = []
    lines.append(_verdict(report))
    for item in report.comparisons:
        pattern = "  {judge:<14} DIFFERS {worst:6.0e} in {cells:>6} {values:<6}  {where}"
        if item.agrees:
            pattern = "  {judge:<14} agrees  {worst:6.0e} in {cells:>6} {values:<6}  {where}"
        if item.agrees and not item.cells:
            pattern = "  {judge:<14} nothing was compared"
        values = say_count("value", "values", item.cells)
        parts = {
            "judge": say(item.judge),
            "worst": item.worst,
            "cells": item.cells,
            "values": values,
            "where": item.where,
        }
        lines.append(say(pattern, **parts))
        if not item.agrees:
            theirs = item.theirs or say("nothing")
            lines.append(
                say(
                    "                 {subject} {ours}, {judge} {theirs}",
                    subject=item.subject,
                    ours=item.ours,
                    judge=say(item.judge),
                    theirs=theirs,
                )
            )
        if report.stored is not None and item is report.comparisons[0]:
            for line in stored_lines(report.stored)[1:]:
                lines.append(say("  {line}", line=line))
    if report.stale:
        lines.append(say("  stale: {what}", what=report.stale))
    if report.red_line:
        lines.append(say("  the line under its title says: {line}", line=report.red_line))
    for edit in report.edits[:EDITS]:
        was, now = focused(edit.was, edit.now)
        lines.append(
            say(
                "  edited: {where} {what}{note}",
                where=edit.where,
                what=_WORDS.get(edit.kind, edit.kind),
                note=edit.note,
            )
        )
        if edit.kind == "inserted":
            continue
        lines.append(say("          was {was}", was=was or say("empty")))
        lines.append(say("          is  {now}", now=now or say("empty")))
    if len(report.edits) > EDITS:
        more = len(report.edits) - EDITS
        lines.append(
            say(
                "  edited: {count} more place (all with --json)"
                if more == 1
                else "  edited: {count} more places (all with --json)",
                count=more,
            )
        )
    for remark in [*report.remarks, *(remark_lines(report.stored.remarks) if report.stored is not None else ())]:
        lines.append(say("  note: {remark}", remark=remark))
    for fault in report.missing:
        lines.append(say("  note: {message}: skipped", message=fault.message))
    return lines


_WORDS = {
    "changed": say("has another formula"),
    "out of its run": say("has a formula of its own"),
    "overwritten": say("was overwritten"),
    "emptied": say("was emptied"),
    "formula": say("holds a formula in place of a number"),
    "value": say("holds another number"),
    "name": say("is a name that was changed"),
    "sheet": say("is a sheet that is not as it was"),
    "deleted": say("was deleted"),
    "inserted": say("was inserted"),
}


def _verdict(report: Report) -> str:
    if report.agrees and not report.compared:
        return say("{file}: NOTHING WAS COMPARED", file=report.file)
    if report.agrees and report.unjudged:
        return say("{file}: all compared agree; {but}", file=report.file, but=report.unjudged[0])
    if report.agrees:
        return say("{file}: all agree", file=report.file)
    if report.values_agree and not (report.edits or report.red_line):
        return say("{file}: STALE, all values agree", file=report.file)
    if report.values_agree and not report.edits:
        return say("{file}: all values agree, BUT IT SAYS ITSELF THAT SOMETHING IS WRONG", file=report.file)
    if report.values_agree and not report.compared:
        return say("{file}: EDITED, NOTHING WAS COMPARED", file=report.file)
    if report.values_agree and report.unjudged:
        return say("{file}: EDITED, all compared agree; {but}", file=report.file, but=report.unjudged[0])
    if report.values_agree:
        return say("{file}: EDITED, all values agree", file=report.file)
    if report.edits:
        return say("{file}: EDITED, AND SOMETHING DIFFERS", file=report.file)
    return say("{file}: SOMETHING DIFFERS", file=report.file)


def focused(was: str, now: str) -> tuple[str, str]:
    """Two formulas, long ones cut down to where they differ."""
    if max(len(was), len(now)) <= LONG:
        return was, now
    start = max(0, _common(was, now) - AROUND)
    behind = _common(was[start:][::-1], now[start:][::-1])
    cut = max(0, behind - AROUND)
    return _cut(was, start, cut), _cut(now, start, cut)


def _common(one: str, other: str) -> int:
    """How many signs two texts have in common at their beginning."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((place for place, (left, right) in pairs if left != right), min(len(one), len(other)))


def _cut(text: str, start: int, cut: int) -> str:
    end = len(text) - cut
    middle = text[start:end]
    if len(middle) > 2 * LONG:
        middle = middle[: 2 * LONG] + "…"
    return ("…" if start else "") + middle + ("…" if cut else "")
