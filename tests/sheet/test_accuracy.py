"""Near dead centres the workbook loses no more digits than its inputs do: a part of `benchmarks/accuracy.py`."""

import importlib.util
import sys

import pytest

from folders import ROOT

pytest.importorskip("mpmath")


def _load():
    spec = importlib.util.spec_from_file_location("accuracy_study", ROOT / "benchmarks/accuracy.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


ACCURACY = _load()
STUDIES = {study.name: study for study in ACCURACY.studies()}


@pytest.mark.parametrize("name", STUDIES)
def test_error_is_that_of_the_inputs(name):
    """Down to 1e-9 degrees from a dead centre the error is at most a few times what half a unit in the last place of an
    input changes; where that leaves 1e-13, the error is below 1e-12."""
    for distance, error, floor, _ in ACCURACY.measure(STUDIES[name]):
        assert error <= 5 * floor + 1e-15, (distance, error, floor)
        assert error < 1e-12 or floor > 1e-13, (distance, error, floor)


def test_half_angles_keep_the_digits_that_acos_loses():
    """At the ends of a slider's stroke the rod lies along the guide: the rod's angle by its cosine is off by 1e-9."""
    rows = ACCURACY.measure(STUDIES["slider-crank, end of the stroke"])
    assert max(error for _, error, _, _ in rows) < 1e-15
    assert max(textbook for *_, textbook in rows) > 1e-9
