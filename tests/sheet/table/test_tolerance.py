"""The sheet of tolerances: what it says is what textbooks say, it follows what is typed, and it is small."""

import math
from dataclasses import replace

import numpy as np
import pytest
from laid import Laid
from placed import places_of

import mechsheet
from chosen import ITERATED, but
from folders import TEMPLATES
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.printer import print_formula
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.model import Tolerances
from mechsheet.sheet.columns.bands import ROOT, WORST
from mechsheet.sheet.plan import MEANING
from mechsheet.sheet.table.tolerance import lines_of

NAMES = [
    name
    for name in but([path.stem for path in sorted(TEMPLATES.glob("*.toml"))], *ITERATED)
    if "[synthesis" not in template_text(name)  # which finds all their dimensions
]

SLIDER = template_text("slider-crank")
A1, A2, A3 = 20.0, 50.0, 250.0
T1, T2, T3 = 0.1, 0.05, 0.2


def slider(of='["stroke"]', language="en", references="names", source=SLIDER):
    text = source
    for name, tolerance in (("a1", T1), ("a2", T2), ("a3", T3)):
        text = text.replace(f"{name} = {{ value", f"{name} = {{ tolerance = {tolerance}, value")
    own = f'[workbook]\nlanguage = "{language}"\nreferences = "{references}"\n'
    return loads(f"{text}\n[tolerance]\nof = {of}\n{own}")


def numbers(mechanism, typed=()):
    """A workbook's engine values by spot, with cells typed: {spot: value}."""
    compiled = Compiled(mechanism)
    plan = compiled.plan
    overrides = {}
    for key, value in dict(typed).items():
        spot = places_of(plan)[key]
        overrides[spot.sheet, spot.row, spot.col] = value
    values = evaluate(book_of(compiled.layout), overrides)

    def cell(key, col=None):
        spot = places_of(plan)[key]
        return values.get(spot.sheet, spot.row, spot.col if col is None else col)

    return plan, cell, values


def lay_out(mechanism):
    """The workbook, as far as it can be laid out."""
    return Compiled(mechanism).layout


def by_hand(a1=A1, a2=A2, a3=A3):
    """Derivatives of the stroke of an offset slider-crank, sqrt((a3 + a2)^2 - a1^2) - sqrt((a3 - a2)^2 - a1^2)."""
    far, near = math.sqrt((a3 + a2) ** 2 - a1**2), math.sqrt((a3 - a2) ** 2 - a1**2)
    return -a1 / far + a1 / near, (a3 + a2) / far + (a3 - a2) / near, (a3 + a2) / far - (a3 - a2) / near


@pytest.mark.slow
@pytest.mark.parametrize("references", ["names", "anchors"])
def test_the_stroke_of_a_slider_crank_by_hand(references):
    """Its extremes lie between the rows: there the derivatives are taken."""
    _, cell, _ = numbers(slider(references=references))
    parts = [abs(each * t) for each, t in zip(by_hand(), (T1, T2, T3), strict=True)]
    assert cell(f"{WORST} of stroke") == pytest.approx(sum(parts), rel=1e-7)
    assert cell(f"{ROOT} of stroke") == pytest.approx(math.hypot(*parts), rel=1e-7)
    assert cell("band stroke") == cell(f"{WORST} of stroke")


@pytest.mark.slow
def test_what_is_typed_is_followed():
    """A tolerance and a dimension are inputs."""
    _, cell, _ = numbers(slider(), {"tolerance a2": 0.5, "a1": 60.0})
    parts = [abs(each * t) for each, t in zip(by_hand(a1=60.0), (T1, 0.5, T3), strict=True)]
    assert cell(f"{WORST} of stroke") == pytest.approx(sum(parts), rel=1e-6)


@pytest.mark.slow
def test_shares_come_to_one_and_the_largest_is_named():
    plan, cell, values = numbers(slider('["stroke", "mu"]'))
    for line in lines_of(plan):
        columns = [plan.at.spots[name].col for name in plan.banded[line.quantity].derivatives]
        shares = [values.get(plan.at.titles["tolerance"], line.row + 1, col) for col in columns]
        assert sum(shares) == pytest.approx(1.0)
    assert cell("band stroke", MEANING) == "100.3 ± 0.1 mm; mostly a₂ (100 %)"


@pytest.mark.slow
def test_turkish():
    plan, cell, _ = numbers(slider(language="tr"))
    assert plan.at.titles["tolerance"] == "Tolerans"
    assert "en çok a₂ (%100)" in cell("band stroke", MEANING)


@pytest.mark.slow
def test_decimals_follow_the_band():
    """100.8 +- 0.1: no digit that the tolerances cannot hold."""
    compiled = Compiled(slider('["stroke", "C.x"]'))
    plan = compiled.plan
    assert plan.band_decimals["s14"] == 1
    sheet = compiled.workbook.sheet(plan.main)
    row = plan.blocks["summary"].rows["stroke"]
    (value,) = (fill for fill in sheet.fills if (fill.row, fill.col) == (row, 1))
    assert value.style.number_format == "0.0"


