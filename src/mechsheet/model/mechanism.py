"""The mechanism: dimensions, links, points, joints, drivers, loads, and what is wanted of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

from livesheet.formula.nodes import Call, Node, symbols
from livesheet.formula.nodes import Number as NumberNode
from livesheet.said import Words
from mechsheet.units import LENGTH, RAD, SECONDS, Unit

from .asked import Exercise, Study, Synthesis, Tolerances
from .cams import Cam, Segments
from .loads import Dynamics
from .symbols import TIME, GivenPoint, Quantity, rate_symbols
from .takes import Take


@dataclass(frozen=True, slots=True)
class Dimension:
    """A named constant: an input cell, or a derived one.

    value      a number in internal units (an angle in radians), or the expression of a derived dimension
    unit       in which it is shown: degrees or radians, the length unit, or none for a plain number
    cell       the name of its cell, when the description chooses it
    tolerance  in the unit shown
    shown      a plain number as the description wrote it, in its unit (30 for 30 degrees), else None
    written    the expression of a derived dimension as the description wrote it, else ""
    path       where the description gives one that is not among its dimensions: ("driver", "speed"),
               ("driver", "motion", "duration"), ("links", "crank", "mass"), ("loads", 0, "force", 1),
               ("synthesis", "theta", 1) of a task, ("synthesis",) of a step of its solution; () for its own
    """

    symbol: str
    value: Quantity
    unit: Unit
    label: Words | None = None
    cell: str | None = None
    tolerance: float | None = None
    shown: float | None = None
    written: str = ""
    path: tuple[str | int, ...] = ()

    @property
    def driver_key(self) -> str:
        """The key of the driver that gives it: "speed", "acceleration", "duration" …; "" for any other."""
        return str(self.path[-1]) if self.path[:1] == ("driver",) else ""

    @property
    def derived(self) -> bool:
        """Whether it follows from other dimensions, as the description says by `formula`."""
        return not isinstance(self.value, float)


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid link. `points` maps point name to its place in the link's frame. The first link is the ground, number 1."""

    name: str
    number: int
    points: Mapping[str, GivenPoint]
    label: Words | None = None

    @property
    def angle_symbol(self) -> str:
        """`theta13` for link 3, `theta1_10` from the tenth on: the angle of its x axis from the ground's."""
        return f"theta1{self.number}" if self.number < 10 else f"theta1_{self.number}"

    @property
    def rate_symbols(self) -> tuple[str, str]:
        """`omega13`, `alpha13`: its angular velocity and acceleration."""
        return rate_symbols(self.angle_symbol, True)


def touched_by(cam: Cam, links: Sequence[Link]) -> Link | None:
    """The link that a cam touches, of all links, the ground first: that of its face, or the first that has the roller's
    centre; None where none does."""
    moving = (link for link in links[1:] if cam.point in link.points and cam.follower in ("", link.name))
    return next(moving, None)


@dataclass(frozen=True, slots=True)
class Joint:
    """A sliding joint: `point` of `link` stays on a line fixed in the link `on`.

    kind         "prismatic": `link` keeps its angle to the line. "pin-slot": no link keeps an angle to it, and `link` is
                 the first link that has `point` (every other link with that point is pinned to it anyway)
    through      a point of `on` by name, or its (x, y) in `on`'s frame
    angle        direction of the line in `on`'s frame [rad]
    orientation  angle of `link`'s x axis from the line [rad]; 0 for a pin-slot
    symbol       the displacement: signed distance from `through` to `point` along the line
    """

    name: str
    kind: Literal["prismatic", "pin-slot"]
    link: str
    on: str
    point: str
    through: str | tuple[Quantity, Quantity]
    angle: Quantity
    orientation: Quantity
    symbol: str


@dataclass(frozen=True, slots=True)
class Redundant:
    """A link that moves with the others anyway: the mechanism has it with a slot in place of its second revolute joint.

    link   as described, with both joints;  symbol  the displacement in the slot: how long the link would have to be
    also   of one that was found, not marked: the names of others that would do as well; None where the description marks it
    """

    link: Link
    symbol: str
    also: tuple[str, ...] | None = field(default=None, compare=False)


