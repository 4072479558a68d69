"""What grows without bound at a limit, or between two rows, has no largest value: the sheet says so in a word."""

import json

import pytest
from laid import Laid, template_text

import mechsheet
from mechsheet.description import loads
from mechsheet.formula.nodes import ErrorValue
from mechsheet.library.show import overview_text
from mechsheet.library.verdicts import verdicts_json

NA = ErrorValue("#N/A")

OUTPUTS = """
[outputs]
wedge = { formula = "1/sin(theta14 - theta13)", unit = "mm" }
ratio = { formula = "omega14/omega12" }
advantage = { formula = "omega12/omega14" }

[summary]
wedge_max = { of = "wedge", take = "max" }
wedge_min = { of = "wedge", take = "min" }
ratio_max = { of = "ratio", take = "max" }
advantage_max = { of = "advantage", take = "max" }
faster = { of = "alpha14", take = "max" }
swing = { of = "theta14", take = "range" }
"""
CRANK_ROCKER = template_text("four-bar").partition("[outputs]")[0] + OUTPUTS
CRANK_ROCKER = CRANK_ROCKER.replace("step = 15", 'step = 15\nspeed = { value = 60, unit = "rpm" }')
AROUND = CRANK_ROCKER.replace("start = 0", "start = -180").replace("stop = 360", "stop = 180")
"""With a2 = 50 one stretch of positions, which ends where the rocker's dyad is stretched: the transmission angle is 180."""

WORDS = {"en": "grows without bound", "tr": "sınırsız büyür"}


def summary(laid, name):
    """The number and the words of a summary's line."""
    row = laid.plan.blocks["summary"].rows[name]
    return laid.values.get(laid.plan.main, row, 1), laid.values.get(laid.plan.main, row, 4)


@pytest.mark.parametrize("language", WORDS)
def test_what_is_without_bound_at_a_limit_has_no_number(language):
    laid = Laid(AROUND, language).change(a2=50)
    for name in ("wedge_max", "ratio_max", "faster"):
        value, words = summary(laid, name)
        assert value == NA and WORDS[language] in words, name
    for name in ("wedge_min", "swing"):
        value, words = summary(laid, name)
        assert isinstance(value, float) and WORDS[language] not in words, name


def test_a_pole_between_two_rows_is_no_extreme():
    """The mechanical advantage where the rocker turns back; the ratio of the speeds is an ordinary curve there."""
    laid = Laid(CRANK_ROCKER)
    value, words = summary(laid, "advantage_max")
    assert value == NA and WORDS["en"] in words
    for name in ("wedge_max", "ratio_max", "faster", "swing"):
        value, words = summary(laid, name)
        assert isinstance(value, float) and WORDS["en"] not in words, name


def test_programs_and_check_are_told_the_same(tmp_path):
    mechanism = loads(AROUND, overrides={"a2": "50"})
    said = json.loads(verdicts_json(mechanism))
    assert said["ratio_max"]["value"] is None and WORDS["en"] in said["ratio_max"]["words"]
    assert abs(said["ratio_max"]["where"]) == pytest.approx(160.41, abs=0.01)
    assert said["wedge_min"]["value"] == pytest.approx(1)
    assert "ratio_max: grows without bound" in overview_text(mechanism)
    (tmp_path / "m.toml").write_text(AROUND.replace("value = 35,", "value = 50,"), encoding="utf-8")
    (path,) = mechsheet.load(tmp_path / "m.toml").build(tmp_path / "m.xlsx")
    assert mechsheet.check(path).agrees


def test_a_page_says_as_much_to_programs():
    """A description for one sheet: all verdicts nevertheless."""
    text = AROUND.partition("[outputs]")[0]
    said = json.loads(verdicts_json(loads(f'{text}\n[workbook]\nlayout = "page"\n')))
    assert said == json.loads(verdicts_json(loads(text)))
    assert said["swing_theta14"]["value"] == pytest.approx(78.94412837)
