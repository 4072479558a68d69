"""What the first sheet says in words: types of four-bar loops typed into one workbook, ratios and transmission angles by
closed forms. What holds of any mechanism: test_claims.py."""

import math
import re
import tomllib

import pytest
from laid import Laid

from folders import ROOT
from livesheet.formula.nodes import ErrorValue
from mechsheet.description.templates import template_text
from mechsheet.sheet.plan import LEGEND_ROW, MEANING

NA = ErrorValue("#N/A")
CASES = tomllib.loads((ROOT / "tests/cases/stands.toml").read_text(encoding="utf-8"))
FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize("case", CASES["four-bar"], ids=lambda case: case["words"])
def test_types_of_four_bars(case):
    """Typed into the cells of one and the same workbook: the words are live."""
    a1, a2, a3, a4 = case["lengths"]
    laid = Laid(FOUR_BAR).change(a1=a1, a2=a2, a3=a3, a4=a4)
    assert laid.words("grashof_1") == case["words"]
    shortest, longest = min(case["lengths"]), max(case["lengths"])
    assert laid.spot("grashof_1") == pytest.approx(2 * (shortest + longest) - sum(case["lengths"]), abs=1e-12)
    assert laid.words("swing_theta14") == case["rocker"]


def test_an_emptied_length_leaves_no_type_and_no_number():
    laid = Laid(FOUR_BAR).change(a3=None)
    assert (laid.spot("grashof_1"), laid.words("grashof_1")) == (NA, "")


def test_transmission_angle():
    """cos(mu) = (a3^2 + a4^2 - s^2) / (2 a3 a4), with s between |a1 - a2| and a1 + a2."""
    a1, a2, a3, a4 = 70, 35, 62.3, 56
    low, high = (math.degrees(math.acos((a3**2 + a4**2 - s**2) / (2 * a3 * a4))) for s in (a1 - a2, a1 + a2))
    laid = Laid(FOUR_BAR)
    assert laid.spot("transmission_1") == pytest.approx(min(low, 180 - high), abs=1e-6)
    assert laid.spot("transmission_1_at") == pytest.approx(0 if low < 180 - high else 180, abs=1e-3)
    assert laid.words("transmission_1") == f"worst {low:.1f}° at 0° (below 40°: poor)"


def _ratio(way):
    way %= math.tau
    return max(way, math.tau - way) / min(way, math.tau - way)


@pytest.mark.slow
@pytest.mark.parametrize("offset", [0, 20, 60])
def test_slider_crank(offset):
    """Time ratio from the two dead centres, the rod's worst angle against the guide."""
    r, rod = 50, 250
    laid = Laid(template_text("slider-crank"), overrides={"a1": str(offset)})
    way = math.pi + math.asin(offset / (rod - r)) - math.asin(offset / (rod + r))
    assert laid.spot("time_ratio_s14") == pytest.approx(_ratio(way), abs=1e-4)
    worst = 90 - math.degrees(math.asin((r + offset) / rod))
    assert laid.spot("transmission_1") == pytest.approx(worst, abs=1e-6)
    assert laid.words("transmission_1").endswith(" (good)")


@pytest.mark.slow
def test_time_ratio_by_a_motion_law_is_one_of_times():
    """The crank starts and stops gently: between the dead centres it needs other times than at an even speed."""
    from scipy.optimize import brentq  # a second to load: only where it is needed

    r, rod, offset = 50, 250, 60
    text = re.sub(r"(?m)^(start|stop|step) *=.*\n", "", template_text("slider-crank"))
    law = 'start = 0\nstop = 360\nmotion = { law = "cycloidal", duration = 3, rows = 73 }'
    text = text.replace("[driver]", f"[driver]\n{law}")
    laid = Laid(text, overrides={"a1": str(offset)})
    places = [
        brentq(lambda t, way=way: t - math.sin(math.tau * t) / math.tau - way / math.tau, 0, 1)
        for way in (math.asin(offset / (rod + r)), math.pi + math.asin(offset / (rod - r)))
    ]
    assert laid.spot("time_ratio_s14") == pytest.approx(_ratio(math.tau * (places[1] - places[0])), rel=1e-3)
    assert laid.spot("time_ratio_s14") != pytest.approx(_ratio(math.pi + 0.1), rel=0.05)
    laid.change(stop=720.0)  # by this law its two turns are not alike
    assert laid.spot("time_ratio_s14") == NA
    part = text.replace("stop = 360", "stop = 90")
    assert not any(entry.startswith("time_ratio") for entry in Laid(part).plan.places.lines)


@pytest.mark.slow
def test_quick_return():
    """The slotted lever's template was made for a time ratio of 2; the lever swings by 60 degrees."""
    laid = Laid(template_text("slotted-lever"))
    assert laid.spot("time_ratio_s15") == pytest.approx(2, abs=1e-4)
    assert laid.spot("swing_theta13") == pytest.approx(60, abs=1e-5)
    assert laid.words("swing_theta13") == "rocker: swings by this much"


