"""`--set a1=65`: the text is changed in place, and reading it again gives the same mechanism."""

import math
import re
import unicodedata
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechsheet.description import Overrides, load, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError

DATA = Path(__file__).parents[1] / "data"
EVERYTHING = DATA / "everything.toml"
BAR = """format = 1
[mechanism]
name = "bar"
[dimensions]
a1 = 7 # a comment that stays
a2 = { value = 3.5, label = "bar" }
phi0 = { value = 30, unit = "deg" }
half = { value = 0.5, unit = "1" }
turn = { value = 1.5, unit = "rad" }
late = { formula = "2*early" }
early = { formula = "a1*half" }
gamma3 = { formula = "acos(half)", unit = "deg" }
[links]
ground.points.O = [0, 0]
bar.points = { O = [0, 0], P = ["a1", "a2"] }
[driver]
link = "bar"
values = [0]
"""


def test_values_in_place() -> None:
    before = load(EVERYTHING)
    after = load(EVERYTHING, Overrides({"a1": "8", "a2": "2.25", "phi0": " -45 "}))
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
    after = loads(f"format = 1\n{layout}\n{rest}", overrides=Overrides({"a1": "65", "b": "1e-5"}))
    assert {dimension.symbol: dimension.shown for dimension in after.dimensions} == {"a1": 65, "b": 1e-5}
    assert loads(after.text) == after


@pytest.mark.slow
@settings(deadline=None)
@given(st.floats(-1e90, 1e90).filter(lambda x: x == 0 or abs(x) > 1e-90))
def test_any_number(value: float) -> None:
    after = load(EVERYTHING, Overrides({"turn": repr(value)}))
    assert after.dimensions[4].shown == value
    assert loads(after.text) == after


@pytest.mark.parametrize(
    ("typed", "value"),
    [(".5", 0.5), ("5.", 5), ("+007", 7), ("1E3", 1000), ("-0.0", 0), ("12345678901234567", 1.2345678901234568e16)],
)
def test_spellings(typed: str, value: float) -> None:
    after = load(EVERYTHING, Overrides({"turn": typed}))
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
        ("a1", "3 N", '"3 N" where cm are needed'),
        ("a1", "", 'expected a number, found ""\n       = a plain number in the dimension\'s own unit'),
        ("a1", "2*", 'a1=2*: in "2*": expected a number, a name, a function or "(", found the end at column 3'),
        ("a1", "2a2", 'found "a2" at column 2\n       = a product is written with "*"'),
        ("a1", "40,5*2", 'found "," at column 3\n       = the decimal sign is "."'),
        ("a1", "2*b9", 'in "2*b9": "b9" is not a dimension\n       = dimensions: a1, a2, phi0, half, turn, late'),
        ("a1", "x", '"x" is not a dimension'),
        ("a1", "hald*2", 'did you mean "half"?'),
        ("a1", "1/0", "overrides: a1=1/0: has no value: division by zero"),
        ("a1", "sqrt(-half)", "the square root of -0.5 is not a real number\n       = with half = 0.5"),
        ("a1", "10^400", "has no value"),
        ("a1", "phi0", 'a1=phi0: "phi0" is an angle where a length is needed'),
        ("phi0", "2*a1", '"2*a1" is a length where an angle is needed'),
        ("phi0", "degrees(atan(1))", "expressions compute in radians: leave degrees() out"),
        ("half", "3/2", "dimensions.gamma3.formula: has no value: the arc cosine of 1.5 does not exist"),
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
        load(EVERYTHING, Overrides({name: value}))
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("name", "typed", "text"),
    [
        ("a1", "40*1.1", "44"),
        ("a1", "0.1+0.2", "0.3"),
        ("a1", "-2^2 + (7 - 1)/4", "-2.5"),
        ("a1", "1/3", "0.333333333333333"),
        ("a1", "a1 + 2*late", "21"),  # derived: late = 2*early, early = a1*half
        ("phi0", "40 + 5", "45"),  # numbers alone: in the dimension's unit
        ("phi0", "acos(half)", "60"),  # a function: radians, as in a description
        ("phi0", "pi/4", "45"),
        ("phi0", "phi0*1.5", "45"),
        ("turn", "phi0*6/pi", "1"),
        ("turn", "1 + 0.25", "1.25"),
        ("half", "cos(2*phi0)^2", "0.25"),
        ("half", "a2/early", "1"),
    ],
)
def test_expressions(name: str, typed: str, text: str) -> None:
    after = loads(BAR, overrides=Overrides({name: typed}))
    assert [dimension.shown for dimension in after.dimensions if dimension.symbol == name] == [float(text)]
    (line,) = set(after.text.splitlines()) - set(BAR.splitlines())
    assert re.fullmatch(rf"{name} = (?:{{ value = )?{re.escape(text)}\b.*", line)
    assert loads(after.text) == after


