"""mechsheet beside other spreadsheet engines on the same files: CPU time of whole processes, and of one change in memory.

    python benchmarks/bench_peers.py [--quick] [--write docs/speed.md]

Whole process: start, read the file, recalculate everything, read one value (programs: write the table as .csv); CPU time of
the process and its children, the best of some runs, as multiples of mechsheet's on the same file. One change: the workbook
is in memory, a dimension is set and the last cell of the table is read, which depends on all of it.
Every answer is compared with numpy's. Peers that are not installed are named and left out.
"""

from __future__ import annotations

import argparse
import importlib.util
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from itertools import count
from pathlib import Path

from tables import COLUMNS, FIRST, by_hand, write_table

CHANGED = 34.5
"""What the dimension a_2 (Mechanism!B2) is set to."""
LAST = len(COLUMNS) + 1
"""The table's last column, counted from 1."""
FILES = {
    "361": (361, False),
    "3,601": (3_601, False),
    "36,001": (36_001, False),
    "36,001 shared": (36_001, True),
    "361,000 shared": (361_000, True),
}
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""Packages that are installed have their modules compiled."""
SLOW = 4.0
"""Seconds from which on a process is not run again."""
MARKS = "<!-- peers -->", "<!-- end of peers -->"


class Mechsheet:
    most = 361_000

    def __init__(self, path):
        import mechsheet

        self.book = mechsheet.open_book(path)

    def set(self, value):
        self.book["a_2"] = value

    def get(self, row, col):
        return self.book.number(f"Positions!{chr(64 + col)}{row}")


class Ironcalc:
    most = 361_000

    def __init__(self, path):
        import ironcalc

        self.model = ironcalc.load_from_xlsx(str(path), "en", "UTC", "en")
        self.model.evaluate()

    def set(self, value):
        self.model.set_user_input(1, 2, 2, repr(value))
        self.model.evaluate()

    def get(self, row, col):
        return self.model.get_cell_value(0, row, col)


class Formualizer:
    most = 36_001

    def __init__(self, path):
        import formualizer

        self.book = formualizer.load_workbook(str(path))
        self.book.evaluate_all()

    def set(self, value):
        self.book.set_value("Mechanism", 2, 2, value)
        self.book.evaluate_all()

    def get(self, row, col):
        return self.book.get_value("Positions", row, col)


class Formulas:
    most = 361

    def __init__(self, path):
        from mechsheet.checking.programs import answers

        self.answers = answers("formulas", path)

    def get(self, row, col):
        return self.answers.get("Positions", row - 1, col - 1)


class Numpy:
    """The same columns written by hand; reads no file."""

    most = 361_000

    def __init__(self, path):
        self.rows = int(path.stem.split()[0])
        self.columns = by_hand(self.rows)

    def set(self, value):
        self.columns = by_hand(self.rows, value)

    def get(self, row, col):
        return float(self.columns[col - 2][row - FIRST])


PACKAGES = {
    "mechsheet": Mechsheet,
    "numpy by hand, no file": Numpy,
    "ironcalc": Ironcalc,
    "formualizer": Formualizer,
    "formulas": Formulas,
}
PROGRAMS = {"LibreOffice": ("soffice", 36_001), "gnumeric": ("ssconvert", 36_001)}


def installed(name):
    if name in PROGRAMS:
        return shutil.which(PROGRAMS[name][0]) is not None
    return importlib.util.find_spec(name.split()[0]) is not None


def run_here(name, path, row, change):
    """In a process of its own: open, answer, and time changes. Prints the value, CPU seconds of one change, peak MB."""
    peer = PACKAGES[name](path)
    value = peer.get(row, LAST)
    best = float("inf")
    lengths = count()
    until = time.process_time() + 2
    while change and time.process_time() < until:
        start = time.process_time_ns()
        for _ in range(change):
            peer.set(CHANGED + 0.001 * (next(lengths) % 7))  # never what it was
            value = peer.get(row, LAST)
        best = min(best, (time.process_time_ns() - start) / change / 1e9)
    if change:
        peer.set(CHANGED - 1)
        peer.set(CHANGED)
        value = peer.get(row, LAST)
    print(value, best, peak_memory())


def peak_memory():
    """Megabytes that this process had at most (what `getrusage` says includes the process that started it)."""
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    line = next(line for line in status.read_text(encoding="utf-8").splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) / 1024


def command_of(name, path, row, folder, change=0):
    """What to start, and where the answer will be (None: on standard output)."""
    if name in PACKAGES:
        return [sys.executable, __file__, "--run", name, str(path), str(row), str(change)], None
    if name == "gnumeric":
        table = folder / "gnumeric.csv"
        return ["ssconvert", "--recalc", str(path), str(table)], table
    from mechsheet.checking.programs import RECALCULATE

    user = folder / "profile" / "user"
    if not user.exists():
        user.mkdir(parents=True)
        (user / "registrymodifications.xcu").write_text(RECALCULATE, encoding="utf-8")
    profile = f"-env:UserInstallation={user.parent.as_uri()}"
    command = ["soffice", profile, "--headless", "--convert-to", "csv", "--outdir", str(folder), str(path)]
    return command, folder / f"{path.stem}.csv"


def measured(name, path, row, expected, runs, folder):
    """Best CPU seconds of whole processes, and peak megabytes of the largest of them."""
    best, peak = float("inf"), 0.0
    for _ in range(runs):
        command, table = command_of(name, path, row, folder)
        with tempfile.TemporaryFile("w+") as output:
            process = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = status
            output.seek(0)
            said = output.read()
        if status:
            raise SystemExit(f"{name} failed on {path.name}")
        best = min(best, usage.ru_utime + usage.ru_stime)
        if table is None:
            value, _, peak = map(float, said.split())
        else:
            peak = usage.ru_maxrss / 1024
            value = float(table.read_text(encoding="utf-8").splitlines()[-1].split(",")[LAST - 1].strip('"'))
        if abs(value - expected) > (1e-9 if table is None else 1e-2) * max(1, abs(expected)):
            raise SystemExit(f"{name} answers {value} on {path.name}, expected {expected}")
        if best > SLOW:
            break
    return best, peak


def whole_processes(peers, files, runs, folder):
    """The table of whole processes: (lines, peaks)."""
    lines = [f"| whole process, CPU | {' | '.join(files)} |", f"|---|{'--:|' * len(files)}"]
    cells = {name: [] for name in peers}
    for label, (rows, shared) in files.items():
        path = folder / f"{rows} {'shared' if shared else 'full'}.xlsx"
        write_table(path, rows, shared)
        expected = float(by_hand(rows)[-1][-1])
        seconds = None
        for name in peers:
            most = PACKAGES[name].most if name in PACKAGES else PROGRAMS[name][1]
            if rows > most:
                cells[name].append("")
                continue
            used, peak = measured(name, path, rows + FIRST - 1, expected, runs, folder)
            seconds = used if seconds is None else seconds
            shown = f"{used:.2f} s" if name == "mechsheet" else f"{used / seconds:.2f}"
            cells[name].append(f"{shown}, {peak:,.0f} MB" if rows > 36_001 else shown)
            print(f"{label}: {name} {used:.2f} s, {peak:.0f} MB", file=sys.stderr)
        path.unlink()
    return lines + [f"| {name} | {' | '.join(cells[name])} |" for name in peers]


def changes(peers, sizes, folder):
    """The table of one change in memory."""
    lines = [f"| one change, CPU | {' | '.join(f'{rows:,}' for rows in sizes)} |", f"|---|{'--:|' * len(sizes)}"]
    cells = {name: [] for name in peers if name in PACKAGES and hasattr(PACKAGES[name], "set")}
    for rows in sizes:
        path = folder / f"{rows} full.xlsx"
        write_table(path, rows, False)
        expected = float(by_hand(rows, CHANGED)[-1][-1])
        ours = None
        for name, found in cells.items():
            repeats = 100 if name in ("mechsheet", "numpy by hand, no file") else 2
            command, _ = command_of(name, path, rows + FIRST - 1, folder, repeats if rows < 36_001 else 2)
            said = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
            if abs(float(said[0]) - expected) > 1e-9 * max(1, abs(expected)):
                raise SystemExit(f"{name} answers {said[0]} after a change, expected {expected}")
            used = float(said[1])
            ours = used if ours is None else ours
            found.append(f"{used * 1e6:,.0f} µs" if name == "mechsheet" else f"{used / ours:,.2f}")
            print(f"{rows}: one change, {name} {used * 1e6:.0f} us", file=sys.stderr)
        path.unlink()
    return lines + [f"| {name} | {' | '.join(row)} |" for name, row in cells.items()]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true", help="small files only, one run each")
    parser.add_argument("--write", type=Path, help="put the tables into this file, between its marks")
    options = parser.parse_args()
    names = [*PACKAGES, *PROGRAMS]
    peers = [name for name in names if installed(name)]
    files = {label: file for label, file in FILES.items() if file[0] <= 3_601 or not options.quick}
    with tempfile.TemporaryDirectory(prefix="mechsheet-bench-") as place:
        folder = Path(place)
        lines = whole_processes(peers, files, 1 if options.quick else 3, folder)
        lines += ["", *changes(peers, (361, 3_601) if options.quick else (361, 3_601, 36_001), folder)]
    missing = [name for name in names if name not in peers]
    if missing:
        lines += ["", f"Not installed, so left out: {', '.join(missing)}."]
    text = "\n".join(lines)
    print(text)
    if options.write is not None:
        before, _, rest = options.write.read_text(encoding="utf-8").partition(MARKS[0])
        after = rest.partition(MARKS[1])[2]
        options.write.write_text(f"{before}{MARKS[0]}\n\n{text}\n\n{MARKS[1]}{after}", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--run"]:
        run_here(sys.argv[2], Path(sys.argv[3]), int(sys.argv[4]), int(sys.argv[5]))
    else:
        main()
