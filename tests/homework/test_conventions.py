"""Right workbooks in other conventions are not blamed; one fault in them is found, its marks and what is wanted exact."""

from __future__ import annotations

import re

import openpyxl
import pytest

import mechsheet
from chosen import first
from homework.conventions import TASKS
from mechsheet.description import loads
from mechsheet.homework.audit import audit

ASIN = {"t13": "{q}", "xC": "{a2}*COS({fi})-{a3}*COS({t13})", "lean": "2*(PI()-{t13})", "steepest": "PI()-MIN({t13})"}

RIGHT = {
    "four-bar, plain": ("four-bar", {}),
    "four-bar, from the other side": ("four-bar", {"t14": "ATAN2({xB}-{a1},{yB})-PI()", "mu": "{t14}-{t13}+PI()"}),
    "four-bar, offset into the output": ("four-bar", {"t14": "ATAN2({xB}-{a1},{yB})-PI()"}),
    "four-bar, from the vertical": ("four-bar", {"t14": "ATAN2({xB}-{a1},{yB})-PI()/2"}),
    "four-bar, clockwise": ("four-bar", {"t14": "-ATAN2({xB}-{a1},{yB})", "mu": "-{t14}-{t13}"}),
    "four-bar, clockwise in degrees": (
        "four-bar", {"t14": "DEGREES(-ATAN2({xB}-{a1},{yB}))", "mu": "-{t14}-DEGREES({t13})"}
    ),
    "four-bar, degrees": ("four-bar", {"t14": "DEGREES(ATAN2({xB}-{a1},{yB}))", "mu": "{t14}-DEGREES({t13})"}),
    "four-bar, a turn further": ("four-bar", {"t14": "ATAN2({xB}-{a1},{yB})+2*PI()", "mu": "{t14}-{t13}-2*PI()"}),
    "four-bar, summaries in degrees": ("four-bar", {"least": "DEGREES(MIN({t14}))", "most": "DEGREES(MAX({t14}))"}),
    "four-bar, both clockwise": ("four-bar", {"t13": "{b}+{g}", "mu": "{t13}-{t14}"}),
    "steering, plain": ("steering", {}),
    "steering, the wheel from the other side": (
        "steering", {"t14": "ATAN2({xR}-{track},{yR})+PI()", "err": "DEGREES({t14}-ATAN({track}/{wb}*COS({fi})))-{beta}"}
    ),
    "steering, the offset carried on": ("steering", {"t14": "ATAN2({xR}-{track},{yR})+PI()"}),
    "steering, in degrees": (
        "steering",
        {
            "t14": "DEGREES(ATAN2({xR}-{track},{yR}))",
            "err": "{t14}+180-DEGREES(ATAN({track}/{wb}*COS({fi})))-{beta}",
        },
    ),
    "steering, in radians": ("steering", {"err": "{t14}+PI()-ATAN({track}/{wb}*COS({fi}))-RADIANS({beta})"}),
    "slider, plain": ("slider", {}),
    "slider, the sharp angle": ("slider", ASIN),
    "slider, the sharp angle all the way": ("slider", {**ASIN, "steepest": "MAX({t13})"}),
    "slider, from below": ("slider", {"t13": "-{q}", "xC": "{a2}*COS({fi})-{a3}*COS({t13})", "lean": "2*({t13}+PI())"}),
    "slider, doubled from there": ("slider", {"t13": "-{q}", "xC": "{a2}*COS({fi})-{a3}*COS({t13})"}),
    "lever, plain": ("lever", {}),
    "lever, from the vertical": ("lever", {"t13": "ATAN2({u},{v})-PI()/2", "xB": "-{b}*SIN({t13})"}),
    "lever, the arc from above": (
        "lever", {"t13": "ATAN2({u},{v})-PI()/2", "xB": "-{b}*SIN({t13})", "arc": "{b}*({t13}+PI()/2)"}
    ),
    "lever, clockwise": ("lever", {"t13": "-ATAN2({u},{v})", "left": "MAX({t13})", "arc": "-{b}*{t13}"}),
    "lever, clockwise in degrees": (
        "lever",
        {"t13": "-DEGREES(ATAN2({u},{v}))", "xB": "{b}*COS(RADIANS({t13}))", "arc": "-{b}*RADIANS({t13})"},
    ),
}  # fmt: skip
"""Workbook -> (task, columns in other words): 25 of them."""


@pytest.mark.slow
@pytest.mark.parametrize("how", first(list(RIGHT), 6))
def test_a_convention_is_not_blamed(tmp_path, how):
    task, changes = RIGHT[how]
    found = audit(TASKS[task].save(tmp_path / "book.xlsx", changes), TASKS[task].mechanism)
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == dict.fromkeys(found.asked, "right")
    assert found.faults == ()
    assert found.follow_through == found.plain == found.of


