"""A text longer than a cell holds is #VALUE!, as in Excel: a small workbook must not take all memory."""

import openpyxl
import pytest

from mechsheet.library.recalculation import recalc


@pytest.mark.parametrize(
    "formula", ["=A{above}&A{above}", "=CONCAT(A{above},A{above})", "=CONCATENATE(A{above},A{above})"]
)
def test_forty_cells_that_double_the_one_above(formula, tmp_path):
    """5 kB that took 24 GB."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet["A1"] = "x"
    for row in range(2, 42):
        sheet[f"A{row}"] = formula.format(above=row - 1).replace("CONCAT(", "_xlfn.CONCAT(")
    book.save(tmp_path / "doubling.xlsx")
    values = recalc(tmp_path / "doubling.xlsx").as_dict()[sheet.title]
    assert len(values["A15"]) == 2**14
    assert {values[f"A{row}"] for row in range(16, 42)} == {"#VALUE!"}  # 2**15 is one more than 32,767
