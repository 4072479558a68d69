"""Groups of class III and IV: found, all their assemblies listed, followed as the reference finds them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from folders import TEMPLATES
from judging import judged
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Symbol, symbols, transform
from mechsheet import reference
from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.newton.newton_equations import cramer
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses, sweep
from mechsheet.model import Sketch
from random_mechanisms import Grower


def swept(mechanism, equations=None):
    equations = equations or solve(mechanism)
    return equations, sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))


def platform(**changes):
    mechanism = load(TEMPLATES / "planar-3rpr.toml")
    return replace(mechanism, driver=replace(mechanism.driver, **changes))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("leg", "angles"),
    [
        (5.0, (-0.7208492, -0.3310052, 1.1436855, 2.1159090)),
        (7.0, (-0.6731575, -0.3547403, 0.0377668, 0.4588782, 0.9776729, 2.5138528)),
    ],
)
def test_sauer_finds_as_many_assemblies(leg, angles):
    """T. Sauer, Numerical Analysis, Reality Check 1: the platform's angles [rad]."""
    mechanism = platform(values=(leg,))
    found = []
    for number in range(1, len(angles) + 1):
        equations, values = swept(mechanism, solve(mechanism, {"mode_1": number}))
        assert len(equations.groups[0].assemblies) == len(angles)
        found.append(float(values["theta16"][0]))
    assert sorted(found) == pytest.approx(angles, abs=5e-8)


@pytest.mark.cases(4)
@pytest.mark.parametrize(
    ("end", "before", "behind"),
    [(3.711, 0, 2), (4.864, 2, 4), (6.967, 4, 6), (7.022, 6, 4), (7.849, 4, 2), (9.262, 2, 0)],
)
def test_the_number_of_assemblies_changes_with_the_leg(end, before, behind):
    """At these lengths of the leg, to three digits."""
    assert [assemblies_of(leg) for leg in (end - 0.001, end + 0.001)] == [before, behind]


def assemblies_of(leg):
    """How many the platform has in the first row."""
    mechanism = replace(platform(values=(leg,)), sketch=Sketch())
    try:
        return len(solve(mechanism).groups[0].assemblies)
    except MechanismError as error:
        assert "cannot be joined" in str(error)
        return 0


def test_a_square_platform_has_the_two_positions_of_the_text():
    """All legs sqrt5: the platform stands at -45 degrees on (1, 2), at 45 degrees on (2, 1)."""
    text = template_text("planar-3rpr")
    five = '{ formula = "sqrt(5)" }'
    for name, new in (("p1", five), ("p3", five), ("L2", '{ formula = "sqrt(2)" }'), ("L3", '{ formula = "sqrt(2)" }'),
                      ("x1", "4"), ("y2", "4"), ("gamma", '{ value = 90, unit = "deg" }')):  # fmt: skip
        old = next(line for line in text.splitlines() if line.startswith(f"{name} ="))
        text = text.replace(old, f"{name} = {new}")
    text = text.replace("start = 5\nstop = 7\nstep = 0.2", 'values = ["sqrt(5)"]').replace(
        "B = [3, 4.6]\nC = [0.6, 3.1]", ""
    )
    mechanism = loads(text)
    found = set()
    for number in range(1, len(solve(mechanism).groups[0].assemblies) + 1):
        _, values = swept(mechanism, solve(mechanism, {"mode_1": number}))
        found.add(tuple(round(float(values[name][0]), 6) for name in ("theta16", "A.x", "A.y")))
    assert {(round(-math.pi / 4, 6), 1.0, 2.0), (round(math.pi / 4, 6), 2.0, 1.0)} <= found


@pytest.mark.parametrize(("name", "kind", "unknowns"), [
    ("planar-3rpr", "III", 2), ("stephenson-iii-output", "III", 2), ("stephenson-ii-class-iv", "IV", 2),
    ("double-butterfly", "III", 3),
])  # fmt: skip
def test_class_and_fewest_unknowns(name, kind, unknowns):
    (group,) = solve(load(TEMPLATES / f"{name}.toml")).groups
    assert (group.kind, len(group.unknowns)) == (kind, unknowns)


@pytest.mark.parametrize(("kind", "seed"), [("III", 0), ("III", 17), ("IV", 4)])
def test_random_groups_are_as_the_reference_finds_them(kind, seed):
    mechanism = loads(Grower(seed, 1, (kind,)).text(rows=6, step=1.0))
    equations, values = swept(mechanism)
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    theirs = reference.variables(solution)
    there = np.isfinite(values[equations.groups[0].closes])
    assert there.any()
    assert not (there & ~solution.exists).any()
    for name in {name for name in theirs if name in values}:
        gap = (values[name] - theirs[name])[there]
        if name.startswith("theta"):
            gap = gap - math.tau * np.round(gap / math.tau)
        assert np.abs(gap).max() < 1e-9 * (1.0 if name.startswith("theta") else solution.size), name


