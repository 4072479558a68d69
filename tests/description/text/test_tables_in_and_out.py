"""Tables that are written into a description, and taken out of it."""

import pytest

from mechsheet.description.text.rewrite import with_last_key, with_table, without_table
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import DescriptionError

TEXT = """\
# a description
[dimensions]
a2 = 30  # crank

# the ground
[links.ground]
points = { A0 = [0, 0] }
# the crank
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }  # driven

# where it was drawn
[assembly]
A = [20, 20]
"""


def test_a_link_goes_behind_the_last_one():
    new = with_table(parse(TEXT, "x"), ("links", "rod"), ["points = { A = [0, 0] }"]).text
    assert new == TEXT.replace("# driven\n", "# driven\n[links.rod]\npoints = { A = [0, 0] }\n")


def test_a_table_of_another_kind_stands_in_the_order_of_the_manual():
    new = with_table(parse(TEXT, "x"), ("driver",), ['link = "crank"']).text
    assert new == TEXT.replace("# driven\n", '# driven\n\n[driver]\nlink = "crank"\n')


def test_joints_are_counted():
    source = parse(TEXT, "x")
    for number in range(2):
        source = with_table(source, ("joints", number), [f'type = "{number}"'])
    assert [joint["type"] for joint in source.data["joints"]] == ["0", "1"]
    assert without_table(source, ("joints", 0)).data["joints"] == [{"type": "1"}]
    assert without_table(without_table(source, ("joints", 1)), ("joints", 0)).text == TEXT


@pytest.mark.parametrize("path", [("links", "crank"), ("assembly",), ("dimensions",)])
def test_what_is_taken_out_leaves_all_else(path):
    source = without_table(parse(TEXT, "x"), path)
    there = source.data
    for key in path[:-1]:
        there = there[key]
    assert path[-1] not in there
    comments = [line for line in TEXT.splitlines() if line.startswith("#")]
    assert [line for line in source.text.splitlines() if line.startswith("#")] == comments
    assert "\n\n\n" not in source.text


def test_nothing_is_taken_out_where_nothing_stands():
    source = parse(TEXT, "x")
    assert without_table(source, ("links", "other")) is source


@pytest.mark.parametrize(
    ("table", "there"),
    [
        (("dimensions",), "a2 = 30  # crank\nb = 1\n"),
        (("assembly",), "A = [20, 20]\nb = 1\n"),
        (("workbook",), "[workbook]\nb = 1\n"),
    ],
)
def test_a_new_key_stands_last(table, there):
    assert there in with_last_key(parse(TEXT, "x"), table, "b", "1").text


def test_tables_on_one_line_are_refused_with_their_line():
    with pytest.raises(DescriptionError) as told:
        with_table(parse("links = { ground = { points = {} } }", "x"), ("links", "rod"), [])
    assert told.value.faults[0].line == 1
    with pytest.raises(DescriptionError, match="one line"):
        with_table(parse("joints = [ { type = 'gear' } ]", "x"), ("joints", 1), [])
