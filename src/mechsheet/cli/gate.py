"""What `check` and `recalc --check` share as gates: files, options, verdict, reports."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import click

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from livesheet.time_limit import in_time, limited
from mechsheet.diagnostics import OWN_FAILURES, MechsheetError, own_fault

from .common import FILE, Command, doubts_told, in_file, progress, with_options
from .speaking import note, wrote

if TYPE_CHECKING:
    from mechsheet.checking import Baseline, Report, Rules

Found = TypeVar("Found")

SUFFIXES = (".xlsx", ".xlsm", ".ods", ".xls")
"""What is looked for in a folder."""

DESCRIPTION = ".toml"

LOCKS = ("~$", ".~lock.")
"""How the files begin that Excel and LibreOffice put beside a workbook that is open."""

OPTIONS = (
    click.option(
        "--relative", type=float, metavar="X", help="Largest relative difference of numbers; 1e-9 if not given."
    ),
    click.option("--absolute", type=float, metavar="X", help="Largest absolute difference of numbers."),
    click.option(
        "--ignore", multiple=True, metavar="RANGE", help="Leave out Sheet!A1:B9, a name, a sheet; may be repeated."
    ),
    click.option("--baseline", type=FILE, help="Differences that are accepted, one line a cell."),
    click.option("--update-baseline", is_flag=True, help="Accept what differs now: rewrite the baseline."),
    click.option("--junit", "junit_file", type=FILE, help="Write a report for build servers."),
)


def gate_options(command: Command) -> Command:
    """The options of a gate, in the order of OPTIONS."""
    return with_options(OPTIONS, command)


@dataclass(slots=True)
class Gate:
    """The options as they were given."""

    relative: float | None = None
    absolute: float | None = None
    ignore: tuple[str, ...] = ()
    baseline: Path | None = None
    update_baseline: bool = False
    junit_file: Path | None = None
    strict: bool = False

    def given(self) -> list[str]:
        """The options that were given, but --strict, as a user writes them."""
        names = [
            each.name for each in fields(self) if each.name != "strict" and getattr(self, each.name) != each.default
        ]
        return ["--" + name.removesuffix("_file").replace("_", "-") for name in names]

    def rules(self) -> Rules:
        """What the options say of differences."""
        from mechsheet.checking import TOLERANCE, Rules

        relative = TOLERANCE if self.relative is None else self.relative
        return Rules(relative, self.absolute or 0.0, self.ignore)

    def accepted(self) -> Baseline | None:
        """The baseline. Raises MechsheetError when it cannot be read."""
        from mechsheet.checking import read_baseline

        if self.baseline is None:
            if self.update_baseline:
                raise MechsheetError(
                    Fault(say("--update-baseline goes with --baseline FILE"), hint=say("which file is it to write?"))
                )
            return None
        return read_baseline(self.baseline, must_exist=not self.update_baseline)


def workbooks(paths: Sequence[Path]) -> list[Path]:
    """The files that are meant: a folder stands for the workbooks in it and below; files that mark an open one do not count.

    Raises MechsheetError for a folder without any.
    """
    found: list[Path] = []
    faults = []
    for path in paths:
        if path.name.startswith(LOCKS):
            note(say("{file} only marks a workbook that is open: passed over", file=path.as_posix()))
        elif path.is_dir():
            inside = list(_inside(path))
            found += inside
            if not inside:
                faults.append(
                    Fault(say("no workbook ({names}) in this folder", names=", ".join(SUFFIXES)), readable_name(path))
                )
        else:
            found.append(path)
    if faults:
        raise MechsheetError(faults)
    return list(dict.fromkeys(found))


def descriptions_among(paths: Sequence[Path]) -> list[Path]:
    """The descriptions that are named, and those in the folders that are and below."""
    found = [path for path in paths if path.suffix.lower() == DESCRIPTION]
    return found + [inside for path in paths if path.is_dir() for inside in _inside(path, (DESCRIPTION,))]


def _inside(folder: Path, suffixes: tuple[str, ...] = SUFFIXES) -> Iterable[Path]:
    """Files in a folder and below that end so, but in folders whose names begin with a point."""
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(names):
            if name.lower().endswith(suffixes) and not name.startswith((".", *LOCKS)):
                yield Path(place) / name


def of_each(
    files: Sequence[Path],
    faults: list[Fault],
    judge: Callable[[Path, Callable[[str], None]], Found],
    seconds: float | None = None,
) -> list[Found]:
    """What `judge` finds in each file; a file that cannot be judged, or not in so many seconds, does not keep the others
    from it."""
    found = []
    for number, file in enumerate(files, 1):
        with progress(file.name) as tell:
            if len(files) > 1:
                tell(f"{number} of {len(files)}")
            try:
                with limited(seconds, readable_name(file)), doubts_told(in_file(file)):
                    found.append(judge(file, in_time(tell)))
            except MechsheetError as error:
                faults += error.faults
            except OWN_FAILURES as error:
                faults.append(own_fault(error, readable_name(file)))
    return found


def unmeant(gate: Gate, reports: Sequence[Report]) -> list[Fault]:
    """What was to be ignored and means cells in none of the files."""
    judged = [report.stored.unmeant for report in reports if report.stored is not None]
    return [judged[0][text] for text in gate.ignore if judged and all(text in each for each in judged)]


def concluded(gate: Gate, reports: Sequence[Report], baseline: Baseline | None, faults: Sequence[Fault]) -> None:
    """Write the report and the baseline, say what is missing, and end with the exit code."""
    faults = [*faults, *unmeant(gate, reports)]
    if gate.junit_file is not None:
        from livesheet.replacing import replace_file

        from .junit import junit

        replace_file(gate.junit_file, junit(reports, faults, gate.strict))
    if baseline is not None:
        _conclude_baseline(gate, baseline)
    missing = [fault for report in reports for fault in report.missing]
    if faults or missing:
        raise MechsheetError(dict.fromkeys([*faults, *missing]))
    if any(fails(report, gate) for report in reports):
        sys.exit(1)


def fails(report: Report, gate: Gate) -> bool:
    """Whether something differs in a file, or --strict has something to say; a baseline that is written accepts all."""
    if gate.strict and why_not_strict(report):
        return True
    if not gate.update_baseline:
        return not report.agrees
    others = report.comparisons[report.stored is not None :]
    return bool(report.edits or report.red_line or report.stale) or not all(item.agrees for item in others)


def why_not_strict(report: Report) -> list[str]:
    """What --strict refuses in a file: nothing to compare with, cells that were not computed."""
    doubts = [] if report.stored is None else [fault.message for fault in report.stored.doubts]
    return [*doubts, *report.unjudged]


def _conclude_baseline(gate: Gate, baseline: Baseline) -> None:
    from livesheet.replacing import replace_file

    name = baseline.path.as_posix()
    if gate.update_baseline:
        replace_file(baseline.path, baseline.updated().encode())
        count = sum(map(len, baseline.checked.values()))
        wrote(say("{name}: {count} accepted", name=name, count=count))
        return
    for entry in baseline.unused:
        note(say("{name}: {file} {cell} is no longer needed", name=name, file=entry.file, cell=entry.cell))
    if baseline.unused:
        count = len(baseline.unused)
        note(say("--update-baseline takes out what is no longer needed: {count}", count=count))
