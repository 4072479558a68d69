"""What a study says of a number is what the design's workbook says of it; designs of marked numbers are not compared."""

import json
import re
from collections import Counter

import numpy as np
import pytest

from chosen import ALL
from mechsheet import open_book
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.library.changed import loads
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.plan import MEANING, VALUE
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs
from mechsheet.studies.run import studied
from studying import study_of, template_text

COUNT = 60 if ALL else 6

FOUR_BAR = {
    "[driver]": "[driver]\nspeed = 3",
    "[outputs]": '[outputs]\npole = { formula = "1/(C.x-30)" }\nunsigned = { formula = "1/abs(C.x-30)" }',
    "[summary]": '[summary]\npole_max = { of = "pole", take = "max" }\npole_range = { of = "unsigned", take = "range" }\n'
    'w_max = { of = "omega14", take = "max" }\nw_range = { of = "alpha14", take = "range" }\n'
    'w_mean = { of = "omega14", take = "mean" }\nreach = { of = "C.x", take = "range" }\n'
    'whole = { of = "theta12", take = "max" }',
}
SLIDER = {
    "[driver]": "[driver]\nspeed = 3",
    "[summary]": '[summary]\nv_max = { of = "s14.v", take = "max" }\na_max = { of = "s14.a", take = "range" }\n'
    'lean = { of = "theta13", take = "range" }',
}


def with_parts(template, parts, study, rows=None):
    text = template_text(template)
    for heading, more in parts.items():
        assert f"{heading}\n" in text
        text = text.replace(heading, more, 1)
    return loads(f"{text}\n{study}", overrides=Overrides(rows=rows))


CASES = {
    "four-bar": ("four-bar", FOUR_BAR, "a2 = [15, 60], a3 = [40, 110], a4 = [30, 90]", "37"),
    "four-bar, few rows": ("four-bar", FOUR_BAR, "a2 = [15, 60], a3 = [40, 110], a4 = [30, 90]", "10"),
    "slider-crank": ("slider-crank", SLIDER, "a2 = [20, 160], a3 = [60, 220]", "25"),
}


def said_in_workbook(mechanism, values, modes):
    """The number and the remark of each summary on the first sheet of a design's workbook."""
    changes = [(name, repr(value)) for name, value in values.items()]
    compiled = Compiled(
        loads(mechanism.text, overrides=Overrides(changes + [(name, str(mode)) for name, mode in modes.items()]))
    )
    found = {}
    for name, row in compiled.plan.blocks["summary"].rows.items():
        words = str(compiled.value(Spot(compiled.plan.main, row, MEANING)))
        remark = re.search(r" \((about|or beyond|grows without bound|rows only|several stretches)\)$", words)
        found[name] = compiled.number(Spot(compiled.plan.main, row, VALUE)), remark[0] if remark else ""
    return found


def said_in_study(remarks, name):
    found = re.search(rf"(?:^|, ){re.escape(name)}( \([a-z ]+\))", remarks or "")
    return found[1] if found else ""


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_a_study_marks_what_the_workbook_marks(case):
    template, parts, vary, rows = CASES[case]
    count = COUNT if rows != "10" else COUNT // 2
    part = f'[study]\nsample = "sobol"\ncount = {count}\nseed = 5\nvary = {{ {vary} }}'
    mechanism = with_parts(template, parts, part, rows)
    designs = Designs(mechanism)
    found = kept_of(designs, 0, count)
    seen: Counter[str] = Counter()
    for place in range(count):
        values = {one: float(found.columns[one][place]) for one in designs.varied}
        try:
            book = said_in_workbook(mechanism, values, designs.modes)
        except MechsheetError:  # closes nowhere
            continue
        for name, (number, remark) in book.items():
            own, said = float(found.columns[name][place]), said_in_study(found.remarks[place], name)
            seen[remark] += 1
            assert said == remark, (name, values)
            assert np.isnan(own) == np.isnan(number), (name, values)
            if remark == " (rows only)" or name == "whole":
                assert own == pytest.approx(number, rel=1e-9, nan_ok=True), (name, values)
    assert seen[""]
    if ALL:
        assert seen[" (rows only)"]
        assert seen[" (grows without bound)"] or case == "slider-crank"


