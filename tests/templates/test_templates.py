"""Every template: written as promised, assembles as sketched, agrees with the reference, and does what it is known for."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from mechsheet import reference, template
from mechsheet.description import Overrides, load, loads
from mechsheet.description.driving.segments import LINKS
from mechsheet.description.templates import template_text
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep

FOLDER = Path(__file__).resolve().parents[2] / "templates"
NAMES = sorted(path.stem for path in FOLDER.glob("*.toml"))


@cache
def described(name):
    return load(FOLDER / f"{name}.toml")


@cache
def equations_of(name):
    return solve(described(name))


@cache
def positions(name):
    """All columns of a template over its own sweep."""
    mechanism = described(name)
    return sweep(mechanism, equations_of(name), driver_values(mechanism, dimension_values(mechanism)))


def over(name, degrees):
    """All columns at driver angles of one's own."""
    return sweep(described(name), equations_of(name), np.radians(np.asarray(degrees, dtype=float)))


def dims(name):
    return dimension_values(described(name))


def comment(name):
    return template_text(name).partition("format = 1")[0]


def where(name, symbol, take):
    """Driver value in degrees where a column is largest or smallest."""
    found = positions(name)
    return round(math.degrees(found[described(name).driver.symbol][take(found[symbol])]), 6)


# ---- all of them


def test_the_five_of_the_text_and_at_least_sixteen_more():
    text = {"slider-crank", "four-bar", "fivelink", "adjustable-pump", "six-link-dwell"}
    assert text <= set(NAMES)
    assert len(NAMES) >= len(text) + 16


@pytest.mark.parametrize("name", NAMES)
def test_written_as_promised(name):
    mechanism = described(name)
    assert mechanism.name == name
    assert mechanism.title.of("en") != mechanism.title.of("tr")
    assert mechanism.source.of("en")
    lines = comment(name).splitlines()
    assert all(line.startswith("#") for line in lines if line)
    assert any("Source:" in line for line in lines)
    assert any("What to look at:" in line for line in lines)
    dimensions = [dim for dim in mechanism.dimensions if not dim.path]  # masses and loads say themselves what they are
    links = [
        link for link in mechanism.links[1:] if link.name not in LINKS
    ]  # a cam that segments bring along has no label
    for part in (*dimensions, *links, *mechanism.outputs, *mechanism.summaries):
        label = part.label
        assert label is not None, part
        assert label.of("en").strip(), part
        assert label.of("tr").strip(), part
    for request in (*mechanism.charts, *mechanism.tables):
        assert request.title is not None


@pytest.mark.cases(25)
@pytest.mark.parametrize("name", NAMES)
def test_assembles_as_sketched_over_the_whole_sweep(name):
    mechanism, found = described(name), positions(name)
    assert not [group.label.of("en") for group in equations_of(name).groups if group.open]
    assert all(np.isfinite(column).all() for column in found.values())
    size = max(np.max(np.abs(found[key])) for key in found if key.endswith((".x", ".y")))
    for point, place in mechanism.sketch.points.items():
        x, y = (number(quantity, dims(name)) for quantity in place)
        gap = math.hypot(found[f"{point}.x"][0] - x, found[f"{point}.y"][0] - y)
        assert gap < 0.1 * size, f"{point} is sketched far from where it is"


@pytest.mark.cases(5)
@pytest.mark.parametrize("name", NAMES)
def test_agrees_with_the_reference(name):
    mechanism, found = described(name), positions(name)
    solution = reference.solve(mechanism)
    theirs = reference.variables(solution)
    angles = {link.angle_symbol for link in mechanism.links}
    angles |= {output.symbol for output in mechanism.outputs if output.unit.in_degrees}
    angles |= {mechanism.driver.symbol} if mechanism.driver.link else set()
    for symbol, column in theirs.items():
        ours = found.get(symbol)
        if ours is None:
            continue
        gap = ours - column
        gap = np.remainder(gap + math.pi, math.tau) - math.pi if symbol in angles else gap / solution.size
        assert np.max(np.abs(gap)) < 1e-9, symbol
    worst, _ = reference.worst(reference.residuals(mechanism, dims(name), found))
    assert np.max(worst) < 1e-12 * solution.size * 10


