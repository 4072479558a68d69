"""From a function of Python values to a kernel: arguments converted by their kinds (`formula/functions.txt`), errors first.

A plain function takes floats, texts, truth values and arrays and returns a scalar, an array (`Cells` of two axes, or rows of
scalars), or raises `Problem`. What Python raises for numbers beyond reach becomes #NUM!. It is called once for every
combination of arguments that differs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from ...formula.functions import Function
from ...formula.nodes import ArrayLiteral, CellRef, ErrorValue, Missing, Node, RangeRef, Scalar
from ..values.cells import (
    BLANK,
    EPOCHS,
    MOST_LISTED,
    NUMBER,
    ArrayArgumentError,
    Cells,
    Frame,
    Numbers,
    Texts,
    VaryingSizeError,
    codes_of,
    error_code,
    fitted,
    too_large,
)
from ..values.coerce import (
    Problem,
    Serial,
    numbers_of,
    once_each,
    raise_first,
    shaped,
    since_epoch,
    to_number,
    to_strict_number,
    to_text,
    to_truth,
)
from .closures import Evaluation

Args: TypeAlias = tuple[Node, ...]
"""The arguments of a call, as trees."""

SINGLES = frozenset("npytbdae")
"""Kinds of single values: an array there means one result for each of its cells."""

LISTED_A_STEP = 16
"""Cells of an array that are handed to a function one by one in the time of a step."""


def _to_day(value: Scalar) -> float:
    if isinstance(value, bool):
        return float(value)
    return to_number(value)


_CONVERSIONS: dict[str, Callable[[Scalar], Any]] = {
    "n": to_number,
    "p": to_strict_number,
    "y": to_strict_number,
    "t": to_text,
    "b": to_truth,
    "d": _to_day,
    "a": lambda value: value,
    "e": lambda value: value,
}


def given(ev: Evaluation, arg: Node, frame: Frame, spread: bool) -> Cells:
    """An argument's value as it is handed on: nothing between two commas is 0."""
    return Cells(np.float64(0)) if isinstance(arg, Missing) else ev.value(arg, frame, spread)


def need_one(cells: Cells) -> None:
    """Refuse what is not one value for all cells of a frame.

    Raises VaryingSizeError where each cell has its own, and ArrayArgumentError for an array: then the function is computed
    once for each cell, or for each value.
    """
    if len(cells.shape) > 2:
        raise ArrayArgumentError
    if cells.shape != ():
        raise VaryingSizeError


def one_number(ev: Evaluation, arg: Node, frame: Frame, spread: bool) -> float:
    """The number of an argument that says what is done in all cells of a frame, and not with what. Raises as `need_one`
    does, and Problem for an error."""
    cells = given(ev, arg, frame, spread)
    need_one(cells)
    number, errors = numbers_of(cells, ev.texts)
    if errors is not None:
        raise_first(np.atleast_1d(errors))
    return float(number)


def table_of(ev: Evaluation, node: Node, frame: Frame) -> Cells:
    """An array value that is the same all over the frame: two axes, always with codes."""
    cells = ev.value(node, frame, spread=True)
    shape = cells.shape
    if len(shape) <= 2:
        if shape != ():
            raise VaryingSizeError
        shape = (1, 1, 1, 1)
    if shape[2:] != (1, 1):
        raise VaryingSizeError
    numbers = np.broadcast_to(cells.numbers, shape)[:, :, 0, 0]
    return Cells(numbers, np.broadcast_to(codes_of(cells), shape)[:, :, 0, 0])


def is_reference(node: Node) -> bool:
    """Whether values come out of cells (or an array), where texts and truth values do not count."""
    return isinstance(node, CellRef | RangeRef | ArrayLiteral)


