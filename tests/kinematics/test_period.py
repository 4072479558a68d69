"""What a turn of the driver changes of a quantity, by how it reads angles."""

import pytest

import mechsheet
from livesheet.formula.parser import parse_description
from mechsheet.compiled import compiled_of
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.whole_turns import Periods


@pytest.mark.parametrize(
    ("formula", "change"),
    [
        ("C.x - 20*a2", "nothing"),
        ("cos(theta12) + sin(2*theta12 - theta14)*C.y", "nothing"),
        ("theta12", "turns"),
        ("theta14 - theta13", "turns"),
        ("-2*theta12 + pi", "turns"),
        ("theta12 + 0*C.x", "turns"),
        ("theta12/10", "anything"),
        ("0.5*theta12", "anything"),
        ("C.x*theta14", "anything"),
        ("sqrt(theta12)", "anything"),
        ("cos(theta12/2)", "anything"),
        ("sin(theta12)^2 + theta14", "turns"),
    ],
)
def test_by_how_it_reads_angles(formula, change):
    compiled = compiled_of(loads(template_text("four-bar")))
    for columns in (compiled.equations.columns, compiled.plan.equations.columns):
        assert Periods(columns, compiled.mechanism.driven_symbols).of(parse_description(formula)) == change


@pytest.mark.slow
def test_what_the_mechanism_has_comes_back_or_goes_on_by_turns():
    compiled = compiled_of(loads(template_text("four-bar-forces")))
    periods = compiled.plan.periods
    names = {column.symbol: periods.change(column.symbol) for column in compiled.equations.columns}
    assert "anything" not in names.values()
    assert {"theta12", "theta13", "theta14"} <= {name for name, change in names.items() if change == "turns"} | {
        "theta12"
    }
    assert names["F34.x"] == names["T12"] == names["omega14"] == "nothing"


@pytest.mark.slow
def test_the_way_along_a_guide_is_no_time():
    """In the equations of a guide at an angle a part is called t, as time is where a motion law drives."""
    text = template_text("slider-crank").replace('through = [0, "a1"]', 'through = [0, "a1"]\nangle = "10 deg"')
    periods = compiled_of(loads(text)).plan.periods
    assert periods.change("t") == periods.change("s14") == "nothing"
    for stop in (360, 345):  # also without the row that closes the turn
        said = mechsheet.loads(text.replace("360", str(stop))).verdicts()
        assert said["time_ratio_s14"].words == "time ratio of s₁₄, slow way : fast way", stop
