"""What a user can do wrong, as data. Everything else that goes wrong is a bug and may show a traceback."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from mechsheet.said import Said, say


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


class MechsheetError(Exception):
    """Base of every error that a user can cause; carries all faults found, not only the first."""

    def __init__(self, faults: Fault | str | Iterable[Fault]) -> None:
        if isinstance(faults, str):
            faults = Fault(faults)
        self.faults: tuple[Fault, ...] = (faults,) if isinstance(faults, Fault) else tuple(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


class DescriptionWarning(UserWarning):
    """Something in a description that works and is probably not what was meant: `fault` says what.

    The library gives it to Python's `warnings`; the command line prints it on standard error, with file and line.
    """

    def __init__(self, fault: Fault) -> None:
        self.fault = fault
        super().__init__(str(fault))


class DescriptionError(MechsheetError):
    """The description is wrong."""


class MechanismError(MechsheetError):
    """The mechanism cannot be solved: mobility, a group of a class not supported, a sketch between two modes."""


class WorkbookError(MechsheetError):
    """A workbook cannot be read or recalculated."""


class MissingSheetError(WorkbookError, KeyError):
    """A sheet that is asked for is not in the workbook."""

    def __init__(self, title: str, file: str = "") -> None:
        super().__init__(Fault(say('no sheet of this workbook is called "{title}"', title=title), file))
        self.title = title

    def __str__(self) -> str:
        return str(self.faults[0])


class FormulaError(MechsheetError):
    """A formula cannot be parsed, or uses something that is not known."""


class OutputError(MechsheetError):
    """A file cannot be written."""


class MissingProgramError(MechsheetError):
    """A program or package that was asked for is not installed; the message says what to install."""


OWN_FAILURES = (
    LookupError, ArithmeticError, TypeError, ValueError, AttributeError, RuntimeError, AssertionError, StopIteration,
    MemoryError,
)  # fmt: skip
"""What a fault of mechsheet itself raises: among many files it is told of its file, and the others are judged."""


def own_fault(error: BaseException, file: str) -> Fault:
    """What is said of a file on which mechsheet itself failed."""
    message = say(
        "mechsheet itself failed on this file, please report it: {kind}: {error}",
        kind=type(error).__name__,
        error=str(error),
    )
    return Fault(message, file)


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
