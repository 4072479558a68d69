"""Which assemblies the whole sketch means: of all combinations the one whose points and angles lie nearest to it.

A point may tell more than the assembly of the group that it is solved in: where a group before has the other one, it is
elsewhere as well. So nothing is decided group by group. The equations are followed in every combination, group after group;
what is sketched is read where its group closes first, and the sum of the squares of what it misses decides:

    distance^2 = sum of (x - x sketched)^2 / size^2 over coordinates and displacements, + of (angle - angle sketched)^2
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Root
from livesheet.said import Words, say
from mechsheet.kinematics.equations import Equation, System
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.modes import BETWEEN, SEPARATE, BetweenModesError, difference, entries_among, shown_entries
from mechsheet.kinematics.newton.picking import MOST_FOUND, listed
from mechsheet.kinematics.newton.system import followed
from mechsheet.kinematics.numeric import Array, evaluate_equation
from mechsheet.model import Mechanism

WIDTH = 256
"""So many combinations are followed at most: of more those that miss the sketch least so far."""

FITS = 0.1
"""A combination that misses the sketch by less than this (parts of the size, radians) in the very first row is what was
sketched: no later row is looked at."""

TWICE = 2.0
"""A combination that does not close was meant all the same where all that close miss the sketch by so many times as much."""


SHOWN = 4
"""Between two combinations so many of the sketched numbers are named, those that tell them apart best."""


@dataclass(frozen=True, slots=True)
class Choice:
    """A group in order of solution: the symbol of its mode (empty: it has one assembly), the column that says where it
    closes, the mode that is given (None: the sketch decides), and of a group that Newton's method solves its system.
    """

    number: int
    mode: str
    closes: str
    given: int | None
    system: System | None
    label: Words
    leaning: int | None = None


@dataclass(frozen=True, slots=True)
class _Combination:
    """Groups in these assemblies: modes, the values of all symbols so far, the sketched ones (NaN until they are read)."""

    modes: Mapping[str, int]
    values: Mapping[str, Array]
    found: Array
    missed: float


@dataclass(frozen=True, slots=True)
class Meant:
    """The modes of the nearest combination (of several that are as near the first), nothing where nothing closes.

    open     those that another one, which has all that is sketched in the same places, has otherwise together with more
    unasked  those of dyads that another such one has otherwise alone: a later row may tell, where the first is a dead centre
    """

    modes: Mapping[str, int]
    open: frozenset[str]
    unasked: frozenset[str]


NOTHING_MEANT = Meant({}, frozenset(), frozenset())


class Nearest:
    """What the sketch decides.

    ledger  has the equations of all positions, whatever modes they were written with;  choices  its groups
    """

    def __init__(
        self, mechanism: Mechanism, ledger: Ledger, choices: Sequence[Choice], dimensions: Mapping[str, float]
    ) -> None:
        self._mechanism = mechanism
        self._ledger = ledger
        self._choices = choices
        self._equations: dict[int, list[Equation]] = {}
        for equation in (*ledger.constants, *ledger.columns):
            self._equations.setdefault(equation.group, []).append(equation)
        columns = [equation for equation in ledger.columns if equation.group > 0]
        self._entries = entries_among(mechanism, columns, dimensions, ledger.largest_length)
        numbers = {link.name: link.angle_symbol for link in mechanism.links}
        self._read_by_gears = {numbers[name] for relation in mechanism.relations for name in relation.turning}

    def modes(self) -> Meant:
        """What the sketch means.

        Between two combinations its shape decides, where that is sketched of a group: as at another value of the driver.
        Raises BetweenModesError where that does not help.
        """
        try:
            return self._nearest()
        except BetweenModesError:
            if all(choice.given is not None or choice.leaning is None for choice in self._choices):
                raise
            self._choices = [
                choice if choice.given is not None else replace(choice, given=choice.leaning)
                for choice in self._choices
            ]
            return self._nearest()

    def _nearest(self) -> Meant:
        closing, broken = self._followed(1 if self._entries else self._ledger.rows)
        if not closing or math.sqrt(closing[0].missed) > FITS:
            closing, broken = self._followed(self._ledger.rows)
        if not closing:
            return NOTHING_MEANT
        meant = next((each for each in broken if self._clearly_nearer(each, closing[0])), None)
        if meant is not None:
            return Meant(meant.modes, frozenset(), frozenset())  # it never closes, and that is what is to be said
        return self._decided(closing)

    def _decided(self, closing: Sequence[_Combination]) -> Meant:
        """The nearest combination, which every other one that has something elsewhere must miss clearly."""
        alike = [each for each in closing if np.max(np.abs(self._apart(closing[0], each)), initial=0.0) < SEPARATE]
        best = min(alike, key=self._plain)
        for other in closing:
            apart = self._apart(best, other)
            if other in alike:
                continue
            if other.missed - best.missed < BETWEEN * float(np.sum(apart[np.abs(apart) >= SEPARATE] ** 2)):
                raise BetweenModesError(self._between(self._differ(best, other)[0], best, other))
        differ = [self._differ(best, other) for other in alike]
        unasked = {each.mode for (each,) in (found for found in differ if len(found) == 1) if each.system is None}
        opened = {each.mode for found in differ for each in found} - unasked
        return Meant(best.modes, frozenset(opened), frozenset(unasked))

    def _differ(self, one: _Combination, other: _Combination) -> list[Choice]:
        return [choice for choice in self._choices if one.modes.get(choice.mode) != other.modes.get(choice.mode)]

    def _plain(self, combination: _Combination) -> tuple[int, ...]:
        """Of combinations that look alike the one with the first assemblies is taken."""
        modes = [(choice.system, combination.modes[choice.mode]) for choice in self._choices if choice.mode]
        return tuple(mode if system else -mode for system, mode in modes)

    def _apart(self, one: _Combination, other: _Combination) -> Array:
        """How far two combinations have apart what is sketched; 0 for what one of them has not."""
        gaps = [
            difference(float(x), float(y), scale)
            for x, y, (_, _, scale) in zip(one.found, other.found, self._entries, strict=True)
        ]
        return np.asarray(np.nan_to_num(np.array(gaps)))

    def _clearly_nearer(self, broken: _Combination, best: _Combination) -> bool:
        """Whether a combination that does not close to the end has what it comes to much nearer to the sketch."""
        read = np.isfinite(broken.found)
        missed = math.sqrt(float(np.sum(self._misses(best.found)[read] ** 2)))
        return bool(missed > FITS and missed > TWICE * math.sqrt(broken.missed))

    def _misses(self, found: Array) -> Array:
        return np.array(
            [difference(float(x), wanted, scale) for x, (_, wanted, scale) in zip(found, self._entries, strict=True)]
        )

    # --- every combination ------------------------------------------------------------------------------------------

    def _followed(self, rows: int) -> tuple[list[_Combination], list[_Combination]]:
        """(combinations in which all groups close somewhere in these first rows, the nearest first; those that do not)."""
        ledger = self._ledger
        own = {equation.symbol for group, rules in self._equations.items() if group for equation in rules}
        given = {name: column[:rows] for name, column in ledger.values.items() if name not in own}
        live = [_Combination({}, given, np.full(len(self._entries), np.nan), 0.0)]
        broken: list[_Combination] = []
        for choice in self._choices:
            grown: list[_Combination] = []
            for before in live:
                found = self._grown(before, choice, rows)
                grown += found
                if not found:
                    broken.append(before)
            live = sorted(grown, key=lambda each: each.missed)[:WIDTH]
        return live, broken

    def _grown(self, before: _Combination, choice: Choice, rows: int) -> list[_Combination]:
        """A combination with each assembly of the next group that closes."""
        rules = self._equations.get(choice.number, [])
        first = next((place for place, rule in enumerate(rules) if isinstance(rule.expression, Root)), 0)
        known = dict(before.values)
        self._evaluate(rules[:first], known, rows)
        found = []
        for mode, system in self._assemblies(known, choice, rows):
            values = dict(known)
            if choice.mode:
                values[choice.mode] = np.full(rows, float(mode))
            if system is not None:
                values |= followed(system, values, rows)
            self._evaluate(rules[first:], values, rows)
            there = np.flatnonzero(np.isfinite(values[choice.closes]))
            if len(there):
                found.append(self._read(before, choice, mode, values, int(there[0])))
        return found

    def _evaluate(self, rules: Sequence[Equation], values: dict[str, Array], rows: int) -> None:
        """The values of these, in place; those of unknowns of Newton's method are there."""
        seen: dict[object, object] = {}
        for rule in rules:
            if not isinstance(rule.expression, Root):
                column = evaluate_equation(rule, values, rows, seen)
                values[rule.symbol] = _counted(column) if rule.symbol in self._read_by_gears else column

    def _assemblies(self, known: Mapping[str, Array], choice: Choice, rows: int) -> list[tuple[int, System | None]]:
        """The modes that a group can take, with the system that leads to each."""
        if choice.system is None:
            modes = (1, -1) if choice.mode else (1,)
            return [(mode, None) for mode in modes if choice.given in (None, mode)]
        found = listed(choice.system, self._ledger, known, rows, self._mechanism.angle_unit)
        if found is None or len(found[1]) > MOST_FOUND:
            return []
        numbers = range(1, len(found[1]) + 1)
        return [(mode, found[0]) for mode in numbers if choice.given in (None, mode)]

    def _read(
        self, before: _Combination, choice: Choice, mode: int, values: Mapping[str, Array], row: int
    ) -> _Combination:
        """With what is sketched of the group, in the first row in which it closes."""
        fresh = {equation.symbol for equation in self._equations.get(choice.number, ())}
        found = before.found.copy()
        missed = before.missed
        for place, (symbol, wanted, scale) in enumerate(self._entries):
            if symbol in fresh:
                found[place] = float(values[symbol][row])
                missed += difference(found[place], wanted, scale) ** 2
        modes = {**before.modes, choice.mode: mode} if choice.mode else before.modes
        return _Combination(modes, values, found, missed)

    def _between(self, choice: Choice, best: _Combination, other: _Combination) -> Fault:
        apart = np.abs(self._apart(best, other))
        told = sorted(sorted(range(len(self._entries)), key=lambda place: -apart[place])[:SHOWN])
        entries = [self._entries[place] for place in told]
        first, second = sorted((best, other), key=lambda each: -each.modes[choice.mode])
        return Fault(
            say("the sketch lies between two assemblies of {group}", group=choice.label),
            key="assembly",
            hint=say(
                "{first} has {plus}; {second} has {minus}: sketch a point nearer to the one that is meant",
                first=f"{choice.mode} = {first.modes[choice.mode]}",
                plus=shown_entries(entries, [float(first.found[place]) for place in told]),
                second=f"{choice.mode} = {second.modes[choice.mode]}",
                minus=shown_entries(entries, [float(second.found[place]) for place in told]),
            ),
        )


def _counted(column: Array) -> Array:
    """An angle that a gear reads: its turns are counted from the first position."""
    there = column[np.isfinite(column)]
    return column - math.tau * round(float(there[0]) / math.tau) if len(there) else column
