"""What the engine computes with: float64 arrays, each with an array of codes beside it that says what a number stands for.

A text is a number into a table of texts, a truth value is 0 or 1, a blank is 0, an error is NaN. So columns of any kind
pass through the same array operations, and a column of plain numbers needs no codes at all (None). Columns are short and
operations many, so whether anything holds is asked by np.count_nonzero: np.any takes longer than most operations.

Arrays of a block have one of four shapes, which numpy broadcasts against each other: () the same in all its cells,
(rows,) along its rows, (cols, 1) along its columns, (cols, rows) both. An array value (a range, a literal) has two axes
more in front: (height, width, cols or 1, rows or 1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...formula.book import Settings
from ...formula.nodes import ErrorValue, Missing, Node, Scalar
from ...said import say


class Frame(NamedTuple):
    """The cells being computed: their first cell, how many, and how far that is from the block's first cell.

    names  what the names of LET and LAMBDA stand for there
    """

    sheet: int
    row: int
    col: int
    rows: int
    cols: int
    down: int = 0
    right: int = 0
    names: Scope | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of a full operand."""
        if self.cols > 1:
            return (self.cols, self.rows)
        return (self.rows,) if self.rows > 1 else ()

    def cell(self, down: int, right: int) -> Frame:
        """One cell of the frame."""
        down_there, right_there = self.down + down, self.right + right
        return Frame(self.sheet, self.row + down, self.col + right, 1, 1, down_there, right_there, self.names)

    def within(self, names: Scope | None) -> Frame:
        """The same cells with other names."""
        return self if names is self.names else self._replace(names=names)


@dataclass(slots=True)
class Bound:
    """What a name stands for: a tree with its scope, or cells; `omitted` when it stands for an argument left out.

    known  the values of the tree so far, by the frame and whether a range is an array there
    """

    node: Node = field(default_factory=Missing)
    scope: Scope | None = None
    cells: Cells | None = None
    omitted: bool = False
    known: dict[tuple[int, int, int, int, bool], Cells] = field(default_factory=dict)


Scope: TypeAlias = Mapping[str, Bound]
"""What names stand for."""


class Span(NamedTuple):
    """What a reference means all over a frame: where it starts, its size, and whether it moves with rows and columns."""

    sheet: int
    row: int
    col: int
    height: int
    width: int
    moves_down: bool
    moves_right: bool


class VaryingSizeError(Exception):
    """A range whose size differs from cell to cell (`A$1:A5` filled down): to be evaluated cell by cell."""


class ArrayArgumentError(Exception):
    """An array where a function wants a single value: to be evaluated for each of its cells."""


class NotReadyError(Exception):
    """A cell that is needed has not been computed yet; what fills it (`Layout.producers`), -1 for one of the step itself."""

    def __init__(self, producer: int) -> None:
        super().__init__()
        self.producer = producer


class UnsupportedError(Exception):
    """Something that a kernel cannot do; the message says what."""


Numbers: TypeAlias = NDArray[np.float64]
Codes: TypeAlias = NDArray[np.uint8]

NUMBER, BLANK, TEXT, BOOLEAN = 0, 1, 2, 3
MOST_CELLS = 1 << 24
"""Cells of an array that an operation makes of smaller ones: one column of a sheet sixteen times."""
MOST_LISTED = 1 << 22
"""Cells of an array that is made or taken apart one by one: some 200 bytes each, where MOST_CELLS take 9."""
MOST_LETTERS = 1 << 28
"""Characters of all texts that one evaluation computes, some 270 MB: ten thousand of the longest."""
EPOCHS = 1462.0
"""Days from the first day of workbooks that count from 1900 to that of workbooks that count from 1904."""
NEAR = 2.0**-48
"""Two numbers nearer than this, relatively, are equal, and their difference is nothing: some 14 to 15 digits."""
ERROR = 16
"""Codes from here on are errors."""

ERROR_NAMES = (
    "#NULL!", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#N/A", "#SPILL!", "#CALC!",
    "#FIELD!", "#BLOCKED!", "#UNKNOWN!", "#CONNECT!", "#BUSY!", "#EXTERNAL!", "#PYTHON!", "#GETTING_DATA",
)  # fmt: skip
NULL, DIV0, VALUE, REF, NAME, NUM, NA, SPILL, CALC = range(ERROR, ERROR + 9)

