"""Branches that meet and degenerate geometry: right numbers, or #N/A with a word, or a clear message.

Engine and reference agree on which rows exist, to the last row at a limit, and on rows to which the mechanism leaps.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from laid import Laid
from leaping import leaps

from chosen import examples, part
from degenerate_cases import cases
from judging import judged
from livesheet.evaluation import book_of
from livesheet.formula.nodes import MAX_ROWS
from mechsheet.checking.against_search import against_search
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.grammar import MOST_ROWS
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.kinematics.solve import solve
from mechsheet.reference import solve as refer
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.planning import plan_of
from random_mechanisms import Grower

ALL = [pytest.param(case, id=case.name) for folder in ("branches", "degenerate") for case in cases(folder)]
BUILT = [param for param in ALL if not param.values[0].refused]
REFUSED = [param for param in ALL if param.values[0].refused]


@pytest.mark.slow
@pytest.mark.parametrize("case", BUILT)
def test_what_must_happen(case):
    """Rows without a position say why, all others are measured as closed, and the counts on the first sheet are these."""
    laid = Laid(case.description)
    exists, status = laid.exists, laid.column("status")
    assert {row for row, there in enumerate(exists) if not there} == case.missing
    for row in case.missing:
        assert case.says in status[row]
        assert ("undetermined" in status[row]) == (row in case.undetermined)
    assert laid.spot("rows_closed") == laid.plan.rows - len(case.missing)
    if not case.undetermined:  # a link that turned round while it could turn freely has made no leap that all see
        assert laid.spot("leaps") == len(case.leaps)
    assert laid.words("largest_gap") == "largest gap of a joint: rounding only"
    for symbol, rows in case.values.items():
        shown = laid.column(symbol)
        for row, value in rows.items():
            assert shown[row] == pytest.approx(value, rel=1e-9, abs=1e-9)


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("case", [param for param in BUILT if param.values[0].undetermined])
def test_the_search_agrees_where_links_can_turn_freely(case):
    """Such a row ends a stretch: its limit has a number, known to a step, and `check` finds nothing wrong with it."""
    laid = Laid(case.description)
    comparison = against_search(book_of(laid.workbook), laid.values, laid.plan, case.name)
    assert comparison.agrees, comparison


@pytest.mark.parametrize("case", [param for param in BUILT if param.values[0].undetermined])
def test_on_one_sheet_too(case):
    compiled = Compiled(replace(loads(case.description), layout="page"))
    status = compiled.column(compiled.plan.status_column)
    assert {row for row, said in enumerate(status) if "undetermined" in str(said)} == case.undetermined


@pytest.mark.cases(8)
@pytest.mark.parametrize("case", BUILT)
def test_reference_agrees(case):
    mechanism = loads(case.description)
    solution = refer(mechanism)
    assert set(np.flatnonzero(~solution.exists)) == case.missing
    assert set(np.flatnonzero(solution.undetermined)) == case.undetermined
    assert set(np.flatnonzero(leaps(solution))) == case.leaps
    comparison = judged(mechanism)
    assert comparison.agrees, comparison


@pytest.mark.parametrize("case", REFUSED)
def test_refused_with_a_message(case):
    with pytest.raises(MechsheetError) as error:
        solve(loads(case.description))
    assert case.says in str(error.value)


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize("seed", part(range(30), 3))
def test_through_and_beyond_limits(seed):
    """Dimensions changed by up to a quarter in the cells: some rows do not exist; engine and reference agree on which."""
    mechanism = loads(Grower(9_000 + seed, 1 + seed % 4).text(25, 15.0))
    random = np.random.default_rng(seed)
    changes = {dim.symbol: dim.shown * (1 + 0.25 * random.uniform(-1, 1)) for dim in mechanism.dimensions}
    comparison = judged(mechanism, changes)
    assert comparison.agrees, (seed, comparison)


@pytest.mark.slow
@settings(max_examples=examples(15), derandomize=True, deadline=None, database=None)
@given(st.floats(1.0, 153.2), st.floats(0.05, 40.0))
def test_rows_around_a_limit(ground, step):
    """Any ground and any step: the last row before the limit and the first one behind it are the reference's."""
    text = template_text("four-bar").partition("[outputs]")[0]
    text = text.replace("a1 = { value = 70", f"a1 = {{ value = {ground!r}").replace("step = 15", f"step = {step!r}")
    text = text.replace("stop = 360", f"stop = {12 * step!r}").partition("[assembly]")[0]
    mechanism = loads(text)
    try:
        solve(mechanism)
    except MechsheetError:
        assert not refer(mechanism).exists.any()
        return
    comparison = judged(mechanism)
    assert comparison.agrees, (ground, step, comparison)


@pytest.mark.slow
def test_as_many_rows_as_a_sheet_holds():
    """Only laid out: the plan has an address for every row, and the sheet of checks has room; one row more is refused."""
    text = template_text("scotch-yoke").replace("step = 5", "step = 0.001")
    most = loads(text.replace("stop = 360", f"stop = {0.001 * (MOST_ROWS - 1)!r}"))
    plan = plan_of(most, solve(most))
    assert plan.rows == MOST_ROWS
    assert plan.at.last < MAX_ROWS
    assert Checks(plan).last < MAX_ROWS
    with pytest.raises(MechsheetError, match="rows"):
        loads(text.replace("stop = 360", f"stop = {0.001 * MOST_ROWS!r}"))
