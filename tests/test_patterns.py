"""The patterns of the manual: short, whole, right, and each with its picture."""

import re
import warnings
from pathlib import Path

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


def test_the_arm_of_the_spring_stays_where_it_is_put():
    (spring,) = [each.values[1] for each in PATTERNS if each.values[0] == "spring"]
    motion = mechsheet.loads(spring).solve()
    assert abs(motion["torque"]).max() < 0.01 * 1.2 * 9.81 * 0.35
