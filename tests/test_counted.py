"""One thing, two things: what people read beside a number."""

import pytest

from mechsheet.checking.stored import Stored
from mechsheet.checking.stored_lines import stored_lines
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.words.catalogue import marks_of


def test_the_comparison_with_stored_values_counts_in_english():
    one, two = ("\n".join(stored_lines(Stored(n + 1, 1, n, n, n, n, n, ("A1",) * n))) for n in (1, 2))
    for word in (
        "2 formulas: 1 as stored, 0 differ",
        "1 has no",
        "1 more was not",
        "1 more changes",
        "1 more is ignored",
        "1 more difference is",
    ):
        assert word in one
    for word in (
        "3 formulas:",
        "2 have no",
        "2 more were not",
        "2 more change ",
        "2 more are ignored",
        "2 more differences",
    ):
        assert word in two


def test_marks_of_one_and_of_several():
    assert marks_of("en", 0.5, 1) == "0.5 of 1 mark"
    assert marks_of("en", 1, 3) == "1 of 3 marks"
    assert marks_of("tr", 1, 1) == "1 üzerinden 1 puan"


def test_a_list_of_one_speed_is_one_number():
    driver = "values = [0, 90, 180]\nspeed = [10]"
    text = template_text("four-bar").replace("start = 0\nstop = 360\nstep = 15", driver)
    with pytest.raises(DescriptionError, match="has 1 number for 3 values of the driver"):
        loads(text)
