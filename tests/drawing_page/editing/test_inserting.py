"""What is written into the text from the menu: it works at once, says what its numbers are, and names what is drawn."""

from functools import lru_cache

import pytest
from asking_page import Drawing, four_bar

from mechsheet.description import loads
from mechsheet.drawing_page.editing.orders import INSERTED
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.words.catalogue import is_key


@lru_cache
def text_of_a_driven_four_bar():
    return four_bar().do("driver", link="link2").text


def driven(language="en"):
    return Drawing(text_of_a_driven_four_bar(), language)


@pytest.mark.parametrize("what", INSERTED)
def test_whatever_is_inserted_fits_and_all_else_stays(what):
    drawing = driven("tr" if what == "masses" else "en")
    before = drawing.text
    drawing.do("insert", what=what)
    assert drawing.look["solved"]
    kept = {"motion": ("step",)}.get(what, ())
    assert not {line for line in before.splitlines() if not line.startswith(kept)} - set(drawing.text.splitlines())
    assert is_key(f"draw.insert.{what}")
    if what == "masses":
        assert "# kütle merkezi, uzvun takımında" in drawing.text


def test_a_motion_law_takes_the_place_of_step_and_speed():
    drawing = driven().do("cell", name="driver.speed", value="60")
    assert loads(drawing.text).driver.speed is not None
    drawing.do("insert", what="motion")
    assert loads(drawing.text).driver.law is not None
    assert "driver.speed" not in [cell["place"] for cell in drawing.look["cells"]]


def test_what_cannot_be_inserted_says_why():
    with pytest.raises(Impossible, match="drive_first"):
        four_bar().do("insert", what="motion")
    with pytest.raises(Impossible, match="there_already"):
        driven().do("insert", what="masses").do("insert", what="masses")
    with pytest.raises(Refusal):
        driven().do("insert", what="nonsense")
