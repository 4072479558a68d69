"""What is asked of the motion: [summary], [[charts]] and [[tables]]; and the names that these, and outputs, may read."""

from __future__ import annotations

from typing import Any

from livesheet.formula.nodes import Symbol
from livesheet.said import say
from mechsheet.description.driving.driver import rows_of
from mechsheet.description.driving.rates import known as known_rate
from mechsheet.description.report import BAD, listed, suggestion
from mechsheet.description.schema import MOST_CELLS, MOST_PAIRS
from mechsheet.description.scope import Scope, words
from mechsheet.description.text.index import Path
from mechsheet.diagnostics import quoted
from mechsheet.model import TAKES, ChartRequest, Driver, Ends, Quantity, Summary, TableRequest


def declare(outputs: dict[str, Any], summaries: dict[str, Any], scope: Scope) -> None:
    """Enter the names of outputs and summaries."""
    for table, what, names in (("outputs", "output", outputs), ("summary", "summary", summaries)):
        for name in names:
            path: Path = (table, name)
            if scope.symbol_is_good(name, path):
                scope.symbols.claim(name, what, path)
    whole = {name: entry for name, entry in summaries.items() if entry is not BAD}
    scope.summaries |= {name: entry["of"] for name, entry in whole.items()}
    scope.takes |= {name: TAKES[entry["take"]] for name, entry in whole.items() if entry["take"] is not BAD}


def is_coordinate(name: str, path: Path, scope: Scope, where: str = "") -> bool:
    """True for `C.x` and `C.y` of a known point; reports other names with a dot."""
    point, dot, axis = name.partition(".")
    if not dot:
        return False
    if point in scope.outputs:
        message = say("{where}the output {name} has no {axis}", where=where, name=quoted(point), axis=quoted(axis))
        hint = say("angles, displacements and points have rates: write it with those, as theta13.d, s14.v, C.vx")
        scope.report.at(path, message, hint)
    elif point not in scope.points:
        hint = scope.meant(name) or suggestion(point, scope.points, "points")
        if point in scope.centers:
            hint = say(
                "the mass centre is the point {center}: write {center}.{axis}",
                center=scope.centers[point],
                axis=axis,
            )
        scope.report.at(path, say("{where}no point is called {point}", where=where, point=quoted(point)), hint)
    elif axis not in ("x", "y"):
        hint = say("write {point}.x or {point}.y", point=point)
        if scope.moves:
            hint = say(
                "write {point}.x or {point}.y; {point}.v, {point}.a for its velocity and acceleration", point=point
            )
        scope.report.at(path, say("{where}a point has no {axis}", where=where, axis=quoted(axis)), hint)
    return point in scope.points and axis in ("x", "y")


def check_column(name: Any, path: Path, scope: Scope) -> None:
    """`name` must be a variable, a coordinate or an output: something with a value in every row."""
    if name is BAD or name in scope.variables or name in scope.outputs or known_rate(name, path, scope):
        return
    if is_coordinate(name, path, scope) or "." in name or not scope.complete:
        return
    allowed = [*scope.variables, *scope.outputs, *scope.coordinates, *scope.rates_there, *scope.forces]
    hint = scope.meant(name) or suggestion(name, allowed, "allowed")
    message = say("no variable or output is called {name}", name=quoted(name))
    if name in scope.charted:
        message = say("{name} follows from all rows together: only charts can show it", name=quoted(name))
        hint = say("")
    if name in scope.motion_outputs:
        message = say(
            "{name} is an output of summaries, one number of the whole motion: it has no value in a row",
            name=quoted(name),
        )
    if name in scope.units:
        message = say(
            "{name} is a dimension, the same in every row; a variable or an output is needed", name=quoted(name)
        )
    scope.report.at(path, message, hint)


def summaries(data: dict[str, Any], scope: Scope) -> tuple[Summary, ...]:
    """Single numbers from a whole sweep."""
    result = []
    for name, entry in data.items():
        if entry is BAD:
            continue
        path: Path = ("summary", name)
        check_column(entry["of"], (*path, "of"), scope)
        cell = scope.cell(entry, path)
        if name in scope.takes:
            result.append(Summary(name, entry["of"], scope.takes[name], words(entry.get("label")), cell))
    return tuple(result)


