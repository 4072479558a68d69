"""No marks for guessing: which column is the answer, which rows it answers, and how little numbers alone are worth."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import mechsheet
from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from mechsheet.homework.rows_asked import answered

ONE = "\n[exercise]\nasked = { theta14 = 1 }\n"


@pytest.fixture(scope="module")
def mechanism():
    return mechsheet.template("four-bar")


@pytest.fixture(scope="module")
def asked_one():
    return mechsheet.loads(mechsheet.template("four-bar").text + ONE, "one")


def marked(tmp_path, mechanism, table):
    """(the mark, the audit) of one workbook."""
    (one,) = mechsheet.mark([table.save(tmp_path / "book.xlsx")], mechanism).students
    return one.mark, one.audit


GUESSES = ("ATAN2({xA}-{a1},{yA})-{q}", "ATAN2({xA}-{a1},{yA})+{q}*0.9", "{q}-{s}/200", "{fi}-{q}/3")
"""The first one is right."""


def with_guesses(headings, *more):
    """The diagonal, its angle, and a column for each guess under these headings."""
    columns = [column for column in four_bar() if column[1] in ("deg", "fi", "xA", "yA", "s")]
    columns.append(("psi", "q", "ACOS(({a4}^2+{s}^2-{a3}^2)/(2*{a4}*{s}))"))
    columns += [(text, f"g{n}", guess) for n, (text, guess) in enumerate(zip(headings, GUESSES, strict=True))]
    return Table(FOUR_BAR, [*columns, *more])


GUESSED = {
    "beside a wrong one that is headed so": ([""] * 4, [("theta14", "w", "{fi}+{q}")]),
    "beside a wrong one headed otherwise too": (["a", "b", "c", "d"], [("Teta14 (rad)", "w", "{fi}+{q}")]),
    "all headed so": (["theta14"] * 4, []),
    "all headed so and numbered": (["theta14 (1)", "theta14 (2)", "theta14 (3)", "theta14 (4)"], []),
    "headed as something else": (["theta13", "", "", ""], []),
}


@pytest.mark.parametrize("how", GUESSED)
def test_one_of_several_columns_that_happens_to_be_right_has_no_marks(tmp_path, asked_one, how):
    headings, more = GUESSED[how]
    mark, found = marked(tmp_path, asked_one, with_guesses(headings, *more))
    assert mark == 0
    assert found.asked["theta14"].verdict != "right"


def test_the_last_column_that_is_headed_by_the_name_counts(tmp_path, asked_one):
    headings = ["theta14", "", "", ""]
    right = ("theta14", "r", GUESSES[0])
    assert marked(tmp_path, asked_one, with_guesses(headings, ("theta14", "w", "{fi}+{q}"), right))[0] == 1
    assert marked(tmp_path, asked_one, with_guesses(headings, ("theta14 [deg]", "d", "DEGREES({g0})")))[0] == 1


def test_first_values_of_an_iteration_may_be_headed_by_the_name(tmp_path, asked_one):
    """The typed ones are called theta14, the computed ones theta14_3: what is computed from them is the answer."""
    solved = mechsheet.template("four-bar", {"a1": 100, "a2": 35, "a3": 70, "a4": 80}).solve()
    first = [round(math.radians(value), 1) for value in solved["theta14"]]
    table = with_guesses(["theta14_3", "", "", ""], ("theta14", "start", first))
    table.columns = [c for c in table.columns if c[1] not in ("g1", "g2", "g3")]
    table.columns = [(h, n, f"{f}+0*{{start}}" if n == "g0" else f) for h, n, f in table.columns]
    assert marked(tmp_path, asked_one, table)[0] == 1


def test_columns_under_each_others_headings_are_wrong_and_said_so(tmp_path, mechanism):
    headings = {"t13": "theta14", "t14": "theta13"}
    columns = [(headings.get(name, heading), name, formula) for heading, name, formula in four_bar()]
    mark, found = marked(tmp_path, mechanism, Table(FOUR_BAR, columns))
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == {
        "theta13": "wrong", "theta14": "wrong", "mu": "right",
    }  # fmt: skip
    assert mark == 1
    assert found.faults == ()  # no formula is blamed
    assert "the column headed theta13 is theta14, and the other way round" in found.remarks


ROWS = {
    "5 of 25": ([15.0 * n for n in range(5)], 5),
    "5 of 25, far apart": ([90.0 * n for n in range(5)], 5),
    "within a third of a degree": ([0.015 * n for n in range(25)], 1),
    "half a turn": ([15.0 * n for n in range(13)], 13),
    "all": (STEPS, 25),
    "all, a turn further": ([360 + step for step in STEPS], 25),
    "all but the closing one": ([10.0 * n for n in range(36)], 25),
    "a coarser step": ([20.0 * n for n in range(19)], 25),
    "a turn that begins elsewhere": ([15.0 * n - 90 for n in range(25)], 25),
    "backwards": (STEPS[::-1], 25),
}


@pytest.mark.parametrize("rows", ROWS)
def test_answers_cover_the_rows_asked_for(tmp_path, mechanism, rows):
    steps, count = ROWS[rows]
    columns = [("krank", "deg", steps), *four_bar()[1:]]
    mark, found = marked(tmp_path, mechanism, Table(FOUR_BAR, columns))
    assert mark == pytest.approx(3 * count / 25)
    assert {one.verdict for one in found.asked.values()} == {"right" if count == 25 else "in part"}
    told = f"the table answers {count} of the 25 rows asked for"
    assert any(told in remark for remark in found.remarks) is (count < 25)
    # whoever only audits a workbook has asked for no rows
    assert mechsheet.audit(tmp_path / "book.xlsx", mechanism).right


def test_a_number_of_a_few_rows_is_not_that_of_all(tmp_path):
    """The least transmission angle of the first rows; typed over all rows in the same cell it is right."""
    text = mechsheet.template("four-bar").text + "\n[exercise]\nasked = { mu_min = 1 }\n"
    mechanism = mechsheet.loads(text, "least")
    for first, mark in ((0.0, 1.0), (180.0, 4 / 25)):  # it is least at 0 degrees
        columns = [("krank", "deg", [first + 15 * n for n in range(4)]), *four_bar()[1:]]
        table = Table(FOUR_BAR, columns, cells={"A40": "mu_min", "B40": "=MIN(L9:L12)"})
        assert marked(tmp_path, mechanism, table)[0] == pytest.approx(mark)


def test_rows_answered_against_counting_by_hand():
    """300 random tables against the rule, value by value: half a step from a row, or between two that are near enough."""
    draw = np.random.default_rng(31)
    for _ in range(300):
        step = draw.uniform(1, 20)
        asked = draw.uniform(-100, 100) + step * np.arange(draw.integers(2, 40))
        given = draw.uniform(asked[0] - 3 * step, asked[-1] + 3 * step, draw.integers(4, 60))
        rows = sorted(given)
        wanted = []
        for value in asked:
            near = min(abs(value - row) for row in rows) <= step / 2
            inside = any(a <= value <= b and b - a <= 2 * step for a, b in itertools.pairwise(rows))
            wanted.append(near or inside)
        assert answered(asked, given, turns=False).tolist() == wanted
