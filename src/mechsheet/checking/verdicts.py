"""The verdicts of the first sheet against a search in Python that reads no formula (`kinematics.search`).

What the sheet finds by probes beside the rows is found here by many places and narrowing. A limit is right to 1e-4 of a
step, an extreme to 1e-4 of its range; where the sheet itself says "about", or a group nearly comes apart, less is asked.
What the sheet warns of (a gap between rows, links that turn far in one step) is compared as a warning, and nothing that
hangs on it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mechsheet.checking.inputs import inputs_in
from mechsheet.checking.report import Comparison, Tally
from mechsheet.checking.undefined_dimensions import missing_dimensions
from mechsheet.formula.book import Book
from mechsheet.formula.nodes import Scalar
from mechsheet.formula.references import cell_address
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.search import TURN, Search
from mechsheet.sheet.checks.geometry import length_in_cells
from mechsheet.sheet.first.classification import FourBar
from mechsheet.sheet.plan import MEANING, Plan

EXACT = 1e-4
"""So much of a step a limit may be off, of its range an extreme."""

ABOUT = 5e-2
"""The same where the sheet says "about", or a group nearly comes apart; then a limit need only lie in its step."""

GAP = 1e-9
"""A gap of a joint, as a part of the size, that is nothing but rounding."""

ROUNDED = 2e-6
"""Angles by arccos [rad], at a dead centre."""

LEAP = math.radians(90.0)
_NUMBER = re.compile(r"\d+")


def against_search(book: Book, values: Any, plan: Plan, shown: str) -> Comparison | None:
    """Hold every verdict cell against what is found with the inputs in the cells; arguments as of `against_plan`.

    None where a derived dimension does not exist: then there is no motion to search.
    """
    mechanism = plan.mechanism
    inputs = inputs_in(book, values, plan, shown)
    if missing_dimensions(mechanism, inputs.dimensions):
        return None
    dimensions = tuple(
        dim if dim.derived else replace(dim, value=inputs.dimensions[dim.symbol]) for dim in mechanism.dimensions
    )
    equations = plan.equations.equations
    groups = tuple(
        replace(group, assembly=group.assembly_of(inputs.modes[group.mode])) if group.mode in inputs.modes else group
        for group in equations.groups
    )
    search = Search(
        replace(mechanism, dimensions=dimensions), replace(equations, groups=groups), inputs.driver,
        stepped=not (mechanism.driver.values or plan.newton),
    )  # fmt: skip
    return _Judge(values, plan, search).result()


class _Judge:
    """The verdicts of one workbook, as its cells have them, one after another."""

    def __init__(self, values: Any, plan: Plan, search: Search) -> None:
        self.values, self.plan, self.search = values, plan, search
        self.tally = Tally("search", tolerance=EXACT)
        driver = plan.mechanism.driver
        self.driver_scale = math.degrees(1.0) if driver.unit.in_degrees else 1.0
        self.angle_scale = math.degrees(1.0) if plan.mechanism.angle_unit.in_degrees else 1.0
        self.page = plan.mechanism.layout == "page"
        both = search.row_there[1:] & search.row_there[:-1]
        self.leaps = any(np.any(both & (column > LEAP)) for column in search.turns_between_rows().values())
        # nothing that hangs on it is said where the sheet warns, or may
        self.sure = not (search.holes or search.doubtful or self.leaps)

    def result(self) -> Comparison:
        """All verdicts that this layout has."""
        if self.page and self._filled_further():
            return self.tally.result()
        self._number("inputs", [0.0])
        self._number("rows_closed", [float(self.search.count)])
        for loop in self.plan.found.four_bars:
            self._grashof(loop)
        for group in self.plan.found.transmission:
            self._transmission(group)
        if not self.page:
            self._motion()
        self._line()  # last: it repeats the others
        return self.tally.result()

    def _motion(self) -> None:
        """What only the layout of several sheets says."""
        found, search = self.plan.found, self.search
        if found.limits:
            self._limits()
            self._ends()
            if not search.doubtful:
                self._warns("passes", bool(search.holes))
        if search.count:
            gap = self._found("largest_gap")
            small = isinstance(gap, float) and gap <= GAP * search.size
            self._note("largest_gap", 0.0 if small else math.inf, 0.0)
        if self.sure or (self.leaps and not (search.holes or search.doubtful)):
            self._warns("leaps", self.leaps)
        for link in found.swings:
            self._extent(f"swing_{link.angle_symbol}", link.angle_symbol, self.angle_scale)
        for joint in found.strokes:
            self._extent(f"stroke_{joint.symbol}", joint.symbol, 1.0)
        for symbol in found.returning:
            self._ratio(symbol)

    # --- cells ---------------------------------------------------------------------------------------------------------

    def _filled_further(self) -> bool:
        """Whether somebody has filled the page's table further down: then its verdicts are of more rows than the plan's."""
        return self.values.get(self.plan.main, self.plan.at.last + 1, 0) is not None

    def _found(self, key: str) -> Scalar:
        spot = self.plan.at.spots[f"#{key}"]
        found: Scalar = self.values.get(spot.sheet, spot.row, spot.col)
        return found

    def _about(self, key: str) -> bool:
        """Whether the words beside a number say that it is about right."""
        spot = self.plan.at.spots[f"#{key}"]
        words = self.values.get(spot.sheet, spot.row, MEANING)
        return isinstance(words, str) and self.plan.text("verdict.about") in words

    def _note(self, key: str, apart: float, expected: Scalar) -> None:
        spot = self.plan.at.spots[f"#{key}"]
        where = f"{cell_address(spot.sheet, spot.row, spot.col)} ({key})"
        self.tally.note(apart, where, self._found(key), expected)

    def _number(self, key: str, expected: Sequence[float], allowed: float = 1e-9) -> None:
        """A number that is one of those expected, or that is none where there are none. `allowed`: so much it may be off."""
        found = self._found(key)
        if not expected:
            self._note(key, math.inf if isinstance(found, float) else 0.0, "no number")
            return
        nearest = float(expected[0])
        apart = math.inf
        if isinstance(found, float):
            nearest = float(min(expected, key=lambda one: abs(one - found)))
            apart = float(EXACT * abs(found - nearest) / allowed)
        self._note(key, apart, nearest)

    def _warns(self, key: str, expected: bool) -> None:
        found = self._found(key)
        right = isinstance(found, float) and (found > 0) == expected
        self._note(key, 0.0 if right else math.inf, float(expected))

    # --- the line, limits ------------------------------------------------------------------------------------------------

    def _line(self) -> None:
        """The line under the title: in how many rows it closes."""
        plan, search = self.plan, self.search
        line = str(self._found("verdict"))
        aside = [
            plan.text("verdict.inputs.wrong", symbol=plan.text("name.position")),
            plan.text("verdict.inputs.misfit"),
        ]
        if line in aside:  # the position shown is none: nothing about the motion
            return
        some = f"{search.count} / {search.rows}"
        if search.count == 0:
            expected = plan.text("page.verdict.nowhere" if self.page else "verdict.line.nowhere")
            right = line == expected
        elif search.count == search.rows:
            begin, end = plan.text("page.verdict.all"), plan.text("page.verdict.positions")
            expected = f"{begin}{search.rows}{end}" if self.page else plan.text("verdict.line.all", rows=search.rows)
            right = line.startswith(expected)
        else:
            expected = some
            right = sorted(map(int, _NUMBER.findall(line)[:2])) == sorted((search.count, search.rows))
        self._note("verdict", 0.0 if right else 1.0, expected)

    def _limits(self) -> None:
        limits = self.search.limits()
        self._number("limits", [float(len(limits))])
        if not self.search.stepped:
            return
        allowed = self._allowed_place()
        shown = [key for key in self.plan.at.spots if key.startswith("#limit_")]
        for number in range(1, len(shown) + 1):
            places = limits[number - 1][1] if number <= len(limits) else []
            self._number(f"limit_{number}", self._at(places), allowed)

    def _allowed_place(self) -> float:
        part = 1.0 if self.search.doubtful or self._about("limits") else EXACT
        return max(part * abs(self.search.step) * self.driver_scale, 1e-9)

    def _at(self, places: Iterable[float]) -> list[float]:
        """Values of the driver, as people read them."""
        return [float(self.search.driver(place)) * self.driver_scale for place in places]

    def _ends(self) -> None:
        """From where to where the driver can go in the first stretch."""
        search = self.search
        if not search.count:
            self._number("input_from", [])
            self._number("input_to", [])
            return
        first, last = search.row_stretches[0]
        for key, row, other in (("input_from", first, first - 1), ("input_to", last, last + 1)):
            inside = search.stepped and 1 <= other <= search.rows
            places = (search.edges_between(row, other) if inside else []) or [float(row)]
            self._number(key, self._at(places), self._allowed_place())

    # --- quantities ------------------------------------------------------------------------------------------------------

    def _grashof(self, loop: FourBar) -> None:
        """Shortest + longest - the other two."""
        known = {name: column[0] for name, column in self.search.at.items()}
        poses = self.plan.equations.poses
        lengths = [
            float(value(length_in_cells(link, one, other, poses), known))
            for link, one, other in loop.sides(self.search.mechanism.ground)
        ]
        excess = 2 * (min(lengths) + max(lengths)) - sum(lengths)
        self._number(f"grashof_{loop.group}", [excess], 1e-8 * self.search.size)

    def _extent(self, key: str, symbol: str, scale: float) -> None:
        """A swing or a stroke: of one stretch."""
        search = self.search
        if len(search.row_stretches) != 1:
            self._number(key, [])
            return
        extremes = search.extremes(symbol)
        if not self.sure or extremes is None:
            return
        extent = (TURN if search.is_angle(symbol) and search.is_crank(symbol) else extremes[2] - extremes[0]) * scale
        least = 1e-8 * (scale if search.is_angle(symbol) else search.size)
        self._number(key, [extent], self._part(key) * extent + least)

    def _part(self, key: str) -> float:
        return ABOUT if self._about(key) else EXACT

    def _ratio(self, symbol: str) -> None:
        """Time of the slower way between the extremes over that of the faster."""
        search, key = self.search, f"time_ratio_{symbol}"
        if not self.sure:
            return
        turns = search.whole and search.closes_everywhere and not (search.is_angle(symbol) and search.is_crank(symbol))
        extremes = search.extremes(symbol) if turns else None
        if extremes is None or extremes[2] - extremes[0] < 1e-7 * (1.0 if search.is_angle(symbol) else search.size):
            self._number(key, [])
            return
        low, at_low, high, at_high = extremes
        ratios = []
        for one in (at_low, *self._ties(symbol, low, high - low)):
            for other in (at_high, *self._ties(symbol, high, high - low)):
                way = abs(other - one) * abs(search.step) % TURN
                if 0 < way < TURN:
                    ratios.append(max(way, TURN - way) / min(way, TURN - way))
        self._number(key, ratios, (ABOUT if self._about(key) else 20 * EXACT) * min(ratios))

    def _ties(self, symbol: str, best: float, span: float) -> Array:
        """Places of the grid that are as good as the best by `EXACT`: a flat extreme's place is less sure than its value."""
        near = self.search.u[np.abs(self.search.at[symbol] - best) < EXACT * span]
        return near[:: max(1, len(near) // 20)]

    def _transmission(self, group: Group) -> None:
        """The angle of transmission that is farthest from 90 degrees, as an acute angle."""
        search, key = self.search, f"transmission_{group.number}"
        if not search.count:
            self._number(key, [])
            return
        if not self.sure and not self.page:
            return

        def acute(angle: Array) -> Array:
            return np.minimum(angle, math.pi - angle) if group.kind == "RRR" else math.pi / 2 - np.abs(angle)

        several = self.page or len(search.row_stretches) > 1
        extremes = search.extremes(group.transmission, acute, rows_only=several)
        if extremes is None:
            return
        least, _, most, _ = extremes
        part = ABOUT if not self.page and self._about(key) else EXACT
        self._number(key, [least * self.angle_scale], (part * max(most - least, 1e-3) + ROUNDED) * self.angle_scale)
