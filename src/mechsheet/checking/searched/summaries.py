"""The summaries of the first sheet, and the outputs that follow from them, against a search that reads no formula."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from livesheet.formula.nodes import Scalar, Symbol
from livesheet.formula.references import cell_address
from livesheet.formula.scalar import evaluate
from mechsheet.checking.report import Tally
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.search import TURN, Search
from mechsheet.kinematics.whole_turns import mean_of_motion
from mechsheet.model import Output, Summary
from mechsheet.sheet.findings.searched import SearchedMotion
from mechsheet.sheet.plan import MEANING, Plan
from mechsheet.sheet.shown import unit_of_column

EXACT, ABOUT = 1e-4, 5e-2
"""So much of its range a value may be off; and where the sheet marks it as about right."""

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
class Expected:
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


def expected_of(judged: SearchedMotion, summary: Summary) -> Expected | None:
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
    return Expected(
        of_motion, of_rows, of_all * scale, ROUNDED * unit * scale,
        TURN * scale if angle and take.occurs_with else 0.0,
        whole, judged.sure and (whole or not angle or len(search.row_stretches) == 1),
    )  # fmt: skip
