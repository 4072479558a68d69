"""The line of verdicts: what is to be said of a description."""

import pytest

import mechsheet
from mechsheet.checking.edited.pull import pull
from mechsheet.library.building import told
from mechsheet.library.verdicts import verdict

FOUR_BAR = """format = 1
[mechanism]
name = "four-bar"
[links.ground]
points = { A0 = [0, 0], B0 = [70, 0] }
[links.crank]
points = { A0 = [0, 0], A = [35, 0] }
mass = 0.5
center = "A0"
[links.coupler]
points = { A = [0, 0], B = [62.3, 0] }
mass = 1
center = [30, 5]
INERTIA
[links.rocker]
points = { B0 = [0, 0], B = [56, 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 15
speed = SPEED
[assembly]
B = [50, 55]
"""
SAID = "; moments of inertia not given, 0 taken, of what turns unevenly: coupler"


def of(inertia="", speed="6"):
    return mechsheet.loads(FOUR_BAR.replace("INERTIA", inertia).replace("SPEED", speed))


@pytest.mark.slow
def test_a_mass_that_turns_without_inertia_is_told():
    assert verdict(told(of())).endswith(SAID)


@pytest.mark.slow
@pytest.mark.parametrize("inertia", ["inertia = 0.001", "inertia = 0"])
def test_one_that_is_given_is_not(inertia):
    assert "inertia" not in verdict(told(of(inertia)))


@pytest.mark.slow
def test_a_crank_that_speeds_up_is_told_too():
    line = verdict(told(of(speed='"5 + cos(theta12)"')))
    assert line.endswith("of what turns unevenly: crank, coupler")


@pytest.mark.slow
def test_what_does_not_turn_needs_none():
    assert "inertia" not in verdict(told(mechsheet.template("engine")))


@pytest.mark.slow
def test_it_has_a_cell_and_what_is_typed_there_comes_back(tmp_path):
    (built,) = of().build(tmp_path, formats="xlsx")
    session = mechsheet.open_book(built)
    before = session.table("Forces!A8:Z8")
    session.set("J_3", 0.002)
    assert session.table("Forces!A8:Z8") != before
    session.write(built)
    assert mechsheet.check(built).values_agree
    assert "inertia = 0.002" in pull(built).text


@pytest.mark.slow
def test_in_turkish():
    linkage = mechsheet.loads(of().text, language="tr")
    assert verdict(told(linkage)).endswith("; atalet momentleri verilmedi, 0 alındı; düzgün dönmeyen uzuvlar: biyel")
