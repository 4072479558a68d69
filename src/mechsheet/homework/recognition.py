"""What a workbook seems to be: the packaged linkage that its numbers are, or none; in words and as JSON data.

A linkage is claimed only where the sheet's own formulas prove it: some computed columns are what its links do in every row,
they stay so when each dimension that decides the motion is retyped, and one of them follows at least two dimensions. A
circle drawn by one radius, or an ellipse, is no mechanism.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from livesheet.diagnostics import readable_name
from livesheet.formula.nodes import symbols
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.description.templates import template_names, template_text
from mechsheet.description.text.rewrite import with_number
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import MechanismError
from mechsheet.homework.agreement import DEGREE, Reading, gaps, likely, reading_of
from mechsheet.homework.assignments import likely_assignments, modes_of
from mechsheet.homework.expected_values import TOLERANCE, Array, Quantity, Truth, all_assemblies, vocabulary
from mechsheet.homework.formula_strips import Place, Work
from mechsheet.homework.headings import around
from mechsheet.homework.inputs import Input, inputs_of, single_cells
from mechsheet.homework.series import Graph, Run, Series, aligned, columns_of, likely_runs
from mechsheet.homework.understanding import Understanding, ways
from mechsheet.homework.verdicts import retype
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.solve import solve
from mechsheet.model import Cartesian, Dimension, Distances, Mechanism, Polar
from mechsheet.words.catalogue import said

GENERAL = ("four-bar", "slider-crank", "inverted-slider-crank", "slotted-lever", "whitworth", "fivelink")
"""Templates that stand for all of their kind, before special cases of them."""
MOST_DIMENSIONS = 5
"""Dimensions that numbers without words may be given to."""


@dataclass(frozen=True, slots=True)
class Recognised:
    """A linkage that a workbook is.

    template     the name of its description;  found  the workbook understood as it
    quantities   what its columns are: (series, quantity, how it is read)
    missing      dimensions of the description that the workbook does not have
    """

    template: str
    found: Understanding
    quantities: tuple[tuple[Series, str, Reading], ...]
    missing: tuple[str, ...]


class Table:
    """A table of the workbook: a driver with what stands beside it."""

    def __init__(self, graph: Graph, run: Run) -> None:
        self.graph, self.run = graph, run
        self.series = [series for series in aligned(graph, run) if series.main is not None]
        self.cells: list[Place] = single_cells(graph, run)
        self.driver = run.column(graph.work)

    @cached_property
    def columns(self) -> Array:
        """The computed columns that move, shape (columns, rows)."""
        found = columns_of(self.series, self.graph.work, self.run.length)
        with np.errstate(invalid="ignore"):
            moving = np.nanmax(found, axis=1, initial=-np.inf) - np.nanmin(found, axis=1, initial=np.inf) > 0
        moved: Array = found[moving]
        return moved


def tables(work: Work) -> list[Table]:
    """The tables that a workbook may have, the likeliest first."""
    graph = Graph(work)
    return [Table(graph, run) for run in likely_runs(graph)]


def recognise(found: Sequence[Table], say: Callable[[str], None] = lambda _: None) -> Recognised | None:
    """The packaged linkage that explains most of a table; None where none is proven."""
    best: tuple[tuple[int, int, int], Recognised] | None = None
    names = sorted(template_names(), key=lambda name: (GENERAL.index(name) if name in GENERAL else len(GENERAL), name))
    seen: set[object] = set()
    for order, name in enumerate(names):
        say(name)
        mechanism = loads(template_text(name), name)
        if _make(mechanism) in seen:
            continue  # a special case of what is proven already
        decisive = deciding(mechanism)
        possible = [table for table in found if 2 <= len(decisive) <= len(table.cells) + 1]
        possible = [
            table for table in possible if len(decisive) <= MOST_DIMENSIONS or len(_called(mechanism, table)) > 2
        ]
        if best is not None:  # only what has more dimensions, each with its cell, explains more
            used = len(best[1].found.inputs)
            possible = [table for table in possible if used < len(decisive) <= len(table.cells)]
        if not possible:
            continue
        try:
            equations = solve(mechanism)
        except MechanismError:
            continue
        if any(group.system is not None for group in equations.groups):
            continue  # links that are solved all at once: nobody does that by hand
        for table in possible:
            one = _in_table(name, mechanism, equations, table, decisive)
            if one is not None:
                own = {link.angle_symbol for link in mechanism.links} | {joint.symbol for joint in mechanism.joints}
                moving = sum(quantity in own for _, quantity, _ in one.quantities)
                rank = moving, -order, len(one.quantities)
                seen.add(_make(mechanism))
                if best is None or rank > best[0]:
                    best = rank, one
        if best is not None and any(len(best[1].quantities) == len(table.columns) for table in found):
            break  # every column is explained
    return None if best is None else best[1]


def _make(mechanism: Mechanism) -> object:
    """What linkages of one kind have in common: how their links are joined, whatever they are called."""
    shared = Counter(point for link in mechanism.links for point in link.points)
    pins = sorted(count for count in shared.values() if count > 1)
    slides = sorted(joint.kind for joint in mechanism.joints)
    return len(mechanism.links), tuple(pins), tuple(slides), bool(mechanism.driver.joint), len(mechanism.relations)


def _in_table(
    name: str, mechanism: Mechanism, equations: Equations, table: Table, decisive: Sequence[str]
) -> Recognised | None:
    geometric = mechanism.free_dimensions
    called = _called(mechanism, table)
    for factor, offset in ways(table.graph.work, table.run, mechanism, False):
        for inputs in _inputs(mechanism, equations, table, geometric, decisive, called, factor):
            one = _proven(name, mechanism, table, inputs, decisive, factor, offset)
            if one is not None:
                return one
    return None


def _called(mechanism: Mechanism, table: Table) -> tuple[Input, ...]:
    """The dimensions that are called by their symbols or labels."""
    given = reference.dimension_values(mechanism)
    return tuple(one for one in inputs_of(table.graph, mechanism, given, table.run, True) if one.told)


def deciding(mechanism: Mechanism) -> tuple[str, ...]:
    """The dimensions that decide how the links move, in the description's order: those in the places of joints, those of a
    cam and of its motion.

    A point that only one link has is carried along: its dimensions decide nothing.
    """
    counted_points = Counter(point for link in mechanism.links for point in link.points)
    slides = {name for joint in mechanism.joints for name in (joint.point, joint.through) if isinstance(name, str)}
    parts: list[object] = [(joint.through, joint.angle, joint.orientation) for joint in mechanism.joints]
    for link in mechanism.links:
        parts += [at for point, at in link.points.items() if counted_points[point] > 1 or point in slides]
    if mechanism.cam is not None:
        parts += [mechanism.cam.base_radius, mechanism.cam.radius]
    for segment in mechanism.segments.parts if mechanism.segments is not None else ():
        parts += [segment.over, segment.by]
    by_symbol = {dim.symbol: dim for dim in mechanism.dimensions}
    read: set[str] = set()
    waiting = [symbol for part in parts for symbol in _read(part)]
    while waiting:
        symbol = waiting.pop()
        dim = by_symbol.get(symbol)
        if dim is None or symbol in read:
            continue
        read.add(symbol)
        if not isinstance(dim.value, float):
            waiting += symbols(dim.value)
    return tuple(dim.symbol for dim in mechanism.free_dimensions if dim.symbol in read)


def _read(part: object) -> list[str]:
    """The quantities that places are written with; of points by distances the points' own are found with them."""
    if isinstance(part, tuple | list):
        return [symbol for one in part for symbol in _read(one)]
    if isinstance(part, Mapping):
        return [symbol for one in part.values() for symbol in _read(one)]
    if isinstance(part, Cartesian | Polar | Distances):
        return [symbol for one in fields(part) for symbol in _read(getattr(part, one.name))]
    return [] if part is None or isinstance(part, str | float) else list(symbols(part))  # type: ignore[arg-type]


