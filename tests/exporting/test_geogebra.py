"""The constructions for GeoGebra: their expressions computed here, and by the real program where it is."""

import ast
import math
import re
import xml.etree.ElementTree as ET
import zipfile
from io import BytesIO

import numpy as np
import pytest
from exported import worst_against_reference
from geogebra import BUNDLE, geogebra

from chosen import ITERATED, but, some
from folders import TEMPLATE_FILES
from mechsheet.compiled import compiled_of
from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.exporting import Job, export, exported
from mechsheet.exporting.functions.routines import Source
from mechsheet.exporting.geogebra import construction_of, label_of
from mechsheet.kinematics.angle_branch import WINDOWED
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.model import Mechanism
from random_mechanisms import Grower

POSITIONS = 25
CHANGES = (1.0, 0.995, 1.007)
"""What each length is multiplied by, every second one: three sets of dimensions."""

CASES = but(TEMPLATE_FILES, *ITERATED)


def text_of(content):
    return zipfile.ZipFile(BytesIO(content)).read("geogebra.xml").decode()


def asked(mechanism: Mechanism):
    """The file, its construction, and symbol -> label of what people read."""
    construction = construction_of(Job(mechanism, mechanism.name))
    text = construction.text()
    source = Source(compiled_of(mechanism))
    taken = {name: WINDOWED.format(symbol=name) if name in source.branches else name for name in source.variables()}
    equations = source.equations
    numbers = {
        name: construction.labels.get(symbol)
        for name, symbol in taken.items()
        if equations.of(name).role in ("variable", "output")
    }
    return text, construction, {name: label for name, label in numbers.items() if label}


# --- computed here ---------------------------------------------------------------------------------------------------

WORDS = re.compile(r"\?|&&|\|\||!(?!=)|\^|\d[\d.]*(?:E[+-]?\d+)?|[^\W\d]\w*(?:\{[^}]*\})?")
PYTHON = {"?": "nan", "&&": " and ", "||": " or ", "!": " not ", "^": "**"}
FUNCTIONS = {
    "If": np.where, "IsDefined": np.isfinite, "Max": np.maximum, "Min": np.minimum, "atan2": np.arctan2,
    "abs": np.abs, "acos": np.arccos, "asin": np.arcsin, "atan": np.arctan, "ln": np.log, "sgn": np.sign,
    "x": lambda point: point[0], "y": lambda point: point[1],
    **{name: getattr(np, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "floor", "round")},
}  # fmt: skip
OPERATORS = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide, ast.Pow: np.power, ast.Lt: np.less,
    ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal, ast.Eq: np.equal, ast.NotEq: np.not_equal,
    ast.USub: np.negative, ast.UAdd: np.positive, ast.Not: np.logical_not,
}  # fmt: skip


def computed(text, given):
    """What the expressions of numbers and points give, label -> array or pair of arrays, from the values of the sliders."""
    known, kind = {"pi": math.pi, "nan": math.nan, **given}, kinds(text)
    for part in ET.fromstring(text).find("construction"):
        if part.tag == "expression" and kind[part.get("label")] in ("numeric", "point"):
            with np.errstate(all="ignore"):
                known[part.get("label")] = value(part.get("exp"), known)
    return known


def value(expression, known):
    """An expression as GeoGebra writes them: calls in brackets or parentheses, labels with subscripts in braces."""
    labels = []

    def word(match):
        found = match.group()
        if found in PYTHON or found in FUNCTIONS or found[0].isdigit():
            return PYTHON.get(found, found)
        labels.append(found)
        return f"_{len(labels) - 1}"

    def of(node):
        match node:
            case ast.Constant(number):
                return number
            case ast.Name(name):
                return known[labels[int(name[1:])]] if name.startswith("_") else known[name]
            case ast.Tuple(parts):
                return tuple(map(of, parts))
            case ast.UnaryOp(operator, x):
                return OPERATORS[type(operator)](of(x))
            case ast.BinOp(x, operator, y):
                return OPERATORS[type(operator)](of(x), of(y))
            case ast.Compare(x, [operator], [y]):
                return OPERATORS[type(operator)](of(x), of(y))
            case ast.BoolOp(operator, parts):
                fold = np.logical_and if isinstance(operator, ast.And) else np.logical_or
                return fold(*map(of, parts))
            case ast.Call(ast.Name(name), parts) | ast.Subscript(ast.Name(name), ast.Tuple(parts)):
                return FUNCTIONS[name](*map(of, parts))
            case ast.Subscript(ast.Name(name), x):
                return FUNCTIONS[name](of(x))
        raise AssertionError(ast.dump(node))

    return of(ast.parse(WORDS.sub(word, expression), mode="eval").body)


