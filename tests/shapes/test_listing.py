"""The list of shapes: everything that a description has is in it, stands where its points are, follows its loads."""

from pathlib import Path

import numpy as np
import pytest

from chosen import some
from loaded_mechanisms import LAMP, SUSPENSION, of_kind, positions
from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.model import Link
from mechsheet.shapes.colors import FORCE, SPRING, link_color
from mechsheet.shapes.forms import EDGE
from mechsheet.shapes.loads import COIL_ASIDE, LONGEST, NARROWEST, WIDEST, first_shown
from mechsheet.shapes.positions import Positions, there
from mechsheet.words.equations import link_words

folder = Path(__file__).parents[2] / "templates"
TEMPLATES = sorted(folder.glob("*.toml"))

BELT = """
format = 1
[mechanism]
name = "belt"
[links.ground]
points = { O = [0, 0], Q = [100, 0] }
[links.small]
points = { O = [0, 0], A = [20, 0] }
[links.large]
points = { Q = [0, 0], B = [30, 0] }
[[joints]]
type = "belt"
link = "large"
on = "small"
ratio = 0.5
[driver]
link = "small"
start = 0
stop = 360
step = 30
"""


@pytest.fixture(scope="module")
def suspension():
    return positions(SUSPENSION)


@pytest.fixture(scope="module")
def truth():
    return reference.solve(loads(SUSPENSION))


def test_everything_is_there(suspension):
    scene = suspension.at(2)
    kinds = {item.kind for item in scene.items if there(item)}
    assert kinds == {
        "link", "ground", "spring", "damper", "load", "torque", "weight", "mass", "path", "pin", "point", "name",
        "scale", "caption",
    }  # fmt: skip
    names = {item.text.split(" = ")[0] for item in of_kind(scene, "name")}
    assert {"A₀", "S", "E", "K", "G₂", "G₃"} <= names


def test_a_point_that_only_a_spring_uses_is_held_and_named(suspension):
    scene = suspension.at(0)
    assert ("S", 250.0, 260.0) in [(item.name, item.x, item.y) for item in of_kind(scene, "point")]
    supports = [item.points[0].tolist() for item in of_kind(scene, "ground")]
    assert [250.0, 260.0] in supports


def test_a_spring_stretches_between_its_ends(suspension, truth):
    lengths = []
    for row in range(suspension.rows):
        (coil,) = of_kind(suspension.at(row), "spring")
        assert coil.points[0] == pytest.approx(truth.points["E"][row], abs=1e-7)
        assert coil.points[-1] == pytest.approx([250, 260], abs=1e-7)
        way = (coil.points[-1] - coil.points[0]) / np.hypot(*(coil.points[-1] - coil.points[0]))
        aside = np.abs((coil.points - coil.points[0]) @ np.array([-way[1], way[0]]))
        assert aside.max() == pytest.approx(COIL_ASIDE * suspension.window.half)
        lengths.append(np.hypot(*(coil.points[-1] - coil.points[0])))
        assert f"K = {lengths[-1]:.0f} mm" in {item.text for item in of_kind(suspension.at(row), "name")}
    assert max(lengths) > 1.05 * min(lengths)


def test_a_force_is_drawn_at_its_point_as_large_as_it_is(suspension, truth):
    theta = np.radians(np.linspace(-12, 12, 13))
    force = 800 + 1500 * theta
    for row in range(suspension.rows):
        shaft = next(item for item in of_kind(suspension.at(row), "load") if not item.fill)
        assert shaft.points[0] == pytest.approx(truth.points["W"][row], abs=1e-7)
        drawn = shaft.points[1] - shaft.points[0]
        assert drawn == pytest.approx([0, LONGEST * suspension.window.half * force[row] / max(force)], abs=1e-7)


def test_weights_and_loads_have_one_scale(suspension, truth):
    shaft = next(item for item in of_kind(suspension.at(0), "weight") if item.width == 1.75)
    most = 800 + 1500 * np.radians(12)
    assert shaft.points[1] - shaft.points[0] == pytest.approx([0, -LONGEST * suspension.window.half * 25 * 9.81 / most])


