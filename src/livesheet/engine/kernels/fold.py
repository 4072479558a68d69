"""Aggregation: one number from ranges and values.

In cells only numbers count; an argument written out counts by what it shows.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ...formula.nodes import Binary, Missing, Node, RangeRef
from ..interpreter.calling import Args, is_reference
from ..interpreter.closures import Evaluation
from ..values.cells import (
    BLANK,
    DIV0,
    ERROR,
    NUM,
    NUMBER,
    TEXT,
    VALUE,
    Cells,
    Frame,
    broadcast,
    codes_of,
    error,
    finished,
    first_error,
)
from ..values.coerce import numbers_of
from .logic import _first_of, _flat


class Gathered(NamedTuple):
    """All values of a call: along the first axis, then the frame's axes.

    numbers  the values;  counts  which of them count as numbers;  errors  their error codes or None
    """

    numbers: Any
    counts: Any
    errors: Any


def united(args: Args) -> list[Node]:
    """The arguments, unions `(A1:A3,B2)` as their parts."""
    found: list[Node] = []
    stack = list(reversed(args))
    while stack:
        arg = stack.pop()
        if isinstance(arg, Binary) and arg.op == ",":
            stack += (arg.right, arg.left)
        else:
            found.append(arg)
    return found


def gather(ev: Evaluation, args: Args, frame: Frame) -> Gathered:
    """The values of all arguments in one array."""
    parts = [_part(ev, arg, frame) for arg in united(args)]
    if len(parts) == 1:
        return parts[0]
    tail = np.broadcast_shapes(*(np.shape(part.numbers)[1:] for part in parts))

    def joined(arrays: list[Any]) -> Any:
        return np.concatenate([broadcast(_with_axes(array, len(tail)), (len(array), *tail)) for array in arrays])

    errors = None
    if any(part.errors is not None for part in parts):
        none = [np.zeros(np.shape(part.numbers), np.uint8) for part in parts]
        errors = joined([zero if p.errors is None else p.errors for p, zero in zip(parts, none, strict=True)])
    return Gathered(joined([p.numbers for p in parts]), joined([p.counts for p in parts]), errors)


def _with_axes(array: Any, count: int) -> Any:
    """An array with `count` axes of the frame behind its first one."""
    if array.ndim == count + 1:
        return array
    return np.reshape(array, (len(array), *(1,) * (count + 1 - array.ndim), *array.shape[1:]))


def _part(ev: Evaluation, arg: Node, frame: Frame) -> Gathered:
    cells = ev.value(arg, frame, spread=True)
    if is_reference(arg) or np.ndim(cells.numbers) > 2:
        numbers = _flat(cells.numbers)
        if cells.codes is None:
            return Gathered(numbers, np.ones(numbers.shape, bool), None)
        codes = _flat(broadcast(cells.codes, cells.shape))
        errors = np.where(codes >= ERROR, codes, np.uint8(0))
        return Gathered(numbers, codes == NUMBER, errors if np.count_nonzero(errors) else None)
    single, faults = numbers_of(cells, ev.texts)
    flat = None if faults is None else _flat(broadcast(faults, np.shape(single)))
    return Gathered(_flat(single), np.ones(np.shape(_flat(single)), bool), flat)


def fold(function: Callable[[Any, Any], Any]) -> Any:
    """A kernel from `function(numbers, counts)` over the first axis; the first error among the values wins."""

    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        del spread
        numbers, counts, errors = gather(ev, args, frame)
        return folded(function, numbers, counts, None if errors is None else _first_of(errors))

    return kernel


def folded(function: Callable[[Any, Any], Any], numbers: Any, counts: Any, errors: Any) -> Cells:
    """The result of `function`, or the error."""
    found = function(numbers, counts)
    if isinstance(found, tuple):
        found, own = found
        errors = first_error(errors, own)
    return finished(found, errors)


def total(numbers: Any, counts: Any) -> Any:
    """SUM."""
    return np.add.reduce(np.where(counts, numbers, 0.0))


def count(numbers: Any, counts: Any) -> Any:
    """COUNT."""
    del numbers
    return np.add.reduce(counts.astype(np.float64))


def mean(numbers: Any, counts: Any) -> Any:
    """AVERAGE: #DIV/0! of nothing."""
    many = count(numbers, counts)
    return total(numbers, counts) / np.where(many == 0, 1.0, many), np.where(many == 0, np.uint8(DIV0), np.uint8(0))


def least(numbers: Any, counts: Any) -> Any:
    """MIN: 0 of nothing."""
    found = np.minimum.reduce(np.where(counts, numbers, np.inf), initial=np.inf)
    return np.where(np.logical_or.reduce(counts), found, 0.0)


def greatest(numbers: Any, counts: Any) -> Any:
    """MAX: 0 of nothing."""
    found = np.maximum.reduce(np.where(counts, numbers, -np.inf), initial=-np.inf)
    return np.where(np.logical_or.reduce(counts), found, 0.0)


def product(numbers: Any, counts: Any) -> Any:
    """PRODUCT: 0 of nothing."""
    found = np.multiply.reduce(np.where(counts, numbers, 1.0))
    return np.where(np.logical_or.reduce(counts), found, 0.0)


