"""`check --perturb`: random dimensions and modes typed into a workbook's input cells; do all evaluators still agree?

The file is taken as it was read. Each set is a handful of overrides for the engine; for an outside program it is a copy of
the file in which only the input cells differ, all stored results being those of the unchanged file: a program that
believed them would be found out.
"""

from __future__ import annotations

import math
import random
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from livesheet.diagnostics import WorkbookError, readable_name
from livesheet.engine import compile_book
from livesheet.formats import read, update_values
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar, symbols
from mechsheet.checking.against_reference import against_plan
from mechsheet.checking.cells import compare_program
from mechsheet.checking.comparison import Comparison
from mechsheet.checking.inputs import description_or_fault, plan_inside, workbook_of
from mechsheet.checking.programs import Answers, answers_to_all, names_of, refuse_unknown
from mechsheet.diagnostics import MissingProgramError
from mechsheet.kinematics.inputs import asked_of, refused_of
from mechsheet.sheet.plan import Plan

Place = tuple[str, int, int]

SPREADS = (0.02, 0.1, 0.3, 0.8)
"""A set's dimensions are those of the file times exp(u), u uniform within one of these; angles get u radians more."""

NOWHERE_KEPT = 0.1
"""Part of the sets that may assemble nowhere: that such a workbook shows no number at all is worth a look too."""

REDRAWS = 25
"""Sets that assemble nowhere are drawn again so often."""

FLIPPED = 0.4
"""How likely each mode is flipped."""

BATCH = 40
"""Files that are written at once for an outside program."""


@dataclass(frozen=True, slots=True)
class Setting:
    """One set: what each input cell holds, by symbol, in the unit of the cell; and how many rows exist with it."""

    number: int
    inputs: Mapping[str, float]
    rows: int = 0

    def text(self) -> str:
        """`a1 = 65.2, mode_1 = -1`."""
        return ", ".join(f"{symbol} = {_shortest(value)}" for symbol, value in self.inputs.items())


@dataclass(frozen=True, slots=True)
class Judged:
    """One judge over all sets: the number of values compared, its worst comparison, that one's set, and how many differ."""

    cells: int
    worst: Comparison
    setting: Setting
    differing: int


@dataclass(frozen=True, slots=True)
class Perturbation:
    """What `perturb` found in one file."""

    file: str
    sets: int
    seed: int
    rows: int
    whole: int
    partly: int
    judged: tuple[Judged, ...]

    @property
    def agrees(self) -> bool:
        """True when every judge agrees in every set."""
        return all(item.differing == 0 for item in self.judged)

    @property
    def nowhere(self) -> int:
        """Sets with which no row exists."""
        return self.sets - self.whole - self.partly

    def as_dict(self) -> dict[str, Any]:
        """As JSON data."""
        return {
            "file": self.file,
            "agrees": self.agrees,
            "sets": self.sets,
            "seed": self.seed,
            "rows": self.rows,
            "assemble": {"whole": self.whole, "partly": self.partly, "nowhere": self.nowhere},
            "judges": [
                {
                    "judge": item.worst.judge,
                    "cells": item.cells,
                    "worst": item.worst.worst,
                    "where": item.worst.where,
                    "ours": item.worst.ours,
                    "theirs": item.worst.theirs,
                    "set": item.setting.number,
                    "inputs": dict(item.setting.inputs),
                    "differing": item.differing,
                }
                for item in self.judged
            ],
        }


def perturb(
    path: str | Path,
    count: int,
    seed: int = 0,
    programs: str | Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
) -> Perturbation:
    """Type `count` random sets of dimensions and modes into the input cells of a workbook (or of what a description builds).

    The engine is compared with the reference and with each program named. The same seed gives the same sets. Raises
    MechsheetError when the file cannot be read or carries no description.
    """
    path = Path(path)
    say = progress or (lambda _: None)
    programs = names_of(programs)
    refuse_unknown(programs)
    with workbook_of(path) as built:
        return _Run(built, readable_name(path), seed, say).over(count, programs)


