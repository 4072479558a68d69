"""What is driven, its symbol, and the values it takes: the part [driver], and beside it [[drivers]], whose values may follow
from others."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, symbols
from livesheet.said import say
from mechsheet.description.grammar import MOST_ROWS
from mechsheet.description.joints import Ends
from mechsheet.description.kinds import ANGLE, LENGTH
from mechsheet.description.report import BAD, found, suggestion
from mechsheet.description.scope import Scope, circle_message, cycles, own_cell
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Dimension, Driver, FurtherDriver, Joint, Link, Quantity, TableRequest
from mechsheet.units import Unit

LANDS = 1e-9
"""`stop` counts as reached when the steps miss it by this part of a step."""


def read(data: Any, links: tuple[Link, ...], joints: tuple[Joint, ...], ends: Ends, scope: Scope) -> Driver | None:
    """The driver, when its faults let one be made; its symbol becomes a variable."""
    if data is BAD:
        scope.complete = False
        return None
    made = driven(data, ("driver",), links, joints, ends, scope)
    if made is None:
        scope.complete = False
    kind, unit = kind_and_unit(data, scope)
    start, stop, step, values = _values(data, kind, scope)
    if made is None:
        return None
    symbol, link, relative_to, joint = made
    return Driver(symbol, unit, link, relative_to, joint, start, stop, step, values)


Driven: TypeAlias = tuple[str, str, str, str]
"""Symbol, link, the one it turns against, joint."""


def rows_of(driver: Driver, scope: Scope) -> int | None:
    """How many rows the driver has; None where a fault hides it."""
    if driver.law is not None:
        return driver.law.rows
    if driver.values:
        return len(driver.values)
    start, stop, step = (scope.number(part) for part in (driver.start, driver.stop, driver.step))
    if not all(map(math.isfinite, (start, stop, step))) or step == 0:
        return None
    return _rows(start, stop, step)


def _rows(start: float, stop: float, step: float) -> int:
    return math.floor((stop - start) / step + LANDS) + 1


def driven(
    data: dict[str, Any], path: Path, links: tuple[Link, ...], joints: tuple[Joint, ...], ends: Ends, scope: Scope
) -> Driven | None:
    """What the table at `path` drives; None where that is faulty."""
    return _sliding(data, path, joints, scope) if _slides(data) else _turning(data, path, links, ends, scope)


def _slides(data: dict[str, Any]) -> bool:
    return "joint" in data and "link" not in data


def kind_and_unit(data: dict[str, Any], scope: Scope) -> tuple[str, Unit]:
    """What the driver's values are, ANGLE or LENGTH, and the unit in which they are written."""
    if _slides(data) and "segments" not in data:
        return LENGTH, scope.length
    return ANGLE, scope.angle_unit


def _sliding(data: dict[str, Any], place: Path, joints: tuple[Joint, ...], scope: Scope) -> Driven | None:
    if "relative_to" in data:
        message = say("goes with `link`; a driven joint has its two links already")
        scope.report.at((*place, "relative_to"), message)
    name = data["joint"]
    joint = next((one for one in joints if one.name == name), None)
    if joint is None:
        if name is not BAD and scope.complete:
            hint = suggestion(name, [one.name for one in joints], "sliding joints")
            scope.report.at((*place, "joint"), say("no sliding joint is called {name}", name=quoted(name)), hint)
        return None
    symbol = data.get("symbol", joint.symbol)
    if symbol not in (BAD, joint.symbol):
        message = say("the driven displacement is called {symbol} already", symbol=quoted(joint.symbol))
        hint = say("leave it out here, or give the same symbol to the joint")
        scope.report.at((*place, "symbol"), message, hint)
    return joint.symbol, "", "", joint.name


def _turning(data: dict[str, Any], place: Path, links: tuple[Link, ...], ends: Ends, scope: Scope) -> Driven | None:
    ground = links[0].name
    link, other = data.get("link", BAD), data.get("relative_to", ground)
    known = ends.has_link(link, (*place, "link"))
    known = ends.has_link(other, (*place, "relative_to")) and known
    if not known:
        return None
    if link == other:
        message = say("the link {link} cannot turn: it is `relative_to` as well", link=quoted(link))
        hint = say("")
        if link == ground:
            message = say("the link {link} cannot turn: it is the ground", link=quoted(link))
            hint = say("the first link of the file is the ground: write the fixed link first")
        scope.report.at((*place, "link"), message, hint)
        return None
    if link == ground:
        message = say("the link {link} is the ground", link=quoted(link))
        hint = say('drive the other one: link = "{other}", with the opposite sign of the values', other=other)
        scope.report.at((*place, "link"), message, hint)
        return None
    own = next(one.angle_symbol for one in links if one.name == link)
    default = own if other == ground else ends.pair_symbol("theta", other, link)
    symbol = data.get("symbol", default)
    path: Path = (*place, "symbol") if "symbol" in data else place
    if symbol is BAD or not scope.symbol_is_good(symbol, path):
        return None
    if symbol != own or other != ground:
        scope.add_variable(symbol, ANGLE, "driver", path)
    return symbol, link, other, ""


