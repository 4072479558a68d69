"""Zip files that come from anywhere: opened with care, read in pieces, refused with one clear sentence."""

from __future__ import annotations

import re
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, NoReturn
from xml.parsers import expat

from livesheet.diagnostics import Fault, WorkbookError, readable_name, system_reason
from livesheet.formula.book import Settings
from livesheet.said import say

if TYPE_CHECKING:
    from .repeated_rows import RepeatedRows

DAMAGED = (zipfile.BadZipFile, zlib.error, struct.error, EOFError, NotImplementedError)
"""What zipfile raises at archives that are damaged or packed in a way that it does not know."""
MAX_PARTS = 10_000
MAX_SHEETS = 10_000
MAX_SIZE = 4 << 30
"""Most bytes of all parts together, unpacked: a full sheet of a million rows takes half of it."""
MAX_RATIO = 300
"""Most bytes unpacked from one: sheets reach 100, what is packed to burst reaches 1,000."""
MAX_VALUE = 4 << 20
"""Most bytes of one tag, and most characters of one text: cells hold 32,767. The parser takes long over long tags."""
_ESCAPE = re.compile("_x([0-9A-Fa-f]{4})_")
_SMALL = 32 << 20
_PIECE = 1 << 16

_OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_OLE_HEAD = 512
_ENCRYPTED = "EncryptedPackage".encode("utf-16-le")
_KINDS = (
    (re.compile(rb"\A(?:" + re.escape(_OLE) + rb"|\x09[\x00\x02\x04\x08][\x04-\x10]\x00)"),
     say("an .xls of the old kind"), say("rename it to .xls, or save it as .xlsx")),
    (re.compile(rb"urn:oasis:names:tc:opendocument:xmlns:office"),
     say("a flat OpenDocument file (.fods), which is not read"), say("save it as .ods")),
    (re.compile(rb"urn:schemas-microsoft-com:office:spreadsheet"), say("an XML spreadsheet of 2003"),
     say("save it as .xlsx")),
    (re.compile(rb"\A\s*<(?:!doctype html|html|table)", re.IGNORECASE), say("a web page, not a workbook"),
     say("save it as .xlsx")),
    (re.compile(rb"\A%PDF"), say("a PDF, not a workbook"), ""),
)  # fmt: skip
"""What a file begins with that is no zip file, and what it is."""


def part_key(name: str) -> str:
    """What a part's name is compared by: large and small letters are the same, some programs write backslashes."""
    return name.replace("\\", "/").lstrip("/").casefold()


