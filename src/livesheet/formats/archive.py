"""Zip files that come out the same on every machine, and the seal of a workbook by which one that was saved anew is known.

The seal is a digest of all other parts, among the file's properties: whoever saves it writes other parts.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from copy import copy
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, TextIO

from livesheet.replacing import replacing

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer


import re

from .reading.package import DAMAGED

FIXED_TIME = datetime(2000, 1, 1, tzinfo=UTC)
"""The time that every document says it was made at: a clock would make equal documents unequal."""

_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_UNIX = 3
_LARGE = 1 << 30
"""From this size on a part gets a header that has room for more than 4 GiB."""
_SMALL = 4 << 20
"""Parts of so many bytes are packed as tightly as zlib can: hundredths of a second more."""


class Archive:
    """A zip file being written: parts in the order they are added, with fixed times and rights."""

    def __init__(self, file: BinaryIO) -> None:
        self._zip = zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED)

    def text(self, name: str) -> TextIO:
        """A stream for a part of UTF-8 text; one may be open at a time, closing it ends the part."""
        return io.TextIOWrapper(io.BufferedWriter(_Part(self, name)), encoding="utf-8", newline="\n")

    def stored(self, name: str, text: str) -> None:
        """A part that is not compressed (the `mimetype` of an OpenDocument file must not be)."""
        self._zip.writestr(_entry(name, zipfile.ZIP_STORED), text.encode())

    def copied(self, entry: zipfile.ZipInfo, pieces: Iterable[bytes]) -> None:
        """A part exactly as it stands in another archive: `pieces` are its header there and what follows."""
        file = self._zip.fp
        if file is None:
            raise ValueError("the archive is closed")
        entry = copy(entry)
        entry.header_offset = self._zip.start_dir
        file.seek(entry.header_offset)
        for piece in pieces:
            file.write(piece)
        # What `ZipFile.open` keeps up to date for the parts that it writes itself.
        self._zip.start_dir = file.tell()
        self._zip.filelist.append(entry)
        self._zip.NameToInfo[entry.filename] = entry

    def rewritten(self, entry: zipfile.ZipInfo, pieces: Iterable[bytes]) -> None:
        """A part of another archive with other content, and all else about it as it was."""
        entry = copy(entry)
        with self._zip.open(entry, "w", force_zip64=entry.file_size > _LARGE) as part:
            for piece in pieces:
                part.write(piece)

    @property
    def open(self) -> bool:
        """Whether parts may still be added."""
        return self._zip.fp is not None

    def comment(self, text: bytes) -> None:
        """The comment of the archive as a whole."""
        self._zip.comment = text

    def contents(self) -> str:
        """A digest of the parts written so far: their names, sizes and checksums."""
        return contents_of(self._zip.filelist)

    def close(self) -> None:
        """Write the directory of the archive."""
        self._zip.close()

    def abandon(self) -> None:
        """Let go of the file without writing to it again (zipfile would when it is collected, into a closed file)."""
        self._zip.fp = None


class _Part(io.RawIOBase):
    """A part being written, compressed by what suits its size, which zipfile does not let a writer choose.

    A large part is a table of numbers: among their digits short repetitions are not worth a reference, which Z_FILTERED
    knows.
    """

    def __init__(self, archive: Archive, name: str) -> None:
        super().__init__()
        self._archive = archive
        self._entry = _entry(name, zipfile.ZIP_DEFLATED)
        self._first: list[bytes] = []
        """What came before it was known whether the part is small."""
        self._packed: list[bytes] = []
        self._compressor: zlib._Compress | None = None

    def writable(self) -> bool:
        return True

    def write(self, data: ReadableBuffer) -> int:
        """Take bytes; how many."""
        content = bytes(data)
        self._entry.CRC = zlib.crc32(content, self._entry.CRC)
        self._entry.file_size += len(content)
        if self._compressor is None:
            self._first.append(content)
            if self._entry.file_size > _SMALL:
                self._start(_compressor(zlib.Z_DEFAULT_COMPRESSION, zlib.Z_FILTERED))
        else:
            self._packed.append(self._compressor.compress(content))
        return len(content)

    def _start(self, compressor: zlib._Compress) -> zlib._Compress:
        self._compressor = compressor
        self._packed = [compressor.compress(content) for content in self._first]
        self._first = []
        return compressor

    def close(self) -> None:
        """The part joins its archive, unless that was abandoned."""
        if not self.closed and self._archive.open:
            compressor = self._compressor or self._start(_compressor(zlib.Z_BEST_COMPRESSION, zlib.Z_DEFAULT_STRATEGY))
            self._packed.append(compressor.flush())
            self._entry.compress_size = sum(map(len, self._packed))
            self._archive.copied(self._entry, [self._entry.FileHeader(), *self._packed])
        super().close()


def _compressor(level: int, strategy: int) -> zlib._Compress:
    """Of bare deflate, as zip files hold it."""
    return zlib.compressobj(level, zlib.DEFLATED, -zlib.MAX_WBITS, zlib.DEF_MEM_LEVEL, strategy)


def contents_of(entries: Iterable[zipfile.ZipInfo]) -> str:
    """A digest of the parts of an archive, in any order: their names, sizes and checksums.

    A checksum of 32 bits is enough: it is to tell a file that was saved anew, not one that was forged.
    """
    parts = sorted(f"{entry.CRC:08x} {entry.file_size} {entry.filename}" for entry in entries)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:32]


def _entry(name: str, method: int) -> zipfile.ZipInfo:
    entry = zipfile.ZipInfo(name, _ZIP_TIME)
    entry.compress_type = method
    entry.create_system = _UNIX  # zipfile writes the system it runs on
    entry.external_attr = 0o644 << 16
    entry.CRC = entry.compress_size = entry.file_size = 0
    return entry


@contextmanager
def new_archive(path: Path) -> Iterator[Archive]:
    """An archive that becomes the file `path` when the block ends well.

    Raises OutputError when it cannot be written; whatever goes wrong, an old file at `path` stays as it was.
    """
    with replacing(path) as file:
        archive = Archive(file)
        try:
            yield archive
            archive.close()
        finally:
            archive.abandon()


PROPERTIES = ("docProps/core.xml", "meta.xml")
"""Where the properties of an .xlsx and of an .ods stand; this part is written last and is not under the seal."""

_SEAL = re.compile(rb"[A-Za-z]+:([0-9a-f]{32})")
_MOST = 1 << 20
"""Properties are small; a larger part of that name is something else."""


def seal(author: str, contents: str) -> str:
    """The seal as the properties hold it: the program that wrote the file, and the digest of all other parts."""
    return f"{author}:{contents}"


def is_untouched(path: Path) -> bool:
    """Whether a file is a workbook exactly as it was written, by this or another version.

    False for everything else: saved by a spreadsheet program, recalculated with other values, not a workbook. Raises
    OSError when it cannot be read.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            entries = archive.infolist()
            holders = [entry for entry in entries if entry.filename in PROPERTIES]
            if len(holders) != 1 or holders[0].file_size > _MOST:
                return False
            found = _SEAL.findall(archive.read(holders[0]))
    except (*DAMAGED, RuntimeError, ValueError):  # the last two: a password, a name that is no text
        return False
    others = contents_of(entry for entry in entries if entry is not holders[0])
    return found[-1:] == [others.encode()]
