"""Sessions: inputs set and values read, always what a full recalculation gives."""

import math
import re
import shutil
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mechsheet
from chosen import examples
from folders import ROOT
from livesheet.diagnostics import WorkbookError
from livesheet.engine import Live, Plan, compile_book
from livesheet.engine import incremental as incremental_module
from livesheet.engine.fast.cell_code import CellCodes
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from livesheet.time_limit import TimeLimitError
from mechsheet.library.session import Session

ROWS = 40
NA = ErrorValue("#N/A")


def sheet_of_everything():
    """Inputs in B1:B4 (named), data in column D; columns of every kind that the engine computes in its own way."""
    builder = BookBuilder("book.xlsx")
    sheet = builder.sheet("S")
    for row, value in enumerate([2.0, 0.5, "text", 7.0]):
        sheet.constant(row, 1, value)
        builder.name(f"in_{row + 1}", parse_formula(f"S!$B${row + 1}"))
    builder.name("curve", parse_formula(f"S!$F$6:$F${ROWS + 5}"))
    sheet.constants.extend(5, 3, [0.1 * row for row in range(ROWS)])
    fills = [
        "D6*in_1", "SIN(E6)+in_2", "1/(F6-in_4)", 'IF(in_3="text",D6,-D6)', "IF(ISNUMBER(G6),H6,in_1)", "D6&in_3",
        "SUM(D$6:D6)*in_2", 'IF(F6>0,"up","down")',
    ]  # fmt: skip
    for col, text in enumerate(fills, 4):
        sheet.block(5, col, ROWS, 1, parse_formula(text))
    sheet.constant(4, 12, 0.0)
    sheet.constant(4, 13, 1.0)
    sheet.block(5, 12, ROWS, 1, parse_formula("M5+E6"))
    sheet.block(5, 13, ROWS, 1, parse_formula("IF(F6>in_2,F6,N5)"))
    sheet.block(5, 14, ROWS, 3, parse_formula("$D6*O$5+$B$1"))
    sheet.constants.extend(4, 14, [1.0])
    sheet.constants.extend(4, 15, [-2.0])
    sheet.constants.extend(4, 16, [0.25])
    sheet.block(0, 18, 1, 1, parse_formula("SUM(E6:E45)+COUNT(S!$D$1:$D$99)"))
    sheet.block(1, 18, 1, 1, parse_formula("S1&in_3"))
    sheet.block(2, 18, 1, 1, parse_formula("MATCH(in_1,D6:D45,1)+IF(ISBLANK(in_4),100,0)"))
    sheet.block(3, 18, 1, 1, parse_formula("Z9+1"))  # an empty cell
    sheet.block(4, 18, 2, 1, parse_formula("S4*2"))
    sheet.block(0, 20, 9, 1, parse_formula("V2+in_1"))  # two columns that read each other
    sheet.block(0, 21, 9, 1, parse_formula("IF(ROW()>4,in_2,U3)"))
    return builder.build()


BOOK = sheet_of_everything()
AREAS = ["S!E6:E45", "curve", "S!G6:G45", "S!A1:V45", "S!S1", "S!S2", "S!S3", "S!M45", "S!O6:Q45", "S!U1:V9", "S!S4:S6"]
CELLS = ["in_1", "in_2", "in_3", "in_4", "S!D6", "S!D20", "S!D45", "S!M5", "S!P5", "S!Z9"]
INPUTS = st.one_of(
    st.floats(-3, 3), st.sampled_from([0.0, -0.0, 1e308, 1e-300, "text", "x", "3", "", True, None, NA, 2.0])
)
CHANGES = st.lists(
    st.one_of(
        st.tuples(st.just("set"), st.sampled_from(CELLS), INPUTS),
        st.tuples(st.just("get"), st.sampled_from(AREAS), st.none()),
        st.tuples(st.just("reset"), st.sampled_from(CELLS[:9]), st.none()),
    ),
    max_size=12,
)


def bits(values):
    """Values that can be compared to the last bit."""
    return [[np.float64(v).tobytes() if isinstance(v, float) else v for v in row] for row in values]


def place_of(where):
    """A cell of BOOK as (sheet, row, column)."""
    found = re.fullmatch(r"S!([A-Z])(\d+)", where)
    return ("S", int(found[2]) - 1, ord(found[1]) - 65) if found else ("S", int(where[-1]) - 1, 1)


