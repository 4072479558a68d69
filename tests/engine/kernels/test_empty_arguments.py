"""Arguments that are empty, `COUNTA(,)`: as in Excel nothing between two commas is a value, 0, FALSE or an empty text."""

import pytest

from asking import ours
from livesheet.formula.nodes import ErrorValue

NUM, NA = ErrorValue("#NUM!"), ErrorValue("#N/A")
CASES = [
    ("COUNTA(,)", 2.0), ("COUNTA(1,)", 2.0), ("COUNTA(A1,,A2)", 3.0), ('COUNTA("",)', 2.0), ("COUNTA(C1,)", 1.0),
    ("COUNT(,)", 2.0), ("COUNT(1,)", 2.0), ("SUM(,)", 0.0), ("AVERAGE(,)", 0.0), ("AVERAGE(1,)", 0.5),
    ("AVERAGEA(1,)", 0.5), ("MAX(-1,)", 0.0), ("MAXA(-1,)", 0.0), ("MIN(1,)", 0.0), ("MINA(1,)", 0.0),
    ("PRODUCT(2,)", 0.0), ("MEDIAN(1,)", 0.5), ("MODE(0,)", 0.0), ("DEVSQ(1,)", 0.5), ("GEOMEAN(1,)", NUM),
    ("AND(TRUE,)", False), ("AND(,)", False), ("OR(,)", False), ("OR(TRUE,)", True), ("XOR(,)", False),
    ("XOR(TRUE,)", True), ("NOT(AND(A1>0,))", True), ("IF(AND(A1>0,),1,2)", 2.0), ("IF(OR(,A1>0),1,2)", 1.0),
    ("CONCATENATE(,)", ""), ('TEXTJOIN(",",FALSE,,)', ","), ("CHOOSE(1,,2)", 0.0), ("IF(TRUE,)", 0.0),
    ("IFERROR(1/0,)", 0.0), ("LOG(8,)", NUM), ('LEFT("abc",)', ""), ("ROUND(2.5,)", 3.0), ("SWITCH(1,,2)", NA),
]  # fmt: skip


@pytest.mark.parametrize(("formula", "value"), CASES, ids=[case[0] for case in CASES])
def test_one(formula, value):
    found = ours([formula], [(0, 0, 1.0), (1, 0, 2.0)])[0]
    assert type(found) is type(value)
    assert found == value


def test_filled_down():
    """The same by the code that is made for long columns."""
    assert set(ours(["IF(AND($A$1>0,),1,COUNTA(,))"] * 300, [(0, 0, 1.0)])) == {2.0}
