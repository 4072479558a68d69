"""The commands of README and docs are run as they stand there."""

import re
import shlex
import sys

import pytest

from chosen import IN_CI
from command_line import run
from folders import ROOT

sys.path.append(str(ROOT / "tools"))
from documented import PAGES, commands

LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")


ELSEWHERE = ("studies.md", "wiper.md")
"""Pages whose descriptions stand on the page: tests/test_wiper.py runs their commands."""

LONG = ("designer.md", "lecturer.md")
"""Run in CI only: the first takes longest; the second has commands much like those of lecturer.tr.md and README.md."""


def test_the_readme_has_commands():
    assert len(commands(ROOT / "README.md")) >= 5


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(
    "page",
    [page for page in PAGES if page.name not in (*ELSEWHERE, *(() if IN_CI else LONG)) and commands(page)],
    ids=lambda page: page.name,
)
def test_commands_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for command in commands(page):
        if "--with" in command:
            continue  # other programs: see tests/differential
        result = run(*shlex.split(command)[1:])
        assert result.exit_code == 0, f"{command}\n{result.output}\n{result.stderr}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    targets = LINK.findall(page.read_text(encoding="utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []


def test_the_readme_has_links():
    assert len(LINK.findall((ROOT / "README.md").read_text(encoding="utf-8"))) > 10
