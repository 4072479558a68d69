"""Writes .xls files record by record, as Excel would, and as somebody would who means harm."""

from __future__ import annotations

import struct
from collections.abc import Sequence

MAGIC = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
END, FREE, TABLE = 0xFFFFFFFE, 0xFFFFFFFF, 0xFFFFFFFD


def record(kind: int, data: bytes = b"") -> bytes:
    return struct.pack("<HH", kind, len(data)) + data


def bof(sort: int, version: int = 0x0600) -> bytes:
    return record(0x0809, struct.pack("<HHHHII", version, sort, 0x0DBB, 1996, 0, 6))


EOF = record(0x000A)


def text(letters: str) -> bytes:
    """A text without its length: the mark of wide letters, and they."""
    try:
        return b"\0" + letters.encode("latin-1")
    except UnicodeEncodeError:
        return b"\1" + letters.encode("utf-16-le")


def number(row: int, col: int, value: float) -> bytes:
    return record(0x0203, struct.pack("<HHHd", row, col, 0, value))


def formula(row: int, col: int, tokens: bytes, value: float = 0.0, extra: bytes = b"") -> bytes:
    head = struct.pack("<HHHdHIH", row, col, 0, value, 0, 0, len(tokens))
    return record(0x0006, head + tokens + extra)


def shared(top: int, bottom: int, left: int, right: int, tokens: bytes) -> bytes:
    return record(0x04BC, struct.pack("<HHBBHH", top, bottom, left, right, bottom - top + 1, len(tokens)) + tokens)


def array(top: int, bottom: int, left: int, right: int, tokens: bytes, extra: bytes = b"") -> bytes:
    return record(0x0221, struct.pack("<HHBBHIH", top, bottom, left, right, 0, 0, len(tokens)) + tokens + extra)


def member(row: int, col: int) -> bytes:
    """The tokens of a cell whose formula stands with another one."""
    return b"\x01" + struct.pack("<HH", row, col)


def cell(row: int, col: int, token: int = 0x44, rows: bool = True, columns: bool = True) -> bytes:
    """A reference; `rows`, `columns`: relative ones."""
    return bytes([token]) + struct.pack("<HH", row & 0xFFFF, (col & 0xFF) | rows << 15 | columns << 14)


def name(letters: str, tokens: bytes, sheet: int = 0, about: int = 0) -> bytes:
    head = struct.pack("<HBBHHHI", about, 0, len(letters), len(tokens), 0, sheet, 0)
    return record(0x0018, head + text(letters) + tokens)


def stream(*sheets: tuple[str, bytes], before: bytes = b"", at: Sequence[int] = (), version: int = 0x0600) -> bytes:
    """The stream of a workbook: (title, records of cells) of each sheet. `at`: other places for the sheets than theirs."""
    entries = [(title, record(0x0085, bytes(6) + bytes([len(title)]) + text(title))) for title, _ in sheets]
    head = bof(0x0005, version) + before
    size = len(head) + sum(len(entry) for _, entry in entries) + len(EOF)
    parts, places = [], []
    for number, (_, cells) in enumerate(sheets):
        places.append(at[number] if number < len(at) else size)
        parts.append(bof(0x0010) + cells + EOF)
        size += len(parts[-1])
    bound = b"".join(
        entry[:4] + struct.pack("<I", place) + entry[8:] for (_, entry), place in zip(entries, places, strict=True)
    )
    return head + bound + EOF + b"".join(parts)


def compound(
    data: bytes,
    title: str = "Workbook",
    links: dict[int, int] | None = None,
    size: int | None = None,
    small: bool = False,
) -> bytes:
    """A compound file with one stream in sectors of 512 bytes: tables, directory, stream.

    links  sectors chained otherwise;  small  the stream lies in sectors of 64 bytes inside the root's
    """
    count = -(-len(data) // 512)
    table = [TABLE, END, END, *range(4, count + 3), END][: count + 3]
    for sector, following in (links or {}).items():
        table[sector] = following
    table += [FREE] * (128 - len(table))
    minis = -(-len(data) // 64)
    mini_table = [*range(1, minis), END] + [FREE] * (128 - minis) if small else [FREE] * 128
    said = len(data) if size is None else size
    root = entry("Root Entry", 5, 3, 64 * minis) if small else entry("Root Entry", 5, END, 0)
    entries = root + entry(title, 2, 0 if small else 3, said)
    head = MAGIC + bytes(16) + struct.pack("<HHHHH6x", 0x3E, 3, 0xFFFE, 9, 6)
    head += struct.pack("<10I", 0, 1, 1, 0, 4096 if small else 0, 2, 1, END, 0, 0) + struct.pack("<108I", *[FREE] * 108)
    tables = struct.pack("<128I", *table), entries.ljust(512, b"\0"), struct.pack("<128I", *mini_table)
    return head + b"".join(tables) + data.ljust(512 * count, b"\0")


def entry(title: str, kind: int, first: int, size: int) -> bytes:
    letters = title.encode("utf-16-le") + b"\0\0"
    head = letters.ljust(64, b"\0") + struct.pack("<HBBIII", len(letters), kind, 1, FREE, FREE, FREE)
    return head + bytes(36) + struct.pack("<III", first, size, 0)
