"""The profile of a cam: what a roller or a flat face on some link envelops, in the axes of the cam.

P is the roller's centre seen from the cam's, a prime the derivative by the cam's angle phi, s = 1 for a cam that turns
counter-clockwise and -1 for the other; J v = (-v_y, v_x), R(a) a turn by a. In the axes of the cam

    pitch curve   R(-s phi) P,  its tangent    T = P' - s J P,    its change    A = P'' - 2 s J P' - P
    curvature     kappa = -s (T x A)/|T|^3,    outwards    n = s J T/|T|,    profile    R(-s phi) (P - r n)
    pressure      tan alpha = -s f.T/(f x T)   where f is the way in which the follower moves P

A flat face lies along f through F, with normal g = J f. It touches where it does not move against the cam along g, at
F + x f, and the radius of curvature is that of the support function p = g.F over the normal's direction in the cam:

    x = (s F.f - F'.g)/(theta' - s),    rho = p + d^2p/dpsi^2 where p > 0, else its opposite,    psi' = theta' - s

How a place moves with the follower's variable v, while the cam stands: by the cam's angle every first derivative is linear
in v.d. So its derivative by v.d follows from the formulas that stand there already, and it is there at a dwell, too:

    dX/dv = sum of d(X.d)/d(Y.d) dY/dv,      dv/dv = 1

Source: R. L. Norton, Cam Design and Manufacturing Handbook, chapter 7; the support function: any text on convex curves; the
derivative by v: Soeylemez, Mechanisms, section 5.3 (virtual work).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, symbols
from livesheet.formula.vectors import Vector, cross, dot, minus, negative, over, plus, size, times, turned
from livesheet.said import Words
from mechsheet.kinematics.equations import CAM, RATES, Condition, Equation, Role
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.kinematics.poses import Poses
from mechsheet.kinematics.rates.motions import Motions, PointRate
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS, RateColumns
from mechsheet.model import BASE, Cam, FurtherDriver, Link, touched_by
from mechsheet.units import ANGLE, LENGTH, NUMBER, Unit
from mechsheet.words.equations import phrase


class ByFollower:
    """Writes the columns down that are read."""

    def __init__(self, follower: FurtherDriver, motions: Motions, columns: RateColumns) -> None:
        """`motions`: by the cam's angle, all of whose columns are written down."""
        self.follower, self.motions, self.columns = follower, motions, columns
        self._rates = {each.symbol: each for each in columns.ledger.columns if each.role in RATES}
        self._known: dict[str, Node] = {f"{follower.symbol}{COEFFICIENTS[0]}": al.ONE}

    def of_place(self, link: str, at: Vector) -> Vector:
        """How the place of a link moves that is at some coordinates now."""
        x, y = self.motions.motion[link](at).first
        return self._of(x), self._of(y)

    def of_angle(self, link: str) -> Node:
        """How a link turns."""
        return self._of(self.motions.turning[link].first)

    def _of(self, node: Node) -> Node:
        parts = [al.mul(derivative(node, name), self._of_symbol(name)) for name in symbols(node)]
        return al.total(part for part in parts if not al.is_zero(part))

    def _of_symbol(self, name: str) -> Node:
        if name not in self._known:
            equation = self._rates.get(name)  # what is no rate of a body is a place: it stands
            self._known[name] = al.ZERO if equation is None else self._column(equation)
        return self._known[name]

    def _column(self, equation: Equation) -> Node:
        node = self._of(equation.expression)
        if al.is_simple(node):
            return node
        ledger, variable = self.columns.ledger, self.follower.symbol
        symbol = equation.symbol.removesuffix(COEFFICIENTS[0])
        group, ledger.group = ledger.group, CAM
        base = f"{symbol.replace('.', '_')}_by_{variable}"
        unit = self.columns.per_length(equation.unit) if self.follower.joint else equation.unit
        label = phrase("by_follower", symbol=symbol, follower=variable)
        found: Symbol = self.columns.define(base, self.columns.within(node, base, unit, label), unit, label)
        ledger.group = group
        return found


