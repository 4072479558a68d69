"""`check --mutate`: damaged formulas, and who notices."""

import runpy
from dataclasses import replace
from pathlib import Path

import pytest
from edited import laid_out, saved

from chosen import ALL
from folders import TEMPLATES
from livesheet.formats import read
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from livesheet.formula.references import column_letters
from livesheet.formula.slips import damages
from mechsheet.checking import mutate
from mechsheet.checking.edited.edits import edits_of
from mechsheet.checking.inputs import expected_for
from mechsheet.description import Overrides, load
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.building import build

pytestmark = pytest.mark.slow


def texts(formula, kind, names=()):
    tree = parse_formula(formula)
    return {print_formula(damage.of(tree)) for damage in damages(tree, names) if damage.kind == kind}


@pytest.mark.parametrize(
    ("formula", "kind", "expected"),
    [
        ("A1+2", "operator", {"A1-2"}),
        ("A1<2", "operator", {"A1>2", "A1<=2"}),
        ("A1-2", "sign", {"-A1-2"}),
        ("-A1", "sign", {"A1"}),
        ("B2", "reference", {"B3", "B1", "C2", "A2"}),
        ("A1", "reference", {"A2", "B1"}),
        ("B2", "anchor", {"B$2", "$B2"}),
        ("$B$2", "anchor", {"B$2", "$B2"}),
        ("crank+1", "reference", {"rod+1"}),
        ("SIN(A1)", "function", {"COS(A1)"}),
        ("ATAN2(A1,B1)", "function", {"ATAN2(B1,A1)"}),
        ("IF(A1,1,2)", "function", {"IF(A1,2,1)"}),
        ("RADIANS(A1)", "function", {"DEGREES(A1)", "A1"}),
        ("2*A1", "constant", {"3*A1", "2.02*A1", "-2*A1"}),
        ("A1&\"ok\"", "constant", {"A1&\"okx\""}),
        ("SUM(A1:A3)", "reference", {"SUM(A2:A3)", "SUM(B1:A3)", "SUM(A1:A4)", "SUM(A1:A2)", "SUM(A1:B3)"}),
    ],
)  # fmt: skip
def test_kinds_of_damage(formula, kind, expected):
    assert texts(formula, kind, ("crank", "rod")) == expected


def test_no_damage_leaves_a_formula_as_it_was():
    tree = parse_formula('IF(ABS(A1)>1,NA(),-2*ATAN2(B$2,$C3)^2+MAX(D1:D9)&"x")')
    found = [damage.of(tree) for damage in damages(tree, ("a", "b"))]
    assert len(found) > 30
    assert tree not in found


@pytest.fixture(scope="module")
def yoke(tmp_path_factory):
    return saved(laid_out("scotch-yoke")[0], tmp_path_factory.mktemp("mutate") / "scotch-yoke.xlsx")


def test_check_catches_all_and_the_same_seed_does_the_same(yoke):
    found = mutate(yoke, 3)
    assert len(found.damages) == 3
    assert found.clear
    assert found.agrees
    assert found.share("check") == 1.0
    assert found == mutate(yoke, 3)
    assert {damage.where for damage in found.damages} != {damage.where for damage in mutate(yoke, 3, seed=5).damages}
    assert sum(count for count, _ in found.tally(lambda damage: damage.kind).values()) == 3


@pytest.mark.full
@pytest.mark.ci
def test_the_sheet_alone_notices_a_pin_that_moves(tmp_path):
    """Its gaps are measured from points and lengths only; docs/proof.md holds the figures of all templates."""
    workbook, plan = laid_out("four-bar")
    found = mutate(saved(workbook, tmp_path / "four-bar.xlsx"), 60 if ALL else 30, seed=3, sheets=["positions"])
    pins = {f"{plan.table}!{column_letters(plan.at.spots[name].col)}" for name in ("A.x", "A.y", "B.x", "B.y")}
    moved = [
        damage
        for damage in found.damages
        if damage.where.rstrip("0123456789:").split(":")[0].rstrip("0123456789") in pins
    ]
    assert len(moved) > 3
    # but one that keeps the lengths: the mirror image, a turned frame
    assert sum(damage.sheet for damage in moved) > 0.7 * len(moved)


def test_a_page_has_no_checks_of_its_own(tmp_path):
    mechanism = load(TEMPLATES / "scotch-yoke.toml", overrides=Overrides(layout="page"))
    (page,) = build(mechanism, tmp_path, ("xlsx",))
    found = mutate(page, 3)
    assert [damage.sheet for damage in found.damages] == [False] * 3
    assert all(damage.check for damage in found.damages)


