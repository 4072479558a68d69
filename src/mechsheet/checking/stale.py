"""Whether the workbook beside a description is still the one that the description builds.

The same description gives the same bytes, so a workbook whose own description says something else than the file of its
name was not built anew after a change. What `build` was told beside the description is no change of it, nor are comments;
and after `mechsheet pull` the file says what is typed in the workbook.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from livesheet.diagnostics import readable_name
from livesheet.said import say
from mechsheet.checking.edited.pull import pull
from mechsheet.description.text.index import Path as Place
from mechsheet.description.text.rewrite import is_origin, meaning
from mechsheet.description.text.source import dotted, read_text
from mechsheet.diagnostics import MechsheetError

_EXTRA = ("", "-basic", "-lambda")
"""What the names of a description's workbooks have behind its own."""


def description_of(workbook: Path, known: Iterable[Path] = ()) -> Path | None:
    """The description file of a workbook: of its name beside it, else the only one of its name among `known`."""
    names = {workbook.stem.removesuffix(extra) + ".toml" for extra in _EXTRA if workbook.stem.endswith(extra)}
    beside = [path for name in sorted(names) if (path := workbook.with_name(name)).is_file()]
    if beside:
        return beside[-1]  # the longest name: it is the nearest
    others = [path for path in dict.fromkeys(known) if path.name in names]
    return others[0] if len(others) == 1 else None


def stale(inside: str, workbook: Path, file: Path) -> str:
    """What the description in `file` says otherwise than the one `inside` the workbook; "" where they say the same.

    Raises MechsheetError when the file cannot be read.
    """
    shown = readable_name(file)
    mine, built = meaning(read_text(file), shown), meaning(inside, shown)
    place = _first_difference(mine, built)
    if place is None or is_origin(mine, inside):
        return ""
    try:
        if _first_difference(mine, meaning(pull(workbook).text, shown)) is None:
            return ""
    except MechsheetError:
        pass  # what cannot be pulled cannot be what the file says
    return say(
        "{file} says {key} = {now}, the workbook was built with {was}: build it anew, or use mechsheet pull",
        file=shown,
        key=dotted(place),
        now=_said_at(mine, place),
        was=_said_at(built, place),
    )


def _said_at(data: Any, place: Place) -> str:
    """The value at a place, as a message shows it."""
    for key in place:
        try:
            data = data[key]
        except (LookupError, TypeError):
            return say("nothing")
    return "..." if isinstance(data, dict | list) else str(data)


def _first_difference(one: Any, other: Any, place: Place = ()) -> Place | None:
    """Where two descriptions' data differ first, in the order of the first."""
    if isinstance(one, dict) and isinstance(other, dict):
        keys: Iterable[Any] = dict.fromkeys([*one, *other])
        known = one.keys() & other.keys()
    elif isinstance(one, list) and isinstance(other, list):
        keys = range(max(len(one), len(other)))
        known = set(range(min(len(one), len(other))))
    else:
        return None if one == other else place
    for key in keys:
        if key not in known:
            return (*place, key)
        if (found := _first_difference(one[key], other[key], (*place, key))) is not None:
            return found
    return None
