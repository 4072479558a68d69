"""What a workbook sets about computing is honoured, or said; and no value is written that the setting would not have given.

tests/cases/ods_settings.tsv holds what LibreOffice 7.4 gives for formulas under calculation settings of .ods documents.
"""

import csv
import html
import re
import subprocess
import zipfile
from pathlib import Path

import openpyxl
import pytest

from command_line import run
from formats.ods_files import cell, content, number, row, table, text, write_ods
from livesheet.formats import read
from livesheet.formula.nodes import ErrorValue
from mechsheet.library.recalculation import recalc

TABLE = Path(__file__).parents[1] / "cases" / "ods_settings.tsv"
WORDS = (
    ("A", "apple", "Apple", "pineapple pie", "a.ple", "ap*", "banana"),
    ("pineapple", "apple", "(x", "*a", "A+b", "aab", "a", "apple*"),
)
NUMBERS = (("B", 1, 2, 3, 4, 5, 6), (1, 2, 3, 4, 5, 6, 7, 8))
"""Columns A and B above the formulas; D1:D2 hold criteria for a data base."""

SETTINGS = {
    "empty": "",
    "ci": 'table:case-sensitive="false"',
    "part": 'table:search-criteria-must-apply-to-whole-cell="false"',
    "plain": 'table:use-regular-expressions="false"',
    "wild": 'table:use-regular-expressions="false" table:use-wildcards="true"',
    "wildci": 'table:case-sensitive="false" table:use-regular-expressions="false" table:use-wildcards="true"',
    "wildpart": 'table:case-sensitive="false" table:search-criteria-must-apply-to-whole-cell="false"'
    ' table:use-regular-expressions="false" table:use-wildcards="true"',
    "plainpart": 'table:search-criteria-must-apply-to-whole-cell="false" table:use-regular-expressions="false"',
    "d1904": "",
}
MANIFEST = (
    '<manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0">'
    '<manifest:file-entry manifest:full-path="/" manifest:media-type="application/vnd.oasis.opendocument.spreadsheet"/>'
    '<manifest:file-entry manifest:full-path="content.xml" manifest:media-type="text/xml"/></manifest:manifest>'
)
"""Without it LibreOffice does not open a file."""
NULL_1904 = '<table:null-date table:date-value="1904-01-01"/>'


def settings_of(name):
    inside = NULL_1904 if name == "d1904" else ""
    return f"<table:calculation-settings {SETTINGS[name]}>{inside}</table:calculation-settings>"


def cases(data):
    with TABLE.open(encoding="utf-8") as file:
        return [
            line for line in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE) if line["data"] == str(data)
        ]


def document(data, settings, path):
    """The words, the numbers, and below them the formulas of the table."""
    rows = []
    for place, (word, value) in enumerate(zip(WORDS[data], NUMBERS[data], strict=True)):
        cells = [text(word), text(value) if isinstance(value, str) else number(value)]
        rows.append(row(*cells, *([cell(), text(("A", "apple")[place])] if place < 2 else [])))
    for case in cases(data):
        rows.append(row(cell(f'table:formula="{html.escape("of:=" + case["formula"])}"')))
    write_ods(path, content(settings + table("".join(rows))), {"META-INF/manifest.xml": MANIFEST})
    return path


def shown(value):
    """A value as LibreOffice writes it into a csv."""
    if isinstance(value, ErrorValue | str):
        return str(value)
    return str(value).upper() if isinstance(value, bool) else f"{value:g}" if value < 1e5 else f"{value:.0f}"


@pytest.mark.parametrize("data", [0, 1])
@pytest.mark.parametrize("name", SETTINGS)
def test_formulas_under_settings(data, name, tmp_path):
    result = recalc(document(data, settings_of(name), tmp_path / "set.ods"))
    assert not result.remarks
    first = len(WORDS[data])
    found = {case["formula"]: shown(result.get("S", first + i, 0)) for i, case in enumerate(cases(data))}
    assert found == {case["formula"]: case[name] for case in cases(data)}


