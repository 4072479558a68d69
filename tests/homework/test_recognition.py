"""A workbook without a description: what it seems to be, and nothing where its formulas prove nothing."""

from __future__ import annotations

import json

import numpy as np
import pytest

import mechsheet
from command_line import printed
from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from livesheet.formats import read
from mechsheet import description
from mechsheet.homework.audit import audit
from mechsheet.homework.expected_values import Quantity
from mechsheet.homework.formula_strips import upright
from mechsheet.homework.recognition import deciding, driven_on, recognise, tables


def seen(path):
    return recognise(tables(upright(read(path))))


SILENT = [("", name, value) for _, name, value in FOUR_BAR]
ORDERS = {
    "called": Table(FOUR_BAR, four_bar()),
    "without a word": Table(SILENT[::-1], four_bar(), headings=False, labels=False),
    "to the right, of the other assembly": Table(SILENT, four_bar(t13="{b}-{g}"), across=True),
}


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("how", ORDERS)
def test_a_four_bar_is_recognised_and_described(tmp_path, how):
    path = ORDERS[how].save(tmp_path / "book.xlsx")
    said = printed("audit", path, "--json", "--describe", tmp_path / "own.toml")
    found, _ = json.JSONDecoder().raw_decode(said)
    assert found["template"] == "four-bar"
    assert {symbol: one["value"] for symbol, one in found["dimensions"].items()} == {s: v for s, _, v in FOUR_BAR}
    assert {"theta13", "theta14", "mu"} <= set(found["quantities"])
    assert found["unexplained"] == []
    assert audit(path, mechsheet.load(tmp_path / "own.toml")).right


def test_a_slider_crank_in_line_has_no_eccentricity(tmp_path):
    columns = [("aci", "deg", STEPS), ("rad", "fi", "RADIANS({deg})")]
    columns.append(("yol", "x", "{r}*COS({fi})+SQRT({l}^2-({r}*SIN({fi}))^2)"))
    path = Table([("", "r", 50.0), ("", "l", 200.0)], columns).save(tmp_path / "book.xlsx")
    lines = printed("audit", path, "--language", "tr").splitlines()
    assert lines[0].endswith("Krank-biyel mekanizması (şablon slider-crank)")
    assert "a2       Sayfa1!B2      50" in lines
    assert any("0 alındı: a1" in line for line in lines)


NONE = {
    "a circle": ["{r}*COS({fi})", "{r}*SIN({fi})"],
    "an ellipse": ["{r}*COS({fi})", "{l}*SIN({fi})"],
    "a cam": ["{r}+{l}*(1-COS({fi}))", "{l}*SIN({fi})"],
    "typed numbers": ["50*COS({fi})+SQRT(200^2-(50*SIN({fi}))^2)", "{r}*{l}+{fi}"],
}


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("what", NONE)
def test_what_is_no_linkage_is_none(tmp_path, what):
    columns = [("aci", "deg", STEPS), ("rad", "fi", "RADIANS({deg})")]
    columns += [(f"k{n}", f"k{n}", text) for n, text in enumerate(NONE[what])]
    path = Table([("a2", "r", 50.0), ("a3", "l", 200.0)], columns).save(tmp_path / "book.xlsx")
    assert seen(path) is None
    output = printed("audit", path, "--describe", tmp_path / "own.toml", code=1)
    assert "no linkage of the templates fits its numbers" in output
    assert "Sayfa1!C7:C31" in output
    assert not (tmp_path / "own.toml").exists()


@pytest.mark.slow
def test_a_workbook_without_a_table_is_none(tmp_path):
    path = Table([("a1", "a1", 1.0)], [("x", "x", [1.0, 2.0])]).save(tmp_path / "book.xlsx")
    assert "no table" in printed("audit", path, code=1)


def test_what_decides_a_motion():
    """The coupler point's dimensions do not; those of a joint's place do, also behind a derived one."""
    assert deciding(mechsheet.template("four-bar")) == ("a1", "a2", "a3", "a4")
    assert deciding(mechsheet.template("slider-crank")) == ("a1", "a2", "a3")
    assert "b4" in deciding(mechsheet.template("fivelink"))


def test_what_says_something_of_a_link_that_is_not_driven():
    """By what it reads, not by its letters: the crank's pin AB has the letter of the rocker's B in its name."""
    text = (
        mechsheet.template("four-bar")
        .text.replace("A = ", "AB = ")
        .replace(
            "[outputs]\n",
            """[outputs]
height = { formula = "AB.y" }
rocking = { formula = "2*B.y" }
""",
            1,
        )
    )
    own = description.loads(text, "own")
    assert not driven_on(own, Quantity("|A0AB|", "length", np.zeros(3), ("A0", "AB")))
    assert driven_on(own, Quantity("|A0B|", "length", np.zeros(3), ("A0", "B")))
    told = {name: driven_on(own, Quantity(name, "number", np.zeros(3))) for name in ("height", "rocking", "mu")}
    assert told == {"height": False, "rocking": True, "mu": True}


def test_a_description_is_asked_for_once(tmp_path):
    (tmp_path / "m.toml").write_text(mechsheet.template("four-bar").text, encoding="utf-8")
    path = Table(FOUR_BAR, four_bar()).save(tmp_path / "book.xlsx")
    output = printed("audit", path, "--against", tmp_path / "m.toml", "--describe", tmp_path / "n.toml", code=2)
    assert "--describe" in output
