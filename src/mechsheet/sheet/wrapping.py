"""How high a row must be for texts that are broken into lines: not every program finds that out when it opens a file."""

from __future__ import annotations

import math

from mechsheet.sheet.workbook import Content, plain_text


def wrapped_lines(content: Content, width: float) -> int:
    """How many lines a text takes in a column of `width` characters, generously: words break early, capitals are wide."""
    if content is None or isinstance(content, bool | float):
        return 1
    return max(1, sum(math.ceil(len(line) / (width * 1.05)) for line in plain_text(content).split("\n")))