_ERROR_VALUES = tuple(ErrorValue(name) for name in ERROR_NAMES)
_ERROR_CODES = {name: ERROR + index for index, name in enumerate(ERROR_NAMES)}


def error_code(name: str) -> int:
    """The code of an error's text; anything that is no error's text is #VALUE!."""
    return _ERROR_CODES.get(name.upper(), VALUE)


class Cells(NamedTuple):
    """Numbers and their codes (None: all of them plain numbers), shaped as the module says."""

    numbers: Any
    codes: Any = None

    @property
    def shape(self) -> tuple[int, ...]:
        """The common shape of numbers and codes."""
        shape: tuple[int, ...] = np.shape(self.numbers)
        return shape if self.codes is None else np.broadcast_shapes(shape, np.shape(self.codes))


def different(numbers: Numbers) -> list[float]:
    """The different numbers among few, in order. (`np.unique` takes longer and loads `numpy.ma` the first time.)"""
    return sorted(set(numbers.tolist()))


_AS_EXCEL = Settings()


class Texts:
    """The table of texts of one evaluation: text <-> its number. Texts that differ by case are two here.

    A table may stand on another, which it leaves as it is: the plan's own texts serve all evaluations.

    settings  how texts compare and are searched for;  epochs  days from 1900 to where the workbook's calendar begins
    """

    def __init__(self, base: Texts | None = None, settings: Settings = _AS_EXCEL, epochs: float = 0.0) -> None:
        self.settings: Settings = settings if base is None else base.settings
        self.epochs: float = epochs if base is None else base.epochs
        self._base = base
        self._closed = False
        if base is not None:
            base._closed = True
        self._first = len(base) if base is not None else 0
        self._texts: list[str] = []
        self._numbers: dict[str, int] = {}
        self._letters = 0

    def __len__(self) -> int:
        return self._first + len(self._texts)

    def takes(self, text: str) -> bool:
        """Whether a text is here or can still be put here: not while other tables stand on this one, which number it too."""
        return not self._closed or text in self._numbers

    def number(self, text: str) -> int:
        """The number of a text, new or known. Raises UnsupportedError where computed texts take too much memory."""
        found = self._base._numbers.get(text) if self._base is not None else None
        if found is None or found >= self._first:
            found = self._numbers.get(text)
        if found is None:
            self._letters += len(text)
            if self._base is not None and self._letters > MOST_LETTERS:
                raise UnsupportedError(say("texts of more than {most} characters are not computed", most=MOST_LETTERS))
            found = self._numbers[text] = len(self)
            self._texts.append(text)
        return found

    def text(self, number: float) -> str:
        """The text of a number."""
        index = int(number)
        if index < self._first and self._base is not None:
            return self._base._texts[index]
        return self._texts[index - self._first]

    def key(self, text: str) -> tuple[str, str]:
        """What two texts are compared by: without regard to case; where case counts, small letters before capitals."""
        return text.casefold(), text.swapcase() if self.settings.case_sensitive else ""

    def encode(self, value: Scalar) -> tuple[float, int]:
        """(number, code) of a scalar."""
        match value:
            case None:
                return 0.0, BLANK
            case bool():
                return float(value), BOOLEAN
            case str():
                return float(self.number(value)), TEXT
            case ErrorValue(name):
                return np.nan, error_code(name)
            case _:
                return float(value), NUMBER

    def decode(self, number: float, code: int) -> Scalar:
        """The scalar of (number, code)."""
        if code == NUMBER:
            return float(number)
        if code == TEXT:
            return self.text(number)
        if code == BOOLEAN:
            return bool(number)
        return None if code == BLANK else _ERROR_VALUES[code - ERROR]

    def constant(self, value: Scalar) -> Cells:
        """A scalar as cells of shape ()."""
        number, code = self.encode(value)
        return Cells(np.float64(number), None if code == NUMBER else np.uint8(code))


def too_large(height: int, width: int) -> UnsupportedError:
    """What is raised for an array that would take too much memory."""
    return UnsupportedError(say("an array of {height} x {width} cells is not computed", height=height, width=width))


def error(code: int) -> Cells:
    """One error, shape ()."""
    return Cells(np.float64(np.nan), np.uint8(code))


def boolean(mask: Any) -> Cells:
    """Truth values."""
    return Cells(np.float64(mask) if type(mask) is np.bool_ else np.asarray(mask, np.float64), np.uint8(BOOLEAN))


