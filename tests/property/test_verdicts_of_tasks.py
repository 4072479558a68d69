"""What the sheet of synthesis says of random tasks is true: marks and numbers held against the reference's own geometry."""

import cmath
import math

import numpy as np
import pytest
from synthesised import outputs
from test_random_tasks import address, typed

from chosen import first
from livesheet.formula.references import cell_address
from mechsheet.description import loads
from mechsheet.reference import dimension_values
from mechsheet.reference.synthesis import functions, guidance
from mechsheet.reference.synthesis.results import Given, crank_of, pairs
from mechsheet.sheet.plan import MEANING, SYMBOL, VERDICT_ROW
from mechsheet.sheet.synthesis.requirement_checks import NO
from mechsheet.sheet.task_rows import ROUNDED, VALUE, verdicts_of
from mechsheet.synthesis.kinds import KINDS
from synthesis_tasks import description, task

pytestmark = pytest.mark.slow

SEEDS = first(range(200), 5)
DENSE = 4001
SMALL = 0.01
"""The part of a change that is tried."""


def verdicts(kind, seed, **further):
    """Key -> (mark, number) of a task typed into its workbook; the mechanism, its dimensions; None where it has none."""
    asked = {**task(kind, seed), **further}
    mechanism = loads(description(asked))
    values = dimension_values(mechanism)
    if not all(math.isfinite(values[symbol]) for symbol in mechanism.synthesis.ends):
        return None
    session, spots = typed(asked, mechanism)
    found = {}
    for key, spot in spots.items():
        if key.startswith("does "):
            mark = session.get(cell_address(spot.sheet, spot.row, ROUNDED))
            found[key.removeprefix("does ")] = mark, session.get(address(spot))
    assert found.keys() >= set(verdicts_of(mechanism.synthesis, four_bar=True)), (
        "a name of another sheet's has taken one"
    )
    return found, mechanism, values


def first_sheet(asked):
    """The number and the words of the first sheet's line on the task, the line under its title, and the dimensions; None
    where the task has no solution."""
    mechanism = loads(description(asked))
    values = dimension_values(mechanism)
    if not all(math.isfinite(values[symbol]) for symbol in mechanism.synthesis.ends):
        return None
    session, spots = typed(asked, mechanism)
    line = spots["task"]
    number, words = (session.get(cell_address(line.sheet, line.row, col)) for col in (VALUE, MEANING))
    title = session.get(cell_address(line.sheet, VERDICT_ROW, SYMBOL))
    return number, words, title, {name: values[symbol] for name, symbol in mechanism.synthesis.results.items()}


def swing_of(found):
    """By how much the rocker swings over a whole turn of the crank, by places of its pin; NaN where it does not close."""
    crank = found["a2"] * np.exp(1j * np.linspace(0, 2 * np.pi, DENSE))
    toward = crank - found["a1"]
    cosine = (np.abs(toward) ** 2 + found["a4"] ** 2 - found["a3"] ** 2) / (2 * found["a4"] * np.abs(toward))
    with np.errstate(invalid="ignore"):
        rocker = np.unwrap(np.angle(toward) - found["mode"] * np.arccos(cosine))
    return math.degrees(np.ptp(rocker))


def stroke_of(found):
    """How far the slider goes likewise."""
    crank = found["a2"] * np.exp(1j * np.linspace(0, 2 * np.pi, DENSE))
    with np.errstate(invalid="ignore"):
        return float(np.ptp(crank.real + np.sqrt(found["a3"] ** 2 - (crank.imag + found["c"]) ** 2)))


MEASURED = {"dead-centres": (swing_of, "psi"), "quick-return-slider": (stroke_of, "stroke")}


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", MEASURED)
def test_a_motion_that_is_not_the_one_asked_for_is_red_on_the_first_sheet(kind, seed):
    asked = task(kind, seed)
    said = first_sheet(asked)
    if said is None:
        return
    number, words, title, found = said
    measure, key = MEASURED[kind]
    got = measure(found)
    missed = not abs(got - asked[key]) < 1e-3 * asked[key]
    assert (number > 0) == missed, (got, asked[key], title)
    assert title.startswith(f"{words}; closes") if missed else title.endswith("; does exactly what is asked")


