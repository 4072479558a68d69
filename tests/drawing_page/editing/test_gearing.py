"""Wheels, racks and further drivers by the mouse; and that they go with what they belong to."""

import pytest
from asking_page import Drawing, four_bar, pin, spot

from judging import judged
from mechsheet.description import loads
from mechsheet.drawing_page.questions import Impossible


def two_cranks():
    """Two cranks and two rods: a freedom too many."""
    drawing = Drawing().do("ground", end=spot(0, 0)).do("ground", end=spot(70, 0))
    drawing.do("link", ends=[pin("A0"), spot(20, 30)]).do("link", ends=[pin("B0"), spot(90, 30)])
    drawing.do("link", ends=[pin("A"), spot(60, 90)]).do("link", ends=[pin("B"), pin("C")])
    return drawing.do("driver", link="link2")


def test_a_gear_between_two_cranks_takes_a_freedom_away():
    drawing = two_cranks()
    assert (drawing.look["solved"], drawing.look["mobility"]) == (False, 2)
    drawing.do("gear", on="link2", end={"link": "link3"}, size="-20/40")
    assert drawing.look["solved"]
    assert 'ratio = "-20/40"' in drawing.text
    assert {shape["kind"] for shape in drawing.look["shapes"]} == {"gear"}
    assert judged(loads(drawing.text)).agrees


def test_a_second_driver_takes_the_freedom_that_is_left_and_stays_where_it_is_drawn():
    drawing = two_cranks()
    before = drawing.places()["C"]
    drawing.do("driver", link="link3")
    assert drawing.look["solved"]
    assert loads(drawing.text).drivers[0].link == "link3"
    assert drawing.places()["C"] == pytest.approx(before, abs=0.05)
    cells = {cell["place"]: cell["value"] for cell in drawing.look["cells"]}
    assert cells["drivers[1].value"] == pytest.approx(56.31, abs=0.01)
    drawing.do("cell", name="drivers[1].value", value="1 rad")
    assert "value = 57.29577951" in drawing.text


def test_a_new_wheel_beside_a_crank():
    drawing = Drawing(four_bar().do("driver", link="link2").text).do("gear", on="link2", end=spot(-40, 0), size="-2")
    assert drawing.look["solved"]
    assert loads(drawing.text).relations[0].on == "link2"


def test_a_rack_is_a_pinion_and_a_slider():
    drawing = Drawing().do("ground", end=spot(0, 0)).do("link", ends=[pin("A0"), spot(20, 30)])
    drawing.do("link", ends=[spot(60, -25), spot(90, -25)]).do(
        "slide", kind="prismatic", end=pin("B"), on=spot(160, -25)
    )
    joint = drawing.look["joints"][0]["name"]
    assert joint
    drawing = Drawing().do("ground", end=spot(0, 0)).do("link", ends=[pin("A0"), spot(20, 30)])
    drawing.do("slide", kind="prismatic", end=spot(60, -25), on=spot(160, -25)).do("driver", link="link2")
    drawing.do("gear", on="link2", end={"joint": drawing.look["joints"][0]["name"]}, size="25 mm")
    assert drawing.look["solved"]
    assert "radius = 25 " in drawing.text
    assert {shape["kind"] for shape in drawing.look["shapes"]} == {"gear", "rack"}


def test_what_belongs_to_a_link_goes_with_it():
    drawing = two_cranks().do("gear", on="link2", end={"link": "link3"}, size="-1")
    kept = drawing.text
    drawing.do("force", end=pin("B"), to=[90, 0], size="10").do("mass", link="link3", size="1", shape="bar")
    drawing.do("delete", load="P").do("delete", mass="link3")
    assert drawing.text.split() == kept.split()
    drawing.do("delete", link="link3")
    assert "[[joints]]" not in drawing.text
    assert not [fault for fault in drawing.look["faults"] if "link3" in fault["message"]]


def test_what_does_not_mesh_says_why():
    with pytest.raises(Impossible, match="gear_pivot"):
        four_bar().do("gear", on="link2", end={"link": "link2"}, size="-1")
    with pytest.raises(Impossible, match="ratio"):
        two_cranks().do("gear", on="link2", end={"link": "link3"}, size='"')
