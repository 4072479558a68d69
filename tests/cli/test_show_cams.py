"""Every name that a cam's mechanism has is a key of `show --json`."""

import json
import math

import pytest

from command_line import run
from folders import TEMPLATES

CAMS = sorted(TEMPLATES.glob("cam-*.toml"), key=str)


@pytest.mark.parametrize("template", CAMS, ids=lambda path: path.stem)
def test_the_cam_turns_by_both_of_its_names(template):
    """Its angle over the cam is called phi, that of the link by the link's number: both have a speed."""
    shown = run("show", template, "--json")
    assert shown.exit_code == 0, shown.output
    found = json.loads(shown.stdout)
    assert {"phi", "omega_phi", "alpha_phi"} <= set(found)
    assert found["omega_phi"] and all(map(math.isfinite, found["omega_phi"]))
