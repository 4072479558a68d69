"""Cells in runs: whatever order they are put in, what is read is what a plain dictionary holds."""

from array import array
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from chosen import examples
from livesheet.formula.book import Book, BookSheet, CellStore, DefinedName
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, Number

NUMBERS = st.integers(-9, 9).map(float)
VALUES = NUMBERS | st.sampled_from(["x", "", True, None])
ROWS, COLS = st.integers(0, 60), st.integers(0, 2)
ACTIONS = st.lists(
    st.tuples(st.just("put"), ROWS, COLS, VALUES)
    | st.tuples(st.just("numbers"), ROWS, COLS, st.lists(NUMBERS, min_size=1, max_size=9))
    | st.tuples(st.just("values"), ROWS, COLS, st.lists(VALUES, min_size=1, max_size=9))
    | st.tuples(st.just("read"), ROWS, COLS, st.none()),
    max_size=40,
)


def shown(value):
    """With its kind: 1 is not TRUE."""
    return type(value).__name__, value


def runs_are_in_order(store):
    for runs in store.columns.values():
        assert all(len(run.values) for run in runs)
        assert all(above.end <= below.row for above, below in pairwise(runs))


@settings(max_examples=examples(150), deadline=None)
@given(ACTIONS)
def test_a_store_holds_what_a_dictionary_holds(actions):
    store, cells = CellStore(), {}
    for what, row, col, value in actions:
        if what == "read":
            found = store.get(row, col)
            assert shown(found) == shown(cells.get((col, row)))
        elif what == "put":
            store.put(row, col, value)
            cells[col, row] = value
        else:
            store.extend(row, col, array("d", value) if what == "numbers" else value)
            cells.update({(col, row + offset): each for offset, each in enumerate(value)})
    copy = store.copy()
    runs_are_in_order(store)
    assert [(col, row, shown(value)) for row, col, value in store.items()] == [
        (*place, shown(cells[place])) for place in sorted(cells)
    ]
    for col in range(3):
        for row in range(70):
            assert shown(store.get(row, col)) == shown(cells.get((col, row)))
    store.put(0, 0, "changed")
    assert shown(copy.get(0, 0)) == shown(cells.get((0, 0)))


def test_numbers_filled_down_are_one_run():
    """A column of a million numbers must not be a million runs."""
    store = CellStore()
    store.extend(0, 0, array("d", [1, 2]))
    store.extend(2, 0, array("d", [3, 4]))
    store.put(4, 0, 5.0)
    store.later(5, 0, b"6 7")
    assert [(run.row, list(run.values)) for run in store.columns[0]] == [(0, [1, 2, 3, 4, 5, 6, 7])]


def test_what_is_put_later_stands_between_what_is_there():
    store = CellStore()
    store.put(0, 0, "head")
    store.later(5, 0, b"5 6")
    store.later(1, 0, b"1 2")
    store.put(9, 1, 1.0)
    assert list(store.items()) == [(0, 0, "head"), (1, 0, 1), (2, 0, 2), (5, 0, 5), (6, 0, 6), (9, 1, 1)]
    assert [store.get(row, 0) for row in range(8)] == ["head", 1, 2, None, None, 5, 6, None]


@pytest.mark.parametrize("count", [3, 40])
def test_cells_out_of_order_go_where_they_belong(count):
    store = CellStore()
    for row in reversed(range(count)):
        store.put(2 * row, 0, float(row))
    store.put(0, 0, "head")
    expected = [(0, 0, "head"), *((2 * row, 0, float(row)) for row in range(1, count))]
    assert list(store.items()) == expected


def test_hidden_rows_that_touch_are_one_part():
    sheet = BookSheet("S")
    sheet.hide(2, 4)
    sheet.hide(4, 5, by_filter=True)
    sheet.hide(7, 8)
    assert (sheet.hidden, sheet.filtered) == ([(2, 5), (7, 8)], [(4, 5)])


def test_the_formula_of_a_cell():
    sheet = BookSheet("S")
    sheet.block(1, 1, 2, 3, Number(1))
    inside = {(row, col) for row in range(6) for col in range(6) if sheet.formula_at(row, col) is not None}
    assert inside == {(1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (2, 3)}


def test_a_block_lies_on_the_sheet():
    sheet = BookSheet("S")
    sheet.block(MAX_ROWS - 1, MAX_COLUMNS - 1, 1, 1, Number(1))
    for place in ((-1, 0, 1, 1), (0, -1, 1, 1), (MAX_ROWS - 1, 0, 2, 1), (0, MAX_COLUMNS - 1, 1, 2), (0, 0, 0, 1)):
        with pytest.raises(ValueError, match="outside the sheet"):
            sheet.block(*place, Number(1))


def test_cells_that_keep_their_stored_values():
    sheet = BookSheet("S")
    for row, col in ((1, 1), (1, 2), (2, 1), (3, 1), (1, 3)):
        sheet.cached.put(row, col, float(10 * row + col))
    sheet.keep([(1, 1, 2, 2)])
    assert list(sheet.constants.items()) == [(1, 1, 11), (2, 1, 21), (1, 2, 12)]


def test_a_sheet_s_own_name_goes_before_the_book_s():
    names = [
        DefinedName("rate", Number(1)),
        DefinedName("Rate", Number(2), "Data"),
        DefinedName("other", Number(3), "S"),
    ]
    book = Book([], names=names)
    assert book.name("RATE") is names[0]
    assert book.name("rate", "data") is names[1]
    assert book.name("rate", "S") is names[0]
    assert book.name("other") is None
