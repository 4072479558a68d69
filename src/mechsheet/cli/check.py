"""`mechsheet check`: recalculate and compare."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError

from .common import JSON, completing, modules_option, seconds_option
from .gate import Gate, concluded, descriptions_among, fails, gate_options, of_each, workbooks
from .helping import Explained
from .speaking import speak_of


def _programs() -> tuple[str, ...]:
    from mechsheet.checking.programs import PROGRAMS

    return tuple(PROGRAMS)


@click.command(cls=Explained, short_help="Recalculate and compare with the reference and other programs.")
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
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

    from .printing import print_line, print_report

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
                print_line(report)
            else:
                print_report(report)
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

    from .printing import print_mutation, print_perturbation

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
                (print_mutation if perturb is None else print_perturbation)(report)
    if faults:
        raise MechsheetError(faults)
    if not all(report.agrees for report in reports):
        sys.exit(1)
