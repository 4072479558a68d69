"""Look-up and conditional sums: functions that search a range. The range is the same for the whole frame in most sheets,
and is searched for all cells of the frame at once; where it moves, each cell is evaluated by itself."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...formula.nodes import Call, CellRef, Local, Missing, RangeRef
from ..interpreter.calling import Args, given, need_one, one_number, spread_cells, table_of
from ..interpreter.closures import Evaluation
from ..interpreter.regions import gives_region, regions
from ..texts.searching import CRITERION, EXACT, EXPRESSION, LARGER, SMALLER, WILDCARD, Line
from ..values.cells import (
    BLANK,
    NA,
    REF,
    TEXT,
    VALUE,
    Cells,
    Frame,
    VaryingSizeError,
    choose,
    error,
    errors_of,
    first_error,
    fitted,
)
from ..values.coerce import Problem, caught, numbers_of, once_each, truths_of


def index(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """INDEX(range, row, column): 0 or nothing for the only row or column; #REF! outside."""
    row, row_errors = _argument(ev, args, 1, frame, spread)
    col, col_errors = _argument(ev, args, 2, frame, spread)
    if row_errors is None and col_errors is None and np.ndim(row) == 0 and np.ndim(col) == 0:
        if not spread:
            single = _indexed(ev, args, frame, float(row), float(col))
            if single is not None:
                return single
        part = _part(ev, args, frame, spread, len(args) == 2 or 0 in (int(row), int(col)))
        if part is not None:
            return part
    table = table_of(ev, args[0], frame)
    height, width = table.numbers.shape
    span = ev.span(args[0], frame)
    if span is not None:
        height, width = span.height, span.width  # beyond the data a whole column goes on, blank
    if len(args) == 2 and height == 1:
        row, col = np.where(width == 1, row, 1.0), np.where(width == 1, col, row)
    row, col = np.trunc(row), np.trunc(col)
    several = (np.equal(row, 0) & (height > 1)) | (np.equal(col, 0) & (width > 1))
    if np.count_nonzero(several) and (frame.rows > 1 or frame.cols > 1):
        raise VaryingSizeError  # a whole row or column, of which each cell takes the one beside it
    row, col = np.where(np.equal(row, 0), 1.0, row), np.where(np.equal(col, 0), 1.0, col)
    own = np.where(several, np.uint8(VALUE), np.uint8(0))
    outside = (row < 1) | (row > height) | (col < 1) | (col > width) | ~np.isfinite(row) | ~np.isfinite(col)
    own = np.where(outside, np.uint8(REF), own)
    own = np.where((row < 0) | (col < 0), np.uint8(VALUE), own)
    beyond = ~outside & ((row > table.numbers.shape[0]) | (col > table.numbers.shape[1]))
    safe = outside | beyond
    i, j = np.where(safe, 0, row - 1).astype(np.intp), np.where(safe, 0, col - 1).astype(np.intp)
    found = Cells(table.numbers[i, j], np.where(beyond, np.uint8(BLANK), table.codes[i, j]))
    return _or_error(found, first_error(row_errors, col_errors, own))


def _part(ev: Evaluation, args: Args, frame: Frame, spread: bool, whole: bool) -> Cells | None:
    """What INDEX means of a reference, or a whole row or column of an array; None for single cells of anything."""
    single = frame.rows == frame.cols == 1
    if not (single and spread) and not whole and len(args) < 4 and not isinstance(args[0], Call | Local):
        return None
    if gives_region(args[0]):
        found = regions(ev, Call("INDEX", args), frame)
        if found is not None:
            return found if isinstance(found, Cells) else ev.of_span(found[0], frame, spread)
    if not whole:
        return None
    if len(args) == 4 and float(_argument(ev, args, 3, frame, spread)[0]) != 1:
        return error(REF)
    table = table_of(ev, args[0], frame)
    row, col = (int(_argument(ev, args, place, frame, spread, 0.0)[0]) for place in (1, 2))
    height, width = table.numbers.shape
    if len(args) == 2 and height == 1:
        row, col = 0, row
    if row < 0 or col < 0:
        return error(VALUE)
    if row > height or col > width:
        return error(REF)
    place = slice(row - 1, row) if row else slice(None), slice(col - 1, col) if col else slice(None)
    return spread_cells(Cells(table.numbers[place], table.codes[place]))


def _indexed(ev: Evaluation, args: Args, frame: Frame, row: float, col: float) -> Cells | None:
    """The one cell of a fixed range that INDEX means everywhere in the frame; None in all less plain cases."""
    span = ev.span(args[0], frame)
    if span is None or span.moves_down or span.moves_right:
        return None
    if len(args) == 2 and span.height == 1 and span.width > 1:
        row, col = 1.0, row
    if not (1 <= row < span.height + 1 and 1 <= col < span.width + 1):
        return None
    return ev.at(span.sheet, span.row + int(row) - 1, span.col + int(col) - 1)


