"""Mends beyond one change of a column: summaries, two faults in one formula, drivers nobody reads, the text's routines."""

from __future__ import annotations

from dataclasses import replace

import pytest

import mechsheet
from chosen import first
from homework.handmade import FOUR_BAR, STEPS, Table, four_bar
from homework.styles import STYLES as LAYOUTS
from livesheet.formula.nodes import Binary, Call, Number
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet import description
from mechsheet.homework.audit import audit, audited
from mechsheet.homework.expected_values import asked_of
from mechsheet.homework.formula_strips import upright
from mechsheet.homework.mends.candidates import Surroundings, candidates, pairs

pytestmark = pytest.mark.slow

LEAST = {"A40": "mu_min", "B40": "=MIN(L9:L33)"}


@pytest.fixture(scope="module")
def mechanism():
    text = mechsheet.template("four-bar").text
    return description.loads(text + "\n[exercise]\nasked = { theta13 = 2, theta14 = 2, mu_min = 1 }\n", "four-bar")


def judged(tmp_path, mechanism, cells=None, **slips):
    table = Table(FOUR_BAR, four_bar(**slips), cells={**LEAST, **(cells or {})})
    found = audit(table.save(tmp_path / "book.xlsx"), mechanism)
    return found, {symbol: one.verdict for symbol, one in found.asked.items()}


SUMMARIES = {
    "largest for smallest": ("MAX(L9:L33)", "function"),
    "a part of the column": ("MIN(L20:L30)", "range"),
    "another column": ("MIN(K9:K33)", "range"),
    "degrees once more": ("MIN(L9:L33)*180", "factor too many"),
}


@pytest.mark.parametrize("slip", first(list(SUMMARIES), 2))
def test_a_wrong_summary_is_told_with_its_mend(tmp_path, mechanism, slip):
    formula, kind = SUMMARIES[slip]
    found, verdicts = judged(tmp_path, mechanism, {"B40": f"={formula}"})
    assert verdicts == {"theta13": "right", "theta14": "right", "mu_min": "wrong"}
    assert [(fault.cells, fault.mend, fault.kind) for fault in found.faults] == [("Sayfa1!B40", "MIN(L9:L33)", kind)]
    assert (found.plain, found.follow_through) == (4, 4)


def test_a_summary_of_a_wrong_column_follows(tmp_path, mechanism):
    found, verdicts = judged(tmp_path, mechanism, t14="ATAN2({yB},{xB}-{a1})")
    assert verdicts == {"theta13": "right", "theta14": "wrong", "mu_min": "follows"}
    assert [fault.cells for fault in found.faults] == ["Sayfa1!K9:K33"]


PAIRS = {
    "a sign and a bracket": (
        {"g": "ACOS(({a3}^2-{s}^2-{a4}^2)/2*{a3}*{s})"},
        "ACOS(($B$4^2+E9^2-$B$5^2)/(2*$B$4*E9))",
        {"theta13": "follows", "theta14": "follows", "mu_min": "follows"},
    ),
    "arguments and a sign": (
        {"t14": "ATAN2({yB},{xB}+{a1})"},
        "ATAN2(I9-$B$2,J9)",
        {"theta13": "right", "theta14": "wrong", "mu_min": "follows"},
    ),
}


@pytest.mark.ci
@pytest.mark.parametrize("slip", first(list(PAIRS), 1))
def test_two_faults_in_one_formula_are_mended_together(tmp_path, mechanism, slip):
    changes, mend, expected = PAIRS[slip]
    found, verdicts = judged(tmp_path, mechanism, **changes)
    assert [(fault.mend, fault.kind) for fault in found.faults] == [(mend, "two changes")]
    assert verdicts == expected


def test_pairs_are_no_single_changes_and_each_formula_comes_once():
    formula = Binary("-", Call("SIN", (Number(3.0),)), Binary("*", Number(2.0), Call("COS", (Number(5.0),))))
    around = Surroundings((), (), ())
    found = [one.formula for one in pairs(formula, around)]
    wanted = Binary("+", Call("COS", (Number(3.0),)), Binary("*", Number(2.0), Call("COS", (Number(5.0),))))
    assert wanted in found
    assert len(set(found)) == len(found)
    assert not {one.formula for one in candidates(formula, around) if one.weight <= 1.6} & set(found)


LOST = {
    "an anchor too many": ("down", "RADIANS($A$17)"),
    "to the right": ("to the right", "RADIANS($P$1)"),
    "the heading's row": ("two sheets", "RADIANS($A16)"),
}


@pytest.mark.parametrize("slip", first(list(LOST), 1))
def test_a_driver_that_no_formula_reads_any_more_is_found(slip):
    """Its column stands beside the table; nothing else says which column it was."""
    style, wrong = LOST[slip]
    four_bar_ = mechsheet.template("four-bar")
    book = LAYOUTS[style](four_bar_)
    sheet = book.sheets[-1]
    place = next(n for n, block in enumerate(sheet.blocks) if block.rows * block.cols > 3)
    assert isinstance(sheet.blocks[place].formula, Call)
    sheet.blocks[place] = replace(sheet.blocks[place], formula=parse_formula(wrong))
    found = audited(upright(book), four_bar_, asked_of(four_bar_), "book")
    assert {one.verdict for one in found.asked.values()} == {"follows"}
    assert len(found.faults) == 1


