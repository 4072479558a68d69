"""More logic and information: choices among several values, kinds of values."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...formula.nodes import ErrorValue, Missing, Node, Scalar
from ..values.calling import Problem, to_number
from ..values.cells import BOOLEAN, ERROR, NA, TEXT, VALUE, Cells, boolean, choose, codes_of, error, errors_of
from ..values.coerce import compared, truths_of
from ..values.frames import Frame

if TYPE_CHECKING:
    from ..interpreter.evaluator import Evaluator

Args = tuple[Node, ...]


def _given(ev: Evaluator, arg: Node, frame: Frame, spread: bool) -> Cells:
    return Cells(np.float64(0)) if isinstance(arg, Missing) else ev.value(arg, frame, spread)


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
        if np.any(holds):
            result = _merged(holds, value(), result)
        open_ = open_ & ~holds
        if not np.any(open_):
            break
    if np.any(open_):
        result = _merged(open_, last(), result)
    return error(NA) if result is None else result


def _merged(mask: Any, value: Cells, before: Cells | None) -> Cells:
    if before is None:  # as large as the condition, whatever the value's size
        return choose(mask, value, value) if np.ndim(mask) > 2 else value
    return choose(mask, value, before)


def _truth(ev: Evaluator, arg: Node, frame: Frame, spread: bool) -> Cells:
    mask, errors = truths_of(_given(ev, arg, frame, spread), ev.texts)
    return Cells(np.asarray(mask, np.float64), errors)


def ifs(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """IFS(condition, value, ...): #N/A when no condition holds."""
    if len(args) % 2:
        return error(VALUE)
    conditions = [partial(_truth, ev, arg, frame, spread) for arg in args[::2]]
    values = [partial(_given, ev, arg, frame, spread) for arg in args[1::2]]
    return _first_true(conditions, values, partial(error, NA))


def switch(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """SWITCH(value, case, result, ..., default)."""
    wanted = _given(ev, args[0], frame, spread)
    cases = args[1:]
    default = cases[-1] if len(cases) % 2 else None

    def equal(arg: Node) -> Cells:
        found = compared("=", wanted, _given(ev, arg, frame, spread), ev.texts)
        return Cells(found.numbers, errors_of(found))

    pairs = cases[:-1] if default is not None else cases
    conditions = [partial(equal, arg) for arg in pairs[::2]]
    values = [partial(_given, ev, arg, frame, spread) for arg in pairs[1::2]]
    otherwise = partial(error, NA) if default is None else partial(_given, ev, default, frame, spread)
    return _first_true(conditions, values, otherwise)


def _asks(question: Callable[[Any], Any]) -> Any:
    def kernel(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
        return boolean(question(codes_of(ev.value(args[0], frame, spread))))

    return kernel


def type_(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """TYPE: 1 number, 2 text, 4 truth value, 16 error, 64 array."""
    del spread
    cells = ev.value(args[0], frame, spread=True)
    if len(cells.shape) > 2 and cells.shape[:2] != (1, 1):
        return Cells(np.float64(64))
    codes = codes_of(cells)
    kinds = np.select([codes >= ERROR, codes == TEXT, codes == BOOLEAN], [16.0, 2.0, 4.0], 1.0)
    return Cells(kinds)


KERNELS: dict[str, Any] = {
    "IFS": ifs,
    "SWITCH": switch,
    "TYPE": type_,
    "ISNONTEXT": _asks(lambda codes: codes != TEXT),
}


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


PLAIN: dict[str, Callable[..., Any]] = {
    "ERROR.TYPE": error_type,
    "ISEVEN": lambda value: _parity(value) == 0,
    "ISODD": lambda value: _parity(value) == 1,
}
