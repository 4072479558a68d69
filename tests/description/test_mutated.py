"""Descriptions damaged as people damage them: each works, or says with file and line what is wrong; nothing tracebacks."""

import warnings

import pytest

from chosen import IN_CI
from livesheet.diagnostics import Fault
from mechsheet.description import loads
from mechsheet.description.locate import located
from mechsheet.description.templates import template_names, template_text
from mechsheet.diagnostics import DescriptionError, DescriptionWarning, MechanismError
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.sketched import doubts
from mechsheet.library.building import compile_workbook
from mechsheet.sheet.layout import lay_out
from mutations import DAMAGES, mutated

FILE = "mine.toml"
TEXTS = [template_text(name) for name in template_names()]
EACH = 3 if IN_CI else 1
"""Damaged copies of each template; 70 of each (2,000 in all) have been run once."""


def outcome(text: str, whole: bool = False) -> str:
    """ "works", or the kind of error; anything but an error of the description goes through."""
    try:
        mechanism = loads(text, FILE)
    except DescriptionError as error:
        check(error.faults)
        return "description"
    try:
        equations = solve(mechanism)
        doubts(mechanism, equations)
        if whole:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DescriptionWarning)
                compile_workbook(mechanism)
        else:
            lay_out(mechanism, equations)
    except MechanismError as error:
        check(located(error, mechanism.text, FILE).faults)
        return "mechanism"
    assert loads(mechanism.text, FILE) == mechanism
    return "works"


def check(faults: tuple[Fault, ...]) -> None:
    assert faults
    for fault in faults:
        assert fault.file == FILE
        assert fault.message
        assert "BAD" not in str(fault)
        # What is not there at all has no line, nor has a file that is no text.
        assert fault.line or "is missing" in fault.message or "too deep" in fault.message, fault


@pytest.mark.cases(31)
@pytest.mark.parametrize("place", range(len(TEXTS)), ids=template_names())
def test_damaged(place: int) -> None:
    for seed in range(EACH):
        outcome(mutated(TEXTS[place], 1000 * place + seed), whole=seed == 3)


@pytest.mark.slow
def test_the_damages_do_damage() -> None:
    """Every kind of damage changes the text, and they do not all end alike."""
    import random

    assert all(any(damage(TEXTS[6], random.Random(seed)) != TEXTS[6] for seed in range(9)) for damage in DAMAGES)
    found = {outcome(mutated(TEXTS[6], seed)) for seed in range(40)}
    assert {"works", "description"} <= found
