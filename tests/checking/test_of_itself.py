"""A workbook beside a description that was changed and not built again is stale: no agreement."""

import json

import openpyxl
import pytest

from command_line import run
from mechsheet.description.templates import template_text
from mechsheet.library.building import build
from mechsheet.library.changed import loads

pytestmark = pytest.mark.slow

TEXT = template_text("four-bar").replace("[workbook]\n", '[workbook]\nlayout = "page"\n')
"""On one sheet, which is checked in a third of the time: no judge of values is asked here."""
CHANGED = TEXT.replace("a1 = { value = 70", "a1 = { value = 65")


@pytest.fixture
def folder(tmp_path):
    """A description and its workbook in one folder."""
    (tmp_path / "four-bar.toml").write_text(TEXT, encoding="utf-8")
    build(loads(TEXT, file="four-bar.toml"), tmp_path / "four-bar.xlsx")
    return tmp_path


def test_as_built_it_agrees(folder):
    assert run("check", folder).exit_code == 0


def test_a_changed_length(folder):
    (folder / "four-bar.toml").write_text(CHANGED, encoding="utf-8")
    for asked in ([folder], [folder / "four-bar.toml", folder / "four-bar.xlsx"], [folder / "four-bar.xlsx"]):
        found = run("check", *asked)
        assert found.exit_code == 1
        assert "four-bar.xlsx: STALE, all values agree" in found.output
        assert "dimensions.a1.value = 65, the workbook was built with 70" in found.output
    report = json.loads(run("check", "--json", folder).output)[0]
    assert not report["agrees"]
    assert "a1" in report["stale"]
    run("check", folder, "--junit", folder / "report.xml")
    assert "its description has been changed" in (folder / "report.xml").read_text(encoding="utf-8")


def test_description_and_workbook_in_two_folders(folder, tmp_path):
    (tmp_path / "descriptions").mkdir()
    (tmp_path / "workbooks").mkdir()
    (folder / "four-bar.toml").unlink()
    (folder / "four-bar.xlsx").rename(tmp_path / "workbooks" / "four-bar.xlsx")
    (tmp_path / "descriptions" / "four-bar.toml").write_text(CHANGED, encoding="utf-8")
    assert run("check", tmp_path).exit_code == 1
    # alone it has no description: nobody can know
    assert run("check", tmp_path / "workbooks").exit_code == 0


@pytest.mark.parametrize(
    ("was", "now"),
    [
        ("[workbook]\n", '[workbook]\nlanguage = "tr"\n'),
        ("format = 1\n", "# a comment\nformat = 1\n"),
        ("\n", "\r\n"),
    ],
    ids=["language", "comment", "line ends of Windows"],
)
def test_what_changes_no_number(folder, was, now):
    (folder / "four-bar.toml").write_text(TEXT.replace(was, now), encoding="utf-8", newline="")
    assert run("check", folder).exit_code == 0


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    "options",
    [["--set", "a1=72"], ["--set", "mode_1=-1", "--rows", "13"], ["--step", "5", "--layout", "page"], ["--tolerance"]],
)
def test_what_build_was_told_is_no_change_of_the_file(folder, options):
    """Until the file is changed, whatever the workbook was built with; a file that was pulled from it is another one."""
    file, own = folder / "four-bar.toml", TEXT.replace("value = 56,", "value = 56, tolerance = 0.1,")
    file.write_text(own, encoding="utf-8")
    assert run("build", file, "-o", folder, *options).exit_code == 0
    assert run("check", folder).exit_code == 0
    file.write_text(own.replace("value = 70", "value = 71"), encoding="utf-8")
    assert "STALE" in run("check", folder).output
    file.write_text(run("pull", folder / "four-bar.xlsx").stdout, encoding="utf-8")
    assert run("check", folder).exit_code == 0
    assert run("build", file, "-o", folder).exit_code == 0
    file.write_text(own, encoding="utf-8")
    assert "STALE" in run("check", folder).output


def test_what_is_read_off_the_sketch_is_no_change_of_the_file(tmp_path):
    """A redundant link that nobody has marked is marked in the workbook's description."""
    text = template_text("double-parallelogram")
    assert "redundant = true\n" in text
    (tmp_path / "arms.toml").write_text(text.replace("redundant = true\n", ""), encoding="utf-8")
    assert run("build", tmp_path / "arms.toml", "-o", tmp_path).exit_code == 0
    assert run("check", tmp_path).exit_code == 0


def test_after_pull_it_agrees(folder):
    """What is typed in the workbook and pulled into the description is what both say."""
    path = folder / "four-bar.xlsx"
    book = openpyxl.load_workbook(path)
    (cell,) = (row[1] for row in book.worksheets[0].iter_rows() if row[0].value == "a1")
    cell.value = 65
    book.save(path)
    (folder / "four-bar.toml").write_text(CHANGED, encoding="utf-8")
    assert "STALE" not in run("check", folder).output
    (folder / "four-bar.toml").write_text(TEXT.replace("value = 56,", "value = 57,"), encoding="utf-8")
    found = run("check", folder)
    assert "dimensions.a4.value = 57, the workbook was built with 56" in found.output
