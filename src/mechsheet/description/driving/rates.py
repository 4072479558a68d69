"""Velocities and accelerations: the driver's own in [driver], the points of [rates], and what all of them are called."""

from __future__ import annotations

from typing import Any, Literal

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Call, Node, Symbol, symbols, walk
from livesheet.said import reason, say
from mechsheet.description.driving import motion_laws
from mechsheet.description.driving.motion_laws import Motion
from mechsheet.description.force_names import OF_MOTION
from mechsheet.description.kinds import ANY
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import measured
from mechsheet.description.text.rewrite import OWN_CELLS
from mechsheet.diagnostics import quoted
from mechsheet.model import Dimension, Driver, Joint, Link, Quantity, rate_symbols
from mechsheet.units import RAD, Unit

_SIXTIETH = al.div(al.PI, al.number(30.0))
_FACTORS: dict[str, Node] = {"deg/s": al.div(al.PI, al.number(180.0)), "rpm": _SIXTIETH}
_FACTORS |= {"deg/s^2": _FACTORS["deg/s"], "rpm/s": _SIXTIETH}
assert _FACTORS.keys() == {*OWN_CELLS}
"""Unit -> radians per second (per second) of one of it."""

_WITH_CORNERS = {"ABS": "abs", "SIGN": "sign", "MIN": "min", "MAX": "max", "IF": "where"}
"""Functions without a derivative somewhere, and what a description calls them."""

Key = Literal["speed", "acceleration"]


def declare(links: tuple[Link, ...], joints: tuple[Joint, ...], driver: Driver | None, data: Any, scope: Scope) -> None:
    """Enter the names of all rates; where the driver has a speed they must be free."""
    names = {name: link.angle_symbol for link in links[1:] for name in link.rate_symbols}
    names |= {name: joint.symbol for joint in joints for name in rate_symbols(joint.symbol, False)}
    if driver is not None:
        names |= dict.fromkeys(_names(links, driver), driver.symbol)
    scope.rates = dict.fromkeys(names)
    scope.moves = isinstance(data, dict) and ("speed" in data or "motion" in data)
    if not scope.moves:
        return
    if "motion" in data:
        motion_laws.declare(data, scope)
    for name, of in names.items():
        scope.symbols.claim(
            name, say("rate of {of}", of=of), ("driver", "speed"), say("rename it: the driver has a speed")
        )
    for joint in joints:
        for link in scope.points.get(joint.symbol, ())[:1]:
            message = say(
                "the point has the name of a displacement: {symbol}.v would be the velocity of either",
                symbol=joint.symbol,
            )
            scope.report.at(("links", link, "points", joint.symbol), message, say("rename one of them"))


def _names(links: tuple[Link, ...], driver: Driver) -> tuple[str, str]:
    turned = next((link for link in links if link.name == driver.link), None)
    own = turned is not None and driver.relative_to == links[0].name
    return rate_symbols(turned.angle_symbol if turned and own else driver.symbol, not driver.joint)


def motion(data: dict[str, Any], links: tuple[Link, ...], driver: Driver, scope: Scope) -> Motion | None:
    """The driver's speed and acceleration, when it has a speed and no fault hides it."""
    if not scope.moves:
        if "acceleration" in data:
            scope.report.at(("driver", "acceleration"), say("goes with `speed`"), say("a driver at rest has speed = 0"))
        return None
    names = _names(links, driver)
    if "motion" in data:
        units = (_unit("speed", driver, scope), _unit("acceleration", driver, scope))
        return motion_laws.read(data, driver, names, units, scope)
    speed, cells = _rate("speed", data["speed"], names[0], driver, scope)
    acceleration: Node | None
    if "acceleration" in data:
        acceleration, more = _rate("acceleration", data["acceleration"], names[1], driver, scope)
        cells += more
    elif speed is not None and driver.symbol in symbols(speed):
        acceleration = _as_speed_changes(speed, data["speed"], driver.symbol, scope)
    else:
        acceleration = Symbol(names[1])
        cells += (_cell("acceleration", names[1], 0.0, driver, scope),)
    if speed is None or acceleration is None:
        return None
    keys: tuple[Key, Key] = ("speed", "acceleration")
    lists = (_listed(key, data.get(key), data, driver, scope) for key in keys)
    return Motion(speed, acceleration, cells, None, *lists)


def _listed(key: Key, given: Any, data: dict[str, Any], driver: Driver, scope: Scope) -> tuple[Quantity, ...]:
    """The speeds or accelerations that are listed; none where they are not."""
    if not isinstance(given, list):
        return ()
    path: Path = ("driver", key)
    values = data.get("values", BAD)
    if "values" not in data:
        scope.report.at(
            path,
            say("a list of them goes with `values`: one {key} for each", key=key),
            say("or give one for all rows"),
        )
    elif values is not BAD and len(values) != len(given):
        message = say("has {count} numbers for {rows} values of the driver", count=len(given), rows=len(values))
        if len(given) == 1:
            message = say("has 1 number for {rows} values of the driver", rows=len(values))
        scope.report.at(path, message, say("give one {key} for each of `values`", key=key))
    unit = _unit(key, driver, scope)
    return tuple(scope.quantity(each, ANY, (*path, place), unit) for place, each in enumerate(given))


def _unit(key: Key, driver: Driver, scope: Scope) -> Unit:
    """Radians or lengths per second, per second squared."""
    unit = scope.length if driver.joint else RAD
    return unit.per_time() if key == "speed" else unit.per_time().per_time()


def _cell(key: Key, symbol: str, value: Quantity, driver: Driver, scope: Scope, text: str = "") -> Dimension:
    shown = value if isinstance(value, float) else None
    return Dimension(symbol, value, _unit(key, driver, scope), shown=shown, written=text, path=("driver", key))


