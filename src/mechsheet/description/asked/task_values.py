"""Changing the task of a synthesis as the command line asks: `theta.2=95`, `psi=[60,80,105]`, `A.moving.1=3`.

What the task does not say yet can be set, too: `round=0.5`; and another of its ways, in place of the one that is written:
`lam=4` instead of `best = true`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from typing import Any

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.description.asked.schema import SYNTHESIS
from mechsheet.description.asked.synthesis import unit_in
from mechsheet.description.grammar import Items, Shape, Table, Text, YesNo
from mechsheet.description.text.index import Path
from mechsheet.description.text.rewrite import with_value, without_key
from mechsheet.description.text.source import Source
from mechsheet.description.typed_value import scope_for, typed_value
from mechsheet.diagnostics import quoted
from mechsheet.synthesis.kinds import KINDS
from mechsheet.units import NUMBER


def _numbers(value: Any, place: Path) -> Iterator[Path]:
    """Where the numbers below a key stand, the lists of them first."""
    if isinstance(value, list):
        yield place
        for index, item in enumerate(value):
            yield from _numbers(item, (*place, index))
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from _numbers(item, (*place, key))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield place


def _places(source: Source) -> dict[str, Path]:
    """`theta`, `theta.2`, `stroke` -> where it stands below [synthesis], or would stand; items count from 1."""
    task = source.data.get("synthesis")
    said = _numbers(task, ()) if isinstance(task, dict) else ()
    places = (*said, *_shapes(source))
    return {".".join(str(part + 1) if isinstance(part, int) else part for part in place): place for place in places}


def _tables(source: Source) -> dict[Path, Table]:
    """The tables of keys that a task of its kind can have, the outer one and those in it, by where they stand."""
    task = source.data.get("synthesis")
    outer = SYNTHESIS.tables.get(str(task.get("kind"))) if isinstance(task, dict) else None
    if outer is None:
        return {}
    return {(): outer} | {(key,): each.shape for key, each in outer.keys.items() if isinstance(each.shape, Table)}


def _shapes(source: Source) -> dict[Path, Shape]:
    """Where a number, list of numbers or choice can stand: `lam`, `round`, `A.moving` -> its shape."""
    return {
        (*around, key): entry.shape
        for around, table in _tables(source).items()
        for key, entry in table.keys.items()
        if not isinstance(entry.shape, Table | Text)
    }


def task_names(source: Source) -> list[str]:
    """What of the task can be changed: what it says, then what it could say."""
    return list(_places(source))


def task_place(source: Source, name: str) -> Path | None:
    """Where the task has what is called so, or could have it; None where its kind has nothing of that name."""
    return _places(source).get(name)


def with_task_value(source: Source, place: Path, value: str, option: str) -> tuple[Source, list[Fault]]:
    """The source with another number, list of numbers or choice in its task, instead of a way that excludes it; and what
    is wrong with it."""
    path: Path = ("synthesis", *place)
    shape = _shapes(source).get(place)
    if isinstance(shape, YesNo):
        changed, faults = _with_choice(source, path, value, option)
    else:
        changed, faults = _with_numbers(source, place, value, option, isinstance(shape, Items))
    return (source, faults) if faults else (_without_others(changed, place), [])


def _without_others(source: Source, place: Path) -> Source:
    """The source without the keys that exclude what stands there."""
    *around, key = place
    table = _tables(source).get(tuple(around))
    for ways in table.ways if table else ():
        own = next((way for way in ways if key in way), None)
        for way in ways if own else ():
            for other in way if way != own else ():
                source = without_key(source, ("synthesis", *around, other))
    return source


def _with_choice(source: Source, path: Path, value: str, option: str) -> tuple[Source, list[Fault]]:
    if value.strip() != "true":
        return source, [
            Fault(say("expected true, found {value}", value=quoted(value.strip())), source.file, key=option)
        ]
    return with_value(source, path, "true"), []


def _with_numbers(source: Source, place: Path, value: str, option: str, whole_list: bool) -> tuple[Source, list[Fault]]:
    path: Path = ("synthesis", *place)
    is_list, wants_list = value.strip().startswith("["), whole_list or (*path, 0) in source.spots
    if is_list or wants_list:
        return _with_list(source, path, value, option, is_list and wants_list)
    scope = scope_for(source, option)
    kind = KINDS.get(str(source.data["synthesis"].get("kind")))
    unit = unit_in(place, kind, scope) if kind else NUMBER  # without a kind the reader will complain
    text = typed_value(value, unit, "its", scope)
    return (source if text is None else with_value(source, path, text)), scope.report.faults


def _with_list(source: Source, path: Path, value: str, option: str, fits: bool) -> tuple[Source, list[Fault]]:
    hint: str = say("for example --set psi=[60,80,105], or --set psi.2=80 for one of them")
    try:
        found = tomllib.loads(f"value = {value}")["value"] if fits else None
    except tomllib.TOMLDecodeError:
        found = None
    if not isinstance(found, list) or not all(_plain(item) for item in found):
        message = say("expected a list of numbers, found {value}", value=quoted(value.strip()))
        if not fits and value.strip().startswith("["):
            message, hint = say("expected a number, found the list {value}", value=quoted(value.strip())), ""
        return source, [Fault(message, source.file, key=option, hint=hint)]
    return with_value(source, path, value.strip()), []


def _plain(item: Any) -> bool:
    """A number, or a list of them (a pose)."""
    if isinstance(item, list):
        return all(_plain(part) for part in item)
    return isinstance(item, int | float) and not isinstance(item, bool)
