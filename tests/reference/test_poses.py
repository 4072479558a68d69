"""Positions near known ones, with other dimensions: those that a solution from the start finds."""

import numpy as np
import pytest

from folders import TEMPLATES
from mechsheet import reference
from mechsheet.description import load


@pytest.mark.parametrize(
    ("name", "changes"),
    [("four-bar", {"a3": 62.8}), ("slider-crank", {"a1": 21.0, "a3": 249.0}), ("cylinder-boom", {"x0": -10.0})],
)
def test_the_same_as_from_the_start(name, changes):
    mechanism = load(TEMPLATES / f"{name}.toml")
    solution = reference.solve(mechanism)
    changes = {key: value if key != "x0" else solution.dimensions[key] + 3.0 for key, value in changes.items()}
    near, afresh = reference.nearby(solution, changes), reference.solve(mechanism, changes)
    assert near.exists.all()
    theirs = reference.variables(afresh)
    for symbol, column in reference.variables(near).items():
        assert np.allclose(column, theirs[symbol], rtol=0, atol=1e-9), symbol


def test_a_row_that_cannot_be_closed_does_not_exist():
    """A crank of 50 does not go round in the text's four-bar: three rows of 25 come apart."""
    solution = reference.solve(load(TEMPLATES / "four-bar.toml"))
    near = reference.nearby(solution, {"a2": 50.0})
    assert list(np.flatnonzero(~near.exists)) == [11, 12, 13]
    assert np.isnan(near.poses["rocker"][12]).all()
