"""Number formats: what the elements say, and that LibreOffice shows the twins' numbers alike."""

from __future__ import annotations

import csv

import pytest

from livesheet.formats import write
from livesheet.formats.ods.styles import number_style
from livesheet.workbook import Cell, Sheet, Style, Workbook
from mechsheet.checking.programs import convert_with_libreoffice, libreoffice_command
from odf import schema_errors

SHOWN = {
    "General": ("-1234.5", "0", "0.000123456", "1234567.125"),
    "0": ("-1235", "0", "0", "1234567"),
    "0.0": ("-1234.5", "0.0", "0.0", "1234567.1"),
    "0.000": ("-1234.500", "0.000", "0.000", "1234567.125"),
    "0.0##": ("-1234.5", "0.0", "0.0", "1234567.125"),
    "#,##0.00": ("-1,234.50", "0.00", "0.00", "1,234,567.13"),
    "0.00E+00": ("-1.23E+03", "0.00E+00", "1.23E-04", "1.23E+06"),
    "0.0%": ("-123450.0%", "0.0%", "0.0%", "123456712.5%"),
    '0.0"°"': ("-1234.5°", "0.0°", "0.0°", "1234567.1°"),
    '0.0" <mm>"': ("-1234.5 <mm>", "0.0 <mm>", "0.0 <mm>", "1234567.1 <mm>"),
    "0.0\\ \\m": ("-1234.5 m", "0.0 m", "0.0 m", "1234567.1 m"),
    "+0.0;-0.0;0": ("-1234.5", "0", "+0.0", "+1234567.1"),
    '+0.0;"minus "0.0': ("minus 1234.5", "+0.0", "+0.0", "+1234567.1"),
    '"±"0.00': ("-±1234.50", "±0.00", "±0.00", "±1234567.13"),
    "[Red]0.0": ("-1234.5", "0.0", "0.0", "1234567.1"),
    "000": ("-1235", "000", "000", "1234567"),
}
VALUES = (-1234.5, 0.0, 0.000123456, 1234567.125)


def workbook():
    cells = [
        Cell(row, col, value, Style(number_format=code))
        for row, code in enumerate(SHOWN)
        for col, value in enumerate(VALUES)
    ]
    return Workbook((Sheet("Numbers", tuple(cells)),))


def test_the_schema_knows_them(tmp_path):
    write(workbook(), tmp_path / "a.ods")
    assert schema_errors(tmp_path / "a.ods") == []


@pytest.mark.parametrize("code", ["dd.mm.yyyy", "0;0;0;@", "[$€-407]0", "0.0 mm"])
def test_what_is_not_known_is_a_bug(code):
    with pytest.raises(ValueError, match="number format"):
        number_style("N1", code)


def test_sections_are_mapped():
    text = number_style("N1", "+0;-0;0")
    assert 'style:condition="value()&gt;0" style:apply-style-name="N1P0"' in text
    assert 'style:condition="value()&lt;0" style:apply-style-name="N1P1"' in text


@pytest.mark.libreoffice
@pytest.mark.skipif(libreoffice_command() is None, reason="LibreOffice is not installed")
def test_libreoffice_shows_the_same_in_both(tmp_path):
    for suffix in ("xlsx", "ods"):
        (tmp_path / suffix).mkdir()
        path = tmp_path / f"{suffix}-twin.{suffix}"
        write(workbook(), path)
    paths = [tmp_path / "xlsx-twin.xlsx", tmp_path / "ods-twin.ods"]
    # The filter's numbers: comma, quote, UTF-8, as shown.
    results = convert_with_libreoffice(paths, "csv:Text - txt - csv (StarCalc):44,34,76,1,,0,false,true", tmp_path)
    for result in results:
        rows = list(csv.reader(result.read_text(encoding="utf-8").splitlines()))
        assert dict(zip(SHOWN, map(tuple, rows), strict=True)) == SHOWN, result.name
