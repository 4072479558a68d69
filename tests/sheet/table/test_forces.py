"""The sheet of forces, its inputs and its words, as a person meets them."""

import re

import numpy as np
import pytest
from laid import Laid

from livesheet.evaluation import book_of
from livesheet.formula.nodes import Call, ErrorValue, Number
from livesheet.formula.printer import print_formula
from mechsheet import loads
from mechsheet.checking import check
from mechsheet.checking.against_reference import against_plan
from mechsheet.description.templates import template_text
from mechsheet.kinematics.equations import JOINT_FORCES
from mechsheet.library.building import build
from mechsheet.library.show import overview_text

pytestmark = pytest.mark.slow

MORE = '[dynamics]\ngravity = 9.81\n[[loads]]\nname = "P"\nlink = "coupler"\npoint = "C"\nforce = [0, -20]\n'


def four_bar(more=MORE):
    return f"""
format = 1
[mechanism]
name = "four-bar-with-masses"
[dimensions]
a1 = 70
a2 = 35
a3 = 62.3
a4 = 56
[links.ground]
points = {{ A0 = [0, 0], B0 = ["a1", 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
mass = 0.8
center = [17.5, 0]
inertia = 2e-4
[links.coupler]
points = {{ A = [0, 0], B = ["a3", 0], C = [31, 20] }}
mass = 1.5
center = [31, 8]
inertia = 9e-4
[links.rocker]
points = {{ B0 = [0, 0], B = ["a4", 0] }}
mass = 1.2
center = [28, 0]
inertia = 6e-4
[driver]
link = "crank"
start = 0
stop = 360
step = 30
speed = 30
[assembly]
B = [63, 55]
{more}"""


def test_the_sheet_stands_behind_the_rates_and_is_lean():
    laid = Laid(four_bar())
    titles = [sheet.title for sheet in laid.workbook.sheets]
    assert titles[1:4] == ["Positions", "Rates", "Forces"]
    assert [column.symbol for column in laid.plan.forces] == [
        "T12", "T12.work",
        "G3.x", "G3.y", "G3.ax", "G3.ay", "S3_x", "S3_y", "M3",
        "G4.x", "G4.y", "G4.ax", "G4.ay", "S4_x", "S4_y", "M4",
        "F34.x", "F34.y", "F34", "F23.x", "F23.y", "F23", "F14.x", "F14.y", "F14",
        "G2.x", "G2.y", "G2.ax", "G2.ay", "F12.x", "F12.y", "F12", "part", "part_1",
    ]  # fmt: skip
    sheet = laid.workbook.sheet("Forces")
    assert {column.first for column in sheet.columns if column.level} == {
        column.col for column in laid.plan.forces if column.inner
    }


def test_formulas_can_be_read():
    name = "whitworth"
    text = re.sub(r"(?m)^layout *=.*$", "", template_text(name))
    text = re.sub(r"(?m)^speed *=.*$", "", text)
    text = re.sub(r"(?m)^\[driver\]", "[driver]\nspeed = 3", text)
    text = re.sub(r"(?m)^(\[links\.\w+\])$", r"\1\nmass = 1\ncenter = [3, 4]\ninertia = 1e-3", text)
    first = next(link.name for link in loads(template_text(name)).links)
    text = text.replace(f"[links.{first}]\nmass = 1\ncenter = [3, 4]\ninertia = 1e-3", f"[links.{first}]")
    laid = Laid(text + "\n[dynamics]\ngravity = 9.81\n")
    work = laid.plan.at.spots[laid.plan.efforts[1]].col
    for fill in laid.workbook.sheet(laid.plan.at.titles["forces"]).fills:
        assert len(print_formula(fill.formula, "excel")) <= (250 if fill.col == work else 130)


def test_masses_loads_and_gravity_are_inputs():
    laid = Laid(four_bar())
    before = {name: np.array(laid.column(name)) for name in ("T12", "F34")}
    names = {name.name for name in laid.workbook.names}
    assert {"m_2", "J_2", "x_G2", "y_G2", "P_y", "largest_effort", "largest_force", "effort_fits"} <= names
    assert laid.spot("largest_effort") == pytest.approx(max(abs(before["T12"])))
    assert laid.spot("effort_fits") < 1e-12
    assert laid.words("effort_fits") == "reactions and virtual work agree"
    assert laid.words("largest_force").startswith("the largest joint force among the rows: F")
    doubled = {name: 2 * laid.spot(name) for name in ("m_2", "m_3", "m_4", "J_2", "J_3", "J_4", "P_y")}
    laid.change(**doubled)
    for name, column in before.items():
        assert np.array(laid.column(name)) == pytest.approx(2 * column, rel=1e-12)


@pytest.mark.parametrize(("force", "names"), [("[0, 50000]", ": F₁₄ₙ"), ("[-50000, 0]", ": F₃₄ F₂₃ F₁₂")])
def test_the_largest_joint_force_may_be_that_of_a_guide(force, names):
    """A piston that is pressed against its cylinder: who sizes the guide must not read a pin's name beside the force."""
    text = template_text("slider-crank") + f'[[loads]]\nlink = "piston"\npoint = "B"\nforce = {force}\n'
    laid = Laid(text)
    sizes = {name: np.abs(laid.column(name)).max() for name in laid.plan.equations.equations.forces(*JOINT_FORCES)}
    assert laid.spot("largest_force") == pytest.approx(max(sizes.values()), rel=1e-12)
    assert laid.words("largest_force").endswith(names)


