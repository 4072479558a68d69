"""The report: true scale in the worst position, the words of the first sheet, one to three pages."""

import numpy as np
import pytest

import mechsheet
from chosen import some
from folders import TEMPLATE_FILES
from loaded_mechanisms import SUSPENSION
from mechsheet.compiled import Compiled
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


def test_the_worst_position():
    """Where the angle of transmission is smallest; with forces where the driver needs most."""
    first, _ = pages_of(mechsheet.load(next(path for path in TEMPLATE_FILES if path.stem == "fivelink")))
    assert first.worst == pytest.approx(302.9, abs=0.1)
    first, pages = pages_of(mechsheet.loads(SUSPENSION))
    motion = mechsheet.loads(SUSPENSION).solve()
    assert first.worst == pytest.approx(motion["theta12"][np.argmax(np.abs(motion["T12"]))], abs=0.5)
    assert any(text.startswith(f"θ₁₂ = {first.worst:g}°") for text in texts_of(pages[0]))


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


def test_turkish_and_a_position_of_ones_own(tmp_path):
    mechanism = mechsheet.load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar"))
    path = mechsheet.plot(mechanism, tmp_path / "r.pdf", at=60, language="tr")
    assert path.read_bytes().count(b"/Type /Page") >= 2  # a page, and their list
