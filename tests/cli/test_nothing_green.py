"""`check` is never green for nothing: what was not compared, not computed, or is red by itself, is said."""

import json
import re
import xml.etree.ElementTree as ElementTree

import openpyxl
import pytest

from command_line import run
from mechsheet.description import Overrides
from mechsheet.description.templates import template_text
from mechsheet.library.building import build
from mechsheet.library.changed import loads

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A four-bar's workbook."""
    (path,) = build(loads(template_text("four-bar"), file="four-bar.toml"), tmp_path_factory.mktemp("built"))
    return path


def resaved(path, into, change=lambda book: None):
    """As openpyxl saves it: without any stored value; with a change."""
    book = openpyxl.load_workbook(path)
    change(book)
    book.save(into)
    return into


def plain(into, formula):
    """Somebody else's workbook with one formula that has a stored value, and one that has none."""
    book = openpyxl.Workbook()
    book.active["A1"] = formula
    book.save(into)
    return into


def test_a_workbook_without_stored_values(built, tmp_path):
    path = resaved(built, tmp_path / "bare.xlsx")
    found = run("check", path)
    assert found.exit_code == 0
    assert "all agree" not in found.output
    assert "all compared agree; no value is stored" in found.output
    assert "stored values  nothing was compared" in found.output
    assert "no value is stored" in run("check", "-q", path).output
    assert run("check", "--strict", path).exit_code == 1
    assert json.loads(run("check", "--json", path).output)[0]["unjudged"] == ["no value is stored"]


def test_nothing_at_all_was_compared(tmp_path):
    path = plain(tmp_path / "other.xlsx", "=1+1")
    assert "NOTHING WAS COMPARED" in run("check", path).output
    assert run("check", "--strict", path).exit_code == 1


def test_a_red_line_is_no_agreement(built, tmp_path):
    def hostile(book):
        del book[book.sheetnames[-1]]  # the hidden sheet with the description
        sheet = book["Positions"]
        sheet["F10"] = "=1+2"

    path = resaved(built, tmp_path / "open.xlsx", hostile)
    found = run("check", path)
    assert found.exit_code == 1
    assert "BUT IT SAYS ITSELF THAT SOMETHING IS WRONG" in found.output
    assert "the line under its title says: " in found.output


@pytest.mark.cases(3)
@pytest.mark.parametrize("language", ["en", "tr"])
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_a_mechanism_that_closes_nowhere(language, layout, tmp_path):
    """A ground link of 1000 is typed: nothing can be joined; all judges agree, and the line is red."""
    text = re.sub(r"(?m)^layout = .*\n", "", template_text("four-bar")).replace(
        "[workbook]\n", f'[workbook]\nlayout = "{layout}"\n', 1
    )
    assert "[workbook]" in text
    (path,) = build(loads(text, "four-bar.toml", Overrides(language=language)), tmp_path)
    assert run("check", path).exit_code == 0

    def longer(book):
        sheet = book[book.sheetnames[0]]
        cell = next(row[1] for row in sheet.iter_rows() if row[1].value == 70)
        cell.value = 1000

    found = run("check", resaved(path, tmp_path / "longer.xlsx", longer))
    assert found.exit_code == 1, found.output
    assert "agree, BUT" in found.output or "uyuşuyor, AMA" in found.output


@pytest.mark.parametrize("language", ["en", "tr"])
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_a_task_that_the_mechanism_misses(language, layout, tmp_path):
    """From some ratio of the lengths on the dead centres lie on different assemblies: lengths, but a shorter stroke."""
    text = (
        template_text("quick-return-slider").replace("lam = 3\n", "lam = 300\n", 1)
        + f'[workbook]\nlayout = "{layout}"\n'
    )
    assert "lam = 300" in text
    (path,) = build(loads(text, "quick-return-slider.toml", Overrides(language=language)), tmp_path)
    found = run("check", path)
    assert found.exit_code == 1, found.output
    assert re.search("agree, BUT|uyuşuyor, AMA", found.output)
    assert re.search("says: (misses|istenen)", found.output)


def test_our_workbook_without_its_description(built, tmp_path):
    path = resaved(built, tmp_path / "nameless.xlsx", lambda book: book.remove(book[book.sheetnames[-1]]))
    assert run("check", path).exit_code == 0
    found = run("check", "--strict", path)
    assert found.exit_code == 1
    assert json.loads(run("check", "--json", path).output)[0]["unjudged"][-1] == "it carries no description"


@pytest.mark.cases(2)
@pytest.mark.parametrize("sheet", ["Extremes", "Checks", "Drawing", "Positions"])
def test_one_files_trouble_is_one_files_line(sheet, built, tmp_path):
    folder = tmp_path / "books"
    folder.mkdir()
    resaved(built, folder / "damaged.xlsx", lambda book: book.remove(book[sheet]))
    (folder / "good.xlsx").write_bytes(built.read_bytes())
    report = tmp_path / "report.xml"
    found = run("check", folder, "--junit", report)
    assert "Traceback" not in found.output
    assert "good.xlsx: all agree" in found.output
    alone = run("check", folder / "damaged.xlsx")
    assert f'the sheet "{sheet}" is missing' in alone.output
    if sheet == "Positions":  # the others may be deleted
        assert found.exit_code in (1, 2)
    assert "damaged.xlsx" in found.output
    cases = ElementTree.parse(report).iter("testcase")
    assert {"good.xlsx", "damaged.xlsx"} <= {case.get("classname", "").rpartition("/")[2] for case in cases}
