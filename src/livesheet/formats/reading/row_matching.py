"""Rows matched whole: the regular expression of the rows below a row, and their values put into the sheet."""

from __future__ import annotations

import re
from array import array
from collections.abc import Callable, Sequence

from livesheet.formula.book import BookSheet
from livesheet.formula.nodes import Scalar

from .fill_runs import Template

LONGEST = 1 << 14
"""Longer rows make no pattern: compiling it would take as long as parsing very many of them."""
LEAST = 8
"""Rows that a formula must have been filled down."""
ROW_NUMBER = rb"[1-9][0-9]{0,6}+"
NUMBER = rb"-?+[0-9]{1,17}+(?:\.[0-9]{1,30}+)?+(?:[eE](?:-[0-9]{1,3}+|\+?+[0-9]{1,2}+))?+"
"""A number whose value is finite whatever it is; the parser takes the others."""
TEXT = rb"[^<&\x00-\x1f\xef]*+"
"""A text without markup and without characters that XML does not allow or changes (some of them begin with EF)."""
_CHARACTER = re.compile("&[^;]*;|.", re.DOTALL)


class RowExpression:
    """Written from left to right. `row` is the row's number, from 0; `rows` says how far from it -> in which group."""

    def __init__(self, data: bytes, row: int) -> None:
        self.row = row
        self.rows: dict[int, int] = {}
        self._data = data
        self._parts: list[bytes] = []
        self._done = 0
        self._groups = 0

    def variable(self, start: int, stop: int, expression: bytes) -> None:
        """Something that `expression` matches instead of the bytes from `start` to `stop`."""
        self._parts += (re.escape(self._data[self._done : start]), expression)
        self._done = stop

    def group(self, start: int, stop: int, expression: bytes) -> int:
        """The same as a group; its number, from 0."""
        self.variable(start, stop, b"(%s)" % expression)
        self._groups += 1
        return self._groups - 1

    def number(self, start: int, stop: int, offset: int) -> bool:
        """The number of the row that is `offset` below the row's own, a group where it comes first; False: it is not."""
        if self._data[start:stop] != b"%d" % (self.row + 1 + offset):
            return False
        if offset in self.rows:
            self.variable(start, stop, rb"(?:\%d)" % (self.rows[offset] + 1))
        else:
            self.rows[offset] = self.group(start, stop, ROW_NUMBER)
        return True

    def formula(self, start: int, stop: int, skip: int, template: Template) -> bool:
        """A formula's text that begins after `skip` characters; False when it is not what the template says."""
        pieces = _CHARACTER.findall(self._data[start:stop].decode())  # an entity is one character
        places = [start]
        for piece in pieces:
            places.append(places[-1] + len(piece.encode()))
        for first, last, offset in template.places(self.row):
            if skip + last > len(pieces) or not self.number(places[skip + first], places[skip + last], offset):
                return False
        return True

    def finished(self) -> re.Pattern[bytes]:
        """The expression for the whole row."""
        return re.compile(b"".join((*self._parts, re.escape(self._data[self._done :]))))


def give_numbers(sheet: BookSheet, row: int, col: int, formula: bool, texts: Sequence[bytes]) -> None:
    """Numbers of the cells from (row, col) down, known to be finite; `formula`: as values stored for a formula."""
    if formula:
        sheet.cached.later(row, col, b" ".join(texts))
    else:
        sheet.constants.extend(row, col, array("d", map(float, texts)))


def give_values(
    sheet: BookSheet, row: int, col: int, formula: bool, texts: Sequence[bytes], value: Callable[[bytes, int], Scalar]
) -> None:
    """The same for other kinds of values: `value` says what a text in a row means, the same for the same text."""
    store = sheet.cached if formula else sheet.constants
    known: dict[bytes, Scalar] = {}
    for down, text in enumerate(texts, row):
        found = known.get(text)
        if found is None:
            found = value(text, down)
            if found is None:
                continue
            known[text] = found
        store.put(down, col, found)
