"""The figures of docs/proof.md: random inputs and damaged formulas over all templates.

python tools/proof.py perturb 12 [TEMPLATE...] [--with libreoffice,gnumeric,ironcalc] [--seed S]
python tools/proof.py mutate 8 [TEMPLATE...] [--seed S]
python tools/proof.py mutate-forces 12 [CASE...] [--seed S]
python tools/proof.py mutate-every 0 [TEMPLATE...] [--seed S]
python tools/proof.py perturb-forces 3 [TEMPLATE...] --with libreoffice,gnumeric [--seed S]
python tools/proof.py perturb-forces-page 3 [TEMPLATE...] --with libreoffice,gnumeric,ironcalc [--seed S]

`perturb-forces` is of workbooks with velocities and forces, `perturb-forces-page` of the same on one sheet (without
flywheels and tolerances, which need sheets). `mutate-forces` damages the sheets of velocities and forces alone, of published
cases, `mutate-every` every formula of these sheets of three templates, by each kind of damage that it can have.
Prints a table in Markdown, and puts it between its marks in docs/proof.md when all templates were run. --jobs N runs N
templates at a time.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from mechsheet.checking import Mutation, Perturbation, mutate, perturb
from mechsheet.checking.mutation import by_kind, by_sheet
from mechsheet.compiled import Compiled
from mechsheet.description import load

HERE = Path(__file__).parent.parent
TEMPLATES = HERE / "templates"
CASES = HERE / "tests" / "cases" / "published"
DOCUMENT = HERE / "docs" / "proof.md"
WITH_FORCES = ("engine", "four-bar-forces", "scissor-lift-between-arms", "six-link-dwell", "toggle-press")
"""Templates of which `perturb-forces` is."""

EVERY = ("engine", "four-bar-forces", "six-link-dwell")
"""Templates of which `mutate-every` is."""

PLACES = ("positions", "mechanism", "checks", "extremes", "drawing", "tables", "others")
"""Sheets that a damage may be on; the others are those of velocities, forces, tolerances, Newton's method and tasks."""


def perturbed(count: int, seed: int, programs: tuple[str, ...], name: str) -> Perturbation:
    """One template with random inputs."""
    return perturb(TEMPLATES / f"{name}.toml", count, seed, programs)


def page_perturbed(count: int, seed: int, programs: tuple[str, ...], name: str) -> Perturbation:
    """One template on a page, with random inputs."""
    text = (TEMPLATES / f"{name}.toml").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^\[(flywheel|tolerance)\]\n(?:\w.*\n)*", "", text)
    text = re.sub(r"(?m)^\[workbook\]\n", "", re.sub(r"(?m)^layout *=.*\n", "", text))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.toml"
        path.write_text(text + '\n[workbook]\nlayout = "page"\n', encoding="utf-8")
        return perturb(path, count, seed, programs)


def mutated(count: int, seed: int, name: str) -> Mutation:
    """One template with damaged formulas."""
    return mutate(TEMPLATES / f"{name}.toml", count, seed)


