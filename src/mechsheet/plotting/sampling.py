"""The workbook that a picture is taken from: the mechanism's own, at as many positions as an animation needs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.evaluation import live
from livesheet.formula.nodes import Symbol
from livesheet.said import say
from mechsheet.arguments.values import number_given
from mechsheet.compiled import Compiled, compiled_of
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import tell
from mechsheet.kinematics.driving import given_at, place_of, rates_at
from mechsheet.kinematics.numeric import Array, runs_of
from mechsheet.model import TIME, Driver, FurtherDriver, Mechanism
from mechsheet.shapes.described import moving_points
from mechsheet.shapes.loads import first_shown
from mechsheet.sheet.plan import STATUS
from mechsheet.units import behind_number
from mechsheet.words.catalogue import LANGUAGES
from mechsheet.words.symbols import plain

if TYPE_CHECKING:
    from livesheet.engine import Live

LEAST, MOST = 121, 361
"""A sweep with fewer positions is refined, each of its steps alike; of one with more, every second, third … is taken."""

SAME = 1e-9
"""A driver value this part of the sweep away from a position is that position."""


class Sample(Compiled):
    """A mechanism compiled at the positions to be drawn.

    sweep    how many of the table's rows are the sweep; one more follows when a position outside of it is asked for
    vectors  whether the drawing has arrows of velocities, accelerations and forces
    """

    def __init__(
        self, mechanism: Mechanism, modes: Mapping[str, int], sweep: int, shown: int | None, vectors: bool = False
    ) -> None:
        super().__init__(mechanism, modes)
        self.sweep = sweep
        self.vectors = vectors
        self._asked = shown

    @cached_property
    def exists(self) -> tuple[bool, ...]:
        """In which rows there is a position, by the equations' own values: a picture needs no cell of the workbook."""
        return tuple(self.closed.tolist())

    @cached_property
    def cells(self) -> Live:
        """What the workbook's cells show, each computed when it is asked for: the drawing again for each position."""
        return live(self.layout, often=True)

    @cached_property
    def shown(self) -> int:
        """The row of the position asked for; without one, that which a workbook shows first."""
        if self._asked is not None:
            return self._asked
        return first_shown(self.mechanism, self.closed, self.values)


def sample(
    mechanism: Mechanism,
    at: float | None,
    language: str | None,
    least: int = LEAST,
    vectors: bool = False,
) -> Sample:
    """The mechanism's workbook at the positions to be drawn, `at` (in the driver's unit) among them exactly.

    There are `least` positions or a few more, where the sweep has fewer of its own.
    The assembly modes are those of the description's own sweep; `vectors` as of `Sample`. Raises MechanismError when the
    mechanism cannot be solved, or cannot be assembled at `at`; MechsheetError when `at` is no number, or where there are no
    vectors to draw.
    """
    at = None if at is None else number_given(at, "at")
    if language not in (None, *LANGUAGES):
        raise MechsheetError(
            Fault(
                say('unknown language "{language}"', language=language),
                key="language",
                hint=say("languages: {languages}", languages=", ".join(f'"{each}"' for each in LANGUAGES)),
            )
        )
    compiled = compiled_of(mechanism)
    tell(mechanism, compiled.equations)
    places: list[float] = []
    if mechanism.driver.law is None:
        values = resampled(compiled.driver.tolist(), least)
    else:
        places = resampled([float(row) for row in range(1, mechanism.driver.law.rows + 1)], least)
        values = given_at(mechanism, dimension_values(mechanism), np.array(places))[mechanism.driver.symbol].tolist()
    shown, sweep = None, len(values)
    if at is not None:
        wanted = mechanism.driver.unit.to_internal(at)
        values, shown = with_value(values, wanted)
        sweep = sweep if shown == sweep else len(values)
        if places and len(values) > len(places):
            places.insert(shown, place_of(mechanism, dimension_values(mechanism), wanted))
    drawn = replace(
        mechanism,
        driver=_listed(compiled, values, places, shown, least),
        drivers=tuple(_besides(driver, compiled, values, shown, least) for driver in mechanism.drivers),
        language=language or mechanism.language,
        layout="sheets",
        tables=(),
        summaries=(),
        motion_outputs=(),
    )
    found = Sample(drawn, compiled.modes, sweep, shown, vectors)
    if vectors and not found.plan.arrows:
        hint = say("give the driver a speed, or the links masses or loads")
        if found.plan.rates:
            hint = say('say whose: points = ["{point}"] in [rates]', point=next(iter(moving_points(mechanism)), "A"))
        raise MechsheetError(
            Fault(say("there are no velocities of points and no forces to draw"), key="vectors", hint=hint)
        )
    if shown is not None and not found.exists[shown]:
        raise MechanismError(_missing(found, at))
    return found


