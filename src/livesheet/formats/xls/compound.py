"""The container of an .xls: a compound file, whose streams are chains of sectors. Source: Microsoft, [MS-CFB].

Only what a workbook needs is read, and nothing is followed that the file can bend into a circle: streams are found in the
list of the directory, not in its tree, and a chain that comes back to one of its sectors is refused.
"""

from __future__ import annotations

import struct

from livesheet.diagnostics import Fault, WorkbookError
from livesheet.said import say

SIGNATURE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_LAST = 0xFFFFFFFA
"""Sector numbers from here on are no sectors: the end of a chain, a free sector, a table's own."""
_HEAD_TABLES = 109
_ENTRY = 128
_MINI = 64
_STREAM, _ROOT = 2, 5


class Compound:
    """A compound file in memory. Raises WorkbookError, from anything, where it is not whole."""

    def __init__(self, data: bytes, name: str) -> None:
        self._data, self._name = data, name
        if len(data) < 512:
            raise self.damaged(say("its head is cut off"))
        power, mini_power = struct.unpack_from("<HH", data, 30)
        if power not in (9, 12) or mini_power != 6:
            raise self.damaged(say("sectors of no known size"))
        self._size = 1 << power
        (first, _, self._cutoff, mini_table, _, more_tables, _) = struct.unpack_from("<7I", data, 48)
        self._table = self._sector_table(more_tables)
        self._entries = self._directory(first)
        root = next((entry for entry in self._entries if entry[1] == _ROOT), None)
        self._mini_table = self._numbers(self._chain(mini_table))
        self._mini = b"" if root is None else b"".join(map(self._sector, self._chain(root[2])))[: root[3]]

    def damaged(self, why: str) -> WorkbookError:
        """The error that refuses the file."""
        return WorkbookError(Fault(say("the file is damaged or cut off ({why})", why=why), file=self._name))

    def __contains__(self, stream: str) -> bool:
        return any(name.casefold() == stream.casefold() for name, *_ in self._entries)

    def stream(self, name: str) -> bytes | None:
        """The bytes of a stream, None where there is none of that name."""
        for found, kind, first, size in self._entries:
            if kind == _STREAM and found.casefold() == name.casefold():
                data = self._small(first) if size < self._cutoff else b"".join(map(self._sector, self._chain(first)))
                if len(data) < size:
                    raise self.damaged(say("the stream {name} is shorter than it says", name=name))
                return data[:size]
        return None

    def _sector(self, number: int) -> bytes:
        start = (number + 1) * self._size
        data = self._data[start : start + self._size]
        if not data:
            raise self.damaged(say("a sector that is not there"))
        return data

    def _sector_table(self, more: int) -> list[int]:
        """Which sector follows which."""
        numbers = list(struct.unpack_from(f"<{_HEAD_TABLES}I", self._data, 76))
        seen: set[int] = set()
        while more < _LAST:
            if more in seen:
                raise self.damaged(say("its list of tables runs in a circle"))
            seen.add(more)
            *found, more = self._numbers([more])
            numbers += found
        tables = [number for number in numbers if number < _LAST]
        if len(set(tables)) < len(tables):
            raise self.damaged(say("a table that is named twice"))
        return self._numbers(tables)

    def _numbers(self, sectors: list[int]) -> list[int]:
        found: list[int] = []
        for sector in sectors:
            data = self._sector(sector)
            found += struct.unpack(f"<{len(data) // 4}I", data[: len(data) // 4 * 4])
        return found

    def _chain(self, first: int) -> list[int]:
        return self._followed(first, self._table)

    def _followed(self, number: int, table: list[int]) -> list[int]:
        found: list[int] = []
        seen = bytearray(len(table))
        while number < _LAST:
            if number >= len(table):
                raise self.damaged(say("a sector that is not there"))
            if seen[number]:
                raise self.damaged(say("a stream that runs in a circle"))
            seen[number] = 1
            found.append(number)
            number = table[number]
        return found

    def _small(self, first: int) -> bytes:
        """A stream below the cutoff lies in small sectors inside of the root's own stream."""
        parts = self._followed(first, self._mini_table)
        return b"".join(self._mini[number * _MINI : (number + 1) * _MINI] for number in parts)

    def _directory(self, first: int) -> list[tuple[str, int, int, int]]:
        """(name, kind, first sector, bytes) of every entry."""
        data = b"".join(map(self._sector, self._chain(first)))
        found = []
        for at in range(0, len(data) - _ENTRY + 1, _ENTRY):
            length, kind = struct.unpack_from("<HB", data, at + 64)
            start, size = struct.unpack_from("<II", data, at + 116)
            name = data[at : at + max(0, min(length, 64) - 2)].decode("utf-16-le", "replace")
            if kind:
                found.append((name, kind, start, size))
        return found
