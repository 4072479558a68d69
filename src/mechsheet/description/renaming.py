"""A point or a link gets another name, wherever a description names it: comments, numbers and all else stay as they are.

What a key or a text is the name of, the schema says. In expressions a point stands before a dot: `B.x`, `C.vx`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, Literal, TypeAlias

from mechsheet.description.grammar import Either, Items, Kinds, Named, Quantity, Shape, Table, Text, Words
from mechsheet.description.schema import DESCRIPTION
from mechsheet.description.text.index import Path, key_text, written_keys
from mechsheet.description.text.source import Source, parse

ALSO_WORDS = ("A", "I", "O")

Renamed: TypeAlias = Literal["point", "link"]


def renamed(source: Source, kind: Renamed, old: str, new: str) -> Source:
    """The source with `new` in place of `old`. Whether the new name may be one is the reader's to tell."""
    changes = [*_in_keys(source, kind, old, new), *_in_values(source, kind, old, new)]
    text = source.text
    for start, end, words in sorted(changes, reverse=True):
        text = text[:start] + words + text[end:]
    return parse(text, source.file)


Change: TypeAlias = tuple[int, int, str]
"""Between two offsets stands another text."""


def _in_keys(source: Source, kind: Renamed, old: str, new: str) -> Iterator[Change]:
    for path, start, end in written_keys(source.text):
        key = str(path[-1])
        for around in _shapes(DESCRIPTION, path[:-1]):
            if not isinstance(around, Named) or key in around.keys:
                continue
            if key == old and kind in around.what.split(" "):
                yield start, end, key_text(new)
            elif kind == "point" and key.startswith(f"{old}."):
                yield start, end, key_text(new + key[len(old) :])


def _in_values(source: Source, kind: Renamed, old: str, new: str) -> Iterator[Change]:
    points = [point for link in source.data.get("links", {}).values() for point in link.get("points", {})]
    for path, text in _texts(source.data, ()):
        spot = source.spots[path]
        written = source.text[spot.start : spot.end]
        changed = written
        for shape in _shapes(DESCRIPTION, path):
            match shape:
                case Text(names=names) if names == kind:
                    if text == old:
                        changed = f'"{new}"'
                case Words() if kind == "point" and ("label" in path or path[0] == "charts"):
                    changed = _in_label(written, old, new, points)
                case Text() | Quantity():
                    changed = _in_expression(changed, kind, old, new)
        if changed != written:
            yield spot.start, spot.end, changed


def _in_expression(written: str, kind: Renamed, old: str, new: str) -> str:
    """A point before a dot; a link in a condition of a study, `crank(rocker)`."""
    name = re.escape(old)
    pattern = rf"(?<![\w.]){name}(?=\.[a-z])" if kind == "point" else rf"(?<=\bcrank\(){name}(?=\))"
    return re.sub(pattern, new, written)


def _in_label(written: str, old: str, new: str, points: list[str]) -> str:
    """Words made of points' names, as textbooks call lengths, angles and curves: `crank A0A`, `curve of C`. What is a word
    of the language as well stays."""
    name = "|".join(re.escape(point) for point in sorted(set(points), key=len, reverse=True))

    def changed(found: re.Match[str]) -> str:
        if found[0] in ALSO_WORDS:
            return found[0]
        parts = re.findall(name, found[0])
        return "".join(new if part == old else part for part in parts)

    return re.sub(rf"(?<!\w)(?:{name})+(?!\w)", changed, written)


def _texts(data: Any, path: Path) -> Iterator[tuple[Path, str]]:
    """Every text of the data, and where it stands."""
    if isinstance(data, str):
        yield path, data
    for key, value in data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ():
        yield from _texts(value, (*path, key))


def _shapes(shape: Shape, path: Path) -> Iterator[Shape]:
    """What may stand at a path: several where the kind of a table, or of a value, decides."""
    match shape:
        case Either(shapes):
            for each in shapes:
                yield from _shapes(each, path)
            return
        case Kinds(_, tables):
            for table in tables.values():
                yield from _shapes(table, path)
            return
    if not path or isinstance(shape, Words):  # words may be a table of two languages
        yield shape
        return
    key, *rest = path
    match shape:
        case Table(keys) if key in keys:
            yield from _shapes(keys[str(key)].shape, tuple(rest))
        case Named(item, keys=keys):
            yield from _shapes(keys[str(key)].shape if key in keys else item, tuple(rest))
        case Items(item):
            yield from _shapes(item, tuple(rest))
