"""The profile of a cam in DXF: closed, on layers of its own, as long and as large as it is."""

import io
from pathlib import Path

import numpy as np
import pytest

from mechsheet.description import Overrides, load
from mechsheet.drawing_page.looking import look
from mechsheet.drawing_page.reading import read
from mechsheet.exporting.dxf import write
from mechsheet.exporting.job import Job

TEMPLATES = Path(__file__).resolve().parents[2] / "templates"


def test_dxf_of_the_profile():
    ezdxf = pytest.importorskip("ezdxf")
    mechanism = load(TEMPLATES / "cam-slide.toml", Overrides(rows="721"))
    job = Job(mechanism, "cam")
    document = ezdxf.read(io.StringIO(write(job)[0].decode("utf-8").replace("\r\n", "\n")))
    assert not document.audit().errors
    lines = {line.dxf.layer: line for line in document.modelspace().query("LWPOLYLINE")}
    assert lines["cam"].closed and lines["pitch curve"].closed and lines["base circle"].closed
    found = np.array([point[:2] for point in lines["cam"].get_points()])
    assert len(found) == 720
    values = job.compiled.values
    own = np.column_stack([values["cam.x"], values["cam.y"]])[:-1]
    assert np.max(np.abs(found - own)) < 1e-9
    x, y = found.T
    area = abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2
    phi = values["phi"]
    exact = abs(
        np.trapezoid(
            0.5 * (own[:, 0] * np.gradient(own[:, 1], phi[:-1]) - own[:, 1] * np.gradient(own[:, 0], phi[:-1])),
            phi[:-1],
        )
    )
    assert area == pytest.approx(exact, rel=1e-2)
    assert any(point.dxf.layer == "POINTS O" for point in document.modelspace().query("POINT"))


def test_the_page_of_draw_has_the_profile():
    path = TEMPLATES / "cam-slide.toml"
    seen = look(read(path.read_text(encoding="utf-8"), path.name), None, {})
    shapes = {shape["name"]: shape for shape in seen["shapes"] if shape["kind"] == "cam"}
    assert {"cam", "pitch curve", "base circle", "roller", "line of pressure"} <= shapes.keys()
    path = np.array(shapes["cam"]["path"])
    assert len(path) > 50
    assert np.hypot(*path.T).min() > 39.9
    assert len(shapes["cam"]["places"]) == 3