PRESSURE: Node = Call("RADIANS", (NumberNode(20.0),))
"""The usual angle between a tooth force and the tangent of the pitch circles [rad]."""


@dataclass(frozen=True, slots=True)
class Gear:
    """Two wheels, or pulleys with a belt, whose axes an arm carries:

        angle(link) - angle(arm) = ratio (angle(on) - angle(arm)) + phase

    kind      "gear" or "belt": the same relation, drawn otherwise, and with other forces
    arm       the link that carries both axes; it shares a pivot with either wheel
    ratio     negative where the wheels turn against each other: external gears, crossed belts
    phase     [rad];  pressure  angle between the tooth force and the tangent of the pitch circles [rad]
    order     its place among the joints of the file, from 0
    read_off  True where the description has no phase: it is what the sketch shows, or 0
    """

    kind: Literal["gear", "belt"]
    link: str
    on: str
    arm: str
    ratio: Node
    phase: Node
    order: int
    pressure: Node = PRESSURE
    read_off: bool = False

    @property
    def turning(self) -> tuple[str, ...]:
        """The links whose angles it ties."""
        return (self.link, self.on, self.arm)


@dataclass(frozen=True, slots=True)
class Rack:
    """A toothed bar and a pinion:

        displacement of the sliding joint = radius (angle(link) - angle(arm)) + phase

    joint  symbol of the displacement;  link  the pinion;  arm  the side of the sliding joint on which the pinion is pivoted
    phase  in the length unit; the others as in `Gear`
    """

    joint: str
    link: str
    arm: str
    radius: Node
    phase: Node
    order: int
    pressure: Node = PRESSURE
    read_off: bool = False

    @property
    def turning(self) -> tuple[str, ...]:
        """The links whose angles it ties."""
        return (self.link, self.arm)


Relation: TypeAlias = Gear | Rack


LAWS = ("constant", "accelerated", "parabolic", "harmonic", "cycloidal", "polynomial")
"""Names of the motion laws: by which part of its way a driver has moved after a part of the time."""


@dataclass(frozen=True, slots=True)
class Law:
    """A motion in time: from start to stop in so many seconds, in rows that are equally spaced in time.

    name      one of `LAWS`
    rows      how many
    start, stop, duration  symbols of the dimensions that say from where to where, and in what time
    value     the driver's value over these three and the time, `TIME`
    """

    name: str
    rows: int
    start: str
    stop: str
    duration: str
    value: Node


@dataclass(frozen=True, slots=True)
class Driver:
    """What is driven, and its values.

    link, relative_to  the link that turns, and the link it turns against: value = angle(link) - angle(relative_to)
    joint              or the sliding joint whose displacement is given (then link and relative_to are "")
    symbol             theta12, or the joint's symbol
    start, stop, step  the sweep in internal units (stop is included when the steps land on it); or
    values             the driver's values one by one; or
    law                how it moves in time
    unit               unit in which a person reads and writes the values: degrees, radians or the length unit
    speed              its derivative by time [rad/s or length unit/s], over dimensions, the driver's symbol and the time of
                       a law; the symbol of a dimension of its own where it is the same in every row; None where no rates
                       are asked for
    acceleration       the second derivative, likewise
    speeds, accelerations  one for each of `values`, where they are listed: then `speed` is their symbol
    times              the times of `values`, where positions of a law are listed one by one
    """

    symbol: str
    unit: Unit
    link: str = ""
    relative_to: str = ""
    joint: str = ""
    start: Quantity = 0.0
    stop: Quantity = 0.0
    step: Quantity = 0.0
    values: tuple[Quantity, ...] = ()
    law: Law | None = None
    speed: Node | None = None
    acceleration: Node | None = None
    speeds: tuple[Quantity, ...] = ()
    accelerations: tuple[Quantity, ...] = ()
    times: tuple[Quantity, ...] = ()

    @property
    def stepped(self) -> bool:
        """Whether its rows follow each other by one step."""
        return not self.values and self.law is None

    @property
    def uneven(self) -> bool:
        """Whether its speed follows from where it is: then ways of the same length do not take the same time."""
        return self.speed is not None and self.symbol in symbols(self.speed)


