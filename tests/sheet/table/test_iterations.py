"""The sheet of Newton's method: what a reader sees of it, and what he is told when he changes something."""

import math

import numpy as np
import pytest
from laid import Laid

from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet.checking.against_reference import against_plan
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.exporting import KINDS, Job
from random_mechanisms import Grower

TEXT = template_text("planar-3rpr").replace("stop = 7\n", "stop = 5.6\n")
SAUER = (-0.7208492, -0.3310052, 1.1436855, 2.1159090)


@pytest.fixture
def sheet():
    return Laid(TEXT)


@pytest.mark.slow
def test_the_drop_down_chooses_among_all_assemblies(sheet):
    found = []
    for number in range(1, 5):
        sheet.change(mode_1=number)
        assert sheet.exists == [True] * 4
        found.append(math.radians(sheet.column("theta16")[0]))
    assert sorted(found) == pytest.approx(SAUER, abs=5e-8)
    assert sheet.change(mode_1=5).verdict == "look at mode₁: no value that it can have"
    assert not any(sheet.exists)


@pytest.mark.slow
def test_the_sheet_is_the_last_and_all_but_its_last_pass_is_folded(sheet):
    last = sheet.workbook.sheets[-2]  # the last of all is the hidden one that carries the description
    assert last.title == "Iterations"
    blocks = {column.group for column in sheet.plan.iterations}
    shown = {column.group for column in sheet.plan.iterations
             if not any(each.hidden for each in last.columns if each.first == column.col)}  # fmt: skip
    assert shown == {max(blocks)}
    assert len(blocks) == 7


@pytest.mark.slow
def test_the_first_sheet_says_how_well_it_went(sheet):
    assert sheet.spot("largest_residual") < 1e-14
    assert 3 <= sheet.spot("passes_needed") <= 6
    assert sheet.spot("same_assembly") == 0
    assert "rows only" in sheet.words("swing_theta12")
    last = next(group.system.determinant for group in sheet.plan.equations.groups if group.system is not None)
    assert sheet.spot("least_det") == min(map(abs, sheet.column(last)))


@pytest.mark.slow
def test_after_a_change_the_start_table_still_leads_to_the_position(sheet):
    sheet.change(p1=4.7, L3=3.2)
    assert sheet.exists == [True] * 4
    assert sheet.spot("largest_gap") < 1e-12


@pytest.mark.slow
def test_where_the_links_do_not_meet_the_table_says_so(sheet):
    sheet.change(_start=9.4)
    assert not any(sheet.exists)
    assert sheet.column("status")[0].startswith("these links do not meet, or the step is too large")
    assert "no position found" in sheet.verdict


@pytest.mark.slow
def test_behind_a_start_that_leads_nowhere_no_row_shows_a_position_by_chance(sheet):
    """Rows further down would close, in whichever assembly Newton's method happens to fall into."""
    for start, step in ((10.0, -1.2), (10.0, -2.2), (10.5, -1.6), (11.0, -1.2)):
        sheet.change(_start=start, _step=step)
        assert not any(sheet.exists), (start, step)
    sheet.change(_start=9.2, _step=-0.4)  # a start that is reached leads on
    assert all(sheet.exists)


def test_steps_that_leap_are_red(sheet):
    """A leg that runs through the end of an assembly and back: what stands behind the gap may be another."""
    sheet.change(_start=7.0, _step=2.5)
    assert sheet.exists == [True, False, False, False]
    sheet.change(_start=7.0, _step=-1.5)
    assert sheet.spot("same_assembly") + sheet.exists.count(False) > 0


def test_python_writes_a_loop_that_gives_the_same(sheet):
    (code,) = KINDS["python"].write(Job(sheet.mechanism, "platform_module"))
    space = {"__name__": "platform_module"}
    exec(compile(code, "platform_module.py", "exec"), space)
    found = space["solve"]()
    assert np.degrees(found["theta16"]) == pytest.approx(sheet.column("theta16"), abs=1e-11)
    assert space["solve"](mode_1=2)["theta16"][0] == pytest.approx(SAUER[2], abs=5e-8)
    with pytest.warns(UserWarning, match="no position was found"):
        assert np.isnan(space["solve"](p2=[9.4])["theta16"]).all()


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("seed", [1062, 1023])
def test_a_massless_block_whose_angle_is_an_unknown_starts_where_it_was_found(seed):
    """A pin in a slot among the carriers: its angle has no column in degrees, its start value is typed in degrees."""
    compiled = Compiled(loads(Grower(seed, 1, ("III",)).text(rows=6, step=1.0)))
    assert any(name.startswith("delta") for group in compiled.equations.groups for name in group.unknowns)
    book = book_of(compiled.layout)
    comparison, _ = against_plan(book, evaluate(book), compiled.plan, "block")
    assert comparison.agrees
    assert comparison.worst < 1e-9
