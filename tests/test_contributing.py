"""The table of docs/contributing.md: the files are there, and what a change is said to touch is all that it touches."""

import re
from token import NAME
from tokenize import tokenize

import pytest

from folders import ROOT

PACKAGES = (ROOT / "src" / "mechsheet", ROOT / "src" / "livesheet")

MOST = 8
"""Existing modules that one kind of change may touch: a function of descriptions is computed, derived and written."""

MOST_OF_AN_ANALYSIS = 6
"""The design's own measure: velocities were to touch so many."""


def table():
    text = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")
    lines = text.partition("**Which files a change touches**")[2].splitlines()
    rows = [line.strip("| ").split(" | ") for line in lines if line.startswith("| ")][1:]
    return {change: re.findall(r"`([^`]+)`", files) for change, files in rows}


ROWS = table()


def modules_with(pattern):
    """Modules and catalogues of the program whose text holds a pattern, below the package that they are in."""
    return {
        path.relative_to(package).as_posix()
        for package in PACKAGES
        for kind in ("py", "po")
        for path in package.rglob(f"*.{kind}")
        if re.search(pattern, path.read_text(encoding="utf-8"))
    }


@pytest.mark.parametrize("page", ["architecture", "contributing"])
def test_files_that_pages_name_are_there(page):
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    named = {name for name in re.findall(r"`([\w/]+(?:/|\.py|\.txt))`", text) if "NEW" not in name}
    there = {f"/{path.relative_to(ROOT).as_posix()}" for path in (ROOT / "src").rglob("*")}
    assert named
    assert {
        name
        for name in named
        if not (ROOT / name).exists() and not any(path.endswith(f"/{name.rstrip('/')}") for path in there)
    } == set()


def covered(module, files):
    return any(module == name or (name.endswith("/") and module.startswith(name)) for name in files)


@pytest.mark.parametrize("change", ROWS)
def test_files_are_there_and_few(change):
    there = [name for name in ROWS[change] if "NEW" not in name]
    assert all(any((package / name).exists() for package in PACKAGES) for name in there), there
    assert len(there) <= (MOST_OF_AN_ANALYSIS if change.startswith("an analysis") else MOST)


def test_a_dyad_is_named_in_no_other_module():
    files = ROWS["a kind of dyad"]
    assert all(covered(module, files) for module in modules_with(r'"RPR"')), modules_with(r'"RPR"')


def test_what_is_no_formula_is_a_case_in_no_other_module():
    """One that writes such a thing into its equations names it, too: a case is what tells it from others."""
    row = next(change for change in ROWS if change.startswith("a thing in the list of equations"))
    cases = modules_with(r"case TriangleAngle\(")
    assert {"kinematics/numeric.py", "exporting/lowering.py", "sheet/columns/lowering.py"} <= cases
    assert all(covered(module, ROWS[row]) for module in cases), cases


def test_a_worksheet_function_is_named_in_its_table_and_its_kernel():
    files = ROWS["a worksheet function"]
    for name in ("PERCENTRANK", "BESSELI", "NETWORKDAYS"):
        found = modules_with(rf'"{name}"')
        assert found
        assert all(covered(module, files) for module in found), found
        assert re.search(
            rf"^{name}\b", (ROOT / "src/livesheet/formula/functions.txt").read_text(encoding="utf-8"), re.MULTILINE
        )


@pytest.mark.parametrize("name", ["dead-centres", "guidance", "quick-return-slider", "quick-return-lever"])
def test_a_kind_of_synthesis_is_named_in_no_other_module(name):
    """Not `function`, which names much else; `synthesis/` holds one module for each."""
    files = ROWS["a kind of synthesis"]
    found = modules_with(rf'["\.]{name}"')
    assert "synthesis/kinds.py" in found
    assert all(covered(module, files) for module in found), found


def test_a_take_is_named_in_no_other_module():
    found = modules_with(r'"(take\.)?rms"')
    assert set(found) == set(ROWS["a take of a summary"])


@pytest.mark.parametrize("name", ["EXP", "LN"])
def test_a_function_of_descriptions_is_named_where_it_is_said(name):
    """Of worksheets and of Basic others have lists of functions, which have these too."""
    found = {module for module in modules_with(rf'"{name}"') if not module.startswith(("engine/", "basic/"))}
    assert found | {"formula/parser.py"} == set(ROWS["a function of descriptions"])


def test_turkish_words_stand_in_one_place():
    """Beside `words/`: alphabets (what counts as a letter; names of a textbook's routines), and the exports' programs."""
    letters = (
        "description/scope.py",
        "engine/resolve.py",
        "formula/names.py",
        "formats/ods/values.py",
        "cli/streams.py",
        "shapes/names.py",  # letters that reach below the line
        "library/routines.py",  # names of the routines that a Turkish text brings along, and how they are folded
    )
    found = modules_with(r"[ğışİŞĞ]")
    others = {m for m in found if not m.startswith(("words/", "exporting/")) and m not in letters}
    assert others == set()


OF_CAMS = {"cam", "cams", "Cam", "CAM", "CONTACT", "segments", "Segments"}


@pytest.mark.slow
def test_modules_that_name_a_cam_are_those_that_the_page_gives_a_reason_for():
    """Another module that asks about a cam is to be seen, and said why."""
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    text = page.partition("## What a cam touches")[2].partition("\n## ")[0]
    listed = {name for line in text.splitlines() if line.startswith("| `")
              for name in re.findall(r"`([^`]+\.py)`", line.split(" | ")[0])}  # fmt: skip
    package = ROOT / "src" / "mechsheet"
    naming = set()
    for path in package.rglob("*.py"):
        with path.open("rb") as file:
            if any(token.type == NAME and token.string in OF_CAMS for token in tokenize(file.readline)):
                naming.add(path.relative_to(package).as_posix())
    assert listed == naming
    assert f"These are {len(naming)} modules" in text
