"""A plugin of pytest for tools/slow_tests.py: the CPU time of each test, of the processes that it starts as well.

    pytest -p cpu_of_tests --cpu-of-tests FOLDER

Every process writes a line for each test into a file of its own: seconds, and the test without its parameters. CPU time
and not what a clock says: the same on a busy machine.
"""

import os
from pathlib import Path

import pytest


def pytest_addoption(parser):
    parser.addoption("--cpu-of-tests", required=True, metavar="FOLDER")


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item):
    before = sum(os.times()[:4])
    yield
    folder = Path(item.config.getoption("--cpu-of-tests"))
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / f"{os.getpid()}.txt").open("a", encoding="utf-8") as file:
        file.write(f"{sum(os.times()[:4]) - before:.3f} {item.nodeid.partition('[')[0]}\n")
