"""A sketch drawn at another position than the first: `at` reads it there; without it the right value is named."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from chosen import LISTED, but, part, some
from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.templates import template_names, template_text
from mechsheet.description.text.source import parse
from mechsheet.diagnostics import DescriptionWarning, MechanismError
from mechsheet.exporting.program import program_of
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.library.building import compile_workbook
from mechsheet.library.modes_from_sketch import with_modes
from mechsheet.library.show import overview_text
from mechsheet.model import Sketch

FOUR_BAR = template_text("four-bar")
TEMPLATES = [name for name in template_names() if "[assembly]" in template_text(name)]


def octave(mechanism):
    return program_of(Compiled(mechanism), ())


def modes_of(mechanism):
    return {group.mode: group.mode_value for group in solve(mechanism).groups if group.mode}


def sketched(name, *, pin=False):
    """(mechanism with `at`, driver value as written) for sketches of some rows, exact, of what the template sketches."""
    mechanism = loads(template_text(name))
    dimensions = dimension_values(mechanism)
    driver = driver_values(mechanism, dimensions)
    values = sweep(mechanism, solve(mechanism), driver)
    rows = len(driver)
    for row in part(sorted({rows // 9, rows // 5, rows // 2, 5 * rows // 6}), 3, rows):
        points = {
            point: (float(values[f"{point}.x"][row]), float(values[f"{point}.y"][row]))
            for point in mechanism.sketch.points
        }
        if not all(math.isfinite(value) for pair in points.values() for value in pair):
            continue
        symbols = {symbol: float(values[symbol][row]) for symbol in mechanism.sketch.symbols}
        if pin:
            symbols[mechanism.driver.symbol] = float(driver[row])
        sketch = Sketch(points, symbols, float(driver[row]))
        written = mechanism.driver.unit.to_shown(driver[row])
        step = abs(driver[1] - driver[0])
        yield (
            replace(mechanism, sketch=sketch),
            float(written),
            mechanism.driver.unit.to_shown(step),
        )


@pytest.mark.slow
def test_no_template_is_doubtful():
    """Every packaged sketch is one of the first position, rough as it is."""
    for name in some(template_names(), 2):
        mechanism = loads(template_text(name))
        assert doubts(mechanism, solve(mechanism)) == (), name


@pytest.mark.parametrize("name", some(TEMPLATES, 3))
def test_at_says_where_the_sketch_is_read(name):
    """Drawn at any position, with `at`, the sketch means the assembly of the template, and nobody is warned."""
    wanted = modes_of(loads(template_text(name)))
    for mechanism, _, _ in sketched(name):
        assert modes_of(mechanism) == wanted
        assert doubts(mechanism, solve(mechanism)) == ()


def numbers_behind(text):
    return [
        float(number)
        for number in re.findall(
            r"[-\d.]+(?:e[-+]?\d+)?", text.partition(" fits ")[2].partition("=")[2].partition(":")[0]
        )
    ]


def as_if_first(mechanism, equations):
    """Whether a sketch is so near to the first position that nobody could say that it is another one's."""
    values = sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))
    apart = [
        math.dist(place, [values[f"{point}.{axis}"][0] for axis in "xy"])
        for point, place in mechanism.sketch.points.items()
    ]
    spans = [
        np.ptp([values[f"{point}.{axis}"][0] for link in mechanism.links for point in link.points]) for axis in "xy"
    ]
    return max(apart) < 0.06 * max(spans)


@pytest.mark.parametrize("name", some(but(TEMPLATES, "sun-and-planet"), 4))  # its sketch is of a phase, not of a value
def test_without_at_the_value_is_named(name):
    """The wrong assembly is never taken in silence: the warning, or the error, names the driver value that was drawn."""
    wanted = modes_of(loads(template_text(name)))
    for mechanism, value, step in sketched(name):
        mechanism = replace(mechanism, sketch=replace(mechanism.sketch, at=None))
        try:
            equations = solve(mechanism)
        except MechanismError as error:
            told = error.faults[0].hint
        else:
            found = doubts(mechanism, equations)
            if not found:
                modes = {group.mode: group.mode_value for group in equations.groups if group.mode}
                assert modes == wanted or as_if_first(mechanism, equations)
                continue
            told = found[0].message
        turn = math.inf if mechanism.driver.joint else 360.0
        away = [
            abs(math.remainder(number - value, turn)) if turn == 360.0 else abs(number - value)
            for number in numbers_behind(told)
        ]
        assert min(away) <= 1.01 * step + 1e-3 * abs(value), told


