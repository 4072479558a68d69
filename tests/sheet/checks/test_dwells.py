"""What rests while its cam turns fits, too: a number in every row, and no rounding over rounding."""

import numpy as np
import pytest
from laid import Laid

from mechsheet.description.templates import template_text
from mechsheet.sheet.checks.checks import Checks


@pytest.mark.slow
def test_a_dwell_is_a_row_with_velocities():
    """Where all velocities of a group were 0 there was no number, and where they were rounding one in some programs only."""
    laid = Laid(template_text("cam-linkage"))
    checks = Checks(laid.plan)
    cols = [2 + at for at, check in enumerate(checks.columns) if check.kind in ("velocity", "acceleration")]
    assert len(cols) > 1
    phi = np.linspace(0, 360, checks.last + 1 - checks.first)
    for col in cols:
        shown = [laid.values.get(checks.title, row, col) for row in range(checks.first, checks.last + 1)]
        assert all(isinstance(value, float) for value in shown)
        assert max(shown) < 1e-10
        assert np.max(np.asarray(shown)[(phi > 122) & (phi < 178)]) < 1e-13