def values_of(ev: Evaluation, node: Node, frame: Frame) -> Numbers:
    """The numbers of an argument: those among the cells of a range; a value written out counts by what it shows."""
    single = np.ndim(ev.value(node, frame, spread=True).numbers) <= 2 and not is_reference(node)
    table = table_of(ev, node, frame)
    if single:
        numbers, errors = numbers_of(table, ev.texts)
        if errors is not None:
            raise_first(np.broadcast_to(errors, np.shape(numbers)))
        return np.asarray(np.ravel(numbers), np.float64)
    raise_first(table.codes)
    return np.asarray(table.numbers[table.codes == NUMBER], np.float64)


def matrix_of(table: Cells) -> Numbers:
    """A matrix of numbers: the first error, or #VALUE! where a cell holds no number."""
    raise_first(table.codes)
    if np.any(table.codes != NUMBER):
        raise Problem("#VALUE!")
    return np.asarray(table.numbers, np.float64)


def scalars_of(table: Cells, texts: Texts) -> list[Scalar]:
    """The values of an array, row by row."""
    pairs = zip(table.numbers.ravel().tolist(), table.codes.ravel().tolist(), strict=True)
    return [texts.decode(number, code) for number, code in pairs]


def grid_of(table: Cells, texts: Texts) -> list[list[Scalar]]:
    """The values of an array as rows."""
    values, width = scalars_of(table, texts), table.numbers.shape[1]
    return [values[start : start + width] for start in range(0, len(values), width)]