class Package:
    """An open zip file with its parts by name."""

    def __init__(self, file: zipfile.ZipFile, name: str) -> None:
        self._zip = file
        self.name = name
        self._parts: dict[str, zipfile.ZipInfo] = {}
        for info in file.infolist():
            if self._parts.setdefault(part_key(info.filename), info) is not info:
                # Two readers of such a file would see two workbooks.
                raise self.fault(say("two parts have this name"), info.filename[:100])

    def __contains__(self, part: str) -> bool:
        return part_key(part) in self._parts

    def close(self) -> None:
        """Let go of the file, before the block of `open_package` ends: nothing more is read from it."""
        self._zip.close()

    def fault(self, message: str, part: str = "") -> WorkbookError:
        """The error that refuses the file."""
        return WorkbookError(Fault(message, file=self.name, key=part))

    def pieces(self, part: str) -> Iterator[bytes]:
        """The bytes of a part, piece by piece."""
        info = self._parts.get(part_key(part))
        if info is None:
            raise self.fault(say("the part is missing"), part)
        if info.flag_bits & 1:
            raise self.fault(say("the part is encrypted with a password"), part)
        try:
            with self._zip.open(info) as stream:
                while piece := stream.read(_PIECE):
                    yield piece
        except (*DAMAGED, OSError) as problem:
            raise self.fault(say("the file is damaged ({problem})", problem=problem), part) from problem

    def entries(self) -> list[zipfile.ZipInfo]:
        """All entries of the zip file in the order of their data."""
        return sorted(self._zip.infolist(), key=lambda info: info.header_offset)

    @property
    def comment(self) -> bytes:
        """The comment of the zip file."""
        return self._zip.comment

    def raw(self, info: zipfile.ZipInfo) -> Iterator[bytes]:
        """An entry's header and packed data as they stand in the file, up to where the next begins."""
        file = self._zip.fp
        later = [other.header_offset for other in self._zip.infolist() if other.header_offset > info.header_offset]
        left = min([*later, self._zip.start_dir]) - info.header_offset
        if file is None or left < info.compress_size:
            raise self.fault(say("the file is damaged (parts overlap)"), info.filename)
        file.seek(info.header_offset)
        while left > 0:
            piece = file.read(min(left, _PIECE))
            if not piece:
                raise self.fault(say("the file is damaged (cut off)"), info.filename)
            left -= len(piece)
            yield piece

    def read(
        self,
        part: str,
        start: Callable[[str, dict[str, Any]], None],
        end: Callable[[str], None] | None = None,
        texts: list[str] | None = None,
    ) -> None:
        """Read a part by what is to be done where an element begins, and where it ends; `texts` gathers the text at hand."""
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartElementHandler = start
        parser.EndElementHandler = end
        if texts is not None:
            parser.CharacterDataHandler = texts.append
        self.parse(part, parser, () if texts is None else texts)

    def parse(
        self, part: str, parser: expat.XMLParserType, texts: Sequence[str] = (), rows: RepeatedRows | None = None
    ) -> None:
        """Run an XML parser over a part. Document types and entities are refused: no workbook has any.

        texts  where its handlers gather the text at hand, watched so that it cannot grow without end
        rows   takes rows out before the parser sees them
        """
        for _ in self.parsed(part, parser, texts, rows=rows):
            pass

    def parsed(
        self,
        part: str,
        parser: expat.XMLParserType,
        texts: Sequence[str] = (),
        before: Callable[[bytes], None] = lambda _: None,
        rows: RepeatedRows | None = None,
    ) -> Iterator[None]:
        """As `parse`, with a stop after the events of each piece of the part; `before` is given each piece first."""
        parser.StartDoctypeDeclHandler = self._refuse_doctype(part)
        parser.EntityDeclHandler = self._refuse_doctype(part)
        fed = 0
        try:
            for piece in self.pieces(part) if rows is None else rows.through(self.pieces(part)):
                before(piece)
                parser.Parse(piece, False)
                fed += len(piece)
                long = len(texts) > MAX_VALUE / _PIECE and sum(map(len, texts)) > MAX_VALUE
                if long or fed - parser.CurrentByteIndex > MAX_VALUE:
                    raise self.fault(
                        say("a value longer than {most} MB: this is no workbook", most=MAX_VALUE >> 20), part
                    )
                yield
            parser.Parse(b"", True)
        except expat.ExpatError as problem:
            # Where rows were taken out, the parser counts its lines and columns wrong.
            reason = expat.ErrorString(problem.code) if rows is not None and rows.taken else problem
            raise self.fault(say("the part is no proper XML ({reason})", reason=reason), part) from problem
        except (LookupError, ValueError) as problem:
            if "encoding" not in str(problem):
                raise
            raise self.fault(
                say("the part is written in an encoding that is not read ({problem})", problem=problem), part
            ) from problem

    def decoded(self, text: bytes, part: str) -> str:
        """A text that was taken from a part without its parser."""
        try:
            return text.decode()
        except UnicodeDecodeError as problem:
            raise self.fault(say("the part is no proper XML (text that is not UTF-8)"), part) from problem

    def _refuse_doctype(self, part: str) -> Callable[..., Any]:
        def refuse(*_: object) -> None:
            raise self.fault(say("the part declares a document type, which no workbook does"), part)

        return refuse


@contextmanager
def open_package(path: Path) -> Iterator[Package]:
    """Open a zip file. Raises WorkbookError when it is none, or one that would unpack beyond all measure."""
    name = readable_name(path)
    try:
        _check_head(path, name)
        with zipfile.ZipFile(path) as file:
            _check_sizes(file, name)
            yield Package(file, name)
    except DAMAGED as problem:
        raise WorkbookError(
            Fault(say("the file is damaged or cut off ({problem})", problem=problem), file=name)
        ) from problem
    except OSError as problem:
        raise unreadable(name, problem) from problem


def _check_head(path: Path, name: str) -> None:
    """Say what a file is that is no zip."""
    if path.is_dir():
        raise WorkbookError(Fault(say("this is a folder, not a workbook"), file=name))
    with path.open("rb") as stream:
        head = stream.read(1 << 16)
        if head.startswith(b"PK"):
            return
        directory = b""
        if head.startswith(_OLE) and len(head) >= _OLE_HEAD:
            # Where the names of its streams stand: a sector's size is a power of two, sectors count from behind the first.
            power, sector = int.from_bytes(head[30:32], "little"), int.from_bytes(head[48:52], "little")
            stream.seek((sector + 1) << power if power < 20 else 0)
            directory = stream.read(1 << 13)
    if head.startswith(_OLE) and _ENCRYPTED in head + directory:
        raise protected(name)
    refuse_what_it_is(head, name)


