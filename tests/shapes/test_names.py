"""Names stand where there is room: by the true size of their letters, over no line, ring or other name."""

from itertools import combinations

import numpy as np
import pytest

from chosen import some
from folders import TEMPLATE_FILES
from loaded_mechanisms import LAMP, SUSPENSION, of_kind
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.shapes.loads import VECTORS
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import Positions, Stroke, there

POSITIONS = 6


def box(label, window):
    """Left, right, low, high of the letters themselves, in the length unit; a text stands in the middle of its height."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    found = TextPath((0, 0), label.text, prop=FontProperties(family="DejaVu Sans", size=label.size)).get_extents()
    unit = window.half / POINTS
    wide, high = found.width * unit, found.height * unit
    left = label.x - wide / 2 if label.middle else label.x
    return left, left + wide, label.y - high / 2, label.y + high / 2


def overlap(a, b):
    return a[0] < b[1] and b[0] < a[1] and a[2] < b[3] and b[2] < a[3]


def dots(stroke, step):
    """Places along a line, close to each other."""
    for start, end in zip(stroke.points[:-1], stroke.points[1:], strict=True):
        count = int(np.ceil(np.hypot(*(end - start)) / step)) + 1
        yield from start + (end - start) * np.linspace(0, 1, count)[:, None]


def judge(found, row):
    scene = found.at(row)
    labels = [item for item in of_kind(scene, "name", "scale", "caption") if hasattr(item, "text") and there(item)]
    boxes = {label.text + label.kind: box(label, scene.window) for label in labels}
    for (one, a), (other, b) in combinations(boxes.items(), 2):
        assert not overlap(a, b), (row, one, other)
    lines = [item for item in scene.items if isinstance(item, Stroke) and item.kind != "path" and there(item)]
    places = np.concatenate([np.array(list(dots(line, scene.window.half / 100))) for line in lines])
    for label in of_kind(scene, "name", "scale"):
        if hasattr(label, "text") and there(label):
            left, right, low, high = boxes[label.text + label.kind]
            inside = (places > (left, low)).all(axis=1) & (places < (right, high)).all(axis=1)
            assert not inside.any(), (row, label.text)
            for disc in of_kind(scene, "pin", "point"):
                near = np.clip((disc.x, disc.y), (left, low), (right, high))
                assert np.hypot(*(near - (disc.x, disc.y))) >= disc.radius, (row, label.text, disc.name)


def rows_of(compiled):
    closed = np.flatnonzero(compiled.closed)
    return closed[np.linspace(0, len(closed) - 1, min(POSITIONS, len(closed))).astype(int)].tolist()


@pytest.mark.parametrize("path", some(TEMPLATE_FILES, 3), ids=lambda path: path.stem)
def test_names_of_templates(path):
    compiled = Compiled(load(path))
    found = Positions(compiled)
    for row in rows_of(compiled):
        judge(found, row)


@pytest.mark.slow
@pytest.mark.parametrize("text", [SUSPENSION, LAMP], ids=["suspension", "lamp"])
def test_names_beside_springs_and_arrows(text):
    compiled = Compiled(loads(text))
    found = Positions(compiled)
    for row in rows_of(compiled):
        judge(found, row)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar-forces", "engine"])
def test_names_beside_all_arrows(name):
    compiled = Compiled(load(next(path for path in TEMPLATE_FILES if path.stem == name)))
    found = Positions(compiled, VECTORS)
    for row in rows_of(compiled):
        judge(found, row)


@pytest.mark.slow
def test_every_point_is_named():
    for path in TEMPLATE_FILES[::5]:
        compiled = Compiled(load(path))
        scene = Positions(compiled).at(int(np.flatnonzero(compiled.closed)[0]))
        marked = {item.name for item in of_kind(scene, "pin", "point")}
        assert marked <= {item.text for item in of_kind(scene, "name") if there(item)}
