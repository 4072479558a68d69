from dataclasses import replace

import numpy as np
import pytest
from reference_cases import EXAMPLES, mechanism, read

from livesheet.formula.parser import parse_description
from mechsheet.diagnostics import MechanismError
from mechsheet.model import Dimension, Distances, Driver, Link
from mechsheet.reference import dimension_values, driver_values
from mechsheet.reference.geometry import link_points, points_in_links, size
from mechsheet.units import DEG, unit_of


def with_driver(**keys):
    return replace(
        read("drag-link"), driver=Driver(symbol="theta12", unit=DEG, link="crank", relative_to="ground", **keys)
    )


def derived(symbol, formula):
    return Dimension(symbol, parse_description(formula), unit_of("mm", "mm"), written=formula)


def test_dimensions_in_any_order():
    four_bar = read("drag-link")
    dims = (derived("c", "2*b"), derived("b", "a + 1"), Dimension("a", 3.0, unit_of("mm", "mm")))
    values = dimension_values(replace(four_bar, dimensions=dims))
    assert list(values.items()) == [("c", 8.0), ("b", 4.0), ("a", 3.0)]
    assert dimension_values(replace(four_bar, dimensions=dims), {"a": 5.0})["c"] == 12.0


def test_circle_of_dimensions():
    dims = (derived("c", "2*b"), derived("b", "c + 1"))
    with pytest.raises(MechanismError, match="c → b → c"):
        dimension_values(replace(read("drag-link"), dimensions=dims))


def test_dimension_that_is_not_there():
    with pytest.raises(MechanismError, match='"a22" is no dimension; did you mean "a2"'):
        dimension_values(read("drag-link"), {"a22": 1.0})


@pytest.mark.parametrize(
    ("start", "stop", "step", "count"),
    [
        (0, 360, 15, 25),
        (0, 100, 30, 4),
        (0, -90, -30, 4),
        (5, 5, 0, 1),
        (0, 1, 0.1, 11),
        (0, 0.3, 0.1, 4),
        (0, 10, 20, 1),
    ],
)
def test_rows_of_a_sweep(start, stop, step, count):
    values = driver_values(with_driver(start=float(start), stop=float(stop), step=float(step)), {})
    assert len(values) == count
    assert np.array_equal(values, start + np.arange(count) * step)


@pytest.mark.parametrize("step", [0.0, -1.0])
def test_steps_that_never_arrive(step):
    with pytest.raises(MechanismError, match="does not get"):
        driver_values(with_driver(start=0.0, stop=10.0, step=step), {})


def test_values_one_by_one():
    values = driver_values(
        with_driver(values=(0.5, parse_description("acos(4/5)"), parse_description("a"))), {"a": 3.0}
    )
    assert np.array_equal(values, [0.5, np.arccos(0.8), 3.0])


def test_point_by_distances():
    four_bar = read("four-bar", EXAMPLES)
    numbers = dimension_values(four_bar)
    coupler = points_in_links(four_bar, numbers)["coupler"]
    assert np.hypot(*coupler["C"]) == pytest.approx(126.6, rel=1e-15)
    assert np.hypot(*(coupler["C"] - coupler["B"])) == pytest.approx(84.1, rel=1e-15)
    assert np.degrees(np.arctan2(coupler["C"][1], coupler["C"][0])) == pytest.approx(35.538, abs=5e-4)


def test_point_by_distances_that_do_not_meet():
    link = Link("l", 2, {"C": Distances("A", 1.0, "B", 1.0, "right"), **read("drag-link").links[2].points})
    assert np.isnan(link_points(link, {"a3": 3.5})["C"]).all()
    assert link_points(link, {"a3": 2.0})["C"] == pytest.approx([1.0, 0.0])
    assert link_points(link, {"a3": 1.2})["C"] == pytest.approx([0.6, -0.8])


def test_points_in_a_circle():
    link = Link(
        "l",
        2,
        {
            "A": Distances("B", 1.0, "C", 1.0, "left"),
            "B": Distances("A", 1.0, "C", 1.0, "left"),
            "C": Distances("A", 1, "B", 1, "left"),
        },
    )
    with pytest.raises(MechanismError, match="circle"):
        link_points(link, {})


def test_size():
    assert size(read("drag-link"), dimension_values(read("drag-link"))) == 4.0
    text = """
    links.ground.points = {O = [0, 0]}
    links.slide.points = {A = [0, 0]}
    joints = [{type = "prismatic", name = "g", link = "slide", on = "ground", point = "A", through = "O"}]
    driver = {joint = "g", start = 0, stop = -7, step = -1}
    """
    assert size(mechanism(text), {}) == 7.0
