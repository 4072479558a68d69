"""What counts or sums under conditions over a sheet that was deleted: the error stands in place of the range."""

import pytest

from asking import ours
from livesheet.formula.nodes import ErrorValue

LOST = (
    "COUNTIF(#REF!,1)", "COUNTIFS(A1:A2,1,#REF!,1)", "SUMIF(#REF!,1)", "SUMIF(A1:A2,1,#REF!)", "AVERAGEIF(#REF!,1)",
    "SUMIFS(#REF!,A1:A2,1)", "AVERAGEIFS(A1:A2,#REF!,1)", "MAXIFS(#REF!,#REF!,1)", "MINIFS(A1:A2,#REF!,1)",
)  # fmt: skip


@pytest.mark.parametrize("formula", LOST)
@pytest.mark.parametrize("rows", [1, 300])
def test_a_lost_range_is_its_error(formula, rows):
    """0 looked like a result."""
    assert set(ours([formula] * rows, [(0, 0, 1.0), (1, 0, 2.0)])) == {ErrorValue("#REF!")}


def test_an_error_in_a_range_is_one_of_its_cells():
    assert ours(["1/0", "COUNTIF(C1:C2,2)", "COUNTIF(A1:A2,2)"], [(0, 0, 1.0), (1, 0, 2.0)])[2] == 1.0
    assert ours(["COUNTIF(A1,2)"], [(0, 0, ErrorValue("#N/A"))])[0] == 0.0
