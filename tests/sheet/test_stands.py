"""How it stands: types of four-bar loops, limits, strokes, time ratios and transmission angles against closed forms."""

import math
import tomllib

import pytest
from laid import ROOT, Laid, template_text

CASES = tomllib.loads((ROOT / "tests/cases/stands.toml").read_text(encoding="utf-8"))
FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]


@pytest.mark.parametrize("case", CASES["four-bar"], ids=lambda case: case["words"])
def test_types_of_four_bars(case):
    """Typed into the cells of one and the same workbook: the words are live."""
    a1, a2, a3, a4 = case["lengths"]
    laid = Laid(FOUR_BAR).change(a1=a1, a2=a2, a3=a3, a4=a4)
    assert laid.stands("grashof 1", 4) == case["words"]
    shortest, longest = min(case["lengths"]), max(case["lengths"])
    assert laid.stands("grashof 1") == pytest.approx(2 * (shortest + longest) - sum(case["lengths"]), abs=1e-12)
    assert laid.stands("swing theta14", 4) == case["rocker"]


def test_from_where_to_where():
    """a1 = 100 lets the rocker only be reached while |A B0| <= a3 + a4."""
    laid = Laid(FOUR_BAR, overrides={"a1": "100"})
    limit = math.degrees(math.acos((100**2 + 35**2 - 118.3**2) / (2 * 100 * 35)))
    last = 15 * math.floor(limit / 15)
    assert laid.stands("rows") == 2 * last / 15 + 2
    assert laid.stands("rows", 4) == "assembles from 0° to 360°, 2 stretches"
    assert laid.stands("missing") == 25 - laid.stands("rows")
    assert laid.stands("missing", 3) == last + 15
    assert Laid(FOUR_BAR).stands("rows", 4) == "assembles over the whole range"
    assert Laid(FOUR_BAR).change(a1=500).stands("rows", 4) == "assembles nowhere"


def test_transmission_angle_and_swing():
    """cos(mu) = (a3^2 + a4^2 - s^2) / (2 a3 a4), with s between |a1 - a2| and a1 + a2."""
    a1, a2, a3, a4 = 70, 35, 62.3, 56
    low, high = (math.degrees(math.acos((a3**2 + a4**2 - s**2) / (2 * a3 * a4))) for s in (a1 - a2, a1 + a2))
    laid = Laid(FOUR_BAR)
    assert laid.stands("transmission mu_1") == pytest.approx(min(low, 180 - high), abs=1e-9)
    assert laid.stands("transmission mu_1", 4) == f"{low:.1f}° … {high:.1f}°: poor, below 40°"
    ends = [math.acos((a1**2 + r**2 - a4**2) / (2 * a1 * r)) for r in (a3 - a2, a3 + a2)]
    b0 = [math.atan2(r * math.sin(e), r * math.cos(e) - a1) for r, e in zip((a3 - a2, a3 + a2), ends, strict=True)]
    fine = Laid(FOUR_BAR.replace("step = 15", "step = 3"))
    assert fine.stands("swing theta14") == pytest.approx(math.degrees(b0[0] - b0[1]), abs=2e-3)
    assert fine.stands("ratio theta14") == pytest.approx(_ratio(math.pi + ends[0] - ends[1]), abs=2e-3)


def _ratio(way):
    way %= math.tau
    return max(way, math.tau - way) / min(way, math.tau - way)


@pytest.mark.parametrize("offset", [0, 20, 60])
def test_slider_crank(offset):
    """Stroke sqrt((l + r)^2 - e^2) - sqrt((l - r)^2 - e^2), time ratio from the two dead centres."""
    r, rod = 50, 250
    text = template_text("slider-crank")
    laid = Laid(text.replace("step = 15", "step = 5"), overrides={"a1": str(offset)})
    far, near = (math.sqrt((rod + sign * r) ** 2 - offset**2) for sign in (1, -1))
    assert laid.stands("stroke s14") == pytest.approx(far - near, abs=3e-4)
    way = math.pi + math.asin(offset / (rod - r)) - math.asin(offset / (rod + r))
    assert laid.stands("ratio s14") == pytest.approx(_ratio(way), abs=3e-4)
    worst = 90 - math.degrees(math.asin((r + offset) / rod))
    assert laid.stands("transmission psi") == pytest.approx(worst, abs=1e-9)
    assert laid.stands("transmission psi", 4).endswith(": good transmission")


def test_quick_return():
    """The slotted lever's template was made for a time ratio of 2; the lever swings by 60 degrees."""
    laid = Laid(template_text("slotted-lever").replace("step = 5", "step = 1"))
    assert laid.stands("ratio s15") == pytest.approx(2, abs=1e-3)
    assert laid.stands("swing theta13") == pytest.approx(60, abs=1e-5)
    assert laid.stands("swing theta13", 4) == "rocker: swings by this much"


def test_less_than_a_turn():
    """Without a whole turn there is no time ratio, and a link that is in no loop with the driver only turns."""
    laid = Laid(template_text("chebyshev"))
    assert laid.stands("ratio theta14") == ""
    assert laid.stands("ratio theta14", 4) == "time ratio: needs a sweep of a whole turn"
    assert Laid(template_text("cylinder-boom")).stands("swing theta12", 4) == "turns by this much in the sweep"


def test_link_that_turns_on():
    assert Laid(template_text("oldham")).stands("swing theta14", 4) == "crank: turns fully"
    assert Laid(template_text("watt-ii")).stands("swing theta16", 4) == "rocker: swings by this much"
