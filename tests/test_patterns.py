"""The patterns of the manual: short, whole, right, and each with its picture."""

import math
import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import mechsheet

PAGE = (Path(__file__).parent.parent / "docs" / "patterns.md").read_text(encoding="utf-8")
SECTION = re.compile(
    r"^## (?P<title>.*?)$.*?pictures/pattern-(?P<picture>[\w-]+)\.png.*?```toml\n(?P<text>.*?)```", re.M | re.S
)
PATTERNS = [pytest.param(found["picture"], found["text"], id=found["title"]) for found in SECTION.finditer(PAGE)]
LONGEST = 12
"""Lines: what is longer is a template."""


def test_the_page_has_a_picture_and_a_description_under_each_heading():
    assert len(PATTERNS) == PAGE.count("\n## ") == PAGE.count("```toml") >= 8


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("picture", "text"), PATTERNS)
def test_each_is_short_and_builds_a_workbook_that_agrees(picture, text, tmp_path):
    assert len(text.splitlines()) <= LONGEST
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # nobody wants to copy a doubtful sketch
        linkage = mechsheet.loads(text)
        assert linkage.name == picture
        assert linkage.solve().exists.all()
        (built,) = linkage.build(tmp_path, formats="xlsx")
    assert mechsheet.check(built).agrees


def pattern(picture):
    return next(mechsheet.loads(each.values[1]) for each in PATTERNS if each.values[0] == picture)


def test_the_arm_of_the_spring_stays_where_it_is_put():
    motion = pattern("spring").solve()
    assert abs(motion["torque"]).max() < 0.01 * 1.2 * 9.81 * 0.35


def test_the_shaper_cuts_one_way_only():
    """The work of a turn is that of the cut over the stroke, 2000 N over 240 mm, and what the damper takes."""
    motion = pattern("shaper").solve()
    cutting = motion["s.v"] < 0
    assert 0.5 < cutting.mean() < 0.75  # slowly to the left, quickly back
    angle, rate = np.radians(motion["theta12"]), motion["s.v"]
    power = np.where(cutting, -2.0 * rate, 0.0) + 0.4e-3 * rate**2  # W
    assert np.trapezoid(motion["T12"], angle) == pytest.approx(np.trapezoid(power, angle) / math.tau, rel=0.01)
    assert np.ptp(motion["s"]) * 2.0 == pytest.approx(480, rel=0.01)


def test_the_tie_rod_follows_and_the_worst_error_is_its_largest_size():
    steering = pattern("steering")
    motion = steering.solve()
    assert motion["error"][motion["theta12"] == 0] == pytest.approx(0, abs=1e-9)
    assert motion["error"].max() == pytest.approx(1.54, abs=0.005)  # as the page says
    assert motion["error"].min() == pytest.approx(-3.04, abs=0.005)
    assert motion.summary["worst"] == pytest.approx(abs(motion["error"]).max())
