"""What the first sheet, or the page, says of a task: whether the mechanism that came out does what is asked.

Random tasks, held against the motion itself, are in `property/test_verdicts_of_tasks.py`.
"""

import re
from dataclasses import replace

import numpy as np
import pytest
from placed import places_of

from mechsheet.compiled import Compiled, compiled_of
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.library.verdicts import verdict
from mechsheet.sheet.page import top
from mechsheet.sheet.plan import MEANING

SLIDER = template_text("quick-return-slider")
APART = SLIDER.replace("lam = 3\n", "lam = 300\n", 1)
"""Its dead centres lie on different assemblies: there are lengths, but the stroke is shorter."""

WORDS = {"sheets": MEANING, "page": top.MEANING}
"""The column of the words in each layout."""


def line(text, layout="sheets"):
    """The number of things wrong, the words, and the line under the title."""
    compiled = Compiled(loads(text + f'[workbook]\nlayout = "{layout}"\n'))
    spot = places_of(compiled.plan)["task"]
    return compiled.value(spot), compiled.value(replace(spot, col=WORDS[layout])), verdict(compiled)


@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("further", ["", "round = 0.5\n"])
def test_a_stroke_that_is_not_the_one_asked_for(layout, further):
    number, words, title = line(APART.replace("[synthesis]\n", f"[synthesis]\n{further}"), layout)
    assert number > 0
    assert words.startswith("misses what is asked by up to ")
    assert title.startswith(f"{words}; closes in all 37 positions")


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_rounding_is_a_doubt(layout):
    assert line(SLIDER, layout)[:2] == (0.0, "does exactly what is asked")
    number, words, title = line(SLIDER.replace("[synthesis]\n", "[synthesis]\nround = 0.5\n"), layout)
    assert number == 0
    assert re.fullmatch(r"misses what is asked by up to 0\.\d+", words)
    assert title.startswith("closes in all")
    assert title.endswith(words)


@pytest.mark.slow
def test_poses_are_missed_by_rounding_alone():
    """The lengths before rounding are compared with themselves, not with the rounded ones."""
    number, words, _ = line(template_text("rigid-body-guidance").replace("[synthesis]\n", "[synthesis]\nround = 0.5\n"))
    assert number == 0
    assert words.startswith("misses what is asked by up to 0.1")


@pytest.mark.slow
def test_a_number_in_the_place_of_a_result():
    """The mechanism has it, so it is what is judged."""
    text = template_text("function-generator").replace('a2 = { synthesis = "a2"', "a2 = { value = 12")
    number, words, _ = line(text)
    assert number == 1
    assert words == "misses what is asked by up to 1.5187°"


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["function-generator", "crank-rocker-swing", "rigid-body-guidance"])
def test_a_task_and_the_assembly_that_the_mechanism_has(name):
    """Whichever link is described first; and the other assembly, which a sketch may mean, is not what is asked."""
    text = template_text(name)
    _, *links = re.findall(r"^\[links\.\w+\]\n(?:(?!\[).*\n)+", text, re.MULTILINE)
    whole = compiled_of(loads(text))
    turned = text.replace("".join(links), "".join(reversed(links)))
    assert line(turned) == line(text)
    a, b, b0 = (complex(*(np.ravel(whole.values[f"{point}.{axis}"])[0] for axis in "xy")) for point in ("A", "B", "B0"))
    along = (a - b0) / abs(a - b0)
    other = b0 + along * ((b - b0) / along).conjugate()
    for sketch, begins in ((b, "closes in all"), (other, "misses what|the mechanism is of the other assembly")):
        drawn = text.replace('mode_1 = { synthesis = "mode" }', f"B = [{sketch.real}, {sketch.imag}]")
        assert re.match(begins, line(drawn)[2])
