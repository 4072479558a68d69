"""Links of class III and IV in other programs: every cell, and what the first sheet says where Newton lands elsewhere."""

import pytest
from chain_workbooks import Case, Elsewhere, compared, descriptions, elsewhere, written

from chosen import ALL
from mechsheet.checking.programs import answers_to_all
from mechsheet.description.templates import template_text

pytestmark = pytest.mark.slow

COUNT, ROWS = (20, 12) if ALL else (2, 4)
PROGRAMS = ("libreoffice", "gnumeric")

MOVED = Elsewhere(template_text("stephenson-ii-class-iv"), "v", 2.2834089501311663)
"""Where Newton lands then is chance: no two programs need land in one place, all must say so."""


@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.gnumeric
def test_other_programs_compute_them(tmp_path, record_property):
    """In turn an .xlsx and an .ods; in a full run both of each."""
    given = list(descriptions(COUNT, ROWS))
    formats = [("xlsx", "ods") if ALL else (("xlsx", "ods")[number % 2],) for number in range(COUNT)]
    cases = [
        Case(text, written(text, tmp_path / f"chain-{seed}.{suffix}"))
        for (seed, text), suffixes in zip(given, formats, strict=True)
        for suffix in suffixes
    ]
    changes = [MOVED, *filter(None, (elsewhere(seed) for seed, _ in given if ALL))]
    moved = [change.written(tmp_path / f"moved-{number}.ods") for number, change in enumerate(changes)]
    paths = [*(case.path for case in cases), *moved]
    answers = {program: list(answers_to_all(program, paths)) for program in PROGRAMS}
    for comparisons in compared(cases, answers).values():
        for found in comparisons:
            record_property("worst", f"{found.judge}: {found.worst}, {found.cells} cells")
            assert found.agrees, found
    for program, values in answers.items():
        told = [change.told(each) for change, each in zip(changes, values[len(cases) :], strict=True)]
        assert all(told), (program, [change for change, fine in zip(changes, told, strict=True) if not fine])
