"""latex: the written solution as a document of its own, for any LaTeX."""

from __future__ import annotations

from mechsheet.exporting.job import Job
from mechsheet.exporting.solution import Block, Display, Heading, Paragraph, Table, marked_up, solution
from mechsheet.words.symbols import GREEK

HEAD = r"""\documentclass[a4paper,11pt]{article}
\usepackage[margin=22mm]{geometry}
\usepackage{amsmath}
\usepackage{longtable}
\usepackage{iftex}
\ifPDFTeX\usepackage[utf8]{inputenc}\else\usepackage{fontspec}\fi
\setlength{\parindent}{0pt}
\setlength{\parskip}{4pt}
\sloppy
\allowdisplaybreaks
\AtBeginDocument{\setlength{\abovedisplayskip}{3pt}\setlength{\belowdisplayskip}{5pt}}
\begin{document}
"""

LONG = 24
"""Rows from which on a table is broken over pages."""

HEADINGS = {2: "section*", 3: "subsection*"}

_SIGNS = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "%": r"\%", "_": r"\_",
    "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "→": r"$\to$", "–": "--", "—": "---", "−": r"$-$",
    "°": r"$^\circ$", "·": r"$\cdot$", "×": r"$\times$", "²": r"$^2$", "³": r"$^3$", "µ": r"$\mu$", "≤": r"$\le$",
    "≥": r"$\ge$", "±": r"$\pm$", "∠": r"$\angle$", "√": r"$\surd$", "<": r"$<$", ">": r"$>$", "|": r"$|$", '"': "''",
} | {letter: f"$\\{name}$" for name, letter in GREEK.items()}  # fmt: skip


def write(job: Job) -> list[bytes]:
    """The document in UTF-8."""
    parts = [HEAD]
    for block in solution(job):
        # no paragraph ends before equations: they would stand further down
        parts += ["" if isinstance(block, Display) else "\n", _block(block), "\n"]
    return ["".join([*parts, "\n\\end{document}\n"]).encode()]


def _block(block: Block) -> str:
    match block:
        case Heading(1, text):
            return rf"{{\LARGE\bfseries {escaped(text)}\par}}"
        case Heading(level, text):
            return rf"\{HEADINGS[level]}{{{escaped(text)}}}"
        case Paragraph(parts):
            return marked_up(parts, escaped)
        case Display(lines):
            return "\\begin{align*}\n" + " \\\\\n".join(lines) + "\n\\end{align*}"
        case Table():
            return _table(block)


def _table(table: Table) -> str:
    """A table; a long one may go on on the next page. Texts in the last column are wrapped."""
    last = len(table.head) - 1
    columns = ["r" if index in table.numbers else "l" for index in range(len(table.head))]
    if last not in table.numbers:
        columns[last] = "p{95mm}"
    rows = [table.head, *table.rows]
    lines = [" & ".join(marked_up(cell, escaped) for cell in row) + r" \\" for row in rows]
    kind, place = ("longtable", "[l]") if len(rows) > LONG else ("tabular", "")
    lines.insert(1, r"\hline" + (r"\endhead" if kind == "longtable" else ""))
    return "\n".join([rf"\begin{{{kind}}}{place}{{{''.join(columns)}}}", *lines, rf"\end{{{kind}}}\par\smallskip"])


def escaped(text: str) -> str:
    """Signs that LaTeX would read as its own, and letters that its fonts do not have."""
    return "".join(_SIGNS.get(letter, letter) for letter in text)