def protected(name: str, hint: str = say("save it as .xlsx without a password")) -> WorkbookError:
    """The error that refuses a workbook with a password."""
    return WorkbookError(Fault(say("the workbook is protected by a password"), file=name, hint=hint))


def unreadable(name: str, problem: OSError) -> WorkbookError:
    """The error for a file that the system does not let be read."""
    return WorkbookError(Fault(say("cannot be read: {reason}", reason=system_reason(problem)), file=name))


def refuse_what_it_is(head: bytes, name: str, missing: str = say("this is no zip file")) -> NoReturn:
    """Say what a file is, by how it begins, that is no workbook of the format expected. Raises WorkbookError."""
    for mark, message, hint in _KINDS:
        if mark.search(head):
            raise WorkbookError(Fault(message, file=name, hint=hint))
    message = say("the file is empty") if not head else say("not a workbook: {missing}", missing=missing)
    hint = "" if not head or b"\0" in head else say("a table as text (.csv)? save it as .xlsx first")
    raise WorkbookError(Fault(message, file=name, hint=hint))


def _check_sizes(file: zipfile.ZipFile, name: str) -> None:
    infos = file.infolist()
    if len(infos) > MAX_PARTS:
        raise WorkbookError(
            Fault(say("{count} parts, at most {most} are read", count=len(infos), most=MAX_PARTS), file=name)
        )
    # The reader of a part never gives more than the size declared here, so these sums hold.
    if sum(info.file_size for info in infos) > MAX_SIZE:
        raise WorkbookError(Fault(say("unpacks to more than {most} GiB", most=MAX_SIZE >> 30), file=name))
    for info in infos:
        if info.file_size > _SMALL and info.file_size > MAX_RATIO * max(info.compress_size, 1):
            message = say("packed more than {most} to 1: this is no workbook", most=MAX_RATIO)
            raise WorkbookError(Fault(message, file=name, key=info.filename))


def unescaped(text: str) -> str:
    """A text without OOXML's `_x000D_` for characters that XML cannot hold."""
    return _ESCAPE.sub(lambda match: chr(int(match[1], 16)), text) if "_x" in text else text


_PROGRAM = re.compile(rb"<(?:\w+:)?(?:generator|Application)>\s*([^<]{0,200})<")
_ABOUT = 1 << 16


def saved_by(package: Package, part: str) -> str:
    """The program that saved a file, as `part` (meta.xml, docProps/app.xml) names it; "" when it names none."""
    head = b""
    for piece in package.pieces(part) if part in package else ():
        head += piece
        if len(head) >= _ABOUT:
            break
    found = _PROGRAM.search(head)
    return found[1].decode("utf-8", "replace").strip() if found else ""


def local_name(tag: str) -> str:
    """A tag without its prefix."""
    return tag.rpartition(":")[2]


def attribute(attributes: Mapping[str, str], name: str) -> str | None:
    """An attribute by its name without prefix (`id` finds `r:id`)."""
    found = attributes.get(name)
    if found is not None:
        return found
    return next((value for key, value in attributes.items() if local_name(key) == name), None)


def relationships(package: Package, part: str) -> dict[str, tuple[str, str]]:
    """Id -> (last word of the type, the part meant) of a part's relationships; {} when it has none."""
    place = PurePosixPath(part)
    rels = str(place.parent / "_rels" / f"{place.name}.rels")
    found: dict[str, tuple[str, str]] = {}
    if rels not in package:
        return found

    def start(tag: str, attributes: dict[str, str]) -> None:
        if local_name(tag) == "Relationship" and attributes.get("TargetMode") != "External":
            kind = attributes.get("Type", "").rpartition("/")[2]
            found[attributes.get("Id", "")] = kind, _target(place, attributes.get("Target", ""))

    package.read(rels, start)
    return found


def _target(part: PurePosixPath, target: str) -> str:
    """Where a relationship of `part` leads, from the package's root."""
    if target.startswith("/"):
        return target.lstrip("/")
    steps: list[str] = []
    for step in (part.parent / target).parts:
        if step == "..":
            steps = steps[:-1]
        elif step != ".":
            steps.append(step)
    return "/".join(steps)


def settings_remarks(settings: Settings, file: str) -> list[Fault]:
    """The remarks on a file with these settings."""
    if not settings.as_shown:
        return []
    message = say("every value is rounded as it is shown (a setting of this workbook): stored values are kept")
    return [Fault(message, file, hint=say("switch “precision as displayed” off to have it computed"))]
