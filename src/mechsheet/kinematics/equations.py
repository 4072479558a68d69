"""The ordered list of assignments that solves a mechanism, as mathematics: small data, and its checker.

    symbol = expression        in internal units (radians, the file's length unit)

An expression reads dimensions, modes, and symbols assigned before it, all at one position of the driver, and it has a
derivative: an angle that goes on without jumps is a `Direction`, the angle of a triangle a `TriangleAngle`; that a position
does not exist is no value but a condition beside the expression. How cells and programs say these is the edges' matter.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Binary, Node, Root, Symbol, symbols
from livesheet.said import Words, say
from mechsheet.diagnostics import MechanismError
from mechsheet.model import FurtherDriver, Mechanism, Take
from mechsheet.units import Unit

Role = Literal[
    "constant", "driver", "iteration", "intermediate", "variable", "point", "coefficient", "rate", "dynamic", "force",
    "influence", "band", "output",
]  # fmt: skip

RATES: tuple[Role, ...] = ("coefficient", "rate")
"""Roles of what only a mechanism with velocities has: influence coefficients with all they need, and what people read."""


FORCES: tuple[Role, ...] = ("dynamic", "force")
"""Roles of what only a mechanism with masses or loads has: what forces are found from, and what people read."""

CAM = -3
"""Stands for a group where the columns of a cam's profile are meant."""

BANDS: tuple[Role, ...] = ("influence", "band")
"""Roles of what only a workbook with tolerances has: what derivatives by dimensions are found from, and what people read."""

INNER: tuple[Role, ...] = ("intermediate", "coefficient", "dynamic", "influence")
"""Roles of columns in quieter ink: nobody but other columns reads them."""

ForceKind = Literal["", "effort", "work", "besides", "size", "part", "normal", "couple", "whole", "center", "hold"]
"""What a column of forces is: the driver's effort from the reactions, and by virtual work; that of a further driver; of a
pin's force the size and the parts; of a slide, a cam, or of teeth along their pitch line, the normal force, and the couple;
where somebody asks, what holds for the whole mechanism (power, shaking force) and the motion of a mass centre; which free
length of a spring just holds a cam's follower."""

JOINT_FORCES: tuple[ForceKind, ...] = ("size", "normal")
"""With what joints hold the links."""


@dataclass(frozen=True, slots=True)
class Condition:
    """What must hold for a quantity to exist: `margin` is not less than `least`.

    margin  a length or a ratio that is continuous in the driver, also where the position does not exist
    least   minus the tolerance where links must reach each other (rounding at a dead centre is no gap); a small positive
            number where a direction must be determined (pins apart, lines that cross)
    reach   True where links must reach each other: the margin is the group's way to coming apart
    """

    margin: Node
    least: Node
    reach: bool = False

    @property
    def fails(self) -> Node:
        """True where the quantity does not exist."""
        return Binary("<", self.margin, self.least)


@dataclass(frozen=True, slots=True)
class Equation:
    """One assignment.

    role    "constant" has one value for all rows (a cell beside the dimensions); the others are columns: "coefficient" is
            a derivative by the driver or what one is found from, "rate" a velocity or an acceleration, "force" a force or
            a torque, "dynamic" what one is found from
    force   which one, where the role is "force"
    unit    `LENGTH`, `ANGLE`, `NUMBER`: the expression's value is in internal units; of an output the one it is shown in
    exists  all that must hold for it to have a value, besides what it reads
    group   0 for the driver's side, n for the n-th group in order of solution, -1 for outputs, `CAM` for a cam's profile
    """

    symbol: str
    expression: Node
    role: Role
    unit: Unit
    label: Words
    group: int = 0
    exists: tuple[Condition, ...] = ()
    force: ForceKind = ""

    @property
    def fails(self) -> Node | None:
        """True where it does not exist, or None when it always does."""
        return al.any_of([condition.fails for condition in self.exists]) if self.exists else None

    @property
    def reads(self) -> tuple[str, ...]:
        """Symbols that the expression reads, and those that decide whether it exists."""
        found = dict.fromkeys(symbols(self.expression))
        for condition in self.exists:
            found |= dict.fromkeys((*symbols(condition.margin), *symbols(condition.least)))
        return tuple(found)


@dataclass(frozen=True, slots=True)
class LinkPose:
    """Where a link is: a point that it carries at `place` (u, v) in its frame lies at

        x + u cos(angle) - v sin(angle),   y + u sin(angle) + v cos(angle)

    angle, x, y  of the link's frame, over symbols of the equations;  places  its points in its frame, over constants
    """

    angle: Node
    x: Node
    y: Node
    places: Mapping[str, tuple[Node, Node]]


