"""Every template opens on the page: where the reference has its points, quickly, and nothing of it is changed."""

import json
import math

import numpy as np
import pytest
from asking_page import Drawing, pin, spot

from chosen import but, some
from folders import TEMPLATE_FILES
from loaded_mechanisms import SUSPENSION
from mechsheet import reference
from mechsheet.description import load
from mechsheet.drawing_page.answers import Studio
from mechsheet.drawing_page.looking import look
from mechsheet.drawing_page.reading import read, typed_in_cell
from mechsheet.kinematics.sweep import rough_poses
from mechsheet.library.building import compile_workbook

FOUR_BAR = next(path for path in TEMPLATE_FILES if path.stem == "four-bar")


def looked(text, at=None, held=None, language="en"):
    return look(read(text, "mine.toml"), at, held or {}, language)


@pytest.mark.parametrize("path", some(TEMPLATE_FILES, 2), ids=lambda path: path.stem)
def test_positions_are_those_of_the_reference(path):
    reading = read(path.read_text(encoding="utf-8"), path.name)
    found = look(reading, None, {})
    assert found["solved"]
    assert found["faults"] == []
    frames = found["frames"]
    compiled = reading.compiled
    truth = reference.solve(compiled.mechanism, start=rough_poses(compiled.mechanism, compiled.equations))
    size = np.nanmax(np.abs(np.array([truth.points[name] for name in truth.points])))
    places, driver = np.array(frames["driver"]), compiled.mechanism.driver.unit.to_shown(compiled.driver)
    stepped = len(places) != len(driver)  # other sweeps show their rows alone
    rows = [int(np.argmin(np.abs(places - each))) if stepped else row for row, each in enumerate(driver)]
    assert places[rows] == pytest.approx(driver, abs=1e-8)
    for name, columns in frames["points"].items():
        true = np.asarray(truth.points[name], float)
        for axis, column in enumerate(columns):
            shown = np.array([column[row if len(column) > 1 else 0] for row in rows], float)
            closed = np.isfinite(true[:, axis])
            assert shown[closed] == pytest.approx(true[closed, axis], abs=1e-6 * size), name
    json.dumps(found, allow_nan=False)


@pytest.mark.cases(10)
@pytest.mark.slow
@pytest.mark.parametrize("path", TEMPLATE_FILES, ids=lambda path: path.stem)
def test_a_template_is_written_back_unchanged(path, tmp_path):
    mine = tmp_path / path.name
    mine.write_bytes(path.read_bytes())
    studio = Studio(mine)
    begun = studio.answer("begin", {})
    saved = studio.answer("save", {"text": begun["text"], "mark": begun["mark"]})
    assert saved["saved"]
    assert mine.read_bytes() == path.read_bytes()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("engine", {"flywheel"}),
        ("geared-five-bar", set()),
        ("five-bar-robot", {"values"}),
        ("adjustable-pump", {"tables"}),
        ("four-bar", set()),
    ],
)
def test_what_cannot_be_drawn_is_said(name, said):
    path = FOUR_BAR.with_stem(name)
    assert said <= set(looked(path.read_text(encoding="utf-8"))["undrawn"])


@pytest.mark.slow
def test_a_shaper_is_shown_as_it_cuts():
    """The position that a workbook shows first; at 0 degrees no load acts."""
    path = FOUR_BAR.with_stem("shaper")
    found = looked(path.read_text(encoding="utf-8"))
    _, plan = compile_workbook(load(path))
    shown = found["frames"]["driver"][found["at"]]
    assert shown == pytest.approx(plan.mechanism.driver.unit.to_shown(float(plan.nominal["theta12"][plan.first_shown])))
    (arrow, *_) = [shape for shape in found["shapes"] if shape["kind"] == "load"]
    assert all(
        column[found["at"] if len(column) > 1 else 0] is not None for vector in arrow["places"] for column in vector
    )


def test_springs_and_loads_stand_where_their_points_are():
    found = looked(SUSPENSION)
    kinds = [shape["kind"] for shape in found["shapes"]]
    assert {"spring", "damper", "load", "torque", "weight", "mass"} == set(kinds)
    spring, load = (found["shapes"][kinds.index(kind)] for kind in ("spring", "load"))
    frames = len(found["frames"]["driver"])
    for shape, point in ((spring, "E"), (load, "W")):
        for axis in range(2):
            assert shape["places"][0][axis] == found["frames"]["points"][point][axis]
            assert len(shape["places"][1][axis]) in (1, frames)
    end = [np.add(*(np.array(spring["places"][part][axis]) for part in (0, 1))) for axis in range(2)]
    assert end[0] == pytest.approx(np.full(frames, 250), abs=1e-3)
    assert end[1] == pytest.approx(np.full(frames, 260), abs=1e-3)
    json.dumps(found, allow_nan=False)
    assert looked(FOUR_BAR.read_text(encoding="utf-8"))["shapes"] == []


def test_the_position_asked_for_is_among_those_shown():
    found = looked(FOUR_BAR.read_text(encoding="utf-8"), at=33.3)
    assert found["frames"]["driver"][found["at"]] == pytest.approx(33.3)
    assert found["frames"]["driver"] == sorted(found["frames"]["driver"])
    assert set(range(0, 361, 15)) <= set(found["frames"]["driver"])


def test_a_position_of_another_turn_is_the_same():
    text = FOUR_BAR.read_text(encoding="utf-8")
    first, later = looked(text, at=40), looked(text, at=400)
    assert first["frames"]["points"] == later["frames"]["points"]


