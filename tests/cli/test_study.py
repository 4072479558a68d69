"""`mechsheet study` and `mechsheet build --design`, as somebody types them."""

import json

import pytest

from command_line import run
from mechsheet.cli.study import _duration
from studying import small, study_of

pytest.importorskip("pyarrow")


@pytest.fixture
def description(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(small(9_000).text, encoding="utf-8")
    return path


@pytest.mark.slow
def test_the_best_are_printed_and_the_counts_told(description, tmp_path):
    done = run("study", description, "-o", tmp_path / "out", "--workers", 1)
    assert done.exit_code == 0, done.output
    lines = done.stdout.splitlines()
    assert lines[0].split()[:1] == ["design"]
    assert len(lines) == 11
    assert "fail mu_min > 35" in done.stderr
    assert "kept of 9,000 designs" in done.stderr
    assert "\r" not in done.stderr
    again = run("study", description, "-o", tmp_path / "out", "--workers", 1, "--resume")
    assert again.stdout == done.stdout


@pytest.mark.slow
def test_a_design_of_a_study_is_built(description, tmp_path):
    out = tmp_path / "out"
    first = (
        run("study", description, "-o", out, "--workers", 1, "--rows", 73)
        .stdout.splitlines()[1]
        .replace("*", " ")
        .split()
    )
    done = run("build", description, "--design", f"{out}:{first[0]}", "-o", tmp_path / "best.xlsx")
    assert done.exit_code == 0, done.output
    assert "closes in all 73 positions" in done.stderr
    assert "note:" not in done.stderr
    shown = run("recalc", tmp_path / "best.xlsx", "--json")
    cells = [value for sheet in json.loads(shown.stdout).values() for value in sheet.values()]
    for number in first[1:]:
        assert any(isinstance(value, float) and f"{value:.7g}" == number for value in cells), number


@pytest.mark.slow
def test_a_description_that_was_changed_since_is_noted(description, tmp_path):
    out = tmp_path / "out"
    run("study", description, "-o", out, "--workers", 1)
    description.write_text(
        description.read_text(encoding="utf-8").replace("b3 = { value = 126.6", "b3 = { value = 120")
    )
    done = run("build", description, "--design", f"{out}:5", "-o", tmp_path / "5.xlsx")
    assert done.exit_code == 0
    assert "differs from the description of the study" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("design", "words"),
    [
        ("{out}", "is not FOLDER:NUMBER"),
        ("{out}:0", "they go from 1 to 9,000"),
        ("{out}:9001", "they go from 1 to 9,000"),
        ("{out}x:1", "No such file"),
    ],
)
def test_a_design_that_there_is_not(description, tmp_path, design, words):
    out = tmp_path / "out"
    run("study", description, "-o", out, "--workers", 1)
    done = run("build", description, "--design", design.format(out=out), "-o", tmp_path / "x.xlsx")
    assert done.exit_code == 2
    assert words in done.stderr
    assert not (tmp_path / "x.xlsx").exists()


@pytest.mark.slow
def test_conditions_that_keep_nothing_are_told_with_their_counts(tmp_path):
    path = tmp_path / "none.toml"
    path.write_text(
        study_of('[study]\nvary = { a2 = [20, 60, 1] }\nkeep = ["closes", "mu_min > 89"]').text, encoding="utf-8"
    )
    done = run("study", path, "-o", tmp_path / "out", "--workers", 1)
    assert done.exit_code == 2
    assert "none.toml:" in done.stderr
    assert "none of 41 designs meets all conditions" in done.stderr
    assert "fail closes" in done.stderr
    assert "fail mu_min > 89" in done.stderr


def test_a_description_without_a_study(tmp_path):
    path = tmp_path / "plain.toml"
    path.write_text(study_of("").text, encoding="utf-8")
    done = run("study", path, "-o", tmp_path / "out")
    assert done.exit_code == 2
    assert "no part [study]" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("size", ["much", "2 GiBi", "-1"])
def test_a_size_that_is_none(description, tmp_path, size):
    done = run("study", description, "-o", tmp_path / "out", "--limit-memory", size)
    assert done.exit_code == 2
    assert "--limit-memory" in done.stderr


def test_durations_read_as_a_clock():
    assert [_duration(x) for x in (5, 61, 3_600, 200_000)] == ["0:05", "1:01", "1:00:00", "2 d 7:33:20"]