@pytest.mark.libreoffice
@pytest.mark.slow
@pytest.mark.parametrize("data", [0, 1])
def test_the_table_is_what_libreoffice_gives(data, tmp_path):
    for name in SETTINGS:
        document(data, settings_of(name), tmp_path / f"{name}.ods")
    to_csv = "csv:Text - txt - csv (StarCalc):44,34,76,1,,0,false,false,false"
    files = [str(tmp_path / f"{name}.ods") for name in SETTINGS]
    command = ["soffice", f"-env:UserInstallation={(tmp_path / 'profile').as_uri()}", "--headless"]
    subprocess.run([*command, "--convert-to", to_csv, "--outdir", str(tmp_path), *files], check=True, timeout=300)
    for name in SETTINGS:
        with (tmp_path / f"{name}.csv").open(encoding="utf-8") as file:
            given = [line[0] for line in csv.reader(file)][len(WORDS[data]) :]
        assert given == [case[name] for case in cases(data)], name


def test_a_document_that_says_nothing_is_case_sensitive(tmp_path):
    """As OpenDocument has it, and LibreOffice computes it."""
    path = tmp_path / "silent.ods"
    write_ods(path, content(table(row(cell('table:formula="of:=&quot;A&quot;=&quot;a&quot;"')))))
    assert recalc(path).get("S", 0, 0) is False


def test_no_regular_expression(tmp_path):
    """What no expression can be made of is not guessed: the stored value is kept, with a remark."""
    path = tmp_path / "odd.ods"
    formula = number(7, html.escape('COUNTIF([.A1:.A1];"*a")'))
    write_ods(path, content(table(row(text("*a"), formula))))
    result = recalc(path)
    assert result.get("S", 0, 1) == 7.0
    assert "is no regular expression" in result.remarks[0].message


# --- what is not honoured: said, and nothing wrong is written ---------------------------------------------------------


def patched(path, part, old, new):
    """The file with a change in one part."""
    with zipfile.ZipFile(path) as old_file:
        parts = {name: old_file.read(name) for name in old_file.namelist()}
    changed = re.sub(old, new, parts[part].decode(), count=1)
    assert changed != parts[part].decode()
    parts[part] = changed.encode()
    with zipfile.ZipFile(path, "w") as new_file:
        for name, content in parts.items():
            new_file.writestr(name, content)
    return path


def xlsx(path, calc="", dates=False, cells=(), values=()):
    """A workbook with formulas and their stored values."""
    book = openpyxl.Workbook()
    book.active.title = "S"
    for name, value in cells:
        book.active[name] = value
    if dates:
        from openpyxl.utils.datetime import CALENDAR_MAC_1904

        book.epoch = CALENDAR_MAC_1904
    book.save(path)
    for name, value in values:
        patched(path, "xl/worksheets/sheet1.xml", rf'(<c r="{name}".*?</f>)<v\s*/?>(</v>)?', rf"\g<1><v>{value}</v>")
    if calc:
        patched(path, "xl/workbook.xml", r"<calcPr ", f"<calcPr {calc} ")
    return path


def as_shown(folder, suffix):
    if suffix == ".xlsx":
        return xlsx(folder / "shown.xlsx", 'fullPrecision="0"', cells=[("A1", "=1/3"), ("A2", "=A1*3")],
                    values=[("A1", 0.33), ("A2", 0.99)])  # fmt: skip
    path = folder / "shown.ods"
    rows = row(number(0.33, "1/3")) + row(number(0.99, "[.A1]*3"))
    write_ods(path, content('<table:calculation-settings table:precision-as-shown="true"/>' + table(rows)))
    return path


@pytest.mark.parametrize("suffix", [".xlsx", ".ods"])
def test_precision_as_shown(suffix, tmp_path):
    """Every stored value is kept, and that is said: 0.333 in place of 0.33 would be wrong."""
    path = as_shown(tmp_path, suffix)
    result = recalc(path)
    assert [result.get("S", place, 0) for place in (0, 1)] == [0.33, 0.99]
    assert "rounded as it is shown" in str(result.remarks[0])
    again = tmp_path / f"again{suffix}"
    found = run("recalc", path, "-o", again)
    assert found.exit_code == 0
    assert "rounded as it is shown" in found.output
    cached = read(again).sheets[0].cached
    assert [cached.get(place, 0) for place in (0, 1)] == [0.33, 0.99]
    assert run("recalc", "--check", "--strict", path).exit_code == 1


