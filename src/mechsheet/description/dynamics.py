"""Masses of links, loads and gravity; and the flywheel.

A plain number becomes an input cell of its own (m_2, J_2, x_G2; P_x of a load), an expression over dimensions a derived one:
both are dimensions of the model, with the place that gives them. A flywheel is only where the driver turns evenly through
whole turns, for else no one energy is stored and given back.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol, symbols
from livesheet.said import Said, say
from mechsheet.description.driving.rates import check_speed
from mechsheet.description.force_names import CENTER, MOMENTS, POWER, first_key, keys_of
from mechsheet.description.links import place as read_place
from mechsheet.description.report import BAD, suggestion, within
from mechsheet.description.scope import Scope, symbol_fault
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import CONSISTENT, METRES, consistent, measured, spelled
from mechsheet.diagnostics import quoted
from mechsheet.model import (
    ENERGY,
    Cartesian,
    Dimension,
    Distances,
    Driver,
    Dynamics,
    GivenPoint,
    Joint,
    Link,
    Load,
    Mass,
    Quantity,
    Spring,
    center_symbol,
    inertia_label,
    torque_unit,
)
from mechsheet.units import NUMBER, Unit


def read(
    bodies: dict[str, Any], given: dict[str, Any], loads: list[Any], links: tuple[Link, ...], joints: tuple[Joint, ...],
    scope: Scope,
) -> tuple[Dynamics | None, tuple[Dimension, ...]]:  # fmt: skip
    """Masses and loads, and the dimensions that they bring; None where there are none."""
    if first_key(bodies, loads) is None or not links:
        if given:
            message = say("no link has a mass and nothing is loaded: there are no forces")
            scope.report.at(("dynamics",), message, say("give links a `mass`, or [[loads]]"))
        return None, ()
    return _Reader(given, links, _straight(links, joints), scope).read(bodies, loads)


def _straight(links: tuple[Link, ...], joints: tuple[Joint, ...]) -> set[str]:
    """The links that never turn: sliding joints alone lead from the ground to them."""
    found = {links[0].name}
    pairs = [{joint.link, joint.on} for joint in joints if joint.kind == "prismatic"]
    while grown := {name for pair in pairs if pair & found for name in pair} - found:
        found |= grown
    return found


@dataclass
class _Reader:
    given: dict[str, Any]
    links: tuple[Link, ...]
    straight: set[str]
    scope: Scope
    cells: list[Dimension] = field(default_factory=list)

    def read(self, bodies: dict[str, Any], loads: list[Any]) -> tuple[Dynamics, tuple[Dimension, ...]]:
        self.metre = METRES.get(self.scope.length_unit)
        self.force_unit, self.mass_unit = self._units(bodies)
        torque = torque_unit(self.force_unit, self.metre, self.scope.length_unit)
        self.force, self.torque = Unit("force", self.force_unit), Unit("moment", torque)
        self.scope.force_units |= {name: self._unit_of(name, what) for name, what in self.scope.forces.items()}
        masses = [self._mass(link, bodies[link.name]) for link in self.links if self._has_mass(link, bodies)]
        gravity = self._gravity()
        found = [self._load(number, entry) for number, entry in enumerate(loads) if entry is not BAD]
        dynamics = Dynamics(
            tuple(masses), tuple(load for load in found if isinstance(load, Load)), gravity, self.metre,
            tuple(load for load in found if isinstance(load, Spring)), self.force_unit, self.mass_unit,
        )  # fmt: skip
        return dynamics, tuple(self.cells)

    def _unit_of(self, name: str, what: str) -> str:
        """What stands behind the numbers of a force, an effort or a mass centre."""
        if what == POWER:
            return "W" if self.metre else f"{self.torque.text}/s"
        if what == CENTER:
            return self.scope.length_unit
        return self.torque.text if what in MOMENTS or name.endswith(".m") else self.force.text

    def _units(self, bodies: dict[str, Any]) -> tuple[str, str]:
        """The labels of forces and masses."""
        length = self.scope.length_unit
        own = ("N", "kg") if self.metre else CONSISTENT.get(spelled(length), ("", ""))
        if BAD in self.given.values():
            return own
        given = tuple(
            str(self.given.get(key, word)) for key, word in zip(("force_unit", "mass_unit"), own, strict=True)
        )
        if not self.metre and consistent(given[0], given[1], length) is False:
            self._inconsistent(*given)
        found = []
        for key, metric, word in zip(("force_unit", "mass_unit"), own, given, strict=True):
            if self.metre and word not in (BAD, metric):
                message = say(
                    "with lengths in {length_unit} forces are in N and masses in kg", length_unit=self.scope.length_unit
                )
                self.scope.report.at(("dynamics", key), message, say("take it away"))
            weighs = any(isinstance(entry, dict) and "mass" in entry for entry in bodies.values())
            if word == "" and (key == "force_unit" or weighs):
                message = say(
                    "{key} is missing: with lengths in {length_unit} no unit goes without saying",
                    key=key,
                    length_unit=quoted(self.scope.length_unit),
                )
                hint = say("a force must be a mass times {length_unit}/s²", length_unit=self.scope.length_unit)
                self.scope.report.at(("dynamics", key) if key in self.given else ("dynamics",), message, hint)
            found.append(word)
        return found[0], found[1]

    def _inconsistent(self, force: str, mass: str) -> None:
        """Report a force that is not a mass times an acceleration."""
        length = self.scope.length_unit
        message = say(
            "1 {force} is not 1 {mass} times 1 {length}/s²: forces would come out wrong",
            force=force,
            mass=mass,
            length=length,
        )
        hint = say("a force must be a mass times {length_unit}/s²", length_unit=length)
        if (right := CONSISTENT.get(spelled(length))) is not None:
            hint = say(
                'with {length}: force_unit = "{right_force}", mass_unit = "{right_mass}", which need not be written; '
                'a mass in another unit has it behind the number: mass = "5 {mass}"',
                length=length, right_force=right[0], right_mass=right[1], mass=mass,
            )  # fmt: skip
        key = "mass_unit" if "mass_unit" in self.given else "force_unit"
        self.scope.report.at(("dynamics", key), message, hint)

    # ---- cells

    def _cell(
        self, symbol: str, given: Any, unit: Unit, path: Path, what: str, least: float = -math.inf
    ) -> Node | None:
        """A number or an expression over dimensions as a dimension of its own; None where it is faulty."""
        scope = self.scope
        given = scope.plain(given, unit.text, path)
        if given is BAD:
            return None
        value: Quantity
        if isinstance(given, str):
            tree = scope.parse(given, path)
            if tree is None or not scope.only_dimensions(tree, given, path):
                return None
            scope.in_its_unit(tree, given, unit, path)
            known = all(name in scope.numbers for name in symbols(tree))
            number = scope.value(tree, path) if known else None
            value = tree
        else:
            value = number = float(given)
        if number is not None and number < least:
            scope.report.at(path, say("a {what} is not negative: {number:.6g}", what=say(what), number=number))
        hint = say("rename it: this {what} has a cell of that name", what=say(what))
        scope.symbols.claim(symbol, what, path, hint)
        shown = value if isinstance(value, float) else None
        written = given if isinstance(given, str) else ""
        self.cells.append(Dimension(symbol, value, unit, shown=shown, written=written, path=path))
        return Symbol(symbol)

    def _own_place(self, value: Any, names: tuple[str, str], path: Path, link: Link) -> GivenPoint:
        """A place in a link's frame, its plain numbers as cells."""
        found = read_place(value, path, self.scope)
        if isinstance(found, Cartesian):
            parts: list[Quantity] = [found.x, found.y]
            for index, (name, part) in enumerate(zip(names, parts, strict=True)):
                if isinstance(part, float) and math.isfinite(part):
                    parts[index] = self._cell(name, part, self.scope.length, (*path, index), "coordinate") or part
            return Cartesian(parts[0], parts[1])
        if isinstance(found, Distances):
            for other in (found.first, found.second):
                if other and other not in link.points:
                    self.scope.no_point_of(link.name, other, link.points, (*path, "distances", other))
        return found

    def _spot(self, value: Any, names: tuple[str, str], path: Path, link: Link) -> str | GivenPoint:
        """A point of the link by name, or a place in its frame."""
        if isinstance(value, str):
            if value not in link.points:
                self.scope.no_point_of(link.name, value, link.points, path)
            return value
        return next(iter(link.points), "") if value is BAD else self._own_place(value, names, path, link)

    # ---- masses

    def _has_mass(self, link: Link, bodies: dict[str, Any]) -> bool:
        keys = keys_of(bodies, link.name)
        if keys and link is self.links[0]:
            message = say("the ground does not move: its mass changes nothing")
            self.scope.report.at(("links", link.name, keys[0]), message, say("take it away"))
            return False
        if keys == ["center"]:
            self.scope.report.at(("links", link.name, "center"), say("goes with `mass`"))
            return False
        return bool(keys)

    def _mass(self, link: Link, entry: dict[str, Any]) -> Mass:
        n, path = link.number, ("links", link.name)
        length = "m" if self.metre else self.scope.length_unit
        mass = inertia = None
        if "mass" in entry:
            mass = self._cell(f"m_{n}", entry["mass"], Unit("label", self.mass_unit), (*path, "mass"), "mass", 0.0)
        assumed = "mass" in entry and "inertia" not in entry and self.scope.moves and link.name not in self.straight
        if "inertia" in entry or assumed:
            unit = Unit("label", inertia_label(self.mass_unit, length))
            inertia = self._cell(f"J_{n}", entry.get("inertia", 0), unit, (*path, "inertia"), "moment of inertia", 0.0)
        own = center_symbol(n)
        names = (f"x_{own}", f"y_{own}")
        if "center" in entry:
            center = self._spot(entry["center"], names, (*path, "center"), link)
        else:
            center = next(iter(link.points), "")
            if "mass" in entry and len(link.points) != 1:
                message = say(
                    "the link {name} has {count} points: its mass needs a `center`",
                    name=quoted(link.name),
                    count=len(link.points),
                )
                self.scope.report.at((*path, "mass"), message, say('write center = "…" or center = [x, y]'))
        return Mass(link.name, mass, center, inertia, assumed)

    def _acts_downwards(self, given: Any, path: Path) -> None:
        """Report a number below 0, which would act upwards."""
        found = measured(given) if isinstance(given, str) else None
        number = found.value if found else given
        if isinstance(number, int | float) and number < 0:
            hint = say("leave the minus out; upwards it is [0, {up:g}]", up=-number)
            self.scope.report.at(
                path, say("gravity counts downwards: {number:g} would act upwards", number=number), hint
            )

    def _gravity(self) -> tuple[Node, Node]:
        """Its components; one number points downwards."""
        given = self.given.get("gravity", 0)
        path: Path = ("dynamics", "gravity")
        unit = Unit("label", f"{'m' if self.metre else self.scope.length_unit}/s²")
        if isinstance(given, list):
            parts = [
                al.ZERO if part == 0 else self._cell(f"g_{axis}", part, unit, (*path, index), "gravity") or al.ZERO
                for index, (axis, part) in enumerate(zip("xy", given, strict=True))
            ]
            return parts[0], parts[1]
        if "gravity" not in self.given or given is BAD:
            return al.ZERO, al.ZERO
        self._acts_downwards(given, path)
        return al.ZERO, al.neg(self._cell("g", given, unit, path, "gravity") or al.ZERO)

    # ---- loads

    def _load(self, number: int, entry: dict[str, Any]) -> Load | Spring | None:
        path: Path = ("loads", number)
        scope = self.scope
        name = entry.get("name", f"L{number + 1}")
        if name is BAD or (reason := symbol_fault(name)):
            if name is not BAD:
                scope.report.at((*path, "name"), say("the name {name} {reason}", name=quoted(name), reason=reason))
            name = f"L{number + 1}"
        if "between" in entry:
            return self._spring(name, number, entry)
        for key in ("stiffness", "free_length", "damping"):
            if key in entry:
                scope.report.at((*path, key), say("goes with `between`: the two points that a spring joins"))
        if "link" not in entry:
            scope.report.at((*path, "link"), say("is missing: the link that is loaded"))
        link = next((one for one in self.links if one.name == entry.get("link", BAD)), None)
        if link is None:
            if entry.get("link", BAD) is not BAD:
                hint = suggestion(entry["link"], [one.name for one in self.links[1:]], "moving links")
                scope.report.at((*path, "link"), say("no link is called {name}", name=quoted(entry["link"])), hint)
            return None
        if link is self.links[0]:
            message = say("{name} is the ground: a load on it changes nothing", name=quoted(link.name))
            scope.report.at((*path, "link"), message, say("load a moving link, or take it away"))
            return None
        if "torque" in entry:
            for key in ("point", "frame"):
                if key in entry:
                    scope.report.at((*path, key), say("goes with `force`: a torque is the same wherever it acts"))
            torque = self._effort(name, entry["torque"], self.torque, (*path, "torque"))
            return None if torque is None else Load(name, number, link.name, torque=torque)
        if "force" not in entry:
            return None  # reported already
        given = entry["force"]
        point = self._point(entry, name, path, link)
        if given is BAD:
            return None
        x, y = (
            self._effort(f"{name}_{axis}", part, self.force, (*path, "force", index))
            for index, (axis, part) in enumerate(zip("xy", given, strict=True))
        )
        if x is None or y is None:
            return None
        return Load(name, number, link.name, point, (x, y), in_link=entry.get("frame") == "link")

    def _spring(self, name: str, number: int, entry: dict[str, Any]) -> Spring | None:
        path: Path = ("loads", number)
        scope = self.scope
        for key in ("link", "point", "frame"):
            if key in entry:
                scope.report.at((*path, key), say("goes with a force: a spring has its two points in `between`"))
        points = entry["between"] if entry["between"] is not BAD else []
        ends = []
        for place, point in enumerate(points):
            owner = next((link.name for link in self.links if point in link.points), None)
            if owner is None and point is not BAD:
                scope.no_point(point, (*path, "between", place))
            elif owner is not None:
                ends.append((owner, point))
        if len(ends) == 2 and ends[0][0] == ends[1][0]:
            message = say(
                "both points belong to the link {link}: the spring never changes its length", link=quoted(ends[0][0])
            )
            scope.report.at(
                (*path, "between"), message, say("each point belongs to the first link, in the file's order")
            )
        length = scope.length_unit
        units = {
            "stiffness": Unit("label", f"{self.force_unit}/{length}"),
            "free_length": scope.length,
            "damping": Unit("label", f"{self.force_unit} s/{length}"),
        }
        cells = [
            self._cell(f"{letter}_{name}", entry[key], unit, (*path, key), key.replace("_", " "), 0.0)
            if entry.get(key, 0) != 0
            else al.ZERO
            for letter, (key, unit) in zip("klc", units.items(), strict=True)
        ]
        if len(ends) < 2 or any(cell is None for cell in cells):
            return None
        stiffness, free, damping = (cell or al.ZERO for cell in cells)
        return Spring(name, number, (ends[0], ends[1]), stiffness, free, damping)

    def _point(self, entry: dict[str, Any], name: str, path: Path, link: Link) -> str | GivenPoint:
        if "point" in entry:
            return self._spot(entry["point"], (f"x_{name}", f"y_{name}"), (*path, "point"), link)
        if len(link.points) != 1:
            message = say(
                "the link {name} has {count} points: the force needs a `point`",
                name=quoted(link.name),
                count=len(link.points),
            )
            self.scope.report.at(path, message, suggestion("", link.points, say("points of {link}", link=link.name)))
        return next(iter(link.points), "")

    def _effort(self, symbol: str, given: Any, unit: Unit, path: Path) -> Node | None:
        """A number, or an expression over dimensions, as a cell; one that differs from row to row as it is."""
        scope = self.scope
        given = scope.plain(given, unit.text, path)
        if given is BAD:
            return None
        if given == 0 and not isinstance(given, str):
            return al.ZERO
        if not isinstance(given, str):
            return self._cell(symbol, given, unit, path, "load")
        tree = scope.parse(given, path)
        if tree is None:
            return None
        names = symbols(tree)
        if all(name in scope.units for name in names):
            return self._cell(symbol, given, unit, path, "load")
        known = [self._may_read(name, given, path) for name in names]  # every fault, not the first alone
        return tree if all(known) else None

    def _may_read(self, name: str, text: str, path: Path) -> bool:
        """True for a dimension, a position or a rate; reports what else it is."""
        scope = self.scope
        point, dot, axis = name.partition(".")
        where = within(text, name)
        if name in scope.units or name in scope.variables or (dot and point in scope.points and axis in ("x", "y")):
            return True
        if scope.is_rate(name):
            check_speed(name, path, scope, where)
            return True
        if name in scope.forces:
            what = scope.forces[name]
            message = say(
                "{where}{name} is a {what}: loads may read positions and rates, no forces",
                where=where,
                name=quoted(name),
                what=say(what),
            )
            scope.report.at(path, message, say("give the link a point there") if what == CENTER else "")
        elif name in scope.outputs:
            scope.report.at(
                path,
                say(
                    "{where}{name} is an output; loads read positions, rates and dimensions",
                    where=where,
                    name=quoted(name),
                ),
            )
        else:
            hint = scope.meant(name) or suggestion(
                name, [*scope.variables, *scope.units, *scope.rates_there], "allowed"
            )
            scope.report.at(
                path,
                say("{where}{name} is not a position, a rate or a dimension", where=where, name=quoted(name)),
                hint,
            )
        return False


# --- the flywheel -----------------------------------------------------------------------------------------------------

_PATH: Path = ("flywheel",)


def declare_flywheel(given: dict[str, Any], scope: Scope) -> None:
    """Enter the name of the column that it brings."""
    if given:
        scope.symbols.claim(
            ENERGY, "energy of the flywheel", _PATH, say("rename it: the flywheel's energy has a column")
        )
        scope.charted[ENERGY] = None


def read_flywheel(
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
    if speed is None or acceleration is None or abs(scope.number(acceleration)) > 0.0:
        hint = say("give one number as `speed`, and no `acceleration`")
        return [(say("a flywheel needs a constant speed: this one varies"), hint)]
    return [(say("a flywheel needs a speed: at rest it stores no energy"), "")] if scope.number(speed) == 0.0 else []
