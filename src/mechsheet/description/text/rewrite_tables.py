"""Whole tables of a description's text, written and taken away: a link more, a joint less; all else stays as it is.

A new table goes behind the last of its kind ([links.rocker] behind [links.coupler]), else where the manual's order has it.
"""

from __future__ import annotations

from livesheet.said import say
from mechsheet.description.schema import DESCRIPTION
from mechsheet.description.text.index import Path, Spot, key_text
from mechsheet.description.text.rewrite import with_value
from mechsheet.description.text.source import Source, parse
from mechsheet.diagnostics import DescriptionError


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
    return parse(f"{source.text[:end]}\n{key_text(key)} = {value}{source.text[end:]}", source.file)


def _headers(source: Source) -> list[tuple[Path, Spot]]:
    """The headings of the text in their order. Each element of an array of tables has one of its own."""
    found = [(path, spot) for path, spot in source.spots.items() if spot.how == "header"]
    return sorted(found, key=lambda each: each[1].start)


def _end_of(source: Source, start: int) -> int:
    """Where the table ends whose heading begins at `start`: behind its last line that is no comment and not empty."""
    following = min((spot.start for _, spot in _headers(source) if spot.start > start), default=len(source.text))
    inside = [spot.end for spot in source.spots.values() if start <= spot.start < following]
    last = max(inside, default=start)
    end = source.text.find("\n", last)
    return len(source.text) if end < 0 else end


def _apart(source: Source, spots: list[Spot]) -> bool:
    """Whether tables of this kind stand with an empty line above."""
    starts = [source.text.rfind("\n", 0, spot.start) for spot in spots]
    return all(start < 1 or source.text[start - 1] == "\n" for start in starts) if len(spots) > 1 else False
