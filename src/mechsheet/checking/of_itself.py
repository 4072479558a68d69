"""What a workbook of ours says of itself, without any other judge, that is no agreement.

A red line under the title of its first sheet is never agreement: it says that an input cannot be, that nothing closes, or
that a joint is open. It is known by what it does not say: that it closes, in all positions or in some. So it is found
without the description, too, which somebody may have deleted, and in every language.

The same description gives the same bytes, so a workbook whose own description says something else than the file of its
name was not built anew after a change: it is stale. What `build` was told beside the description is no change of it, nor
are comments; and after `mechsheet pull` the file says what is typed in the workbook.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from livesheet.diagnostics import readable_name
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
from livesheet.said import say
from mechsheet.checking.edited.pull import pull
from mechsheet.description.text.index import Path as Place
from mechsheet.description.text.rewrite import is_origin, meaning
from mechsheet.description.text.source import dotted, read_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.sheet.plan import LEGEND_ROW, SYMBOL, VALUE, VERDICT_ROW
from mechsheet.words.catalogue import LANGUAGES, words

_CLOSES = ("verdict.line.all", "verdict.line.one", "verdict.line.closes", "verdict.rows.all", "verdict.rows.some")
"""How a line begins that is not red."""

_BEGUN = "verdict.same_assembly.begun"
"""What a line says that is amber and does not begin so."""


def first_sheet(book: Book) -> str | None:
    """The title of the sheet that has the legend of our first sheets under its line; None where no sheet has."""
    legends = {tuple(words(language, f"legend.{key}") for key in ("input", "result")) for language in LANGUAGES}
    for sheet in book.sheets:
        found = tuple(sheet.constants.get(LEGEND_ROW, col) for col in (SYMBOL, VALUE))
        if found in legends:
            return sheet.title
    return None


def red_line(book: Book, values: Any) -> str:
    """What the line under the title says where it is red, "" where it is not, and in workbooks that are not ours."""
    title = first_sheet(book)
    if title is None:
        return ""
    line: Scalar = values.get(title, VERDICT_ROW, SYMBOL)
    return "" if isinstance(line, str) and _says_that_it_closes(line) else str("" if line is None else line) or "-"


def _says_that_it_closes(line: str) -> bool:
    if line.startswith(tuple(words(language, "verdict.line.nowhere") for language in LANGUAGES)):
        return False  # though it begins as a green one does
    if line in {words(language, _BEGUN) for language in LANGUAGES}:
        return True
    begins = (words(language, key, rows="\0") for language in LANGUAGES for key in _CLOSES)
    return any(re.match(re.escape(text).replace("\0", "[0-9]+"), line) for text in begins)


# --- whether it is stale ---------------------------------------------------------------------------------------------


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