ROUTINES = {
    "Turkish": {"t14": "DörtÇubuk({a2},{a3},{a4},{a1},1,{fi})"},
    "plain letters": {"s": "Boy({a1}-{xA},-{yA})", "b": "Aci({a1}-{xA},-{yA})", "g": "AciCos({a3},{s},{a4})"},
    "English": {"t14": "FourBar({a2},{a3},{a4},{a1},1,{fi})", "s": "Mag({a1}-{xA},-{yA})"},
}


@pytest.mark.cases(1)
@pytest.mark.parametrize("words", ROUTINES)
def test_the_routines_of_the_text_are_known(tmp_path, mechanism, words):
    """A macro never runs; its cells would keep their values when a dimension is retyped, and would not be live."""
    found, verdicts = judged(tmp_path, mechanism, **ROUTINES[words])
    assert (verdicts["theta13"], verdicts["theta14"]) == ("right", "right")
    assert not any("unknown" in remark for remark in found.remarks)


@pytest.mark.ci
def test_a_wrong_argument_of_a_routine_is_mended(tmp_path, mechanism):
    found, _ = judged(tmp_path, mechanism, t14="DortCubuk({a2},{a3},{a4},{a1},-1,{fi})")
    assert [fault.mend for fault in found.faults] == ["DORTCUBUK($B$3,$B$4,$B$5,$B$2,1,B9)"]


def test_a_macro_that_is_only_called_like_a_routine_keeps_its_values(tmp_path, mechanism):
    """Here Boy is something else: the file says what it gave."""
    from livesheet.formats import read

    path = Table(FOUR_BAR, four_bar(s="Boy({a1}-{xA},-{yA})")).save(tmp_path / "book.xlsx")
    book = read(path)
    book.sheets[0].cached.put(8, 4, 1234.5)
    assert not upright(book).book.names
    book.sheets[0].cached.put(8, 4, 65.0)
    assert [name.name for name in upright(book).book.names] == ["BOY"]


def test_the_pumps_routine_is_known(tmp_path):
    """`AyarlıPompa` takes degrees, in the text's order of arguments; its column is the pump's displacement."""
    text = mechsheet.template("adjustable-pump").text + "\n[exercise]\nasked = { s15 = 1 }\n"
    pump = description.loads(text, "pump")
    order = ("a2", "a3", "a4", "b1", "c4", "s1")
    values = {
        dim.symbol: float(dim.unit.to_shown(dim.value)) for dim in pump.dimensions if isinstance(dim.value, float)
    }
    given = [(symbol, symbol, values[symbol]) for symbol in order]
    call = ",".join(f"{{{symbol}}}" for symbol in order)
    table = Table(given, [("derece", "deg", STEPS), ("x", "x", f"AyarlıPompa({call},{{deg}})")])
    assert audit(table.save(tmp_path / "pump.xlsx"), pump).right


LARGE = {
    "watt-ii": ("two sheets", "RADIANS($A22)", "$A22"),
    "rigid-body-guidance": ("names", "v_y_A0+v_a2*SIN(B89)", "v_y_A0+v_a2/SIN(B89)"),
}


@pytest.mark.parametrize("name", first(list(LARGE), 1))
def test_a_fault_in_a_large_linkage_is_found(name):
    """With dozens of formulas, or of dimensions that are computed from a task, in which nothing is right any more."""
    style, was, now = LARGE[name]
    mechanism = mechsheet.template(name)
    book = LAYOUTS[style](mechanism)
    blocks = book.sheets[-1].blocks
    place = next(n for n, block in enumerate(blocks) if print_formula(block.formula) == was)
    blocks[place] = replace(blocks[place], formula=parse_formula(now))
    found = audited(upright(book), mechanism, asked_of(mechanism), name)
    assert [(fault.formula, fault.mend) for fault in found.faults] == [(now, was)]


NEARLY = {
    "mu in degrees": ({"mu": "({t14}-{t13})*57.3"}, "(K9-H9)*(180/PI())"),
    "the crank in radians": ({"fi": "{deg}/57.3"}, "A9/(180/PI())"),
    "times a short number": ({"fi": "{deg}*0.01745"}, "A9*(PI()/180)"),
}


@pytest.mark.parametrize("how", NEARLY)
def test_a_rounded_factor_of_degrees_is_what_it_stands_for(tmp_path, how):
    """57.3 was mended by a term from anywhere that happened to fit, or by leaving the degrees out."""
    changes, mend = NEARLY[how]
    path = Table(FOUR_BAR, four_bar(**changes)).save(tmp_path / "book.xlsx")
    found = mechsheet.audit(path, mechsheet.template("four-bar"))
    assert [(fault.mend, fault.kind) for fault in found.faults] == [(mend, "value of pi")]
