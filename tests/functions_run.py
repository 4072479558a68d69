"""A plugin of pytest for tools/tests_of.py: which functions of the package each file of tests runs.

    pytest -p functions_run --functions-run FOLDER

Every process writes one file, {file of tests: {module: [functions]}}, into the folder. A function counts as run when it is
entered, by the test or by what prepares it; what a module does when it is imported does not count.
"""

import json
import os
import sys
from collections import defaultdict
from pathlib import Path

SOURCE = str(Path(__file__).parent.parent / "src" / "mechsheet") + os.sep


def pytest_addoption(parser):
    parser.addoption("--functions-run", required=True, metavar="FOLDER")


def pytest_configure(config):
    config.pluginmanager.register(Recorder(Path(config.getoption("--functions-run"))))


class Recorder:
    """Entered functions, by file of tests."""

    def __init__(self, folder):
        self.folder = folder
        self.entered = defaultdict(set)
        self.now = set()

    def note(self, frame, event, _):
        if event == "call":
            self.now.add(frame.f_code)

    def pytest_runtest_logstart(self, nodeid):
        self.now = self.entered[nodeid.partition("::")[0]]
        sys.setprofile(self.note)

    def pytest_runtest_logfinish(self):
        sys.setprofile(None)

    def pytest_sessionfinish(self):
        found = {}
        for file, codes in self.entered.items():
            modules = defaultdict(list)
            for code in codes:
                if code.co_filename.startswith(SOURCE) and code.co_name != "<module>":
                    modules[code.co_filename.removeprefix(SOURCE)].append(code.co_qualname)
            found[file] = {module: sorted(functions) for module, functions in sorted(modules.items())}
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / f"{os.getpid()}.json").write_text(json.dumps(found), encoding="utf-8")
