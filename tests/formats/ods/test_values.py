"""Dates and times as OpenDocument spells them."""

import pytest

from livesheet.formats.ods.values import date_text, time_number, time_text
from livesheet.formats.xml_text import NULL_DATE, day_number


@pytest.mark.parametrize("number", [45351.0, 45351.5, 1.25, 60.000011574074074])
def test_dates_read_back(number):
    assert day_number(date_text(number, NULL_DATE), NULL_DATE) == pytest.approx(number, abs=1e-8)
    assert time_number(time_text(number)) == pytest.approx(number, abs=1e-8)
