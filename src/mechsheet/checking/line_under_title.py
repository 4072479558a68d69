"""What a workbook of ours says of itself, in the line under the title of its first sheet.

A red line is never agreement: it says that an input cannot be, that nothing closes, or that a joint is open. It is known
by what it does not say: that it closes, in all positions or in some. So it is found without the description, too, which
somebody may have deleted, and in every language.
"""

from __future__ import annotations

import re
from typing import Any

from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
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
