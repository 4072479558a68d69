"""Which cells of a sheet are the mechanism's dimensions: by their names, the words beside them, their values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula.nodes import symbols
from mechsheet.homework.agreement import DEGREE, POWERS
from mechsheet.homework.formula_strips import Place
from mechsheet.homework.headings import around, contains, names_over, plain, says
from mechsheet.homework.series import Graph, Run, of_table
from mechsheet.model import Dimension, Mechanism
from mechsheet.words.catalogue import LANGUAGES

SAME = 1e-6
"""Two numbers that differ by less than this part of them are one number typed twice."""
ROUNDED = 1e-3
"""A derived dimension worked out on paper may be rounded so far."""
MOST_UNREAD = 400
"""Typed numbers that no formula reads, looked at for a dimension's name beside them."""


@dataclass(frozen=True, slots=True)
class Input:
    """A cell that holds a dimension: dimension = factor * cell, in internal units."""

    symbol: str
    place: Place
    factor: float
    told: bool

    def cell_value(self, value: float) -> float:
        """What is typed for a value in internal units."""
        return value / self.factor


def single_cells(graph: Graph, driver: Run) -> list[Place]:
    """Typed numbers that the formulas of a driver's table, or what these depend on, read one by one, in the order of the
    sheets; not those that make the driver alone. Another table may have dimensions of its own."""
    work = graph.work
    along = {(driver.sheet, pos, driver.line) for pos in range(driver.start, driver.end)}
    found: dict[Place, None] = {}
    for number in sorted(graph.above(of_table(graph, driver)) or range(len(work.strips))):
        strip = work.strips[number]
        if (strip.sheet, strip.line) == (driver.sheet, driver.line) and driver.start <= strip.start <= driver.end:
            continue
        for start, end in graph.corners(number):
            sheet = graph.titles.get((start.sheet or strip.sheet).casefold())
            if start is not end or sheet is None or not (start.row_abs or strip.length == 1):
                continue
            place = sheet, start.row, start.col
            filled = work.strip_at(place)
            constant = filled is None or (work.strips[filled].length == 1 and not graph.corners(filled))
            if place not in found and place not in along and constant and math.isfinite(work.number(place)):
                found[place] = None
    order = {sheet.title: number for number, sheet in enumerate(work.book.sheets)}
    return sorted(found, key=lambda place: (order[place[0]], place[2], place[1]))


def unread_inputs(
    graph: Graph, mechanism: Mechanism, values: Mapping[str, float], driver: Run, known: Sequence[Input]
) -> tuple[Input, ...]:
    """Cells that are called as a dimension that none of the `known` ones is, though no formula reads them: the number
    may have been typed into the formulas instead."""
    taken = {one.place for one in known} | set(driver.places())
    found = {one.symbol for one in known}
    dims = [dim for dim in mechanism.free_dimensions if dim.symbol not in found]
    power = next((one.factor for one in known if is_length(mechanism, one.symbol)), 1.0)
    typed = [place for place in typed_numbers(graph) if place not in taken][:MOST_UNREAD] if dims else []
    texts = [_texts(graph, place) for place in typed]
    told = [n for n, (names, words) in enumerate(texts) if any(_told(dim, names, words) for dim in dims)]
    return tuple(_chosen(graph, dims, values, [typed[n] for n in told], [texts[n] for n in told], power, True))


def is_length(mechanism: Mechanism, symbol: str) -> bool:
    """Whether a dimension is a length."""
    return any(dim.symbol == symbol and dim.unit.kind == "length" for dim in mechanism.dimensions)


def typed_numbers(graph: Graph) -> Iterator[Place]:
    """The cells in which numbers were typed, sheet by sheet."""
    work = graph.work
    for sheet in work.book.sheets:
        for row, col, value in sheet.constants.items():
            if isinstance(value, float) and math.isfinite(value):
                yield (sheet.title, col, row) if work.across else (sheet.title, row, col)


@dataclass(frozen=True, slots=True)
class _Pair:
    score: int
    dimension: int
    cell: int
    factor: float
    told: bool