def _rate(key: Key, given: Any, name: str, driver: Driver, scope: Scope) -> tuple[Node | None, tuple[Dimension, ...]]:
    """What the driver's rate is, over dimensions and the driver, and the cells it needs; None where it is faulty."""
    path: Path = ("driver", key)
    if given is BAD:
        return None, ()
    if isinstance(given, list):
        return Symbol(name), ()
    if isinstance(given, dict):
        return _in_unit(key, given, name, driver, scope)
    if isinstance(given, str) and (found := measured(given)) is not None:
        if found.unit in _FACTORS and not driver.joint:
            return _in_unit(key, {"value": found.value, "unit": found.unit}, name, driver, scope)
        given = scope.plain(given, _unit(key, driver, scope).text, path)
        if given is BAD:
            return None, ()
    if not isinstance(given, str):
        return Symbol(name), (_cell(key, name, float(given), driver, scope),)
    tree = scope.parse(given, path)
    if tree is None or not scope.only_dimensions(tree, given, path, driver.symbol):
        return None, ()
    if driver.symbol in symbols(tree):
        return tree, ()
    if all(symbol in scope.numbers for symbol in symbols(tree)) and scope.value(tree, path) is None:
        return None, ()
    return Symbol(name), (_cell(key, name, tree, driver, scope, given),)


def _in_unit(
    key: Key, given: dict[str, Any], name: str, driver: Driver, scope: Scope
) -> tuple[Node | None, tuple[Dimension, ...]]:
    """A number in a unit of its own: the cell that people fill in, and the rate in the program's units that follows."""
    value, unit = given["value"], given["unit"]
    if value is BAD or unit is BAD:
        return None, ()
    per = "s" if key == "speed" else "s^2"
    plain = f"{scope.length_unit}/{per}" if driver.joint else f"rad/{per}"
    turning = ("deg/s", "rpm") if key == "speed" else ("deg/s^2", "rpm/s")
    allowed = [plain] if driver.joint else [plain, *turning]
    word = unit.strip().replace("°", "deg").replace("²", "^2")
    if word not in allowed:
        what = say("a displacement") if driver.joint else say("an angle")
        message = say("{unit} is no unit of this {key}: the driver is {what}", unit=quoted(unit), key=key, what=what)
        scope.report.at(("driver", key, "unit"), message, suggestion(unit, allowed, "units"))
        return None, ()
    if word == plain:
        return Symbol(name), (_cell(key, name, value, driver, scope),)
    scope.symbols.claim(
        key, f"driver's {key}", ("driver", key), f"rename it: the {key} in {word} has a cell of its own"
    )
    shown = Unit("label", word.replace("deg", "°").replace("^2", "²"))
    cell = Dimension(key, value, shown, shown=value, path=("driver", key))
    scope.numbers[key] = value
    tree = al.mul(Symbol(key), _FACTORS[word])
    return Symbol(name), (cell, _cell(key, name, tree, driver, scope, f"{key}*pi/{180 if 'deg' in word else 30}"))


def _as_speed_changes(speed: Node, text: str, symbol: str, scope: Scope) -> Node | None:
    """speed · d(speed)/d(driver)."""
    path: Path = ("driver", "speed")
    corners = [
        _WITH_CORNERS[part.name] for part in walk(speed) if isinstance(part, Call) and part.name in _WITH_CORNERS
    ]
    if corners:
        message = say(
            "{text} depends on the driver and has no derivative where {corner} has a corner",
            text=quoted(text),
            corner=corners[0],
        )
        scope.report.at(path, message, say("give the driver an `acceleration`"))
        return None
    try:
        return al.mul(speed, derivative(speed, symbol))
    except ValueError as error:
        scope.report.at(
            path,
            say("{text} depends on the driver: {error}", text=quoted(text), error=reason(error)),
            say("give the driver an `acceleration`"),
        )
        return None


def points(data: dict[str, Any], scope: Scope) -> tuple[str, ...] | None:
    """The points whose rates are wanted; None where the description does not say."""
    if data and not scope.moves:
        scope.report.at(("rates",), say("needs the driver's speed"), say("write `speed` in [driver]"))
    if "points" not in data or data["points"] is BAD:
        return None
    found = []
    for place, name in enumerate(data["points"]):
        path: Path = ("rates", "points", place)
        if name is BAD:
            continue
        if name not in scope.points:
            scope.no_point(name, path)
        elif name in scope.fixed:
            scope.still(say("{name} is a point of the ground: it does not move", name=quoted(name)), path)
        elif name in found:
            scope.report.at(path, say("{name} is listed twice", name=quoted(name)))
        found.append(name)
    return tuple(found)


def known(name: str, path: Path, scope: Scope) -> bool:
    """True for a rate or a force; reports one that needs a speed of the driver where it has none."""
    if name in scope.forces:
        if not scope.moves and scope.forces[name] in OF_MOTION:
            message = say(
                "{name} is a {what}: it needs the driver's speed", name=quoted(name), what=say(scope.forces[name])
            )
            scope.report.at(path, message, say("write `speed` in [driver]"))
        return True
    if not scope.is_rate(name) or name in scope.units or name in scope.outputs:
        return False
    check_speed(name, path, scope)
    return True


def check_speed(name: str, path: Path, scope: Scope, where: str = "") -> None:
    """Report a rate that needs a speed of the driver where it has none; coefficients need none."""
    if not scope.moves and name not in scope.of_cam and not name.endswith((".d", ".dd", ".ddd")):
        message = say(
            "{where}{name} is a velocity or an acceleration: it needs the driver's speed",
            where=where,
            name=quoted(name),
        )
        scope.report.at(path, message, say("write `speed` in [driver]"))
