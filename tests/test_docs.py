"""The pages of docs: what follows from the code is up to date, examples are right, links lead somewhere."""

import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

from mechsheet.cli import main as commands
from mechsheet.description import loads
from mechsheet.description.schema import DESCRIPTION, Either, Items, Kinds, Named, Shape, Table
from mechsheet.kinematics.solve import solve

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
sys.path.insert(0, str(ROOT / "tools"))
import reference  # noqa: E402

BLOCK = re.compile(r"```toml\n(.*?)```", re.DOTALL)
EXAMPLES = [
    (path.name, number, text)
    for path in sorted(DOCS.glob("*.md"))
    for number, text in enumerate(BLOCK.findall(path.read_text(encoding="utf-8")), 1)
]


@pytest.mark.parametrize("name", sorted(reference.PAGES))
def test_pages_made_from_the_code_are_up_to_date(name):
    assert (DOCS / name).read_text(encoding="utf-8") == reference.PAGES[name](), "run `make reference`"


@pytest.mark.parametrize(("page", "number", "text"), EXAMPLES, ids=lambda part: str(part)[:20])
def test_examples_are_toml_and_whole_ones_solve(page, number, text):
    found = tomllib.loads(text)
    if "format" in found:
        assert solve(loads(text)).groups


def keys_of(shape: Shape, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Every key of the format as a path, `*` for names that the description gives."""
    match shape:
        case Table(keys):
            for name, key in keys.items():
                yield (*path, name)
                yield from keys_of(key.shape, (*path, name))
        case Named(item):
            yield from keys_of(item, (*path, "*"))
        case Items(item):
            yield from keys_of(item, path)
        case Kinds(_, tables):
            for table in tables.values():
                yield from keys_of(table, path)
        case Either(shapes):
            for part in shapes:
                yield from keys_of(part, path)


def used(value: object, path: tuple[str, ...], known: set[tuple[str, ...]]) -> Iterator[tuple[str, ...]]:
    """The paths of the keys that an example uses, written as `keys_of` writes them."""
    if isinstance(value, list):
        for item in value:
            yield from used(item, path, known)
    if not isinstance(value, dict):
        return
    for name, below in value.items():
        place = (*path, name) if (*path, name) in known else (*path, "*")
        yield place
        yield from used(below, place, known)


def test_every_key_has_an_example():
    known = set(keys_of(DESCRIPTION))
    shown = {
        key for page, _, text in EXAMPLES if page == "description.md" for key in used(tomllib.loads(text), (), known)
    }
    assert known - shown == set()


def test_the_site_is_built_and_its_links_lead_somewhere(tmp_path):
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(tmp_path / "site")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "site" / "index.html").exists()


@pytest.mark.parametrize("path", [".pre-commit-hooks.yaml", "docs/examples/check-workbooks.yml"])
def test_ready_files_run_commands_that_exist(path):
    """The hook and the workflow are YAML, and their `mechsheet` lines have options that the command knows."""
    yaml = pytest.importorskip("yaml")
    text = (ROOT / path).read_text(encoding="utf-8")
    assert yaml.safe_load(text)
    lines = re.findall(r"(?:entry|run): mechsheet (.*)", text)
    assert lines
    for line in lines:
        name, *options = line.split()
        known = {option for parameter in commands.commands[name].params for option in parameter.opts}
        assert {option for option in options if option.startswith("-")} <= known
