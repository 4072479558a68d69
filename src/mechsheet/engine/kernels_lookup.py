"""Look-up and conditional sums: functions that search a range. The range is the same for the whole frame in most sheets,
and is searched for all cells of the frame at once; where it moves, each cell is evaluated by itself."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..formula.nodes import ErrorValue, Missing, Node, RangeRef
from .calling import table_of
from .coerce import compare_numbers, numbers_of, text_to_number, truths_of
from .frames import Frame, VaryingSizeError
from .kernels_fold import greatest, least, total
from .values import (
    BLANK,
    BOOLEAN,
    DIV0,
    ERROR,
    ERROR_NAMES,
    NA,
    NUMBER,
    REF,
    TEXT,
    VALUE,
    Cells,
    choose,
    codes_of,
    error,
    error_code,
    errors_of,
    finished,
    first_error,
)
from .wildcards import pattern_of

if TYPE_CHECKING:
    from .careful import Evaluator

Args = tuple[Node, ...]


def index(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """INDEX(range, row, column): 0 or nothing for the only row or column; #REF! outside."""
    row, row_errors = _argument(ev, args, 1, frame, spread)
    col, col_errors = _argument(ev, args, 2, frame, spread)
    if row_errors is None and col_errors is None and np.ndim(row) == 0 and np.ndim(col) == 0:
        single = _indexed(ev, args, frame, float(row), float(col))
        if single is not None:
            return single
    table = table_of(ev, args[0], frame)
    height, width = table.numbers.shape
    if isinstance(args[0], RangeRef):
        span = ev.span(args[0], frame)
        if span is not None:
            height, width = span.height, span.width  # beyond the data a whole column goes on, blank
    if len(args) == 2 and height == 1:
        row, col = np.where(width == 1, row, 1.0), np.where(width == 1, col, row)
    row, col = np.trunc(row), np.trunc(col)
    several = (np.equal(row, 0) & (height > 1)) | (np.equal(col, 0) & (width > 1))
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


def _indexed(ev: Evaluator, args: Args, frame: Frame, row: float, col: float) -> Cells | None:
    """The one cell of a fixed range that INDEX means everywhere in the frame; None in all less plain cases."""
    span = ev.span(args[0], frame) if isinstance(args[0], RangeRef) else None
    if span is None or span.moves_down or span.moves_right:
        return None
    if len(args) == 2 and span.height == 1 and span.width > 1:
        row, col = 1.0, row
    if not (1 <= row < span.height + 1 and 1 <= col < span.width + 1):
        return None
    return ev.at(span.sheet, span.row + int(row) - 1, span.col + int(col) - 1)


def _or_error(found: Cells, errors: Any) -> Cells:
    if errors is None or not np.any(errors):
        return found if found.codes is None or np.any(found.codes) else Cells(found.numbers)
    return choose(errors != 0, Cells(np.nan, errors), found)


def _argument(ev: Evaluator, args: Args, place: int, frame: Frame, spread: bool, default: float = 1.0) -> Any:
    """(numbers, error codes or None) of an argument that may be left out."""
    if place >= len(args):
        return np.float64(default), None
    if isinstance(args[place], Missing):
        return np.float64(0), None
    return numbers_of(ev.value(args[place], frame, spread), ev.texts)


