"""What is doubtful in a description is said on standard error, with file and line; the command does its work."""

import pytest

from command_line import run
from mechsheet.description.templates import template_text


@pytest.mark.slow
def test_a_sketch_of_another_position_is_a_warning(tmp_path):
    path = tmp_path / "mine.toml"
    text = template_text("four-bar").replace("B = [50, 55]", "A = [26.8, 22.5]\nB = [85, 54]\nA0 = [0, 0]")
    path.write_text(text, encoding="utf-8")
    result = run("show", path)
    assert result.exit_code == 0
    assert result.stdout.startswith("Four-bar linkage")
    line = text.split("\n").index("[assembly]") + 1
    assert f"warning: {path.as_posix()}:{line}: assembly: the sketch is read at the first position" in result.stderr
    assert f'warning: {path.as_posix()}:{line + 3}: assembly.A0: "A0" is a point of the ground' in result.stderr


@pytest.mark.slow
def test_a_good_sketch_is_silent(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(template_text("four-bar"), encoding="utf-8")
    assert run("show", path).stderr == ""
