"""`check` and `recalc --check` as gates: the same verdict, options, exit codes and reports, on .xlsx and .ods."""

import importlib.util
import json
from xml.etree import ElementTree
from xml.sax.saxutils import escape

import openpyxl
import pytest
import xlsxwriter

import mechsheet
from command_line import run
from livesheet.diagnostics import WorkbookError
from mechsheet.checking import Rules, check
from mechsheet.checking.cells_apart import difference
from mechsheet.diagnostics import MissingProgramError

URN = "urn:oasis:names:tc:opendocument:xmlns"
ODS = f"""<?xml version="1.0" encoding="UTF-8"?>
<office:document-content xmlns:office="{URN}:office:1.0" xmlns:table="{URN}:table:1.0" xmlns:text="{URN}:text:1.0"
 xmlns:of="{URN}:of:1.2" office:version="1.3"><office:body><office:spreadsheet>{{}}</office:spreadsheet></office:body>
</office:document-content>"""


def cell_xml(formula, value):
    """A cell of an .ods; without a value when it is None."""
    start = f'<table:table-cell table:formula="of:={formula}"' if formula else "<table:table-cell"
    if value is None:
        return start + "/>"
    if isinstance(value, str):
        return f'{start} office:value-type="string"><text:p>{value}</text:p></table:table-cell>'
    return f'{start} office:value-type="float" office:value="{value}"/>'


def write_ods(path, sheets, program="LibreOffice/7.4", extra=()):
    """An .ods of sheets {title: rows of (formula, value)}, as `program` might have saved it."""
    import zipfile

    tables = "".join(
        f'<table:table table:name="{title}">'
        + "".join("<table:table-row>" + "".join(cell_xml(*cell) for cell in row) + "</table:table-row>" for row in rows)
        + "</table:table>"
        for title, rows in sheets.items()
    )
    meta = f"<meta><meta:generator xmlns:meta='urn:x'>{program}</meta:generator></meta>"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("content.xml", ODS.format(tables))
        archive.writestr("meta.xml", meta)
        for part in extra:
            archive.writestr(part, "Function Area(x) ...")
    return path


def write_xlsx(path, sheets, macros=False):
    """The same as an .xlsx; formulas as OpenFormula spells them."""
    with xlsxwriter.Workbook(path) as workbook:
        for title, rows in sheets.items():
            sheet = workbook.add_worksheet(title)
            for row, cells in enumerate(rows):
                for col, (formula, value) in enumerate(cells):
                    if formula:
                        text = formula.replace("[.", "").replace("]", "").replace(";", ",")
                        sheet.write_formula(row, col, "=" + text, value=value)
                    else:
                        sheet.write(row, col, value)
        if macros:
            blob = path.with_name("vbaProject.bin")
            blob.write_bytes(b"\xd0\xcf\x11\xe0 not looked into")
            workbook.add_vba_project(str(blob))
    return path


def written(folder, suffix, sheets, name="book"):
    path = folder / f"{name}{suffix}"
    return write_ods(path, sheets) if suffix == ".ods" else write_xlsx(path, sheets)


BOTH = pytest.mark.parametrize("suffix", [".xlsx", ".ods"])

GOOD = {"A": [[(None, 2.0), ("[.A1]*2", 4.0)]], "B": [[("1+1", 2.0)]]}
STALE = {"A": [[(None, 2.0), ("[.A1]*2", 5.0), ("[.B1]+1", 6.0)]], "B": [[("1+1", 2.0), ("10^6", 1000001.0)]]}


def both(*arguments):
    """Exit codes of the two commands, which must be one."""
    codes = {run("check", *arguments).exit_code, run("recalc", "--check", *arguments).exit_code}
    assert len(codes) == 1, codes
    return codes.pop()


@BOTH
def test_both_commands_agree(tmp_path, suffix):
    good = written(tmp_path, suffix, GOOD)
    stale = written(tmp_path, suffix, STALE, "stale")
    assert both(good) == 0
    assert both(stale) == both(good, stale) == 1
    assert both(good, tmp_path / "missing.xlsx") == 2
    [one] = json.loads(run("check", stale, "--json").stdout)
    [other] = json.loads(run("recalc", "--check", stale, "--json").stdout)
    assert one["stored"] == {key: value for key, value in other.items() if key != "file"}
    assert [(item["cell"], item["follows"]) for item in other["differences"]] == [
        ("A!B1", False), ("A!C1", True), ("B!B1", False)
    ]  # fmt: skip


