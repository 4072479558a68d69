"""The table of functions: its spellings, its kinds, and the page made from it."""

import importlib.util

import pytest

from folders import ROOT
from livesheet.formula.functions import FUNCTIONS, MANY


def list_of_functions():
    spec = importlib.util.spec_from_file_location("list_of_functions", ROOT / "tools" / "list_of_functions.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_up_to_date():
    """Run tools/list_of_functions.py after a change of functions.txt."""
    assert list_of_functions().PATH.read_text(encoding="utf-8") == list_of_functions().page()


@pytest.mark.parametrize(
    ("name", "least", "most", "kinds"),
    [
        ("SIN", 1, 1, "n"),
        ("LOG", 1, 2, "nn"),
        ("SUM", 1, MANY, "vvvv"),
        ("SUMIFS", 3, MANY, "rrqrqrq"),
        ("SORTBY", 2, MANY, "gggggg"),
        ("NOW", 0, 0, ""),
    ],
)
def test_arguments(name, least, most, kinds):
    row = FUNCTIONS[name]
    assert (row.least, row.most, row.kinds_of(len(kinds))) == (least, most, kinds)


def test_arguments_that_may_be_left_empty():
    """`ROUND(A1,)` rounds to whole numbers, an empty criterion of COUNTIFS is one."""
    assert [FUNCTIONS["ROUND"].needs(place) for place in range(2)] == [True, True]
    assert [FUNCTIONS["LOG"].needs(place) for place in range(2)] == [True, False]
    assert [FUNCTIONS["COUNTIFS"].needs(place) for place in range(5)] == [True] * 5
    assert [FUNCTIONS["SUM"].needs(place) for place in range(3)] == [True] * 3


def test_spellings_are_those_of_other_writers():
    """XlsxWriter's list of functions younger than the format: those it knows must have our prefix, and no others."""
    import inspect
    import re

    from xlsxwriter.worksheet import Worksheet

    source = inspect.getsource(Worksheet._prepare_formula)
    theirs = dict(re.findall(r'r"\\b([A-Z0-9.]+)\\\(", "([A-Za-z_.0-9]+)\("', source))
    known = {name for name in theirs if name in FUNCTIONS}
    assert len(known) > 100
    assert {name: FUNCTIONS[name].ooxml for name in known} == {name: theirs[name] for name in known}
