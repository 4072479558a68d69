"""The report: true scale in the worst position, the words of the first sheet, one to three pages."""

from itertools import pairwise

import numpy as np
import pytest

import mechsheet
from chosen import some
from folders import TEMPLATE_FILES
from loaded_mechanisms import SUSPENSION
from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.kinematics.sweep import rough_poses
from mechsheet.plotting import paper, report
from mechsheet.plotting.pictures import settings
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage

MILLIMETRES = 25.4


def pages_of(mechanism):
    first = report._FirstSheet(Compiled(mechanism))
    with settings():
        return first, report._pages(first, Stage(sample(mechanism, first.worst, None)))


def texts_of(page):
    return [text.get_text() for text in page.texts]


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize("path", some(TEMPLATE_FILES, 5), ids=lambda path: path.stem)
def test_true_scale(path):
    """A millimetre of paper is n of the mechanism, along both axes, and everything lies between the margins."""
    mechanism = mechsheet.load(path)
    _, pages = pages_of(mechanism)
    assert 1 <= len(pages) <= report.MOST
    drawing = pages[0].axes[0]
    wide, high = drawing.get_position().size * np.array([paper.WIDE, paper.HIGH])
    (caption,) = [text for text in texts_of(pages[0]) if " : " in text and "=" in text]
    one, n = (float(part) for part in caption.rpartition(", ")[2].split(" : "))
    unit = paper.MILLIMETRES[mechanism.length_unit]
    assert wide * n / one == pytest.approx(np.ptp(drawing.get_xlim()) * unit, rel=1e-4)
    assert high * n / one == pytest.approx(np.ptp(drawing.get_ylim()) * unit, rel=1e-4)
    for page in pages:
        for axes in page.axes:
            left, low, right, top = axes.get_position().extents * np.array([paper.WIDE, paper.HIGH] * 2)
            assert left > paper.MARGIN - 1
            assert right < paper.WIDE - paper.MARGIN + 1
            assert paper.MARGIN - 1 < low < top < paper.HIGH - paper.MARGIN + 1


@pytest.mark.slow
def test_the_worst_position():
    """Where the worst of all angles of transmission is worst; with forces where the driver needs most."""
    excavator = mechsheet.load(next(path for path in TEMPLATE_FILES if path.stem == "excavator"))
    assert report._FirstSheet(Compiled(excavator)).worst == pytest.approx(1260)  # the second of two; the first: 840
    first, _ = pages_of(mechsheet.load(next(path for path in TEMPLATE_FILES if path.stem == "fivelink")))
    assert first.worst == pytest.approx(302.9, abs=0.1)
    first, pages = pages_of(mechsheet.loads(SUSPENSION))
    motion = mechsheet.loads(SUSPENSION).solve()
    assert first.worst == pytest.approx(motion["theta12"][np.argmax(np.abs(motion["T12"]))], abs=0.5)
    assert any(text.startswith(f"θ₁₂ = {first.worst:g}°") for text in texts_of(pages[0]))


@pytest.mark.slow
def test_it_says_what_the_first_sheet_says():
    mechanism = mechsheet.loads(SUSPENSION)
    _, pages = pages_of(mechanism)
    said = "\n".join(text for page in pages for text in texts_of(page))
    assert "closes in all 13 positions" in said
    for words in (
        "Loads",
        "Masses",
        "What can be said",
        "Forces, and where each is largest",
        "driving torque of frame",
        "13 / 13",
    ):
        assert words in said
    (row,) = [row for row in report._largest(sample(mechanism, None, None)) if row[0] == "F₁₃"]
    assert float(row[1].split()[0]) == pytest.approx(np.nanmax(mechanism.solve()["F13"]), rel=0.01)


