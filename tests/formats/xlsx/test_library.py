"""XlsxWriter: what is private of it is named in one module and still there; its releases write the same file."""

import ast
import inspect
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from xlsxwriter.contenttypes import ContentTypes
from xlsxwriter.core import Core
from xlsxwriter.drawing import DrawingInfo
from xlsxwriter.sharedstrings import SharedStringTable
from xlsxwriter.styles import Styles

import mechsheet
from chosen import IN_CI
from folders import ROOT
from livesheet.formats.xlsx import library

SOURCE = Path(mechsheet.__file__).parent.parent
EXTENDED = [
    kind
    for kind in vars(library).values()
    if inspect.isclass(kind)
    and kind.__module__ == library.__name__
    and kind.__base__.__module__.startswith("xlsxwriter")
]
USED = (ContentTypes, Core, DrawingInfo(), SharedStringTable, Styles)
"""Classes of XlsxWriter of which something private is used, beside those that are extended."""


def named(kind):
    return set(re.findall(r"\b_[a-z]\w*", inspect.getdoc(kind)))


@pytest.mark.parametrize("kind", EXTENDED)
def test_private_names_are_still_there(kind):
    """An override whose name a new release has changed would never be called, and nobody would say so."""
    overridden = named(kind) & set(vars(kind))
    assert {name for name in overridden if not hasattr(kind.__base__, name)} == set()
    assert {name for name in named(kind) if not any(hasattr(place, name) for place in (kind.__base__, *USED))} == set()


@pytest.mark.parametrize("kind", EXTENDED)
def test_private_names_are_named_with_their_reason(kind):
    nodes = list(ast.walk(ast.parse(inspect.getsource(kind))))
    found = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    found |= {node.name for node in nodes if isinstance(node, ast.FunctionDef)}
    own = {name for name in vars(kind) if not hasattr(kind.__base__, name)} - named(kind)
    assert {name for name in found if re.match("_[a-z]", name)} - own == named(kind)


def test_no_other_module_knows_the_library():
    imports = re.compile(r"^\s*(from|import) xlsxwriter", re.MULTILINE)
    files = {path for path in SOURCE.rglob("*.py") if imports.search(path.read_text("utf-8"))}
    assert files == {Path(library.__file__)}


WRITES = """
import sys
from pathlib import Path
import xlsxwriter
from mechsheet import build, load
from livesheet.formats import write
from samples import sample
folder = Path(sys.argv[1])
write(sample(), folder / "sample.xlsx")
build(load(sys.argv[2]), folder / "four-bar.xlsx")
print(xlsxwriter.__version__, xlsxwriter.__file__)
"""


def written(folder, side=None):
    """Bytes of the workbooks by name, and what wrote them; `side` is a folder whose XlsxWriter goes first."""
    folder.mkdir()
    paths = [*([side] if side else []), SOURCE, ROOT / "tests" / "formats"]
    run = subprocess.run(
        [sys.executable, "-c", WRITES, str(folder), str(ROOT / "templates" / "four-bar.toml")],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, paths))},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    return {path.name: path.read_bytes() for path in folder.iterdir()}, run.stdout.strip()


def install(wanted, target):
    """Put a release into a folder; where the package index cannot be reached, say so."""
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", str(target), wanted]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode:
        message = f"{wanted} could not be installed beside the own one: {run.stderr.strip()[-500:]}"
        if IN_CI:
            pytest.fail(f"{message}\nCI must try the lowest and the newest release", pytrace=False)
        pytest.skip(message)


def allowed():
    """The range of releases in pyproject.toml, and the lowest of them."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    wanted = next(one for one in project["dependencies"] if one.startswith("XlsxWriter"))
    return wanted, re.search(r">=([0-9.]+)", wanted)[1]


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("end", ["lowest", "newest"])
def test_every_release_writes_the_same_file(end, tmp_path):
    wanted, lowest = allowed()
    install(f"XlsxWriter=={lowest}" if end == "lowest" else wanted, tmp_path / "side")
    theirs, release = written(tmp_path / "theirs", tmp_path / "side")
    ours, _ = written(tmp_path / "ours")
    assert str(tmp_path) in release
    if end == "lowest":
        assert release.split()[0] == lowest
    assert set(theirs) == {"sample.xlsx", "four-bar.xlsx"}
    assert [name for name in theirs if theirs[name] != ours[name]] == []
