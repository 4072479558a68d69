"""`check` and `pull` on workbooks that somebody has edited, as a user types it."""

import json

import pytest

from command_line import run
from folders import TEMPLATES
from mechsheet.checking.report import focused
from mechsheet.description.templates import template_text


@pytest.fixture(scope="module")
def yoke(tmp_path_factory):
    folder = tmp_path_factory.mktemp("edited")
    assert run("build", TEMPLATES / "scotch-yoke.toml", "-o", folder).exit_code == 0
    return folder / "scotch-yoke.xlsx"


@pytest.fixture(scope="module")
def changed(yoke):
    """A dimension changed, as `recalc` writes it."""
    path = yoke.with_name("changed.xlsx")
    assert run("recalc", yoke, "--set", "a2=45", "-o", path).exit_code == 0
    return path


@pytest.mark.slow
def test_pull_and_build_again(changed, tmp_path):
    new = tmp_path / "new.toml"
    result = run("pull", changed, "-o", new)
    assert result.exit_code == 0
    assert "a2: " in result.stderr
    assert "-> 45" in result.stderr
    assert run("build", new, "-o", tmp_path).exit_code == 0
    report = json.loads(run("check", tmp_path / "new.xlsx", "--json").stdout)[0]
    assert report["agrees"]
    assert report["remarks"] == []


@pytest.mark.slow
def test_pull_to_standard_output(changed, yoke):
    result = run("pull", changed)
    assert result.stdout.startswith("#")
    assert result.stdout.endswith("\n")
    assert "nothing was changed" in run("pull", yoke).stderr


@pytest.mark.slow
def test_pull_does_not_overwrite_but_what_it_pulls_into(changed, tmp_path):
    mine = tmp_path / "mine.toml"
    mine.write_bytes((TEMPLATES / "scotch-yoke.toml").read_bytes())
    result = run("pull", changed, "-o", mine)
    assert result.exit_code == 2
    assert "there is a file already" in result.stderr
    assert mine.read_bytes() == (TEMPLATES / "scotch-yoke.toml").read_bytes()
    assert run("pull", changed, "--into", mine, "-o", mine).exit_code == 0
    assert mine.read_bytes() != (TEMPLATES / "scotch-yoke.toml").read_bytes()


@pytest.mark.slow
def test_a_conflict_writes_nothing(changed, tmp_path):
    mine, new = tmp_path / "mine.toml", tmp_path / "new.toml"
    text = template_text("scotch-yoke")
    old = next(line for line in text.splitlines() if line.startswith("a2"))
    mine.write_text(text.replace(old, "a2 = 51"), encoding="utf-8")
    result = run("pull", changed, "--into", mine, "-o", new)
    assert result.exit_code == 2
    assert "mine.toml" in result.stderr
    assert "is 51 here and 45 in" in result.stderr
    assert not new.exists()


@pytest.mark.parametrize("content", [None, b"", b"hello", bytes(range(256))])
@pytest.mark.parametrize("command", [("pull",), ("check", "--perturb", "1"), ("check", "--mutate", "1")])
def test_no_workbook(tmp_path, content, command):
    path = tmp_path / "bad.xlsx"
    if content is not None:
        path.write_bytes(content)
    result = run(*command, path)
    assert result.exit_code == 2
    assert "bad.xlsx" in result.stderr


@pytest.mark.slow
def test_perturb(yoke):
    result = run("check", yoke, "--perturb", "2", "--seed", "3")
    assert result.exit_code == 0
    assert "2 sets (seed 3)" in result.stdout
    assert "a2 = " in result.stdout
    data = json.loads(run("check", yoke, "--perturb", "2", "--seed", "3", "--json").stdout)[0]
    assert (data["sets"], data["seed"], data["agrees"]) == (2, 3, True)
    assert data["judges"][0]["inputs"]["a2"] > 0


@pytest.mark.slow
def test_mutate(yoke):
    result = run("check", yoke, "--mutate", "2")
    assert result.exit_code == 0
    assert "2 damages that change a value (seed 0)" in result.stdout
    assert "check                    2 caught, 100.00%" in result.stdout
    data = json.loads(run("check", yoke, "--mutate", "2", "--json").stdout)[0]
    assert (data["damages"], data["caught"]["check"], data["clear"]) == (2, 2, True)


def test_mutate_goes_alone(yoke):
    for others in (["--perturb", "1"], ["--with", "ironcalc"]):
        assert run("check", yoke, "--mutate", "1", *others).exit_code == 2


def test_numbers_that_make_no_sense(yoke):
    for option in ("--perturb", "--mutate"):
        for number in ("0", "-1", "many"):
            assert run("check", yoke, option, number).exit_code == 2


def test_long_formulas_are_shown_where_they_differ():
    was, now = "=" + "A1+" * 80 + "SIN(B1)" + "+C1" * 80, "=" + "A1+" * 80 + "COS(B1)" + "+C1" * 80
    one, other = focused(was, now)
    assert len(one) < 90
    assert "SIN(B1)" in one
    assert "COS(B1)" in other
    assert one.startswith("…")
    assert one.endswith("…")
    assert focused("=A1", "=A2") == ("=A1", "=A2")
    assert focused(was, "") == (was[:200] + "…", "")