@pytest.mark.slow
def test_where_the_spring_is_longest():
    """By the distance of its ends in the reference's positions of the sweep."""
    mechanism = mechsheet.loads(SUSPENSION)
    compiled = Compiled(mechanism)
    truth = reference.solve(mechanism, start=rough_poses(mechanism, compiled.equations))
    lengths = np.hypot(*(np.asarray(truth.points["E"]) - np.asarray(truth.points["S"])).T)
    places = np.degrees(compiled.driver)
    ((name, longest, shortest),) = report._springs(*_sampled(mechanism))
    assert name == "K"
    assert longest == f"{lengths.max():.1f} mm @ {places[lengths.argmax()]:g}°".replace("-", "−")
    assert shortest.endswith(f"{lengths.min():.1f} mm @ {places[lengths.argmin()]:g}°".replace("-", "−"))


@pytest.mark.slow
def test_which_pin_carries_most():
    """Behind the driver's effort stands the largest force of all, and where it is."""
    mechanism = mechsheet.loads(SUSPENSION)
    motion = mechanism.solve()
    effort, first, *others = report._largest(sample(mechanism, None, None))
    assert effort[0] == "T₁₂"
    forces = {symbol: np.nanmax(motion[symbol]) for symbol in ("F12", "F13", "F24", "F34")}
    most = max(forces, key=forces.get)
    assert first[0] == most.translate(report.LOWERED)
    assert float(first[1].split()[0]) == pytest.approx(forces[most], rel=1e-3)
    assert all(float(row[1].split()[0]) <= forces[most] for row in others)


@pytest.mark.slow
def test_which_way_the_cutting_force_acts():
    """The report of the shaper draws it as it cuts: an arrow from the ram against its motion, with its amount."""
    mechanism = mechsheet.load(next(path for path in TEMPLATE_FILES if path.stem == "shaper"))
    first = report._FirstSheet(Compiled(mechanism))
    found, positions = _sampled(mechanism, first.worst)
    scene = positions.at(found.shown)
    shaft = next(item for item in scene.items if item.kind == "load")
    (ram,) = [item for item in scene.items if item.kind == "pin" and item.name == "D"]
    assert shaft.points[0] == pytest.approx([ram.x, ram.y])
    along, across = shaft.points[1] - shaft.points[0]
    speed = mechanism.solve()["s15.v"][found.shown]
    assert along * speed < 0 and across == pytest.approx(0)
    assert any(getattr(item, "text", "") == "F = 2000 N" for item in scene.items)


def test_a_value_ends_before_what_it_means_begins():
    """Values of many wide letters, as -1011.3 mm @ 927.37 mm, have a column as wide as they are."""
    with settings():
        page = paper.Paper()
        page.columns([("deepest", "−1011.3 mm @ 927.37 mm", "lowest teeth"), ("a", "1 mm", "short")], 1)
        page.figure.canvas.draw()
        boxes = [text.get_window_extent() for text in page.figure.texts[:3]]
    assert all(one.x1 < other.x0 for one, other in pairwise(boxes))


@pytest.mark.slow
def test_a_line_says_what_is_of_the_motion():
    """No place where there is none, no unit without a number, nothing of sheets."""
    first = report._FirstSheet(Compiled(mechsheet.load(next(p for p in TEMPLATE_FILES if p.stem == "double-wishbone"))))
    rows = {name: value for name, value, _ in first.rows("verdicts")}
    assert rows["Grashof"] == "80 mm"
    assert "slow way" not in rows  # which needs a whole turn
    assert rows["μ1 (B)"].endswith("@ −12°")
    assert "sheets" not in rows


def _sampled(mechanism, at=None):
    stage = Stage(sample(mechanism, at, None))
    return stage.sample, stage.positions


@pytest.mark.ci
@pytest.mark.slow
def test_turkish_and_a_position_of_ones_own(tmp_path):
    mechanism = mechsheet.load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar"))
    path = mechsheet.plot(mechanism, tmp_path / "r.pdf", at=60, language="tr")
    assert path.read_bytes().count(b"/Type /Page") >= 2  # a page, and their list
