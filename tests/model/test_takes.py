"""Takes: each of the same motion, wherever it is computed."""

import numpy as np
import pytest
from placed import places_of

import mechsheet
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.homework.summaries import taken
from mechsheet.library.changed import loads
from mechsheet.model import TAKES
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs
from studying import in_workbook

TEXT = template_text("four-bar-forces").partition("[[charts]]")[0]
ASKED = "".join(f'z_{take} = {{ of = "T12", take = "{take}" }}\n' for take in TAKES)


def with_takes(text=TEXT):
    return text.replace("[summary]\n", f"[summary]\n{ASKED}")


def root_of_mean_square(torque):
    """Over one turn, by trapezia between its rows."""
    squares = torque**2
    return float(np.sqrt((squares[1:] + squares[:-1]).mean() / 2))


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize(("layout", "form"), [("sheets", "xlsx"), ("sheets", "ods"), ("page", "xlsx"), ("page", "ods")])
def test_the_root_mean_square_of_a_torque_heats_the_motor(layout, form, tmp_path):
    """In the file, as `check` searches it, and by hand."""
    linkage = mechsheet.loads(with_takes())
    (path,) = mechsheet.build(linkage, tmp_path / f"motor.{form}", layout=layout)
    assert mechsheet.check(path).agrees
    compiled = Compiled(loads(with_takes(), overrides=Overrides(layout=layout)))
    found = compiled.number(places_of(compiled.plan)["summary z_rms"])
    assert found == pytest.approx(root_of_mean_square(linkage.solve()["T12"]), rel=1e-12)


@pytest.mark.slow
def test_a_study_says_what_the_workbook_says():
    asked = 'heat = { of = "T12", take = "rms" }\n'
    grid = "\n[study]\nvary = { a = { values = [2.0, 1.9] }, c = { values = [9.5, 9.0] } }\n"
    mechanism = loads(TEXT.replace("[summary]\n", f"[summary]\n{asked}") + grid)
    designs = Designs(mechanism)
    found = kept_of(designs, 0, designs.sampling.total)
    assert len(found.numbers) == 4
    for number in range(4):
        values = {name: float(found.columns[name][number]) for name in ("a", "c")}
        book = in_workbook(mechanism, values, designs.modes)
        assert float(found.columns["heat"][number]) == pytest.approx(book["heat"], rel=1e-12)


@pytest.mark.parametrize("take", TAKES.values(), ids=lambda take: take.key)
def test_a_take_of_what_is_the_same_everywhere(take):
    """Is that number; a range is 0."""
    for number in (3.25, -2.0):
        found = taken(np.full(5, number), take, "number")
        assert found == {"range": 0.0, "rms": abs(number)}.get(take.key, number)


def test_no_band_for_what_does_not_change_as_its_quantity_does():
    text = template_text("four-bar").replace("[summary]\n", '[summary]\nheat = { of = "theta14", take = "rms" }\n')
    text = text.replace("a2 = { value = 35,", "a2 = { value = 35, tolerance = 0.1,")
    with pytest.raises(DescriptionError, match=r"heat.*changes as its quantity does"):
        mechsheet.loads(f'{text}\n[tolerance]\nof = ["heat"]\n')
    assert "heat" not in mechsheet.loads(f"{text}\n[tolerance]\n").bands.summaries
