"""`show --dimensions`: every dimension by name; results of a synthesis exact, nothing where its task has no solution."""

import json

import pytest

from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.library.changed import loads
from mechsheet.library.dimensions import dimensions_json, dimensions_text


def dimensions(name, overrides=None):
    return json.loads(dimensions_json(loads(template_text(name), name, overrides)))


def test_given_and_derived():
    found = dimensions("four-bar")
    assert found["a1"] == 70
    assert found["gamma3"] == pytest.approx(35.538207204)


def test_results_of_a_synthesis_are_exact_though_the_mechanism_uses_rounded_ones():
    text = template_text("function-generator").replace("a1 = 100\n", "a1 = 100\nround = 0.5\n")
    mechanism = loads(text)
    assert json.loads(dimensions_json(mechanism))["a2"] == pytest.approx(11.349735218)
    assert next(line for line in dimensions_text(mechanism).splitlines() if line.startswith("a2 ")).split()[1:3] == [
        "11.3497",
        "11.5",
    ]


def test_a_task_without_a_solution_gives_nothing():
    found = dimensions("function-generator", {"theta.2": "45"})
    assert found["theta_p2"] == 45
    same = dimensions("function-generator", {"theta": "[45, 45, 135]", "psi": "[60, 60, 100]"})
    assert [same[name] for name in ("a1", "a2", "a3", "a4", "theta_offset", "psi_offset", "mode")] == [None] * 7


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("a2", "3", "is found by the synthesis"),
        ("theta.4", "3", "no dimension"),
        ("theta", "4", "expected a list of numbers"),
        ("a1", "[3]", "expected a number"),
        ("psi", "[60, 80]", "has 2 angles for 3"),
        ("mode_1", "-1", "is found by the synthesis"),
    ],
)
def test_what_cannot_be_changed_is_told(name, value, told):
    with pytest.raises(DescriptionError, match=told):
        loads(template_text("function-generator"), "f.toml", {name: value})
