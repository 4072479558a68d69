"""`--set a1=65`: the text is changed in place, and reading it again gives the same mechanism."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechsheet.description import load, loads
from mechsheet.diagnostics import DescriptionError

DATA = Path(__file__).parents[1] / "data"
EVERYTHING = DATA / "everything.toml"


def test_values_in_place() -> None:
    before = load(EVERYTHING)
    after = load(EVERYTHING, {"a1": "8", "a2": "2.25", "phi0": " -45 "})
    shown = {dimension.symbol: dimension.shown for dimension in after.dimensions}
    assert (shown["a1"], shown["a2"], shown["phi0"], shown["half"]) == (8, 2.25, -45, 0.5)
    assert after.dimensions[2].value == math.radians(-45)
    assert after.dimensions[1] == replace(before.dimensions[1], value=2.25, shown=2.25)
    assert after.links == before.links
    lines = zip(before.text.splitlines(), after.text.splitlines(), strict=True)
    assert [new for old, new in lines if old != new] == [
        "a1 = 8 # a comment that stays",
        'a2 = { value = 2.25, label = { en = "crank A0A", tr = "krank A0A" }, cell = "Krank", tolerance = 0.1 }',
        'phi0 = { value = -45, unit = "deg", tolerance = 0.5 }',
    ]
    assert loads(after.text) == after


@pytest.mark.parametrize(
    "layout",
    [
        "dimensions = { a1 = 1, b = 2 }",
        "dimensions.a1 = 1 # [dimensions]\ndimensions.b = 2",
        "[dimensions]\nb = 2\na1 = { value = 1 }",
        '[dimensions]\n"a1" =   1_000.5\t# = 3\nb = 2',
        '[dimensions.a1]\nlabel = "a1 = 1"\nvalue = 1\n[dimensions.b]\nvalue = 2',
        "[dimensions]\n'a1'.value = 1\nb.value = 2",
        '[dimensions]\nb.value = 2\nb.label = """[dimensions]\\\n  a1 = 1"""\na1 = 0x10',
    ],
)
def test_wherever_a_dimension_stands(layout: str) -> None:
    rest = """
        [mechanism]
        name = "bar"
        [links]
        ground.points.O = [0, 0]
        bar.points = { O = [0, 0], P = ["a1", "b"] }
        [driver]
        link = "bar"
        values = [0]
    """
    after = loads(f"format = 1\n{layout}\n{rest}", overrides={"a1": "65", "b": "1e-5"})
    assert {dimension.symbol: dimension.shown for dimension in after.dimensions} == {"a1": 65, "b": 1e-5}
    assert loads(after.text) == after


@settings(deadline=None)
@given(st.floats(-1e90, 1e90).filter(lambda x: x == 0 or abs(x) > 1e-90))
def test_any_number(value: float) -> None:
    after = load(EVERYTHING, {"turn": repr(value)})
    assert after.dimensions[4].shown == value
    assert loads(after.text) == after


@pytest.mark.parametrize(
    ("typed", "value"),
    [(".5", 0.5), ("5.", 5), ("+007", 7), ("1E3", 1000), ("-0.0", 0), ("12345678901234567", 1.2345678901234568e16)],
)
def test_spellings(typed: str, value: float) -> None:
    after = load(EVERYTHING, {"turn": typed})
    assert after.dimensions[4].shown == value
    assert loads(after.text) == after


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("a9", "1", 'overrides: a9=1: no dimension is called "a9"\n       = inputs: a1, a2, phi0, half, turn'),
        ("A1", "1", 'no dimension is called "A1"\n       = did you mean "a1"?'),
        ("gamma3", "1", 'the dimension "gamma3" is derived from others\n       = change the dimensions in its'),
        ("a1", "65,5", 'expected a number, found "65,5"\n       = write 65.5'),
        ("a1", "−5", 'expected a number, found "−5"\n       = write -5'),
        ("a1", "3 cm", 'expected a number, found "3 cm"\n       = a plain number in the dimension\'s own unit'),
        ("a1", "", 'expected a number, found ""\n       = a plain number in the dimension\'s own unit'),
        ("a1", "2*a2", 'expected a number, found "2*a2"'),
        ("a1", "nan", 'expected a number, found "nan"'),
        ("a1", "1e999", 'expected a number, found "1e999"'),
        ("a1", "1_000", 'expected a number, found "1_000"'),
        ("a1", "١", "expected a number"),
        ("a1", "1e200", "dimensions.a1: 1e+200 is out of range"),
        ("half", "2", "dimensions.gamma3.formula: has no value: the arc cosine of 2 does not exist"),
    ],
)  # fmt: skip
def test_faults(name: str, value: str, message: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        load(EVERYTHING, {name: value})
    assert message in str(caught.value)


def test_faults_of_values_and_of_the_description_together() -> None:
    text = EVERYTHING.read_text(encoding="utf-8").replace('"crank"\nrelative', '"cronk"\nrelative')
    with pytest.raises(DescriptionError) as caught:
        loads(text, overrides={"a9": "1", "a1": "x"})
    assert [fault.key for fault in caught.value.faults] == ["overrides: a9=1", "overrides: a1=x", "driver.link"]


@pytest.mark.parametrize("entry", ["{ unit = 'cm' }", "{ formula = 3 }", "{ value = 1, formula = 'a1' }", "{}", "["])
def test_an_entry_that_is_faulty_itself(entry: str) -> None:
    text = EVERYTHING.read_text(encoding="utf-8").replace('half = { value = 0.5, unit = "1" }', f"half = {entry}")
    with pytest.raises(DescriptionError):
        loads(text, overrides={"half": "1"})


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("", '\n[workbook]\nlanguage = "tr"\n'),
        ('[workbook]\nreferences = "names"\n', '[workbook]\nlanguage = "tr"\nreferences = "names"\n'),
        ('[workbook] # why\nlanguage = "en" # yes\n', '[workbook] # why\nlanguage = "tr" # yes\n'),
        ("[workbook]", '[workbook]\nlanguage = "tr"'),
        ("[workbook]\n[outputs]\n", '[workbook]\nlanguage = "tr"\n[outputs]\n'),
    ],
)
def test_language_in_the_text(before: str, after: str) -> None:
    text = (DATA / "slider-crank.toml").read_text(encoding="utf-8")
    mechanism = loads(text + before, language="tr")
    assert mechanism.text == text + after
    assert loads(mechanism.text) == mechanism


@pytest.mark.parametrize(
    "first", ["workbook = {}", 'workbook = { references = "anchors" }', '  workbook.references = "anchors"']
)
def test_language_in_the_text_above_all_tables(first: str) -> None:
    text = (DATA / "slider-crank.toml").read_text(encoding="utf-8")
    mechanism = loads(f"{first}\n{text}", language="tr")
    assert mechanism.language == "tr"
    assert loads(mechanism.text) == mechanism
