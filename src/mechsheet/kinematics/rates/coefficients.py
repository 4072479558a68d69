"""Velocities and accelerations as equations: influence coefficients of every group, then the rates that people read.

A coefficient is a derivative by the driver's variable, `theta13.d`, `theta13.dd`: it depends on the position alone. A dyad's
two follow from two linear equations (`motions`), by Cramer's rule,

    q1' = u x w2 / D,    q2' = w1 x u / D,    q1'' = k x w2 / D,    q2'' = w1 x k / D,    D = w1 x w2

(or with the opposite signs in all of them), where w is the velocity of the closing point per unit of q', u what the known
side moves, k what is left of the second derivative. Then omega = q' omega12 and alpha = q'' omega12^2 + q' alpha12. D is
what vanishes at a dead centre, written with what the positions have: a3 a4 sin(mu), w, or the sine between two lines.
Source: Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, section 3.12 (kinematic coefficients).
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field, replace

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, symbols, with_symbols
from livesheet.formula.vectors import Vector, cross, minus, size
from livesheet.said import Words, say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.assur import Drive, Dyad, Order
from mechsheet.kinematics.cams.profile import Contact, write_cam
from mechsheet.kinematics.dyads.solved import Determinant, Solved
from mechsheet.kinematics.equations import Fit
from mechsheet.kinematics.gear_relations import Held, Tied, solved_for
from mechsheet.kinematics.graph import Slide
from mechsheet.kinematics.newton.chains import Chain
from mechsheet.kinematics.newton.newton_equations import Solution
from mechsheet.kinematics.newton.rates import ChainColumns, Closings, known_pins, without
from mechsheet.kinematics.poses import Poses
from mechsheet.kinematics.rates.motions import Meeting, Motions, PointRate, Rate
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS, LONGEST, RateColumns, order_words
from mechsheet.model import POINT_RATES, FurtherDriver, Mechanism, rate_symbols
from mechsheet.units import LENGTH, RAD, Unit
from mechsheet.words.equations import link_words, phrase

INLINE = 75
"""Characters of a point's rate that is written where it is read."""

SHORT = 30
"""Characters of a constant coefficient that is written where it is read."""


def asked(mechanism: Mechanism) -> dict[str, None]:
    """Every symbol that an output, a summary, a chart or a line of the first sheet reads."""
    found = dict.fromkeys(name for output in mechanism.outputs for name in symbols(output.formula))
    found |= dict.fromkeys(summary.of for summary in mechanism.summaries)
    for load in mechanism.dynamics.loads if mechanism.dynamics else ():
        found |= dict.fromkeys(name for part in (*(load.force or ()), load.torque) if part for name in symbols(part))
    for chart in mechanism.charts:
        found |= dict.fromkeys(f"{point}.v{axis}" for point in chart.hodographs for axis in "xy")
    found |= dict.fromkeys(link.rate_symbols[1] for link in mechanism.assumed_inertia)
    return found | dict.fromkeys(name for chart in mechanism.charts for name in (chart.x, *chart.y) if name)


def wanted(mechanism: Mechanism) -> bool:
    """Whether a mechanism has velocities, or at least derivatives by its driver: virtual work needs them."""
    return (
        mechanism.dynamics is not None
        or mechanism.driver.speed is not None
        or mechanism.follower is not None
        or any(name.endswith((".d", ".dd")) for name in asked(mechanism))
    )


