"""What is read from a file by the patterns of repeated rows, and by the parser alone."""

import re

import pytest

from livesheet.diagnostics import WorkbookError
from livesheet.formats import read
from livesheet.formats.reading import repeated_rows
from livesheet.formats.reading.repeated_rows import RepeatedRows


@pytest.fixture(autouse=True, scope="module")
def short_tables():
    """A pattern after a few rows: otherwise all tables of tests would have to be as long as is worth one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(repeated_rows, "_PRICE", 8)
        yield


def everything(path):
    """All that is read from a file, or why it is not."""
    try:
        book = read(path)
    except WorkbookError as problem:
        return re.sub(r": line \d+, column \d+", "", str(problem))
    return [
        (
            [(row, col, repr(value)) for row, col, value in sheet.constants.items()],
            [(row, col, repr(value)) for row, col, value in sheet.cached.items()],
            sheet.blocks,
        )
        for sheet in book.sheets
    ]


def alone(path):
    """The same by the parser alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(RepeatedRows, "through", lambda self, pieces: iter(pieces))
        return everything(path)


def rows_taken(path):
    """How many rows the parser has not seen."""
    counts = []
    through = RepeatedRows.through

    def counted(self, pieces):
        yield from through(self, pieces)
        counts.append(self.taken)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(RepeatedRows, "through", counted)
        everything(path)
    return sum(counts)