@BOTH
def test_tolerances_and_ranges_that_are_ignored(tmp_path, suffix):
    stale = written(tmp_path, suffix, STALE)
    assert both(stale, "--relative", "1e-5") == 1
    assert both(stale, "--relative", "0.3") == both(stale, "--absolute", "1") == 0
    assert both(stale, "--ignore", "A", "--ignore", "B!B1:C9") == 0
    assert both(stale, "--ignore", "A!B1", "--ignore", "B!B:B") == 0
    assert both(stale, "--ignore", "A!B1") == 1
    assert (
        both(stale, "--ignore", "Nowhere") == both(stale, "--relative", "-1") == both(stale, "--relative", "nan") == 2
    )
    other = written(tmp_path, suffix, {"Other": [[("1+1", 3.0)]]}, "other")
    assert both(stale, other, "--ignore", "Other", "--relative", "0.3") == 0  # a sheet of one of the files


@BOTH
def test_differences_that_are_accepted(tmp_path, suffix, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "books").mkdir()
    stale = written(tmp_path / "books", suffix, STALE)
    assert both("books", "--baseline", "accepted.txt") == 2  # there is none yet
    assert run("check", "books", "--baseline", "accepted.txt", "--update-baseline").exit_code == 0
    text = (tmp_path / "accepted.txt").read_text()
    assert text.splitlines()[1:] == [
        f"books/book{suffix}\tA!B1\tcomputed 4\tstored 5",
        f"books/book{suffix}\tB!B1\tcomputed 1000000\tstored 1000001",
    ]
    assert both("books", "--baseline", "accepted.txt") == 0
    assert run("recalc", "--check", "books", "--baseline", "accepted.txt", "--update-baseline").exit_code == 0
    assert (tmp_path / "accepted.txt").read_text() == text
    stale.unlink()
    worse = {**STALE, "A": [[(None, 2.0), ("[.A1]*2", 4.0), ("[.B1]+1", 7.0)]]}
    written(tmp_path / "books", suffix, worse)  # one is right now, another one differs
    result = run("check", "books", "--baseline", "accepted.txt")
    assert result.exit_code == 1
    assert f"books/book{suffix} A!B1 is no longer needed" in result.stderr
    assert "B!B1" not in result.stderr
    (tmp_path / "accepted.txt").write_text("nonsense")
    result = run("check", "books", "--baseline", "accepted.txt")
    assert result.exit_code == 2 and "accepted.txt:1" in result.stderr
    assert both("books", "--update-baseline") == 2


@BOTH
def test_an_accepted_difference_is_that_one_and_no_other(tmp_path, suffix):
    accepted = tmp_path / "accepted.txt"
    book = written(tmp_path, suffix, STALE)
    run("check", book, "--baseline", accepted, "--update-baseline")
    book.unlink()
    written(tmp_path, suffix, {**STALE, "A": [[(None, 2.0), ("[.A1]*2", 5.5), ("[.B1]+1", 6.5)]]})
    assert both(book, "--baseline", accepted) == 1


@BOTH
def test_folders_and_files_that_mark_an_open_workbook(tmp_path, suffix):
    (tmp_path / "deep" / "er").mkdir(parents=True)
    (tmp_path / ".hidden").mkdir()
    written(tmp_path / "deep" / "er", suffix, STALE, "stale")
    written(tmp_path / ".hidden", suffix, STALE)
    written(tmp_path, suffix, GOOD)
    for lock in ("~$book.xlsx", ".~lock.book.ods#"):
        (tmp_path / lock).write_bytes(b"who has it open")
    assert both(tmp_path) == 1
    found = json.loads(run("check", tmp_path, tmp_path / "~$book.xlsx", "--json").stdout)
    assert [report["file"].rpartition("/")[2] for report in found] == [f"book{suffix}", f"stale{suffix}"]
    (tmp_path / "empty").mkdir()
    assert both(tmp_path / "empty") == 2
    assert both(tmp_path / "~$book.xlsx") == 0


