"""How `mechsheet check` prints what it found."""

from __future__ import annotations

from typing import Any

import click

from livesheet.counted import counted
from livesheet.said import say
from mechsheet.checking.mutation import by_kind, by_sheet
from mechsheet.checking.remark_lines import grouped
from mechsheet.checking.report_lines import focused, report_lines

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
    for line in report_lines(report):
        click.echo(told(line))


def print_perturbation(found: Any) -> None:
    """Random sets of inputs: how many assemble, and the worst of each judge with the set that caused it."""
    click.echo(f"{found.file}: {'all agree' if found.agrees else 'SOMETHING DIFFERS'}")
    click.echo(
        f"  {counted(found.sets, 'set')} (seed {found.seed}): {counted(found.whole, 'assembles', 'assemble')} in all "
        f"{counted(found.rows, 'row')}, {found.partly} in some, {found.nowhere} in none"
    )
    for item in found.judged:
        worst = item.worst
        verdict = "agrees " if not item.differing else "DIFFERS"
        click.echo(f"  {worst.judge:<14} {verdict} {item.cells:>8} values, worst {worst.worst:9.2e}  {worst.where}")
        if item.differing:
            click.echo(
                f"  {'':<14} in {item.differing} of {counted(found.sets, 'set')}; here {worst.subject} {worst.ours}, "
            )
            click.echo(f"  {'':<14} {worst.judge} {worst.theirs or 'nothing'}")
        click.echo(f"  {'':<14} set {item.setting.number + 1}: {item.setting.text()}")


def print_mutation(found: Any) -> None:
    """Damages: how many are caught by whom, and those that the sheet's own checks do not catch."""
    count = len(found.damages)
    click.echo(f"{found.file}: {'check catches all damages' if found.agrees else 'A DAMAGE ESCAPES'}")
    click.echo(
        f"  {counted(count, 'damage that changes', 'damages that change')} a value (seed {found.seed}); "
        f"{counted(found.harmless, 'more changes', 'more change')} none, {found.circular} cannot be computed"
    )
    if not found.clear:
        click.echo("  note: the sheet's checks are not clear without any damage: what they catch means nothing")
    names = {"check": "check", "reference": "  reference only", "sheet": "sheet's checks"}
    for by, name in names.items():
        click.echo(f"  {name:<18} {found.caught(by):>5} caught, {found.share(by):7.2%}")
    for title, what in (("by sheet", by_sheet), ("by kind", by_kind)):
        parts = (f"{key} {caught}/{number}" for key, (number, caught) in found.tally(what).items())
        click.echo(f"  sheet's checks {title}: {', '.join(parts)}")
    survivors = [damage for damage in found.damages if not (damage.sheet and damage.check)]
    for damage in survivors[:SURVIVORS]:
        was, now = focused(damage.was, damage.now)
        click.echo(f"  {'not caught' if not damage.check else 'only check'}: {damage.where} ({damage.kind})")
        click.echo(f"          was {was}")
        click.echo(f"          is  {now}")
    if len(survivors) > SURVIVORS:
        click.echo(f"  {len(survivors) - SURVIVORS} more (all with --json)")
