"""Plates: rings fill what their outline encloses, and keep names off it."""

import numpy as np
import pytest

from chosen import some
from folders import TEMPLATE_FILES
from mechsheet.compiled import Compiled
from mechsheet.description import load
from mechsheet.shapes.forms import BORDER, PLATE
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import Positions, Stroke, layers_of, rings, rings_needed, there

OUTLINES = {
    "triangle": [(0, 0), (100, 0), (30, 80)],
    "flat": [(0, 0), (100, 0), (90, 8)],
    "quadrilateral": [(0, 0), (90, -10), (100, 60), (10, 70)],
    "pentagon": [(0, 0), (60, -20), (100, 30), (60, 80), (0, 60)],
}


def closed(corners):
    return np.array([*corners, corners[0]], float)


def inside(places, outline):
    """Of a convex outline: on one side of all its sides."""
    starts, ways = outline[:-1], np.diff(outline, axis=0)
    away = places[:, None, :] - starts
    turns = ways[:, 0] * away[..., 1] - ways[:, 1] * away[..., 0]
    return (turns >= 0).all(axis=1) | (turns <= 0).all(axis=1)


def distances(places, line):
    """From each place to the nearest of a line."""
    starts, ways = line[:-1], np.diff(line, axis=0)
    away = places[:, None, :] - starts
    part = np.clip((away * ways).sum(axis=2) / np.maximum((ways**2).sum(axis=1), 1e-300), 0, 1)
    return np.hypot(*np.moveaxis(away - part[..., None] * ways, 2, 0)).min(axis=1)


@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize("width", [5.0, 7.5, 20.0])
def test_rings_fill_a_plate(name, width):
    outline = closed(OUTLINES[name])
    grid = np.stack(np.meshgrid(np.linspace(-5, 105, 111), np.linspace(-25, 85, 111)), axis=-1).reshape(-1, 2)
    places = grid[inside(grid, outline)]
    line = rings(outline, rings_needed(outline, width))
    assert distances(places, line).max() <= width / 2 * (1 + 1e-9)
    if rings_needed(outline, width) > 1:
        fewer = rings(outline, rings_needed(outline, width) - 1)
        assert distances(places, fewer).max() > width / 4  # none too many by far


def test_corners_on_a_line_need_none():
    assert rings_needed(closed([(0, 0), (50, 0), (100, 0)]), 5.0) == 0


def test_a_plate_is_its_border_and_on_it_its_inside():
    scene = Positions(Compiled(load(TEMPLATE_FILES[0].parent / "four-bar.toml"))).at(3)
    plates = [item for item in scene.items if item.kind == "link"]
    assert len(plates) == 3
    for plate in plates:
        border, within = layers_of(plate)
        assert (border.width, border.color, border.fill) == (PLATE, plate.color, plate.color)
        assert (within.width, within.color) == (PLATE - 2 * BORDER, plate.fill)
        assert int(within.color, 16) > int(plate.color, 16)  # paler
    others = [item for item in scene.items if isinstance(item, Stroke) and item.kind != "link"]
    assert all(layers_of(item) == (item,) for item in others)


@pytest.mark.slow
@pytest.mark.parametrize("path", some(TEMPLATE_FILES, 5), ids=lambda path: path.stem)
def test_no_name_stands_on_a_plate(path):
    """The middle of a name, in a few positions; what has no more room anywhere is counted, and is the exception."""
    found = Positions(Compiled(load(path)))
    names = hidden = 0
    for row in np.linspace(0, found.rows - 1, 5).astype(int).tolist():
        scene = found.at(row)
        plates = [item for item in scene.items if item.kind == "link" and there(item)]
        for label in (item for item in scene.items if item.kind == "name" and there(item)):
            middle = np.array([[label.x, label.y]])
            names += 1
            for plate in plates:
                near = distances(middle, plate.points)[0] < plate.width / 2 / POINTS * scene.window.half
                enclosed = len(plate.points) == 4 and inside(middle, plate.points)[0]
                hidden += near or enclosed
    assert hidden <= names / 50, f"{hidden} of {names}"
