"""What `check` says of a workbook, line by line."""

from __future__ import annotations

from typing import Any

from livesheet.said import say, say_count
from mechsheet.checking.remark_lines import remark_lines, stored_lines

LONG = 100
"""Longer formulas are shown around the place in which they differ; with --json in full."""

AROUND = 30
"""So many signs of them before and behind it."""

EDITS = 40
"""So many edits are listed; with --json all."""


def report_lines(report: Any) -> list[str]:
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


def _verdict(report: Any) -> str:
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