@pytest.mark.parametrize(("a2", "limits"), [(50, True), (35, False)])
def test_limits_are_found_between_the_positions(a2, limits):
    """The crank and the coupler in line with the rocker: a triangle of a1, a2 and a3 + a4 or |a3 - a4|."""
    text = FOUR_BAR.read_text(encoding="utf-8").replace("value = 35,", f"value = {a2},")
    found = looked(text)
    a1, a3, a4 = 70, 62.3, 56
    cosine = (a1**2 + a2**2 - (a3 + a4) ** 2) / (2 * a1 * a2)
    if limits:
        angle = math.degrees(math.acos(cosine))
        assert found["limits"] == pytest.approx([angle, 360 - angle], abs=1e-4)
        assert set(found["frames"]["why"]) == {0, 1}
        assert "coupler" in found["frames"]["reasons"][1]["links"]
    else:
        assert found["limits"] == []
        assert cosine < -1


@pytest.mark.parametrize(
    ("old", "new", "links", "key"),
    [
        ('"a3", 0]', '"a9", 0]', [], "links.coupler.points.B"),
        ("value = 70,", "value = 300,", ["coupler", "rocker"], "dimensions"),
        ("A0 = [0, 0], A =", "A1 = [0, 0], A =", ["crank"], "links.crank"),
    ],
)
def test_faults_are_told_at_their_line_and_link(old, new, links, key):
    text = FOUR_BAR.read_text(encoding="utf-8")
    assert old in text
    found = looked(text.replace(old, new))
    assert not found["solved"]
    assert any(fault["key"].startswith(key) and fault["line"] for fault in found["faults"]), found["faults"]
    assert set(links) <= {name for fault in found["faults"] for name in fault["links"]}
    assert set(found["frames"]["points"]) >= {"A0", "B0", "A", "B", "C"}


@pytest.mark.parametrize("text", ["", "a = ", "\x00", "[[[", "a = 1\na = 2", "é" * 1_000_001])
def test_what_is_no_toml_is_a_fault_and_no_drawing(text):
    found = looked(text)
    assert found["faults"]
    assert not found["readable"]


@pytest.mark.parametrize(
    "text",
    ["a = 1", "links = 5", "[links]\nground = 5", "joints = 3", "[links.ground]\npoints = { A = [1] }", "[driver]\nlink = 4",
     "[links.a]\npoints = { A = { r = 'x', angle = 0 } }\n[links.b]\npoints = { A = [0, 0] }\n[assembly]\nA = 3",
     "[[joints]]\ntype = 'gear'", "[dimensions]\na = { formula = 'a' }"],
)  # fmt: skip
def test_what_is_hardly_a_description_is_looked_at_all_the_same(text):
    found = looked(text)
    assert found["readable"]
    assert not found["solved"]
    assert found["faults"]


def test_degrees_of_freedom_are_counted_before_there_is_a_driver():
    text = FOUR_BAR.read_text(encoding="utf-8")
    start, end = text.index("[driver]"), text.index("[assembly]")
    found = looked(text[:start] + text[end:])
    assert found["mobility"] == 1
    assert [fault["key"] for fault in found["faults"] if not fault["line"]] == ["driver"]


def test_loose_links_are_named_in_the_words_of_show():
    text = FOUR_BAR.read_text(encoding="utf-8").replace("B0 = [0, 0], B =", "D0 = [0, 0], B =")
    found = looked(text)
    assert found["mobility"] == 3
    assert any('"rocker" is loose' in fault["message"] for fault in found["faults"])


def test_half_a_drawing_is_not_told_how_many_drivers_it_would_need():
    """Two links, nothing driven: the loose one is named; "2 drivers would be needed, one is given" would be untrue."""
    drawing = Drawing().do("ground", end=spot(0, 0)).do("link", ends=[pin("A0"), spot(20, 30)])
    drawing.do("link", ends=[pin("A"), spot(75, 60)])
    assert drawing.look["mobility"] == 2
    assert [fault["key"] for fault in drawing.look["faults"]] == ["driver", "links.link3"]


def test_titles_and_reasons_come_in_both_languages():
    text = FOUR_BAR.read_text(encoding="utf-8").replace("value = 35,", "value = 50,")
    assert looked(text, language="tr")["title"] == "Dört-çubuk mekanizması"
    assert "kapanmıyor" in looked(text, language="tr")["frames"]["reasons"][1]["text"]


@pytest.mark.cases(6)
@pytest.mark.parametrize("path", but(some(TEMPLATE_FILES, 4)), ids=lambda path: path.stem)
def test_an_answer_is_small(path):
    """It is sent with every step of a drag."""
    assert len(json.dumps(looked(path.read_text(encoding="utf-8")))) < 250_000


@pytest.mark.parametrize("name", ["cam-slide", "cam-rocker", "cam-valve"])
def test_a_cam_is_drawn_and_its_segments_can_be_typed(name):
    """Profile, base circle and what touches are shapes of every position; angles and ways are cells of the list."""
    text = (FOUR_BAR.parent / f"{name}.toml").read_text(encoding="utf-8")
    found = looked(text)
    assert [shape["kind"] for shape in found["shapes"]].count("cam") >= 3
    cells = {cell["place"]: cell["value"] for cell in found["cells"]}
    assert cells["driver.segments[1].over"] in (80, 90, 110)
    changed = typed_in_cell(read(text, "mine.toml"), "driver.segments[1].over", "100")
    assert read(changed, "mine.toml").compiled.mechanism.drivers[0].segments.parts[0].law in changed
    assert {cell["place"]: cell["value"] for cell in looked(changed)["cells"]} == {
        **cells,
        "driver.segments[1].over": 100,
    }
