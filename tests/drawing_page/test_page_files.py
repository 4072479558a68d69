"""The page's files: small, without any address elsewhere, every word in both languages."""

import re
from pathlib import Path

import pytest

import mechsheet
from catalogues import pairs

DRAWING_PAGE = pairs("draw.")

PAGE = Path(mechsheet.__file__).parent / "drawing_page" / "page"
FILES = sorted(PAGE.iterdir())
LARGEST = 300_000


def test_the_page_is_small():
    assert sum(path.stat().st_size for path in FILES) < LARGEST


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_nothing_comes_from_elsewhere(path):
    """No network: the only address is the name of a vocabulary, which nobody fetches."""
    found = set(re.findall(r"(?:https?:)?//[\w.-]+\.\w+[\w./-]*", path.read_text(encoding="utf-8")))
    assert found <= {"http://www.w3.org/2000/svg"}
    assert "eval(" not in path.read_text(encoding="utf-8")


def keys_used():
    """Keys of words in the page: as they stand, and what templates of them can become."""
    exact, begins = set(), set()
    for path in FILES:
        text = path.read_text(encoding="utf-8")
        exact |= set(re.findall(r'(?:word\("|data-(?:word|hint|label)=")([\w.]+)"', text))
        begins |= set(re.findall(r"word\(`([\w.]+)\$", text))
    return exact, begins


def test_every_word_of_the_page_is_there():
    exact, begins = keys_used()
    assert len(exact) > 50
    assert exact - set(DRAWING_PAGE) == set()
    assert all(any(key.startswith(begin) for key in DRAWING_PAGE) for begin in begins)


def test_no_word_lies_about():
    exact, begins = keys_used()
    text = "".join(path.read_text(encoding="utf-8") for path in FILES)
    made = (*begins, "impossible.", "label.")
    unused = {key for key in set(DRAWING_PAGE) - exact if not key.startswith(made) and f'"{key}"' not in text}
    assert unused <= {key for key in DRAWING_PAGE if key.startswith("tool.")} | {"empty", "play", "pause"}


@pytest.mark.parametrize("key", DRAWING_PAGE)
def test_both_languages_have_the_same_holes(key):
    holes = [sorted(re.findall(r"\{(\w+)\}", text)) for text in DRAWING_PAGE[key]]
    assert holes[0] == holes[1]
    assert all(text.strip() for text in DRAWING_PAGE[key])


TOOLS = "shape turn ground link plate slider slot driver gear spring damper force torque mass delete scale"


@pytest.mark.parametrize("name", TOOLS.split())
def test_every_tool_says_what_to_do(name):
    """A line for each of its clicks, or what it is for."""
    assert any(key.startswith(f"tool.{name}.") for key in DRAWING_PAGE)