def inputs_of(
    graph: Graph, mechanism: Mechanism, values: Mapping[str, float], driver: Run, by_words: bool
) -> tuple[Input, ...]:
    """The cells of the dimensions. `by_words`: what is written beside a cell counts more than the number in it."""
    cells = single_cells(graph, driver)
    geometric = [dim for dim in mechanism.dimensions if not dim.path]
    power = _power(graph, geometric, values, cells)
    texts = [_texts(graph, place) for place in cells]
    chosen = _chosen(graph, [dim for dim in geometric if not dim.derived], values, cells, texts, power, by_words)
    known = {pair.symbol for pair in chosen}
    taken = {pair.place for pair in chosen}
    rest = [(place, text) for place, text in zip(cells, texts, strict=True) if place not in taken]
    derived = [dim for dim in geometric if dim.derived and not _bases(dim, mechanism) <= known]
    more = _chosen(graph, derived, values, [p for p, _ in rest], [t for _, t in rest], power, by_words)
    return (*chosen, *more)


def _bases(dim: Dimension, mechanism: Mechanism) -> set[str]:
    """The inputs that a derived dimension follows from."""
    by_symbol = {other.symbol: other for other in mechanism.dimensions}
    found: set[str] = set()
    waiting = [dim]
    while waiting:
        value = waiting.pop().value
        for symbol in () if isinstance(value, float) else symbols(value):
            other = by_symbol.get(symbol)
            if other is not None and other.derived:
                waiting.append(other)
            elif other is not None:
                found.add(symbol)
    return found


def _texts(graph: Graph, place: Place) -> tuple[list[str], list[str]]:
    """(names of a cell, words beside it)."""
    return names_over(graph.work, [place]), around(graph.work, place)


def _power(graph: Graph, dims: Iterable[Dimension], values: Mapping[str, float], cells: Sequence[Place]) -> float:
    """The factor from the sheet's lengths to the description's: the one with which most of them are found."""
    numbers = [graph.work.number(place) for place in cells]
    lengths = [values[dim.symbol] for dim in dims if dim.unit.kind == "length" and values[dim.symbol]]

    def found(power: float) -> int:
        return sum(any(abs(number * power - length) <= SAME * abs(length) for number in numbers) for length in lengths)

    return max(POWERS, key=lambda power: (found(power), power == 1.0))


def _chosen(
    graph: Graph,
    dims: Sequence[Dimension],
    values: Mapping[str, float],
    cells: Sequence[Place],
    texts: Sequence[tuple[list[str], list[str]]],
    power: float,
    by_words: bool,
) -> list[Input]:
    pairs = []
    for number, dim in enumerate(dims):
        for index, place in enumerate(cells):
            pair = _pair(graph, dim, number, values[dim.symbol], place, index, texts[index], power, by_words)
            if pair is not None:
                pairs.append(pair)
    pairs.sort(key=lambda pair: (-pair.score, pair.dimension, pair.cell))
    found: dict[int, _Pair] = {}
    taken: set[int] = set()
    for pair in pairs:
        if pair.dimension not in found and pair.cell not in taken:
            found[pair.dimension] = pair
            taken.add(pair.cell)
    return [Input(dims[n].symbol, cells[pair.cell], pair.factor, pair.told) for n, pair in sorted(found.items())]


def _pair(
    graph: Graph,
    dim: Dimension,
    number: int,
    value: float,
    place: Place,
    index: int,
    text: tuple[list[str], list[str]],
    power: float,
    by_words: bool,
) -> _Pair | None:
    """How well a cell suits a dimension, None where nothing speaks for it."""
    cell = graph.work.number(place)
    names, words = text
    told = _told(dim, names, words)
    factors = (1.0, DEGREE) if dim.unit.kind == "angle" else (power,) if dim.unit.kind == "length" else (1.0,)
    near = ROUNDED if dim.derived else SAME
    for factor in factors:
        for sign in (1, -1):
            if abs(sign * factor * cell - value) <= near * abs(value) and (value or told):
                score = (60 if sign == 1 else 45) + told
                return _Pair(score, number, index, sign * factor, bool(told))
    if not told:
        return None
    factor = min(factors, key=lambda each: abs(math.log((abs(each * cell) + 1e-9) / (abs(value) + 1e-9))))
    return _Pair((61 if by_words else 5) + told, number, index, factor, True)


def _told(dim: Dimension, names: Sequence[str], words: Sequence[str]) -> int:
    """How clearly a cell is called as a dimension: 0 not at all."""
    called = {plain(name).replace("_", "") for name in (dim.symbol, dim.cell or "") if name}
    if any(plain(name).replace("_", "") in called for name in names):
        return 40
    labels = [dim.label.of(language) for language in LANGUAGES] if dim.label else []
    for rank, text in enumerate(words):
        if says(text, dim.symbol) or any(contains(text, label) for label in labels):
            return 30 - rank
    return 0
