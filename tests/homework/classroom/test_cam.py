"""A cam as a task: told in words, filled in by hand, marked."""

import re

import openpyxl
import pytest

import mechsheet
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.homework.classroom.exercise import exercise
from mechsheet.homework.classroom.statement import Statement
from mechsheet.homework.expected_values import asked_of

EXERCISE = """
[exercise]
asked = { s = 2, alpha = 2, rho = 1 }
vary = { rb = [44, 48, 2], e = [4, 10, 2], h1 = [16, 24, 2] }
"""


def described(name, more=EXERCISE):
    return loads(mechsheet.template(name, language="en").text.split("[summary]")[0] + more, name)


def told(lines):
    return [line.plain for line in lines]


def test_the_task_says_how_the_cam_turns_and_what_it_moves():
    mechanism = described("cam-slide")
    found = Statement(Compiled(mechanism), list(asked_of(mechanism).marks))
    assert told(found.driver()) == [
        "phi: angle by which the cam has turned about O, counter-clockwise",
        "s is moved by the cam, one segment after another, from where it touches the base circle",
        "1. cycloidal: over over1, by h1",
        "2. dwell: over over2",
        "3. 3-4-5 polynomial: over over3, by −h1",
        "4. dwell: over 2π − (over1 + over2 + over3)",
        "base circle of radius rb;  a roller about C of radius rr",
    ]
    assert any("positive in the cam's sense of turning" in line for line in told(found.meanings()))


def test_a_face_and_a_cam_that_turns_clockwise():
    mechanism = described("cam-flat", "")
    lines = told(Statement(Compiled(mechanism), ["contact"]).driver())
    assert lines[0] == "phi: angle by which the cam has turned about O, clockwise"
    assert lines[-1].startswith("base circle of radius rb;  the flat face of tappet passes through F, in the direction")


FILLED = {
    "s": "=SQRT(({rb}+{rr})^2-{e}^2)+{h1}*({f})",
    "alpha": "=DEGREES(ATAN(({d}-{e})/{s}))",
}
F = (
    "IF({p}<={over_1},{p}/{over_1}-SIN(2*PI()*{p}/{over_1})/2/PI(),IF({p}<={over_1}+{over_2},1,IF({p}<={over_1}+{over_2}+{over_3},"
    "1-10*{t}^3+15*{t}^4-6*{t}^5,0)))"
)
D = (
    "{h1}*IF({p}<={over_1},(1-COS(2*PI()*{p}/{over_1}))/RADIANS({over_1}),IF(OR({p}<={over_1}+{over_2},{p}>{over_1}+{over_2}+{over_3}),"
    "0,-30*{t}^2*(1-{t})^2/RADIANS({over_3})))"
)


def filled(path, sign=""):
    """The columns s and alpha of a student's sheet, by the textbook's formulas."""
    book = openpyxl.load_workbook(path)
    sheet = book.worksheets[0]
    cells = {
        re.sub(r"^over(\d)", r"over_\1", str(row[0].value).split(" ")[0]): row[1].coordinate
        for row in sheet.iter_rows()
        if row[1].value is not None
    }
    holes = {name: "$" + "$".join(re.fullmatch(r"([A-Z]+)(\d+)", at).groups()) for name, at in cells.items()}
    head = next(row for row in sheet.iter_rows() if str(row[0].value).startswith("φ [") and row[1].value == "s [mm]")
    for row in range(head[0].row + 1, sheet.max_row + 1):
        known = holes | {"p": f"$A{row}", "s": f"$B{row}"}
        known["t"] = "(({p}-{over_1}-{over_2})/{over_3})".format(**known)
        known |= {"f": F.format(**known), "d": f"({D.format(**known)})"}
        sheet.cell(row, 2).value = FILLED["s"].format(**known)
        sheet.cell(row, 3).value = FILLED["alpha"].format(**known).replace("=", f"={sign}")
    book.save(path)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("sign", "marks"), [("", 4.0), ("0.9*", 2.0)])
def test_a_task_filled_in_by_hand_is_marked(tmp_path, sign, marks):
    people = tmp_path / "class.csv"
    people.write_text("id,name\n101,Ada\n", encoding="utf-8")
    exercise(described("cam-slide"), people, tmp_path / "week")
    page = tmp_path / "week" / "student" / "101.xlsx"
    filled(page, sign)
    (one,) = mechsheet.mark(page, tmp_path / "week" / "key.json").students
    assert (one.id, one.mark) == ("101", marks)


@pytest.mark.slow
def test_the_workbook_itself_has_all_marks(tmp_path):
    people = tmp_path / "class.csv"
    people.write_text("id\n7\n", encoding="utf-8")
    exercise(
        described("cam-rocker", EXERCISE.replace("s = 2", "theta12 = 2").split("vary")[0]), people, tmp_path / "week"
    )
    (one,) = mechsheet.mark(tmp_path / "week" / "solution" / "7.xlsx", tmp_path / "week" / "key.json").students
    assert one.mark == 5.0