def _inputs(
    mechanism: Mechanism,
    equations: Equations,
    table: Table,
    geometric: Sequence[Dimension],
    decisive: Sequence[str],
    called: tuple[Input, ...],
    factor: float,
) -> Iterator[tuple[Input, ...]]:
    """Cells that may be the dimensions: as they are called, then by their numbers alone."""
    if {one.symbol for one in called} >= set(decisive):
        yield called
    if len(decisive) > MOST_DIMENSIONS:
        return
    wanted = [dim for dim in geometric if dim.symbol in decisive]
    numbers = [table.graph.work.number(place) for place in table.cells]
    found = likely_assignments(mechanism, equations, wanted, numbers, table.driver * factor, table.columns)
    units = {dim.symbol: dim.unit.kind for dim in wanted}
    for assignment in found:
        yield tuple(
            Input(
                symbol,
                table.cells[index],
                DEGREE if units[symbol] == "angle" and abs(numbers[index]) > 2 * np.pi else 1.0,
                False,
            )
            for symbol, index in assignment.items()
            if index is not None
        )


def _proven(
    name: str,
    mechanism: Mechanism,
    table: Table,
    inputs: tuple[Input, ...],
    decisive: Sequence[str],
    factor: float,
    offset: float,
) -> Recognised | None:
    """The table as a mechanism with these cells as its dimensions, where that is proven: see the module."""
    work = table.graph.work
    values = {one.symbol: one.factor * work.number(one.place) for one in inputs}
    zero = [symbol for symbol in decisive if symbol not in values]
    own = in_proportion(mechanism, values | dict.fromkeys(zero, 0.0))
    ranked = []
    for truth in _assembled(own, table.driver * factor + offset):
        found = Understanding(table.graph, table.run, factor, offset, inputs, truth, table.series, TOLERANCE)
        agreeing = _agreeing(found)
        if any(driven_on(mechanism, quantity) for _, quantity, _ in agreeing):
            ranked.append((found, agreeing))
    ranked.sort(key=lambda pair: -sum(reading.plain for _, _, reading in pair[1]))
    for found, agreeing in ranked:
        proven = _lasting(found, agreeing, [symbol for symbol in decisive if symbol in values])
        if proven:
            known = set(values) | set(zero)
            missing = [dim.symbol for dim in mechanism.free_dimensions if dim.symbol not in known]
            return Recognised(name, found, tuple(proven), tuple(missing))
    return None