@pytest.mark.parametrize("name", NAMES)
def test_angles_are_continuous(name):
    mechanism, found = described(name), positions(name)
    for link in mechanism.links[1:]:
        assert np.max(np.abs(np.diff(found[link.angle_symbol]))) < 1.5, link.name


@pytest.mark.slow
def test_both_languages_and_both_ways_of_referring_are_shown():
    assert {described(name).language for name in NAMES} == {"en", "tr"}
    assert {described(name).references for name in NAMES} == {"names", "anchors"}


# ---- straight-line linkages


def test_peaucellier_draws_an_exact_straight_line():
    found = positions("peaucellier")
    assert np.max(np.abs(found["D.x"] - 93.75)) < 1e-11
    assert np.ptp(found["D.y"]) == pytest.approx(187.5)
    inverse = np.hypot(found["B.x"], found["B.y"]) * np.hypot(found["D.x"], found["D.y"])
    assert np.allclose(inverse, 100**2 - 50**2, rtol=1e-13)


def test_chebyshev_is_straight_within_a_quarter_percent():
    found = positions("chebyshev")
    assert found["theta12"][-1] == pytest.approx(math.acos(4 / 5), abs=1e-15)
    assert found["P.x"][[0, -1]] == pytest.approx([0, 200], abs=1e-7)
    assert found["P.y"][[0, -1]] == pytest.approx([200, 200], abs=1e-7)
    fine = over("chebyshev", np.linspace(90, 37, 5001))
    assert round(float(np.max(fine["deviation"])), 3) == 0.488 and np.min(fine["deviation"]) > -1e-9
    middle = over("chebyshev", [math.degrees(math.atan2(4, 3))])
    assert (middle["P.x"][0], middle["P.y"][0]) == pytest.approx((100, 200))
    assert "0.488" in comment("chebyshev")


def test_hoeken_is_straight_over_half_a_turn():
    half = over("hoeken", np.linspace(90, 270, 3601))
    assert round(float(np.max(half["deviation"])), 3) == 0.390 and np.min(half["deviation"]) > -1e-9
    assert np.ptp(half["P.x"]) == pytest.approx(160)
    exact = over("hoeken", [90, 180, 270])
    assert exact["P.y"] == pytest.approx([160, 160, 160])
    assert exact["P.x"] == pytest.approx([160, 80, 0], abs=1e-9)
    assert "0.390" in comment("hoeken")


def test_roberts_passes_both_pivots_and_the_middle():
    found = positions("roberts")
    assert found["P.x"][[0, -1]] == pytest.approx([0, 200], abs=1e-9)
    assert np.max(np.abs(found["P.y"])) < 0.13
    crossing = np.interp(100, found["P.x"], found["P.y"])
    assert abs(crossing) < 2e-3
    longer = loads(template_text("roberts"), overrides=Overrides({"a2": "480"}))
    column = sweep(longer, solve(longer), driver_values(longer, dimension_values(longer)))
    assert np.max(np.abs(column["P.y"])) < 0.25 * np.max(np.abs(found["P.y"]))  # the longer the legs, the closer


def test_watt_is_straight_near_the_middle():
    found = over("watt-straight-line", np.linspace(-10, 10, 2001))
    assert round(float(np.max(np.abs(found["deviation"]))), 3) == 0.021
    assert round(float(np.ptp(found["P.y"]))) == 69
    whole = positions("watt-straight-line")
    assert whole["deviation"][0] < 0 < whole["deviation"][-1]  # the two arcs of the figure of eight


# ---- copies, couplings, harmonic motion


