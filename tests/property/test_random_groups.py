"""Random groups of class III and IV: what the workbook computes is what the reference finds from the model alone."""

import pytest

from chosen import part
from judging import judged
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from random_mechanisms import Grower

COUNT = 200
ROWS = 24


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("seed", part(range(COUNT), 50))
def test_engine_equals_reference(seed, record_property):
    """Class III and IV in turn, of class III some with a pin in a slot."""
    mechanism = loads(Grower(seed, 1, (("III", "IV")[seed % 2],)).text(ROWS, 1.0))
    try:
        comparison = judged(mechanism)
    except MechanismError as error:
        assert "the sketch lies between" in str(error)
        pytest.skip("a rounded sketch that says nothing")
    record_property("worst", comparison.worst)
    assert comparison.agrees, comparison
    assert comparison.worst < 1e-9


@pytest.mark.parametrize("seed", part(range(30), 10))
def test_all_assemblies_are_listed(seed):
    """As many as the reference finds by guesses of its own in the first position, whatever joints the group has."""
    mechanism = loads(Grower(seed, 1, (("III", "IV")[seed % 2],)).text(3, 1.0))
    try:
        (group,) = solve(mechanism).groups
    except MechanismError:
        pytest.skip("a rounded sketch that says nothing")
    dimensions = dimension_values(mechanism)
    first = float(driver_values(mechanism, dimensions)[group.system.row])
    assert len(group.assemblies) == len(reference.assemblies(mechanism, None, first))
