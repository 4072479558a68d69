"""The cells of one evaluation, as formulas written as Python functions read them: see `any_kind`.

What is more than a comparison of numbers and of plain words is the interpreter's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ...formula.book import Settings
from ...formula.nodes import Boolean, Missing, Node, Number, Scalar, Text
from ...time_limit import TimeLimitError
from ..interpreter.evaluator import Evaluator
from ..kernels.table import KERNELS
from ..values.cells import BLANK, ERROR, NA, TEXT
from ..values.coerce import number_shown
from ..values.frames import Frame
from .any_values import CellError, LeftError, equal

MOST = 256
"""Cells of a line: numpy takes as long for them as Python."""
_AS_EXCEL = Settings()
_ANYWHERE = Frame(0, 0, 0, 1, 1)

Places = Sequence[int]
"""Where the cells of a line, a short row or column, lie: a range where they lie side by side; -1 for an empty cell."""


class Memory:
    """The flat array of one evaluation as Python reads it fastest."""

    def __init__(self, ev: Evaluator) -> None:
        self.ev = ev
        self.numbers: Any = ev.numbers.data
        self.codes: Any = ev.codes.data
        self.texts = ev.texts

    # single cells

    def look(self, place: int) -> Scalar:
        """What stands at a place (-1: nothing). Raises CellError for an error."""
        if place < 0:
            return None
        code = self.codes[place]
        if not code:
            number: float = self.numbers[place]
            return number
        if code >= ERROR:
            raise CellError(code)
        if code == BLANK:
            return None
        return self.texts.text(self.numbers[place]) if code == TEXT else bool(self.numbers[place])

    def code(self, place: int) -> int:
        """What kind of value stands at a place."""
        found: int = BLANK if place < 0 else self.codes[place]
        return found

    def fill(self, code: Callable[[Memory, int], Scalar], down: int, place: int) -> bool:
        """Compute a cell; whether that could be done by code."""
        try:
            value = code(self, down)
        except CellError as problem:
            self.numbers[place], self.codes[place] = math.nan, problem.code
        except LeftError:
            return False
        else:
            if value.__class__ is float:
                self.numbers[place], self.codes[place] = value, 0
            else:
                self.numbers[place], self.codes[place] = self.texts.encode(value)
        return True

    def called(self, name: str, *values: Scalar) -> Scalar:
        """A function of single values, by its kernel."""
        try:
            with np.errstate(all="ignore"):
                found = KERNELS[name](self.ev, tuple(map(_written, values)), _ANYWHERE, False)
        except TimeLimitError:
            raise
        except Exception:
            raise LeftError from None  # the interpreter says what becomes of the cell, and remarks it
        if np.ndim(found.numbers) or np.ndim(found.codes):
            raise LeftError  # an array
        code = 0 if found.codes is None else int(found.codes)
        if code >= ERROR:
            raise CellError(code)
        return self.texts.decode(float(found.numbers), code)

    # lines

    def indexed(self, places: Places, number: float) -> Scalar:
        """INDEX of cells in a line; what lies outside of them is the interpreter's."""
        if not 1 <= number < len(places) + 1:
            raise LeftError
        return self.look(places[int(number) - 1])

    def part(self, places: Places, first: Callable[[], float], last: Callable[[], float]) -> Places:
        """`INDEX(line, first):INDEX(line, last)`."""
        try:
            low, high = sorted((first(), last()))
        except CellError:
            raise LeftError from None
        if not (low >= 1 and high < len(places) + 1):
            raise LeftError
        return places[int(low) - 1 : int(high)]

    def in_line(self, places: Places) -> list[float]:
        """The numbers of a line; blanks, texts and truth values do not count. Raises CellError for the first error."""
        codes = self._codes(places)
        if isinstance(places, range) and not any(codes):
            whole: list[float] = self.numbers[places.start : places.stop].tolist()
            return whole
        for code in codes:
            if code >= ERROR:
                raise CellError(code)
        return [self.numbers[place] for place, code in zip(places, codes, strict=True) if not code]

    def count(self, places: Places) -> int:
        """How many numbers."""
        return self._codes(places).count(0)

    def _codes(self, places: Places) -> Sequence[int]:
        if isinstance(places, range):
            return bytes(self.codes[places.start : places.stop])
        return [self.code(place) for place in places]

    def match(self, wanted: Scalar, places: Places) -> float:
        """Where a number, or a word, stands first, from 1. Raises CellError where it does not."""
        if not isinstance(wanted, float) and not self._is_word(wanted):
            raise LeftError
        for at, place in enumerate(places, 1):
            if self._same(wanted, place, self.code(place)):
                return float(at)
        raise CellError(NA)

    def count_if(self, *asked: tuple[Places, Scalar]) -> float:
        """COUNTIFS: several lines of as many cells, and what is asked for in each."""
        for _, wanted in asked:
            if not isinstance(wanted, float) and not self._is_word(wanted):
                raise LeftError
        found = 0
        for down in range(len(asked[0][0])):
            found += all(self._counts(wanted, places[down]) for places, wanted in asked)
        return float(found)

    def criterion(self, place: int) -> Scalar:
        """What stands in a cell that says what is asked for."""
        if self.code(place) >= ERROR:
            raise LeftError
        return self.look(place)

    def _is_word(self, value: Scalar) -> bool:
        """Whether a text means nothing but itself where it is looked for: no number, no truth value, no pattern."""
        return (
            isinstance(value, str)
            and self.texts.settings == _AS_EXCEL
            and value.isalpha()
            and value.upper() not in ("TRUE", "FALSE")
            and number_shown(value, self.texts) is None
        )

    def _same(self, wanted: Scalar, place: int, code: int) -> bool:
        if isinstance(wanted, float):
            return not code and equal(self.numbers[place], wanted)
        return code == TEXT and self._word(place).casefold() == str(wanted).casefold()

    def _counts(self, wanted: Scalar, place: int) -> bool:
        """The same for criteria, to which a text that shows a number is that number."""
        code = self.code(place)
        if isinstance(wanted, float) and code == TEXT:
            shown = number_shown(self._word(place), self.texts)
            return shown is not None and equal(shown, wanted)
        return self._same(wanted, place, code)

    def _word(self, place: int) -> str:
        return self.texts.text(self.numbers[place])


def _written(value: Scalar) -> Node:
    """A value as it would be written in a formula."""
    match value:
        case bool():
            return Boolean(value)
        case float():
            return Number(value)
        case str():
            return Text(value)
    return Missing()  # an error never gets here: it is raised
