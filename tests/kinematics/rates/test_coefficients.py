"""Velocities and accelerations from the equations: against the reference for all dyads, and against closed forms by hand."""

import re
from dataclasses import replace

import numpy as np
import pytest

from chosen import ALL, CAMS, ITERATED, LISTED, but, some
from folders import TEMPLATE_FILES
from in_line import IN_LINE
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.dynamics import solve as dynamics
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.dyads.solved import DEAD
from mechsheet.kinematics.equations import CAM
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses, sweep
from mechsheet.model import Solution, rate_symbols
from random_mechanisms import Grower

SPEED, ACCELERATION = 2.5, -1.7

FOUR_BAR = """
format = 1
[mechanism]
name = "parallelogram"
[dimensions]
a1 = 80
a2 = 35
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a1", 0] }
[links.rocker]
points = { B0 = [0, 0], B = ["a2", 0] }
[driver]
link = "crank"
start = 20
stop = 160
step = 10
speed = 4
acceleration = 3
[assembly]
B = [100, 30]
"""

SLIDER_CRANK = IN_LINE.replace("step = 15\n", 'step = 15\nspeed = { value = 90, unit = "rpm" }\nacceleration = 6\n')


def moving(text):
    """A description with a speed, in the layout that has rates."""
    text = re.sub(r"(?m)^(layout|speed|acceleration) *=.*$", "", text)
    text = re.sub(r"(?m)^\[flywheel\]\n.*$", "", text)  # it wants a constant speed
    return re.sub(r"(?m)^\[driver\]", f"[driver]\nspeed = {SPEED}\nacceleration = {ACCELERATION}", text)


def solved(described):
    mechanism = loads(described) if isinstance(described, str) else described
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    return mechanism, equations, driver, sweep(mechanism, equations, driver)


def sines(equations, values):
    """Row by row the least sine of the angle at which a group is driven."""
    found = np.ones(len(next(iter(values.values()))))
    for equation in equations.columns:
        for condition in equation.exists if equation.role == "coefficient" else ():
            part = np.abs(DEAD * value(condition.margin, values) / value(condition.least, values))
            found = np.fmin(found, part)
    return found


def expected(symbol, mechanism, rates):
    """A rate by the reference's derivatives."""

    def by_time(name):
        once, twice = rates[name]
        return once * SPEED, twice * SPEED**2 + once * ACCELERATION

    for name in rates:
        for turns in (True, False):
            if symbol in (names := rate_symbols(name, turns)):
                return by_time(name)[names.index(symbol)]
    point, _, part = symbol.partition(".")
    x, y = (by_time(f"{point}.{axis}")["va".index(part[0])] for axis in "xy")
    return {"": np.hypot(x, y), "x": x, "y": y}[part[1:]]


def worst_of(described):
    """The largest difference from the reference, times sin^2 of the transmission angle; how many were compared."""
    mechanism, equations, _, values = solved(described)
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    rates = reference.rates(solution)
    sine = sines(equations, values)
    rows = solution.exists & (sine > DEAD)
    if any(
        group.system for group in equations.groups
    ):  # which may come to no position where the rows are too far apart
        rows &= equations.closed(values)
    worst, compared = 0.0, 0
    for equation in equations.columns:
        if equation.role != "rate" or equation.group == CAM or equation.symbol.endswith((".d", ".dd", ".ddd", ".j")):
            continue  # a cam's own: see tests/property/test_random_cams.py
        theirs = expected(equation.symbol, mechanism, rates)
        error = (np.abs(values[equation.symbol] - theirs) * sine**2 / (1 + np.abs(theirs)))[rows]
        assert np.isfinite(error).all(), equation.symbol
        assert np.isnan(values[equation.symbol][solution.exists & (sine < DEAD)]).all() or equation.group <= 1
        worst, compared = max(worst, float(error.max(initial=0.0))), compared + len(error)
    for fits in equations.fits.values():
        for part in (*fits.velocity, *fits.acceleration):
            size = solution.size * (1 + SPEED**2)
            assert np.nanmax(np.abs(value(part, values) * sine**2), initial=0.0) < 1e-12 * size
    return worst, compared


