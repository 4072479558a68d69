"""A description read with changes: assembly modes, and rows and step as numbers of the library."""

import pytest

import mechsheet
from mechsheet.description.templates import template_text
from mechsheet.kinematics.solve import solve

FOUR_BAR = template_text("four-bar")


def modes(mechanism):
    return {group.mode: group.mode_value for group in solve(mechanism).groups if group.mode}


def test_a_mode_is_said_by_a_sketch_that_travels_in_the_text():
    linkage = mechsheet.loads(FOUR_BAR, overrides={"mode_1": -1})
    assert modes(linkage) == {"mode_1": -1}
    assert "B = [63, -56]" in linkage.text
    assert modes(mechsheet.loads(linkage.text)) == {"mode_1": -1}
    assert (linkage.solve()["B.y"] < 0).any() and linkage.solve().exists.all()
    assert mechsheet.loads(FOUR_BAR, overrides={"mode_1": "1"}).text == FOUR_BAR


def test_the_other_groups_keep_their_modes():
    text = template_text("watt-i")
    own = modes(mechsheet.loads(text))
    assert len(own) > 1
    for mode, value in own.items():
        assert modes(mechsheet.loads(text, overrides={mode: -value})) == own | {mode: -value}


def test_a_sketch_between_two_modes_is_decided():
    between = FOUR_BAR.replace("B = [50, 55]", "B = [63, 0]")
    with pytest.raises(mechsheet.MechsheetError, match="lies between"):
        solve(mechsheet.loads(between))
    for mode in (1, -1):
        assert modes(mechsheet.loads(between, overrides={"mode_1": mode})) == {"mode_1": mode}


def test_modes_with_other_changes():
    linkage = mechsheet.loads(FOUR_BAR, overrides={"mode_1": -1, "a2": "40*1.1", "a4": "a2 + 20"}, rows=5, step="90/4")
    assert modes(linkage) == {"mode_1": -1}
    assert {dim.symbol: dim.shown for dim in linkage.dimensions}["a4"] == 64
    assert linkage.solve()["theta12"].tolist() == pytest.approx([0, 22.5, 45, 67.5, 90])


def test_a_dimension_called_so_comes_first():
    text = FOUR_BAR.replace("a1 = 70", "mode_1 = 3\na1 = 70").replace("a1 = {", "mode_1 = 3\na1 = {")
    linkage = mechsheet.loads(text, overrides={"mode_1": 2, "mode_1_1": -1})
    assert {dim.symbol: dim.shown for dim in linkage.dimensions}["mode_1"] == 2
    assert modes(linkage) == {"mode_1_1": -1}


def test_a_mode_in_which_nothing_closes():
    with pytest.raises(mechsheet.MechsheetError, match="overrides: mode_1=-1: the links cannot be joined") as found:
        mechsheet.template("slotted-lever", overrides={"mode_1": -modes(mechsheet.template("slotted-lever"))["mode_1"]})
    assert len(found.value.faults) == 1


@pytest.mark.parametrize(("rows", "step", "key"), [("5", None, "rows"), (2.5, None, "rows"), (None, True, "step")])
def test_numbers_of_the_library(rows, step, key):
    with pytest.raises(mechsheet.MechsheetError) as found:
        mechsheet.template("four-bar", rows=rows, step=step)
    assert found.value.faults[0].key == key
