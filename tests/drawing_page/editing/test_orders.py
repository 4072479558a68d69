"""What is drawn becomes a description: links, pins, sliders, the driver; and goes again without a trace."""

import pytest
from asking_page import Drawing, four_bar, pin, spot

import mechsheet
from judging import judged
from mechsheet.description import loads
from mechsheet.drawing_page.questions import Impossible, Refusal

WRITTEN = """\
format = 1

[mechanism]
name = "drawn"

[dimensions]
x_B0 = { value = 70, label = "x, B0" }
a2 = { value = 36.056, label = "A0A" }
a3 = { value = 62.65, label = "AB" }
a4 = { value = 60.208, label = "BB0" }
b3 = { value = 72.111, label = "AC" }
gamma3 = { value = 27.7, unit = "deg", label = "BAC" }

[links.ground]
points = { A0 = [0, 0], B0 = ["x_B0", 0] }
[links.link2]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.link3]
points = { A = [0, 0], B = ["a3", 0], C = { r = "b3", angle = "gamma3" } }
[links.link4]
points = { B = [0, 0], B0 = ["a4", 0] }

[driver]
link = "link2"
start = 0
stop = 360
step = 15

[assembly]
at = 56.31
A = [20, 30]
B = [75, 60]
C = [60, 90]
"""


def near(drawing, **places):
    for name, place in places.items():
        assert drawing.places()[name] == pytest.approx(place, abs=0.02), name


def test_a_four_bar_reads_as_a_person_would_have_written_it():
    drawing = four_bar()
    assert (drawing.look["solved"], drawing.look["mobility"]) == (False, 1)
    drawing.do("driver", link="link2")
    assert drawing.text == WRITTEN
    assert drawing.look["solved"]
    near(drawing, A=(20, 30), B=(75, 60), C=(60, 90))
    assert judged(loads(drawing.text)).agrees


@pytest.mark.parametrize(("towards", "line"), [((160, 10), [0, "y_B"]), ((120, 90), ["x_B", 0])])
def test_a_slider_crank(towards, line):
    drawing = Drawing().do("ground", end=spot(0, 0)).do("link", ends=[pin("A0"), spot(20, 30)])
    drawing.do("link", ends=[pin("A"), spot(120, 10)]).do("slide", kind="prismatic", end=pin("B"), on=spot(*towards))
    drawing.do("driver", link="link2")
    assert drawing.look["solved"], drawing.look["faults"]
    near(drawing, A=(20, 30), B=(120, 10))
    mechanism = loads(drawing.text)
    (joint,) = mechanism.joints
    assert [getattr(part, "name", part) for part in joint.through] == line
    assert judged(mechanism).agrees


def test_a_slider_on_a_guide_askew():
    drawing = Drawing().do("ground", end=spot(10, 5)).do("link", ends=[pin("A0"), spot(20, 30)])
    drawing.do("link", ends=[pin("A"), spot(120, 10)]).do("slide", kind="pin-slot", end=pin("B"), on=spot(160, 40))
    drawing.do("driver", link="link2")
    near(drawing, A0=(10, 5), A=(20, 30), B=(120, 10))
    assert judged(loads(drawing.text)).agrees


def test_a_slotted_lever_about_a_pin_of_the_ground():
    drawing = Drawing().do("ground", end=spot(0, 0)).do("ground", end=spot(-50, -10))
    drawing.do("link", ends=[pin("A0"), spot(20, 30)]).do("slide", kind="pin-slot", end=pin("A"), on=pin("B0"))
    drawing.do("driver", link="link2").do("plate", link="link3", end=spot(40, 80))
    near(drawing, A=(20, 30), B=(40, 80))
    assert judged(loads(drawing.text)).agrees


def test_a_block_on_a_moving_link():
    drawing = (
        Drawing().do("ground", end=spot(0, 0)).do("ground", end=spot(80, 0)).do("link", ends=[pin("A0"), spot(20, 30)])
    )
    drawing.do("link", ends=[pin("B0"), spot(60, 70)]).do("slide", kind="pin-slot", end=pin("A"), on={"link": "link3"})
    assert drawing.look["mobility"] == 1
    drawing.do("driver", link="link2")
    assert drawing.look["frames"]["lines"]


def test_a_cylinder_is_driven_by_its_length():
    drawing = Drawing().do("ground", end=spot(0, 0)).do("ground", end=spot(40, -30))
    drawing.do("link", ends=[pin("A0"), spot(60, 20)]).do("slide", kind="prismatic", end=pin("A"), on=pin("B0"))
    drawing.do("driver", joint="s34")
    near(drawing, A=(60, 20))
    assert drawing.at == pytest.approx(53.85, abs=0.01)
    assert judged(loads(drawing.text)).agrees


@pytest.mark.parametrize("kind", ["link", "point"])
def test_what_is_deleted_leaves_nothing_behind(kind):
    drawing = four_bar().do("driver", link="link2")
    before = drawing.text
    drawing.do("link", ends=[pin("C"), spot(100, 120)])
    assert drawing.text != before
    drawing.do("delete", **{kind: "link5" if kind == "link" else "D"})
    drawing.text = drawing.text.replace("\n\n\n", "\n\n")
    assert drawing.text == before
    assert drawing.look["solved"]


