"""Every sketched point decides: of all assemblies the one is taken that has the points nearest to their sketch."""

import itertools

import pytest

from chosen import part
from folders import TEMPLATE_FILES
from mechsheet import reference
from mechsheet.description import load, loads
from mechsheet.description.report import located
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from partial_sketches import case_of, linkage

COUNT = 300
EXACT = 1e-5


def sketched(name, entries):
    """A template with another sketch."""
    text = template_text(name)
    head, _, tail = text.partition("[assembly]\n")
    lines = "".join(f"{key} = {value}\n" for key, value in entries.items())
    _, _, after = tail.partition("\n\n")
    return loads(f"{head}[assembly]\n{lines}\n{after}")


def first_position(mechanism, equations):
    """Every point in the first row."""
    values = sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))
    names = {point for link in mechanism.links for point in link.points}
    return {name: (float(values[f"{name}.x"][0]), float(values[f"{name}.y"][0])) for name in names}


def judge(case, label):
    """Assert that the assembly meant is built, and that what is left open is what nothing sketched distinguishes."""
    if case is None or not case.means:
        pytest.skip("the points sketched tell nothing")
    equations = solve(case.mechanism)
    found = first_position(case.mechanism, equations)
    assert case.missed(found) < EXACT, (label, case.sketched)
    if case.alone:
        assert case.missed(found, everywhere=True) < EXACT, (label, case.sketched)
        assert not any(group.open for group in equations.groups), (label, case.sketched)
    else:
        assert any(group.open for group in equations.groups), (label, case.sketched)


@pytest.mark.parametrize("lifted", [False, True], ids=["driven-at-the-ground", "driven-between-moving-links"])
@pytest.mark.parametrize("seed", part(range(COUNT), 15))
def test_one_to_three_points_roughly_sketched(seed, lifted):
    """5 % of the size off, in any assembly; half of the linkages are driven by a cylinder between two moving links."""
    judge(case_of(linkage(seed, lifted), seed), seed)


@pytest.mark.parametrize("path", part(TEMPLATE_FILES, 5, 1), ids=lambda path: path.stem)
def test_any_points_of_a_template(path):
    mechanism = load(path)
    judged = 0
    if mechanism.synthesis or mechanism.relations or mechanism.redundant or mechanism.sketch.at is not None:
        pytest.skip("a task, teeth, a link too many, or a sketch of a later position")
    for seed in range(6):
        case = case_of(mechanism, seed, 0.04)
        if case is not None and case.means:
            judge(case, seed)
            judged += 1
    if not judged:
        pytest.skip("one assembly")


def test_two_points_of_a_scissor_lift_with_a_cylinder_between_its_arms():
    """The mirror image of the lift, below its floor, has them elsewhere."""
    mechanism = sketched("scissor-lift-between-arms", {"C": "[490, 100]", "T1": "[980, 200]"})
    equations = solve(mechanism)
    assert first_position(mechanism, equations)["C"][1] > 0
    assert not equations.groups[0].open


def test_a_point_of_the_platform_alone_decides_the_cylinder_too():
    mechanism = sketched("scissor-lift-between-arms", {"W": "[500, 210]"})
    places = first_position(mechanism, solve(mechanism))
    assert places["W"][1] > 0
    assert places["C"][1] > 0


def test_a_mirrored_sketch_is_built_mirrored():
    mechanism = sketched("scissor-lift-between-arms", {"C": "[490, -100]", "R": "[980, 0]"})
    assert first_position(mechanism, solve(mechanism))["C"][1] < 0


def test_the_reference_takes_the_same():
    for seed in range(0, 24, 2):
        try:
            case = case_of(linkage(seed, lifted=False), seed)
        except MechsheetError:
            continue
        if case is None or not case.means or not case.alone:
            continue
        theirs = reference.solve(case.mechanism)
        found = {name: tuple(places[0]) for name, places in theirs.points.items()}
        assert case.missed(found, everywhere=True) < EXACT, seed


FOUR_BARS = """format = 1
[mechanism]
name = "two-four-bars"
[links.ground]
points = { A0 = [0, 0], B0 = [70, 0], D0 = [160, 0] }
[links.crank]
points = { A0 = [0, 0], A = [35, 0] }
[links.coupler]
points = { A = [0, 0], B = [62.3, 0] }
[links.rocker]
points = { B0 = [0, 0], B = [56, 0], C = [30, 20] }
[links.rod]
points = { C = [0, 0], D = [LENGTH, 0] }
[links.lever]
points = { D0 = [0, 0], D = [50, 0] }
[driver]
link = "crank"
start = 60
stop = 90
step = 10
[assembly]
"""


def two_four_bars(sketch, length=100):
    return loads(FOUR_BARS.replace("LENGTH", str(length)) + sketch, "two.toml")


def test_a_sketch_between_two_combinations_is_refused():
    """D is half way between its places with either assembly of the group before."""
    spots = []
    for first in (1, -1):
        mechanism = two_four_bars("")
        spots += [first_position(mechanism, solve(mechanism, {"mode_1": first, "mode_2": 1}))["D"]]
    (x, y), (u, v) = spots
    mechanism = two_four_bars(f"D = [{(x + u) / 2}, {(y + v) / 2}]\n")
    with pytest.raises(MechanismError) as caught:
        solve(mechanism)
    said = str(located(caught.value, mechanism.text, "two.toml"))
    assert "two.toml:21: assembly: the sketch lies between two assemblies of coupler and rocker" in said
    assert "sketch a point nearer to the one that is meant" in said


def test_what_nothing_sketched_tells_is_open():
    groups = solve(two_four_bars("B = [60, 50]\n")).groups
    assert [(group.mode_value, group.open) for group in groups] == [(1, False), (1, True)]


@pytest.mark.slow
def test_an_assembly_that_never_closes_is_not_taken_for_one_that_does():
    """With mode +1 of the first group, which nothing sketched tells, the second would not close."""
    closing = {}
    for length in range(20, 200, 4):
        mechanism = two_four_bars("", length)
        for first in (1, -1):
            try:
                solve(mechanism, {"mode_1": first})
                closing.setdefault(length, []).append(first)
            except MechanismError:
                continue
    length = next(length for length, modes in closing.items() if modes == [-1])
    mechanism = two_four_bars("", length)
    places = first_position(mechanism, solve(mechanism, {"mode_1": -1, "mode_2": 1}))
    assert solve(two_four_bars(f"D = {[*places['D']]}\n", length)).groups[0].mode_value == -1
    with pytest.raises(MechanismError, match="cannot be joined"):  # a clear sketch of the other one
        solve(two_four_bars("B = [64, 56]\n", length))


@pytest.mark.parametrize("name", ["watt-i", "stephenson-ii-class-iv", "klann"])
def test_two_points_of_any_link_say_where_it_is(name):
    mechanism = load(TEMPLATE_FILES[0].parent / f"{name}.toml")
    true = first_position(mechanism, solve(mechanism))
    for link in mechanism.links[1:]:
        for pair in itertools.combinations([point for point in link.points if point not in mechanism.ground.points], 2):
            again = sketched(name, {point: f"[{true[point][0]:.3g}, {true[point][1]:.3g}]" for point in pair})
            found = first_position(again, solve(again))
            for point in link.points:
                assert found[point] == pytest.approx(true[point], abs=1e-6)
