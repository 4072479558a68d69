"""One study at a time in a folder, whatever became of the last one; parts that are of another study are never taken."""

import errno
import shutil
import signal
import subprocess
import sys
import time

import pytest

from livesheet.diagnostics import OutputError
from mechsheet.studies import folder as study_folder
from mechsheet.studies.folder import LOCK, locked
from mechsheet.studies.parts import counted
from mechsheet.studies.run import studied
from studying import contents, small

pytest.importorskip("pyarrow")


def test_a_folder_is_locked_once_and_then_free_again(tmp_path):
    with locked(tmp_path), pytest.raises(OutputError, match="another study is being computed"), locked(tmp_path):
        raise AssertionError("both have it")
    with locked(tmp_path):
        assert (tmp_path / LOCK).exists()
    assert not list(tmp_path.iterdir())


def test_a_lock_that_was_left_behind_locks_nobody_out(tmp_path):
    """Killed, or the power was cut: the file is there, and nobody holds it."""
    folder = tmp_path / "study"
    folder.mkdir()
    (folder / LOCK).write_bytes(b"")
    studied(small(3_000), folder, workers=1)
    assert not (folder / LOCK).exists()


def test_whoever_waits_at_a_removed_lock_does_not_have_it(tmp_path, monkeypatch):
    """Between opening the file and locking it the holder ends and removes it, and a third one makes a new one."""
    holder = locked(tmp_path)
    holder.__enter__()
    lock_it, others = study_folder._lock, []

    def late(file):
        if not others:
            holder.__exit__(None, None, None)
            others.append(locked(tmp_path))
            monkeypatch.setattr(study_folder, "_lock", lock_it)
            others[0].__enter__()
        lock_it(file)

    monkeypatch.setattr(study_folder, "_lock", late)
    with pytest.raises(OutputError, match="another study is being computed"), locked(tmp_path):
        raise AssertionError("both have it")
    others[0].__exit__(None, None, None)


@pytest.mark.ci
def test_two_studies_started_at_once_in_an_empty_folder_do_not_mix(tmp_path):
    """Both ended with exit code 0, and the folder had parts of the one and of the other."""
    runs = []
    for number, count in enumerate((60_000, 70_000)):
        description = tmp_path / f"{number}.toml"
        description.write_text(small(count).text, encoding="utf-8")
        command = [sys.executable, "-m", "mechsheet", "study", str(description), "-o", str(tmp_path / "study")]
        pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
        runs.append(subprocess.Popen([*command, "--workers", "1"], **pipes, text=True, encoding="utf-8"))
    told = [run.communicate(timeout=120)[1] for run in runs]
    codes = [run.returncode for run in runs]
    assert sorted(codes) == [0, 2], told
    refused = told[codes.index(2)]
    assert "another study is being computed in this folder" in refused or "is the folder of another study" in refused
    studies = {counted(path).study for path in (tmp_path / "study" / "parts").iterdir()}
    assert len(studies) == 1


@pytest.mark.ci
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="nothing kills a process without a word here")
def test_a_killed_study_frees_its_folder(tmp_path):
    description = tmp_path / "four-bar.toml"
    description.write_text(small(3_000_000).text, encoding="utf-8")
    folder = tmp_path / "study"
    command = [sys.executable, "-m", "mechsheet", "study", str(description), "-o", str(folder), "--workers", "2"]
    run = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    until = time.monotonic() + 60
    while not list(folder.glob("parts/*.parquet")):
        assert run.poll() is None
        assert time.monotonic() < until
        time.sleep(0.05)
    with pytest.raises(OutputError, match="another study is being computed"):
        studied(small(3_000_000), folder, workers=1, resume=True)
    run.kill()
    run.wait()
    with locked(folder):
        assert (folder / LOCK).exists()


@pytest.mark.slow
def test_parts_of_another_study_are_computed_again(tmp_path):
    """They have the same name and as many designs: only what they say of themselves tells them from this one's."""
    one, other = tmp_path / "one", tmp_path / "other"
    studied(small(9_000), one, workers=1)
    found = studied(_reseeded(), other, workers=1)
    files = contents(other)
    shutil.copy(one / "parts" / "part-000001.parquet", other / "parts")
    (other / "parts" / "part-000002.parquet").write_bytes((one / "parts" / "part-000000.parquet").read_bytes())
    again = studied(_reseeded(), other, workers=1, resume=True)
    assert contents(other) == files
    assert again.result == found.result


def _reseeded():
    from mechsheet.library.changed import loads

    return loads(small(9_000).text.replace("seed = 3", "seed = 4"))


@pytest.mark.slow
def test_without_locks_a_mixed_folder_is_told(tmp_path, monkeypatch):
    """On a file system that knows no locks the parts tell it, before anything is counted or ranked."""

    def none(_):
        raise OSError(errno.ENOLCK, "no locks available")

    monkeypatch.setattr(study_folder, "_lock", none)
    other, folder = tmp_path / "other", tmp_path / "study"
    studied(_reseeded(), other, workers=1)
    parts = sorted((other / "parts").iterdir())

    def meddle(progress):
        if progress.done >= progress.all:
            shutil.copy(parts[0], folder / "parts")

    with pytest.raises(OutputError, match="another study has written into this folder"):
        studied(small(9_000), folder, workers=1, tell=meddle)
    assert not (folder / "result.json").exists()
    assert studied(small(9_000), folder, workers=1, resume=True).result.designs == 9_000
