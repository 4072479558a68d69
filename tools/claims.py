"""What the first sheet says, judged after random changes of its yellow cells: over all templates and random mechanisms.

python tools/claims.py [--random N] [--first SEED] [--changes N] [--templates PATTERN] [--check]
python tools/claims.py --with libreoffice,gnumeric           one change in ten of each, computed by other programs
python tools/claims.py --with libreoffice,gnumeric --asked   nothing but these, by the engine too: 300 mechanisms in an hour
python tools/claims.py --wrong FILE                          wrong claims are written there as they are found
python tools/claims.py --again FILE                          only these settings

Each mechanism is built once; then its dimensions, start, step and modes are typed anew, the engine recalculates, and every
line is held against a search (`tests/sheet/findings/claims.py`). `--check` asks `mechsheet check` of the same values, too:
its
own search against the sheet's cells. Prints how many claims of each kind are wrong; --table puts them into docs/proof.md.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent
TESTS = (".", "sheet", "sheet/findings")
sys.path[:0] = [*(str(ROOT / "tests" / name) for name in TESTS), str(ROOT / "src")]

from claimed import Sheets, named_sheets, settings_of  # noqa: E402
from claims import Claims, judge, judge_typed  # noqa: E402

from chosen import LISTED, but  # noqa: E402
from livesheet.diagnostics import WorkbookError  # noqa: E402
from mechsheet.checking.against_search import against_search  # noqa: E402
from mechsheet.checking.programs import answers_to_all  # noqa: E402

DOCUMENT = ROOT / "docs" / "proof.md"
Inputs = dict[str, float]
A_PART, BATCH = 10, 20
"""Other programs are asked of one setting in so many, and of so many files at once: to start LibreOffice is slow."""


def main() -> None:
    """Run it."""
    given = _arguments()
    # where a list gives positions there are no others between them to search
    paths = sorted((ROOT / "templates").glob(f"{given.templates}.toml")) if given.templates else []
    names = [path.stem for path in but(paths, *LISTED)]
    names += [f"random {seed}" for seed in range(given.first, given.first + given.random)]
    again = _written_before(Path(given.again)) if given.again else None
    run = _Run(
        given.changes, [name for name in given.programs.split(",") if name], given.check, given.wrong, given.asked
    )
    begun = time.perf_counter()
    try:
        for name in again or names:
            run.judge(name, again[name] if again else None)
            print(f"{name}: {run.so_far()}, {time.perf_counter() - begun:.0f} s", file=sys.stderr)
    except KeyboardInterrupt:
        print("interrupted: the tables are of what was judged so far", file=sys.stderr)
    run.ask()
    for who, claims in run.claims.items():
        count = sum(claims.judged.values())
        print(f"\n{who}: {len(claims.wrong)} wrong of {count:,} claims, {run.settings[who]:,} settings")
        print("\n".join(_table(claims)))
        for entry in claims.wrong[: given.show]:
            print(*entry)
    if given.table:
        _into_document(given.table, run)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--random", type=int, default=60, help="so many random mechanisms, of one to three groups")
    parser.add_argument("--first", type=int, default=0, help="the first one's seed")
    parser.add_argument("--templates", default="*", help="which templates, as a pattern; none: ''")
    parser.add_argument("--changes", type=int, default=10, help="changes of each")
    parser.add_argument("--with", dest="programs", default="", help="other programs, of one setting in ten")
    parser.add_argument("--asked", action="store_true", help="judge only the settings that other programs are asked of")
    parser.add_argument("--check", action="store_true", help="ask `mechsheet check` too")
    parser.add_argument("--wrong", default="", help="file to which wrong claims are written as they are found")
    parser.add_argument("--again", default="", help="judge only what stands in such a file")
    parser.add_argument("--show", type=int, default=40, help="so many wrong claims are printed")
    parser.add_argument("--table", default="", help="put the table between these marks of docs/proof.md")
    return parser.parse_args()


def _written_before(path: Path) -> dict[str, list[Inputs]]:
    """By mechanism the settings in which something was wrong in an earlier run."""
    found: dict[str, list[Inputs]] = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        entry = json.loads(line)
        settings = found.setdefault(entry["name"], [])
        if entry["inputs"] not in settings:
            settings.append(entry["inputs"])
    return found


@dataclass(frozen=True)
class _Asked:
    """A setting that other programs are asked of, and the file in which it is typed."""

    sheets: Sheets
    name: str
    inputs: Inputs
    file: Path


class _Run:
    """The claims found so far, by who has computed the workbook."""

    def __init__(self, changes: int, programs: list[str], check: bool, wrong: str, only_asked: bool) -> None:
        self.changes, self.programs, self.check, self.only_asked = changes, programs, check, only_asked
        self.claims = {who: Claims() for who in ("engine", *(["check"] if check else []), *programs)}
        self.settings: Counter[str] = Counter()
        self.mechanisms = 0
        self.log = Path(wrong) if wrong else None
        self.folder = tempfile.TemporaryDirectory()
        self.asked: list[_Asked] = []
        self.count = 0

    def so_far(self) -> str:
        """How many are wrong of how many."""
        return ", ".join(f"{who} {len(each.wrong)} of {sum(each.judged.values())}" for who, each in self.claims.items())

    def judge(self, name: str, settings: list[Inputs] | None) -> None:
        """One mechanism, with all its settings."""
        sheets = named_sheets(name)
        if sheets is None:
            return
        self.mechanisms += 1
        elsewhere = []
        for inputs in settings_of(name, sheets, self.changes) if settings is None else settings:
            self.count += 1
            asked = settings is not None or self.count % A_PART == 0
            if asked:
                elsewhere.append(inputs)
            elif self.only_asked:
                continue
            with self._noted("engine", name, inputs) as claims:
                judge(sheets, inputs, claims, name)
            if self.check:
                self._check(sheets, name, inputs)
        if elsewhere and self.programs:
            self._write(sheets, name, elsewhere)
        if len(self.asked) >= BATCH:
            self.ask()

    def _check(self, sheets: Sheets, name: str, inputs: Inputs) -> None:
        with self._noted("check", name, inputs) as claims:
            try:
                found = against_search(sheets.book.book, sheets.values, sheets.plan, name)
            except WorkbookError:  # inputs that cannot be
                return
            if found is not None:
                claims.judged["cells"] += found.cells - 1
                claims.say("cells", found.agrees, name, inputs, found.where, found.ours, found.theirs)

    def _write(self, sheets: Sheets, name: str, settings: list[Inputs]) -> None:
        for inputs in settings:
            file = Path(self.folder.name) / f"set-{self.count}-{len(self.asked)}.xlsx"
            sheets.write(inputs, file)
            self.asked.append(_Asked(sheets, name, inputs, file))

    def ask(self) -> None:
        """Other programs, of all files that are written."""
        for program in self.programs if self.asked else ():
            answers = answers_to_all(program, [each.file for each in self.asked])
            for each, values in zip(self.asked, answers, strict=True):
                with self._noted(program, each.name, each.inputs) as claims:
                    judge_typed(each.sheets.elsewhere(values), each.inputs, claims, each.name)
        for each in self.asked:
            each.file.unlink()
        self.asked = []

    @contextmanager
    def _noted(self, who: str, name: str, inputs: Inputs) -> Iterator[Claims]:
        """The claims of somebody; those that are wrong with these inputs are written down."""
        self.settings[who] += 1
        claims = self.claims[who]
        before = len(claims.wrong)
        yield claims
        for wrong in claims.wrong[before:]:
            if self.log is None:
                break
            entry = {"who": who, "name": name, "inputs": inputs, "kind": wrong[0], "details": repr(wrong[3:])}
            with self.log.open("a", encoding="utf-8") as log:
                print(json.dumps(entry), file=log)


KINDS = {
    "rows that close": ("rows_closed", "rows_closed words", "nothing else said where nothing closes"),
    "limits, range of the driver": ("limits", "limit", "limits words", "limit in words", "input", "input words"),
    "gaps between positions, leaps, gap of joints": (
        "passes",
        "passes words",
        "leaps",
        "largest_gap",
        "largest_gap words",
    ),
    "Grashof": ("grashof", "grashof words"),
    "swings, strokes, crank or rocker": ("swing", "swing words", "stroke", "stroke words", "unsure"),
    "time ratios": ("time_ratio",),
    "transmission angle": ("transmission", "transmission at", "transmission words"),
    "summaries": ("summary", "without bound"),
    "wrong inputs": ("wrong input", "impossible"),
    "the line under the title, its colour": ("verdict", "verdict colour"),
    "words without errors, rows only": ("words without errors", "rows only"),
    "cells that check compares": ("cells",),
}


def _table(claims: Claims) -> list[str]:
    """A row for each kind of claim."""
    wrong = Counter(_kind(entry[0]) for entry in claims.wrong)
    judged: Counter[str] = Counter()
    for kind, count in claims.judged.items():
        judged[_kind(kind)] += count
    rows = [f"| {kind} | {judged[kind]:,} | {wrong[kind]} |" for kind in (*KINDS, "other") if judged[kind]]
    total = f"| **all** | {sum(judged.values()):,} | {sum(wrong.values())} |"
    return ["| what is said | claims | wrong |", "|---|---|---|", *rows, total]


def _kind(kind: str) -> str:
    kind = kind.removesuffix(" (rows too far apart)").removesuffix(" words (rows too far apart)")
    kind = kind.replace(" (rows too far apart)", "")
    for title, kinds in KINDS.items():
        if kind in kinds or any(
            kind.startswith(each) for each in kinds if each in ("summary", "wrong input", "impossible")
        ):
            return title
    return "other"


def _into_document(mark: str, run: _Run) -> None:
    """Put the tables between their marks in docs/proof.md."""
    parts = []
    for who, claims in run.claims.items():
        parts += [f"{who}: {run.mechanisms} mechanisms, {run.settings[who]:,} settings.", "", *_table(claims), ""]
    text = DOCUMENT.read_text(encoding="utf-8")
    new = "\n".join(parts).rstrip()
    found, count = re.subn(rf"(<!-- {mark} -->\n).*?(\n<!-- end -->)", lambda m: m[1] + new + m[2], text, flags=re.S)
    if not count:
        raise SystemExit(f"no mark {mark} in {DOCUMENT.name}")
    DOCUMENT.write_text(found, encoding="utf-8")


if __name__ == "__main__":
    main()