def free_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points of a single moving link, at which nothing is joined."""
    at: dict[str, int] = {}
    for link in mechanism.links:
        for point in link.points:
            at[point] = at.get(point, 0) + 1
    joined = {joint.point for joint in mechanism.joints} | set(mechanism.ground.points)
    return tuple(point for point, count in at.items() if count == 1 and point not in joined)


def points_of(mechanism: Mechanism) -> dict[str, None]:
    """Points whose rates are wanted: those that the description names, those whose rates are read."""
    if mechanism.driver.speed is None:
        return {}
    own = mechanism.rate_points
    if own is None:
        fixed = mechanism.ground.points
        charted = [point for chart in mechanism.charts for point in chart.paths if point not in fixed]
        own = tuple(charted) or free_points(mechanism)
    found = dict.fromkeys(own)
    moving = {point for link in mechanism.links[1:] for point in link.points}
    for name in asked(mechanism):
        point, _, part = name.partition(".")
        if part in POINT_RATES and point in moving:
            found[point] = None
    return found


def primed(symbol: str) -> Rate:
    """Both coefficients of a symbol."""
    return Rate(Symbol(f"{symbol}.d"), Symbol(f"{symbol}.dd"))


class _ByDriver:
    """Derivatives by the driver's variable; `driven`: those of what is driven."""

    def __init__(self, driver: str) -> None:
        self.points: dict[str, PointRate] = {}
        self.unknown: dict[str, None] = {}
        self.driven = {driver: Rate(al.ONE, al.ZERO)}

    def of_drive(self, symbol: str) -> Rate:
        return self.driven[symbol]

    def of(self, symbol: str) -> Rate:
        self.unknown |= dict.fromkeys(f"{symbol}{part}" for part in COEFFICIENTS)
        return primed(symbol)

    def of_relative(self, symbol: str) -> Rate:
        return self.of(symbol)

    def of_point(self, point: str) -> PointRate | None:
        return self.points.get(point)


class _ByTime:
    """Derivatives by time, over velocities and accelerations that have columns; `driven`: those of what is driven."""

    def __init__(self, mechanism: Mechanism, points: Mapping[str, PointRate], driven: Mapping[str, Rate]) -> None:
        self.driven, self.driver = driven, driven[mechanism.driver.symbol]
        self.angles = {link.angle_symbol for link in mechanism.links}
        self.slides = {joint.symbol for joint in mechanism.joints}
        self.points = points

    def of_drive(self, symbol: str) -> Rate:
        return self.driven[symbol]

    def of(self, symbol: str) -> Rate:
        if symbol not in self.angles | self.slides:  # the angle of a block, which has no columns by time
            return self.of_relative(symbol)
        return Rate(*(Symbol(name) for name in rate_symbols(symbol, symbol in self.angles)))

    def of_relative(self, symbol: str) -> Rate:
        return primed(symbol).by_time(self.driver)

    def of_point(self, point: str) -> PointRate | None:
        found = self.points.get(point)
        return None if found is None else found.by_time(self.driver)


@dataclass(frozen=True, slots=True)
class _Cramer:
    """Two linear equations: the vectors of the unknowns, and what the known sides differ by."""

    first: Vector
    second: Vector
    right: Vector

    def solved(self, right: Vector, det: Determinant) -> tuple[Node, Node]:
        """Both unknowns, `right` standing for the right side."""
        one, other = (cross(right, self.second), cross(self.first, right))
        if det.turned:
            one, other = cross(self.second, right), cross(right, self.first)
        return al.div(one, det.node), al.div(other, det.node)


@dataclass(frozen=True, slots=True)
class Written:
    """What has been written: `fits` and `turning` see `Equations`.

    by_driver     the motion of every body by the driver's variable;  by_time: by time, None for a driver without a speed
    determinants  by number of the group what its rates are divided by
    contact       where a cam presses
    """

    fits: Mapping[int, Fit]
    turning: Mapping[str, tuple[Node, Node]]
    by_driver: Motions | None = None
    by_time: Motions | None = None
    determinants: Mapping[int, Node] = field(default_factory=dict)
    contact: Contact | None = None


def add_rates(poses: Poses, order: Order, solved: Sequence[Solved], chains: Mapping[int, Solution]) -> Written:
    """Write all equations of velocities and accelerations down, behind those of positions.

    solved  each group;  chains  by its number each one that Newton's method solves
    """
    return _Writer(poses, order, solved, chains).write()


