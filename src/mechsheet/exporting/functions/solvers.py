"""Groups that Newton's method solves, for functions of one position, as plain data. Printers spell them out.

A function knows one position, the table a row above. So a solver does by itself what the rows do one after the other:

1. It begins with the start values of the assembly, which fit the described dimensions in the row where the table begins, and
   goes with the dimensions from those described to those asked for, in as many equal steps as the table does.
2. Then it goes with the drivers, on a straight line, from their values in that row to those asked for, in steps as large as
   the table's own. So 300 degrees is reached over all that lies between, and -60 the other way: a gear, or an assembly that
   is another one after a turn, needs that.

Where the links do not meet on the way, where the determinant changes its sign or an unknown leaves its trend, the way ends,
and all behind it is #N/A: nobody can drive there. (The table goes on behind a gap, with a warning; a cell has no place for
one.)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.said import Words
from mechsheet.compiled import Compiled
from mechsheet.exporting.functions.all_functions import patterns, prefix_of
from mechsheet.exporting.functions.routines import Routine, Source, folded, needed_for, unknown_key, with_calls
from mechsheet.exporting.lowering import Step
from mechsheet.exporting.program import quantity
from mechsheet.kinematics.angle_branch import WINDOWED
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.equations import Group, System
from mechsheet.kinematics.modes import STEP
from mechsheet.kinematics.newton.changed_dimensions import scales
from mechsheet.kinematics.points_in_link import number
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import NOTHING

SMALL = 0.01
"""Part of the largest length that a slide goes in a step where the table has a single row."""


@dataclass(frozen=True, slots=True)
class Block:
    """Steps in order, from symbols that are given to results."""

    given: tuple[str, ...]
    steps: tuple[Step, ...]
    results: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Drive:
    """A driver: its value in the row where the table begins, and how far it goes in a step."""

    symbol: str
    home: Node
    stride: Node


@dataclass(frozen=True, slots=True)
class Solver:
    """One group.

    number     of the group, from 1;  name: what a printer may call it;  label: its links
    keys       what trees call each unknown (`unknown_key`)
    asked      symbols of the arguments: the parameters of the mechanism's functions
    drives     the drivers, which stand beside each other among these
    starts     start values of each assembly;  mode: symbol of its number
    scales     in what each unknown is measured: 1 for an angle, else the largest length
    described  what changes on the way from the description, by symbol (also unknowns of groups before): the value for which
               the start values were found
    still      from `asked` to what stays while the drivers move: dimensions, tolerance, modes
    earlier    unknowns of groups before
    reading    from results of `still`, drivers and `earlier`, in this order, to what a pass is given
    passing    from the unknowns and what is given to J^-1 F, the residual and det J
    """

    number: int
    name: str
    label: Words
    keys: tuple[str, ...]
    asked: tuple[str, ...]
    drives: tuple[Drive, ...]
    starts: tuple[tuple[Node, ...], ...]
    mode: str
    scales: tuple[float, ...]
    passes: int
    described: Mapping[str, Node]
    still: Block
    earlier: tuple[str, ...]
    reading: Block
    passing: Block

    @property
    def first_drive(self) -> int:
        """Where the drivers begin among the arguments."""
        return self.asked.index(self.drives[0].symbol)


def solvers_of(source: Source, compiled: Compiled) -> tuple[Solver, ...]:
    """The solver of each group that Newton's method solves, in order."""
    return tuple(
        _solver(source, compiled, group, group.system) for group in source.equations.groups if group.system is not None
    )


def _solver(source: Source, compiled: Compiled, group: Group, system: System) -> Solver:
    mechanism = source.mechanism
    asked = tuple(part.symbol for part in source.parameters())
    drives = tuple(_drive(compiled, system, symbol) for symbol in (mechanism.driver.symbol, *mechanism.listed_symbols))
    driven = [drive.symbol for drive in drives]
    leaves = {symbol for symbol, _ in system.described}
    names = {name: _read(source, system, name) for name in system.given}
    stops = {*leaves, *asked, source.equations.tolerance}
    rules = {symbol: step for symbol, step in source.steps.items() if symbol not in stops}
    needed = needed_for(names.values(), rules)
    earlier = tuple(name for name in source.solved if name in needed and name not in system.variables)
    still = tuple(
        name for name in _ordered(source, asked) if name in needed & stops and name not in (*driven, *earlier)
    )
    units = {dim.symbol: dim.unit for dim in mechanism.dimensions}
    described = {
        symbol: quantity(value, units.get(symbol, NUMBER))
        for symbol, value in system.described
        if symbol in still or symbol in earlier
    }
    return Solver(
        group.number,
        f"{prefix_of(mechanism, mechanism.language)}_Newton{group.number}",
        group.label,
        tuple(unknown_key(name) for name in system.variables),
        asked,
        drives,
        tuple(
            tuple(_angle_or_length(source, name, x) for name, x in zip(system.variables, start, strict=True))
            for start in system.starts
        ),
        system.mode,
        scales(mechanism, source.equations, system),
        system.passes,
        described,
        _block(asked, source.steps, still),
        earlier,
        _block((*still, *driven, *earlier), rules, [*names.values()]),
        _passing(system),
    )


def _read(source: Source, system: System, name: str) -> str:
    """What a system reads, as functions have it: a gear reads an angle with its turns."""
    taken = WINDOWED.format(symbol=name)
    return taken if not system.periodic and taken in source.steps else name


def _ordered(source: Source, asked: Sequence[str]) -> dict[str, None]:
    """All symbols: the parameters, then what follows, in order of solution."""
    return dict.fromkeys((*asked, *source.steps))


def _drive(compiled: Compiled, system: System, symbol: str) -> Drive:
    mechanism = compiled.mechanism
    driver, unit = mechanism.driver, mechanism.driver_of(symbol).unit
    column = compiled.given[symbol]
    if symbol == driver.symbol and driver.stepped:
        stride = abs(number(driver.step, dimension_values(mechanism)))
    else:
        ways = np.abs(np.diff(column))
        stride = float(np.mean(ways[ways > 0])) if np.any(ways > 0) else 0.0
    if not stride:
        stride = (
            STEP if unit.kind == "angle" else SMALL * (largest_length(mechanism, dimension_values(mechanism)) or 1.0)
        )
    home = system.home if symbol == driver.symbol else float(column[min(system.row, len(column) - 1)])
    return Drive(symbol, quantity(home, unit), quantity(stride, unit))


def _angle_or_length(source: Source, name: str, value: float) -> Node:
    unit: Unit = source.mechanism.angle_unit if source.equations.of(name).unit.kind == "angle" else NUMBER
    return quantity(value, unit)


def _block(given: Sequence[str], rules: Mapping[str, Step], wanted: Sequence[str]) -> Block:
    """The steps from what is given to what is wanted."""
    free = {name: step for name, step in rules.items() if name not in given}
    needed = needed_for(wanted, free)
    steps, forms = folded(
        [step for name, step in free.items() if name in needed], {name: Symbol(name) for name in given}
    )
    return Block(tuple(given), _calling(steps), tuple(forms[name] for name in wanted))


def _passing(system: System) -> Block:
    steps = [Step(part.symbol, part.expression) for part in system.body]
    ends = (*system.corrections, Symbol(system.residual), Symbol(system.determinant))
    return Block((*system.unknowns, *system.given), _calling(steps), ends)


def _calling(steps: Sequence[Step]) -> tuple[Step, ...]:
    """Elementary functions are called, not written out."""
    return with_calls(Routine("", NOTHING, (), tuple(steps), al.ZERO, NUMBER), patterns()).steps
