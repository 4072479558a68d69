"""A mass that turns unevenly without a moment of inertia: an amber line, which follows the cells."""

import pytest

import mechsheet

TEXT = mechsheet.template("four-bar").text.replace(
    'label = { en = "coupler", tr = "biyel" }',
    'label = { en = "coupler", tr = "biyel" }\nmass = 1\ncenter = "B"',
)


RUNNING = TEXT.replace('link = "crank"\nstart', 'link = "crank"\nspeed = "60 rpm"\nstart')
MISSING = "not given, 0 taken, of what turns unevenly: coupler"
GIVEN = "of every link that turns unevenly"
COLUMNS = {"sheets": "BEF", "page": "BD"}

pytestmark = pytest.mark.slow


@pytest.fixture
def built(tmp_path):
    def build(text, layout="sheets"):
        (book,) = mechsheet.build(mechsheet.loads(text, "mine"), tmp_path / "mine.xlsx", layout=layout)
        return mechsheet.open_book(book)

    return build


def lines(book, layout="sheets"):
    """The first sheet's lines about it: value, words, and on several sheets the mark."""
    rows = [row for row in range(10, 90) if book[f"Mechanism!A{row}"] == "moments of inertia"]
    return [tuple(book[f"Mechanism!{column}{row}"] for column in COLUMNS[layout]) for row in rows]


def test_it_is_amber_until_the_cell_has_a_number(built):
    book = built(RUNNING)
    assert lines(book) == [(1.0, MISSING, "▲")]
    book.set("J_3", 0.001)
    assert lines(book) == [(0.0, GIVEN, "")]


@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_the_line_under_the_title_names_it_until_then(built, layout):
    book = built(RUNNING, layout)
    title = book["Mechanism!A2"]
    assert title.endswith(f"; moments of inertia {MISSING}")
    assert lines(book, layout)[0][:2] == (1.0, MISSING)
    book.set("J_3", 0.001)
    assert book["Mechanism!A2"] == title.removesuffix(f"; moments of inertia {MISSING}")
    assert lines(book, layout)[0][:2] == (0.0, GIVEN)


def test_at_rest_and_where_it_is_given_there_is_none(built):
    assert lines(built(TEXT)) == []
    assert lines(built(TEXT.replace("mass = 1\n", "mass = 1\ninertia = 0\n"))) == []


BLOCK = """
format = 1
mechanism.name = "block"
links.ground.points = { O = [0, 0], P = [90, 0] }
links.crank.points = { O = [0, 0], A = [40, 0] }
links.arm.points = { P = [0, 0] }
links.block = { points = { A = [0, 0] }, mass = 1 }
joints = [{ type = "prismatic", link = "block", on = "arm", point = "A", through = "P", symbol = "u" }]
driver = { link = "crank", start = 0, stop = 360, step = 30, speed = "60 rpm" }
"""


@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_a_block_that_turns_with_its_guide_has_the_line_too(built, layout):
    """Its angular velocity is the guide's, and has no column of its own but for this line."""
    book = built(BLOCK, layout)
    assert lines(book, layout)[0][:2] == (1.0, "not given, 0 taken, of what turns unevenly: block")
