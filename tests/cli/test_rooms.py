"""Which rooms of the house a command loads: none that it does not use, so that it starts at once."""

import subprocess
import sys

import pytest

LINE = {"arguments", "cli", "diagnostics", "on_demand", "replacing", "said", "time_limit", "version", "words"}
"""What the command line itself is made of; of `words` only which languages there are."""

DESCRIPTIONS = LINE | {"description", "formula", "model", "portable", "synthesis", "units", "words"}
WORKBOOKS = LINE | {"checking", "engine", "formats", "formula", "library", "portable"}
"""Of `checking` only how remarks are worded."""
SHEETS = DESCRIPTIONS | {"compiled", "dynamics", "evaluation", "kinematics", "library", "shapes", "sheet", "workbook"}
MECHANISMS = SHEETS | {"engine"}
"""With values: the first sheet's are the engine's."""

RARELY = {
    "mechsheet.checking.mutation": (),  # what --mutate does
    "mechsheet.description.text.typed": (),  # a text that is no TOML
    "mechsheet.library.recalculation": ("recalc",),
    "mechsheet.reference.synthesis.results": (),  # a task
    "mechsheet.sheet.asked.two_way": ("check",),  # a two-way table
}
"""Modules that the four-bar needs only for these commands."""

RUN = """
import sys
from mechsheet.cli import main
try:
    main()
finally:
    print({name for name in sys.modules if name.startswith(("mechsheet.", "livesheet."))}, file=sys.stderr)
"""


COMMANDS = {
    "--help": LINE,
    "build --help": LINE,
    "schema": DESCRIPTIONS,
    "recalc generated/four-bar.xlsx --print Mechanism!B5": WORKBOOKS,
    "recalc --check generated/four-bar.xlsx": WORKBOOKS,
    "check generated/four-bar.xlsx": MECHANISMS | WORKBOOKS | {"counted", "extras", "reference"},
    "show --equations templates/four-bar.toml": SHEETS,
    "show --dimensions templates/four-bar.toml": SHEETS,
    "show templates/four-bar.toml": MECHANISMS,
    "plot templates/four-bar.toml -o {folder}/four-bar.svg": MECHANISMS | {"extras", "plotting"},
    "build templates/four-bar.toml -o {folder}/": MECHANISMS | {"formats"},
    "export templates/four-bar.toml --to csv -o {folder}/four-bar.csv": SHEETS | {"exporting", "extras", "plotting"},
}


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_loads_no_room_that_it_does_not_use(command, tmp_path):
    arguments = command.format(folder=tmp_path).split()
    found = subprocess.run([sys.executable, "-c", RUN, *arguments], check=False, capture_output=True, text=True)
    assert found.returncode < 2  # 1: `check` has found something
    loaded = set(eval(found.stderr.splitlines()[-1]))
    assert {name.split(".")[1] for name in loaded} <= COMMANDS[command]
    wanted = {name for name, commands in RARELY.items() if command.split()[0] in commands}
    assert loaded & set(RARELY) <= wanted
