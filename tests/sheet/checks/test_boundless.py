"""What grows without bound at a limit, or between two rows, has no largest value: the sheet says so in a word."""

import json
import math

import numpy as np
import pytest
from laid import Laid

import mechsheet
from livesheet.formula.nodes import ErrorValue
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.library.show import overview_text
from mechsheet.library.verdicts import verdicts_of
from mechsheet.sheet.checks.boundless import may_grow

pytestmark = pytest.mark.slow

NA = ErrorValue("#N/A")

OUTPUTS = """
[outputs]
wedge = { formula = "1/sin(theta14 - theta13)", unit = "mm" }
ratio = { formula = "omega14/omega12" }
advantage = { formula = "omega12/omega14" }

[summary]
wedge_max = { of = "wedge", take = "max" }
wedge_min = { of = "wedge", take = "min" }
ratio_max = { of = "ratio", take = "max" }
advantage_max = { of = "advantage", take = "max" }
faster = { of = "alpha14", take = "max" }
swing = { of = "theta14", take = "range" }
"""
CRANK_ROCKER = template_text("four-bar").partition("[outputs]")[0] + OUTPUTS
CRANK_ROCKER = CRANK_ROCKER.replace("step = 15", 'step = 15\nspeed = { value = 60, unit = "rpm" }')
AROUND = CRANK_ROCKER.replace("start = 0", "start = -180").replace("stop = 360", "stop = 180")
"""With a2 = 50 one stretch of positions, which ends where the rocker's dyad is stretched: the transmission angle is 180."""

WORDS = {"en": "grows without bound", "tr": "sınırsız büyür"}


def summary(laid, name):
    """The number and the words of a summary's line."""
    row = laid.plan.blocks["summary"].rows[name]
    return laid.values.get(laid.plan.main, row, 1), laid.values.get(laid.plan.main, row, 4)


@pytest.mark.cases(1)
@pytest.mark.parametrize("language", WORDS)
def test_what_is_without_bound_at_a_limit_has_no_number(language):
    laid = Laid(AROUND, language).change(a2=50)
    for name in ("wedge_max", "ratio_max", "faster"):
        value, words = summary(laid, name)
        assert value == NA and WORDS[language] in words, name
    for name in ("wedge_min", "swing"):
        value, words = summary(laid, name)
        assert isinstance(value, float) and WORDS[language] not in words, name


def test_a_pole_between_two_rows_is_no_extreme():
    """The mechanical advantage where the rocker turns back; the ratio of the speeds is an ordinary curve there."""
    laid = Laid(CRANK_ROCKER)
    value, words = summary(laid, "advantage_max")
    assert value == NA and WORDS["en"] in words
    for name in ("wedge_max", "ratio_max", "faster", "swing"):
        value, words = summary(laid, name)
        assert isinstance(value, float) and WORDS["en"] not in words, name


ABSOLUTE = {
    "quotient": ("abs(omega12/omega14)", "max"),
    "slow": ("-1/(2*abs(omega14))", "min"),
    "both": ("abs(omega14)*(2 + cos(theta12 - radians(195)))/abs(omega14)", None),
    "one": ("abs(omega14)*(2 + cos(theta12 - radians(20)))/abs(omega14)", None),
}
"""Outputs divided by an absolute value, and which of their extremes there is not; `both` and `one` are 0/0 where the rocker
turns back, beside their largest value, and have no pole."""


@pytest.mark.cases(2)
@pytest.mark.parametrize("name", ABSOLUTE)
def test_an_absolute_value_hides_no_pole(name):
    """It has no sign that changes between two rows: what stands in it has."""
    formula, without = ABSOLUTE[name]
    text = CRANK_ROCKER.partition("[outputs]")[0] + f'[outputs]\n{name} = {{ formula = "{formula}", unit = "1" }}\n'
    text += "[summary]\n" + "".join(f'{way}_of = {{ of = "{name}", take = "{way}" }}\n' for way in ("min", "max"))
    laid = Laid(text)
    for way in ("min", "max"):
        value, words = summary(laid, f"{way}_of")
        assert (WORDS["en"] in words) == (way == without)
        assert value == NA if way == without else isinstance(value, float)
    if without is None:
        assert summary(laid, "max_of")[0] == pytest.approx(3) and summary(laid, "min_of")[0] == pytest.approx(1)


def test_a_row_beside_the_pole_of_an_absolute_value():
    """A row 0.017 of a row beside where the bucket turns back: its force ratio is 32, of the others less than 1."""
    changed = {
        "alpha": 26.370702764646275, "b": 2324.839666776864, "ey": 804.3888036527657, "gy": 302.0375999708186,
        "d": 1328.607058517391, "r": 220.4787933745097, "kx": -17.51474371996449, "m": 440.8761601368815,
        "h": 944.5726953185302,
    }  # fmt: skip
    value, words = summary(Laid(template_text("excavator")).change(**changed), "ratio_max")
    assert value == NA and WORDS["en"] in words


@pytest.mark.ci
def test_programs_and_check_are_told_the_same(tmp_path):
    mechanism = loads(AROUND, overrides=Overrides({"a2": "50"}))
    said = json.loads(verdicts_of(mechanism).as_json())
    assert said["ratio_max"]["value"] is None and WORDS["en"] in said["ratio_max"]["words"]
    assert abs(said["ratio_max"]["where"]) == pytest.approx(160.41, abs=0.01)
    assert said["wedge_min"]["value"] == pytest.approx(1)
    assert "ratio_max: grows without bound" in overview_text(mechanism)
    (tmp_path / "m.toml").write_text(AROUND.replace("value = 35,", "value = 50,"), encoding="utf-8")
    (path,) = mechsheet.load(tmp_path / "m.toml").build(tmp_path / "m.xlsx")
    assert mechsheet.check(path).agrees