def test_names_mean_what_the_changes_before_made_of_them() -> None:
    after = loads(BAR, overrides=Overrides([("a2", "a1/2"), ("a1", "10"), ("a2", "a2 + early"), ("half", "a2/a1")]))
    shown = {dimension.symbol: dimension.shown for dimension in after.dimensions}
    assert (shown["a1"], shown["a2"], shown["half"]) == (10, 8.5, 0.85)


def test_names_in_either_normal_form() -> None:
    text = BAR.replace("half =", '"açı" =').replace("half", "açı")
    after = loads(
        text, overrides=Overrides({unicodedata.normalize("NFD", "açı"): unicodedata.normalize("NFD", "açı*1.5")})
    )
    assert {dimension.symbol: dimension.shown for dimension in after.dimensions}["açı"] == 0.75


def test_a_name_without_a_value_is_told_where_it_is_read() -> None:
    """Also when a later change gives it one: what is typed is never passed over in silence."""
    with pytest.raises(DescriptionError, match='phi0=gamma3: has no value: "gamma3" has none'):
        loads(BAR, overrides=Overrides([("half", "2"), ("phi0", "gamma3"), ("half", "0.5")]))


def test_faults_of_values_and_of_the_description_together() -> None:
    text = EVERYTHING.read_text(encoding="utf-8").replace('"crank"\nrelative', '"cronk"\nrelative')
    with pytest.raises(DescriptionError) as caught:
        loads(text, overrides=Overrides({"a9": "1", "a1": "x"}))
    assert [fault.key for fault in caught.value.faults] == ["overrides: a9=1", "overrides: a1=x", "driver.link"]


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ("{ unit = 'cm' }", 'dimensions.half: is not complete: give "value" or'),
        ("{ formula = 3 }", "dimensions.half.formula: expected"),
        ("{ value = 1, formula = 'a1' }", 'dimensions.half: "value" and "form'),
        ("{}", "dimensions.half: is not complete"),
        ("[", "dimensions.half: what begins here with"),
    ],
)
def test_an_entry_that_is_faulty_itself(entry: str, said: str) -> None:
    text = EVERYTHING.read_text(encoding="utf-8").replace('half = { value = 0.5, unit = "1" }', f"half = {entry}")
    with pytest.raises(DescriptionError, match=said):
        loads(text, overrides=Overrides({"half": "1"}))


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
    mechanism = loads(text + before, overrides=Overrides(language="tr"))
    assert mechanism.text == text + after
    assert loads(mechanism.text) == mechanism


@pytest.mark.parametrize(
    "first", ["workbook = {}", 'workbook = { references = "anchors" }', '  workbook.references = "anchors"']
)
def test_language_in_the_text_above_all_tables(first: str) -> None:
    text = (DATA / "slider-crank.toml").read_text(encoding="utf-8")
    mechanism = loads(f"{first}\n{text}", overrides=Overrides(language="tr"))
    assert mechanism.language == "tr"
    assert loads(mechanism.text) == mechanism


def test_a_value_of_a_task_is_set_likewise() -> None:
    text = template_text("quick-return-slider")
    task = loads(text, overrides=Overrides({"stroke": "120"}))
    assert {dimension.symbol: dimension.shown for dimension in task.dimensions}["stroke"] == 120
    assert "stroke = 120\n" in task.text


@pytest.mark.parametrize(("name", "typed"), [("a1", "20 mm"), ("a1", "20mm"), ("phi0", "20°"), ("phi0", "20 derece")])
def test_a_number_may_have_its_own_unit_behind_it(name: str, typed: str) -> None:
    found = loads(BAR, overrides=Overrides({name: typed}))
    assert next(dim.shown for dim in found.dimensions if dim.symbol == name) == 20
