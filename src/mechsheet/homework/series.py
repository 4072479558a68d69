"""Series: the columns of a table, row by row beside the driver's values."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from livesheet.engine import Values
from livesheet.formula.nodes import Call, CellRef, Node, walk
from mechsheet.homework.expected_values import Array
from mechsheet.homework.formula_strips import Stretch, Strip, Work, references

SHORTEST = 3
"""Cells that make a run: with fewer rows no column is told from another."""
MOST_RUNS = 3
"""Runs that are tried for the driver's."""


@dataclass(frozen=True, slots=True)
class Run(Stretch):
    """A stretch that holds numbers, typed or computed from the cell above alone."""


@dataclass(frozen=True, slots=True)
class Series:
    """A line of a table: `origin` is the position of the driver's first row, `rows` how many the driver has.

    main    the formula that most of its cells have; None where all are typed
    first, last  the first and the last row in which it has a cell
    """

    sheet: str
    line: int
    origin: int
    rows: int
    main: Strip | None
    first: int
    last: int

    @property
    def cells(self) -> Stretch:
        """One for each of the driver's rows."""
        return Stretch(self.sheet, self.line, self.origin, self.rows)

    @property
    def filled(self) -> Stretch:
        """From the first cell that it has to the last one."""
        return Stretch(self.sheet, self.line, self.origin + self.first, self.last - self.first + 1)

    def column(self, work: Work, values: Values | None = None) -> Array:
        """Its numbers, NaN where it has none."""
        return self.cells.column(work, values)

    def strips(self, work: Work) -> list[int]:
        """The numbers of the strips that fill its cells."""
        return work.strips_in(self.cells)

    def where(self, work: Work) -> str:
        """Its cells by name."""
        return self.filled.where(work)

    @property
    def key(self) -> tuple[str, int, int]:
        """What tells it from others."""
        return self.sheet, self.line, self.origin


class Graph:
    """Which strips read which, and which typed cells."""

    def __init__(self, work: Work) -> None:
        self.work = work
        self.formulas: list[Node] = [work.bound(strip.formula, strip) for strip in work.strips]
        self.titles = {sheet.title.casefold(): sheet.title for sheet in work.book.sheets}

    def corners(self, number: int) -> list[tuple[CellRef, CellRef]]:
        """The corners of every area that a strip reads, as seen from its first cell."""
        return self._corners[number]

    @cached_property
    def _corners(self) -> list[list[tuple[CellRef, CellRef]]]:
        return [list(references(formula)) for formula in self.formulas]

    def areas(self, number: int) -> Iterator[tuple[str, int, int, int, int]]:
        """(sheet, first pos, last pos, first line, last line) of everything that a strip reads."""
        strip = self.work.strips[number]
        for start, end in self._corners[number]:
            sheet = self.titles.get((start.sheet or strip.sheet).casefold())
            if sheet is None:
                continue
            last = end.row if end.row_abs else end.row + strip.length - 1
            low, high = min(start.row, last), max(start.row, last, end.row)
            yield sheet, low, high, min(start.col, end.col), max(start.col, end.col)

    @cached_property
    def reads(self) -> list[set[int]]:
        """For each strip the strips that it reads."""
        found: list[set[int]] = []
        for number in range(len(self.work.strips)):
            read: set[int] = set()
            for sheet, low, high, left, right in self.areas(number):
                for line in range(left, min(right, left + 500) + 1):
                    read |= {
                        other
                        for other in self.work.lines.get((sheet, line), ())
                        if self.work.strips[other].start <= high and low < self.work.strips[other].end
                    }
            found.append(read)
        return found

    @cached_property
    def readers(self) -> list[set[int]]:
        """For each strip the strips that read it."""
        found: list[set[int]] = [set() for _ in self.work.strips]
        for number, read in enumerate(self.reads):
            for other in read:
                found[other].add(number)
        return found

    def below(self, numbers: set[int]) -> set[int]:
        """The strips themselves and all that depend on them."""
        return _closure(numbers, self.readers)

    def above(self, numbers: set[int], without: Set[int] = frozenset()) -> set[int]:
        """The strips themselves and all that they depend on, but for what they read through those left out."""
        return _closure(numbers, self.reads, without)

    def readers_of(self, cells: Stretch) -> set[int]:
        """Strips that read some of these cells directly."""
        return {
            number
            for low, high, left, right, number in self._areas_of.get(cells.sheet, ())
            if left <= cells.line <= right and low < cells.end and cells.start <= high
        }

    @cached_property
    def _areas_of(self) -> dict[str, list[tuple[int, int, int, int, int]]]:
        """By sheet (first pos, last pos, first line, last line, strip) of everything that is read there."""
        found: dict[str, list[tuple[int, int, int, int, int]]] = {}
        for number in range(len(self.work.strips)):
            for sheet, *area in self.areas(number):
                found.setdefault(sheet, []).append((*area, number))  # type: ignore[arg-type]
        return found

    @cached_property
    def order(self) -> dict[int, int]:
        """In which order strips are computed: how many steps each is from what was typed."""
        depth: dict[int, int] = {}
        remaining = set(range(len(self.reads)))
        level = 0
        while remaining:
            ready = {number for number in remaining if not (self.reads[number] - {number}) & remaining} or set(
                remaining
            )
            depth |= dict.fromkeys(ready, level)
            remaining -= ready
            level += 1
        return depth


