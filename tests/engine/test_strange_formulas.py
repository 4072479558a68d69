"""Formulas without sense are computed like all others: the fuzzer's findings (tools/fuzz_readers.py)."""

from pathlib import Path

import pytest

from livesheet.engine import evaluate
from livesheet.formula.book import Book, BookSheet, DefinedName
from livesheet.formula.nodes import CellRef
from livesheet.formula.parser import parse_formula

LINES = (Path(__file__).parent.parent / "cases" / "bad" / "formulas.txt").read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize("text", [line for line in LINES if not line.startswith("# ")])
def test_a_value_in_every_cell(text):
    sheet = BookSheet("Sheet1")
    sheet.constants.extend(0, 0, [1.0, "a", True, None, 2.5])
    sheet.block(0, 5, 3, 1, parse_formula(text))
    values = evaluate(Book([sheet], [DefinedName("rate", CellRef(0, 0, True, True, "Sheet1"))]))
    assert all(values.get("Sheet1", row, 5) is not None for row in range(3))
