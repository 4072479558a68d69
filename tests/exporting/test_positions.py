"""Every kind that shows a position, for every template: drawings read back and the written solution, at one position.

The reference has the values; the workbook of a position is computed once for all kinds.
"""

import re
from functools import cache

import numpy as np
import pytest
from test_drawings import points_of_dxf, points_of_svg

from chosen import ITERATED, LISTED, but, some
from folders import TEMPLATE_FILES
from mechsheet import reference
from mechsheet.description import Overrides, load
from mechsheet.exporting import Job, drawings, mathtext
from mechsheet.exporting.drawings import dxf_drawing, svg_picture
from mechsheet.exporting.mathtext import symbol_math
from mechsheet.exporting.solution import Display, Table, latex, markdown, solution
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses
from mechsheet.plotting.sampling import sample

pytestmark = pytest.mark.slow

FAST = ("fivelink", "oldham", "adjustable-pump")
CASES = [
    pytest.param(path, ("en", "tr")[index % 2], id=path.stem, marks=() if path.stem in FAST else pytest.mark.slow)
    for index, path in enumerate(but(TEMPLATE_FILES, *ITERATED, *LISTED))
    if path in some(TEMPLATE_FILES, 1) or path.stem in FAST
]


def at_a_position(mechanism):
    """The driver's value in its unit at a position of the sweep, and what the reference finds there, as people read it."""
    equations = solve(mechanism)
    solved = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    row = int(np.flatnonzero(solved.exists)[solved.exists.sum() // 3])
    found = {symbol: float(column[row]) for symbol, column in reference.variables(solved).items()}
    driver = mechanism.driver
    units = {equation.symbol: equation.unit for equation in equations.columns} | {driver.symbol: driver.unit}
    degrees = {symbol: mechanism.shown(unit).in_degrees for symbol, unit in units.items()}
    values = {symbol: np.degrees(value) if degrees.get(symbol) else value for symbol, value in found.items()}
    return values[driver.symbol], values


@pytest.mark.parametrize(("path", "language"), CASES)
def test_every_template(path, language, monkeypatch, tmp_path):
    once = cache(lambda _, at, least: sample(mechanism, at, None, least))
    for module in (drawings, mathtext):
        monkeypatch.setattr(module, "sample", lambda mechanism, at, _, least=121: once(mechanism.name, at, least))
    mechanism = load(path, Overrides(language=language))
    at, values = at_a_position(mechanism)
    drawn_points(mechanism, at, values, tmp_path)
    blocks = solution(Job(mechanism, "it", at))
    written_values(mechanism, blocks, values)
    written_loops(blocks)
    lines = "\n".join(line for block in blocks if isinstance(block, Display) for line in block.lines)
    assert ("{,}" in lines) == (language == "tr")
    for write in (markdown, latex):
        assert write(Job(mechanism, "it", at))[0].decode().count("theta") > 3


def drawn_points(mechanism, at, values, folder):
    """Every point stands where it is, in the SVG and in the DXF."""
    (drawn,) = drawings.drawings(Job(mechanism, "it", at))
    size = max(abs(value) for symbol, value in values.items() if "." in symbol)
    for name, print_, read in (("svg", svg_picture, points_of_svg), ("dxf", dxf_drawing, points_of_dxf)):
        (folder / name).write_bytes(print_(drawn))
        points = read(folder / name)
        assert set(points) == {point for link in mechanism.links for point in link.points}
        for point, (x, y) in points.items():
            assert abs(x - values[f"{point}.x"]) < 1e-9 * size, (name, point)
            assert abs(y - values[f"{point}.y"]) < 1e-9 * size, (name, point)


def written_values(mechanism, blocks, values):
    """The table of results: every variable, point and output, rounded; and each has its step."""
    result = [block for block in blocks if isinstance(block, Table)][-1]
    shown = {cells[0][0].code: number(cells[1][0].code) for cells in result.rows}
    fixed = {f"{point}.{axis}" for point in mechanism.ground.points for axis in "xy"}
    wanted = {symbol: value for symbol, value in values.items() if symbol not in {*fixed, mechanism.driver.symbol}}
    assert {symbol_math(symbol) for symbol in wanted} <= set(shown)
    for symbol, value in wanted.items():
        text, found = shown[symbol_math(symbol)]
        gap = found - value
        if abs(gap) > 300:  # the reference's turn is its own
            gap = (gap + 180) % 360 - 180
        places = len(text.partition(".")[2])
        assert abs(gap) <= 0.5 * 10.0**-places + 1e-9 or f"{value:.6g}" == text, symbol
    lines = "\n".join(line for block in blocks if isinstance(block, Display) for line in block.lines)
    assert all(f"{code} &=" in lines for code in shown)


def written_loops(blocks):
    """Both sides of every loop have the same sum."""
    for table in [block for block in blocks if isinstance(block, Table) and len(block.head) == 7]:
        left, right = (row for row in table.rows if not row[1])
        assert [cell[0].code for cell in left[5:]] == [cell[0].code for cell in right[5:]]


def number(code):
    text = re.split(r"\\|\^", code.replace("{,}", "."))[0].strip()
    return text, float(text)
