"""No marks for guessing: which column is the answer, which rows it answers, and how little numbers alone are worth."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import mechsheet
from chosen import first
from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from mechsheet.homework.audit import answered
from mechsheet.homework.headings import aliases_of, called

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
    columns = [("krank", "deg", STEPS[::2])]
    columns += [column for column in four_bar() if column[1] in ("fi", "xA", "yA", "s")]
    columns.append(("psi", "q", "ACOS(({a4}^2+{s}^2-{a3}^2)/(2*{a4}*{s}))"))
    columns += [(text, f"g{n}", guess) for n, (text, guess) in enumerate(zip(headings, GUESSES, strict=True))]
    return Table(FOUR_BAR, [*columns, *more])


GUESSED = {
    "beside numbers that are headed so": ([""] * 4, [("theta14", "w", [n / 7 for n in range(13)])]),
    "without a name anywhere": ([""] * 4, []),
    "beside a wrong one that is headed so": ([""] * 4, [("theta14", "w", "{fi}+{q}")]),
    "beside a wrong one headed otherwise too": (["a", "b", "c", "d"], [("Teta14 (rad)", "w", "{fi}+{q}")]),
    "all headed so": (["theta14"] * 4, []),
    "all headed so and numbered": (["theta14 (1)", "theta14 (2)", "theta14 (3)", "theta14 (4)"], []),
    "each called something": (["a", "b", "c", "d"], []),
    "headed as something else": (["theta13", "", "", ""], []),
}


@pytest.mark.slow
@pytest.mark.parametrize("how", first(list(GUESSED), 2))
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
    begun = [round(math.radians(value), 1) for value in solved["theta14"]]
    table = with_guesses(["theta14_3", "", "", ""], ("theta14", "start", begun[::2]))
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


@pytest.mark.slow
def test_a_number_of_a_few_rows_is_not_that_of_all(tmp_path):
    """The least transmission angle of the first rows; typed over all rows in the same cell it is right."""
    text = mechsheet.template("four-bar").text + "\n[exercise]\nasked = { mu_min = 1 }\n"
    mechanism = mechsheet.loads(text, "least")
    for start, mark in ((0.0, 1.0), (180.0, 4 / 25)):  # it is least at 0 degrees
        columns = [("krank", "deg", [start + 15 * n for n in range(4)]), *four_bar()[1:]]
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


SAID = {
    "θ14 [°]": ({"theta14"}, True),
    "Teta14 (radyan)": ({"theta14"}, True),
    "C x [mm]": ({"C.x"}, True),
    "rocker angle theta14": ({"theta14"}, False),
    "mu": ({"mu"}, True),
    "Kapanıyor mu": (set(), False),  # Turkish: "does it close"
    "cos theta14": (set(), False),
    "s″14 [mm/s²]": (set(), False),
    "θ̇14": (set(), False),
    "theta14 + theta13": (set(), False),
    "∂deviation/∂a1": (set(), False),
}


@pytest.mark.parametrize("text", SAID)
def test_what_a_heading_names(text):
    symbols = ("theta13", "theta14", "s14", "mu", "C.x", "deviation")
    found = called([text], aliases_of(symbols))
    assert (set(found.symbols), found.alone) == SAID[text]


def test_a_formula_under_a_heading_names_what_it_reads():
    symbols = ("theta13", "theta14", "A.x", "s14")
    assert called(["s14 [mm]", "mode1·w + xA"], aliases_of(symbols)).symbols == {"s14"}
    assert called(["slide [mm]", "mode1·w + xA"], aliases_of(symbols)).symbols == set()


@pytest.mark.ci
@pytest.mark.parametrize("name", ["engine", "fivelink"])
def test_derivatives_and_forces_in_other_sheets_are_no_answers(tmp_path, name):
    """Our own workbook has a column s″14 for s14, and one that asks 'Kapanıyor mu' for mu."""
    mechanism = mechsheet.template(name)
    mechsheet.build(mechanism, tmp_path / "own.xlsx")
    found = mechsheet.audit(tmp_path / "own.xlsx", mechanism)
    assert found.right
    assert found.faults == ()


def pasted(mechanism, heads=("theta13", "theta14", "mu"), offset=0.0):
    """The crank's column, and the right values under these headings, as numbers."""
    solved = mechsheet.template("four-bar", {name: value for _, name, value in FOUR_BAR}).solve()
    columns = [("krank", "deg", STEPS)]
    columns += [
        (name, f"v{n}", [math.radians(value) - offset for value in solved[name]]) for n, name in enumerate(heads)
    ]
    return columns


