"""Writing single values into a description's text, in place: comments, order and everything else stay as they are.

By the offsets that `index` keeps anyway: messages name the line of each key.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from mechsheet.description.text.index import Path, Spot, key_text
from mechsheet.description.text.measured import home, measured
from mechsheet.description.text.source import Source, parse

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
    end = source.text.find("\n", first.end)
    end = len(source.text) if end < 0 else end
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
        line_end = text.find("\n", end)
        return _replaced(source, start, len(text) if line_end < 0 else line_end + 1, "")
    before = len(text[:start].rstrip())
    if text[before - 1] == ",":
        return _replaced(source, before - 1, end, "")
    behind = re.match(r"\s*,\s*", text[end:])
    return _replaced(source, start, end + (behind.end() if behind else 0), "")


def _replaced(source: Source, start: int, end: int, new: str) -> Source:
    """Read again at once: every place behind the change has moved."""
    return parse(source.text[:start] + new + source.text[end:], source.file)
