"""What a reference means: references as they stand, and functions and operators that give references.

`A1:INDEX(B1:B9,3)`, `OFFSET(A1,1,0)`, `(A1:B2,C3)` and names of LET that stand for a reference all mean rectangles of
cells (`Span`). What gives a value instead gives None here; a reference that cannot be is the error it becomes, as cells.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ...formula.nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    Apply,
    Binary,
    Call,
    CellRef,
    ErrorValue,
    Local,
    Missing,
    Node,
    RangeRef,
)
from ..values.cells import (
    ERROR,
    NA,
    NULL,
    REF,
    VALUE,
    ArrayArgumentError,
    Cells,
    Frame,
    Span,
    VaryingSizeError,
    error,
    error_code,
)
from ..values.coerce import numbers_of, text_of, truths_of
from .calling import Args
from .closures import Evaluation

Regions: TypeAlias = "list[Span] | Cells | None"


class ReferenceFault(Exception):  # noqa: N818 - an error value on its way to the cell
    """An argument of a function that gives a reference is an error, or leaves the sheet."""

    def __init__(self, found: Cells) -> None:
        super().__init__()
        self.found = found


def regions(ev: Evaluation, node: Node, frame: Frame) -> Regions:
    """The rectangles that a tree means, from the left; None when it means a value, the error when there is one."""
    try:
        return _regions(ev, node, frame)
    except ReferenceFault as fault:
        return fault.found


def _regions(ev: Evaluation, node: Node, frame: Frame) -> Regions:
    match node:
        case CellRef() | RangeRef():
            span = ev.corners(node, frame)
            return error(REF) if span is None else [span]
        case Binary(op, left, right) if op in _OPERATORS:
            first, second = _regions(ev, left, frame), _regions(ev, right, frame)
            if not isinstance(first, list) or not isinstance(second, list):
                return first if isinstance(first, Cells) else second if isinstance(second, Cells) else error(VALUE)
            return _OPERATORS[op](first, second)
        case Call(name, args) if name in _FUNCTIONS:
            return _FUNCTIONS[name](ev, args, frame)
        case ErrorValue(code):
            return error(error_code(code))
        case Local(name):
            bound = (frame.names or {}).get(name)
            if bound is None or bound.cells is not None or bound.omitted:
                return None
            return regions(ev, bound.node, frame.within(bound.scope))
        case Apply():
            body = ev.scopes.applied(ev, node, frame)
            return body if isinstance(body, Cells) else _regions(ev, *body)
        case _:
            return None


# operators


def _union(first: list[Span], second: list[Span]) -> Regions:
    return [*first, *second]


def _shared(first: list[Span], second: list[Span]) -> Regions:
    """What two references have in common: #NULL! when that is nothing."""
    found = []
    for a in first:
        for b in second:
            _same_for_all(a, b)
            row, col = max(a.row, b.row), max(a.col, b.col)
            height, width = min(a.row + a.height, b.row + b.height) - row, min(a.col + a.width, b.col + b.width) - col
            if a.sheet != b.sheet:
                return error(VALUE)
            if height > 0 and width > 0:
                found.append(Span(a.sheet, row, col, height, width, False, False))
    return found or error(NULL)


def _around(first: list[Span], second: list[Span]) -> Regions:
    """The rectangle around both."""
    if len(first) != 1 or len(second) != 1 or first[0].sheet != second[0].sheet:
        return error(VALUE)
    a, b = first[0], second[0]
    _same_for_all(a, b)
    row, col = min(a.row, b.row), min(a.col, b.col)
    height, width = max(a.row + a.height, b.row + b.height) - row, max(a.col + a.width, b.col + b.width) - col
    return [Span(a.sheet, row, col, height, width, False, False)]


def _same_for_all(*spans: Span) -> None:
    if any(span.moves_down or span.moves_right for span in spans):
        raise VaryingSizeError


_OPERATORS: dict[str, Callable[[list[Span], list[Span]], Regions]] = {",": _union, " ": _shared, ":": _around}


# functions


def _number(
    ev: Evaluation, args: Args, place: int, frame: Frame, default: float = 0.0, of_fraction: float = 0.0
) -> float:
    """A whole number among the arguments; `of_fraction` is what a number between 0 and 1 means.

    Raises ReferenceFault for an error, VaryingSizeError or ArrayArgumentError for several numbers.
    """
    if place >= len(args) or isinstance(args[place], Missing):
        return default
    numbers, errors = numbers_of(_one_value(ev, args[place], frame), ev.texts)
    if errors is not None:
        raise ReferenceFault(error(int(np.ravel(errors)[0])))
    number = float(np.ravel(numbers)[0])
    return of_fraction if 0 < number < 1 else float(np.trunc(number))


def _one_value(ev: Evaluation, node: Node, frame: Frame) -> Cells:
    """A single value. Raises ArrayArgumentError for an array, VaryingSizeError for values that differ over the frame."""
    found = ev.value(node, frame, spread=True)
    if np.size(found.numbers) != 1:
        raise ArrayArgumentError if frame.rows == frame.cols == 1 else VaryingSizeError
    return found


def _one(ev: Evaluation, node: Node, frame: Frame) -> Span | Cells | None:
    """The single rectangle that an argument means."""
    found = regions(ev, node, frame)
    if not isinstance(found, list):
        return found
    return found[0] if len(found) == 1 else error(VALUE)


