"""The verdicts of the first sheet against a search in Python that reads no formula (`kinematics.search`).

What the sheet finds by probes beside the rows is found here by many places and narrowing. A limit is right to 1e-4 of a
step, an extreme to 1e-4 of its range; where the sheet itself says "about", or a group nearly comes apart, less is asked.
What the sheet warns of (a gap between rows, links that turn far in one step) is compared as a warning, and nothing that
hangs on it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from livesheet import portable
from livesheet.diagnostics import MissingSheetError
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
from livesheet.formula.references import cell_address
from mechsheet.checking.inputs import OfTheLast, inputs_in
from mechsheet.checking.report import Comparison, Tally
from mechsheet.checking.searched.summaries import judge_summaries
from mechsheet.checking.searched.tables import judge_tables
from mechsheet.checking.searched.verdicts import SearchedVerdicts
from mechsheet.checking.undefined_dimensions import missing_dimensions
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.points_in_link import number_places
from mechsheet.kinematics.search import Search
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.findings.closing import closes_in_all
from mechsheet.sheet.plan import MEANING, Plan
from mechsheet.words.equations import link_words

EXACT = 1e-4
"""So much of a step a limit may be off, of its range an extreme."""

ABOUT = 5e-2
"""The same where the sheet says "about", or a group nearly comes apart; then a limit need only lie in its step."""

GAP = 1e-9
"""A gap of a joint, as a part of the size, that is nothing but rounding."""

ROUNDED = 2e-6
"""Angles by arccos [rad], at a dead centre."""

_NUMBER = re.compile(r"\d+")


_SEARCHES: OfTheLast[dict[tuple[tuple[str, float], ...], Search | None]] = OfTheLast()
"""By other values of some inputs: a search reads no cell but inputs."""


def against_search(book: Book, values: Any, plan: Plan, shown: str) -> Comparison | None:
    """Hold every verdict cell against what is found with the inputs in the cells; arguments as of `against_plan`.

    None where a derived dimension does not exist: then there is no motion to search. Raises MissingSheetError where a sheet
    that the first one reads was deleted: most of its lines are empty then.
    """
    for key in plan.places.sheets:
        if book.sheet(plan.at.titles[key]) is None:
            raise MissingSheetError(plan.at.titles[key], shown)
    mechanism = plan.mechanism
    inputs = inputs_in(book, values, plan, shown)
    equations = plan.equations.equations
    groups = tuple(
        replace(group, assembly=group.assembly_of(inputs.modes[group.mode])) if group.mode in inputs.modes else group
        for group in equations.groups
    )

    known = _SEARCHES.of(plan, inputs, dict)

    def search(other: Mapping[str, float]) -> Search | None:
        asked = tuple(other.items())
        if asked not in known:
            known[asked] = searched(other)
        return known[asked]

    def searched(other: Mapping[str, float]) -> Search | None:
        given = {**inputs.dimensions, **other}
        if missing_dimensions(mechanism, given):
            return None
        dimensions = tuple(
            dim if dim.derived else replace(dim, value=given[dim.symbol]) for dim in mechanism.dimensions
        )
        return Search(replace(mechanism, dimensions=dimensions), replace(equations, groups=groups), inputs.given)

    found = search({})
    if found is None:
        return None
    judge = _Judge(values, plan, found)
    if judge.filled_further():
        return judge.tally.result()
    judge_summaries(values, judge.searched, judge.tally)
    judge_tables(values, plan, judge.tally, search)
    return judge.result()


class _Judge:
    """The verdicts of one workbook, as its cells have them, one after another."""

    def __init__(self, values: Any, plan: Plan, search: Search) -> None:
        self.values, self.plan, self.search = values, plan, search
        self.tally = Tally("search", tolerance=EXACT)
        self.searched = SearchedVerdicts(plan, search)
        self.page = self.searched.page

    def result(self) -> Comparison:
        """All verdicts that this layout has."""
        self._number("inputs", [0.0])
        self._number("rows_closed", [float(self.search.count)])
        for loop in self.plan.found.four_bars:
            # of inputs that cannot be nothing is said
            excess = [] if self._inputs_wrong() else [self.searched.grashof(loop)]
            self._number(f"grashof_{loop.group}", excess, 1e-8 * self.search.size)
        for group in self.plan.found.transmission:
            self._transmission(group)
        if not self.page:
            self._motion()
        self._line()  # last: it repeats the others
        return self.tally.result()

    def _misfit(self) -> tuple[float, str]:
        """By how much the length of a redundant link is off in the worst row, which is the only gap that there can be; and
        the last of those that do not fit, "" where all do."""
        search, mechanism = self.search, self.plan.mechanism
        worst, found = 0.0, ""
        for each in mechanism.redundant:
            slot = next(joint for joint in mechanism.joints if joint.symbol == each.symbol)
            places = number_places(each.link, search.dimensions)
            (x, y), (x_end, y_end) = places[str(slot.through)], places[slot.point]
            length = portable.hypot(x_end - x, y_end - y)
            column = search.in_rows(each.symbol)[search.row_there]
            off = float(np.max(np.abs(np.abs(column) - length)))  # of the other assembly it points the other way
            worst = max(worst, off)
            if off > GAP * search.size:
                found = link_words(each.link).of(mechanism.language)
        return worst, found

    def _motion(self) -> None:
        """What only the layout of several sheets says."""
        found, search = self.plan.found, self.search
        if found.limits:
            self._limits()
            self._ends()
            if not search.doubtful:
                self._warns("passes", bool(search.holes))
        if search.count:
            gap, (misfit, _) = self._found("largest_gap"), self._misfit()
            small = isinstance(gap, float) and abs(gap - misfit) <= GAP * search.size
            self._note("largest_gap", 0.0 if small else math.inf, misfit)
        leaps = self.searched.leaps
        if self.searched.sure or (leaps and not (search.holes or search.doubtful)):
            self._warns("leaps", leaps)
        for link in found.swings:
            self._extent(f"swing_{link.angle_symbol}", link.angle_symbol)
        for joint in found.strokes:
            self._extent(f"stroke_{joint.symbol}", joint.symbol)
        for symbol in found.returning:
            self._ratio(symbol)

    # --- cells ---------------------------------------------------------------------------------------------------------

    def filled_further(self) -> bool:
        """Whether somebody has filled the page's table further down: then its verdicts are of more rows than the plan's."""
        return self.page and self.values.get(self.plan.main, self.plan.at.last + 1, 0) is not None

    def _spot(self, key: str) -> Spot:
        """The line under the title, a line of what is said, a limit."""
        known = {"verdict": self.plan.places.verdict} | {spot.name: spot for spot in self._limits_shown}
        return known[key] if key in known else self.plan.places.lines[key]

    @property
    def _limits_shown(self) -> Sequence[Spot]:
        return self.plan.extremes.limits if self.plan.extremes else ()

    def _found(self, key: str) -> Scalar:
        spot = self._spot(key)
        found: Scalar = self.values.get(spot.sheet, spot.row, spot.col)
        return found

    def _says(self, key: str, word: str) -> bool:
        """Whether the words beside a number say that it is `about` right, `within` a step, of `rows.only`, or `beyond`."""
        spot = self._spot(key)
        words = self.values.get(spot.sheet, spot.row, MEANING)
        return isinstance(words, str) and self.plan.text(f"verdict.{word}") in words

    def _note(self, key: str, apart: float, expected: Scalar) -> None:
        spot = self._spot(key)
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

    def _inputs_wrong(self) -> bool:
        wrong = self._found("inputs")
        return isinstance(wrong, float) and wrong > 0

    def _warns(self, key: str, expected: bool) -> None:
        found = self._found(key)
        right = isinstance(found, float) and (found > 0) == expected
        self._note(key, 0.0 if right else math.inf, float(expected))

    # --- the line, limits ------------------------------------------------------------------------------------------------

    def _line(self) -> None:
        """The line under the title: in how many rows it closes."""
        plan, search = self.plan, self.search
        line = str(self._found("verdict"))
        if plan.found.task is not None:  # the random tasks of tests judge what is said of it
            task = plan.places.lines["task"]
            line = line.removeprefix(f"{self.values.get(task.sheet, task.row, MEANING)}; ")
        aside = [
            plan.text("verdict.inputs.wrong", symbol=plan.text("name.position")),
            plan.text("verdict.inputs.misfit"),
        ]
        if plan.newton:  # which assembly it is the search does not ask
            aside += [plan.text(f"verdict.{key}") for key in ("same_assembly.lost", "same_assembly.begun")]
        if line in aside:  # the position shown is none: nothing about the motion
            return
        some = f"{search.count} / {search.rows}"
        if search.count == 0:
            expected = plan.text("verdict.line.nowhere")
            right = line.startswith(expected) or (plan.newton and line == plan.text("verdict.line.ended"))
        elif not self.page and (misfit := self._misfit()[1]):
            expected = plan.text("verdict.gap.redundant", link=misfit, sheet=plan.at.titles["checks"])
            right = line == expected
        elif search.count == search.rows:
            expected = closes_in_all(plan)
            right = line.startswith(expected)
        else:
            expected = some
            right = sorted(map(int, _NUMBER.findall(line)[:2])) == sorted((search.count, search.rows))
        self._note("verdict", 0.0 if right else 1.0, expected)

    def _limits(self) -> None:
        self._number("limits", [float(len(self.search.limits()))])
        if not self.search.stepped:
            return
        allowed = self._allowed_place()
        for number, spot in enumerate(self._limits_shown, 1):
            self._number(spot.name, self.searched.limit(number), allowed)

    def _allowed_place(self) -> float:
        part = 1.0 if self.search.doubtful or self._says("limits", "within") else EXACT
        return max(part * abs(self.search.step) * self.searched.driver_scale, 1e-9)

    def _ends(self) -> None:
        """From where to where the driver can go in the first stretch."""
        for key, expected in zip(("input_from", "input_to"), self.searched.ends(), strict=True):
            self._number(key, expected, self._allowed_place() if expected else 1.0)

    # --- quantities ------------------------------------------------------------------------------------------------------

    def _extent(self, key: str, symbol: str) -> None:
        """A swing or a stroke; where there are several stretches there is none."""
        expected = self.searched.extent(symbol, self._says(key, "rows.only"))
        if not expected and len(self.search.row_stretches) == 1:
            return
        expected = self._as_far(key, expected, self.searched.extent(symbol, True))
        if self.searched.sure or not expected:
            least = 1e-8 * (self.searched.scale(symbol) if self.search.is_angle(symbol) else self.search.size)
            self._number(key, expected, self._part(key) * max(expected, default=0.0) + least)

    def _as_far(self, key: str, expected: list[float], of_rows: list[float]) -> list[float]:
        """What is expected; where the sheet says that there may be more elsewhere, all from that of the rows on is right."""
        found = self._found(key)
        if not (expected and of_rows and isinstance(found, float) and self._says(key, "beyond")):
            return expected
        low, high = sorted((expected[0], of_rows[0]))
        return [min(max(found, low), high)]

    def _part(self, key: str) -> float:
        return ABOUT if self._says(key, "about") else EXACT

    def _ratio(self, symbol: str) -> None:
        """Time of the slower way between the extremes over that of the faster."""
        key = f"time_ratio_{symbol}"
        if self.searched.sure:
            ratios = self.searched.time_ratio(symbol)
            part = ABOUT if self._says(key, "about") else 5 * EXACT
            self._number(key, ratios, part * min(ratios, default=1.0))

    def _transmission(self, group: Group) -> None:
        """The angle of transmission that is farthest from 90 degrees, as an acute angle."""
        key = f"transmission_{group.number}"
        if not self.search.count or self.searched.too_many:
            self._number(key, [])
        elif self.searched.sure or self.page:
            found = self.searched.transmission(group, not self.page and self._says(key, "rows.only"))
            if found is not None:
                least, _, most = found
                scale = self.searched.angle_scale
                part = ABOUT if not self.page and self._says(key, "about") else EXACT
                of_rows = None if self.page else self.searched.transmission(group, rows_only=True)
                expected = self._as_far(key, [least], [of_rows[0]] if of_rows else [])
                self._number(key, expected, part * max(most - least, 1e-3 * scale) + ROUNDED * scale)
