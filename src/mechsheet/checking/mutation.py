"""`check --mutate`: one formula damaged at a time. Would the sheet's own checks notice? Would `check`?"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from livesheet.diagnostics import readable_name
from livesheet.engine import compile_book
from livesheet.formats import read
from livesheet.formula.book import Block, Book, BookSheet
from livesheet.formula.nodes import shifted
from livesheet.formula.references import area_name
from livesheet.formula.slips import Damage, damages
from mechsheet.checking.against_reference import against_plan
from mechsheet.checking.books_compared import printed
from mechsheet.checking.cells import Angles, angles_in
from mechsheet.checking.comparison import TOLERANCE
from mechsheet.checking.edited.edits import edits_of
from mechsheet.checking.inputs import Expected, description_or_fault, expected_for, inside, workbook_of
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.rows import AGREES

TRIES = 60
"""Damages that change no value are drawn again so often for each one wanted."""


@dataclass(frozen=True, slots=True)
class Damaged:
    """One damage that changes some value, and who notices.

    where   the cells whose formula is damaged;  was, now  the formula there before and after
    sheet   the workbook's own checks notice;  reference  the reference does;  check  `check` does, by whatever it compares
    """

    kind: str
    where: str
    was: str
    now: str
    sheet: bool
    reference: bool
    check: bool


@dataclass(frozen=True, slots=True)
class Mutation:
    """What `mutate` found in one file.

    harmless  damages drawn that change no value;  circular  those that no program computes. Neither is in `damages`.
    clear     the sheet's checks are clear without any damage (else what they catch means nothing)
    """

    file: str
    seed: int
    damages: tuple[Damaged, ...]
    harmless: int
    circular: int
    clear: bool

    @property
    def agrees(self) -> bool:
        """True when `check` catches every damage."""
        return all(damage.check for damage in self.damages)

    def caught(self, by: str) -> int:
        """How many damages are caught by "sheet", "reference" or "check"."""
        return sum(1 for damage in self.damages if getattr(damage, by))

    def share(self, by: str) -> float:
        """The part that is caught, 1 when there are no damages."""
        return self.caught(by) / len(self.damages) if self.damages else 1.0

    def tally(self, what: Callable[[Damaged], str]) -> dict[str, tuple[int, int]]:
        """By kind, by sheet …: (how many damages, how many of them the sheet's own checks catch)."""
        found: dict[str, tuple[int, int]] = {}
        for damage in self.damages:
            count, caught = found.get(what(damage), (0, 0))
            found[what(damage)] = (count + 1, caught + damage.sheet)
        return found

    def as_dict(self) -> dict[str, Any]:
        """As JSON data."""
        return {
            "file": self.file,
            "agrees": self.agrees,
            "seed": self.seed,
            "damages": len(self.damages),
            "harmless": self.harmless,
            "circular": self.circular,
            "clear": self.clear,
            "caught": {by: self.caught(by) for by in ("sheet", "reference", "check")},
            "kinds": {key: {"damages": n, "sheet": caught} for key, (n, caught) in sorted(self.tally(by_kind).items())},
            "sheets": {key: {"damages": n, "sheet": caught} for key, (n, caught) in self.tally(by_sheet).items()},
            "survivors": [
                {"kind": item.kind, "where": item.where, "was": item.was, "now": item.now, "check": item.check}
                for item in self.damages
                if not (item.sheet and item.check)
            ],
        }


def by_kind(damage: Damaged) -> str:
    """The kind of a damage."""
    return damage.kind


def by_sheet(damage: Damaged) -> str:
    """The sheet that it stands on."""
    return damage.where.rpartition("!")[0]


def mutate(
    path: str | Path,
    count: int | None,
    seed: int = 0,
    progress: Callable[[str], None] | None = None,
    sheets: Collection[str] = (),
) -> Mutation:
    """Damage `count` formulas of a workbook (or of what a description builds), one at a time, each so that a value changes.

    Each sheet gets about as many as any other; on it every formula (a filled range is one), and every kind of damage that it
    can have, is as likely as the others. Half of the damages in a filled range are done to all of it, half to one cell.

    Stored values are those that a spreadsheet program would store: they fit the damage, and give nothing away. A value is
    changed when it differs by more than TOLERANCE (angles modulo a turn, as everywhere). The same seed gives the same
    damages. Raises MechsheetError when the file cannot be read or carries no description.

    count   None: every formula, in all of its range, by each kind of damage that it can have
    sheets  keys of the only sheets that are damaged ("rates", "forces"); all where none is named
    """
    path = Path(path)
    say = progress or (lambda _: None)
    with workbook_of(path) as built:
        run = _Run(built, readable_name(path), seed, sheets)
        return run.over_every(say) if count is None else run.over(count, say)


class _Run:
    """One file."""

    def __init__(self, path: Path, shown: str, seed: int, sheets: Collection[str] = ()) -> None:
        self.shown, self.seed = shown, seed
        self.book = read(path)
        self.expected: Expected = expected_for(description_or_fault(self.book, shown), inside(shown))
        self.values = compile_book(self.book).evaluate()
        self.angles = angles_in(self.expected.plan)
        self.names = sorted(name.name for name in self.book.names if name.sheet is None)
        titles = {title for key, title in self.expected.plan.at.titles.items() if key in sheets}
        self.sheets = [sheet for sheet in self.book.sheets if sheet.blocks and (not sheets or sheet.title in titles)]
        self.kinds: dict[tuple[str, int], dict[str, list[Damage]]] = {}
        self.harmless = self.circular = 0

    def over(self, count: int, say: Callable[[str], None]) -> Mutation:
        """So many damages that change a value; fewer when the workbook has no more."""
        draw = random.Random(self.seed)
        seen: set[tuple[str, Block]] = set()
        found: list[Damaged] = []
        for _ in range(count * TRIES if self.sheets else 0):
            if len(found) == count:
                break
            sheet, pieces, damaged, kind = self._drawn(draw)
            if (sheet.title, damaged) in seen:
                continue
            seen.add((sheet.title, damaged))
            judged = self._judged(sheet, pieces, damaged, kind)
            if judged is not None:
                found.append(judged)
                say(f"damage {len(found)} of {count}")
        clear = self._is_clear(self.values)
        return Mutation(self.shown, self.seed, tuple(found), self.harmless, self.circular, clear)

    def over_every(self, say: Callable[[str], None]) -> Mutation:
        """Of each formula one damage of every kind, the first drawn that changes a value, in its whole range."""
        draw = random.Random(self.seed)
        found: list[Damaged] = []
        for sheet in self.sheets:
            for number, block in enumerate(sheet.blocks):
                for kind, some in sorted(self._damages(sheet, number).items()):
                    for damage in draw.sample(some, len(some)):
                        damaged = replace(block, formula=damage.of(block.formula))
                        judged = self._judged(sheet, [damaged], damaged, kind)
                        if judged is not None:
                            found.append(judged)
                            break
                say(f"{sheet.title}: formula {number + 1} of {len(sheet.blocks)}")
        clear = self._is_clear(self.values)
        return Mutation(self.shown, self.seed, tuple(found), self.harmless, self.circular, clear)

    def _drawn(self, draw: random.Random) -> tuple[BookSheet, list[Block], Block, str]:
        """(sheet, what its block becomes, the damaged one among these, the kind of damage)."""
        while True:
            sheet = draw.choice(self.sheets)
            number = draw.randrange(len(sheet.blocks))
            block = sheet.blocks[number]
            by_kind = self._damages(sheet, number)
            if not by_kind:
                continue
            kind = draw.choice(sorted(by_kind))
            formula = draw.choice(by_kind[kind]).of(block.formula)
            if block.rows * block.cols == 1 or draw.random() < 0.5:
                damaged = replace(block, formula=formula)
                return sheet, [damaged], damaged, kind
            down, right = draw.randrange(block.rows), draw.randrange(block.cols)
            pieces = block.around(down, right)
            damaged = Block(block.row + down, block.col + right, 1, 1, shifted(formula, down, right))
            return sheet, [*pieces, damaged], damaged, kind

    def _damages(self, sheet: BookSheet, number: int) -> dict[str, list[Damage]]:
        if (sheet.title, number) not in self.kinds:
            by_kind: dict[str, list[Damage]] = {}
            for damage in damages(sheet.blocks[number].formula, self.names):
                by_kind.setdefault(damage.kind, []).append(damage)
            self.kinds[sheet.title, number] = by_kind
        return self.kinds[sheet.title, number]

    def _judged(self, sheet: BookSheet, pieces: list[Block], damaged: Block, kind: str) -> Damaged | None:
        old = sheet.formula_at(damaged.row, damaged.col)
        assert old is not None
        book = _with_blocks(self.book, sheet, old, pieces)
        values = compile_book(book).evaluate()
        if values.remarks:
            self.circular += 1
            return None
        if not differ(self.book, self.values, values, self.angles):
            self.harmless += 1
            return None
        reference = not against_plan(book, values, self.expected.plan, self.shown)[0].agrees
        return Damaged(
            kind,
            f"{sheet.title}!{area_name(damaged.row, damaged.col, damaged.rows, damaged.cols)}",
            printed(shifted(old.formula, damaged.row - old.row, damaged.col - old.col)),
            printed(damaged.formula),
            not self._is_clear(values),
            reference,
            reference or bool(edits_of(book, self.expected).edits),
        )

    def _is_clear(self, values: Any) -> bool:
        """Whether the first sheet finds no gap, no cell without a formula, and all that is found twice alike. A page has no
        checks of its own, and notices nothing."""
        lines, checked = self.expected.plan.places.lines, self.expected.plan.checks
        if checked is None:
            return True

        def found(spot: Spot) -> float:
            value = values.get(spot.sheet, spot.row, spot.col)
            return value if isinstance(value, float) else math.nan

        rounding = found(checked.rounding)
        least = {"largest_gap": rounding, "velocities_fit": rounding, "accelerations_fit": rounding}
        least["effort_fits"] = AGREES
        fits = (found(lines[key]) <= most for key, most in least.items() if key in lines)
        return found(checked.typed) == 0.0 and all(fits)


def _with_blocks(book: Book, sheet: BookSheet, old: Block, new: list[Block]) -> Book:
    """The book with some blocks in the place of one."""
    changed = replace(sheet, blocks=[block for block in sheet.blocks if block is not old] + new)
    return replace(book, sheets=[changed if each is sheet else each for each in book.sheets])


def differ(book: Book, ours: Any, theirs: Any, angles: Angles) -> bool:
    """Whether any formula's value differs between two evaluations, as `compare_cells` measures it."""
    return any(
        _column_differs(sheet.title, col, block, ours, theirs, angles)
        for sheet in book.sheets
        for block in sheet.blocks
        for col in range(block.col, block.col + block.cols)
    )


def _column_differs(title: str, col: int, block: Block, ours: Any, theirs: Any, angles: Angles) -> bool:
    first, last = block.row, block.row + block.rows - 1
    one, codes = ours.arrays(title, col, first, last)
    other, others = theirs.arrays(title, col, first, last)
    if not np.array_equal(codes, others):
        return True
    if np.isnan(one).any() and ours.column(title, col, first, last) != theirs.column(title, col, first, last):
        texts = zip(ours.column(title, col, first, last), theirs.column(title, col, first, last), strict=True)
        if any(isinstance(left, str) and left != right for left, right in texts):
            return True
    apart = one - other
    period = angles.periods.get((title, col))
    if period is not None:
        apart = (np.remainder(apart + period / 2, period) - period / 2) / period
    else:
        scale = max(angles.size, float(np.max(np.abs(one), initial=0.0, where=np.isfinite(one))))
        apart = apart / np.maximum(scale, np.maximum(np.abs(one), np.abs(other)))
    return bool(np.nanmax(np.abs(apart), initial=0.0) > TOLERANCE)