def _closure(numbers: set[int], edges: Sequence[set[int]], without: Set[int] = frozenset()) -> set[int]:
    found: set[int] = set()
    waiting = list(numbers)
    while waiting:
        number = waiting.pop()
        if number not in found and number not in without:
            found.add(number)
            waiting += edges[number]
    return found


def runs_of_numbers(work: Work) -> list[Run]:
    """Typed numbers one after the other."""
    found = []
    for sheet in work.book.sheets:
        lines: dict[int, set[int]] = {}
        for row, col, value in sheet.constants.items():
            if isinstance(value, float) and not isinstance(value, bool):
                pos, line = (col, row) if work.across else (row, col)
                lines.setdefault(line, set()).add(pos)
        for line, places in sorted(lines.items()):
            start: int | None = None
            for pos in sorted(places):
                if start is None:
                    start = pos
                if pos + 1 not in places:
                    if pos + 1 - start >= SHORTEST:
                        found.append(Run(sheet.title, line, start, pos + 1 - start))
                    start = None
    return found


def drivers(graph: Graph, share: float = 0.5) -> list[Run]:
    """What may be the driver's values, the likeliest first: what most cells depend on, and at least this share of them."""
    work = graph.work
    candidates = runs_of_numbers(work) + _stepped(graph)
    weighed = []
    for run in candidates:
        direct = {
            number
            for number in graph.readers_of(run)
            if work.strips[number].length >= 3 and _reads_along(graph, number, run)
        }
        cells = sum(
            work.strips[number].length for number in graph.below(direct) if work.strips[number].length >= SHORTEST - 1
        )
        column = run.column(work)
        if cells and np.isfinite(column).all() and np.ptp(column) > 0:
            weighed.append((cells, run))
    weighed = weighed or [(1, run) for run in runs_of_numbers(work) if _beside_formulas(graph, run)]
    weighed.sort(key=lambda pair: (-pair[0], -pair[1].length))
    return [run for cells, run in weighed if cells >= share * weighed[0][0]]


def _beside_formulas(graph: Graph, run: Run) -> bool:
    """Whether formulas stand beside a run from end to end, though none of them reads it row by row."""
    return bool(np.ptp(run.column(graph.work)) > 0) and any(
        (strip.sheet, strip.start, strip.end) == (run.sheet, run.start, run.end) for strip in graph.work.strips
    )


def _reads_along(graph: Graph, number: int, run: Run) -> bool:
    """Whether a strip reads a run cell by cell, not as a whole."""
    strip = graph.work.strips[number]
    return any(
        start is end
        and not start.row_abs
        and start.col == run.line
        and start.row < run.end
        and run.start < start.row + strip.length
        for start, end in graph.corners(number)
        if graph.titles.get((start.sheet or strip.sheet).casefold()) == run.sheet
    )


