"""A workbook understood: its driver, its dimensions, its series, and the mechanism with the sheet's own numbers.

A two-way table is one formula filled down beside the driver's values and to the right below those of a dimension: each
column has a dimension of its own in the cell above it. One of them, the one whose dimension is an input of the sheet, is
understood as any other column; the others are held against the mechanism with theirs.

A sheet may count an angle from another zero, in another turn, or sense: then outputs and summaries follow (`as_counted`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault, WorkbookError
from livesheet.engine import Values
from mechsheet import reference
from mechsheet.homework.agreement import DEGREE, POWERS, Reading, allowance, gaps, likely, nearest_unit, reading_of
from mechsheet.homework.expected_values import Array, Quantity, Shift, Truth, driver_asked, truth_of, vocabulary
from mechsheet.homework.formula_strips import Place, Work
from mechsheet.homework.headings import Called, aliases_of, called, contains, heading, labels, names_over, tokens
from mechsheet.homework.inputs import Input, inputs_of, is_length, unread_inputs
from mechsheet.homework.series import Graph, Run, Series, aligned, by_law, columns_of, drivers, likely_runs, typed_runs
from mechsheet.model import Dimension, Mechanism
from mechsheet.reference.expressions import column as computed

ENOUGH = 2
"""So many of the asked quantities found with a way to read the driver settle that it is the right way."""

MOVING = 20
"""What changes by less than so many tolerances is told from nothing that stands still."""

SMALL = 1e-3
"""A change by less than this part of what is allowed is rounding."""

ENOUGH_TO_SEE = 1.03
"""A dimension that is larger by this factor shows on what depends on it."""


@dataclass
class Understanding:
    """See the module.

    factor, offset  driver = factor * cell + offset in internal units
    counted         the columns that outputs and summaries are computed from, and how they say their quantities
    settings        the columns of a two-way table by the cells above them
    by_convention   outputs that follow from these as the sheet counts them, not from the description's (see `in_convention`)
    """

    graph: Graph
    driver: Run
    factor: float
    offset: float
    inputs: tuple[Input, ...]
    truth: Truth
    series: list[Series]
    tolerance: float
    counted: Mapping[str, tuple[Series, Reading]] = field(default_factory=dict)
    by_convention: frozenset[str] = frozenset()
    settings: Settings = field(default_factory=dict)
    headings: dict[tuple[str, int, int], tuple[str, ...]] = field(default_factory=dict)
    names: dict[tuple[str, ...], Called] = field(default_factory=dict)

    @property
    def work(self) -> Work:
        """The workbook."""
        return self.graph.work

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.truth.mechanism

    @property
    def zeros(self) -> list[float]:
        """Angles among the dimensions."""
        return [self.truth.dimensions[dim.symbol] for dim in self.mechanism.dimensions if dim.unit.kind == "angle"]

    @property
    def length_unit(self) -> float:
        """The factor from the sheet's lengths to the mechanism's: that of its dimensions."""
        return next((abs(one.factor) for one in self.inputs if is_length(self.mechanism, one.symbol)), 1.0)

    def allowed(self, quantity: Quantity) -> float:
        """How far a column may be from a quantity."""
        return allowance(quantity, self.truth.size, self.tolerance)

    def is_still(self, quantity: Quantity) -> bool:
        """Whether a quantity changes too little to be told from anything that stands still."""
        return quantity.spread <= MOVING * self.allowed(quantity)

    def meant_unit(self, column: Array, quantity: Quantity) -> float:
        """The unit in which a column that is wrong is meant: of lengths that of the dimensions."""
        return self.length_unit if quantity.kind == "length" else nearest_unit(column, quantity)

    def heading(self, series: Series) -> str:
        """The words over a series, with the workbook's names for it."""
        return " ".join(self.heading_cells(series)).strip()

    def heading_cells(self, series: Series) -> tuple[str, ...]:
        """The same, text by text."""
        if series.key not in self.headings:
            cells = heading(self.work, series.sheet, series.origin + series.first, series.line)
            self.headings[series.key] = (*cells, *names_over(self.work, series.cells.places()))
        return self.headings[series.key]

    def called(self, series: Series) -> Called:
        """Which columns of the mechanism a series is headed by: by their symbols, else by their labels."""
        cells = self.heading_cells(series)
        if cells not in self.names:
            found = called(cells, aliases_of(tuple(self.truth.columns)))
            self.names[cells] = found if found.symbols else self._labelled(cells)
        return self.names[cells]

    def _labelled(self, cells: Sequence[str]) -> Called:
        named = [(symbol, label) for symbol in self.truth.columns for label in labels(self.mechanism, symbol)]
        found = [(symbol, label, cell) for symbol, label in named for cell in cells if contains(cell, label)]
        alone = any(set(tokens(cell)) <= set(tokens(label)) for _, label, cell in found)
        return Called(frozenset(symbol for symbol, _, _ in found), alone)