def _or_error(found: Cells, errors: Any) -> Cells:
    if errors is None or not np.count_nonzero(errors):
        return found if found.codes is None or np.count_nonzero(found.codes) else Cells(found.numbers)
    return choose(errors != 0, Cells(np.nan, errors), found)


def _argument(ev: Evaluation, args: Args, place: int, frame: Frame, spread: bool, default: float = 1.0) -> Any:
    """(numbers, error codes or None) of an argument that may be left out."""
    if place >= len(args):
        return np.float64(default), None
    if isinstance(args[place], Missing):
        return np.float64(0), None
    return numbers_of(ev.value(args[place], frame, spread), ev.texts)


def match(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """MATCH(value, range, type): 1 the last not above (ascending), 0 the first equal, -1 the last not below (descending)."""
    table = table_of(ev, args[1], frame)
    if 1 not in table.numbers.shape:
        return error(NA)
    kind = one_number(ev, args[2], frame, spread) if len(args) > 2 else 1.0
    line = Cells(table.numbers.ravel(), table.codes.ravel())
    places = positions(ev, ev.value(args[0], frame, spread), line, float(np.sign(kind)))
    return Cells(places.numbers + 1.0, places.codes)


def positions(ev: Evaluation, wanted: Cells, line: Cells, kind: float) -> Cells:
    """Where each wanted value stands in `line` (from 0), #N/A where it stands nowhere; errors of `wanted` first.

    kind  0 the first equal one, texts with wildcards; 1 the last not above, in ascending order; -1 the last not below, in
          descending order
    """
    search = Line(line, ev.texts, backwards=False)
    places, shape = once_each(lambda key: _place(search, *key[0], kind), (wanted,))
    found = np.array(places, np.float64).reshape(shape)
    missing = np.where(found < 0, np.uint8(NA), np.uint8(0))
    errors = first_error(errors_of(wanted), missing if np.count_nonzero(missing) else None)
    return Cells(np.where(found < 0, 0.0, found), errors)


def _place(search: Line, number: float, code: int, kind: float) -> int:
    if kind != 0:
        return search.beside(number, code, descending=kind < 0)
    return -1 if code == BLANK else search.place(number, code, CRITERION)  # a blank cell equals nothing here


def choose_(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """CHOOSE(number, first, second, …): #VALUE! outside; only the values chosen matter."""
    number, errors = numbers_of(ev.value(args[0], frame, spread), ev.texts)
    number = np.trunc(number)
    result = error(VALUE)
    for place, arg in enumerate(args[1:], 1):
        here = np.equal(number, place)
        if np.count_nonzero(here):
            value = given(ev, arg, frame, spread)
            result = value if np.all(here) else choose(here, value, result)
    return _or_error(result, errors)


def _line(cells: Cells, by_rows: bool, place: int) -> Cells:
    return (
        Cells(cells.numbers[:, place], cells.codes[:, place])
        if by_rows
        else Cells(cells.numbers[place], cells.codes[place])
    )


def _table_lookup(by_rows: bool) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        table = table_of(ev, args[1], frame)
        if table.codes.shape == (1, 1) and table.codes[0, 0] == TEXT and not isinstance(args[1], CellRef | RangeRef):
            return error(VALUE)
        wanted = ev.value(args[0], frame, spread)
        place, place_errors = numbers_of(ev.value(args[2], frame, spread), ev.texts)
        near: Any = np.True_
        near_errors: Any = None
        if len(args) > 3:
            how = ev.value(args[3], frame, spread)
            need_one(how)
            near, near_errors = truths_of(how, ev.texts)
        found = positions(ev, wanted, _line(table, by_rows, 0), 1.0 if near else 0.0)
        found, (place, place_errors) = fitted(found, Cells(place, place_errors))
        across = np.trunc(place)
        width = table.numbers.shape[1 if by_rows else 0]
        own = np.where(across < 1, np.uint8(VALUE), np.where(across > width, np.uint8(REF), np.uint8(0)))
        safe = np.where((own != 0) | np.isnan(across), 0, across - 1).astype(np.intp)
        along = found.numbers.astype(np.intp)
        at = (along, safe) if by_rows else (safe, along)
        errors = first_error(
            errors_of(wanted), place_errors, near_errors, own if np.count_nonzero(own) else None, found.codes
        )
        return _or_error(Cells(table.numbers[at], table.codes[at]), errors)

    return kernel


def lookup(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """LOOKUP(value, ascending line, line of results); with one table, its first and last row or column."""
    table = table_of(ev, args[1], frame)
    if len(args) > 2 and 1 not in table.numbers.shape:
        return error(NA)
    by_rows = table.numbers.shape[0] >= table.numbers.shape[1]
    found = positions(ev, ev.value(args[0], frame, spread), _line(table, by_rows, 0), 1.0)
    results = table_of(ev, args[2], frame) if len(args) > 2 else table
    line = Cells(results.numbers.ravel(), results.codes.ravel()) if len(args) > 2 else _line(table, by_rows, -1)
    along = found.numbers.astype(np.intp)
    if np.count_nonzero(along >= len(line.numbers)):
        return error(REF)
    return _or_error(Cells(line.numbers[along], line.codes[along]), found.codes)


# --- XMATCH and XLOOKUP ----------------------------------------------------------------------------------------------


def _mode(ev: Evaluation, args: Args, place: int, frame: Frame, spread: bool, allowed: tuple[int, ...]) -> int:
    """How it is searched: one of `allowed`, the first where it is left out. Raises Problem for any other."""
    if place >= len(args) or isinstance(args[place], Missing):
        return allowed[0]
    mode = int(one_number(ev, args[place], frame, spread))
    if mode not in allowed:
        raise Problem("#VALUE!")
    return mode


def _places(ev: Evaluation, args: Args, modes: int, frame: Frame, spread: bool) -> tuple[Any, Any, Any]:
    """(places with -1 for nowhere, errors or None, the array searched)."""
    table = table_of(ev, args[1], frame)
    mode = _mode(ev, args, modes, frame, spread, (EXACT, SMALLER, LARGER, WILDCARD, EXPRESSION))
    direction = _mode(ev, args, modes + 1, frame, spread, (1, -1, 2, -2))
    if (mode == WILDCARD and direction in (2, -2)) or 1 not in table.numbers.shape:
        raise Problem("#VALUE!")
    line = Line(table, ev.texts, backwards=direction in (-1, -2))
    wanted = ev.value(args[0], frame, spread)
    places, shape = once_each(lambda key: line.place(*key[0], mode), (wanted,))
    return np.array(places, np.intp).reshape(shape), errors_of(wanted), table


def xmatch(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """XMATCH(value, array, match mode, search mode)."""
    places, errors, _ = _places(ev, args, 2, frame, spread)
    missing = np.where(places < 0, np.uint8(NA), np.uint8(0))
    codes = first_error(errors, missing if np.count_nonzero(missing) else None)
    return Cells(np.where(places < 0, np.nan, places + 1.0), codes)


def xlookup(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """XLOOKUP(value, array, results, if not found, match mode, search mode): a whole row or column of the results."""
    places, errors, searched = _places(ev, args, 4, frame, spread)
    results = table_of(ev, args[2], frame)
    down = searched.numbers.shape[1] == 1 and (searched.numbers.shape[0] > 1 or results.numbers.shape[0] == 1)
    if results.numbers.shape[0 if down else 1] != searched.numbers.size:
        return error(VALUE)
    lines = results if down else Cells(results.numbers.T, results.codes.T)
    picked = _picked(lines, places, down)
    missing = places < 0
    if np.count_nonzero(missing):
        given = len(args) > 3 and not isinstance(args[3], Missing)
        picked = choose(missing, ev.value(args[3], frame, spread) if given else error(NA), picked)
    return picked if errors is None else choose(errors != 0, Cells(np.nan, errors), picked)


def _picked(lines: Cells, places: Any, down: bool) -> Cells:
    """The line of results at each place: single values, or arrays for a single value or the cells of a frame."""
    safe = np.maximum(places, 0)
    width = lines.numbers.shape[1]
    if width == 1 or places.ndim > 2:
        numbers, codes = lines.numbers[safe, 0], lines.codes[safe, 0]
        return Cells(numbers, codes if np.count_nonzero(codes) else None)
    numbers, codes = (np.moveaxis(part[safe], -1, 0) for part in (lines.numbers, lines.codes))
    while numbers.ndim < 3:
        numbers, codes = numbers[:, None], codes[:, None]
    shaped = (slice(None), None) if not down else (None, slice(None))
    return Cells(numbers[shaped], codes[shaped] if np.count_nonzero(codes) else None)


KERNELS: dict[str, Any] = {
    "XMATCH": caught(xmatch), "XLOOKUP": caught(xlookup),
    "INDEX": index, "MATCH": caught(match), "CHOOSE": choose_, "LOOKUP": lookup,
    "VLOOKUP": _table_lookup(True), "HLOOKUP": _table_lookup(False),
}  # fmt: skip