@dataclass(frozen=True, slots=True)
class FurtherDriver:
    """What is driven besides; its value in a row is

    follows  an expression over dimensions, the driver's symbol and those of further drivers; or
    values   one for each row, in internal units
    segments what `follows` is made of, where the driver's angle is that of a cam

    The other fields as in `Driver`; `order`: its place among the further drivers of the file, from 0.
    """

    symbol: str
    unit: Unit
    order: int
    link: str = ""
    relative_to: str = ""
    joint: str = ""
    follows: Node | None = None
    values: tuple[Quantity, ...] = ()
    segments: Segments | None = None

    @property
    def by_angle(self) -> tuple[str, str, str]:
        """Of what a cam moves: its derivatives by the cam's angle."""
        return f"{self.symbol}.d", f"{self.symbol}.dd", f"{self.symbol}.ddd"

    @property
    def by_time(self) -> tuple[str, str, str]:
        """Of what a cam moves: velocity, acceleration and jerk."""
        return (*rate_symbols(self.symbol, not self.joint), f"{self.symbol}.j")


@dataclass(frozen=True, slots=True)
class Sketch:
    """A rough position: points (x, y), and angles or displacements by symbol.

    at       the driver value that it shows; None for the first at which each group of links closes
    doubted  False when it was drawn for other dimensions than these, and so need not fit
    """

    points: Mapping[str, tuple[Quantity, Quantity]] = field(default_factory=dict)
    symbols: Mapping[str, Quantity] = field(default_factory=dict)
    at: Quantity | None = None
    doubted: bool = field(default=True, compare=False)


@dataclass(frozen=True, slots=True)
class Output:
    """A further quantity: an expression over variables (`C.x` too) and dimensions, or over summaries and dimensions; `unit`
    as a dimension's, or any label; `written`: the formula as the description has it."""

    symbol: str
    formula: Node
    unit: Unit
    label: Words | None = None
    cell: str | None = None
    written: str = field(default="", compare=False)


@dataclass(frozen=True, slots=True)
class Summary:
    """One number from a whole sweep of the variable or output `of`, with the driver value where it occurs."""

    symbol: str
    of: str
    take: Take
    label: Words | None = None
    cell: str | None = None


Ends: TypeAlias = tuple[float | None, float | None]
"""Where an axis begins and ends."""


@dataclass(frozen=True, slots=True)
class ChartRequest:
    """Curves of `y` against `x`, or the paths of points at true scale, or those of the ends of their velocity vectors.

    profile         whether the profile of the cam is drawn instead
    x_ends, y_ends  where the axes of curves begin and end, as they are shown; None: chosen
    """

    title: Words | None = None
    x: str = ""
    y: tuple[str, ...] = ()
    paths: tuple[str, ...] = ()
    hodographs: tuple[str, ...] = ()
    profile: bool = False
    x_ends: Ends = (None, None)
    y_ends: Ends = (None, None)


@dataclass(frozen=True, slots=True)
class TableRequest:
    """A two-way table: a dimension across (`column` takes `columns`), `value` in the cells.

    rows        the driver's symbol: down go its values; or another dimension, which takes `row_values`: then `value` is
                a summary of the sweep with these two dimensions
    """

    rows: str
    column: str
    columns: tuple[Quantity, ...]
    value: str
    title: Words | None = None
    row_values: tuple[Quantity, ...] = ()

    @property
    def of_summary(self) -> bool:
        """Whether it shows a summary over two dimensions."""
        return bool(self.row_values)


