"""The profile of a cam in DXF: closed, on layers of its own, as long and as large as it is."""

import io

import numpy as np
import pytest

from folders import TEMPLATES
from mechsheet.description import Overrides, load
from mechsheet.drawing_page.looking import look
from mechsheet.drawing_page.reading import read
from mechsheet.exporting.drawings import dxf
from mechsheet.exporting.job import Job


def measured(places):
    """The perimeter and the area of a closed line."""
    x, y = np.asarray(places).T
    length = np.sum(np.hypot(x - np.roll(x, 1), y - np.roll(y, 1)))
    return length, abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2


def test_dxf_of_a_flat_faced_cam_is_as_long_and_as_large_as_its_support_function_says():
    """Cauchy: L is the integral of p over a turn, A half that of p^2 - p'^2, where p = rb + s and p' = s'."""
    ezdxf = pytest.importorskip("ezdxf")
    job = Job(load(TEMPLATES / "cam-flat.toml", Overrides(rows="721")), "cam")
    document = ezdxf.read(io.StringIO(dxf(job)[0].decode("utf-8").replace("\r\n", "\n")))
    assert not document.audit().errors
    outline = next(line for line in document.modelspace().query("LWPOLYLINE") if line.dxf.layer == "cam")
    assert outline.closed
    length, area = measured([point[:2] for point in outline.get_points()])
    support, slope = (job.compiled.values[name][:-1] for name in ("s", "s.d"))
    inscribed = 2e-5  # a polygon of 720 corners is less than the curve by (pi/360)^2/6 of it
    assert length == pytest.approx(2 * np.pi * np.mean(support), rel=inscribed)
    assert area == pytest.approx(np.pi * np.mean(support**2 - slope**2), rel=inscribed)


def test_dxf_of_the_profile():
    ezdxf = pytest.importorskip("ezdxf")
    mechanism = load(TEMPLATES / "cam-slide.toml", Overrides(rows="721"))
    job = Job(mechanism, "cam")
    document = ezdxf.read(io.StringIO(dxf(job)[0].decode("utf-8").replace("\r\n", "\n")))
    assert not document.audit().errors
    lines = {line.dxf.layer: line for line in document.modelspace().query("LWPOLYLINE")}
    assert lines["cam"].closed and lines["pitch curve"].closed
    circles = {circle.dxf.layer: circle.dxf for circle in document.modelspace().query("CIRCLE")}
    assert (circles["base circle"].radius, circles["roller"].radius) == pytest.approx((40, 10))
    assert tuple(circles["base circle"].center) == pytest.approx((0, 0, 0), abs=1e-9)
    found = np.array([point[:2] for point in lines["cam"].get_points()])
    assert len(found) == 720
    values = job.compiled.values
    own = np.column_stack([values["cam.x"], values["cam.y"]])[:-1]
    assert np.max(np.abs(found - own)) < 1e-9
    # the profile is parallel to the pitch curve: L - 2 pi r, A - r L + pi r^2
    pitch = np.array([point[:2] for point in lines["pitch curve"].get_points()])
    (length, area), (long, large), radius = measured(found), measured(pitch), 10
    assert length == pytest.approx(long - 2 * np.pi * radius, rel=1e-5)
    assert area == pytest.approx(large - radius * long + np.pi * radius**2, rel=1e-5)
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