def kinds(text):
    return {part.get("label"): part.get("type") for part in ET.fromstring(text).iter("element")}


def sliders(mechanism, labels, share=1.0):
    """Label -> value of every slider but the driver's; every second length is changed by a share."""
    values = dimension_values(mechanism)
    found, changed = {}, {}
    for number, dim in enumerate(dim for dim in mechanism.dimensions if not dim.derived):
        value = values[dim.symbol] * (share if number % 2 and dim.unit.kind == "length" else 1.0)
        changed[dim.symbol] = value
        if dim.symbol in labels:
            found[labels[dim.symbol]] = value
    return found, changed


def driven(mechanism):
    """The driver's values, and of what else is driven, at some of the rows."""
    given = given_values(mechanism, dimension_values(mechanism))
    rows = np.unique(np.linspace(0, len(given[mechanism.driver.symbol]) - 1, POSITIONS).round().astype(int))
    return {symbol: column[rows] for symbol, column in given.items()}


def arrays(mechanism, rows, numbers, points):
    """As `worst_against_reference` takes them; a position is there when all of it is."""
    found = {symbol: rows[symbol] for symbol in driven(mechanism)} | numbers
    return found | {f"{name}.{axis}": place[at] for name, place in points.items() for at, axis in enumerate("xy")}


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("path", some(CASES, 2), ids=lambda path: path.stem)
def test_the_expressions_give_what_the_reference_gives(path):
    """For the described dimensions; a wrong order of atan2, a lost sign, a label read too early would be seen."""
    mechanism = load(path)
    text, construction, numbers = asked(mechanism)
    labels, points = construction.labels, construction.places
    rows = driven(mechanism)
    given, _ = sliders(mechanism, labels)
    modes = {group.mode: group.mode_value for group in compiled_of(mechanism).equations.groups if group.mode}
    given |= {labels[mode]: float(value) for mode, value in modes.items() if mode in labels}
    given |= {labels[symbol]: column for symbol, column in rows.items() if symbol in labels}
    known = computed(text, given)
    count = len(rows[mechanism.driver.symbol])
    moving = [name for name in points if f"{name}.x" in compiled_of(mechanism).values]
    exists = np.all(
        [np.isfinite(np.broadcast_to(known[points[name]][0], count)) for name in moving] or [np.ones(count, bool)], 0
    )
    assert exists.any()
    found = {symbol: np.broadcast_to(known[label], count) for symbol, label in numbers.items() if label in known}
    places = {name: [np.broadcast_to(part, count) for part in known[points[name]]] for name in moving}
    assert found or places
    assert worst_against_reference(mechanism, arrays(mechanism, rows, found, places)) < 1e-9


# --- the file --------------------------------------------------------------------------------------------------------


def test_labels_are_the_names_of_the_textbook():
    wanted = {
        "theta12": "theta_{12}", "a2": "a_2", "A0": "A_0", "s14": "s_{14}", "phi_2": "phi_2", "AyarAçısı": "AyarAçısı",
        "A0B0": "A0B0", "Alfa1": "Alfa_1",
    }  # fmt: skip
    assert {symbol: label_of(symbol) for symbol in wanted} == wanted


def test_names_that_geogebra_reads_otherwise_are_taken_by_nobody():
    text = loads(template_text("slider-crank").replace("a2", "e").replace("a3", "t"))
    labels = construction_of(Job(text, "m"))
    assert '"e"' not in labels.text() and '"t"' not in labels.text()
    assert {labels.labels["e"], labels.labels["t"]} == {"e_{1}", "t_{1}"}


def test_all_that_is_drawn_has_its_element():
    text = text_of(exported(load(TEMPLATE_FILES[0].parent / "four-bar.toml"), "geogebra"))
    found = list(kinds(text).values())
    assert found.count("locus") == 1  # the coupler point's path
    assert found.count("segment") == 2 and found.count("polyline") >= 3  # crank, rocker; coupler, two supports
    assert 'label="said"' in text and "Locus[C, theta_{12}]" in text


def turned_lines(text):
    """Labels of the curves that turn with a cam."""
    found = ET.fromstring(text).iter("expression")
    return [part.get("label") for part in found if part.get("exp").startswith("PolyLine[Rotate[First[")]


@pytest.mark.parametrize(("name", "curves"), [("cam-rocker", 2), ("cam-flat", 1), ("four-bar", 0)])
def test_a_cam_has_its_profile_and_the_pitch_curve_of_its_roller(name, curves):
    text = text_of(exported(loads(template_text(name)), "geogebra"))
    assert len(turned_lines(text)) == curves


