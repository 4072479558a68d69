"""What many formulas give in one strip at once is what each gives by itself."""

from __future__ import annotations

import numpy as np
import pytest

import mechsheet
from homework.styles import STYLES
from mechsheet.engine.values.cells import NUMBER
from mechsheet.engine.values.frames import Frame
from mechsheet.homework.mends.candidates import Surroundings, candidates
from mechsheet.homework.mends.own_values import own_values
from mechsheet.homework.series import Graph
from mechsheet.homework.upright import turned, upright


def by_itself(work, strip, formula):
    """A formula over a strip's cells, by the engine alone."""
    sheet, row, col = work.engine_place((strip.sheet, strip.start, strip.line))
    frame = Frame(
        work.plan.layout.titles.index(sheet), row, col, *((1, strip.length) if work.across else (strip.length, 1))
    )
    cells = work.computed.result(turned(formula) if work.across else formula, frame)
    numbers = np.ravel(np.broadcast_to(cells.numbers, frame.shape))
    codes = 0 if cells.codes is None else np.ravel(np.broadcast_to(cells.codes, frame.shape))
    return np.where(codes == NUMBER, numbers, np.nan)


@pytest.mark.parametrize("style", ["down", "to the right", "two sheets"])
def test_many_at_once_as_one_by_one(style):
    """Formulas that differ in one place are computed as one array; dead ends among them (1/0, ACOS(3)) stay NaN."""
    work = upright(STYLES[style](mechsheet.template("four-bar")))
    graph = Graph(work)
    tried = 0
    for number, strip in enumerate(work.strips):
        formula = graph.formulas[number]
        read = tuple(node for start, end in graph.corners(number) if start is end for node in [start])
        numbers = tuple(work.number((node.sheet or strip.sheet, node.row, node.col)) for node in read)
        several = [one.formula for one in candidates(formula, Surroundings(read, read, numbers))][::7]
        together = own_values(work, strip, formula, several)
        alone = [by_itself(work, strip, one) for one in several[:40]]
        np.testing.assert_allclose(together[: len(alone)], np.reshape(alone, (-1, strip.length)), rtol=1e-13)
        tried += len(alone)
    assert tried > 200
