"""What is given row by row, and between the rows."""

import tomllib

import numpy as np
import pytest

from chosen import some
from mechsheet.description import loads
from mechsheet.description.templates import template_names, template_text
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_between, given_values, place_of

STEPPED = [name for name in template_names() if "values" not in tomllib.loads(template_text(name))["driver"]]


@pytest.mark.parametrize("name", some(STEPPED, 12))
def test_at_the_rows_it_is_what_the_rows_have(name):
    mechanism = loads(template_text(name))
    dimensions = dimension_values(mechanism)
    given = given_values(mechanism, dimensions)
    rows = np.arange(1.0, len(given[mechanism.driver.symbol]) + 1)
    there = given_between(mechanism, dimensions, given, rows)
    assert there.keys() == given.keys()
    for symbol, column in given.items():
        assert there[symbol] == pytest.approx(column, rel=1e-12, abs=1e-12), symbol
    between = given_between(mechanism, dimensions, given, rows[:-1] + 0.5)[mechanism.driver.symbol]
    low, high = np.sort([given[mechanism.driver.symbol][:-1], given[mechanism.driver.symbol][1:]], axis=0)
    if mechanism.driver.law is None:
        assert between == pytest.approx((low + high) / 2)
    else:
        places = [place_of(mechanism, dimensions, float(each)) for each in between]
        assert places == pytest.approx(rows[:-1] + 0.5, abs=0.1)
