"""Links in the workbook's chart: filled by lines, and in the same order in programs that draw the last series on top, or the
first."""

import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drawn import Drawn
from PIL import Image

from livesheet.formats import write
from livesheet.workbook import Area
from loaded_mechanisms import SUSPENSION
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.compiled import compiled_of
from mechsheet.description import load
from mechsheet.shapes.colors import DRIVEN, LINKS, pale
from mechsheet.shapes.forms import BORDER, PLATE

pytestmark = pytest.mark.slow

FOUR_BAR = Path(__file__).parents[3] / "templates/four-bar.toml"
COUPLER = LINKS[1]
RESOLUTION = 150


def plates(drawn, row):
    """By the colour of a link: its border and its inside, as points in half windows."""
    found = {}
    for series, points, _ in drawn.at(row):
        if series.width in (PLATE, PLATE - 2 * BORDER):
            found[series.line] = points
    return found


@pytest.mark.parametrize("values", [{}, {"b3": "105", "c3": "70"}], ids=["described", "changed"])
def test_the_inside_of_a_plate_is_covered_by_its_line(values):
    """Places of the coupler's triangle, in two positions, also after its sides are changed in the description's workbook."""
    drawn = Drawn(FOUR_BAR.read_text(encoding="utf-8"), values=values)
    reach = (PLATE / 2 - BORDER) / drawn.half
    for row in (2, 15):
        line = plates(drawn, row)[pale(COUPLER)]
        outline = plates(drawn, row)[COUPLER]
        assert len(outline) == 4 and np.array_equal(outline[0], outline[-1])
        weights = np.random.default_rng(0).dirichlet((1, 1, 1), 400)
        for place in weights @ outline[:3]:
            starts, ways = line[:-1], np.diff(line, axis=0)
            part = np.clip(((place - starts) * ways).sum(axis=1) / np.maximum((ways**2).sum(axis=1), 1e-300), 0, 1)
            assert np.hypot(*(place - starts - part[:, None] * ways).T).min() <= reach * 1.001


@pytest.mark.parametrize("text", [FOUR_BAR.read_text(encoding="utf-8"), SUSPENSION], ids=["four-bar", "suspension"])
def test_what_lies_on_links_lies_there_in_both_orders(text):
    """Borders, insides, springs and pins: their order from one end of the series is that from the other."""
    series = Drawn(text).chart.series
    twice = [each for each in dict.fromkeys(series) if series.count(each) == 2]
    assert {each.line for each in twice} >= {DRIVEN, pale(DRIVEN), COUPLER, pale(COUPLER)}
    assert {each.marker for each in twice} == {"", "circle"}
    upwards = [each for each in series if each in twice]
    count = len(twice)
    assert upwards[:count] == upwards[count:][::-1]
    assert max(map(series.count, series)) == 2
    first = next(n for n, each in enumerate(upwards[count:]) if each.width == PLATE)
    assert upwards[count:][first + 1].width == PLATE - 2 * BORDER  # on its border


@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.parametrize("form", ["xlsx", "ods"])
def test_libreoffice_shows_filled_plates_and_pins_on_them(form, tmp_path):
    """As many pixels of what LibreOffice prints have the pale colour of the coupler and of the crank as these are large."""
    compiled = compiled_of(load(FOUR_BAR))
    first, *others = compiled.workbook.sheets
    chart = first.charts[0]
    area = Area(chart.anchor.row, chart.anchor.col, chart.anchor.row + 22, chart.anchor.col + 7)
    setup = replace(first.print_setup, area=area, scale=100, landscape=True)
    first = replace(first, charts=(chart,), print_setup=setup)
    target = tmp_path / f"plates.{form}"
    write(replace(compiled.workbook, sheets=(first, *(replace(each, hidden=True) for each in others))), target)
    (pdf,) = convert_with_libreoffice([target], "pdf", tmp_path)
    subprocess.run(["pdftoppm", "-r", str(RESOLUTION), "-singlefile", "-png", pdf, pdf.with_suffix("")], check=True)
    picture = np.asarray(Image.open(pdf.with_suffix(".png")).convert("RGB")).astype(int)
    drawn = Drawn(FOUR_BAR.read_text(encoding="utf-8"))
    spot = compiled.plan.places.position
    found = plates(
        drawn, int(next(cell.content for cell in first.cells if (cell.row, cell.col) == (spot.row, spot.col)))
    )
    dots = drawn.half * RESOLUTION / 72
    wide = (PLATE - 2 * BORDER) * RESOLUTION / 72
    (x1, y1), (x2, y2), _ = sides = np.diff(found[COUPLER], axis=0) * dots
    plate = abs(x1 * y2 - x2 * y1) / 2 + np.hypot(*sides.T).sum() * wide / 2
    assert 0.9 < np.count_nonzero(near(picture, pale(COUPLER))) / plate < 1.1
    start, end = found[DRIVEN] * dots
    bar = np.hypot(*(end - start)) * wide
    assert 0.6 < np.count_nonzero(near(picture, pale(DRIVEN))) / bar < 1.2  # pins lie on it


def near(picture, color):
    """Where a colour is, but for what printing changes of it."""
    wanted = [int(color[at : at + 2], 16) for at in (0, 2, 4)]
    return (np.abs(picture - wanted) <= 3).all(axis=2)