def _stepped(graph: Graph) -> list[Run]:
    """Formulas that step from cell to cell: from the cell above (with the first cell), or by their own row's number."""
    found = []
    for number, strip in enumerate(graph.work.strips):
        if strip.length < SHORTEST - 1 or _reads_rows(graph, number):
            continue
        own = [
            start.row - strip.start
            for start, end in graph.corners(number)
            if start is end and not start.row_abs and start.col == strip.line
        ]
        first = (strip.sheet, strip.start - 1, strip.line)
        if own == [-1] * len(own) and own and not math.isnan(graph.work.number(first)):
            found.append(Run(strip.sheet, strip.line, strip.start - 1, strip.length + 1))
        elif not own and _linear(graph.work, strip) is not None:
            found.append(Run(strip.sheet, strip.line, strip.start, strip.length))
    return found


def _reads_rows(graph: Graph, number: int) -> bool:
    """Whether a strip reads another one cell by cell."""
    strip = graph.work.strips[number]
    return any(not start.row_abs and start.col != strip.line for start, _ in graph.corners(number))


def _linear(work: Work, strip: Strip) -> float | None:
    """The step of a strip whose numbers go on by equal steps, None where they do not."""
    column = strip.column(work)
    steps = np.diff(column)
    if len(steps) < SHORTEST - 2 or not np.isfinite(column).all() or not steps[0]:
        return None
    return float(steps[0]) if np.allclose(steps, steps[0], rtol=1e-6, atol=1e-9) else None


def counted(graph: Graph, run: Run) -> list[Run]:
    """Where a run only counts the rows (0, 1, 2 ...), what is computed from it by equal steps: start + number * step."""
    work = graph.work
    column = run.column(work)
    if column[0] not in (0.0, 1.0) or (np.diff(column) != 1).any():
        return []
    found = []
    for number in sorted(graph.readers_of(run)):
        strip = work.strips[number]
        step = _linear(work, strip) if strip.length >= SHORTEST and _reads_along(graph, number, run) else None
        rows = {(start.sheet, start.col) for start, _ in graph.corners(number) if not start.row_abs}
        if step is not None and len(rows) == 1 and abs(abs(step) - math.pi / 180) > 1e-6:
            found.append(Run(strip.sheet, strip.line, strip.start, strip.length))
    return found


def by_law(graph: Graph, runs: Sequence[Run], slides: bool = False) -> list[Run]:
    """Columns that go on one way, by unequal steps, computed from a run (of times) alone; of a driver that turns those of
    which sines are taken."""
    work = graph.work
    found = []
    for run in runs:
        below = graph.below(graph.readers_of(run))
        for number in sorted(below, key=lambda each: (graph.order[each], each)):
            strip = work.strips[number]
            steps = np.diff(strip.column(work))
            one_way = bool(len(steps) >= SHORTEST - 1 and ((steps > 0).all() or (steps < 0).all()))
            if one_way and _linear(work, strip) is None and (slides or _turned_by(graph, number)):
                found.append(Run(strip.sheet, strip.line, strip.start, strip.length))
    return found[:MOST_RUNS]


def _turned_by(graph: Graph, number: int) -> bool:
    """Whether the sine or cosine of a strip's own cells is taken somewhere, of degrees as `COS(RADIANS(B4))`."""
    strip = graph.work.strips[number]
    return any(
        isinstance(part, Call)
        and part.name in ("SIN", "COS")
        and any(
            isinstance(each, CellRef) and (each.sheet, each.col) == (strip.sheet, strip.line)
            for each in walk(part.args[0])
        )
        for reader in graph.readers[number]
        for part in walk(graph.formulas[reader])
    )


def likely_runs(graph: Graph) -> list[Run]:
    """The runs that may be the driver's, the likeliest first, each followed by those that are counted by it."""
    return [one for run in drivers(graph)[:MOST_RUNS] for one in (run, *counted(graph, run))]


def typed_runs(graph: Graph, asked: Sequence[Array]) -> list[Run]:
    """What may be the driver's values where all of a table was pasted as numbers: runs with others beside them. Those that
    are the values asked for, in one of the units given; where no formula reads any run, each of them."""
    runs = [run for run in runs_of_numbers(graph.work) if np.ptp(run.column(graph.work)) > 0]
    found = [run for run in runs if any(_beside(run, other) for other in runs)]
    meant = [run for run in found if any(_same(run.column(graph.work), values) for values in asked)]
    return meant or ([] if drivers(graph) else found[:MOST_RUNS])


