"""Outputs with poles and jumps, and points in line: a fresh workbook agrees with the reference, a wrong one does not."""

import numpy as np
import pytest

import mechsheet
from chosen import part
from judging import judged
from livesheet.formula.book import Book
from livesheet.formula.parser import parse_formula
from mechsheet.checking.cells_apart import Rounding
from mechsheet.checking.columns_apart import given_by_rounding
from mechsheet.description import loads
from mechsheet.reference import solve, variables

HEAD = """
format = 1
[mechanism]
name = "four-bar"
[dimensions]
a3 = 62.3
near = 30
far = 32.3
[links.ground]
points = { A0 = [0, 0], B0 = [70, 0] }
[links.crank]
points = { A0 = [0, 0], A = [35, 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0], C = { distances = { A = "near", B = "far" }, side = "left" } }
[links.rocker]
points = { B0 = [0, 0], B = [56, 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 15
[assembly]
B = [50, 55]
"""

POLES = [
    "1/sin(theta12)", "1/theta12", "1/(theta12 - pi)", "ln(A.y)", "0^A.y", "sqrt(A.y)", "acos(A.x/35)", "tan(theta12)",
    "atan2(A.y, A.x - 35)",
]  # fmt: skip


def with_output(formula, head=HEAD):
    unit = ', unit = "deg"' if formula.startswith("a") else ""
    return loads(f'{head}\n[outputs]\nq = {{ formula = "{formula}"{unit} }}\n')


@pytest.mark.parametrize("formula", POLES)
def test_fresh_workbook_agrees_at_a_pole(formula):
    comparison = judged(with_output(formula))
    assert comparison.agrees, comparison


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "tr"])
def test_files_with_a_pole(language, tmp_path):
    """Both formats; the sheet itself says that all is well, although the first row shows an error."""
    text = f'{HEAD}\n[outputs]\nq = {{ formula = "1/sin(theta12)" }}\n[summary]\nmost = {{ of = "q", take = "max" }}\n'
    for path in mechsheet.build(mechsheet.loads(text, language=language), tmp_path, ("xlsx", "ods")):
        assert mechsheet.check(path).agrees
        assert mechsheet.recalc(path).named()["verdict"].startswith(("closes in all", "25 konumun hepsinde kapanıyor"))


@pytest.mark.parametrize(
    ("formula", "row", "value", "right"),
    [
        ("1/sin(theta12)", 0, np.nan, True),
        ("1/sin(theta12)", 0, -3e15, True),
        ("1/sin(theta12)", 0, 5.0, False),
        ("1/sin(theta12)", 1, np.nan, False),
        ("1/sin(theta12)", 1, 3e15, False),
        ("ln(A.y)", 0, np.nan, True),
        ("ln(A.y)", 0, 0.0, False),
        ("sqrt(A.y)", 0, 1e-5, True),
        ("sqrt(A.y)", 0, 1e-3, False),
        ("sqrt(A.y)", 3, np.nan, False),
        ("acos(A.x/35)", 0, 1e-6, True),
        ("acos(A.x/35)", 0, 1e-4, False),
        ("atan2(A.y, A.x - 35)", 0, 1.0, True),
        ("atan2(A.y, A.x - 35)", 0, np.nan, True),
        ("atan2(A.y, A.x - 35)", 2, np.nan, False),
        ("A.y", 4, np.nan, False),
    ],
)
def test_what_rounding_excuses_and_what_not(formula, row, value, right):
    """At a pole any huge number or an error; beside it, or where a function only ends, nothing but what rounding makes."""
    solution = solve(with_output(formula))
    found = variables(solution)
    ours = found["q"].copy()
    ours[row] = value
    assert given_by_rounding(solution, found, "q", ours, 1.0)[row] == right


def test_rows_that_do_not_exist_are_never_given_by_rounding():
    solution = solve(with_output("1/sin(theta12)", HEAD.replace("B0 = [70, 0]", "B0 = [110, 0]")))
    missing = np.flatnonzero(~solution.exists)
    assert len(missing)
    assert not given_by_rounding(solution, variables(solution), "q", np.full(25, 5.0), 1.0)[missing].any()


IN_LINE = [(30, 32.3, 62.3), (92.3, 30, 62.3), (0.1, 0.2, 0.3), (33.3, 29, 62.3), (12.1, 50.2, 62.3), (70, 7.7, 62.3)]


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("near", "far", "between"), part(IN_LINE, 2))
def test_three_points_in_line(near, far, between, side):
    """The place of C has all its digits in the reference too: by from_p^2 - along^2 it had half of them."""
    text = HEAD.replace("near = 30", f"near = {near}").replace("far = 32.3", f"far = {far}")
    text = text.replace('side = "left"', f'side = "{side}"')
    if between != 62.3:
        text = text.replace('B = ["a3", 0]', f'B = ["a3", 0], D = [{between}, 0]').replace('B = "far"', 'D = "far"')
    comparison = judged(loads(text))
    assert comparison.agrees, comparison
    assert comparison.worst < 1e-12


class Cells:
    """Numbers of a sheet, as the engine has them."""

    def __init__(self, *rows):
        self.rows = rows

    def get(self, sheet, row, col):
        return self.rows[row][col]

    def arrays(self, sheet, col, top, bottom):
        return np.array([row[col] for row in self.rows[top : bottom + 1]]), None


VERTEX = "A1-((A1-A2)^2*(B1-B3)-(A1-A3)^2*(B1-B2))/(2*((A1-A2)*(B1-B3)-(A1-A3)*(B1-B2)))"


@pytest.mark.parametrize(("formula", "excused"), [(VERTEX, True), ("A1-(A1-A2)/(2*B2)", False)])
def test_the_vertex_between_places_that_are_nearly_one_has_few_digits(formula, excused):
    """Three values around a top differ in their last digits only: what rounding leaves of these decides where it is."""
    places = (63.5, 63.5 - 1e-6, 63.5 + 1e-6)
    cells = Cells(*((place, 2.0 - (place - 63.5 + 2e-7) ** 2) for place in places))
    rounding = Rounding(Book(()), cells)
    assert rounding.accounts_for(parse_formula(formula), "S", 63.5, 63.5 + 2e-8) == excused
