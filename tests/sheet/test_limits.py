"""Limits, dead centres and extremes found by cells: against closed forms, and live when a dimension changes."""

import math

import numpy as np
import pytest
from laid import TEMPLATES, Laid, template_text

from chosen import part, some
from mechsheet.description import loads
from mechsheet.reference import solve as refer
from mechsheet.reference import variables
from random_mechanisms import Grower

FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]


def limits(laid):
    """(driver's value, "ends at" or "begins at") of every limit that is shown."""
    numbers = [n for n in range(1, 5) if f"#limit {n}" in laid.plan.at.spots]
    found = [(laid.spot(f"#limit {n}"), laid.spot(f"#limit way {n}")) for n in numbers]
    return [pair for pair in found if pair[0] != "–"]


def by_cosines(a1, a2, reach):
    """Where the crank's pin is `reach` away from the other fixed pivot [deg]."""
    return math.degrees(math.acos((a1**2 + a2**2 - reach**2) / (2 * a1 * a2)))


@pytest.mark.parametrize("a1", [90, 100, 110, 130, 150])
def test_limits_of_a_rocker(a1):
    """Typed into one workbook: |A B0| <= a3 + a4 = 118.3; from a1 = 153.3 on it closes nowhere."""
    laid = Laid(FOUR_BAR).change(a1=a1)
    limit = by_cosines(a1, 35, 118.3)
    (first, ends), (second, begins) = limits(laid)
    assert (ends, begins) == ("ends at", "begins at")
    assert first == pytest.approx(limit, abs=2e-9)
    assert second == pytest.approx(360 - limit, abs=2e-9)
    assert laid.spot("#input to") == pytest.approx(limit, abs=1e-11)
    assert laid.spot("#input from") == pytest.approx(-limit, abs=1e-11)
    assert laid.stands("limits") == 2
    assert laid.stands("input") == pytest.approx(2 * limit, abs=1e-10)
    assert laid.stands("limits", 4) == f"ends at {round(limit, 3):.15g}°, begins at {round(360 - limit, 3):.15g}°"


def test_two_ranges():
    """Neither stretched nor folded everywhere: two mirrored ranges, and four limits in a turn."""
    laid = Laid(template_text("drag-link"), overrides={"r1": "100", "r2": "60", "r3": "30", "r4": "80"})
    near, far = by_cosines(100, 60, 50), by_cosines(100, 60, 110)
    assert [value for value, _ in limits(laid)] == pytest.approx([near, far, 360 - far, 360 - near], abs=2e-9)
    assert [way for _, way in limits(laid)] == ["begins at", "ends at"] * 2
    assert laid.spot("#input ranges") == 2
    ends = sorted(laid.spot(f"#input {key}") for key in ("from", "to", "from other", "to other"))
    assert ends == pytest.approx([-far, -near, near, far], abs=1e-10)


def test_crank_without_limits_and_no_position_at_all():
    laid = Laid(FOUR_BAR)
    assert limits(laid) == []
    assert laid.stands("limits", 4) == "no limit position in the sweep"
    assert laid.stands("input", 4) == "the input can turn fully"
    laid.change(a1=500)
    assert limits(laid) == []
    assert laid.stands("input", 4) == "assembles nowhere"


def test_slider_crank_whose_rod_is_too_short():
    """|r sin(theta) - e| <= rod: the rod of 30 is shorter than the crank of 50."""
    laid = Laid(template_text("slider-crank"), overrides={"a2": "50", "a3": "30", "a1": "0"})
    limit = math.degrees(math.asin(30 / 50))
    wanted = [limit, 180 - limit, 180 + limit, 360 - limit]
    assert [value for value, _ in limits(laid)] == pytest.approx(wanted, abs=2e-9)
    assert laid.spot("#input to") == pytest.approx(limit, abs=1e-10)
    assert laid.spot("#input ranges") == 2


def test_driven_slide():
    """A cylinder's displacement: the triangle of the boom closes between the difference and the sum of two sides."""
    laid = Laid(template_text("cylinder-boom"))
    mechanism = laid.mechanism
    low, high = laid.spot("#input from"), laid.spot("#input to")
    for value, inside in ((high - 1e-3, True), (high + 1e-3, False), (low + 1e-3, True), (low - 1e-3, False)):
        assert bool(refer(mechanism, values=np.array([value])).exists[0]) == inside


