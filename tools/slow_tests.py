"""How long tests take: measures the CPU time of each and writes tests/slow.txt.

    python tools/slow_tests.py [--seconds 50] [--quick] [--times FOLDER]

All tests are taken, with all their cases, the cheapest first, until together they take so many seconds of CPU time; what is
left is named in tests/slow.txt. tests/conftest.py leaves it out of `make quick`, but for the first case of those whose cases
are cheap, and a test that takes very long runs with a part of its cases, a larger one in CI. A test that is new runs
everywhere until this is run again. Tests share what they compute: when the first that asks for something is left out, the
next one pays for it. So --quick measures what `make quick` runs with the present list, and adds to the list. --times takes
what an earlier run of tests/cpu_of_tests.py has measured.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent
LIST = ROOT / "tests" / "slow.txt"

HEAD = "# Tests that take long (tools/slow_tests.py): seconds of CPU time, cases, test\n"


@dataclass
class Needed:
    """CPU time of a test, all its cases together."""

    seconds: float = 0.0
    cases: int = 0


def measure(folder: Path, quick: bool) -> None:
    """Runs the tests; what fails is no matter here."""
    command = [sys.executable, "-m", "pytest", "-n", "auto", "--dist", "worksteal", *(["--quick"] if quick else [])]
    environment = dict(os.environ) if quick else dict(os.environ, MECHSHEET_MEASURED="1")
    subprocess.run([*command, "-p", "cpu_of_tests", f"--cpu-of-tests={folder}"], cwd=ROOT, env=environment, check=False)


def needed(folder: Path) -> dict[str, Needed]:
    """What each test needed."""
    found: defaultdict[str, Needed] = defaultdict(Needed)
    for path in folder.glob("*.txt"):
        for line in path.read_text(encoding="utf-8").splitlines():
            seconds, _, test = line.partition(" ")
            found[test].seconds += float(seconds)
            found[test].cases += 1
    return found


def left_out(tests: dict[str, Needed], most: float) -> dict[str, Needed]:
    """Those that no longer fit when the cheapest are taken first."""
    left, taken = {}, 0.0
    for test, need in sorted(tests.items(), key=lambda item: (item[1].seconds, item[0])):
        taken += need.seconds
        if taken > most:
            left[test] = need
    return left


def listed() -> dict[str, Needed]:
    """The list as it is."""
    lines = [line.split() for line in LIST.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return {test: Needed(float(seconds), int(cases)) for seconds, cases, test in lines}


def main() -> int:
    """Writes the list."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=50.0)
    parser.add_argument("--quick", action="store_true", help="measure what `make quick` runs, and add to the list")
    parser.add_argument("--times", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        times = options.times or Path(folder)
        if not options.times:
            measure(times, options.quick)
        tests = needed(times)
    left = left_out(tests, options.seconds)
    if options.quick:
        left = listed() | left
    lines = [f"{need.seconds:.1f} {need.cases} {test}\n" for test, need in sorted(left.items())]
    LIST.write_text(HEAD + "".join(lines), encoding="utf-8")
    whole, rest = (sum(need.seconds for need in some.values()) for some in (tests, left))
    print(f"{len(tests)} tests, {whole:.0f} s; {len(left)} left to make test, {rest:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
