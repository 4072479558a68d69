"""Goal Seek ("Hedef Ara"): a live cell of the first sheet is brought to a number by a dimension (docs/lecturer.md)."""

import pytest
from printed_numbers import TEMPLATES

from mechsheet.description import load
from mechsheet.library.building import build
from mechsheet.library.recalculation import recalc
from office_macros import Job, with_macros

pytestmark = pytest.mark.slow

GOAL = 90.0
PAGE = (TEMPLATES.parent / "docs" / "lecturer.md").read_text(encoding="utf-8")


@pytest.mark.ci
def test_goal_seek_finds_the_crank_for_a_swing(tmp_path):
    """The rocker of the text's four-bar is to swing by 90 degrees; the crank is changed."""
    files = build(load(TEMPLATES / "four-bar.toml"), tmp_path, ("xlsx", "ods"))
    for path, found in zip(
        files, with_macros([Job(path, sought=("swing", "a_2", GOAL)) for path in files]), strict=True
    ):
        result = recalc(path)
        places = {name.name: name.formula for name in result.book.names}
        crank, swing = (found.get(places[name].sheet, places[name].row, places[name].col) for name in ("a_2", "swing"))
        assert swing == pytest.approx(GOAL, abs=0.01)
        assert recalc(path, {"a_2": crank}).named()["swing"] == pytest.approx(swing, abs=1e-6)
        assert f"{crank:.3f} mm" in PAGE
