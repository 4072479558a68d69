"""`show --dimensions`: every dimension by name; results of a synthesis exact, nothing where its task has no solution."""

import json

import pytest

from mechsheet.description import Overrides
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.library.changed import loads
from mechsheet.library.show import dimensions_json, dimensions_text


def dimensions(name, overrides=()):
    return json.loads(dimensions_json(loads(template_text(name), name, Overrides(overrides))))


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
    ("name", "values", "found"),
    [
        # another way in place of the one that is written: swing 80, time ratio 10/9, a1 = 120 (goessner/crocker)
        ("crank-rocker-swing", {"a2": "60"}, {"a2": 60, "a3": 103.196, "a4": 93.9645}),
        ("crank-rocker-swing", {"lam": "2"}, {"lam": 2, "a2": 54.5429, "a3": 109.0857}),
        ("crank-rocker-swing", {"lam": "2", "best": "true"}, {"a2": 46.6704}),
        ("crank-rocker-swing", {"phi": "190", "lam": "3"}, {"phi": 190, "time_ratio": 190 / 170}),
        ("quick-return-slider", {"c": "20"}, {"c": 20, "a2": 48.5409}),
        ("rigid-body-guidance", {"A.moving": "[-0.845512, 0.533343]"}, {"x_A0": -1.712, "y_A0": 0.033}),
        # what it does not say
        ("function-generator", {"round": "0.5"}, {"a2": 11.349735, "round_to": 0.5}),
    ],
)
def test_what_a_task_does_not_say_can_be_set(name, values, found):
    given = dimensions(name, values)
    for symbol, value in found.items():
        assert given[symbol] == pytest.approx(value, rel=1e-4), symbol


def test_the_text_says_then_what_was_set_and_nothing_that_excludes_it():
    text = loads(template_text("crank-rocker-swing"), "c.toml", Overrides({"a2": "60", "round": "0.1"})).text
    assert "a2 = 60" in text
    assert "round = 0.1" in text
    assert "best" not in text.partition("[dimensions]")[0].partition("[synthesis]")[2]


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("best", "true", "no dimension"),  # of another kind
        ("rund", "3", 'did you mean "round"'),
        ("a2", "3", "is found by the synthesis"),
        ("theta.4", "3", "no dimension"),
        ("theta", "4", "expected a list of numbers"),
        ("a1", "[3]", "expected a number"),
        ("psi", "[60, 80]", "has 2 angles for 3"),
        ("mode_1", "-1", "is found by the synthesis"),
        ("x", "3", "expected a list of numbers"),
        ("round", "-1", "must be greater than 0"),
    ],
)
def test_what_cannot_be_changed_is_told(name, value, told):
    with pytest.raises(DescriptionError, match=told):
        loads(template_text("function-generator"), "f.toml", Overrides({name: value}))


@pytest.mark.parametrize(("name", "value", "told"), [("best", "no", "expected true"), ("A.moving", "[1, 2]", "no dim")])
def test_a_choice_is_true(name, value, told):
    with pytest.raises(DescriptionError, match=told):
        loads(template_text("crank-rocker-swing"), "c.toml", Overrides({name: value}))


def test_the_table_says_what_is_used_of_the_assembly_too():
    lines = dimensions_text(loads(template_text("function-generator"))).splitlines()
    assert next(line for line in lines if line.startswith("mode")).split()[1:3] == ["1", "1"]


def test_the_heading_is_in_the_language_of_the_description():
    text = template_text("function-generator") + '[workbook]\nlanguage = "tr"\n'
    assert dimensions_text(loads(text)).splitlines()[0].split() == ["Simge", "Değer", "kullanılan", "Birim"]
