"""Other dimensions given before anything is built: a sketch that has come to mean another assembly is told."""

import pytest

from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.solve import solve
from mechsheet.library import changed


def told(name, **overrides):
    mechanism = changed.loads(
        template_text(name), overrides=Overrides({key: str(value) for key, value in overrides.items()})
    )
    return doubts(mechanism, solve(mechanism))


@pytest.mark.slow
@pytest.mark.cases(2)
@pytest.mark.parametrize(
    ("name", "overrides", "words", "hint"),
    [
        ("planar-3rpr", {"p1": 6}, "", ""),
        (
            "planar-3rpr",
            {"p1": 8},
            "the assembly of leg 1, platform, ",
            "mode_1=1 ... 2",
        ),  # the sheet finds no position
        ("planar-3rpr", {"y2": 2.4}, "means another assembly of leg 1", "--set mode_1=2 takes that one"),
        ("planar-3rpr", {"y2": 2.4, "mode_1": 2}, "", ""),
        ("four-bar", {"a2": 36}, "", ""),
    ],
)
def test_an_assembly_that_the_sketch_leaves(name, overrides, words, hint):
    found = told(name, **overrides)
    assert [words in fault.message and hint in fault.hint for fault in found] == [True] * bool(words)


@pytest.mark.slow
@pytest.mark.parametrize("other", [{"language": "tr"}, {"layout": "page"}])
def test_what_the_workbook_is_like_does_not_matter(other):
    mechanism = changed.loads(template_text("planar-3rpr"), overrides=Overrides({"y2": "2.4"}, **other))
    assert doubts(mechanism, solve(mechanism)) == tuple(told("planar-3rpr", y2=2.4))


@pytest.mark.slow
def test_groups_of_newton_move_by_a_law():
    """Watt's sun and planet driven in so many seconds: the rows are tried before anything has a time."""
    driver = "start = 0\nstop = 720\nstep = 15"
    text = template_text("sun-and-planet")
    assert driver in text
    law = 'start = 0\nstop = 60\nmotion = { law = "cycloidal", duration = 2, rows = 5 }'
    equations = solve(loads(text.replace(driver, law)))
    assert {"omega13", "alpha14"} <= {equation.symbol for equation in equations.columns}
