"""Loads and masses by the mouse: what is written of them, and what it means."""

import math

import numpy as np
import pytest
from asking_page import Drawing, four_bar, pin, spot

from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.drawing_page.questions import Impossible, Refusal


def driven(language="en"):
    return Drawing(four_bar().do("driver", link="link2").text, language)


def test_a_force_points_where_its_arrow_does_and_is_as_large_as_was_said():
    drawing = driven().do("force", end=pin("C"), to=[63, 94.2], size="0.2 kN")
    (load,) = loads(drawing.text).dynamics.loads
    assert (load.name, load.link, load.point) == ("P", "link3", "C")
    cells = {cell["symbol"]: cell["value"] for cell in drawing.look["cells"]}
    assert (cells["P_x"], cells["P_y"]) == pytest.approx((200 * 3 / 5.1612, 200 * 4.2 / 5.1612), abs=0.1)
    assert "# N, to the right and upwards" in drawing.text


def test_an_arrow_along_an_axis_has_no_small_part_and_acts_on_a_place_of_a_link():
    drawing = driven().do("force", end={"link": "link4", "at": [73, 36]}, to=[74, 0], size="50")
    assert "force = [0, -50]" in drawing.text
    (load,) = loads(drawing.text).dynamics.loads
    assert load.link == "link4"
    u, v = (float(part) for part in (drawing.text.split("point = [")[1].split("]")[0]).split(","))
    assert math.hypot(u, v) == pytest.approx(math.hypot(2, 24), abs=0.01)


@pytest.mark.parametrize("end", [pin("A"), spot(90, 100)])
def test_a_spring_lies_between_two_points_and_has_no_force_as_drawn(end):
    drawing = driven().do("spring", ends=[pin("B0") if "point" in end else pin("C"), end], size="2 N/mm")
    assert drawing.look["solved"]
    (spring,) = loads(drawing.text).dynamics.springs
    cells = {cell["symbol"]: cell["value"] for cell in drawing.look["cells"]}
    (first, second) = (drawing.places()[point] for _, point in spring.ends)
    assert cells["k_K"] == 2
    assert cells["l_K"] == pytest.approx(math.dist(first, second), abs=0.01)
    assert {shape["kind"] for shape in drawing.look["shapes"]} >= {"spring"}
    drawing.do("damper", ends=[pin("B0"), pin("C")], size="0.1")
    assert loads(drawing.text).dynamics.springs[1].name == "D"


def test_a_torque_and_numbers_typed_over_with_their_units():
    drawing = driven("tr").do("torque", link="link4", size="-3")
    assert "# N m, saat yönünün tersine" in drawing.text
    drawing.do("cell", name="loads[1].torque", value="5000 Nmm")
    assert "torque = 5 " in drawing.text
    drawing.do("cell", name="driver.speed", value="60 rpm")
    assert 'speed = "60 rpm"' in drawing.text
    drawing.do("cell", name="driver.speed", value="2 rev/s")
    assert 'speed = "120 rpm"' in drawing.text
    assert {curve["role"] for curve in drawing.look["curves"]} >= {"rate"}
    with pytest.raises(MechsheetError, match="mm"):
        drawing.do("cell", name="loads[1].torque", value="5 mm")
    with pytest.raises(Refusal):
        drawing.do("cell", name="loads[2].torque", value="5")


@pytest.mark.parametrize(
    ("link", "shape", "inertia"),
    [
        ("link2", "bar", lambda d: d["m_link2"] * d["a2"] ** 2 / 12),
        ("link4", "disc", lambda d: d["m_link4"] * d["r_4"] ** 2 / 2),
        ("link4", "plate", lambda d: d["m_link4"] * (d["a4"] ** 2 + d["b_4"] ** 2) / 12),
        ("link4", "point", lambda d: 0),
    ],
)
def test_a_mass_has_the_moment_of_inertia_of_its_shape(link, shape, inertia):
    drawing = driven().do("mass", link=link, size="2 kg", shape=shape)
    drawing.do("cell", name="driver.speed", value="60")
    values = {each["symbol"]: each["value"] for each in drawing.look["dimensions"]}
    moment = Compiled(loads(drawing.text)).values[f"J_{link[-1]}"]
    assert np.ravel(moment)[0] == pytest.approx(inertia(values) / 1e6, rel=1e-9, abs=1e-12)
    assert "gravity = 9.81" in drawing.text


def test_a_plate_of_three_points_is_a_triangle_whose_centre_follows_the_dimensions():
    """The moment of a triangle about its centre by another way: its sides."""
    drawing = driven().do("mass", link="link3", size="3", shape="plate").do("dimension", name="b3", value="90")
    mechanism = loads(drawing.text)
    values = Compiled(mechanism).values
    row = 3
    corners = [np.array([values[f"{point}.{axis}"][row] for axis in "xy"]) for point in "ABC"]
    sides = [math.dist(corners[n], corners[n - 1]) for n in range(3)]
    centre = [float(values[f"G3.{axis}"][row]) for axis in "xy"]
    assert centre == pytest.approx(sum(corners) / 3)
    assert np.ravel(values["J_3"])[0] == pytest.approx(3 * sum(side**2 for side in sides) / 36 / 1e6)


def test_what_does_not_move_has_neither_load_nor_mass():
    alone = Drawing().do("ground", end=spot(0, 0))
    with pytest.raises(Impossible, match="load_moving"):
        alone.do("force", end=pin("A0"), to=[10, 0], size="1")
    with pytest.raises(Impossible, match="load_moving"):
        driven().do("mass", link="ground", size="1", shape="bar")
    with pytest.raises(Impossible, match="spring_apart"):
        driven().do("spring", ends=[pin("A"), pin("B")], size="1")
    with pytest.raises(Impossible, match="there_already"):
        driven().do("mass", link="link4", size="1", shape="bar").do("mass", link="link4", size="1", shape="bar")