@pytest.mark.parametrize("seed", SEEDS)
def test_points_that_are_missed_are_said_on_the_first_sheet(seed):
    """Red where three points, which decide the lengths, are missed, or cannot be passed one after another."""
    asked = task("function", seed)
    said, own = first_sheet(asked), verdicts("function", seed)
    if said is None:
        return
    number, words, title, found = said
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    bar = functions.function(theta, psi, found["a1"])
    errors = np.degrees(np.abs(np.angle(np.exp(1j * (outputs(bar, theta, found["mode"]) - psi)))))
    missed = not np.max(errors) < 1e-3
    assert number == sum(mark == NO for mark, _ in own[0].values())
    assert number > 0 or not missed or len(theta) > 3
    assert title.startswith(f"{words}; ") if number > 0 else title.endswith(f"; {words}")


def sides_of(a, b, b0):
    """On which side of A→B0 the joint B lies."""
    return np.sign(((b0 - a).conjugate() * (b - a)).imag)


def transmission(a, b0, a3, a4):
    """Least angle between the lines of coupler and rocker over places of A, degrees; NaN where some do not close."""
    cosine = (a3**2 + a4**2 - np.abs(b0 - a) ** 2) / (2 * a3 * a4)
    return math.degrees(math.acos(np.max(np.abs(cosine)))) if np.max(np.abs(cosine)) <= 1 else math.nan


