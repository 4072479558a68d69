"""XMATCH and XLOOKUP."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...formula.nodes import Missing, Node
from ..texts.searching import EXACT, EXPRESSION, LARGER, SMALLER, WILDCARD, Line
from ..values.calling import table_of
from ..values.cells import (
    NA,
    VALUE,
    Cells,
    choose,
    codes_of,
    error,
    errors_of,
    first_error,
)
from ..values.coerce import numbers_of
from ..values.frames import Frame

if TYPE_CHECKING:
    from ..interpreter.evaluator import Evaluator

Args = tuple[Node, ...]


def _mode(ev: Evaluator, args: Args, place: int, frame: Frame, allowed: tuple[int, ...]) -> tuple[int, int]:
    """(a mode, the code of the error that is in its place or 0)."""
    if place >= len(args) or isinstance(args[place], Missing):
        return allowed[0], 0
    numbers, errors = numbers_of(ev.value(args[place], frame), ev.texts)
    if errors is not None and np.any(errors):
        return 0, int(np.ravel(errors)[0])
    mode = int(np.trunc(np.ravel(numbers)[0]))
    return mode, 0 if mode in allowed else VALUE


def _places(ev: Evaluator, args: Args, modes: int, frame: Frame, spread: bool) -> tuple[Any, Any, Any] | Cells:
    """(places with -1 for nowhere, errors or None, the array searched), or the error instead."""
    table = table_of(ev, args[1], frame)
    mode, fault = _mode(ev, args, modes, frame, (EXACT, SMALLER, LARGER, WILDCARD, EXPRESSION))
    direction, other = _mode(ev, args, modes + 1, frame, (1, -1, 2, -2))
    if mode == WILDCARD and direction in (2, -2):
        other = VALUE
    if fault or other:
        return error(fault or other)
    if 1 not in table.numbers.shape:
        return error(VALUE)
    line = Line(table, ev.texts, backwards=direction in (-1, -2))
    wanted = ev.value(args[0], frame, spread)
    numbers, codes = np.broadcast_arrays(wanted.numbers, codes_of(wanted))
    known: dict[tuple[float, int], int] = {}
    keys = list(zip(numbers.ravel().tolist(), codes.ravel().tolist(), strict=True))
    for key in keys:
        if key not in known:
            known[key] = line.place(*key, mode)
    found = np.array([known[key] for key in keys], np.intp).reshape(numbers.shape)
    return found, errors_of(wanted), table


def xmatch(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """XMATCH(value, array, match mode, search mode)."""
    found = _places(ev, args, 2, frame, spread)
    if isinstance(found, Cells):
        return found
    places, errors, _ = found
    missing = np.where(places < 0, np.uint8(NA), np.uint8(0))
    codes = first_error(errors, missing if np.any(missing) else None)
    return Cells(np.where(places < 0, np.nan, places + 1.0), codes)


def xlookup(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """XLOOKUP(value, array, results, if not found, match mode, search mode): a whole row or column of the results."""
    found = _places(ev, args, 4, frame, spread)
    if isinstance(found, Cells):
        return found
    places, errors, searched = found
    results = table_of(ev, args[2], frame)
    down = searched.numbers.shape[1] == 1 and (searched.numbers.shape[0] > 1 or results.numbers.shape[0] == 1)
    if results.numbers.shape[0 if down else 1] != searched.numbers.size:
        return error(VALUE)
    lines = results if down else Cells(results.numbers.T, results.codes.T)
    picked = _picked(lines, places, down)
    missing = places < 0
    if np.any(missing):
        given = len(args) > 3 and not isinstance(args[3], Missing)
        picked = choose(missing, ev.value(args[3], frame, spread) if given else error(NA), picked)
    return picked if errors is None else choose(errors != 0, Cells(np.nan, errors), picked)


def _picked(lines: Cells, places: Any, down: bool) -> Cells:
    """The line of results at each place: single values, or arrays for a single value or the cells of a frame."""
    safe = np.maximum(places, 0)
    width = lines.numbers.shape[1]
    if width == 1 or places.ndim > 2:
        numbers, codes = lines.numbers[safe, 0], lines.codes[safe, 0]
        return Cells(numbers, codes if np.any(codes) else None)
    numbers, codes = (np.moveaxis(part[safe], -1, 0) for part in (lines.numbers, lines.codes))
    while numbers.ndim < 3:
        numbers, codes = numbers[:, None], codes[:, None]
    shaped = (slice(None), None) if not down else (None, slice(None))
    return Cells(numbers[shaped], codes[shaped] if np.any(codes) else None)


KERNELS: dict[str, Any] = {"XMATCH": xmatch, "XLOOKUP": xlookup}
