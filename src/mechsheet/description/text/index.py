"""Where each key of a TOML text stands: the standard reader gives values without lines.

The text has already been read by `tomllib`, so this walk only finds its way through correct TOML and never judges it.
"""

from __future__ import annotations

import bisect
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

Path: TypeAlias = tuple[str | int, ...]
"""Keys from the root; an int counts from 0 through a list or an array of tables."""


@dataclass(frozen=True, slots=True)
class Spot:
    """Where a key, a table or an element of a list stands.

    line        1-based line of its name (of the value itself for an element of a list)
    start, end  offsets of its value in the text; for a table with a header, `end` is where that line ends
    how         "value"; or for tables "header", "inline", or "implied" (made by the dotted key of another)
    """

    line: int
    start: int
    end: int
    how: Literal["value", "header", "inline", "implied"]


_SKIP = re.compile(r"(?:[ \t\n]|\#[^\n]*)*")
BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
"""A key that stands without quotes."""

_SCALAR = re.compile(r"[^,\]}\#\n]+")
_STRING = re.compile(
    r'"""(?:[^\\]|\\.)*?"{3,5}'
    r"|'''.*?'{3,5}"
    r'|"(?:[^"\\\n]|\\.)*"'
    r"|'[^'\n]*'",
    re.DOTALL,
)


def key_text(name: str) -> str:
    """A key as TOML spells it, in quotes where it needs them."""
    return name if BARE_KEY.fullmatch(name) else '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'


def line_end(text: str, at: int) -> int:
    """Where the line ends in which an offset stands."""
    end = text.find("\n", at)
    return len(text) if end < 0 else end


def index(text: str) -> Mapping[Path, Spot]:
    """The place of every key, table and list element of `text`, which must be valid TOML with `\\n` line ends."""
    return _Walk(text).run()


def written_keys(text: str) -> list[tuple[Path, int, int]]:
    """Every key that is written in a text, in headings too: its path, and the offsets between which it stands."""
    walk = _Walk(text)
    walk.run()
    return walk.written


class _Walk:
    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.breaks = [found.start() for found in re.finditer("\n", text)]
        self.spots: dict[Path, Spot] = {}
        self.counts: dict[Path, int] = {}  # arrays of tables: elements so far
        self.written: list[tuple[Path, int, int]] = []

    def run(self) -> Mapping[Path, Spot]:
        table: Path = ()
        self.skip()
        while self.at < len(self.text):
            if self.text[self.at] == "[":
                table = self.header()
            else:
                self.pair(table)
            self.skip()
        return self.spots

    def skip(self) -> None:
        """On past spaces, line ends and comments."""
        found = _SKIP.match(self.text, self.at)
        self.at = found.end() if found else self.at

    def line(self, offset: int) -> int:
        return bisect.bisect_left(self.breaks, offset) + 1

    def header(self) -> Path:
        begin, array = self.at, self.text.startswith("[[", self.at)
        self.at += 1 + array
        keys = self.keys()
        self.at += 1 + array
        path: Path = ()
        for place, (key, start, end) in enumerate(keys):
            path = (*path, key)
            self.written.append((path, start, end))
            last = place == len(keys) - 1
            if last and array:
                self.note(path, begin, "header")
                self.counts[path] = self.counts.get(path, 0) + 1
            if path in self.counts:
                path = (*path, self.counts[path] - 1)
            self.note(path, begin, "header" if last else "implied")
        return path

    def note(self, path: Path, begin: int, how: Literal["header", "implied"]) -> None:
        """A table's own header wins over the mention that a deeper header made of it."""
        if path not in self.spots or (how == "header" and self.spots[path].how == "implied"):
            self.spots[path] = Spot(self.line(begin), begin, line_end(self.text, self.at), how)

    def pair(self, table: Path) -> None:
        begin = self.at
        path = table
        keys = self.keys()
        self.at += 1  # the equals sign
        for place, (key, start, end) in enumerate(keys):
            path = (*path, key)
            self.written.append((path, start, end))
            if place < len(keys) - 1:
                self.note(path, begin, "implied")
        self.value(path, begin)

    def keys(self) -> list[tuple[str, int, int]]:
        """A dotted key, up to the sign behind it: its words, and where each begins and ends."""
        found = []
        while True:
            self.skip()
            match = BARE_KEY.match(self.text, self.at) or _STRING.match(self.text, self.at)
            if match is None:
                raise AssertionError(f"no key at offset {self.at}")
            word = match.group()
            key = next(iter(tomllib.loads(f"{word} = 0"))) if word[0] in "\"'" else word
            found.append((key, match.start(), match.end()))
            self.at = match.end()
            self.skip()
            if self.text[self.at] != ".":
                return found
            self.at += 1

    def value(self, path: Path, begin: int) -> None:
        self.skip()
        start, sign = self.at, self.text[self.at]
        if sign == "[":
            self.elements(path)
        elif sign == "{":
            self.inline(path)
        else:
            match = _STRING.match(self.text, start) or _SCALAR.match(self.text, start)
            self.at = match.end() if match else start + 1
        end = start + len(self.text[start : self.at].rstrip())
        self.spots[path] = Spot(self.line(begin), start, end, "inline" if sign == "{" else "value")

    def elements(self, path: Path) -> None:
        self.at += 1
        count = 0
        self.skip()
        while self.text[self.at] != "]":
            self.value((*path, count), self.at)
            count += 1
            self.comma()
        self.at += 1

    def inline(self, path: Path) -> None:
        self.at += 1
        self.skip()
        while self.text[self.at] != "}":
            self.pair(path)
            self.comma()
        self.at += 1

    def comma(self) -> None:
        self.skip()
        if self.text[self.at] == ",":
            self.at += 1
            self.skip()