def charts(data: list[Any], driver: Driver | None, scope: Scope) -> tuple[ChartRequest, ...]:
    """The charts asked for; `driver` is None when a fault hides it."""
    result = []
    for place, entry in enumerate(data):
        if entry is BAD:
            continue
        path: Path = ("charts", place)
        x = entry.get("x", "")
        given = (entry.get(key, []) for key in ("y", "paths", "hodographs"))
        y, paths, hodographs = ([] if names is BAD else names for names in given)
        if x:
            _check_curve(x, (*path, "x"), driver, scope)
        for number, name in enumerate(y):
            if name not in scope.charted:
                _check_curve(name, (*path, "y", number), driver, scope)
        for key, names in (("paths", paths), ("hodographs", hodographs)):
            for number, name in enumerate(names):
                if name is not BAD and name not in scope.points:
                    scope.no_point(name, (*path, key, number))
        for key, names in (("y", y), ("paths", paths), ("hodographs", hodographs)):
            _check_twice(names, (*path, key), scope)
        _check_moves(paths, (*path, "paths"), scope)
        if hodographs:
            _check_velocities(hodographs, (*path, "hodographs"), scope)
        shape = entry.get("profile") is True
        if entry.get("profile") is False:
            scope.report.at((*path, "profile"), say("a chart that is not wanted is left out"))
        if shape and not scope.of_cam:
            scope.report.at((*path, "profile"), say("there is no cam: a profile is that of [cam]"))
        ends = [_ends_of_axis(entry, axis, path, scope) for axis in ("x", "y")]
        result.append(
            ChartRequest(words(entry.get("title")), x, tuple(y), tuple(paths), tuple(hodographs), shape, *ends)
        )
    return tuple(result)


def _ends_of_axis(entry: dict[str, Any], axis: str, path: Path, scope: Scope) -> Ends:
    """Where an axis of curves begins and ends, where the description says so; paths are drawn at true scale."""
    low, high = (None if entry.get(key) is BAD else entry.get(key) for key in (f"{axis}_min", f"{axis}_max"))
    for key, end in (("min", low), ("max", high)):
        if end is not None and not entry.get("y"):
            scope.report.at((*path, f"{axis}_{key}"), say("a chart at true scale has no axes of its own"))
    if low is not None and high is not None and low >= high:
        scope.report.at((*path, f"{axis}_max"), say("an axis ends above where it begins"))
    return low, high


def _check_twice(names: list[Any], path: Path, scope: Scope) -> None:
    for number, name in enumerate(names):
        if name is not BAD and name in names[:number]:
            scope.report.at((*path, number), say("{name} is listed twice", name=quoted(name)))


def _check_velocities(names: list[Any], path: Path, scope: Scope) -> None:
    """A hodograph needs points that move, and the driver's speed."""
    for number, name in enumerate(names):
        if name in scope.fixed:
            message = say("{name} is a point of the ground: it has no velocity", name=quoted(name))
            scope.still(message, (*path, number))
    if not scope.moves:
        scope.report.at(
            path, say("a hodograph shows velocities: it needs the driver's speed"), say("write `speed` in [driver]")
        )


def _check_curve(name: Any, path: Path, driver: Driver | None, scope: Scope) -> None:
    """A curve is drawn over a column: what is the same in every row has one cell."""
    check_column(name, path, scope)
    rates = [rate.name for rate in (driver.speed, driver.acceleration) if isinstance(rate, Symbol)] if driver else []
    fixed = isinstance(name, str) and name.endswith((".x", ".y")) and name[:-2] in scope.fixed
    if fixed or (driver and name in rates and not (driver.speeds if name == rates[0] else driver.accelerations)):
        message = say("{name} is the same in every row: it has no column that a chart could show", name=quoted(name))
        scope.report.at(path, message, say('give it one: an output with formula = "{name} + 0"', name=name))


def _check_moves(names: list[Any], path: Path, scope: Scope) -> None:
    """A chart of paths needs a point that moves; fixed points beside it are marks in the picture."""
    if names and all(name in scope.fixed for name in names):
        message = say("{points} is a point of the ground: what does not move has no path", points=listed(names))
        if len(names) > 1:
            message = say("{points} are points of the ground: what does not move has no path", points=listed(names))
        scope.still(message, path)


def tables(data: list[Any], driver: Driver | None, scope: Scope) -> tuple[TableRequest, ...]:
    """The two-way tables asked for; `driver` is None when a fault hides it."""
    result = []
    for place, entry in enumerate(data):
        if entry is BAD:
            continue
        path: Path = ("tables", place)
        rows, value, title = entry["rows"], entry["value"], words(entry.get("title"))
        column, values = _values_of_input(entry["columns"], (*path, "columns"), scope)
        if isinstance(rows, dict):
            row, row_values = _values_of_input(rows, (*path, "rows"), scope)
            _check_summary(value, (*path, "value"), driver, scope)
            _check_pairs(row, row_values, column, values, driver, path, scope)
            result.append(TableRequest(row, column, values, value, title, row_values))
            continue
        if driver is not None and rows not in (BAD, driver.symbol):
            message = say(
                "expected the driver's symbol {symbol}, found {found}", symbol=quoted(driver.symbol), found=quoted(rows)
            )
            hint = ""
            if rows in scope.inputs:
                hint = say("over two dimensions a table shows a summary: rows = {{ {rows} = […] }}", rows=rows)
            scope.report.at((*path, "rows"), message, hint)
        if value is not BAD and value in scope.summaries:
            message = say(
                "{value} is a summary, one number of the whole sweep: over the driver it has one value only",
                value=quoted(value),
            )
            scope.report.at((*path, "value"), message, say("give a second input: rows = { a2 = [40, 45, 50] }"))
        else:
            check_column(value, (*path, "value"), scope)
            _check_position(value, (*path, "value"), scope)
        result.append(TableRequest(rows, column, values, value, title))
    return tuple(result)


