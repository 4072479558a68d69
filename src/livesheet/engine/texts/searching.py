"""What fits a criterion (">3", "=x*", 5, "<>") among cells, and where a value stands in a row or a column."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable
from itertools import takewhile
from typing import Any

import numpy as np

from ...formula.book import Settings
from ...formula.nodes import ErrorValue, Scalar
from ..values.cells import (
    BLANK,
    BOOLEAN,
    ERROR,
    ERROR_NAMES,
    NUMBER,
    TEXT,
    Cells,
    Texts,
    codes_of,
    different,
    error_code,
)
from ..values.coerce import compare_numbers, number_shown, number_to_text
from .patterns import expression, pattern_of

EXACT, SMALLER, LARGER, WILDCARD, EXPRESSION, CRITERION = 0, -1, 1, 2, 3, 4
"""How a text is searched for; a CRITERION as the workbook's settings have it."""
_FOUND = (EXACT, WILDCARD, EXPRESSION, CRITERION)
"""What is found or not, and is never the next best."""
_AS_EXCEL = Settings()
_OFTEN = 4


class Line:
    """One row or column that is searched, with what makes that quick."""

    def __init__(self, table: Cells, texts: Texts, backwards: bool) -> None:
        order = slice(None, None, -1) if backwards else slice(None)
        self.numbers, self.codes = table.numbers.ravel()[order], table.codes.ravel()[order]
        self.size = len(self.numbers)
        self.backwards = backwards
        self.texts = texts
        self._words: list[tuple[int, str]] | None = None
        self._first: dict[str, int] = {}
        self._kinds: dict[int, Any] = {}
        self._asked = 0
        self._numbers: dict[float, int] = {}

    def words(self) -> list[tuple[int, str]]:
        """(place, text without case) of all texts."""
        if self._words is None:
            places = np.flatnonzero(self.codes == TEXT).tolist()
            self._words = [(place, self.texts.text(self.numbers[place]).casefold()) for place in places]
            for place, word in self._words:
                self._first.setdefault(word, place)
        return self._words

    def place(self, number: float, code: int, mode: int) -> int:
        """Where a value is found, counted from the front; -1 nowhere."""
        found = self._place(number, code, mode)
        return self.size - 1 - found if self.backwards and found >= 0 else found

    def _place(self, number: float, code: int, mode: int) -> int:
        if code >= ERROR:
            return -1
        if code == TEXT:
            return self._text_place(self.texts.text(number), mode)
        if code == BLANK:
            hits = np.flatnonzero(self.codes == BLANK)
            if len(hits) or mode in _FOUND:
                return int(hits[0]) if len(hits) else -1
            code = NUMBER
        if code == NUMBER and number in self._first_numbers():
            return self._numbers[number]
        same = self.codes == (BOOLEAN if code == BOOLEAN else NUMBER)
        hits = np.flatnonzero(same & compare_numbers("=", self.numbers, np.float64(number)))
        if len(hits):
            return int(hits[0])
        if mode in _FOUND:
            return -1
        side = np.flatnonzero(same & ((self.numbers < number) if mode == SMALLER else (self.numbers > number)))
        if not len(side):
            return self._in_next_kind(BOOLEAN if code == BOOLEAN else NUMBER, mode)
        values = self.numbers[side]
        return int(side[np.argmax(values) if mode == SMALLER else np.argmin(values)])

    def beside(self, number: float, code: int, descending: bool) -> int:
        """Among sorted values of the same kind the last that does not lie beyond a value; -1 when all do."""
        if code >= ERROR:
            return -1
        if code == TEXT:
            words, folded = self.words(), self.texts.text(number).casefold()
            count = bisect_right(words, folded, key=lambda pair: pair[1])
            if descending:
                count = sum(1 for _ in takewhile(lambda pair: pair[1] >= folded, words))
            return words[count - 1][0] if count else -1
        places = self._places_of(BOOLEAN if code == BOOLEAN else NUMBER)
        values = self.numbers[places]
        count = int(
            np.searchsorted(-values, -number, "right") if descending else np.searchsorted(values, number, "right")
        )
        return int(places[count - 1]) if count else -1

    def _places_of(self, code: int) -> Any:
        found = self._kinds.get(code)
        if found is None:
            found = self._kinds[code] = np.flatnonzero(self.codes == code)
        return found

    def _first_numbers(self) -> dict[float, int]:
        """Where each number stands first; found out when several have been asked for."""
        self._asked += 1
        if self._asked == _OFTEN:
            places = np.flatnonzero(self.codes == NUMBER)[::-1]
            self._numbers = dict(zip(self.numbers[places].tolist(), places.tolist(), strict=True))
        return self._numbers

    def _text_place(self, text: str, mode: int) -> int:
        if mode == EXPRESSION:
            return self._matched(text)
        if mode == CRITERION:
            settings = self.texts.settings
            if settings.searching != "wildcards" or not settings.whole_cells:
                return self._as_set(text)
            mode = WILDCARD
        folded, words = text.casefold(), self.words()
        if mode == WILDCARD and any(mark in text for mark in "*?~"):
            pattern = pattern_of(folded, _AS_EXCEL)
            return next((place for place, word in words if pattern.fits(word)), -1)
        found = self._first.get(folded, -1)
        if found >= 0 or mode in _FOUND:
            return found
        best = -1
        nearest = ""
        for place, word in words:
            beside = word < folded if mode == SMALLER else word > folded
            nearer = best < 0 or (word > nearest if mode == SMALLER else word < nearest)
            if beside and nearer:
                best, nearest = place, word
        return best if best >= 0 else self._in_next_kind(TEXT, mode)

    def _as_set(self, wanted: str) -> int:
        """The first text that fits, where the workbook does not search as Excel does."""
        pattern = pattern_of(wanted, self.texts.settings)
        return next((place for place, _ in self.words() if pattern.fits(self.texts.text(self.numbers[place]))), -1)

    def _matched(self, wanted: str) -> int:
        """The first text in which a regular expression is found."""
        for place, _ in self.words():
            text = self.texts.text(self.numbers[place])
            if expression(wanted, text).search(text):
                return place
        return -1

    def _in_next_kind(self, code: int, mode: int) -> int:
        """The largest value of the kinds before, or the smallest of the kinds after: numbers, texts, truth values."""
        kinds = (NUMBER, TEXT, BOOLEAN)
        place = kinds.index(code)
        others = kinds[:place][::-1] if mode == SMALLER else kinds[place + 1 :]
        for kind in others:
            places = self._places_of(kind)
            if not len(places):
                continue
            if kind == TEXT:
                words = self.words()
                return (max if mode == SMALLER else min)(words, key=lambda pair: pair[1])[0]
            values = self.numbers[places]
            return int(places[np.argmax(values) if mode == SMALLER else np.argmin(values)])
        return -1