class _Run:
    """One file: its book compiled once, and the running worst of each judge."""

    def __init__(self, path: Path, shown: str, seed: int, say: Callable[[str], None]) -> None:
        self.path, self.shown, self.seed, self.say = path, shown, seed, say
        self.book = read(path)
        self.plan = plan_inside(description_or_fault(self.book, shown), shown)
        self.ready = compile_book(self.book)
        self.tallies: dict[str, Judged] = {}

    def over(self, count: int, programs: Sequence[str]) -> Perturbation:
        """All sets, in batches."""
        draw = random.Random(self.seed)
        settings: list[Setting] = []
        for first in range(0, count, BATCH):
            batch = [self._drawn(draw, number) for number in range(first, min(first + BATCH, count))]
            settings += batch
            self._judge(batch, programs, count)
        rows = self.plan.rows
        return Perturbation(
            self.shown,
            count,
            self.seed,
            rows,
            sum(1 for each in settings if each.rows == rows),
            sum(1 for each in settings if 0 < each.rows < rows),
            tuple(self.tallies.values()),
        )

    def _drawn(self, draw: random.Random, number: int) -> Setting:
        """A set that assembles in some row, nearly always."""
        may_fail = draw.random() < NOWHERE_KEPT
        for _ in range(1 if may_fail else REDRAWS):
            setting = Setting(number, drawn(self.plan, draw))
            rows = self._rows(self.ready.evaluate(self._changes(setting)))
            if rows:
                break
        return replace(setting, rows=rows)

    def _rows(self, values: Any) -> int:
        spot = self.plan.places.closed
        found = values.get(spot.sheet, spot.row, spot.col)
        return int(found) if isinstance(found, float) else 0

    def _changes(self, setting: Setting) -> dict[Place, Scalar]:
        spots = self.plan.at.spots
        return {(spots[name].sheet, spots[name].row, spots[name].col): value for name, value in setting.inputs.items()}

    def _judge(self, batch: Sequence[Setting], programs: Sequence[str], count: int) -> None:
        values = [self.ready.evaluate(self._changes(setting)) for setting in batch]
        for setting, found in zip(batch, values, strict=True):
            self.say(f"set {setting.number + 1} of {count}")
            self._note(against_plan(self.book, found, self.plan, self.shown)[0], setting)
        for program in programs:
            self.say(f"{program}, sets {batch[0].number + 1} to {batch[-1].number + 1} of {count}")
            with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
                paths = [self._written(setting, Path(folder)) for setting in batch]
                theirs = self._answers(program, paths)
                for setting, found, answer in zip(batch, values, theirs, strict=True):
                    compared = compare_program(program, self.book, found, answer.get, self.plan, self.shown)
                    self._note(compared, setting)

    def _answers(self, program: str, paths: Sequence[Path]) -> Iterator[Answers]:
        try:
            yield from answers_to_all(program, paths)
        except MissingProgramError:
            raise
        except WorkbookError as error:
            raise WorkbookError([replace(fault, file=self.shown) for fault in error.faults]) from error

    def _written(self, setting: Setting, folder: Path) -> Path:
        """The file with only its input cells changed: stored results stay what they were."""
        output = folder / f"set-{setting.number}{self.path.suffix}"
        typed_into(self.path, output, self.book, self._changes(setting))
        return output

    def _note(self, found: Comparison, setting: Setting) -> None:
        differs = 0 if found.agrees else 1
        old = self.tallies.get(found.judge)
        if old is None:
            self.tallies[found.judge] = Judged(found.cells, found, setting, differs)
            return
        # A difference is worse than any agreement, whatever their figures (a dead centre's uncertainty is excused).
        worse = (not found.agrees, found.worst) > (not old.worst.agrees, old.worst.worst)
        worst, where = (found, setting) if worse else (old.worst, old.setting)
        self.tallies[found.judge] = Judged(old.cells + found.cells, worst, where, old.differing + differs)


def typed_into(path: Path, output: Path, book: Book, changes: Mapping[Place, Scalar]) -> None:
    """Write a copy of a workbook in which only these input cells differ: stored results stay what they were.

    book  what `path` was read as
    """
    update_values(path, output, book, _Stored(book), changes)


class _Stored:
    """The values stored in a book, as if they were new ones."""

    def __init__(self, book: Book) -> None:
        self._sheets = {sheet.title: sheet.cached for sheet in book.sheets}

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The stored value of a formula's cell."""
        return self._sheets[sheet].get(row, col)


def drawn(plan: Plan, draw: random.Random) -> dict[str, float]:
    """A random set: every input dimension and mode, in the unit of its cell.

    Lengths keep their sign; where the workbook allows any sign, a few change it. A zero stays zero half the time: zero is
    often what makes a mechanism special.
    """
    spread = draw.choice(SPREADS)
    inputs = [(dim, dim.value) for dim in plan.mechanism.dimensions if isinstance(dim.value, float)]
    size = max((abs(value) for dim, value in inputs if dim.unit.kind == "length"), default=1.0) or 1.0
    found: dict[str, float] = {}
    for dim, value in inputs:
        change = draw.uniform(-spread, spread)
        if dim.unit.kind == "angle":
            value = value + change
            value = dim.unit.to_shown(value)
        elif value == 0:
            value = 0.0 if draw.random() < 0.5 else change * size
            value = abs(value) if dim.symbol in plan.equations.positive else value
        else:
            value *= math.exp(change)
            if dim.symbol not in plan.equations.positive and draw.random() < 0.05:
                value = -value
        found[dim.symbol] = float(f"{value:.6g}")
    found |= _kept_of_cam(plan, found)
    for group in plan.equations.groups:
        if group.mode and group.follows is None:
            others = [value for value in group.mode_values if value != group.mode_value] or [group.mode_value]
            flipped = others[0] if len(others) == 1 else others[int(draw.random() * len(others))]
            found[group.mode] = float(flipped if draw.random() < FLIPPED else group.mode_value)
    return found


def _kept_of_cam(plan: Plan, typed: Mapping[str, float]) -> dict[str, float]:
    """The described numbers of a cam that could not be with what is drawn: cells that would be refused show nothing."""
    inputs = {dim.symbol: dim for dim in plan.mechanism.dimensions if isinstance(dim.value, float)}
    internal = {symbol: dim.unit.to_internal(typed[symbol]) for symbol, dim in inputs.items()}
    if not any(refused_of(plan.mechanism, internal)):
        return {}
    read = {name for each in asked_of(plan.mechanism) for name in (each.symbol, *symbols(each.margin))}
    kept = (dim for symbol, dim in inputs.items() if symbol in read)
    return {dim.symbol: dim.unit.to_shown(dim.value) for dim in kept if isinstance(dim.value, float)}


def _shortest(value: float) -> str:
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