def offset(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """OFFSET(reference, rows, columns, height, width): a negative height counts upwards; #REF! outside the sheet."""
    base = _one(ev, args[0], frame)
    if not isinstance(base, Span):
        return error(VALUE) if base is None else base
    _same_for_all(base)
    row, col = base.row + _number(ev, args, 1, frame), base.col + _number(ev, args, 2, frame)
    height, width = _number(ev, args, 3, frame, base.height, 1), _number(ev, args, 4, frame, base.width, 1)
    if height < 0:
        row, height = row + height + 1, -height
    if width < 0:
        col, width = col + width + 1, -width
    inside = row >= 0 and col >= 0 and row + height <= MAX_ROWS and col + width <= MAX_COLUMNS
    if not inside or not height or not width:
        return error(REF)
    return [Span(base.sheet, int(row), int(col), int(height), int(width), False, False)]


def indirect(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """INDIRECT(text, in A1 form): the reference that a text says; #REF! when it says none."""
    if frame.rows > 1 or frame.cols > 1:
        raise VaryingSizeError
    text = text_of(_one_value(ev, args[0], frame), ev.texts)
    if isinstance(text, Cells):
        return text
    in_a1 = _number(ev, args, 1, frame, 1.0) != 0
    node = ev.scopes.reference(text, in_a1, ev.layout.titles[frame.sheet], frame.row, frame.col)
    found = None if node is None else _regions(ev, node, frame)
    return error(REF) if found is None else found


def index(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """INDEX of a reference: one of its cells, a row or a column of it (0), or all of it."""
    found = regions(ev, args[0], frame)
    if not isinstance(found, list):
        return found
    area = _number(ev, args, 3, frame, 1.0)
    if not 1 <= area <= len(found):
        return error(REF)
    span = found[int(area) - 1]
    _same_for_all(span)
    row, col = _number(ev, args, 1, frame), _number(ev, args, 2, frame)
    if len(args) == 2 and span.height == 1:
        row, col = (row, 0.0) if span.width == 1 else (0.0, row)
    if row < 0 or col < 0:
        return error(VALUE)
    if row > span.height or col > span.width:
        return error(REF)
    first, height = (span.row + int(row) - 1, 1) if row else (span.row, span.height)
    left, width = (span.col + int(col) - 1, 1) if col else (span.col, span.width)
    return [Span(span.sheet, first, left, height, width, False, False)]


def if_(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """IF: the reference of the branch that is taken."""
    mask, errors = truths_of(ev.value(args[0], frame), ev.texts)
    if np.size(mask) != 1:
        if frame.rows == frame.cols == 1:
            return None
        raise VaryingSizeError
    if errors is not None:
        return error(int(np.ravel(errors)[0]))
    place = 1 if np.ravel(mask)[0] else 2
    return regions(ev, args[place], frame) if place < len(args) else None


def choose(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """CHOOSE: the reference that is chosen."""
    cells = ev.value(args[0], frame)
    if np.size(cells.numbers) != 1:
        if frame.rows == frame.cols == 1:
            return None
        raise VaryingSizeError
    place = float(np.trunc(np.ravel(cells.numbers)[0]))
    if cells.codes is not None and np.ravel(cells.codes)[0]:
        place = _number(ev, args, 0, frame)
    return regions(ev, args[int(place)], frame) if 1 <= place < len(args) else error(VALUE)


def let(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """LET: the reference that its last argument means."""
    return _regions(ev, *ev.scopes.let(args, frame))


def spilled(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """`A1#`: the cells of the array whose formula stands in A1; #REF! when there is none."""
    anchor = _one(ev, args[0], frame)
    if not isinstance(anchor, Span):
        return error(REF) if anchor is None else anchor
    _same_for_all(anchor)
    area = ev.layout.spill_at(anchor.sheet, anchor.row, anchor.col)
    return error(REF) if area is None else [Span(*area, False, False)]


def xlookup(ev: Evaluation, args: Args, frame: Frame) -> Regions:
    """XLOOKUP: the row or column of the array of results; None where it must be a value."""
    if frame.rows > 1 or frame.cols > 1:
        raise VaryingSizeError
    results = _one(ev, args[2], frame)
    if not isinstance(results, Span):
        return results
    place = ev.value(Call("XMATCH", (args[0], args[1], *args[4:])), frame)
    if np.size(place.numbers) != 1:
        return None
    if place.codes is not None and np.ravel(place.codes)[0] >= ERROR:
        code = int(np.ravel(place.codes)[0])
        return regions(ev, args[3], frame) if code == NA and len(args) > 3 else place
    size = ev.value(Call("ROWS", (args[1],)), frame)
    step = int(np.ravel(place.numbers)[0]) - 1
    if float(size.numbers) > 1:
        return [Span(results.sheet, results.row + step, results.col, 1, results.width, False, False)]
    return [Span(results.sheet, results.row, results.col + step, results.height, 1, False, False)]


_FUNCTIONS: dict[str, Callable[[Evaluation, Args, Frame], Regions]] = {
    "OFFSET": offset, "INDIRECT": indirect, "INDEX": index, "IF": if_, "CHOOSE": choose, "LET": let,
    "ANCHORARRAY": spilled, "XLOOKUP": xlookup,
}  # fmt: skip
"""Functions that may give a reference."""


def gives_region(node: Node) -> bool:
    """Whether a tree may mean a reference."""
    match node:
        case CellRef() | RangeRef() | Local() | Apply():
            return True
        case Binary(op):
            return op in _OPERATORS
        case Call(name):
            return name in _FUNCTIONS
        case _:
            return False