@pytest.mark.slow
def test_less_than_a_turn():
    """Without a whole turn there is no time ratio, and a rocker only turns by so much in this range."""
    laid = Laid(template_text("chebyshev"))
    assert laid.spot("time_ratio_theta14") == NA
    assert laid.words("time_ratio_theta14") == "time ratio of θ₁₄: needs a whole turn"
    assert laid.words("swing_theta14") == "turns by this much in this range"


@pytest.mark.slow
def test_link_that_turns_on():
    assert Laid(template_text("oldham")).words("swing_theta14") == "crank: turns fully"
    assert Laid(template_text("watt-ii")).words("swing_theta16") == "rocker: swings by this much"


@pytest.mark.slow
def test_what_stands_still_beside_a_driver_set_by_hand_is_not_judged():
    """The dipper's cylinder keeps its length while the bucket's moves: its angle of transmission would be called good."""
    laid = Laid(template_text("excavator"))
    lines = laid.plan.blocks["verdicts"].rows
    assert {"transmission_2", "transmission_3"} <= set(lines)
    assert not {"transmission_1", "swing_theta12", "swing_theta14"} & set(lines)
    assert "below 40°: poor" in laid.verdict


@pytest.mark.parametrize(
    ("language", "words"), [("en", "closes in its one position"), ("tr", "tek konumunda kapanıyor")]
)
def test_of_one_position_nothing_is_said_in_the_plural(language, words):
    driver = re.sub(r"start = 0\nstop = 360\nstep = 15", "values = [60]", FOUR_BAR)
    assert Laid(driver, language).verdict.startswith(words)


@pytest.mark.slow
def test_no_time_ratio_of_several_turns_of_gears():
    """Two turns of the driver are one of the wheel that moves the slide: a ratio of ways within one turn means nothing."""
    text = template_text("slider-crank").partition("[[charts]]")[0]
    text = text.replace(
        '[driver]\nlink = "crank"', '[links.pinion]\npoints = { A0 = [0, 0] }\n[driver]\nlink = "pinion"'
    )
    text = (
        text.replace("stop = 360", "stop = 720")
        + '[[joints]]\ntype = "gear"\nlink = "crank"\non = "pinion"\nratio = 0.5\n'
    )
    laid = Laid(text)
    assert laid.spot("time_ratio_s14") == NA
    assert laid.words("time_ratio_s14").endswith("needs a period of one turn")


@pytest.mark.slow
def test_values_that_go_to_and_fro_reach_from_the_least_to_the_largest():
    """Listed values may end where they began: the driver has moved all the same."""
    laid = Laid(re.sub(r"start = 0\nstop = 360\nstep = 15", "values = [90, 120, 60, 90]", FOUR_BAR))
    assert (laid.spot("input_from"), laid.spot("input_to")) == pytest.approx((60, 120))


def test_what_became_amber_or_red_is_named_under_the_line_with_its_cell():
    """Only the words are far below; red before amber, and beside each line its mark."""
    laid = Laid(FOUR_BAR)
    rows = laid.plan.blocks["verdicts"].rows

    def pointed():
        return laid.values.get(laid.plan.main, LEGEND_ROW, MEANING).partition(" · ")[0]

    def mark(key):
        return laid.values.get(laid.plan.main, rows[key], MEANING + 1)

    assert (pointed(), mark("transmission_1")) == (f"▲ μ1 (B): E{rows['transmission_1'] + 1}", "▲")
    laid.change(a2=90.0)
    assert (pointed(), mark("rows_closed")) == (f"▲ closes: E{rows['rows_closed'] + 1}", "▲")
    laid.change(a2=-1.0)
    assert (pointed(), mark("inputs")) == (f"● yellow cells: E{rows['inputs'] + 1}", "●")
    laid.change(a1=100.0, a2=30.0, a3=90.0, a4=80.0)
    assert laid.values.get(laid.plan.main, LEGEND_ROW, MEANING) == laid.plan.text("legend.missing")


@pytest.mark.slow
@pytest.mark.parametrize(("phi", "lam"), [(190, 3), (170, 2.5)])
def test_the_driver_turns_by_phi_during_the_slow_way(phi, lam):
    """A crank-rocker that a task finds for so many degrees between its dead centres has these between them."""
    laid = Laid(template_text("crank-rocker-swing"), overrides={"phi": str(phi), "lam": str(lam)})
    assert laid.spot("slow_way_theta14") == pytest.approx(max(phi, 360 - phi), abs=1e-3)


@pytest.mark.slow
def test_a_motion_law_turns_the_driver_otherwise_than_time_goes_by():
    text = re.sub(r"(?m)^(start|stop|step) *=.*\n", "", template_text("slider-crank"))
    law = 'start = 0\nstop = 360\nmotion = { law = "cycloidal", duration = 3, rows = 73 }'
    lines = Laid(text.replace("[driver]", f"[driver]\n{law}")).plan.places.lines
    assert "time_ratio_s14" in lines and "slow_way_s14" not in lines
