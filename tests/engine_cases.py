"""The case files of the engine: formulas with what they give, over one set of cells."""

import json
import math
import tomllib
from datetime import date, time, timedelta
from pathlib import Path

from openpyxl.utils.datetime import to_excel

from livesheet.engine.values.cells import ERROR_NAMES
from livesheet.formula.book import Book, BookBuilder
from livesheet.formula.nodes import CellRef, ErrorValue, transform
from livesheet.formula.parser import parse_formula

FOLDER = Path(__file__).parent / "cases" / "engine"
FILES = sorted(
    path for path in FOLDER.glob("*.toml") if path.stem not in ("cells", "decided") and "differences" not in path.stem
)
FIRST_ROW = 20
COLUMN = 8


def load(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def scalar(value):
    """A value of a case file as a scalar."""
    if isinstance(value, str) and value in ERROR_NAMES:
        return ErrorValue(value)
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def answered(value):
    """What openpyxl found in a cell, as a scalar: numbers beyond reach are errors, dates are numbers."""
    if isinstance(value, str) and value.startswith("#"):
        return ErrorValue(value)
    if isinstance(value, date | time | timedelta):
        return float(to_excel(value))
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value) if math.isfinite(value) else ErrorValue("#NUM!")
    return "" if value is None else value


def spelt(value):
    """A value as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
    text = value.code if isinstance(value, ErrorValue) else "" if value is None else str(value)
    return quoted(text)


def quoted(text):
    """A text as TOML."""
    return json.dumps(text, ensure_ascii=False)


def cells():
    """(row, column, value) of the cells that all cases read."""
    for letter, column in load(FOLDER / "cells.toml").items():
        for row, value in enumerate(column):
            if value != "":
                yield row, ord(letter) - 65, value[1:] if isinstance(value, str) and value[0] == "'" else scalar(value)


def cases():
    """(file, formula, value) of all cases."""
    return [(path.stem, formula, scalar(value)) for path in FILES for formula, value in load(path)["cases"]]


def book_of(formulas) -> Book:
    """The cells, and the formulas below one another."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, col, value in cells():
        sheet.constant(row, col, value)
    for row, formula in enumerate(formulas, FIRST_ROW):
        sheet.block(row, COLUMN, 1, 1, parse_formula(formula))
    return builder.build()


def same(ours, theirs, tolerance=1e-13):
    """Whether two scalars are equal: numbers nearly, everything else exactly and of the same kind."""
    if isinstance(ours, float) and isinstance(theirs, float):
        return abs(ours - theirs) <= tolerance * max(abs(ours), abs(theirs))
    return type(ours) is type(theirs) and ours == theirs


def array_cases():
    """(file, formula, rows of values) of the cases of arrays."""
    paths = sorted(path for path in (FOLDER / "arrays").glob("*.toml") if path.stem != "differences")
    return [
        (path.stem, formula, [[scalar(item) for item in row] for row in rows])
        for path in paths
        for formula, rows in load(path)["cases"]
    ]


def anchored(node):
    """The formula with every reference absolute: filled down it says the same in each row."""

    def change(part):
        return CellRef(part.row, part.col, True, True, part.sheet) if isinstance(part, CellRef) else part

    return transform(node, change)
