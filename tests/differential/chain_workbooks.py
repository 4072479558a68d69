"""Workbooks of random links of class III and IV with velocities and forces, and what each program computes of them.

`test_chains.py` judges some; `tools/chains_elsewhere.py` makes the table of docs/proof.md.
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from laid import Laid
from placed import places_of
from test_reactions import weighed
from test_start_table import KEPT, Followed, typed

from livesheet.evaluation import book_of
from livesheet.formats import write
from mechsheet.checking import Comparison
from mechsheet.checking.against_reference import against_plan
from mechsheet.checking.cells import compare_program
from mechsheet.checking.programs import Answers
from mechsheet.diagnostics import MechanismError
from mechsheet.sheet.plan import MEANING
from random_mechanisms import Grower
from typed_files import with_inputs

ROWS, STEP = 12, 1.5
CHANGES = 60
"""Changes that are tried until one ends the described assembly while rows close; in a third of the linkages one does."""


def descriptions(count: int, rows: int = ROWS) -> Iterator[tuple[int, str]]:
    """So many random mechanisms of class III and IV in turn, most with a speed, all with forces: (seed, description)."""
    found = 0
    for seed in itertools.count():
        text = Grower(seed, 1, (("III", "IV")[seed % 2],)).text(rows, STEP)
        try:
            laid = Laid(weighed(text, seed, seed % 5 == 4))
        except MechanismError:  # drawn so that its rounded sketch says nothing
            continue
        if sum(laid.exists) < rows // 2:
            continue
        yield seed, laid.key[0]
        found += 1
        if found == count:
            return


def written(text: str, path: Path, **changes: float) -> Path:
    """The whole workbook, numbers typed into some of its cells: 0 is stored as the result of every formula."""
    laid = Laid(text)
    typed = {(spot.sheet, spot.row, spot.col): changes[key] for key, spot in laid.spots(changes).items()}
    write(with_inputs(laid.workbook, typed), path)
    return path


class _Theirs:
    """A program's values, for who asks for columns, too."""

    def __init__(self, answers: Answers) -> None:
        self.get = answers.get

    def column(self, sheet, col, first, last):
        return [self.get(sheet, row, col) for row in range(first, last + 1)]


def judged(text: str, name: str, answers: dict[str, Answers]) -> Iterator[Comparison]:
    """The engine's values against the reference, each program's against the engine's and against the reference."""
    laid = Laid(text)
    book, plan, ours = book_of(laid.workbook), laid.plan, laid.values
    yield against_plan(book, ours, plan, name)[0]
    for program, theirs in answers.items():
        yield compare_program(program, book, ours, theirs.get, plan, name)
        yield against_plan(book, _Theirs(theirs), plan, name)[0]


@dataclass(frozen=True)
class Elsewhere:
    """A change of one cell after which the described assembly has ended on the way, and rows close all the same."""

    text: str
    cell: str
    number: float

    def written(self, path: Path) -> Path:
        """The workbook with the number typed."""
        return written(self.text, path, **{self.cell: self.number})

    def told(self, values: Answers) -> bool:
        """Whether a first sheet with these values says so in its line, or shows no position."""
        plan = Laid(self.text).plan
        spot = places_of(plan)["verdict"]
        line = values.get(spot.sheet, spot.row, spot.col)
        words = values.get(plan.main, plan.blocks["verdicts"].rows["same_assembly"], MEANING)
        nowhere = [plan.text(f"verdict.line.{key}") for key in ("nowhere", "ended")]
        return line in nowhere or (words != plan.text(KEPT) and line == words)


def elsewhere(seed: int) -> Elsewhere | None:
    """The first of some random changes after which Newton's method lands elsewhere than the assembly was led; or None.

    Where it ought to be is followed in many small steps, apart from the sheet (`Followed`). Three rows are enough.
    """
    text = Grower(seed, 1, (("III", "IV")[seed % 2],)).text(3, 1.0)
    sheet = Laid(text)
    followed = Followed(sheet)
    random = np.random.default_rng(seed)
    changes = [typed(random, followed) for _ in range(CHANGES)]
    for (cell, number, _), truth in zip(changes, followed.to([meant for *_, meant in changes]), strict=True):
        sheet.change(**{cell: number})
        here = followed.begins()
        if here is not None and any(sheet.exists) and (np.isnan(truth).any() or not followed.same(here, truth)):
            return Elsewhere(text, cell, number)
    return None


@dataclass(frozen=True)
class Case:
    """A linkage and one of its files."""

    text: str
    path: Path


def compared(cases: list[Case], answers: dict[str, list[Answers]]) -> dict[tuple[str, str], list[Comparison]]:
    """All comparisons, by the file's format and by what was compared."""
    whats = ["engine, reference", *(what for name in answers for what in (name, f"{name}, reference"))]
    found: dict[tuple[str, str], list[Comparison]] = {}
    for number, case in enumerate(cases):
        comparisons = judged(case.text, case.path.name, {name: each[number] for name, each in answers.items()})
        for what, comparison in zip(whats, comparisons, strict=True):
            found.setdefault((case.path.suffix[1:], what), []).append(comparison)
    return found
