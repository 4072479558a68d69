"""Links of which no chain of joints leads to the ground: they are named, and no others, whichever is described first."""

import pytest

from mechsheet.description import loads
from mechsheet.diagnostics import DescriptionError

LINKS = {
    "loose": "[links.loose]\npoints = { P = [0, 0], Q = [10, 0] }\n",
    "crank": "[links.crank]\npoints = { A0 = [0, 0], A = [20, 0] }\n",
}


@pytest.mark.parametrize("order", [("loose", "crank"), ("crank", "loose")])
def test_the_loose_one_is_named(order):
    with pytest.raises(DescriptionError) as caught:
        loads(
            'format = 1\n[mechanism]\nname = "loose"\n[links.ground]\npoints = { A0 = [0, 0] }\n'
            + "".join(map(LINKS.get, order))
            + '[driver]\nlink = "crank"\nstart = 0\nstop = 90\nstep = 15\n'
        )
    (fault,) = caught.value.faults
    assert fault.key == "links.loose"
    assert fault.hint == "it shares no point with another link"