@dataclass(frozen=True, slots=True)
class Vector:
    """length e^(i angle); a displacement may be negative."""

    length: Node
    angle: Angle


@dataclass(frozen=True, slots=True)
class Loop:
    """A loop closure equation: vectors in complex form, one way round against the other, sum of r e^(i theta) on each side.

    The ways are given over named points, too: a way and its reverse differ in sign.

    left_way, right_way  the steps of each side, from point to point
    """

    left: tuple[Vector, ...]
    right: tuple[Vector, ...]
    left_way: tuple[tuple[str, str], ...]
    right_way: tuple[tuple[str, str], ...]

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """Those of both sides."""
        return self.left + self.right

    @property
    def reads(self) -> tuple[str, ...]:
        """Every symbol in it, once."""
        nodes = (node for vector in self.vectors for node in (vector.length, vector.angle.node))
        return tuple(dict.fromkeys(name for node in nodes for name in symbols(node)))

    @property
    def gap(self) -> tuple[Node, Node]:
        """Real and imaginary part of left minus right: both are 0 where the loop closes."""

        def part(function: Callable[[Angle], Node]) -> Node:
            sides = (
                al.total(al.mul(vector.length, function(vector.angle)) for vector in side)
                for side in (self.left, self.right)
            )
            return al.sub(*sides)

        return part(al.cos), part(al.sin)


NO_LOOP = Loop((), (), (), ())
"""Of a group that is solved by other equations."""


PASSES = 6
"""Newton steps a row, where more are not needed."""


@dataclass(frozen=True, slots=True)
class System:
    """n equations in n unknowns.

    unknowns     symbols of what is iterated: angles [rad] and displacements before it is asked whether they fit
    variables    what these are called in the table, where they fit
    body         all that follows from the unknowns, in order: points, F, J, its determinant, the residual
    equations    symbols of F;  jacobian: rows of J, over symbols of the body;  determinant, residual: symbols
    corrections  J^-1 F, over symbols of the body
    mode         symbol of the number (from 1) of the assembly;  starts: the start values of each
    given        what it reads besides its unknowns
    driver, home the driver's symbol, and its value in the row at which the start values fit;  row: that row, from 0
    passes       Newton steps a row
    described    what `given` follows from in that row, with the values for which the start values were found: dimensions,
                 values of drivers, unknowns of groups before;  way: the equations from there to `given`
    periodic     whether a turn more of an angle changes nothing: with gears it does
    """

    unknowns: tuple[str, ...]
    variables: tuple[str, ...]
    body: tuple[Equation, ...]
    equations: tuple[str, ...]
    jacobian: tuple[tuple[Node, ...], ...]
    determinant: str
    residual: str
    corrections: tuple[Node, ...]
    given: tuple[str, ...]
    mode: str
    driver: str
    starts: tuple[tuple[float, ...], ...] = ()
    home: float = 0.0
    row: int = 0
    passes: int = PASSES
    described: tuple[tuple[str, float], ...] = ()
    way: tuple[Equation, ...] = ()
    periodic: bool = True

    def roots(self) -> tuple[Root, ...]:
        """Each unknown as an expression."""
        given = tuple(Symbol(name) for name in (self.driver, self.mode, *self.given))
        return tuple(Root(name, given) for name in self.unknowns)


