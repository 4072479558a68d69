"""A lecturer's week: an exercise for a class, their workbooks back, marks, an appeal."""

from __future__ import annotations

import csv
import io
import json

import openpyxl
import pytest

import mechsheet
from command_line import printed
from homework.handmade import STEPS, Table, four_bar
from mechsheet.description import loads
from mechsheet.homework.classroom.exercise import fulfils, safe
from mechsheet.homework.classroom.marks import lines_of
from mechsheet.homework.classroom.marks_book import page

EXERCISE = """
[exercise]
asked = { theta13 = 2, theta14 = 1, mu_min = 1 }
vary = { a2 = [30, 38, 0.5], a3 = [60, 66, 0.5] }
need = "all rows and mu_min > 28"
"""


@pytest.fixture(scope="module")
def week(tmp_path_factory):
    folder = tmp_path_factory.mktemp("week")
    text = mechsheet.template("four-bar").text.replace("[workbook]", '[workbook]\nlayout = "page"')
    (folder / "four-bar.toml").write_text(text + EXERCISE, encoding="utf-8")
    (folder / "class.csv").write_text("id;name\n101;Ayşe\n102;<b>Bora</b>\n103;=1+1\n", encoding="utf-8")
    printed("exercise", folder / "four-bar.toml", folder / "class.csv", "-o", folder / "week")
    return folder


def key_of(week):
    return json.loads((week / "week" / "key.json").read_text(encoding="utf-8"))


def filled(week, number, path, **slips):
    """A student's own table with own dimensions."""
    own = key_of(week)["students"][number]["dimensions"]
    given = [(name, name, own[name]) for name in ("a1", "a2", "a3", "a4")]
    table = Table(given, four_bar(**slips))
    table.cells = {"A40": "mu_min", "B40": "=MIN(L9:L33)"}
    return table.save(path)


@pytest.mark.slow
def test_a_students_sheet_holds_the_task_and_no_answer(week):
    book = openpyxl.load_workbook(week / "week" / "student" / "101.xlsx")
    sheet, _ = book.worksheets
    cells = [cell.value for row in sheet.iter_rows() for cell in row if cell.value is not None]
    assert sheet.sheet_state == "visible"
    # which assembly, where the points lie, what the columns mean: lengths alone leave that open
    assert {"assembly: B left of A→B0", "θ13: direction A→B  (angle of link 3, coupler)"} <= set(cells)
    assert "3  coupler: A, B, C;  AB = a3;  AC = b3, counter-clockwise from A→B by γ3" in cells
    assert {"θ13 [deg]", "θ14 [deg]", "μmin [deg]", "101"} <= set(cells)
    assert [value for value in cells if isinstance(value, float | int)][-25:] == STEPS
    assert not any(isinstance(value, str) and value.startswith("=") for value in cells)
    assert all(mode not in " ".join(map(str, cells)) for mode in ("mode_1", "[assembly]"))


@pytest.mark.slow
def test_dimensions_come_from_seed_and_id_alone(week):
    drawn = {one["id"]: one["dimensions"] for one in key_of(week)["students"]}
    assert len({tuple(one.values()) for one in drawn.values()}) == 3
    assert all(30 <= one["a2"] <= 38 and one["a2"] * 2 == int(one["a2"] * 2) for one in drawn.values())
    (week / "one.csv").write_text("id\n103\n", encoding="utf-8")
    printed("exercise", week / "four-bar.toml", week / "one.csv", "-o", week / "again")
    again = json.loads((week / "again" / "key.json").read_text(encoding="utf-8"))
    assert again["students"][0]["dimensions"] == drawn["103"]


@pytest.mark.slow
def test_a_class_is_marked(week):
    handed = week / "handed"
    handed.mkdir()
    filled(week, 0, handed / "101.xlsx")
    filled(week, 1, handed / "homework_102.xlsx", xA="{a2}*COS({fi})+1")
    pages = week / "pages"
    printed(
        "mark",
        handed,
        "--against",
        week / "week" / "key.json",
        "-o",
        week / "marks.xlsx",
        "--csv",
        week / "m.csv",
        "--html",
        pages,
    )
    rows = list(csv.reader(io.StringIO((week / "m.csv").read_text(encoding="utf-8-sig"))))
    assert [row[:2] for row in rows] == [["id", "mark"], ["101", "4"], ["102", "4"], ["103", "0"]]
    assert "a term too many" in rows[2][2]
    assert "no workbook" in rows[3][2]
    page = (pages / "102.html").read_text(encoding="utf-8")
    assert "&lt;b&gt;Bora&lt;/b&gt;" in page
    assert "Ayşe" not in page


