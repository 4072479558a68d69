"""Writes docs/functions.md, the list of functions, from src/livesheet/formula/functions.txt."""

from __future__ import annotations

from pathlib import Path

from livesheet.formula.functions import FUNCTIONS, MANY, Function

PATH = Path(__file__).parent.parent / "docs" / "functions.md"

KINDS = {
    "n": "number", "p": "number", "y": "date", "t": "text",
    "b": "truth value", "d": "date", "a": "value", "e": "value or error", "v": "numbers",
    "m": "matrix", "r": "range", "l": "values", "h": "dates", "g": "array", "q": "criterion", "f": "formula",
}  # fmt: skip

HEAD = """# Functions

The {count} functions that `mechsheet recalc` knows, as Excel has them. Arguments in brackets may be left out; *numbers*
means a range (its numbers count) or a single value; *range* stands for an array, too. Where a single value is wanted, an
array gives one result for each of its cells. Functions marked *volatile* are computed anew at every change, and `recalc`
says so. Probability distributions, Bessel functions and GAMMALN need SciPy: `pip install "mechsheet[statistics]"`; without
it `recalc` keeps their stored values and says so.

This page is made by `tools/list_of_functions.py` from `src/livesheet/formula/functions.txt`.
"""


def arguments(row: Function) -> str:
    """The arguments of a function in words: `number, [number]`, `range, criterion, …`."""
    words = [KINDS[kind] for kind in row.kinds]
    shown = [word if place < row.least else f"[{word}]" for place, word in enumerate(words)]
    return ", ".join([*shown, "…"] if row.most == MANY else shown)


def line(row: Function) -> str:
    """A row of the table."""
    notes = [part for part in ("volatile" if row.volatile else "", row.note) if part]
    return f"| {row.name} | {arguments(row)} | {'; '.join(notes)} |"


def page() -> str:
    """The whole page: one table for each family."""
    families: dict[str, list[Function]] = {}
    for row in FUNCTIONS.values():
        families.setdefault(row.family, []).append(row)
    parts = [HEAD.format(count=len(FUNCTIONS))]
    for family in sorted(families):
        rows = sorted(families[family], key=lambda row: row.name)
        table = "\n".join(["| function | arguments | notes |", "|---|---|---|", *map(line, rows)])
        parts.append(f"## {family}\n\n{table}\n")
    return "\n".join(parts)


if __name__ == "__main__":
    PATH.write_text(page(), encoding="utf-8")
