"""Single values written into a description's text."""

import pytest

from mechsheet.description.text.rewrite import number_text, with_number, with_value, without_key
from mechsheet.description.text.source import parse

TEXT = """\
# a description
[dimensions]
a1 = 70   # ground
a2 = { value = 35.0, label = "x # y" } # crank
a3.value = 4   # dotted
a3.unit = "mm"
a6 = { tolerance = 0.1, value = 3 }
"ş1" = 3
[dimensions.a5]
value = 0x1f   # hex
tolerance = 0.2  # here

[assembly]
B = [50, "a1"]   # as drawn
"""


@pytest.mark.parametrize(
    ("path", "value", "old", "new"),
    [
        (("a1",), 71.5, "a1 = 70   # ground", "a1 = 71.5   # ground"),
        (("a1",), 71.0, "a1 = 70   #", "a1 = 71   #"),
        (("a2", "value"), 36.0, "value = 35.0,", "value = 36.0,"),
        (("a3", "value"), -5.0, "a3.value = 4   #", "a3.value = -5   #"),
        (("a5", "value"), 32.0, "0x1f   # hex", "32   # hex"),
        (("a5", "tolerance"), 0.05, "0.2  # here", "0.05  # here"),
        (("ş1",), 1e-7, '"ş1" = 3', '"ş1" = 1e-07'),
        (("a1", "tolerance"), 0.1, "a1 = 70   #", "a1 = { value = 70, tolerance = 0.1 }   #"),
        (("a2", "tolerance"), 0.1, '"x # y" }', '"x # y", tolerance = 0.1 }'),
        (("a3", "tolerance"), 0.1, "# dotted\n", "# dotted\na3.tolerance = 0.1\n"),
    ],
)
def test_only_the_value_changes(path, value, old, new):
    assert old in TEXT
    assert with_number(parse(TEXT, "x"), ("dimensions", *path), value).text == TEXT.replace(old, new)


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        (("a6", "tolerance"), "{ tolerance = 0.1, value = 3 }", "{ value = 3 }"),
        (("a5", "tolerance"), "tolerance = 0.2  # here\n", ""),
        (("a1", "tolerance"), "a1", "a1"),
    ],
)
def test_a_key_taken_away(path, old, new):
    assert without_key(parse(TEXT, "x"), ("dimensions", *path)).text == TEXT.replace(old, new)


def test_given_and_taken_away_again():
    source = parse(TEXT, "x")
    for name in ("a2", "a3", "a5"):
        path = ("dimensions", name, "tolerance")
        once = with_number(without_key(source, path), path, 0.3)
        assert once.data["dimensions"][name]["tolerance"] == 0.3
        assert without_key(once, path).text == without_key(source, path).text


def test_elements_of_lists_and_new_tables():
    source = with_number(with_number(parse(TEXT, "x"), ("assembly", "B", 1), 55.0), ("assembly", "theta13"), 70.0)
    assert source.text.endswith("[assembly]\ntheta13 = 70\nB = [50, 55]   # as drawn\n")
    source = with_value(parse("[dimensions]\na = 1\n", "x"), ("assembly", "B"), "[1, 2]")
    assert source.data["assembly"] == {"B": [1, 2]}
    source = with_value(parse("assembly = {}\n", "x"), ("assembly", "B'"), "[1, 2]")
    assert source.data["assembly"] == {"B'": [1, 2]}


@pytest.mark.parametrize(
    ("value", "old", "text"),
    [
        (35.0, "30", "35"),
        (35.0, "30.0", "35.0"),
        (35.0, '"a1"', "35"),
        (0.1, "1", "0.1"),
        (1 / 3, "1", repr(1 / 3)),
        (-0.5, "", "-0.5"),
        (1e22, "", "1e+22"),
        (-0.0, "", "0"),
    ],
)
def test_numbers(value, old, text):
    assert number_text(value, old) == text


def test_no_number():
    with pytest.raises(ValueError, match="nan"):
        number_text(float("nan"))