@pytest.mark.slow
@pytest.mark.parametrize("name", ["stephenson-ii-class-iv", "double-butterfly"])
def test_the_jacobian_is_the_derivative(name):
    """Written by hand, held against the derivative of F by every unknown with all that follows from it."""
    mechanism = load(TEMPLATES / f"{name}.toml")
    equations, values = swept(mechanism)
    (system,) = (group.system for group in equations.groups)
    rules = {part.symbol: part.expression for part in system.body}

    def written_out(node):
        while any(name in rules for name in symbols(node)):
            node = transform(node, lambda part: rules.get(part.name, part) if isinstance(part, Symbol) else part)
        return node

    for row, name in enumerate(system.equations):
        whole = written_out(Symbol(name))
        for column, unknown in enumerate(system.unknowns):
            exact = value(derivative(whole, unknown), values)
            assert value(system.jacobian[row][column], values) == pytest.approx(exact, abs=1e-10)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_cramer(count):
    random = np.random.default_rng(count)
    matrix, right = random.normal(size=(count, count)), random.normal(size=count)
    nodes = [[Symbol(f"J{row}{column}") for column in range(count)] for row in range(count)]
    found = cramer(nodes, [Symbol(f"F{row}") for row in range(count)])
    known = {f"J{row}{column}": matrix[row, column] for row in range(count) for column in range(count)}
    known |= {f"F{row}": right[row] for row in range(count)}
    for name, node in found.minors:
        known[name] = value(node, known)
    solved = [value(node, known) / value(found.determinant, known) for node in found.numerators]
    assert solved == pytest.approx(np.linalg.solve(matrix, right))


@pytest.mark.slow
def test_a_step_that_is_too_large_is_told_with_one_that_works():
    mechanism = load(TEMPLATES / "stephenson-ii-class-iv.toml")
    far, near = (replace(mechanism, driver=replace(mechanism.driver, step=math.radians(step))) for step in (40, 20))
    (doubt,) = doubts(far, solve(far))
    assert doubt.key == "driver.step"
    assert "too large" in doubt.message
    assert "a step of 20 works" in doubt.hint
    assert doubts(near, solve(near)) == ()


@pytest.mark.slow
def test_a_sketch_of_another_position_is_followed_to_the_first_row():
    mechanism = load(TEMPLATES / "stephenson-ii-class-iv.toml")
    _, values = swept(mechanism)
    row = 6
    sketch = Sketch({name: (float(values[f"{name}.x"][row]), float(values[f"{name}.y"][row])) for name in "BDE"}, {},
                    math.radians(60))  # fmt: skip
    _, found = swept(replace(mechanism, sketch=sketch))
    assert found["theta16"] == pytest.approx(values["theta16"], abs=1e-12)


@pytest.mark.slow
def test_a_sketch_between_two_assemblies_is_refused():
    mechanism = platform()
    both = [swept(mechanism, solve(mechanism, {"mode_1": number}))[1] for number in (1, 2)]
    middle = {
        name: tuple(float(sum(values[f"{name}.{axis}"][0] for values in both)) / 2 for axis in "xy") for name in "ABC"
    }
    with pytest.raises(MechanismError, match="between two of the 4 assemblies"):
        solve(replace(mechanism, sketch=Sketch(middle)))


def test_the_reference_starts_in_the_stretch_that_the_sheet_begins_in():
    """Behind a gap Newton's method may land on any assembly: its rows say nothing of the one that is meant.

    At 9.262 m, near the end of leg 2, the platform's two assemblies lie close together; 9.6 m is out of reach; behind it
    they lie far apart, and on one that is not there at 9.262 m.
    """
    mechanism = replace(platform(values=(9.262,), speed=None), sketch=Sketch(), dynamics=None)
    equations = solve(mechanism, {"mode_1": 2})
    mechanism = replace(mechanism, driver=replace(mechanism.driver, values=(9.262, 9.6, 6.75, 6.85)))
    _, values = swept(mechanism, equations)
    assert np.isfinite(values["theta16"]).tolist() == [True, False, True, True]
    turns = math.remainder(values["theta16"][2] - values["theta16"][0], math.tau)
    assert abs(turns) > 1.0  # another assembly
    _, _, angle = rough_poses(mechanism, equations)["platform"]
    assert math.remainder(angle - values["theta16"][0], math.tau) == pytest.approx(0, abs=1e-3)


