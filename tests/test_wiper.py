"""The designer's tutorial: what it shows is what a reader gets."""

import re
from pathlib import Path

import pytest

from command_line import run

pytestmark = pytest.mark.slow

pytest.importorskip("pyarrow")

PAGE = (Path(__file__).parent.parent / "docs" / "wiper.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.ci
def test_the_study_of_the_wiper_says_what_its_page_shows(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("wiper.toml").write_text(re.search(r"```toml\n(.*?)```", PAGE, re.DOTALL)[1], encoding="utf-8")
    done = run("study", "wiper.toml", "-o", "wiper", "--workers", "1")
    assert done.exit_code == 0, done.output
    assert done.stderr.strip() == SHOWN[0].strip()
    assert [line.rstrip() for line in done.stdout.strip().splitlines()] == SHOWN[1].strip().splitlines()
    command = re.search(r"mechsheet (build .*--design.*)", PAGE)[1].split()
    built = run(*command)
    assert built.exit_code == 0, built.output
    assert SHOWN[2].strip() in built.stderr
