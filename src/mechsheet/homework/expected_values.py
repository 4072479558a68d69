"""What is expected of a workbook: what is asked of it, and what the mechanism does at given driver values: the asked
quantities and everything else that a sheet may hold.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import symbols
from mechsheet import reference
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses
from mechsheet.model import Mechanism, Summary

TOLERANCE = 1e-4
NOT_LIVE = 0.5


@dataclass(frozen=True, slots=True)
class AskedFor:
    """Marks by what is asked; the rest as `Exercise` has it."""

    marks: Mapping[str, float]
    tolerance: float = TOLERANCE
    follow_through: bool = True
    not_live: float = NOT_LIVE


def asked_of(mechanism: Mechanism) -> AskedFor:
    """What a description asks for: by default every link angle, displacement and output, a mark each; not what drives and
    has its values in a column, nor the angle of a link that cannot turn, which `audit` would leave out too."""
    exercise = mechanism.exercise
    if exercise is not None:
        rules = exercise.tolerance, exercise.follow_through, exercise.not_live
        return AskedFor(exercise.asked or asked_of(replace(mechanism, exercise=None)).marks, *rules)
    names = [link.angle_symbol for link in mechanism.links[1:]]
    names += [joint.symbol for joint in mechanism.joints] + [output.symbol for output in mechanism.outputs]
    still = {equation.symbol for equation in solve(mechanism).all if not symbols(equation.expression)}
    given = {mechanism.driver.symbol, *mechanism.listed_symbols}
    return AskedFor({name: 1.0 for name in names if name not in given | still})


Array: TypeAlias = NDArray[np.float64]
Kind: TypeAlias = Literal["angle", "length", "number"]

STILL = 1e-9
"""What changes by less than this part of the size over the sweep does not move."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """One column of the mechanism, in radians and its length unit; NaN where it does not exist.

    points   those that it is between, where it is no column of the mechanism itself
    """

    name: str
    kind: Kind
    values: Array
    points: tuple[str, ...] = ()

    @property
    def spread(self) -> float:
        """How much it changes over the sweep; of an angle about that, whole turns aside."""
        found = self.values[np.isfinite(self.values)]
        if not len(found):
            return 0.0
        if self.kind == "angle":
            return float(np.ptp(np.sin(found)) + np.ptp(np.cos(found))) / 2
        return float(np.ptp(found))

    def moves(self, size: float) -> bool:
        """Whether it changes over the sweep."""
        if self.kind == "length":
            return self.spread > STILL * size
        return self.spread > STILL * max(1.0, float(np.nan_to_num(np.abs(self.values)).max(initial=0.0)))


@dataclass(frozen=True, slots=True)
class Span:
    """What a summary may be, in internal units: from the rows alone, to the extreme between the rows.

    own  the same where the sheet counts the column that it is taken from otherwise;  rows  what the rows alone give, as the
         sheet counts: what is told to be wanted
    """

    kind: Kind
    low: float
    high: float
    rows: float
    own: tuple[float, float] | None = None

    @property
    def quantity(self) -> Quantity:
        """What it is as a quantity, what the rows alone give last: what units and how much of a difference are allowed."""
        return Quantity("", self.kind, np.array([self.low, self.high, *(self.own or ()), self.rows]))


@dataclass(frozen=True, slots=True)
class Shift:
    """How a sheet counts a quantity: from another zero, in another turn, the other way round; internal units."""

    sense: int
    offset: float

    def counted(self, values: Array) -> Array:
        """The quantity's values as the sheet has them."""
        return self.sense * (values + self.offset)


@dataclass(frozen=True, slots=True)
class Truth:
    """A mechanism with numbers in place.

    dimensions   every dimension's value, internal units
    driver       the driver's values;  exists  in which rows it can be assembled
    columns      the quantities by symbol;  kinds  what each of them is
    poses        of the links in the first row that exists: what picks this assembly again
    shifts       how the sheet counts columns of which it does not say the quantity itself (`in_convention`)
    spans        what its summaries may be, once they are known (`summaries.span_of`)
    """

    mechanism: Mechanism
    dimensions: Mapping[str, float]
    driver: Array
    exists: NDArray[np.bool_]
    columns: Mapping[str, Array]
    kinds: Mapping[str, Kind]
    size: float
    poses: Mapping[str, tuple[float, float, float]] | None
    shifts: Mapping[str, Shift] = field(default_factory=dict)
    spans: dict[str, Span] = field(default_factory=dict, compare=False)

    def quantity(self, symbol: str) -> Quantity:
        """One of the columns."""
        return Quantity(symbol, self.kinds[symbol], self.columns[symbol])

    def summary(self, symbol: str) -> Summary:
        """One of the mechanism's summaries."""
        return next(one for one in self.mechanism.summaries if one.symbol == symbol)


