"""Two-way tables of summaries: each cell is what a search finds with its two inputs, whatever is typed into the sheet."""

from functools import cache

import pytest
from placed import places_of

from livesheet.engine import compile_book
from livesheet.evaluation import book_of
from livesheet.formula.nodes import ErrorValue
from mechsheet.checking.against_search import against_search
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.sheet import styles
from mechsheet.sheet.asked.two_way import FIRST, HEAD_ROW

pytestmark = pytest.mark.slow


LINKAGE = """
format = 1
[mechanism]
name = "case"
[dimensions]
a1 = 70
a2 = 35
a3 = 62.3
a4 = 56
tilt = { value = 10, unit = "deg" }
part = { value = 0.5, unit = "1" }
[links.ground]
points = { A0 = [0, 0], B0 = { r = "a1", angle = "tilt" } }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0], C = ["part*a3", 30] }
[links.rocker]
points = { B0 = [0, 0], B = ["a4", 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 20
[assembly]
B = [60, 60]
[summary]
swing = { of = "theta14", take = "range" }
height = { of = "C.y", take = "max" }
middle = { of = "C.x", take = "mean" }
end = { of = "C.y", take = "last" }
rough = { of = "C.x", take = "rms" }
[[tables]]
rows = { a2 = ["a2", 60] }
columns = { a1 = [70, 200] }
value = "swing"
[[tables]]
rows = { tilt = [-20, 10] }
columns = { part = [0.5] }
value = "height"
[[tables]]
rows = { a2 = [35] }
columns = { part = [0.5] }
value = "middle"
[[tables]]
rows = { a4 = [56] }
columns = { a2 = [35] }
value = "end"
[[tables]]
rows = { a4 = [56] }
columns = { a3 = [62.3] }
value = "rough"
"""


@cache
def built():
    compiled = Compiled(loads(LINKAGE))
    return compiled, compile_book(book_of(compiled.layout))


@cache
def evaluated(**typed):
    """The plan, and the values with numbers typed into cells: `swing_A9`, or a symbol of the first sheet."""
    compiled, book = built()
    spots = places_of(compiled.plan)
    places = {}
    for name, value in typed.items():
        if name in spots:
            places[spots[name].sheet, spots[name].row, spots[name].col] = float(value)
        else:
            table, cell = name.split("_")
            places[f"Table {table}", int(cell[1:]) - 1, "ABCD".index(cell[0])] = float(value)
    return compiled.plan, book.evaluate(places)


def judged(values, plan):
    return against_search(book_of(built()[0].layout), values, plan, "case")


TYPED = {
    "start": 7.5,
    "step": 4,
    "a3": 70,
    "mode_1": -1,
    "swing_A9": 42,
    "swing_B7": 81,
    "height_A8": 33,
    "height_B7": 2.5,
}


@pytest.mark.cases(1)
@pytest.mark.parametrize("typed", [{}, TYPED], ids=["built", "typed"])
def test_each_cell_is_what_the_search_finds(typed):
    """All positions, some, none; inputs of the table, of the first sheet, start, step and assembly changed."""
    plan, values = evaluated(**typed)
    found = judged(values, plan)
    assert found.agrees, found
    assert found.cells >= 4 + 2 + 1 + 1 + 1 + 10


@pytest.mark.parametrize(("name", "row"), [("swing", 0), ("height", 1), ("middle", 0), ("end", 0), ("rough", 0)])
def test_the_present_dimensions_give_the_first_sheets_number(name, row):
    plan, values = evaluated()
    spot = places_of(plan)[f"summary {name}"]
    shown = values.get(spot.sheet, spot.row, spot.col)
    assert values.get(f"Table {name}", FIRST + row, 1) == pytest.approx(shown, rel=1e-6)


def test_what_does_not_exist_is_marked():
    """Of a1 = 200 nothing closes; with a crank of 60 a part, in amber; the rest is plain."""
    _, values = evaluated()
    sheet = built()[0].layout.sheet("Table swing")
    rules = [rule for rule in sheet.conditionals if rule.style == styles.WARN]
    amber = [values.get("Table swing", rule.condition.left.row, rule.condition.left.col) == 0 for rule in rules]
    assert amber == [False, True]
    assert isinstance(values.get("Table swing", FIRST + 1, 1), float)
    assert values.get("Table swing", FIRST, 2) == ErrorValue("#N/A")


class Damaged:
    """Values, but for one cell."""

    def __init__(self, values, place, value):
        self.values, self.place, self.value, self.column = values, place, value, values.column

    def get(self, *place):
        return self.value if place == self.place else self.values.get(*place)


@pytest.mark.parametrize(("table", "value"), [("swing", 1.001), ("middle", ErrorValue("#N/A"))])
def test_a_wrong_cell_is_found(table, value):
    plan, values = evaluated()
    place = (f"Table {table}", FIRST, 1)
    wrong = values.get(*place) * value if isinstance(value, float) else value
    found = judged(Damaged(values, place, wrong), plan)
    assert not found.agrees
    assert f"{table} with" in found.where


def test_heads_and_chart():
    """Both heads are inputs; a curve for each column over the values that go down; helpers are folded away."""
    sheet = built()[0].layout.sheet("Table swing")
    inputs = [(cell.row, cell.col) for cell in sheet.cells if cell.style == styles.INPUT]
    assert sorted(inputs) == [(HEAD_ROW, 1), (HEAD_ROW, 2), (FIRST + 1, 0)]
    (formula,) = [fill for fill in sheet.fills if fill.style == styles.INPUT]
    assert (formula.row, formula.col) == (FIRST, 0)
    (chart,) = sheet.charts
    assert [series.x.area.last_row for series in chart.series] == [FIRST + 1] * 2
    assert chart.x_axis.title == "a₂ [mm]"
    assert all(column.hidden for column in sheet.columns if column.level)
