"""`--set`, `--step` and `--rows`: the same in every command, and what is wrong with them told together."""

import json

import pytest
from small import CRANK

from command_line import run
from mechsheet.description.templates import template_text

FOUR_BAR = template_text("four-bar")


@pytest.mark.parametrize(
    ("settings", "messages"),
    [
        (["mode_1=2"], ['--set mode_1=2: an assembly mode is 1 or -1, not "2"']),
        (["mode_1=−1"], ["--set mode_1=−1: an assembly mode is 1 or -1", "write -1"]),
        (["mode_1=a2"], ["an assembly mode is 1 or -1"]),
        (["mode_2=1"], ['--set mode_2=1: no group of links has the assembly mode "mode_2"', "modes: mode_1"]),
        (["mode1=1"], ['did you mean "mode_1"?']),
        (["mode_2=1", "a9=1"], ["--set mode_2=1: no group", "--set a9=1: no dimension"]),
        (["mode_1=-1", "a2=500"], ["-:24: dimensions: the links cannot be joined at any value of the driver"]),
        (
            ["mode_1=3", "x", "a2=1/0"],
            ["--set mode_1=3:", '--set: "x" is not NAME=VALUE', "--set a2=1/0: has no value"],
        ),
    ],
)
def test_what_is_wrong_with_modes(settings, messages):
    result = run("show", "-", *(part for setting in settings for part in ("--set", setting)), text=FOUR_BAR)
    assert result.exit_code == 2 and result.stdout == ""
    for message in messages:
        assert message.replace("-:24", "<stdin>:24") in result.stderr, result.stderr


@pytest.mark.slow
def test_every_command_means_the_same(tmp_path):
    changes = ("--rows", "4", "--step", "30", "--set", "a2=30*1.1", "--set", "a2=a2+1")
    shown = json.loads(run("show", "-", "--json", *changes, text=CRANK).stdout)
    assert shown["theta12"] == pytest.approx([0, 30, 60, 90])
    assert shown["A.x"][0] == 34
    exported = run("export", "-", "--to", "csv", "-o", "-", *changes, text=CRANK).stdout.splitlines()
    assert [float(line.split(",")[1]) for line in exported[1:]] == pytest.approx(shown["A.x"])
    built = run("build", "-", "-o", tmp_path / "a.xlsx", *changes, text=CRANK)
    assert built.exit_code == 0 and "closes in all 4 positions" in built.stderr
    pulled = run("pull", tmp_path / "a.xlsx").stdout
    assert pulled == CRANK.replace("a2 = 30", "a2 = 34").replace("stop = 360\nstep = 90", "stop = 90\nstep = 30")


def test_nothing_is_written_where_an_option_is_wrong(tmp_path):
    for command in (("build",), ("plot",), ("export", "--to", "csv")):
        result = run(*command, "-", "-o", tmp_path / "a.xlsx", "--rows", "1", "--step", "x", text=CRANK)
        assert result.exit_code == 2
        assert "<stdin>: --rows: a sweep has at least 2 rows, not 1\n" in result.stderr
        assert '<stdin>: --step: "x" is not a dimension\n' in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "options", [(), ("--language", "tr"), ("--layout", "page"), ("--rows", "9", "--language", "tr")]
)
def test_lines_are_those_of_the_file(options):
    """Whatever is added to the text on its way into the workbook."""
    text = FOUR_BAR.replace("B = [50, 55]", "B = [63, 0]").partition("[workbook]")[0]
    text = text.replace("[dimensions]", '[workbook]\nreferences = "names"\n[dimensions]')
    line = text.splitlines().index("[assembly]") + 1
    result = run("build", "-", "-o", "/nowhere/a.xlsx", *options, text=text)
    assert result.exit_code == 2 and f"<stdin>:{line}: assembly: " in result.stderr


def test_an_option_has_no_line():
    result = run("build", "-", "--tolerance", "--layout", "page", text=template_text("engine"))
    lines = [line for line in result.stderr.splitlines() if line.startswith("<stdin>")]
    assert [line.split(": ")[0] for line in lines] == ["<stdin>", "<stdin>", "<stdin>:64"]
