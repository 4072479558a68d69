"""`mechsheet pull`: inputs changed in a workbook, back into the description."""

import random
from dataclasses import replace

import pytest
from edited import edited, laid_out, saved
from placed import places_of

from chosen import first
from livesheet.engine import evaluate
from livesheet.evaluation import computed
from livesheet.formats import read, update_values, write
from livesheet.formula.references import cell_name
from mechsheet.checking.edited.edits import same
from mechsheet.checking.edited.pull import input_places, pull
from mechsheet.checking.inputs import expected_for
from mechsheet.checking.perturbation import drawn
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.layout import lay_out

pytestmark = pytest.mark.slow


def typed(workbook, path):
    """The file with the results that stood there before: inputs come back whether anything was computed or not."""
    write(workbook, path)
    return path


def template(name):
    return template_text(name)


def cells_of(plan, **values):
    """`a2=30` as the cell Mechanism_B11=30."""
    spots = places_of(plan)
    return {f"{spots[symbol].sheet}_B{spots[symbol].row + 1}": value for symbol, value in values.items()}


def changed_lines(old, new):
    pairs = zip(old.rstrip("\n").split("\n"), new.rstrip("\n").split("\n"), strict=True)
    return [after for before, after in pairs if before != after]


def held(text, path):
    """Whether a description builds a workbook with the inputs that a file holds: what differs."""
    expected, book = expected_for(text, "new"), read(path)
    return [
        key
        for key, (title, row, col) in input_places(expected)
        if not same(expected.book.sheet(title).constants.get(row, col), book.sheet(title).constants.get(row, col))
    ]


@pytest.fixture(scope="module")
def four_bar():
    workbook, plan = laid_out("four-bar")
    return computed(workbook), plan


@pytest.mark.cases(1)
@pytest.mark.parametrize("suffix", ["xlsx", "ods"])
def test_only_what_was_changed_is_changed(four_bar, tmp_path, suffix):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, a1=72.5, a2=36.0)), tmp_path / f"e.{suffix}")
    found = pull(path)
    assert found.changes == ("a1: 70 -> 72.5", "a2: 35 -> 36")
    lines = changed_lines(template("four-bar"), found.text)
    assert [line.split(",")[0] for line in lines] == ["a1 = { value = 72.5", "a2 = { value = 36"]
    assert held(found.text, path) == []


def test_nothing_changed_gives_the_description_back(four_bar, tmp_path):
    found = pull(typed(four_bar[0], tmp_path / "e.xlsx"))
    assert found.changes == ()
    assert found.text.rstrip("\n") == template("four-bar").rstrip("\n")


def test_angles_stay_in_their_unit(tmp_path):
    text = template("four-bar").replace(
        'gamma3 = { formula = "acos((a3^2 + b3^2 - c3^2) / (2*a3*b3))"', "gamma3 = { value = 35"
    )
    mechanism = loads(text)
    workbook, plan = lay_out(mechanism, solve(mechanism))
    path = saved(edited(workbook, **cells_of(plan, gamma3=40.0)), tmp_path / "e.xlsx")
    assert changed_lines(text, pull(path).text)[0].startswith("gamma3 = { value = 40,")


def test_tolerances_given_changed_and_taken_away(four_bar, tmp_path):
    text = template("four-bar").replace("a3 = { value = 62.3", "a3 = { value = 62.3, tolerance = 0.1")
    text = text.replace("a4 = { value = 56", "a4 = { tolerance = 0.2, value = 56")
    mechanism = loads(text)
    workbook, plan = lay_out(mechanism, solve(mechanism))
    rows = {symbol: plan.at.spots[symbol].row + 1 for symbol in ("a2", "a3", "a4")}
    changes = {f"Mechanism_D{rows['a2']}": 0.05, f"Mechanism_D{rows['a3']}": 0.3, f"Mechanism_D{rows['a4']}": None}
    path = saved(edited(workbook, **changes), tmp_path / "e.xlsx")
    found = pull(path)
    assert found.changes == (
        "tolerance of a2: not given -> 0.05",
        "tolerance of a3: 0.1 -> 0.3",
        "tolerance of a4: 0.2 -> taken away",
    )
    tolerances = {dim.symbol: dim.tolerance for dim in loads(found.text).dimensions}
    assert (tolerances["a2"], tolerances["a3"], tolerances["a4"]) == (0.05, 0.3, None)


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("changes", "driver"),
    [
        ({"start": 10.0}, {"start": 10, "stop": 370, "step": 15}),
        ({"step": 10.0}, {"start": 0, "stop": 240, "step": 10}),
        ({"start": 360.0, "step": -7.5}, {"start": 360, "stop": 180, "step": -7.5}),
    ],
)
def test_the_sweep_keeps_its_rows(four_bar, tmp_path, changes, driver):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, **changes)), tmp_path / "e.xlsx")
    text = pull(path).text
    for key, value in driver.items():
        assert f"\n{key} = {value}\n" in text
    assert held(text, path) == []


