"""What a key of a description may hold: the shapes in which `schema` is written.

A shape says what is allowed where it stands, not what it means; `shape.py` checks a text against it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS

HEADING_ROWS = 20
"""Rows of a sheet that are kept for headings when the length of a sweep is judged."""
MOST_ROWS = MAX_ROWS - HEADING_ROWS
MOST_SERIES = 255
"""Curves in one chart: the limit of spreadsheet programs."""
MOST_COLUMNS = MAX_COLUMNS - HEADING_ROWS


@dataclass(frozen=True, slots=True)
class Number:
    """A plain number; `least` is the smallest allowed."""

    least: float | None = None


@dataclass(frozen=True, slots=True)
class Integer:
    """A whole number from `least` to `most`."""

    least: int
    most: int


@dataclass(frozen=True, slots=True)
class YesNo:
    """true or false."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number in the file's own units; in quotes a number with its unit, or an expression."""


@dataclass(frozen=True, slots=True)
class WithUnit:
    """A number with its unit, in quotes: "20 mm"."""


@dataclass(frozen=True, slots=True)
class Text:
    """A text.

    choices  the only texts allowed, when there are any
    names    what the text is the name of ("link", "point" ...), for documentation
    longest  number of characters;  lines: more than one line is allowed
    """

    choices: tuple[str, ...] = ()
    names: str = ""
    longest: int = 255
    lines: bool = False


@dataclass(frozen=True, slots=True)
class Words:
    """One text, or one in each language: `{ en = "…", tr = "…" }`."""

    longest: int = 255
    lines: bool = False


@dataclass(frozen=True, slots=True)
class Items:
    """A list (or an array of tables) of `least` to `most` items."""

    item: Shape
    least: int = 0
    most: int = MOST_ROWS
    note: str = ""


@dataclass(frozen=True, slots=True)
class Named:
    """A table whose keys are names that the description gives; `what` they name. `keys` are keys beside them."""

    item: Shape
    what: str
    least: int = 0
    most: int | None = None
    keys: Mapping[str, Key] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Key:
    """One key of a table."""

    shape: Shape
    note: str
    required: bool = False


@dataclass(frozen=True, slots=True)
class Table:
    """A table with fixed keys.

    ways     alternatives: exactly one group must be there, whole: (("start", "stop", "step"), ("values",)); a key with "?"
             may be left out of its group
    later    keys that are expected here and do not exist, refused by name
    """

    keys: Mapping[str, Key]
    ways: tuple[tuple[tuple[str, ...], ...], ...] = ()
    later: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Kinds:
    """A table whose text `key` says which other keys it has."""

    key: str
    tables: Mapping[str, Table]


@dataclass(frozen=True, slots=True)
class Either:
    """One of several shapes, told apart by their TOML type."""

    shapes: tuple[Shape, ...]


# A string: it is recursive.
Shape: TypeAlias = (
    "Number | Integer | YesNo | Quantity | WithUnit | Text | Words | Items | Named | Table | Kinds | Either"
)
