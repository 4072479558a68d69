"""The report of a check of one file: what was found, and the lines that `check` prints of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from livesheet.diagnostics import Fault
from livesheet.said import say, say_count
from mechsheet.checking.stored_lines import remark_lines, stored_lines

if TYPE_CHECKING:
    from mechsheet.checking.comparison import Comparison
    from mechsheet.checking.stored import Stored

LONG = 100
"""Longer formulas are shown around the place in which they differ; with --json in full."""

AROUND = 30
"""So many signs of them before and behind it."""

EDITS = 40
"""So many edits are listed; with --json all."""


@dataclass(frozen=True, slots=True)
class Edit:
    """A place in a workbook that is not as its description would build it.

    kind   "changed" a formula is another one; "out of its run" so it is in a part of a filled range; "overwritten" a
           constant stands in its place; "emptied" nothing does; "formula" one stands in the place of an input; "value" a
           number that is no input; "name", "sheet" changed or missing; "deleted" rows or columns,
           "inserted" so inside a filled range
    where  the range, the name, or the sheet;  was, now  formulas or values there
    note   what else there is to say of the place
    """

    kind: str
    where: str
    was: str
    now: str
    note: str = ""


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
