"""What `mechsheet check` prints and writes: a line for each of many files, details where something is wrong, JUnit."""

from pathlib import Path
from xml.etree import ElementTree

import openpyxl
import pytest

import command_line
from mechsheet.checking import check as judged

pytestmark = pytest.mark.slow

GENERATED = Path(__file__).parent.parent.parent / "generated"


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Twins that agree, and a workbook in which a formula was overwritten (its other values kept)."""
    folder = tmp_path_factory.mktemp("reports")
    good = [folder / "scotch-yoke.xlsx", folder / "scotch-yoke.ods"]
    for path in good:
        path.write_bytes((GENERATED / path.name).read_bytes())
    book = openpyxl.load_workbook(good[0])
    book["Positions"]["H9"] = 5
    book.save(folder / "edited.xlsx")
    return [*good, folder / "edited.xlsx"]


def run(*arguments):
    return command_line.run("check", *arguments)


def test_many_files_have_a_line_each_that_fits_a_terminal(files, monkeypatch):
    monkeypatch.chdir(files[0].parent)
    result = run(*(file.name for file in files[:2]))
    assert result.exit_code == 0
    lines = result.output.splitlines()
    assert [line.split(":")[0] for line in lines] == ["scotch-yoke.xlsx", "scotch-yoke.ods"]
    assert all(len(line) <= 80 for line in lines)
    details = run("-v", *(file.name for file in files[:2])).output.splitlines()
    assert len(details) > len(lines) and all(len(line) <= 80 for line in details)


def test_quiet_says_only_what_is_wrong(files):
    assert run("-q", *files[:2]).output == ""
    result = run("-q", *files)
    assert result.exit_code == 1
    assert "Positions!H9" in result.output and "scotch-yoke.ods" not in result.output


def test_junit(files, tmp_path):
    target = tmp_path / "report.xml"
    result = run(*files, tmp_path / "missing.xlsx", "--junit", target)
    assert result.exit_code == 2
    suite = ElementTree.parse(target).getroot().find("testsuite")
    cases = {(case.get("classname"), case.get("name")): case for case in suite}
    assert suite.get("tests") == str(len(cases)) and suite.get("errors") == "1"
    good, edited = str(files[0]), str(files[2])
    assert len(cases[good, "reference"]) == 0
    assert "Positions!H9" in cases[edited, "formulas as built"].find("failure").text
    assert next(case for case in suite if case.find("error") is not None).get("name") == "read"
    again = tmp_path / "again.xml"
    run(*files, tmp_path / "missing.xlsx", "--junit", again)
    assert again.read_bytes() == target.read_bytes()


def test_junit_is_of_checks_only(files, tmp_path):
    assert run(files[0], "--perturb", "1", "--junit", tmp_path / "r.xml").exit_code == 2


def test_a_program_that_cannot_read_the_names_is_not_asked():
    pytest.importorskip("ironcalc")
    report = judged(GENERATED / "fivelink.xlsx", ["ironcalc"])
    assert report.agrees
    assert any("ÇıkışUzvu" in remark for remark in report.remarks)
