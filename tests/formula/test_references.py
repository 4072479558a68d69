"""References as INDIRECT reads them."""

import pytest

from livesheet.formula.nodes import MAX_ROWS, CellRef, RangeRef
from livesheet.formula.references import parse_r1c1


@pytest.mark.parametrize(
    ("text", "row", "col", "found"),
    [
        ("R2C3", 8, 8, CellRef(1, 2, True, True)),
        ("RC[-1]", 4, 2, CellRef(4, 1, True, True)),
        ("R[-1]C", 0, 0, None),
        ("RC[-1]", 0, 0, None),
        ("R[1]C", MAX_ROWS - 1, 0, None),
        ("R9C2:R1C1", 0, 0, RangeRef(CellRef(0, 0, True, True), CellRef(8, 1, True, True))),
        ("C2", 0, 0, RangeRef(CellRef(0, 1, True, True), CellRef(MAX_ROWS - 1, 1, True, True))),
        ("'it''s'!R2C3", 0, 0, CellRef(1, 2, True, True, "it's")),
        ("Data!R2C3", 0, 0, CellRef(1, 2, True, True, "Data")),
        ("A1", 0, 0, None),
        ("", 0, 0, None),
    ],
)
def test_rows_and_columns_as_seen_from_a_cell(text, row, col, found):
    assert parse_r1c1(text, row, col) == found
