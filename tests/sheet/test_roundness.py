"""A circle is round in the picture that LibreOffice draws, before and after a dimension is changed, in both formats."""

import subprocess
from dataclasses import replace

import numpy as np
import pytest
from placed import places_of

from chosen import first
from folders import ROOT
from livesheet.formats import write
from mechsheet.checking.programs import convert_with_libreoffice, stored_values
from mechsheet.description import load
from mechsheet.library.building import compile_workbook

pytestmark = pytest.mark.slow

INK = "FF00FF"
TOLERANCE = 0.01
RESOLUTION = 300


def with_cells(workbook, changes):
    """The workbook with other constants on its first sheet, all values stored for formulas as they were."""
    first = workbook.sheets[0]
    cells = tuple(replace(cell, content=changes.get((cell.row, cell.col), cell.content)) for cell in first.cells)
    return replace(workbook, sheets=(replace(first, cells=cells), *workbook.sheets[1:]))


def only_path(workbook, wanted):
    """One chart on the first sheet, its path in a colour that nothing else has, nothing over it; the sheet for itself."""
    first = workbook.sheets[0]
    chart = next(chart for chart in first.charts if any(_long(series) for series in chart.series) and wanted(chart))
    path = next(series for series in chart.series if _long(series))
    chart = replace(chart, series=(replace(path, line=INK, width=0.25),))
    others = [replace(sheet, hidden=True) for sheet in workbook.sheets[1:]]  # not printed: faster
    return replace(workbook, sheets=(replace(first, charts=(chart,)), *others))


def _long(series):
    return series.x.area.last_row > series.x.area.first_row + 30 and series.x.sheet == series.y.sheet == "Drawing"


def measured(pdf):
    """Width and height of what is drawn in the colour, in pixels, on the one page where it is: charts print beside cells."""
    subprocess.run(["pdftoppm", "-r", str(RESOLUTION), str(pdf), str(pdf.with_suffix(""))], check=True)
    boxes = [box for page in sorted(pdf.parent.glob(f"{pdf.stem}-*.ppm")) if (box := _inked(page)) is not None]
    assert len(boxes) == 1, f"{pdf.stem}: the path is on {len(boxes)} pages"
    return boxes[0]


def _inked(page):
    head, rest = page.read_bytes().split(b"\n255\n", 1)
    width, height = map(int, head.split()[1:3])
    pixels = np.frombuffer(rest, np.uint8).reshape(height, width, 3).astype(int)
    ys, xs = np.nonzero((pixels[..., 0] > 200) & (pixels[..., 1] < 128) & (pixels[..., 2] > 200))
    return (np.ptp(xs) + 1, np.ptp(ys) + 1) if len(xs) else None


STATES = {"circle": (200.0, 100.0), "ellipse": (200.0, 50.0), "larger": (700.0, 350.0)}
"""AB and AP of the trammel: P runs on an ellipse with the axes 2 BP and 2 AP."""


@pytest.mark.ci
@pytest.mark.libreoffice
def test_circle_stays_round(tmp_path):
    """A trammel whose P runs on a circle, then on an ellipse of 3 to 1, then on a larger circle.

    Both the path behind the drawing and the chart of the path. The values stored in the files are those of the template,
    so what is measured is what LibreOffice has recalculated.
    """
    workbook, plan = compile_workbook(load(ROOT / "templates/elliptic-trammel.toml"))
    places = [(spot.row, spot.col) for spot in (plan.at.spots["AB"], plan.at.spots["AP"])]
    files = []
    for kind, wanted in (("drawing", lambda chart: chart.name == "drawing"), ("path", lambda chart: not chart.name)):
        shown = only_path(workbook, wanted)
        for state in first(list(STATES), 1):
            lengths = STATES[state]
            for suffix in ("xlsx", "ods"):
                path = tmp_path / f"{kind}-{state}-{suffix}.{suffix}"
                write(with_cells(shown, dict(zip(places, lengths, strict=True))), path)
                files.append(path)
    for pdf in convert_with_libreoffice(files, "pdf", tmp_path):
        width, height = measured(pdf)
        beam, to_a = STATES[pdf.stem.split("-")[1]]
        assert height > 80, f"{pdf.stem}: {width} x {height}"
        assert width / height == pytest.approx((beam - to_a) / to_a, rel=TOLERANCE), f"{pdf.stem}: {width} x {height}"


@pytest.mark.ci
@pytest.mark.libreoffice
def test_libreoffice_moves_the_drawing(tmp_path):
    """The position cell is changed in the file: LibreOffice's points of the drawing are those of the table's row."""
    workbook, plan = compile_workbook(load(ROOT / "templates/four-bar.toml"))
    position = places_of(plan)["position"]
    files = [tmp_path / f"moved-{suffix}.{suffix}" for suffix in ("xlsx", "ods")]
    for path in files:
        write(with_cells(workbook, {(position.row, position.col): 7.0}), path)
    sheet = workbook.sheet("Drawing")
    names = {
        cell.content if isinstance(cell.content, str) else cell.content.plain: cell.row
        for cell in reversed(sheet.cells)
        if cell.col == 0
    }
    (tmp_path / "answers").mkdir()
    for answer in convert_with_libreoffice(files, "xlsx", tmp_path / "answers"):
        found = stored_values(answer)
        for point in ("A", "B", "C"):
            for axis, col in (("x", 1), ("y", 2)):
                spot = plan.at.spots[f"{point}.{axis}"]
                expected = found.get(plan.table, plan.at.first + 7, spot.col)
                assert isinstance(expected, float)
                assert found.get("Drawing", names[point], col) == pytest.approx(expected, abs=1e-9)
