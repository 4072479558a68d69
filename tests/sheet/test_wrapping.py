"""Labels stay in their column: they neither run under the drawing nor are cut off."""

import zipfile

import pytest

from mechsheet.library.building import Target, told, write_all
from mechsheet.library.changed import loads
from mechsheet.sheet import styles
from mechsheet.sheet.cells import ROW_HEIGHT, height_of, label_lines
from mechsheet.sheet.first.blocks import MEANING_WIDTH
from mechsheet.sheet.page.plan import ROW_HEIGHT as PAGE_ROW
from mechsheet.sheet.plan import MEANING

ROOM = MEANING_WIDTH * 7 + 5
"""Pixels of the column in Excel."""

LONG = "the crank, whose length was measured between the two bearings of its pins with the machine at rest"


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("", 1),
        ("crank A0A", 1),
        ("s₁₅ where the angle of rocker with pinion is 0", 1),
        ("displacement s₁₅ where the angle of rocker with pinion is 0", 2),
        (LONG, 3),  # two would hold it, if words were broken
        ("W" * 30, 2),  # no place to break: wherever the column ends
        ("i" * 90, 1),  # letters differ in width
        (f"{LONG} and {LONG}", 5),
    ],
)
def test_lines_of_a_label(text, lines):
    assert label_lines(text, ROOM) == lines


CRANK = f"""format = 1
[mechanism]
name = "long"
[dimensions]
a2 = {{ value = 30, label = "{LONG}" }}
[links.ground]
points = {{ A0 = [0, 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[driver]
link = "crank"
start = 0
stop = 30
step = 15
[workbook]
layout = "LAYOUT"
"""


@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_the_row_of_a_long_label_is_higher(layout):
    sheet = told(loads(CRANK.replace("LAYOUT", layout))).workbook.sheets[0]
    (label,) = (cell for cell in sheet.cells if cell.content == LONG)
    heights = dict(sheet.row_heights)
    assert label.style == styles.LABEL_LINES and label.style.wrap
    row = ROW_HEIGHT if layout == "sheets" else PAGE_ROW
    assert heights[label.row] >= height_of(3, row) > row
    others = {cell.row for cell in sheet.cells if cell.style == styles.LABEL and cell.row > label.row}
    assert {heights[other] for other in others} == {row}
    if layout == "sheets":
        (width,) = (column.width for column in sheet.columns if column.first == MEANING)
        assert width == MEANING_WIDTH


@pytest.mark.parametrize(
    ("ending", "part", "smaller"),
    [("xlsx", "xl/styles.xml", b'shrinkToFit="1"'), ("ods", "content.xml", b'style:shrink-to-fit="true"')],
)
def test_a_text_that_a_formula_writes_becomes_smaller_or_has_lines_and_is_not_wider(ending, part, smaller, tmp_path):
    """How long it will be depends on what is typed."""
    workbook = told(loads(CRANK.replace("LAYOUT", "sheets")))
    written = [fill.style for fill in workbook.workbook.sheets[0].fills if fill.col == MEANING]
    assert set(written) == {styles.LABEL_SAID, styles.LEGEND, styles.LABEL_LINES}
    assert all(style.shrink or style.wrap for style in written)
    (path,) = write_all(workbook, [Target(tmp_path / f"x.{ending}", ending)])
    assert smaller in zipfile.ZipFile(path).read(part)