def _check_summary(name: Any, path: Path, driver: Driver | None, scope: Scope) -> None:
    """Over two dimensions the cells hold a summary, of what differs with them and can be written in one cell."""
    if name is BAD:
        return
    if name not in scope.summaries:
        message = say("no summary is called {name}", name=quoted(name))
        if name in scope.motion_outputs:
            message = say(
                "{name} is an output of summaries: in a table over two dimensions each cell is one summary",
                name=quoted(name),
            )
        if name in scope.variables or name in scope.outputs or "." in name:
            message = say(
                "{name} differs from row to row: over two dimensions the cells hold a summary", name=quoted(name)
            )
        of_it = [summary for summary, of in scope.summaries.items() if of == name]
        scope.report.at(path, message, suggestion(name, of_it or scope.summaries, "summaries"))
        return
    of = scope.summaries[name]
    if driver is not None and of == driver.symbol:
        message = say(
            "{name} is of the driver, whose values are the same in every cell of the table", name=quoted(name)
        )
        scope.report.at(path, message)
    else:
        _check_position(of, path, scope, say("a line of the first sheet shows it"))


def _check_pairs(
    row: str,
    row_values: tuple[Quantity, ...],
    column: str,
    values: tuple[Quantity, ...],
    driver: Driver | None,
    path: Path,
    scope: Scope,
) -> None:
    """Two different inputs, and no more cells than a sheet is good for."""
    if row and row == column:
        scope.report.at((*path, "columns", column), say("{row} goes down already: give another input", row=quoted(row)))
    pairs = len(row_values) * len(values)
    rows = (rows_of(driver, scope) or 0) if driver is not None else 0
    if pairs > MOST_PAIRS:
        message = say(
            "the table has {rows} x {columns} = {pairs:,} cells; at most {most} have a summary",
            rows=len(row_values),
            columns=len(values),
            pairs=pairs,
            most=MOST_PAIRS,
        )
        scope.report.at((*path, "rows"), message, say("give fewer values"))
    elif pairs * rows > MOST_CELLS:
        message = say(
            "{rows} x {columns} cells over {values:,} values of the driver are {cells:,} helper cells; "
            "at most {most:,} are made",
            rows=len(row_values),
            columns=len(values),
            values=rows,
            cells=pairs * rows,
            most=MOST_CELLS,
        )
        scope.report.at((*path, "rows"), message, say("give fewer values, or a larger step"))


def _check_position(name: Any, path: Path, scope: Scope, hint: str = "") -> None:
    """A two-way table holds positions, one formula a cell: a rate would need its whole group there."""
    if name is BAD or not scope.reads_rates(name):
        return
    message = say(
        "{name} is a velocity, an acceleration or a force: two-way tables have positions only", name=quoted(name)
    )
    if name in scope.forces:
        what = say(scope.forces[name])
        message = say("{name} is a {what}: two-way tables have positions only", name=quoted(name), what=what)
    elif name in scope.of_rates and scope.forces:
        message = say(
            "{name} reads a velocity, an acceleration or a force: two-way tables have positions only", name=quoted(name)
        )
    elif name in scope.of_rates:
        message = say(
            "{name} reads a velocity or an acceleration: two-way tables have positions only", name=quoted(name)
        )
    elif not scope.forces:
        message = say("{name} is a velocity or an acceleration: two-way tables have positions only", name=quoted(name))
    scope.report.at(path, message, hint or say("a summary or a chart can show it"))


def _values_of_input(data: Any, path: Path, scope: Scope) -> tuple[str, tuple[Quantity, ...]]:
    """The input that differs from column to column (or from row to row), and its values in internal units."""
    if data is BAD:
        return "", ()
    name, values = next(iter(data.items()))
    if name not in scope.units:
        message = say("no dimension is called {name}", name=quoted(name))
        scope.report.at((*path, name), message, suggestion(name, scope.inputs, "inputs"))
    elif name not in scope.inputs:
        message = say("the dimension {name} is derived; only an input can differ from row to row", name=quoted(name))
        if path[-1] == "columns":
            message = say(
                "the dimension {name} is derived; only an input can differ from column to column", name=quoted(name)
            )
        scope.report.at((*path, name), message, suggestion(name, scope.inputs, "inputs"))
    elif values is not BAD:
        unit, kind = scope.units[name], scope.kinds[name]
        return name, tuple(
            scope.quantity(value, kind, (*path, name, number), unit) for number, value in enumerate(values)
        )
    return name, ()