def _listed(
    compiled: Compiled, values: Sequence[float], places: Sequence[float], row: int | None, least: int
) -> Driver:
    """The driver at these values one by one; with the time of its law at these places, with what is listed beside it.

    row  of a value that was put between those of the sweep, if one was
    """
    mechanism, driver = compiled.mechanism, compiled.mechanism.driver
    names = dict(zip(mechanism.driver_rates, ("speeds", "accelerations"), strict=True))
    if driver.law is None:
        own = [name for name in mechanism.given_by_row if name not in mechanism.listed_symbols]
        columns = {name: _as_driver(compiled.given[name], values, row, least) for name in own}
    else:
        given = given_at(mechanism, dimension_values(mechanism), np.array(places))
        rates = rates_at(mechanism, dimension_values(mechanism), given)
        known = {dim.symbol for dim in mechanism.dimensions}  # the same in every row
        columns = {TIME: given[TIME].tolist()}
        columns |= {name: column.tolist() for name, column in rates.items() if name not in known}
    lists = {names.get(name, "times"): tuple(column) for name, column in columns.items()}
    speed, acceleration = driver.speed, driver.acceleration
    if driver.law is not None:
        speed, acceleration = (Symbol(name) for name in names)
    return replace(
        driver,
        values=tuple(values),
        law=None,
        speed=speed,
        acceleration=acceleration,
        times=lists.get("times", ()),
        speeds=lists.get("speeds", ()),
        accelerations=lists.get("accelerations", ()),
    )


def _besides(
    driver: FurtherDriver, compiled: Compiled, values: Sequence[float], row: int | None, least: int
) -> FurtherDriver:
    """A further driver at these values of the driver, where its own are listed."""
    if not driver.values:
        return driver
    return replace(driver, values=tuple(_as_driver(compiled.given[driver.symbol], values, row, least)))


def _as_driver(listed: Array, values: Sequence[float], row: int | None, least: int) -> list[float]:
    """What is listed beside the driver's values, where these have been refined: evenly from one to the next."""
    found = resampled(listed.tolist(), least)
    if row is None or len(found) == len(values):
        return found
    if row >= len(found):
        return [*found, found[-1]]
    part = (values[row] - values[row - 1]) / (values[row + 1] - values[row - 1])
    found.insert(row, found[row - 1] + (found[row] - found[row - 1]) * part)
    return found


def resampled(values: Sequence[float], least: int = LEAST) -> list[float]:
    """The driver's values with equal parts between them, or thinned; first and last stay."""
    steps = len(values) - 1
    if steps < 1:
        return list(values)
    most = max(MOST, least)
    if len(values) > most:
        every = math.ceil(steps / (most - 1))
        return [*values[:-1:every], values[-1]]
    parts = math.ceil((least - 1) / steps)
    fine = [a + (b - a) * part / parts for a, b in pairwise(values) for part in range(parts)]
    return [*fine, values[-1]]


def with_value(values: Sequence[float], value: float) -> tuple[list[float], int]:
    """The values with one more, and its row: where the sweep passes it, or after the end when it does not.

    Never before the first: the sketch belongs to that one.
    """
    near = SAME * (max(values) - min(values) or 1.0)
    for row, known in enumerate(values):
        if abs(known - value) <= near:
            return list(values), row
    for row, (a, b) in enumerate(pairwise(values), 1):
        if (a - value) * (b - value) < 0:
            return [*values[:row], value, *values[row:]], row
    return [*values, value], len(values)


def _missing(sample: Sample, at: float | None) -> Fault:
    plan = sample.plan
    driver = plan.mechanism.driver
    unit = behind_number(driver.unit.text)
    shown = driver.unit.to_shown(np.array(plan.driver))
    symbol = plain(driver.symbol)
    runs = runs_of(sample.exists[: sample.sweep])
    ranges = ", ".join(f"{shown[a]:.6g} … {shown[b - 1]:.6g}{unit}" for a, b in runs)
    why = sample.column(STATUS)[sample.shown]
    return Fault(
        say("no position at {symbol} = {at:g}{unit}: {why}", symbol=symbol, at=at, unit=unit, why=why),
        key="at",
        hint=say("the sweep has positions at {symbol} = {ranges}", symbol=symbol, ranges=ranges)
        if runs
        else say("no position of the sweep exists"),
    )
