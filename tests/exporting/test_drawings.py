"""svg and dxf, read back: every point where the engine has it, in every template; windows, layers, frames, bytes."""

import math
import subprocess
import sys

import ezdxf
import numpy as np
import pytest
from ezdxf.enums import TextEntityAlignment
from lxml import etree

from folders import TEMPLATE_FILES
from loaded_mechanisms import SUSPENSION
from mechsheet.description import load, loads
from mechsheet.diagnostics import MechsheetError, MissingProgramError
from mechsheet.exporting import export
from mechsheet.library.building import compile_workbook
from mechsheet.library.show import variables_of

pytestmark = pytest.mark.slow

SVG = "{http://www.w3.org/2000/svg}"
BY_NAME = {path.stem: path for path in TEMPLATE_FILES}


def points_of_svg(path):
    root = etree.parse(path).getroot()
    (group,) = [group for group in root.iter(f"{SVG}g") if group.get("id") == "points"]
    assert group.get("transform") == "scale(1,-1)"
    return {circle.get("id"): (float(circle.get("cx")), float(circle.get("cy"))) for circle in group}


def points_of_dxf(path):
    space = ezdxf.readfile(path).modelspace()
    return {
        point.dxf.layer.removeprefix("POINTS "): (point.dxf.location.x, point.dxf.location.y)
        for point in space.query("POINT")
    }


def test_links_pass_their_points(tmp_path):
    """The drawing's own lines, taken out of its window, end where the points are."""
    mechanism = load(BY_NAME["four-bar"])
    (path,) = export(mechanism, "dxf", tmp_path / "it.dxf", at=75)
    points = points_of_dxf(path)
    lines = {line.dxf.layer: line for line in ezdxf.readfile(path).modelspace().query("LWPOLYLINE")}
    for link in mechanism.links[1:]:
        corners = np.array([corner[:2] for corner in lines[link.label.of("en") if link.label else link.name]])
        for point in link.points:
            assert np.hypot(*(corners - points[point]).T).min() < 1e-9 * 70, (link.name, point)
    (svg,) = export(mechanism, "svg", tmp_path / "it.svg", at=75)
    texts = {line.find(f"{SVG}title").text: line.get("points") for line in etree.parse(svg).iter(f"{SVG}polyline")}
    crank = [float(part) for part in texts["crank"].replace(",", " ").split()]
    assert crank == pytest.approx([0, 0, 35 * math.cos(math.radians(75)), 35 * math.sin(math.radians(75))], abs=1e-8)


def test_layers_units_and_names(tmp_path):
    (path,) = export(load(BY_NAME["slider-crank"]), "dxf", tmp_path / "it.dxf", at=60)
    document = ezdxf.readfile(path)
    assert not document.audit().errors
    assert document.units == 4
    assert {"crank", "coupler", "PINS", "TEXT", "POINTS C"} <= {layer.dxf.name for layer in document.layers}
    texts = {text.dxf.text: text for text in document.modelspace().query("TEXT")}
    assert {"A", "B", "C", "θ₁₂ = 60°"} <= set(texts)
    assert texts["A"].get_align_enum() == TextEntityAlignment.MIDDLE_CENTER
    # the slider block: 0.15 and 0.09 of half the window
    (block,) = [line for line in document.modelspace().query("LWPOLYLINE") if line.dxf.layer.startswith("block")]
    sides = np.diff([corner[:2] for corner in block], axis=0)
    assert np.hypot(*sides[0]) / np.hypot(*sides[1]) == pytest.approx(0.075 / 0.045)
    assert np.mean([corner[:2] for corner in block][:4], axis=0) == pytest.approx([273.9119, 20], abs=1e-3)


def test_every_element_has_the_class_of_its_kind(tmp_path):
    (path,) = export(loads(SUSPENSION), "svg", tmp_path / "it.svg")
    kinds = {element.get("class") for element in etree.parse(path).iter() if element.get("class")}
    assert kinds == {
        "link", "ground", "spring", "damper", "load", "torque", "weight", "mass", "path", "pin", "point", "name",
        "scale", "caption",
    }  # fmt: skip
    (path,) = export(loads(SUSPENSION), "dxf", tmp_path / "it.dxf")
    layers = {layer.dxf.name for layer in ezdxf.readfile(path).layers}
    assert {"spring K", "damper K", "load wheel", "load brake", "mass centre of rocker", "support S"} <= layers