def understand(
    work: Work,
    mechanism: Mechanism,
    asked: Sequence[str],
    tolerance: float,
    unusual: bool,
    runs: Sequence[Run] | None,
) -> Understanding:
    """Understand a workbook. Raises WorkbookError where nothing in it is a table of this mechanism.

    unusual  the driver may be counted clockwise, or from another zero; or be computed from a column of times
    runs     what may be the driver's values; without them the likeliest of the workbook
    """
    graph = Graph(work)
    given = reference.dimension_values(mechanism)
    if runs is None:
        runs = likely_runs(graph)
        runs += [run for run in typed_runs(graph, _asked_values(mechanism, given)) if run not in runs]
    if unusual:
        runs = [*runs, *by_law(graph, runs, bool(mechanism.driver.joint))]
    if not runs:
        raise WorkbookError(Fault("no table", about="no table"))
    best: tuple[tuple[int, int], Understanding] | None = None
    for run in runs:
        series = aligned(graph, run)
        settings = settings_of(graph, series)
        for inputs in _possible_inputs(graph, mechanism, given, run, settings):
            for factor, offset in ways(work, run, mechanism, unusual):
                found = _hypothesis(graph, run, factor, offset, inputs, mechanism, series, settings, tolerance)
                if found is None:
                    continue
                score = _score(found, asked)
                if best is None or score > best[0]:
                    best = score, found
                if score[0] >= min(ENOUGH, len(asked)):
                    break
            if best is not None and best[0][0] >= min(ENOUGH, len(asked)):
                break
        if best is not None and best[0][0]:
            break
    if best is None:
        raise WorkbookError(Fault("no position", about="no position"))
    return _without_namesakes(best[1], asked)


def _without_namesakes(found: Understanding, asked: Sequence[str]) -> Understanding:
    """Without cells that merely hold the number of a dimension: no name says that they are it, and nothing asked depends on
    it. A coordinate of 60 mm is no spring of 60 N/mm."""
    of = {summary.symbol: summary.of for summary in found.mechanism.summaries}
    names = dict.fromkeys(of.get(symbol, symbol) for symbol in asked)
    wanted = [found.truth.quantity(name) for name in names if name in found.truth.columns]
    kept = tuple(one for one in found.inputs if one.told or _matters(found, one, wanted))
    return found if len(kept) == len(found.inputs) else replace(found, inputs=kept)


def _matters(found: Understanding, one: Input, wanted: Sequence[Quantity]) -> bool:
    """Whether any of these quantities depends on a dimension."""
    truth = found.truth
    changed = {**dimensions_in(found.work, found.inputs), one.symbol: truth.dimensions[one.symbol] * ENOUGH_TO_SEE}
    other = truth_of(found.mechanism, changed, truth.driver, truth.poses)
    return other is None or any(
        gaps(other.columns[quantity.name], quantity, Reading()).max(initial=0.0) > SMALL * found.allowed(quantity)
        for quantity in wanted
    )


def _asked_values(mechanism: Mechanism, given: Mapping[str, float]) -> list[Array]:
    """The driver's values as the description asks for them, in its units and in degrees."""
    values = driver_asked(mechanism, given)
    if values is None:
        return []
    return [values, np.asarray(mechanism.driver.unit.to_shown(values), float), values / DEGREE]


def other_runs(graph: Graph, used: Sequence[Understanding]) -> list[Run]:
    """What may be the driver's values in tables of the workbook besides those understood."""
    taken = [cells for found in used for cells in (found.driver, *(one.cells for one in found.series))]
    return [run for run in drivers(graph, 0.0) if not any(run.meets(cells) for cells in taken)]


def _possible_inputs(
    graph: Graph, mechanism: Mechanism, given: Mapping[str, float], run: Run, settings: Settings
) -> Iterator[tuple[Input, ...]]:
    """The cells of the dimensions: by what is written beside them, by their numbers, with those that no formula reads, with
    one above a column of a two-way table."""
    by_words = inputs_of(graph, mechanism, given, run, True)
    unread = unread_inputs(graph, mechanism, given, run, by_words)
    if unread and not by_words:  # no formula reads anything: the numbers were pasted
        yield unread
    yield by_words
    by_numbers = inputs_of(graph, mechanism, given, run, False)
    if by_numbers != by_words:
        yield by_numbers
    if unread and by_words:
        yield (*by_words, *unread)
    power = next((one.factor for one in by_words if is_length(mechanism, one.symbol)), 1.0)
    yield from with_setting(by_words, settings, mechanism.dimensions, power)


