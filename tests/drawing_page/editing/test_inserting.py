"""What is written into the text from the menu: it works at once, says what its numbers are, and names what is drawn."""

from functools import lru_cache

import pytest
from asking_page import Drawing, four_bar, pin, spot

from mechsheet.description import loads
from mechsheet.drawing_page.editing.inserting import KINDS
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.words.catalogue import is_key

FORCE = """
[[loads]]
name = "P"                  # its yellow cells begin with it
link = "link4"              # the link it acts on
point = "B"                 # a point of the link, or a place in its frame: [20, 5]
force = [0, -100]           # N, to the right and upwards; numbers or expressions
"""


@lru_cache
def text_of_a_driven_four_bar():
    return four_bar().do("driver", link="link2").text


def driven(language="en"):
    return Drawing(text_of_a_driven_four_bar(), language)


@pytest.mark.parametrize("what", KINDS)
def test_whatever_is_inserted_fits_and_all_else_stays(what):
    drawing = driven("tr" if what == "spring" else "en")
    before = drawing.text
    drawing.do("insert", what=what)
    assert drawing.look["solved"]
    kept = {"motion": ("step",), "gear": ("points = { A0 = [0, 0], B0",)}.get(what, ())
    assert not {line for line in before.splitlines() if not line.startswith(kept)} - set(drawing.text.splitlines())
    assert is_key(f"draw.insert.{what}")
    if what == "spring":
        assert "# ayrı uzuvların iki noktası" in drawing.text


def test_a_force_names_what_is_drawn_or_what_is_chosen():
    drawing = driven().do("insert", what="force")
    assert FORCE in drawing.text
    drawing.do("insert", what="force", point="C")
    first, second = loads(drawing.text).dynamics.loads
    assert (first.name, first.link, first.point) == ("P", "link4", "B")
    assert (second.name, second.link, second.point) == ("P2", "link3", "C")


def test_a_motion_law_takes_the_place_of_step_and_speed():
    drawing = driven().do("insert", what="speed")
    assert loads(drawing.text).driver.speed is not None
    drawing.do("insert", what="motion")
    assert loads(drawing.text).driver.law is not None
    with pytest.raises(Impossible, match="there_already"):
        drawing.do("insert", what="speed")


def test_a_gear_takes_a_freedom_away_or_brings_a_wheel_of_its_own():
    """Two cranks and two rods have a freedom too many: the gear joins the cranks. To a four-bar a wheel comes with it."""
    drawing = Drawing().do("ground", end=spot(0, 0)).do("ground", end=spot(70, 0))
    drawing.do("link", ends=[pin("A0"), spot(20, 30)]).do("link", ends=[pin("B0"), spot(90, 30)])
    drawing.do("link", ends=[pin("A"), spot(60, 90)]).do("link", ends=[pin("B"), pin("C")]).do("driver", link="link2")
    assert (drawing.look["solved"], drawing.look["mobility"]) == (False, 2)
    drawing.do("insert", what="gear")
    assert drawing.look["solved"]
    assert len(drawing.look["links"]) == 5
    assert len(driven().do("insert", what="gear").look["links"]) == 5


def test_what_cannot_be_inserted_says_why():
    with pytest.raises(Impossible, match="drive_first"):
        four_bar().do("insert", what="speed")
    with pytest.raises(Impossible, match="draw_first"):
        Drawing().do("insert", what="force")
    with pytest.raises(Impossible, match="gear_pivot"):
        Drawing().do("insert", what="gear")
    with pytest.raises(Impossible, match="there_already"):
        driven().do("insert", what="masses").do("insert", what="masses")
    with pytest.raises(Refusal):
        driven().do("insert", what="nonsense")
