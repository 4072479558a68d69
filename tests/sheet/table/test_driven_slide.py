"""A driven slide that is itself a side of the first group: a cylinder whose line goes through both of its pins, and its kin.

Building such a mechanism stopped with a traceback: its dead centres asked for the driver as if it were a constant.
"""

import math
from pathlib import Path

import pytest
from laid import Laid

import mechsheet
from chosen import ALL, part
from livesheet.formula.nodes import Number
from mechsheet.exporting import KINDS

CASES = Path(__file__).parents[2] / "cases/reference"
FAR = math.hypot(3, 2)
BOOM = 4.0
"""From the boom's pin to the barrel's, and to the rod's."""

REACH = {
    "cylinder": (BOOM - FAR, BOOM + FAR),
    "driven-pin-slot": (BOOM - FAR, BOOM + FAR),
    "eccentric-cylinder": (-math.sqrt((BOOM + FAR) ** 2 - 0.5**2), math.sqrt((BOOM + FAR) ** 2 - 0.5**2)),
    "telescope": (3.0, math.inf),
}
"""From where to where each slide can go. The eccentric one lies beside the pin, so that it gets through; the telescope is
3 long at its shortest, where it stands at right angles to the guide."""


def text_of(name):
    return (CASES / f"{name}.toml").read_text(encoding="utf-8")


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", REACH)
def test_range_of_the_slide(name):
    """What the first sheet says: the sweep, cut off where the slide can go no further; and of a sweep carried on in
    the cells."""
    laid = Laid(text_of(name))
    low, high = REACH[name]
    start, step = laid.spot("start"), laid.spot("step")
    first, last = sorted((start, start + (laid.plan.rows - 1) * step))
    found = sorted((laid.spot("input_from"), laid.spot("input_to")))
    assert found == pytest.approx([max(low, first), min(high, last)], abs=1e-6)
    assert all(laid.exists) == (low <= first and last <= high)
    if math.isfinite(high):
        laid.change(_start=high - 1.0, _step=2.0 / (laid.plan.rows - 1))
        assert 0 < sum(laid.exists) < laid.plan.rows
        assert laid.spot("input_to") == pytest.approx(high, abs=1e-6)
        assert laid.spot("limit_1") == pytest.approx(high, abs=1e-6)


@pytest.mark.slow
def test_no_row_where_the_slide_is_no_length():
    """Typed to begin at -1: as long as the cylinder is 0 or shorter there is no position, and no number of the boom."""
    laid = Laid(text_of("cylinder")).change(_start=-1.0)
    slide, boom = laid.column("s23"), laid.column("theta14")
    assert min(slide) < 0 < max(slide)
    assert [isinstance(angle, float) for angle in boom] == laid.exists
    assert not any(there for there, length in zip(laid.exists, slide, strict=True) if length <= 0)


@pytest.mark.slow
def test_boom_by_the_law_of_cosines():
    """theta14 = -atan(2/3) + acos((4^2 + 13 - s^2) / (2 * 4 * sqrt(13)))"""
    laid = Laid(text_of("cylinder"))
    shown = laid.column("theta14")
    for row in range(7):
        length = 3 + 0.5 * row
        angle = math.acos((BOOM**2 + FAR**2 - length**2) / (2 * BOOM * FAR)) - math.atan2(2, 3)
        assert shown[row] == pytest.approx(math.degrees(angle), abs=1e-11)


def test_start_must_be_a_length():
    """A cylinder's length is a side of a triangle: a start of -3 is refused when it is typed, not shown as a gap."""
    laid = Laid(text_of("cylinder"))
    row = laid.plan.blocks["sweep"].rows["start"]
    (rule,) = [rule for rule in laid.workbook.sheets[0].validations if rule.area.first_row == row]
    assert (rule.operator, rule.low) == (">", Number(0.0))
    assert "s₂₃" in rule.error_message


@pytest.mark.slow
@pytest.mark.parametrize(("name", "language"), part([("cylinder", "tr"), *((name, "en") for name in REACH)], of=5))
def test_files_agree(name, language, tmp_path):
    for path in mechsheet.build(mechsheet.loads(text_of(name), language=language), tmp_path, ("xlsx", "ods")):
        report = mechsheet.check(path)
        assert report.agrees, report


@pytest.mark.parametrize("to", list(KINDS) if ALL else ["python", "csv"])
def test_exports(to, tmp_path):
    mechanism = mechsheet.loads(text_of("cylinder"))
    (path,) = mechsheet.export(mechanism, to, tmp_path / f"cylinder{KINDS[to].suffix}")
    assert path.stat().st_size > 500


@pytest.mark.slow
def test_plot(tmp_path):
    mechsheet.plot(mechsheet.loads(text_of("cylinder")), tmp_path / "cylinder.svg")
    assert (tmp_path / "cylinder.svg").stat().st_size > 1000