@pytest.mark.parametrize("seed", SEEDS)
def test_of_function_generators(seed):
    said = verdicts("function", seed)
    if said is None:
        return
    found, mechanism, values = said
    theta, psi = pairs(Given(mechanism.synthesis, values))
    bar = functions.function(theta, psi, values[mechanism.synthesis.results["a1"]])
    sides = functions.sides(bar, theta, psi)
    if len(theta) == 3:  # of more than three nearly met ones, which side they mean is a matter of taste
        assert (found["assemblies"][1] == 1) == bool(np.all(sides == sides[0]))
        assert (found["assemblies"][0] == NO) == bool(np.any(sides != sides[0]))
    got = outputs(bar, theta, values[mechanism.synthesis.results["mode"]])
    errors = np.degrees(np.abs(np.angle(np.exp(1j * (got - psi)))))
    missed = np.isnan(errors)
    if len(theta) == 3:  # three pairs are met exactly, or in the other assembly
        missed |= errors > 1e-6
    assert (found["meets"][0] == NO) == bool(np.any(missed))
    if not np.any(np.isnan(errors)):
        assert found["meets"][1] == pytest.approx(np.max(errors), abs=1e-7)
    assert found["order"][1] == float(abs(np.sum(np.sign(np.diff(theta)))) == len(theta) - 1)
    swept = bar.a2 * np.exp(1j * (np.linspace(theta[0], theta[-1], DENSE) + bar.theta_offset))
    least = transmission(swept, bar.a1, bar.a3, bar.a4)
    assert (found["closes_throughout"][0] == NO) == math.isnan(least)
    if not math.isnan(least):
        assert found["transmission_used"][1] == pytest.approx(least, abs=0.1)
    at = bar.a2 * np.exp(1j * (theta + bar.theta_offset))
    dead = [transmission(at[n : n + 1], bar.a1, bar.a3, bar.a4) for n in range(len(at))]
    assert found["grashof"][1] == pytest.approx(excess(bar.a1, bar.a2, bar.a3, bar.a4), abs=1e-6)
    if np.all(np.isfinite(dead)):
        assert found["at_dead_centre"][1] == pytest.approx(min(dead), abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", ["dead-centres", "quick-return-slider"])
def test_of_dead_centres(kind, seed):
    said = verdicts(kind, seed)
    if said is None:
        return
    found, mechanism, values = said
    least = values[mechanism.synthesis.results["mu_min"]]
    assert (found["together"][0] == NO) == math.isnan(least)
    if math.isnan(least):
        assert found["meets"][0] == NO or found["meets"][1] > 1e-6
    else:
        assert found["meets"][1] < 1e-9
        assert found["turns"][0] != NO
        assert found["transmission_least"][1] == pytest.approx(math.degrees(least), abs=1e-9)


@pytest.mark.cases(1)
@pytest.mark.parametrize("seed", SEEDS)
def test_of_guided_bodies(seed):
    said = verdicts("guidance", seed)
    if said is None:
        return
    found, mechanism, values = said
    given = Given(mechanism.synthesis, values)
    poses = [
        guidance.Pose(complex(given.at("poses", n, 0), given.at("poses", n, 1)), given.at("poses", n, 2))
        for n in range(3)
    ]
    one, other = (crank_of(given, poses, name) for name in ("A", "B"))
    a, b = (np.array(guidance.carried(poses, crank.moving)) for crank in (one, other))
    a0, b0 = one.fixed, other.fixed
    sides = sides_of(a, b, b0)
    assert (found["assemblies"][1] == 1) == bool(np.all(sides == sides[0]))
    second, third = one.turns
    assert found["order"][1] == float(second * third > 0 and abs(third) > abs(second))
    start = cmath.phase(one.moving - one.fixed)
    swept = one.fixed + one.length * np.exp(1j * (start + np.linspace(0, third, DENSE)))
    least = transmission(swept, other.fixed, abs(other.moving - one.moving), other.length)
    assert (found["closes_throughout"][0] == NO) == math.isnan(least)
    if not math.isnan(least):
        assert found["transmission_used"][1] == pytest.approx(least, abs=0.1)
    assert found["meets"][1] < 1e-6
    at_poses = [transmission(a[n : n + 1], b0, np.abs(b[n] - a[n]), other.length) for n in range(3)]
    assert found["at_dead_centre"][1] == pytest.approx(min(at_poses), abs=1e-5)
    assert found["grashof"][1] == pytest.approx(excess(one.length, abs(b[0] - a[0]), other.length, abs(b0 - a0)))


def excess(*lengths):
    """Shortest and longest less the other two: below 0 a link turns fully."""
    return 2 * (min(lengths) + max(lengths)) - sum(lengths)


@pytest.mark.parametrize("seed", SEEDS)
def test_of_slotted_levers(seed):
    said = verdicts("quick-return-lever", seed)
    assert said is None or said[0]["meets"][1] < 1e-9


@pytest.mark.cases(2)
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", KINDS)
def test_of_how_much_a_small_change_changes(kind, seed):
    """0.1 degrees, or 0.1 %, in one input: by the reference's differences, in parts of each length."""
    said = verdicts(kind, seed)
    if said is None:
        return
    found, mechanism, values = said
    synthesis = mechanism.synthesis
    units = {dim.symbol: dim.unit for dim in mechanism.dimensions}
    lengths = [s for s in synthesis.ends if s in synthesis.steps and units[s].kind == "length"]
    largest = 0.0
    for symbol in synthesis.inputs:
        whole = math.radians(0.1) if units[symbol].kind == "angle" else 0.001 * abs(values[symbol])
        around = [dimension_values(mechanism, {symbol: values[symbol] + way * SMALL * whole}) for way in (1, -1)]
        for length in lengths:
            change = (around[0][length] - around[1][length]) / (2 * SMALL)
            largest = max(largest, 100 * abs(change / values[length]))
    assert found["sensitivity"][1] == pytest.approx(largest, rel=1e-3)


COARSE = {"dead-centres": (0.5, 5.0), "quick-return-slider": (0.5, 5.0)}
"""To what lengths are rounded: to what a drawing has, and so that some lose what they had."""


@pytest.mark.cases(1)
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", COARSE)
def test_a_full_turn_is_lost_by_rounding_alone(kind, seed):
    """A doubt where the exact lengths turn fully and the rounded ones do not; never red where the exact ones do."""
    for step in COARSE[kind]:
        said = verdicts(kind, seed, round=step)
        if said is None:
            return
        found, mechanism, values = said
        exact = {name: values[symbol] for name, symbol in mechanism.synthesis.results.items()}
        used = {name: values[symbol] for symbol, name in mechanism.synthesis.taken.items()}
        turns, still = (margin(kind, lengths) >= 0 for lengths in (exact, {**exact, **used}))
        assert found["turns"][0] == ("✓" if still else "!" if turns else NO)
        if found["together"][0] != NO:
            assert found["meets"][0] != NO


def margin(kind, lengths):
    """By how much the crank turns fully: what the triangle of the links lacks in its tightest position."""
    if kind == "quick-return-slider":
        return lengths["a3"] - lengths["a2"] - abs(lengths["c"])
    a1, a2, a3, a4 = (lengths[name] for name in ("a1", "a2", "a3", "a4"))
    return min(a3 + a4 - a1 - a2, abs(a1 - a2) - abs(a3 - a4))
