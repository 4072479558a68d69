"""The reference's synthesis: published numbers, and mechanisms that do what was asked when they are solved as links."""

import cmath
import math
import tomllib

import numpy as np
import pytest
from reference_cases import TESTS
from synthesised import FULL, apart, four_bar, guided, outputs, rests, slider_crank, slotted_lever

from chosen import first
from mechsheet.description import loads
from mechsheet.reference import dimension_values, solve, variables
from mechsheet.reference.synthesis import crank_rocker, functions, guidance, quick_return
from synthesis_tasks import description, task

SEEDS = first(range(200), 10)
DESCRIBED = first(range(200), 3)
CASES = {
    path.stem: tomllib.loads(path.read_text(encoding="utf-8"))
    for path in sorted((TESTS / "cases" / "synthesis").glob("*.toml"))
}


def pose(row):
    return guidance.Pose(complex(row[0], row[1]), math.radians(row[2]))


def crank_of(poses, pivot):
    if "turns" in pivot:
        return guidance.by_turns(poses, tuple(np.radians(pivot["turns"])))
    way = "moving" if "moving" in pivot else "fixed"
    return getattr(guidance, f"by_{way}")(poses, complex(*pivot[way]))


def crank_rocker_of(asked):
    psi = math.radians(asked["psi"])
    phi = math.radians(asked["phi"]) if "phi" in asked else crank_rocker.crank_turn(asked["time_ratio"])
    if "lam" in asked:
        return psi, phi, crank_rocker.by_lam(psi, phi, asked["a1"], asked["lam"])
    if "a2" in asked:
        return psi, phi, crank_rocker.by_crank(psi, phi, asked["a1"], asked["a2"])
    return psi, phi, crank_rocker.best(psi, phi, asked["a1"])


def slider_crank_of(asked):
    given = asked["stroke"], asked["time_ratio"]
    if "lam" in asked:
        return quick_return.by_lam(*given, asked["lam"])
    if "c" in asked:
        return quick_return.by_eccentricity(*given, asked["c"])
    if "a2" in asked:
        return quick_return.by_crank(*given, asked["a2"])
    return quick_return.best(*given)


def check_swing(ends, psi, phi):
    """That a rocker swings by psi between its two dead centres while the crank turns by phi, or back by the rest."""
    (first_at, low), (second_at, high) = ends
    turn = abs(second_at - first_at)
    assert abs(high - low) == pytest.approx(psi, abs=1e-10)
    assert min(abs(turn - phi), abs(FULL - turn - phi)) < 1e-10


def check_time_ratio(ends, time_ratio):
    """That the crank turns in this ratio between two dead centres, on the slow way and on the quick one."""
    (first_at, _), (second_at, _) = ends
    turn = abs(second_at - first_at)
    assert max(turn, FULL - turn) / min(turn, FULL - turn) == pytest.approx(time_ratio, rel=1e-9)


def check_chord(ends, lever, stroke):
    """That the end of a lever is so far away from one dead centre at the other."""
    (_, one), (_, other) = ends
    assert abs(cmath.exp(1j * one) - cmath.exp(1j * other)) * lever == pytest.approx(stroke, rel=1e-10)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_function_generator_meets_its_points(seed):
    asked = task("function", seed)
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    found = functions.function(theta, psi, asked["a1"])
    if not found.exists or len(theta) > 3:
        return
    b = found.a1 + found.a4 * np.exp(1j * (psi + found.psi_offset))
    for at, to, sketch in zip(theta, psi, b, strict=True):
        solved = solve(
            four_bar(found.a1, found.a2, found.a3, found.a4, complex(sketch), float(at + found.theta_offset))
        )
        assert solved.exists[0]
        angle = solved.poses["rocker"][0, 2] - found.psi_offset
        assert apart(angle, to) < 1e-10