Test = Callable[[Cells], Any]
"""Cells -> which of them fit."""

_CRITERION = re.compile(r"(<=|>=|<>|<|>|=)?(.*)", re.DOTALL)


def criterion(value: Scalar, texts: Texts) -> Test:
    """The test that a criterion makes."""
    if isinstance(value, ErrorValue):
        wanted = error_code(value.code)
        return lambda cells: codes_of(cells) == wanted
    if isinstance(value, bool):
        return _flag("=", value)
    if not isinstance(value, str):
        return _number("=", float(value or 0), texts)
    match = _CRITERION.fullmatch(value)
    op, word = (match[1] or "=", match[2]) if match else ("=", value)
    shown = number_shown(word, texts)
    if shown is not None:
        return _number(op, shown, texts)
    if word.upper() in ERROR_NAMES and op in ("=", "<>"):
        wanted = error_code(word)
        return lambda cells: (codes_of(cells) == wanted) ^ (op == "<>")
    if word.upper() in ("TRUE", "FALSE") and op in ("=", "<>"):
        return _flag(op, word.upper() == "TRUE")
    if word == "":
        return _empty(op, match is not None and match[1] is not None, texts)
    return _text(op, word, texts)


def _flag(op: str, flag: bool) -> Test:
    return lambda cells: ((codes_of(cells) == BOOLEAN) & (cells.numbers == flag)) ^ (op == "<>")


def _number(op: str, number: float, texts: Texts) -> Test:
    """Numbers by their size; equal to a number is also a text that shows it."""

    def test(cells: Cells) -> Any:
        codes = codes_of(cells)
        if op not in ("=", "<>"):
            return (codes == NUMBER) & compare_numbers(op, cells.numbers, number)
        found = (codes == NUMBER) & compare_numbers("=", cells.numbers, number)
        if op == "<>":
            return ~found
        is_text = codes == TEXT
        for key in different(cells.numbers[is_text]):
            shown = number_shown(texts.text(key), texts)
            if shown is not None and compare_numbers("=", np.float64(shown), number):
                found = found | (is_text & (cells.numbers == key))
        return found

    return test


def _empty(op: str, written: bool, texts: Texts) -> Test:
    """ "=" blanks, "<>" all others; nothing at all: blanks and empty texts."""
    if not written:
        empty = texts.number("")
        return lambda cells: (codes_of(cells) == BLANK) | ((codes_of(cells) == TEXT) & (cells.numbers == empty))
    if op == "=":
        return lambda cells: codes_of(cells) == BLANK
    if op == "<>":
        return lambda cells: codes_of(cells) != BLANK
    return lambda cells: np.zeros(np.shape(cells.numbers), bool)


def _text(op: str, word: str, texts: Texts) -> Test:
    pattern, folded = pattern_of(word, texts.settings), word.casefold()
    tests: dict[str, Callable[[str], bool]] = {
        "=": pattern.fits,
        "<>": lambda text: not pattern.fits(text),
        "<": lambda text: text.casefold() < folded,
        "<=": lambda text: text.casefold() <= folded,
        ">": lambda text: text.casefold() > folded,
        ">=": lambda text: text.casefold() >= folded,
    }

    def test(cells: Cells) -> Any:
        is_text = codes_of(cells) == TEXT
        result = np.zeros(np.shape(cells.numbers), bool) if op != "<>" else ~is_text
        for key in different(cells.numbers[is_text]):
            if tests[op](texts.text(key)):
                result = result | (is_text & (cells.numbers == key))
        if pattern.of_numbers and op in ("=", "<>"):
            is_number = codes_of(cells) == NUMBER
            for key in different(cells.numbers[is_number]):
                here = is_number & (cells.numbers == key)
                result = np.where(here, tests[op](number_to_text(float(key))), result)
        return result

    return test
