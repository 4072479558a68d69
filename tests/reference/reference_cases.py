"""Mechanisms for the tests of the reference."""

from pathlib import Path
from textwrap import dedent

from mechsheet.description import loads

TESTS = Path(__file__).parents[1]
CASES = TESTS / "cases" / "reference"
EXAMPLES = TESTS / "data"
PUBLISHED = TESTS / "data" / "published"


def read(name, folder=CASES):
    """A description by the name of its file."""
    return loads((folder / f"{name}.toml").read_text(encoding="utf-8"))


def mechanism(text):
    """A description without its head."""
    return loads('format = 1\nmechanism = { name = "test" }\n' + dedent(text))
