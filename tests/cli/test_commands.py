"""The command line as a user types it: output, exit codes, and one clear message for each mistake."""

import errno
import json
import os
import zipfile
from pathlib import Path

import pytest

from command_line import run
from folders import TEMPLATES
from mechsheet.cli import main

FOUR_BAR = TEMPLATES / "four-bar.toml"


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("built")
    assert run("build", FOUR_BAR, "-o", folder).exit_code == 0
    return folder / "four-bar.xlsx"


@pytest.mark.slow
def test_new_build_check(tmp_path):
    mine = tmp_path / "mine.toml"
    assert run("new", "four-bar", "-o", mine).exit_code == 0
    result = run("build", mine, "-o", tmp_path, "--set", "a1=72")
    assert result.exit_code == 0
    assert result.stdout.strip().endswith("mine.xlsx")
    result = run("check", tmp_path / "mine.xlsx")
    assert result.exit_code == 0
    assert "all agree" in result.stdout


@pytest.mark.slow
def test_new_lists_and_suggests():
    assert "slider-crank" in run("new", "--list").stdout.split()
    result = run("new", "four-bra")
    assert result.exit_code == 2
    assert 'did you mean "four-bar"?' in result.stderr


def test_new_does_not_overwrite(tmp_path):
    mine = tmp_path / "mine.toml"
    mine.write_text("precious")
    assert run("new", "four-bar", "-o", mine).exit_code == 2
    assert mine.read_text() == "precious"


@pytest.mark.slow
def test_check_json(built):
    reports = json.loads(run("check", built, "--json").stdout)
    assert [item["judge"] for item in reports[0]["comparisons"]] == ["stored values", "reference", "search"]
    assert reports[0]["agrees"] is True


@pytest.mark.slow
def test_recalc_json_follows_the_input(built):
    before = json.loads(run("recalc", built, "--json").stdout)
    after = json.loads(run("recalc", built, "--set", "a1=65", "--json").stdout)
    assert before["Positions"].keys() == after["Positions"].keys()
    assert before["Positions"] != after["Positions"]


@pytest.mark.slow
def test_recalc_unknown_name(built):
    result = run("recalc", built, "--set", "a9=65")
    assert result.exit_code == 2
    assert 'no cell is named "a9"' in result.stderr


@pytest.mark.parametrize("setting", ["a1", "=3", "a1="])
def test_malformed_setting(built, setting):
    assert run("recalc", built, "--set", setting).exit_code == 2


@pytest.mark.slow
def test_show_equations_and_variables():
    assert "theta14 = phi - mode_1*psi" in run("show", FOUR_BAR, "--equations").stdout
    variables = json.loads(run("show", FOUR_BAR, "--json").stdout)
    assert {"theta12", "theta13", "theta14", "C.x", "mu"} <= variables.keys()
    lines = run("show", FOUR_BAR, "--csv").stdout.splitlines()
    assert len(lines) == 1 + len(variables["theta12"])
    assert "Positions" in run("show", FOUR_BAR, "--cells").stdout


def test_misspelt_command():
    result = run("chekc", "x")
    assert result.exit_code == 2
    assert 'did you mean "check"?' in result.stderr


def test_every_command_has_help_with_an_example():
    for name, command in main.commands.items():
        text = run(name, "--help").stdout
        assert f"mechsheet {name}" in text, name
        assert command.help


BAD_INPUT = {
    "missing": lambda path: None,
    "folder": lambda path: path.mkdir(),
    "binary": lambda path: path.write_bytes(bytes(range(256)) * 40),
    "empty": lambda path: path.write_bytes(b""),
    "not-a-zip": lambda path: path.write_text("hello"),
}


@pytest.mark.parametrize("kind", BAD_INPUT)
@pytest.mark.parametrize("command", ["check", "recalc"])
def test_bad_workbook(tmp_path, kind, command):
    path = tmp_path / "bad.xlsx"
    BAD_INPUT[kind](path)
    result = run(command, path)
    assert result.exit_code == 2
    assert len(result.stderr.strip().splitlines()) <= 3
    assert "bad.xlsx" in result.stderr


@pytest.mark.parametrize("kind", BAD_INPUT)
@pytest.mark.parametrize("command", ["build", "show", "check"])
def test_bad_description(tmp_path, kind, command):
    path = tmp_path / "bad.toml"
    BAD_INPUT[kind](path)
    result = run(command, path)
    assert result.exit_code == 2
    assert "bad.toml" in result.stderr