@pytest.mark.slow
@pytest.mark.parametrize("task", first(list(TASKS), 2))
def test_the_workbook_of_a_task_is_right_itself(tmp_path, task):
    """Its verdicts say `worst 33.8° at -108°`: words, beside a summary that is called `worst`; and a column of a hidden
    sheet is called `left`, as a summary is."""
    (built,) = mechsheet.build(TASKS[task].mechanism, tmp_path / "own.xlsx")
    found = audit(built, TASKS[task].mechanism)
    assert found.right, found.asked
    assert found.faults == ()


CLOCKWISE = RIGHT["four-bar, clockwise"][1]
OFFSET = RIGHT["four-bar, from the other side"][1]
IN_DEGREES = RIGHT["steering, in degrees"][1]
SHARP = RIGHT["slider, the sharp angle"][1]
VERTICAL = RIGHT["lever, from the vertical"][1]
BACKWARDS = RIGHT["lever, clockwise"][1]

FAULTS = {
    # four-bar: column typed over, sign, arguments, function, term, bracket, anchor, summary
    "1": ("four-bar", {}, {"t14 6": 2.05}, ["theta14"]),
    "2": ("four-bar", {}, {"s 6": 105.9}, []),
    "3": ("four-bar", OFFSET, {"t14 6": -1.05}, ["theta14"]),
    "4": ("four-bar", CLOCKWISE, {"t14 9": -2.5}, ["theta14"]),
    "5": ("four-bar", CLOCKWISE, {"s": "SQRT(({a1}-{xA})^2-{yA}^2)"}, []),
    "6": ("four-bar", OFFSET, {"xB": "{xA}+{a3}*SIN({t13})"}, []),
    "7": ("four-bar", OFFSET, {"g": "ACOS(({a3}^2+{s}^2-{a4}^2)/2*{a3}*{s})"}, []),
    "8": ("four-bar", {}, {"b": "ATAN2(-{yA},{a1}-{xA})"}, []),
    "9": ("four-bar", {}, {"fi": "{deg}"}, []),
    "10": ("four-bar", {}, {"fi": "{deg}*3.14/180"}, []),
    "11": ("four-bar", CLOCKWISE, {"mu": "-{t14}+{t13}"}, ["mu"]),
    "12": ("four-bar", OFFSET, {"most": "MIN({t14})"}, ["most"]),
    "13": ("four-bar", CLOCKWISE, {"least": "MIN({t14})*2"}, ["least"]),
    "14": ("four-bar", {}, {"xA": "{a2}*COS({deg})"}, []),
    "15": ("four-bar", {}, {"yB 0": 70.0}, []),
    "16": ("four-bar", {}, {"mu 24": 1.0}, ["mu"]),
    # steering
    "17": ("steering", {}, {"t14 4": -1.3}, ["theta14"]),
    "18": ("steering", IN_DEGREES, {"t14 4": -80.5}, ["theta14"]),
    "19": ("steering", {}, {"err 12": 0.3}, ["error"]),
    "20": ("steering", IN_DEGREES, {"err": "{t14}+180-ATAN({track}/{wb}*COS({fi}))-{beta}"}, ["error"]),
    "21": ("steering", {}, {"yL": "{arm}*COS({fi})"}, []),
    "22": ("steering", {}, {"t13": "{psi}-ACOS(({rod}^2+{s}^2-{arm}^2)/(2*{rod}*{arm}))"}, ["theta13"]),
    "23": ("steering", IN_DEGREES, {"worst": "MIN({err})"}, ["worst"]),
    "24": ("steering", {}, {"s": "SQRT(({track}-{xL})^2+{yL})"}, []),
    "25": ("steering", {}, {"psi": "ATAN2({track}+{xL},-{yL})"}, []),
    "26": ("steering", {}, {"xR 7": 1300.0}, []),
    # slider
    "27": ("slider", {}, {"q": "ASIN(({c}+{a2}*SIN({fi}))/{a3})"}, []),
    "28": ("slider", {}, {"q 6": 0.1}, []),
    "29": ("slider", SHARP, {"t13 6": -0.1}, ["theta13"]),
    "30": ("slider", SHARP, {"q": "ASIN(({c}-{a2}*COS({fi}))/{a3})"}, []),
    "31": ("slider", {}, {"xC": "{a2}*SIN({fi})+{a3}*COS({t13})"}, ["x_C"]),
    "32": ("slider", {}, {"stroke": "MAX({xC})"}, ["stroke"]),
    "33": ("slider", {}, {"lean": "{t13}/2"}, ["lean"]),
    # lever
    "34": ("lever", {}, {"v": "{a2}*SIN({fi})-{d}"}, []),
    "35": ("lever", VERTICAL, {"t13 8": 0.5}, ["theta13"]),
    "36": ("lever", BACKWARDS, {"s3": "SQRT({u}^2-{v}^2)"}, ["s3"]),
    "37": ("lever", VERTICAL, {"xB": "-{b}*COS({t13})"}, ["B.x"]),
    "38": ("lever", BACKWARDS, {"left": "MIN({t13})"}, ["left"]),
    "39": ("lever", {}, {"u": "{a2}*COS({deg})"}, []),
    "40": ("lever", {}, {"longest": "MAX({t13})"}, ["longest"]),
    "41": ("lever", {}, {"arc 3": 300.0}, ["arc"]),
    "42": ("lever", BACKWARDS, {"xB 3": 10.0}, ["B.x"]),
}
"""Number -> (task, its convention, the fault: a formula, or a number typed over one; the asked quantities it stands in)."""


