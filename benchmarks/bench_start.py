"""What a command costs before and beside its work: CPU time of whole processes, as multiples of `python -c "import numpy"`.

    python benchmarks/bench_start.py [--runs 5] [--check]

A small workbook, a small description: what is measured is mostly Python starting, modules being loaded and what they do when
they are. The commands run in turn, the least of all runs counts; a first round that compiles modules does not. --check fails
where a goal is missed.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mechsheet.words.catalogue import FOLDER
from mechsheet.words.compiling import compiled

ROOT = Path(__file__).parent.parent
TEMPLATE = str(ROOT / "templates" / "four-bar.toml")
WORKBOOK = "checked.xlsx"
"""Built from the template before anything is measured."""
COMMANDS = {
    "--help": (("--help",), None),
    "recalc": (("recalc", WORKBOOK), 3.0),
    "show": (("show", TEMPLATE), 3.3),
    "build": (("build", TEMPLATE, "-o", "."), 4.6),
    "check": (("check", WORKBOOK), 6.0),
    "plot": (("plot", TEMPLATE, "-o", "four-bar.svg"), 4.6),
}
"""What is run, and what it may cost."""
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""Packages that are installed have their modules compiled."""


def cpu_seconds(arguments: tuple[str, ...], folder: str) -> float:
    """CPU time of one Python process and its children."""
    command = [sys.executable, *arguments]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=ENVIRONMENT, cwd=folder)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"{' '.join(arguments)} failed: {said.decode()}")
    return usage.ru_utime + usage.ru_stime


@contextmanager
def compiled_catalogues() -> Iterator[None]:
    """Catalogues of words as a wheel has them; a source tree compiles them whenever it starts."""
    made = [path.with_suffix(".mo") for path in FOLDER.glob("*.po") if not path.with_suffix(".mo").exists()]
    try:
        for path in made:
            path.write_bytes(compiled(path.with_suffix(".po").read_text(encoding="utf-8")))
        yield
    finally:
        for path in made:
            path.unlink(missing_ok=True)


def main() -> None:
    """Print the table; with --check, fail where a goal is missed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--check", action="store_true", help="fail where a goal is missed")
    options = parser.parse_args()
    least = dict.fromkeys(["numpy", *COMMANDS], float("inf"))
    with tempfile.TemporaryDirectory(prefix="mechsheet-bench-") as folder, compiled_catalogues():
        cpu_seconds(("-m", "mechsheet", "build", TEMPLATE, "-o", WORKBOOK), folder)
        for run in range(options.runs + 1):
            for name in least:
                arguments = ("-c", "import numpy") if name == "numpy" else ("-m", "mechsheet", *COMMANDS[name][0])
                used = cpu_seconds(arguments, folder)
                least[name] = min(least[name], used) if run else least[name]
    print(f"import numpy: {least['numpy'] * 1000:.0f} ms of CPU\n\n| command | times that | goal |\n|---|--:|--:|")
    missed = []
    for name, (_, goal) in COMMANDS.items():
        ratio = least[name] / least["numpy"]
        print(f"| {name} | {ratio:.2f} | {goal or ''} |")
        if goal is not None and ratio > goal:
            missed.append(name)
    if options.check and missed:
        raise SystemExit(f"goals missed: {', '.join(missed)}")


if __name__ == "__main__":
    main()