@pytest.mark.parametrize("suffix", [".xlsx", ".ods"])
@pytest.mark.parametrize("name", ["TODAY", "NOW", "RAND"])
def test_what_changes_by_itself_is_left_out_and_said(tmp_path, suffix, name):
    sheets = {"S": [[(f"{name}()", 0.25), ("[.A1]+1", 1.25), (None, 2.0), ("[.C1]*2", 4.0)]]}
    book = written(tmp_path, suffix, sheets)
    assert both(book) == both(book, "--strict") == 0
    for command in (["check"], ["recalc", "--check"]):
        result = run(*command, book)
        assert f"S!A1: {name} gives another value at every recalculation" in result.output
        assert "left out" in result.output
    sheets["S"][0][3] = ("[.C1]*2", 5.0)
    book.unlink()
    assert both(written(tmp_path, suffix, sheets)) == 1  # the rest is judged all the same


@BOTH
def test_strict_wants_something_to_compare_with(tmp_path, suffix):
    path = tmp_path / f"book{suffix}"
    if suffix == ".xlsx":
        workbook = openpyxl.Workbook()
        workbook.active.append([1, "=A1+1"])
        workbook.save(path)
    else:
        write_ods(path, {"S": [[(None, 1.0), ("[.A1]+1", None)]]})
    assert both(path) == 0
    assert both(path, "--strict") == 1
    assert both(written(tmp_path, suffix, GOOD, "good"), "--strict") == 0


@BOTH
def test_a_judge_that_is_missing_does_not_hide_the_others(tmp_path, suffix, monkeypatch):
    def absent(path):
        raise MissingProgramError("LibreOffice Calc is not installed")

    from mechsheet.checking import programs

    monkeypatch.setitem(programs.PROGRAMS, "libreoffice", absent)
    stale = written(tmp_path, suffix, STALE)
    report = tmp_path / "report.xml"
    result = run("check", stale, "--with", "libreoffice", "--junit", report)
    assert result.exit_code == 2
    assert "A!B1" in result.stdout and "LibreOffice Calc is not installed: skipped" in result.stdout
    cases = {case.get("name"): case for case in ElementTree.parse(report).getroot().iter("testcase")}
    assert cases["LibreOffice Calc is not installed"].find("skipped") is not None
    assert cases["sheet A"].find("failure") is not None


def test_programs_are_named_by_one_text_or_several(tmp_path):
    book = write_xlsx(tmp_path / "book.xlsx", GOOD)
    with pytest.raises(MissingProgramError, match='did you mean "libreoffice"') as problem:
        mechsheet.check(book, programs="libreofice")
    assert "--with" not in str(problem.value)
    with pytest.raises(MissingProgramError):
        mechsheet.check(book, programs=[None])
    assert [item.judge for item in check(book, "formulas").comparisons] == ["stored values", "formulas"]
    with pytest.raises(WorkbookError, match="Nowhere"):
        check(book, rules=Rules(ignore=("Nowhere!A1",)))


@BOTH
def test_junit_has_a_case_for_each_sheet_and_each_unknown_function(tmp_path, suffix):
    sheets = {
        "A": [[(None, 2.0), ("FOO([.A1])", 7.0), ("FOO([.A1]+1)", 8.0), ("[.B1]+1", 8.0)]],
        "B": [[("FOO(1)", 3.0), ("1+1", 9.0)]],
    }
    book = written(tmp_path, suffix, sheets)
    reports = []
    for command in (["check"], ["recalc", "--check"]):
        path = tmp_path / "report.xml"
        assert run(*command, book, "--junit", path).exit_code == 1
        cases = {case.get("name"): case for case in ElementTree.parse(path).getroot().iter("testcase")}
        assert len(cases["sheet A"]) == 0
        assert "B!B1 =1+1: computed 2, stored 9" in cases["sheet B"].find("failure").text
        assert [name for name in cases if "FOO" in name] == ["unknown function FOO: stored values are kept"]
        assert cases["unknown function FOO: stored values are kept"].find("skipped") is not None
        reports.append(set(cases))
        run(*command, book, "--junit", path, "--strict")
        suite = ElementTree.parse(path).getroot().find("testsuite")
        assert suite.get("failures") == "2"
    assert reports[0] - reports[1] <= {"formulas as built"}


