"""Logic and information: what kind of value something is, choices among several values."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from ...formula.nodes import CellRef, ErrorValue, Missing, Node, Scalar
from ..interpreter.calling import Args, given
from ..interpreter.closures import Evaluation
from ..values.cells import (
    BLANK,
    BOOLEAN,
    ERROR,
    NA,
    NUMBER,
    TEXT,
    VALUE,
    Cells,
    Frame,
    Span,
    VaryingSizeError,
    boolean,
    choose,
    codes_of,
    error,
    errors_of,
    first_error,
    fitted,
)
from ..values.coerce import Problem, compared, to_number, truths_of


def if_(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """IF: an error of the condition, else the branch taken; the other branch matters nowhere."""
    condition = ev.value(args[0], frame, spread)
    mask, errors = truths_of(condition, ev.texts)
    if np.ndim(mask) > 2:
        return _if_of_array(ev, args, frame, spread, condition)
    held = np.count_nonzero(mask)
    if errors is None and held == np.size(mask):
        return _branch(ev, args, 1, frame, spread)
    if errors is None and not held:
        return _branch(ev, args, 2, frame, spread)
    result = choose(mask, _branch(ev, args, 1, frame, spread), _branch(ev, args, 2, frame, spread))
    return result if errors is None else choose(errors != 0, Cells(np.nan, errors), result)


def _if_of_array(ev: Evaluation, args: Args, frame: Frame, spread: bool, condition: Cells) -> Cells:
    """IF with an array for its condition: as large as the largest of condition and branches."""
    mask, errors = truths_of(condition, ev.texts)
    then = _branch(ev, args, 1, frame, spread) if np.count_nonzero(mask) else Cells(np.float64(0))
    otherwise = Cells(np.float64(0)) if np.all(mask) else _branch(ev, args, 2, frame, spread)
    condition, then, otherwise = fitted(condition, then, otherwise)
    mask, errors = truths_of(condition, ev.texts)
    result = choose(mask, then, otherwise)
    return result if errors is None else choose(errors != 0, Cells(np.nan, errors), result)


def _branch(ev: Evaluation, args: Args, index: int, frame: Frame, spread: bool) -> Cells:
    """A branch left out is the condition's truth value; an empty one (`IF(a,,b)`) is 0."""
    if index >= len(args):
        return boolean(np.float64(index == 1))
    return given(ev, args[index], frame, spread)


def _instead(caught: Callable[[Any], Any]) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        first = ev.value(args[0], frame, spread)
        if first.codes is None:
            return first
        mask = caught(first.codes)
        if not np.count_nonzero(mask):
            return first
        second = given(ev, args[1], frame, spread)
        first, second = fitted(first, second)
        return choose(caught(codes_of(first)), second, first)

    return kernel


iferror = _instead(lambda codes: codes >= ERROR)
ifna = _instead(lambda codes: codes == NA)


_JOINS: dict[str, tuple[Any, bool]] = {
    "AND": (np.logical_and, True), "OR": (np.logical_or, False), "XOR": (np.logical_xor, False),
}  # fmt: skip
"""How truth values are joined, and the one that changes nothing."""


def _joined(name: str) -> Any:
    join, neutral = _JOINS[name]

    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        del spread
        masks: list[Any] = []
        counted: list[Any] = []
        faults: list[Any] = []
        for arg in args:
            cells = ev.value(arg, frame, spread=True)
            codes = codes_of(cells)
            inside = np.ndim(cells.numbers) > 2 or isinstance(arg, CellRef)
            # Texts and blanks that stand in cells are passed over; a text written as an argument must be a truth value.
            empty = (codes == TEXT) & (cells.numbers == ev.texts.number(""))
            counts = (codes != TEXT) & (codes != BLANK) if inside else (codes != BLANK) & ~empty
            if isinstance(arg, Missing):  # nothing between two commas is FALSE
                counts = np.ones(np.shape(codes), bool)
            mask, errors = truths_of(cells, ev.texts)
            if errors is not None:
                errors = np.where((codes == TEXT) if inside else empty, np.uint8(0), errors)
            masks.append(join.reduce(_flat(np.where(counts, mask, neutral))))
            counted.append(np.logical_or.reduce(_flat(np.broadcast_to(counts, np.shape(cells.numbers)))))
            faults.append(None if errors is None else _first_of(_flat(errors)))
        total = masks[0]
        any_counted = counted[0]
        for mask, counts in zip(masks[1:], counted[1:], strict=True):
            total = join(total, mask)
            any_counted = any_counted | counts
        nothing = np.where(any_counted, np.uint8(0), np.uint8(VALUE))
        errors = first_error(*faults, nothing if np.count_nonzero(nothing) else None)
        result = boolean(total)
        return result if errors is None else choose(errors != 0, Cells(np.nan, errors), result)

    return kernel


