"""[flywheel]: only where the driver turns evenly through whole turns, for else no one energy is stored and given back."""

from __future__ import annotations

import math
from typing import Any

from livesheet.formula.nodes import Symbol
from livesheet.formula.scalar import evaluate
from livesheet.said import Said, say
from mechsheet.description.report import BAD
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.model import ENERGY, Dimension, Driver, Dynamics, Link, Quantity
from mechsheet.units import NUMBER

_PATH: Path = ("flywheel",)


def declare(given: dict[str, Any], scope: Scope) -> None:
    """Enter the name of the column that it brings."""
    if given:
        scope.symbols.claim(
            ENERGY, "energy of the flywheel", _PATH, say("rename it: the flywheel's energy has a column")
        )
        scope.charted[ENERGY] = None


def read(
    given: dict[str, Any], dynamics: Dynamics | None, driver: Driver, links: tuple[Link, ...],
    dimensions: tuple[Dimension, ...], layout: str, scope: Scope,
) -> tuple[Dimension, ...]:  # fmt: skip
    """The dimension with the coefficient of fluctuation; nothing without a flywheel."""
    if not given:
        return ()
    if layout == "page":
        message = say("a flywheel needs sheets of its own, which the layout page does not have")
        scope.report.at(_PATH, message, say('write layout = "sheets"'))
    if dynamics is None:
        scope.report.at(_PATH, say("no link has a mass and nothing is loaded: there is no torque to even out"))
    faults = _of_sweep(driver, links, scope) or _of_speed(driver, dimensions, scope)
    for message, hint in faults:
        scope.report.at(_PATH, message, hint)
    value = given["fluctuation"]
    path: Path = (*_PATH, "fluctuation")
    if value is BAD:
        return ()
    if not 0 < value < 2:
        message = say(
            "{value:.6g} is no coefficient of fluctuation: it is (ω max − ω min) / ω mean, between 0 and 2", value=value
        )
        scope.report.at(path, message, say("0.2 for presses and pumps, 0.02 for machine tools, 0.003 for generators"))
    hint = say("rename it: the flywheel's has a cell of that name")
    scope.symbols.claim("fluctuation", "coefficient of fluctuation", path, hint)
    return (Dimension("fluctuation", float(value), NUMBER, shown=float(value), path=path),)


def _of_sweep(driver: Driver, links: tuple[Link, ...], scope: Scope) -> list[tuple[Said, str]]:
    """Why the rows are no whole turns."""
    if driver.joint or driver.relative_to != links[0].name:
        message = say("a flywheel sits on a link that is driven against the ground, by its angle")
        return [(message, say("drive a crank"))]
    if driver.values:
        message = say("a flywheel needs a whole turn in equal steps, and the driver has `values`")
        return [(message, say("write start, stop and step"))]
    start, stop, step = (scope.number(part) for part in (driver.start, driver.stop, driver.step))
    if not all(map(math.isfinite, (start, stop, step))) or step == 0:
        return []  # reported already
    turns, steps = abs(stop - start) / math.tau, (stop - start) / step
    if round(turns) >= 1 and abs(turns - round(turns)) < 1e-9 and abs(steps - round(steps)) < 1e-6:
        return []
    covered = f"{math.degrees(math.floor(steps + 1e-9) * step):.6g}°"
    message = say(
        "a flywheel needs a whole turn, first and last row alike: these rows cover {covered}", covered=covered
    )
    closing = driver.unit.written(start + math.copysign(math.tau, step))
    hint = say("write stop = {stop:.10g}, a turn from start, and a step that divides it", stop=closing)
    return [(message, hint)]


def _of_speed(driver: Driver, dimensions: tuple[Dimension, ...], scope: Scope) -> list[tuple[Said, str]]:
    """Why the speed is not constant."""
    if driver.speed is None:
        return [] if scope.moves else [(say("a flywheel needs the driver's speed"), say("write `speed` in [driver]"))]
    cells = {dim.symbol: dim.value for dim in dimensions if dim.path[:1] == ("driver",)}
    speed, acceleration = (
        cells.get(rate.name) if isinstance(rate, Symbol) else None for rate in (driver.speed, driver.acceleration)
    )
    if speed is None or acceleration is None or abs(_number(acceleration, scope)) > 0.0:
        hint = say("give one number as `speed`, and no `acceleration`")
        return [(say("a flywheel needs a constant speed: this one varies"), hint)]
    return [(say("a flywheel needs a speed: at rest it stores no energy"), "")] if _number(speed, scope) == 0.0 else []


def _number(quantity: Quantity, scope: Scope) -> float:
    """The value; nan where it has none, as a motion that takes next to no time."""
    try:
        return quantity if isinstance(quantity, float) else evaluate(quantity, scope.numbers)
    except (ArithmeticError, ValueError):
        return math.nan
