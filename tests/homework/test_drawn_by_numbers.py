"""The picture of a student's numbers beside the right one: links that do not meet are seen, and the numbers are told."""

import math
import re

import numpy as np
import pytest

import mechsheet
from homework.handmade import STEPS, Table, four_bar
from homework.shaper import shaped
from mechsheet import reference
from mechsheet.homework.drawn_by_numbers import pictures

GIVEN = (("a1", "a1", 70.0), ("a2", "a2", 35.0), ("a3", "a3", 62.3), ("a4", "a4", 56.0))


def audited(tmp_path, **slips):
    path = Table(GIVEN, four_bar(**slips)).save(tmp_path / "mine.xlsx")
    return mechsheet.audit(path, mechsheet.template("four-bar"))


@pytest.fixture(scope="module")
def turned(tmp_path_factory):
    """The coupler's angle has 0.2 rad too much, and the rocker's follows from where its end then is."""
    return audited(tmp_path_factory.mktemp("turned"), t13="{b}+{g}+0.2")


def test_the_links_are_laid_by_the_sheets_own_angles(turned):
    found = turned.picture
    assert found.numbers["theta13"][0] - found.numbers["theta13"][1] == pytest.approx(0.2)
    a, b = (np.array(found.theirs["coupler"][point]) for point in "AB")
    assert math.atan2(*(b - a)[::-1]) == pytest.approx(math.remainder(found.numbers["theta13"][0], math.tau))
    rocker = np.array(found.theirs["rocker"]["B"]) - found.theirs["rocker"]["B0"]
    assert math.atan2(*rocker[::-1]) == pytest.approx(math.remainder(found.numbers["theta14"][0], math.tau))
    for point in ("A0", "A"):
        assert found.theirs["crank"][point] == pytest.approx(found.right["crank"][point])
    assert np.hypot(*(b - found.theirs["rocker"]["B"])) > 1


def test_the_right_picture_is_the_references(turned):
    found = turned.picture
    truth = reference.solve(found.mechanism, values=np.array([found.at]))
    for links in found.right.values():
        for point, place in links.items():
            assert place == pytest.approx(tuple(truth.points[point][0]), abs=1e-6)


def test_the_page_shows_both_and_tells_the_numbers(turned):
    text = pictures(turned.picture, "tr")
    mine, right = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
    assert mine.count('stroke="#C0202B"') == 2  # the pin B, at the coupler and at the rocker
    assert "#C0202B" not in right
    assert "sizin sayılarınızla" in text
    number = turned.picture.numbers["theta13"]
    assert f"θ₁₃: sayfanızda {math.degrees(number[0]):.5g}" in text.replace("−", "-")


def test_what_is_right_has_no_picture(tmp_path):
    assert audited(tmp_path).picture is None


def test_a_ram_put_together_the_other_way_is_drawn_where_the_sheet_has_it(tmp_path):
    """The lever, which both assemblies have in common, is right; both pictures were those of the student's assembly."""
    found = shaped(tmp_path, s="{xB}+SQRT({c}^2-({h}-{yB})^2)")
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == {
        "theta13": "right",
        "s": "other assembly",
        "reach": "other assembly",
    }
    theirs, right = found.picture.numbers["s"]
    assert theirs - right > 200
    assert found.picture.theirs["ram"]["C"] == pytest.approx((theirs, 520))
    assert found.picture.right["ram"]["C"] == pytest.approx((right, 520))
    assert found.picture.theirs["rod"]["C"] == pytest.approx((right, 520))
    assert found.picture.theirs["lever"]["B"] == pytest.approx(found.picture.right["lever"]["B"])


@pytest.mark.slow
def test_what_is_wrong_and_no_place_has_no_picture(tmp_path):
    """Two pictures that were the same told nothing."""
    found = shaped(tmp_path, reach="SQRT({s}^2-{h}^2/9)")
    assert found.asked["reach"].verdict == "wrong"
    assert found.picture is None


@pytest.mark.ci
def test_a_wrong_length_is_told_in_the_unit_of_the_dimensions(tmp_path):
    """s, too large by far, was told as if it were meant in another unit: 3.0758 mm for 307.58."""
    found = shaped(tmp_path, s="{xB}+40*SQRT({c}^2-({h}-{yB})^2)", reach="SQRT(40^2+{xB}^2)")
    row = STEPS.index(round(math.degrees(found.picture.at)))
    r, d, b, c, h = 90, 300, 550, 120, 520
    lean = math.atan2(r * math.cos(math.radians(STEPS[row])), d + r * math.sin(math.radians(STEPS[row])))
    own = b * math.sin(lean) + 40 * math.sqrt(c**2 - (h - b * math.cos(lean)) ** 2)
    assert found.picture.numbers["s"][0] == pytest.approx(own)
