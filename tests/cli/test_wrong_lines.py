"""Two hundred wrong command lines: one clear message each, exit code 2, no traceback, nothing written."""

import itertools
import os
import subprocess
import sys

import pytest
from small import CRANK

import mechsheet
from chosen import part
from command_line import run

BAD_FILES = (
    "missing.toml",
    "a folder",
    "broken.toml",
    "binary.toml",
    "wrong.toml",
    "mine.xlsx",
    "no such folder/x.toml",
    "",
)
BAD_BOOKS = ("missing.xlsx", "a folder", "binary.xlsx", "mine.toml", "half.xlsx", "no such folder/x.ods", "")
BAD_SETTINGS = ("a2", "a2=", "=3", "nothing=3", "a2=thirty", "a2=31,5", "a2=nan", "")
BAD_OUTPUTS = ("no such folder/out", "a file/out", "", "   ", "x" * 300)
BAD_NUMBERS = ("sixty", "", "nan", "inf", "1e999", "6,5")

DESCRIBING = {
    "build": ("build", "{}"),
    "show": ("show", "{}"),
    "plot": ("plot", "{}"),
    "export": ("export", "{}", "--to", "csv"),
}
BOOKS = {"recalc": ("recalc", "{}"), "pull": ("pull", "{}"), "check": ("check", "{}")}


def filled(words, file):
    return tuple(file if word == "{}" else word for word in words)


def lines():
    """Every command with every kind of mistake that it can be called with."""
    for words, file in itertools.product(DESCRIBING.values(), BAD_FILES):
        yield filled(words, file)
    for words, file in itertools.product(BOOKS.values(), BAD_BOOKS):
        if (words[0], file) != ("check", "mine.toml"):  # it judges descriptions, too
            yield filled(words, file)
    for words, setting in itertools.product(DESCRIBING.values(), BAD_SETTINGS):
        yield (*filled(words, "mine.toml"), "--set", setting)
    for setting in ("a2", "a2=", "=3", "nothing=3", "Nowhere!B2=3", "Mechanism!B=3"):
        yield "recalc", "mine.xlsx", "--set", setting
    for words, output in itertools.product(
        [*DESCRIBING.values(), ("recalc", "mine.xlsx"), ("pull", "mine.xlsx"), ("new", "four-bar"), ("schema",)],
        BAD_OUTPUTS,
    ):
        if words[0] != "show":
            suffix = (
                {"build": ".xlsx", "plot": ".svg", "recalc": ".xlsx"}.get(words[0], ".txt") if output.strip() else ""
            )
            yield (*filled(words, "mine.toml"), "-o", output + suffix)
    for words, at in itertools.product(
        [("plot",), ("export", "--to", "svg"), ("export", "--to", "latex")], BAD_NUMBERS
    ):
        yield (words[0], "mine.toml", *words[1:], "--at", at)
    for frames in ("0", "-1", "many", "2.5", "1000000"):
        yield "export", "mine.toml", "--to", "svg", "--frames", frames
    for command in mechsheet_commands():
        yield command, "--no-such-option"
        yield command, "mine.toml", "-o"
        yield command, "mine.toml", "one too many", "two too many", "--", "three"
    for name in ("buidl", "Build", "", "-x", "--json", "mine.toml"):
        yield (name,)
    for template in ("four-bra", "../four-bar", "", "four-bar.xlsx", "/etc/passwd"):
        yield "new", template
    yield from FURTHER