@pytest.mark.cases(5)
@pytest.mark.parametrize("name", some(but(TEMPLATES, *LISTED), 5, 18))
def test_the_reference_reads_the_sketch_there_too(name):
    """The independent solver finds the same positions from the sketch alone, at the value that `at` names."""
    for mechanism, _, _ in part(list(sketched(name)), 3):
        ours = sweep(mechanism, solve(mechanism), driver_values(mechanism, dimension_values(mechanism)))
        solution = reference.solve(mechanism)
        for point, places in solution.points.items():
            there = solution.exists
            assert there.any()
            apart = np.hypot(ours[f"{point}.x"] - places[:, 0], ours[f"{point}.y"] - places[:, 1])[there]
            assert np.nanmax(apart, initial=0.0) < 1e-4 * solution.size, (name, point)


def told(text):
    mechanism = loads(text)
    return [f"{fault.key}: {fault.message}" for fault in doubts(mechanism, solve(mechanism))]


def with_sketch(*lines):
    return FOUR_BAR.replace("B = [50, 55]", "\n".join(lines))


def test_the_drivers_own_pin_tells_the_position():
    """A at 40 degrees: it decides no assembly, but it shows which position was drawn."""
    (message,) = told(with_sketch("A = [26.8, 22.5]", "B = [85, 54]"))
    assert message.startswith("assembly: the sketch is read at the first position, theta12 = 0, but it fits theta12 = ")
    assert abs(numbers_behind(message)[0] - 40) <= 4
    assert told(with_sketch("A = [26.8, 22.5]", "B = [85, 54]", "at = 40")) == []


def test_the_drivers_own_value_tells_the_position():
    (message,) = told(with_sketch("theta12 = 40", "B = [85, 54]"))
    assert abs(numbers_behind(message)[0] - 40) <= 4


def test_at_that_contradicts_the_sketch():
    (message,) = told(with_sketch("A = [26.8, 22.5]", "B = [85, 54]", "at = 200"))
    assert message.startswith("assembly.at: the sketch is said to show theta12 = 200, but it fits theta12 = ")


@pytest.mark.slow
@pytest.mark.parametrize("use", [compile_workbook, overview_text, octave], ids=["build", "show", "export"])
def test_doubts_are_warnings_of_the_library(use):
    with pytest.warns(DescriptionWarning, match="theta12 = 0, but it fits theta12 = ") as caught:
        use(loads(with_sketch("A = [26.8, 22.5]", "B = [85, 54]")))
    assert caught[0].message.fault.key == "assembly"


def test_a_fixed_point_decides_nothing():
    (message,) = told(with_sketch("B = [50, 55]", "A0 = [0, 0]"))
    assert message == 'assembly.A0: "A0" is a point of the ground: sketching it decides nothing'


def test_a_sketch_that_fits_nowhere():
    (message,) = told(with_sketch("B = [500, 550]"))
    assert message.startswith("assembly.B: the sketch of B is far from every position; at theta12 = 0 it is at B.x = ")


@pytest.mark.parametrize("at", ["40", '"2*pi/9"', '"radians(40)"', "400", "-320", "7.5"])
def test_values_of_at(at):
    """Numbers in the driver's unit, expressions in radians; outside the sweep, and between its rows."""
    text = FOUR_BAR.replace("stop = 360", "stop = 30").replace("B = [50, 55]", f"B = [85, 54]\nat = {at}")
    assert modes_of(loads(text)) == modes_of(loads(FOUR_BAR))


def test_at_in_radians():
    text = FOUR_BAR.replace('name = "four-bar"', 'name = "four-bar"\nangle_unit = "rad"').replace(
        "stop = 360", "stop = 6"
    )
    text = text.replace("step = 15", "step = 0.5").replace("B = [50, 55]", "B = [85, 54]\nat = 0.698")
    assert loads(text).sketch.at == 0.698
    assert told(text) == []


def test_at_where_nothing_closes():
    """A clear fault at the key, not the words of some other row."""
    text = FOUR_BAR.replace("value = 35,", "value = 60,").replace("B = [50, 55]", "B = [50, 55]\nat = 180")
    with pytest.raises(
        MechanismError, match="the sketch cannot show this position: there coupler and rocker"
    ) as caught:
        solve(loads(text))
    assert caught.value.faults[0].key == "assembly.at"