STRAIGHT = 1e-9
"""A curvature below this part of one over the largest length is that of a straight line, which has no radius."""

RESTING = 1e-9
"""A point that moves by less than this part of the largest length in a radian of the follower, or by less than this part
of the follower's way, shows no direction."""


SELF_LOCKED = 1e-5
"""A cosine of the pressure angle below this is that of a force that cannot move what it presses on; as at a dead centre."""


@dataclass(frozen=True, slots=True)
class Contact:
    """Where the cam presses, for those who find how hard.

    cam, link  its link, and the one that it presses on, at `at` along `normal`, out of the cam
    follower  the variable of what the cam's motion drives
    direct  whether that drives the link on the ground; else other links lie between
    lever   how far the force goes along the normal with that variable: no number in rows in which it could not move it
    least   what moves by less with that variable counts as standing
    moved   how the place of a link moves with that variable that is at some coordinates;  turned: how a link turns
    """

    cam: str
    link: str
    follower: str
    at: Vector
    normal: Vector
    direct: bool
    lever: Node
    least: Node
    moved: Callable[[str, Vector], Vector]
    turned: Callable[[str], Node]


def write_cam(poses: Poses, motions: Motions, columns: RateColumns) -> Contact | None:
    """Write the cam's columns down, behind those of rates; where it presses, None where there is no cam."""
    cam, follower = poses.mechanism.cam, poses.mechanism.follower
    touched = None if cam is None else touched_by(cam, poses.mechanism.links)
    if cam is None or follower is None or touched is None:
        return None
    group, poses.ledger.group = poses.ledger.group, CAM
    contact = _Writer(cam, follower, touched, poses, motions, columns).write()
    poses.ledger.group = group
    return contact


