"""Which rooms of the house a command loads: none that it does not use, so that it starts at once."""

import subprocess
import sys

import pytest

LINE = {"arguments", "cli", "diagnostics", "on_demand", "replacing", "said", "time_limit", "words"}
"""What the command line itself is made of; of words the list of languages, no catalogue."""

DESCRIPTIONS = LINE | {"description", "formula", "model", "portable", "synthesis", "units", "words"}
WORKBOOKS = LINE | {"checking", "engine", "extras", "formats", "formula", "library", "portable"}
MECHANISMS = DESCRIPTIONS | {
    "compiled",
    "dynamics",
    "kinematics",
    "library",
    "shapes",
    "sheet",
    "workbook",
    "evaluation",
}

RUN = """
import sys
from mechsheet.cli import main
try:
    main()
finally:
    print({name.split(".")[1] for name in sys.modules if name.startswith(("mechsheet.", "livesheet."))}, file=sys.stderr)
"""


COMMANDS = {
    "--help": LINE,
    "build --help": LINE,
    "schema": DESCRIPTIONS,
    "recalc generated/four-bar.xlsx --print Mechanism!B5": WORKBOOKS,
    "recalc --check generated/four-bar.xlsx": WORKBOOKS,
    "check generated/four-bar.xlsx": MECHANISMS | WORKBOOKS | {"counted", "reference"},
    "show --equations templates/four-bar.toml": MECHANISMS,
    "show --dimensions templates/four-bar.toml": MECHANISMS,
}


def test_build_loads_no_exports(tmp_path):
    command = [sys.executable, "-c", RUN, "build", "templates/four-bar.toml", "-o", f"{tmp_path}/"]
    found = subprocess.run(command, capture_output=True, text=True, check=True)
    assert set(eval(found.stderr.splitlines()[-1])) <= MECHANISMS | WORKBOOKS - {"checking"}


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_loads_no_room_that_it_does_not_use(command):
    found = subprocess.run([sys.executable, "-c", RUN, *command.split()], capture_output=True, text=True, check=True)
    loaded = set(eval(found.stderr.splitlines()[-1]))
    assert loaded <= COMMANDS[command]
