"""What a finding is: one thing that is said of a motion, declared once.

Layouts write it, the line under the title and the marks read its levels, `check` and the library compare it with a search.
All of them go through the list (`listing`); none asks which finding it has.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from livesheet.formula.nodes import Node
from livesheet.workbook import Conditional, Content, Style
from mechsheet.sheet import styles
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

LEVELS = {"bad": styles.BAD, "look": styles.WARN, "good": styles.GOOD}
"""How words look of what is wrong, of what a person should look at, and of what is fine."""

MARKS = {"bad": "●", "look": "▲", "good": ""}
"""What stands beside them: in print without colours, too."""


@dataclass(frozen=True, slots=True)
class Level:
    """How good what is found is where a test of the sheet's own cells holds: other programs refuse another's cells.

    decides  whether the line under the title has this level, too, where no other line has a worse one
    """

    kind: Literal["bad", "look", "good"]
    test: Node
    decides: bool = True


def bad(test: str, **holes: Node | float | str) -> Level:
    """Something is wrong where the test holds."""
    return Level("bad", formula(test, **holes))


def look(test: str, **holes: Node | float | str) -> Level:
    """A person should look at it."""
    return Level("look", formula(test, **holes))


def note(test: str, **holes: Node | float | str) -> Level:
    """A person should know it, and may well want it so: it leaves the line under the title as it is."""
    return Level("look", formula(test, **holes), decides=False)


def good(test: str, **holes: Node | float | str) -> Level:
    """All is well."""
    return Level("good", formula(test, **holes))


@dataclass(frozen=True, slots=True)
class Beside:
    """What stands beside a number, and its symbol and words where it has a line of its own."""

    value: Node
    symbol: str
    words: str


@dataclass(frozen=True, slots=True)
class Line:
    """What a finding says, as formulas.

    unit    of the value; a formula is the number of rows that the value is of
    style   of the value, or only its decimals
    occurs  where, a value of the driver;  beside: what else stands there
    note    what explains it, where no sheet of notes does
    itself  those of its cells that say themselves what is left where another sheet was deleted
    levels  the first that holds counts
    rules   colours of other cells that follow from it
    """

    symbol: Content
    value: Node
    words: Node
    unit: str | Node = ""
    style: int | Style = 0
    occurs: Node | None = None
    beside: Beside | None = None
    note: str = ""
    itself: Sequence[Literal["value", "words"]] = ()
    levels: Sequence[Level] = ()
    rules: Sequence[Conditional] = ()

    @property
    def value_style(self) -> Style:
        """The style of the value."""
        return styles.decimals(styles.RESULT, self.style) if isinstance(self.style, int) else self.style


@dataclass(frozen=True, slots=True)
class InTitle:
    """What a finding adds to the line under the title: before all others say something, in its turn, after all others."""

    first: Node | str = ""
    here: Node | str = ""
    last: Node | str = ""


class Finding(ABC):
    """One thing that is said of a motion.

    key     the name of its cell, in every language
    placed  whether it says where in the motion it occurs: that cell is `key`_at
    by_rows whether it can be said of rows alone, so that a page has it, too
    tells_place  whether its words say where it occurs; else a page has a line of its own for that, below
    needs   keys of other sheets without which nothing can be said, beside those that its formulas read
    """

    key: str
    needs: Sequence[str] = ()
    placed: bool = False
    by_rows: bool = False
    tells_place: bool = False

    def key_beside(self, plan: Plan) -> str:
        """The key of the line that a page has for what stands beside the number; "" where nothing does."""
        return ""

    @property
    def key_at(self) -> str:
        """The key of the cell that says where it occurs."""
        return f"{self.key}_at"

    def keys_below(self, plan: Plan) -> list[str]:
        """The keys of the lines that a page has below its own."""
        place = self.key_at if self.placed and not self.tells_place else ""
        return [key for key in (self.key_beside(plan), place) if key]

    @abstractmethod
    def line(self, on: Reading) -> Line:
        """What it says where it is written."""

    def in_title(self, on: Reading) -> InTitle:
        """What it adds to the line under the title where all is well."""
        return InTitle()

    def left(self, on: Reading) -> Node | str:
        """What it says in the line under the title, with "; " behind it, where another sheet was deleted."""
        return ""

    def overrules(self, on: Reading, title: Node) -> Node:
        """The line under the title, if what it says comes before all else that `title` would say."""
        return title

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        """What a search finds, by the key of the cell; nothing where it cannot say."""
        return {}