@pytest.mark.slow
def test_a_dead_centre_has_no_derivative():
    """A parallelogram in line: no number there, and the words say why."""
    text = template_text("four-bar")
    for old, new in (
        ("value = 62.3", "value = 70"),
        ("value = 56", "value = 35, tolerance = 0.1"),
        ("B = [50, 55]", "B = [95, 25]\nat = 45"),
    ):
        text = text.replace(old, new)
    plan, _, values = numbers(loads(f'{text}\n[tolerance]\nof = ["theta14"]\n'))
    title, column = plan.at.titles["tolerance"], plan.at.spots["theta14:a4"].col
    assert [values.get(title, plan.at.first + row, 1) for row in (3, 12)] == ["ok", "dead centre"]
    assert isinstance(values.get(title, plan.at.first + 3, column), float)
    assert not isinstance(values.get(title, plan.at.first + 12, column), float)


def test_newtons_groups_are_refused():
    mechanism = load(TEMPLATES / "stephenson-ii-class-iv.toml")
    first = next(dim for dim in mechanism.dimensions if not dim.derived)
    dimensions = tuple(replace(dim, tolerance=0.1) if dim is first else dim for dim in mechanism.dimensions)
    asked = replace(mechanism, dimensions=dimensions, bands=Tolerances((mechanism.links[2].angle_symbol,), ()))
    with pytest.raises(MechanismError, match="solved all at once"):
        lay_out(asked)


def test_what_no_dimension_changes_is_refused():
    with pytest.raises(MechanismError, match='no dimension with a tolerance changes "gone"'):
        lay_out(slider('["gone"]', source=SLIDER.replace("[outputs]", '[outputs]\ngone = { formula = "b3" }')))


def test_of_all_outputs_those_have_bands_that_a_tolerance_changes():
    """Where the description names none: a length without a tolerance is not asked for by anybody."""
    source = SLIDER.replace("[outputs]", '[outputs]\ngone = { formula = "b3" }')
    source = source.replace("a2 = { value", f"a2 = {{ tolerance = {T2}, value")
    bands = mechsheet.loads(source).tolerance()
    assert "stroke" in bands
    assert "gone" not in bands


@pytest.mark.slow
def test_a_template_with_tolerances_has_the_bands_that_its_first_lines_promise(tmp_path):
    """The spring of this suspension lies between the frame and an arm whose dimensions have no tolerance."""
    linkage = mechsheet.template("double-wishbone")
    assert {"camber", "spring"} & {*linkage.tolerance()} == {"camber"}
    (book,) = linkage.build(tmp_path, formats="xlsx", tolerance=True)
    assert mechsheet.check(book).agrees


def all_toleranced(name):
    """A template with a tolerance at every input and a band of its last angle or displacement."""
    mechanism = load(TEMPLATES / f"{name}.toml")
    dimensions = tuple(dim if dim.derived or dim.path else replace(dim, tolerance=0.05) for dim in mechanism.dimensions)
    if mechanism.bands is not None:
        return replace(mechanism, dimensions=dimensions)
    compiled = Compiled(mechanism)
    moved = [(driver.symbol,) for driver in mechanism.drivers if driver.segments] or [("theta13",)]
    groups = [group.unknowns for group in compiled.equations.groups] or moved
    return replace(mechanism, dimensions=dimensions, bands=Tolerances((groups[-1][-1],), ()))


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize("name", NAMES)
def test_the_sheet_has_no_more_formulas_a_quantity_than_the_positions(name):
    """And they are short, whatever has a tolerance."""
    compiled = Compiled(all_toleranced(name))
    plan = compiled.plan
    sheet, table = (compiled.layout.sheet(plan.at.titles[key]) for key in ("tolerance", "positions"))
    count, most = (sum(fill.rows * fill.cols for fill in each.fills) for each in (sheet, table))
    count -= sum(
        fill.rows * fill.cols for fill in sheet.fills if fill.row > plan.at.last
    )  # a few lines below the table
    assert count <= most * len(plan.mechanism.bands.quantities)
    assert max(len(print_formula(fill.formula, "excel")) for fill in sheet.fills) <= 460


def test_ranges_of_another_sheet_are_written_as_they_are_read():
    """`Extremes!$A$1:Extremes!$A$3` comes back as `Extremes!$A$1:$A$3`: the workbook would count as edited when fresh."""
    source = SLIDER.replace("[summary]", '[summary]\nend = { of = "s14", take = "last" }')
    sheets = lay_out(slider('["end"]', source=source)).sheets
    (sheet,) = (sheet for sheet in sheets if sheet.title == "Tolerance")
    written = [print_formula(fill.formula) for fill in sheet.fills]
    assert any("MAX(Extremes!" in text for text in written)
    assert not any(":Extremes!" in text for text in written)


@pytest.mark.slow
def test_a_cams_follower_stands_where_base_circle_and_offset_put_it():
    """s is moved by the cam and no driver: its derivatives are those of neighbours."""
    text = template_text("cam-slide") + '\n[tolerance]\nof = ["s"]\n'
    for symbol, value in (("rb", 40), ("e", 8)):
        text = text.replace(f"{symbol} = {{ value = {value},", f"{symbol} = {{ value = {value}, tolerance = 0.1,")
    laid = Laid(text)
    columns = {symbol: np.array(laid.column(f"s:{symbol}")) for symbol in ("rb", "e")}
    for symbol, value in (("rb", 40), ("e", 8)):
        sides = []
        for change in (-1e-4, 1e-4):
            laid.change(**{symbol: value + change})
            sides.append(np.array(laid.column("s")))
        laid.change(**{symbol: value})
        assert columns[symbol] == pytest.approx((sides[1] - sides[0]) / 2e-4, abs=1e-6)
