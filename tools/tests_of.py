"""Which tests a module has: those named as it, and the files of tests that run most of it.

    python tools/tests_of.py src/mechsheet/kinematics/rpr.py    its files of tests, as tests/README.md has them
    python tools/tests_of.py --measure                          runs the tests and writes tests/README.md anew

Measured is which functions of a module each file of tests enters (tests/functions_run.py), in the run of `make quick`.
Listed for a module are its own tests, then those that enter most of its functions, two files in all; of files that enter
as many, one of the module's own room, then the one that enters least besides.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "src" / "mechsheet"
TESTS = ROOT / "tests"
PAGE = TESTS / "README.md"
MOST = 2
"""Files named besides a module's own."""

HEAD = """# Which tests a module has

Tests stand in the folders of `src/mechsheet`, named as the module they are of. Many modules are one step of a room's work
and are tested through it: then the table names the files of tests that run most of the module. `tools/tests_of.py` prints
a module's line, and makes this page (`--measure`) from what the tests of `make quick` enter; a module that none of these
enters is a table, or is tested by slower ones.
"""

Functions = Mapping[str, frozenset[str]]
"""Entered functions, by module."""


def modules() -> list[Path]:
    """Every module that holds code of its own, in the package's folder."""
    found = [path.relative_to(PACKAGE) for path in PACKAGE.rglob("*.py")]
    return sorted(path for path in found if path.name not in ("__init__.py", "__main__.py"))


def own(module: Path) -> Path | None:
    """The test that is named as the module."""
    path = TESTS / module.parent / f"test_{module.name}"
    return path.relative_to(TESTS) if path.exists() else None


def listed() -> dict[str, list[str]]:
    """The page read back: files of tests by module."""
    room, found = "", {}
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            room = line.removeprefix("## ").strip("`")
        elif line.startswith("| `"):
            module, files = (part.strip() for part in line.strip("|").split("|"))
            found[room + module.strip("`")] = [file.strip().strip("`") for file in files.split(",") if file.strip()]
    return found


def entered() -> dict[str, Functions]:
    """Functions that each file of tests enters, by a run of them; what fails is no matter here."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "pytest", "-n", "auto", "--dist", "loadfile", "--quick"]
        subprocess.run([*command, "-p", "functions_run", f"--functions-run={folder}"], cwd=ROOT, check=False)
        found: dict[str, dict[str, frozenset[str]]] = defaultdict(dict)
        for path in Path(folder).glob("*.json"):
            for file, entries in json.loads(path.read_text(encoding="utf-8")).items():
                for module, functions in entries.items():
                    before = found[file].get(module, frozenset())
                    found[file][module] = before | frozenset(functions)
    return {file.removeprefix("tests/"): entries for file, entries in found.items()}


def chosen(module: Path, runs: Mapping[str, Functions]) -> list[str]:
    """A module's own tests, then those that enter most of it."""
    name = module.as_posix()
    first = own(module)
    sizes = {file: sum(len(functions) for functions in entries.values()) for file, entries in runs.items()}
    room = module.parts[0]

    def order(file: str) -> tuple[int, bool, int, str]:
        return -len(runs[file][name]), not file.startswith(f"{room}/"), sizes[file], file

    others = sorted((file for file in runs if runs[file].get(name) and Path(file) != first), key=order)
    if not others and not first:  # what it does is done when it is imported
        dotted = f"mechsheet.{name.removesuffix('.py').replace('/', '.')}"
        others = sorted(file for file in runs if dotted in (TESTS / file).read_text(encoding="utf-8"))
    return [*([first.as_posix()] if first else []), *others[: MOST - (1 if first else 0)]]


def page(tests: Mapping[str, Sequence[str]]) -> str:
    """The page, a table for each room."""
    rooms: dict[str, list[tuple[str, Sequence[str]]]] = defaultdict(list)
    for module, files in sorted(tests.items()):
        room, _, name = module.rpartition("/")
        rooms[f"{room}/" if room else ""].append((name, files))
    lines = [HEAD]
    for room, rows in sorted(rooms.items()):
        lines += [f"## `{room}`" if room else "## ``", "", "| module | tests |", "|---|---|"]
        lines += [f"| `{name}` | {', '.join(f'`{file}`' for file in files)} |" for name, files in rows]
        lines.append("")
    return "\n".join(lines)


def main() -> int:
    """Prints the files of tests of modules, or writes the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("module", nargs="*", type=Path)
    parser.add_argument("--measure", action="store_true", help="run the tests and write tests/README.md anew")
    options = parser.parse_args()
    if options.measure:
        runs = entered()
        PAGE.write_text(page({module.as_posix(): chosen(module, runs) for module in modules()}), encoding="utf-8")
    tests = listed()
    for given in options.module:
        name = given.resolve().relative_to(PACKAGE).as_posix()
        print(name, *(f"  tests/{file}" for file in tests.get(name, ["not listed: run --measure"])), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
