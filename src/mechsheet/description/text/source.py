"""The text of a description: read from disk, parsed, and able to say where each key stands."""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from livesheet.diagnostics import Fault, readable_name
from livesheet.said import say
from mechsheet.description.text.index import BARE_KEY, Path, Spot, index
from mechsheet.diagnostics import DescriptionError, printable

if TYPE_CHECKING:
    from mechsheet.description.text.typed import Mistake

MAX_BYTES = 1_000_000
"""A description is written by hand; a larger file is something else."""

MOST_SHOWN = 160
"""Characters of a line, or of a key, that a message shows."""

MOST_TOLD = 100
"""Typing mistakes that are told of one text; with more it is something else than a description."""

_POSITION = re.compile(r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)$")
_PLAINER = {
    r"illegal character '\n'": say("the line ends inside a text"),
    "expected newline or end of document after a statement": say("the line goes on behind its value"),
    "expected '=' after a key in a key/value pair": say("a line is a [heading] or key = value"),
    "invalid statement": say("a line is a [heading] or key = value"),
    "cannot overwrite a value": say("this key is there already"),
}
_TWICE = re.compile(r"Cannot declare \((.*)\) twice")
_NAMED = r"'([^']*)'"
_DRIVER_AGAIN = re.compile(r"\s*\[\[?\s*driver\s*\]")
_HINTS = {
    r"illegal character '\n'": say("a quotation mark is missing"),
    "invalid value": say("texts and expressions stand in quotes"),
    "unclosed array": say('the list is not closed: write "]"'),
    "expected ']' at the end of a table declaration": say('the heading is not closed: write "]"'),
}
"""By what the standard reader says, in small letters."""


@dataclass(frozen=True, slots=True)
class Source:
    """A description as text, as TOML data, and as an index of places. Line ends are `\\n`, a byte-order mark is gone."""

    text: str
    file: str
    data: dict[str, Any]
    spots: Mapping[Path, Spot]
    lines: tuple[str, ...] = field(repr=False)

    def fault(self, path: Path, message: str, hint: str = "") -> Fault:
        """A fault at `path`, or at the nearest table around it when the key itself is not written."""
        place = path
        while place and place not in self.spots:
            place = place[:-1]
        line = self.spots[place].line if place else None
        shown = _shortened(self.lines[line - 1]) if line else ""
        return Fault(message, self.file, line, dotted(path), shown, hint)


def dotted(path: Path) -> str:
    """`joints[2].on`: list elements count from 1 here, as people count."""
    text = ""
    for key in path:
        if isinstance(key, int):
            text += f"[{key + 1}]"
        else:
            text += ("." if text else "") + (key if BARE_KEY.fullmatch(key) else f'"{_shortened(printable(key))}"')
    return text


def _shortened(text: str) -> str:
    return printable(text.expandtabs(4)) if len(text) <= MOST_SHOWN else printable(text[: MOST_SHOWN - 1]) + "…"


def read_text(path: str | FilePath) -> str:
    """The text of a file. Raises DescriptionError when it is missing, a directory, too large, or not UTF-8 text."""
    name = readable_name(path)
    try:
        with FilePath(path).open("rb") as file:
            content = file.read(MAX_BYTES + 1)
    except FileNotFoundError:
        twice = FilePath(f"{path}.txt")
        hint = say("there is {file}: Notepad has added .txt; rename it", file=readable_name(twice))
        raise _refusal(name, say("there is no such file"), hint if twice.is_file() else "") from None
    except IsADirectoryError:
        raise _refusal(name, say("this is a directory; name a description, a .toml file")) from None
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        if FilePath(path).is_dir():  # Windows answers "permission denied" for a directory
            raise _refusal(name, say("this is a directory; name a description, a .toml file")) from None
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise _refusal(name, say("cannot be read: {reason}", reason=reason)) from None
    return text_of(content, name)


