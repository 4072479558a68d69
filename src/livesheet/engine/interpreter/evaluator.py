"""The plain way to evaluate a formula: any kind of value, every error in its place, whole blocks at a time.

This is the definition of what a formula means here; the fast path is held to it by tests. A *frame* is the part of a block
that is being computed; every operand has the frame's shape or one that broadcasts to it (`values/cells.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np

from ...formula.functions import FUNCTIONS
from ...formula.nodes import (
    UNKNOWN_FUNCTION,
    Apply,
    Arrayed,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Foreign,
    FunctionRef,
    Local,
    Missing,
    Node,
    Number,
    RangeRef,
    Text,
    Unary,
)
from ...said import reason, say
from ...time_limit import TimeLimitError
from ..kernels.math import OPERATORS, snapped
from ..kernels.table import KERNELS
from ..layout import Layout
from ..values.cells import (
    BLANK,
    CALC,
    VALUE,
    ArrayArgumentError,
    Bound,
    Cells,
    Codes,
    Frame,
    NotReadyError,
    Numbers,
    Span,
    Texts,
    UnsupportedError,
    VaryingSizeError,
    codes_of,
    error,
    error_code,
    finished,
    first_error,
    fitted,
)
from ..values.coerce import compared, each, joined, numbers_of
from .calling import SINGLES
from .closures import Evaluation, Scopes
from .environment import CELLS_A_STEP, LIFTED_STEPS, Environment, deeply
from .reading import codes_of_all
from .regions import gives_region, regions
from .rewriting import REFERENCES

_OVER_REFERENCES = frozenset(
    ("SUBTOTAL", "SUMIF", "COUNTIF", "AVERAGEIF", "SUMIFS", "COUNTIFS", "AVERAGEIFS", "N", "T")
)
"""Functions that take one reference after the other where OFFSET or INDIRECT give many."""
_COMPARISONS = frozenset(("=", "<>", "<", "<=", ">", ">="))


class Evaluator(Evaluation):
    """Evaluates formulas over the flat array of one evaluation. `singly`: how often a frame was taken cell by cell."""

    def __init__(
        self, layout: Layout, numbers: Numbers, codes: Codes, texts: Texts, around: Environment | None = None
    ) -> None:
        super().__init__(layout, numbers, codes, texts, around)
        self.singly = 0
        self.scopes = Scopes(self.around.functions, self.around.reference, self.around.budget)

    def result(self, formula: Node, frame: Frame, part: bool = False) -> Cells:
        """What the cells of a frame show: of an array its first cell, with the last + or - snapped and a blank as 0.

        What cannot be computed shows what the file holds; `part`: a part of the cells' formula, which shows #VALUE! then.
        """
        try:
            found = self._safely(formula, frame, False)
        except VaryingSizeError:
            return self.cell_by_cell(lambda cell: self.result(formula, cell, part), frame)
        if found is None:
            return error(VALUE) if part else self.stored(frame)
        if np.ndim(found.numbers) > 2:
            found = Cells(found.numbers[0, 0], None if found.codes is None else codes_of_all(found)[0, 0])
            if frame.rows == frame.cols == 1:
                found = Cells(np.ravel(found.numbers)[0], None if found.codes is None else np.ravel(found.codes)[0])
        return without_blanks(found)

    def stored(self, frame: Frame) -> Cells:
        """The value that the file holds for a cell that cannot be computed, #VALUE! where it holds none."""
        value = self.around.stored(frame.sheet, frame.row, frame.col)
        return error(VALUE) if value is None else self.texts.constant(value)

    def array(self, formula: Node, frame: Frame) -> Cells | None:
        """What an array formula gives, as cells of two axes (height, width); None where it cannot be computed."""
        found = self._safely(formula, frame, True)
        if found is None:
            return None
        shape = found.shape
        if len(shape) > 2:
            numbers = np.broadcast_to(found.numbers, shape)[:, :, 0, 0]
            codes = np.broadcast_to(codes_of(found), shape)[:, :, 0, 0]
        else:
            numbers, codes = np.reshape(found.numbers, (1, 1)), np.reshape(codes_of(found), (1, 1))
        return without_blanks(Cells(numbers, codes))

    def _safely(self, formula: Node, frame: Frame, spread: bool) -> Cells | None:
        """The value; of a single cell None with a remark where it cannot be computed.

        Raises VaryingSizeError for several cells of which some cannot be: each of them by itself may do better.
        """
        try:
            self.around.budget.begin()
            return deeply(lambda: self._unsafely(formula, frame, spread))
        except RecursionError:
            message: str = say("a formula nested too deeply")
        except (NotReadyError, TimeLimitError):
            raise
        except Exception as problem:
            if frame.rows > 1 or frame.cols > 1:
                raise VaryingSizeError from problem
            message = _reason(problem)
        if self.around.stored(frame.sheet, frame.row, frame.col) is not None:
            message = say("{message}: the stored value is kept", message=message)
        self.around.remark(message, frame.sheet, frame.row, frame.col)
        self.around.kept.add((frame.sheet, frame.row, frame.col))
        return None

    def _unsafely(self, formula: Node, frame: Frame, spread: bool) -> Cells:
        with np.errstate(all="ignore"):
            if isinstance(formula, Binary) and formula.op not in REFERENCES:
                return self.chain(formula, frame, spread, snap=True)
            return self.value(formula, frame, spread)

    def value(self, node: Node, frame: Frame, spread: bool = False) -> Cells:
        """The value of a tree over a frame. `spread`: a range is an array there; else the cell of it beside the formula."""
        match node:
            case Number(number):
                return Cells(np.float64(number))
            case CellRef():
                return self.cell(node, frame)
            case Binary(op):
                return self.region(node, frame, spread) if op in REFERENCES else self.chain(node, frame, spread)
            case Unary(op, operand):
                return self.signed(op, self.value(operand, frame, spread))
            case Call():
                return self.call(node, frame, spread)
            case RangeRef():
                if not spread:
                    return self.beside(node, frame)
                found = self.range(node, frame)
                if self.around.budget.depth:
                    self.around.budget.spend(np.size(found.numbers) // CELLS_A_STEP)
                return found
            case Text(text):
                return self.texts.constant(text)
            case Boolean(flag):
                return self.texts.constant(flag)
            case ErrorValue():
                return self.texts.constant(node)
            case Missing():
                return self.texts.constant(None)
            case ArrayLiteral():
                return self.literal(node, frame)
            case Local(name):
                return self.scopes.local(self, name, frame, spread)
            case Apply():
                return self.scopes.call(self, node, frame, spread)
            case Arrayed(operand):
                return self.value(operand, frame, True)
            case FunctionRef():
                return error(CALC)
            case Foreign(why=why):  # what keeps stored values is not computed: here there are none
                return error(error_code("#NAME?" if why == UNKNOWN_FUNCTION else "#REF!"))
            case _:
                raise TypeError(f"{node} is not resolved")

    def chain(self, node: Binary, frame: Frame, spread: bool, snap: bool = False) -> Cells:
        """A run of operators down the left side, in one loop: a sum may have thousands of terms."""
        run: list[Binary] = []
        left: Node = node
        while isinstance(left, Binary) and left.op not in REFERENCES:
            run.append(left)
            left = left.left
        total = self.value(left, frame, spread)
        for part in reversed(run):
            before = total
            total = self.operate(part.op, total, self.value(part.right, frame, spread))
        if snap and node.op in "+-":
            before, total = fitted(before, total)
            total = Cells(snapped(total.numbers, numbers_of(before, self.texts)[0]), total.codes)
        return total

    def operate(self, op: str, left: Cells, right: Cells) -> Cells:
        """An operator between two values."""
        if op in _COMPARISONS:
            left, right = fitted(left, right)
            return compared(op, left, right, self.texts)
        if op == "&":
            return each(joined, (left, right), self.texts, self.around.budget.spend)
        return self.mapped(self.around.arithmetic.functions.get(op, OPERATORS[op]), (left, right))

    def signed(self, op: str, operand: Cells) -> Cells:
        """A sign or `%`."""
        if op == "+":
            return operand
        return self.mapped(np.negative if op == "-" else lambda number: number / 100, (operand,))

    def mapped(self, function: Callable[..., Any], args: tuple[Cells, ...]) -> Cells:
        """A function of numbers over values: errors of arguments first, from the left, then the function's own."""
        codes = None
        numbers = [arg.numbers for arg in args if arg.codes is None and type(arg.numbers) is np.float64]
        if len(numbers) < len(args):  # not all of them single numbers, as most are
            pairs = [numbers_of(arg, self.texts) for arg in fitted(*args)]
            codes = first_error(*(pair[1] for pair in pairs))
            numbers = [pair[0] for pair in pairs]
        found = function(*numbers)
        if isinstance(found, tuple):
            found, own = found
            codes = first_error(codes, own)
        return finished(found, codes)

    def call(self, node: Call, frame: Frame, spread: bool) -> Cells:
        """A function's value; cell by cell where a range changes its size over the frame."""
        if spread and node.name in _OVER_REFERENCES and self._over_references(node, frame):
            return self.lifted(node, frame)
        try:
            return KERNELS[node.name](self, node.args, frame, spread)
        except ArrayArgumentError:
            return self.lifted(node, frame)
        except VaryingSizeError:
            if frame.rows == frame.cols == 1:
                raise
        return self.cell_by_cell(lambda cell: self.call(node, cell, spread), frame)

    def cell_by_cell(self, compute: Callable[[Frame], Cells], frame: Frame) -> Cells:
        """The values of a frame's cells, each computed by itself. Raises VaryingSizeError when one of them is an array."""
        self.singly += 1
        numbers, codes = np.empty((frame.cols, frame.rows)), np.zeros((frame.cols, frame.rows), np.uint8)
        for right in range(frame.cols):
            for down in range(frame.rows):
                found = compute(frame.cell(down, right))
                if np.size(found.numbers) > 1 or np.size(found.codes) > 1:
                    raise VaryingSizeError
                numbers[right, down] = np.ravel(found.numbers)[0]
                codes[right, down] = 0 if found.codes is None else np.ravel(found.codes)[0]
        return Cells(numbers.reshape(frame.shape), codes.reshape(frame.shape) if codes.any() else None)

    def _over_references(self, node: Call, frame: Frame) -> bool:
        """Whether an argument means many references: OFFSET or INDIRECT with an array among its own arguments."""
        inner = [slot for slot in slots(node) if len(slot) > 1]
        return any(np.size(self.value(at_slot(node, slot), frame, True).numbers) > 1 for slot in inner)

    def lifted(self, node: Call, frame: Frame) -> Cells:
        """A function that was given an array where it wants a single value: its value for each cell of the array."""
        if frame.rows > 1 or frame.cols > 1:
            raise VaryingSizeError
        singles = slots(node)
        if not singles:  # the array says where a range ends, as in A1:INDEX(A1:A5,B1:B3): many ranges are no value
            return error(VALUE)
        values = fitted(*(self.value(at_slot(node, slot), frame, True) for slot in singles))
        height, width = np.broadcast_shapes(*((1, 1, *cells.shape)[-4:][:2] for cells in values))
        names = [f"argument {slot} of {node.name}" for slot in singles]
        call = with_slots(node, dict(zip(singles, (Local(name) for name in names), strict=True)))
        self.around.budget.spend(LIFTED_STEPS * height * width)
        numbers, codes = np.empty((height, width, 1, 1)), np.zeros((height, width, 1, 1), np.uint8)
        for down in range(height):
            for right in range(width):
                parts = {
                    name: Bound(cells=part_of(cells, down, right)) for name, cells in zip(names, values, strict=True)
                }
                found = self.call(call, frame.within({**(frame.names or {}), **parts}), True)
                first = found if np.ndim(found.numbers) == 0 else part_of(found, 0, 0)
                numbers[down, right], codes[down, right] = first.numbers, 0 if first.codes is None else first.codes
        return Cells(numbers, codes if codes.any() else None)

    # references

    def span(self, node: Node, frame: Frame) -> Span | None:
        """The one rectangle that a reference means over the frame, None where it leaves the sheet or is no reference."""
        if isinstance(node, CellRef | RangeRef):
            return self.corners(node, frame)
        found = regions(self, node, frame) if gives_region(node) else None
        return found[0] if isinstance(found, list) and len(found) == 1 else None

    def region(self, node: Node, frame: Frame, spread: bool) -> Cells:
        """The cells that an expression means which gives a reference: as an array, or the one beside the formula."""
        found = regions(self, node, frame)
        if found is None:
            return error(VALUE)
        if isinstance(found, Cells):
            return found
        if len(found) > 1:
            return self.joined(found, frame) if spread else error(VALUE)
        return self.of_span(found[0], frame, spread)

    def literal(self, node: ArrayLiteral, frame: Frame) -> Cells:
        """`{1,2;3,4}` as an array value."""
        parts = [[self.value(item, frame) for item in row] for row in node.rows]
        numbers = np.array([[float(cell.numbers) for cell in row] for row in parts])
        codes = np.array([[0 if cell.codes is None else int(cell.codes) for cell in row] for row in parts], np.uint8)
        shape = (*numbers.shape, 1, 1)
        return Cells(numbers.reshape(shape), codes.reshape(shape) if codes.any() else None)


def _reason(problem: Exception) -> str:
    """Why a cell cannot be computed. One formula that this program gets wrong must not take the others with it."""
    if isinstance(problem, UnsupportedError):
        return reason(problem)
    if isinstance(problem, VaryingSizeError | ArrayArgumentError):
        return say("an array where a single value is wanted")
    return say(
        "not computed, by a fault of this program: {kind}: {problem}",
        kind=type(problem).__name__,
        problem=problem,
    )


def without_blanks(cells: Cells) -> Cells:
    """The cells with 0 for blanks, as a formula shows them."""
    if cells.codes is None:
        return cells
    blank = cells.codes == BLANK
    return Cells(cells.numbers, np.where(blank, np.uint8(0), cells.codes)) if np.count_nonzero(blank) else cells


def part_of(cells: Cells, down: int, right: int) -> Cells:
    """One cell of an array value; a single value is the same everywhere."""
    shape = cells.shape
    if len(shape) <= 2:
        return cells
    place = down if shape[0] > 1 else 0, right if shape[1] > 1 else 0, 0, 0
    code = np.broadcast_to(codes_of(cells), shape)[place]
    return Cells(np.broadcast_to(cells.numbers, shape)[place], code if code else None)


Slot: TypeAlias = tuple[int, ...]
_GIVING_REFERENCES = ("OFFSET", "INDIRECT")


def slots(node: Call) -> list[Slot]:
    """The slots of a call, its own and those of the references it is given."""
    found: list[Slot] = []
    for place, (arg, kind) in enumerate(zip(node.args, FUNCTIONS[node.name].kinds_of(len(node.args)), strict=True)):
        if kind in SINGLES or kind == "q":
            found.append((place,))
        elif isinstance(arg, Call) and arg.name in _GIVING_REFERENCES:
            found += [(place, *inner) for inner in slots(arg) if not isinstance(at_slot(arg, inner), Missing)]
    return found


def at_slot(node: Call, slot: Slot) -> Node:
    """The argument in a slot."""
    found: Node = node
    for place in slot:
        assert isinstance(found, Call)
        found = found.args[place]
    return found


def with_slots(node: Call, new: Mapping[Slot, Node]) -> Call:
    """The call with other arguments in some slots."""
    args = list(node.args)
    for place, arg in enumerate(args):
        inner = {slot[1:]: value for slot, value in new.items() if slot[0] == place}
        if () in inner:
            args[place] = inner[()]
        elif inner and isinstance(arg, Call):
            args[place] = with_slots(arg, inner)
    return Call(node.name, tuple(args))
