"""What tests may count on: outside programs are there, or the test says what is missing (in CI that is a failure)."""

import gc
import shutil

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

gc.set_threshold(100_000, 50, 50)
"""Trees of formulas are many small objects without circles: to look for circles in them took a tenth of the time."""


def pytest_collection_modifyitems(config, items):
    """Fast ones first; what is marked `ci` runs in CI only."""
    left_out = [item for item in items if item.get_closest_marker("ci") and not IN_CI]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item not in left_out]
    items.sort(key=lambda item: item.get_closest_marker("slow") is not None)


def pytest_terminal_summary(terminalreporter):
    """What a run has not seen, in its last lines."""
    if not IN_CI:
        terminalreporter.write_line("left to CI (.ci/run): tests marked ci, and more cases where a part ran here")
    if not ALL:
        terminalreporter.write_line("left to `make full`: every template and random mechanism where a part ran here")


def pytest_runtest_setup(item):
    for name, commands in (PROGRAMS | OPTIONAL).items():
        if item.get_closest_marker(name) and not any(shutil.which(command) for command in commands):
            message = f"{name} is not installed ({commands[0]} not found)"
            if IN_CI and name in PROGRAMS:
                pytest.fail(f"{message}: CI must have it", pytrace=False)
            pytest.skip(message)