LIKE_FORMULAS = {
    "as they are": [],
    "read by formulas": ["{%s}*1"],
    "read by formulas that name every dimension": ["{%s}+0*({a1}+{a2}+{a3}+{a4})"],
    "from another zero": ["{%s}+PI()/2"],
}


@pytest.mark.cases(3)
@pytest.mark.slow
@pytest.mark.parametrize("how", LIKE_FORMULAS)
def test_pasted_numbers_have_half_marks(tmp_path, mechanism, how):
    """A sheet of values alone could not be judged; values of another zero that formulas read were right."""
    names = ("theta13", "theta14", "mu")
    columns = pasted(mechanism, offset=math.pi / 2 if "zero" in how else 0.0)
    for formula in LIKE_FORMULAS[how]:
        hidden = [("", name, values) for _, name, values in columns[1:]]
        columns = [columns[0], *hidden, *((symbol, symbol, formula % f"v{n}") for n, symbol in enumerate(names))]
    mark, found = marked(tmp_path, mechanism, Table(FOUR_BAR, columns))
    assert {one.verdict for one in found.asked.values()} == {"not live"}
    assert mark == 1.5


@pytest.mark.slow
def test_pasted_numbers_without_any_dimension_have_half_marks(tmp_path):
    """No dimension could be retyped, so nothing showed that the formulas follow none."""
    mechanism = mechsheet.template("four-bar", {name: value for _, name, value in FOUR_BAR})
    columns = pasted(mechanism)
    hidden = [("", name, values) for _, name, values in columns[1:]]
    columns = [columns[0], *hidden, *((s, s, f"{{v{n}}}*1") for n, s in enumerate(("theta13", "theta14", "mu")))]
    mark, found = marked(tmp_path, mechanism, Table((), columns))
    assert {one.verdict for one in found.asked.values()} == {"not live"}
    assert mark == 1.5


NUMBERS = {
    "to the right": ({"across": True}, 25),
    "three rows": ({}, 3),
    "a coarser step": ({}, 13),
}