def test_frames(tmp_path):
    mechanism = load(BY_NAME["four-bar"])
    files = export(mechanism, "svg", tmp_path / "film", frames=5)
    assert [path.name for path in files] == [f"film-{number}.svg" for number in range(1, 6)]
    pins = [points_of_svg(path)["A"] for path in files]
    assert np.allclose(pins, [(35, 0), (0, 35), (-35, 0), (0, -35), (35, 0)], atol=1e-8)
    boxes = {etree.parse(path).getroot().get("viewBox") for path in files}
    assert len(boxes) == 1, "the window stands still"


def test_more_frames_than_the_sweep_has_steps(tmp_path):
    mechanism = load(BY_NAME["oldham"])
    assert len(export(mechanism, "svg", tmp_path / "film", frames=150)) == 150


def test_window_holds_every_point(tmp_path):
    for name in ("fivelink", "jansen"):
        (path,) = export(load(BY_NAME[name]), "svg", tmp_path / "it.svg")
        left, top, width, height = map(float, etree.parse(path).getroot().get("viewBox").split())
        for x, y in points_of_svg(path).values():
            assert left <= x <= left + width
            assert top <= -y <= top + height


def test_same_bytes_in_another_process(tmp_path):
    code = (
        "import sys; from mechsheet.description import load; from mechsheet.exporting import export\n"
        "for kind in ('svg', 'dxf', 'csv'): export(load(sys.argv[1]), kind, sys.argv[2] + '.' + kind)"
    )
    for seed in ("1", "2"):
        arguments = [sys.executable, "-c", code, str(BY_NAME["four-bar"]), str(tmp_path / seed)]
        subprocess.run(arguments, check=True, env={"PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(sys.path)})
    for kind in ("svg", "dxf", "csv"):
        assert (tmp_path / f"1.{kind}").read_bytes() == (tmp_path / f"2.{kind}").read_bytes(), kind


def test_no_position(tmp_path):
    mechanism = load(BY_NAME["cylinder-boom"])
    for kind in ("svg", "dxf"):
        with pytest.raises(MechsheetError, match=r"(?s)no position at .*the sweep has positions at"):
            export(mechanism, kind, tmp_path / f"it.{kind}", at=1e6)
    with pytest.raises(MechsheetError, match="frames"):
        export(mechanism, "svg", tmp_path / "it", frames=0)
    with pytest.raises(MechsheetError, match="exclude each other"):
        export(mechanism, "svg", tmp_path / "it", at=1, frames=3)
    assert not list(tmp_path.iterdir())


def test_without_ezdxf_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(MissingProgramError, match=r'pip install "mechsheet\[dxf\]"'):
        export(load(BY_NAME["four-bar"]), "dxf", tmp_path / "it.dxf")
    assert not list(tmp_path.iterdir())


def test_csv_is_what_the_engine_has(tmp_path):
    for name in ("fivelink", "cylinder-boom"):
        mechanism = load(BY_NAME[name])
        (path,) = export(mechanism, "csv", tmp_path / "it.csv")
        head, *lines = path.read_text(encoding="utf-8").splitlines()
        _, plan = compile_workbook(mechanism)
        columns = variables_of(mechanism)
        assert [word.split(" [")[0] for word in head.split(",")] == list(columns)
        assert len(lines) == plan.rows
        for row, line in enumerate(lines):
            for text, column in zip(line.split(","), columns.values(), strict=True):
                assert (None if text == "" else float(text)) == column[row]
        units = {word.split(" [")[0]: word.split(" [")[1].rstrip("]") for word in head.split(",") if "[" in word}
        assert units[mechanism.driver.symbol] == mechanism.driver.unit.symbol
        assert all(unit == mechanism.length_unit for symbol, unit in units.items() if symbol.endswith(".x"))