@BOTH
def test_functions_that_are_not_known_keep_their_values(tmp_path, suffix):
    sheets = {"S": [[(None, 2.0), ("AREA([.A1])", 12.5), ("AREA([.A1]+1)", 13.5), ("[.B1]*2", 0.0)]]}
    path = tmp_path / ("book.xlsm" if suffix == ".xlsx" else "book.ods")
    if suffix == ".xlsx":
        write_xlsx(path, sheets, macros=True)
    else:
        write_ods(path, sheets, extra=("Basic/Standard/Module1.xml",))
    new = tmp_path / f"new{path.suffix}"
    result = run("recalc", path, "-o", new, "--set", "S!A1=3")
    notes = [line for line in result.stderr.splitlines() if line.startswith("note")]
    language = "VBA" if suffix == ".xlsx" else "Basic"
    assert notes[0] == f"note: S!B1, S!C1: AREA is defined in this file's {language}: stored values are kept"
    assert len(notes) == 2 and "do not follow what was set" in notes[1]
    values = mechsheet.recalc(new)
    assert [values.book.sheets[0].cached.get(0, col) for col in (1, 2, 3)] == [12.5, 13.5, 25.0]
    assert run("recalc", new, "--check").exit_code == run("check", new).exit_code == 0


@BOTH
def test_a_text_with_a_decimal_comma_is_the_same_text(tmp_path, suffix):
    shown = [('[.A1]&"°"', "33,9°"), ('"t = "&[.A1]&" s"', "t = 33,9 s"), ('[.A1]&"x"', "33;9x")]
    formulas = [(escape(text, {'"': "&quot;"}) if suffix == ".ods" else text, value) for text, value in shown]
    good = written(tmp_path, suffix, {"S": [[(None, 33.9), *formulas[:2]]]}, "good")
    assert both(good) == 0
    assert both(written(tmp_path, suffix, {"S": [[(None, 33.9), *formulas]]}, "bad")) == 1


@pytest.mark.parametrize(
    ("ours", "theirs", "same"),
    [
        ("33.9°", "33,9°", True),
        ("1,234.5", "1.234,5", True),
        ("a,b", "a.b", False),
        ("33.9", "33.8", False),
        ("33,9", "33,8", False),
        ("1, 2", "1. 2", False),
        ("0.30000000000000004", "0,3", True),
    ],
)
def test_texts_of_other_programs_with_either_decimal_sign(ours, theirs, same):
    assert (difference(ours, theirs) < 1e-9) is same


def test_json_is_ascii(tmp_path):
    book = write_xlsx(tmp_path / "book.xlsx", {"Açı": [[("1+1", "dört")]]})
    for arguments in (["check", book], ["recalc", "--check", book], ["recalc", book]):
        assert run(*arguments, "--json").stdout.isascii()


def test_options_of_the_gate_go_with_check_only(tmp_path):
    book = write_xlsx(tmp_path / "book.xlsx", GOOD)
    assert "--relative: only with --check" in run("recalc", book, "--relative", "1").stderr
    assert run("recalc", book, book).exit_code == 2
    assert run("recalc", book, "--check", "-o", tmp_path / "x.xlsx").exit_code == 2
    assert run("check", book, "--mutate", "1", "--baseline", "x").exit_code == 2


@pytest.mark.slow
@pytest.mark.skipif(
    importlib.util.find_spec("docbuilder") is None, reason="document-builder is not installed (100 MB, AGPL)"
)
def test_onlyoffice_computes_for_itself(tmp_path):
    stale = write_xlsx(tmp_path / "book.xlsx", STALE)
    found = check(stale, "onlyoffice").comparisons
    assert [(item.judge, item.agrees) for item in found] == [("stored values", False), ("onlyoffice", True)]


def test_onlyoffice_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    result = run("check", write_xlsx(tmp_path / "book.xlsx", GOOD), "--with", "onlyoffice")
    assert result.exit_code == 2
    assert "mechsheet[onlyoffice]" in result.stderr and "all agree" in result.stdout