def test_a_torque_turns_as_its_sign_says(suspension):
    for row, turns in ((0, -1), (suspension.rows - 1, 1)):
        bow = next(item for item in of_kind(suspension.at(row), "torque") if not item.fill)
        (x, y), (dx, dy) = bow.points[0], np.diff(bow.points[:2], axis=0)[0]
        assert np.sign(x * dy - y * dx) == turns  # about A0, the origin
        assert np.hypot(x, y) == pytest.approx(WIDEST * suspension.window.half)
    middle = suspension.at(suspension.rows // 2)  # the torque is 0
    assert not any(there(item) for item in of_kind(middle, "torque"))
    assert NARROWEST < WIDEST


def test_arrows_stay_in_the_window(suspension):
    for row in range(suspension.rows):
        for item in of_kind(suspension.at(row), "load", "weight", "torque"):
            if there(item):
                away = np.abs(item.points - (suspension.window.x, suspension.window.y)).max()
                assert away <= EDGE * suspension.window.half * (1 + 1e-3)


def test_no_link_has_the_colour_of_a_force_or_a_spring():
    links = {link_color(Link(f"l{number}", number, {}), "l2") for number in range(1, 40)}
    assert not links & {FORCE, SPRING}


@pytest.mark.parametrize(
    ("name", "ends"),
    [
        ("cylinder-boom", [("A0", "A")]),
        ("scissor-lift", [("D0", "K")]),
        ("planar-3rpr", [("P", "B")]),
        ("excavator", [("G", "H"), ("E", "F")]),
        ("oldham", []),
        ("inverted-slider-crank", []),
    ],
)
def test_cylinders_reach_from_pin_to_pin(name, ends):
    compiled = Compiled(load(folder / f"{name}.toml"))
    found = Positions(compiled)
    row = compiled.closed.tolist().index(True)
    drawn = of_kind(found.at(row), "cylinder")
    assert len(drawn) == 2 * len(ends)
    for (eye, other), rod, barrel in zip(ends, drawn[::2], drawn[1::2], strict=True):
        places = [[compiled.values[f"{point}.{axis}"][row] for axis in "xy"] for point in (eye, other)]
        assert barrel.points[0] == pytest.approx(places[0], abs=1e-9 * found.window.half)
        assert rod.points[-1] == pytest.approx(places[1], abs=1e-9 * found.window.half)
        assert np.hypot(*(barrel.points[3] - places[0])) < np.hypot(*np.subtract(*places))


@pytest.mark.parametrize("path", some(TEMPLATES, 4), ids=lambda path: path.stem)
def test_nothing_of_a_template_is_missing(path):
    """Whatever a template has is there wherever its position exists."""
    compiled = Compiled(load(path))
    found = Positions(compiled)
    for row in np.flatnonzero(compiled.closed)[::10].tolist():
        items = of_kind(
            found.at(row), "link", "ground", "slide", "cylinder", "gear", "belt", "rack", "spring", "pin", "point"
        )
        assert all(map(there, items))
        assert {item.name for item in items if item.kind == "link"} == {
            link_words(link).of(compiled.mechanism.language)
            for link in compiled.mechanism.whole_links[1:]
            if len(link.points) > 1
        }


def test_wheels_belts_and_racks_are_of_kinds_of_their_own():
    kinds = {
        name: {item.kind for item in Positions(Compiled(mechanism)).at(0).items}
        for name, mechanism in {
            "rack": load(folder / "rack-slider.toml"),
            "gear": load(folder / "cardan-gear.toml"),
            "belt": loads(BELT),
        }.items()
    }
    assert all(name in found for name, found in kinds.items())


def test_two_springs():
    lamp = positions(LAMP)
    assert len(of_kind(lamp.at(0), "spring")) == 2
    assert not of_kind(lamp.at(0), "damper", "load", "torque")


def test_the_first_position_shown_is_one_in_which_loads_act():
    """A shaper cuts on its way to the left but for its ends: the row of 0 degrees has no force, that of 15 has."""
    compiled = Compiled(load(folder / "shaper.toml"))
    row = first_shown(compiled.mechanism, compiled.closed, compiled.values)
    assert (row, float(np.degrees(compiled.driver[row]))) == (3, pytest.approx(15))
    scene = Positions(compiled).at(row)
    shaft = next(item for item in of_kind(scene, "load") if not item.fill)
    assert shaft.points[1][0] > shaft.points[0][0]  # to the right, against the cut
    assert not any(there(item) for item in of_kind(Positions(compiled).at(0), "load"))
    without = Compiled(load(folder / "four-bar.toml"))
    assert first_shown(without.mechanism, without.closed, without.values) == 0
