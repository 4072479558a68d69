"""Names in the workbook's drawing: none lies on another, a link, an arrow or a ring, in 25 positions of the motion."""

import math

import numpy as np
import pytest
from drawn import Drawn

from chosen import some
from folders import TEMPLATE_FILES
from loaded_mechanisms import LAMP, SUSPENSION
from mechsheet.description.templates import template_text

pytestmark = pytest.mark.slow

POSITIONS = 25


def rows_of(drawn):
    closed = np.flatnonzero(drawn.compiled.closed)
    return sorted(
        {int(row) for row in closed[np.linspace(0, len(closed) - 1, min(POSITIONS, len(closed))).astype(int)]}
    )


@pytest.mark.cases(1)
@pytest.mark.parametrize("path", some(TEMPLATE_FILES, 2), ids=lambda path: path.stem)
def test_names_of_templates(path):
    drawn = Drawn(path.read_text(encoding="utf-8"))
    assert {row: found for row in rows_of(drawn) if (found := list(drawn.conflicts(row)))} == {}


@pytest.mark.cases(1)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("text", [SUSPENSION, LAMP], ids=["suspension", "lamp"])
def test_names_beside_springs_and_loads(text, layout):
    drawn = Drawn(text, layout=layout)
    assert {row: found for row in rows_of(drawn) if (found := list(drawn.conflicts(row)))} == {}


def test_a_point_that_is_there_keeps_its_name_where_nothing_closes():
    """With a crank of 90 the four-bar does not close at 180 degrees: the crank's pin is there, and named."""
    drawn = Drawn(template_text("four-bar"), values={"a2": "90"})
    row = int(np.flatnonzero(~drawn.compiled.closed)[0])
    named = {words: points[0] for series, points, words in drawn.at(row) if series.show_name}
    assert all(map(math.isfinite, named["A"])) and all(map(math.isfinite, named["B₀"]))
    assert not np.isfinite(named["B"]).any()