TWO_STRETCHES = '[study]\nvary = { a2 = [15, 60, 5], a3 = [40, 60, 4], a4 = [40, 60, 4] }\nkeep = ["mu_min > 5"]\n'


def test_designs_that_close_in_two_stretches_are_kept_but_not_ranked(tmp_path):
    """An angle of each stretch's rows is none of the mechanism, however good it looks; over the gap there is no swing."""
    pytest.importorskip("pyarrow")
    mechanism = study_of(TWO_STRETCHES + 'maximize = ["mu_min"]\nbest = 400')
    designs = Designs(mechanism)
    kept = kept_of(designs, 0, designs.sampling.total)
    assert 0 < kept.apart.sum() < len(kept.numbers)
    assert all("mu_min (rows only)" in text for text in kept.remarks[kept.apart])
    swings = kept.columns["swing"]
    assert {*np.flatnonzero(np.isnan(swings))} <= {*np.flatnonzero(kept.apart)}
    assert any("swing (several stretches)" in text for text in kept.remarks[kept.apart])
    found = studied(mechanism, tmp_path / "study", workers=1, formats=["xlsx", "ods"])
    apart = set((kept.numbers[kept.apart] + 1).tolist())
    assert set(found.apart.column("design").to_pylist()) == apart
    assert not apart & {*found.ranked.best.tolist(), *found.ranked.front.tolist()}
    assert len(found.ranked.best) == found.result.kept - len(apart)
    assert json.loads((tmp_path / "study" / "result.json").read_bytes())["set apart"] == len(apart)
    for form in ("xlsx", "ods"):
        book = open_book(tmp_path / "study" / f"study.{form}")
        row = [book[f"Set apart!{letter}7"] for letter in "ABCDEFGHI"]
        assert row[0] in apart
        assert any("mu_min (rows only)" in str(cell) for cell in row)
        book["Best designs!C4"] = "elsewhere"
        assert any(f"--design elsewhere:{row[0]:.0f}" in str(book[f"Set apart!{letter}7"]) for letter in "GHIJ")


def test_a_summary_that_nothing_decides_by_is_marked_and_its_design_is_compared():
    part = '[study]\nvary = { a2 = [15, 60, 5], a3 = [40, 60, 4], a4 = [40, 60, 4] }\nkeep = ["a2 > 12"]\n'
    designs = Designs(study_of(part + 'minimize = ["a3"]'))
    kept = kept_of(designs, 0, designs.sampling.total)
    assert any(kept.remarks)
    assert not kept.apart.any()


def test_a_quantity_without_bound_has_no_number_and_meets_no_condition():
    """At a limit the rocker's speed has no largest value: the probes had found 5.8 million."""
    vary = "a2 = [40, 60, 1], a3 = [80, 110, 10], a4 = [30, 50, 10]"
    every, some = (
        Designs(with_parts("four-bar", FOUR_BAR, f"[study]\nvary = {{ {vary} }}\n{more}"))
        for more in ("", 'keep = ["w_max < 1e9"]')
    )
    found = kept_of(every, 0, every.sampling.total)
    without = np.array(["w_max (grows without bound)" in (text or "") for text in found.remarks])
    assert without.sum() > 20
    assert np.isnan(found.columns["w_max"][without]).all()
    kept = kept_of(some, 0, some.sampling.total)
    assert not {*found.numbers[without]} & {*kept.numbers}


def test_dimensions_called_as_the_columns_of_a_study_are_refused_by_name():
    text = template_text("four-bar").replace("[dimensions]", "[dimensions]\nremarks = 3", 1)
    with pytest.raises(MechanismError, match='every study has a column "remarks" of its own'):
        Designs(loads(f"{text}\n[study]\nvary = {{ remarks = [3, 4, 1] }}"))
