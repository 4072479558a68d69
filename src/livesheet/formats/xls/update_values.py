"""Values are not written into an .xls: said in words."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault, OutputError, readable_name
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
from livesheet.said import say


def update_xls(source: Path, output: Path, book: Book, values: Any, changes: Mapping[Any, Scalar]) -> None:
    """Refuses to write. Raises OutputError."""
    del source, book, values, changes
    message = say("an .xls is read, not written")
    raise OutputError(Fault(message, readable_name(output), hint=say("save it as .xlsx first, then recalculate that")))
