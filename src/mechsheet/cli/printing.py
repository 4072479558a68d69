"""How `mechsheet check` prints what it found."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import click

from livesheet.said import say, say_count
from mechsheet.checking.report_lines import focused, grouped, report_lines

from .speaking import told

WIDTH = 80
"""Signs of a line on a terminal."""

SURVIVORS = 20
"""So many damages that the sheet does not catch are listed; with --json all."""


def print_line(report: Any) -> None:
    """A check of many: all in one line."""
    worst = max((item.worst for item in report.comparisons), default=0.0)
    count = len(report.remarks) + (len(grouped(report.stored.remarks)) if report.stored is not None else 0)
    notes = say("; notes: {count}", count=count) if count else ""

    def line(judges: str) -> str:
        pattern = "{file}: all agree, worst {worst:.0e} ({judges}){notes}"
        return told(say(pattern, file=report.file, worst=worst, judges=judges, notes=notes))

    whole = line(", ".join(told(say(item.judge)) for item in report.comparisons))
    click.echo(whole if len(whole) <= WIDTH else line(say("{count} judges", count=len(report.comparisons))))


def print_report(report: Any) -> None:
    """A check: a line for each judge, the edits, the remarks."""
    _print(report_lines(report))


def print_perturbation(found: Any) -> None:
    """Random sets of inputs: how many assemble, and the worst of each judge with the set that caused it."""
    sets = say_count("{count} set", "{count} sets", found.sets)
    lines = [
        say("{file}: all agree", file=found.file) if found.agrees else
        say("{file}: SOMETHING DIFFERS", file=found.file),
        say("  {sets} (seed {seed}): {whole} in all {rows}, {partly} in some, {nowhere} in none",
            sets=sets, seed=found.seed, whole=say_count("{count} assembles", "{count} assemble", found.whole),
            rows=say_count("{count} row", "{count} rows", found.rows), partly=found.partly, nowhere=found.nowhere),
    ]  # fmt: skip
    for item in found.judged:
        worst = item.worst
        pattern = "  {judge:<14} agrees  {cells:>8} {values}, worst {worst:9.2e}  {where}"
        if item.differing:
            pattern = "  {judge:<14} DIFFERS {cells:>8} {values}, worst {worst:9.2e}  {where}"
        values = say_count("value", "values", item.cells)
        judge = say(worst.judge)
        lines.append(say(pattern, judge=judge, cells=item.cells, values=values, worst=worst.worst, where=worst.where))
        if item.differing:
            lines += [
                say("                 in {count} of {sets}; here {subject} {ours},",
                    count=item.differing, sets=sets, subject=worst.subject, ours=worst.ours),
                say("                 {judge} {theirs}", judge=judge, theirs=worst.theirs or say("nothing")),
            ]  # fmt: skip
        lines.append(
            say("                 set {number}: {set}", number=item.setting.number + 1, set=item.setting.text())
        )
    _print(lines)


def print_mutation(found: Any) -> None:
    """Damages: how many are caught by whom, and those that the sheet's own checks do not catch."""
    from mechsheet.checking.mutation import by_kind, by_sheet

    lines = [
        say("{file}: check catches all damages", file=found.file) if found.agrees else
        say("{file}: A DAMAGE ESCAPES", file=found.file),
        say("  {damages} (seed {seed}); {harmless}, {circular} cannot be computed", seed=found.seed,
            damages=say_count("{count} damage that changes a value", "{count} damages that change a value",
                              len(found.damages)),
            harmless=say_count("{count} more changes none", "{count} more change none", found.harmless),
            circular=found.circular),
    ]  # fmt: skip
    if not found.clear:
        lines.append(say("  note: the sheet's checks are not clear without any damage: what they catch means nothing"))
    for by, name in _CATCHERS.items():
        pattern = "  {name:<20} {caught:>5} caught, {share:7.2%}"
        lines.append(say(pattern, name=name, caught=found.caught(by), share=found.share(by)))
    for pattern, what in (
        ("  sheet's checks by sheet: {parts}", by_sheet),
        ("  sheet's checks by kind: {parts}", by_kind),
    ):
        parts = (f"{key} {caught}/{number}" for key, (number, caught) in found.tally(what).items())
        lines.append(say(pattern, parts=", ".join(parts)))
    survivors = [damage for damage in found.damages if not (damage.sheet and damage.check)]
    for damage in survivors[:SURVIVORS]:
        was, now = focused(damage.was, damage.now)
        caught = say("only check") if damage.check else say("not caught")
        lines += [
            say("  {caught}: {where} ({kind})", caught=caught, where=damage.where, kind=damage.kind),
            say("          was {was}", was=was),
            say("          is  {now}", now=now),
        ]
    if (more := len(survivors) - SURVIVORS) > 0:
        lines.append(say("  {count} more (all with --json)", count=more))
    _print(lines)


_CATCHERS = {"check": say("check"), "reference": say("  reference only"), "sheet": say("sheet's checks")}
"""Who may catch a damage, and how each is called."""


def _print(lines: Iterable[str]) -> None:
    for line in lines:
        click.echo(told(line))
