"""The mean of a summary is that over the motion: the row that closes a turn counts once, everywhere the same."""

import numpy as np
import pytest
from laid import Laid

from chosen import ALL
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet.checking.against_search import against_search
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.asked.two_way import FIRST
from mechsheet.sheet.page.layout import lay_out_page
from mechsheet.sheet.plan import VALUE
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs

FOUR_BAR = """
format = 1
[mechanism]
name = "case"
[dimensions]
a1 = 70
a2 = 35
a3 = 65
a4 = 56
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0] }
[links.rocker]
points = { B0 = [0, 0], B = ["a4", 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 10
[assembly]
B = [60, 60]
[summary]
angle = { of = "theta14", take = "mean" }
place = { of = "B.x", take = "mean" }
"""


def rocker(crank, a1=70.0, a2=35.0, a3=65.0, a4=56.0):
    """The rocker's angle and B.x by the law of cosines, over the crank's angle [deg]; NaN where it does not close."""
    pin = a2 * np.exp(1j * np.radians(crank)) - a1
    with np.errstate(invalid="ignore"):
        inner = np.arccos((abs(pin) ** 2 + a4**2 - a3**2) / (2 * abs(pin) * a4))
    angle = np.angle(pin) % (2 * np.pi) - inner
    return np.degrees(angle), a1 + a4 * np.cos(angle)


def over(low, high, **lengths):
    """The true means, by a fine quadrature."""
    crank = np.linspace(low, high, 20_001)
    return [np.trapezoid(column, crank) / (high - low) for column in rocker(crank, **lengths)]


def means(laid):
    return [laid.spot(f"summary {name}") for name in ("angle", "place")]


@pytest.mark.ci
@pytest.mark.slow
def test_over_a_turn_in_300_linkages():
    """Any crank-rocker, from any start, with the closing row and without it: what a fine quadrature finds. A plain average
    counted the first position twice and was up to several parts in a thousand of the range off."""
    laid, random = Laid(FOUR_BAR), np.random.default_rng(31)
    fuller = Laid(FOUR_BAR.replace("stop = 360", "stop = 350"))
    for _ in range(150 if ALL else 40):
        a2 = random.uniform(20, 35)
        typed = {
            "a2": a2,
            "a1": random.uniform(66, 74),
            "a3": random.uniform(62, 68),
            "_start": random.uniform(-90, 90),
        }
        lengths = {name: typed[name] for name in ("a1", "a2", "a3")}
        wanted = over(typed["_start"], typed["_start"] + 360, **lengths)
        for sheet in (laid, fuller):
            angle, place = means(sheet.change(**typed))
            assert (angle - wanted[0] + 180) % 360 - 180 == pytest.approx(0, abs=2e-3)
            assert place == pytest.approx(wanted[1], abs=2e-3)


@pytest.mark.slow
def test_over_a_part_of_a_turn():
    """Over 0 to 180 degrees the ends count half, as the trapezoidal rule has it."""
    laid = Laid(FOUR_BAR.replace("stop = 360", "stop = 180"))
    assert means(laid) == pytest.approx(over(0, 180), rel=1e-3)
    crank = np.arange(0, 181, 10.0)
    assert means(laid) == pytest.approx([np.trapezoid(column) / 18 for column in rocker(crank)], rel=1e-12)


@pytest.mark.slow
def test_where_rows_are_missing():
    """Over the pairs of neighbouring rows that both exist, whatever stands between the stretches."""
    laid = Laid(FOUR_BAR).change(a1=110)
    there = np.array(laid.exists)
    assert 0 < there.sum() < len(there)
    assert there[0] and there[-1] and not there[18]
    both = there[1:] & there[:-1]
    wanted = []
    for column in (laid.column("theta14"), laid.column("B.x")):
        numbers = np.array([each if isinstance(each, float) else np.nan for each in column])
        wanted.append(np.mean(((numbers[1:] + numbers[:-1]) / 2)[both]))
    assert means(laid) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("rows", [1, 2])
def test_one_row_and_two(rows):
    laid = Laid(FOUR_BAR.replace("stop = 360", f"stop = {10 * rows - 10}"))
    angles = laid.column("theta14")
    assert means(laid)[0] == pytest.approx(sum(angles) / rows)


def test_listed_positions_count_alike():
    listed = FOUR_BAR.replace("start = 0\nstop = 360\nstep = 10", "values = [0, 30, 60, 180]")
    assert means(Laid(listed)) == pytest.approx(
        [np.mean(column) for column in rocker(np.array([0.0, 30.0, 60.0, 180.0]))]
    )


@pytest.mark.slow
def test_two_means_of_one_sheet_agree():
    """The flywheel's mean torque and the summary's."""
    text = template_text("four-bar-forces").replace('acceleration = { value = -40, unit = "rad/s^2" }', "")
    laid = Laid(text + "[flywheel]\nfluctuation = 0.02\n")
    wheel = laid.values.get(laid.plan.main, laid.plan.blocks["verdicts"].rows["mean_torque"], VALUE)
    assert laid.spot("summary mean") == pytest.approx(wheel, rel=1e-12)
    assert Laid(template_text("four-bar-forces")).spot("summary mean") == pytest.approx(-42.2776, abs=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("stop", [360, 350, 140])
def test_page_table_and_study_say_the_same(stop):
    text = FOUR_BAR.replace("stop = 360", f"stop = {stop}")
    wanted = means(Laid(text))
    mechanism = loads(text)
    workbook, plan = lay_out_page(mechanism, solve(mechanism))
    values, rows = evaluate(book_of(workbook)), plan.blocks["summary"].rows
    assert [values.get(plan.main, rows[name], VALUE) for name in ("angle", "place")] == pytest.approx(wanted, rel=1e-9)
    table = Laid(text + '[[tables]]\nrows = { a3 = [65] }\ncolumns = { a2 = [35, 30] }\nvalue = "place"\n')
    title = next(sheet.title for sheet in table.workbook.sheets if sheet.title.startswith("Table"))
    assert table.values.get(title, FIRST, 1) == pytest.approx(wanted[1], rel=1e-9)
    designs = Designs(loads(text + "[study]\nvary = { a2 = [30, 35, 5] }\n"))
    studied = kept_of(designs, 0, 2).columns
    assert [studied[name][1] for name in ("angle", "place")] == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("stop", [360, 350, 140])
def test_check_agrees(stop):
    """The search by which `check` judges the first sheet takes the same mean."""
    laid = Laid(FOUR_BAR.replace("stop = 360", f"stop = {stop}"))
    found = against_search(book_of(laid.workbook), laid.values, laid.plan, "case")
    assert found.agrees, found
