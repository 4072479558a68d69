"""Outputs whose formulas name summaries: one number of the whole motion, with the summaries of the layout it stands in."""

import math

import pytest
from laid import Laid
from placed import places_of

from livesheet.formula.nodes import ErrorValue
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.search import Search
from mechsheet.library.show import overview_text

pytestmark = pytest.mark.slow

NA = ErrorValue("#N/A")

OUTPUTS = """
[outputs]
mu = { formula = "theta14 - theta13", unit = "deg", cell = "Mu" }
arc = { formula = "a4*swing", label = { en = "way of B", tr = "B'nin yolu" }, cell = "Arc" }
worst = { formula = "max(abs(mu_max - pi/2), abs(mu_min - pi/2))", unit = "deg" }
share = { formula = "swing/(2*pi)", unit = "1" }
pole = { formula = "1/(B_most - a4)", unit = "1/mm" }
[summary]
swing = { of = "theta14", take = "range" }
mu_min = { of = "mu", take = "min" }
mu_max = { of = "mu", take = "max" }
B_most = { of = "B.y", take = "max" }
"""

HEAD = template_text("four-bar").partition("[outputs]")[0]
TEXT = HEAD + OUTPUTS


def cell(laid, name, col=1):
    return laid.values.get(laid.plan.main, laid.plan.blocks["summary"].rows[name], col)


def of_search(laid, **dimensions):
    """Swing and transmission angles as a search between the rows has them [rad]."""
    mechanism = loads(TEXT, overrides=Overrides({key: str(value) for key, value in dimensions.items()}))
    compiled = Compiled(mechanism)
    search = Search(mechanism, compiled.equations, compiled.given)
    low, _, high, _ = search.extremes("theta14")
    least, _, most, _ = search.extremes("mu")
    return high - low, least, most


@pytest.mark.cases(1)
@pytest.mark.parametrize("typed", [{}, {"a2": 30, "a4": 58}, {"a1": 75}])
def test_they_follow_the_motion_between_the_rows(typed):
    laid = Laid(TEXT).change(**typed)
    swing, least, most = of_search(laid, **typed)
    a4 = typed.get("a4", 56)
    assert cell(laid, "arc") == pytest.approx(a4 * swing, rel=1e-6)
    assert cell(laid, "share") == pytest.approx(swing / math.tau, rel=1e-6)
    assert cell(laid, "worst") == pytest.approx(
        math.degrees(max(abs(most - math.pi / 2), abs(least - math.pi / 2))), 1e-6
    )
    of_rows = [angle for angle in laid.column("theta14") if isinstance(angle, float)]
    assert cell(laid, "share") * 360 > max(of_rows) - min(of_rows)


def test_what_is_read_beside_them():
    english, turkish = Laid(TEXT), Laid(TEXT, "tr")
    assert (cell(english, "arc", 2), cell(english, "arc", 4)) == ("mm", "way of B")
    assert cell(turkish, "arc", 4) == "B'nin yolu"
    assert (cell(english, "worst", 2), cell(english, "share", 2)) == ("°", "")
    assert cell(english, "share", 4) == "= swing/(2*pi)"
    assert {"Arc", "worst", "share"} <= {name.name for name in english.workbook.names}
    partly = Laid(TEXT).change(a1=110)
    assert cell(partly, "arc", 4) == f"way of B: {int(partly.spot('rows_closed'))} of 25 positions"


def test_no_motion_no_number():
    laid = Laid(TEXT).change(a1=500)
    assert [cell(laid, name) for name in ("arc", "worst", "share")] == [NA] * 3


def test_what_has_no_value_is_not_a_number():
    """B at the top of its circle: 1/(B_most - a4) divides by 0, or by what rounding leaves."""
    text = TEXT.replace("1/(B_most - a4)", "1/(B_most - B_most)")
    assert cell(Laid(text), "pole") == NA


def test_the_named_cell_of_an_output_of_every_row_is_at_the_position_shown():
    laid = Laid(TEXT)
    place = next(name for name in laid.workbook.names if name.name == "Mu")
    row = int(laid.spot("position"))
    assert laid.values.get(place.sheet, place.row, place.col) == laid.column("mu")[row]


@pytest.mark.parametrize("language", ["en", "tr"])
def test_on_a_page_they_are_of_its_rows(language):
    compiled = Compiled(
        loads(
            TEXT.replace("[outputs]", '[workbook]\nlayout = "page"\n[outputs]', 1),
            overrides=Overrides(language=language),
        )
    )
    plan = compiled.plan
    rows = [compiled.value(plan.at.spots["theta14"], row) for row in range(plan.rows)]
    assert compiled.value(places_of(plan)["summary share"]) == pytest.approx((max(rows) - min(rows)) / 360, rel=1e-12)
    words = {"en": "way of B (these rows)", "tr": "B'nin yolu (bu satırlarda)"}[language]
    row = plan.blocks["summary"].rows["arc"]
    (cell,) = [cell for cell in compiled.workbook.sheet(plan.main).cells if (cell.row, cell.col) == (row, 3)]
    assert cell.content == words


def test_show_prints_them():
    (line,) = [line for line in overview_text(loads(TEXT)).splitlines() if line.startswith("over the whole sweep: ")]
    assert line.startswith("over the whole sweep: swing = 78.9441°, mu_min = ")
    assert ", arc = 77.1588 mm, worst = 56.1117°, share = 0.219289, " in line


def test_in_a_file_of_radians():
    """Nothing is in degrees: the same numbers, but angles in radians."""
    head = HEAD.replace("[mechanism]", '[mechanism]\nangle_unit = "rad"').replace("stop = 360", 'stop = "2*pi"')
    head = head.replace("step = 15", 'step = "pi/12"')
    laid = Laid(head + OUTPUTS.replace('unit = "deg"', 'unit = "rad"'))
    assert cell(laid, "arc") == pytest.approx(cell(Laid(TEXT), "arc"), rel=1e-12)
    assert cell(laid, "worst") == pytest.approx(math.radians(cell(Laid(TEXT), "worst")), rel=1e-12)