PLATES = """\
[links.plate1]
points = { G = [0, 0], A = [2.4, 3.1], B = [-0.6, 4] }
[links.plate2]
points = { A = [0, 0], C = [4.1, 1.1], D = [1.6, 4.5] }
[links.plate3]
points = { C = [0, 0], E = [3.8, -0.9], F = [2.2, 2.8] }
[links.plate4]
points = { E = [0, 0], H = [2.7, -3.3], I = [2.9, 1.7] }
[links.bar1]
points = { B = [0, 0], F = [9.3, 3] }
[links.bar2]
points = { D = [0, 0], I = [9.2, -2.6] }
"""

TURNING = """\
[links.crank]
points = { O = [0, 0], H = [-1.6, 1.4] }
"""


@pytest.mark.slow
def test_a_pin_on_a_link_that_is_known_already_is_closed_wherever_that_link_stands():
    """Four plates in a row from the ground at G to the crank at H, and two bars across.

    The pin H is asked for last, of a plate that was reached from the other end: whether the crank is described before
    the plates or after them, the plates stand where they were drawn, and move alike.
    """
    drawn = {"A": (2.4, 3.1), "C": (6.5, 4.2), "E": (10.3, 3.3), "I": (13.2, 5.0)}
    found = []
    for links in (TURNING + PLATES, PLATES + TURNING):
        mechanism = loads(
            'format = 1\n[mechanism]\nname = "row"\n[links.ground]\npoints = { G = [0, 0], O = [14.6, -1.4] }\n'
            + links
            + '[driver]\nlink = "crank"\nstart = 0\nstop = 3\nstep = 1\n[assembly]\n'
            + "".join(f"{point} = [{x}, {y}]\n" for point, (x, y) in drawn.items())
        )
        _, values = swept(mechanism)
        places = np.array([[values[f"{point}.x"], values[f"{point}.y"]] for point in drawn])
        assert places[:, :, 0] == pytest.approx(np.array(list(drawn.values())), abs=1e-9)
        found.append(places)
    assert np.abs(found[0][:, :, -1] - found[0][:, :, 0]).max() > 0.01  # it moves
    assert np.abs(found[1] - found[0]).max() < 1e-12 * 14


@pytest.mark.slow
def test_what_needs_a_closed_form_says_so():
    from mechsheet.compiled import Compiled
    from mechsheet.exporting import KINDS, Job
    from mechsheet.exporting.functions.workbooks import FORMS, functions_workbook

    mechanism = platform()
    with pytest.raises(MechanismError, match="no closed form"):
        _ = Compiled(replace(mechanism, layout="page")).layout
    for kind in ("latex", "markdown"):
        with pytest.raises(MechanismError, match="no closed form"):
            KINDS[kind].write(Job(mechanism, "x"))
    for form in FORMS:
        with pytest.raises(MechanismError, match="no closed form"):
            functions_workbook(Compiled(mechanism), form)


TWO_SLIDES = """
format = 1
mechanism = { name = "two-slides" }
links.ground.points = { O = [0, 0], C0 = [100, 0] }
links.crank.points = { O = [0, 0], A = [20, 0] }
links.left.points = { A = [0, 0], D = [40, 0] }
links.slide.points = { M = [0, 0] }
links.right.points = { C0 = [0, 0], E = [0, 50] }
links.rod.points = { D = [0, 0], E = [70, 0] }
joints = [
    { type = "prismatic", link = "slide", on = "left", point = "M", through = [0, 10], angle = 20, symbol = "s1" },
    { type = "prismatic", link = "slide", on = "right", point = "M", through = [0, -10], angle = 110, orientation = -90 },
]
driver = { link = "crank", start = 0, stop = 360, step = 60 }
[assembly]
D = [50, 30]
"""
"""A class IV group closed by a link with two slides, as the disc of an Oldham coupling."""  # fmt: skip


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("origin", ["C0 = [0, 0], E = [0, 50]", "C0 = [3, 1], E = [3, 51]"])
def test_a_link_with_two_slides_closes_a_group(origin):
    """Left and right are parallel then: |A - C0 + R(theta) (40, -50)| = 70, wherever the frame of `right` begins."""
    mechanism = loads(TWO_SLIDES.replace("C0 = [0, 0], E = [0, 50]", origin))
    equations, values = swept(mechanism)
    (group,) = equations.groups
    assert (group.kind, len(group.system.unknowns)) == ("IV", 3)
    theta = values["theta13"]
    assert np.remainder(values["theta15"] - theta + 1, math.tau) == pytest.approx(1, abs=1e-12)
    x, y = values["A.x"] - 100, values["A.y"]
    across = np.hypot(x + 40 * np.cos(theta) + 50 * np.sin(theta), y + 40 * np.sin(theta) - 50 * np.cos(theta))
    assert across == pytest.approx(70, abs=1e-9)
    comparison = judged(mechanism)
    assert comparison.agrees and comparison.worst < 1e-9, comparison