def test_truncated_workbook(built, tmp_path):
    path = tmp_path / "half.xlsx"
    data = built.read_bytes()
    for part in (0.1, 0.5, 0.95, 0.999):
        path.write_bytes(data[: int(len(data) * part)])
        result = run("check", path)
        assert result.exit_code == 2
        assert "half.xlsx" in result.stderr


def test_zip_that_is_no_workbook(tmp_path):
    path = tmp_path / "other.xlsx"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("hello.txt", "hello")
    result = run("check", path)
    assert result.exit_code == 2


def test_broken_toml(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('format = 1\n[mechanism\nname = "x"\n')
    result = run("build", path)
    assert result.exit_code == 2
    assert "bad.toml:2" in result.stderr


@pytest.mark.slow
def test_output_folder_missing_or_a_file(tmp_path):
    assert run("build", FOUR_BAR, "-o", tmp_path / "new").exit_code == 0
    assert (tmp_path / "new" / "four-bar.xlsx").exists()
    assert run("build", FOUR_BAR, "-o", tmp_path / "nowhere" / "deeper").exit_code == 2
    assert not (tmp_path / "nowhere").exists()
    file = tmp_path / "file"
    file.write_text("")
    assert run("build", FOUR_BAR, "-o", file).exit_code == 2


@pytest.mark.slow
def test_locked_folder(tmp_path, monkeypatch):
    """As when the folder may not be written: the message says so, nothing is left behind."""

    opened = Path.open

    def refuse(path, *arguments, **options):
        if path.suffix == ".tmp":
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return opened(path, *arguments, **options)

    monkeypatch.setattr(Path, "open", refuse)
    result = run("build", FOUR_BAR, "-o", tmp_path)
    assert result.exit_code == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_full_disk_keeps_the_old_file(tmp_path, monkeypatch):
    old = tmp_path / "four-bar.xlsx"
    old.write_bytes(b"the old one")

    def full(*_args, **_kwargs):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("livesheet.formats.archive.Archive.copied", full)  # where a part's bytes go to the disk
    result = run("build", FOUR_BAR, "-o", tmp_path, "--force")
    assert result.exit_code == 2
    assert "full" in result.stderr
    assert old.read_bytes() == b"the old one"
    assert [path.name for path in tmp_path.iterdir()] == ["four-bar.xlsx"]


def test_mobility_fault_has_file_and_line(tmp_path):
    path = tmp_path / "loose.toml"
    path.write_text(
        FOUR_BAR.read_text(encoding="utf-8").replace(
            'points = { B0 = [0, 0], B = ["a4", 0] }', "points = { B0 = [0, 0] }"
        )
    )
    for command in ("build", "show", "check"):
        result = run(command, path)
        assert result.exit_code == 2, command
        assert "loose.toml:" in result.stderr


TOLERANCED = TEMPLATES / "hoeken.toml"


@pytest.mark.slow
def test_show_prints_the_bands():
    lines = run("show", TOLERANCED, "--tolerance").stdout.splitlines()
    assert lines[-1].startswith("length ± 0.596 mm (RSS 0.316 mm): a2 61%")
    found = json.loads(run("show", TOLERANCED, "--tolerance", "--json").stdout)
    assert set(found) == {"deviation", "P.x", "length"}
    assert found["length"]["value"] == pytest.approx(188.1, abs=0.05)
    assert sum(found["length"]["shares"].values()) == pytest.approx(1.0)


@pytest.mark.slow
def test_bands_by_an_option(tmp_path):
    """The description inside asks for them, so `check` judges them too; without a tolerance it says what is missing."""
    mine = tmp_path / "mine.toml"
    mine.write_text(TOLERANCED.read_text(encoding="utf-8").partition("[tolerance]")[0], encoding="utf-8")
    assert run("build", mine, "--tolerance", "-o", tmp_path).exit_code == 0
    assert "all agree" in run("check", tmp_path / "mine.xlsx").stdout
    result = run("build", FOUR_BAR, "--tolerance", "-o", tmp_path)
    assert result.exit_code == 2
    assert (
        "four-bar.toml: tolerance: no dimension has a tolerance" in result.stderr
    )  # no line: nobody wrote [tolerance]
    assert "a1 = { value = 70, tolerance = 0.1 }" in result.stderr
    result = run("build", mine, "--tolerance", "--layout", "page", "-o", tmp_path)
    assert result.exit_code == 2
    assert "which the layout page does not have" in result.stderr