BEHIND = ("double-parallelogram",)
"""Turned a whole turn its third arm follows a linkage near its change point: what is lost there counts twice."""


@pytest.mark.parametrize(
    "template", some(but(TEMPLATE_FILES, *LISTED, *ITERATED, *BEHIND), 4), ids=lambda path: path.stem
)
def test_templates_against_the_reference(template):
    worst, compared = worst_of(moving(template.read_text(encoding="utf-8")))
    assert compared > 0
    assert worst < 1e-12


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", ITERATED)
def test_groups_without_dyads_against_the_reference(name):
    worst, compared = worst_of(moving(template_text(name)))
    assert compared > 100
    assert worst < 1e-12


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize(("kind", "seed"), [*(("III", seed) for seed in range(8)), ("IV", 4)])
def test_random_groups_without_dyads_against_the_reference(kind, seed):
    worst, compared = worst_of(moving(Grower(seed, 1, (kind,)).text(rows=6, step=1.0)))
    assert compared > 0
    assert worst < 1e-12


@pytest.mark.parametrize("name", ["slider-crank", "inverted-slider-crank", "scotch-yoke"])
def test_slides_in_groups_without_dyads_against_the_reference(name):
    """Dyads solved as such groups are: what a slide asks of the rates is another equation than what a pin asks."""
    mechanism = loads(moving(template_text(name)))
    nothing_else = {"outputs": (), "summaries": (), "charts": (), "tables": ()}
    worst, compared = worst_of(replace(mechanism, solution=Solution(force=True), **nothing_else))
    assert compared > 100
    assert worst < 1e-12


@pytest.mark.slow
def test_random_mechanisms_of_all_dyads_against_the_reference():
    kinds, judged = set(), 0
    for seed in range(60 if ALL else 12):
        text = moving(Grower(seed, 1 + seed % 3).text())
        try:
            worst, compared = worst_of(text)
        except MechsheetError:  # it closes nowhere: a random one may
            continue
        kinds |= {group.kind for group in solve(loads(text)).groups}
        assert worst < 2e-12, f"seed {seed}"
        judged += compared
    assert kinds == {"RRR", "RRP", "RPR", "PRP", "RPP"}
    assert judged > 1000


def test_in_line_slider_crank_by_its_closed_form():
    _, _, theta, values = solved(SLIDER_CRANK)
    r, length, omega, alpha = 50.0, 200.0, 90 * np.pi / 30, 6.0
    root = np.sqrt(length**2 - (r * np.sin(theta)) ** 2)
    once = -r * np.sin(theta) - r**2 * np.sin(theta) * np.cos(theta) / root
    twice = -r * np.cos(theta) - r**2 * np.cos(2 * theta) / root - (r**2 * np.sin(theta) * np.cos(theta)) ** 2 / root**3
    assert values["s14.v"] == pytest.approx(once * omega, abs=1e-10)
    assert values["s14.a"] == pytest.approx(twice * omega**2 + once * alpha, abs=1e-9)
    assert values["omega13"] == pytest.approx(-r * np.cos(theta) / root * omega, abs=1e-12)


def test_scotch_yoke_swings_as_a_cosine():
    text = template_text("scotch-yoke")
    mechanism, _, theta, values = solved(moving(text))
    slide = next(joint.symbol for joint in mechanism.joints if joint.on == mechanism.ground.name)
    amplitude = np.ptp(values[slide]) / 2
    phase = values[slide] / np.max(np.abs(values[slide]))
    assert np.max(np.abs(values[f"{slide}.v"])) == pytest.approx(amplitude * SPEED, rel=1e-2)
    swing = values[slide] - (values[slide].max() + values[slide].min()) / 2
    once = values[f"{slide}.v"] / SPEED
    assert swing**2 + once**2 == pytest.approx(np.full_like(theta, amplitude**2), rel=1e-12), phase
    assert values[f"{slide}.a"] == pytest.approx(-swing * SPEED**2 + once * ACCELERATION, abs=1e-11 * amplitude)


