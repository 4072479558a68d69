"""Loop closure equations: the engine's numbers fulfil them, in every row of every template and of random linkages."""

import math

import numpy as np
import pytest

from chosen import ITERATED, but
from folders import TEMPLATE_FILES
from livesheet.formula.printer import print_formula
from mechsheet import reference
from mechsheet.description import load, loads
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_mechanisms import Grower


def loops(mechanism):
    equations = solve(mechanism)
    return equations, tuple(group.closure for group in equations.groups)


def worst_gap(mechanism):
    """The largest left - right over all loops and rows, as a part of the size; the variables are the reference's."""
    equations, found = loops(mechanism)
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    known = {**solution.dimensions, **reference.variables(solution)}
    for equation in equations.constants:
        known[equation.symbol] = value(equation.expression, known)
    inside = {name for group in equations.groups for name in group.unknowns} - known.keys()
    if inside:  # of a group that is solved in a frame that moves
        rows = driver_values(mechanism, dimension_values(mechanism))
        known |= {name: column for name, column in sweep(mechanism, equations, rows).items() if name in inside}
    assert len(found) == len(equations.groups)
    worst = 0.0
    for loop in found:
        total = 0j
        for sign, side in ((1, loop.left), (-1, loop.right)):
            for vector in side:
                total = total + sign * value(vector.length, known) * np.exp(
                    1j * value(vector.angle.expression(), known)
                )
        total = np.broadcast_to(total, solution.exists.shape)[solution.exists]
        assert np.isfinite(total).all()
        worst = max(worst, float(np.abs(total).max()) / solution.size)
    return worst


@pytest.mark.cases(18)
@pytest.mark.parametrize("path", TEMPLATE_FILES, ids=lambda path: path.stem)
def test_templates_close(path):
    assert worst_gap(load(path)) < 1e-10


@pytest.mark.cases(8)
@pytest.mark.parametrize("seed", range(900, 930))
def test_random_linkages_close(seed):
    assert worst_gap(loads(Grower(seed, 1 + seed % 5).text(7))) < 1e-10


@pytest.mark.slow
def test_each_loop_holds_what_its_group_solves():
    """Two scalar equations for two unknowns; an angle that a guide keeps may be written as well."""
    for path in but(TEMPLATE_FILES, *ITERATED):
        equations, found = loops(load(path))
        for number, loop in enumerate(found, 1):
            solved = [eq.symbol for eq in equations.columns if eq.group == number and eq.role == "variable"]
            solved += [name for name in equations.groups[number - 1].unknowns if name not in solved]
            group = equations.groups[number - 1]
            inside = len(group.links) > 4  # links that move with the driven pair: their angles follow
            most = 3 if group.kind in ("PRP", "RPP") or inside else 2
            assert 1 <= len([name for name in loop.reads if name in solved]) <= most, (path.stem, number)


def written(loop):
    sides = []
    for side in (loop.left, loop.right):
        terms = (f"{print_formula(v.length, 'text')} e^({print_formula(v.angle.expression(), 'text')})" for v in side)
        sides.append(" + ".join(terms))
    return " = ".join(sides)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        # as the text writes them
        ("four-bar", ["a2 e^(theta12) + a3 e^(theta13) = a1 e^(0) + a4 e^(theta14)"]),
        ("slider-crank", ["a2 e^(theta12) = a3 e^(theta13) + a1 e^(pi/2) + s14 e^(0)"]),
        (
            "fivelink",
            [
                "A0B0 e^(alpha1) + s3 e^(theta13 + pi/2) = a2 e^(theta12)",
                "b2 e^(theta13) + b3 e^(theta14) + A0B0 e^(alpha1) = a1 + c1 e^(0) + b1 - d1 e^(pi/2) + b4 e^(theta15)",
            ],
        ),
    ],
)
def test_the_texts_equations(name, expected):
    path = next(path for path in TEMPLATE_FILES if path.stem == name)
    assert [written(loop) for loop in loops(load(path))[1]] == expected


def test_ways_name_the_points():
    path = next(path for path in TEMPLATE_FILES if path.stem == "stephenson-iii")
    _, (first, second) = loops(load(path))
    assert first.left_way == (("A", "B"), ("B", "C"))
    assert first.right_way == (("A", "D"), ("D", "C"))
    assert second.left_way == (("A", "B"), ("B", "E"), ("E", "G"))
    assert second.right_way == (("A", "F"), ("F", "G"))


def test_a_wrong_length_opens_the_loop():
    """The test of closure can fail."""
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar"))
    _, (loop,) = loops(mechanism)
    known = {"a1": 70, "a2": 35, "a3": 62.3, "a4": 56, "theta12": math.radians(60), "theta13": 0.5, "theta14": 1.0}
    gap = sum(
        sign * value(v.length, known) * np.exp(1j * value(v.angle.expression(), known))
        for sign, side in ((1, loop.left), (-1, loop.right))
        for v in side
    )
    assert abs(gap) > 1
