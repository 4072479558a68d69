"""Run every command of README and docs as a reader would: page by page, in an empty folder.

    python tools/documented.py                                      # the mechsheet on the PATH
    python tools/documented.py --program /tmp/venv/bin/mechsheet    # one that is installed elsewhere

Run are the lines of `sh` blocks that call mechsheet. A whole description that a page shows lies in the folder as NAME.toml,
as if the reader had saved it. What needs an extra that is not installed is told apart from what fails. tests/test_readme.py
runs the same lines inside one process, from the checkout.
"""

from __future__ import annotations

import argparse
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"```(sh|toml)\n(.*?)```", re.DOTALL)
DESCRIBED = {"studies.md": "wiper.md"}
"""Page -> the page that shows the descriptions that it uses."""
ELSEWHERE = ("--on ",)
"""Options that need another machine."""
MISSING = "No such file"
EXTRA = re.compile(r"mechsheet\[\w+\]")


def commands(page: Path) -> list[str]:
    """Lines of `sh` blocks that call mechsheet, comments cut off."""
    blocks = [text for kind, text in BLOCK.findall(page.read_text(encoding="utf-8")) if kind == "sh"]
    lines = "\n".join(blocks).splitlines()
    return [line.split("  #")[0].strip() for line in lines if line.startswith("mechsheet ")]


def descriptions(page: Path) -> dict[str, str]:
    """Whole descriptions that a page shows, by the name of the file that a reader would give them."""
    texts = [text for kind, text in BLOCK.findall(page.read_text(encoding="utf-8")) if kind == "toml"]
    whole = [(tomllib.loads(text), text) for text in texts]
    return {f"{found['mechanism']['name']}.toml": text for found, text in whole if "format" in found}


def run_page(program: str, page: Path, folder: Path) -> Iterator[tuple[str, str]]:
    """Every command of a page with what went wrong: "" for nothing."""
    for source in (page, page.parent / DESCRIBED.get(page.name, page.name)):
        for name, text in descriptions(source).items():
            (folder / name).write_text(text, encoding="utf-8")
    for line in commands(page):
        if any(option in line for option in ELSEWHERE):
            continue
        command = [program, *shlex.split(line)[1:]]
        done = subprocess.run(command, cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, check=False)
        yield line, done.stderr.decode(errors="replace").strip() if done.returncode else ""


def main() -> int:
    """The exit code: 1 when a command failed that no missing extra explains."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--program", default="mechsheet")
    program = parser.parse_args().program
    failed = 0
    for page in PAGES:
        with tempfile.TemporaryDirectory(prefix="documented-") as folder:
            before = None  # an extra that an earlier line of the page needs: later ones read what it writes
            for line, fault in run_page(program, page, Path(folder)):
                needs = fault and (EXTRA.search(fault) or (before if MISSING in fault else None))
                before = needs or before
                failed += bool(fault and not needs)
                state = f"needs {needs[0]}" if needs else "FAILED" if fault else "ok"
                print(f"{state:<24}{page.name}: {line}", flush=True)
                if fault and not needs:
                    print(f"    {fault}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
