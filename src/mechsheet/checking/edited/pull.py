"""Inputs that a person has changed in a workbook, back into its description: `mechsheet pull`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from livesheet.diagnostics import Fault, WorkbookError, readable_name
from livesheet.formats import read
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
from livesheet.formula.references import cell_address
from livesheet.said import say
from mechsheet.checking.comparison import text_of
from mechsheet.checking.edited.edits import same
from mechsheet.checking.edited.inserted_rows import moves_between, undone
from mechsheet.checking.inputs import Expected, description_or_fault, expected_for, inside
from mechsheet.description import loads
from mechsheet.description.driving.driver import LANDS
from mechsheet.description.report import located
from mechsheet.description.text.index import Path as Place
from mechsheet.description.text.rewrite import number_text, with_number, without_key, without_origin
from mechsheet.description.text.source import Source, parse, read_text
from mechsheet.diagnostics import DescriptionError, MechanismError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.points_in_link import number
from mechsheet.library.modes_from_sketch import numbered_anew, with_modes
from mechsheet.model import Mechanism
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.plan import TOLERANCE, VALUE

Key = tuple[str | int, ...]
"""Where a value belongs: ("dimensions", "a2"), ("tolerance", "a2"), ("mode", "mode_1"), ("driver", "start"),
("driver", "speed"), ("driver", "speed", 3), ("driver", "motion", "duration"), ("driver", "values", 3),
("tables", 0, "columns", 2), ("tables", 0, "rows", 1), ("links", "crank", "mass"), ("loads", 0, "force", 1)."""


@dataclass(frozen=True, slots=True)
class Change:
    """One input cell whose number is another one; both as the cell has them. `now` None: a tolerance that was emptied."""

    key: Key
    was: float | None
    now: float | None

    @property
    def name(self) -> str:
        """What a person calls it."""
        match self.key:
            case ("tolerance", symbol):
                return say("tolerance of {symbol}", symbol=symbol)
            case ("driver", "values", int(index)):
                return say("driver value {index}", index=index + 1)
            case ("drivers", int(order), "values", int(index)):
                return say("value {index} of driver {order}", index=index + 1, order=order + 2)
            case ("drivers", int(order), str(key)):
                return say("{key} of driver {order}", key=key, order=order + 2)
            case ("joints", int(order), str(key)):
                return say("{key} of joint {order}", key=key, order=order + 1)
            case ("driver", str(key), int(index)):
                return say("{key} {index} of the driver", key=key, index=index + 1)
            case ("tables", int(table), str(heads), int(index)):
                return say(
                    "{key} {index} of table {table}", key=heads.removesuffix("s"), index=index + 1, table=table + 1
                )
            case ("synthesised", symbol):
                return say("{symbol}, taken out of the synthesis", symbol=symbol)
            case ("synthesis", *place):
                named = " ".join(str(part + 1) if isinstance(part, int) else str(part) for part in place)
                return say("the task's {named}", named=named)
            case ("links", str(link), str(key), *part):
                return say("{key} of {link}{axis}", key=key, link=link, axis=_axis(part))
            case ("loads", int(number), str(key), *part):
                return say("{key} of load {number}{axis}", key=key, number=number + 1, axis=_axis(part))
        return str(self.key[1]) if self.key[0] != "driver" else say("{key} of the driver", key=self.key[-1])


def _axis(part: Sequence[object]) -> str:
    """`, x` or `, y` of a coordinate; "" of what has none."""
    return "".join(f", {'xy'[int(str(axis))]}" for axis in part)


def changes_in(book: Book, expected: Expected, shown: str) -> list[Change]:
    """All of them. Raises WorkbookError where an input cell holds something else than a number."""
    found: list[Change] = []
    faults: list[Fault] = []
    for key, (title, row, col) in input_places(expected):
        sheet, original = book.sheet(title), expected.book.sheet(title)
        if sheet is None or original is None:
            faults.append(Fault(say('the sheet "{title}" is missing', title=title), shown))
            break
        was, now = original.constants.get(row, col), sheet.constants.get(row, col)
        cell = cell_address(title, row, col)
        if sheet.formula_at(row, col) is not None:
            faults.append(Fault(say("holds a formula now; only numbers can be taken over"), shown, key=cell))
        elif not same(was, now):
            number = _number(now)
            if number is None and not (now is None and key[0] == "tolerance"):
                what = text_of(now) or say("an empty cell")
                faults.append(Fault(say("must hold a number, not {what}", what=what), shown, key=cell))
                continue
            found.append(Change(key, _number(was), number))
    if faults:
        raise WorkbookError(faults)
    return found + _typed_over(book, expected)


def _typed_over(book: Book, expected: Expected) -> list[Change]:
    """Dimensions of a synthesis in whose place a number stands: they are no results any more."""
    plan, task = expected.plan, expected.plan.mechanism.synthesis
    found = []
    for symbol in task.taken if task else ():
        spot = plan.at.spots[symbol]
        sheet = book.sheet(spot.sheet)
        number = None if sheet is None else _number(sheet.constants.get(spot.row, spot.col))
        if sheet is not None and number is not None and sheet.formula_at(spot.row, spot.col) is None:
            found.append(Change(("synthesised", symbol), None, number))
    return found


def _number(value: Scalar) -> float | None:
    if isinstance(value, bool) or not isinstance(value, float | int) or not math.isfinite(value):
        return None
    return float(value)


def input_places(expected: Expected) -> Iterator[tuple[Key, tuple[str, int, int]]]:
    """Every input that a description keeps, and its cell: not the position shown."""
    plan = expected.plan
    mechanism = plan.mechanism
    keys = {dim.symbol: dim.path for dim in mechanism.dimensions if dim.path and not dim.derived}
    found = {} if mechanism.synthesis is None else mechanism.synthesis.taken
    for symbol, given in keys.items():
        spot = plan.at.spots[symbol]
        yield given, (spot.sheet, spot.row, spot.col)
    for symbol, row in plan.blocks["dimensions"].rows.items():
        if symbol in keys or symbol in found:
            continue
        yield ("dimensions", symbol), (plan.main, row, VALUE)
        if mechanism.layout == "sheets":
            yield ("tolerance", symbol), (plan.main, row, TOLERANCE)
    if "assembly" in plan.blocks:
        for symbol, row in plan.blocks["assembly"].rows.items():
            if mechanism.synthesis is not None and symbol in mechanism.synthesis.mode:
                continue
            yield ("mode", symbol), (plan.main, row, VALUE)
    if "sweep" in plan.blocks:
        for key in ("start", "step"):
            if isinstance(getattr(mechanism.driver, key), float):
                yield ("driver", key), (plan.main, plan.blocks["sweep"].rows[key], VALUE)
    kept = dict(zip(mechanism.driver_rates, ("speed", "acceleration"), strict=True))
    besides = {driver.symbol: driver.order for driver in mechanism.drivers}
    for symbol, listed in mechanism.listed.items():
        for index, value in enumerate(listed):
            if isinstance(value, float):
                own: Key = ("driver", kept.get(symbol, "values"), index)
                other: Key = ("drivers", besides[symbol], "values", index) if symbol in besides else own
                yield other, (plan.table, plan.at.first + index, plan.at.spots[symbol].col)
    yield from _table_places(expected)


def _table_places(expected: Expected) -> Iterator[tuple[Key, tuple[str, int, int]]]:
    """The heads of the two-way tables: the input cells of their sheets, from left to right, then downwards."""
    requests = expected.plan.mechanism.tables
    for table in tables_of(expected.plan):
        index = next(number for number, request in enumerate(requests) if request is table.request)
        for heads, quantities, cells in table.heads():
            for place, (quantity, cell) in enumerate(zip(quantities, cells, strict=True)):
                if isinstance(quantity, float):
                    yield ("tables", index, heads, place), (table.title, *cell)


@dataclass(frozen=True, slots=True)
class Pulled:
    """The description with what was changed in the workbook; `changes` in words, one each."""

    text: str
    changes: tuple[str, ...]


def pull(workbook: str | Path, into: str | Path | None = None) -> Pulled:
    """Bring the inputs of an edited workbook into the description it carries, or into the one in the file `into`.

    Dimensions, tolerances, the driver's values, the heads of two-way tables, and modes (as a sketch that means them).
    Comments, order and all else of the text stay. A value that was changed in both, differently, is a conflict. Raises
    MechsheetError with everything that is wrong; then there is no text.
    """
    path = Path(workbook)
    shown = readable_name(path)
    book = read(path)
    base = expected_for(description_or_fault(book, shown), inside(shown))
    changes = changes_in(undone(book, moves_between(base.book, book)), base, shown)
    file = inside(shown) if into is None else readable_name(into)
    raw = without_origin(base.plan.mechanism.text).rstrip("\n") + "\n" if into is None else read_text(into)
    source = parse(raw, file)
    target = base
    if into is not None:
        target = expected_for(source.text, file)
        _refuse_another(base.plan.mechanism, target.plan.mechanism, shown, file)
        changes = _merged(changes, base, target, source, shown)
    # A byte-order mark and Windows' line ends are the file's own: they come back.
    mark = "\ufeff" if raw.startswith("\ufeff") else ""
    ends = "\r\n" if "\r\n" in raw else "\n"
    new = _written(source, changes, target, file)
    return Pulled(mark + new.text.replace("\n", ends), tuple(_words(change) for change in changes))


def _words(change: Change) -> str:
    was = say("not given") if change.was is None else number_text(change.was)
    now = say("taken away") if change.now is None else number_text(change.now)
    return say("{name}: {was} -> {now}", name=change.name, was=was, now=now)


# --- another description -------------------------------------------------------------------------------------------


def _refuse_another(built: Mechanism, mine: Mechanism, shown: str, file: str) -> None:
    """Raise DescriptionError when a description is of another mechanism than the one that the workbook was built from.

    That is: another name, or links, points and sliding joints that are not there any more. New ones may have come.
    """
    hint = say("a length of the same name may mean another one there; enter the changes by hand")
    if built.name != mine.name:
        message = say(
            'describes "{name}"; {shown} was built from "{other}"', name=mine.name, shown=shown, other=built.name
        )
        raise DescriptionError(Fault(message, file, key="mechanism.name", hint=hint))
    bodies = {link.name: link for link in mine.links}
    faults = [
        Fault(
            say(
                'has no link "{name}" with the points {points}, as {shown} has',
                name=link.name,
                points=", ".join(link.points),
                shown=shown,
            ),
            file,
            hint=hint,
        )
        for link in built.links
        if link.name not in bodies or not set(link.points) <= set(bodies[link.name].points)
    ]
    joints = {(joint.kind, joint.link, joint.on, joint.point) for joint in mine.joints}
    faults += [
        Fault(
            say(
                'has no joint of "{link}" on "{on}" at {point}, as {shown} has',
                link=joint.link,
                on=joint.on,
                point=joint.point,
                shown=shown,
            ),
            file,
            hint=hint,
        )
        for joint in built.joints
        if (joint.kind, joint.link, joint.on, joint.point) not in joints
    ]
    if faults:
        raise DescriptionError(faults)


def _merged(changes: Sequence[Change], base: Expected, mine: Expected, source: Source, shown: str) -> list[Change]:
    """The changes that are still to be made in another description. Raises DescriptionError at conflicts."""
    places = dict(input_places(mine))
    faults: list[Fault] = []
    left: list[Change] = []
    for change in changes:
        if change.key not in places or _what(mine, change) != _what(base, change):
            message = say("the workbook has changed {name}; here that is no input, or something else", name=change.name)
            faults.append(Fault(message, source.file, key=change.name))
            continue
        held = _held(mine, places[change.key])
        if same(held, change.now):
            continue
        if same(held, change.was):
            left.append(change)
            continue
        message = say(
            "is {held} here and {now} in {shown}; it was {was} when that was built",
            held=_text(held),
            now=_text(change.now),
            shown=shown,
            was=_text(change.was),
        )
        faults.append(Fault(message, source.file, key=change.name, hint=say("make the two agree first")))
    if faults:
        raise DescriptionError(faults)
    return left


def _held(mine: Expected, place: tuple[str, int, int]) -> Scalar:
    sheet = mine.book.sheet(place[0])
    return None if sheet is None else sheet.constants.get(*place[1:])


def _text(value: Scalar) -> str:
    return number_text(value) if isinstance(value, float | int) else say("not given")


def _what(expected: Expected, change: Change) -> object:
    """What a change is about: in two descriptions it must be the same, with the same unit."""
    mechanism, plan = expected.plan.mechanism, expected.plan
    match change.key:
        case ("dimensions" | "tolerance", symbol):
            return [(dim.unit, dim.derived) for dim in mechanism.dimensions if dim.symbol == symbol]
        case ("mode", symbol):
            return [(group.kind, set(group.links)) for group in plan.equations.groups if group.mode == symbol]
        case ("driver", *_):
            driver = mechanism.driver
            return (driver.symbol, driver.unit, driver.link, driver.joint, plan.rows)
        case ("tables", int(table), str(heads), int()):
            request = mechanism.tables[table]
            down = heads == "rows"
            symbol, values = (request.rows, request.row_values) if down else (request.column, request.columns)
            return (symbol, [dim.unit for dim in mechanism.dimensions if dim.symbol == symbol], len(values))
    return None


# --- the new text --------------------------------------------------------------------------------------------------


def _written(source: Source, changes: Sequence[Change], target: Expected, file: str) -> Source:
    """The source with all changes. Raises DescriptionError when what comes out is no sound description."""
    modes = {group.mode: group.mode_value for group in target.plan.equations.groups if group.mode}
    for change in changes:
        if change.key[0] == "mode" and change.now is not None:
            group = next(group for group in target.plan.equations.groups if group.mode == change.key[1])
            modes[group.mode] = group.value_of(change.now)
        else:
            source = _with_change(source, change)
    if not changes:
        return source
    source = replace(_with_stop(source, changes, target), file=f"{file} with the changes")
    try:
        if target.plan.newton:
            modes = numbered_anew(loads(source.text, source.file), target.plan.equations.equations, modes)
        return with_modes(source, modes)
    except MechanismError as error:
        raise located(error, source.text, source.file) from error


def _with_change(source: Source, change: Change) -> Source:
    match change.key:
        case ("synthesised", str(symbol)):
            source = without_key(source, ("dimensions", symbol, "synthesis"))
            return with_number(source, ("dimensions", symbol, "value"), _given(change))
        case ("tolerance", str(symbol)):
            path: Place = ("dimensions", symbol, "tolerance")
            return without_key(source, path) if change.now is None else with_number(source, path, change.now)
        case ("tables", int(table), str(heads), int(index)):
            symbol = next(iter(source.data["tables"][table][heads]))
            return with_number(source, ("tables", table, heads, symbol, index), _given(change))
    return with_number(source, change.key, _given(change))


def _given(change: Change) -> float:
    if change.now is None:
        raise ValueError(f"{change.name} has no value")
    return change.now


def _with_stop(source: Source, changes: Sequence[Change], target: Expected) -> Source:
    """With the stop of the sweep where the workbook's last row is now: a workbook keeps its number of rows."""
    stepped = target.plan.mechanism.driver.stepped
    if not stepped or not any(change.key[0] == "driver" and len(change.key) == 2 for change in changes):
        return source
    rows = target.plan.rows
    start, stop, step = _sweep(target.plan.mechanism, ())
    landed = step != 0 and abs((stop - start) / step - (rows - 1)) < LANDS
    start, stop, step = _sweep(target.plan.mechanism, changes)
    if step == 0:
        return source  # the reader will say so
    steps = (stop - start) / step
    lands = abs(steps - (rows - 1)) < LANDS
    if math.floor(steps + LANDS) + 1 == rows and (lands or not landed):
        return source
    last = start + (rows - 1) * step
    return with_number(source, ("driver", "stop"), float(f"{last:.15g}"))


def _sweep(mechanism: Mechanism, changes: Sequence[Change]) -> tuple[float, float, float]:
    """Start, stop and step in the unit of the driver, with the changes."""
    changed = {change.key: change.now for change in changes if change.now is not None}
    dimensions = tuple(
        replace(dim, value=dim.unit.to_internal(changed[key]))
        if (key := ("dimensions", dim.symbol)) in changed
        else dim
        for dim in mechanism.dimensions
    )
    values = dimension_values(replace(mechanism, dimensions=dimensions))
    driver = mechanism.driver

    def shown(key: str) -> float:
        if ("driver", key) in changed:
            return changed["driver", key]
        return driver.unit.to_shown(number(getattr(driver, key), values))

    return shown("start"), shown("stop"), shown("step")
