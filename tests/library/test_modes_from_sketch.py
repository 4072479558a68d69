"""Assemblies that have numbers, of groups that Newton's method solves: `--set mode_1=3`, and what `pull` brings back."""

import pytest

import mechsheet
from mechsheet.checking.edited.pull import pull
from mechsheet.compiled import compiled_of
from mechsheet.description.templates import template_text
from mechsheet.kinematics.solve import solve

pytestmark = pytest.mark.slow

PLATFORM = template_text("planar-3rpr")


@pytest.mark.cases(1)
@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_each_number_becomes_a_sketch(number):
    linkage = mechsheet.loads(PLATFORM, overrides={"mode_1": number})
    (group,) = solve(linkage).groups
    assert group.mode_value == number
    (again,) = solve(mechsheet.loads(linkage.text)).groups
    assert again.mode_value == number


@pytest.mark.parametrize("number", [5, -1])
def test_a_number_that_there_is_not(number):
    with pytest.raises(mechsheet.MechsheetError, match=f"one of 4 assemblies, not .{number}") as caught:
        mechsheet.loads(PLATFORM, overrides={"mode_1": number})
    assert "2: theta12 = 26.32°" in caught.value.faults[0].hint


@pytest.mark.cases(1)
@pytest.mark.parametrize("p1", [5, 4.8])
def test_pull_brings_the_assembly_chosen_back(tmp_path, p1):
    """Also where a dimension was changed, by which the assemblies stand otherwise."""
    linkage = mechsheet.loads(PLATFORM)
    (path,) = linkage.build(tmp_path, formats=["xlsx"])
    typed = mechsheet.recalc(path, {"mode_1": 3, "p1": p1})
    typed.write(tmp_path / "typed.xlsx")
    pulled = pull(tmp_path / "typed.xlsx")
    assert "mode_1: 1 -> 3" in pulled.changes
    spot = compiled_of(linkage).plan.at.spots["theta16"]
    found = mechsheet.loads(pulled.text).solve()
    assert found["theta16"][0] == pytest.approx(typed.get(spot.sheet, spot.row, spot.col), abs=1e-9)
