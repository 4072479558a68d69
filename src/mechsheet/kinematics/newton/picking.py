"""Which assembly of a group the sketch means: all of the first position are listed, and the nearest is taken.

They are found by Newton's method from starts spread over all that can be.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from livesheet import portable
from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Symbol
from livesheet.said import Words, say
from mechsheet.kinematics.equations import Equation, System
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.modes import BetweenModesError, NeverClosesError, difference, entries_of, shown_entries
from mechsheet.kinematics.newton.newton_equations import Solution
from mechsheet.kinematics.newton.singular_start import DeadStartError, singular
from mechsheet.kinematics.newton.system import SETTLED, leading, refined, step_of
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Label, Mechanism
from mechsheet.units import Unit

NEARLY = 0.05
"""A sketch is nearer to one assembly than to the next by at least this part of what lies between them."""

LOOKED_AT = 40
"""Rows looked at for the first that has a position."""

DEGREES_SHOWN = 3
DIGITS = 5
"""Start values have so many decimals [deg], or digits of the size."""


def pick_assembly(
    mechanism: Mechanism,
    ledger: Ledger,
    solution: Solution,
    start: int,
    dimensions: Mapping[str, float],
    given: int | None,
    near: Callable[[float], Mapping[str, float]] | None,
) -> tuple[System, int, bool]:
    """(the system with its start values, the number of the assembly from 0, whether it was left open).

    start  the group's first column;  given: the assembly's number from 1;  near: the unknowns' values that are meant, at
    a value of the driver
    """
    system = solution.system
    turning, size = ledger.turning(system), ledger.largest_length
    there = listed(system, ledger, ledger.values, ledger.rows, mechanism.angle_unit)
    if there is None:
        raise NeverClosesError(solution.label)
    system, found = there
    row = system.row
    described, way = _described(ledger, system, row)
    system = replace(system, described=described, way=way)
    for name in system.unknowns:
        ledger.systems[name] = system
    if len(found) > MOST_FOUND:  # no assemblies but a motion
        raise DeadStartError(solution.label)
    _refuse_dead(system, ledger, row, found, solution)
    entries = entries_of(mechanism, ledger, start, dimensions)
    places: list[list[float]] = []
    for number in range(1, len(found) + 1):
        ledger.set_mode(system.mode, number, start)
        places.append([float(ledger.values[symbol][row]) for symbol, _, _ in entries])
    index, is_open = 0, True
    if given is not None:
        index, is_open = min(max(given, 1), len(found)) - 1, False
    elif near is not None:
        meant = near(system.home)
        wanted = [meant[name] for name in system.variables]
        index, is_open = int(np.argmin([_gap(state, wanted, turning, size) for state in found])), False
    elif entries and len(found) > 1:
        index, is_open = _nearest(entries, places, solution), False
    elif entries:
        is_open = False
    ledger.set_mode(system.mode, index + 1, start)
    known = _given_in(system, ledger.values, row)
    if singular(system, known, found[index].tolist(), [not turns for turns in turning], size):
        raise DeadStartError(solution.label)
    return system, index, is_open


def listed(
    system: System, ledger: Ledger, values: Mapping[str, Array], rows: int, unit: Unit
) -> tuple[System, list[Array]] | None:
    """The system with the start values of all assemblies in the first row that has one, and these; None where none has.

    values  of what the system reads, in so many rows, of which those that follow one another are looked at
    """
    turning, size = ledger.turning(system), ledger.largest_length
    row, found = _first_position(system, values, min(rows, ledger.following), turning, size)
    if row is None:
        return None
    starts = tuple(
        tuple(_rounded(x, angle, size, unit) for x, angle in zip(state, turning, strict=True)) for state in found
    )
    return replace(system, starts=starts, home=float(values[system.driver][row]), row=row), found


def words_of(mechanism: Mechanism, system: System, ledger: Ledger) -> tuple[Words, ...]:
    """What tells each assembly: its unknowns in the first position."""
    unit = mechanism.angle_unit
    found = []
    for start in system.starts:
        parts = []
        for name, number, turns in zip(system.variables, start, ledger.turning(system), strict=True):
            shown = unit.to_shown(number) if turns else number
            parts.append(f"{name} = {float(shown):.4g}{unit.text if turns else ''}")
        found.append(Label(", ".join(parts)))
    return tuple(found)


def _given_in(system: System, values: Mapping[str, Array], row: int) -> dict[str, float]:
    """What a system reads in a row."""
    return {name: float(np.asarray(values[name])[row]) for name in system.given}


def _rounded(number: float, turns: bool, size: float, unit: Unit) -> float:
    """As a start cell shows it."""
    if turns:
        return float(
            unit.to_internal(round(float(unit.to_shown(number)), DEGREES_SHOWN if unit.in_degrees else DIGITS))
        )
    return round(number, DIGITS - 1 - math.floor(float(portable.log10(size))))


def _first_position(
    system: System, values: Mapping[str, Array], rows: int, turning: tuple[bool, ...], size: float
) -> tuple[int | None, list[Array]]:
    """The first row in which there is an assembly, with all that there are."""

    def there(row: int) -> list[Array]:
        known = _given_in(system, values, row)
        if not all(map(math.isfinite, known.values())):
            return []
        return assemblies_in(system, known, turning, size)

    tried = range(0, rows, max(1, math.ceil(rows / LOOKED_AT)))
    before = -1
    for row in tried:
        found = there(row)
        if found:
            for earlier in range(before + 1, row):
                first = there(earlier)
                if first:
                    return earlier, first
            return row, found
        before = row
    return None, []


def _described(ledger: Ledger, system: System, row: int) -> tuple[tuple[tuple[str, float], ...], tuple[Equation, ...]]:
    """What the group's numbers follow from, with the values in that row, and the equations between.

    The smallest length that counts is no number of the mechanism's: it stays as it is.
    """
    earlier = [name for other in ledger.systems.values() for name in other.variables]
    ruled = {equation.symbol: equation for equation in (*ledger.constants, *ledger.columns)}
    listed = [name for name in ledger.values if name not in ruled and name not in ledger.constant_symbols]
    changing = dict.fromkeys((*ledger.dimensions, *listed, *earlier))
    rules = {name: equation.reads for name, equation in ruled.items() if Symbol(name) != ledger.tolerance}
    leaves, way = leading(system.given, rules, changing)
    values = {name: np.broadcast_to(ledger.values[name], (ledger.rows,)) for name in leaves}
    return tuple((name, float(values[name][row])) for name in leaves), tuple(ruled[name] for name in way)


def _refuse_dead(system: System, ledger: Ledger, row: int, found: list[Array], solution: Solution) -> None:
    """Start values lead to their own assembly, or two assemblies lie so near that they cannot be told apart."""
    known = _given_in(system, ledger.values, row)
    reached, _, _ = refined(
        system, known, [np.array([start[at] for start in system.starts]) for at in range(len(found[0]))]
    )
    for index, state in enumerate(found):
        if np.max(np.abs(np.array([column[index] for column in reached]) - state)) > 1e-6 * max(
            1.0, np.abs(state).max()
        ):
            raise DeadStartError(solution.label)


def _gap(state: Array, wanted: list[float], turning: tuple[bool, ...], size: float) -> float:
    gaps = (
        difference(one, other, 0.0 if turns else size) for one, other, turns in zip(state, wanted, turning, strict=True)
    )
    return float(portable.hypot(*gaps))


def _nearest(entries: list[tuple[str, float, float]], places: list[list[float]], solution: Solution) -> int:
    """The assembly nearest to the sketch. BetweenModesError where the next one is as near."""
    missed = [
        portable.hypot(*(difference(x, wanted, scale) for x, (_, wanted, scale) in zip(place, entries, strict=True)))
        for place in places
    ]
    order = sorted(range(len(places)), key=missed.__getitem__)
    best, following = order[:2]
    between = portable.hypot(
        *(difference(x, y, scale) for x, y, (_, _, scale) in zip(places[best], places[following], entries, strict=True))
    )
    if missed[following] - missed[best] < NEARLY * between or between == 0:
        shown = "; ".join(
            f"{number + 1} is at {shown_entries(entries, places[number])}" for number in (best, following)
        )
        raise BetweenModesError(
            Fault(
                say(
                    "the sketch lies between two of the {count} assemblies of {group}",
                    count=len(places),
                    group=solution.label,
                ),
                key="assembly",
                hint=say("{assemblies}: sketch a point nearer to the one that is meant", assemblies=shown),
            )
        )
    return best


# --- all assemblies of a position --------------------------------------------------------------------------

STARTS = {1: 400, 2: 30, 3: 12, 4: 7}
"""Starts along each unknown, by the number of unknowns."""

DENSER = 2.5
LONGEST_STEP = 0.6
"""Radians, or parts of the size."""

TURNS = 2
"""With gears so many times the starts, over as many turns."""

BOUNDED = 30
ALIKE = 1e-6
REACH = 2.5
"""Displacements are sought up to so many times the largest length."""


MOST_FOUND = 100
"""More assemblies than this are none: the group moves, and every start leads to another position of its motion."""


def assemblies_in(system: System, known: Mapping[str, Any], turning: Sequence[bool], size: float) -> list[Array]:
    """Every solution in one position, each once, angles within half a turn of 0, in the order of their first unknown.

    known    values of what the system reads, in that position
    turning  which unknowns are angles

    Of an angle-only group the determinants' signs add up to 0 (it can be deformed into one without assemblies): where they
    do not, some assembly was missed and more starts are tried. With gears an angle says in which of its turns it is: those
    up to a whole turn from 0 are looked through, and of what looks alike the one with the smallest angles is taken.
    More than `MOST_FOUND` are not looked for.
    """
    count = STARTS[len(system.unknowns)]
    found = _from(system, known, turning, size, count if system.periodic else round(count * TURNS))
    if len(found) <= MOST_FOUND and all(turning) and system.periodic and abs(sum(sign for _, sign in found)) > 0.5:
        found = _from(system, known, turning, size, round(count * DENSER))
    return [state for state, _ in sorted(found, key=lambda each: tuple(each[0]))]


def _from(
    system: System, known: Mapping[str, Any], turning: Sequence[bool], size: float, count: int
) -> list[tuple[Array, float]]:
    """(state, sign of the determinant) of each solution that a grid of starts leads to."""
    axes = []
    for place, turns in enumerate(turning):
        steps = (np.arange(count) + 0.5 + 0.013 * place) / count
        turn = math.tau * (1 if system.periodic else TURNS)
        axes.append(turn * (steps - 0.5) if turns else size * REACH * (2 * steps - 1))
    grid = [part.ravel() for part in np.meshgrid(*axes, indexing="ij")]
    unknowns = grid
    step = step_of(system, known)
    with np.errstate(all="ignore"):
        for _ in range(BOUNDED):
            following = step(unknowns).unknowns
            unknowns = [
                old + np.clip(np.nan_to_num(new - old), -longest, longest)
                for old, new, longest in zip(
                    unknowns, following, (LONGEST_STEP * (1.0 if turns else size) for turns in turning), strict=True
                )
            ]
        unknowns, residual, determinant = refined(system, known, unknowns, 4)
        there = np.flatnonzero(residual <= SETTLED)
    found: list[tuple[Array, float]] = []
    states = np.array(unknowns)[:, there].T
    angles = np.array(turning)
    scale = np.where(angles, 1.0, size)
    signs = np.sign(determinant[there])
    if system.periodic:
        states[:, angles] -= math.tau * np.round(states[:, angles] / math.tau)
    else:
        inside = np.flatnonzero(np.all(np.abs(states[:, angles]) <= math.pi * TURNS, axis=1))
        nearest = inside[np.argsort(np.abs(states[inside][:, angles]).max(axis=1).round(6), kind="stable")]
        states, signs = states[nearest], signs[nearest]
    for state, sign in zip(states, signs, strict=True):
        if not found or np.min(_apart(state, np.array([other for other, _ in found]), angles, scale)) >= ALIKE:
            found.append((state, float(sign)))
            if len(found) > MOST_FOUND:
                break
    return found


def _apart(one: Array, others: Array, angles: Array, scale: Array) -> Array:
    gap = one - others
    gap = np.where(angles, gap - math.tau * np.round(gap / math.tau), gap)
    return np.asarray(np.max(np.abs(gap) / scale, axis=1))
