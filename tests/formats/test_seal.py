"""The seal says whether a workbook is as it was built; of a file that is damaged it says no, and nothing else."""

import zipfile

import pytest

from livesheet.formats.archive import PROPERTIES, is_untouched
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.library.building import build

pytestmark = pytest.mark.slow


def test_a_damaged_file_is_not_as_it_was_built(tmp_path):
    path = tmp_path / "mine.xlsx"
    build(loads(template_text("parallelogram")), path)
    assert is_untouched(path)
    whole = path.read_bytes()
    with zipfile.ZipFile(path) as archive:
        (part,) = [info for info in archive.infolist() if info.filename in PROPERTIES]
    extra = int.from_bytes(whole[part.header_offset + 28 : part.header_offset + 30], "little")
    begin = part.header_offset + 30 + len(part.filename) + extra
    for place in range(begin, begin + part.compress_size - 8, 7):  # the last bits may be padding
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 0xFF]) + whole[place + 1 :])
        assert not is_untouched(path), place
