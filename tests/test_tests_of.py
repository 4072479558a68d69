"""tests/README.md: which tests a module has."""

import sys
from pathlib import Path

TESTS = Path(__file__).parent
sys.path.append(str(TESTS.parent / "tools"))

import tests_of  # noqa: E402


def test_every_module_without_tests_of_its_own_is_listed():
    """A new module either has tests named as it, or tools/tests_of.py --measure is run."""
    listed = tests_of.listed()
    assert {
        str(module) for module in tests_of.modules() if not tests_of.own(module) and str(module) not in listed
    } == set()


def test_what_is_listed_is_there():
    there = {module.as_posix() for module in tests_of.modules()}
    for module, files in tests_of.listed().items():
        assert module in there, f"{module} is no more: python tools/tests_of.py --measure"
        assert [file for file in files if not (TESTS / file).exists()] == [], module
