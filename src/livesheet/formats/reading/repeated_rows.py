"""Rows that repeat the row above, taken out of the XML before the parser sees them.

The parser reads row by row until a row makes a pattern; rows that match it are taken whole, the next one that does not goes
to the parser again. Only bytes that follow a row's end tag at once are matched, and only in parts without comments, CDATA
sections and processing instructions, so that what looks like a row is one. What a pattern matches, the parser would read
in the same way: `test_row_pattern.py` of both formats compares.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from array import array
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from livesheet.formula.book import BookSheet
from livesheet.formula.nodes import MAX_ROWS, Scalar

from .formulas import Run, Template

_BATCH = 2048
"""Rows handed over at once."""
_MOST_KEPT = 1 << 22
"""A row that is longer goes to the parser in pieces."""
_PATTERNS = 4
"""Patterns that are tried: rows with an error between rows without, say."""
_PRICE = 64
"""Making a pattern takes as long as parsing dozens of rows: so many rows must have gone by for each ..."""
_CREDIT = 8 * _PRICE
"""... but no more are saved up than for a few. So patterns at worst double the time, and a short sheet makes none."""
_PATIENCE = 32
"""Rows that make no pattern, after which pieces go to the parser whole for a while."""
_LONGEST_PAUSE = 64
_HEAD = re.compile(rb"(?:\xef\xbb\xbf)?<\?xml\s[^>]*\?>")
_ENCODING = re.compile(rb"""\sencoding\s*=\s*["']([^"']*)""")
_HIDING = re.compile(rb"<[!?]")

Groups = tuple[bytes, ...]


class Pattern(ABC):
    """What the rows below a row look like, and the runs of formulas that go on in them, by column."""

    def __init__(self, expression: RowExpression, runs: Mapping[int, Run]) -> None:
        self.expression = expression.finished()
        self.runs = runs
        self._rows = list(expression.rows.items())

    @abstractmethod
    def next_row(self) -> int | None:
        """The row that comes next, from 0; None where a row that matches would not be the next one of all runs."""

    def accepts(self, groups: Groups, row: int) -> bool:
        """Whether all row numbers in a row that matches are as far from the row's own as they were."""
        for offset, group in self._rows:
            if groups[group] != b"%d" % (row + 1 + offset):
                return False
        return row < MAX_ROWS

    @abstractmethod
    def take(self, rows: list[Groups]) -> bytes:
        """Take what consecutive rows hold; returns what the parser should read to know where it is."""


class RepeatedRows:
    """Stands between the pieces of a part and the parser.

    end    a row's end tag
    learn  makes a pattern of the bytes of a row that the parser has just read, if that can be done
    count  how many rows the parser has met: what looks like a row may be passed over by those who use the parser
    taken  how many rows the parser has not seen
    """

    def __init__(self, end: bytes, learn: Callable[[bytes], Pattern | None], count: Callable[[], int]) -> None:
        self.taken = 0
        self._end = end
        self._learn = learn
        self._count = count
        self._patterns: list[Pattern] = []
        self._credit = 0
        self._failures = 0
        self._whole = 0
        self._pause = 1

    def through(self, pieces: Iterable[bytes]) -> Iterator[bytes]:
        """What is left for the parser, which must have read each before it asks for the next."""
        stream = iter(pieces)
        data = next(stream, b"")
        head = _HEAD.match(data)
        checked = head.end() if head else 0
        at, fresh = 0, False  # the parser has read data[:at]; `fresh`: which ends with the end of a row
        hidden = not _is_utf8(data)
        while not hidden:
            notes: list[bytes] = []
            if fresh:
                at = self._match(data, at, notes)
            stop = self._next_stop(data, at, fresh)
            if stop > at:
                part = data[at:stop]
                hidden = _HIDING.search(data, max(at, checked), stop) is not None
                whole, before = fresh and not self._whole, self._count()
                at = stop
                yield b"".join((*notes, part))
                fresh = part.endswith(self._end) and self._count() > before + len(notes)
                if whole and fresh:
                    self._consider(part)
                continue
            if notes:
                yield b"".join(notes)
            piece = next(stream, None)
            if piece is None:
                break
            data, at, checked = data[at:] + piece, 0, 0
        yield data[at:]
        yield from stream

    def _next_stop(self, data: bytes, at: int, fresh: bool) -> int:
        """Up to where the parser should read next: the end of a row. `at` when more data is needed first."""
        if self._whole:
            self._whole -= 1
            stop = data.rfind(self._end, at)
        else:
            stop = data.find(self._end, at)
        if stop >= 0:
            return stop + len(self._end)
        if fresh and len(data) - at <= _MOST_KEPT:
            return at
        return max(at, len(data) - data.endswith(b"<"))  # what the last byte begins is seen with the next piece

    def _match(self, data: bytes, at: int, notes: list[bytes]) -> int:
        """Take all rows from `at` on that match; where they end. The parser should read the notes before it goes on."""
        index = 0
        while index < len(self._patterns):
            pattern = self._patterns[index]
            match = pattern.expression.match
            rows: list[Groups] = []
            found = match(data, at)
            row = pattern.next_row() if found is not None else None
            if row is not None:
                while found is not None and len(rows) < _BATCH and pattern.accepts(groups := found.groups(), row):
                    rows.append(groups)
                    row += 1
                    at = found.end()
                    found = match(data, at)
            if not rows:
                index += 1
                continue
            notes.append(pattern.take(rows))
            self.taken += len(rows)
            self._credit = min(_CREDIT, self._credit + len(rows))
            self._failures = 0
            self._patterns.insert(0, self._patterns.pop(index))
            index = 0
        return at

    def _consider(self, row: bytes) -> None:
        """Make a pattern of a row that has been parsed, if that is worth it."""
        self._credit = min(_CREDIT, self._credit + 1)
        pattern = self._learn(row) if self._credit >= _PRICE else None
        if pattern is not None:
            self._credit -= _PRICE
            self._patterns = [pattern, *self._patterns[: _PATTERNS - 1]]
            return
        self._failures += 1
        if self._failures >= _PATIENCE:
            self._failures = 0
            self._whole = self._pause
            self._pause = min(2 * self._pause, _LONGEST_PAUSE)


def _is_utf8(data: bytes) -> bool:
    """Whether a part is UTF-8, or ASCII, by its first bytes."""
    head = _HEAD.match(data)
    if head is None:
        return data.startswith(b"<") and not data.startswith(b"<?")
    encoding = _ENCODING.search(head[0])
    return encoding is None or encoding[1].lower() in (b"utf-8", b"us-ascii")


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