@pytest.mark.parametrize("seed", SEEDS)
def test_one_assembly_goes_through_all_points_exactly_where_they_lie_on_one_side(seed):
    asked = task("function", seed)
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    found = functions.function(theta, psi, asked["a1"])
    if not found.exists or len(theta) > 3:
        return
    sides = functions.sides(found, theta, psi)
    sketch = complex(found.a1 + found.a4 * np.exp(1j * (psi[0] + found.psi_offset)))
    crank = theta + found.theta_offset
    whole = four_bar(found.a1, found.a2, found.a3, found.a4, sketch, float(crank[0]))
    solved = solve(whole, values=crank)
    angles = solved.poses["rocker"][:, 2] - found.psi_offset
    met = [apart(angle, to) < 1e-9 for angle, to in zip(angles, psi, strict=True)]
    assert met == list(sides == sides[0])
    closed = outputs(found, theta, sides[0])
    assert apart(closed, angles) < 1e-9


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_crank_rocker_has_its_swing_and_time_ratio_between_its_dead_centres(seed):
    """Just where the reference knows a transmission angle: else the dead centres lie on both assemblies."""
    psi, phi, found = crank_rocker_of(task("dead-centres", seed))
    if not found.exists:
        return
    ends = rests(four_bar(found.a1, found.a2, found.a3, found.a4, complex(found.a1, found.a4), 1.0), "theta14")
    assert len(ends) == 2
    if math.isfinite(found.mu_min):
        check_swing(ends, psi, phi)
    else:
        (_, low), (_, high) = ends
        assert abs(high - low) != pytest.approx(psi, abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_two_cranks_guide_a_body_through_its_poses(seed):
    asked = task("guidance", seed)
    poses = [pose(row) for row in asked["poses"]]
    cranks = [crank_of(poses, asked[name]) for name in ("A", "B")]
    if not all(crank.exists for crank in cranks):
        return
    first, second = cranks
    size = max(abs(p - first.fixed) for p in (first.moving, second.fixed, second.moving))
    for at, wanted in enumerate(poses):
        solved = solve(guided(cranks, poses, at))
        assert solved.exists[0]
        assert abs(complex(*solved.points["P"][0]) - wanted.place) < 1e-10 * size
        turned = solved.poses["body"][0, 2] - cmath.phase(second.moving - first.moving)
        assert apart(turned, wanted.angle - poses[0].angle) < 1e-10
        other = solved.poses["other"][0, 2] - cmath.phase(second.moving - second.fixed)
        assert apart(other, (0.0, *second.turns)[at]) < 1e-9


@pytest.mark.cases(5)
@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_slider_crank_has_its_stroke_and_time_ratio(seed):
    """Just where the reference knows a transmission angle: else the slider's ends lie on both assemblies."""
    asked = task("quick-return-slider", seed)
    found = slider_crank_of(asked)
    if not found.exists:
        return
    ends = rests(slider_crank(found.a2, found.a3, found.c), "s14")
    assert len(ends) == 2
    (_, one), (_, other) = ends
    if math.isfinite(found.mu_min):
        assert abs(one - other) == pytest.approx(asked["stroke"], rel=1e-10)
        check_time_ratio(ends, asked["time_ratio"])
    else:
        assert abs(one - other) != pytest.approx(asked["stroke"], rel=1e-6)


@pytest.mark.cases(4)
@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_slotted_lever_has_its_stroke_and_time_ratio(seed):
    asked = task("quick-return-lever", seed)
    found = quick_return.slotted_lever(asked["stroke"], asked["time_ratio"], asked["crank"])
    if asked["time_ratio"] <= 1:  # a lever that takes as long forth as back swings by no angle: there is none
        assert math.isnan(found.centre)
        return
    ends = rests(slotted_lever(found.centre, found.lever, asked["crank"]), "theta13")
    assert len(ends) == 2
    check_chord(ends, found.lever, asked["stroke"])
    check_time_ratio(ends, asked["time_ratio"])


def named(asked):
    """The result of a task by the names that the case files use, angles in degrees."""
    if asked["kind"] == "function":
        found = functions.function(np.radians(asked["theta"]), np.radians(asked["psi"]), asked["a1"])
        offsets = {name: math.degrees(getattr(found, name)) for name in ("theta_offset", "psi_offset")}
        return {"a2": found.a2, "a3": found.a3, "a4": found.a4} | offsets
    if asked["kind"] == "dead-centres":
        found = crank_rocker_of(asked)[2]
        lengths = {"a2": found.a2, "a3": found.a3, "a4": found.a4, "lam": found.lam}
        return lengths | {"mu_min": math.degrees(found.mu_min)}
    if asked["kind"] == "quick-return-lever":
        found = quick_return.slotted_lever(asked["stroke"], asked["time_ratio"], asked["crank"])
        return {"centre": found.centre, "lever": found.lever}
    poses = [pose(row) for row in asked["poses"]]
    values = {}
    for name in ("A", "B"):
        crank = crank_of(poses, asked[name])
        arm, rest = crank.moving - crank.fixed, poses[0].place - crank.moving
        values |= {f"length_{name}": crank.length, "length": abs(arm), "direction": math.degrees(cmath.phase(arm))}
        values |= {"rest": abs(rest), "rest_direction": math.degrees(cmath.phase(rest))}
        values |= {f"turn{at}_{name}": math.degrees(turn) for at, turn in enumerate(crank.turns, 2)}
    return values


@pytest.mark.parametrize("name", CASES)
def test_published_numbers(name):
    case = CASES[name]
    found = named(case["synthesis"])
    for symbol, printed in case.get("printed", {}).items():
        assert found[symbol] == pytest.approx(printed["value"], abs=printed["within"]), symbol
    for symbol, value in case.get("exact", {}).items():
        assert found[symbol] == pytest.approx(value, abs=6e-7), symbol
    assert case.get("printed") or case.get("exact")


def test_what_four_digit_cosines_cost():
    """Ohio State's task: 0.005 degrees in one angle move its shortest link by 1 % (why the printed lengths are off)."""
    asked = CASES["ohio-state"]["synthesis"]
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    exact = functions.function(theta, psi, asked["a1"])
    changes = []
    for place in range(3):
        moved = psi.copy()
        moved[place] += np.radians(0.005)
        changes.append(abs(functions.function(theta, moved, asked["a1"]).a2 - exact.a2) / exact.a2)
    assert max(changes) > 0.005


def test_the_tutorial_of_pylinkage_does_not_meet_its_task():
    asked = CASES["pylinkage"]["synthesis"]
    wrong = functions.FourBar(2, 1, 2.4142, 1.7321)
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    reached = [outputs(wrong, theta, side) for side in (1, -1)]
    assert all(not np.allclose(angles, psi, atol=math.radians(5)) for angles in reached)


@pytest.mark.parametrize("seed", first(range(40), 10))
def test_the_closed_form_of_the_text_is_what_its_complex_equations_say(seed):
    """Section 7.1: a2 = sqrt(2) sin(psi/2) / D and so on, from the two dead centres."""
    psi, phi, found = crank_rocker_of(task("dead-centres", seed))
    if not found.exists:
        return
    lam2 = found.lam**2
    d = math.sqrt((1 - math.cos(phi - psi)) + (1 + math.cos(phi - psi)) * lam2)
    assert found.a2 == pytest.approx(found.a1 * math.sqrt(2) * math.sin(psi / 2) / d, rel=1e-12)
    assert found.a4 == pytest.approx(
        found.a1 * math.sqrt((1 - math.cos(phi)) + (1 + math.cos(phi)) * lam2) / d, rel=1e-12
    )


@pytest.mark.parametrize("seed", first(range(40), 10))
def test_dead_centres_lie_on_one_assembly_up_to_a_lam(seed):
    """u = -cos(phi - psi/2) / cos(psi/2), m the smaller of u and 1/u: up to (1 + m) / (1 - m)."""
    random = np.random.default_rng(seed)
    psi = random.uniform(0.2, 2.4)
    phi = random.uniform(math.pi / 2 + psi / 2, 3 * math.pi / 2 + psi / 2)
    u = -math.cos(phi - psi / 2) / math.cos(psi / 2)
    m = min(u, 1 / u)
    last = (1 + m) / (1 - m)
    below = crank_rocker.by_lam(psi, phi, 1, 1 + (last - 1) * 0.999)
    above = crank_rocker.by_lam(psi, phi, 1, last * 1.001)
    assert math.isfinite(below.mu_min)
    assert above.exists
    assert math.isnan(above.mu_min)


def test_no_best_crank_rocker_without_a_quick_return():
    assert not crank_rocker.best(math.radians(60), math.pi, 100).exists
    assert crank_rocker.best(math.radians(60), math.radians(170), 100).exists


def test_tasks_without_a_solution():
    turn = np.radians
    assert not functions.function(turn([10, 10, 50]), turn([20, 20, 60]), 100).exists  # two equal pairs
    assert not functions.function(turn([10, 370, 50]), turn([20, 380, 60]), 100).exists  # equal but for a turn
    assert not functions.function(turn([10, 50]), turn([20, 60]), 100).exists
    straight = [guidance.Pose(complex(x, 2 * x), 0) for x in (0, 10, 30)]
    assert not guidance.by_moving(straight, 5 + 1j).exists  # a slider would do
    twice = [guidance.Pose(0j, 0), guidance.Pose(10 + 5j, 0.3), guidance.Pose(10 + 5j, 0.3)]
    assert not guidance.by_moving(twice, 5 + 1j).exists
    assert not guidance.by_fixed(twice, 5 - 9j).exists
    assert not guidance.by_turns(straight, (0.2, 0.5)).exists  # a body that does not turn
    assert math.isnan(quick_return.slotted_lever(100, 1, 30).centre)
    assert not quick_return.by_crank(100, 1.5, 51).exists  # a crank longer than half the stroke
    assert not quick_return.best(100, 1).exists
    assert not crank_rocker.by_lam(turn(80), turn(100), 100, 2).exists  # outside what a crank-rocker can
    assert not crank_rocker.by_crank(turn(80), turn(190), 100, 95).exists


@pytest.mark.parametrize("seed", first(range(20), 5))
def test_angles_that_differ_by_turns_are_equal(seed):
    asked = task("function", seed)
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    found = functions.function(theta, psi, 100)
    turned = functions.function(theta + FULL * np.arange(len(theta)), psi - FULL, 100)
    assert turned.exists == found.exists
    if found.exists:
        assert [turned.a2, turned.a3, turned.a4] == pytest.approx([found.a2, found.a3, found.a4], rel=1e-9)


def test_more_than_three_points_have_the_least_error_of_the_equation():
    """Any other four-bar near it fits the equation worse, in the sum of squares."""
    theta, psi = np.radians([10, 40, 70, 100, 130]), np.radians([30, 52, 66, 85, 110])
    found = functions.function(theta, psi, 100)
    left, right = functions.equations(theta, psi)

    def error(a2, a3, a4):
        k = np.array([100 / a2, 100 / a4, (100**2 + a2**2 + a4**2 - a3**2) / (2 * a2 * a4)])
        return np.sum((left @ k - right) ** 2)

    sign2, sign4 = (-1 if offset else 1 for offset in (found.theta_offset, found.psi_offset))
    best = np.array([sign2 * found.a2, found.a3, sign4 * found.a4])
    for step in np.eye(3):
        assert all(error(*(best * (1 + way * 1e-3 * step))) > error(*best) for way in (1, -1))


def test_chebyshev_spacing():
    """The zeros of the polynomial of degree three, 0 and cos 30° to either side, in the range."""
    assert functions.chebyshev(0, 1, 3) == pytest.approx([0.0669873, 0.5, 0.9330127], abs=1e-7)
    assert functions.chebyshev(1, 4, 3) == pytest.approx([1.200962, 2.5, 3.799038], abs=1e-6)


def described(kind, seed):
    """The mechanism that a random task gives, as its description has it, and whether it has a solution."""
    whole = loads(description(task(kind, seed)))
    values = dimension_values(whole)
    return whole, values, all(math.isfinite(values[symbol]) for symbol in whole.synthesis.taken)


@pytest.mark.parametrize("seed", DESCRIBED)
def test_a_described_function_generator_meets_its_points(seed):
    whole, values, solved = described("function", seed)
    asked = task("function", seed)
    if not solved or len(asked["theta"]) > 3:
        return
    theta, psi = np.radians(asked["theta"]), np.radians(asked["psi"])
    sides = functions.sides(functions.function(theta, psi, asked["a1"]), theta, psi)
    found = solve(whole, values=theta + values["theta_offset"])
    angles = variables(found)["psi"]
    for place in range(3):
        if sides[place] == values["mode"]:
            assert apart(angles[place], psi[place]) < 1e-10


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("seed", DESCRIBED)
def test_a_described_crank_rocker_has_its_swing(seed):
    whole, values, solved = described("dead-centres", seed)
    if not solved or not math.isfinite(values["mu_min"]):
        return
    check_swing(rests(whole, "theta14"), values["psi"], values["phi"])


@pytest.mark.parametrize("seed", DESCRIBED)
def test_a_described_body_passes_its_poses(seed):
    whole, values, solved = described("guidance", seed)
    if not solved:
        return
    asked = task("guidance", seed)
    poses = [pose(row) for row in asked["poses"]]
    cranks = [crank_of(poses, asked[name]) for name in ("A", "B")]
    places = list(zip(*(guidance.carried(poses, crank.moving) for crank in cranks), strict=True))
    size = max(values[name] for name in ("a1_exact", "a2", "a3", "a4") if name in values)
    for at, (a, b) in enumerate(places):
        side = ((cranks[1].fixed - a).conjugate() * (b - a)).imag
        if math.copysign(1, side) == values["mode"]:
            found = solve(whole, values=[values["theta_1"] + (0.0, *cranks[0].turns)[at]])
            assert abs(complex(*found.points["P"][0]) - poses[at].place) < 1e-10 * size


@pytest.mark.parametrize("seed", DESCRIBED)
def test_a_described_slider_crank_has_its_stroke(seed):
    whole, values, solved = described("quick-return-slider", seed)
    if not solved or not math.isfinite(values["mu_min"]):
        return
    ends = rests(whole, "s")
    (_, one), (_, other) = ends
    assert abs(one - other) == pytest.approx(values["stroke"], rel=1e-10)
    check_time_ratio(ends, values["time_ratio"])


@pytest.mark.slow
@pytest.mark.parametrize("seed", DESCRIBED)
def test_a_described_slotted_lever_has_its_stroke(seed):
    whole, values, solved = described("quick-return-lever", seed)
    if not solved:
        return
    ends = rests(whole, "theta13")
    check_chord(ends, values["lever"], task("quick-return-lever", seed)["stroke"])
    check_time_ratio(ends, values["time_ratio"])