def forces_mutated(count: int, seed: int, name: str) -> Mutation:
    """One published case with masses or loads, formulas of velocities and forces damaged."""
    case = tomllib.loads((CASES / f"{name}.toml").read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.toml"
        path.write_text(case["description"], encoding="utf-8")
        return mutate(path, count, seed, sheets=("rates", "forces"))


def every_mutated(seed: int, name: str) -> Mutation:
    """One template, every formula of velocities and forces damaged in each way."""
    return mutate(TEMPLATES / f"{name}.toml", None, seed, sheets=("rates", "forces"))


def with_forces() -> list[str]:
    """The published cases that have forces."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted(CASES.glob("*.toml"))}
    return [name for name, text in texts.items() if "mass =" in text or "[[loads]]" in text]


def forces_table(found: dict[str, Mutation]) -> Iterator[str]:
    """A row for each case, and their sums: by the sheet of the damage what the workbook's own checks notice."""
    yield "| case | damages | check | reference alone | sheet alone | velocities | forces |"
    yield "|---|---|---|---|---|---|---|"
    whole: Counter[str] = Counter()
    for name, one in found.items():
        sums = Counter({by: one.caught(by) for by in ("check", "reference", "sheet")}, damages=len(one.damages))
        for title, (number, caught) in one.tally(by_sheet).items():
            key = "velocities" if title in ("Rates", "Hızlar") else "forces"
            sums.update({f"{key} of": number, key: caught})
        whole += sums
        yield _forces_row(name, sums)
    yield _forces_row("**all**", whole)


def _forces_row(name: str, sums: Counter[str]) -> str:
    shares = " | ".join(f"{sums[by] / max(1, sums['damages']):.0%}" for by in ("check", "reference", "sheet"))
    parts = " | ".join(f"{sums[key]}/{sums[f'{key} of']}" for key in ("velocities", "forces"))
    return f"| {name} | {sums['damages']} | {shares} | {parts} |"


def perturb_table(found: dict[str, Perturbation]) -> Iterator[str]:
    """A row for each template, and how many values were compared."""
    judges = [item.worst.judge for item in next(iter(found.values())).judged]
    yield "| template | rows | sets: all rows, some, none | " + " | ".join(f"{judge}, worst" for judge in judges) + " |"
    yield "|---|---|---|" + "---|" * len(judges)
    cells: Counter[str] = Counter()
    for name, one in found.items():
        worst = [
            f"{item.worst.worst:.0e}" + (f" ({item.differing} differ)" if item.differing else "") for item in one.judged
        ]
        for item in one.judged:
            cells[item.worst.judge] += item.cells
        yield f"| {name} | {one.rows} | {one.whole}, {one.partly}, {one.nowhere} | {' | '.join(worst)} |"
    yield ""
    yield "Values compared: " + ", ".join(f"{cells[judge]:,} with {judge}" for judge in judges) + "."


def place_of(title: str, titles: dict[str, str]) -> str:
    """What a sheet is; a sheet that is not known is a two-way table."""
    place = titles.get(title, "tables")
    return place if place in PLACES else "others"


def mutate_table(found: dict[str, Mutation]) -> Iterator[str]:
    """A row for each template, their sums, and the kinds of damage."""
    yield "| template | damages | check | reference alone | sheet alone | " + " | ".join(PLACES) + " |"
    yield "|---|---|---|---|---|" + "---|" * len(PLACES)
    whole: dict[str, list[int]] = {}
    kinds: dict[str, list[int]] = {}
    totals = Counter[str]()
    for name, one in found.items():
        titles = sheet_titles(name)
        shares = one.tally(lambda damage, titles=titles: place_of(damage.where.rpartition("!")[0], titles))  # type: ignore[misc]
        for table, part in ((whole, shares), (kinds, one.tally(by_kind))):
            for key, (number, caught) in part.items():
                entry = table.setdefault(key, [0, 0])
                entry[0] += number
                entry[1] += caught
        totals += Counter(damages=len(one.damages), check=one.caught("check"), reference=one.caught("reference"))
        totals += Counter(sheet=one.caught("sheet"), harmless=one.harmless, circular=one.circular)
        parts = (f"{shares[place][1]}/{shares[place][0]}" if place in shares else "" for place in PLACES)
        caught = " | ".join(f"{one.share(by):.0%}" for by in ("check", "reference", "sheet"))
        yield f"| {name} | {len(one.damages)} | {caught} | {' | '.join(parts)} |"
    shares = " | ".join(f"{totals[by] / totals['damages']:.1%}" for by in ("check", "reference", "sheet"))
    parts = (f"{whole[place][1]}/{whole[place][0]}" if place in whole else "" for place in PLACES)
    yield f"| **all** | {totals['damages']} | {shares} | {' | '.join(parts)} |"
    yield ""
    yield (
        "By kind of damage, caught by the sheet alone: "
        + ", ".join(f"{kind} {caught}/{number}" for kind, (number, caught) in sorted(kinds.items()))
        + f". Drawn besides: {totals['harmless']} damages that change no value, {totals['circular']} circular ones."
    )


def sheet_titles(name: str) -> dict[str, str]:
    """Title of a sheet -> what it is."""
    plan = Compiled(load(TEMPLATES / f"{name}.toml")).plan
    return {title: key for key, title in plan.at.titles.items()}


def put(mark: str, lines: list[str]) -> None:
    """Between `<!-- mark -->` and `<!-- end -->`."""
    text = DOCUMENT.read_text(encoding="utf-8")
    new = "\n".join([f"<!-- {mark} -->", *lines, "<!-- end -->"])
    pattern = re.compile(rf"<!-- {mark} -->.*?<!-- end -->", re.DOTALL)
    if not pattern.search(text):
        raise SystemExit(f"docs/proof.md has no place for {mark}")
    DOCUMENT.write_text(pattern.sub(lambda _: new, text), encoding="utf-8")


Job = tuple[Callable[[str], object], list[str]]
"""What is done with a name, and the names."""


def _templates() -> list[str]:
    return sorted(path.stem for path in TEMPLATES.glob("*.toml"))


JOBS: dict[str, Callable[[int, int, tuple[str, ...]], Job]] = {
    "perturb": lambda count, seed, programs: (partial(perturbed, count, seed, programs), _templates()),
    "perturb-forces": lambda count, seed, programs: (partial(perturbed, count, seed, programs), [*WITH_FORCES]),
    "perturb-forces-page": lambda count, seed, programs: (
        partial(page_perturbed, count, seed, programs),
        [*WITH_FORCES],
    ),
    "mutate": lambda count, seed, _: (partial(mutated, count, seed), _templates()),
    "mutate-forces": lambda count, seed, _: (partial(forces_mutated, count, seed), with_forces()),
    "mutate-every": lambda _, seed, __: (partial(every_mutated, seed), [*EVERY]),
}


def main() -> None:
    """Run, print, and put in its place."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=JOBS)
    parser.add_argument("count", type=int)
    parser.add_argument("templates", nargs="*")
    parser.add_argument("--with", dest="programs", default="")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    given = parser.parse_args()
    programs = tuple(part for part in given.programs.split(",") if part)
    job, every = JOBS[given.what](given.count, given.seed, programs)
    names = given.templates or every
    found = {}
    with ProcessPoolExecutor(given.jobs) as pool:
        for name, one in zip(names, pool.map(job, names), strict=True):
            found[name] = one
            print(name, file=sys.stderr, flush=True)
    typed, forces = given.what.startswith("perturb"), given.what in ("mutate-forces", "mutate-every")
    table = perturb_table if typed else forces_table if forces else mutate_table
    what = f"{'sets' if typed else 'damages'} for each {'case' if given.what == 'mutate-forces' else 'template'}"
    count = "All formulas" if given.what == "mutate-every" else f"{given.count} {what}"
    lines = [f"{count}, seed {given.seed}.", "", *table(found)]  # type: ignore[arg-type]
    print("\n".join(lines))
    if not given.templates:
        put(given.what + ("-programs" if programs and given.what == "perturb" else ""), lines)


if __name__ == "__main__":
    main()
