"""Whatever is written, a description either loads or is refused with DescriptionError; nothing tracebacks."""

import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from chosen import examples
from mechsheet.description import grammar as s
from mechsheet.description import loads
from mechsheet.description.schema import DESCRIPTION
from mechsheet.diagnostics import DescriptionError

DATA = Path(__file__).parents[1] / "data"
TEXTS = [path.read_text(encoding="utf-8") for path in sorted(DATA.glob("*.toml"))]
WORDS = sorted({word for text in TEXTS for word in re.findall(r"[\w.]+", text)})

LEAVES = ["1", "0", "-3.5", "1e400", "nan", "-inf", "true", "2021-05-27", '""', '"a1"', "'theta12'", '"A"', '"C.x"']
LEAVES += ['"crank"', '"ground"', '"s17"', '"1/0"', '"(a1"', '"prismatic"', '"pin-slot"', '"gear"', '"deg"', "[]", "{}"]
names = st.sampled_from(WORDS).map(lambda word: f'"{word}"')
leaves = st.sampled_from(LEAVES) | names
values = st.recursive(
    leaves,
    lambda inner: (
        st.lists(inner, max_size=4).map(lambda items: f"[{', '.join(items)}]")
        | st.dictionaries(names, inner, max_size=4).map(
            lambda table: "{" + ", ".join(f"{key} = {value}" for key, value in table.items()) + "}"
        )
    ),
    max_leaves=8,
)


def try_loading(text: str) -> None:
    try:
        mechanism = loads(text)
    except DescriptionError as error:
        assert error.faults
        for fault in error.faults:
            assert fault.message
            assert fault.file == "<text>"
            assert "BAD" not in str(fault)
    else:
        assert loads(mechanism.text) == mechanism


@pytest.mark.ci
@settings(deadline=None)
@given(st.text(max_size=200))
def test_any_text(text: str) -> None:
    try_loading(text)


@settings(max_examples=examples(200), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.sampled_from(TEXTS), st.data())
def test_lines_replaced(text: str, data: st.DataObject) -> None:
    """Some values of a good description replaced by any others, some lines dropped or doubled."""
    lines = text.splitlines()
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(lines) - 1))
        key, equals, _ = lines[place].partition(" = ")
        what = data.draw(st.sampled_from(["value", "value", "value", "drop", "double", "key"]))
        if what == "value" and equals:
            lines[place] = f"{key} = {data.draw(values)}"
        elif what == "key" and equals:
            lines[place] = f"{data.draw(names)} = {lines[place].partition(' = ')[2]}"
        elif what == "double":
            lines.insert(place, lines[place])
        else:
            del lines[place]
        if not lines:
            break
    try_loading("\n".join(lines))


@settings(max_examples=examples(200), deadline=None)
@given(st.sampled_from(TEXTS), st.integers(0, 2000), st.sampled_from([*"\"'[]{}=#.,\n\\ğ\0", ""]))
def test_one_character_changed(text: str, place: int, sign: str) -> None:
    place %= len(text)
    try_loading(text[:place] + sign + text[place + 1 :])


def of_shape(shape: Any) -> st.SearchStrategy[str]:
    """Values that fit the schema, so that the checks beyond it are reached; one in some is any value."""
    fitting: st.SearchStrategy[str]
    match shape:
        case s.Either(shapes):
            fitting = st.one_of([of_shape(one) for one in shapes])
        case s.Number() | s.Integer():
            fitting = st.sampled_from(["1", "2", "3", "70", "-1", "0.5", "0"])
        case s.YesNo():
            fitting = st.sampled_from(["true", "false"])
        case s.Quantity():
            fitting = st.sampled_from(
                ["1", "30", "0", "-2.5", '"a1"', '"b"', '"1/a1"', '"theta12"', '"2 cm"', '"1 N/mm"']
            )
        case s.WithUnit():
            fitting = st.sampled_from(['"20 mm"', '"30°"', '"2 kN"', '"60 rpm"', '"3 px"'])
        case s.Text(choices) if choices:
            fitting = st.sampled_from([f'"{choice}"' for choice in choices])
        case s.Text(_, _, kind):
            known = {"link": ["g", "k", "c"], "point": ["A", "B", "O"], "joint": ["s1", "s13"]}
            known |= {
                "driver": ["theta12", "s1"],
                "variable or output": ["theta12", "theta13", "s1", "mu", "A.x", "O.y"],
            }
            any_text = ["mm", "deg", "x1", "a1 + b", "theta12 - 1", "s1", "mu", "theta12", "prismatic", "pin-slot"]
            fitting = st.sampled_from([f'"{word}"' for word in known.get(kind, any_text)])
        case s.Words():
            fitting = st.sampled_from(['"label"', '{ en = "a", tr = "b" }'])
        case s.Items(item, least, most):
            fitting = st.lists(of_shape(item), min_size=least, max_size=min(most, 3)).map(
                lambda items: f"[{', '.join(items)}]"
            )
        case s.Named(item, what):
            known = {"link": ["g", "k", "c", "d"], "point": ["A", "B", "O"], "dimension": ["a1", "b", "c1"]}
            keys = st.sampled_from(known.get(what, ["mu", "nu", "A", "theta13", "s1"]))
            fitting = st.dictionaries(keys, of_shape(item), min_size=shape.least, max_size=3).map(as_table)
        case s.Kinds(_, tables):
            fitting = st.one_of([of_table(table, {"type": st.just(f'"{kind}"')}) for kind, table in tables.items()])
        case _:
            fitting = of_table(shape, {})
    return st.integers(0, 60).flatmap(lambda dice: values if dice == 0 else fitting)


def as_table(table: dict[str, str]) -> str:
    return "{" + ", ".join(f"{key} = {value}" for key, value in table.items()) + "}"


def of_table(table: s.Table, fixed: dict[str, st.SearchStrategy[str]]) -> st.SearchStrategy[str]:
    keys = {key: fixed[key] if key in fixed else of_shape(rule.shape) for key, rule in table.keys.items()}
    required = {key: keys[key] for key, rule in table.keys.items() if rule.required}
    in_ways = {key for groups in table.ways for group in groups for key in group}
    free = {key: value for key, value in keys.items() if key not in required and key not in in_ways}
    bases = [required]
    for groups in table.ways:
        bases = [{**base, **{key: keys[key] for key in group if key in keys}} for base in bases for group in groups]
    return st.one_of([st.fixed_dictionaries(base, optional=free) for base in bases]).map(as_table)


WHOLE = st.fixed_dictionaries(
    {key: of_shape(rule.shape) for key, rule in DESCRIPTION.keys.items() if rule.required and key != "format"},
    optional={key: of_shape(rule.shape) for key, rule in DESCRIPTION.keys.items() if not rule.required},
)


@pytest.mark.slow
@settings(max_examples=examples(300), deadline=None, suppress_health_check=list(HealthCheck))
@given(WHOLE)
def test_from_the_schema(parts: dict[str, str]) -> None:
    try_loading("format = 1\n" + "\n".join(f"{key} = {value}" for key, value in parts.items()))
