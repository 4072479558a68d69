"""What forces are called in outputs: a slide without a pin holds its link's direction, so it has a couple, too."""

import pytest

from in_line import IN_LINE
from mechsheet.description import loads
from mechsheet.diagnostics import DescriptionError

OUTPUTS = '[[loads]]\nlink = "crank"\ntorque = 3\n[outputs]\nmine = { formula = "F14.n + 0*F14.c", unit = "1" }\n'
SLOT = IN_LINE.replace("[links.piston]\npoints = { B = [0, 0] }\n", "").replace(
    '"prismatic"\nlink = "piston"', '"pin-slot"\nlink = "rod"'
)


def test_a_block_has_a_couple_and_a_pin_in_a_slot_has_none():
    assert [output.symbol for output in loads(IN_LINE + OUTPUTS).outputs] == ["mine"]
    pinned = OUTPUTS.replace("F14", "F13")
    loads(SLOT + pinned.replace(" + 0*F13.c", ""))
    with pytest.raises(DescriptionError, match=r"F13\.c"):
        loads(SLOT + pinned)
