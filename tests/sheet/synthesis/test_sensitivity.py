"""By how much a solution changes with an input: each row is a length, or what a length follows from, and no other step."""

import pytest

from livesheet.formula.nodes import symbols
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.sheet.synthesis.tables import changes, mark


@pytest.mark.parametrize("name", ["crank-rocker-swing", "function-generator", "quick-return-slider"])
def test_only_that_from_which_a_length_follows(name):
    mechanism = loads(template_text(name))
    task, dimensions = mechanism.synthesis, {dim.symbol: dim for dim in mechanism.dimensions}
    found = changes(task, dimensions)
    lengths = {step for step in task.ends if step in task.steps and dimensions[step].unit.kind == "length"}
    assert lengths <= {step for step, _ in found}
    read = {name for node in found.values() for name in symbols(node)}
    for step, column in found:
        assert step in lengths or mark(step, column) in read, step
        assert column in task.inputs
