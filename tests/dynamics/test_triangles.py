"""Joint forces of links that move with a driven pair: triangles of a cylinder and two arms, one on the other."""

import numpy as np
import pytest
from test_reactions import solved, weighed, worst_of

from chosen import ALL
from folders import TEMPLATE_FILES
from mechsheet.diagnostics import MechsheetError
from within_cases import loader


def template(name):
    return next(path for path in TEMPLATE_FILES if path.stem == name).read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["scissor-lift-between-arms", "stephenson-ii-motor"])
def test_templates_against_all_reactions_at_once(name):
    for seed, static in ((1, False), (2, True)) if ALL else ((1, False),):
        worst, count = worst_of(weighed(template(name), seed, static))
        assert count > 10
        assert worst < 1e-11


@pytest.mark.ci
def test_random_cylinders_between_links_that_move():
    rng, judged = np.random.default_rng(18), 0
    for seed in range(12 if ALL else 5):
        text = weighed(loader(rng), seed)
        try:
            worst, _ = worst_of(text)
        except MechsheetError:  # lengths that do not fit
            continue
        assert worst < 1e-10, seed
        judged += 1
    assert judged > 2


def test_the_cylinder_of_the_lift_pushes_the_load_as_many_times_as_its_height_grows():
    _, _, _, values = solved(template("scissor-lift-between-arms"))
    assert values["F45.t"] == pytest.approx(5000 * values["gain"], rel=1e-11)
    # what stands on the frame: the pin, and the slot at a distance s13
    assert values["F12.y"] + values["F13.n"] == pytest.approx(5000, rel=1e-11)


@pytest.mark.slow
def test_two_triangles_on_one_cylinder():
    """Three links at each end of it, all of them inside what moves as a whole: the lower slot is on the second triangle."""
    text = template("scissor-lift-between-arms")
    links = "[links.m]\npoints = { K = [0, 0], M = [300, 0] }\n[links.n]\npoints = { D = [0, 0], M = [450, 0] }\n"
    text = text.replace("[[joints]]", f"{links}[[joints]]", 1).replace("R = [980, 0]", "M = [1000, 0]")
    worst, _ = worst_of(weighed(text.replace('point = "R"', 'point = "M"'), 1))
    assert worst < 1e-11


def test_a_cylinder_at_the_pin_of_an_arm_on_the_frame_is_refused_in_words():
    text = template("scissor-lift-between-arms").replace(', K = ["L/2 + u", 0]', "")
    text = text.replace("points = { K = [0, 0] }", "points = { O = [0, 0] }").replace('point = "K"', 'point = "O"')
    text = text.replace("K = [900, 190]\n", "").replace("value = 290", "value = 500")
    with pytest.raises(MechsheetError, match="at O a driven pair, a link that moves with it and a third"):
        solved(text)