WARM = compile_book(BOOK)
BOOK_VALUES = WARM.evaluate()
AREA_OF = {where: Session(BOOK)._area(where) for where in AREAS}


@pytest.fixture(params=["code at once", "interpreted first"], scope="module")
def patience(request):
    """When single cells get code of their own."""
    with pytest.MonkeyPatch.context() as patch:
        if request.param == "code at once":
            patch.setattr(CellCodes, "due", lambda _: True)
        yield


@pytest.mark.slow
@pytest.mark.usefixtures("patience")
@settings(max_examples=examples(100), deadline=None)
@given(CHANGES)
def test_any_changes_give_what_a_full_recalculation_gives(changes):
    session = Session(BOOK)
    inputs = {}
    for what, where, value in changes:
        if what == "get":
            session.get(where)
        elif what == "set":
            session.set(where, value, force=True)
            inputs[place_of(where)] = value
        else:
            session.reset(where)
            inputs.pop(place_of(where), None)
    expected = WARM.evaluate(inputs)
    for where in AREAS:
        area = session._area(where)
        full = [
            [expected.get("S", row, col) for col in range(area.col, area.col + area.cols)]
            for row in range(area.row, area.row + area.rows)
        ]
        assert bits(session.table(where)) == bits(full), where


@pytest.mark.usefixtures("patience")
@settings(max_examples=examples(40), deadline=None)
@given(CHANGES, st.booleans())
def test_what_is_asked_for_is_what_a_full_recalculation_gives(changes, once):
    """Of a plan that has made ready nothing but what has been asked for so far."""
    live = Live(Plan(BOOK, once=once))
    inputs = {}
    for what, where, value in changes:
        place = place_of(where) if what != "get" else None
        if what == "get":
            live.read(AREA_OF[where])
        elif what == "set" and where != "S!Z9":
            live.set((0, *place[1:]), value)
            inputs[place] = value
        elif what == "reset":
            live.reset((0, *place[1:]))
            inputs.pop(place, None)
    expected, asked = WARM.evaluate(inputs), live.asked()
    for area in AREA_OF.values():
        for col in range(area.col, area.col + area.cols):
            rows = area.row, area.row + area.rows - 1
            assert bits([asked.column("S", col, *rows)]) == bits([expected.column("S", col, *rows)])


def test_nothing_is_made_ready_that_is_not_asked_for():
    plan = Plan(BOOK)
    live = Live(plan)
    assert plan.steps == []
    assert live.asked().get("S", 5, 4) == BOOK_VALUES.get("S", 5, 4)
    assert {number for step in plan.steps for number in step.producers} == {0}
    assert bits([live.asked().items("S")]) == bits([BOOK_VALUES.items("S")])
    assert {number for step in plan.steps for number in step.producers} == set(range(len(plan.formulas)))


def test_a_text_that_is_reached_late_is_no_other():
    """The tables of texts of evaluations stand on the plan's, which takes no more texts then."""
    live = Live(Plan(BOOK))
    for number in range(3):
        live.set((0, 0, 1), float(number))
        live.asked().get("S", 1, 18)  # a text that is computed: its number is the table's next
        live.asked().column("S", 11, 5, 44)  # "up" and "down", written in a formula
    assert set(live.asked().column("S", 11, 5, 44)) <= {"up", "down", ErrorValue("#DIV/0!")}


def test_a_formula_whose_cells_depend_on_values_has_all_made_ready():
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constant(0, 0, 2.0)
    sheet.block(0, 1, 1, 1, parse_formula("A1*3"))
    sheet.block(0, 2, 1, 1, parse_formula('INDIRECT("B"&A1)+1'))
    sheet.block(1, 1, 1, 1, parse_formula("unknown+1"))
    plan = Plan(builder.build())
    asked = Live(plan).asked()
    assert asked.get("S", 0, 1) == 6 and not plan.settles and asked.remarks == ()
    assert asked.get("S", 0, 2) == ErrorValue("#NAME?") and plan.settles
    assert {number for step in plan.steps for number in step.producers} == {0, 1, 2}
    assert [fault.key for fault in asked.remarks] == ["S!B2"]
    assert asked.get("S", 0, 1) == 6


