"""Makes the case tables of the engine's functions from `tests/cases/engine/calls.txt`, by asking other programs.

    python tools/engine_cases.py             what the programs say where they do not all agree with the tables
    python tools/engine_cases.py --write     write the tables and the differences

A value goes into a table when at least one other program gives it, too; where none does, it must stand in `decided.toml`,
with the reason. What the programs give where they differ from a table goes to `differences_<program>.toml`.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from asking import PROGRAMS, agree, asked, code_agrees, ours, outvoted  # noqa: E402
from engine_cases import FOLDER, cells, load, quoted, scalar, spelt  # noqa: E402
from livesheet.formula.functions import FUNCTIONS  # noqa: E402
from livesheet.formula.nodes import Call, Node, Text, walk  # noqa: E402
from livesheet.formula.parser import parse_formula  # noqa: E402
from livesheet.formula.printer import print_formula  # noqa: E402

SINGLE = "npytbda"
VARIANTS = ("A3", "A6", "A5", "A7", "A4")
"""What takes the place of a single value: a text, an error, a blank cell, a text that shows a number, a truth value."""


def calls() -> dict[str, list[str]]:
    """Table -> its formulas, with their variants."""
    tables: dict[str, list[str]] = {}
    for line in (FOLDER / "calls.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            current = tables.setdefault(line.strip("[]"), [])
        elif line.startswith("! "):
            current.append(line[2:])
        elif line and not line.startswith("#"):
            current.extend(variants(line))
    left_out = set(load(FOLDER / "decided.toml")["left_out"])
    for name, formulas in tables.items():
        tables[name] = [formula for formula in dict.fromkeys(formulas) if formula not in left_out]
        left_out.update(tables[name])
    return tables


def variants(formula: str) -> list[str]:
    """A call, and the call with each of its single values replaced."""
    node = parse_formula(formula)
    assert isinstance(node, Call)
    found = [formula]
    kinds = FUNCTIONS[node.name].kinds_of(len(node.args))
    for place, kind in enumerate(kinds):
        if kind not in SINGLE + "v":
            continue
        if kind == "v" and place:
            continue
        shown = [print_formula(arg) for arg in node.args]
        for other in VARIANTS:
            found.append(f"{node.name}({','.join([*shown[:place], other, *shown[place + 1 :]])})")
        if kind in SINGLE and place == 0 and not any(isinstance(part, Text) for part in walk(node.args[0])):
            array = "{" + shown[0] + ";" + shown[0] + "}" if re.fullmatch(r"-?[\d.]+", shown[0]) else ""
            if array:
                found.append(f"SUMPRODUCT({node.name}({','.join([array, *shown[1:]])}))")
    return found


def decided() -> dict[str, object]:
    """Formula -> the value chosen by hand."""
    return {formula: scalar(value) for formula, value in load(FOLDER / "decided.toml")["values"].items()}


def main() -> None:
    """Ask, compare, and write."""
    tables = calls()
    formulas = [formula for name in tables for formula in tables[name]]
    mine, theirs, chosen = ours(formulas, list(cells())), asked(formulas, list(cells())), decided()
    unknown = {name for formula in formulas for name in _names(parse_formula(formula))} - FUNCTIONS.keys()
    assert not unknown, unknown
    values: dict[str, object] = {}
    open_ = 0
    for place, formula in enumerate(formulas):
        given = {program: theirs[program][place] for program in PROGRAMS}
        value = chosen.get(formula, mine[place])
        confirmed = any(agree(value, other) and code_agrees(value, given) for other in given.values())
        if not confirmed and formula not in chosen:
            open_ += 1
            print(f"{formula:60s} ours {mine[place]!s:24} " + "  ".join(f"{p} {v!s}" for p, v in given.items()))
        elif "--doubtful" in sys.argv and formula not in chosen and outvoted(value, given):
            print(f"{formula:60s} ours {mine[place]!s:24} " + "  ".join(f"{p} {v!s}" for p, v in given.items()))
        elif formula in chosen and not agree(chosen[formula], mine[place]):
            print(f"WRONG {formula}: decided {chosen[formula]!s}, ours {mine[place]!s}")
        values[formula] = value
    print(len(formulas), "formulas,", open_, "open")
    if "--write" in sys.argv:
        write(tables, values, formulas, theirs)


def _names(node: Node) -> set[str]:
    return {part.name for part in walk(node) if isinstance(part, Call)}


def write(
    tables: dict[str, list[str]], values: dict[str, object], formulas: list[str], theirs: dict[str, list[object]]
) -> None:
    """The case tables, and what the programs say otherwise."""
    for name, own in tables.items():
        lines = [f"  [{quoted(formula)}, {spelt(values[formula])}]," for formula in own]
        text = "# made by tools/engine_cases.py from calls.txt\narrays = true\ncases = [\n" + "\n".join(lines) + "\n]\n"
        (FOLDER / f"{name}.toml").write_text(text, encoding="utf-8")
    for program in PROGRAMS:
        lines = [
            f"{quoted(formula)} = {spelt(other)}"
            for formula, other in zip(formulas, theirs[program], strict=True)
            if not agree(values[formula], other)
        ]
        text = f"# what {program} gives where it differs from the tables; made by tools/engine_cases.py\n[values]\n"
        (FOLDER / f"differences_{program}.toml").write_text(text + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