def _flat(array: Any) -> Any:
    """The cells of an array value along one axis in front of the frame's own."""
    if np.ndim(array) > 2:
        shape = np.shape(array)
        return _plain(np.reshape(array, (shape[0] * shape[1], *shape[2:])))
    return np.asarray(array)[None]


def _plain(array: Any) -> Any:
    """Without frame axes of length 1, so that it broadcasts with operands of every shape."""
    if array.shape[1] == 1:
        array = array[:, 0]
        return array[:, 0] if array.shape[1] == 1 else array
    return array


def _first_of(errors: Any) -> Any:
    """The first error along the first axis, 0 where there is none."""
    index = np.argmax(errors != 0, axis=0)
    return np.take_along_axis(errors, np.expand_dims(index, 0), axis=0)[0]


and_, or_, xor = _joined("AND"), _joined("OR"), _joined("XOR")


def not_(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """NOT."""
    mask, errors = truths_of(ev.value(args[0], frame, spread), ev.texts)
    result = boolean(~mask)
    return result if errors is None else choose(errors != 0, Cells(np.nan, errors), result)


def na(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """NA: the error #N/A."""
    del ev, args, frame, spread
    return error(NA)


def _asks(question: Callable[[Any], Any]) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        return boolean(question(codes_of(ev.value(args[0], frame, spread))))

    return kernel


isnumber = _asks(lambda codes: codes == NUMBER)
istext = _asks(lambda codes: codes == TEXT)
islogical = _asks(lambda codes: codes == BOOLEAN)
isblank = _asks(lambda codes: codes == BLANK)
isna = _asks(lambda codes: codes == NA)
iserror = _asks(lambda codes: codes >= ERROR)
iserr = _asks(lambda codes: (codes >= ERROR) & (codes != NA))


def n(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """N: numbers and truth values as numbers, texts as 0, errors as they are."""
    cells = ev.value(args[0], frame, spread)
    if cells.codes is None:
        return cells
    errors = errors_of(cells)
    numbers = np.where(cells.codes == TEXT, 0.0, cells.numbers)
    return Cells(numbers, errors)


def t(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """T: texts and errors as they are, all else as the empty text."""
    cells = ev.value(args[0], frame, spread)
    codes = codes_of(cells)
    kept = (codes == TEXT) | (codes >= ERROR)
    return choose(kept, Cells(cells.numbers, codes), ev.texts.constant(""))


def pi(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """PI."""
    del ev, args, frame, spread
    return Cells(np.float64(np.pi))


def row_of(span: Span) -> Any:
    """The numbers of a span's rows."""
    return span.row + 1.0 + np.arange(span.height)


def column_of(span: Span) -> Any:
    """The numbers of a span's columns."""
    return span.col + 1.0 + np.arange(span.width)


def _no_reference(ev: Evaluation, node: Node, frame: Frame) -> Cells:
    """The error that stands in the place of a reference, #VALUE! for any other value."""
    found = ev.value(node, frame, spread=True)
    code = int(np.ravel(codes_of(found))[0])
    return error(code if code >= ERROR else VALUE)


def _where(name: str) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        row, col = float(frame.row + 1), float(frame.col + 1)
        moves_down, moves_right = frame.rows > 1, frame.cols > 1
        if args:
            span = ev.span(args[0], frame)
            if span is None:
                return _no_reference(ev, args[0], frame)
            size = span.height if name == "ROW" else span.width
            if spread and size > 1:
                if span.moves_down or span.moves_right:
                    raise VaryingSizeError
                shape = (size, 1, 1, 1) if name == "ROW" else (1, size, 1, 1)
                return Cells((row_of(span) if name == "ROW" else column_of(span)).reshape(shape))
            row, col, moves_down, moves_right = span.row + 1.0, span.col + 1.0, span.moves_down, span.moves_right
        if name == "ROW":
            return Cells(row + np.arange(frame.rows) if moves_down else np.float64(row))
        return Cells(col + np.arange(frame.cols)[:, None] if moves_right else np.float64(col))

    return kernel


row, column = _where("ROW"), _where("COLUMN")


def _size(axis: int) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        span = ev.span(args[0], frame)
        if span is not None:
            return Cells(np.float64((span.height, span.width)[axis]))
        found = ev.value(args[0], frame, spread=True)
        if len(found.shape) > 2:
            return Cells(np.float64(found.shape[axis]))
        errors = errors_of(found)
        return Cells(np.float64(1)) if errors is None else choose(errors != 0, found, Cells(np.float64(1)))

    return kernel


rows, columns = _size(0), _size(1)


# --- choices among several values ------------------------------------------------------------------------------------


def _first_true(
    conditions: Sequence[Callable[[], Cells]], values: Sequence[Callable[[], Cells]], last: Callable[[], Cells]
) -> Cells:
    """The value of the first condition that holds; conditions after it, and values not chosen, are not looked at."""
    result: Cells | None = None
    open_: Any = np.True_
    for condition, value in zip(conditions, values, strict=True):
        cells = condition()
        faults = errors_of(cells)
        holds = (
            open_ & ((cells.numbers != 0) | False) if faults is None else open_ & (cells.numbers != 0) & (faults == 0)
        )
        if faults is not None:
            failed = open_ & (faults != 0)
            result = _merged(failed, Cells(np.nan, faults), result)
            open_, holds = open_ & ~failed, holds & ~failed
        if np.count_nonzero(holds):
            result = _merged(holds, value(), result)
        open_ = open_ & ~holds
        if not np.count_nonzero(open_):
            break
    if np.count_nonzero(open_):
        result = _merged(open_, last(), result)
    return error(NA) if result is None else result


def _merged(mask: Any, value: Cells, before: Cells | None) -> Cells:
    if before is None:  # as large as the condition, whatever the value's size
        return choose(mask, value, value) if np.ndim(mask) > 2 else value
    return choose(mask, value, before)


def _truth(ev: Evaluation, arg: Node, frame: Frame, spread: bool) -> Cells:
    mask, errors = truths_of(given(ev, arg, frame, spread), ev.texts)
    return Cells(np.asarray(mask, np.float64), errors)


def ifs(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """IFS(condition, value, ...): #N/A when no condition holds."""
    if len(args) % 2:
        return error(VALUE)
    conditions = [partial(_truth, ev, arg, frame, spread) for arg in args[::2]]
    values = [partial(given, ev, arg, frame, spread) for arg in args[1::2]]
    return _first_true(conditions, values, partial(error, NA))


def switch(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """SWITCH(value, case, result, ..., default)."""
    wanted = given(ev, args[0], frame, spread)
    cases = args[1:]
    default = cases[-1] if len(cases) % 2 else None

    def equal(arg: Node) -> Cells:
        found = compared("=", wanted, given(ev, arg, frame, spread), ev.texts)
        return Cells(found.numbers, errors_of(found))

    pairs = cases[:-1] if default is not None else cases
    conditions = [partial(equal, arg) for arg in pairs[::2]]
    values = [partial(given, ev, arg, frame, spread) for arg in pairs[1::2]]
    otherwise = partial(error, NA) if default is None else partial(given, ev, default, frame, spread)
    return _first_true(conditions, values, otherwise)


def type_(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """TYPE: 1 number, 2 text, 4 truth value, 16 error, 64 array."""
    del spread
    cells = ev.value(args[0], frame, spread=True)
    if len(cells.shape) > 2 and cells.shape[:2] != (1, 1):
        return Cells(np.float64(64))
    codes = codes_of(cells)
    kinds = np.select([codes >= ERROR, codes == TEXT, codes == BOOLEAN], [16.0, 2.0, 4.0], 1.0)
    return Cells(kinds)


# --- plain -----------------------------------------------------------------------------------------------------------

_ERROR_TYPES = {
    "#NULL!": 1, "#DIV/0!": 2, "#VALUE!": 3, "#REF!": 4, "#NAME?": 5, "#NUM!": 6, "#N/A": 7, "#GETTING_DATA": 8,
    "#SPILL!": 9, "#CONNECT!": 10, "#BLOCKED!": 11, "#UNKNOWN!": 12, "#FIELD!": 13, "#CALC!": 14,
}  # fmt: skip


def error_type(value: Scalar) -> float:
    """ERROR.TYPE: #N/A for what is no error."""
    if not isinstance(value, ErrorValue) or value.code not in _ERROR_TYPES:
        raise Problem("#N/A")
    return float(_ERROR_TYPES[value.code])


def _parity(value: Scalar) -> int:
    if isinstance(value, bool):
        raise Problem("#VALUE!")
    return math.floor(abs(to_number(value))) % 2


KERNELS: dict[str, Any] = {
    "IF": if_, "IFERROR": iferror, "IFNA": ifna, "AND": and_, "OR": or_, "XOR": xor, "NOT": not_, "NA": na,
    "ISNUMBER": isnumber, "ISTEXT": istext, "ISLOGICAL": islogical, "ISBLANK": isblank, "ISNA": isna,
    "ISERR": iserr, "ISERROR": iserror, "N": n, "T": t, "PI": pi, "ROW": row, "COLUMN": column,
    "ROWS": rows, "COLUMNS": columns,
    "IFS": ifs,
    "SWITCH": switch,
    "TYPE": type_,
    "ISNONTEXT": _asks(lambda codes: codes != TEXT),
}  # fmt: skip

PLAIN: dict[str, Callable[..., Any]] = {
    "ERROR.TYPE": error_type,
    "ISEVEN": lambda value: _parity(value) == 0,
    "ISODD": lambda value: _parity(value) == 1,
}