def match(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """MATCH(value, range, type): 1 the last not above (ascending), 0 the first equal, -1 the last not below (descending)."""
    kind, kind_errors = _argument(ev, args, 2, frame, spread)
    if np.ndim(kind):
        kind = kind.flat[0]
    table = table_of(ev, args[1], frame)
    if 1 not in table.numbers.shape:
        return error(NA)
    line = Cells(table.numbers.ravel(), table.codes.ravel())
    places = positions(ev, ev.value(args[0], frame, spread), line, float(np.sign(kind)))
    found = Cells(places.numbers + 1.0, places.codes)
    return _or_error(found, kind_errors)


def positions(ev: Evaluator, wanted: Cells, line: Cells, kind: float) -> Cells:
    """Where each wanted value stands in `line` (from 0), #N/A where it stands nowhere; errors of `wanted` first."""
    numbers, codes = np.broadcast_arrays(wanted.numbers, codes_of(wanted))
    flat = list(zip(numbers.ravel().tolist(), codes.ravel().tolist(), strict=True))
    known: dict[tuple[float, int], int] = {}
    plain = line.numbers[line.codes == NUMBER]
    where = np.flatnonzero(line.codes == NUMBER)
    for key in flat:
        if key not in known:
            known[key] = _position(ev, key, line, kind, plain, where)
    found = np.array([known[key] for key in flat], np.float64).reshape(numbers.shape)
    missing = np.where(found < 0, np.uint8(NA), np.uint8(0))
    errors = first_error(errors_of(wanted), missing if np.any(missing) else None)
    return Cells(np.where(found < 0, 0.0, found), errors)


def _position(ev: Evaluator, key: tuple[float, int], line: Cells, kind: float, plain: Any, where: Any) -> int:
    number, code = key
    if code >= ERROR or (code == BLANK and kind == 0):
        return -1
    if code in (NUMBER, BLANK):
        if kind == 0:
            hits = np.flatnonzero(compare_numbers("=", plain, np.float64(number)))
            return int(where[hits[0]]) if len(hits) else -1
        place = int(np.searchsorted(plain, number, "right") if kind > 0 else np.searchsorted(-plain, -number, "right"))
        return int(where[place - 1]) if place else -1
    same = np.flatnonzero(line.codes == code)
    if code == BOOLEAN:
        return next((int(i) for i in same if line.numbers[i] == number), -1)
    text = ev.texts.text(number)
    words = [(int(i), ev.texts.text(line.numbers[i])) for i in same]
    if kind == 0:
        fits = wildcard(text)
        return next((i for i, word in words if fits(word)), -1)
    folded = text.casefold()
    place = -1
    for i, word in words:
        if (word.casefold() <= folded) if kind > 0 else (word.casefold() >= folded):
            place = i
        else:
            break
    return place


def wildcard(pattern: str) -> Callable[[str], bool]:
    """Whether a text fits a pattern with wildcards."""
    compiled = pattern_of(pattern)
    return lambda text: compiled.fullmatch(text) is not None


def choose_(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """CHOOSE(number, first, second, …): #VALUE! outside; only the values chosen matter."""
    number, errors = numbers_of(ev.value(args[0], frame, spread), ev.texts)
    number = np.trunc(number)
    result = error(VALUE)
    for place, arg in enumerate(args[1:], 1):
        here = np.equal(number, place)
        if np.any(here):
            value = Cells(np.float64(0)) if isinstance(arg, Missing) else ev.value(arg, frame, spread)
            result = value if np.all(here) else choose(here, value, result)
    return _or_error(result, errors)


def _line(cells: Cells, by_rows: bool, place: int) -> Cells:
    return (
        Cells(cells.numbers[:, place], cells.codes[:, place])
        if by_rows
        else Cells(cells.numbers[place], cells.codes[place])
    )


def _table_lookup(by_rows: bool) -> Any:
    def kernel(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
        table = table_of(ev, args[1], frame)
        wanted = ev.value(args[0], frame, spread)
        place, place_errors = numbers_of(ev.value(args[2], frame, spread), ev.texts)
        near: Any = np.True_
        if len(args) > 3:
            near, _ = truths_of(ev.value(args[3], frame, spread), ev.texts)
        found = positions(ev, wanted, _line(table, by_rows, 0), 1.0 if np.all(near) else 0.0)
        across = np.trunc(place)
        width = table.numbers.shape[1 if by_rows else 0]
        own = np.where(across < 1, np.uint8(VALUE), np.where(across > width, np.uint8(REF), np.uint8(0)))
        safe = np.where(own != 0, 0, across - 1).astype(np.intp)
        along = found.numbers.astype(np.intp)
        at = (along, safe) if by_rows else (safe, along)
        errors = first_error(found.codes, place_errors, own if np.any(own) else None)
        return _or_error(Cells(table.numbers[at], table.codes[at]), errors)

    return kernel


def lookup(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """LOOKUP(value, ascending line, line of results); with one table, its first and last row or column."""
    table = table_of(ev, args[1], frame)
    by_rows = table.numbers.shape[0] >= table.numbers.shape[1]
    found = positions(ev, ev.value(args[0], frame, spread), _line(table, by_rows, 0), 1.0)
    results = table_of(ev, args[2], frame) if len(args) > 2 else table
    line = Cells(results.numbers.ravel(), results.codes.ravel()) if len(args) > 2 else _line(table, by_rows, -1)
    along = found.numbers.astype(np.intp)
    if np.any(along >= len(line.numbers)):
        return error(REF)
    return _or_error(Cells(line.numbers[along], line.codes[along]), found.codes)


_CRITERION = re.compile(r"(<=|>=|<>|<|>|=)?(.*)", re.DOTALL)


def criterion(value: Any, ev: Evaluator) -> Callable[[Cells], Any]:
    """The test that a criterion (">3", "=x*", 5, …) makes: cells -> mask."""
    if isinstance(value, ErrorValue):
        code, _ = ev.texts.encode(value)
        wanted = ev.texts.encode(value)[1]
        return lambda cells: codes_of(cells) == wanted
    if not isinstance(value, str):
        number, code = ev.texts.encode(value)
        code = NUMBER if code == BLANK else code
        return lambda cells: (codes_of(cells) == code) & compare_numbers("=", cells.numbers, number)
    match_ = _CRITERION.fullmatch(value)
    op, word = (match_.group(1) or "=", match_.group(2)) if match_ else ("=", value)
    shown = text_to_number(word)
    if shown is not None:
        number = shown
        if op == "<>":
            return lambda cells: ~((codes_of(cells) == NUMBER) & compare_numbers("=", cells.numbers, number))
        return lambda cells: (codes_of(cells) == NUMBER) & compare_numbers(op, cells.numbers, number)
    return _text_criterion(op, word, bool(match_ and match_.group(1)), ev)


def _text_criterion(op: str, word: str, explicit: bool, ev: Evaluator) -> Callable[[Cells], Any]:
    if word.upper() in ERROR_NAMES and op in ("=", "<>"):
        wanted = error_code(word)
        return lambda cells: (codes_of(cells) == wanted) ^ (op == "<>")
    if word.upper() in ("TRUE", "FALSE") and op in ("=", "<>"):
        flag = float(word.upper() == "TRUE")
        return lambda cells: ((codes_of(cells) == BOOLEAN) & (cells.numbers == flag)) ^ (op == "<>")
    if word == "":
        blank = {"=": lambda c: c == BLANK, "<>": lambda c: c != BLANK}
        if explicit:
            return lambda cells: blank.get(op, lambda c: c != c)(codes_of(cells))
        empty = ev.texts.number("")
        return lambda cells: (codes_of(cells) == BLANK) | ((codes_of(cells) == TEXT) & (cells.numbers == empty))
    fits = wildcard(word)
    folded = word.casefold()
    tests: dict[str, Callable[[str], bool]] = {
        "=": fits, "<>": lambda text: not fits(text), "<": lambda text: text.casefold() < folded,
        "<=": lambda text: text.casefold() <= folded, ">": lambda text: text.casefold() > folded,
        ">=": lambda text: text.casefold() >= folded,
    }  # fmt: skip

    def mask(cells: Cells) -> Any:
        is_text = codes_of(cells) == TEXT
        result = np.full(np.shape(cells.numbers), False) if op != "<>" else ~is_text
        for key in np.unique(cells.numbers[is_text]):
            if tests[op](ev.texts.text(key)):
                result = result | (is_text & (cells.numbers == key))
        return result

    return mask


def _selected(ev: Evaluator, pairs: Args, frame: Frame) -> Any:
    """Which cells fit all criteria: (mask over the common shape of the ranges), None when their sizes differ."""
    result: Any = None
    for place in range(0, len(pairs), 2):
        table = table_of(ev, pairs[place], frame)
        wanted = ev.value(pairs[place + 1], frame)
        number, code = np.float64(wanted.numbers), 0 if wanted.codes is None else int(wanted.codes)
        mask = criterion(ev.texts.decode(float(number), code), ev)(table)
        if result is not None and result.shape != mask.shape:
            return None
        result = mask if result is None else result & mask
    return result


def _cell_by_cell(kernel: Any) -> Any:
    """A kernel that computes one cell at a time (its criterion may differ from cell to cell)."""

    def several(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
        if frame.rows > 1 or frame.cols > 1:
            raise VaryingSizeError
        found: Cells = kernel(ev, args, frame, spread)
        return found

    return several


def _conditional(result: Callable[[Any, Any, Any], Cells], values_first: bool) -> Any:
    def kernel(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
        del spread
        if values_first:
            values, pairs = args[0], args[1:]
        else:
            values, pairs = (args[2] if len(args) > 2 else args[0]), args[:2]
        if len(pairs) % 2:
            return error(VALUE)
        mask = _selected(ev, pairs, frame)
        table = table_of(ev, values, frame)
        if mask is None or (values_first and mask.shape != table.numbers.shape):
            return error(VALUE)
        height, width = min(mask.shape[0], len(table.numbers)), min(mask.shape[1], table.numbers.shape[1])
        mask = mask[:height, :width]
        numbers, codes = table.numbers[:height, :width], table.codes[:height, :width]
        bad = np.flatnonzero((codes >= ERROR) & mask)
        if len(bad):
            return error(int(codes.flat[bad[0]]))
        return result(numbers.ravel(), (mask & (codes == NUMBER)).ravel(), mask)

    return _cell_by_cell(kernel)


def _counting(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    del spread
    mask = _selected(ev, args, frame) if len(args) % 2 == 0 else None
    if mask is None:
        return error(VALUE)
    found = float(np.count_nonzero(mask))
    return Cells(np.float64(found))


def _mean(numbers: Any, counts: Any, mask: Any) -> Cells:
    del mask
    many = np.count_nonzero(counts)
    return Cells(np.float64(total(numbers, counts) / many)) if many else error(DIV0)


def _sum(numbers: Any, counts: Any, mask: Any) -> Cells:
    del mask
    return finished(total(numbers, counts))


KERNELS: dict[str, Any] = {
    "INDEX": index, "MATCH": match, "CHOOSE": choose_, "LOOKUP": lookup,
    "VLOOKUP": _table_lookup(True), "HLOOKUP": _table_lookup(False),
    "COUNTIF": _cell_by_cell(_counting), "COUNTIFS": _cell_by_cell(_counting),
    "SUMIF": _conditional(_sum, False), "SUMIFS": _conditional(_sum, True),
    "AVERAGEIF": _conditional(_mean, False), "AVERAGEIFS": _conditional(_mean, True),
    "MINIFS": _conditional(lambda n, c, m: Cells(np.float64(least(n, c))), True),
    "MAXIFS": _conditional(lambda n, c, m: Cells(np.float64(greatest(n, c))), True),
}  # fmt: skip