def test_moodle_reads_the_grades(week, tmp_path):
    """By ID number; who has handed in nothing has no grade yet."""
    filled(week, 0, tmp_path / "101.xlsx")
    printed("mark", tmp_path / "101.xlsx", "--against", week / "week" / "key.json", "--moodle", tmp_path / "moodle.csv")
    text = (tmp_path / "moodle.csv").read_text(encoding="utf-8")
    head, first, second, third = csv.reader(io.StringIO(text))
    title = mechsheet.template("four-bar", language="en").title.of("en")
    assert head == ["ID number", title, f"Feedback: {title}"]
    assert first[:2] == ["101", "4"]
    assert [row[:2] for row in (second, third)] == [["102", "-"], ["103", "-"]]


def test_an_appeal_is_settled_in_the_sheet(week):
    if not (week / "marks.xlsx").exists():
        pytest.skip("marks are made by the test before")
    book = mechsheet.open_book(week / "marks.xlsx")
    assert [row[0] for row in book.table("Class!I5:I7")] == [4.0, 4.0, 0.0]
    book.set("Class!H7", 3.0, force=True)
    assert [row[0] for row in book.table("Class!I5:I7")] == [4.0, 4.0, 3.0]
    assert book["Faults!B2"] == 1.0


def test_remarks_stay_inside_their_frame_and_rows_are_high_enough(week):
    """A row of one line's height would lay its remarks over the next student's."""
    if not (week / "marks.xlsx").exists():
        pytest.skip("marks are made by a test before")
    sheet = openpyxl.load_workbook(week / "marks.xlsx")["Class"]
    width = sheet.column_dimensions["K"].width
    heights = []
    for row in (5, 6, 7):
        cell = sheet.cell(row, 11)
        lines = sum(-(-len(line) // int(width * 1.2)) for line in str(cell.value or "").split("\n"))
        assert cell.alignment.wrap_text
        heights.append(sheet.row_dimensions[row].height)
        assert heights[-1] >= 12.75 * lines
    assert heights[1] > heights[2]
    assert [sheet.cell(row, 3).value for row in (5, 6)] == ["101.xlsx", "homework_102.xlsx"]
    assert sheet.print_title_rows == "$4:$4"


@pytest.mark.slow
def test_anothers_dimensions_are_named(week):
    other = week / "copied"
    other.mkdir()
    filled(week, 0, other / "103.xlsx")
    found = mechsheet.mark(other, week / "week" / "key.json")
    line = next(one for one in found.students if one.id == "103")
    assert {fault.kind for fault in line.audit.faults} == {"other dimension"}
    assert any(text.startswith("Sayfa1!B") and text.endswith(" is wanted") for text in lines_of(line))
    assert line.private == ("the dimensions are those of 101",)
    assert "101" not in page(found, line)  # a student's page says nothing of another


@pytest.mark.slow
def test_a_dimension_typed_over_is_an_earlier_fault(week):
    """35.25 in the cell of the student's own a2: what depends on it is right but for that; without follow-through it has
    no marks."""
    typed = week / "typed"
    typed.mkdir()
    own = key_of(week)["students"][0]["dimensions"]
    given = [(name, name, 35.25 if name == "a2" else own[name]) for name in ("a1", "a2", "a3", "a4")]
    Table(given, four_bar(), cells={"A40": "mu_min", "B40": "=MIN(L9:L33)"}).save(typed / "101.xlsx")
    found = mechsheet.mark(typed, week / "week" / "key.json").students[0].audit
    assert {one.verdict for one in found.asked.values()} == {"follows"}
    assert [(fault.cells, fault.formula, fault.kind) for fault in found.faults] == [
        ("Sayfa1!B3", "35.25", "other dimension")
    ]
    assert (found.plain, found.follow_through) == (0, 4)
    key = json.loads((week / "week" / "key.json").read_text(encoding="utf-8"))
    key["description"] = key["description"].replace("[exercise]", "[exercise]\nfollow_through = false")
    (week / "strict.json").write_text(json.dumps(key), encoding="utf-8")
    assert mechsheet.mark(typed, week / "strict.json").students[0].mark == 0


WRONG = {
    "asked = { theta31 = 1 }": (
        'exercise.asked.theta31: no variable, coordinate, rate, force, output or summary is called "theta31"'
    ),
    "asked = { theta12 = 3 }": 'exercise.asked.theta12: "theta12" is given: the driver is no question',
    "vary = { gamma3 = [1, 2, 1] }": 'the dimension "gamma3" is derived',
    "vary = { a9 = [1, 2, 1] }": 'no dimension is called "a9"',
    "vary = { a2 = [5, 2, 1] }": "expected [from, to, step]",
    'need = "mu_least > 3"': '"mu_least" is no summary',
    'need = "good"': '"good" is no condition',
    'vary = { a2 = [30, 31, 1] }\nneed = "mu_min > 80"': "no draw of 1000 meets it: mu_min > 80",
}


@pytest.mark.parametrize("lines", WRONG)
def test_what_is_wrong_with_an_exercise_is_told_with_its_line(week, tmp_path, lines):
    (tmp_path / "m.toml").write_text(mechsheet.template("four-bar").text + f"\n[exercise]\n{lines}\n", encoding="utf-8")
    output = printed("exercise", tmp_path / "m.toml", week / "class.csv", "-o", tmp_path / "out", code=2)
    assert WRONG[lines] in output
    assert "m.toml:" in output
    assert not (tmp_path / "out").exists()


def test_what_is_wrong_with_a_class_is_told_all_at_once(week, tmp_path):
    (tmp_path / "class.csv").write_text("id,name\n1,a\n,b\n1,c\n", encoding="utf-8")
    output = printed("exercise", week / "four-bar.toml", tmp_path / "class.csv", "-o", tmp_path / "out", code=2)
    assert "class.csv:3: a line without an id" in output
    assert "class.csv:4: 1: the same id as line 2" in output
    (tmp_path / "class.csv").write_text("number,name\n1,a\n", encoding="utf-8")
    assert 'no column is called "id"' in printed(
        "exercise", week / "four-bar.toml", tmp_path / "class.csv", "-o", tmp_path / "out", code=2
    )


def test_description_list_and_folder_are_told_at_once(tmp_path):
    """Nobody wants to mend the description only to hear of the list."""
    asked = "asked = { theta31 = 1 }\nvary = { gamma3 = [1, 2, 1], a9 = [1, 2, 1] }"
    (tmp_path / "m.toml").write_text(f"{mechsheet.template('four-bar').text}\n[exercise]\n{asked}\n", encoding="utf-8")
    (tmp_path / "class.csv").write_text("id\n1\n1\n", encoding="utf-8")
    (tmp_path / "out").write_text("a file", encoding="utf-8")
    command = ("exercise", tmp_path / "m.toml", tmp_path / "class.csv", "-o", tmp_path / "out")
    output = printed(*command, code=2)
    for text in ("theta31", "gamma3", '"a9"', "class.csv:3: 1: the same id as line 2"):
        assert text in output
    need = 'vary = { a2 = [30, 31, 1] }\nneed = "mu_min > 80"'
    (tmp_path / "m.toml").write_text(f"{mechsheet.template('four-bar').text}\n[exercise]\n{need}\n", encoding="utf-8")
    output = printed(*command, code=2)
    for text in (
        "m.toml:",
        "no draw of 1000 meets it",
        "class.csv:3: 1: the same id",
        "is a file: a folder is written",
    ):
        assert text in output
    assert (tmp_path / "out").read_text(encoding="utf-8") == "a file"


@pytest.mark.slow
def test_a_long_id_in_a_cell_and_a_file_that_cannot_be_read_are_the_students(week, tmp_path):
    """A number of eight digits is no 2.02112e+07; a lost file is a line of its student's, not nobody's."""
    (tmp_path / "class.csv").write_text("id\n20211234\n20215678\n", encoding="utf-8")
    printed("exercise", week / "four-bar.toml", tmp_path / "class.csv", "-o", tmp_path / "week")
    handed = tmp_path / "handed"
    handed.mkdir()
    filled(tmp_path, 0, handed / "mine.xlsx")
    book = openpyxl.load_workbook(handed / "mine.xlsx")
    book.active["A1"] = 20211234
    book.save(handed / "mine.xlsx")
    (handed / "hw_20215678.xlsx").write_bytes(b"PK lost")
    first, second = mechsheet.mark(handed, tmp_path / "week" / "key.json").students
    assert (first.id, first.mark) == ("20211234", 4)
    assert (second.id, second.mark, second.file) == ("20215678", 0, second.file)
    assert "cannot be judged" in second.why


@pytest.mark.parametrize(
    ("identifier", "file"),
    [("../../x", "x"), ("con", "con_"), ("Lpt1", "Lpt1_"), ("a/b\\c:d", "a_b_c_d"), ("Ayşe 1", "Ayşe_1"), ("..", "_")],
)
def test_file_names_are_safe_on_any_system(identifier, file):
    assert safe(identifier) == file


def test_long_ids_give_short_names_that_differ():
    long = "1" * 300
    assert len(safe(long)) < 80
    assert safe(long) != safe(long + "2")


def test_what_is_needed_may_name_outputs_of_summaries():
    """In the unit that they are shown in, as the summaries are."""
    text = mechsheet.template("four-bar").text
    text = text.replace("[summary]", 'half = { formula = "mu_min/2", unit = "deg" }\n[summary]', 1)
    mechanism = loads(f'{text}\n[exercise]\nneed = "half > 16.94 and half < 16.95"\n')  # mu_min = 33.888
    own = {dim.symbol: dim.shown for dim in mechanism.dimensions if dim.shown is not None}
    assert fulfils(mechanism, own, mechanism.exercise.need)
    assert not fulfils(mechanism, own | {"a2": 30.0}, mechanism.exercise.need)


@pytest.mark.slow
def test_an_exercise_in_which_nothing_varies_says_so(tmp_path):
    """Silently the same dimensions for everybody would be found out in the exam room; the line proposed works as it is."""
    text = mechsheet.template("four-bar").text
    (tmp_path / "m.toml").write_text(text, encoding="utf-8")
    (tmp_path / "class.csv").write_text("id\n1\n2\n", encoding="utf-8")
    output = printed("exercise", tmp_path / "m.toml", tmp_path / "class.csv", "-o", tmp_path / "same")
    (note,) = [line for line in output.splitlines() if "everybody has the same dimensions" in line]
    line = note[note.index("vary") :]
    assert line == "vary = { a1 = [66.5, 73.5, 0.5], a2 = [33, 37, 0.5], a3 = [59, 65.5, 0.5], a4 = [53, 59, 0.5] }"
    (tmp_path / "m.toml").write_text(f"{text}\n[exercise]\n{line}\n", encoding="utf-8")
    output = printed("exercise", tmp_path / "m.toml", tmp_path / "class.csv", "-o", tmp_path / "other")
    assert "everybody" not in output
    key = json.loads((tmp_path / "other" / "key.json").read_text(encoding="utf-8"))
    assert key["students"][0]["dimensions"] != key["students"][1]["dimensions"]


def test_nothing_is_marked_where_a_path_holds_no_workbook(week, tmp_path):
    """Marks of an earlier hour stay: with a folder misspelled, a whole class would have handed in nothing."""
    (tmp_path / "empty").mkdir()
    (tmp_path / "list.csv").write_text("id\n101\n", encoding="utf-8")
    kept = {name: f"earlier {name}" for name in ("marks.xlsx", "marks.csv", "moodle.csv")}
    for name, text in kept.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    written = ("-o", tmp_path / "marks.xlsx", "--csv", tmp_path / "marks.csv", "--moodle", tmp_path / "moodle.csv")
    pages = ("--html", tmp_path / "pages")
    handed = [week / "week" / "student", *(tmp_path / name for name in ("handde", "lost.xlsx", "empty", "list.csv"))]
    output = printed("mark", *handed, "--against", week / "week" / "key.json", *written, *pages, code=2)
    for told in (
        "handde: there is no such file or folder",
        "lost.xlsx: there is no such file or folder",
        "empty: no workbook (.xlsx, ",
        "list.csv: is no workbook (.xlsx, ",
    ):
        assert told in output
    assert {name: (tmp_path / name).read_text(encoding="utf-8") for name in kept} == kept
    assert not (tmp_path / "pages").exists()


@pytest.mark.slow
def test_where_nothing_has_a_name_that_could_vary_no_empty_line_is_advised(tmp_path):
    (tmp_path / "class.csv").write_text("id\n1\n", encoding="utf-8")
    text = """format = 1
mechanism.name = "plain"
links.ground.points = { A0 = [0, 0], B0 = [70, 0] }
links.crank.points = { A0 = [0, 0], A = [35, 0] }
links.coupler.points = { A = [0, 0], B = [62, 0] }
links.rocker.points = { B0 = [0, 0], B = [56, 0] }
driver = { link = "crank", start = 0, stop = 360, step = 90 }
assembly.B = [50, 55]
"""
    (tmp_path / "m.toml").write_text(text, encoding="utf-8")
    told = printed("exercise", tmp_path / "m.toml", tmp_path / "class.csv", "-o", tmp_path / "out")
    assert "what is to vary is written into [dimensions]" in told
    assert "vary = {" not in told


def test_a_folder_to_write_into_is_missed_before_anything_is_marked(week, tmp_path):
    command = ("mark", week / "week" / "student", "--against", week / "week" / "key.json")
    output = printed(*command, "-o", tmp_path / "none" / "m.xlsx", "--csv", tmp_path / "none" / "m.csv", code=2)
    assert output.count("there is no such folder") == 2


@pytest.mark.slow
def test_an_appeal_is_looked_at_by_the_key(week):
    """The description of an exercise stands in its key: no faults of a .json read as a description."""
    sheet = next((week / "week" / "student").glob("101*.xlsx"))
    output = printed("audit", sheet, "--against", week / "week" / "key.json", "--language", "tr", code=1)
    assert "theta13" in output
    assert "0 puan" in output
