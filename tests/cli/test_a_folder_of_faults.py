"""`check` of a folder of nearly forty workbooks, each damaged, stale, stripped or foreign in its way, among three good ones.

Every file has its line, no damaged one agrees, the good ones do, and the JUnit file names them all.
"""

import re
import xml.etree.ElementTree as ElementTree
from functools import partial

import openpyxl
import pytest

from command_line import run
from mechsheet.description import Overrides
from mechsheet.description.templates import template_text
from mechsheet.library.building import build
from mechsheet.library.changed import loads

BASES = {"rocker": ("four-bar", "sheets"), "page": ("four-bar", "page"), "slider": ("slider-crank", "sheets")}


def formulas(sheet):
    return [cell for row in sheet.iter_rows() for cell in row if str(cell.value).startswith("=")]


def type_over(book, text, sheet=0, which=-1):
    formulas(book.worksheets[sheet])[which].value = text


def change_a_sine(book):
    """In the table, where every workbook has one."""
    sheet = book["Positions"] if "Positions" in book.sheetnames else book.worksheets[0]
    cell = next(cell for cell in formulas(sheet) if "SIN(" in cell.value)
    cell.value = cell.value.replace("SIN(", "COS(", 1)


def input_cell(book):
    """The crank's length."""
    return next(
        row[1] for row in book.worksheets[0].iter_rows(max_col=2) if row[1].value in (35, 40, 100, 30) and row[0].value
    )


def set_input(book, value):
    input_cell(book).value = value


def remove(book, sheet):
    book.remove(book[sheet])


def rename(book, sheet):
    book[sheet].title = "Another"


CHANGES = {
    "stripped": lambda book: None,
    "number-over-formula": partial(type_over, text=123.456),
    "text-over-formula": partial(type_over, text="none"),
    "unknown-function": partial(type_over, text="=NOSUCHFUNCTION(1)"),
    "circle": lambda book: type_over(book, f"={formulas(book.worksheets[0])[-1].coordinate}+1"),
    "cosine-for-sine": change_a_sine,
    "negative-crank": partial(set_input, value=-35),
    "text-for-crank": partial(set_input, value="long"),
    "no-crank": partial(set_input, value=None),
    "huge-crank": partial(set_input, value=1e9),
}
OF_SHEETS = {
    **{
        f"without-{name.lower()}": partial(remove, sheet=name)
        for name in ("Positions", "Extremes", "Checks", "Drawing")
    },
    "renamed-positions": partial(rename, sheet="Positions"),
}

DAMAGES = {"rocker": CHANGES | OF_SHEETS, "page": CHANGES, "slider": {"circle": CHANGES["circle"]} | OF_SHEETS}
"""Once in each layout, and once more what depends on the sheets that a mechanism has."""


def raw(name):
    return {"empty": b"", "text": b"a, b, c\n1, 2, 3\n", "zip": b"PK\x05\x06" + bytes(18)}[name]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder, and the names of what is wrong in it."""
    folder, wrong = tmp_path_factory.mktemp("books"), []
    for base, (template, layout) in BASES.items():
        mechanism = loads(template_text(template), f"{base}.toml", Overrides(layout=layout))
        (path,) = build(mechanism, folder / f"{base}.xlsx")
        for name, change in DAMAGES[base].items():
            book = openpyxl.load_workbook(path)
            change(book)
            book.save(folder / f"{base}-{name}.xlsx")
            wrong.append(f"{base}-{name}.xlsx")
        (folder / f"{base}-half.xlsx").write_bytes(path.read_bytes()[:20_000])
        wrong.append(f"{base}-half.xlsx")
    for name in ("empty", "text", "zip"):
        (folder / f"{name}.xlsx").write_bytes(raw(name))
        wrong.append(f"{name}.xlsx")
    foreign = openpyxl.Workbook()
    foreign.active["A1"] = "=1+1"
    foreign.save(folder / "foreign.xlsx")
    stale = template_text("slider-crank")
    build(loads(stale, file="stale.toml"), folder / "stale.xlsx")
    (folder / "stale.toml").write_text(re.sub(r"\n(a2 = \{ value = )", r"\n\g<1>1", stale, count=1), encoding="utf-8")
    return folder, [*wrong, "foreign.xlsx", "stale.xlsx"]


@pytest.mark.ci
def test_each_is_named_rightly(folder, tmp_path):
    path, wrong = folder
    assert len(wrong) >= 35
    report = tmp_path / "report.xml"
    found = run("check", "--strict", path, "--junit", report)
    assert found.exit_code in (1, 2)
    assert "Traceback" not in found.output and "mistake of mechsheet" not in found.output
    lines = found.output.splitlines()
    for name in wrong:
        own = [line for line in lines if f"/{name}" in line or line.startswith(name)]
        assert own, name
        assert not any(": all agree" in line for line in own), own
    for base in BASES:
        assert any(f"/{base}.xlsx: all agree" in line for line in lines), base
    cases = list(ElementTree.parse(report).iter("testcase"))
    named = {case.get("classname", "").rpartition("/")[2] for case in cases}
    assert {*wrong, *(f"{base}.xlsx" for base in BASES)} <= named
    failed = {
        case.get("classname", "").rpartition("/")[2]
        for case in cases
        if case.find("failure") is not None or case.find("error") is not None
    }
    assert failed >= set(wrong), sorted(set(wrong) - failed)
