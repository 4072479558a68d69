"""The model as data: what is an input, what follows, what files and angles are called."""

import dataclasses

import pytest

from livesheet.formula.nodes import Symbol
from livesheet.formula.parser import parse_description
from mechsheet.description import loads
from mechsheet.model import Dimension, Label, Link
from mechsheet.units import RAD

TEXT = """
format = 1
mechanism = { name = "crank" }
dimensions = { a = 30, b = { formula = "2 * a" } }
links.ground.points = { O = [0, 0] }
links.crank.points = { O = [0, 0], A = ["a", 0], B = { r = "b", angle = "pi/6" } }
driver = { link = "crank", start = 0, stop = "2*pi", step = 15 }
outputs.height = { formula = "A.y" }
"""


@pytest.fixture(scope="module")
def crank():
    return loads(TEXT, "shop/crank.toml")


def test_expressions_are_read_once_and_stay_as_they_were_written(crank):
    a, b = crank.dimensions
    assert (a.value, a.derived, a.written) == (30.0, False, "")
    assert (b.value, b.derived, b.written) == (parse_description("2*a"), True, "2 * a")
    points = crank.links[1].points
    assert (points["A"].x, points["A"].y) == (Symbol("a"), 0.0)
    assert points["B"].angle == parse_description("pi/6")
    assert (crank.driver.start, crank.driver.stop) == (0.0, parse_description("2*pi"))
    assert crank.outputs[0].formula == Symbol("A.y")


def test_a_model_cannot_be_changed(crank):
    with pytest.raises(dataclasses.FrozenInstanceError):
        crank.name = "lever"


def test_words_in_both_languages():
    assert [Label("crank", (("tr", "krank"),)).of(language) for language in ("en", "tr")] == ["crank", "krank"]


@pytest.mark.parametrize(("number", "symbol"), [(2, "theta12"), (9, "theta19"), (10, "theta1_10")])
def test_angles_are_named_after_links(number, symbol):
    assert Link("l", number, {}).angle_symbol == symbol


def test_files_are_called_after_the_description(crank):
    assert (crank.stem, crank.ground.name) == (crank.file or "crank", "ground")
    assert dataclasses.replace(crank, file="four").stem == "four"


def test_an_input_is_a_number():
    assert not Dimension("a", 30.0, RAD).derived
