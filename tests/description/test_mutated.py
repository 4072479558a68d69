"""Descriptions damaged as people damage them: each works, or says with file and line what is wrong; nothing tracebacks."""

import re
import warnings

import pytest

from chosen import ALL
from livesheet.diagnostics import Fault
from mechsheet.description import loads
from mechsheet.description.report import located
from mechsheet.description.templates import template_names, template_text
from mechsheet.diagnostics import DescriptionError, DescriptionWarning, MechanismError
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.library.building import compile_workbook
from mechsheet.sheet.layout import lay_out
from mutations import DAMAGES, mutated

FILE = "mine.toml"
TEXTS = [template_text(name) for name in template_names()]
EACH = 3 if ALL else 1
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


NUMBER = re.compile(r"""(?<![\w.\-+])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])""")
"""A number of a description's line, once its texts are blanked."""
TEXT_OR_COMMENT = re.compile(r"""'[^']*'|"[^"]*"|#.*""")
NOT_NUMBERS = ("nan", "inf", "-inf")
"""What TOML takes as a number and no mechanism can have."""


def numbers_of(text: str) -> list[tuple[int, int, int]]:
    """(line from 1 on, begin, end) of every number of a description that is none of a text."""
    blanked = [TEXT_OR_COMMENT.sub(lambda part: '"' * len(part[0]), line) for line in text.splitlines()]
    return [(row, *one.span()) for row, line in enumerate(blanked, 1) for one in NUMBER.finditer(line)]


def with_words(text: str, places: list[tuple[int, int, int]], word: str) -> str:
    """The description with a word for each of these numbers."""
    lines = text.splitlines()
    for row, begin, end in reversed(places):
        lines[row - 1] = lines[row - 1][:begin] + word + lines[row - 1][end:]
    return "\n".join(lines)


@pytest.mark.parametrize("text", TEXTS, ids=template_names())
def test_no_field_takes_nan_or_infinity(text: str) -> None:
    """One in each number of a template by turns, then in all at once: every line that has one is told, with its key."""
    places = numbers_of(text)
    single = places if ALL else places[:: max(1, len(places) // 5)]
    cases = [([place], NOT_NUMBERS[number % 3]) for number, place in enumerate(single)]
    for damaged, word in [*cases, *((places, word) for word in NOT_NUMBERS)]:
        with pytest.raises(DescriptionError) as refused:
            loads(with_words(text, damaged, word), FILE)
        check(refused.value.faults)
        told = {fault.line for fault in refused.value.faults if f"found {word}" in fault.message}
        assert {row for row, _, _ in damaged} <= told, (damaged, word)