def _hypothesis(
    graph: Graph,
    run: Run,
    factor: float,
    offset: float,
    inputs: tuple[Input, ...],
    mechanism: Mechanism,
    series: list[Series],
    settings: Settings,
    tolerance: float,
) -> Understanding | None:
    values = dimensions_in(graph.work, inputs)
    truth = truth_of(mechanism, values, run.column(graph.work) * factor + offset)
    if truth is None:
        return None
    series = without_others(series, inputs, settings)
    return Understanding(graph, run, factor, offset, inputs, truth, series, tolerance, settings=settings)


def dimensions_in(work: Work, inputs: Sequence[Input]) -> dict[str, float]:
    """The dimensions that the sheet has, in internal units."""
    return {found.symbol: found.factor * work.number(found.place) for found in inputs}


def ways(work: Work, run: Run, mechanism: Mechanism, unusual: bool) -> Iterator[tuple[float, float]]:
    """(factor, offset) in which the driver may be written, the usual ones first."""
    column = run.column(work)
    if mechanism.driver.joint:
        yield from ((power, 0.0) for power in POWERS)
        return
    largest = float(np.abs(column).max())
    units = (DEGREE, 1.0) if largest > 7 else (1.0, DEGREE)
    for unit in units[: 1 if largest > 40 else 2]:
        yield unit, 0.0
    for unit in units[:1] if unusual else ():
        yield from (
            (sign * unit, turn)
            for sign, turn in ((-1, 0.0), (1, math.pi), (-1, math.pi), (1, math.pi / 2), (1, -math.pi / 2))
        )


def _score(found: Understanding, asked: Sequence[str]) -> tuple[int, int]:
    """(asked quantities that some series is, series that are anything of the mechanism)."""
    columns = columns_of(found.series, found.work, found.driver.length)
    right = 0
    for symbol in asked:
        if symbol in found.truth.columns:
            quantity = found.truth.quantity(symbol)
            allowed = found.allowed(quantity)
            if found.is_still(quantity):
                continue  # anything that stands still would be it
            some = columns[likely(columns, quantity, allowed)]
            right += any(reading_of(column, quantity, allowed, found.zeros) for column in some)
    if right >= min(ENOUGH, len(asked)):
        return right, 0
    return right, int(anything(columns, vocabulary(found.truth), found.allowed).sum())


def anything(
    columns: Array, words: Sequence[Quantity], allowed: Callable[[Quantity], float], zeros: Sequence[float] = ()
) -> NDArray[np.bool_]:
    """Which of the columns, shape (columns, rows), are some quantity of a vocabulary."""
    found = np.zeros(len(columns), bool)
    for word in words:
        if word.spread <= MOVING * allowed(word):
            continue
        near = likely(columns, word, allowed(word)) & ~found
        for number in np.flatnonzero(near):
            found[number] = reading_of(columns[number], word, allowed(word), zeros) is not None
    return found


def retyped(found: Understanding, changes: Mapping[str, float]) -> tuple[dict[str, float], dict[Place, float]]:
    """(all dimensions with changes, what is typed into which cell for them)."""
    values = dimensions_in(found.work, found.inputs) | dict(changes)
    cells = {
        found.work.engine_place(one.place): one.cell_value(changes[one.symbol])
        for one in found.inputs
        if one.symbol in changes
    }
    return values, cells


# --- as the sheet counts ---------------------------------------------------------------------------------------------


def as_counted(found: Understanding, truth: Truth, values: Values | None = None) -> Truth:
    """A truth with the conventions of the sheet's columns, as these are in some state of the workbook."""
    shifts = {}
    for symbol, (series, reading) in found.counted.items():
        shift = _shift(found, truth, symbol, series, reading, values)
        if shift is not None:
            shifts[symbol] = shift
    if not shifts:
        return truth
    known = {name: np.array(value) for name, value in truth.dimensions.items()} | dict(truth.columns)
    known |= {symbol: shift.counted(truth.columns[symbol]) for symbol, shift in shifts.items()}
    columns = dict(truth.columns)
    for output in found.mechanism.outputs:
        if output.symbol in found.by_convention:
            values_ = computed(output.formula, known, len(truth.driver))
            columns[output.symbol] = known[output.symbol] = np.where(truth.exists, values_, np.nan)
    return replace(truth, columns=columns, shifts=shifts, spans={})


