"""A workbook that would take for ever is one file's line: `--seconds`, and what happens without it."""

import time
import xml.etree.ElementTree as ElementTree

import openpyxl
import pytest

import command_line
from mechsheet.description.templates import template_text
from mechsheet.homework.classroom.marks import mark
from mechsheet.library.building import build
from mechsheet.library.changed import loads

pytestmark = pytest.mark.slow

ENDLESS = (
    "=_xlfn.LET(_xlpm.fib,_xlfn.LAMBDA(_xlpm.f,_xlpm.n,IF(_xlpm.n<2,_xlpm.n,"
    "_xlpm.f(_xlpm.f,_xlpm.n-1)+_xlpm.f(_xlpm.f,_xlpm.n-2))),_xlpm.fib(_xlpm.fib,60))"
)


def run(*arguments):
    start = time.monotonic()
    found = command_line.run(*arguments)
    assert time.monotonic() - start < 30
    assert "Traceback" not in found.output
    return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A good workbook, and one with an endless formula."""
    place = tmp_path_factory.mktemp("class")
    (path,) = build(loads(template_text("four-bar"), file="four-bar.toml"), place)
    book = openpyxl.load_workbook(path)
    book["Positions"]["Z3"] = ENDLESS
    book.save(place / "endless.xlsx")
    (place / "four-bar.toml").write_text(template_text("four-bar"))
    return place


def test_recalc_gives_up(folder):
    found = run("recalc", folder / "endless.xlsx", "--seconds", "0.5")
    assert found.exit_code == 2
    assert "endless.xlsx: not finished after 0.5 seconds" in found.output
    assert "--seconds gives it more time" in found.output


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("command", [["check"], ["recalc", "--check"]])
def test_the_other_files_are_judged(command, folder):
    report = folder / "report.xml"
    found = run(*command, folder, "--seconds", "3", "--junit", report)
    assert found.exit_code == 2
    assert "endless.xlsx: not finished after 3 seconds" in found.output
    assert "four-bar.xlsx: " in found.output
    cases = {case.get("classname", "").rpartition("/")[2] for case in ElementTree.parse(report).iter("testcase")}
    assert {"endless.xlsx", "four-bar.xlsx"} <= cases


@pytest.mark.ci
def test_a_class_is_marked(folder):
    """The endless workbook has its line, the other one its marks."""
    books = [folder / "endless.xlsx", folder / "four-bar.xlsx"]
    found = run("mark", *books, "--against", folder / "four-bar.toml", "--seconds", "3")
    assert found.exit_code == 0, found.output
    slow, good = found.output.splitlines()[-2:]
    assert "endless" in slow
    assert "not finished after 3 seconds" in slow
    assert "not finished" not in good


def test_audit_gives_up(folder):
    found = run("audit", folder / "endless.xlsx", "--against", folder / "four-bar.toml", "--seconds", "1")
    assert found.exit_code == 2
    assert "not finished after 1 seconds" in found.output


def test_a_fault_of_ours_is_one_line_of_the_class(folder, monkeypatch):
    """Whatever goes wrong with one workbook, the others get their marks."""
    from mechsheet.homework.classroom import marks

    judge = marks.audited

    def failing(work, mechanism, wanted, shown, *others, **more):
        if "endless" in shown:
            raise KeyError("Extremes")
        return judge(work, mechanism, wanted, shown, *others, **more)

    monkeypatch.setattr(marks, "audited", failing)
    found = mark([folder / "endless.xlsx", folder / "four-bar.xlsx"], folder / "four-bar.toml")
    bad, good = found.students
    assert "please report it: KeyError" in bad.why
    assert good.audit is not None
