"""The verdicts of the first sheet by the names of their cells, found by a search in Python that reads no formula."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.search import TURN, Search
from mechsheet.sheet.checks.search_rules import STRETCHES
from mechsheet.sheet.classification import Classification, FourBar
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.plan import Plan

FLAT = 1e-4
"""So much of its range an extreme may be off: where it is flat, its place is less sure than its value."""

LEAP = math.radians(90.0)


class SearchedVerdicts:
    """What a search finds under each verdict's name, as people read it: a number, or several that are as true.

    A list is empty where there is no such number. `sure` is False where the mechanism nearly comes apart, or a link
    turns far between two rows: then nothing is to be said of what hangs on it. `leaps`: a link turns by more than 90
    degrees between two rows. `too_many`: more stretches than extremes are looked for in.
    """

    def __init__(self, plan: Plan, search: Search) -> None:
        self.plan, self.search = plan, search
        mechanism = plan.mechanism
        self.driver_scale = math.degrees(1.0) if mechanism.driver.unit.in_degrees else 1.0
        self.angle_scale = math.degrees(1.0) if mechanism.angle_unit.in_degrees else 1.0
        self.page = mechanism.layout == "page"
        both = search.row_there[1:] & search.row_there[:-1]
        self.leaps = any(np.any(both & (column > LEAP)) for column in search.turns_between_rows().values())
        self.too_many = not self.page and len(search.row_stretches) > STRETCHES
        self.sure = not (search.holes or search.doubtful or self.leaps)

    def scale(self, symbol: str) -> float:
        """From the equations' unit of a quantity to the one that people read."""
        return self.angle_scale if self.search.is_angle(symbol) else 1.0

    # --- where it closes -------------------------------------------------------------------------------------------------

    def limit(self, number: int) -> list[float]:
        """Where the driver is at the limit of this number, from 1."""
        limits = self.search.limits()
        return self._at(limits[number - 1][1]) if number <= len(limits) else []

    def ends(self) -> tuple[list[float], list[float]]:
        """From where to where the driver can go in the first stretch."""
        search = self.search
        if not search.count:
            return [], []
        first, last = search.row_stretches[0]
        if self.plan.mechanism.driver.values:  # they may go to and fro
            values = self._at(range(first, last + 1))
            return [min(values)], [max(values)]
        return self._end(first, first - 1), self._end(last, last + 1)

    def _end(self, row: int, other: int) -> list[float]:
        inside = self.search.stepped and 1 <= other <= self.search.rows
        places = self.search.edges_between(row, other) if inside else []
        return self._at(places or [float(row)])

    def _at(self, places: Iterable[float]) -> list[float]:
        """Values of the driver, as people read them."""
        return [float(self.search.driver(place)) * self.driver_scale for place in places]

    # --- quantities ------------------------------------------------------------------------------------------------------

    def grashof(self, loop: FourBar) -> float:
        """Shortest + longest - the other two."""
        known = {name: column[0] for name, column in self.search.at.items()}
        poses = self.plan.equations.poses
        lengths = [
            float(value(length_in_cells(link, one, other, poses), known))
            for link, one, other in loop.sides(self.search.mechanism.ground)
        ]
        return 2 * (min(lengths) + max(lengths)) - sum(lengths)

    def extent(self, symbol: str, rows_only: bool = False) -> list[float]:
        """A swing or a stroke: of one stretch, or of its rows."""
        search = self.search
        extremes = search.extremes(symbol, rows_only=rows_only) if len(search.row_stretches) == 1 else None
        if extremes is None:
            return []
        whole = search.is_angle(symbol) and search.is_crank(symbol)
        return [(TURN if whole else extremes[2] - extremes[0]) * self.scale(symbol)]

    def time_ratio(self, symbol: str) -> list[float]:
        """Time of the slower way between the extremes over that of the faster; of extremes that are flat, several."""
        search = self.search
        if search.mechanism.driver.uneven:
            return []
        step = abs(search.step)
        if search.mechanism.driver.law is not None:  # its rows are equally far from each other in time
            if abs(step * (search.rows - 1) / TURN - 1) > 1e-9:
                return []
            step = TURN / (search.rows - 1)
        if (
            search.equations.tied and step * (search.rows - 1) > 1.5 * TURN
        ):  # gears may be back after several, or sooner
            return []
        turns = search.whole and search.closes_everywhere and not (search.is_angle(symbol) and search.is_crank(symbol))
        extremes = search.extremes(symbol) if turns else None
        if extremes is None or extremes[2] - extremes[0] < 1e-7 * (1.0 if search.is_angle(symbol) else search.size):
            return []
        low, at_low, high, at_high = extremes
        ratios = []
        for one in (at_low, *self._ties(symbol, low, high - low)):
            for other in (at_high, *self._ties(symbol, high, high - low)):
                way = abs(other - one) * step % TURN
                if 0 < way < TURN:
                    ratios.append(max(way, TURN - way) / min(way, TURN - way))
        return ratios

    def _ties(self, symbol: str, best: float, span: float) -> Array:
        near = self.search.u[np.abs(self.search.at[symbol] - best) < FLAT * span]
        return near[:: max(1, len(near) // 20)]

    def transmission(self, group: Group, rows_only: bool = False) -> tuple[float, float, float] | None:
        """(least, place, most) of the angle of transmission as an acute angle; of several stretches, in their rows."""
        search = self.search
        if not search.count or self.too_many:
            return None

        def acute(angle: Array) -> Array:
            return np.minimum(angle, math.pi - angle) if group.kind == "RRR" else math.pi / 2 - np.abs(angle)

        rows_only = rows_only or self.page or len(search.row_stretches) > 1
        extremes = search.extremes(group.transmission, acute, rows_only=rows_only)
        if extremes is None:
            return None
        least, place, most, _ = extremes
        return least * self.angle_scale, self._at([place])[0], most * self.angle_scale

    # --- all of them -----------------------------------------------------------------------------------------------------

    def numbers(self) -> dict[str, list[float]]:
        """Every verdict that a search can find, by the name of its cell.

        What is true of rows (`rows_closed`, `limits`, `passes`, `leaps`) always; swings, strokes and time ratios only where
        they are `sure`.
        """
        found, search = self.plan.found, self.search
        numbers = {"rows_closed": [float(search.count)]}
        numbers |= {f"grashof_{loop.group}": [self.grashof(loop)] for loop in found.four_bars}
        if not self.page:
            numbers |= self._of_motion(found)
        for group in found.transmission if self.sure or self.page else ():
            of_group = self.transmission(group)
            numbers[f"transmission_{group.number}"] = [] if of_group is None else [of_group[0]]
        return numbers

    def _of_motion(self, found: Classification) -> dict[str, list[float]]:
        search = self.search
        numbers: dict[str, list[float]] = {"leaps": [float(self.leaps)]} if self.sure else {}
        if found.limits:
            limits = search.limits()
            numbers["limits"] = [float(len(limits))]
            if search.stepped:
                numbers |= {f"limit_{number}": self.limit(number) for number in range(1, len(limits) + 1)}
            numbers["input_from"], numbers["input_to"] = self.ends()
        if self.sure:
            symbols = [("swing", link.angle_symbol) for link in found.swings]
            symbols += [("stroke", joint.symbol) for joint in found.strokes]
            numbers |= {f"{kind}_{symbol}": self.extent(symbol) for kind, symbol in symbols}
            numbers |= {f"time_ratio_{symbol}": self.time_ratio(symbol) for symbol in found.returning}
        return numbers
