"""The records of a BIFF8 stream, with what continues them, and the texts in them. Source: Microsoft, [MS-XLS]."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

from livesheet.said import say


class Kind(IntEnum):
    """The kinds of records that are read."""

    FORMULA = 0x0006
    PRECISION = 0x000E
    EOF = 0x000A
    EXTERN_SHEET = 0x0017
    NAME = 0x0018
    DATES = 0x0022
    EXTERN_NAME = 0x0023
    PASSWORD = 0x002F
    CONTINUE = 0x003C
    SAVED_BY = 0x005C
    SHEET = 0x0085
    FILTER_MODE = 0x009B
    MANY_RK = 0x00BD
    RICH_LABEL = 0x00D6
    SHARED_TEXTS = 0x00FC
    SHARED_LABEL = 0x00FD
    BOOK = 0x01AE
    NUMBER = 0x0203
    LABEL = 0x0204
    BOOLEAN = 0x0205
    STRING = 0x0207
    ROW = 0x0208
    ARRAY = 0x0221
    TABLE = 0x0236
    RK = 0x027E
    SHARED_FORMULA = 0x04BC
    BOF = 0x0809


class DamagedError(Exception):
    """A record that ends too early or says what cannot be; the reader tells it with the file's name."""


@dataclass(frozen=True, slots=True)
class Record:
    """One record: its kind, where it begins in the stream, its bytes and those of the records that continue it."""

    kind: int
    at: int
    pieces: list[bytes]

    @property
    def data(self) -> bytes:
        """All bytes in one."""
        return self.pieces[0] if len(self.pieces) == 1 else b"".join(self.pieces)


def records(stream: bytes, at: int, end: int | None = None) -> Iterator[Record]:
    """The records of the part of a stream that begins at `at` with a BOF, up to its EOF; parts inside of it (charts) are
    passed over. `end`: where it has to be over. Raises DamagedError where the stream ends first."""
    end = len(stream) if end is None else end
    depth = 0
    pending: Record | None = None
    while at + 4 <= end:
        kind, length = struct.unpack_from("<HH", stream, at)
        data = stream[at + 4 : at + 4 + length]
        if at + 4 + length > end:
            break
        if kind == Kind.CONTINUE and pending is not None:
            pending.pieces.append(data)
        else:
            if pending is not None:
                yield pending
            pending = None
            if kind == Kind.BOF:
                depth += 1
            if depth == 1:
                pending = Record(kind, at, [data])
            if kind == Kind.EOF:
                depth -= 1
                if depth <= 0:
                    if pending is not None:
                        yield pending
                    return
        at += 4 + length
    raise DamagedError(say("the workbook ends in the middle"))


class Reader:
    """Reads on through the pieces of a record."""

    def __init__(self, pieces: list[bytes]) -> None:
        self._pieces = pieces
        self._piece = 0
        self._at = 0

    @property
    def done(self) -> bool:
        """Whether nothing is left."""
        return self._piece >= len(self._pieces) - 1 and self._at >= len(self._pieces[-1])

    def take(self, count: int) -> bytes:
        """The next bytes, out of as many pieces as it takes."""
        found = b""
        while len(found) < count:
            piece = self._here()
            part = piece[self._at : self._at + count - len(found)]
            self._at += len(part)
            found += part
        return found

    def rest(self) -> bytes:
        """All that is left."""
        found = self._pieces[self._piece][self._at :] + b"".join(self._pieces[self._piece + 1 :])
        self._piece, self._at = len(self._pieces) - 1, len(self._pieces[-1])
        return found

    def skip(self, count: int) -> None:
        """Past bytes that mean nothing here."""
        while count:
            step = min(count, len(self._here()) - self._at)
            self._at += step
            count -= step

    def unpack(self, form: str) -> tuple[int, ...]:
        """Numbers."""
        return struct.unpack(form, self.take(struct.calcsize(form)))

    def _here(self) -> bytes:
        """The piece with the next byte."""
        while self._at >= len(self._pieces[self._piece]):
            if self._piece + 1 >= len(self._pieces):
                raise DamagedError(say("a record ends in the middle"))
            self._piece += 1
            self._at = 0
        return self._pieces[self._piece]

    def letters(self, count: int, wide: bool) -> str:
        """The letters of a text; a piece that goes on with one says anew how many bytes a letter has."""
        found: list[str] = []
        while count:
            if self._at >= len(self._pieces[self._piece]):
                self._here()
                wide = bool(self.take(1)[0] & 1)
            left = len(self._here()) - self._at
            size = 2 if wide else 1
            step = min(count, left // size)
            if not step:
                raise DamagedError(say("half a letter"))
            data = self.take(step * size)
            found.append(data.decode("utf-16-le" if wide else "latin-1", "replace"))
            count -= step
        return "".join(found)

    def text(self, count: int) -> str:
        """A text of so many letters, with its mark before and without what is said of its fonts and its reading."""
        mark = self.take(1)[0]
        runs = self.unpack("<H")[0] if mark & 8 else 0
        reading = self.unpack("<I")[0] if mark & 4 else 0
        found = self.letters(count, bool(mark & 1))
        if runs or reading:
            self.skip(4 * runs + reading)
        return found


def shared_texts(record: Record) -> list[str]:
    """The texts that cells name by number."""
    reader = Reader(record.pieces)
    count = reader.unpack("<II")[1]
    found: list[str] = []
    while len(found) < count and not reader.done:
        found.append(reader.text(reader.unpack("<H")[0]))
    return found