def steps_run(session, monkeypatch):
    """A list that grows by the first block of every step that runs."""
    ran = []
    for step in session._live.plan.steps:

        def noted(ev, marks, step=step, run=step.run):
            ran.append(step.producers[0])
            run(ev, marks)

        monkeypatch.setattr(step, "run", noted)
    return ran


def columns(*texts, rows=3):
    """A1:A3 and B1 hold numbers; each text fills a column from D on, alone in its step by its height."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [1.0, 2.0, 3.0])
    sheet.constant(0, 1, 5.0)
    for index, text in enumerate(texts):
        sheet.block(0, 3 + index, rows + index, 1, parse_formula(text))
    return builder.build()


def test_only_what_depends_on_the_change_and_is_asked_for_is_computed(monkeypatch):
    session = Session(columns("$A$1*2", "$B$1+1", "D1+1", "E1+1"))
    ran = steps_run(session, monkeypatch)
    session.set("S!A1", 9.0)
    assert not ran
    assert session.get("S!E1") == 6.0  # does not depend on A1
    assert ran == []
    assert session.get("S!D1") == 18.0
    assert ran == [0]
    assert session.get("S!F1") == 19.0
    assert session.get("S!F1") == 19.0
    assert ran == [0, 2]
    session.set("S!A1", 9.0)  # no change
    session.set("S!B1", 6.0)
    assert session.get("S!F1") == 19.0
    assert ran == [0, 2]
    assert session.get("S!G2") == 8.0
    assert ran == [0, 2, 1, 3]


def test_what_reads_the_same_as_before_is_not_computed_again(monkeypatch):
    session = Session(columns("IF($A$1>0,$B$1,0)", "D1+1", "E1&$A$2"))
    ran = steps_run(session, monkeypatch)
    session.set("S!A1", 9.0)
    assert session.get("S!F1") == "62"
    assert ran == [0]
    session.set("S!A1", -9.0)
    assert session.get("S!D1") == 0.0
    session.set("S!A1", -8.0)  # what reads D1 has not been asked for since it changed
    assert session.get("S!F1") == "12"
    assert ran == [0, 0, 0, 1, 2]


def test_what_was_not_finished_is_computed_the_next_time(monkeypatch):
    session = Session(columns("$A$1*2", "D1+1", "E1+1"))
    steps = session._live.plan.steps

    def out_of_time(ev, marks, run=steps[1].run):
        run(ev, marks)
        raise TimeLimitError("not finished")

    session.set("S!A1", 9.0)
    with monkeypatch.context() as patch:
        patch.setattr(steps[1], "run", out_of_time)
        with pytest.raises(TimeLimitError):
            session.get("S!F1")
    assert session.get("S!F1") == 20.0


def test_values_of_every_kind():
    builder = BookBuilder()
    sheet = builder.sheet("My sheet")
    sheet.constants.extend(0, 0, [1.5, "x", True, NA, None])
    sheet.block(0, 1, 5, 1, parse_formula("A1"))
    builder.name("a_1", parse_formula("'My sheet'!$A$1"))
    builder.name("all", parse_formula("'My sheet'!$A$1:$B$2"))
    builder.name("again", parse_formula("a_1"))
    builder.name("two", parse_formula("2"))
    session = Session(builder.build())
    assert session.names == ("a_1", "all", "again", "two")
    assert [session.get(f"'My sheet'!B{row}") for row in range(1, 7)] == [1.5, "x", True, NA, 0.0, None]
    assert session["a1"] == session["A_1"] == session["again"] == session.number("a1") == 1.5
    assert np.array_equal(session.get("my sheet!B1:B4"), [1.5, np.nan, 1.0, np.nan], equal_nan=True)
    assert np.array_equal(session.get("all"), [[1.5, 1.5], [np.nan, np.nan]], equal_nan=True)
    assert session.array("a1").tolist() == [1.5]
    assert session.table("all") == [[1.5, 1.5], ["x", "x"]]
    assert session.get("'My sheet'!B1:C1").shape == (2,)
    assert session.get("'My sheet'!B:B").shape == (5,)
    assert session.get("My sheet!B4:B7").shape == (4,)
    with pytest.raises(WorkbookError, match="'My sheet'!B2: x, no number"):
        session.number("'My sheet'!B2")
    with pytest.raises(WorkbookError, match="all: several cells, no number"):
        session.number("all")
    for where in ("two", "nowhere", "No!A1", "B1", "1+1", "", "'My sheet'!", "all:all"):
        with pytest.raises(WorkbookError, match="no cell or range of this workbook"):
            session.get(where)


def test_arrays_are_views_that_cannot_be_written_to():
    session = Session(columns("A1*$B$1", rows=3))
    array = session.get("S!D1:D3")
    assert not array.flags.owndata
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 1.0


def test_what_cannot_be_set():
    session = Session(columns("A1*$B$1"))
    with pytest.raises(WorkbookError, match="S!D2: computed by a formula"):
        session.set("S!D2", 1.0)
    with pytest.raises(WorkbookError, match="S!A1:A3: several cells"):
        session["S!A1:A3"] = 1.0
    for number in (math.nan, math.inf, np.float64("-inf")):
        with pytest.raises(WorkbookError, match="no number that a cell can hold"):
            session.set("S!A1", number)
    with pytest.raises(WorkbookError) as caught:
        session.update({"S!A1": 77.0, "x": 1.0, "S!D1": 2.0})
    assert [fault.key for fault in caught.value.faults] == ["x", "S!D1"]
    assert session.get("S!A1") == 1.0


def test_kinds_of_numbers_and_resets():
    session = Session(columns("A1*$B$1"))
    for value in (7, np.int32(7), np.float32(7), np.float64(7), 7.0):
        session.set("S!B1", value)
        assert session.get("S!D1") == 7.0
        session.reset()
    assert session.get("S!D1") == 5.0
    session.update({"S!B1": 10, "S!A2": True, "S!A3": "4"}, force=True)
    assert session.get("S!D1:D3").tolist() == [10, 10, 40]
    session.reset("S!A2")
    session.reset("S!A2")
    assert session.get("S!D1:D3").tolist() == [10, 20, 40]


def test_an_empty_cell_can_be_set_and_emptied_again():
    session = Session(columns("A1+$H$1", "COUNT($H$1)"))
    session["S!A1"] = 4.0
    session["S!H1"] = 3.0
    assert (session["S!D1"], session["S!E1"]) == (7.0, 1.0)
    session["S!H1"] = None
    assert (session["S!D1"], session["S!E1"], session["S!H1"]) == (4.0, 0.0, None)


def test_texts_of_long_loops_are_forgotten(monkeypatch):
    monkeypatch.setattr(incremental_module, "MOST_TEXTS", 50)
    session = Session(columns('A1&"x"'))
    for number in range(200):
        session["S!A1"] = float(number)
        assert session["S!D1"] == f"{number}x"
        assert session["S!D2"] == "2x"
        assert len(session._live.texts) < 100


def test_inputs_stay_what_they_are_when_texts_are_forgotten(monkeypatch):
    monkeypatch.setattr(incremental_module, "MOST_TEXTS", 5)
    session = Session(columns('A1&"x"', "$B$1*$A$3+SIN(A1)", rows=300))
    session.set("S!B1", "no number", force=True)
    for number in range(20):
        session["S!A1"] = float(number)
        assert session["S!D1"] == f"{number}x"
        assert session["S!E1"] == ErrorValue("#VALUE!")
    session.reset("S!B1")
    session["S!A1"] = 0.0
    assert session["S!E1"] == 15.0


def test_what_is_read_may_depend_on_values():
    session = Session(columns("OFFSET($A$1,$B$1-5,0)*2", 'INDIRECT("A"&$B$1-4)', "SUM(D1:D3)"))
    assert (session["S!D1"], session["S!E1"]) == (2.0, 1.0)
    session["S!B1"] = 7.0
    assert (session["S!D1"], session["S!E1"], session["S!F1"]) == (6.0, 3.0, 18.0)
    session.set("S!A3", "text", force=True)
    assert (session["S!D1"], session["S!E1"]) == (ErrorValue("#VALUE!"), "text")
    session.reset()
    assert (session["S!D1"], session["S!E1"]) == (2.0, 1.0)


def test_remarks_are_those_of_the_values_as_they_are():
    session = Session(columns("E1+$A$1", "D1", "FOO(1)"))
    for number in range(3):
        session["S!A1"] = float(number)
        messages = [fault.message for fault in session.remarks]
        assert [text for text in messages if "circular" in text] == [
            f"circular reference: S!D{row} -> S!E{row} -> S!D{row}" for row in (1, 2, 3)
        ]
        assert len([text for text in messages if "FOO" in text]) == 1
        assert len(messages) == 4


def test_the_cells_of_a_circle_are_errors():
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.block(0, 0, 1, 1, parse_formula("B1"))
    sheet.block(0, 1, 1, 1, parse_formula("A1"))
    session = Session(builder.build())
    assert session["S!A1"] == ErrorValue("#REF!")
    with pytest.raises(WorkbookError, match="no number"):
        session.number("S!B1")


@pytest.mark.slow
def test_a_file_set_written_and_read_again(tmp_path):
    source = ROOT / "generated" / "four-bar.xlsx"
    session = mechsheet.open_book(source)
    session["a1"] = 68.0
    output = tmp_path / "four-bar.xlsx"
    session.write(output)
    again = mechsheet.open_book(output)
    expected = mechsheet.recalc(source, {"a1": 68.0})
    table = "Positions!A4:K20"
    assert bits(again.table(table)) == bits(session.table(table))
    assert bits(session.table(table)) == bits(
        [[expected.get("Positions", r, c) for c in range(11)] for r in range(3, 20)]
    )
    with pytest.raises(ValueError, match="not read from a file"):
        Session(BOOK).write(output)


@pytest.mark.slow
def test_the_example_of_the_documentation(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    for source in (ROOT / "generated/four-bar.xlsx", ROOT / "templates/four-bar.toml"):
        shutil.copy(source, tmp_path)
    text = (ROOT / "docs" / "what-if.md").read_text(encoding="utf-8")
    examples = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert examples
    assert "66.0, 74.0, 200" in examples[0]
    for example in examples:
        example = example.replace("66.0, 74.0, 200", "66.0, 74.0, 5")  # fewer lengths: quicker
        exec(compile(example, "what-if.md", "exec"), {})


@pytest.mark.parametrize(
    "value", [np.float32(5.5), np.int64(5), np.float64(5.5), np.uint8(5), Decimal("5.5"), Fraction(11, 2)]
)
def test_numbers_of_every_type(value):
    session = Session(columns("A1*2"))
    session["S!A1"] = value
    assert session["S!D1"] == 2 * float(value)


@pytest.mark.parametrize(
    ("value", "hint"),
    [
        ("66,5", "write 66.5"),
        (" 66,5 ", "write 66.5"),
        ("66.5", "the cell holds a number"),
        (True, "write 1"),
        (np.bool_(False), "write 0"),
        (None, "the cell holds a number"),
        ([1], "one number"),
        (np.array([1.0, 2.0]), "one number"),
        ({"a": 1}, "one number"),
    ],
)
def test_a_cell_of_numbers_takes_nothing_else(value, hint):
    """A text in the place of a length makes every result an error, or worse a number, without a word."""
    session = Session(columns("A1*2"))
    with pytest.raises(WorkbookError) as problem:
        session["S!A1"] = value
    [fault] = problem.value.faults
    assert fault.key == "S!A1" and hint in fault.hint and "--set" not in str(fault)
    assert session["S!D1"] == 2.0


@pytest.mark.parametrize("where", [None, 3, ("S!A1",), ["S!A1"]])
def test_places_are_texts(where):
    session = Session(columns("A1*2"))
    for ask in (session.get, session.number, session.table, lambda place: session.set(place, 1.0)):
        with pytest.raises(WorkbookError, match="no name of a cell"):
            ask(where)


def test_several_values_are_set_or_none():
    session = Session(columns("A1*2"))
    with pytest.raises(WorkbookError, match=r"write 66\.5"):
        session.update({"S!A1": 7.0, "S!A2": "66,5"})
    assert session["S!D1"] == 2.0


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".xlsx", ".ods"])
def test_recalc_refuses_the_same_values(suffix):
    source = ROOT / "generated" / f"scotch-yoke{suffix}"
    name = mechsheet.open_book(source).names[0]
    for value in ("66,5", True, None, [1]):
        with pytest.raises(WorkbookError) as problem:
            mechsheet.recalc(source, {name: value})
        assert "--set" not in str(problem.value) and name in str(problem.value)
    with pytest.raises(WorkbookError, match="no name of a cell"):
        mechsheet.recalc(source, {3: 1.0})