def test_trammel_draws_an_ellipse_with_the_given_axes():
    found = positions("elliptic-trammel")
    assert np.max(np.abs((found["P.x"] / 80) ** 2 + (found["P.y"] / 200) ** 2 - 1)) < 1e-14
    assert (np.ptp(found["P.x"]), np.ptp(found["P.y"])) == pytest.approx((160, 400))
    assert np.ptp(found["theta12"]) == pytest.approx(math.tau)


def test_scotch_yoke_is_exactly_harmonic():
    found = positions("scotch-yoke")
    assert np.max(np.abs(found["s13"] - 50 * np.cos(found["theta12"]))) < 1e-13
    assert np.max(np.abs(found["s23"] - 50 * np.sin(found["theta12"]))) < 1e-13


def test_oldham_turns_both_shafts_alike():
    found = positions("oldham")
    assert np.max(np.abs(found["lag"])) < 1e-15
    assert np.allclose(found["r"], 7.5, atol=1e-14)
    round_and_round = np.unwrap(np.arctan2(found["M.y"], found["M.x"] - 7.5))
    assert abs(round_and_round[-1] - round_and_round[0]) == pytest.approx(2 * math.tau)


def test_pantograph_copies_exactly_at_its_scale():
    found = positions("pantograph")
    for axis in "xy":
        assert np.max(np.abs(found[f"Q.{axis}"] - 2.5 * found[f"P.{axis}"])) < 1e-12
    assert np.ptp(found["Q.x"]) == pytest.approx(2.5 * 40)


def test_parallelogram_does_not_turn_its_coupler():
    found = positions("parallelogram")
    assert np.max(np.abs(found["theta13"])) < 1e-13
    assert np.max(np.abs(found["theta14"] - found["theta12"])) < 1e-13
    assert np.allclose(np.hypot(found["L.x"] - 200, found["L.y"] + 80), 300, atol=1e-10)


# ---- quick returns


def test_whitworth_returns_in_half_the_time():
    assert dims("whitworth")["ratio"] == pytest.approx(2)
    assert (where("whitworth", "s15", np.argmax), where("whitworth", "s15", np.argmin)) == (210, 330)
    found = positions("whitworth")
    assert np.ptp(found["s15"]) == pytest.approx(2 * 120)
    assert np.ptp(found["theta13"]) == pytest.approx(math.tau)


def test_slotted_lever_returns_in_half_the_time():
    assert dims("slotted-lever")["ratio"] == pytest.approx(2)
    found = positions("slotted-lever")
    assert (where("slotted-lever", "s15", np.argmax), where("slotted-lever", "s15", np.argmin)) == (330, 210)
    assert np.ptp(found["s15"]) == pytest.approx(400)
    assert np.degrees(np.ptp(found["theta13"])) == pytest.approx(60)


def test_the_motor_of_the_slotted_lever_gives_what_the_tool_takes():
    found, given = template("slotted-lever").solve(), dims("slotted-lever")
    cutting = found["s15.v"] < -1
    assert found["T12"] == pytest.approx(
        np.where(cutting, -given["cut"] * found["s15.v"] / 1000 / math.pi, 0), abs=1e-9
    )


def test_inverted_slider_crank_keeps_its_offset():
    found, given = positions("inverted-slider-crank"), dims("inverted-slider-crank")
    x, y = given["d"] - found["B.x"], -found["B.y"]
    across = np.cos(found["theta13"]) * y - np.sin(found["theta13"]) * x
    assert np.allclose(np.abs(across), given["offset"], atol=1e-14)
    assert np.allclose(np.hypot(found["C.x"] - found["B.x"], found["C.y"] - found["B.y"]), found["b"], atol=1e-14)
    assert np.allclose(found["theta14"] - found["theta13"], math.radians(60), atol=1e-14)
    assert round(given["offset"], 4) == 0.1126


def test_drag_link_turns_fully():
    found, given = positions("drag-link"), dims("drag-link")
    assert given["r1"] + given["r4"] < given["r2"] + given["r3"]
    for angle in ("theta12", "theta13", "theta14"):
        assert found[angle][-1] - found[angle][0] == pytest.approx(math.tau)
    assert np.ptp(found["lead"]) > math.radians(45)


