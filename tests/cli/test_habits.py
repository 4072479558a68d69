"""What people expect of a command line: standard input, completion, examples in the help, plain output in a pipe."""

import os
import subprocess
import sys

import pytest

from command_line import run
from folders import ROOT
from mechsheet import __version__
from mechsheet.cli import main
from mechsheet.description.templates import template_text

FOUR_BAR = template_text("four-bar")


@pytest.mark.slow
def test_a_description_from_standard_input(tmp_path):
    built = run("build", "-", "-o", tmp_path / "out", "--set", "a1=71", text=FOUR_BAR)
    assert built.exit_code == 0, built.output
    assert (tmp_path / "out" / "four-bar.xlsx").exists()
    shown = run("show", "-", "--csv", text=FOUR_BAR)
    assert shown.stdout.startswith("theta12,")


def test_faults_of_standard_input_carry_its_lines():
    result = run("show", "-", text=FOUR_BAR.replace('link = "crank"', 'link = "krank"'))
    assert result.exit_code == 2
    assert "<stdin>:" in result.stderr and 'did you mean "crank"' in result.stderr


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("content", [b"PK\x03\x04\0", b"\xff\xfe", b""])
def test_nonsense_on_standard_input(content):
    done = subprocess.run(
        [sys.executable, "-m", "mechsheet", "show", "-"], input=content, capture_output=True, check=False
    )
    assert done.returncode == 2
    assert b"<stdin>" in done.stderr and b"Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("mechsheet bu", "build"),
        ("mechsheet new ja", "jansen"),
        ("mechsheet export mine.toml --to oc", "octave"),
        ("mechsheet check mine.xlsx --with libreoffice,gn", "libreoffice,gnumeric"),
    ],
)
def test_the_shell_completes(words, expected):
    completing = {
        "COMP_WORDS": words,
        "COMP_CWORD": str(len(words.split()) - 1),
        "_MECHSHEET_COMPLETE": "bash_complete",
    }
    command = [sys.executable, "-c", "from mechsheet.cli import main; main(prog_name='mechsheet')"]
    done = subprocess.run(command, env=os.environ | completing, capture_output=True, text=True, check=False)
    assert f"plain,{expected}" in done.stdout.splitlines()


@pytest.mark.parametrize("name", sorted(main.commands))
def test_help_has_an_example_to_paste(name):
    text = run(name, "--help").stdout
    assert f"  mechsheet {name}" in text.split("Usage:")[1].split("\n", 1)[1]
    assert run(name, "-h").stdout == text


def test_version():
    assert run("--version").stdout == f"mechsheet, version {__version__}\n"


@pytest.mark.slow
def test_no_colours_in_a_pipe():
    assert "\033" not in run("check", ROOT / "generated" / "four-bar.xlsx").output