def _fixed(ev: Evaluation, node: Node, kind: str, frame: Frame, needed: bool) -> Any:
    """An argument that is no single value, or the problem with it; one left out is a blank where it is `needed`."""
    try:
        if kind == "v":
            return values_of(ev, node, frame)
        if isinstance(node, Missing):
            if not needed:
                return None
            table = Cells(np.zeros((1, 1)), np.full((1, 1), BLANK, np.uint8))
        else:
            table = table_of(ev, node, frame)
        if kind in "glh":
            if table.numbers.size > MOST_LISTED:
                raise too_large(*table.numbers.shape)
            ev.around.budget.spend(table.numbers.size // LISTED_A_STEP)
        if kind == "g":
            return grid_of(table, ev.texts)
        if kind in "lh":
            days = ev.texts.epochs if kind == "h" else 0.0
            found = scalars_of(table, ev.texts)
            return [value + days if isinstance(value, float) else value for value in found] if days else found
        return matrix_of(table) if kind == "m" else table
    except Problem as problem:
        return problem


def called(row: Function, function: Callable[..., Any]) -> Any:
    """The kernel of a plain function whose arguments are of the row's kinds."""

    def kernel(ev: Evaluation, args: tuple[Node, ...], frame: Frame, spread: bool) -> Cells:
        kinds = row.kinds_of(len(args))
        fixed = [
            None if kind in SINGLES else _fixed(ev, arg, kind, frame, row.needs(place))
            for place, (arg, kind) in enumerate(zip(args, kinds, strict=True))
        ]
        lifted = [ev.value(arg, frame, spread) for arg, kind in zip(args, kinds, strict=True) if kind in SINGLES]
        return _each_key(_Call(function, kinds, fixed, ev.texts, ev.layout.date1904), lifted, ev.around.budget.spend)

    return kernel


class _Call:
    """One call, with all arguments at hand but the single values."""

    def __init__(self, function: Any, kinds: str, fixed: list[Any], texts: Texts, since_1904: bool) -> None:
        self.function = function
        self.kinds = kinds
        self.fixed = fixed
        self.texts = texts
        self.offset = EPOCHS if since_1904 else 0.0

    def __call__(self, key: tuple[tuple[float, int], ...]) -> Any:
        """(number, code), or the Cells of an array."""
        values: list[Any] = []
        singles = iter(key)
        try:
            for kind, fixed in zip(self.kinds, self.fixed, strict=True):
                values.append(self._value(kind, fixed, singles))
            for value in values:  # errors of single values come before those inside ranges
                if isinstance(value, Problem):
                    raise value
            found = self.function(*values)
        except Problem as problem:
            return np.nan, error_code(problem.code)
        except (ValueError, ArithmeticError, np.linalg.LinAlgError):
            found = ErrorValue("#NUM!")
        return self._result(found)

    def _value(self, kind: str, fixed: Any, singles: Any) -> Any:
        if kind not in SINGLES:
            return fixed
        value = self.texts.decode(*next(singles))
        if isinstance(value, ErrorValue) and kind != "e":
            raise Problem(value.code)
        converted = _CONVERSIONS[kind](value)
        if isinstance(converted, Serial):  # a text that shows a date: functions of days count from 1900
            return float(converted) if kind in "dy" else since_epoch(converted, self.offset)
        return converted + self.offset if kind in "dy" else converted

    def _result(self, found: Any) -> Any:
        if isinstance(found, list):
            return _array(found, self.texts)
        if isinstance(found, np.ndarray):
            return _numbers_only(found)
        if isinstance(found, Cells):
            return found
        if isinstance(found, Serial):
            found = ErrorValue("#NUM!") if found < self.offset else float(found) - self.offset
        if isinstance(found, int | float | np.floating) and not isinstance(found, bool):
            found = float(found) if np.isfinite(found) else ErrorValue("#NUM!")
        return self.texts.encode(found)


def _numbers_only(found: Numbers) -> Cells:
    bad = ~np.isfinite(found)
    if not bad.any():
        return Cells(found)
    return Cells(np.where(bad, np.nan, found), np.where(bad, np.uint8(error_code("#NUM!")), np.uint8(0)))


def _array(rows: list[list[Scalar]], texts: Texts) -> Cells:
    """Rows of scalars as cells of two axes."""
    pairs = [[texts.encode(item) for item in row] for row in rows]
    numbers = np.array([[pair[0] for pair in row] for row in pairs], np.float64)
    return Cells(numbers, np.array([[pair[1] for pair in row] for row in pairs], np.uint8))


def spread_cells(table: Cells) -> Cells:
    """Cells of two axes as an array value."""
    codes = table.codes if table.codes is not None and np.any(table.codes) else None
    return Cells(table.numbers[:, :, None, None], None if codes is None else codes[:, :, None, None])


def _each_key(call: _Call, lifted: list[Cells], spend: Callable[[int], None]) -> Cells:
    """The function's results over the common shape of its single values; `spend` is told how many an array has."""
    lifted = list(fitted(*lifted))
    size = np.broadcast_shapes(*(cells.shape for cells in lifted))
    if len(size) > 2:
        spend(size[0] * size[1])
    found, shape = once_each(call, lifted)
    if shape == () and isinstance(found[0], Cells):
        return spread_cells(found[0])
    return _put_together(found, shape)


def _put_together(found: list[Any], shape: tuple[int, ...]) -> Cells:
    """Results along `shape`. Arrays in a frame's cells must be of one size; arrays for the cells of an array give their
    first cell, as a cell can hold no array."""
    if any(isinstance(item, Cells) for item in found):
        sizes = {np.shape(item.numbers) if isinstance(item, Cells) else (1, 1) for item in found}
        if len(shape) <= 2 and len(sizes) > 1:
            raise VaryingSizeError
        if len(shape) <= 2:
            return _stacked(found, shape)
        found = [_corner(item) if isinstance(item, Cells) else item for item in found]
    return shaped(found, shape)


def _corner(table: Cells) -> tuple[float, int]:
    return float(table.numbers[0, 0]), 0 if table.codes is None else int(table.codes[0, 0])


def _stacked(found: list[Any], shape: tuple[int, ...]) -> Cells:
    """Arrays of one size, one for each cell of the frame."""
    tables = [
        item if isinstance(item, Cells) else Cells(np.full((1, 1), item[0]), np.full((1, 1), item[1])) for item in found
    ]
    frame = (1, *shape) if len(shape) == 1 else shape
    numbers = np.stack([table.numbers for table in tables], axis=-1)
    codes = np.stack([np.broadcast_to(codes_of(table), np.shape(table.numbers)) for table in tables], axis=-1)
    size = numbers.shape[:2]
    return Cells(numbers.reshape(*size, *frame), codes.reshape(*size, *frame).astype(np.uint8))
