"""The slips of the text (docs/errata.md) on plain workbooks: the audit finds each by itself, where it is, and mends it."""

from __future__ import annotations

from dataclasses import replace

import pytest

import mechsheet
from homework.plain_export import plain_book
from livesheet.formula.parser import parse_formula
from livesheet.formula.references import area_name
from mechsheet import description
from mechsheet.homework.audit import audited
from mechsheet.homework.expected_values import asked_of
from mechsheet.homework.formula_strips import upright

pytestmark = pytest.mark.slow

SLIPS = {
    "2: C.x with theta14": (
        "four-bar",
        {"C.x": 1, "C.y": 1},
        ("N17:N41", "C17+$B$6*COS(J17+$B$8)", "C17+$B$6*COS(M17+$B$8)"),
        {"C.x": "wrong", "C.y": "right"},
    ),
    "3: gamma3 as the angle ABC": (
        "four-bar",
        {"theta13": 1, "C.x": 1, "C.y": 1},
        ("B8", "ACOS(($B$4^2+$B$7^2-$B$6^2)/(2*$B$4*$B$7))", "ACOS(($B$4^2+$B$6^2-$B$7^2)/(2*$B$4*$B$6))"),
        {"theta13": "right", "C.x": "follows", "C.y": "follows"},
    ),
    "5: the pump's sign of s1": (
        "adjustable-pump",
        {"s15": 1, "theta14": 1},
        ("F19:F37", "D19+$B$7", "D19-$B$7"),
        {"s15": "follows", "theta14": "follows"},
    ),
    "7: the other root of theta13": (
        "slider-crank",
        {"theta13": 1, "s14": 1, "C.x": 1},
        ("I13:I37", "ASIN((D13-$B$2)/$B$4)", "PI()-ASIN((D13-$B$2)/$B$4)"),
        {"theta13": "wrong", "s14": "right", "C.x": "follows"},
    ),
    "10: the sign of B0's ordinate": (
        "six-link-dwell",
        {"theta14": 1, "theta16": 1},
        ("B40", "-$B$4*SIN($B$12)", "$B$4*SIN($B$12)"),
        {"theta14": "follows", "theta16": "follows"},
    ),
}
"""template, what is asked, (cells, the slip, the mend), verdicts; errata 1 has a table of its own in `test_audit.py`."""


@pytest.mark.cases(1)
@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_of_the_text_is_found_and_mended(slip):
    name, asked, (cells, wrong, mend), verdicts = SLIPS[slip]
    lines = ", ".join(f'"{symbol}" = {marks}' for symbol, marks in asked.items())
    mechanism = description.loads(f"{mechsheet.template(name).text}\n[exercise]\nasked = {{ {lines} }}\n", name)
    book = plain_book(mechanism)
    (sheet,) = book.sheets
    place = next(n for n, b in enumerate(sheet.blocks) if area_name(b.row, b.col, b.rows, b.cols) == cells)
    sheet.blocks[place] = replace(sheet.blocks[place], formula=parse_formula(wrong))
    found = audited(upright(book), mechanism, asked_of(mechanism), name)
    assert [(fault.cells, fault.mend) for fault in found.faults] == [(f"{sheet.title}!{cells}", mend)]
    assert {symbol: one.verdict for symbol, one in found.asked.items()} == verdicts
