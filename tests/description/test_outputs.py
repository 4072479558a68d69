"""Outputs that read other outputs, and those that are one quantity alone."""

import runpy

import numpy as np
import pytest

import mechsheet
from mechsheet.diagnostics import DescriptionError

FOUR_BAR = """format = 1
[mechanism]
name = "four-bar"
[dimensions]
a1 = 70
a2 = 35
a3 = 62.3
a4 = 56
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0] }
mass = 1
center = [30, 5]
inertia = 0.001
[links.rocker]
points = { B0 = [0, 0], B = ["a4", 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 15
speed = "60 rpm"
[assembly]
B = [50, 55]
"""


def with_outputs(lines, rest=""):
    return mechsheet.loads(f"{FOUR_BAR}\n[outputs]\n{lines}\n{rest}")


@pytest.fixture(scope="module")
def linkage():
    return with_outputs(
        """
slope = "sin(mu)*half"
half = "height/2"
height = "B.y"
mu = { formula = "theta14 - theta13", unit = "deg" }
share = { formula = "swing/mu_max", unit = "1" }
more = { formula = "2*share + 1", unit = "1" }
""",
        """
[summary]
swing = { of = "theta14", take = "range" }
mu_max = { of = "mu", take = "max" }
""",
    )


def test_each_is_computed_from_the_others(linkage):
    motion = linkage.solve()
    assert motion["half"] == pytest.approx(motion["B.y"] / 2)
    assert motion["slope"] == pytest.approx(np.sin(np.radians(motion["mu"])) * motion["B.y"] / 2)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_the_workbook_has_them_in_the_order_in_which_they_need_one_another(linkage, layout, tmp_path):
    (built,) = linkage.build(tmp_path, formats="xlsx", layout=layout)
    assert mechsheet.check(built).agrees
    numbers = mechsheet.recalc(built).named()
    share = numbers["swing"] / numbers["mu_max"]
    assert numbers["more"] == pytest.approx(2 * share + 1)


def test_in_the_notes_each_stands_as_it_was_written(linkage):
    assert {output.symbol: output.written for output in linkage.outputs}["half"] == "height/2"
    assert {output.symbol: output.written for output in linkage.motion_outputs}["more"] == "2*share + 1"


def test_one_quantity_alone_has_its_own_unit():
    names = {
        "a": ("theta13", "°"),
        "b": ("B.x", "mm"),
        "c": ("B.v", "mm/s"),
        "d": ("B.ay", "mm/s²"),
        "e": ("omega13", "rad/s"),
        "f": ("alpha14", "rad/s²"),
        "g": ("F34", "N"),
        "h": ("T12", "N m"),
        "i": ("power", "W"),
        "j": ("shaking.m", "N m"),
    }
    motion = with_outputs("\n".join(f'{name}_out = "{of}"' for name, (of, _) in names.items())).solve()
    assert {name: motion.units[f"{name}_out"] for name in names} == {name: unit for name, (_, unit) in names.items()}
    assert motion["a_out"] == pytest.approx(motion["theta13"])


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ('mu = "theta14 - theta13"', 'write unit = "deg" beside the formula'),
        ('p = "q"\nq = "p + 1"', '"p" and "q" depend on one another in a circle'),
        ('p = "2*p"', '"p" depends on itself'),
        ('p = "B.x"\nq = "2*r"', "allowed: "),
        ('[summary]\nworst = { of = "B.x", take = "largest" }', 'did you mean "max"?'),
        ('[summary]\nstroke = { of = "B.x", take = "Stroke" }', 'did you mean "range"?'),
        ('[summary]\nworst = { of = "B.x", take = "minn" }', 'did you mean "min"?'),
    ],
)
def test_what_cannot_be(lines, message):
    with pytest.raises(DescriptionError) as caught:
        with_outputs(lines)
    assert message in str(caught.value)


def test_a_rate_in_an_output_is_one_in_what_reads_it():
    table = '[[tables]]\nrows = "theta12"\ncolumns = { a2 = [30, 35] }\nvalue = "twice"'
    with pytest.raises(DescriptionError, match="two-way tables have positions only"):
        with_outputs('fast = "B.v"\ntwice = "2*fast"', table)


def test_programs_have_them_too(linkage, tmp_path):
    (written,) = mechsheet.export(linkage, "python", tmp_path / "four_bar.py")
    values = runpy.run_path(str(written))["solve"]()
    assert values["slope"] == pytest.approx(linkage.solve()["slope"])