def in_proportion(mechanism: Mechanism, values: Mapping[str, float]) -> Mechanism:
    """The mechanism with other dimensions; lengths that nobody has given grow with those of their link that somebody has."""
    given = reference.dimension_values(mechanism)
    lengths = [dim.symbol for dim in mechanism.dimensions if dim.unit.kind == "length" and not dim.derived]
    known = [symbol for symbol in lengths if values.get(symbol) and given[symbol]]
    whole = sum(abs(values[s]) for s in known) / sum(abs(given[s]) for s in known) if known else 1.0

    def value(dim: Dimension) -> Dimension:
        if dim.symbol in values:
            return replace(dim, value=values[dim.symbol], shown=None)
        if dim.symbol not in lengths or dim.path:
            return dim
        near = [symbol for symbol in known if symbol in _of_link(mechanism, dim.symbol)]
        ratio = abs(values[near[0]] / given[near[0]]) if near else whole
        return replace(dim, value=given[dim.symbol] * ratio, shown=None)

    return replace(mechanism, dimensions=tuple(map(value, mechanism.dimensions)))


def _of_link(mechanism: Mechanism, symbol: str) -> set[str]:
    """The dimensions whose names tell that they belong to the same link: a3, b3, c3."""
    digits = symbol.lstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_")
    return {dim.symbol for dim in mechanism.dimensions if digits and dim.symbol.endswith(digits)}