@dataclass(frozen=True, slots=True)
class Group:
    """One Assur group in order of solution.

    kind          "RRR", "RRP", "RPR", "PRP", "RPP"; of a group solved by Newton's method its class, "III", "IV"
    links         names of its links (a massless block of a pin-slot joint is called after its slot)
    unknowns      the symbols that its closure decides: two angles or displacements
    closure       its loop closure equation: left = right, in the plane
    mode          symbol of the mode cell, "" where there is only one assembly
    assemblies    what each assembly looks like; `assembly` is the number (from 0) of the one that the sketch means
    closes        symbol of an equation that has a value exactly where the group can be assembled
    apart         how far its assemblies are from each other: 0 at a dead centre; None where there is one assembly
    open          True when the sketch said nothing about this group
    transmission  angle of the transmission: symbol whose sine measures how well the group transmits force, or ""
    sides         lengths that must form a triangle for the group to close: its three sides; or the hypotenuse and a leg of
                  a right triangle; none where two lines meet
    system        the equations that Newton's method solves, where no formula does; such a group has no `closure`
    follows       the mode as a synthesis finds it, over its steps; None where it is given
    determinant   that of the closure's derivatives by the unknowns, in their order: w1 x w2, where w is the derivative of
                  left minus right by one of them; None where there is no `closure`
    dead          what must hold for derivatives to be numbers; None where the determinant never vanishes
    degenerate    TRUE in a row where the links can be joined but their position is undetermined (pins coincide, so that a
                  link can turn about them; lines coincide); None where that cannot be
    """

    number: int
    kind: str
    links: tuple[str, ...]
    pins: tuple[str, ...]
    unknowns: tuple[str, ...]
    closure: Loop
    mode: str
    assemblies: tuple[Words, ...]
    assembly: int
    closes: str
    apart: Node | None
    open: bool
    label: Words
    transmission: str = ""
    sides: tuple[Node, ...] = ()
    system: System | None = None
    follows: Node | None = None
    determinant: Node | None = None
    dead: Condition | None = None
    degenerate: Node | None = None

    @property
    def mode_value(self) -> int:
        """What the mode cell holds: +1 for the first assembly of a dyad, -1 for the second; else its number from 1."""
        return 1 - 2 * self.assembly if self.system is None else self.assembly + 1

    @property
    def mode_values(self) -> tuple[int, ...]:
        """What it can hold."""
        return (1, -1) if self.system is None else tuple(range(1, len(self.assemblies) + 1))

    def value_of(self, mode: float) -> int:
        """The value that a number in the mode cell counts as."""
        return self.mode_values[self.assembly_of(mode)] if mode == mode else self.mode_values[-1]

    def assembly_of(self, mode: float) -> int:
        """The number of the assembly (from 0) that a value of the mode cell means."""
        return assembly_of(mode) if self.system is None else min(max(round(mode), 1), len(self.assemblies)) - 1

    @property
    def only_undetermined(self) -> bool:
        """Whether it always closes, but where its two pins coincide and it can turn about them: a slot through its pivot."""
        return self.kind == "RPR" and al.is_zero(self.sides[1])

    @property
    def status(self) -> str:
        """What is said of it where it does not close, as a key of words."""
        why = "undetermined" if self.only_undetermined else "newton" if self.system is not None else "open"
        return f"status.{why}"

    @property
    def mode_words(self) -> Words:
        """What the assembly that was taken looks like."""
        return self.assemblies[self.assembly]


def assembly_of(mode: float) -> int:
    """The number of the assembly that a mode cell means."""
    return 0 if mode > 0 else 1


