"""Zip files that are not what they say."""

import zipfile

import pytest
from xlsx_files import packed, parts_of

from livesheet.diagnostics import WorkbookError
from livesheet.formats import read
from livesheet.formats.reading.package import MAX_RATIO


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_two_parts_of_one_name(tmp_path):
    """Whoever takes the first sees another workbook than who takes the last."""
    path = tmp_path / "book.xlsx"
    path.write_bytes(packed(parts_of("")))
    with zipfile.ZipFile(path, "a") as file:
        file.writestr("xl/worksheets/SHEET1.xml", "<worksheet/>")
    with pytest.raises(WorkbookError, match=r"SHEET1\.xml: two parts have this name"):
        read(path)


@pytest.mark.slow
def test_a_zip_that_is_packed_to_burst(tmp_path):
    path = tmp_path / "book.xlsx"
    path.write_bytes(packed({**parts_of(""), "xl/media/big.bin": "\0" * (40 << 20)}))
    with pytest.raises(WorkbookError, match=f"more than {MAX_RATIO} to 1"):
        read(path)


def test_sizes_that_are_not_true(tmp_path):
    """A part that unpacks to more than the zip file says is damaged, and no more of it is read."""
    data = bytearray(packed(parts_of('<row r="1"><c r="A1"><v>1</v></c></row>' * 500)))
    place = data.rfind(b"xl/worksheets/sheet1.xml") - 46 + 24  # its size in the central directory
    data[place : place + 4] = (100).to_bytes(4, "little")
    path = tmp_path / "book.xlsx"
    path.write_bytes(data)
    with pytest.raises(WorkbookError, match="damaged"):
        read(path)
