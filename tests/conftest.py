"""What tests may count on: outside programs are there, or the test says what is missing (in CI that is a failure)."""

import gc
import os
import shutil
from collections import defaultdict

import pytest

from chosen import ALL, IN_CI

PROGRAMS = {
    "libreoffice": ("soffice", "libreoffice"),
    "gnumeric": ("ssconvert",),
    "jing": ("jing",),
    "octave": ("octave-cli", "octave"),
    "chromium": ("chromium", "chromium-browser", "google-chrome"),
}
OPTIONAL = {"latex": ("pdflatex",)}
"""Large, and what it judges is a side of the product: nowhere a must."""

os.environ["LC_ALL"] = "C.UTF-8"
"""Messages are in English, whatever the machine speaks."""

gc.set_threshold(100_000, 50, 50)
"""Trees of formulas are many small objects without circles: to look for circles in them took a tenth of the time."""


CASES_ON_QUICK = 2
"""No test runs with more cases on `make quick`: there are thousands of small ones."""


def left_to_longer_runs(items, quick):
    """Cases that do not run here, by the marks of their tests.

    slow      not in `make quick`
    ci        in CI and full runs only
    full      in full runs only
    cases(n)  n of its cases, evenly spread, where it is not a full run: no more than two on `make quick`
    """
    without = set() if ALL else {"full"} if IN_CI else {"full", "ci"}
    if quick:
        without |= {"slow", *PROGRAMS, *OPTIONAL}
    left_out = {item for item in items if without & {marker.name for marker in item.iter_markers()}}
    cases = defaultdict(list)
    for item in items:
        if quick or (item.get_closest_marker("cases") and not ALL):
            cases[item.nodeid.partition("[")[0]].append(item)
    for found in cases.values():
        mark = found[0].get_closest_marker("cases")
        count = mark.args[0] if mark else CASES_ON_QUICK
        kept = min(count, CASES_ON_QUICK) if quick else count
        left_out.update(set(found) - set(found[:: -(-len(found) // kept)]))
    return left_out


def pytest_addoption(parser):
    parser.addoption("--quick", action="store_true", help="only what is fast and needs no other program")


def pytest_collection_modifyitems(config, items):
    """Fast ones first."""
    left_out = left_to_longer_runs(items, config.getoption("--quick"))
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]
    items.sort(key=lambda item: item.get_closest_marker("slow") is not None)


def pytest_terminal_summary(terminalreporter):
    """What a run has not seen, in its last lines."""
    if terminalreporter.config.getoption("--quick"):
        terminalreporter.write_line("left to `make test`: what is marked slow or needs another program")
    if not IN_CI:
        terminalreporter.write_line("left to CI (.ci/run): tests marked ci")
    if not ALL:
        terminalreporter.write_line("left to `make full`: tests marked full, and every case where a part ran here")


def pytest_runtest_setup(item):
    for name, commands in (PROGRAMS | OPTIONAL).items():
        if item.get_closest_marker(name) and not any(shutil.which(command) for command in commands):
            message = f"{name} is not installed ({commands[0]} not found)"
            if IN_CI and name in PROGRAMS:
                pytest.fail(f"{message}: CI must have it", pytrace=False)
            pytest.skip(message)
