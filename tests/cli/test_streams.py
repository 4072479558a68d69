"""The program on other people's terminals: code pages that lack signs, full disks, closed pipes, signals."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from small import CRANK

from chosen import part

pytestmark = pytest.mark.slow

COMMAND = [sys.executable, "-m", "mechsheet"]
POSIX = pytest.mark.skipif(os.name == "nt", reason="Windows has neither these signals nor /dev/full")
TURKISH = CRANK.replace("a2 = 30", 'a2 = { value = 30, label = "krank ığşİ θ − √" }').replace(
    "[assembly]", '[workbook]\nlanguage = "tr"\n[assembly]'
)


def call(*arguments, page="utf-8", cwd=None, **options):
    environment = os.environ | {"PYTHONIOENCODING": page}
    return subprocess.run([*COMMAND, *arguments], env=environment, cwd=cwd, capture_output=True, check=False, **options)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pages")
    (folder / "mine.toml").write_text(TURKISH, encoding="utf-8")
    assert call("build", "mine.toml", cwd=folder).returncode == 0
    return folder


LINES = [
    ("show", "mine.toml"),
    ("show", "mine.toml", "--equations"),
    ("show", "mine.toml", "--json"),
    ("show", "mine.toml", "--csv"),
    ("show", "mine.toml", "--cells"),
    ("new", "fivelink"),
    ("new", "--list"),
    ("recalc", "mine.xlsx"),
    ("recalc", "mine.xlsx", "--json"),
    ("check", "mine.xlsx"),
    ("check", "mine.xlsx", "--json"),
    ("build", "mine.toml", "-o", "again/"),
    ("pull", "mine.xlsx"),
    ("export", "mine.toml", "--to", "markdown", "-o", "-"),
]


PAGES = ("cp1252", "cp1254", "ascii")
CALLS = [(line, page) for line in LINES for page in PAGES]


@pytest.mark.cases(1)
@pytest.mark.parametrize(("line", "page"), part(CALLS, of=10, turn=6), ids=lambda part: "".join(part[:2]))
def test_every_code_page_will_do(folder, line, page):
    done = call(*line, page=page, cwd=folder)
    assert done.returncode == 0, done.stderr
    assert b"Error" not in done.stderr
    if "--json" in line:
        assert json.loads(done.stdout.decode("utf-8")) == json.loads(call(*line, cwd=folder).stdout)
    elif (line[0] in ("new", "pull", "export") and "--list" not in line) or "--csv" in line:
        assert done.stdout == call(*line, cwd=folder).stdout, "what is a file by rights has the same bytes everywhere"
    else:
        done.stdout.decode("utf-8" if page == "ascii" else page)  # click takes ASCII for UTF-8 that is not set up


def test_signs_that_a_page_lacks_stay_readable(tmp_path):
    (tmp_path / "mine.toml").write_text(TURKISH.replace("Çatal ışığı", "Çatal θ ≤ 5° ışık − ψ ✓ 中"), encoding="utf-8")
    shown = {
        page: call("show", "mine.toml", page=page, cwd=tmp_path).stdout.decode(page) for page in ("cp1252", "cp1254")
    }
    assert shown["cp1252"].splitlines()[0] == "Çatal theta <= 5° isik - psi ? ?"
    assert shown["cp1254"].splitlines()[0] == "Çatal theta <= 5° ışık - psi ? ?"


@pytest.mark.cases(1)
@POSIX
@pytest.mark.parametrize(
    "line",
    part(
        [("show", "mine.toml"), ("--help",), ("show", "mine.toml", "--json"), ("new", "fivelink"), ("build", "--help")],
        of=3,
    ),
)
def test_a_full_disk_is_told_in_one_line(folder, line):
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run([*COMMAND, *line], cwd=folder, stdout=full, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 2
    turkish = "mine.toml" in line  # the description that is shown is in Turkish
    told = (
        "çıktı yazılamıyor: diskte yer kalmadı" if turkish else "the output cannot be written: No space left on device"
    )
    assert done.stderr.decode().strip() == told


@pytest.mark.cases(1)
@POSIX
@pytest.mark.parametrize("line", part([("new", "--list"), ("show", "mine.toml", "--cells"), ("--help",)], of=2))
def test_a_reader_that_goes_is_no_fault(folder, line):
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "wb") as closed:
        done = subprocess.run([*COMMAND, *line], cwd=folder, stdout=closed, stderr=subprocess.PIPE, check=False)
    assert done.stderr == b""
    assert done.returncode not in (0, 1, 2), "neither done, nor different, nor a wrong input"


@POSIX
def test_standard_streams_that_are_closed(folder):
    for closing in ("<&-", ">&-", "2>&-"):
        line = f'"{sys.executable}" -m mechsheet show - {closing}'
        done = subprocess.run(
            ["sh", "-c", line],
            cwd=folder,
            input=CRANK.encode(),
            capture_output=True,
            check=False,
        )
        assert b"Traceback" not in done.stderr, closing
        assert done.returncode == (2 if closing == "<&-" else 0), closing


HANGING = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell starts what runs in the background deaf to it
from livesheet.formats.archive import Archive
write = Archive.contents
def slow(archive):  # the seal is made when all but one part is written
    print("writing", flush=True)
    time.sleep(60)
Archive.contents = slow
from mechsheet.cli import main
main(["build", "mine.toml", "-o", "held.xlsx", "--force"])
"""


@pytest.mark.cases(1)
@POSIX
@pytest.mark.parametrize(("number", "code", "said"), [(signal.SIGINT, 130, "stopped"), (signal.SIGTERM, 143, "")])
def test_signals_leave_nothing_half_written(tmp_path, number, code, said):
    (tmp_path / "mine.toml").write_text(CRANK, encoding="utf-8")
    (tmp_path / "held.xlsx").write_text("the old one")
    running = subprocess.Popen(
        [sys.executable, "-c", HANGING], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert running.stdout.readline() == "writing\n"
    assert [path.suffix for path in tmp_path.iterdir() if path.name.startswith(".")] == [".tmp"]
    time.sleep(0.05)
    running.send_signal(number)
    _, stderr = running.communicate(timeout=30)
    assert (running.returncode, stderr.strip()) == (code, said)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["held.xlsx", "mine.toml"]
    assert (tmp_path / "held.xlsx").read_text() == "the old one"


def test_the_words_for_signs_are_letters():
    from mechsheet.cli.streams import _WORDS

    assert all(re.fullmatch(r"[\x20-\x7e]+", word) for word in _WORDS.values())


@pytest.mark.cases(1)
@POSIX
@pytest.mark.parametrize("page", ["utf-8", "cp857"])
def test_long_work_shows_a_bar_on_a_terminal_and_no_colour(tmp_path, page):
    import pty

    (tmp_path / "class.csv").write_text("id\n1\n2\n", encoding="utf-8")
    (tmp_path / "mine.toml").write_text(CRANK, encoding="utf-8")
    screen, terminal = pty.openpty()
    subprocess.run(
        [*COMMAND, "exercise", "mine.toml", "class.csv", "-o", "week"],
        cwd=tmp_path, stderr=terminal, stdout=subprocess.DEVNULL, check=True, env=os.environ | {"PYTHONIOENCODING": page},
    )  # fmt: skip
    os.close(terminal)
    shown = os.read(screen, 100_000).decode(page)
    os.close(screen)
    assert "############............ student 1 of 2" in shown
    assert "\033[3" not in shown
