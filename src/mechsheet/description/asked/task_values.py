"""Changing the task of a synthesis as the command line asks: `theta.2=95`, `psi=[60,80,105]`, `A.moving.1=3`."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from typing import Any

from mechsheet.description.asked.synthesis import unit_in
from mechsheet.description.index import Path
from mechsheet.description.quoting import quoted
from mechsheet.description.rewrite import with_value
from mechsheet.description.source import Source
from mechsheet.description.typed_value import scope_for, typed_value
from mechsheet.diagnostics import Fault
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
    """`theta`, `theta.2`, `stroke` -> where it stands below [synthesis]; items count from 1."""
    task = source.data.get("synthesis")
    found = _numbers(task, ()) if isinstance(task, dict) else iter(())
    return {".".join(str(part + 1) if isinstance(part, int) else part for part in place): place for place in found}


def task_names(source: Source) -> list[str]:
    """What of the task can be changed."""
    return list(_places(source))


def task_place(source: Source, name: str) -> Path | None:
    """Where the task has what is called so; None where it has nothing of the kind."""
    return _places(source).get(name)


def with_task_value(source: Source, place: Path, value: str, option: str) -> tuple[Source, list[Fault]]:
    """The source with another number, or another list of numbers, of its task; and what is wrong with it."""
    path: Path = ("synthesis", *place)
    if path not in source.spots:
        return source, []
    is_list, wants_list = value.strip().startswith("["), (*path, 0) in source.spots
    if is_list or wants_list:
        return _with_list(source, path, value, option, is_list and wants_list)
    scope = scope_for(source, option)
    kind = KINDS.get(str(source.data["synthesis"].get("kind")))
    unit = unit_in(place, kind, scope) if kind else NUMBER  # without a kind the reader will complain
    text = typed_value(value, unit, "its", scope)
    return (source if text is None else with_value(source, path, text)), scope.report.faults


def _with_list(source: Source, path: Path, value: str, option: str, fits: bool) -> tuple[Source, list[Fault]]:
    hint = "for example --set psi=[60,80,105], or --set psi.2=80 for one of them"
    try:
        found = tomllib.loads(f"value = {value}")["value"] if fits else None
    except tomllib.TOMLDecodeError:
        found = None
    if not isinstance(found, list) or not all(_plain(item) for item in found):
        message = f"expected a list of numbers, found {quoted(value.strip())}"
        if not fits and value.strip().startswith("["):
            message, hint = f"expected a number, found the list {quoted(value.strip())}", ""
        return source, [Fault(message, source.file, key=option, hint=hint)]
    return with_value(source, path, value.strip()), []


def _plain(item: Any) -> bool:
    """A number, or a list of them (a pose)."""
    if isinstance(item, list):
        return all(_plain(part) for part in item)
    return isinstance(item, int | float) and not isinstance(item, bool)