def test_parallelogram_turns_its_rocker_as_its_crank():
    _, _, _, values = solved(FOUR_BAR)
    assert values["omega14"] == pytest.approx(np.full(15, 4.0), rel=1e-13)
    assert values["alpha14"] == pytest.approx(np.full(15, 3.0), rel=1e-12)
    assert values["omega13"] == pytest.approx(np.zeros(15), abs=1e-12)


def test_oldham_coupling_hands_the_speed_on():
    text = template_text("oldham")
    text += '\n[outputs.ratio]\nformula = "omega14/omega12"\nunit = "1"\n'
    _, _, theta, values = solved(moving(text))
    assert values["omega14"] == pytest.approx(np.full_like(theta, SPEED), rel=1e-14)
    assert "alpha14" not in values  # it would be the driver's: only what is asked for by name is written twice
    radius = 15 / 2  # of the circle on which the disc's middle runs twice a turn
    assert values["M.v"] == pytest.approx(np.full_like(theta, radius * 2 * SPEED), rel=1e-12)
    assert values["M.a"] == pytest.approx(
        np.full_like(theta, radius * np.hypot((2 * SPEED) ** 2, 2 * ACCELERATION)), rel=1e-12
    )


def test_a_rate_of_another_name_is_written_when_it_is_read():
    text = (
        FOUR_BAR
        + '[summary]\nfast = { of = "B.vx", take = "max" }\n[outputs]\ngain = { formula = "1/theta14.d", unit = "1" }\n'
    )
    _, _, theta, values = solved(text)
    assert values["B.vx"] == pytest.approx(-35 * np.sin(theta) * 4, abs=1e-11)
    assert values["gain"] == pytest.approx(np.ones(15), rel=1e-13)
    assert "B.vx" not in solved(FOUR_BAR)[3]


def test_coefficients_need_no_speed():
    text = FOUR_BAR.replace("speed = 4\nacceleration = 3\n", "")
    text += '[outputs]\ngain = { formula = "1/theta14.d", unit = "1" }\n'
    _, equations, _, values = solved(text)
    assert values["gain"] == pytest.approx(np.ones(15), rel=1e-13)
    assert not [equation for equation in equations.columns if equation.role == "rate"]


def test_dead_centre_has_no_rates_but_a_position():
    text = FOUR_BAR.replace("start = 20", "start = 160").replace("stop = 160", "stop = 200")
    _, _, theta, values = solved(text)
    dead = np.argmin(np.abs(theta - np.pi))
    assert np.isnan(values["omega13"][dead])
    assert np.isnan(values["alpha14"][dead])
    assert np.isfinite(values["theta14"][dead])
    assert values["omega14"][dead - 1] == pytest.approx(4.0, rel=1e-10)
    assert np.isfinite(
        values["omega14"][dead + 1]
    )  # the assembly stays: beyond the change point that is the other motion


def test_a_speed_that_depends_on_the_driver_brings_its_acceleration():
    text = FOUR_BAR.replace("speed = 4\nacceleration = 3\n", 'speed = "2 + sin(theta12)"\n')
    _, _, theta, values = solved(text)
    assert values["omega14"] == pytest.approx(2 + np.sin(theta), rel=1e-12)
    assert values["alpha14"] == pytest.approx((2 + np.sin(theta)) * np.cos(theta), abs=1e-11)


def test_only_what_has_no_column_yet_gets_one():
    """A four-bar: D, two coefficients, k, two second ones; four rates; six columns for a point asked for."""
    _, equations, _, _ = solved(FOUR_BAR)
    found = [equation.symbol for equation in equations.columns if equation.role in ("coefficient", "rate")]
    assert len(found) == 11
    _, equations, _, _ = solved(FOUR_BAR + '[rates]\npoints = ["B"]\n')
    assert len([each for each in equations.columns if each.role in ("coefficient", "rate")]) == 17


# --- against differences of the project's own positions ------------------------------------------------------------

WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
STEPS = 4e-2 / 2.0 ** np.arange(11)
CALM = 0.2
"""Rows are judged where every group is driven at more than this sine: differences must not reach over a dead centre."""
ROWS = 30
LIMIT = 1e-9


