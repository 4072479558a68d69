"""Columns that read their own previous row. Two kinds are computed as arrays: running sums, phases unwrapped.

    prev + f(row), f(row) + prev, prev - f(row)      -> a running sum
    x(row) + turn * IFERROR(ROUND((prev - x(row)) / turn, 0), 0)
                                                     -> x and whole turns, within half a turn of the cell above

where `prev` is the cell above, or N of it, which is 0 of a heading, and f, x and turn read nothing of the column itself.
Both are what numpy has an operation for (`cumsum`, `unwrap`), and twenty times as fast as the loop over the rows that all
other columns get which read themselves (`row_loop`): a table of 36,001 rows with one of them takes a fifth of the time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from ...formula.book import Block
from ...formula.nodes import Binary, Call, CellRef, FunctionRef, Node, Number, walk
from ...time_limit import TimeLimitError
from ..graph import area_read, reads_anywhere, references
from ..interpreter.evaluator import Evaluator
from ..kernels.math import rounded
from ..layout import Layout
from ..values.cells import NEAR, NUM, Cells, finished
from ..values.coerce import numbers_of
from ..values.frames import Frame, NotReadyError

HALF, MANY = 1e-9, 1e6
"""Parts of a turn: nearer to half a turn it is asked one by one which way a value goes; so it is after so many turns."""


@dataclass(frozen=True, slots=True)
class RunningSum:
    """`prev` and `step`, joined by `op`; `step_first` when the formula says f + prev."""

    op: Literal["+", "-"]
    prev: Node
    step: Node
    step_first: bool


@dataclass(frozen=True, slots=True)
class Unwrapped:
    """`value` and as many times `turn` (one number for the column) as bring it next to `prev`; anew after an error."""

    value: Node
    turn: Node
    prev: Node


Recurrence: TypeAlias = RunningSum | Unwrapped


def recognise(layout: Layout, number: int, formula: Node) -> Recurrence | None:
    """What kind of recurrence a block is, None when it must be computed row by row."""
    block = layout.blocks[number]
    if block.cols > 1 or block.kind != "fill" or reads_anywhere(formula):
        return None
    if any(isinstance(part, FunctionRef) for part in walk(formula)):
        return None
    title = layout.titles[layout.block_sheets[number]]

    def apart(node: Node) -> bool:
        areas = (area_read(ref, block, layout.sheets) for ref in references(node))
        return all(area is None or number not in layout.producers(area) for area in areas)

    match formula:
        case Binary("+" | "-" as op, prev, step) if _is_above(prev, block, title) and apart(step):
            return RunningSum("+" if op == "+" else "-", prev, step, False)
        case Binary("+", step, prev) if _is_above(prev, block, title) and apart(step):
            return RunningSum("+", prev, step, True)
        case Binary(
            "+",
            value,
            Binary(
                "*",
                turn,
                Call(
                    "IFERROR",
                    (Call("ROUND", (Binary("/", Binary("-", prev, same), per), Number(0))), Number(0)),
                ),
            ),
        ) if (
            same == value
            and per == turn
            and _is_above(prev, block, title)
            and next(references(turn), None) is None
            and apart(value)
        ):
            return Unwrapped(value, turn, prev)
    return None


def _is_above(node: Node, block: Block, title: str) -> bool:
    ref = node.args[0] if isinstance(node, Call) and node.name == "N" and len(node.args) == 1 else node
    if not isinstance(ref, CellRef):
        return False
    return ref.sheet == title and not ref.row_abs and ref.row == block.row - 1 and ref.col == block.col


def compute(kind: Recurrence, ev: Evaluator, frame: Frame) -> Cells:
    """The cells of a frame of the column; the row above the frame has been computed."""
    above = ev.value(kind.prev, frame.cell(0, 0))
    with np.errstate(all="ignore"):
        if isinstance(kind, RunningSum):
            return _running_sum(kind, above, ev, frame)
        return _unwrapped(kind, above, ev, frame)


def _value(ev: Evaluator, node: Node, frame: Frame) -> Cells:
    """The value of a part of the formula; cell by cell where that is asked for, or where some cells cannot be computed."""
    try:
        return ev.value(node, frame)
    except (NotReadyError, TimeLimitError):
        raise
    except Exception:  # said of each cell that cannot be computed
        return ev.cell_by_cell(lambda cell: ev.result(node, cell, part=True), frame)


def _running_sum(kind: RunningSum, above: Cells, ev: Evaluator, frame: Frame) -> Cells:
    rows = (frame.rows,)
    steps, step_errors = numbers_of(_value(ev, kind.step, frame), ev.texts)
    start, start_error = numbers_of(above, ev.texts)
    steps = np.broadcast_to(-steps if kind.op == "-" else steps, rows)
    errors = np.zeros(rows, np.uint8) if step_errors is None else np.array(np.broadcast_to(step_errors, rows))
    carried = 0 if start_error is None else int(start_error)
    first = 0 if carried else _first_or_end(errors != 0)
    numbers = np.full(rows, np.nan)
    numbers[:first] = good = running(float(start), steps[:first], kind.step_first)
    overflow = _first_or_end(~np.isfinite(good))
    if overflow < first:
        first = overflow
        errors[first] = NUM
    if first == frame.rows:
        return Cells(numbers)
    numbers[first:] = np.nan
    if kind.step_first:  # each row's own error comes before the one it inherits
        last = np.maximum.accumulate(np.where(errors != 0, np.arange(frame.rows), -1))
        codes = np.where(last >= 0, errors[np.maximum(last, 0)], np.uint8(carried))
    else:
        codes = np.full(rows, carried or errors[first], np.uint8)
    return Cells(numbers, np.where(np.arange(frame.rows) < first, np.uint8(0), codes).astype(np.uint8))


def _unwrapped(kind: Unwrapped, above: Cells, ev: Evaluator, frame: Frame) -> Cells:
    values, errors = numbers_of(_value(ev, kind.value, frame), ev.texts)
    turns, turn_errors = numbers_of(ev.value(kind.turn, frame.cell(0, 0)), ev.texts)
    start = _start(above, ev)
    codes = np.zeros(frame.rows, np.uint8) if errors is None else np.array(np.broadcast_to(errors, (frame.rows,)))
    if turn_errors is not None:
        codes[codes == 0] = np.uint8(turn_errors)
    values = np.where(codes == 0, np.broadcast_to(values, (frame.rows,)), np.nan)
    found = unwrapped(values, float(turns), start)
    return finished(found, codes if codes.any() else None)


def start_of(kind: Unwrapped, ev: Evaluator, frame: Frame) -> float:
    """The number above the first row of a frame, NaN where there is none: a heading."""
    return _start(ev.value(kind.prev, frame.cell(0, 0)), ev)


def _start(above: Cells, ev: Evaluator) -> float:
    start, error = numbers_of(above, ev.texts)
    return float("nan") if error is not None else float(start)


def unwrapped(values: Any, turn: float, above: float) -> Any:
    """Each value with whole turns added, so that it lies within half a turn of the one before; `above` is the first one's.

    A value after NaN stays as it is. Where a value lies just half a turn away, the rounding of each sum decides.
    """
    values = np.atleast_1d(values)  # one for all rows: then the first decides for all
    before = np.concatenate(([above], values[:-1]))
    steps = (before - values) / turn
    near = np.rint(steps)
    known = np.isfinite(steps)
    if np.any((np.abs(np.abs(steps - near) - 0.5) < HALF) | (np.abs(near) > MANY), where=known):
        return _unwrapped_one_by_one(values, turn, above)
    counted = np.add.accumulate(np.where(known, near, 0.0))
    # A value without a known one before it begins anew: what was counted up to there is taken off again.
    starts = np.maximum.accumulate(np.where(known, -1, np.arange(len(values))))
    counted -= np.where(starts >= 0, counted[np.maximum(starts, 0)], 0.0)
    return _added(values, turn * counted)


def _unwrapped_one_by_one(values: Any, turn: float, above: float) -> Any:
    result = np.empty(len(values))
    for row, value in enumerate(values.tolist()):
        count = float(rounded(np.float64((above - value) / turn), 0))
        above = float(_added(np.float64(value), np.float64(turn * count))) if np.isfinite(count) else value
        result[row] = above
    return result


def _added(one: Any, other: Any) -> Any:
    """The sum, snapped as a cell's would be."""
    total = one + other
    return np.where(np.abs(total) < np.minimum(NEAR * np.abs(one), 1), 0.0, total)


def _first_or_end(mask: Any) -> int:
    """Where a mask holds first, its length when it does not."""
    return int(np.argmax(mask)) if mask.any() else len(mask)


def running(start: float, steps: Any, step_first: bool) -> Any:
    """start + steps[0], that + steps[1], …: added one after the other, each sum snapped as a cell's would be."""
    result = np.empty(len(steps))
    place = 0
    while place < len(steps):
        sums = np.add.accumulate(np.concatenate(([start], steps[place:])))
        found = sums[1:]
        left = steps[place:] if step_first else sums[:-1]
        snaps = np.flatnonzero((np.abs(found) < np.minimum(NEAR * np.abs(left), 1)) & (found != 0))
        end = int(snaps[0]) if len(snaps) else len(found)
        result[place : place + end] = found[:end]
        place += end
        if place < len(steps):
            result[place] = start = 0.0
            place += 1
    return result