def _beside(run: Run, other: Run) -> bool:
    """Whether numbers of another line stand in most rows of a run and in no others: a column may have gaps."""
    inside = run.sheet == other.sheet and run.line != other.line and run.start <= other.start and other.end <= run.end
    return inside and 2 * other.length >= run.length


def _same(column: Array, values: Array) -> bool:
    return len(column) == len(values) and bool(np.allclose(column, values, rtol=1e-6, atol=1e-6 * np.ptp(values)))


def columns_of(several: Sequence[Series], work: Work, rows: int) -> Array:
    """The numbers of several series, shape (series, rows)."""
    return np.array([series.column(work) for series in several]).reshape(len(several), rows)


def aligned(graph: Graph, driver: Run) -> list[Series]:
    """All series beside a driver, in the order of the sheets."""
    origins = _origins(graph, driver)
    work = graph.work
    grouped: dict[tuple[str, int, int], list[Strip]] = {}
    for number, origin in origins.items():
        strip = work.strips[number]
        grouped.setdefault((strip.sheet, strip.line, origin), []).append(strip)
    for run in runs_of_numbers(work):
        if _beside(driver, run):
            grouped.setdefault((run.sheet, run.line, driver.start), [])
    found = []
    for (sheet, line, origin), strips in grouped.items():
        rows = np.flatnonzero(work.filled(sheet, origin, line, driver.length)).tolist()
        if rows:
            found.append(Series(sheet, line, origin, driver.length, _main(strips), rows[0], rows[-1]))
    order = {sheet.title: number for number, sheet in enumerate(work.book.sheets)}
    return sorted(found, key=lambda series: (order[series.sheet], series.line, series.origin))


def of_table(graph: Graph, driver: Run) -> set[int]:
    """The strips beside a driver, and all that depend on it."""
    origins = _origins(graph, driver)
    return graph.below(graph.readers_of(driver) | origins.keys())


def _main(strips: Sequence[Strip]) -> Strip | None:
    return max(strips, key=lambda strip: strip.length) if strips else None


def _origins(graph: Graph, driver: Run) -> dict[int, int]:
    """Strip -> the position that belongs to the driver's first row, by what it reads."""
    work = graph.work
    origins: dict[int, int] = {}
    long = [number for number, strip in enumerate(work.strips) if strip.length >= 3]
    own = {
        number
        for number in long
        if (work.strips[number].sheet, work.strips[number].line) == (driver.sheet, driver.line)
        and driver.start <= work.strips[number].start < driver.end
    }
    for number in long:
        strip = work.strips[number]
        if number not in own and (strip.sheet, strip.start, strip.end) == (driver.sheet, driver.start, driver.end):
            origins[number] = driver.start  # beside the driver from end to end, whatever it reads
    while True:
        new = {}
        for number in long:
            if number in origins or number in own:
                continue
            found = _origin(graph, number, driver, origins)
            if found is not None:
                new[number] = found
        if not new:
            return origins
        origins |= new


def _origin(graph: Graph, number: int, driver: Run, origins: dict[int, int]) -> int | None:
    strip = graph.work.strips[number]
    seen: Counter[int] = Counter()
    for start, end in graph.corners(number):
        if start is not end or start.row_abs:
            continue
        sheet = graph.titles.get((start.sheet or strip.sheet).casefold())
        if (sheet, start.col) == (driver.sheet, driver.line) and driver.start - 1 <= start.row < driver.end:
            seen[strip.start - (start.row - driver.start)] += 1
            continue
        for other in graph.work.lines.get((sheet or "", start.col), ()):
            target = graph.work.strips[other]
            if (
                other in origins
                and other != number
                and target.start < start.row + strip.length
                and start.row < target.end
            ):
                seen[strip.start - (start.row - origins[other])] += 1
    if not seen:
        return None
    here = driver.start
    if strip.sheet == driver.sheet and here <= strip.start < driver.end and any(abs(o - here) <= 2 for o in seen):
        return here
    return min(seen, key=lambda origin: (-seen[origin], origin))
