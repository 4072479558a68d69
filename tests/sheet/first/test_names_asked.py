"""Every name that an output may read can be asked for elsewhere too: also what is the same in every row."""

import pytest
from laid import Laid

from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet.checking.against_search import against_search
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.dynamics.solve import solve
from mechsheet.model import takes
from mechsheet.sheet.page.layout import lay_out_page
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs

TAKES = tuple(takes.TAKES)
FOUR_BAR = template_text("four-bar").partition("[outputs]")[0]


def asked(text, name):
    return text + "[summary]\n" + "".join(f'z_{take} = {{ of = "{name}", take = "{take}" }}\n' for take in TAKES)


def with_speed(speed, text=FOUR_BAR):
    return text.replace("step = 15", f"step = 15\nspeed = {speed}")


@pytest.mark.cases(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        (with_speed(10), "omega12", 10.0),
        (with_speed('{ value = 60, unit = "rpm" }'), "omega12", 6.283185307179586),
        (with_speed('"2*a2/a2"'), "omega12", 2.0),
        (with_speed(10), "alpha12", 0.0),
        (with_speed("10\nacceleration = 3"), "alpha12", 3.0),
        (FOUR_BAR, "A0.x", 0.0),
        (FOUR_BAR, "B0.x", 70.0),
        (FOUR_BAR, "B0.y", 0.0),
        (with_speed(10), "B0.vx", 0.0),
    ],
)
def test_what_is_the_same_in_every_row(text, name, value):
    """Its smallest, largest, mean, first and last value is it; its range is 0. Once this was a traceback, or, of a mean, the
    mean of whatever cells stood below the constant."""
    laid = Laid(asked(text, name))
    found = {take: laid.spot(f"summary z_{take}") for take in TAKES}
    assert found == pytest.approx({take: 0.0 if take == "range" else value for take in TAKES}, rel=1e-12)
    searched = against_search(book_of(laid.workbook), laid.values, laid.plan, "case")
    assert searched.agrees, searched


@pytest.mark.slow
@pytest.mark.parametrize(("name", "value"), [("B0.x", 70.0), ("A0.y", 0.0)])
def test_on_a_page_in_a_table_and_in_a_study(name, value):
    mechanism = loads(asked(FOUR_BAR, name))
    workbook, plan = lay_out_page(mechanism, solve(mechanism))
    values = evaluate(book_of(workbook))
    rows = plan.blocks["summary"].rows
    for take in TAKES:
        assert values.get(plan.main, rows[f"z_{take}"], 1) == pytest.approx(0.0 if take == "range" else value)
    table = '[[tables]]\nrows = { a2 = [30, 35] }\ncolumns = { a3 = [62, 63] }\nvalue = "z_mean"\n'
    laid = Laid(asked(FOUR_BAR, name) + table)
    searched = against_search(book_of(laid.workbook), laid.values, laid.plan, "case")
    assert searched.agrees, searched
    designs = Designs(loads(asked(FOUR_BAR, name) + "[study]\nvary = { a2 = [30, 35, 5] }\n"))
    found = kept_of(designs, 0, 2).columns
    assert all(found[f"z_{take}"] == pytest.approx(0.0 if take == "range" else value) for take in TAKES)


@pytest.mark.parametrize(
    ("speed", "name", "values"),
    [
        ("10", "omega12", [10.0, 10.0]),
        ("10", "alpha12", [0.0, 0.0]),
        ("10\nacceleration = 3", "alpha12", [3.0, 3.0]),
        ('"a2/5"', "omega12", [6.0, 7.0]),
    ],
)
def test_the_drivers_speed_in_a_study(speed, name, values):
    """It is no column: it cannot grow between the rows. Once this was a traceback."""
    part = '[study]\nvary = { a2 = [30, 35, 5] }\nkeep = ["z_max > -1000"]\nmaximize = ["z_mean"]\n'
    found = kept_of(Designs(loads(asked(with_speed(speed), name) + part)), 0, 2).columns
    for take in TAKES:
        assert list(found[f"z_{take}"]) == pytest.approx([0.0, 0.0] if take == "range" else values)


@pytest.mark.parametrize(
    ("text", "chart"),
    [
        (with_speed(10), 'x = "theta12"\ny = ["omega14", "omega12"]'),
        (with_speed(10), 'x = "theta12"\ny = ["alpha12"]'),
        (FOUR_BAR, 'x = "theta12"\ny = ["theta14", "B0.x"]'),
        (FOUR_BAR, 'x = "B0.y"\ny = ["theta14"]'),
    ],
)
def test_a_chart_of_what_has_no_column_is_refused_by_name(text, chart):
    """No traceback, and no curve through whatever cells stand below the constant."""
    with pytest.raises(DescriptionError, match="is the same in every row"):
        loads(f"{text}[[charts]]\n{chart}\n")


def test_a_speed_that_changes_has_a_curve():
    loads(with_speed('"10 + cos(theta12)"') + '[[charts]]\nx = "theta12"\ny = ["omega12", "alpha12"]\n')


@pytest.mark.slow
def test_the_way_out_of_a_refused_chart_is_one():
    """The output that the message proposes has a column."""
    text = FOUR_BAR + '[outputs]\nfoot = { formula = "B0.x + 0" }\n'
    laid = Laid(text + '[[charts]]\nx = "theta12"\ny = ["foot"]\n')
    assert laid.column("foot") == [70.0] * laid.plan.rows


EVERY = ("four-bar-forces", "engine", "scissor-lift", "rack-slider", "geared-five-bar", "adjustable-pump")


@pytest.mark.slow
@pytest.mark.cases(1)
@pytest.mark.parametrize("template", EVERY)
def test_every_name_of_a_template(template):
    """All summaries of all names that may be asked for: the search finds the same."""
    text = template_text(template)
    mechanism = loads(text)
    names = [equation.symbol for equation in solve(mechanism).all] + list(mechanism.driver_rates)
    names = [name for name in dict.fromkeys(names) if taken(text, name)]
    assert len(names) >= 8
    laid = Laid(summed(text, names))
    searched = against_search(book_of(laid.workbook), laid.values, laid.plan, template)
    assert searched.agrees, searched


def summed(text, names):
    lines = "".join(
        f'z{place}_{take} = {{ of = "{name}", take = "{take}" }}\n'
        for place, name in enumerate(names) for take in ("max", "range", "mean")
    )  # fmt: skip
    return (
        text.replace("\n[summary]\n", "\n[summary]\n" + lines, 1)
        if "\n[summary]\n" in text
        else (text + "\n[summary]\n" + lines)
    )


def taken(text, name):
    """Whether a description may ask for it."""
    try:
        loads(summed(text, [name]))
    except DescriptionError:
        return False
    return True
