"""What tests may count on: outside programs are there, or the test says what is missing (in CI that is a failure)."""

import gc
import os
import shutil
from collections import defaultdict
from pathlib import Path

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

MEASURED = bool(os.environ.get("MECHSHEET_MEASURED"))
"""tools/slow_tests.py measures all anew."""

os.environ["LC_ALL"] = "C.UTF-8"
"""Messages are in English, whatever the machine speaks."""

gc.set_threshold(100_000, 50, 50)
"""Trees of formulas are many small objects without circles: to look for circles in them took a tenth of the time."""


CHEAP = 0.2
"""Seconds of CPU time of a case that `make quick` may afford, once, of a test whose cases together take long."""

DEAREST = 2.0
"""Seconds of CPU time of a case that runs in CI only."""

TOO_DEAR = 16.0
"""Seconds of CPU time of a case that is left to a full run: CI ends within a quarter of an hour on two cores."""

SHARE, SHARE_IN_CI = 0.6, 3.0
"""Seconds of CPU time that the cases of one test may take together; if they take more, a part of them runs."""


def slow_tests():
    """Tests that take long, all their cases together, and the seconds of one case (tools/slow_tests.py)."""
    found = {}
    for line in (Path(__file__).parent / "slow.txt").read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            seconds, cases, test = line.split()
            found[test] = float(seconds) / int(cases)
    return found


def mark_slow(items):
    """What takes long is marked slow, but for a first case that is cheap; returned are cases that do not run here."""
    seconds = slow_tests()
    cases = defaultdict(list)
    for item in items:
        cases[item.nodeid.partition("[")[0]].append(item)
    left_out = set()
    for test in cases.keys() & seconds.keys():
        found = cases[test]
        in_quick = 1 if seconds[test] <= CHEAP else 0
        for item in found[in_quick:]:
            item.add_marker("slow")
        if seconds[test] > (TOO_DEAR if IN_CI else DEAREST) and not ALL:
            left_out.update(found)
        elif not ALL:
            kept = max(1, int((SHARE_IN_CI if IN_CI else SHARE) / max(seconds[test], 1e-3)))
            left_out.update(set(found) - set(found[:: -(-len(found) // kept)]))
    return left_out


def pytest_addoption(parser):
    parser.addoption("--quick", action="store_true", help="only what is fast and needs no other program")


def pytest_collection_modifyitems(config, items):
    """Fast ones first; what is marked `ci` runs in CI only."""
    left_out = set() if MEASURED else mark_slow(items)
    without = set() if IN_CI else {"ci"}
    if config.getoption("--quick"):
        without |= {"slow", *PROGRAMS, *OPTIONAL}
    left_out |= {item for item in items if without & {marker.name for marker in item.iter_markers()}}
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]
    items.sort(key=lambda item: item.get_closest_marker("slow") is not None)


def pytest_terminal_summary(terminalreporter):
    """What a run has not seen, in its last lines."""
    if terminalreporter.config.getoption("--quick"):
        terminalreporter.write_line("left to `make test`: what is slow (tests/slow.txt) or needs another program")
    if not IN_CI:
        terminalreporter.write_line(
            "left to CI (.ci/run): tests marked ci, the dearest, and more cases where a part ran here"
        )
    if not ALL:
        terminalreporter.write_line("left to `make full`: every template and random mechanism where a part ran here")


def pytest_runtest_setup(item):
    for name, commands in (PROGRAMS | OPTIONAL).items():
        if item.get_closest_marker(name) and not any(shutil.which(command) for command in commands):
            message = f"{name} is not installed ({commands[0]} not found)"
            if IN_CI and name in PROGRAMS:
                pytest.fail(f"{message}: CI must have it", pytrace=False)
            pytest.skip(message)