def truth_of(
    mechanism: Mechanism,
    dimensions: Mapping[str, float],
    driver: Array,
    start: Mapping[str, tuple[float, float, float]] | None = None,
) -> Truth | None:
    """The mechanism at these driver values; None where it cannot be assembled anywhere, or has no places."""
    try:
        if start is None and mechanism.synthesis is not None:
            start = rough_poses(mechanism, solve(mechanism))  # the task says which assembly is meant, not a sketch
        solution = reference.solve(mechanism, dimensions, start=start, values=driver)
        columns = reference.variables(solution)
    except (MechanismError, FloatingPointError, np.linalg.LinAlgError):
        return None
    rows = np.flatnonzero(solution.exists)
    if not len(rows):
        return None
    cam = mechanism.cam
    if cam is not None:
        columns = reference.profile(solution, cam).columns | columns
    if cam is not None or (mechanism.driver.speed is not None and not mechanism.driver.speeds):
        columns = reference.by_time(solution) | columns
    columns = _without_poles(reference.forces(solution) | columns, mechanism, solution.size)
    poses = {name: tuple(map(float, pose[rows[0]])) for name, pose in solution.poses.items()}
    return Truth(
        mechanism,
        solution.dimensions,
        np.asarray(driver, float),
        solution.exists,
        columns,
        _kinds(mechanism, columns),
        solution.size,
        poses,  # type: ignore[arg-type]
    )


def _without_poles(columns: Mapping[str, Array], mechanism: Mechanism, size: float) -> dict[str, Array]:
    """The columns without the numbers of outputs where there is none but for rounding: of 1/tan(theta13) straight ahead."""
    found = dict(columns)
    for output in mechanism.outputs:
        most = reference.POLE * (size if output.unit.kind == "length" else 1.0)
        column = columns[output.symbol]
        found[output.symbol] = np.where(np.abs(column) < most, column, np.nan)
    return found


def kind_of(unit: str) -> Kind:
    """What a quantity is by the kind of its unit."""
    return "angle" if unit == "angle" else "length" if unit == "length" else "number"


def _kinds(mechanism: Mechanism, columns: Mapping[str, Array]) -> dict[str, Kind]:
    angles = {link.angle_symbol for link in mechanism.links}
    if not mechanism.driver.joint:
        angles.add(mechanism.driver.symbol)
    lengths = {joint.symbol for joint in mechanism.joints} | {name for name in columns if name.endswith((".x", ".y"))}
    if mechanism.cam is not None:
        angles.add("alpha")
        lengths |= {"contact", "rho"}
    if mechanism.driver.joint:
        lengths.add(mechanism.driver.symbol)
    units = {output.symbol: output.unit.kind for output in mechanism.outputs}

    def kind(symbol: str) -> Kind:
        if symbol in units:
            return kind_of(units[symbol])
        return "angle" if symbol in angles else "length" if symbol in lengths else "number"

    return {symbol: kind(symbol) for symbol in columns}


def driver_asked(mechanism: Mechanism, dimensions: Mapping[str, float]) -> Array | None:
    """The driver's values as the description asks for them; None where these dimensions give no rows."""
    try:
        return reference.driver_values(mechanism, dimensions)
    except (MechanismError, KeyError, ArithmeticError):
        return None


def other_assemblies(truth: Truth) -> list[Truth]:
    """The same mechanism put together in the other ways that there are in its first row."""
    row = int(np.flatnonzero(truth.exists)[0])
    return [
        other
        for other in all_assemblies(truth.mechanism, truth.dimensions, truth.driver, row)
        if not _same(other, truth)
    ]


def all_assemblies(mechanism: Mechanism, dimensions: Mapping[str, float], driver: Array, row: int) -> list[Truth]:
    """The mechanism in all the ways in which it can be put together in one of the rows."""
    value = float(driver[row])
    try:
        found = reference.assemblies(mechanism, dict(dimensions), value)
    except (MechanismError, FloatingPointError, np.linalg.LinAlgError):
        return []
    truths: list[Truth] = []
    for poses in found[:16]:
        truth = truth_of(mechanism, dimensions, driver, _from_here(mechanism, poses, value))
        if truth is not None and not any(_same(truth, one) for one in truths):
            truths.append(truth)
    return truths


