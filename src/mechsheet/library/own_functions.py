"""Functions that a workbook calls and that stand in modules of Basic beside it: put into the book as names for LAMBDA."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from pathlib import Path

from livesheet.basic import decoded, functions_in, lambdas
from livesheet.diagnostics import Fault, WorkbookError, readable_name
from livesheet.formula.book import Book
from livesheet.formula.names import folded
from livesheet.said import say

MOST_BYTES = 2_000_000
"""A module is text that somebody wrote."""


def with_modules(book: Book, files: Sequence[Path]) -> Book:
    """The book with the functions of modules; what the book defines itself stays. What cannot be read is a remark.

    Raises WorkbookError where a file cannot be read, or holds no function.
    """
    if not files:
        return book
    found = copy(book)
    found.names, found.remarks = list(book.names), list(book.remarks)
    taken = {folded(name.name) for name in book.names}
    for file in files:
        shown = readable_name(file)
        functions, faults = functions_in(_text(file), shown)
        names, further = lambdas(functions, shown)
        if not functions and not faults:
            raise WorkbookError(Fault(say("no function in Basic is in it"), shown, key="--functions"))
        found.remarks += [*faults, *further]
        for name in names:
            if folded(name.name) not in taken:
                taken.add(folded(name.name))
                found.names.append(name)
    return found


def _text(file: Path) -> str:
    try:
        with file.open("rb") as stream:
            content = stream.read(MOST_BYTES + 1)
    except OSError as error:
        raise WorkbookError(
            Fault(say("cannot be read: {reason}", reason=error.strerror), readable_name(file))
        ) from None
    if len(content) > MOST_BYTES or b"\0" in content:
        raise WorkbookError(Fault(say("is no module of Basic"), readable_name(file), key="--functions"))
    return decoded(content)
