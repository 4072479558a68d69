"""Triangulated plates: points given by their distances from points that are given by distances in turn.

Written out, a place repeated the places that it is given by, twenty times as long from level to level.
"""

import pytest
from laid import Laid

import mechsheet
from chosen import ALL, part
from livesheet.formula.printer import print_formula
from mechsheet.description import loads
from mechsheet.exporting import KINDS
from mechsheet.kinematics.solve import solve
from mechsheet.reference import solve as refer
from mechsheet.sheet.columns.lowering import lowered

HEAD = """
format = 1
[mechanism]
name = "plate"
[dimensions]
a2 = 35
a3 = 62.3
u_E = { value = 50, label = "a name that the workbook would give" }
"""

TAIL = """
[driver]
link = "crank"
start = 0
stop = 360
step = 20
[assembly]
B = [50, 55]
"""

LETTERS = "EFGHIJKLMNPQ"


def chain(count):
    """C from A and B, then each of `count` points from the two before it, left and right in turn."""
    points = ["A = [0, 0]", 'B = ["a3", 0]', 'C = { distances = { A = 126.6, B = 84.1 }, side = "left" }']
    before = ["B", "C"]
    for index, name in enumerate(LETTERS[:count]):
        near = '"u_E"' if index == 0 else 50 + index
        side = "right" if index % 2 == 0 else "left"
        points.append(f'{name} = {{ distances = {{ {before[-1]} = {near}, {before[-2]} = 70 }}, side = "{side}" }}')
        before.append(name)
    return points


def plate(count, order=1):
    """A four-bar whose coupler is such a plate; `order` -1 lists its points from the last to the first."""
    coupler = "\n".join(chain(count)[::order])
    return f"""{HEAD}
[links.ground]
points = {{ A0 = [0, 0], B0 = [70, 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.coupler.points]
{coupler}
[links.rocker]
points = {{ B0 = [0, 0], B = [56, 0] }}
{TAIL}"""


def frame(count):
    """A four-bar on a truss: its second fixed pin is the last of a chain on the ground, its coupler ends there as well."""
    points = "\n".join(chain(count)).replace("A =", "A0 =", 1).replace("A =", "A0 =")
    last = LETTERS[count - 1]
    return f"""{HEAD}
[links.ground.points]
{points}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.coupler]
points = {{ A = [0, 0], D = [150, 0] }}
[links.rocker]
points = {{ {last} = [0, 0], D = [160, 0] }}
{TAIL.replace("B = [50, 55]", "D = [50, -155]")}"""


TEXTS = {"three": plate(2), "ten": plate(9), "from the last": plate(4, -1), "truss": frame(5)}


@pytest.mark.slow
@pytest.mark.parametrize("name", TEXTS)
def test_formulas_stay_short(name):
    laid = Laid(TEXTS[name])
    assert laid.words("largest_gap") == "largest gap of a joint: rounding only"
    longest = max(len(print_formula(fill.formula, "excel")) for sheet in laid.workbook.sheets for fill in sheet.fills)
    assert longest < 5000
    constants = [equation.symbol for equation in laid.plan.equations.constants]
    assert len(set(constants)) == len(constants)
    assert "u_E" not in constants


@pytest.mark.parametrize("count", [2, 9])
def test_length_does_not_grow_with_depth(count):
    """The equations of the last point are as long as those of the first that is laid off from others."""
    mechanism = loads(plate(count))
    equations = lowered(mechanism, solve(mechanism))
    texts = {eq.symbol: print_formula(eq.expression, "text") for eq in equations.all}
    last = LETTERS[count - 1]
    assert len(texts[f"{last}.x"]) < 60
    assert max(len(text) for symbol, text in texts.items() if symbol.startswith(("u_", "v_"))) < 80


@pytest.mark.slow
def test_grashof_of_a_truss():
    """The distance of the fixed pins reads cells: 4 lengths, one of them five triangles away."""
    laid = Laid(TEXTS["truss"])
    ground = refer(laid.mechanism).points["I"][0]
    lengths = sorted([35, 150, 160, float((ground[0] ** 2 + ground[1] ** 2) ** 0.5)])
    excess = laid.spot("grashof_1")
    assert excess == pytest.approx(2 * (lengths[0] + lengths[3]) - sum(lengths), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "language"), part([("three", "en"), ("truss", "tr")], of=2))
def test_files_agree(name, language, tmp_path):
    for path in mechsheet.build(mechsheet.loads(TEXTS[name], language=language), tmp_path, ("xlsx", "ods")):
        report = mechsheet.check(path)
        assert report.agrees, report


@pytest.mark.parametrize("to", list(KINDS) if ALL else ["python"])
def test_exports(to, tmp_path):
    path = tmp_path / f"plate{KINDS[to].suffix}"
    mechsheet.export(mechsheet.loads(TEXTS["ten"]), to, path)
    assert path.stat().st_size < 150_000