def squares(numbers: Any, counts: Any) -> Any:
    """SUMSQ."""
    return np.add.reduce(np.square(np.where(counts, numbers, 0.0)))


def median(numbers: Any, counts: Any) -> Any:
    """MEDIAN: #NUM! of nothing."""
    many = count(numbers, counts)
    ordered = np.sort(np.where(counts, numbers, np.inf), axis=0)
    low = np.maximum(np.floor((many - 1) / 2), 0).astype(np.intp)
    high = np.floor(many / 2).astype(np.intp)
    high = np.minimum(high, len(ordered) - 1)
    pair = [np.take_along_axis(ordered, np.expand_dims(index, 0), axis=0)[0] for index in (low, high)]
    codes = np.where(many == 0, np.uint8(NUM), np.uint8(0))
    return np.where(
        many == 0, 0.0, np.where(many == 0, 0.0, pair[0]) / 2 + np.where(many == 0, 0.0, pair[1]) / 2
    ), codes


def ranked(numbers: Any, counts: Any, place: Any, from_top: bool) -> Any:
    """LARGE and SMALL: the `place`-th; #NUM! outside 1..how many there are."""
    many = count(numbers, counts)
    place = np.where(np.less(place, 1), 0.0, np.ceil(place))
    ordered = np.sort(np.where(counts, numbers, np.inf), axis=0)
    index = many - place if from_top else place - 1
    outside = ~((place >= 1) & (place <= many))  # also where it is no number
    safe = np.where(outside, 0, index).astype(np.intp)
    if ordered.ndim == 1:
        found = ordered[safe]
    else:
        safe, _ = np.broadcast_arrays(safe, ordered[0])
        found = np.take_along_axis(ordered, np.expand_dims(safe, 0), axis=0)[0]
    return np.where(outside, 0.0, found), np.where(outside, np.uint8(NUM), np.uint8(0))


def _by_rank(from_top: bool) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        numbers, counts, errors = gather(ev, args[:1], frame)
        place, place_errors = numbers_of(ev.value(args[1], frame, spread), ev.texts)
        found, own = ranked(numbers, counts, place, from_top)
        return finished(found, first_error(None if errors is None else _first_of(errors), place_errors, own))

    return kernel


def counta(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """COUNTA: everything but blanks, errors and empty texts too; nothing between two commas is a value, as for COUNT."""
    del spread
    number: Any = np.float64(0)
    for arg in united(args):
        if isinstance(arg, Missing):
            number = number + 1.0
            continue
        cells = ev.value(arg, frame, spread=True)
        filled = np.broadcast_to(codes_of(cells) != BLANK, cells.shape)
        number = number + np.add.reduce(_flat(filled).astype(np.float64))
    return Cells(number)


def countblank(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """COUNTBLANK: blanks and empty texts."""
    del spread
    cells = ev.value(args[0], frame, spread=True)
    codes = np.broadcast_to(codes_of(cells), cells.shape)
    blank = (codes == BLANK) | ((codes == TEXT) & (cells.numbers == ev.texts.number("")))
    number = np.add.reduce(_flat(blank).astype(np.float64))
    span = ev.span(args[0], frame) if isinstance(args[0], RangeRef) else None
    if span is not None:  # what lies beyond the sheet's data was not read, and is blank
        number = number + span.height * span.width - cells.shape[0] * cells.shape[1]
    return Cells(number)


def sumproduct(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """SUMPRODUCT: products of cells in the same places, summed; #VALUE! when sizes differ."""
    del spread
    product_of: Any = None
    errors: Any = None
    sizes = set()
    for arg in args:
        cells = ev.value(arg, frame, spread=True)
        shape = cells.shape if len(cells.shape) > 2 else (1, 1, *cells.shape)
        sizes.add(shape[:2])
        numbers = np.broadcast_to(cells.numbers, cells.shape)
        codes = np.broadcast_to(codes_of(cells), cells.shape)
        found = codes >= ERROR
        if np.count_nonzero(found):
            errors = first_error(errors, _first_of(_flat(np.where(found, codes, np.uint8(0)))))
        numbers = _flat(np.where(codes == NUMBER, numbers, 0.0))
        product_of = numbers if product_of is None else product_of * numbers if len(sizes) == 1 else product_of
    if len(sizes) > 1:
        return error(VALUE)
    return finished(np.add.reduce(product_of), errors)


def count_numbers(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """COUNT: numbers in cells, and arguments that show a number; errors do not count and do not matter."""
    del spread
    numbers, counts, errors = gather(ev, args, frame)
    return Cells(count(numbers, counts if errors is None else counts & (errors == 0)))


KERNELS: dict[str, Any] = {
    "SUM": fold(total), "SUMSQ": fold(squares), "PRODUCT": fold(product), "AVERAGE": fold(mean),
    "MIN": fold(least), "MAX": fold(greatest), "COUNT": count_numbers, "MEDIAN": fold(median),
    "COUNTA": counta, "COUNTBLANK": countblank, "SUMPRODUCT": sumproduct, "LARGE": _by_rank(True),
    "SMALL": _by_rank(False),
}  # fmt: skip