@pytest.mark.parametrize("suffix", [".xlsx", ".ods"])
def test_iterations(suffix, tmp_path):
    """A circle that the workbook computes again and again keeps its values; what reads it is computed from them."""
    path = tmp_path / f"circle{suffix}"
    if suffix == ".xlsx":
        cells = [("A1", "=B1/2+1"), ("B1", "=A1"), ("C1", "=A1+1")]
        xlsx(path, 'iterate="1"', cells=cells, values=[("A1", 2), ("B1", 2), ("C1", 3)])
    else:
        iteration = '<table:iteration table:status="enable" table:steps="50"/>'
        rows = row(number(2, "[.B1]/2+1"), number(2, "[.A1]"), number(3, "[.A1]+1"))
        write_ods(path, content(f"<table:calculation-settings>{iteration}</table:calculation-settings>{table(rows)}"))
    result = recalc(path)
    assert [result.get("S", 0, place) for place in (0, 1, 2)] == [2.0, 2.0, 3.0]
    assert any("not computed again and again here" in fault.message for fault in result.remarks)
    judged = result.compare_with_stored()
    assert (judged.kept, judged.equal) == (2, 1)


def test_a_circle_without_iterations_is_an_error(tmp_path):
    path = xlsx(tmp_path / "circle.xlsx", cells=[("A1", "=B1"), ("B1", "=A1")], values=[("A1", 2), ("B1", 2)])
    assert recalc(path).get("S", 0, 0) == ErrorValue("#REF!")


DATES_1904 = [
    ('="1/1/2020"+0', 42369.0),
    ('=VALUE("1/1/2020")', 42369.0),
    ('=DATEVALUE("1/1/2020")', 42369.0),
    ("=DATE(2020,1,1)", 42369.0),
    ('=YEAR("1/1/2020")', 2020.0),
    ('=TEXT("1/1/2020","yyyy-mm-dd")', "2020-01-01"),
    ('=COUNTIF(A1:A3,">1/1/2020")', 2.0),
    ('=COUNTIF(A1:A3,"1/1/2020")', 1.0),
    ('=SUM("1/1/2020",1)', 42370.0),
    ('=MAX(0,"1/1/2020")', 42369.0),
    ('="1/1/1903"+0', ErrorValue("#VALUE!")),
    ('="6:00 AM"+0', 0.25),
    ('=DAYS("1/3/2020","1/1/2020")', 2.0),
    ('="1/1/2020"-A1', 0.0),
    ('=EDATE("1/1/2020",1)', 42400.0),
    ("=WORKDAY(A1,1,A2)", 42371.0),
    ("=NETWORKDAYS(A1,A3,A2)", 2.0),
    ('=ROUND("1/1/2020",0)', 42369.0),
    ('=INT("1/1/2020 12:00")', 42369.0),
]


@pytest.mark.parametrize(("formula", "value"), DATES_1904, ids=[case[0] for case in DATES_1904])
def test_texts_as_dates_in_the_calendar_of_1904(formula, value, tmp_path):
    """A text that shows a date is the number that this workbook counts: A1 holds 1 January 2020 as 42369."""
    cells = [("A1", 42369), ("A2", 42370), ("A3", 42371), ("B1", formula)]
    assert recalc(xlsx(tmp_path / "mac.xlsx", dates=True, cells=cells)).get("S", 0, 1) == value


@pytest.mark.parametrize(("formula", "value"), DATES_1904, ids=[case[0] for case in DATES_1904])
def test_the_same_row_by_row(formula, value, tmp_path):
    """Formulas filled down far enough that code is made for them."""
    above = [("A1", 42369), ("A2", 42370), ("A3", 42371)]
    fixed = re.sub(r"\b(A)([123])\b", r"$\1$\2", formula)
    cells = [*above, *((f"B{place}", fixed) for place in range(1, 200))]
    result = recalc(xlsx(tmp_path / "mac.xlsx", dates=True, cells=cells))
    assert {result.get("S", place, 1) for place in range(199)} == {value}


def test_two_digit_years_from_another_year(tmp_path):
    path = tmp_path / "years.ods"
    settings = '<table:calculation-settings table:null-year="1950"/>'
    write_ods(path, content(settings + table(row(number(1, "DATEVALUE(&quot;1/2/29&quot;)")))))
    assert any("years of two digits" in fault.message for fault in recalc(path).remarks)