def test_a_page_says_as_much_to_programs():
    """A description for one sheet: all verdicts nevertheless."""
    text = AROUND.partition("[outputs]")[0]
    said = json.loads(verdicts_of(loads(f'{text}\n[workbook]\nlayout = "page"\n')).as_json())
    assert said == json.loads(verdicts_of(loads(text)).as_json())
    assert said["swing_theta14"]["value"] == pytest.approx(78.94412837)


@pytest.mark.cases(2)
@pytest.mark.parametrize(
    ("formula", "grows"),
    [
        ("sin(theta14)*cos(theta13)", False),
        ("where(theta14 - pi, C.x/a1, sqrt(abs(theta13))^2)", False),
        ("theta13*exp(-theta14)", False),
        ("1/(2 + cos(theta14))", True),
        ("sin(1/theta14)", False),
        ("tan(theta14)", True),
        ("theta14^theta13", True),
        ("omega14/100", True),
    ],
)
def test_what_is_divided_by_nothing_that_varies_is_bounded(formula, grows):
    outputs = f'asked = {{ formula = "{formula}", unit = "1" }}'
    asked = '[summary]\nmost = { of = "asked", take = "max" }\n'
    laid = Laid(f"{CRANK_ROCKER.partition('[outputs]')[0]}\n[outputs]\n{outputs}\n{asked}")
    assert may_grow(laid.plan, "asked") == grows


def test_a_bounded_output_does_not_grow_without_bound():
    """Three of its rows lie as if its reciprocal went through 0 in a straight line."""
    text = template_text("four-bar").partition("[outputs]")[0]
    text += '[outputs]\nw = { formula = "sin(theta14)*cos(theta13)" }\n[summary]\nleast = { of = "w", take = "min" }\n'
    laid = Laid(text).change(a1=48.13136312848412, a2=39.36807294533667, a3=54.5460355465693, a4=36.71428895818196)
    value, words = summary(laid, "least")
    assert -1 <= value <= 1 and WORDS["en"] not in words


FLAT = """
format = 1
mechanism.name = "flat"
links.ground.points = { O = [0, 0] }
links.tappet.points = { F = [0, 0] }
joints = [{ type = "prismatic", link = "tappet", on = "ground", point = "F", through = [0, 0], angle = 90, symbol = "s" }]
driver = { joint = "s", step = 5, segments = [SEGMENTS] }
cam = { center = "O", base_radius = 40, face = { link = "tappet", point = "F", angle = 90 } }
[summary]
least = { of = "rho", take = "min" }
fastest = { of = "s.dd", take = "max" }
slowest = { of = "s.dd", take = "min" }
"""
RISE = '{ law = "harmonic", over = 40, to = 5 }, { law = "dwell", over = 30 }'
BACK = '{ law = "harmonic", over = 40, to = 0 }, { law = "dwell" }'


def test_where_segments_meet_a_leap_is_no_pole():
    """s'' = 2 h (pi/beta)^2/4 where the rise begins; rho is 40 + s + s'' where it ends, its other sign."""
    laid = Laid(FLAT.replace("SEGMENTS", f"{RISE}, {BACK}"))
    most = 5 / 2 * (180 / 40) ** 2
    assert laid.spot("summary fastest") == pytest.approx(most)
    assert laid.spot("summary least") == pytest.approx(45 - most)
    assert WORDS["en"] not in laid.words("least_rho")


def test_an_acceleration_that_changes_its_sign_quickly_has_a_largest_value():
    """From one segment to the next s'' goes from its least to its largest between three rows."""
    rise = '{ law = "parabolic", over = 70, to = 4.464 }, { law = "modified trapezoid", over = 20, to = 5.346 }'
    laid = Laid(FLAT.replace("SEGMENTS", rise + ', { law = "dwell", over = 200 }, { law = "modified sine", to = 0 }'))
    factor = 8 * math.pi / (2 + math.pi)
    assert laid.spot("summary slowest") == pytest.approx(-factor * 0.882 / math.radians(20) ** 2)


KNIFE = """
format = 1
mechanism.name = "knife"
links.ground.points = { O = [3, 4], G = [8, 3] }
links.f.points = { C = [2, 1], D = [60, 0] }
cam = { center = "O", base_radius = 31, roller = { point = "C", radius = 0 } }
[[joints]]
type = "prismatic"
name = "guide"
link = "f"
on = "ground"
point = "D"
through = "G"
angle = -98
orientation = 0.3
symbol = "s"
[driver]
joint = "guide"
step = 10
closed = false
segments = [
  { law = "modified sine", over = 92, to = -0.3 }, { law = "cycloidal", over = 24, to = 2.1 },
  { law = "dwell", over = 146 }, { law = "uniform", over = 98, to = 3.2 },
]
[summary]
most = { of = "kappa", take = "max" }
"""


def test_the_curvature_of_a_rollers_way_has_no_pole():
    """Over three rows of its cycloidal rise it goes from hollow to sharp, as it would beside one."""
    laid = Laid(KNIFE)
    mechanism = loads(KNIFE.replace("step = 10\n", "step = 0.1\n"))
    assert laid.spot("summary most") == pytest.approx(np.max(compiled_of(mechanism).values["kappa"]), rel=1e-4)
    assert WORDS["en"] not in summary(laid, "most")[1]
