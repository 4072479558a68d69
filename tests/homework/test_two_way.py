"""Two-way tables, one formula filled down and to the right, as the text's workbook of the adjustable pump has it."""

from __future__ import annotations

import openpyxl
import pytest
from openpyxl.workbook.defined_name import DefinedName

from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.homework.audit import audit
from mechsheet.homework.mends import trial

GIVEN = (("Krank", 55), ("Biyel", 240), ("Arakol", 165), ("SabitU_Y", 185), ("Eksantrik", 70))
SETTINGS = (20, 50, 100, 150, 200, 250)
CALL = "AyarlıPompa(Krank,Biyel,Arakol,SabitU_Y,Eksantrik,{column}$7,$A{row})"
MOST_TRIED = 2000
"""Formulas that an audit may try in place of a table's: each calls a routine of some hundred nodes and takes some
milliseconds. Twice as many were tried where a call cost no more than a sum, and an audit took half a minute."""


@pytest.fixture(scope="module")
def pump():
    return loads(
        template_text("adjustable-pump") + "\n[exercise]\nasked = { s15 = 1 }\n", "pump", Overrides(language="en")
    )


def saved(path, call=CALL, settings=SETTINGS, rows=19, only="BCDEFG", cells=None):
    """The text's sheet: dimensions by name, settings in row 7, angles in column A; `call` in the columns `only`."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "Sayfa1"
    for row, (name, value) in enumerate(GIVEN, 1):
        sheet.cell(row, 1, name)
        sheet.cell(row, 2, value)
        book.defined_names[name] = DefinedName(name, attr_text=f"Sayfa1!$B${row}")
    for column, setting in zip("BCDEFG", settings, strict=True):
        sheet[f"{column}7"] = setting
        for row in range(8, 8 + rows):
            sheet[f"A{row}"] = 20 * (row - 8)
            sheet[f"{column}{row}"] = "=" + (call if column in only else CALL).format(column=column, row=row)
    for cell, value in (cells or {}).items():
        sheet[cell] = value
    book.save(path)
    return path


@pytest.fixture(autouse=True)
def few_are_tried(monkeypatch):
    """No audit takes long."""
    tried = []
    laid_out = trial._Book.candidates

    def counted(book, number, candidates):
        tried.append(len(candidates))
        laid_out(book, number, candidates)

    monkeypatch.setattr(trial._Book, "candidates", counted)
    yield
    assert sum(tried) < MOST_TRIED


@pytest.mark.slow
def test_all_columns_are_right(tmp_path, pump):
    found = audit(saved(tmp_path / "pump.xlsx"), pump)
    assert (found.asked["s15"].verdict, found.asked["s15"].cells) == ("right", "Sayfa1!B8:G26")
    assert found.faults == ()


@pytest.mark.slow
def test_nothing_but_the_table_is_missing(tmp_path):
    """The angles that the template asks for besides are no fault of these columns."""
    found = audit(saved(tmp_path / "pump.xlsx"), loads(template_text("adjustable-pump"), "pump"))
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == {
        "theta13": "missing", "theta14": "missing", "s15": "right", "s4": "missing",
    }  # fmt: skip


@pytest.mark.slow
def test_other_settings_than_the_descriptions_are_read_from_their_row(tmp_path, pump):
    found = audit(saved(tmp_path / "pump.xlsx", settings=(30, 60, 90, 120, 180, 210)), pump)
    assert found.right


@pytest.mark.slow
def test_a_table_wider_than_it_is_high_goes_down_all_the_same(tmp_path, pump):
    found = audit(saved(tmp_path / "pump.xlsx", rows=5), pump)
    assert (found.asked["s15"].verdict, found.asked["s15"].cells) == ("in part", "Sayfa1!B8:G12")


SWAPPED = CALL.replace("Biyel,Arakol", "Arakol,Biyel")


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("only", "cells"), [("BCDEFG", "B8:G26"), ("D", "D8:D26")])
def test_a_wrong_formula_is_found_in_the_columns_that_have_it(tmp_path, pump, only, cells):
    found = audit(saved(tmp_path / "pump.xlsx", SWAPPED, only=only), pump)
    (fault,) = found.faults
    assert fault.cells == f"Sayfa1!{cells}"
    assert "Krank,Biyel,Arakol" in fault.mend
    assert found.follow_through == 0


@pytest.mark.slow
@pytest.mark.parametrize(("cell", "wanted"), [("B12", "252.093"), ("E12", "290.755")])
def test_a_number_typed_over_is_found_in_its_column(tmp_path, pump, cell, wanted):
    found = audit(saved(tmp_path / "pump.xlsx", cells={cell: 123.4}), pump)
    (fault,) = found.faults
    assert (fault.cells, fault.formula, fault.kind) == (f"Sayfa1!{cell}", "123.4", "typed over")
    assert f"s15 in Sayfa1!{cell}: 123.4 found, {wanted} wanted" in found.remarks


@pytest.mark.ci
def test_what_no_single_change_mends_takes_no_longer(tmp_path, pump):
    wrong = CALL.replace("Arakol,SabitU_Y,Eksantrik", "Eksantrik,SabitU_Y*1.07,Arakol")
    found = audit(saved(tmp_path / "pump.xlsx", wrong), pump)
    assert [fault.kind for fault in found.faults] == ["no single change mends it"]
