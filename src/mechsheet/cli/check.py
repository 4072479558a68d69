"""`mechsheet check`: recalculate and compare; and how it prints what it found."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import click

from livesheet.diagnostics import Fault
from livesheet.said import say, say_count
from mechsheet.diagnostics import MechsheetError

from .common import FILE, JSON, Explained, completing, modules_option, seconds_option
from .gate import Gate, concluded, descriptions_among, fails, gate_options, of_each, workbooks
from .speaking import speak_of, told


def _programs() -> tuple[str, ...]:
    from mechsheet.checking.programs import PROGRAMS

    return tuple(PROGRAMS)


@click.command(cls=Explained, short_help="Recalculate and compare with the reference and other programs.")
@click.argument("files", nargs=-1, required=True, type=FILE)
@click.option(
    "--with",
    "programs",
    default="",
    shell_complete=completing(_programs),
    help="Other programs to ask: formulas, ironcalc, libreoffice, gnumeric, onlyoffice.",
)
@click.option("--perturb", type=click.IntRange(min=1), metavar="N", help="Type N random sets of inputs and compare.")
@click.option("--mutate", type=click.IntRange(min=1), metavar="N", help="Damage N formulas: would anybody notice?")
@click.option("--seed", default=0, show_default=True, help="Another seed: other random sets, other damages.")
@modules_option
@gate_options
@click.option("--strict", is_flag=True, help="Exit code 1 even if something just cannot be computed or compared.")
@seconds_option()
@click.option("-q", "--quiet", is_flag=True, help="Say only what is wrong.")
@click.option("-v", "--verbose", is_flag=True, help="Say everything about each file, even if there are many.")
@JSON
def check(
    files: tuple[Path, ...],
    programs: str,
    modules: tuple[Path, ...],
    perturb: int | None,
    mutate: int | None,
    seed: int,
    seconds: float | None,
    quiet: bool,
    verbose: bool,
    as_json: bool,
    **options: Any,
) -> None:
    """Recalculate and compare: engine, stored values, numpy reference, verdicts, other programs.

    \b
    mechsheet check four-bar.xlsx
    mechsheet check edited.xlsx                     what did somebody change?
    mechsheet check four-bar.toml --with libreoffice,ironcalc
    mechsheet check four-bar.xlsx four-bar.ods      also compared cell by cell
    mechsheet check four-bar.xlsx --perturb 100 --with libreoffice
    mechsheet check four-bar.xlsx --mutate 200
    mechsheet check workbooks --junit report.xml    a folder and all below it
    mechsheet check workbooks --baseline accepted.txt --update-baseline

    Exit code 0: all agree; 1: something differs, or was edited, or a damage escapes; 2:
    cannot be read, or a judge is missing.
    """
    gate = Gate(**options)
    mode = "--mutate" if mutate is not None else "--perturb"
    if modules and (mutate is not None or perturb is not None):
        raise MechsheetError(
            Fault(say("{given} does not go with --perturb and --mutate", given="--functions"), key=mode)
        )
    if mutate is not None and (programs or perturb is not None):
        raise MechsheetError(Fault(say("--mutate goes with --seed and --json only"), key="--mutate"))
    if (mutate is not None or perturb is not None) and (gate.given() or gate.strict):
        given = ", ".join([*gate.given(), *(["--strict"] if gate.strict else [])])
        raise MechsheetError(Fault(say("{given} does not go with --perturb and --mutate", given=given), key=mode))
    found = workbooks(files)
    if len(found) == 1:
        speak_of(found[0])
    if mutate is None and perturb is None:
        _check(found, descriptions_among(files), programs, modules, gate, seconds, quiet, verbose, as_json)
    else:
        _try_out(found, programs, perturb, mutate, seed, seconds, quiet, as_json)


def _check(
    files: Sequence[Path],
    descriptions: Sequence[Path],
    programs: str,
    modules: Sequence[Path],
    gate: Gate,
    seconds: float | None,
    quiet: bool,
    verbose: bool,
    as_json: bool,
) -> None:
    """The plain check."""
    from mechsheet.checking import judge, with_twins
    from mechsheet.checking.programs import names_of, refuse_unknown
    from mechsheet.checking.report import report_lines

    asked = names_of(programs)
    refuse_unknown(asked)
    rules, baseline = gate.rules(), gate.accepted()
    faults: list[Fault] = []
    judged = of_each(
        files, faults, lambda file, tell: judge(file, asked, tell, rules, baseline, descriptions, modules), seconds
    )
    reports = with_twins(judged)
    if as_json:
        click.echo(json.dumps([report.as_dict() for report in reports], indent=2))
    else:
        for report in reports:
            fine = report.agrees and not report.unjudged and not fails(report, gate) and not report.missing
            if fine and quiet:
                continue
            if fine and len(files) > 1 and not verbose:
                _print_line(report)
            else:
                _print(report_lines(report))  # a line for each judge, the edits, the remarks
    concluded(gate, reports, baseline, faults)


def _try_out(
    files: Sequence[Path],
    programs: str,
    perturb: int | None,
    mutate: int | None,
    seed: int,
    seconds: float | None,
    quiet: bool,
    as_json: bool,
) -> None:
    """Random inputs, or damaged formulas."""
    from mechsheet import checking

    faults: list[Fault] = []
    reports: list[Any]
    if perturb is not None:
        reports = of_each(
            files, faults, lambda file, tell: checking.perturb(file, perturb, seed, programs, tell), seconds
        )
    else:
        count = mutate or 1
        reports = of_each(files, faults, lambda file, tell: checking.mutate(file, count, seed, tell), seconds)
    if as_json:
        click.echo(json.dumps([report.as_dict() for report in reports], indent=2))
    else:
        for report in reports:
            if not (report.agrees and quiet):
                (_print_mutation if perturb is None else _print_perturbation)(report)
    if faults:
        raise MechsheetError(faults)
    if not all(report.agrees for report in reports):
        sys.exit(1)


WIDTH = 80
"""Signs of a line on a terminal."""

SURVIVORS = 20
"""So many damages that the sheet does not catch are listed; with --json all."""


def _print_line(report: Any) -> None:
    """A check of many: all in one line."""
    from mechsheet.checking.stored_lines import grouped

    worst = max((item.worst for item in report.comparisons), default=0.0)
    count = len(report.remarks) + (len(grouped(report.stored.remarks)) if report.stored is not None else 0)
    notes = say("; notes: {count}", count=count) if count else ""

    def line(judges: str) -> str:
        pattern = "{file}: all agree, worst {worst:.0e} ({judges}){notes}"
        return told(say(pattern, file=report.file, worst=worst, judges=judges, notes=notes))

    whole = line(", ".join(told(say(item.judge)) for item in report.comparisons))
    click.echo(whole if len(whole) <= WIDTH else line(say("{count} judges", count=len(report.comparisons))))


def _print_perturbation(found: Any) -> None:
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


def _print_mutation(found: Any) -> None:
    """Damages: how many are caught by whom, and those that the sheet's own checks do not catch."""
    from mechsheet.checking.mutation import by_kind, by_sheet
    from mechsheet.checking.report import focused

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
