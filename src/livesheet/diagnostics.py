"""What a user can do wrong, as data. Everything else that goes wrong is a bug and may show a traceback."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from livesheet.said import Said, say


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that is wrong, and where.

    message  one sentence: what was found and what is allowed
    file     the file it stands in, as the user named it
    line     1-based line in a text file, or None
    key      dotted key of a description ("driver.link"), or a cell ("Positions!C9"), or ""
    source   the line itself, shown under the message
    hint     the near miss, or the list of what is allowed
    about    what it is about, where programs ask: "function" of a function that is not known, "volatile" of one that gives
             another value at every recalculation, "routine" of one that a file calls and does not define, and that is known;
             else ""
    """

    message: str
    file: str = ""
    line: int | None = None
    key: str = ""
    source: str = ""
    hint: str = ""
    about: str = ""

    @property
    def doubtful(self) -> bool:
        """Whether something is not computed as it is meant: what changes by itself is, and what is known, too."""
        return self.about not in ("volatile", "routine")

    def __str__(self) -> str:
        place = self.file + (f":{self.line}" if self.line is not None else "")
        head = ": ".join(part for part in (place, self.key, self.message) if part)
        number = str(self.line) if self.line is not None else ""
        lines = [head]
        if self.source:
            lines.append(f"{number:>6} | {self.source.strip()}")
        if self.hint:
            lines.append(f"{'':>6} = {self.hint}")
        return "\n".join(lines)


class UserError(Exception):
    """Base of every error that a user can cause; carries all faults found, not only the first."""

    def __init__(self, faults: Fault | str | Iterable[Fault]) -> None:
        if isinstance(faults, str):
            faults = Fault(faults)
        self.faults: tuple[Fault, ...] = (faults,) if isinstance(faults, Fault) else tuple(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


class WorkbookError(UserError):
    """A workbook cannot be read or recalculated."""


class MissingSheetError(WorkbookError, KeyError):
    """A sheet that is asked for is not in the workbook."""

    def __init__(self, title: str, file: str = "") -> None:
        super().__init__(Fault(say('no sheet of this workbook is called "{title}"', title=title), file))
        self.title = title

    def __str__(self) -> str:
        return str(self.faults[0])


class FormulaError(UserError):
    """A formula cannot be parsed, or uses something that is not known."""


class OutputError(UserError):
    """A file cannot be written."""


def near_miss(word: str, allowed: Iterable[str]) -> Said:
    """`did you mean "crank"?`, or "" when nothing in `allowed` resembles `word`."""
    found = difflib.get_close_matches(word, list(allowed), n=1, cutoff=0.6)
    return say('did you mean "{name}"?', name=found[0]) if found else say("")


def system_reason(error: OSError) -> Said:
    """What the system says of a file, `Permission denied`; the words of other errors as they are."""
    return say(error.strerror or str(error))


def readable_name(path: str | Path) -> str:
    """A path as messages show it: as given, with forward slashes on every system."""
    return Path(path).as_posix()
