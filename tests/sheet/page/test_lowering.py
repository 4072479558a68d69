"""What a formula of one sheet asks for before it is computed: whether pins coincide that come near each other."""

import pytest

from livesheet.formula.nodes import Call, walk
from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.page.lowering import lowered

FOUR_BAR = """
format = 1
[mechanism]
name = "four-bar"
[links.ground]
points = {{ A0 = [0, 0], B0 = [{a1!r}, 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = [{a2!r}, 0] }}
[links.coupler]
points = {{ A = [0, 0], B = [{a3!r}, 0] }}
[links.rocker]
points = {{ B0 = [0, 0], B = [{a4!r}, 0] }}
[driver]
link = "crank"
start = 0
stop = 360
step = 60
[assembly]
B = [{a1!r}, {a4!r}]
"""


def asks(a2, scale):
    """Whether the angle to the rocker's pivot, to which the crank's pin comes within a1 - a2, has a condition."""
    lengths = {"a1": 70 * scale, "a2": a2 * scale, "a3": 110 * scale, "a4": 100 * scale}
    mechanism = loads(FOUR_BAR.format(**lengths))
    columns = lowered(mechanism, solve(mechanism), (), True).columns
    (angle,) = (each for each in columns if each.symbol.startswith("mu"))
    return any(isinstance(part, Call) and part.name == "IF" for part in walk(angle.expression))


@pytest.mark.parametrize("scale", [1.0, 1e-3])
def test_near_is_a_part_of_the_size_whatever_the_unit(scale):
    """In mm and in m: where a link is set to a length at which they coincide, a cell says #N/A instead of a number."""
    assert asks(65, scale)
    assert not asks(30, scale)