@dataclass(frozen=True, slots=True)
class Solution:
    """How groups are solved that no dyad can be taken from.

    passes  Newton steps a row; None: as many as are needed, at least six
    force   dyads are solved so, too
    """

    passes: int | None = None
    force: bool = False


@dataclass(frozen=True, slots=True)
class Mechanism:
    """A whole description. Orders are those of the file; `text` is the file itself (it travels in the workbook).

    outputs      quantities of every row;  motion_outputs: those whose formulas name summaries: one number of the motion each
    relations    gears, belts and racks
    drivers      what is driven besides the driver, each after those that it follows
    rate_points  points whose velocity and acceleration are wanted; None: those that suit any mechanism
    dynamics     masses and loads; None where the description has none
    solution     how groups without a closed form are solved
    bands        what tolerances are followed to; None where nobody asks
    synthesis    the task from which dimensions are found; None where all of them are given
    redundant    links that are left out of what has to be solved
    cam          the cam whose profile is asked for
    file         the stem of the file that it was read from, "" when it was read from none
    before       the same without the changes that a caller asked for; None when there are none
    listing      the text whose lines messages name: the file with the values asked for, without what was added
    """

    name: str
    title: Words
    source: Words
    length_unit: str
    angle_unit: Unit
    dimensions: tuple[Dimension, ...]
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    driver: Driver
    sketch: Sketch = Sketch()
    outputs: tuple[Output, ...] = ()
    motion_outputs: tuple[Output, ...] = ()
    summaries: tuple[Summary, ...] = ()
    charts: tuple[ChartRequest, ...] = ()
    tables: tuple[TableRequest, ...] = ()
    language: str = "en"
    references: Literal["names", "anchors"] = "names"
    layout: Literal["sheets", "page"] = "sheets"
    drawn: bool = True
    rate_points: tuple[str, ...] | None = None
    dynamics: Dynamics | None = None
    solution: Solution = Solution()
    relations: tuple[Relation, ...] = ()
    drivers: tuple[FurtherDriver, ...] = ()
    exercise: Exercise | None = None
    bands: Tolerances | None = None
    study: Study | None = None
    synthesis: Synthesis | None = None
    redundant: tuple[Redundant, ...] = ()
    cam: Cam | None = None
    text: str = ""
    file: str = field(default="", compare=False)
    before: Mechanism | None = field(default=None, compare=False)
    listing: str = field(default="", compare=False, repr=False)

    def link(self, name: str) -> Link:
        """The link of that name."""
        return next(link for link in self.links if link.name == name)

    @property
    def whole_links(self) -> tuple[Link, ...]:
        """The links as described: redundant ones with both joints."""
        whole = {each.link.name: each.link for each in self.redundant}
        return tuple(whole.get(link.name, link) for link in self.links)

    @property
    def free_dimensions(self) -> tuple[Dimension, ...]:
        """Those that follow from no others, and are no number that the description has elsewhere (a mass, a speed)."""
        return tuple(dim for dim in self.dimensions if not dim.derived and not dim.path)

    @property
    def sliding(self) -> tuple[Joint, ...]:
        """The sliding joints of the description: without the slots that stand for joints of redundant links."""
        slots = {each.symbol for each in self.redundant}
        return tuple(joint for joint in self.joints if joint.symbol not in slots)

    @property
    def stem(self) -> str:
        """What files made of it are called: as the file it was read from, or by its name."""
        return self.file or self.name

    def shown(self, unit: Unit) -> Unit:
        """The unit in which people read a quantity of an equation: its own, or that of all lengths, of all angles."""
        if unit.symbol:
            return unit
        known = self.angle_unit if unit.kind == "angle" else Unit(unit.kind, self.length_unit)
        return replace(known, per=unit.per)

    @property
    def motion_numbers(self) -> tuple[Summary | Output, ...]:
        """What is one number of the whole motion: summaries, then the outputs that follow from them."""
        return (*self.summaries, *self.motion_outputs)

    @property
    def flywheel(self) -> Dimension | None:
        """The coefficient of fluctuation that a flywheel must keep; None where no flywheel is asked for."""
        return next((dim for dim in self.dimensions if dim.path[:1] == ("flywheel",)), None)

    @property
    def assumed_inertia(self) -> tuple[Link, ...]:
        """Links that turn and have a mass, but no moment of inertia that anybody has said."""
        assumed = {mass.link for mass in self.dynamics.masses if mass.assumed} if self.dynamics else set()
        return tuple(link for link in self.links if link.name in assumed)

    @property
    def driver_rates(self) -> tuple[str, str]:
        """Symbols of the driver's speed and acceleration: omega12, alpha12."""
        driver = self.driver
        link = next((link for link in self.links if link.name == driver.link), None)
        own = link.angle_symbol if link and driver.relative_to == self.ground.name else driver.symbol
        return rate_symbols(own, not driver.joint)

    @property
    def driven_link(self) -> str:
        """The link that the driver moves, seen from the ground.

        Of a cam that turns clockwise the driver's angle is that of the ground, seen from the cam.
        """
        driver = self.driver
        if driver.joint:
            return next(joint.link for joint in self.joints if joint.name == driver.joint)
        return driver.relative_to if driver.link == self.ground.name else driver.link

    @property
    def all_drivers(self) -> tuple[Driver | FurtherDriver, ...]:
        """The driver, and what is driven besides."""
        return (self.driver, *self.drivers)

    @property
    def follower(self) -> FurtherDriver | None:
        """What a cam moves, where there is one."""
        return next((driver for driver in self.drivers if driver.segments is not None), None)

    @property
    def segments(self) -> Segments | None:
        """The motion over a cam's angle, where there is one."""
        return None if self.follower is None else self.follower.segments

    @property
    def seams(self) -> tuple[Node, ...]:
        """Values of the driver at which pieces of its motion meet, or are fastest; none where it is one piece."""
        return () if self.segments is None else self.segments.seams

    @property
    def driven_symbols(self) -> tuple[str, ...]:
        """Symbols of what is driven, the driver's first."""
        return tuple(driver.symbol for driver in self.all_drivers)

    def driver_of(self, symbol: str) -> Driver | FurtherDriver:
        """What is driven, by its symbol."""
        return next(each for each in self.all_drivers if each.symbol == symbol)

    @property
    def listed_symbols(self) -> tuple[str, ...]:
        """Symbols of further drivers whose values are listed, row by row."""
        return tuple(driver.symbol for driver in self.drivers if driver.values)

    @property
    def given_by_row(self) -> tuple[str, ...]:
        """Symbols that have a value in each row beside the driver's: the time of a law, listed speeds and accelerations,
        listed values of further drivers."""
        return (TIME,) if self.driver.law is not None else tuple(self.listed)[1:]

    @property
    def listed(self) -> dict[str, tuple[Quantity, ...]]:
        """What is listed row by row: the driver's values, and what belongs to each of them; nothing where it steps."""
        driver = self.driver
        names = (driver.symbol, TIME, *self.driver_rates)
        lists = (driver.values, driver.times, driver.speeds, driver.accelerations)
        besides = {other.symbol: other.values for other in self.drivers if other.values}
        return {name: listed for name, listed in zip(names, lists, strict=True) if listed} | besides

    def given_unit(self, symbol: str) -> Unit | None:
        """Of what is driven, of its speed and acceleration where these are cells, and of what has a value in each row beside
        it; None for all that equations say."""
        driver = self.driver
        if symbol == driver.symbol or symbol in self.listed_symbols:
            return self.driver_of(symbol).unit
        if symbol in self.driver_rates:
            same = next((dim for dim in self.dimensions if dim.symbol == symbol), None)
            if same is not None:
                return same.unit
        if symbol not in self.given_by_row:
            return None
        if symbol == TIME:
            return SECONDS
        speed = (LENGTH if driver.joint else RAD).per_time()
        return speed if symbol == self.driver_rates[0] else speed.per_time()

    @property
    def ground(self) -> Link:
        """The fixed link."""
        return self.links[0]
