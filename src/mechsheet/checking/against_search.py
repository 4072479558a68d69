"""The first sheet and its two-way tables against a search in Python that reads no formula (`kinematics.search`).

Each finding says what it expects and by how much its cell may be off (`sheet/findings`); here the cells are read. What a
summary is, the search itself says; an output of summaries must be what its formula makes of those shown.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from livesheet.diagnostics import MissingSheetError
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar, Symbol
from livesheet.formula.references import cell_address
from livesheet.formula.scalar import evaluate
from mechsheet.checking.comparison import Comparison, Tally
from mechsheet.checking.inputs import Inputs, OfTheLast, equations_as_typed, inputs_in, missing_dimensions, with_numbers
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.search import TURN, Search
from mechsheet.kinematics.whole_turns import mean_of_motion
from mechsheet.model import Output, Summary
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.asked.summary_table import SummaryTable
from mechsheet.sheet.asked.two_way import FIRST, HEAD_ROW
from mechsheet.sheet.findings.closing import closes_in_all, misfit_of
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.findings.searched import ABOUT, EXACT, Expected, SearchedMotion
from mechsheet.sheet.page.reading import MEANING as PAGE_MEANING
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import MEANING, Plan
from mechsheet.sheet.shown import unit_of_column

ROUNDED = 1e-8
"""As a part of the size, or as an angle [rad]: rounding at a dead centre."""

POLE = 1e3
"""A quantity whose range is so many times that of its rows has a pole between them, and no largest value."""

GROWN = 3.0
"""And one that the sheet says to grow without bound goes beyond the rows by more than so many of their ranges."""

SAME = 1e-9
"""As a part of itself an output of summaries may be off what its formula makes of the summaries shown."""


def judge_summaries(values: Any, judged: SearchedMotion, tally: Tally) -> None:
    """Note each summary of the first sheet, and each output of summaries."""
    plan = judged.plan
    shown: dict[str, float] = {}
    for summary in plan.mechanism.summaries:
        number = _number(values, plan, summary.symbol)
        shown[summary.symbol] = unit_of_column(plan, summary.of).to_internal(number)
        _judge(values, judged, tally, summary, number)
    for output in plan.mechanism.motion_outputs:
        _judge_output(values, plan, tally, judged.search, output, shown)


def _number(values: Any, plan: Plan, symbol: str) -> float:
    spot = plan.places.summaries[symbol]
    found = values.get(spot.sheet, spot.row, spot.col)
    return found if isinstance(found, float) else math.nan


def _where(plan: Plan, symbol: str) -> str:
    spot = plan.places.summaries[symbol]
    return f"{cell_address(spot.sheet, spot.row, spot.col)} ({symbol})"


def _judge(values: Any, judged: SearchedMotion, tally: Tally, summary: Summary, number: float) -> None:
    plan = judged.plan
    where = _where(plan, summary.symbol)
    if not judged.search.count:
        tally.note(math.inf if math.isfinite(number) else 0.0, where, number, "no number")
        return
    spot = plan.places.summaries[summary.symbol]
    words = values.get(spot.sheet, spot.row, MEANING)
    if math.isnan(number) and isinstance(words, str) and plan.text("verdict.boundless") in words:
        tally.note(0.0 if _grows(judged, summary) else math.inf, where, "grows without bound", "an extreme")
        return
    if math.isnan(number) and _has_gaps(judged, summary):
        tally.note(0.0, where, "no number", "a row without a value")
        return
    if plan.equations.equations.range_has_gaps(summary.of, summary.take) and len(judged.search.row_stretches) > 1:
        tally.note(math.inf if math.isfinite(number) else 0.0, where, number, "no number: several stretches")
        return
    expected = expected_of(judged, summary)
    if expected is None or not expected.sure:
        return
    said = words if isinstance(words, str) else ""
    if plan.text("verdict.beyond") in said:  # it may be elsewhere: beside another row
        expected = replace(expected, whole=False)
    settled = plan.text("verdict.about") not in said
    tally.note(expected.apart(number, settled) * tally.tolerance, where, number, expected.value)


def _grows(judged: SearchedMotion, summary: Summary) -> bool:
    """Whether the search, too, finds values far beyond the rows."""
    inner, outer = (judged.search.extremes(summary.of, rows_only=rows_only) for rows_only in (True, False))
    if inner is None or outer is None:
        return False
    return not outer[2] - outer[0] < GROWN * (inner[2] - inner[0])


def _has_gaps(judged: SearchedMotion, summary: Summary) -> bool:
    """Whether an extreme over several sheets has no value: there is none in a row that closes, as at a dead centre."""
    if judged.page or not summary.take.ways:
        return False
    return not np.isfinite(judged.search.in_rows(summary.of)[judged.search.row_there]).all()


def _judge_output(
    values: Any, plan: Plan, tally: Tally, search: Search, output: Output, summaries: dict[str, float]
) -> None:
    """What the formula makes of the summaries shown: these are judged by themselves."""
    number = _number(values, plan, output.symbol)
    known = {**search.dimensions, **summaries}
    try:
        expected = plan.mechanism.shown(output.unit).to_shown(evaluate(output.formula, known))
    except (ArithmeticError, ValueError):
        expected = math.nan
    if not math.isfinite(expected):
        tally.note(math.inf if math.isfinite(number) else 0.0, _where(plan, output.symbol), number, "no number")
        return
    apart = abs(number - expected) / (SAME * max(1.0, abs(expected)))
    apart = apart if math.isfinite(apart) else math.inf
    tally.note(apart * tally.tolerance, _where(plan, output.symbol), number, expected)


@dataclass(frozen=True, slots=True)
class ExpectedSummary:
    """What a summary is.

    value, of_rows  as the motion has it, and the rows alone
    range           of the quantity;  rounded: so much is rounding
    turn            of an angle that is known up to whole turns, else 0
    whole           whether all positions exist, and all have been looked at
    sure            whether the motion is known well enough to ask
    """

    value: float
    of_rows: float
    range: float
    rounded: float
    turn: float
    whole: bool
    sure: bool

    def apart(self, shown: Scalar, settled: bool) -> float:
        """How far a cell's value is off, as a part of what is allowed.

        Where some positions do not exist, or have not been looked at, it may be anything between that of the rows and that
        of the motion.
        """
        if not isinstance(shown, float) or not math.isfinite(shown):
            return math.inf
        low, high = sorted((self.value, self.value if self.whole else self.of_rows))
        if self.turn:
            shown += self.turn * round((low - shown) / self.turn)
        off = max(low - shown, shown - high, 0.0)
        return off / ((EXACT if settled or not self.whole else ABOUT) * self.range + self.rounded)


def expected_of(judged: SearchedMotion, summary: Summary) -> ExpectedSummary | None:
    """What a summary is over the rows that exist and, but on a page, what lies between them.

    None where no row exists, for an extreme over too many stretches, and for a quantity with a pole.
    """
    search = judged.search
    if not search.count or summary.of not in search.at or (summary.take.ways and judged.too_many):
        return None
    angle = search.is_angle(summary.of)
    scale = unit_of_column(judged.plan, summary.of).to_shown(1.0)
    inner, outer = search.extremes(summary.of, rows_only=True), search.extremes(summary.of, rows_only=judged.page)
    if inner is None or outer is None:
        return None
    reach, of_all = inner[2] - inner[0], outer[2] - outer[0]
    if not math.isfinite(of_all) or (reach > 0 and of_all > POLE * reach):
        return None
    in_rows = search.in_rows(summary.of)
    column = in_rows[search.row_there]
    take = summary.take
    averaged = np.asarray(value(take.row(Symbol(summary.of)), {summary.of: in_rows}))
    mean = float(mean_of_motion(averaged, search.row_there, search.counts_alike))
    plain = {"first": float(column[0]), "last": float(column[-1]), "mean": mean}
    of_motion, of_rows = (
        float(value(take.value, {**plain, "least": found[0], "largest": found[2]})) * scale for found in (outer, inner)
    )
    whole = search.count == search.rows
    unit = 1.0 if angle else search.size
    return ExpectedSummary(
        of_motion, of_rows, of_all * scale, ROUNDED * unit * scale,
        TURN * scale if angle and take.occurs_with else 0.0,
        whole, judged.sure and (whole or not angle or len(search.row_stretches) == 1),
    )  # fmt: skip


def judge_tables(values: Any, plan: Plan, tally: Tally, search: Callable[[dict[str, float]], Search | None]) -> None:
    """Note each cell of each such table.

    search  the motion with other values of some inputs (internal units); None where there is none to search
    """
    for table in tables_of(plan):
        if isinstance(table, SummaryTable):
            _judge_table(values, plan, table, tally, search)


def _judge_table(
    values: Any, plan: Plan, table: SummaryTable, tally: Tally, search: Callable[[dict[str, float]], Search | None]
) -> None:
    for down in range(len(table.request.row_values)):
        for across in range(table.count):
            row, col = FIRST + down, 1 + across
            given = {
                table.row.symbol: values.get(table.title, row, 0),
                table.column.symbol: values.get(table.title, HEAD_ROW, col),
            }
            dims = {table.row.symbol: table.row, table.column.symbol: table.column}
            if not all(isinstance(number, float) for number in given.values()):
                continue
            found = search({symbol: dims[symbol].unit.to_internal(number) for symbol, number in given.items()})
            if found is None:
                continue
            sure = values.get(table.title, table.helpers.sure.row, table.at + down * table.count + across) == 1.0
            shown = values.get(table.title, row, col)
            words = ", ".join(f"{symbol} = {number:.6g}" for symbol, number in given.items())
            where = f"{cell_address(table.title, row, col)} ({table.request.value} with {words})"
            expected = expected_of(SearchedMotion(plan, found), table.summary)
            if expected is None:
                tally.note(0.0 if not isinstance(shown, float) else math.inf, where, shown, "no number")
            elif expected.sure or not isinstance(shown, float):
                tally.note(expected.apart(shown, sure) * tally.tolerance, where, shown, expected.value)


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
    mechanism, equations = plan.mechanism, equations_as_typed(plan, inputs)
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
        return Search(with_numbers(mechanism, numbers), equations, given)

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