@pytest.mark.slow
@pytest.mark.parametrize("how", NUMBERS)
def test_a_table_of_numbers_is_read_in_any_direction(tmp_path, mechanism, how):
    """Where nothing is computed no formula says where the table goes: it was not found, or only in the other direction."""
    options, rows = NUMBERS[how]
    columns = [(heading, name, values[:: 24 // (rows - 1)]) for heading, name, values in pasted(mechanism)]
    _, found = marked(tmp_path, mechanism, Table(FOUR_BAR, columns, **options))
    assert {one.verdict for one in found.asked.values()} == {"not live"}
    assert found.faults == ()


@pytest.mark.slow
@pytest.mark.parametrize(("value", "kind"), [(77.7, "wrong number"), (None, "no number")])
def test_a_wrong_number_among_numbers_is_told(tmp_path, mechanism, value, kind):
    columns = pasted(mechanism)
    table = Table(FOUR_BAR, columns, cells={"C20": value})
    mark, found = marked(tmp_path, mechanism, table)
    (fault,) = found.faults
    assert (fault.cells, fault.kind) == ("Sayfa1!C20", kind)
    assert float(fault.mend) == pytest.approx(columns[2][2][11], rel=1e-5)
    assert mark == 1.0


@pytest.mark.slow
def test_noise_beyond_the_tolerance_has_no_marks(tmp_path, mechanism):
    draw = np.random.default_rng(7)
    columns = [
        (h, n, v if n == "deg" else [x + d for x, d in zip(v, draw.uniform(-1e-3, 1e-3, len(v)), strict=True)])
        for h, n, v in pasted(mechanism)
    ]
    assert marked(tmp_path, mechanism, Table(FOUR_BAR, columns))[0] == 0


SINGLE = {
    "the right formula": ({"A40": "mu_min", "B40": "=MIN(L9:L33)"}, 1.0),
    "typed as a number": ({"A40": "mu_min", "B40": math.degrees(0.887056)}, 0.5),
    "right in a cell without a name": ({"B40": "=MIN(L9:L33)"}, 1.0),
    "another cell has the name": ({"A40": "mu_min", "B40": "=12+0*B2", "S3": "=MIN(L9:L33)"}, 0.0),
    "the last one with the name": ({"A40": "mu_min", "B40": "=MIN(L9:L33)", "A41": "mu_min", "B41": "=12+0*B2"}, 0.0),
    "hit by a row of guesses": ({f"S{n}": f"={50.82 + n * 0.0005}+0*B2" for n in range(1, 20)}, 0.0),
}


@pytest.mark.cases(3)
@pytest.mark.slow
@pytest.mark.parametrize("how", SINGLE)
def test_a_single_number_is_the_cell_that_is_called_so(tmp_path, how):
    text = mechsheet.template("four-bar").text + "\n[exercise]\nasked = { mu_min = 1 }\n"
    cells, mark = SINGLE[how]
    table = Table(FOUR_BAR, four_bar(), cells=cells)
    assert marked(tmp_path, mechsheet.loads(text, "least"), table)[0] == mark


@pytest.mark.slow
def test_pasted_numbers_of_a_task_have_half_marks(tmp_path):
    """The lengths follow from a task: that they cannot be retyped one by one was taken for being live."""
    mechanism = mechsheet.template("crank-rocker-swing")
    solved = mechanism.solve()
    columns = [(name, f"v{name}", [math.radians(x) for x in solved[name]]) for name in ("theta13", "theta14")]
    columns = [("theta12", "deg", [float(x) for x in solved["theta12"]]), *columns]
    found = marked(tmp_path, mechanism, Table((), columns))[1]
    assert {one.verdict for symbol, one in found.asked.items() if symbol.startswith("theta")} == {"not live"}


@pytest.mark.slow
def test_pasted_numbers_of_another_assembly_have_half_marks_at_most(tmp_path, mechanism):
    """None, as for any other assembly; with `--assembly any` half, as for pasted numbers."""
    other = mechsheet.template("four-bar", {name: value for _, name, value in FOUR_BAR} | {"mode_1": -1}).solve()
    columns = [("krank", "deg", STEPS)]
    columns += [(s, f"v{s}", [math.radians(x) for x in other[s]]) for s in ("theta13", "theta14")]
    path = Table(FOUR_BAR, columns).save(tmp_path / "book.xlsx")
    for assembly, mark in (("", 0.0), ("any", 1.0)):
        (one,) = mechsheet.mark([path], mechanism, assembly=assembly).students
        assert one.mark == mark


def test_what_is_accepted_in_another_convention_is_said(tmp_path):
    """A rate in turns a minute; it was taken for wrong, and one times 60/2π the wrong way round for right."""
    text = mechsheet.template("four-bar").text.replace(
        "step = 15\n", 'step = 15\nspeed = { value = 60, unit = "rpm" }\n', 1
    )
    mechanism = mechsheet.loads(text + "\n[exercise]\nasked = { omega14 = 1 }\n", "speeds")
    speed = "2*PI()*{a2}*SIN({t13}-{fi})/({a4}*SIN({t13}-{t14}))*30/PI()"
    table = Table(FOUR_BAR, [*four_bar(), ("omega14 [rpm]", "w", speed)])
    found = marked(tmp_path, mechanism, table)[1]
    assert found.asked["omega14"].verdict == "right"
    assert "omega14 is written in another unit: times 0.10472" in found.remarks