def test_heads_of_tables_and_listed_driver_values(tmp_path):
    text = template("adjustable-pump").replace(
        "start = 0\nstop = 360\nstep = 20\n", 'values = [0, 20.0, "pi/4", 100] # by hand\n'
    )
    table = '[[tables]]\nrows = { a2 = [35, "a2"] }\ncolumns = { s1 = [20] }\nvalue = "kurs"\n\n[workbook]'
    text = text.replace("[workbook]", table)
    mechanism = loads(text)
    workbook, plan = lay_out(mechanism, solve(mechanism))
    table = next(sheet.title for sheet in workbook.sheets if sheet.title.startswith("Tablo s15"))
    (row, col) = min(
        (cell.row, cell.col)
        for cell in next(s for s in workbook.sheets if s.title == table).cells
        if cell.content == 50.0
    )
    changes = {f"{table}_{chr(65 + col)}{row + 1}": 60.0, f"Konumlar_B{plan.at.first + 2}": 25.0}
    changes |= {"Tablo kurs_A8": 40.0, "Tablo kurs_B7": 30.0}
    path = saved(edited(workbook, **changes), tmp_path / "e.xlsx")
    assert changed_lines(text, pull(path).text) == [
        'values = [0, 25.0, "pi/4", 100] # by hand',
        "columns = { s1 = [20, 60, 100, 150, 200, 250] }",
        'rows = { a2 = [40, "a2"] }',
        "columns = { s1 = [30] }",
    ]


def test_a_flipped_mode_becomes_a_sketch_that_means_it(four_bar, tmp_path):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, mode_1=-1.0)), tmp_path / "e.xlsx")
    text = pull(path).text
    (line,) = changed_lines(template("four-bar"), text)
    assert line.startswith("B = [")
    assert solve(loads(text)).groups[0].mode_value == -1
    assert held(text, path) == []


def test_a_mode_without_a_sketch(tmp_path):
    text = template("four-bar").replace("[assembly]\nB = [50, 55]\n", "")
    mechanism = loads(text)
    workbook, plan = lay_out(mechanism, solve(mechanism))
    assert plan.equations.groups[0].open
    path = saved(edited(workbook, **cells_of(plan, mode_1=-1.0)), tmp_path / "e.xlsx")
    assert held(pull(path).text, path) == []


NAMES = ("slider-crank", "adjustable-pump", "stephenson-i", "oldham")


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", first(NAMES, 1))
@pytest.mark.ci
def test_random_inputs_come_back(tmp_path, name):
    """Any set that a description can say: with the text, the same workbook is built again."""
    workbook, plan = laid_out(name)
    path, output = saved(workbook, tmp_path / "old.xlsx"), tmp_path / "new.xlsx"
    book, draw = read(path), random.Random(name)
    done = 0
    for _ in range(6):
        spots = plan.at.spots
        values = drawn(plan, draw).items()
        changes = {(spots[key].sheet, spots[key].row, spots[key].col): value for key, value in values}
        update_values(path, output, book, evaluate(book, changes), changes)
        try:
            text = pull(output).text
        except MechsheetError as error:
            assert any(word in str(error) for word in ("cannot be joined", "has no value", "no point lies")), error
            continue
        assert held(text, output) == []
        done += 1
        if done == 2:
            return
    assert done


# --- into another description --------------------------------------------------------------------------------------


def test_into_a_description_that_went_on(four_bar, tmp_path):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, a1=72.5, a4=57.0)), tmp_path / "e.xlsx")
    mine = tmp_path / "mine.toml"
    mine.write_text(
        template("four-bar")
        .replace("value = 35", "value = 33")
        .replace("value = 56", "value = 57")
        .replace("# Four-bar", "# My four-bar"),
        encoding="utf-8",
    )
    found = pull(path, mine)
    assert found.changes == ("a1: 70 -> 72.5",)
    assert [line[:20] for line in changed_lines(mine.read_text(encoding="utf-8"), found.text)] == [
        "a1 = { value = 72.5,"
    ]


def test_windows_line_ends_and_byte_order_mark_stay(four_bar, tmp_path):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, a1=72.5)), tmp_path / "e.xlsx")
    mine = tmp_path / "mine.toml"
    mine.write_bytes(b"\xef\xbb\xbf" + template("four-bar").replace("\n", "\r\n").encode())
    text = pull(path, mine).text
    assert text == "\ufeff" + template("four-bar").replace("value = 70", "value = 72.5").replace("\n", "\r\n")


