"""Formulas that are meant to take for ever give an error instead."""

import time

import pytest

from asking import ours

HOSTILE = [
    'REGEXTEST("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa!","(a+)+$")',
    'REGEXTEST(REPT("a",3000),"a*a*a*a*b")',
    'SEARCH("*a*a*a*a*a*a*a*b",REPT("a",30000))',
    'COUNTIF(A1:A2,"*a*a*a*a*a*a*a*a*a*a*b")',
    "COMBIN(1E15,5E14)",
    "PERMUT(1E15,5E14)",
    "MULTINOMIAL(1E15,1E15)",
    "PERMUTATIONA(1E15,1E15)",
    "FACT(1E15)",
    "HYPGEOM.DIST(4E14,5E14,8E14,1E15,TRUE)",
    "VDB(1,0,1E15,0,1E15)",
    "CUMIPMT(0.1,1E15,1,1,1E15,0)",
    "SUM(SEQUENCE(1E6,1E4))",
    "BESSELJ(1,1E9)",
    "WORKDAY(1,1E9)",
    "BINOM.INV(1E9,0.5,0.5)",
    'REPT("abc",1E9)',
    "BASE(1,2,1E9)",
    'TEXT(1,REPT("0",30000))',
]


@pytest.mark.parametrize("formula", HOSTILE)
def test_time_is_bounded(formula):
    start = time.process_time()
    ours([formula], [(0, 0, "a" * 32000), (1, 0, "a" * 32000 + "c")])
    assert time.process_time() - start < 2