# ---- six-bars


def test_crank_rockers_turn_fully():
    for name in ("four-bar", "watt-i", "watt-ii", "stephenson-i", "stephenson-iii"):
        found = positions(name)
        assert np.ptp(found["theta12"]) == pytest.approx(math.tau)
        for key, column in found.items():
            if key.endswith((".x", ".y")) or re.fullmatch(r"theta1[3-9]", key):
                turns = (column[-1] - column[0]) / math.tau if key.startswith("theta") else 0
                assert turns == pytest.approx(round(turns), abs=1e-12), key


@pytest.mark.slow
def test_loops_of_the_six_bars_hang_where_they_should():
    groups = {name: [group.links for group in equations_of(name).groups] for name in NAMES}
    for name in ("watt-i", "watt-ii", "stephenson-i", "stephenson-iii"):
        assert groups[name] == [("coupler", "rocker"), ("link5", "link6")], name
    ternary = {
        "watt-i": {"coupler", "rocker"},
        "watt-ii": {"ground", "rocker"},
        "stephenson-i": {"crank", "rocker"},
        "stephenson-iii": {"ground", "coupler"},
    }
    for name, expected in ternary.items():
        assert {link.name for link in described(name).links if len(link.points) == 3} == expected, name


def test_r_rrr_rrt_is_solved_in_the_order_of_its_name():
    assert [group.kind for group in equations_of("six-bar-r-rrr-rrt").groups] == ["RRR", "RRP"]
    found = over("six-bar-r-rrr-rrt", [45])
    text = comment("six-bar-r-rrr-rrt")
    for point in ("C", "E"):
        assert f"{point} = ({found[f'{point}.x'][0]:.4f}, {found[f'{point}.y'][0]:.4f})" in text
    assert f"at {found['F.y'][0]:.4f}" in text
    assert f"stroke is {np.ptp(positions('six-bar-r-rrr-rrt')['s16']):.3f}" in text


# ---- walking legs


@pytest.mark.parametrize(("name", "foot"), [("jansen", "S"), ("klann", "G")])
def test_foot_paths_are_closed_and_flat_below(name, foot):
    found = positions(name)
    x, y = found[f"{foot}.x"], found[f"{foot}.y"]
    assert (x[-1], y[-1]) == pytest.approx((x[0], y[0]))
    assert np.max(np.hypot(np.diff(x), np.diff(y))) < 10
    ground = y < y.min() + 0.12 * np.ptp(y)
    assert ground.mean() > 0.4, "the foot is on the ground for a good part of the turn"
    assert np.ptp(x[ground]) > 0.8 * np.ptp(x)


def test_jansen_has_the_published_lengths():
    found, given = positions("jansen"), dims("jansen")
    assert len([dim for dim in described("jansen").dimensions if not dim.path]) == 13
    bars = {
        "b": "YW",
        "c": "YU",
        "d": "YV",
        "e": "VW",
        "f": "VT",
        "g": "TU",
        "h": "TS",
        "i": "US",
        "j": "XW",
        "k": "XU",
    }
    for symbol, (start, end) in (*bars.items(), ("m", "ZX")):
        length = np.hypot(found[f"{end}.x"] - found[f"{start}.x"], found[f"{end}.y"] - found[f"{start}.y"])
        assert np.allclose(length, given[symbol], atol=1e-11), symbol
    assert (round(float(np.ptp(found["S.x"])), 1), round(float(np.ptp(found["S.y"])), 1)) == (67.9, 22.3)


def test_klann_walks_straight_for_half_a_turn():
    found = positions("klann")
    assert (round(float(np.ptp(found["G.x"]))), round(float(np.ptp(found["G.y"])))) == (64, 31)
    half = slice(0, 36)
    assert round(float(np.ptp(found["G.y"][half])), 1) == 3.6
    assert np.ptp(found["G.x"][half]) > 0.99 * np.ptp(found["G.x"])


# ---- driven by a cylinder, and a press