def finished(numbers: Any, codes: Any = None) -> Cells:
    """A numeric result: `codes` holds errors (0 elsewhere) or is None; what is not finite beside them becomes #NUM!."""
    fine = np.isfinite(numbers)
    if (fine is np.True_ or np.count_nonzero(fine) == fine.size) and (codes is None or not np.count_nonzero(codes)):
        return Cells(numbers)
    if codes is None:
        return Cells(np.where(fine, numbers, np.nan), np.where(fine, np.uint8(NUMBER), np.uint8(NUM)))
    codes = np.where(codes != 0, codes, np.where(fine, np.uint8(0), np.uint8(NUM)))
    return Cells(np.where(codes != 0, np.nan, numbers), codes)


def errors_of(cells: Cells) -> Any:
    """The error codes of cells, 0 where there is none; None when there is none at all."""
    if cells.codes is None:
        return None
    found = cells.codes >= ERROR
    return np.where(found, cells.codes, np.uint8(0)) if np.count_nonzero(found) else None


def first_error(*codes: Any) -> Any:
    """Per cell the first error from the left among arrays of error codes (None: none), or None."""
    result = None
    for part in codes:
        if part is not None:
            result = part if result is None else np.where(result != 0, result, part)
    return result


def choose(mask: Any, then: Cells, otherwise: Cells) -> Cells:
    """`then` where the mask holds, else `otherwise`; arrays of different sizes as `fitted` has them."""
    if max(np.ndim(mask), _axes(then), _axes(otherwise)) > 2:
        asked, then, otherwise = fitted(Cells(np.asarray(mask, np.float64)), then, otherwise)
        mask = np.nan_to_num(asked.numbers) != 0
        if asked.codes is not None:
            beyond = asked.codes != 0
            found = choose(mask, then, otherwise)
            return Cells(np.where(beyond, np.nan, found.numbers), np.where(beyond, asked.codes, codes_of(found)))
    numbers = np.where(mask, then.numbers, otherwise.numbers)
    if then.codes is None and otherwise.codes is None:
        return Cells(numbers)
    zero = np.uint8(NUMBER)
    return Cells(
        numbers,
        np.where(
            mask,
            zero if then.codes is None else then.codes,
            zero if otherwise.codes is None else otherwise.codes,
        ),
    )


def fitted(*cells: Cells) -> tuple[Cells, ...]:
    """Array values made the same size where they differ: #N/A beyond the edge of the smaller one.

    Raises UnsupportedError for what would be more than MOST_CELLS.
    """
    for cell in cells:
        if _axes(cell) > 2:
            break
    else:
        return cells
    sizes = {cell.shape[:2] for cell in cells if len(cell.shape) > 2}
    if len(sizes) < 2:
        return cells
    height, width = (max(size[axis] for size in sizes) for axis in (0, 1))
    if height * width > MOST_CELLS:
        raise too_large(height, width)
    if all(size[0] in (1, height) and size[1] in (1, width) for size in sizes):
        return cells
    return tuple(_padded(cell, height, width) for cell in cells)


def _axes(cells: Cells) -> int:
    """How many axes cells have; np.ndim and np.shape would cost more than the rest of most operations."""
    axes: int = getattr(cells.numbers, "ndim", 0)
    return axes if cells.codes is None else max(axes, getattr(cells.codes, "ndim", 0))


def _padded(cells: Cells, height: int, width: int) -> Cells:
    shape = cells.shape
    if len(shape) <= 2:
        return cells
    down = 0 if shape[0] == 1 else height - shape[0]
    right = 0 if shape[1] == 1 else width - shape[1]
    if not (down or right):
        return cells
    around = ((0, down), (0, right), *((0, 0),) * (len(shape) - 2))
    numbers = np.pad(np.broadcast_to(cells.numbers, shape), around, constant_values=np.nan)
    codes = np.pad(np.broadcast_to(codes_of(cells), shape), around, constant_values=NA)
    return Cells(numbers, codes)


def broadcast(array: Any, shape: tuple[int, ...]) -> Any:
    """np.broadcast_to, which takes longer than most operations, where there is anything to do."""
    return array if np.shape(array) == shape else np.broadcast_to(array, shape)


def codes_of(cells: Cells) -> Any:
    """The codes as an array, also where they are all NUMBER."""
    return np.zeros(np.shape(cells.numbers), np.uint8) if cells.codes is None else cells.codes