def derived(equations):
    """(a column, its derivative by the driver, 1 or 2 for the order, the quantity) of all that have both."""
    known = {equation.symbol: equation for equation in equations.all}
    for symbol in known:
        for order, ending in ((2, ".dd"), (1, ".d")):
            quantity = symbol.removesuffix(ending)
            below = quantity + ".d" * (order - 1)
            if quantity != symbol and below in known:
                yield below, symbol, order, quantity
                break


def worst_by_differences(text):
    """Theta' against differences of theta over eight points, theta'' against differences of theta'; how many were compared.

    In each row the step is the one at which the differences change least with the next smaller ones: neither the curvature
    nor the rounding then counts. The largest difference, as a part of the mechanism's size (of 1 rad) and of the column.
    """
    mechanism = loads(text)
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))[:ROWS]
    turns = mechanism.driver.unit.kind == "angle"
    stroke = 1.0 if turns else float(np.max(np.abs(driver)))
    values = sweep(mechanism, equations, driver)
    calm = sines(equations, values) > CALM
    kinds = {equation.symbol: equation.unit.kind for equation in equations.all}
    lengths = [
        abs(dim.value) for dim in mechanism.dimensions if isinstance(dim.value, float) and dim.unit.kind == "length"
    ]
    lengths += [np.nanmax(np.abs(values[name]), initial=0.0) for name in kinds if name.endswith((".x", ".y"))]
    pairs = list(derived(equations))
    found = {symbol: [] for _, symbol, _, _ in pairs}
    for step in STEPS * stroke:
        beside = sweep(mechanism, equations, (driver[:, None] + step * np.arange(-4, 5)).ravel())
        for below, symbol, order, _ in pairs:
            table = np.array(beside[below]).reshape(-1, 9)
            if order == 1 and kinds[below] == "angle":
                table = np.unwrap(table, axis=1)
            found[symbol].append(table @ WEIGHTS / step)
    worst, compared = 0.0, 0
    for _, symbol, order, quantity in pairs:
        estimates = np.array(found[symbol])
        changes = np.nan_to_num(np.abs(np.diff(estimates, axis=0)), nan=np.inf)
        changes = np.maximum(changes[:-1], changes[1:])  # twice: once may be chance
        best = estimates[1 + changes.argmin(axis=0), np.arange(len(driver))]
        rows = calm & np.isfinite(changes.min(axis=0)) & np.isfinite(values[symbol])
        kind = kinds.get(quantity, "length" if quantity.endswith((".x", ".y")) else "angle")
        size = (max(lengths) if kind == "length" else 1.0) / stroke**order
        error = np.abs(best - values[symbol])[rows] / (size + np.abs(values[symbol][rows]))
        worst, compared = max(worst, float(error.max(initial=0.0))), compared + int(rows.sum())
    return worst, compared


@pytest.mark.parametrize(
    "template", some(but(TEMPLATE_FILES, *ITERATED, *LISTED, *CAMS), 3), ids=lambda path: path.stem
)
def test_templates_against_differences(template):
    worst, compared = worst_by_differences(moving(template.read_text(encoding="utf-8")))
    assert compared > 0
    assert worst < LIMIT


@pytest.mark.slow
def test_random_mechanisms_against_differences():
    kinds, compared = set(), 0
    for seed in range(300 if ALL else 12):
        text = moving(Grower(seed, 1 + seed % 3).text())
        try:
            worst, count = worst_by_differences(text)
        except MechsheetError:  # it closes nowhere: a random one may
            continue
        assert worst < LIMIT, f"seed {seed}"
        compared += count
        kinds |= {group.kind for group in solve(loads(text)).groups}
    assert kinds >= {"RRR", "RRP", "RPR", "RPP"}
    assert compared > 300


def test_a_list_of_values_says_nothing_of_a_speed():
    """Static forces are found by virtual work as well, which needs to know how every driver moves with the first."""
    robot = template_text("five-bar-robot")
    mechanism = loads(f'{robot}\n[[loads]]\nlink = "left"\ntorque = 1\n')
    with pytest.raises(MechsheetError, match=r"theta15. is a list of values"):
        dynamics.solve(mechanism)
