"""Good descriptions load to the model that they describe."""

import math
from pathlib import Path

import pytest

from livesheet.formula.nodes import Symbol, Unary
from livesheet.formula.parser import parse_description
from mechsheet.description import Overrides, load, loads
from mechsheet.description.reader import with_settings
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import DescriptionError
from mechsheet.model import (
    TAKES,
    Cartesian,
    ChartRequest,
    Dimension,
    Distances,
    Driver,
    Joint,
    Label,
    Link,
    Mechanism,
    Output,
    Polar,
    Sketch,
    Summary,
    TableRequest,
)
from mechsheet.units import DEG, NUMBER, RAD, unit_of

DATA = Path(__file__).parents[1] / "data"
ORIGIN = Cartesian(0.0, 0.0)
MM, CM = unit_of("mm", "mm"), unit_of("cm", "cm")


def derived(symbol, formula, unit, **more):
    return Dimension(symbol, parse_description(formula), unit, written=formula, **more)


def test_four_bar() -> None:
    path = DATA / "four-bar.toml"
    values = {"a1": 70, "a2": 35, "a3": 62.3, "a4": 56, "b3": 126.6, "c3": 84.1}
    coupler = {
        "A": ORIGIN,
        "B": Cartesian(Symbol("a3"), 0.0),
        "C": Distances("A", Symbol("b3"), "B", Symbol("c3"), "left"),
    }
    assert load(path) == Mechanism(
        name="four-bar",
        title=Label("four-bar"),
        source=Label(""),
        length_unit="mm",
        angle_unit=DEG,
        dimensions=tuple(Dimension(name, value, MM, shown=value) for name, value in values.items()),
        links=(
            Link("ground", 1, {"A0": ORIGIN, "B0": Cartesian(Symbol("a1"), 0.0)}),
            Link("crank", 2, {"A0": ORIGIN, "A": Cartesian(Symbol("a2"), 0.0)}),
            Link("coupler", 3, coupler),
            Link("rocker", 4, {"B0": ORIGIN, "B": Cartesian(Symbol("a4"), 0.0)}),
        ),
        joints=(),
        driver=Driver("theta12", DEG, "crank", "ground", "", 0.0, math.radians(360), math.radians(15), values=()),
        sketch=Sketch({"B": (50.0, 55.0)}, {}),
        outputs=(Output("mu", parse_description("theta14 - theta13"), DEG),),
        text=path.read_text(encoding="utf-8"),
    )


def test_slider_crank() -> None:
    mechanism = load(DATA / "slider-crank.toml")
    joint = Joint("s14", "prismatic", "piston", "ground", "B", (0.0, Symbol("a1")), 0.0, 0.0, "s14")
    assert mechanism.joints == (joint,)
    assert mechanism.dimensions[-1] == Dimension("gamma3", math.radians(30), DEG, shown=30.0)
    assert mechanism.links[2].points["C"] == Polar(Symbol("b3"), Unary("-", Symbol("gamma3")))


def test_adjustable_pump() -> None:
    mechanism = load(DATA / "adjustable-pump.toml")
    assert mechanism.joints == (
        Joint("s15", "prismatic", "plunger", "ground", "D", "A0", math.pi, 0.0, "s15"),
        Joint("s4", "pin-slot", "plunger", "rocker", "D", (Symbol("c4"), 0.0), math.radians(90), 0.0, "s4"),
    )


def test_six_link_dwell() -> None:
    mechanism = load(DATA / "six-link-dwell.toml")
    alpha3 = mechanism.dimensions[-1]
    assert (alpha3.derived, alpha3.unit, alpha3.shown) == (True, DEG, None)
    assert alpha3.written == "acos((AC^2 + AB^2 - BC^2) / (2*AC*AB))"
    assert alpha3.value == parse_description(alpha3.written)
    assert [link.number for link in mechanism.links] == [1, 2, 3, 4, 5, 6]
    assert mechanism.sketch.points == {"B": (740.0, 750.0), "D": (1140.0, 1270.0)}


@pytest.fixture(scope="module")
def everything() -> Mechanism:
    return load(DATA / "everything.toml")