def _from_here(
    mechanism: Mechanism, poses: Mapping[str, tuple[float, float, float]], value: float
) -> dict[str, tuple[float, float, float]]:
    """Poses as `solve` takes them: they tell the driver's value, the angles of the driven link as the driver counts them."""
    driver = mechanism.driver
    if driver.joint:
        return dict(poses)
    base = poses[driver.relative_to or mechanism.ground.name][2]
    x, y, angle = poses[driver.link]
    return {**poses, driver.link: (x, y, angle + math.tau * round((value + base - angle) / math.tau))}


EDGE = 1e-6
"""A row that is no more when the driver moves by this part of a step lies at a limit."""


def without_limits(truth: Truth) -> Truth:
    """The truth without what it says of rows at a limit: there rounding decides whether a formula has a value."""
    step = float(np.min(np.abs(np.diff(truth.driver)), initial=1.0)) or 1.0
    edge = np.zeros(len(truth.driver), bool)
    for side in (-EDGE, EDGE):
        beside = truth_of(truth.mechanism, truth.dimensions, truth.driver + side * step, truth.poses)
        edge |= truth.exists if beside is None else truth.exists & ~beside.exists
    if not edge.any():
        return truth
    driver = truth.mechanism.driver.symbol
    columns = {
        name: column if name == driver else np.where(edge, np.nan, column) for name, column in truth.columns.items()
    }
    return replace(truth, columns=columns, exists=truth.exists & ~edge, spans={})


def _same(one: Truth, other: Truth) -> bool:
    both = one.exists & other.exists
    if one.poses is None or other.poses is None:
        return False
    for symbol, column in one.columns.items():
        if symbol in other.columns and one.kinds[symbol] != "number":
            gap = np.abs(column[both] - other.columns[symbol][both])
            if one.kinds[symbol] == "angle":
                gap = np.abs(np.remainder(gap + math.pi, math.tau) - math.pi)
            if len(gap) and float(np.nanmax(gap, initial=0.0)) > 1e-6 * max(one.size, 1.0):
                return False
    return bool((one.exists == other.exists).all())


def vocabulary(truth: Truth) -> list[Quantity]:
    """What moves: the columns; of the points distances, directions, differences and the angles of three."""
    found = [truth.quantity(symbol) for symbol in truth.columns]
    curves = () if truth.mechanism.cam is None else truth.mechanism.cam.symbols
    points = sorted({symbol[:-2] for symbol in truth.columns if symbol.endswith(".x") and symbol not in curves})
    places = {point: (truth.columns[f"{point}.x"], truth.columns[f"{point}.y"]) for point in points}
    for p, q in itertools.combinations(points, 2):
        dx, dy = (places[q][axis] - places[p][axis] for axis in (0, 1))
        distance = np.hypot(dx, dy)
        found.append(Quantity(f"|{p}{q}|", "length", distance, (p, q)))
        found.append(Quantity(f"{q}.x-{p}.x", "length", dx, (p, q)))
        found.append(Quantity(f"{q}.y-{p}.y", "length", dy, (p, q)))
        direction = np.where(distance > STILL * truth.size, np.arctan2(dy, dx), np.nan)
        found.append(Quantity(f"∠{p}{q}", "angle", direction, (p, q)))
    found += _angles_of_three(points, places, truth.size)
    return [quantity for quantity in found if quantity.moves(truth.size)]


def _angles_of_three(points: Sequence[str], places: Mapping[str, tuple[Array, Array]], size: float) -> list[Quantity]:
    """The angle p q r at q; of mechanisms with many points those are too many to mean anything."""
    if len(points) > 8:
        return []
    found = []
    for q in points:
        for p, r in itertools.combinations([point for point in points if point != q], 2):
            arms = [(places[end][0] - places[q][0], places[end][1] - places[q][1]) for end in (p, r)]
            short = np.minimum(np.hypot(*arms[0]), np.hypot(*arms[1])) <= STILL * size
            cross = arms[0][0] * arms[1][1] - arms[0][1] * arms[1][0]
            dot = arms[0][0] * arms[1][0] + arms[0][1] * arms[1][1]
            angle = np.where(short, np.nan, np.arctan2(cross, dot))
            found.append(Quantity(f"∠{p}{q}{r}", "angle", angle, (p, q, r)))
    return found
