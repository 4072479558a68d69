"""What each of many formulas gives in one strip's own cells: common parts are computed once, and formulas that differ in one
place together, as an array with a row for each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from mechsheet.engine.interpreter.evaluator import Evaluator
from mechsheet.engine.values.cells import NUMBER, Cells
from mechsheet.engine.values.frames import ArrayArgumentError, Frame, VaryingSizeError
from mechsheet.formula.functions import FUNCTIONS
from mechsheet.formula.nodes import (
    Binary,
    Boolean,
    Call,
    CellRef,
    Node,
    Number,
    RangeRef,
    Text,
    Unary,
    calls,
    children,
    rebuilt,
    walk,
)
from mechsheet.homework.mends.candidates import put_at
from mechsheet.homework.truth import Array
from mechsheet.homework.upright import Strip, Work

PLACED = frozenset(("OFFSET", "INDIRECT", "CELL", "FORMULATEXT"))
TURNED = frozenset(
    ("ROW", "COLUMN", "INDEX", "VLOOKUP", "HLOOKUP", "MATCH", "LOOKUP", "ROWS", "COLUMNS", "TRANSPOSE", "MMULT")
)
"""Functions that mean another thing on a sheet laid out anew: always, and where rows and columns were exchanged."""
_PLAIN = (Number, Text, Boolean, CellRef, RangeRef, Unary, Binary, Call)
_OF_NUMBERS = frozenset(
    (
        "SIN",
        "COS",
        "TAN",
        "ASIN",
        "ACOS",
        "ATAN",
        "ATAN2",
        "SQRT",
        "ABS",
        "SIGN",
        "RADIANS",
        "DEGREES",
        "POWER",
    )
)
"""Functions that are computed cell by cell: of an array with a row for each formula, too."""
_ARITHMETIC = "+-*/^"


def is_simple(formula: Node) -> bool:
    """Whether a formula is made of what means the same anywhere."""
    called = set(calls(formula))
    plain = all(isinstance(part, _PLAIN) for part in walk(formula))
    return plain and called <= FUNCTIONS.keys() and not called & (PLACED | TURNED)


def own_values(work: Work, strip: Strip, formula: Node, candidates: Sequence[Node]) -> Array:
    """What each candidate gives in a strip's own cells, (candidates, cells); NaN for what is no number.

    formula  the strip's own, of which the candidates are changes: they share its parts
    """
    sheet, row, col = work.engine_place((strip.sheet, strip.start, strip.line))
    index = next(n for n, title in enumerate(work.plan.layout.titles) if title == sheet)
    frame = Frame(index, row, col, *((1, strip.length) if work.across else (strip.length, 1)))
    return _Stack(work, frame, formula).values(candidates)


_Key = tuple[tuple[int, ...], str, int]
"""Where formulas differ: the path from the root, and an operator put there with what stands on its other side (0 or 1)."""


class _Stack:
    """Formulas over one frame."""

    def __init__(self, work: Work, frame: Frame, formula: Node) -> None:
        self.frame = frame
        self.turn = _Turn() if work.across else None
        self.formula = formula
        self.evaluator = _Remembering(work.computed, set(map(id, walk(self._there(formula)))))
        self.cells = frame.rows * frame.cols

    def _there(self, node: Node) -> Node:
        return node if self.turn is None else self.turn(node)

    def values(self, candidates: Sequence[Node]) -> Array:
        """See `own_values`."""
        found = np.full((len(candidates), self.cells), np.nan)
        groups: dict[_Key, list[tuple[int, Node]]] = {}
        for place, candidate in enumerate(candidates):
            hole = _hole(self.formula, candidate)
            if hole is None:
                found[place] = self._one(candidate)
            else:
                groups.setdefault(hole[0], []).append((place, hole[1]))
        for key, members in groups.items():
            places = [place for place, _ in members]
            try:
                found[places] = self._group(key, [leaf for _, leaf in members])
            except VaryingSizeError:
                for place in places:
                    found[place] = self._one(candidates[place])
        return found

    def _one(self, candidate: Node) -> Array:
        return _numbers(self.evaluator.result(self._there(candidate), self.frame), self.frame.shape).ravel()

    def _group(self, key: _Key, leaves: Sequence[Node]) -> Array:
        """The values with each leaf in one place, (leaves, cells). Raises VaryingSizeError."""
        evaluator, frame = self.evaluator, self.frame
        read = [evaluator.remembered(self._there(leaf), frame) for leaf in leaves]
        numbers = np.array([np.broadcast_to(one.numbers, frame.shape).ravel() for one in read])
        codes = None
        if any(one.codes is not None for one in read):
            codes = np.zeros(numbers.shape, np.uint8)
            for place, one in enumerate(read):
                if one.codes is not None:
                    codes[place] = np.broadcast_to(one.codes, frame.shape).ravel()
        upright = frame.cols > 1  # an operand has the shape (cells, 1) then, else (cells,)
        stacked = Cells(numbers.T if upright else numbers, codes if codes is None else codes.T if upright else codes)
        marker = Number(0.0)
        path, operator, side = key
        there = self._there(self.formula)
        new: Node = marker
        if operator:
            part = _at(there, path)
            new = Binary(operator, *((marker, part) if side == 0 else (part, marker)))
        shape = (self.cells, len(leaves)) if upright else (len(leaves), self.cells)
        with evaluator.standing_for(marker, stacked):
            found = _numbers(evaluator.result(put_at(there, path, new), frame), shape)
        return found.T if upright else found


def _numbers(cells: Cells, shape: tuple[int, ...]) -> Array:
    numbers = np.broadcast_to(cells.numbers, shape)
    if cells.codes is not None:
        numbers = np.where(np.broadcast_to(cells.codes, shape) == NUMBER, numbers, np.nan)
    return numbers


def _hole(formula: Node, candidate: Node) -> tuple[_Key, Node] | None:
    """Where a candidate differs from a formula and what stands there; None where arrays are not computed cell by cell."""
    path: list[int] = []
    old, new = formula, candidate
    while type(old) is type(new):
        pairs = list(zip(children(old), children(new), strict=False))
        if not _same_head(old, new) or len(pairs) != len(children(new)) or not _by_cells(old):
            break
        different = [index for index, (one, other) in enumerate(pairs) if one is not other]
        if len(different) != 1:
            break
        path.append(different[0])
        old, new = pairs[different[0]]
    if isinstance(new, Binary) and new.op in _ARITHMETIC and (new.left is old) != (new.right is old):
        key: _Key = tuple(path), new.op, int(new.left is old)
        new = new.right if new.left is old else new.left
    elif path:
        key = tuple(path), "", 0
    else:
        return None
    return None if any(isinstance(part, RangeRef) for part in walk(new)) else (key, new)


def _same_head(old: Node, new: Node) -> bool:
    match old, new:
        case Binary(one), Binary(other):
            return one == other
        case Unary(one), Unary(other):
            return one == other
        case Call(one), Call(other):
            return one == other
    return False


def _by_cells(node: Node) -> bool:
    match node:
        case Binary(op):
            return op in _ARITHMETIC
        case Unary():
            return True
        case Call(name):
            return name in _OF_NUMBERS
    return False


def _at(node: Node, path: Sequence[int]) -> Node:
    for number in path:
        node = children(node)[number]
    return node


class _Remembering(Evaluator):
    """An evaluator that computes what all candidates have in common once. `common`: ids of the nodes of the formula."""

    def __init__(self, like: Evaluator, common: set[int]) -> None:
        super().__init__(like.layout, like.numbers, like.codes, like.texts, like.around)
        self.common = common
        self.known: dict[tuple[int, bool], Cells] = {}

    def value(self, node: Node, frame: Frame, spread: bool = False) -> Cells:
        """As the evaluator's."""
        if id(node) not in self.common:
            return super().value(node, frame, spread)
        key = id(node), spread
        found = self.known.get(key)
        if found is None:
            found = self.known[key] = super().value(node, frame, spread)
        return found

    def remembered(self, node: Node, frame: Frame) -> Cells:
        """The value of a node that several candidates may share, and that stays as long as this evaluator."""
        self.common.add(id(node))
        with np.errstate(all="ignore"):
            try:
                return self.value(node, frame)
            except ArrayArgumentError as error:
                raise VaryingSizeError from error

    @contextmanager
    def standing_for(self, marker: Node, cells: Cells) -> Iterator[None]:
        """While this lasts, the value of a node is these cells."""
        self.common.add(id(marker))
        self.known |= {(id(marker), spread): cells for spread in (False, True)}
        try:
            yield
        finally:
            self.common.discard(id(marker))
            for spread in (False, True):
                del self.known[id(marker), spread]


class _Turn:
    """Exchanges rows and columns; a part that was exchanged before is the same object again."""

    def __init__(self) -> None:
        self.known: dict[int, tuple[Node, Node]] = {}

    def __call__(self, node: Node) -> Node:
        found = self.known.get(id(node))
        if found is None:
            below = children(node)
            if isinstance(node, CellRef):
                new: Node = CellRef(node.col, node.row, node.col_abs, node.row_abs, node.sheet)
            else:
                new = rebuilt(node, tuple(map(self, below))) if below else node
            found = self.known[id(node)] = (node, new)
        return found[1]
