"""Checks: all clear on every template, blank where there is no position, and damage of any column is seen."""

import pytest
from laid import ROOT, TEMPLATES, Laid, template_text

from chosen import some
from mechsheet.formula.nodes import Binary, Call, Number, transform
from mechsheet.sheet.checks import DATA, FIRST, VERDICT_ROW
from mechsheet.sheet.plan import EXISTS

CLEAR = {"en": "all clear", "tr": "her şey yolunda"}


@pytest.mark.parametrize("name", some(TEMPLATES, 2))
def test_all_clear(name):
    """Gaps are rounding errors, nothing leaps, and every column has been judged."""
    laid = Laid(template_text(name), copies=True)
    assert laid.spot("#clear") == CLEAR[laid.mechanism.language]
    assert 0 <= laid.spot("#worst") < 1e-9 * max(abs(d.value) for d in laid.mechanism.dimensions if d.shown is not None)
    assert laid.spot("#leaps") == 0


def test_rows_without_a_position_are_blank():
    laid = Laid(template_text("four-bar")).change(a1=110)
    sheet = laid.plan.at.titles["checks"]
    exists = [laid.values.get(laid.plan.table, laid.plan.at.first + row, EXISTS) for row in range(laid.plan.rows)]
    assert 0 < sum(exists) < laid.plan.rows
    for row, there in enumerate(exists):
        value = laid.values.get(sheet, FIRST + row, DATA)
        assert isinstance(value, float) if there else value == ""
    assert laid.spot("#clear") == "all clear"


def test_no_position_at_all_is_not_clear():
    assert Laid(template_text("four-bar")).change(a1=500).spot("#clear") == "look at the red cells"


def swapped(node):
    """ATAN2 with its arguments the wrong way round."""
    return transform(
        node, lambda part: Call("ATAN2", part.args[::-1]) if getattr(part, "name", "") == "ATAN2" else part
    )


def doubled(node):
    return Binary("*", node, Number(1.001))


FOUR_BAR = (ROOT / "tests/data/four-bar.toml").read_text(encoding="utf-8")
"""Its coupler point is given by distances: the angle there is the equations' own."""

DAMAGE = {
    "ATAN2 swapped": ("phi_0", swapped),
    "angle in a triangle": ("mu_1", doubled),
    "angle of a link": ("theta13", doubled),
    "pin": ("B.x", doubled),
    "coupler point": ("C.y", doubled),
    "crank pin": ("A.x", doubled),
    "fixed point": ("B0.x", doubled),
    "constant angle": ("gamma3", doubled),
    "driver": ("#driver", doubled),
    "limit": ("Delta", lambda node: node.args[2]),  # clipped instead of #N/A
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_damage_is_seen(kind):
    symbol, change = DAMAGE[kind]
    laid = Laid(FOUR_BAR, overrides={"a1": "100"} if kind == "limit" else None)
    spot = laid.plan.at.spots[symbol] if symbol != "#driver" else laid.plan.at.shown["theta12"]
    assert laid.spot("#clear") == "all clear"
    own = [fill for fill in laid.workbook.sheet(spot.sheet).fills if fill.col == spot.col]
    hit = [fill.formula for fill in own if spot.column or fill.row == spot.row]
    laid.damage(spot.sheet, spot.col, lambda node: change(node) if any(node is one for one in hit) else node)
    assert laid.spot("#clear") == "look at the red cells"


LEVER = """
format = 1
[mechanism]
name = "lever"
[dimensions]
a1 = 50
a2 = 50
b3 = 120
[links.ground]
points = { A0 = [0, 0], B0 = ["-a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.lever]
points = { B0 = [0, 0], C = ["b3", 0] }
[[joints]]
type = "pin-slot"
point = "A"
on = "lever"
through = "B0"
symbol = "s3"
[driver]
link = "crank"
start = 2
stop = 362
step = 5
[assembly]
C = [70, 0]
"""


def test_leap_where_a_slot_passes_its_pivot():
    """The crank's pin runs through the lever's pivot at 180 degrees: the lever turns round from one row to the next."""
    laid = Laid(LEVER)
    assert laid.spot("#leaps") == 1
    assert laid.spot("#clear") == "look at the red cells"
    sheet = laid.plan.at.titles["checks"]
    col = laid.plan.at.shown["#leaps"].col
    flags = [laid.values.get(sheet, FIRST + row, col) for row in range(laid.plan.rows)]
    (row,) = [row for row, flag in enumerate(flags) if flag == 1]
    assert 2 + 5 * (row - 1) < 180 < 2 + 5 * row
    assert laid.values.get(sheet, VERDICT_ROW, col) == "look"
    assert laid.stands("leaps", 4) == "other branch, or steps too coarse"
    assert Laid(LEVER.replace("a1 = 50", "a1 = 60")).spot("#leaps") == 0