@pytest.mark.parametrize("seed", part(range(24), 3))
def test_limits_of_later_groups(seed):
    """The reference exists on one side of every limit and not on the other."""
    text = Grower(7000 + seed, 2 + seed % 3).text(25, 15.0)
    laid = Laid(text)
    for value, way in limits(laid):
        around = np.radians(np.array([value - 1e-6, value + 1e-6]))
        exists = refer(laid.mechanism, values=np.concatenate([laid.plan.driver, around])).exists[-2:]
        assert list(exists) == ([True, False] if way == "ends at" else [False, True]), (seed, value)


def test_extremes_between_rows():
    """With steps of 15 degrees, better than 1e-9 of the size."""
    laid = Laid(FOUR_BAR)
    a1, a2, a3, a4 = 70, 35, 62.3, 56
    wanted = []
    for reach in (a3 + a2, a3 - a2):
        crank = math.acos((a1**2 + reach**2 - a4**2) / (2 * a1 * reach))
        rocker = math.degrees(math.atan2(reach * math.sin(crank), reach * math.cos(crank) - a1))
        wanted.append((rocker, math.degrees(crank) + (0 if reach > a3 else 180)))
    for take, (value, at) in zip(("min", "max"), wanted, strict=True):
        assert laid.spot(f"#{take} theta14") == pytest.approx(value, abs=1e-8)
        assert laid.spot(f"#{take} at theta14") == pytest.approx(at, abs=2e-5)


@pytest.mark.parametrize("offset", [0, 20, 60])
def test_stroke(offset):
    """sqrt((l + r)^2 - e^2) - sqrt((l - r)^2 - e^2)."""
    laid = Laid(template_text("slider-crank"), overrides={"a1": str(offset)})
    far, near = (math.sqrt((250 + sign * 50) ** 2 - offset**2) for sign in (1, -1))
    assert laid.stands("stroke s14") == pytest.approx(far - near, abs=1e-9)


def test_extreme_at_a_limit():
    """The rocker's last angle lies at the limit, where coupler and rocker are in line: by the law of cosines."""
    laid = Laid(FOUR_BAR, overrides={"a1": "100"})
    limit = math.radians(by_cosines(100, 35, 118.3))
    x, y = 35 * math.cos(limit) - 100, 35 * math.sin(limit)
    assert laid.spot("#max theta14") == pytest.approx(360 + math.degrees(math.atan2(-y, x)), abs=1e-6)
    assert laid.spot("#max at theta14") == pytest.approx(360 - math.degrees(limit), abs=1e-8)
    assert laid.spot("#max mu_1") == pytest.approx(math.pi, abs=1e-9)


@pytest.mark.parametrize("name", some(TEMPLATES, 1))
def test_extremes_of_fine_sweeps_agree(name):
    """Extremes found from the template's own steps are those of a sweep with a third of the step, to 1e-7 of the size."""
    text = template_text(name)
    mechanism = loads(text)
    driver = mechanism.driver
    if driver.values:
        return
    laid = Laid(text)
    keys = [key for key in laid.plan.at.spots if key.startswith(("#max ", "#min ")) and " at " not in key]
    fine = refer(mechanism, values=_finer(laid.plan.driver))
    found = variables(fine)
    for key in keys:
        symbol = key[5:]
        if symbol not in found or not np.isfinite(found[symbol]).any():
            continue
        values = np.degrees(found[symbol]) if laid.plan.at.shown[symbol].degrees else found[symbol]
        take = np.nanmax if key.startswith("#max") else np.nanmin
        size = max(1.0, float(np.nanmax(np.abs(values))))
        beyond = float(take(values)) - laid.spot(key)
        if laid.plan.at.shown[symbol].degrees:  # the reference may count another number of turns
            beyond -= 360 * round(beyond / 360)
        assert (beyond if key.startswith("#max") else -beyond) < 1e-7 * size, key  # no row lies beyond the extreme
        assert abs(beyond) < 5e-3 * size, key


def _finer(driver):
    driver = np.array(driver)
    return np.interp(np.linspace(0, len(driver) - 1, 9 * (len(driver) - 1) + 1), np.arange(len(driver)), driver)
