"""Nothing is said on the first sheet that nobody judges."""

import importlib
import pkgutil
from pathlib import Path

import pytest

from mechsheet.sheet import findings
from mechsheet.sheet.findings.finding import Finding

TESTS = Path(__file__).parents[2]

JUDGED_BY = {
    "AssumedInertia": "sheet/findings/test_assumed_inertia.py",
    "Agrees": "sheet/table/test_rates.py",
    "DeadCentres": "sheet/findings/claims.py",
    "EnergyChange": "sheet/columns/test_flywheel.py",
    "FlywheelInertia": "sheet/columns/test_flywheel.py",
    "LargestEffort": "sheet/table/test_forces.py",
    "LargestForce": "sheet/table/test_forces.py",
    "LargestMiss": "sheet/findings/test_task.py",
    "LargestResidual": "sheet/table/test_iterations.py",
    "LeastDeterminant": "sheet/table/test_iterations.py",
    "MeanTorque": "sheet/columns/test_flywheel.py",
    "OtherSheets": "sheet/findings/test_other_sheets.py",
    "PassesNeeded": "sheet/table/test_iterations.py",
    "SameAssembly": "sheet/table/test_start_table.py",
    "Task": "sheet/findings/test_task.py",
}
"""Findings that the search of `check` does not expect: the test that holds what they say against another way to it."""


def all_findings():
    for module in pkgutil.iter_modules(findings.__path__):
        importlib.import_module(f"{findings.__name__}.{module.name}")
    waiting = [Finding]
    while waiting:
        kind = waiting.pop()
        waiting += kind.__subclasses__()
        if not kind.__name__.startswith("_") and kind is not Finding:
            yield kind


@pytest.mark.parametrize("kind", sorted(all_findings(), key=lambda kind: kind.__name__), ids=lambda kind: kind.__name__)
def test_each_is_judged(kind):
    if kind.expected is Finding.expected:
        assert (TESTS / JUDGED_BY[kind.__name__]).is_file()
    else:
        assert kind.__name__ not in JUDGED_BY
