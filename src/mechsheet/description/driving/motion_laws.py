"""The motion laws of [driver] motion: value, speed and acceleration of the driver over the time t, in which it goes from
start to stop in `duration` seconds.

With tau = t/duration the driver's value is start + (stop - start) f(tau), its speed (stop - start)/duration f'(tau), its
acceleration (stop - start)/duration^2 f''(tau):

    constant     tau                                polynomial   10 tau^3 - 15 tau^4 + 6 tau^5
    accelerated  tau^2                              harmonic     (1 - cos(pi tau))/2
    parabolic    2 tau^2, then 1 - 2 (1 - tau)^2    cycloidal    tau - sin(2 pi tau)/(2 pi)

Source: Norton, Design of Machinery, chapter 8 (cam functions); Soeylemez, Mechanisms, chapter 8.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, symbols
from livesheet.formula.parser import parse_description
from livesheet.said import say
from mechsheet.description.kinds import ANGLE, ANY, LENGTH
from mechsheet.description.report import BAD
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.model import LAWS, TIME, Dimension, Driver, Law, Quantity
from mechsheet.units import SECONDS, Unit

START, STOP, DURATION = "start", "stop", "duration"
"""Names of the cells that say from where to where the driver goes, and in what time."""

ROWS = 41
"""Rows of a motion that does not say how many."""

_LATE = "2*t/duration-1.000000001"
"""Above 0 in the second half; in the middle itself the driver still speeds up, however the rounding fell."""

_LAWS: dict[str, tuple[str, str, str]] = {
    "constant": ("t/duration", "1", "0"),
    "accelerated": ("(t/duration)^2", "2*t/duration", "2"),
    "parabolic": (
        f"where({_LATE}, 1-2*(1-t/duration)^2, 2*(t/duration)^2)",
        f"where({_LATE}, 4*(1-t/duration), 4*t/duration)",
        f"where({_LATE}, -4, 4)",
    ),
    "harmonic": ("(1-cos(pi*t/duration))/2", "pi/2*sin(pi*t/duration)", "pi^2/2*cos(pi*t/duration)"),
    "cycloidal": (
        "t/duration-sin(2*pi*t/duration)/(2*pi)",
        "1-cos(2*pi*t/duration)",
        "2*pi*sin(2*pi*t/duration)",
    ),
    "polynomial": (
        "(t/duration)^3*(10-15*t/duration+6*(t/duration)^2)",
        "30*(t/duration)^2*(1-t/duration)^2",
        "60*t/duration*(1-t/duration)*(1-2*t/duration)",
    ),
}
"""f, f' and f'' of each law."""

assert _LAWS.keys() == {*LAWS}


@dataclass(frozen=True, slots=True)
class Motion:
    """How the driver moves, by a law or not: see `Driver`; `dimensions` are those of its own that are cells."""

    speed: Node
    acceleration: Node
    dimensions: tuple[Dimension, ...]
    law: Law | None = None
    speeds: tuple[Quantity, ...] = ()
    accelerations: tuple[Quantity, ...] = ()

    def of(self, driver: Driver) -> Driver:
        """The driver, moving so."""
        return replace(
            driver,
            speed=self.speed,
            acceleration=self.acceleration,
            law=self.law,
            speeds=self.speeds,
            accelerations=self.accelerations,
        )


def declare(data: dict[str, Any], scope: Scope) -> None:
    """Enter the names of time, start, stop and duration; what a law decides must not be given."""
    path: Path = ("driver", "motion")
    for name in (TIME, START, STOP, DURATION):
        what = "time" if name == TIME else name
        scope.symbols.claim(
            name,
            say("{what} of the driver's motion", what=say(what)),
            path,
            say("rename it: the driver has a motion law"),
        )
    for key in ("speed", "acceleration"):
        if key in data:
            message = say("goes with `step` or `values`: here the {key} follows from the motion law", key=key)
            scope.report.at(("driver", key), message, say("leave out {key}, or motion", key=key))
    scope.rates[TIME] = None


def read(
    data: dict[str, Any], driver: Driver, names: tuple[str, str], units: tuple[Unit, Unit], scope: Scope
) -> Motion | None:
    """The motion, when no fault hides it. `names`, `units`: of the driver's speed and acceleration."""
    given = data["motion"]
    if given is BAD or "values" in data:
        return None
    path: Path = ("driver", "motion")
    kind = LENGTH if driver.joint else ANGLE
    duration = _duration(given, (*path, DURATION), scope)
    first, last = scope.number(driver.start), scope.number(driver.stop)
    if first == last:
        scope.report.at(("driver", STOP), say("start and stop are the same: the driver does not move"))
    law, rows = given["law"], given.get("rows", ROWS)
    if duration is None or BAD in (law, rows):
        return None
    cells = [
        _cell(name, value, unit, data.get(name), name)
        for name, value, unit in ((START, driver.start, driver.unit), (STOP, driver.stop, driver.unit))
    ]
    cells.append(_cell(DURATION, duration, SECONDS, given[DURATION], DURATION))
    for dim, its_kind in zip(cells, (kind, kind, ANY), strict=True):
        scope.units[dim.symbol], scope.kinds[dim.symbol] = dim.unit, its_kind
        scope.numbers[dim.symbol] = scope.number(dim.value)
    way = al.sub(Symbol(STOP), Symbol(START))
    value, *rates = (parse_description(text) for text in _LAWS[law])
    made = []
    for order, (name, unit, rate) in enumerate(zip(names, units, rates, strict=True), 1):
        time = al.square(Symbol(DURATION)) if order == 2 else Symbol(DURATION)
        tree = al.mul(al.div(way, time), rate)
        if TIME not in symbols(tree):  # the same in every row: one cell
            cells.append(_cell(name, tree, unit, "", ("speed", "acceleration")[order - 1]))
            tree = Symbol(name)
        made.append(tree)
    where = al.add(Symbol(START), al.mul(way, value))
    return Motion(made[0], made[1], tuple(cells), Law(law, rows, START, STOP, DURATION, where))


def _cell(symbol: str, value: Quantity, unit: Unit, written: Any, key: str) -> Dimension:
    """A cell of the motion; a plain number is an input."""
    place = ("driver", "motion", key) if key == DURATION else ("driver", key)
    shown = unit.written(value) if isinstance(value, float) else None
    return Dimension(symbol, value, unit, shown=shown, written=written if isinstance(written, str) else "", path=place)


def _duration(given: dict[str, Any], path: Path, scope: Scope) -> Quantity | None:
    """The duration; None where it is faulty."""
    duration = given[DURATION]
    if duration is BAD:
        return None
    quantity = scope.quantity(duration, ANY, path, SECONDS)
    seconds = scope.number(quantity)
    if seconds <= 0:
        scope.report.at(path, say("the motion takes {seconds:g} s: it must take more than 0", seconds=seconds))
        return None
    return quantity if seconds == seconds else None
