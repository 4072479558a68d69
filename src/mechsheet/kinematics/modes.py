"""Which of a group's two assemblies the sketch means, and the way from a sketched position to the first row."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault
from livesheet.said import Words, say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import largest_length
from mechsheet.kinematics.dyads.solved import Solved
from mechsheet.kinematics.equations import Equation
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Driver, Mechanism

BETWEEN = 0.1
"""A sketch lies between two assemblies where the squares of its distances to them differ by less than this part of the
square of their separation: half as far from the middle of the way from one to the other."""

SEPARATE = 1e-6
"""Assemblies closer than this part of the size (or radians) are one: a dead centre."""


class BetweenModesError(MechanismError):
    """The sketch lies between the two assemblies of a group."""


class NeverClosesError(MechanismError):
    """A group of links cannot be joined in any row; `links` names them and their joints."""

    def __init__(self, links: Words) -> None:
        self.links = links
        fault = Fault(
            say("the links cannot be joined at any value of the driver: {links}", links=links),
            key="dimensions",
            hint=say("check the lengths of these links and the distance of their outer joints"),
        )
        super().__init__(fault)


def pick_mode(
    mechanism: Mechanism,
    ledger: Ledger,
    solved: Solved,
    start: int,
    dimensions: Mapping[str, float],
    given: int | None,
) -> tuple[int, bool]:
    """(mode, left open): the mode whose position is nearest to the sketch, at the first row in which the group closes.

    Where that row is a dead centre, in which both assemblies are one, the next row that tells them apart decides.
    `start` is the group's first column in the ledger, whose values are left as the chosen mode makes them.
    """
    first = ledger.first_number(solved.closes)
    if first is None:
        raise NeverClosesError(solved.label)
    if not solved.mode:
        return 1, False
    if given is not None:
        ledger.set_mode(solved.mode, given, start)
        return given, False
    entries = entries_of(mechanism, ledger, start, dimensions)
    columns = {}
    for sign in (-1, 1):  # +1 last: it stays when nothing decides
        ledger.set_mode(solved.mode, sign, start)
        columns[sign] = [ledger.values[symbol] for symbol, _, _ in entries]
    row = _first_apart(entries, columns, np.flatnonzero(np.isfinite(ledger.values[solved.closes])))
    positions = {sign: [float(column[row]) for column in found] for sign, found in columns.items()}
    distance = {1: 0.0, -1: 0.0}
    separation = 0.0
    for index, (_, wanted, scale) in enumerate(entries):
        plus, minus = positions[1][index], positions[-1][index]
        gap = difference(plus, minus, scale)
        if abs(gap) < SEPARATE:
            continue
        separation += gap**2
        distance[1] += difference(plus, wanted, scale) ** 2
        distance[-1] += difference(minus, wanted, scale) ** 2
    if separation == 0:
        return 1, True
    apart = distance[1] - distance[-1]
    if abs(apart) < BETWEEN * separation:
        if row != first:  # a good sketch of a dead centre: it is as near to the one as to the other
            return 1, True
        raise BetweenModesError(_between(entries, positions, solved))
    mode = 1 if apart < 0 else -1
    ledger.set_mode(solved.mode, mode, start)
    return mode, False


def _first_apart(entries: list[Entry], columns: dict[int, list[Array]], rows: NDArray[np.intp]) -> int:
    """The first of `rows` in which the assemblies differ in what is sketched: at a dead centre they are one."""
    for row in rows:
        for (_, _, scale), plus, minus in zip(entries, columns[1], columns[-1], strict=True):
            if abs(difference(float(plus[row]), float(minus[row]), scale)) >= SEPARATE:
                return int(row)
    return int(rows[0])


Entry = tuple[str, float, float]
"""A sketched quantity: (symbol, rough value, its scale; 0 for an angle)."""


def entries_of(mechanism: Mechanism, ledger: Ledger, start: int, dimensions: Mapping[str, float]) -> list[Entry]:
    """What the sketch says of the columns from `start` on."""
    size = largest_length(mechanism, dimensions) or 1.0
    for equation in ledger.columns[start:]:
        if equation.role == "point":
            found = ledger.values[equation.symbol]
            size = max(size, float(abs(found[found == found]).max(initial=0.0)))
    return entries_among(mechanism, ledger.columns[start:], dimensions, size)


def entries_among(
    mechanism: Mechanism, columns: Sequence[Equation], dimensions: Mapping[str, float], size: float
) -> list[Entry]:
    """What the sketch says of some columns, lengths being measured in `size`."""
    kinds = {equation.symbol: equation.unit.kind for equation in columns}
    sketched = [(f"{point}.{axis}", quantity) for point, place in mechanism.sketch.points.items()
                for axis, quantity in zip("xy", place, strict=True)]  # fmt: skip
    return [
        (symbol, number(quantity, dimensions), 0.0 if kinds[symbol] == "angle" else size)
        for symbol, quantity in (*sketched, *mechanism.sketch.symbols.items())
        if symbol in kinds
    ]


def difference(a: float, b: float, scale: float) -> float:
    """a - b as a part of the scale; angles (scale 0) modulo a turn."""
    return math.remainder(a - b, math.tau) if scale == 0 else (a - b) / scale


def shown_entries(entries: Sequence[Entry], found: Sequence[float]) -> str:
    """What is sketched as an assembly has it: `B.x = 62.61, B.y = 55.51`."""
    return ", ".join(
        f"{name} = {math.degrees(x) if scale == 0 else x:.4g}"
        for (name, _, scale), x in zip(entries, found, strict=True)
    )


def _between(entries: list[Entry], positions: dict[int, list[float]], solved: Solved) -> Fault:
    return Fault(
        say("the sketch lies between the two assemblies of {group}", group=solved.label),
        key="assembly",
        hint=say(
            "+1 is at {plus}; -1 is at {minus}: sketch a point nearer to the one that is meant",
            plus=shown_entries(entries, positions[1]),
            minus=shown_entries(entries, positions[-1]),
        ),
    )


# --- from the sketched position to the first row -----------------------------------------------------------

STEP = math.radians(1.0)
FEWEST, MOST = 24, 390
"""Steps between two values of the driver: fewer than the rows that are looked at when a mechanism is solved."""


def way(start: float, end: float, turns: bool) -> Array:
    """Values of the driver from one to another, in small steps."""
    count = math.ceil(abs(end - start) / STEP) if turns else FEWEST
    return np.linspace(start, end, min(max(count, FEWEST), MOST) + 1)


def cannot_show(links: Words) -> MechanismError:
    """There is no position where the sketch is said to show one."""
    message = say("the sketch cannot show this position: there {links} cannot be joined", links=links)
    hint = say("check `at`, which is in the driver's unit, and the lengths of these links")
    return MechanismError(Fault(message, key="assembly.at", hint=hint))


def cannot_follow(links: Words, driver: Driver, at: float, place: float) -> MechanismError:
    """What the sketch shows at the driver's value `at` comes apart on the way, at another [rad or length unit]."""
    where = {"symbol": driver.symbol, "value": float(driver.unit.to_shown(place))}
    start = float(driver.unit.to_shown(at))
    return MechanismError(
        Fault(
            say(
                "from the position that the sketch shows {links} cannot be followed to the first one: they "
                "come apart at {symbol} = {value:.4g}",
                links=links,
                **where,
            ),
            key="assembly.at",
            hint=say(
                "begin the sweep at {symbol} = {start:.4g}, where it exists, or sketch a position of the first one's "
                "stretch",
                symbol=driver.symbol,
                start=start,
            ),
        )
    )
