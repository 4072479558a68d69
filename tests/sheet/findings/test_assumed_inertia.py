"""A mass that turns unevenly without a moment of inertia: an amber line, which follows the cells."""

import pytest

import mechsheet

TEXT = mechsheet.template("four-bar").text.replace(
    'label = { en = "coupler", tr = "biyel" }',
    'label = { en = "coupler", tr = "biyel" }\nmass = 1\ncenter = "B"',
)


def lines(book):
    """The first sheet's lines about it: value, words, mark."""
    rows = [row for row in range(20, 90) if book[f"Mechanism!A{row}"] == "moments of inertia"]
    return [tuple(book[f"Mechanism!{column}{row}"] for column in "BEF") for row in rows]


@pytest.fixture
def built(tmp_path):
    def build(text):
        path = tmp_path / "mine.toml"
        path.write_text(text, encoding="utf-8")
        (book,) = mechsheet.build(mechsheet.load(path), tmp_path / "mine.xlsx")
        return mechsheet.open_book(book)

    return build


def test_it_is_amber_until_the_cell_has_a_number(built):
    book = built(TEXT.replace('link = "crank"\nstart', 'link = "crank"\nspeed = "60 rpm"\nstart'))
    assert lines(book) == [(1.0, "not given, 0 taken, of what turns unevenly: coupler", "▲")]
    book.set("J_3", 0.001)
    assert lines(book) == [(0.0, "of every link that turns unevenly", "")]


def test_at_rest_and_where_it_is_given_there_is_none(built):
    assert lines(built(TEXT)) == []
    assert lines(built(TEXT.replace("mass = 1\n", "mass = 1\ninertia = 0\n"))) == []