def _assembled(mechanism: Mechanism, driver: Array) -> list[Truth]:
    """The mechanism in every assembly; found in the first rows that exist."""
    for row in np.unique(np.linspace(0, len(driver) - 1, 6).astype(int)):
        found = all_assemblies(mechanism, {}, driver, int(row))
        if found:
            return found
    return []


def _agreeing(found: Understanding) -> list[tuple[Series, Quantity, Reading]]:
    """Computed series that are what the mechanism does, each with the first quantity that it is."""
    columns = columns_of(found.series, found.work, found.driver.length)
    agreeing: dict[int, tuple[Series, Quantity, Reading]] = {}
    for word in vocabulary(found.truth):
        allowed = found.allowed(word)
        for number in np.flatnonzero(likely(columns, word, allowed)).tolist():
            reading = None if number in agreeing else reading_of(columns[number], word, allowed)
            if reading is not None and (word.kind != "length" or reading.unit == 1.0):
                agreeing[number] = found.series[number], word, reading
    return [agreeing[number] for number in sorted(agreeing)]


def driven_on(mechanism: Mechanism, quantity: Quantity) -> bool:
    """Whether a quantity says something of a link that is not driven itself: an output by what its formula reads."""
    near = {mechanism.ground.name, mechanism.driver.link}
    by_links = {point for link in mechanism.links if link.name in near for point in link.points}
    away = {point for link in mechanism.links for point in link.points} - by_links
    own = {link.angle_symbol for link in mechanism.links if link.name not in near}
    own |= {joint.symbol for joint in mechanism.joints if joint.symbol != mechanism.driver.symbol}
    own |= {f"{point}.{axis}" for point in away for axis in "xy"}
    read = {quantity.name}.union(*(symbols(one.formula) for one in mechanism.outputs if one.symbol == quantity.name))
    return not own.isdisjoint(read) or not away.isdisjoint(quantity.points)


def _lasting(
    found: Understanding, agreeing: Sequence[tuple[Series, Quantity, Reading]], decisive: Sequence[str]
) -> list[tuple[Series, str, Reading]]:
    """What goes on agreeing when each dimension is retyped; nothing where a dimension is followed by none of it."""
    follows: dict[str, set[str]] = {}
    lasting = list(agreeing)
    names = {quantity.name for _, quantity, _ in agreeing}
    for symbol in decisive:
        after = retype(found, [symbol], 0)
        if after is None:
            return []
        now = {word.name: word for word in vocabulary(after.truth) if word.name in names}
        kept = []
        for series, before, reading in lasting:
            word = now.get(before.name)
            if word is None:
                continue
            column = series.column(found.work, after.values)
            if gaps(column, word, reading).max() <= 10 * found.allowed(word):
                kept.append((series, before, reading))
                change = gaps(before.values, word, Reading())
                if float(change[np.isfinite(change)].max(initial=0.0)) > 20 * found.allowed(word):
                    follows.setdefault(before.name, set()).add(symbol)
        lasting = kept
    there = [follows.get(quantity.name, set()) for _, quantity, _ in lasting]
    if set().union(*there) < set(decisive) or max(map(len, there), default=0) < 2:
        return []
    return [(series, quantity.name, reading) for series, quantity, reading in lasting]


# --- as a description -------------------------------------------------------------------------------------------------


def settings_of(known: Recognised) -> dict[str, str]:
    """Dimensions in their own units, and assembly modes, as texts: what the description of the template is to have."""
    truth = known.found.truth
    found = {
        dim.symbol: f"{round(float(dim.unit.to_shown(truth.dimensions[dim.symbol])), 10):.15g}"
        for dim in truth.mechanism.free_dimensions
    }
    return found | {mode: f"{sign:.0f}" for mode, sign in modes_of(truth, solve(truth.mechanism)).items()}