def test_layout_of_the_workbook() -> None:
    text = (DATA / "slider-crank.toml").read_text(encoding="utf-8")
    plain = loads(text)
    assert (plain.layout, plain.drawn, plain.references) == ("sheets", True, "names")
    page = loads(f'{text}\n[workbook]\nlayout = "page"\ndrawing = false\n')
    assert (page.layout, page.drawn, page.references) == ("page", False, "anchors")
    named = loads(f'{text}\n[workbook]\nlayout = "page"\nreferences = "names"\n')
    assert named.references == "names"
    assert loads(with_settings(plain, Overrides(layout="page")).text).layout == "page"
    assert with_settings(page, Overrides()) is page
    with pytest.raises(DescriptionError, match='"sheets", "page"'):
        with_settings(plain, Overrides(layout="book"))


def test_every_key_head(everything: Mechanism) -> None:
    assert everything.name == "every-key_1"
    assert everything.title == Label("Every key", (("tr", "Her anahtar"),))
    assert everything.source == Label("first line\nsecond line")
    assert (everything.length_unit, everything.angle_unit) == ("cm", RAD)
    assert (everything.language, everything.references) == ("tr", "anchors")


def test_every_key_dimensions(everything: Mechanism) -> None:
    label = Label("crank A0A", (("tr", "krank A0A"),))
    assert everything.dimensions == (
        Dimension("a1", 7.0, CM, shown=7.0),
        Dimension("a2", 3.5, CM, label=label, cell="Krank", tolerance=0.1, shown=3.5),
        Dimension("phi0", math.radians(30), DEG, tolerance=0.5, shown=30.0),
        Dimension("half", 0.5, NUMBER, shown=0.5),
        Dimension("turn", 1.5, RAD, shown=1.5),
        derived("late", "2*early", CM, label=Label("late")),
        derived("early", "a1*half", CM),
        derived("gamma3", "acos(half)", DEG, cell="Gama.3"),
    )


def test_every_key_links(everything: Mechanism) -> None:
    ground, crank, coupler, block, rod = everything.links
    assert everything.ground is ground
    assert [link.number for link in everything.links] == [1, 2, 6, 7, 10]
    assert [link.angle_symbol for link in everything.links[1:]] == ["theta12", "theta16", "theta17", "theta1_10"]
    assert ground.points["B0"] == Polar(Symbol("a1"), Unary("-", Symbol("phi0")))
    assert list(crank.points) == ["A0", "A"]
    assert coupler.label == Label("biyel")
    assert coupler.points["C"] == Distances("B", 5.0, "A", parse_description("2*a2"), "right")
    assert block.points == {"C": ORIGIN}
    assert rod.points == {"D": Polar(2.0, 0.25)}


def test_every_key_joints(everything: Mechanism) -> None:
    assert everything.joints == (
        Joint("guide", "prismatic", "block", "ground", "C", "B0", 0.5, parse_description("pi/2"), "s17"),
        Joint("s", "pin-slot", "coupler", "rod", "B", (1.0, parse_description("half*a1")), 0.0, 0.0, "s"),
        Joint("s_b", "pin-slot", "coupler", "rod", "A", "D", Symbol("phi0"), 0.0, "s_b"),
    )


def test_every_key_results(everything: Mechanism) -> None:
    assert everything.driver == Driver("theta62", RAD, "crank", "coupler", values=(0.0, 1.5, Symbol("phi0")))
    assert everything.sketch == Sketch({"B": (50.0, Symbol("a1"))}, {"theta16": 0.75, "s17": parse_description("2*a1")})
    assert everything.outputs == (
        Output("mu", parse_description("theta12 - theta16"), DEG, Label("angle"), "Mu_1"),
        Output("xc", parse_description("C.x + B0.y"), CM),
    )
    assert everything.summaries == (
        Summary("stroke", "s17", TAKES["range"], Label("stroke", (("tr", "kurs"),)), "Kurs"),
        Summary("top", "C.y", TAKES["max"]),
    )
    assert everything.charts == (
        ChartRequest(Label("angles"), "theta62", ("theta12", "mu", "C.x")),
        ChartRequest(paths=("C", "B")),
    )
    columns = (math.radians(10), math.radians(20), parse_description("pi/6"))
    assert everything.tables == (TableRequest("theta62", "phi0", columns, "xc", Label("two ways")),)