def _values(data: dict[str, Any], kind: str, scope: Scope) -> tuple[Quantity, Quantity, Quantity, tuple[Quantity, ...]]:
    """(start, stop, step, values) in internal units."""
    path: Path = ("driver", "values")
    if "values" in data:
        given = data["values"] if data["values"] is not BAD else []
        values = tuple(scope.quantity(value, kind, (*path, place)) for place, value in enumerate(given))
        return 0.0, 0.0, 0.0, values
    start, stop, step = (scope.quantity(data.get(key, BAD), kind, ("driver", key)) for key in ("start", "stop", "step"))
    if "motion" in data:
        return start, stop, 0.0, ()
    check_sweep(scope.number(start), scope.number(stop), scope.number(step), data, scope)
    return start, stop, step, ()


def check_sweep(start: float, stop: float, step: float, data: dict[str, Any], scope: Scope) -> None:
    """Report a step of zero or with the wrong sign, and too many rows; `data` has the three as they are written."""
    path: Path = ("driver", "step")
    if step == 0:
        scope.report.at(path, say("the step is zero"))
    elif not all(math.isfinite(value) for value in (start, stop, step)):
        return
    elif (stop - start) * step < 0:
        shown = {key: _as_written(data[key]) for key in ("start", "stop", "step")}
        message = say("a step of {step} never leads from {start} to {stop}: it must be negative", **shown)
        if stop > start:
            message = say("a step of {step} never leads from {start} to {stop}: it must be positive", **shown)
        scope.report.at(path, message)
    elif (rows := _rows(start, stop, step)) > MOST_ROWS:
        message = say(
            "the sweep has {rows:,} rows; a sheet holds at most {most:,} below its headings",
            rows=rows,
            most=MOST_ROWS,
        )
        scope.report.at(path, message)


def _as_written(value: Any) -> str:
    return quoted(value) if isinstance(value, str) else found(value)


# --- what is driven besides -------------------------------------------------------------------------------------------


def read_further(
    data: list[Any], first: Driver | None, links: tuple[Link, ...], joints: tuple[Joint, ...], ends: Ends, scope: Scope
) -> tuple[tuple[FurtherDriver, ...], tuple[Dimension, ...]]:
    """The further drivers, each after those that it follows, and the cells of their values."""
    cells: list[Dimension] = []
    made: list[tuple[FurtherDriver, dict[str, Any]]] = []
    for order, entry in enumerate(data):
        found = None if entry is BAD else driven(entry, ("drivers", order), links, joints, ends, scope)
        if found is None:
            scope.complete = False
            continue
        symbol, link, relative_to, joint = found
        _, unit = kind_and_unit(entry, scope)
        made.append((FurtherDriver(symbol, unit, order, link, relative_to, joint), entry))
    _check_apart(first, [driver for driver, _ in made], scope)
    names = dict.fromkeys([*([first.symbol] if first else ()), *(driver.symbol for driver, _ in made)])
    drivers = [_with_values(driver, entry, first, names, cells, scope) for driver, entry in made]
    return _in_order([driver for driver in drivers if driver is not None], scope), tuple(cells)


def _check_apart(first: Driver | None, drivers: list[FurtherDriver], scope: Scope) -> None:
    """No joint is driven twice."""
    taken = {_what(first): "[driver]"} if first else {}
    for driver in drivers:
        other = taken.setdefault(_what(driver), f"number {driver.order + 1} of [[drivers]]")
        if other != f"number {driver.order + 1} of [[drivers]]":
            key = "joint" if driver.joint else "link"
            message = say("{name} is driven already, by {other}", name=quoted(driver.joint or driver.link), other=other)
            scope.report.at(("drivers", driver.order, key), message, say("drive another joint"))


def _what(driver: Driver | FurtherDriver) -> frozenset[str]:
    return frozenset({driver.link, driver.relative_to, driver.joint})


