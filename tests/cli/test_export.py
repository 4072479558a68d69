"""`mechsheet export` itself: kinds, options, names of files, and one clear message for each mistake."""

import pytest

from command_line import run
from folders import TEMPLATES
from mechsheet.exporting import KINDS
from mechsheet.exporting.program import ascii_word, identifiers

FOUR_BAR = TEMPLATES / "four-bar.toml"


def test_writes_and_overwrites(tmp_path):
    target = tmp_path / "table.csv"
    target.write_text("old")
    result = run("export", FOUR_BAR, "--to", "csv", "-o", target)
    assert (result.exit_code, result.stdout.strip()) == (0, target.as_posix())
    assert target.read_text(encoding="utf-8").startswith("theta12 [deg],")


def test_set_reaches_the_file(tmp_path):
    texts = []
    for setting in ("a2=35", "a2=30"):
        run("export", FOUR_BAR, "--to", "csv", "-o", tmp_path / "t.csv", "--set", setting)
        texts.append((tmp_path / "t.csv").read_text(encoding="utf-8"))
    assert texts[0] != texts[1]


@pytest.mark.parametrize(
    ("arguments", "messages"),
    [
        (["--to", "cvs"], ['no kind of export is called "cvs"', 'did you mean "csv"?']),
        (["--to", "qqqq"], ["= kinds: ", ", csv"]),
        (["--to", "csv", "--at", "60"], ["--at: csv holds the whole sweep"]),
        (["--to", "csv", "--frames", "3"], ["--frames: csv holds the whole sweep"]),
        (["--to", "csv", "--set", "a9=1"], ["a9"]),
        (["--to", "csv", "--set", "a2=500"], ["cannot be joined"]),
        (["--to", "csv", "-o", "no/such/folder/x.csv"], ["there is no such folder"]),
    ],
)
def test_mistakes(arguments, messages, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("export", FOUR_BAR, *arguments)
    assert result.exit_code == 2
    assert not list(tmp_path.iterdir())
    for message in messages:
        assert message in result.stderr


@pytest.mark.slow
def test_printed_instead_of_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    printed = run("export", FOUR_BAR, "--to", "markdown", "--at", "60", "-o", "-")
    run("export", FOUR_BAR, "--to", "markdown", "--at", "60")
    assert printed.stdout == (tmp_path / "four-bar.md").read_text(encoding="utf-8")
    assert [path.name for path in tmp_path.iterdir()] == ["four-bar.md"]


@pytest.mark.slow
def test_a_failure_leaves_the_old_file(tmp_path):
    target = tmp_path / "old.svg"
    target.write_text("precious")
    result = run("export", TEMPLATES / "cylinder-boom.toml", "--to", "svg", "--at", "1e6", "-o", target)
    assert result.exit_code == 2
    assert "no position at" in result.stderr
    assert target.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [target]


def test_help_lists_the_kinds():
    text = run("export", "--help").stdout
    assert all(kind.about.split()[0] in text for kind in KINDS.values())


def test_identifiers():
    assert [ascii_word(word) for word in ("C.x", "çıkış", "θ13", "four-bar", "2x", "_", "Ölçü")] == [
        "C_x", "cikis", "theta13", "four_bar", "x2x", "x", "Olcu",
    ]  # fmt: skip
    names = identifiers(["C.x", "c_x", "for", "a1"], ["for"])
    assert names == {"C.x": "C_x", "c_x": "c_x_", "for": "for_", "a1": "a1"}