def text_of(content: bytes, name: str) -> str:
    """The text of a file's first MAX_BYTES + 1 bytes; `name` is what messages call it. Raises DescriptionError."""
    if len(content) > MAX_BYTES:
        raise _refusal(name, say("larger than {most:,} bytes: this is no description", most=MAX_BYTES))
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise _refusal(
            name,
            say('saved as UTF-16 (some editors call it "Unicode")'),
            say('save the file with the encoding "UTF-8"'),
        )
    if b"\0" in content:
        hint = (
            say("a workbook carries its description inside; name the .toml file here") if content[:2] == b"PK" else ""
        )
        raise _refusal(name, say("a binary file, not a description (TOML text)"), hint)
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        message = say("not UTF-8 text: byte {byte:#04x} fits nowhere", byte=content[error.start])
        raise _refusal(name, message, say('save the file with the encoding "UTF-8"'), line) from None


def parse(text: str, file: str) -> Source:
    """The source of a TOML text. Raises DescriptionError when it is empty, too large, or broken TOML.

    The whole text is brought into Unicode's normal form C first, so that a name typed with combining marks in one
    place and with composed letters in another is one name.
    """
    source, faults = parse_as_meant(text, file)
    if faults:
        raise DescriptionError(faults)
    return source


def parse_as_meant(text: str, file: str) -> tuple[Source, list[Fault]]:
    """The same of a text with typing mistakes: decimal commas, a word processor's quotation marks, keys without quotes …

    The source is that of the text as it is meant, with the lines as they are; and what is wrong with them. Raises
    DescriptionError where nobody can say what is meant.
    """
    if len(text) > MAX_BYTES:
        raise _refusal(file, say("larger than {most:,} characters: this is no description", most=MAX_BYTES))
    text = unicodedata.normalize("NFC", text.removeprefix("\ufeff").replace("\r\n", "\n"))
    if not text.strip():
        raise _refusal(file, say("the description is empty"), say('begin with "mechsheet new"'))
    lines = tuple(text.split("\n"))
    try:
        text.encode("utf-8")
        return Source(text, file, _data(text, file), index(text), lines), []
    except UnicodeEncodeError as error:
        raise _refusal(file, say("not Unicode text"), "", text.count("\n", 0, error.start) + 1) from None
    except tomllib.TOMLDecodeError:
        from mechsheet.description.text.typed import mended

        meant = mended(text)
    faults = [_mistake(one, text, file, lines) for one in meant.mistakes[:MOST_TOLD]]
    try:
        return Source(meant.text, file, _data(meant.text, file), index(meant.text), lines), faults
    except tomllib.TOMLDecodeError as error:
        left = _broken(str(error), file, lines, meant.keys)
        told = any(fault.line == left.line for fault in faults)
        raise DescriptionError(faults if told else [*faults, left]) from None


def _data(text: str, file: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except RecursionError:
        raise _refusal(file, say("lists or tables stand too deep inside one another")) from None
    except ValueError:  # Python refuses to convert whole numbers of thousands of digits
        raise _refusal(file, say("a number has too many digits")) from None


def _mistake(mistake: Mistake, text: str, file: str, lines: tuple[str, ...]) -> Fault:
    line = text.count("\n", 0, mistake.offset) + 1
    return Fault(mistake.message, file, line, dotted(mistake.path), _shortened(lines[line - 1]), mistake.hint)


def _broken(reason: str, file: str, lines: tuple[str, ...], keys: tuple[Path, ...]) -> Fault:
    found = _POSITION.search(reason)
    reason = _POSITION.sub("", reason)
    line, column = None, ""
    if found and found[1]:
        line, column = int(found[1]), say(" (column {column})", column=found[2])
    elif found:
        line = len(lines)
        while line > 1 and not lines[line - 1].strip():
            line -= 1
    shown = lines[line - 1] if line else ""
    hint = _HINTS.get(reason.lower(), "")
    if _DRIVER_AGAIN.match(shown):
        hint = say("write [driver] once; what is driven besides stands under [[drivers]]")
    plain: str = _PLAINER.get(reason.lower(), say("")) or printable(reason[:1].lower() + reason[1:])
    if twice := _TWICE.fullmatch(reason):
        heading = printable(".".join(re.findall(_NAMED, twice[1])))
        plain = say("the heading [{heading}] is there already", heading=heading)
    key = dotted(keys[line - 1]) if line and line <= len(keys) else ""
    return Fault(
        say("broken TOML: {reason}{column}", reason=plain, column=column),
        file,
        line,
        key,
        _shortened(shown),
        hint,
    )


def _refusal(file: str, message: str, hint: str = "", line: int | None = None) -> DescriptionError:
    return DescriptionError(Fault(message, file, line, hint=hint))
