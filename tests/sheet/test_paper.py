"""What workbooks print on, measured in the PDFs that LibreOffice makes; `tools/paper.py` measures all templates."""

import shutil

import pytest
from on_paper import pages_of, printed

pytestmark = [
    pytest.mark.ci,
    pytest.mark.libreoffice,
    pytest.mark.skipif(shutil.which("pdftohtml") is None, reason="poppler-utils is not installed"),
]

LEAST = 6.5
"""Points of a number on a first sheet or in a table."""
NEARLY_EMPTY = 0.25
"""A page that is printed no further down than this part of its height."""


def smallest(pages, kind):
    return min(size for page in pages if (size := page.smallest(kind)) is not None)


@pytest.mark.parametrize("language", ["en", "tr"])
def test_the_pages_of_the_text_print_on_one_sheet_of_paper(tmp_path, language):
    for name, path in printed(["four-bar", "slider-crank"], "page", tmp_path, language).items():
        pages = pages_of(path)
        assert len(pages) == 1, name
        assert smallest(pages, "number") >= 7 - 0.05, name
        assert smallest(pages, "formula") >= 5.5, name  # powers are written in smaller letters than what they stand at


def test_a_workbook_prints_what_a_reader_wants(tmp_path):
    found = {name: pages_of(path) for name, path in printed(["four-bar", "cam-valve"], "sheets", tmp_path).items()}
    assert 3 <= len(found["four-bar"]) <= 6
    for pages in found.values():
        assert smallest(pages, "number") >= LEAST
        assert all(page.reach > NEARLY_EMPTY for page in pages)