def test_survivors_are_told(yoke):
    found = mutate(yoke, 3)
    data = found.as_dict()
    missed = [damage for damage in found.damages if not damage.sheet]
    assert data["caught"]["sheet"] == 3 - len(missed)
    assert len(data["survivors"]) == len(missed)
    assert data["damages"] == 3


def test_edits_show_every_kind_of_damage(yoke):
    """Not only those that change a value."""
    book = read(yoke)
    expected = expected_for(laid_out("scotch-yoke")[1].mechanism.text, "inside")
    assert edits_of(book, expected).edits == ()
    for sheet in book.sheets:
        for block in sheet.blocks[:: 7 if ALL else 21]:
            for damage in damages(block.formula)[::12]:
                others = [replace(one, formula=damage.of(one.formula)) if one is block else one for one in sheet.blocks]
                damaged = replace(
                    book, sheets=[replace(one, blocks=others) if one is sheet else one for one in book.sheets]
                )
                assert edits_of(damaged, expected).edits, (sheet.title, block, damage)


def test_a_workbook_without_description(tmp_path):
    workbook, _ = laid_out("scotch-yoke")
    path = saved(replace(workbook, sheets=workbook.sheets[:-1]), tmp_path / "foreign.xlsx")
    with pytest.raises(MechsheetError, match="carries no description"):
        mutate(path, 1)


def test_formulas_of_forces_alone_are_damaged_and_the_sheet_asks_both_ways_to_the_torque(tmp_path):
    text = (
        'format = 1\n[mechanism]\nname = "crank"\n[links.ground]\npoints = { A0 = [0, 0] }\n[links.crank]\n'
        "points = { A0 = [0, 0] }\nmass = 2\ncenter = [30, 4]\ninertia = 1e-3\n"
        '[driver]\nlink = "crank"\nstart = 0\nstop = 90\nstep = 30\nspeed = 5\nacceleration = 2\n'
        "[dynamics]\ngravity = 9.81\n"
    )
    path = tmp_path / "crank.toml"
    path.write_text(text, encoding="utf-8")
    found = mutate(path, 8, sheets=("forces",))
    assert found.clear
    assert found.agrees
    assert {damage.where.partition("!")[0] for damage in found.damages} == {"Forces"}
    assert 0 < found.caught("sheet") < 8  # the size of a joint force is read by nobody


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("name", ["quick-return-lever", "quick-return-slider"])
def test_formulas_of_a_synthesis_alone_are_damaged(tmp_path, name):
    path = saved(laid_out(name)[0], tmp_path / f"{name}.xlsx")
    found = mutate(path, 8 if ALL else 3, sheets=("synthesis",))
    assert found.clear
    assert found.agrees
    assert {damage.where.partition("!")[0] for damage in found.damages} == {"Synthesis"}


LEVER = """
format = 1
[mechanism]
name = "lever"
[links.ground]
points = { A0 = [0, 0] }
[links.lever]
points = { A0 = [0, 0], C = [80, 10] }
mass = 2
center = "C"
[driver]
link = "lever"
start = 0
stop = 90
step = 30
[dynamics]
gravity = 9.81
"""


def test_every_formula_of_a_sheet_is_damaged_in_every_way_that_it_can_be(tmp_path):
    path = tmp_path / "lever.toml"
    path.write_text(LEVER, encoding="utf-8")
    said = []
    found = mutate(path, None, progress=said.append, sheets=("forces",))
    assert found.agrees
    assert {each.where.rpartition("!")[0] for each in found.damages} == {"Forces"}
    formulas = {each.where for each in found.damages}
    assert said[-1] == f"Forces: formula {len(said)} of {len(said)}"
    assert len(formulas) >= len(said) - 2  # what every damage leaves as it is: a formula that is 0
    kinds = [(each.where, each.kind) for each in found.damages]
    assert len(kinds) == len(set(kinds)) > len(formulas)


def test_the_proofs_table_knows_every_sheet_of_a_template_with_a_flywheel():
    """It ended in an IndexError after an hour of damaging, when the table was made."""
    proof = runpy.run_path(str(Path(__file__).parents[2] / "tools" / "proof.py"))
    titles = proof["sheet_titles"]("engine")
    found = {title: proof["place_of"](title, titles) for title in ("Positions", "Rates", "Forces", "Table s14")}
    assert found == {"Positions": "positions", "Rates": "others", "Forces": "others", "Table s14": "tables"}