def test_a_joint_that_is_deleted_takes_its_block_along():
    drawing = Drawing().do("ground", end=spot(0, 0)).do("link", ends=[pin("A0"), spot(20, 30)])
    drawing.do("link", ends=[pin("A"), spot(120, 10)])
    before = drawing.text
    drawing.do("slide", kind="prismatic", end=pin("B"), on=spot(160, 10)).do("delete", joint="s14")
    assert drawing.text == before


def test_dimensions_that_others_read_stay():
    text = mechsheet.template("four-bar").text
    drawing = Drawing(text).do("delete", point="C")
    assert "gamma3 =" not in drawing.text
    assert "a3 =" in drawing.text
    assert any(fault["key"].startswith("charts") for fault in drawing.look["faults"])  # its chart still names C


def test_a_point_that_is_fixed_stays_where_it_is():
    drawing = four_bar().do("ground", end=pin("C"))
    near(drawing, C=(60, 90))
    assert drawing.look["mobility"] == -1
    assert any("cannot move" in f["message"] or "mobility" in f["message"] for f in drawing.look["faults"])


def test_another_driver_keeps_the_sweep_and_the_comments():
    text = mechsheet.template("four-bar").text
    drawing = Drawing(text).do("driver", link="rocker")
    assert 'link = "rocker"' in drawing.text
    assert "step = 15" in drawing.text
    assert drawing.text.count("[driver]") == 1
    assert [line for line in drawing.text.splitlines() if line.startswith("#")] == [
        line for line in text.splitlines() if line.startswith("#")
    ]


def test_names_are_turkish_where_the_page_is():
    drawing = Drawing(language="tr").do("ground", end=spot(0, 0))
    drawing.do("link", ends=[pin("A0"), spot(1, 2)])
    assert "[links.uzuv2]" in drawing.text


@pytest.mark.parametrize(
    "order",
    [
        {"do": "link", "ends": [pin("A"), pin("B")]},
        {"do": "link", "ends": [pin("A"), pin("A")]},
        {"do": "link", "ends": [spot(1, 1), spot(1, 1)]},
        {"do": "ground", "end": pin("A0")},
        {"do": "plate", "link": "link3", "end": pin("B")},
        {"do": "slide", "kind": "prismatic", "end": pin("A"), "on": {"link": "link3"}},
        {"do": "slide", "kind": "pin-slot", "end": pin("A"), "on": spot(20, 30)},
        {"do": "slide", "kind": "pin-slot", "end": spot(5, 5), "on": spot(20, 30)},
        {"do": "driver", "link": "ground"},
        {"do": "delete", "link": "ground"},
    ],
)
def test_what_cannot_be_drawn_so_is_told_in_both_languages(order):
    drawing = four_bar()
    with pytest.raises(Impossible) as told:
        drawing.do(**order)
    texts = {told.value.text(language) for language in ("en", "tr")}
    assert len(texts) == 2
    assert all(text.endswith(".") and "{" not in text for text in texts)


@pytest.mark.parametrize(
    ("order", "said"),
    [
        ({"do": "link"}, "a link begins and ends"),
        ({"do": "link", "ends": [1, 2]}, "an end is a table"),
        ({"do": "link", "ends": [pin("X"), pin("A")]}, 'there is no point "X"'),
        ({"do": "plate", "link": "nothing", "end": spot(0, 0)}, 'there is no link "nothing"'),
        ({"do": "slide", "kind": "glide", "end": pin("A"), "on": spot(0, 0)}, 'no sliding joint is called "glide"'),
        ({"do": "slide", "kind": "pin-slot", "end": pin("A"), "on": 3}, '"on" is a table'),
        ({"do": "driver", "joint": "nothing"}, 'there is no sliding joint "nothing"'),
        ({"do": "delete"}, '"" must be a text'),
        ({"do": "delete", "point": "nothing"}, 'there is no point "nothing"'),
        ({"do": "delete", "joint": "nothing"}, 'there is no sliding joint "nothing"'),
    ],
)
def test_orders_that_make_no_sense_are_refused(order, said):
    with pytest.raises(Refusal, match=said):
        four_bar().do(**order)


@pytest.mark.parametrize(
    ("name", "value", "there"),
    [
        ("a2", "40", "a2 = { value = 40,"),
        ("a2", "20+5", "a2 = { value = 25"),
        ("a2", "20 mm", "a2 = { value = 20"),
        ("driver.step", "7.5°", "step = 7.5"),
        ("driver.step", "7,5", "step = 7.5"),
        ("gamma3", "30", "gamma3 = { value = 30,"),
    ],
)
def test_numbers_that_are_typed(name, value, there):
    drawing = four_bar().do("driver", link="link2").do("dimension", name=name, value=value)
    assert there in drawing.text


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("a2", "x", '"x" is not a dimension'),
        ("a9", "1", 'no dimension is called "a9"'),
        ("driver.step", "fast", 'driver.step: "fast" is no number'),
        ("driver.start", "3 mm", 'driver.start: "3 mm" where ° are needed'),
    ],
)
def test_numbers_that_are_none_are_refused(name, value, said):
    with pytest.raises(mechsheet.MechsheetError, match=said):
        four_bar().do("driver", link="link2").do("dimension", name=name, value=value)
