"""Dimensions that were changed in a workbook, back into its description: `mechsheet pull`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from livesheet.diagnostics import Fault, readable_name
from livesheet.formats import read
from livesheet.formula.nodes import Scalar
from livesheet.said import say
from mechsheet.checking.edited.changes import Change, changes_in, input_places
from mechsheet.checking.edited.edits import same
from mechsheet.checking.edited.expected import Expected, expected_for, inside
from mechsheet.checking.edited.inserted_rows import moves_between, undone
from mechsheet.checking.perturbation import description_or_fault
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