def with_driver(known: Recognised, text: str) -> str:
    """The template's text with the workbook's driver; as it is where that does not go on by equal steps."""
    found, driver = known.found, known.found.truth.mechanism.driver
    values = np.asarray(driver.unit.to_shown(found.truth.driver), float)
    steps = np.diff(values)
    if driver.law is not None or driver.values or not np.allclose(steps, steps[0], rtol=1e-6, atol=1e-9):
        return text
    source = parse(text, known.template)
    for key, value in (("start", values[0]), ("stop", values[-1]), ("step", steps[0])):
        source = with_number(source, ("driver", key), round(float(value), 10))
    return source.text


# --- in words, and as JSON data --------------------------------------------------------------------------------------


MOST_LISTED = 40
"""Columns that are listed."""


def recognised_lines(tables: Sequence[Table], known: Recognised | None, workbook: Path, language: str) -> list[str]:
    """Which linkage it is, its driver, its dimensions, its columns; what is there, where it is none that is known."""
    name = readable_name(workbook)
    if known is None:
        return [said(language, "unrecognised", file=name), *_there(tables, language)]
    found = known.found
    work, mechanism = found.work, found.mechanism
    first = said(language, "recognised", file=name, title=mechanism.title.of(language), template=known.template)
    rows = [(mechanism.driver.symbol, _cells(known), said(language, "driver"))]
    for one in found.inputs:
        rows.append((one.symbol, work.where(*one.place), f"{work.number(one.place):.10g}"))
    for series, quantity, reading in known.quantities:
        rows.append((quantity, series.where(work), "" if reading.plain else said(language, "otherwise")))
    zero = [
        symbol
        for symbol, value in found.truth.dimensions.items()
        if value == 0.0 and symbol not in known.missing and symbol not in {one.symbol for one in found.inputs}
    ]
    told = [first, *_aligned(rows)]
    if zero:
        told.append(said(language, "taken as zero", symbols=", ".join(zero)))
    if known.missing:
        told.append(said(language, "not there", symbols=", ".join(known.missing)))
    open_columns = [series.where(work) for series in _unexplained(known)]
    if open_columns:
        told.append(said(language, "unexplained", cells=", ".join(open_columns[:MOST_LISTED])))
    return told


def _cells(known: Recognised) -> str:
    return known.found.driver.where(known.found.work)


def _unexplained(known: Recognised) -> list[Series]:
    keys = {series.key for series, _, _ in known.quantities}
    return [series for series in known.found.series if series.key not in keys]


def _there(tables: Sequence[Table], language: str) -> list[str]:
    """The driver, the numbers and the columns of the likeliest table."""
    if not tables:
        return [said(language, "no table")]
    table = tables[0]
    work = table.graph.work
    rows = [(said(language, "driver"), table.run.where(work), "")]
    rows += [(" ".join(around(work, cell)[:1]), work.where(*cell), f"{work.number(cell):.10g}") for cell in table.cells]
    rows += [("", series.where(work), "") for series in table.series[:MOST_LISTED]]
    return _aligned(rows)


def _aligned(rows: Sequence[tuple[str, str, str]]) -> list[str]:
    wide = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    return [f"{one:<{wide[0]}}  {two:<{wide[1]}}  {three}".rstrip() for one, two, three in rows]


def as_dict(known: Recognised | None) -> dict[str, Any]:
    """As JSON data."""
    if known is None:
        return {"template": None}
    found = known.found
    return {
        "template": known.template,
        "driver": _cells(known),
        "dimensions": {
            one.symbol: {"cell": found.work.where(*one.place), "value": found.work.number(one.place)}
            for one in found.inputs
        },
        "quantities": {quantity: series.where(found.work) for series, quantity, _ in known.quantities},
        "missing": list(known.missing),
        "unexplained": [series.where(found.work) for series in _unexplained(known)],
    }