def _shift(
    found: Understanding, truth: Truth, symbol: str, series: Series, reading: Reading, values: Values | None
) -> Shift | None:
    """How a column counts: by the same in most rows, else it has no convention; None where it is the quantity itself."""
    own = reading.unit * series.column(found.work, values)
    apart = reading.sense * own - truth.columns[symbol]
    known = apart[np.isfinite(apart)]
    if not len(known):
        return None
    offset = float(np.median(known))
    allowed = found.allowed(truth.quantity(symbol))
    if 2 * (np.abs(known - offset) <= 2 * allowed).sum() <= len(known):
        return None
    return None if reading.sense == 1 and abs(offset) <= allowed else Shift(reading.sense, offset)


# --- two-way tables --------------------------------------------------------------------------------------------------


Settings = dict[Place, Series]
"""The columns of a two-way table by the cells above them that they read."""


def settings_of(graph: Graph, several: Sequence[Series]) -> Settings:
    """The columns of a table that read a number typed above themselves, where at least two read one of the same row."""
    rows: dict[tuple[str, int], Settings] = {}
    for series in several:
        for place in _above(graph, series):
            rows.setdefault(place[:2], {})[place] = series
    return max(rows.values(), key=len, default={}) if any(len(found) > 1 for found in rows.values()) else {}


def _above(graph: Graph, series: Series) -> Iterator[Place]:
    main, work = series.main, graph.work
    for start, end in graph.corners(work.strips.index(main)) if main is not None else ():
        place = series.sheet, start.row, start.col
        above = start is end and start.row_abs and start.col == series.line and start.row < series.origin
        here = above and (start.sheet or series.sheet) == series.sheet
        if here and work.strip_at(place) is None and math.isfinite(work.number(place)):
            yield place


def with_setting(
    inputs: Sequence[Input], settings: Settings, dims: Sequence[Dimension], power: float
) -> Iterator[tuple[Input, ...]]:
    """The inputs, with one of the cells above the columns for a dimension that has none."""
    if not settings or any(one.place in settings for one in inputs):
        return
    known = {one.symbol for one in inputs}
    for dim in dims:
        if dim.symbol not in known and not (dim.path or dim.derived):
            yield (*inputs, Input(dim.symbol, next(iter(settings)), power if dim.unit.kind == "length" else 1.0, False))


def others_of(found: Understanding) -> Iterator[tuple[Series, Understanding]]:
    """The other columns of a two-way table, each understood with its own dimension."""
    own = next((one for one in found.inputs if one.place in found.settings), None)
    if own is None:
        return
    main = found.settings[own.place]
    for place, series in found.settings.items():
        if series.key == main.key:
            continue
        inputs = tuple(replace(one, place=place) if one is own else one for one in found.inputs)
        values = {one.symbol: one.factor * found.work.number(one.place) for one in inputs}
        truth = truth_of(found.mechanism, values, found.truth.driver, found.truth.poses)
        if truth is not None:
            columns = [series if one.key == main.key else one for one in found.series]
            yield series, replace(found, inputs=inputs, truth=truth, series=columns, settings={})


def columns_beside(graph: Graph, driver: Run, inputs: Sequence[Input]) -> tuple[list[Series], Settings]:
    """The columns of a table, of a two-way one the column that is understood; and the columns of the latter."""
    several = aligned(graph, driver)
    settings = settings_of(graph, several)
    return without_others(several, inputs, settings), settings


def without_others(several: Sequence[Series], inputs: Sequence[Input], settings: Settings) -> list[Series]:
    """The columns of a table, of a two-way one the column that is understood."""
    own = next((settings[one.place] for one in inputs if one.place in settings), None)
    left_out = {series.key for series in settings.values() if own is not None and series.key != own.key}
    return [series for series in several if series.key not in left_out]


def where(found: Understanding, series: Series) -> str:
    """The cells of a column by name; of a two-way table's those of all its columns, where these stand beside each other."""
    lines = sorted(one.line for one in found.settings.values())
    if any(one.key == series.key for one in found.settings.values()) and lines[-1] - lines[0] == len(lines) - 1:
        first = series.origin + series.first
        return found.work.where(series.sheet, first, lines[0], series.last - series.first + 1, len(lines))
    return series.where(found.work)