class _Writer:
    def __init__(
        self, cam: Cam, follower: FurtherDriver, touched: Link, poses: Poses, motions: Motions, columns: RateColumns
    ) -> None:
        self.follower = follower
        self.cam, self.poses, self.motions, self.columns = cam, poses, motions, columns
        self.ledger: Ledger = poses.ledger
        self.phi = Symbol(poses.mechanism.driver.symbol)
        self.touching = touched
        self.by_follower = ByFollower(follower, motions, columns)

    def write(self) -> Contact:
        """The columns of a roller, or those of a face."""
        point = self.cam.point
        moved = self.motions.of_point(point, self.columns.length)
        place = minus(self.poses.xy[point], self.poses.xy[self.cam.center])
        if self.cam.radius is None:
            return self._face(place, moved)
        return self._roller(place, moved, self.cam.radius)

    def _roller(self, place: Vector, moved: PointRate, radius: Node | float) -> Contact:
        tangent = self._vector("T", minus(moved.first, self._with_cam(turned(place))))
        change = minus(minus(moved.second, self._with_cam(times(al.TWO, turned(moved.first)))), place)
        long = self._inner("T", size(tangent), LENGTH)
        curved = self._sense(al.neg(cross(tangent, change)))
        kappa = self._define("kappa", al.div(curved, Binary("^", long, Number(3.0))), self._per_length())
        outwards = self._with_cam(turned(tangent))
        part = al.div(al.as_node(radius), long)
        self._curve("pitch", place)
        self._curve("cam", place if al.is_zero(part) else minus(place, times(part, outwards)))
        way = self._way(self.poses.xy[self.cam.point])
        self._alpha(self._sense(al.neg(dot(way, tangent))), cross(way, tangent), way)
        if self.cam.offset is not None:
            self._base(Call("ABS", (dot(place, way),)), al.as_node(radius), al.as_node(self.cam.offset))
        there = Condition(Call("ABS", (al.mul(kappa, self.ledger.size()),)), Number(STRAIGHT))
        self._define("rho", al.sub(al.div(al.ONE, kappa), al.as_node(radius)), LENGTH, there)
        x, y = (over(part, long) for part in outwards)
        return self._contact(self.poses.xy[self.cam.point], (x, y), way)

    def _base(self, far: Node, roller: Node, offset: Node) -> None:
        """The base circle with which the roller of a slide would be pressed at the usual angle: |s' - e| = u tan alpha stays
        what it is, so u, how far the roller has come along its slide, has to grow by u (tan alpha/tan usual - 1)."""
        usual = Call("TAN", (al.as_node(self.cam.pressure_angle),))
        steep = al.div(Call("TAN", (Call("ABS", (Symbol("alpha"),)),)), usual)
        aside = al.square(offset)
        begun = al.sqrt(al.sub(al.square(al.add(al.as_node(self.cam.base_radius), roller)), aside))
        grown = Call("MAX", (al.ZERO, al.add(begun, al.mul(far, al.sub(steep, al.ONE)))))
        self._define(BASE, al.sub(al.sqrt(al.add(al.square(grown), aside)), roller), LENGTH)

    def _face(self, place: Vector, moved: PointRate) -> Contact:
        link = self.cam.follower
        angle = self.poses.known[link].angle + angle_of(self.cam.face)
        along: Vector = (al.cos(angle), al.sin(angle))
        normal = turned(along)
        turning = self.motions.turning[link]
        one = al.neg(al.ONE) if self.cam.clockwise else al.ONE
        turned_by = al.sub(turning.first, one)  # how fast the face turns in the cam
        there = Condition(Call("ABS", (turned_by,)), Number(STRAIGHT))
        forth, across = dot(place, along), self._inner("p", dot(place, normal), LENGTH)
        moves = self._inner("p'", al.sub(dot(moved.first, normal), al.mul(turning.first, forth)), LENGTH)
        contact = self._define(
            "contact",
            al.neg(al.add(forth, al.div(moves, turned_by))),
            LENGTH,
            *(() if al.value_of(turned_by) is not None else (there,)),
        )
        touched = self._curve("cam", plus(place, times(contact, along)))
        way = self._way(plus(self.poses.xy[self.cam.point], times(contact, along)))
        self._alpha(self._sense(dot(way, along)), dot(way, normal), way)
        second = al.sub(
            al.sub(dot(moved.second, normal), al.mul(al.square(turning.first), across)),
            al.add(al.mul(turning.second, forth), al.mul(al.mul(al.TWO, turning.first), dot(moved.first, along))),
        )
        bent = al.div(
            al.sub(al.mul(second, turned_by), al.mul(moves, turning.second)), Binary("^", turned_by, Number(3.0))
        )
        outside = Call("SIGN", (across,))
        self._define("rho", al.mul(outside, al.add(across, bent)), LENGTH)
        return self._contact(plus(touched, self.poses.xy[self.cam.center]), times(outside, normal), way)

    def _contact(self, at: Vector, normal: Vector, way: Vector) -> Contact:
        link, variable = self.touching.name, self.follower.symbol
        lever, direct = dot(normal, way), self._moved_directly(at) is not None
        if not direct and self.poses.mechanism.dynamics is not None:
            pushes = Condition(Call("ABS", (lever,)), al.mul(Number(SELF_LOCKED), size(way)))
            lever = self._inner("lever", lever, self._unit_of_way(), exists=(pushes,))
        turned = self.by_follower.of_angle
        return Contact(self.cam.link, link, variable, at, normal, direct, lever, self._resting(), self._moved, turned)

    # --- how the follower presses ----------------------------------------------------------------------------------

    def _alpha(self, aside: Node, forth: Node, way: Vector) -> None:
        """Between the normal and the way in which the place that is touched moves: that of a roller is its centre."""
        exists: tuple[Condition, ...] = ()
        if self._moved_directly(self.poses.xy[self.cam.point]) is None:
            exists = (Condition(size(way), self._resting()),)
        self._define("alpha", Call("ATAN", (al.div(aside, forth),)), ANGLE, *exists)

    def _way(self, at: Vector) -> Vector:
        """The direction in which the place moves that is touched at these coordinates.

        It is the way that goes with the follower's variable, so that a dwell has one, too. Of a slide or a rocker on the
        ground it is that of the joint; where other links lie between there may be none in their dead centre.
        """
        direct = self._moved_directly(at)
        if direct is not None:
            return direct
        return self._vector("V", self.by_follower.of_place(self.touching.name, at), self._unit_of_way())

    def _resting(self) -> Node:
        """What moves by less with the follower's variable shows no direction."""
        return Number(RESTING) if self.follower.joint else al.mul(Number(RESTING), self.ledger.size())

    def _unit_of_way(self) -> Unit:
        return NUMBER if self.follower.joint else LENGTH

    def _moved(self, link: str, at: Vector) -> Vector:
        """How the place of a link moves with the follower's variable that is at some coordinates."""
        found = self._moved_directly(at) if link == self.touching.name else None
        return self.by_follower.of_place(link, at) if found is None else found

    def _moved_directly(self, at: Vector) -> Vector | None:
        """Of the link that is touched; None where that variable does not drive it on the ground."""
        mechanism, follower, touching = self.poses.mechanism, self.follower, self.touching.name
        ground = mechanism.ground
        joint = next((one for one in mechanism.joints if one.name == follower.joint), None)
        if joint is not None and joint.kind == "prismatic" and {joint.link, joint.on} == {touching, ground.name}:
            line = self.poses.known[joint.on].angle + angle_of(joint.angle)
            along: Vector = (al.cos(line), al.sin(line))
            return along if joint.link == touching else negative(along)
        if follower.link == touching and follower.relative_to == ground.name:
            pivot = next(point for point in self.touching.points if point in ground.points)
            return turned(minus(at, self.poses.xy[pivot]))
        return None

    # --- what they share -------------------------------------------------------------------------------------------

    def _sense(self, node: Node) -> Node:
        return al.neg(node) if self.cam.clockwise else node

    def _with_cam(self, vector: Vector) -> Vector:
        return negative(vector) if self.cam.clockwise else vector

    def _curve(self, name: str, place: Vector) -> Vector:
        """A place, seen from the cam's centre, in the axes of the cam; the same over its columns in those of the ground."""
        x, y = self._vector(name, place) if name == "cam" else place
        c, s = Call("COS", (self.phi,)), self._sense(Call("SIN", (self.phi,)))
        self._define(f"{name}.x", al.add(al.mul(x, c), al.mul(y, s)), LENGTH)
        self._define(f"{name}.y", al.sub(al.mul(y, c), al.mul(x, s)), LENGTH)
        return x, y

    def _vector(self, name: str, vector: Vector, unit: Unit = LENGTH) -> Vector:
        """Both parts in columns of their own where they are no short sums."""
        found = [self._inner(f"{name}_{axis}", part, unit, axis) for axis, part in zip("xy", vector, strict=True)]
        return found[0], found[1]

    def _inner(self, name: str, node: Node, unit: Unit, axis: str = "", exists: tuple[Condition, ...] = ()) -> Node:
        if al.is_simple(node):
            return node
        key = name.rstrip("_xy").rstrip("'")
        label = phrase(f"cam_{key}", axis=axis)
        return self._written(
            self.ledger.reserve(name.replace("'", "_d"), numbered=False), node, unit, label, "coefficient", *exists
        )

    def _define(self, name: str, node: Node, unit: Unit, *exists: Condition) -> Symbol:
        key, _, axis = name.partition(".")
        return self._written(name, node, unit, phrase(f"cam_is_{key}", axis=axis), "rate", *exists)

    def _written(self, name: str, node: Node, unit: Unit, label: Words, role: Role, *exists: Condition) -> Symbol:
        return self.ledger.define(name, node, unit, label, role, exists)

    def _per_length(self) -> Unit:
        length = self.poses.mechanism.length_unit
        return Unit("number", f"1/{length}") if length else NUMBER