ARM = """
format = 1
mechanism.name = "arm"
links.ground.points = { S = [0, 0] }
links.upper = { points = { S = [0, 0], E = [300, 0] }, mass = 2, center = [150, 0] }
links.forearm = { points = { E = [0, 0], H = [250, 0] }, mass = 1, center = [125, 0] }
driver = { link = "upper", start = 10, stop = 80, step = 5 }
drivers = [{ link = "forearm", relative_to = "upper", symbol = "elbow", follows = "radians(120) - 2*theta12" }]
loads = [{ link = "forearm", point = "H", force = [0, -20] }]
dynamics.gravity = 9.81
"""


@pytest.mark.slow
def test_each_motor_has_its_largest_effort():
    """Who sizes the elbow's motor by the one line that there was took the shoulder's for it."""
    laid = Laid(ARM)
    angles = np.array(laid.column("theta12"))
    for key, effort in (("largest_effort", "T12"), ("largest_T23", "T23")):
        column = np.abs(laid.column(effort))
        assert laid.spot(key) == pytest.approx(column.max(), rel=1e-12), effort
        at = laid.plan.places.lines[key].row
        assert laid.values.get(laid.plan.main, at, 3) == pytest.approx(angles[column.argmax()])


def test_the_position_shown_has_its_forces_and_there_are_charts():
    laid = Laid(four_bar()).change(**{"_position": 3})
    row = laid.plan.blocks["variables"].rows["T12"]
    assert laid.values.get(laid.plan.main, row, 1) == laid.column("T12")[3]
    charts = {chart.title: chart for chart in laid.workbook.sheets[0].charts}
    effort = charts["T₁₂ against θ₁₂; dashed: by virtual work"]
    assert [(series.name, series.dash) for series in effort.series[:2]] == [("T₁₂", "solid"), ("T₁₂*", "dash")]
    assert "F₃₄, F₂₃, F₁₄, F₁₂ against θ₁₂" in charts


def test_at_a_dead_centre_there_are_no_forces():
    kite = (
        'format = 1\n[mechanism]\nname = "kite"\n[dimensions]\na1 = 80\na2 = 35\na3 = 80\n'
        '[links.ground]\npoints = { A0 = [0, 0], B0 = ["a1", 0] }\n[links.crank]\npoints = { A0 = [0, 0], A = ["a2", 0] }\n'
        '[links.coupler]\npoints = { A = [0, 0], B = ["a3", 0] }\nmass = 1\ncenter = "A"\n'
        '[links.rocker]\npoints = { B0 = [0, 0], B = ["a2", 0] }\n'
        '[driver]\nlink = "crank"\nstart = 150\nstop = 180\nstep = 10\n'
        "[dynamics]\ngravity = 9.81\n[assembly]\nB = [50, 20]\n"
        '[[loads]]\nlink = "rocker"\ntorque = 2\n'
    )
    laid = Laid(kite, "tr")
    assert "Kuvvetler" in [sheet.title for sheet in laid.workbook.sheets]
    assert laid.column("T12")[-1] == ErrorValue("#N/A")
    assert isinstance(laid.column("T12")[-2], float)
    assert isinstance(laid.column("theta14")[-1], float)
    assert "speed 0: static forces" in overview_text(loads(kite))


def test_a_spring_without_a_length_has_no_direction():
    """Where its ends coincide there are no forces, in that row alone."""
    lever = (
        'format = 1\n[mechanism]\nname = "lever"\n[links.ground]\npoints = { A0 = [0, 0], H = [0, 80] }\n'
        "[links.lever]\npoints = { A0 = [0, 0], C = [80, 0] }\n"
        '[driver]\nlink = "lever"\nstart = 70\nstop = 110\nstep = 20\n'
        '[[loads]]\nname = "K"\nbetween = ["C", "H"]\nstiffness = 2\nfree_length = 30\n'
    )
    laid = Laid(lever)
    assert [isinstance(value, float) for value in laid.column("T12")] == [True, False, True]
    assert laid.column("T12")[1] == ErrorValue("#N/A")
    assert laid.column("status") == ["ok"] * 3


def test_damaged_forces_are_noticed_by_the_sheet_and_by_the_reference():
    laid = Laid(four_bar())
    book = book_of(laid.workbook)
    assert against_plan(book, laid.values, laid.plan, "one")[0].agrees
    for symbol in ("M3", "S4_y"):
        laid = Laid(four_bar()).damage(
            "Forces", laid.plan.at.spots[symbol].col, lambda formula: Call("SUM", (formula, Number(1e-4)))
        )
        assert laid.words("effort_fits").startswith("they do not agree"), symbol
        assert not against_plan(book, laid.values, laid.plan, "one")[0].agrees, symbol


@pytest.mark.ci
def test_both_formats_and_the_reference_agree(tmp_path):
    more = (
        '[outputs.gap]\nformula = "T12 - T12.work + 0*F34.x"\nunit = "N m"\n[summary.most]\nof = "F34"\ntake = "max"\n'
    )
    paths = build(loads(four_bar(MORE + more), language="tr"), tmp_path, ["xlsx", "ods"])
    for path in paths:
        report = check(path)
        assert report.agrees, report
        assert max(judged.worst for judged in report.comparisons if judged.judge != "search") < 2e-11


def test_nothing_of_it_without_masses():
    laid = Laid(re.sub(r"(?m)^(mass|center|inertia) = .*$", "", four_bar("")))
    assert not laid.plan.forces
    assert "Forces" not in [sheet.title for sheet in laid.workbook.sheets]