class _Writer:
    def __init__(self, poses: Poses, order: Order, solved: Sequence[Solved], chains: Mapping[int, Solution]) -> None:
        self.poses, self.order, self.solved, self.chains = poses, order, solved, chains
        self.mechanism, self.ledger = poses.mechanism, poses.ledger
        self.timed = self.mechanism.driver.speed is not None
        self.asked = asked(self.mechanism)
        self.points = points_of(self.mechanism)
        self.names = _ByDriver(self.mechanism.driver.symbol)
        self.columns = RateColumns(self.mechanism, self.ledger, self.names.unknown.keys())
        self.determinants: dict[int, Node] = {}
        self.shown: set[Node] = {al.ZERO, al.ONE}
        self.ledger.group = 0
        self.motions = Motions(poses, order, self.names)
        self.pairs: dict[Drive, Motions] = {}

    def write(self) -> Written:
        self._driver()
        self._further_drivers()
        clustered = _clustered(self.order)  # of which some may be further drivers
        self.pairs = {drive: Motions(self.poses, self.order, self.names, drive) for drive in clustered}
        for step in self.order.steps:
            match step:
                case Drive():
                    self.motions.drive(step)
                case Tied():
                    self._tie(step)
                case Dyad():
                    self.ledger.group += 1
                    self._dyad(step, self.solved[self.ledger.group - 1])
                case Chain():
                    self.ledger.group += 1
                    self._chain(self.chains[self.ledger.group])
            self._after_group()
        contact = write_cam(self.poses, self.motions, self.columns)
        found = self._by_time_alone() if self.timed else Written({}, {})
        return replace(found, by_driver=self.motions, determinants=self.determinants, contact=contact)

    # --- the driver -------------------------------------------------------------------------------------------

    def _driver(self) -> None:
        """Its speed and acceleration, where they differ from row to row."""
        driver = self.mechanism.driver
        if driver.speed is None or driver.acceleration is None:
            return
        names = self.mechanism.driver_rates
        for order, (name, node) in enumerate(zip(names, (driver.speed, driver.acceleration), strict=True), 1):
            if node != Symbol(name):
                label = phrase("driver_speed" if order == 1 else "driver_acceleration")
                self.ledger.define(name, node, self._rate_unit(not driver.joint, order), label, "rate")

    def _further_drivers(self) -> None:
        """How what is driven besides moves with the driver. Raises MechanismError where a list of values does not say."""
        own = self.mechanism.driver.symbol
        follows: dict[str, Node] = {}
        for driver in self.mechanism.drivers:
            if driver.values:
                message = say(
                    "{symbol} is a list of values, which says nothing of its speed", symbol=f'"{driver.symbol}"'
                )
                hint = say("write `follows` in place of `values`, or take masses, loads and derivatives away")
                raise MechanismError(Fault(message, key=f"drivers.{driver.order}.values", hint=hint))
            if driver.segments is not None:
                self._follower(driver)
                continue
            if driver.follows is None:
                continue
            node = with_symbols(driver.follows, follows)
            follows[driver.symbol] = node
            first = derivative(node, own)
            rate = Rate(first, derivative(first, own))
            self.names.driven[driver.symbol] = self._in_columns(driver.symbol, rate, not driver.joint)

    def _follower(self, driver: FurtherDriver) -> None:
        """What a cam moves: its derivatives by the cam's angle, and where the cam turns evenly its jerk."""
        symbol, turns = driver.symbol, not driver.joint
        for order, (node, name) in enumerate(zip(self.ledger.ways[symbol], driver.by_angle, strict=True), 1):
            unit = self.columns.unit(0 if turns else 1, order)
            self.ledger.define(name, node, unit, phrase(f"by_cam_{order}", symbol=symbol), "rate")
        self.names.driven[symbol] = self.names.of(symbol)
        if not self.timed:
            return
        self._rates(symbol, self.names.of(symbol), turns)
        speed, acceleration = self._driven.both
        if self.ledger.is_constant(speed) and self.ledger.is_constant(acceleration):
            change = al.mul(al.mul(Number(3.0), Symbol(f"{symbol}.dd")), al.mul(speed, acceleration))
            jerk = al.add(al.mul(Symbol(f"{symbol}.ddd"), Binary("^", speed, Number(3.0))), change)
            unit = self._rate_unit(turns, 2).per_time()
            self.ledger.define(f"{symbol}.j", jerk, unit, phrase("jerk", symbol=symbol), "rate")

    def _in_columns(self, symbol: str, rate: Rate, turns: bool) -> Rate:
        """Coefficients in cells of their own where they are no short constants; and the rates by time, that people read."""
        if all(self.ledger.is_constant(node) and self.columns.length(node) <= SHORT for node in rate.both):
            own = rate
        else:
            for order, node in enumerate(rate.both, 1):
                self.columns.coefficient(symbol, order, node, turns)
            own = self.names.of(symbol)
        if self.timed:
            self._rates(symbol, own, turns)
        return own

    def _tie(self, tied: Tied) -> None:
        """What gears and racks decide: they tie rates as they tie angles and displacements, without the phase."""

        def slid(symbol: str) -> Rate:
            return self.names.driven.get(symbol) or self.names.of(symbol)

        first = solved_for(tied, lambda name: self.motions.of_tie(name, slid).first, self.ledger.number, False)
        second = solved_for(tied, lambda name: self.motions.of_tie(name, slid).second, self.ledger.number, False)
        rates = {}
        for held in tied.bodies:
            turns = not isinstance(held.at, Slide)
            symbol = self._symbol(held)
            rates[held.variable] = self._in_columns(symbol, Rate(first[held.variable], second[held.variable]), turns)
        self.motions.tie(tied, rates)

    def _symbol(self, held: Held) -> str:
        """Of what a gear or a rack decides."""
        return held.variable if isinstance(held.at, Slide) else self.poses.links[held.body].angle_symbol

    def _rate_unit(self, turns: bool, order: int) -> Unit:
        unit = (RAD if turns else LENGTH).per_time()
        return unit if order == 1 else unit.per_time()

    # --- a group ----------------------------------------------------------------------------------------------

    def _dyad(self, dyad: Dyad, solved: Solved) -> None:
        if dyad.frame:
            meeting = self.pairs[self.order.pair(dyad.frame)].meet_within(dyad)
            self.columns.angles.update(meeting.unknowns)
            once, twice = (self._cramer(meeting, order) for order in (1, 2))
            self._solve(solved, meeting, once, twice, timed=False)
            return
        for force in (False, True):
            meeting = self.motions.meet(dyad, {pin: self._outer(pin, force) for pin in dyad.outer_pins})
            once, twice = (self._cramer(meeting, order) for order in (1, 2))
            longest = max(map(self.columns.length, (*once.right, *twice.right)))
            if longest <= LONGEST:
                break
        self._solve(solved, meeting, once, twice)

    def _chain(self, solution: Solution) -> None:
        known = {pin: self._outer(pin, False) for pin in known_pins(self.motions, solution)}
        closings = Closings(self.motions, solution, known).write()
        self.determinants[self.ledger.group], symbols_found = ChainColumns(
            self.columns, solution.system, closings, self.names.points
        ).write()
        shown = {joint.symbol for joint in self.mechanism.joints} | {link.angle_symbol for link in self.mechanism.links}
        for name in symbols_found if self.timed else ():
            if name in shown:  # but the angle of a massless block
                self._rates(name, primed(name), name in self.columns.angles)

    def _outer(self, point: str, force: bool) -> PointRate:
        """The rates of an outer pin, as columns where they are long."""
        found = self.motions.of_point(point, self.columns.length)
        parts = (*found.first, *found.second)
        if max(map(self.columns.length, parts)) > INLINE or (force and not all(map(al.is_simple, parts))):
            found = self._columns_of(point, found)
        return found

    def _cramer(self, meeting: Meeting, order: int) -> _Cramer:
        """The equations of the first or of the second coefficients."""
        unknowns = [f"{symbol}{COEFFICIENTS[order - 1]}" for symbol in meeting.unknowns]
        left, right = (way.of(order) for way in meeting.ways)
        columns = []
        for name in unknowns:
            parts = [al.sub(derivative(a, name), derivative(b, name)) for a, b in zip(left, right, strict=True)]
            columns.append((parts[0], parts[1]))
        known = minus(without(right, unknowns), without(left, unknowns))
        return _Cramer(columns[0], columns[1], known)

    def _solve(self, solved: Solved, meeting: Meeting, once: _Cramer, twice: _Cramer, timed: bool = True) -> None:
        """D, both first coefficients, k, both second ones; then the rates."""
        det = self._determinant(solved.determinant)
        self.determinants[self.ledger.group] = det.node
        names = meeting.unknowns
        u = self._short(once, det)
        for name, node in zip(names, once.solved(u, det), strict=True):
            self.columns.coefficient(name, 1, node)
        k = self._hoisted(twice.right, "k", 2)
        for name, node in zip(names, twice.solved(k, det), strict=True):
            self.columns.coefficient(name, 2, node)
        if self.timed and timed:
            for name in names:
                self._rates(name, primed(name), name in self.columns.angles)

    def _determinant(self, given: Determinant) -> Determinant:
        """D as a column that has no value at a dead centre; a number where the lines keep their angle."""
        if given.dead is None:
            return given
        column = self.columns.define(
            "D", given.node, self.columns.unit(given.lengths), phrase("determinant"), given.dead
        )
        return replace(given, node=column)

    def _short(self, once: _Cramer, det: Determinant) -> Vector:
        """The right side where it is read, as columns where the formulas would become long."""
        longest = max(self.columns.length(node) for node in once.solved(once.right, det))
        return once.right if longest <= LONGEST else self._hoisted(once.right, "u", 1)

    def _hoisted(self, right: Vector, base: str, order: int) -> Vector:
        words = order_words(order)
        return self.columns.hoist_vector(base, right, order, lambda axis: phrase("known_side", axis=axis, order=words))

    def _rates(self, symbol: str, own: Rate, turns: bool, only: Container[str] | None = None) -> None:
        """omega, alpha of an angle, which `turns`; velocity and acceleration of a displacement. `only`: those of them."""
        names, by_time = rate_symbols(symbol, turns), own.by_time(self._driven)
        for order, (name, node) in enumerate(zip(names, by_time.both, strict=True), 1):
            if only is None or name in only:
                words = self._rate_words(symbol, turns, order)
                self.ledger.define(name, node, self._rate_unit(turns, order), words, "rate")

    def _rate_words(self, symbol: str, turns: bool, order: int) -> Words:
        if not turns:
            return phrase("sliding_velocity" if order == 1 else "sliding_acceleration", symbol=symbol)
        link = next((link for link in self.mechanism.links if link.angle_symbol == symbol), None)
        if link is None:  # driven against another link than the ground, or called otherwise, as a cam's angle
            link = next(
                self.poses.links[driver.link] for driver in self.mechanism.all_drivers if driver.symbol == symbol
            )
        key = "angular_velocity" if order == 1 else "angular_acceleration"
        return phrase(key, number=str(link.number), link=link_words(link))

    @property
    def _driven(self) -> Rate:
        """The driver's speed and acceleration."""
        speed, acceleration = self.mechanism.driver_rates
        return Rate(Symbol(speed), Symbol(acceleration))

    # --- points, and what is asked for by name ----------------------------------------------------------------

    def _after_group(self) -> None:
        """Points that are wanted and solved now, and rates that are another's but are read by a name of their own."""
        for point in list(self.points):
            bodies = self.poses.graph.bodies_at(point)
            if any(body in self.motions.motion for body in bodies):
                self._point(point)
                del self.points[point]
        for link in self.mechanism.links[1:]:
            if link.name in self.motions.turning:
                self._other_names(link.angle_symbol, self.motions.turning[link.name], True)
        driver = self.mechanism.driver
        if driver.joint or driver.symbol not in self.columns.angles:
            self._other_names(driver.symbol, Rate(al.ONE, al.ZERO), not driver.joint)

    def _other_names(self, symbol: str, own: Rate, turns: bool) -> None:
        for order, node in enumerate(own.both, 1):
            name = f"{symbol}{COEFFICIENTS[order - 1]}"
            if name in self.asked and name not in self.ledger.values:
                self.columns.coefficient(symbol, order, node)
        if not self.timed:
            return
        own_column = turns and not al.is_simple(own.first) and own.first not in self.shown
        self.shown.add(own.first)
        names = [name for name in rate_symbols(symbol, turns) if name in self.asked or own_column]
        self._rates(symbol, own, turns, only={name for name in names if name not in self.ledger.values})

    def _columns_of(self, point: str, found: PointRate) -> PointRate:
        """A point's coefficients as columns."""
        known = PointRate(*(self.columns.point(point, order, found.of(order)) for order in (1, 2)))
        self.names.points[point] = known
        return known

    def _point(self, point: str) -> None:
        """A point's velocity and acceleration."""
        known = self.names.of_point(point)
        if known is None:
            known = self._columns_of(point, self.motions.of_point(point, self.columns.length))
        rates = known.by_time(self._driven)
        for letter, order, vector in (("v", 1, rates.first), ("a", 2, rates.second)):
            unit = self._rate_unit(False, order)
            for axis, node in zip("xy", vector, strict=True):
                name = f"{point}.{letter}{axis}"
                if name in self.asked:
                    label = phrase(f"point_{letter}_part", point=point, axis=axis)
                    self.ledger.define(name, node, unit, label, "rate")
            squares = known.first if order == 1 else vector
            node = al.mul(Call("ABS", (self._driven.first,)), size(squares)) if order == 1 else size(squares)
            self.ledger.define(f"{point}.{letter}", node, unit, phrase(f"point_{letter}", point=point), "rate")

    # --- do they fit? -----------------------------------------------------------------------------------------

    def _by_time_alone(self) -> Written:
        """How fast each link turns; of each group by how much its two ways to the closing point differ."""
        names = {self.mechanism.driver.symbol: self._driven}
        for driver in self.mechanism.drivers:
            names[driver.symbol] = Rate(*(Symbol(name) for name in rate_symbols(driver.symbol, not driver.joint)))
        by_time = _ByTime(self.mechanism, self.names.points, names)
        motions = Motions(self.poses, self.order, by_time)
        pairs = {drive: Motions(self.poses, self.order, by_time, drive) for drive in self.pairs}
        found = {}
        number = 0
        for dyad in self.order.steps:
            if isinstance(dyad, Drive):
                motions.drive(dyad)
                continue
            if isinstance(dyad, Tied):
                motions.tie(dyad, {held.variable: by_time.of(self._symbol(held)) for held in dyad.bodies})
                continue
            number += 1
            if isinstance(dyad, Chain):
                found[number] = self._fit_of_chain(motions, self.chains[number])
                continue
            if dyad.frame:
                meeting = pairs[self.order.pair(dyad.frame)].meet_within(dyad)
            else:
                pins = {pin: motions.of_point(pin, self.columns.length) for pin in dyad.outer_pins}
                meeting = motions.meet(dyad, pins)
            left, right = meeting.ways
            found[number] = Fit(minus(left.first, right.first), minus(left.second, right.second))
        turning = {link.angle_symbol: motions.turning[link.name].both for link in self.mechanism.links[1:]}
        return Written(found, turning, by_time=motions)

    def _fit_of_chain(self, motions: Motions, solution: Solution) -> Fit:
        """At the second end of each link between two carriers, at each pin that closes a loop."""
        known = {pin: motions.of_point(pin, self.columns.length) for pin in known_pins(motions, solution)}
        gaps = [closing.gap for closing in Closings(motions, solution, known).write()]
        return Fit(
            tuple(part for gap in gaps for part in gap.first), tuple(part for gap in gaps for part in gap.second)
        )


def _clustered(order: Order) -> list[Drive]:
    """Driven pairs with which dyads move."""
    return list(dict.fromkeys(order.pair(dyad.frame) for dyad in order.dyads if dyad.frame))