@pytest.mark.cases(3)
@pytest.mark.slow
@pytest.mark.parametrize("number", first(list(FAULTS), 6))
def test_one_fault_is_found_with_exact_marks(tmp_path, number):
    name, convention, fault, lost = FAULTS[number]
    task = TASKS[name]
    typed = {place: value for place, value in fault.items() if " " in place}
    changes = {place: value for place, value in fault.items() if " " not in place}
    right = mechsheet.open_book(task.save(tmp_path / "right.xlsx", convention))
    found = audit(task.save(tmp_path / "wrong.xlsx", convention | changes, typed), task.mechanism)
    (place,) = fault
    column, _, row = place.partition(" ")
    assert [one.cells for one in found.faults] == [task.where(column, int(row) if row else None)]
    assert {symbol for symbol, one in found.asked.items() if one.verdict not in ("right", "follows")} == set(lost)
    assert found.follow_through == found.of - len(lost)
    for cell, wanted in told(found):
        assert wanted == pytest.approx(right[cell], rel=1e-4, abs=1e-4)


def told(found):
    """What remarks say is wanted, by cell."""
    for text in found.remarks:
        match = re.search(r"in (Sayfa1!\w+): (?:.*) found, (.*) wanted", text)
        if match:
            yield match[1], float(match[2])


BUILT = {
    "1": ("four-bar", "I", "-$B$12", "+$B$12", ["theta13"]),
    "2": ("four-bar", "D", "^2+C", "^2-C", []),
    "3": ("four-bar", "F", "$B$7^2+D", "$B$7^2-D", []),
    "4": ("four-bar", "C", "SIN", "COS", []),
    "5": ("steering", "C", "SIN", "COS", []),
    "6": ("steering", "G", "-D", "+D", []),
    "7": ("steering", "J", "+180", "+90", ["error"]),
    "8": ("slider", "B", "-$B$4*SIN", "+$B$4*SIN", []),
    "9": ("slider", "G", "$B$5*COS", "$B$5*SIN", []),
    "10": ("slider", "J", "2*F", "3*F", ["lean"]),
    "11": ("lever", "B", "+$B$5", "-$B$5", []),
    "12": ("lever", "I", "RADIANS", "", ["arc"]),
}
"""Number -> (task, the column of its own workbook of one sheet that is changed; from, to; what is asked in that column)."""


@pytest.mark.slow
@pytest.mark.parametrize("number", first(list(BUILT), 2))
def test_one_formula_changed_in_a_workbook_that_was_built(tmp_path, number):
    name, column, was, now, lost = BUILT[number]
    text = TASKS[name].text.replace('"B.x" = 1, ', "")  # no column of the built one
    mechanism = loads(text, "own")
    mechsheet.build(mechanism, tmp_path / "own.xlsx", layout="page")
    book = openpyxl.load_workbook(tmp_path / "own.xlsx")
    changed = []
    for (cell,) in book.worksheets[0][f"{column}20:{column}80"]:
        if isinstance(cell.value, str) and cell.value.startswith("=") and was in cell.value:
            cell.value = cell.value.replace(was, now)
            changed.append(cell.coordinate)
    book.save(tmp_path / "own.xlsx")
    found = audit(tmp_path / "own.xlsx", mechanism)
    (fault,) = found.faults
    assert fault.cells.endswith(f"!{changed[0]}:{changed[-1]}")
    assert {symbol for symbol, one in found.asked.items() if one.verdict not in ("right", "follows")} == set(lost)
    assert found.follow_through == found.of - len(lost)
