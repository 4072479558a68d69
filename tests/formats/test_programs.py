"""Both twins in the programs that people open them with: values recalculated from scratch, and how they look."""

from __future__ import annotations

import shutil
import subprocess
import zipfile

import numpy as np
import openpyxl
import pytest
from samples import FRONT, sample

from livesheet.formats import write
from livesheet.formula.nodes import ErrorValue
from mechsheet.checking.programs import convert_with_libreoffice, libreoffice_command

pytestmark = pytest.mark.slow

libreoffice = [
    pytest.mark.libreoffice,
    pytest.mark.skipif(libreoffice_command() is None, reason="LibreOffice is not installed"),
]
needs_pictures = pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="poppler-utils is not installed")
DOTS = 150
"""Resolution of pictures [dots per inch]."""
PATH_COLOR = (0x2F, 0x55, 0x97)


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    folder = tmp_path_factory.mktemp("twins")
    paths = [folder / "one.xlsx", folder / "two.ods"]
    for path in paths:
        write(sample(), path)
    return paths


@pytest.fixture(scope="module")
def recalculated(twins, tmp_path_factory):
    return convert_with_libreoffice(twins, "xlsx", tmp_path_factory.mktemp("recalculated"))


def differences(path):
    """Formula cells whose value in the file at `path`, as another program wrote it, is not ours."""
    book = openpyxl.load_workbook(path, data_only=True)
    found = []
    for sheet in sample().sheets:
        for fill in sheet.fills:
            for row in range(fill.row, fill.row + fill.rows):
                for col in range(fill.col, fill.col + fill.cols):
                    mine, theirs = fill.value(row, col), book[sheet.title].cell(row + 1, col + 1).value
                    if not same(mine, theirs):
                        found.append((sheet.title, row, col, mine, theirs))
    return found


def same(mine, theirs):
    if isinstance(mine, ErrorValue):
        return str(mine) == theirs
    if isinstance(mine, float):
        return isinstance(theirs, (int, float)) and abs(mine - theirs) < 1e-9
    return mine == theirs or (mine == "" and theirs is None)


class TestLibreOffice:
    pytestmark = libreoffice

    def test_values_are_ours(self, recalculated):
        for path in recalculated:
            assert differences(path) == []

    def test_conversion_keeps_names_charts_and_validation(self, recalculated):
        for path in recalculated:
            book = openpyxl.load_workbook(path)
            assert set(book.defined_names) == {"ÇıkışUzvu", "Adım", "a_1"}
            assert len(book[FRONT].data_validations.dataValidation) == 4
            with zipfile.ZipFile(path) as archive:
                assert sum(name.startswith("xl/charts/chart") for name in archive.namelist()) == 2

    def test_controls_are_read_from_both(self, twins, tmp_path):
        for path in convert_with_libreoffice(twins, "ods", tmp_path):
            with zipfile.ZipFile(path) as archive:
                content = archive.read("content.xml").decode()
            assert content.count("<form:value-range") == 2
            assert content.count('form:linked-cell="&apos;Giriş &amp; Çıkış&apos;.B7"') == 2
            assert content.count("<draw:control") == 2
            assert content.count('form:max-value="72"') == 2

    @needs_pictures
    def test_a_circle_is_round(self, twins, tmp_path):
        for path in convert_with_libreoffice(twins, "pdf", tmp_path):
            width, height = extent(picture(path, tmp_path), PATH_COLOR)
            assert width > 200
            assert width / height == pytest.approx(1, abs=0.01), path.name


@pytest.mark.gnumeric
@pytest.mark.filterwarnings("ignore:Workbook contains no default style")
@pytest.mark.skipif(shutil.which("ssconvert") is None, reason="gnumeric is not installed")
def test_gnumeric_computes_the_same_from_the_ods(twins, tmp_path):
    # Not from the .xlsx: gnumeric cannot read a sheet's name with an apostrophe there.
    result = tmp_path / "answers.xlsx"
    subprocess.run(["ssconvert", "--recalc", twins[1], result], check=True, capture_output=True)
    assert differences(result) == []


def picture(pdf, folder):
    """The first page as an array of colours, rows x columns x 3."""
    stem = folder / pdf.stem
    command = ["pdftoppm", "-r", str(DOTS), "-f", "1", "-l", "1", "-singlefile", pdf, stem]
    subprocess.run(command, check=True, capture_output=True)
    data = stem.with_suffix(".ppm").read_bytes()
    _, width, height, _ = data.split(maxsplit=3)[0], *map(int, data.split(maxsplit=4)[1:4])
    size = width * height * 3
    return np.frombuffer(data[-size:], dtype=np.uint8).reshape(height, width, 3)


def extent(pixels, color):
    """Width and height of everything in one colour."""
    rows, cols = np.nonzero((np.abs(pixels.astype(int) - color) < 12).all(axis=2))
    return int(np.ptp(cols)) + 1, int(np.ptp(rows)) + 1
