"""The index of places agrees with the standard reader about which keys there are, and finds their values."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from mechsheet.description.text.index import index, key_text
from mechsheet.description.text.source import dotted

FILES = sorted(Path(__file__).parents[2].glob("*/*.toml"))

HARD = """\
# a comment with [brackets] and "quotes
title = "a # b ] } \\" = [x]" # end
'single' = 'it is a \\'
multi = \"\"\"
[not.a.table]
key = 1 \\\"\"\" still \"\"\"\"
literal = '''
x = '[1]
''''
"quoted \\u00e7 key" . "b.c" = [ 1, # one
  [ "two]", { a = 3, b.c = 4 } ], # two
  2021-05-27 07:32:00, +1_000, inf,
]
empty = []
nothing = {}
[ a . "b c" ]
x=1
[[list]]
y = { z = { w = [ { v = 1 } ] } }
[list.sub]
u = true
[[list.more]]
t = 1
[[list.more]]
t = 2
[[list]]
[list.sub]
u = false
[late.header]
v = 1
[late]
w = 2"""


def paths(data: Any, path: tuple[str | int, ...] = ()) -> dict[tuple[str | int, ...], Any]:
    """Every key and element below, with its value."""
    found = {path: data} if path else {}
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        found.update(paths(value, (*path, key)))
    return found


def check(text: str) -> None:
    data = tomllib.loads(text)
    spots = index(text)
    assert set(spots) == set(paths(data))
    for path, value in paths(data).items():
        spot = spots[path]
        if spot.how in ("value", "inline"):
            again = tomllib.loads(f"x = {text[spot.start : spot.end]}")["x"]
            assert repr(again) == repr(value)  # nan is not equal to itself


def test_there_are_files() -> None:
    assert len(FILES) > 50


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_files(path: Path) -> None:
    try:
        text = path.read_text(encoding="utf-8")
        tomllib.loads(text)
    except (ValueError, RecursionError):
        return  # broken on purpose
    check(text)


def test_hard_text() -> None:
    check(HARD)
    spots = index(HARD)
    line = {dotted(path): spot.line for path, spot in spots.items()}
    assert (line["title"], line["multi"], line["literal"]) == (2, 4, 7)
    assert line['"quoted ç key"."b.c"[2]'] == 11
    assert line['"quoted ç key"."b.c"[2][2].b.c'] == 11
    assert line['"quoted ç key"."b.c"[4]'] == 12
    assert (line["list"], line["list[2]"], line["list[1].more[2].t"], line["list[2].sub.u"]) == (18, 26, 25, 28)
    assert (line["late.header"], line["late"]) == (29, 31)


@pytest.mark.parametrize("name", ["a1", "a-b_2", "a b", "ş1", 'a"b', "a\\b", "B'", ""])
def test_a_key_as_toml_spells_it(name: str) -> None:
    assert tomllib.loads(f"{key_text(name)} = 1") == {name: 1}
