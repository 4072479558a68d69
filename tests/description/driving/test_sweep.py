"""`--step 1.8`, `--rows 200`: the sweep is changed in the description's text, and has that many rows."""

from pathlib import Path

import numpy as np
import pytest

from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values

DATA = Path(__file__).parents[2] / "data"
TEXTS = {name: template_text(name) for name in ("four-bar", "chebyshev", "roberts", "cylinder-boom")}


def swept(mechanism):
    """The driver's values as people read them."""
    return mechanism.driver.unit.to_shown(driver_values(mechanism, dimension_values(mechanism)))


@pytest.mark.parametrize(
    ("name", "rows", "step", "written"),
    [
        ("four-bar", "201", None, "start = 0\nstop = 360\nstep = 1.8"),
        ("four-bar", "200", None, "start = 0\nstop = 360\nstep = 1.8090452261306533"),
        ("four-bar", "1048556", None, "start = 0\nstop = 360\nstep = 0.0003433296298239005"),
        ("four-bar", None, "1.8", "start = 0\nstop = 360\nstep = 1.8"),
        ("four-bar", None, "360/7", "start = 0\nstop = 360\nstep = 51.4285714285714"),
        ("four-bar", None, "pi/100", "start = 0\nstop = 360\nstep = 1.8"),  # as in a description: radians
        ("four-bar", "11", "0.1", "start = 0\nstop = 1\nstep = 0.1"),
        ("four-bar", "1000000", "1.1", "start = 0\nstop = 1099998.9\nstep = 1.1"),
        ("four-bar", "999983", "0.0001095702000976", "stop = 109.56822783399824\nstep = 0.0001095702000976"),
        ("four-bar", "11", "-5", "start = 0\nstop = -50\nstep = -5"),
        ("chebyshev", "6", None, 'start = 90\nstop = "acos(4/5)"\nstep = "(acos(4/5) - radians(90)) / 5"'),
        ("chebyshev", "6", "-2", "start = 90\nstop = 80\nstep = -2"),
        ("roberts", "11", None, 'start = "left"\nstop = "right"\nstep = "(right - left) / 10"'),
        ("roberts", "11", "-2", 'start = "left"\nstop = "left - radians(20)"\nstep = -2'),
        ("cylinder-boom", "7", None, "start = 0\nstop = 600\nstep = 100"),
        ("cylinder-boom", "2", "L0", "start = 0\nstop = 620\nstep = 620"),
    ],
)
def test_rows_and_step_in_the_text(name, rows, step, written):
    before, after = loads(TEXTS[name]), loads(TEXTS[name], overrides=Overrides(rows=rows, step=step))
    assert f"\n{written}\n" in after.text
    old, new = swept(before), swept(after)
    assert new[0] == old[0]
    if rows is not None:
        assert len(new) == int(rows)
    if step is None:
        assert new[-1] == pytest.approx(old[-1], abs=1e-9)
    assert loads(after.text) == after
    assert len(after.text.splitlines()) == len(before.text.splitlines())


def test_what_follows_from_expressions_goes_on_following():
    """The sweep between two derived angles has its rows also after a dimension was changed in the text."""
    text = loads(TEXTS["roberts"], overrides=Overrides(rows="11")).text
    assert len(swept(loads(text, overrides=Overrides({"a2": "250"})))) == 11
    changed = loads(TEXTS["roberts"], overrides=Overrides({"a2": "250"}, rows="11"))
    assert np.array_equal(swept(changed), swept(loads(text, overrides=Overrides({"a2": "250"}))))


def test_a_sweep_that_is_not_whole_is_completed():
    text = TEXTS["four-bar"].replace("stop = 360\n", "").replace("step = 15\n", "")
    assert swept(loads(text, overrides=Overrides(rows="3", step="20"))).tolist() == pytest.approx([0, 20, 40])
    with pytest.raises(DescriptionError, match='"stop" and "step" are missing'):
        loads(text, overrides=Overrides(rows="3"))


@pytest.mark.parametrize(
    ("rows", "step", "messages"),
    [
        ("1", None, ["rows: a sweep has at least 2 rows, not 1"]),
        ("1048557", None, ["rows: a sheet holds at most 1,048,556 rows below its headings, not 1,048,557"]),
        ("2.5", None, ['rows: expected a whole number, found "2.5"']),
        ("1,000", None, ['rows: expected a whole number, found "1,000"']),
        ("many", "1,8", ['step: expected a number, found "1,8"\n       = write 1.8', 'found "many"']),
        (None, "0", ["step: the step is zero"]),
        ("5", "0", ["step: the step is zero"]),
        (None, "-1", ["step: a step of -1 never leads from 0 to 360: it must be positive"]),
        (None, "1e-6", ["step: the sweep has 360,000,001 rows"]),
        (None, "1e-310", ["step: 1e-310 is out of range"]),
        ("1000000", "1e305", ["step: 1e+305 is out of range"]),
        ("1e999", None, ['rows: expected a whole number, found "1e999"']),
        (None, "nan", ['step: expected a number, found "nan"']),
        (None, "5 mm", ['step: "5 mm" where ° are needed']),
        (None, "1/0", ["step: has no value: division by zero"]),
        (None, "a2", ['step: "a2" is a length where an angle is needed']),
        (None, "fast", ['step: "fast" is not a dimension']),
    ],
)
def test_faults(rows, step, messages):
    with pytest.raises(DescriptionError) as caught:
        loads(TEXTS["four-bar"], "four-bar.toml", Overrides(rows=rows, step=step))
    assert all(message in str(caught.value) for message in messages), str(caught.value)
    assert len(caught.value.faults) == (rows is not None and step == "1,8") + 1
    assert {(fault.file, fault.line) for fault in caught.value.faults} == {("four-bar.toml", None)}


def test_faults_together():
    text = TEXTS["four-bar"].replace('link = "crank"', 'link = "cronk"')
    with pytest.raises(DescriptionError) as caught:
        loads(text, overrides=Overrides({"a9": "1"}, rows="1"))
    assert [fault.key for fault in caught.value.faults] == ["overrides: a9=1", "rows", "driver.link"]


def test_from_one_value_to_the_same_no_step_leads():
    text = TEXTS["four-bar"].replace("stop = 360", "stop = 0")
    with pytest.raises(DescriptionError, match="rows: start and stop are the same: no step makes 5 rows"):
        loads(text, overrides=Overrides(rows="5"))
    assert len(swept(loads(text, overrides=Overrides(rows="5", step="3")))) == 5


def test_values_one_by_one_are_no_sweep():
    text = TEXTS["four-bar"].replace("start = 0\nstop = 360\nstep = 15", "values = [0, 30, 90]")
    with pytest.raises(DescriptionError) as caught:
        loads(text, overrides=Overrides(rows="5", step="3"))
    assert [fault.key for fault in caught.value.faults] == ["step", "rows"]
    assert "listed one by one" in str(caught.value)


@pytest.mark.parametrize("start", ['"nothing"', "true", '"1/0"', "[0]"])
def test_a_faulty_sweep_is_told_once(start):
    text = TEXTS["four-bar"].replace("start = 0", f"start = {start}")
    for changes in ({"rows": "5"}, {"step": "5"}, {"rows": "5", "step": "5"}):
        with pytest.raises(DescriptionError) as caught:
            loads(text, overrides=Overrides(**changes))
        assert [fault.key for fault in caught.value.faults] == ["driver.start"]
