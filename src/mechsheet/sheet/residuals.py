"""What the sheet of checks measures in every row: what a person could do with ruler and protractor.

For every row that exists: the distance of the points of each link against its length; the gap at its joints when the link
is laid down by its base point and its angle (closure of the loops); the gap at each sliding joint, and the angle that it
keeps; the farthest move of a point and the largest turn of a link since the row before, and whether that is a leap. Lengths
and places come from the description (`geometry`), not from the equations, and values from the columns that people read.

A leap: between two rows that exist a point moves more than `LEAP` times as far, or a link turns more than `LEAP` times as
much, as in the step before and in the step after; or a link turns by more than half a turn. At a limit position, where a
link moves as the square root of the driver, neighbouring steps differ by a factor of 2.4 at most.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, Text, shifted
from mechsheet.kinematics.naming import link_words
from mechsheet.kinematics.places import angle_of, length_node
from mechsheet.model import Distances, Joint, Link
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.gaps import gap_of
from mechsheet.sheet.geometry import UV, Known, base_point, distance, measured_pairs, place
from mechsheet.sheet.plan import EXISTS, Plan
from mechsheet.sheet.symbols import plain

LEAP = 4.0
"""A step so many times as large as its neighbours is a leap."""

ROUNDING_ANGLE = 1e-9
"""Differences of angles [rad] below this are rounding."""

BATCH = 60
"""Points (or links) that one formula compares with the row above; more take further columns."""


@dataclass(frozen=True, slots=True)
class Check:
    """One column.

    group    what stands over it: the link or the joint
    head     what is measured
    unit     "length", "angle" (radians): errors; "move" (length), "turn" (an angle as people read it); "leap" (0 or 1);
             "shared" (0 or 1): both assemblies of a group meet there
    formula  for the first row of the table, bound; an empty text in rows that do not exist
    given    constants from the description that it is measured against, in cells over the column: a length, or (u, v)
    after    True where the row above is read: the first row has no value
    """

    group: str
    head: str
    unit: Literal["length", "angle", "move", "turn", "leap", "shared"]
    formula: Node
    given: tuple[Node, ...] = ()
    after: bool = False


@dataclass(frozen=True, slots=True)
class Frame:
    """Where the columns stand on their sheet: its title, the first column and row, the rows of the constants, and the cell
    of the length below which a difference is rounding."""

    title: str
    col: int
    first: int
    given_row: int
    rounding: CellRef


def residuals(plan: Plan, frame: Frame) -> tuple[Check, ...]:
    """All columns, in order from `frame.col` on."""
    ruler = _Ruler(plan, frame)
    for link in plan.mechanism.links[1:]:
        ruler.lengths(link)
        ruler.gaps(link)
    for joint in plan.mechanism.joints:
        ruler.slide(joint)
    ruler.driver()
    ruler.motion()
    ruler.shared()
    return tuple(ruler.found)


class _Ruler:
    """Collects the columns. Formulas are written for the first row of the table."""

    def __init__(self, plan: Plan, frame: Frame) -> None:
        self.plan = plan
        self.frame = frame
        self.found: list[Check] = []
        self.links = {link.name: link for link in plan.mechanism.links}

    # --- reading ----------------------------------------------------------------------------------------------

    def shown(self, symbol: str, up: int = 0) -> Node:
        """What people read in the table of positions, in this row or `up` rows above it."""
        node = self.plan.at.reading_shown(symbol, self.frame.title, self.plan.at.first)
        return shifted(node, -up) if self.plan.at.shown[symbol].column else node

    def radians(self, symbol: str) -> Node:
        """A shown angle in radians."""
        node = self.shown(symbol)
        return Call("RADIANS", (node,)) if self.plan.at.shown[symbol].degrees else node

    def angle(self, link: Link) -> Node:
        """The angle of a link in radians."""
        return al.ZERO if link is self.plan.mechanism.ground else self.radians(link.angle_symbol)

    def bound(self, node: Node) -> Node:
        """An expression over dimensions as the sheet has it."""
        return self.plan.at.bind(node, self.frame.title, None)

    def exists(self, up: int = 0) -> Node:
        """TRUE where the row (or the one above) has a position."""
        return Binary("=", CellRef(self.plan.at.first - up, EXISTS, sheet=self.plan.table), Number(1.0))

    def given(self, index: int) -> CellRef:
        """The cell of the n-th constant over the column that is added next."""
        return CellRef(self.frame.given_row + index, self.frame.col + len(self.found), row_abs=True)

    def local(self, u: Node, v: Node) -> tuple[Node, Node]:
        """A vector in a link's frame, in the cells over the column that is added next; a 0 is left out of the formula."""
        return al.ZERO if al.is_zero(u) else self.given(0), al.ZERO if al.is_zero(v) else self.given(1)

    def add(
        self, group: str, head: str, unit: Literal["length", "angle"], value: Node, given: tuple[Node, ...] = ()
    ) -> None:
        """A column with a value in every row that exists."""
        self.found.append(Check(group, head, unit, Call("IF", (self.exists(), value, Text(""))), given))

    # --- links ------------------------------------------------------------------------------------------------

    def name(self, link: Link) -> str:
        """The link in words."""
        return link_words(link).of(self.plan.language)

    def lengths(self, link: Link) -> None:
        """The distance of two points against their distance in the description."""
        for start, end in measured_pairs(link):
            x, y = (al.sub(self.shown(f"{end}.{axis}"), self.shown(f"{start}.{axis}")) for axis in "xy")
            error = Call("ABS", (al.sub(_hypot(x, y), self.given(0)),))
            self.add(self.name(link), f"{start}–{end}", "length", error, (self.bound(distance(link, start, end)),))

    def gaps(self, link: Link) -> None:
        """How far each point is from where the link's base point and its angle put it."""
        base = base_point(link)
        others = [point for point in link.points if point != base]
        places = self._places(link, base, others)
        u0, v0 = place(link, base) if base else (al.ZERO, al.ZERO)
        for point in others:
            u, v = place(link, point, places)
            if not isinstance(link.points[point], Distances):
                u, v = al.sub(u, u0), al.sub(v, v0)
            way = (self.bound(u), self.bound(v))
            x, y = _turned(*self.local(*way), self.angle(link))
            gap_x = al.sub(al.sub(self.shown(f"{point}.x"), self.shown(f"{base}.x")), x)
            gap_y = al.sub(al.sub(self.shown(f"{point}.y"), self.shown(f"{base}.y")), y)
            head = self.plan.text("checks.gap", point=point)
            self.add(self.name(link), head, "length", _hypot(gap_x, gap_y), way)

    def _places(self, link: Link, base: str, others: list[str]) -> Known:
        """The cells, over the columns that come next, of the ways from a link's base to its other points.

        Points given by distances are laid off from there: written out, each would repeat all those that it is given by.
        """
        title, row, col = self.frame.title, self.frame.given_row, self.frame.col + len(self.found)
        places: dict[str, UV] = {base: (al.ZERO, al.ZERO)}
        for index, point in enumerate(others):
            places[point] = CellRef(row, col + index, True, True), CellRef(row + 1, col + index, True, True)
            self.plan.ways[link.name, point] = Spot(title, row, col + index), Spot(title, row + 1, col + index)
        return places

    # --- sliding joints, the driver ---------------------------------------------------------------------------

    def slide(self, joint: Joint) -> None:
        """The gap between the point and where the displacement puts it on the line; the angle kept to the line."""
        carrier = self.links[joint.on]
        group = self.plan.text("checks.slide", symbol=plain(joint.symbol))
        direction = self._direction(joint)
        if self._base(carrier) != joint:
            x0, y0, given = self._through(joint, carrier)
            reach = _turned(self.shown(joint.symbol), al.ZERO, direction)
            gap_x = al.sub(al.sub(self.shown(f"{joint.point}.x"), x0), reach[0])
            gap_y = al.sub(al.sub(self.shown(f"{joint.point}.y"), y0), reach[1])
            self.add(group, self.plan.text("checks.gap", point=joint.point), "length", _hypot(gap_x, gap_y), given)
        if joint.kind == "prismatic":
            kept = al.add(direction, self.bound(angle_of(joint.orientation).expression()))
            self.add(group, self.plan.text("checks.kept"), "angle", _apart(self.angle(self.links[joint.link]), kept))

    def _direction(self, joint: Joint) -> Node:
        """The direction of a joint's line [rad]."""
        return al.add(self.angle(self.links[joint.on]), self.bound(angle_of(joint.angle).expression()))

    def _base(self, carrier: Link) -> str | Joint | None:
        """What says where a link is: its base point; a link without points stands where its first slide puts it."""
        on = (joint for joint in self.plan.mechanism.joints if joint.on == carrier.name)
        return base_point(carrier) or next(on, None)

    def _through(self, joint: Joint, carrier: Link) -> tuple[Node, Node, tuple[Node, ...]]:
        """(x, y) of the point that the line passes, and the constants over the column that they read."""
        if isinstance(joint.through, str):
            return self.shown(f"{joint.through}.x"), self.shown(f"{joint.through}.y"), ()
        u, v = (length_node(quantity) for quantity in joint.through)
        if carrier is self.plan.mechanism.ground:
            fixed = (self.bound(u), self.bound(v))
            return *self.local(*fixed), fixed
        base = self._base(carrier)
        if isinstance(base, Joint) and not isinstance(base.through, str):
            u0, v0 = (length_node(quantity) for quantity in base.through)
            back = _turned(self.shown(base.symbol), al.ZERO, self._direction(base))
            x0, y0 = (al.sub(self.shown(f"{base.point}.{axis}"), part) for axis, part in zip("xy", back, strict=True))
        else:
            u0, v0 = place(carrier, str(base))
            x0, y0 = self.shown(f"{base}.x"), self.shown(f"{base}.y")
        way = (self.bound(al.sub(u, u0)), self.bound(al.sub(v, v0)))
        x, y = _turned(*self.local(*way), self.angle(carrier))
        return al.add(x0, x), al.add(y0, y), way

    def driver(self) -> None:
        """The angle between two moving links that the driver gives (against the ground it is a link's own angle)."""
        driver = self.plan.mechanism.driver
        if not driver.link or self.links[driver.link].angle_symbol == driver.symbol:
            return
        given = al.add(self.radians(driver.symbol), self.angle(self.links[driver.relative_to]))
        error = _apart(self.angle(self.links[driver.link]), given)
        self.add(self.plan.text("group.driver"), plain(driver.symbol), "angle", error)

    # --- from row to row --------------------------------------------------------------------------------------

    def motion(self) -> None:
        """The farthest move, the largest turn, and the leaps."""
        start = len(self.found)
        self._compared("move", [self._move(point) for point in self._moving_points()])
        self._compared("turn", [self._turned_by(symbol) for symbol in self._turning_angles()])
        motions = self.found[start:]
        if motions:
            group, head = self.plan.text("checks.motion"), self.plan.text("checks.leap")
            self.found.append(Check(group, head, "leap", self._leap(motions, self.frame.col + start), after=True))

    def shared(self) -> None:
        """Whether both assemblies of some group meet in a row: its gap is 0 there, rounding aside."""
        gaps = [self._in_row(gap_of(group)) for group in self.plan.equations.groups if group.mode and group.sides]
        group, head = self.plan.text("checks.motion"), self.plan.text("checks.shared")
        for batch in range(0, len(gaps), BATCH):
            least = al.smallest(gaps[batch : batch + BATCH])
            meets = Call("IF", (Binary("<=", least, self.frame.rounding), al.ONE, al.ZERO))
            self.found.append(Check(group, head, "shared", Call("IF", (self.exists(), meets, Text("")))))

    def _in_row(self, node: Node) -> Node:
        """An expression over columns, as this sheet reads them in the first row."""
        return self.plan.at.bind(node, self.frame.title, self.plan.at.first)

    def _compared(self, unit: Literal["move", "turn"], changes: list[Node]) -> None:
        """The largest change since the row above, in rows that exist as the row above does."""
        both = Call("AND", (self.exists(), self.exists(up=1)))
        group, head = self.plan.text("checks.motion"), self.plan.text(f"checks.{unit}")
        for batch in range(0, len(changes), BATCH):
            part = tuple(changes[batch : batch + BATCH])
            largest = al.largest(part)
            value = Call("SQRT", (largest,)) if unit == "move" else largest
            self.found.append(Check(group, head, unit, Call("IF", (both, value, Text(""))), after=True))

    def _moving_points(self) -> tuple[str, ...]:
        fixed = self.plan.mechanism.ground.points
        return tuple(dict.fromkeys(p for link in self.plan.mechanism.links for p in link.points if p not in fixed))

    def _move(self, point: str) -> Node:
        """The square of a point's move."""
        x, y = (al.sub(self.shown(f"{point}.{axis}"), self.shown(f"{point}.{axis}", up=1)) for axis in "xy")
        return al.add(al.square(x), al.square(y))

    def _turning_angles(self) -> tuple[str, ...]:
        """Angles of links but the driver's own, which may step as it likes, and those that never change."""
        angles = (link.angle_symbol for link in self.plan.mechanism.links[1:])
        driver = self.plan.mechanism.driver.symbol
        return tuple(symbol for symbol in angles if symbol != driver and self.plan.equations.of(symbol).reads)

    def _turned_by(self, symbol: str) -> Node:
        return Call("ABS", (al.sub(self.shown(symbol), self.shown(symbol, up=1)),))

    def _leap(self, motions: list[Check], col: int) -> Node:
        """1 where a change stands out from its neighbours; a neighbour that is no number is left out."""
        row = self.frame.first
        degrees = self.plan.mechanism.angle_unit.in_degrees
        rounding_angle = Number(math.degrees(ROUNDING_ANGLE) if degrees else ROUNDING_ANGLE)
        half = Number(180.0) if degrees else al.PI
        tests: list[Node] = []
        for index, motion in enumerate(motions):
            above, here, below = (CellRef(row + step, col + index) for step in (-1, 0, 1))
            rounding: Node = self.frame.rounding if motion.unit == "move" else rounding_angle
            most = al.add(al.mul(Number(LEAP), Call("MAX", (above, below))), rounding)
            alone = Binary("=", Call("COUNT", (above, below)), al.ZERO)
            tests.append(Call("AND", (Call("NOT", (alone,)), Binary(">", here, most))))
            if motion.unit == "turn":
                tests.append(Binary(">", here, half))
        flag = Call("IF", (Call("OR", tuple(tests)), al.ONE, al.ZERO))
        return Call("IF", (Call("ISNUMBER", (CellRef(row, col),)), flag, Text("")))


def _hypot(x: Node, y: Node) -> Node:
    return al.sqrt(al.add(al.square(x), al.square(y)))


def _turned(u: Node, v: Node, angle: Node) -> tuple[Node, Node]:
    """(u, v) turned by an angle."""
    if al.is_zero(angle):
        return u, v
    c, s = Call("COS", (angle,)), Call("SIN", (angle,))
    return al.sub(al.mul(u, c), al.mul(v, s)), al.add(al.mul(u, s), al.mul(v, c))


def _apart(one: Node, other: Node) -> Node:
    """How far two angles are apart, whole turns aside: 2 |sin(half the difference)| [rad]."""
    return Call("ABS", (al.mul(al.TWO, Call("SIN", (al.div(al.sub(one, other), al.TWO),))),))