@dataclass(frozen=True, slots=True)
class Fit:
    """What is 0 in every row: how far velocities, and accelerations, are from fitting together."""

    velocity: tuple[Node, ...]
    acceleration: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Equations:
    """All equations of a mechanism: constants first, then columns, in order of solution.

    positive   symbols of dimensions that are lengths between joints: they must stay greater than zero; the driver's, too,
               and the duration of a motion law
    tolerance  symbol of the constant below which a length counts as zero
    poses      where each link is, by its name
    fits       by number of a group what its two ways to a point differ by, over points, velocities and accelerations
    turning    how fast each link turns, by the symbol of its angle: its angular velocity and acceleration
    listed     further drivers whose values are listed, row by row: each is itself
    tied       what gears, racks and further drivers decide, by symbol: it turns as fast as they say, and need not repeat
               itself with every turn of the driver
    """

    constants: tuple[Equation, ...]
    columns: tuple[Equation, ...]
    groups: tuple[Group, ...]
    positive: tuple[str, ...]
    tolerance: str
    poses: Mapping[str, LinkPose] = field(default_factory=dict)
    fits: Mapping[int, Fit] = field(default_factory=dict)
    turning: Mapping[str, tuple[Node, Node]] = field(default_factory=dict)
    listed: tuple[Equation, ...] = ()
    tied: tuple[str, ...] = ()

    @property
    def all(self) -> tuple[Equation, ...]:
        """Constants and columns."""
        return self.constants + self.columns

    def forces(self, *kinds: ForceKind) -> tuple[str, ...]:
        """Symbols of the forces of these kinds, in order of solution."""
        return tuple(equation.symbol for equation in self.columns if equation.force in kinds)

    def rates_of(self, follower: FurtherDriver) -> tuple[str, str, str]:
        """What people read of how a cam moves it: by time where the cam turns evenly, else by the cam's angle."""
        known = {equation.symbol for equation in self.columns}
        return follower.by_time if known.issuperset(follower.by_time) else follower.by_angle

    @property
    def positions(self) -> Equations:
        """Those of positions alone: without rates, forces, bands and what people derive from all of these."""
        besides = (*RATES, *FORCES, *BANDS, "output")
        return replace(self, columns=tuple(equation for equation in self.columns if equation.role not in besides))

    @property
    def efforts(self) -> tuple[str, ...]:
        """The driver's effort from the reactions and by virtual work; nothing without forces."""
        return self.forces("effort", "work")

    @property
    def shown_forces(self) -> tuple[str, ...]:
        """What people read of the forces: not the parts, nor the effort once more."""
        return self.forces("effort", "besides", *JOINT_FORCES, "couple", "whole", "center", "hold")

    def unit_of(self, mechanism: Mechanism, symbol: str) -> Unit:
        """The unit of a quantity: of what is given row by row, or of an equation."""
        return mechanism.given_unit(symbol) or self.of(symbol).unit

    def is_angle(self, mechanism: Mechanism, symbol: str) -> bool:
        """Whether a quantity is an angle, which may go on by whole turns."""
        unit = self.unit_of(mechanism, symbol)
        return unit.kind == "angle" and not unit.per

    def behind(self, wanted: Iterable[str]) -> list[Equation]:
        """The columns among those wanted, and all columns that they follow from."""
        columns = {equation.symbol: equation for equation in self.columns}
        waiting, found = [*wanted], dict[str, Equation]()
        while waiting:
            symbol = waiting.pop()
            if symbol in columns and symbol not in found:
                found[symbol] = columns[symbol]
                waiting += columns[symbol].reads
        return [*found.values()]

    def range_has_gaps(self, symbol: str, take: Take) -> bool:
        """Whether a take of several stretches is none: how far an angle goes that counts its turns anew after each gap."""
        equation = next((each for each in self.columns if each.symbol == symbol), None)
        angle = equation is not None and equation.role == "variable" and equation.unit.kind == "angle"
        return angle and len(take.ways) > 1

    def impossible(self, driver: str) -> Node | None:
        """True while an input is none that a mechanism can have: a length between joints that is not above 0, another mode
        than there are. None where no input could be one.

        driver  its symbol: a driven slide that is no length is found row by row, where its group comes apart
        """
        lengths = tuple(Symbol(name) for name in self.positive if name != driver)
        wrong: list[Node] = [Binary("<=", al.smallest(lengths), al.ZERO)] if lengths else []
        modes = [(Symbol(group.mode), group.system) for group in self.groups if group.mode]
        wrong += [Binary("<>", al.call("ABS", mode), al.ONE) for mode, system in modes if system is None]
        for mode, system in modes:
            if system is not None:
                most = al.number(len(system.starts))
                middle = al.sub(al.sub(al.mul(al.TWO, mode), most), al.ONE)
                wrong.append(Binary(">=", al.call("ABS", middle), most))
        return al.any_of(wrong) if wrong else None

    def group_of(self, equation: Equation) -> Group | None:
        """The group that an equation belongs to; None on the driver's side, of outputs and of a cam's profile."""
        return self.groups[equation.group - 1] if equation.group > 0 else None

    def of(self, symbol: str) -> Equation:
        """The equation of a symbol."""
        return next(equation for equation in (*self.all, *self.listed) if equation.symbol == symbol)

    def closed(self, values: Mapping[str, NDArray[np.float64]]) -> NDArray[np.bool_]:
        """In which rows every group closes. `values`: of every symbol, row by row, NaN where it does not exist (`sweep`)."""
        found = np.ones(len(next(iter(values.values()))), bool)
        for group in self.groups:
            found &= np.isfinite(values[group.closes])
        return found


def validate(equations: Equations, given: tuple[str, ...]) -> None:
    """Raise ValueError unless every symbol is solved once, before it is read. `given`: dimensions and the driver."""
    known = set(given) | {group.mode for group in equations.groups if group.mode}
    for equation in equations.all:
        missing = [name for name in equation.reads if name not in known]
        if missing:
            raise ValueError(f"{equation.symbol}: {missing[0]} is not solved yet")
        if equation.symbol in known:
            raise ValueError(f"{equation.symbol} is solved twice")
        if (equation.role == "constant") != (equation in equations.constants):
            raise ValueError(f"{equation.symbol} stands in the wrong list")
        known.add(equation.symbol)


def need_closed_form(equations: Equations, what: str, key: str = "", hint: str = "") -> None:
    """Raise MechanismError where a group is solved by Newton's method; `what` is not written then."""
    group = next((group for group in equations.groups if group.system is not None), None)
    if group is not None:
        message = say("{what}: {group} have no closed form, each row needs the row above", what=what, group=group.label)
        raise MechanismError(Fault(message, key=key, hint=hint))


def need_one_position(equations: Equations, what: str, key: str = "", hint: str = "") -> None:
    """As `need_closed_form`; the driver's value alone must also say where everything else that is driven stands."""
    need_closed_form(equations, what, key, hint)
    for listed in equations.listed:
        message = say(
            "{what}: the values of {symbol} are listed row by row, they do not follow from the driver",
            what=what,
            symbol=listed.symbol,
        )
        raise MechanismError(Fault(message, key=key, hint=hint))