def changed(*pairs: tuple[str, str]) -> Mechanism:
    """The four-bar with some of its text replaced."""
    text = (DATA / "four-bar.toml").read_text(encoding="utf-8")
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    return loads(text)


def test_symbol_of_driver_beside_the_angle_of_its_link() -> None:
    """A driver's own symbol and theta1N name the same angle; both may be used."""
    mechanism = changed(('"crank"\n', '"crank"\nsymbol = "phi"\n'), ("theta14 - theta13", "phi - theta12 + theta13"))
    assert mechanism.driver.symbol == "phi"
    assert mechanism.links[1].angle_symbol == "theta12"


def test_driven_displacement() -> None:
    text = 'joint = "guide"\nstart = 230\nstop = 280\nstep = 0.5\n'
    source = (DATA / "slider-crank.toml").read_text(encoding="utf-8")
    driver_at, assembly_at = source.index("[driver]"), source.index("[assembly]")
    source = source[:driver_at] + "[driver]\n" + text + source[assembly_at:]
    source = source.replace('type = "prismatic"', 'type = "prismatic"\nname = "guide"')
    expected = Driver("s14", MM, joint="guide", start=230.0, stop=280.0, step=0.5)
    assert loads(source).driver == expected
    assert loads(source.replace('joint = "guide"', 'joint = "guide"\nsymbol = "s14"')).driver == expected


def test_relative_driver_from_the_tenth_link_on() -> None:
    rename = (("[links.rocker]", "[links.rocker]\nnumber = 12"), ("theta14", "theta1_12"))
    assert changed(*rename).links[3].angle_symbol == "theta1_12"
    relative = changed(*rename, ('link = "crank"', 'link = "rocker"\nrelative_to = "coupler"'))
    assert relative.driver.symbol == "theta3_12"


def test_clockwise_and_single_rows() -> None:
    assert changed(("stop = 360", "stop = -360"), ("step = 15", "step = -7.5")).driver.step == math.radians(-7.5)
    assert changed(("stop = 360", "stop = 0")).driver.stop == 0


def test_names_are_normalised() -> None:
    """A letter typed with a combining mark in one place and as one character in another is one name."""
    mechanism = loads(
        (DATA / "four-bar.toml")
        .read_text(encoding="utf-8")
        .replace("a1 = 70", '"o\u0308lc\u0327u\u0308" = 70')
        .replace('"a1"', '"ölçü"')
    )
    assert mechanism.dimensions[0].symbol == "ölçü"
    assert mechanism.links[0].points["B0"] == Cartesian(Symbol("ölçü"), 0.0)


def test_line_ends_and_byte_order_mark() -> None:
    text = (DATA / "everything.toml").read_text(encoding="utf-8")
    assert loads("\ufeff" + text.replace("\n", "\r\n")) == loads(text)


def test_language() -> None:
    assert load(DATA / "four-bar.toml", Overrides(language="tr")).language == "tr"
    with pytest.raises(DescriptionError, match='unknown language "de"'):
        load(DATA / "four-bar.toml", Overrides(language="de"))


def test_ground_without_points() -> None:
    mechanism = loads(
        """
        format = 1
        mechanism.name = "trammel"
        links.ground.points = {}
        links.bar.points = { P = [0, 0], Q = [100, 0] }
        joints = [
            { type = "pin-slot", point = "P", on = "ground", through = [0, 0], symbol = "x" },
            { type = "pin-slot", point = "Q", on = "ground", through = [0, 0], angle = 90, symbol = "y" },
        ]
        driver = { link = "bar", start = 0, stop = 360, step = 10 }
        """
    )
    assert [joint.symbol for joint in mechanism.joints] == ["x", "y"]


@pytest.mark.parametrize("unit", ["°", "deg", "degrees", "Derece", "deg."])
def test_every_spelling_of_degrees_is_degrees(unit: str) -> None:
    """An angle whose unit is written "°" is shown in degrees, not as radians with that sign behind."""
    text = template_text("four-bar")
    plain = loads(text)
    spelled = loads(text.replace('unit = "deg"', f'unit = "{unit}"'))
    assert spelled.outputs == plain.outputs
    assert spelled.dimensions == plain.dimensions
