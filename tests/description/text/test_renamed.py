"""A point or a link with another name: everywhere in a description, and nowhere else."""

import numpy as np
import pytest

from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.description.text.rewrite import renamed
from mechsheet.description.text.source import parse

EVERYWHERE = """\
format = 1 # B is the coupler's point
[mechanism]
name = "mine"
title = "B and C"
[dimensions]
a2 = { value = 20, label = "crank A0A" }
a3 = { value = 50, label = "AB" }
B = 12
[links.ground]
points = { A0 = [0, 0], B0 = [60, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
mass = 1
center = "B"
[links.coupler.points]
A = [0, 0]
B = ["a3", 0]
C = { distances = { A = 30, B = 30 }, side = "left" }
[links.rocker]
points.B0 = [0, 0]
points."B" = [45, 0]
[driver]
link = "crank"
start = 0
stop = 360
step = 15
[[loads]]
link = "rocker"
point = "B"
force = ["-2*B.x", "B"]
[[loads]]
between = ["B", "A0"]
stiffness = 0.1
[assembly]
B = [60, 40]
[outputs]
high = { formula = "B.y + B", unit = "mm", label = "height of B" }
[summary]
top = { of = "B.y", take = "max" }
[[charts]]
paths = ["B", "C"]
[exercise]
asked = { "B.x" = 2 }
"""


def test_a_point_is_renamed_wherever_it_is_named_and_a_dimension_of_that_name_stays():
    text = renamed(parse(EVERYWHERE, "mine.toml"), "point", "B", "Pim").text
    loads(text)
    expected = EVERYWHERE
    for old, new in {
        'label = "AB"': 'label = "APim"',
        "height of B": "height of Pim",
        'center = "B"': 'center = "Pim"',
        'B = ["a3", 0]': 'Pim = ["a3", 0]',
        "A = 30, B = 30": "A = 30, Pim = 30",
        'points."B"': "points.Pim",
        'point = "B"': 'point = "Pim"',
        '"-2*B.x"': '"-2*Pim.x"',
        '["B", "A0"]': '["Pim", "A0"]',
        "B = [60, 40]": "Pim = [60, 40]",
        "B.y + B": "Pim.y + B",
        'of = "B.y"': 'of = "Pim.y"',
        'paths = ["B", "C"]': 'paths = ["Pim", "C"]',
        '"B.x" = 2': '"Pim.x" = 2',
    }.items():
        assert old in expected
        expected = expected.replace(old, new)
    assert text == expected


@pytest.mark.parametrize("name", ["four-bar", "desk-lamp", "excavator", "geared-five-bar", "cam-rocker", "rack-slider"])
def test_templates_move_as_before_when_a_link_and_a_point_are_called_otherwise(name):
    source = parse(template_text(name), name)
    link = list(source.data["links"])[-1]
    point = list(source.data["links"][link]["points"])[-1]
    text = renamed(renamed(source, "link", link, "uzuv-x"), "point", point, "Zz").text
    before, after = (Compiled(loads(each)).values for each in (source.text, text))
    np.testing.assert_array_equal(after["Zz.x"], before[f"{point}.x"])
