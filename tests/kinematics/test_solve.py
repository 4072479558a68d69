"""Mechanisms that cannot be solved, each with the exact message that names the links."""

from pathlib import Path

import pytest

from mechsheet.description import load
from mechsheet.description.report import located
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.solve import solve

FOLDER = Path(__file__).parent / "faults"
CASES = sorted(FOLDER.glob("*.toml"))


def test_there_are_cases():
    assert len(CASES) >= 10


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_message(path):
    mechanism = load(path)
    with pytest.raises(MechanismError) as caught:
        solve(mechanism)
    assert str(located(caught.value, mechanism.text, path.name)) + "\n" == path.with_suffix(".txt").read_text(
        encoding="utf-8"
    )
