"""A further kind of synthesis: its declaration, a line, its keys, words and the reference's own solution, no more."""

import math

import pytest
from laid import Laid

from catalogues import added
from mechsheet.description import loads
from mechsheet.description.asked.schema import SYNTHESIS
from mechsheet.description.grammar import Key, Number, Table, Text
from mechsheet.diagnostics import DescriptionError
from mechsheet.reference import dimension_values
from mechsheet.reference.synthesis import results
from mechsheet.synthesis import kinds
from mechsheet.synthesis.kind import Kind, Line, Requirement

TEXT = """
format = 1
[mechanism]
name = "central"
[synthesis]
kind = "central-slider"
stroke = 80
swing = 15
[dimensions]
a2 = { synthesis = "a2" }
a3 = { synthesis = "a3" }
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.rod]
points = { A = [0, 0], B = ["a3", 0] }
[links.slider]
points = { B = [0, 0] }
[[joints]]
type = "prismatic"
link = "slider"
on = "ground"
point = "B"
through = [0, 0]
symbol = "s"
[driver]
link = "crank"
start = 0
stop = 360
step = 30
[assembly]
B = [150, 0]
"""


def write(w):
    w.length("stroke")
    w.angle("swing")
    w.result("a2", "stroke/2", w.units.length, "crank")
    w.result("a3", "a2/sin(swing)", w.units.length, "rod", "sin(swing)")


CENTRAL = Kind(
    write,
    lambda _: [Requirement("stroke", "stroke", "(a3 + a2) - (a3 - a2)", "length")],
    lambda _: [Line("figure.dead", (("A0", "0", "0"), ("A1", "a2", "0"), ("B1", "a2 + a3", "0")), number=1)],
    ("meets", "turns", "sensitivity"),
    angles=("swing",),
    positive=("stroke",),
    turns="a3 - a2",
)


@pytest.fixture(autouse=True)
def further(monkeypatch, tmp_path):
    """A central slider-crank from its stroke and the largest angle of its rod, as a kind of its own."""
    keys = Table({"kind": Key(Text(), "", True), "stroke": Key(Number(), "", True), "swing": Key(Number(), "", True)})
    monkeypatch.setitem(SYNTHESIS.tables, "central-slider", keys)
    monkeypatch.setitem(kinds.KINDS, "central-slider", CENTRAL)
    further = {"synthesis.kind.central-slider": "Central", "synthesis.figure.central-slider": "Dead centre"}
    monkeypatch.setitem(
        results.KINDS,
        "central-slider",
        lambda given: {"a2": given.at("stroke") / 2, "a3": given.at("stroke") / 2 / math.sin(given.at("swing"))},
    )
    with added(tmp_path, "en", further):
        yield


@pytest.mark.slow
def test_its_workbook_solves_the_task_and_follows_what_is_typed():
    sheet = Laid(TEXT)
    assert sheet.spot("a2") == 40
    assert sheet.spot("a3") == pytest.approx(40 / math.sin(math.radians(15)), rel=1e-15)
    assert sheet.spot("synthesis") == "does all that the task asks"
    sheet.change(swing=30)
    assert sheet.spot("a3") == pytest.approx(80, rel=1e-15)


def test_the_reference_finds_the_same():
    found = dimension_values(loads(TEXT))
    assert found["a3"] == pytest.approx(40 / math.sin(math.radians(15)), rel=1e-15)


def test_its_keys_are_checked():
    with pytest.raises(DescriptionError, match=r"synthesis\.stroke: must be greater than 0"):
        loads(TEXT.replace("stroke = 80", "stroke = -80"))