FURTHER = [
    ("build",),
    ("build", "mine.toml", "--format", "xls"),
    ("build", "mine.toml", "--format", ""),
    ("build", "mine.toml", "--format", ","),
    ("build", "mine.toml", "--format", "xlsx;ods"),
    ("build", "mine.toml", "--functions", "fortran"),
    ("build", "mine.toml", "--language", "de"),
    ("build", "mine.toml", "-o", "-"),
    ("build", "mine.toml", "-o", "out.xls"),
    ("build", "mine.toml", "-o", "out.ods", "--format", "xlsx"),
    ("build", "mine.toml", "-o", "out.ods", "--format", "xlsx,ods"),
    ("build", "mine.toml", "-o", "mine.toml"),
    ("build", "mine.toml", "-o", "a file"),
    ("build", "mine.toml", "-o", "homework.xlsx"),
    ("build", "mine.toml", "sub/mine.toml"),
    ("build", "mine.toml", "sub/mine.toml", "-o", "one.xlsx"),
    ("build", "mine.toml", "missing.toml", "-o", "out/"),
    ("show", "mine.toml", "--equations", "--colour"),
    ("plot", "mine.toml", "-o", "out.docx"),
    ("plot", "mine.toml", "-o", "out"),
    ("plot", "mine.toml", "-o", "-"),
    ("plot", "mine.toml", "--language", "fr"),
    ("plot", "mine.toml", "--at", "1e9", "-o", "out.html"),
    ("export", "mine.toml"),
    ("export", "mine.toml", "--to", "pdf"),
    ("export", "mine.toml", "--to", "CSV"),
    ("export", "mine.toml", "--to", "csv", "--at", "60"),
    ("export", "mine.toml", "--to", "csv", "--frames", "3"),
    ("export", "mine.toml", "--to", "svg", "--frames", "3", "--at", "60"),
    ("export", "mine.toml", "--to", "svg", "--frames", "3", "-o", "-"),
    ("export", "mine.toml", "--to", "svg", "--frames", "3", "-o", "a file"),
    ("export", "mine.toml", "--to", "octave", "-o", "my file.m"),
    ("export", "mine.toml", "--to", "python", "-o", "numpy-is.py"),
    ("export", "mine.toml", "--to", "csv", "-o", "mine.toml"),
    ("export", "mine.toml", "--to", "csv", "-o", "a folder/deeper/x.csv"),
    ("recalc", "mine.xlsx", "--print", "Nowhere!A1"),
    ("recalc", "mine.xlsx", "--print", "A1:"),
    ("recalc", "mine.xlsx", "--print", ""),
    ("recalc", "mine.xlsx", "-o", "out.ods"),
    ("recalc", "mine.xlsx", "-o", "./"),
    ("recalc", "mine.xlsx", "-o", "-"),
    ("recalc", "mine.xlsx", "--set", "a2=3", "--check"),
    ("check", "mine.xlsx", "--with", "excel"),
    ("check", "mine.xlsx", "--perturb", "0"),
    ("check", "mine.xlsx", "--perturb", "few"),
    ("check", "mine.xlsx", "--mutate", "-3"),
    ("check", "mine.xlsx", "--mutate", "3", "--perturb", "3"),
    ("check", "mine.xlsx", "--mutate", "3", "--junit", "report.xml"),
    ("check", "mine.xlsx", "--seed", "x"),
    ("pull", "mine.xlsx", "--into", "missing.toml"),
    ("pull", "mine.xlsx", "--into", "broken.toml"),
    ("pull", "mine.xlsx", "--into", "other.toml"),
    ("pull", "mine.xlsx", "-o", "mine.toml"),
    ("pull", "mine.xlsx", "-o", "mine.xlsx"),
    ("new", "four-bar", "-o", "mine.toml"),
    ("new", "--list", "-o", "list.txt"),
    ("schema", "-o", "a folder/deeper/schema.json"),
    ("schema", "-o", "x" * 300 + "/"),
    ("build", "mine.toml", "-o", "x" * 300 + "/"),
    ("plot", "mine.toml", "-o", "a file/"),
    ("build", "mine.toml", "-o", "a file/"),
    ("check", "mine.xlsx", "--junit", "no such folder/report.xml"),
    ("pull", "mine.xlsx", "--into", "mine.xlsx"),
]


def mechsheet_commands():
    from mechsheet.cli import main

    return sorted(main.commands)


LINES = list(lines())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with one good description and its workbook among bad files."""
    folder = tmp_path_factory.mktemp("wrong")
    (folder / "mine.toml").write_text(CRANK, encoding="utf-8")
    (folder / "sub").mkdir()
    (folder / "sub" / "mine.toml").write_text(CRANK, encoding="utf-8")
    (folder / "other.toml").write_text(CRANK.replace('name = "yoke"', 'name = "other"'), encoding="utf-8")
    mechsheet.load(folder / "mine.toml").build(folder)
    book = (folder / "mine.xlsx").read_bytes()
    (folder / "half.xlsx").write_bytes(book[: len(book) // 2])
    (folder / "homework.xlsx").write_text("homework")
    (folder / "a folder").mkdir()
    (folder / "a file").write_text("a file")
    (folder / "broken.toml").write_text("format = 1\n[mechanism\n")
    (folder / "wrong.toml").write_text(CRANK.replace('"ground"', '"gruond"'), encoding="utf-8")
    for name in ("binary.toml", "binary.xlsx"):
        (folder / name).write_bytes(bytes(range(256)) * 8)
    return folder


def held(folder):
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def test_there_are_two_hundred():
    assert len(set(LINES)) >= 200


@pytest.mark.cases(18)
@pytest.mark.parametrize("line", part(LINES, of=6, turn=1), ids=lambda line: " ".join(line)[:60] or "nothing")
def test_a_wrong_line_is_told(folder, line, monkeypatch):
    monkeypatch.chdir(folder)
    before = held(folder)
    result = run(*line)
    said = result.stderr.strip()
    assert result.exit_code == 2, (result.output, result.exception)
    assert said and "Traceback" not in said and "Errno" not in said
    assert len(said.splitlines()) <= 12, "a message, not a flood"
    assert held(folder) == before, "nothing is written"


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("line", part(FURTHER, of=20, turn=7)[:8], ids=lambda line: " ".join(line)[:60])
def test_the_same_as_a_program(folder, line):
    """The exit code and the streams are those of a real process, too."""
    done = subprocess.run(
        [sys.executable, "-m", "mechsheet", *line], cwd=folder, capture_output=True, check=False, env=os.environ
    )
    assert done.returncode == 2
    assert done.stderr.strip() and b"Traceback" not in done.stderr
