"""What a turn of the driver changes of a quantity, by how it reads angles."""

import pytest

from livesheet.formula.parser import parse_description
from mechsheet.compiled import compiled_of
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.period import Periods


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


def test_what_the_mechanism_has_comes_back_or_goes_on_by_turns():
    compiled = compiled_of(loads(template_text("four-bar-forces")))
    periods = compiled.plan.periods
    names = {column.symbol: periods.change(column.symbol) for column in compiled.equations.columns}
    assert "anything" not in names.values()
    assert {"theta12", "theta13", "theta14"} <= {name for name, change in names.items() if change == "turns"} | {
        "theta12"
    }
    assert names["F34.x"] == names["T12"] == names["omega14"] == "nothing"
