"""What a user can do wrong with a mechanism, beside what can be wrong with a workbook or a file; and how
messages show what somebody has written."""

from __future__ import annotations

from livesheet.diagnostics import Fault, UserError
from livesheet.said import say

MechsheetError = UserError
"""Base of every error that a user can cause: one family for mechanisms, workbooks and files."""


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


MOST = 60
"""Characters of somebody's text that a message shows."""


def printable(text: str) -> str:
    """The text with everything that could disturb a terminal written as an escape."""
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)


def quoted(text: str) -> str:
    """The text in quotes, shortened, and safe to print."""
    text = printable(text)
    return f'"{text}"' if len(text) <= MOST else f'"{text[: MOST - 1]}…"'