@pytest.mark.cases(2)
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("value = 70", "value = 71", "is 71 here and 72.5 in"),
        ('"a1"', "70", "no input"),
        ("value = 70,", 'formula = "2*a2",', "no input"),
    ],
    ids=["both changed", "gone", "derived"],
)
def test_conflicts(four_bar, tmp_path, old, new, message):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, a1=72.5)), tmp_path / "e.xlsx")
    text = template("four-bar").replace(old, new)
    if new == "70":
        text = text.replace("a1 = { value", "a9 = { value")
    mine = tmp_path / "mine.toml"
    mine.write_text(text, encoding="utf-8")
    with pytest.raises(MechsheetError, match=r"mine\.toml") as caught:
        pull(path, mine)
    assert message in str(caught.value)


# --- what cannot be pulled -----------------------------------------------------------------------------------------


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("value", "message"),
    [("thirty", "must hold a number, not thirty"), (None, "not an empty cell"), ("=5*7", "holds a formula now")],
)
def test_inputs_that_are_no_numbers(four_bar, tmp_path, value, message):
    workbook, plan = four_bar
    path = saved(edited(workbook, **cells_of(plan, a2=value)), tmp_path / "e.xlsx")
    with pytest.raises(MechsheetError, match=message) as caught:
        pull(path)
    assert f"Mechanism!B{plan.at.spots['a2'].row + 1}" in str(caught.value)


def test_dimensions_with_which_nothing_assembles(four_bar, tmp_path):
    workbook, plan = four_bar
    path = typed(edited(workbook, **cells_of(plan, a1=700.0)), tmp_path / "e.xlsx")
    with pytest.raises(MechsheetError, match="cannot be joined at any value of the driver"):
        pull(path)


def test_a_foreign_workbook(tmp_path, four_bar):
    workbook = replace(four_bar[0], sheets=four_bar[0].sheets[:-1])
    write(computed(workbook), tmp_path / "foreign.xlsx")
    with pytest.raises(MechsheetError, match="carries no description"):
        pull(tmp_path / "foreign.xlsx")


def test_the_speed_of_the_driver(tmp_path):
    text = template("four-bar").replace("[driver]", '[driver]\nspeed = { value = 60, unit = "rpm" }')
    mechanism = loads(text)
    workbook, plan = lay_out(mechanism, solve(mechanism))
    path = saved(edited(workbook, **cells_of(plan, speed=90, alpha12=2)), tmp_path / "e.xlsx")
    found = pull(path)
    assert found.changes == ("speed of the driver: 60 -> 90", "acceleration of the driver: 0 -> 2")
    assert 'speed = { value = 90, unit = "rpm" }' in found.text
    assert loads(found.text).driver_rates == ("omega12", "alpha12")
    assert held(found.text, path) == []


def test_a_duration_and_listed_speeds(tmp_path):
    """What stands in the driver's own cells, deep in an inline table or in a list."""
    head, _, tail = template("scotch-yoke").partition("[driver]\n")
    link, rest = tail.split("\n", 1)
    rest = "\n".join(line for line in rest.split("\n") if not line.startswith(("start", "stop", "step", "speed")))
    law = 'start = 0\nstop = 90\nmotion = { law = "harmonic", duration = 2, rows = 3 }  # s\n'
    lists = "values = [0, 10, 5]\nspeed = [1, 0, -1]\n"
    for driver, cell, wanted in (
        (law, "duration", "duration = 3.5, rows = 3 }  # s"),
        (lists, "omega12", "[1, 0, 3.5]"),
    ):
        mechanism = loads(f"{head}[driver]\n{link}\n{driver}{rest}")
        workbook, plan = lay_out(mechanism, solve(mechanism))
        spot = plan.at.spots[cell]
        place = f"{spot.sheet}_{cell_name(plan.at.last if spot.column else spot.row, spot.col)}"
        found = pull(saved(edited(workbook, **{place: 3.5}), tmp_path / "typed.xlsx"))
        assert len(found.changes) == 1
        assert wanted in found.text


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("symbol", "value", "mode"), [("psi_p2", 80.5, 1), ("psi_p2", 81.0, -1), ("theta_p3", 130.0, None)]
)
def test_the_assembly_of_a_task_follows_the_task(tmp_path, symbol, value, mode):
    """Also when the new task asks for the other one: no sketch has to say so."""
    workbook, plan = laid_out("function-generator")
    spot = plan.at.spots[symbol]
    path = saved(edited(workbook, **{f"{spot.sheet}_B{spot.row + 1}": value}), tmp_path / "e.xlsx")
    found = pull(path)
    assert len(changed_lines(template("function-generator"), found.text)) == 1
    (group,) = solve(loads(found.text)).groups
    assert mode is None or group.mode_value == mode
    assert held(found.text, path) == []
