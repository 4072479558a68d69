"""Replacing files: all or nothing, with one clear message."""

from __future__ import annotations

import errno
import zipfile
from pathlib import Path

import pytest
from samples import sample

from mechsheet.diagnostics import OutputError
from mechsheet.formats import write
from mechsheet.formats.archive import new_archive


def left_alone(folder):
    return [path.name for path in folder.iterdir()] == ["old.xlsx"] and (folder / "old.xlsx").read_text() == "old"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "old.xlsx").write_text("old")
    return tmp_path


@pytest.mark.parametrize("after", [0, 1, 15])
@pytest.mark.parametrize(
    ("number", "words"),
    [(errno.ENOSPC, "the disk is full"), (errno.EACCES, "no permission"), (errno.EROFS, "read-only")],
)
def test_a_disk_that_refuses_leaves_the_old_file(folder, monkeypatch, number, words, after):
    writes = zipfile._ZipWriteFile.write
    count = 0

    def refuse(self, data):
        nonlocal count
        count += 1
        if count > after:
            raise OSError(number, "refused")
        return writes(self, data)

    monkeypatch.setattr(zipfile._ZipWriteFile, "write", refuse)
    with pytest.raises(OutputError, match=words) as caught:
        write(sample(), folder / "old.xlsx")
    assert "old.xlsx" in str(caught.value)
    assert len(caught.value.faults) == 1
    monkeypatch.undo()
    assert left_alone(folder)


def test_a_file_that_cannot_be_moved_leaves_the_old_file(folder, monkeypatch):
    def refuse(self, target):
        raise PermissionError(errno.EACCES, "in use")

    monkeypatch.setattr(Path, "replace", refuse)
    with pytest.raises(OutputError, match="open in another program"):
        write(sample(), folder / "old.xlsx")
    assert left_alone(folder)


def test_a_bug_leaves_the_old_file(folder):
    with pytest.raises(ZeroDivisionError), new_archive(folder / "old.xlsx") as archive:
        archive.text("part").write("half")
        raise ZeroDivisionError
    assert left_alone(folder)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("missing/a.xlsx", "there is no such folder"),
        ("old.xlsx/a.xlsx", "there is no such folder"),
        (".", 'no format is called ""'),
        ("a.doc", "formats: .xlsx, .ods"),
        ("n" * 300 + ".xlsx", "the file name is too long"),
    ],
)
def test_places_that_cannot_be_written(folder, name, words):
    with pytest.raises(OutputError, match=words.replace(".", r"\.")):
        write(sample(), folder / name)
    assert left_alone(folder)


def test_a_folder_of_that_name(tmp_path):
    (tmp_path / "a.xlsx").mkdir()
    with pytest.raises(OutputError, match="this is a folder"):
        write(sample(), tmp_path / "a.xlsx")
    assert [path.name for path in tmp_path.iterdir()] == ["a.xlsx"]


def test_rights_of_the_old_file_stay(folder):
    (folder / "old.xlsx").chmod(0o640)
    write(sample(), folder / "old.xlsx")
    assert (folder / "old.xlsx").stat().st_mode & 0o777 == 0o640


def test_entries_are_the_same_everywhere(tmp_path):
    with new_archive(tmp_path / "a.zip") as archive:
        archive.stored("mimetype", "application/x-test")
        with archive.text("çok.txt") as part:
            part.write("ı\n" * 1000)
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        first, second = archive.infolist()
        assert archive.read(second) == "ı\n".encode() * 1000
    assert first.compress_type == zipfile.ZIP_STORED
    for entry in (first, second):
        assert entry.date_time == (1980, 1, 1, 0, 0, 0)
        assert (entry.create_system, entry.external_attr >> 16) == (3, 0o644)
