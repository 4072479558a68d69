"""Rows that are not shown: read from both formats, left out of SUBTOTAL and AGGREGATE."""

from __future__ import annotations

import pytest
import xlsxwriter
from ods_files import cell, content, number, table, write_ods

from livesheet.formats import read
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.library.recalculation import recalc

TOTALS = {"SUBTOTAL(9,A2:A7)": 47.0, "SUBTOTAL(109,A2:A7)": 45.0, "AGGREGATE(9,4,A2:A7)": 63.0, "AGGREGATE(9,5,A2:A7)": 45.0,
          "SUM(A2:A7)": 63.0, "SUBTOTAL(103,A2:A7)": 4.0, "SUBTOTAL(102,A2:B7)": 4.0}  # fmt: skip
"""Of 1, 2, 4 ... 32, where a filter hides 16, and a person has hidden 2 outside of it."""


def by_xlsxwriter(path, with_table=False):
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("S")
        sheet.write_row("A1", ["a", "b"])
        sheet.write_column("A2", [1, 2, 4, 8, 16, 32])
        if with_table:
            sheet.add_table("A5:B7", {"header_row": True, "columns": [{"header": "8"}, {"header": "b"}]})
            sheet.write_number("A5", 8)
        else:
            sheet.autofilter("A5:A7")
            sheet.filter_column(0, "x > 20")
        for row in (2, 5):
            sheet.set_row(row, None, None, {"hidden": True})
        for row, formula in enumerate(TOTALS):
            sheet.write_formula(
                row, 3, f"=_xlfn.{formula}" if "AGG" in formula else f"={formula}", None, TOTALS[formula]
            )
    return path


def test_an_xlsx(tmp_path):
    path = by_xlsxwriter(tmp_path / "a.xlsx")
    sheet = read(path).sheets[0]
    assert (sheet.hidden, sheet.filtered) == ([(2, 3), (5, 6)], [(5, 6)])
    assert [recalc(path).get("S", row, 3) for row in range(len(TOTALS))] == list(TOTALS.values())


def test_many_rows_that_are_alike(tmp_path):
    """The reader takes rows that repeat the row above without parsing them: also hidden ones?"""
    path = tmp_path / "a.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("S")
        for row in range(900):
            sheet.write_number(row, 0, row)
            if 300 <= row < 600 or row == 800:
                sheet.set_row(row, None, None, {"hidden": True})
    assert read(path).sheets[0].hidden == [(300, 600), (800, 801)]


@pytest.mark.ci
@pytest.mark.libreoffice
def test_as_libreoffice_writes_and_counts_them(tmp_path):
    source = by_xlsxwriter(tmp_path / "a.xlsx")
    for suffix in ("ods", "xlsx"):
        (tmp_path / suffix).mkdir()
        (path,) = convert_with_libreoffice([source], suffix, tmp_path / suffix)
        result = recalc(path)
        assert [result.get("S", row, 3) for row in range(len(TOTALS))] == list(TOTALS.values()), suffix
        assert result.compare_with_stored().differences == ()


def test_an_ods(tmp_path):
    rows = "".join(
        f'<table:table-row table:visibility="{shown}">{number(value)}</table:table-row>'
        for shown, value in (("visible", 1), ("collapse", 2), ("filter", 4), ("filter", 8))
    )
    rows += (
        f"<table:table-row>{number(0, 'SUBTOTAL(9;[.A1:.A4])')}{number(0, 'SUBTOTAL(109;[.A1:.A4])')}</table:table-row>"
    )
    rows += (
        f'<table:table-row table:number-rows-repeated="1048571" table:visibility="collapse">{cell()}</table:table-row>'
    )
    path = write_ods(tmp_path / "a.ods", content(table(rows)))
    sheet = read(path).sheets[0]
    assert (sheet.hidden, sheet.filtered) == ([(1, 4), (5, 1_048_576)], [(2, 4)])
    result = recalc(path)
    assert (result.get("S", 4, 0), result.get("S", 4, 1)) == (3.0, 1.0)