def _with_values(
    driver: FurtherDriver,
    entry: dict[str, Any],
    first: Driver | None,
    names: dict[str, None],
    cells: list[Dimension],
    scope: Scope,
) -> FurtherDriver | None:
    """The driver with what gives its values; None where that is faulty."""
    kind, unit = kind_and_unit(entry, scope)
    path: Path = ("drivers", driver.order)
    if "value" in entry:
        node = own_cell(
            scope,
            cells,
            f"{driver.symbol}_0",
            entry["value"],
            kind,
            unit,
            (*path, "value"),
            f"value of {driver.symbol}",
        )
        return replace(driver, follows=node)
    if "follows" in entry:
        node_or_none = _follows(entry["follows"], kind, (*path, "follows"), names, scope)
        return None if node_or_none is None else replace(driver, follows=node_or_none)
    given = entry.get("values", BAD)
    if given is BAD:
        scope.complete = False
        return None
    values = tuple(scope.quantity(value, kind, (*path, "values", index)) for index, value in enumerate(given))
    rows = None if first is None else rows_of(first, scope)
    if rows is not None and rows != len(values):
        message = say(
            "{count} values, where [driver] has {rows} rows: one is needed for each", count=len(values), rows=rows
        )
        if len(values) == 1:
            message = say("1 value, where [driver] has {rows} rows: one is needed for each", rows=rows)
        scope.report.at((*path, "values"), message)
    return replace(driver, values=values)


def _follows(text: Any, kind: str, path: Path, names: dict[str, None], scope: Scope) -> Node | None:
    """An expression over dimensions and other drivers."""
    tree = None if text is BAD else scope.parse(text, path)
    if tree is None:
        return None
    wrong = [name for name in symbols(tree) if name not in scope.units and name not in names]
    for name in wrong:
        message = say("in {text}: {name} is neither a dimension nor a driver", text=quoted(text), name=quoted(name))
        if name in scope.variables:
            message = say("in {text}: {name} is not driven", text=quoted(text), name=quoted(name))
        hint = suggestion(name, [*names, *scope.units], "allowed")
        scope.report.at(path, message, hint)
    return None if wrong or not scope.fits(tree, text, kind, path) else tree


def _in_order(drivers: list[FurtherDriver], scope: Scope) -> tuple[FurtherDriver, ...]:
    needs = {one.symbol: symbols(one.follows) if one.follows is not None else () for one in drivers}
    order, circles = cycles(needs)
    by_symbol = {one.symbol: one for one in drivers}
    for circle in circles:
        path: Path = ("drivers", by_symbol[circle[0]].order, "follows")
        scope.report.at(path, circle_message(circle, "the drivers"))
    return tuple(by_symbol[symbol] for symbol in order)


def listed(first: Driver, further: tuple[FurtherDriver, ...], scope: Scope) -> Driver:
    """The driver with its values one by one where another one's are listed, row by row: these belong to rows."""
    rows = None if first is None else rows_of(first, scope)
    if first.values or rows is None or not any(other.values for other in further):
        return first
    start, step = (al.number(part) if isinstance(part, float) else part for part in (first.start, first.step))
    plain = isinstance(first.start, float) and isinstance(first.step, float)
    values = tuple(
        scope.number(first.start) + row * scope.number(first.step)
        if plain
        else al.add(start, al.mul(al.number(float(row)), step))
        for row in range(rows)
    )
    return replace(first, start=0.0, stop=0.0, step=0.0, values=values)


def check_speeds(first: Driver | None, further: tuple[FurtherDriver, ...], scope: Scope) -> None:
    """Where the driver has a speed, each other must say by a formula how it moves."""
    for driver in further:
        if scope.moves and driver.values and first is not None:
            message = say("{symbol} is a list of values, which says nothing of its speed", symbol=quoted(driver.symbol))
            hint = say("write `follows` in place of `values`, or take `speed` out of [driver]")
            scope.report.at(("drivers", driver.order, "values"), message, hint)


def check_tables(further: tuple[FurtherDriver, ...], tables: tuple[TableRequest, ...], scope: Scope) -> None:
    """A two-way table computes its own rows: what is listed row by row has no value there."""
    for driver in further:
        if driver.values and tables:
            message = say(
                "two-way tables have no value of {symbol}, which is listed row by row", symbol=quoted(driver.symbol)
            )
            hint = say("write `follows` or `value` in place of `values`, or take the tables away")
            scope.report.at(("drivers", driver.order, "values"), message, hint)
