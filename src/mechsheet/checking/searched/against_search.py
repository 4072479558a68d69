"""The verdicts of the first sheet against a search in Python that reads no formula (`kinematics.search`).

Each finding says what it expects and by how much its cell may be off (`sheet/findings`); here the cells are read.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from livesheet.diagnostics import MissingSheetError
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
from livesheet.formula.references import cell_address
from mechsheet.checking.inputs import Inputs, OfTheLast, inputs_in
from mechsheet.checking.report import Comparison, Tally
from mechsheet.checking.searched.summaries import judge_summaries
from mechsheet.checking.searched.tables import judge_tables
from mechsheet.checking.undefined_dimensions import missing_dimensions
from mechsheet.kinematics.search import Search
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.findings.closing import closes_in_all, misfit_of
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.findings.searched import EXACT, Expected, SearchedMotion
from mechsheet.sheet.page.reading import MEANING as PAGE_MEANING
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import MEANING, Plan

_NUMBER = re.compile(r"\d+")


_SEARCHES: OfTheLast[dict[tuple[tuple[str, float], ...], Search | None]] = OfTheLast()
"""By other values of some inputs: a search reads no cell but inputs."""


def against_search(book: Book, values: Any, plan: Plan, shown: str, built: Plan | None = None) -> Comparison | None:
    """Hold every verdict cell against what is found with the inputs in the cells; arguments as of `against_plan`.

    None where a derived dimension does not exist: then there is no motion to search. Raises MissingSheetError where a sheet
    that the first one reads was deleted: most of its lines are empty then.
    """
    for key in plan.places.sheets:
        if book.sheet(plan.at.titles[key]) is None:
            raise MissingSheetError(plan.at.titles[key], shown)
    search = _searching(plan, inputs_in(book, values, plan, shown))
    found = search({})
    if found is None:
        return None
    judge = _Judge(values, plan, found)
    judge_summaries(values, judge, judge.tally)
    if built is not None and built is not plan:
        search, plan = _searching(built, inputs_in(book, values, built, shown)), built
    judge_tables(values, plan, judge.tally, search)
    return judge.result()


def _searching(plan: Plan, inputs: Inputs) -> Callable[[Mapping[str, float]], Search | None]:
    """The search of a motion with other values of some inputs; None where a dimension has none then."""
    mechanism, equations = plan.mechanism, plan.equations.equations
    groups = tuple(
        replace(group, assembly=group.assembly_of(inputs.modes[group.mode])) if group.mode in inputs.modes else group
        for group in equations.groups
    )
    known = _SEARCHES.of(plan, inputs, dict)
    there = np.isfinite(inputs.given[mechanism.driver.symbol])
    # rows that were inserted and left empty are none
    given = {name: column[there] for name, column in inputs.given.items()} if there.any() else inputs.given

    def search(other: Mapping[str, float]) -> Search | None:
        asked = tuple(other.items())
        if asked not in known:
            known[asked] = searched(other)
        return known[asked]

    def searched(other: Mapping[str, float]) -> Search | None:
        numbers = {**inputs.dimensions, **other}
        if missing_dimensions(mechanism, numbers):
            return None
        dimensions = tuple(
            dim if dim.derived else replace(dim, value=numbers[dim.symbol]) for dim in mechanism.dimensions
        )
        return Search(replace(mechanism, dimensions=dimensions), replace(equations, groups=groups), given)

    return search


class _Judge(SearchedMotion):
    """The findings of one workbook, as its cells have them, one after another."""

    def __init__(self, values: Any, plan: Plan, search: Search) -> None:
        super().__init__(plan, search)
        self.values = values
        self.tally = Tally("search", tolerance=EXACT)
        self.meaning = PAGE_MEANING if self.page else MEANING
        self.others = {f"{key}_at": spot for key, spot in plan.places.occurs.items()}
        self.others |= {spot.name: spot for spot in plan.extremes.limits} if plan.extremes else {}

    def result(self) -> Comparison:
        """All findings that this layout has."""
        for finding in findings_of(self.plan.mechanism, self.plan.found, by_rows=self.page):
            for key, expected in finding.expected(self).items():
                self._judge(key, expected)
        self._line()  # last: it repeats the others
        return self.tally.result()

    # --- cells ---------------------------------------------------------------------------------------------------------

    def _spot(self, key: str) -> Spot | None:
        """The cell of a finding, of where it occurs, or of a limit; only the first limits have one."""
        return self.plan.places.lines.get(key, self.others.get(key))

    def number(self, key: str) -> Scalar:
        spot = self._spot(key)
        found: Scalar = None if spot is None else self.values.get(spot.sheet, spot.row, spot.col)
        return found

    def says(self, key: str, word: str) -> bool:
        return self.plan.text(f"verdict.{word}") in self._words(key)

    def _words(self, key: str) -> str:
        spot = there(self._spot(key))
        words = self.values.get(spot.sheet, spot.row, self.meaning)
        return words if isinstance(words, str) else ""

    def _judge(self, key: str, expected: Expected) -> None:
        """A number that is one of those expected, or that is none where there are none."""
        spot = self._spot(key)
        if spot is None:
            return
        shown = self.number(key)
        wanted: Scalar = "no number" if not expected.numbers else float(expected.numbers[0])
        apart = math.inf
        if not expected.numbers:
            apart = math.inf if isinstance(shown, float) else 0.0
        elif isinstance(shown, float) and expected.warning:
            apart = 0.0 if (shown > 0) == (wanted == 1.0) else math.inf
        elif isinstance(shown, float):
            wanted = float(min(expected.numbers, key=lambda one: abs(one - shown)))
            apart = float(EXACT * abs(shown - wanted) / expected.allowed)
        self._note(spot, key, apart, shown, wanted)
        if expected.words and not any(words in self._words(key) for words in expected.words):
            self._note(replace(spot, col=self.meaning), key, math.inf, self._words(key), expected.words[0])

    def _note(self, spot: Spot, key: str, apart: float, shown: Scalar, wanted: Scalar) -> None:
        self.tally.note(apart, f"{cell_address(spot.sheet, spot.row, spot.col)} ({key})", shown, wanted)

    # --- the line under the title ----------------------------------------------------------------------------------------

    def _line(self) -> None:
        """In how many rows it closes."""
        plan, search, spot = self.plan, self.search, self.plan.places.verdict
        shown: Scalar = self.values.get(spot.sheet, spot.row, spot.col)
        line = str(shown)
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
        if search.count == 0:
            expected = plan.text("verdict.line.nowhere")
            right = line.startswith(expected) or (plan.newton and line == plan.text("verdict.line.ended"))
        elif not self.page and (misfit := misfit_of(self)[1]):
            expected = plan.text("verdict.gap.redundant", link=misfit, sheet=plan.at.titles["checks"])
            right = line == expected
        elif search.count == search.rows:
            expected = closes_in_all(plan, search.rows)
            right = line.startswith(expected)
        else:
            expected = f"{search.count} / {search.rows}"
            right = sorted(map(int, _NUMBER.findall(line)[:2])) == sorted((search.count, search.rows))
        self._note(spot, "verdict", 0.0 if right else 1.0, shown, expected)
