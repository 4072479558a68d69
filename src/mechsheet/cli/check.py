"""`mechsheet check`: recalculate and compare."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from mechsheet.diagnostics import Fault, MechsheetError

from .common import JSON, progress

if TYPE_CHECKING:
    from mechsheet.checking import Mutation, Perturbation, Report

Found = TypeVar("Found")


@click.command()
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--with", "programs", default="", help="Other judges: formulas, ironcalc, libreoffice, gnumeric.")
@click.option("--perturb", type=click.IntRange(min=1), metavar="N", help="Type N random sets of inputs and compare.")
@click.option("--mutate", type=click.IntRange(min=1), metavar="N", help="Damage N formulas: would anybody notice?")
@click.option("--seed", default=0, show_default=True, help="Another seed: other random sets, other damages.")
@click.option("--junit", "junit_file", type=click.Path(path_type=Path), help="Write a report for build servers.")
@click.option("-q", "--quiet", is_flag=True, help="Say only what is wrong.")
@click.option("-v", "--verbose", is_flag=True, help="Say everything of each file, also of many.")
@JSON
def check(
    files: tuple[Path, ...],
    programs: str,
    perturb: int | None,
    mutate: int | None,
    seed: int,
    junit_file: Path | None,
    quiet: bool,
    verbose: bool,
    as_json: bool,
) -> None:
    """Recalculate and compare: engine, stored values, numpy reference, other programs.

    \b
    mechsheet check four-bar.xlsx
    mechsheet check edited.xlsx                     what did somebody change?
    mechsheet check four-bar.toml --with libreoffice,ironcalc
    mechsheet check four-bar.xlsx four-bar.ods      also: are they the same, cell by cell?
    mechsheet check four-bar.xlsx --perturb 100 --with libreoffice
    mechsheet check four-bar.xlsx --mutate 200
    mechsheet check --junit report.xml *.xlsx       a line for each file, details where something is wrong

    Exit code 0: all agree; 1: something differs, or was edited, or a damage escapes; 2: cannot be read.
    """
    from .printing import print_line, print_mutation, print_perturbation, print_report

    judges = [part.strip() for part in programs.split(",") if part.strip()]
    if mutate is not None and (judges or perturb is not None):
        raise MechsheetError(Fault("--mutate goes with --seed and --json only", key="--mutate"))
    if junit_file is not None and (mutate is not None or perturb is not None):
        raise MechsheetError(Fault("--junit does not go with --perturb and --mutate", key="--junit"))
    faults: list[Fault] = []
    reports: list[Report] | list[Perturbation] | list[Mutation]
    show: Callable[[Any], None] = print_report
    if perturb is not None:
        reports = _perturbed(files, perturb, seed, judges, faults)
        show = print_perturbation
    elif mutate is not None:
        reports = _mutated(files, mutate, seed, faults)
        show = print_mutation
    else:
        reports = _checked(files, judges, faults)
        if junit_file is not None:
            _write_junit(junit_file, reports, faults)
    if as_json:
        click.echo(json.dumps([report.as_dict() for report in reports], indent=2))
    else:
        for report in reports:
            if report.agrees and quiet:
                continue
            if report.agrees and show is print_report and len(files) > 1 and not verbose:
                print_line(report)
            else:
                show(report)
    if faults:
        raise MechsheetError(faults)
    if not all(report.agrees for report in reports):
        sys.exit(1)


def _of_each(
    files: tuple[Path, ...], faults: list[Fault], judge: Callable[[Path, Callable[[str], None]], Found]
) -> list[Found]:
    """What `judge` finds in each file; a file that cannot be judged does not keep the others from it."""
    found = []
    for file in files:
        with progress(file.name) as say:
            try:
                found.append(judge(file, say))
            except MechsheetError as error:
                faults += error.faults
    return found


def _write_junit(path: Path, reports: list[Report], faults: list[Fault]) -> None:
    from mechsheet.formats.archive import replace_file

    from .junit import junit

    replace_file(path, junit(reports, faults))


def _checked(files: tuple[Path, ...], judges: list[str], faults: list[Fault]) -> list[Report]:
    from mechsheet.checking import check as check_file
    from mechsheet.checking import with_twins

    return with_twins(_of_each(files, faults, lambda file, say: check_file(file, judges, say)))


def _perturbed(
    files: tuple[Path, ...], count: int, seed: int, judges: list[str], faults: list[Fault]
) -> list[Perturbation]:
    from mechsheet.checking import perturb

    return _of_each(files, faults, lambda file, say: perturb(file, count, seed, judges, say))


def _mutated(files: tuple[Path, ...], count: int, seed: int, faults: list[Fault]) -> list[Mutation]:
    from mechsheet.checking import mutate

    return _of_each(files, faults, lambda file, say: mutate(file, count, seed, say))