def test_texts_of_the_description_stay_texts():
    source = template_text("four-bar")
    odd = re.sub(r"(?m)^title = .*$", 'title = "a < b & \\\\"c\\\\""', source, count=1)
    root = ET.fromstring(text_of(exported(loads(odd), "geogebra")))
    assert root.find("construction").get("title") == 'a < b & "c"'


def test_what_newton_solves_has_no_construction():
    with pytest.raises(MechanismError, match=r"constructions for GeoGebra: .* have no closed form"):
        exported(load(next(path for path in TEMPLATE_FILES if path.stem == ITERATED[0])), "geogebra")


def test_same_bytes(tmp_path):
    mechanism = load(TEMPLATE_FILES[0].parent / "fivelink.toml")
    one, two = (export(mechanism, "geogebra", tmp_path / name)[0].read_bytes() for name in ("a.ggb", "b.ggb"))
    assert one == two


# --- the real program ------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def program():
    if BUNDLE is None:
        pytest.skip("MECHSHEET_GEOGEBRA names no folder with GeoGebra's bundle (docs/contributing.md)")
    with geogebra() as found:
        yield found


@pytest.mark.chromium
@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_geogebra_computes_what_the_reference_computes(program, path):
    """With three sets of dimensions, at up to 25 positions; with the described ones everything is defined and drawn."""
    judged = worst_of(program, load(path))
    assert judged and max(judged) < 1e-9, judged


@pytest.mark.chromium
@pytest.mark.parametrize("seed", range(700, 706))
def test_geogebra_computes_random_mechanisms(program, seed):
    judged = worst_of(program, loads(Grower(seed, 1 + seed % 6).text(13)))
    assert judged and max(judged) < 1e-9, judged


CAMS = [path for path in TEMPLATE_FILES if path.stem.startswith("cam-")]
ON_THE_LINE = 1e-3
"""A touched place is so near to the drawn profile, in parts of the base circle's radius: the line has corners."""


@pytest.mark.chromium
@pytest.mark.parametrize("path", CAMS, ids=lambda path: path.stem)
def test_geogebra_turns_the_profile_below_the_follower(program, path):
    """The place at which cam and follower touch, as our columns have it, lies on the profile, whatever the cam's angle."""
    mechanism = load(path)
    compiled = compiled_of(mechanism)
    content = exported(mechanism, "geogebra")
    program.load(content)
    labels = construction_of(Job(mechanism, mechanism.name)).labels
    rows = driven(mechanism)[mechanism.driver.symbol][::5]
    at = [int(np.argmin(np.abs(compiled.driver - angle))) for angle in rows]
    # every cam of the templates turns about the origin
    way = -rows if mechanism.cam.clockwise else rows
    x, y = (compiled.values[f"cam.{axis}"][at] for axis in "xy")
    places = np.column_stack([x * np.cos(way) - y * np.sin(way), x * np.sin(way) + y * np.cos(way)])
    profile = turned_lines(text_of(content))[-1]
    found = program.distances(labels[mechanism.driver.symbol], rows.tolist(), places.tolist(), profile)
    assert max(found) < ON_THE_LINE * np.hypot(x, y).min()
    assert "°°" not in program.said()  # an angle of GeoGebra shows its degrees itself


def worst_of(program, mechanism):
    """The largest difference for each set of dimensions with which there is a position."""
    _, construction, numbers = asked(mechanism)
    labels, points = construction.labels, construction.places
    program.load(exported(mechanism, "geogebra"))
    assert program.undefined() == []
    rows, found = driven(mechanism), []
    driver = mechanism.driver.symbol
    moving = [name for name in points if f"{name}.x" in compiled_of(mechanism).values]
    if len(rows) > 1:
        return [0.0]  # what is driven besides is listed row by row
    for share in CHANGES:
        given, changed = sliders(mechanism, labels, share)
        program.set(given)
        if driver not in labels:
            continue
        values = program.rows(
            labels[driver], rows[driver].tolist(), list(numbers.values()), [points[m] for m in moving]
        )
        table = np.array([[*first, *(x for place in second for x in place)] for first, second in values], float)
        table[~np.isfinite(table).all(axis=1)] = math.nan
        if not np.isfinite(table).any():
            continue
        columns = dict(zip(numbers, table.T[: len(numbers)], strict=True))
        places = {name: table.T[len(numbers) + 2 * at :][:2] for at, name in enumerate(moving)}
        from test_python import dimensions_of

        found.append(
            worst_against_reference(
                mechanism, arrays(mechanism, rows, columns, places), dimensions_of(mechanism, changed)
            )
        )
    return found
