"""A study of cams says what the workbook says: also where pieces of the motion meet, which follows what varies."""

import re

import numpy as np
import pytest
from laid import Laid

import random_cams
from mechsheet.description import loads
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs
from studying import in_workbook

STUDY = """
[dimensions]
first = { value = 40, unit = "deg" }
[summary]
sharpest = { of = "SHARP", take = "WAY" }
steepest = { of = "alpha", take = "max" }
hardest = { of = "s.dd", take = "min" }
[study]
vary = { first = { values = [20, 37.5, 70] } }
"""


@pytest.mark.slow
@pytest.mark.cases(2)
@pytest.mark.parametrize("laws", [("parabolic",), ("modified sine", "3-4-5"), ("modified trapezoid", "harmonic")])
@pytest.mark.parametrize(("kind", "sharp", "way"), [("slide", "kappa", "max"), ("flat slide", "rho", "min")])
def test_summaries_are_those_of_the_workbook(kind, sharp, way, laws):
    head, _, tail = random_cams.cam(7, kind, laws).partition("over = ")
    study = STUDY.replace("SHARP", sharp).replace("WAY", way)
    mechanism = loads(f'{head}over = "first"\n{tail.partition(chr(10))[2]}{study}')
    designs = Designs(mechanism)
    found = kept_of(designs, 0, designs.sampling.total)
    assert len(found.numbers) == 3
    for number, first in enumerate(found.columns["first"]):
        book = in_workbook(mechanism, {"first": float(first)}, designs.modes)
        for name in ("sharpest", "steepest", "hardest"):
            assert found.columns[name][number] == pytest.approx(book[name], rel=1e-11, abs=1e-11), (name, first)
    assert np.all(np.isfinite(found.columns["sharpest"]))


@pytest.mark.slow
def test_designs_that_a_cam_cannot_have_are_none():
    """Where the workbook asks to look at a cell, no row of the study claims a position."""
    text = f"""{random_cams.cam(7, "flat slide", ("3-4-5",))}
    [dimensions]
    base = 20
    first = {{ value = 40, unit = "deg" }}
    [summary]
    highest = {{ of = "s", take = "max" }}
    [study]
    vary = {{ base = {{ values = [-5, 0, 20] }}, first = {{ values = [-30, 0, 40, 400] }} }}
    """
    text = re.sub(r"over = \S+", 'over = "first"', text, count=1)
    text = re.sub(r"base_radius = \S+", 'base_radius = "base"', text)
    designs = Designs(loads(text))
    found = kept_of(designs, 0, designs.sampling.total)
    there = np.isfinite(found.columns["highest"])
    assert list(zip(found.columns["base"][there], np.round(found.columns["first"][there]), strict=True)) == [(20, 40)]
    laid = Laid(text)
    for base, first, fine in zip(found.columns["base"], found.columns["first"], there, strict=True):
        assert (laid.change(base=base, first=first).spot("inputs") == 0) == fine