def test_cylinder_drives_the_boom_and_the_fork_stays_level():
    mechanism, found, given = described("cylinder-boom"), positions("cylinder-boom"), dims("cylinder-boom")
    assert mechanism.driver.joint == "cylinder"
    length = np.hypot(found["A.x"] - given["x0"], found["A.y"] - given["y0"])
    assert np.allclose(length, given["L0"] + found["s23"], atol=1e-11)
    assert np.max(np.abs(found["theta15"])) < 1e-14 * 10
    # virtual work: a cylinder's lever arm is the extension per angle of the boom
    rate = np.gradient(found["s23"], found["theta14"], edge_order=2)
    assert np.allclose(rate[1:-1], found["arm"][1:-1], rtol=1e-3)
    assert 0 < dims("cylinder-boom")["L0"] > np.max(found["s23"]), "a cylinder cannot be longer out than in"


def test_scissor_lift_stays_level_and_gains_less_and_less():
    found = positions("scissor-lift")
    assert np.max(np.abs(found["theta16"])) < 1e-14
    assert np.max(np.abs(found["level"])) < 1e-11
    assert np.all(np.diff(found["gain"]) < 0)
    rate = np.gradient(found["W.y"], found["s23"], edge_order=2)
    assert np.allclose(rate[2:-2], found["gain"][2:-2], rtol=5e-3)


def test_toggle_press_dwells_at_the_bottom():
    found = positions("toggle-press")
    bottom = np.max(found["s16"])
    near = bottom - found["s16"] < 0.01 * np.ptp(found["s16"])
    assert near.sum() * 5 >= 60, "the ram stays within a hundredth of the stroke over 60 degrees"
    assert np.all(found["knee"] > 0)
    reach = math.hypot(300, 200 - 180) - 40
    assert f"{reach:.1f}"[:5] == "260.7" and dims("toggle-press")["a3"] < reach
    longer = loads(template_text("toggle-press"), overrides=Overrides({"a3": "265"}))
    ram = sweep(longer, solve(longer), np.radians(np.arange(-90.0, 91.0)))["s16"]
    bottoms = [i for i in range(1, len(ram) - 1) if ram[i] > ram[i - 1] and ram[i] >= ram[i + 1]]
    assert len(bottoms) == 2


# ---- springs and loads


@pytest.mark.slow
def test_the_lamp_stays_where_it_is_put_when_its_spring_has_no_free_length():
    motion = template("desk-lamp", {"l0": 0}).solve()
    weight = motion["of_weight"].max()
    assert np.abs(motion["T12"]).max() < 1e-12 * weight
    common = template("desk-lamp").solve()
    assert common.summary["T_part"] == pytest.approx(common["T12"].max() / (weight / math.cos(0)), rel=1e-3)
    assert np.ptp(common["theta14"]) < 1e-9  # the head stays upright


@pytest.mark.slow
def test_the_shaper_has_the_stroke_and_the_time_ratio_of_the_formulas():
    linkage = template("shaper")
    motion, verdicts = linkage.solve(), linkage.verdicts()
    assert motion.summary["stroke"] == pytest.approx(2 * 300 * 60 / 150, rel=1e-6)
    ratio = (math.pi + 2 * math.asin(0.4)) / (math.pi - 2 * math.asin(0.4))
    assert verdicts["time_ratio_s15"].value == pytest.approx(ratio, rel=1e-3)
    force = motion["T12"] * motion["omega12"]  # the motor works where the ram cuts, to the left
    assert force[motion["s15.v"] < 0].mean() > 5 * force[motion["s15.v"] > 0].mean()


def test_the_wishbones_lean_the_wheel_inwards_as_it_rises_and_its_spring_carries_the_car():
    motion = template("double-wishbone").solve()
    above = motion["rise"] > motion["rise"][12]
    assert (np.diff(motion["camber"][above]) < 0).all()
    assert (np.diff(motion["T12"]) > 0).all()
    assert abs(motion["theta12"][np.abs(motion["T12"]).argmin()]) <= 2
