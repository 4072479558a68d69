"""The wheel that users install: what is in it, and that it works without the checkout."""

import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from folders import ROOT
from mechsheet.extras import EXTRAS

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", ".", "--no-deps", "--no-build-isolation", "-q", "-w", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    return next(folder.glob("*.whl"))


def test_contents(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    inside = {name.removeprefix("mechsheet/") for name in names if name.startswith("mechsheet/")}
    source = ROOT / "src" / "mechsheet"
    modules = {path.relative_to(source).as_posix() for path in source.rglob("*.py")}
    templates = {f"templates/{path.name}" for path in (ROOT / "templates").iterdir() if not path.name.startswith(".")}
    data = {
        "py.typed",
        "plotting/page.css",
        "plotting/page.html",
        "plotting/page.js",
    }
    brought = {f"exporting/brought/{path.name}" for path in (source / "exporting" / "brought").iterdir()}
    page = {f"drawing_page/page/{path.name}" for path in (source / "drawing_page" / "page").iterdir()}
    catalogues = {f"words/catalogues/{path.stem}.mo" for path in (source / "words" / "catalogues").glob("*.po")}
    assert inside == modules | templates | data | page | catalogues | brought
    assert "templates/mechsheet.schema.json" in templates
    library = {name for name in names if name.startswith("livesheet/")}
    beside = {path.relative_to(ROOT / "src").as_posix() for path in (ROOT / "src" / "livesheet").rglob("*.py")}
    assert library == beside | {"livesheet/py.typed", "livesheet/formula/functions.txt"}
    outside = {name.split("/", 1)[1] for name in names if not name.startswith(("mechsheet/", "livesheet/"))}
    assert outside == {"METADATA", "WHEEL", "RECORD", "entry_points.txt", "licenses/LICENSE"}


def test_the_source_archive_holds_what_the_wheel_is_built_from(wheel, tmp_path):
    """Neither tests nor ready workbooks: a small archive, from which the same wheel comes."""
    from hatchling.builders.sdist import SdistBuilder

    (path,) = SdistBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"])
    with tarfile.open(path) as archive:
        names = {name.split("/", 1)[1] for name in archive.getnames()}
    rooms = {name.partition("/")[0] for name in names}
    alone = {"hatch_build.py", "pyproject.toml", "README.md", "CHANGELOG.md", "LICENSE", "PKG-INFO", ".gitignore"}
    assert rooms == {"src", "templates", *alone}
    inside = {name for name in zipfile.ZipFile(wheel).namelist() if name.startswith(("mechsheet/", "livesheet/"))}
    assert {f"src/{name}".replace(".mo", ".po") for name in inside if "/templates/" not in name} <= names
    assert {f"templates/{Path(name).name}" for name in inside if "/templates/" in name} <= names


def test_what_a_package_index_shows_leads_to_nothing_that_is_not_there(wheel):
    archive = zipfile.ZipFile(wheel)
    metadata = next(name for name in archive.namelist() if name.endswith("METADATA"))
    _, _, shown = archive.read(metadata).decode("utf-8").partition("\n\n")
    assert shown.startswith("# mechsheet\n")
    assert "mechsheet new four-bar -o mine.toml" in shown
    assert "](" not in shown.replace("](https://", "")  # pictures and links into the repository
    assert "| |" not in shown  # the table of pictures


PACKAGES_OF_EXTRAS = [package.replace("-", "_") for packages, _ in EXTRAS.values() for package in packages]


@pytest.mark.ci
def test_it_works_without_the_checkout_and_without_extras(wheel, tmp_path):
    """From templates to a checked workbook, with the modules of the wheel and what a bare install brings along."""
    place = tmp_path / "installed"
    command = [sys.executable, "-m", "pip", "install", "--no-deps", "-q", "--target", str(place), str(wheel)]
    subprocess.run(command, check=True, capture_output=True)
    # read by Python when it starts: an import of these fails, as if they were not installed
    (place / "sitecustomize.py").write_text(f"import sys\nsys.modules.update(dict.fromkeys({PACKAGES_OF_EXTRAS}))\n")
    environment = os.environ | {"PYTHONPATH": str(place)}

    def run(*arguments: str) -> str:
        line = [sys.executable, *arguments]
        done = subprocess.run(line, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    where = run("-c", "import mechsheet; print(mechsheet.__file__)").strip()
    assert Path(where).is_relative_to(place)
    assert "four-bar" in run("-m", "mechsheet", "new", "--list").split()
    run("-m", "mechsheet", "new", "four-bar", "-o", "mine.toml")
    run("-m", "mechsheet", "build", "mine.toml", "--format", "xlsx,ods")
    assert "all agree" in run("-m", "mechsheet", "check", "mine.xlsx", "mine.ods")
    assert "a_1 = 65.0" in run("-m", "mechsheet", "recalc", "mine.xlsx", "--set", "a1=65")
    assert "crank-rocker" in run("-m", "mechsheet", "show", "mine.toml", "--verdicts")
    for arguments in (("export", "mine.toml", "--to", "python"), ("plot", "mine.toml", "-o", "mine.html")):
        run("-m", "mechsheet", *arguments)
    (tmp_path / "class.csv").write_text("id\n1\n", encoding="utf-8")
    run("-m", "mechsheet", "exercise", "mine.toml", "class.csv", "-o", "week")
    run("-m", "mechsheet", "mark", "week/solution", "--against", "week/key.json", "-o", "marks.xlsx")
    with pytest.raises(AssertionError, match=r"mechsheet\[plot\]"):
        run("-m", "mechsheet", "plot", "mine.toml", "-o", "mine.png")


def test_nothing_heavy_at_the_start():
    """`mechsheet --help` loads neither numpy nor any reader or writer of files."""
    code = (
        "import sys; from mechsheet.cli import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "print(sorted({'numpy', 'openpyxl', 'xlsxwriter', 'lxml', 'formulas', 'matplotlib'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
