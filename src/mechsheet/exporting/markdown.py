"""markdown: the written solution with LaTeX mathematics between dollar signs, as GitHub, Jupyter and pandoc read it."""

from __future__ import annotations

import re

from mechsheet.exporting.job import Job
from mechsheet.exporting.solution import Block, Display, Heading, Paragraph, Table, marked_up, solution


def write(job: Job) -> list[bytes]:
    """The document in UTF-8."""
    return [("\n\n".join(_block(block) for block in solution(job)) + "\n").encode()]


def _block(block: Block) -> str:
    match block:
        case Heading(level, text):
            return f"{'#' * level} {_escaped(text)}"
        case Paragraph(parts):
            return marked_up(parts, _escaped)
        case Display(lines):
            return "$$\n\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}\n$$"
        case Table(head, rows, numbers):
            rule = ["--:" if index in numbers else "---" for index in range(len(head))]
            written = [f"| {' | '.join(marked_up(cell, _escaped) for cell in row)} |" for row in (head, *rows)]
            return "\n".join([written[0], f"| {' | '.join(rule)} |", *written[1:]])


def _escaped(text: str) -> str:
    """Signs that Markdown would read as its own."""
    return re.sub(r"([\\`*_{}\[\]<>#|$~])", r"\\\1", text)