@pytest.mark.parametrize("at", ["at = 40", 'at = "radians(200)"', "at = 500"])
def test_a_flipped_mode_comes_back_as_a_sketch_of_the_same_position(at):
    """`pull` rewrites the sketch where it is read: at the value that `at` names, which stays as it was written."""
    source = parse(FOUR_BAR.replace("B = [50, 55]", f"{at}\nB = [85, 54]"), "mine.toml")
    for mode in (-1, 1):
        new = with_modes(source, {"mode_1": mode})
        assert modes_of(loads(new.text)) == {"mode_1": mode}
        assert at in new.text
        if new.text != source.text:
            assert doubts(loads(new.text), solve(loads(new.text))) == ()


def test_a_mode_that_cannot_be_sketched_there_is_sketched_at_the_first_position():
    """At a dead centre both assemblies are one: `at` goes, the sketch is that of the first position."""
    text = FOUR_BAR.replace("value = 35,", "value = 60,").replace(
        "B = [50, 55]", 'at = "acos((a1^2 + a2^2 - (a3 + a4)^2) / (2*a1*a2))"\nB = [50, 55]'
    )
    new = with_modes(parse(text, "mine.toml"), {"mode_1": -1})
    assert modes_of(loads(new.text)) == {"mode_1": -1}
    assert "at = " not in new.text.partition("[assembly]")[2].partition("[outputs]")[0]


def test_a_wheel_sketched_out_of_phase_is_told_the_phase_that_fits():
    text = template_text("geared-five-bar")
    sketch = "P = [0.2, 0.25]\nA = [0.12, 0]\n"
    assert told(text.replace("P = [0.2, 0.25]\n", sketch + "B = [0.3, 0]\n")) == []
    mechanism = loads(text.replace("P = [0.2, 0.25]\n", sketch + "B = [0.18, 0.12]\n"))
    fault, *others = doubts(mechanism, solve(mechanism))
    assert fault.key == "joints.0"
    assert fault.message == "B is sketched 90 degrees away from where the phase puts it"
    assert fault.hint == "write phase = 90, or sketch B elsewhere"
    back = loads(text.replace("P = [0.2, 0.25]\n", sketch + "B = [0.3, 0]\n").replace("phase = 0", "phase = 40"))
    fault, *_others = doubts(back, solve(back))
    assert fault.hint == "write phase = 0, or sketch B elsewhere"  # not 6e-15
    assert not any("phase" in other.message for other in others)
    elsewhere = text.replace("P = [0.2, 0.25]\n", "P = [0.28, 0.2]\nB = [0.3, 0]\n")  # P is no point of the wheel
    assert not any("phase" in message for message in told(elsewhere))


@pytest.mark.parametrize(
    ("phase", "said"), [("10", []), ("40", ["rod is sketched 40.2 degrees away from where the phase puts it"])]
)
def test_a_phase_inside_a_group_that_is_solved_all_at_once_is_held_against_the_sketch(phase, said):
    """There the phase turns arm and rod alike: what the sketch makes of all three links counts."""
    mechanism = loads(
        template_text("sun-and-planet").replace("phase = 0", f"phase = {phase}").replace("stop = 720", "stop = 60")
    )
    faults = doubts(mechanism, solve(mechanism))
    assert [fault.message for fault in faults] == said
    assert all(
        (fault.key, fault.hint) == ("joints.0", "write phase = -0.229, or sketch rod elsewhere") for fault in faults
    )


def test_at_beside_outputs_of_a_motion():
    """What is shown elsewhere has neither speed nor time nor forces; outputs that read them have nothing to do with it."""
    text = FOUR_BAR.replace("step = 15", 'motion = { law = "harmonic", duration = 2 }').replace(
        "stop = 360", "stop = 30"
    )
    text = text.replace(
        "[outputs]", '[[loads]]\nlink = "crank"\ntorque = 1\n[outputs]\nw = { formula = "omega14*t*T12" }'
    )
    assert modes_of(loads(text.replace("B = [50, 55]", "B = [85, 54]\nat = 40"))) == modes_of(loads(FOUR_BAR))


def test_a_falling_sweep_is_told_a_value_that_it_reaches():
    text = (
        FOUR_BAR.replace("start = 0", "start = 150")
        .replace("stop = 360", "stop = 30")
        .replace("step = 15", "step = -5")
    )
    (message,) = told(text.replace("B = [50, 55]", "A = [26.8, 22.5]\nB = [85, 54]"))
    assert abs(numbers_behind(message)[0] - 40) <= 4
