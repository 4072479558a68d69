"""Changing a description's text in place: single values, whole tables, names of points and links; all else stays as it is.

By the offsets that `index` keeps anyway: messages name the line of each key. A new table goes behind the last of its kind
([links.rocker] behind [links.coupler]), else where the manual's order has it. What a key or a text is the name of, the
schema says; in expressions a point stands before a dot: `B.x`, `C.vx`.

What a description said before options changed it (a length, the rows, bands), or what its sketch shows (a redundant link,
the turn of a phase), travels in its text as a comment (`with_origin`): who asks later whether the file was changed since the
workbook was built must not take that for a change of the file.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Iterator, Sequence
from typing import Any, Literal, TypeAlias

from livesheet.said import say
from mechsheet.description.grammar import Either, Items, Kinds, Named, Quantity, Shape, Table, Text, Words
from mechsheet.description.schema import DESCRIPTION
from mechsheet.description.text.index import Path, Spot, key_text, line_end, written_keys
from mechsheet.description.text.numbers import home, measured
from mechsheet.description.text.source import Source, parse
from mechsheet.diagnostics import DescriptionError

SPEEDS = (("driver", "speed"), ("driver", "acceleration"))
OWN_CELLS = ("deg/s", "rpm", "deg/s^2", "rpm/s")
"""Units in which a speed or an acceleration of the driver has a cell of its own, beside the one in rad/s."""

_KEY_BEFORE = re.compile(r"""(?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*')\s*=\s*$""")


def number_text(value: float, old: str = "") -> str:
    """A number as TOML, with the fewest digits that read back as it: 35, or 35.0 where a number with a point stood."""
    if not math.isfinite(value):
        raise ValueError(f"{value} is no number of a description")
    pointed = re.fullmatch(r"[+-]?[0-9_]+\.[0-9_]+", old.strip()) is not None
    if value == int(value) and abs(value) < 1e15 and not pointed:
        return str(int(value))
    return repr(float(value))


def with_number(source: Source, path: Path, value: float) -> Source:
    """The source with a number at `path`, spelled as the one that stands there, or as a new key of the table around it.

    Where a table stands with a `value`, that is the number.
    """
    if (*path, "value") in source.spots:
        path = (*path, "value")
    spot = source.spots.get(path)
    return with_value(source, path, number_text(value, source.text[spot.start : spot.end] if spot else ""))


def with_value(source: Source, path: Path, value: str) -> Source:
    """The source with `value`, a text in TOML, at `path`: in place of what stands there, or as a new key.

    A plain number above a new key becomes a table with `value`.
    """
    if spot := source.spots.get(path):
        return _replaced(source, spot.start, spot.end, _with_its_unit(source, path, spot, value))
    *around, key = path
    table = source.spots.get(tuple(around))
    line = f"{key_text(str(key))} = {value}"
    if table is None:
        return _with_header(source, around, line)
    if table.how == "header":
        return _replaced(source, table.end, table.end, f"\n{line}")
    if table.how == "inline":
        return _replaced(source, *_inline_end(source.text, table, line))
    if table.how == "value":
        old = source.text[table.start : table.end]
        return _replaced(source, table.start, table.end, f"{{ value = {old}, {line} }}")
    return _beside(source, tuple(around), line)


def _with_header(source: Source, around: Sequence[str | int], line: str) -> Source:
    """A table of its own, below all others, with its first key."""
    head = ".".join(key_text(str(part)) for part in around)
    return parse(f"{source.text.rstrip(chr(10))}\n\n[{head}]\n{line}\n", source.file)


def _with_its_unit(source: Source, path: Path, spot: Spot, value: str) -> str:
    """A number in the place of one with its unit ("2 kN"): it is in the unit of the cell, which has to be written where
    the place does not say it.
    """
    old = measured(source.text[spot.start + 1 : spot.end - 1])
    if old is None or source.text[spot.start] not in "\"'" or value[:1] in "\"'{[":
        return value
    if path[0] == "dimensions":
        head = source.data.get("mechanism")
        length = str(head.get("length_unit", "mm")) if isinstance(head, dict) else "mm"
        at_home = home(old, length)
        return value if at_home is None or at_home[1] == length else f'"{value} {at_home[1]}"'
    return f'"{value} {old.unit}"' if path in SPEEDS and old.unit in OWN_CELLS else value


def _inline_end(text: str, table: Spot, line: str) -> tuple[int, int, str]:
    """Where a further key of `{ … }` goes, and what is written there."""
    last = table.end - 1  # the brace
    while text[last - 1].isspace():
        last -= 1
    comma = "" if text[last - 1] == "{" else ","
    return last, table.end - 1, f"{comma} {line} "


def _beside(source: Source, around: Path, line: str) -> Source:
    """A further key of a table that dotted keys make (`a2.value = 30`): a line below the one that begins it.

    One that has but tables of its own (`[[driver.segments]]`) gets a head.
    """
    inside = [spot for path, spot in source.spots.items() if path[:-1] == around and spot.how == "value"]
    if not inside:
        return _with_header(source, around, line)
    first = min(inside, key=lambda spot: spot.start)
    start = source.text.rfind("\n", 0, first.start) + 1
    before = source.text[start : first.start]
    key = _KEY_BEFORE.search(before)
    prefix = before[: key.start()] if key else ""
    end = line_end(source.text, first.end)
    return _replaced(source, end, end, f"\n{prefix}{line}")


def without_key(source: Source, path: Path) -> Source:
    """The source without a key; nothing changes where it is not written."""
    spot = source.spots.get(path)
    table = source.spots.get(path[:-1])
    if spot is None or table is None:
        return source
    text = source.text
    found = _KEY_BEFORE.search(text[: spot.start])
    start = found.start() if found else spot.start
    end = spot.end
    if table.how != "inline":  # a line of its own, with the comment behind it
        start = text.rfind("\n", 0, start) + 1
        return _replaced(source, start, min(line_end(text, end) + 1, len(text)), "")
    before = len(text[:start].rstrip())
    if text[before - 1] == ",":
        return _replaced(source, before - 1, end, "")
    behind = re.match(r"\s*,\s*", text[end:])
    return _replaced(source, start, end + (behind.end() if behind else 0), "")


def _replaced(source: Source, start: int, end: int, new: str) -> Source:
    """Read again at once: every place behind the change has moved."""
    return parse(source.text[:start] + new + source.text[end:], source.file)


# --- whole tables -----------------------------------------------------------------------------------------------------


def with_table(source: Source, path: Path, lines: list[str]) -> Source:
    """The source with a table `[path]`, or with a further `[[path]]` where `path` ends with a number; `lines` stand in it.

    Raises DescriptionError where the tables around it are written on one line, which no heading can go on with.
    """
    array = isinstance(path[-1], int)
    keys = [key_text(str(key)) for key in path if not isinstance(key, int)]
    heading = f"[[{'.'.join(keys)}]]" if array else f"[{'.'.join(keys)}]"
    around = source.spots.get(path[:-1])
    if around is not None and around.how in ("inline", "value"):
        hint = say("write them under headings, {heading}, then it can be drawn", heading=heading)
        raise DescriptionError(source.fault(path[:-1], say("stands on one line"), hint))
    text = "\n".join([heading, *lines])
    headers = _headers(source)
    same = [spot for found, spot in headers if len(path) > 1 and found[: len(path) - 1] == path[:-1]]
    same = [spot for spot in same if source.text[spot.start :].startswith(heading[: 2 if array else 1])]
    before = same or [spot for found, spot in headers if _order(found) <= _order(path)]
    if not before:
        return parse(f"{source.text.rstrip()}\n\n{text}\n", source.file)
    end = _end_of(source, before[-1].start)
    gap = "\n" if not same or _apart(source, same) else ""
    behind = source.text[end:]
    gap_behind = "\n" if not same and behind.strip() and not behind.startswith("\n\n") else ""
    return parse(f"{source.text[:end]}\n{gap}{text}{gap_behind}{behind or chr(10)}", source.file)


def _order(path: Path) -> int:
    """Where a table stands in a description: as its keys are listed in the manual."""
    keys = list(DESCRIPTION.keys)
    return keys.index(str(path[0])) if path[0] in keys else len(keys)


def without_table(source: Source, path: Path) -> Source:
    """The source without the table under a heading; nothing changes where there is no such heading."""
    spot = source.spots.get(path)
    if spot is None or spot.how != "header":
        return source
    start, end = source.text.rfind("\n", 0, spot.start) + 1, _end_of(source, spot.start)
    rest = source.text[end:].lstrip("\n")
    before = source.text[:start].rstrip("\n")
    gap = "\n\n" if source.text[end:].startswith("\n\n") or source.text[:start].endswith("\n\n") else "\n"
    if not rest:
        return parse(before + "\n", source.file)
    return parse(f"{before}{gap if before else ''}{rest}", source.file)


def with_last_key(source: Source, table: Path, key: str, value: str) -> Source:
    """The source with a new key at the end of a table; a table that is not there is made."""
    spot = source.spots.get(table)
    if (*table, key) in source.spots or spot is None or spot.how != "header":
        return with_value(source, (*table, key), value)
    end = _end_of(source, spot.start)
    return _replaced(source, end, end, f"\n{key_text(key)} = {value}")


def _headers(source: Source) -> list[tuple[Path, Spot]]:
    """The headings of the text in their order. Each element of an array of tables has one of its own."""
    found = [(path, spot) for path, spot in source.spots.items() if spot.how == "header"]
    return sorted(found, key=lambda each: each[1].start)


def _end_of(source: Source, start: int) -> int:
    """Where the table ends whose heading begins at `start`: behind its last line that is no comment and not empty."""
    following = min((spot.start for _, spot in _headers(source) if spot.start > start), default=len(source.text))
    inside = [spot.end for spot in source.spots.values() if start <= spot.start < following]
    return line_end(source.text, max(inside, default=start))


def _apart(source: Source, spots: list[Spot]) -> bool:
    """Whether tables of this kind stand with an empty line above."""
    starts = [source.text.rfind("\n", 0, spot.start) for spot in spots]
    return all(start < 1 or source.text[start - 1] == "\n" for start in starts) if len(spots) > 1 else False


# --- names of points and links ----------------------------------------------------------------------------------------

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


# --- what it said before ----------------------------------------------------------------------------------------------

_OF_BUILD = ("layout", "language", "references")
"""Keys of [workbook] that do not change a number, and that `build` has options for."""

_MARK = "# changed when it was built from a description of the fingerprint "
_MARKED = re.compile(rf"^{_MARK}(\w+)\n?", re.MULTILINE)


def meaning(text: str, file: str) -> dict[str, Any]:
    """The data of a text that decide what is built; `file` is what messages call it."""
    data = parse(text, file).data
    workbook = data.get("workbook", {})
    if isinstance(workbook, dict):
        data = {**data, "workbook": {key: value for key, value in workbook.items() if key not in _OF_BUILD}}
    return data


def with_origin(text: str, read: str, file: str) -> str:
    """The text that was made of `read`, marked with the fingerprint of that where it means something else."""
    if text == read or _MARKED.search(text):
        return text
    origin = meaning(read, file)
    return text if meaning(text, file) == origin else f"{text.rstrip()}\n{_MARK}{_fingerprint(origin)}\n"


def without_origin(text: str) -> str:
    """The text without that mark: it is a description of its own."""
    return _MARKED.sub("", text)


def is_origin(data: dict[str, Any], text: str) -> bool:
    """Whether a text was made of the description that means `data`."""
    mark = _MARKED.search(text)
    return mark is not None and mark[1] == _fingerprint(data)


def _fingerprint(data: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(data, sort_keys=True, default=str).encode()).hexdigest()[:16]
