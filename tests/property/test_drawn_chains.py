"""Linkages with groups of class III and IV, gears, racks and two drivers, drawn by a generator of their own."""

import pytest

from chains_compared import compared
from chosen import first
from drawn_chains import SHAPES, Drawn
from judging import judged
from mechsheet.description import loads
from mechsheet.kinematics.solve import solve

pytestmark = pytest.mark.slow


@pytest.mark.cases(1)
@pytest.mark.parametrize("seed", first((6, 4, 7, 8, 11, 45), 1))
def test_positions_are_those_of_the_reference(seed):
    """A linkage of each shape, over a turn: to where its assembly ends, and it does end there. More: tools/chains.py."""
    found = compared(Drawn(seed).text(73, 5.0))
    assert found.amiss == ()
    assert found.rows >= 30
    assert found.worst < 1e-11
    assert found.gap < 1e-10


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize(("rows", "step"), [(11, 5.0), (66, 0.375)])
def test_behind_a_limit_the_sheet_may_stand_elsewhere(rows, step):
    """In another assembly that closes: with all links, or with those up to a dyad that comes apart. Nothing is wrong."""
    assert judged(loads(Drawn(15).text(rows, step))).agrees


def test_shapes_are_solved_all_at_once():
    """What is drawn is what is meant: links that no dyad can begin with."""
    assert len(SHAPES) == 6
    (group,) = (group for group in solve(loads(Drawn(8).text(2, 1.0))).groups if group.system)
    assert group.kind == "III"
