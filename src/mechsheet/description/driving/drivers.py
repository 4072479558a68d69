"""The part [[drivers]]: what is driven beside [driver], and by what its values are given."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, symbols
from livesheet.said import say
from mechsheet.description.driving import driver as first_driver
from mechsheet.description.joints import Ends
from mechsheet.description.own_cells import own_cell
from mechsheet.description.report import BAD, suggestion
from mechsheet.description.scope import Scope, circle_message, cycles
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import Dimension, Driver, FurtherDriver, Joint, Link, TableRequest


def read(
    data: list[Any], first: Driver | None, links: tuple[Link, ...], joints: tuple[Joint, ...], ends: Ends, scope: Scope
) -> tuple[tuple[FurtherDriver, ...], tuple[Dimension, ...]]:
    """The further drivers, each after those that it follows, and the cells of their values."""
    cells: list[Dimension] = []
    made: list[tuple[FurtherDriver, dict[str, Any]]] = []
    for order, entry in enumerate(data):
        found = None if entry is BAD else first_driver.driven(entry, ("drivers", order), links, joints, ends, scope)
        if found is None:
            scope.complete = False
            continue
        symbol, link, relative_to, joint = found
        _, unit = first_driver.kind_and_unit(entry, scope)
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
    kind, unit = first_driver.kind_and_unit(entry, scope)
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
    rows = None if first is None else first_driver.rows_of(first, scope)
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
    rows = None if first is None else first_driver.rows_of(first, scope)
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
